//! Strokes the slow way: all links of a layout solved afresh for each place of the drive, by Newton's method with difference
//! quotients on a turn and a shift of every link; joint forces by opening a joint a little and looking what the jaws do.

use super::{Drawn, gauss};
use ozols::chains::Input;
use ozols::synthesis::structure::Structure;

/// A joint that is opened: by so much in the plane, or for the slide across and turned.
#[derive(Clone, Copy)]
pub(super) struct Opened {
    pub(super) pin: usize,
    pub(super) by: [f64; 2],
}

pub(super) struct Twin<'a> {
    pub(super) s: &'a Structure,
    pub(super) l: &'a Drawn,
}

/// A turn and a shift of each link.
pub(super) type Pose = Vec<f64>;

/// The link that a joint's place goes with: the block of a drive that slides goes with the driver, and a pin with either link.
pub(super) fn carrier(s: &Structure, (u, v): (usize, usize)) -> usize {
    let r = &s.structure.roles;
    let drive = [(u, v), (v, u)].contains(&(r.frame, r.drive()[1]));
    if drive { r.drive()[1] } else { u }
}

pub(super) fn place(x: &[f64], link: usize, p: [f64; 2]) -> [f64; 2] {
    let [t, u, v] = [x[3 * link], x[3 * link + 1], x[3 * link + 2]];
    [
        t.cos() * p[0] - t.sin() * p[1] + u,
        t.sin() * p[0] + t.cos() * p[1] + v,
    ]
}

impl Twin<'_> {
    pub(super) fn slides(&self) -> bool {
        self.s.input() == Input::Slide
    }

    /// Whether a pin is the input joint.
    pub(super) fn is_input(&self, pin: usize) -> bool {
        let (u, v) = self.l.pins[pin];
        let r = &self.s.structure.roles;
        [(u, v), (v, u)].contains(&(r.frame, r.drive()[1]))
    }

    pub(super) fn drawn(&self) -> Pose {
        vec![0.0; 3 * self.s.structure.chain.links()]
    }

    fn misses(&self, x: &[f64], drive: f64, opened: Option<Opened>) -> Vec<f64> {
        let mut out: Vec<f64> = (0..3)
            .map(|k| x[3 * self.s.structure.roles.frame + k])
            .collect();
        for (i, (&(u, v), at)) in self.l.pins.iter().zip(&self.l.at).enumerate() {
            let by = opened.filter(|o| o.pin == i).map_or([0.0; 2], |o| o.by);
            let p = at.real();
            if self.slides() && self.is_input(i) {
                let d = self.s.structure.roles.drive()[1];
                let [a, b] = place(x, d, p);
                out.extend([
                    50.0 * (x[3 * d] - by[1]),
                    a - p[0] - drive,
                    b - p[1] - by[0],
                ]);
                continue;
            }
            let (a, b) = (place(x, u, p), place(x, v, p));
            out.extend([b[0] - a[0] - by[0], b[1] - a[1] - by[1]]);
        }
        if !self.slides() {
            out.push(50.0 * (x[3 * self.s.structure.roles.drive()[1]] - drive));
        }
        out
    }

    /// Closes all joints from a pose nearby.
    pub(super) fn solve(&self, x: &mut Pose, drive: f64, opened: Option<Opened>) {
        assert!(self.closes(x, drive, opened), "{}", self.s.name());
    }

    /// Whether all joints close from a pose nearby.
    pub(super) fn closes(&self, x: &mut Pose, drive: f64, opened: Option<Opened>) -> bool {
        for _ in 0..12 {
            let r = self.misses(x, drive, opened);
            if r.iter().all(|m| m.abs() < 1e-11) {
                return true;
            }
            let column = |c: usize| -> Vec<f64> {
                let [a, b] = [1e-6, -1e-6].map(|h| {
                    let mut y = x.clone();
                    y[c] += h;
                    self.misses(&y, drive, opened)
                });
                a.iter().zip(&b).map(|(a, b)| (a - b) / 2e-6).collect()
            };
            let columns: Vec<Vec<f64>> = (0..x.len()).map(column).collect();
            let dx = gauss(&columns, &r);
            x.iter_mut().zip(dx).for_each(|(a, d)| *a -= d);
        }
        let worst = self.misses(x, drive, opened);
        worst.iter().all(|m| m.abs() < 1e-8)
    }

    pub(super) fn tips(&self, x: &[f64]) -> Vec<[f64; 2]> {
        let tips = self.s.structure.roles.jaws.iter().zip(&self.l.tips);
        tips.map(|(&j, t)| place(x, j, t.real())).collect()
    }

    /// Away from the part, jaw by jaw.
    pub(super) fn outward(&self) -> Vec<[f64; 2]> {
        let tips: Vec<[f64; 2]> = self.l.tips.iter().map(|t| t.real()).collect();
        let count = tips.len() as f64;
        let middle = [0, 1].map(|k| tips.iter().map(|t| t[k]).sum::<f64>() / count);
        let unit = |t: &[f64; 2]| {
            let d = [t[0] - middle[0], t[1] - middle[1]];
            let size = d[0].hypot(d[1]);
            d.map(|x| x / size)
        };
        tips.iter().map(unit).collect()
    }

    /// What a newton of the part on each jaw does as the tips go from one pose to another.
    pub(super) fn work(&self, from: &[f64], to: &[f64]) -> f64 {
        let (a, b) = (self.tips(from), self.tips(to));
        let outward = self.outward();
        let each = a.iter().zip(&b).zip(&outward);
        each.map(|((a, b), o)| (b[0] - a[0]) * o[0] + (b[1] - a[1]) * o[1])
            .sum()
    }

    /// How far apart the tips are: of three twice their mean distance from the middle.
    pub(super) fn width(&self, x: &[f64]) -> f64 {
        let half = self.s.structure.roles.jaws.len() as f64 / 2.0;
        let drawn = 2.0 * self.l.tips[0].real()[1];
        drawn + self.work(&self.drawn(), x) / half
    }

    /// What presses in a joint, by what the jaws do when it is opened: two forces, or of a slide a force and a moment.
    pub(super) fn joint(&self, x: &Pose, drive: f64, pin: usize) -> [f64; 2] {
        let slide = self.slides() && self.is_input(pin);
        [0, 1].map(|k| {
            let h = if slide && k == 1 { 1e-6 } else { 1e-4 };
            let [ahead, back] = [h, -h].map(|h| {
                let mut by = [0.0; 2];
                by[k] = h;
                let mut y = x.clone();
                self.solve(&mut y, drive, Some(Opened { pin, by }));
                y
            });
            self.work(&back, &ahead) / (2.0 * h)
        })
    }
}
