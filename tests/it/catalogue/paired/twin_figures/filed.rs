//! A gripper as its file has it, moved: places and turns of all links by Newton's method with difference quotients.

use super::super::super::solve_square;
use crate::common::*;
use std::array::from_fn;
use toml::Table;

pub(in super::super::super) type Point = [f64; 2];

/// Steps from the narrowest part to the widest: other poses than the catalogue looks at, which takes 48.
const STEPS: f64 = 60.0;
/// So many mm count as a radian of a link, so that turns and shifts fit as exactly.
const ARM: f64 = 50.0;

#[derive(Clone, Copy, PartialEq)]
pub(in super::super::super) enum Holds {
    Hinge,
    Slide,
    Slot,
}

/// A joint of a file: of a slot the link with the pin is the first.
pub(in super::super::super) struct FiledJoint {
    id: String,
    pub(in super::super::super) holds: Holds,
    pub(in super::super::super) links: [usize; 2],
    pub(in super::super::super) at: Point,
    pub(in super::super::super) along: Point,
    /// The end that has the pin, or the block of a guide: what moves, where the other is the frame.
    pub(in super::super::super) pin: usize,
    pub(in super::super::super) driven: bool,
}

/// Teeth: the joints of their carrier that hold them, and how fast the second goes by the first.
pub(in super::super::super) struct FiledTeeth {
    pub(in super::super::super) held: [usize; 2],
    ratio: f64,
}

pub(in super::super::super) struct Gripper {
    pub(in super::super::super) links: usize,
    pub(in super::super::super) frame: usize,
    pub(in super::super::super) jaws: Vec<usize>,
    pub(in super::super::super) tips: Vec<Point>,
    pub(in super::super::super) joints: Vec<FiledJoint>,
    pub(in super::super::super) teeth: Vec<FiledTeeth>,
}

/// A number of a file: one that is written in words may have a root of three in it.
fn real(x: &toml::Value) -> f64 {
    let Some(words) = x.as_str() else {
        let whole = || x.as_integer().unwrap() as f64;
        return x.as_float().unwrap_or_else(whole);
    };
    let number: Expr = words.replace("sqrt3", "sqrt(3)").parse().unwrap();
    number.to_f64()
}

fn filed<'t>(file: &'t Table, key: &str) -> Vec<&'t toml::Value> {
    let all = file.get(key).and_then(toml::Value::as_array);
    all.into_iter().flatten().collect()
}

/// What a gripper is moved to: a width of the part, or a place of its drive (mm or rad).
#[derive(Clone, Copy)]
pub(in super::super::super) enum To {
    Width(f64),
    Drive(f64),
}

pub(in super::super::super) fn place(x: &[f64], link: usize, p: Point) -> Point {
    let [t, u, v] = [x[3 * link], x[3 * link + 1], x[3 * link + 2]];
    [
        t.cos() * p[0] - t.sin() * p[1] + u,
        t.sin() * p[0] + t.cos() * p[1] + v,
    ]
}

impl FiledJoint {
    /// So many mm count as a radian or a millimetre of it.
    fn arm(&self) -> f64 {
        if self.holds == Holds::Slide { 1.0 } else { ARM }
    }

    fn of(j: &toml::Value, link: impl Fn(&toml::Value) -> usize) -> FiledJoint {
        let options = j.get("options").map(toml::Value::to_string);
        // Flat faces are laid out as pins in slots, since two of their constraints are redundant in the plane.
        let faces = options.is_some_and(|o| o.contains("\"pin-in-slot\""));
        let (holds, lies) = match j["type"].as_str().unwrap() {
            "revolute" => (Holds::Hinge, "axis"),
            "slotted" => (Holds::Slot, "reference"),
            _ if faces => (Holds::Slot, "axis"),
            _ => (Holds::Slide, "axis"),
        };
        let along = [0, 1].map(|k| real(&j[lies][k]));
        let block = holds == Holds::Slide && j["links"][1].as_str() != Some("frame");
        FiledJoint {
            id: j["id"].as_str().unwrap().to_owned(),
            holds,
            links: [0, 1].map(|k| link(&j["links"][k])),
            at: [0, 1].map(|k| real(&j["point"][k])),
            along: scale(along, 1.0 / length(along)),
            pin: usize::from(block),
            driven: j.get("drive").is_some(),
        }
    }
}

impl Gripper {
    pub(in super::super::super) fn read(file: &str) -> Gripper {
        let file: Table = file.parse().unwrap();
        let names: Vec<&str> = filed(&file, "link")
            .iter()
            .map(|l| l["id"].as_str().unwrap())
            .collect();
        let named = |name: &str| names.iter().position(|n| *n == name).unwrap();
        let link = |name: &toml::Value| named(name.as_str().unwrap());
        let joints: Vec<FiledJoint> = filed(&file, "joint")
            .iter()
            .map(|j| FiledJoint::of(j, link))
            .collect();
        let joint = |id: &toml::Value| joints.iter().position(|j| Some(&*j.id) == id.as_str());
        let teeth = filed(&file, "coupling").into_iter().map(|c| FiledTeeth {
            held: [0, 1].map(|k| joint(&c["joints"][k]).unwrap()),
            ratio: real(&c["ratio"]),
        });
        let tips = filed(&file, "point");
        Gripper {
            teeth: teeth.collect(),
            links: names.len(),
            frame: named("frame"),
            jaws: tips.iter().map(|t| link(&t["link"])).collect(),
            tips: (tips.iter().map(|t| [0, 1].map(|k| real(&t["point"][k])))).collect(),
            joints,
        }
    }

    /// Where a point of a joint is that goes with one of its links.
    pub(in super::super::super) fn on(&self, x: &[f64], j: &FiledJoint, end: usize) -> Point {
        place(x, j.links[end], j.at)
    }

    /// The direction of a guide or a slot, which goes with one of its links.
    pub(in super::super::super) fn along(&self, x: &[f64], j: &FiledJoint, end: usize) -> Point {
        let link = j.links[end];
        sub(place(x, link, j.along), place(x, link, [0.0; 2]))
    }

    /// How far the second link of a joint has gone against the first: rad, of a guide mm.
    pub(in super::super::super) fn gone(&self, x: &[f64], j: &FiledJoint) -> f64 {
        let [u, v] = j.links;
        match j.holds {
            Holds::Slide => dot(self.along(x, j, 0), sub(self.on(x, j, 1), self.on(x, j, 0))),
            _ => x[3 * v] - x[3 * u],
        }
    }

    pub(in super::super::super) fn input(&self) -> &FiledJoint {
        self.joints.iter().find(|j| j.driven).unwrap()
    }

    pub(in super::super::super) fn tip(&self, x: &[f64], n: usize) -> Point {
        place(x, self.jaws[n], self.tips[n])
    }

    /// From the middle of the part to each tip as drawn.
    fn arms(&self) -> impl Iterator<Item = Point> {
        let count = self.tips.len() as f64;
        let sum = |k: usize| self.tips.iter().map(|t| t[k]).sum::<f64>();
        let middle: Point = from_fn(|k| sum(k) / count);
        self.tips.iter().map(move |t| sub(*t, middle))
    }

    /// Away from the part.
    pub(in super::super::super) fn outward(&self) -> Vec<Point> {
        self.arms().map(|a| scale(a, 1.0 / length(a))).collect()
    }

    /// How far apart the tips are, as the forces of the part go: twice as far as they are from its middle on the average.
    pub(in super::super::super) fn width(&self, x: &[f64]) -> f64 {
        let ways = self.arms().zip(self.outward()).enumerate();
        let each =
            ways.map(|(n, (arm, out))| length(arm) + dot(sub(self.tip(x, n), self.tips[n]), out));
        2.0 * each.sum::<f64>() / self.tips.len() as f64
    }

    /// By how much everything misses, in mm: the frame its place, every joint, all teeth, and what it is moved to.
    fn misses(&self, x: &[f64], to: To) -> Vec<f64> {
        let mut out: Vec<f64> = x[3 * self.frame..][..3].to_vec();
        for j in &self.joints {
            let apart = sub(self.on(x, j, 1), self.on(x, j, 0));
            match j.holds {
                Holds::Hinge => out.extend(apart),
                Holds::Slide => {
                    out.push(dot(quarter_turn(self.along(x, j, 0)), apart));
                    out.push(ARM * (x[3 * j.links[1]] - x[3 * j.links[0]]));
                }
                Holds::Slot => out.push(dot(quarter_turn(self.along(x, j, 1)), apart)),
            }
        }
        for t in &self.teeth {
            let [a, b] = t.held.map(|j| &self.joints[j]);
            let off = self.gone(x, b) - t.ratio * self.gone(x, a);
            out.push(b.arm() * off);
        }
        let input = self.input();
        out.push(match to {
            To::Width(width) => self.width(x) - width,
            To::Drive(drive) => input.arm() * (self.gone(x, input) - drive),
        });
        out
    }

    /// How what misses changes with each of the unknown.
    pub(in super::super::super) fn columns(&self, x: &[f64], to: To) -> Vec<Vec<f64>> {
        let column = |c: usize| -> Vec<f64> {
            let [a, b] = [1e-6, -1e-6].map(|h| {
                let mut y = x.to_vec();
                y[c] += h;
                self.misses(&y, to)
            });
            a.iter().zip(&b).map(|(a, b)| (a - b) / 2e-6).collect()
        };
        (0..x.len()).map(column).collect()
    }

    /// Whether all links fit there, from a pose nearby.
    pub(in super::super::super) fn fits(&self, x: &mut [f64], to: To) -> bool {
        for _ in 0..20 {
            let off = self.misses(x, to);
            if off.iter().all(|m| m.abs() < 1e-9) {
                return true;
            }
            let by = solve_square(&self.columns(x, to), &off);
            x.iter_mut().zip(by).for_each(|(x, d)| *x -= d);
        }
        false
    }

    pub(in super::super::super) fn drawn(&self) -> Vec<f64> {
        vec![0.0; 3 * self.links]
    }

    /// Poses from the drawn one on, as many for a millimetre everywhere.
    pub(in super::super::super) fn stroke(&self, narrowest: f64, widest: f64) -> Vec<Vec<f64>> {
        let mut out = vec![self.drawn()];
        let drawn = self.width(&out[0]);
        let step = (widest - narrowest) / STEPS;
        for end in [narrowest, widest] {
            let mut x = self.drawn();
            let count = ((end - drawn) / step).abs().ceil();
            for i in 1..=count as u32 {
                let width = drawn + (end - drawn) * f64::from(i) / count;
                assert!(self.fits(&mut x, To::Width(width)), "no pose at {width} mm");
                out.push(x.clone());
            }
        }
        out
    }

    /// Of teeth the links, the first of them a pinion where the other is a rack, and the carrier.
    pub(in super::super::super) fn meshing(&self, t: &FiledTeeth) -> [usize; 3] {
        let [a, b] = t.held.map(|j| self.joints[j].links);
        let carrier = a.into_iter().find(|l| b.contains(l)).unwrap();
        let other = |ends: [usize; 2]| ends[usize::from(ends[0] == carrier)];
        [other(a), other(b), carrier]
    }

    /// Where pitch circles touch, which is where both have the same velocity, and which way teeth press.
    pub(in super::super::super) fn pitch(&self, x: &[f64], t: &FiledTeeth) -> [Point; 2] {
        let [first, second, carrier] = self.meshing(t);
        let [a, b] = t.held.map(|j| &self.joints[j]);
        let centres = [a, b].map(|j| place(x, carrier, j.at));
        // A joint tells how its second link goes against its first.
        let way = |j: &FiledJoint, gear: usize| if j.links[1] == gear { 1.0 } else { -1.0 };
        let ratio = t.ratio * way(a, first) * way(b, second);
        if b.holds == Holds::Slide {
            let along = self.along(x, b, 0);
            // An arm of the pinion goes a quarter of a turn ahead of where it points.
            let arm = scale(quarter_turn(along), -ratio);
            return [from_fn(|k| centres[0][k] + arm[k]), along];
        }
        let apart = sub(centres[1], centres[0]);
        let share = ratio / (ratio - 1.0);
        let touch = from_fn(|k| centres[0][k] + share * apart[k]);
        [touch, scale(quarter_turn(apart), 1.0 / length(apart))]
    }
}
