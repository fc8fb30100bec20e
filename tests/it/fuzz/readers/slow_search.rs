//! Every variant of a small mechanism looked at by itself, from the definitions and modulo a prime of its own: what a search
//! must agree with. It shares no code with the searches of the program, nor with their twin in rational numbers.

use crate::common::*;
use ozols::model::mechanism::{Frame, JointOption};

/// Not one of the program's.
const PRIME: u64 = (1 << 61) - 1;

fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

fn plus(a: u64, b: u64) -> u64 {
    (a + b) % PRIME
}

fn minus(a: u64) -> u64 {
    (PRIME - a) % PRIME
}

/// One over a number: its power by the prime less two.
fn inverse(a: u64) -> u64 {
    let (mut out, mut square, mut left) = (1, a, PRIME - 2);
    while left > 0 {
        if left & 1 == 1 {
            out = times(out, square);
        }
        square = times(square, square);
        left >>= 1;
    }
    out
}

/// The value of a rational expression.
fn value(e: &Expr) -> u64 {
    let r = e.as_rational().unwrap();
    let whole = |x: i64| x.rem_euclid(PRIME as i64) as u64;
    let above = whole(i64::try_from(r.numer()).unwrap());
    let below = whole(i64::try_from(r.denom()).unwrap());
    times(above, inverse(below))
}

type Vector = [u64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    let m = |i: usize, j: usize| plus(times(a[i], b[j]), minus(times(a[j], b[i])));
    [m(1, 2), m(2, 0), m(0, 1)]
}

fn dot(a: Vector, b: Vector) -> u64 {
    (0..3).fold(0, |sum, i| plus(sum, times(a[i], b[i])))
}

fn by(v: Vector, factor: u64) -> Vector {
    v.map(|x| times(x, factor))
}

/// Turning, then sliding.
type Twist = [u64; 6];

fn twist(turning: Vector, sliding: Vector) -> Twist {
    std::array::from_fn(|i| if i < 3 { turning[i] } else { sliding[i - 3] })
}

/// The twists of a joint: z its axis, x the reference made perpendicular to it, y across both; in a plane with this normal a basis of
/// those combinations that stay in it.
fn twists(frame: &Frame, kind: &JointType, normal: Option<Vector>) -> Vec<Twist> {
    let vector = |v: &[Expr; 3]| [value(&v[0]), value(&v[1]), value(&v[2])];
    let (p, z, r) = (
        vector(&frame.point),
        vector(&frame.axis),
        vector(&frame.reference),
    );
    let (long, along) = (by(r, dot(z, z)), by(z, dot(z, r)));
    let x: Vector = std::array::from_fn(|i| plus(long[i], minus(along[i])));
    let y = cross(z, x);
    let turn = |u| twist(u, cross(p, u));
    let slide = |u| twist([0; 3], u);
    let pitch = || by(z, value(&frame.pitch));
    let one = |f: &Freedom| match f {
        Freedom::Rx => turn(x),
        Freedom::Ry => turn(y),
        Freedom::Rz => turn(z),
        Freedom::Tx => slide(x),
        Freedom::Ty => slide(y),
        Freedom::Tz => slide(z),
        Freedom::Screw => {
            let (turned, slid) = (turn(z), slide(pitch()));
            std::array::from_fn(|i| plus(turned[i], slid[i]))
        }
    };
    let all = kind.freedoms().iter().map(one);
    match normal {
        None => all.collect(),
        Some(n) => {
            // What leads out of the plane stands first: rows that begin behind it stay in the plane.
            let mut rows = Echelon::default();
            for t in all {
                let [a, b, c, d, e, f] = t;
                let [x, y, z] = cross([a, b, c], n);
                rows.add([vec![x, y, z, dot([d, e, f], n)], t.to_vec()].concat());
            }
            let inside = rows.rows.iter().filter(|(at, _)| *at >= 4);
            inside
                .map(|(_, row)| std::array::from_fn(|i| row[4 + i]))
                .collect()
        }
    }
}

/// Independent rows, each 1 where it begins.
#[derive(Default, Clone)]
struct Echelon {
    rows: Vec<(usize, Vec<u64>)>,
}

impl Echelon {
    /// Adds a row where it is independent of those that are there.
    fn add(&mut self, mut row: Vec<u64>) {
        for (at, known) in &self.rows {
            let factor = minus(row[*at]);
            if factor != 0 {
                for (x, k) in row.iter_mut().zip(known) {
                    *x = plus(*x, times(factor, *k));
                }
            }
        }
        if let Some(at) = row.iter().position(|x| *x != 0) {
            let factor = inverse(row[at]);
            self.rows
                .push((at, row.into_iter().map(|x| times(x, factor)).collect()));
        }
    }
}

/// What stands between two links.
struct Between {
    links: [LinkId; 2],
    twists: Vec<Twist>,
}

/// A choice at a joint: an option, and what is put in series.
pub(crate) type Choice = (usize, Option<usize>);

/// What a variant is like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Figures {
    /// W.
    pub(crate) mobility: i64,
    /// σ.
    pub(crate) redundant: u32,
    /// f.
    pub(crate) freedoms: u32,
    /// Dimension of the motion of the outputs.
    pub(crate) motion: usize,
    /// Joints changed, and joints put in series.
    pub(crate) changes: u32,
}

/// What stands between the links of a variant, and how many links there are.
fn built(m: &Mechanism, choices: &[Choice], normal: Option<Vector>) -> (Vec<Between>, usize) {
    let span = |o: &JointOption| twists(&o.frame, &o.joint_type, normal);
    let (mut all, mut links) = (Vec::new(), m.links.len());
    for (joint, (option, unloading)) in m.joints.iter().zip(choices) {
        let mut ends = joint.links;
        if let Some(u) = unloading {
            let between = LinkId::new(links);
            links += 1;
            all.push(Between {
                links: [ends[0], between],
                twists: span(&joint.unloading[*u]),
            });
            ends[0] = between;
        }
        all.push(Between {
            links: ends,
            twists: span(&joint.options[*option]),
        });
    }
    (all, links)
}

/// Looks at a variant. Unknown are the twists of all links and the speeds in all joints: each joint demands that the twists of
/// its links differ by its speeds, and the frame rests. No contours, no tree.
pub(crate) fn look(m: &Mechanism, choices: &[Choice]) -> Figures {
    let (normal, rows) = match &m.mode {
        Mode::Spatial => (None, 6),
        Mode::Planar { normal } => (Some([0, 1, 2].map(|i| value(&normal[i]))), 3),
    };
    let (all, links) = built(m, choices, normal);
    let freedoms: usize = all.iter().map(|b| b.twists.len()).sum();
    let width = 6 * links + freedoms;
    let mut known = Echelon::default();
    let rest = |known: &mut Echelon, link: LinkId| {
        for c in 0..6 {
            let mut row = vec![0; width];
            row[6 * link.index() + c] = 1;
            known.add(row);
        }
    };
    rest(&mut known, m.frame());
    let mut at = 6 * links;
    for b in &all {
        for c in 0..6 {
            let mut row = vec![0; width];
            row[6 * b.links[1].index() + c] = 1;
            row[6 * b.links[0].index() + c] = minus(1);
            for (i, t) in b.twists.iter().enumerate() {
                row[at + i] = minus(t[c]);
            }
            known.add(row);
        }
        at += b.twists.len();
    }
    let mobility = width - known.rows.len();
    let joined: BTreeSet<LinkId> = all.iter().flat_map(|b| b.links).collect();
    let contours = all.len() + 1 - joined.len();
    let watched = |l: &LinkId| m.links[*l].role == Role::Output || m.search.hold.contains(l);
    for link in m.link_ids().filter(watched) {
        rest(&mut known, link);
    }
    let one = |c: &Choice| u32::from(c.0 != 0) + u32::from(c.1.is_some());
    Figures {
        mobility: mobility as i64,
        redundant: (mobility + rows * contours - freedoms) as u32,
        freedoms: freedoms as u32,
        motion: mobility - (width - known.rows.len()),
        changes: choices.iter().map(one).sum(),
    }
}

/// How many variants there are.
pub(crate) fn size(m: &Mechanism) -> usize {
    let of = |j: JointId| m.joints[j].options.len() * (1 + m.joints[j].unloading.len());
    m.joint_ids().map(of).product()
}

/// All variants, the present one first.
pub(crate) fn variants(m: &Mechanism) -> Vec<Vec<Choice>> {
    let mut out = vec![Vec::new()];
    for joint in m.joints.iter() {
        let series = std::iter::once(None).chain((0..joint.unloading.len()).map(Some));
        let choices: Vec<Choice> = series
            .flat_map(|u| (0..joint.options.len()).map(move |o| (o, u)))
            .collect();
        let longer = |v: &Vec<Choice>| -> Vec<Vec<Choice>> {
            let one = |&c: &Choice| [v.clone(), vec![c]].concat();
            choices.iter().map(one).collect()
        };
        out = out.iter().flat_map(longer).collect();
    }
    out
}
