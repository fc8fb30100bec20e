//! The largest load in a direction that faces resist: a cone program, and bounds proven by its solution independent of
//! the solver's status.
//!
//! The forces found are moved into their cones, and the residual of the balance is measured. They are a lower bound of
//! the load. The multipliers are a motion of part and jaws that does no work on unlimited forces. The largest work of a
//! normal force of 1 on it, over the work of the load, is an upper bound.

use crate::geom::vector::{add, cross, length, scale};
use crate::grip::clamped_part::{ClampedPart, LooseMotion};
use crate::grip::faces::{JawFace, Press};
use crate::statics::cone_programme::{ConeProgramme, SolverEffort};
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::{Six, TOLERANCE, power, wrench};
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};

/// Work below this is rounding.
const ROUNDING: f64 = 1e-12;

/// A load that is just resisted, with lower and upper bound.
#[derive(Debug, Clone)]
pub(super) struct Resisted {
    /// Lower bound, except for `left`; the cap if it is reached.
    pub(super) least: f64,
    /// Upper bound.
    pub(super) most: f64,
    /// Residual of the balance for the forces found.
    pub(super) left: f64,
    /// Normal of the set of resisted loads at its boundary in this direction, (moment over the part's size; force)
    /// about its middle.
    pub(super) normal: Six,
}

impl Resisted {
    /// Returns true if both bounds agree to a relative difference of `tie`.
    pub(super) fn agrees(&self, tie: f64) -> bool {
        self.most - self.least <= tie * self.most && self.left <= tie * self.most
    }
}

/// A pressing point, with its columns.
struct Point {
    normal: usize,
    /// Coefficient of friction, whose two columns come after the normal.
    friction: Option<f64>,
}

/// The forces that faces can exert on a part, by the work of each on the motions.
pub(super) struct Forces<'a> {
    part: &'a ClampedPart,
    points: Vec<Point>,
    /// Work on each motion.
    columns: Vec<Vec<f64>>,
    /// Orthonormal vectors that span the work of unlimited columns.
    unlimited: Vec<Vec<f64>>,
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Returns `a` without its parts along orthonormal vectors.
fn across(a: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut out = a.to_vec();
    for q in basis {
        let along = inner(&out, q);
        for (x, y) in out.iter_mut().zip(q) {
            *x -= along * y;
        }
    }
    out
}

impl<'a> Forces<'a> {
    /// Creates the forces of faces on a part.
    pub(super) fn new(part: &'a ClampedPart, faces: &[JawFace]) -> Forces<'a> {
        let mut out = Forces {
            part,
            points: Vec::new(),
            columns: Vec::new(),
            unlimited: Vec::new(),
        };
        for (i, face) in faces.iter().enumerate() {
            let work = |w: &Six| -> Vec<f64> {
                let of = |m: &LooseMotion| power(w, &m.against[i]);
                part.motions.iter().map(of).collect()
            };
            let (presses, free) = face.presses(&part.geometry);
            for Press { normal, along } in presses {
                out.points.push(Point {
                    normal: out.columns.len(),
                    friction: face.friction.filter(|f| *f > 0.0),
                });
                out.columns.push(work(&normal));
                match face.friction {
                    Some(0.0) => {}
                    Some(_) => out.columns.extend(along.iter().map(work)),
                    None => along.iter().for_each(|a| out.without_limit(work(a))),
                }
            }
            free.iter().for_each(|w| out.without_limit(work(w)));
        }
        out
    }

    fn without_limit(&mut self, work: Vec<f64>) {
        let rest = across(&across(&work, &self.unlimited), &self.unlimited);
        let size = inner(&rest, &rest).sqrt();
        if size > (TOLERANCE * inner(&work, &work).sqrt()).max(ROUNDING) {
            let unit = rest.iter().map(|x| x / size).collect();
            self.unlimited.push(unit);
        }
        self.columns.push(work);
    }

    /// Returns the largest load along `d` up to `cap`, with normal forces of 1 in total.
    ///
    /// # Errors
    /// Returns an error if the solver rejects the program.
    pub(super) fn resist(
        &self,
        d: &Six,
        cap: f64,
        effort: SolverEffort,
    ) -> Result<Resisted, Unsolved> {
        let part = self.part;
        let load = about_middle(part, d);
        let load: Vec<f64> = (part.motions.iter())
            .map(|m| power(&load, &m.part))
            .collect();
        let (programme, worked) = self.programme(&load, cap);
        let mut aim = vec![0.0; self.columns.len() + 1];
        aim[0] = -1.0;
        let found = programme
            .solve_with(&[], &aim, effort)
            .map_err(Unsolved::Programme)?;
        let (least, left) = self.below(&found.x, &load);
        let mut y = vec![0.0; load.len()];
        for (i, z) in worked.iter().zip(&found.z) {
            y[*i] = *z;
        }
        let size = inner(&y, &y).sqrt() * inner(&load, &load).sqrt();
        let y = across(&y, &self.unlimited);
        // For a load that is resisted without limit, only rounding is left.
        let most = match inner(&y, &load) {
            work if work.abs() > TOLERANCE * size => self.above(&y, work).min(cap),
            _ => cap,
        };
        let normal = self.normal(&y);
        let sign = inner(&normal, d).signum();
        Ok(Resisted {
            least,
            most,
            left,
            normal: scale(normal, sign),
        })
    }

    /// Returns the program of the largest load, and the motions whose balance it contains.
    fn programme(&self, load: &[f64], cap: f64) -> (ConeProgramme, Vec<usize>) {
        let mut programme = ConeProgramme::default();
        // A motion on which neither load nor contacts do work gives no information, and rounding must not.
        let mut worked = Vec::new();
        for (i, own) in load.iter().enumerate() {
            let others = self.columns.iter().enumerate();
            let all = std::iter::once((0, *own)).chain(others.map(|(k, c)| (k + 1, c[i])));
            let row: Vec<(usize, f64)> = all.filter(|(_, x)| x.abs() > ROUNDING).collect();
            if !row.is_empty() {
                programme.row(row, 0.0);
                worked.push(i);
            }
        }
        programme.within(ZeroConeT);
        programme.row([(0, 1.0)], cap);
        programme.row(self.points.iter().map(|p| (p.normal + 1, 1.0)), 1.0);
        for p in &self.points {
            programme.row([(p.normal + 1, -1.0)], 0.0);
        }
        programme.within(NonnegativeConeT);
        for p in &self.points {
            let Some(friction) = p.friction else { continue };
            programme.row([(p.normal + 1, -friction)], 0.0);
            programme.row([(p.normal + 2, -1.0)], 0.0);
            programme.row([(p.normal + 3, -1.0)], 0.0);
            programme.within(SecondOrderConeT);
        }
        (programme, worked)
    }

    /// Returns the part's motion formed by multipliers of the motions, (turn times the size; shift of the middle). It
    /// maximises the work of the load relative to the work of the contacts.
    fn normal(&self, multipliers: &[f64]) -> Six {
        let part = self.part;
        let mut twist = [0.0; 6];
        for (y, motion) in multipliers.iter().zip(&part.motions) {
            twist = add(twist, scale(motion.part, *y));
        }
        let turn = [twist[0], twist[1], twist[2]];
        let shift = add([twist[3], twist[4], twist[5]], cross(turn, part.middle));
        let turn = scale(turn, part.size);
        [turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]]
    }

    /// Returns the load of the forces found, moved into their cones, and the residual of the balance.
    fn below(&self, x: &[f64], load: &[f64]) -> (f64, f64) {
        if x.iter().any(|x| !x.is_finite()) {
            return (0.0, f64::INFINITY);
        }
        let mut x = x.to_vec();
        for p in &self.points {
            let n = p.normal + 1;
            x[n] = x[n].max(0.0);
            if let Some(friction) = p.friction {
                let along = length([x[n + 1], x[n + 2], 0.0]);
                let within = (friction * x[n] / along).min(1.0);
                let within = if along > 0.0 { within } else { 0.0 };
                x[n + 1] *= within;
                x[n + 2] *= within;
            }
        }
        let sum: f64 = self.points.iter().map(|p| x[p.normal + 1]).sum();
        let over = sum.max(1.0);
        let x: Vec<f64> = x.iter().map(|x| x / over).collect();
        let left = (0..load.len()).map(|i| {
            let columns = self.columns.iter().zip(&x[1..]);
            x[0] * load[i] + columns.map(|(c, x)| c[i] * x).sum::<f64>()
        });
        let left: Vec<f64> = left.collect();
        (x[0].max(0.0), inner(&left, &left).sqrt())
    }

    /// Returns the upper bound by a motion on which the load has the given `power`.
    fn above(&self, y: &[f64], power: f64) -> f64 {
        let y: Vec<f64> = y.iter().map(|y| y * power.signum()).collect();
        let work = |k: usize| inner(&self.columns[k], &y);
        let most = self.points.iter().map(|p| {
            let along = p.friction.map_or(0.0, |f| {
                f * length([work(p.normal + 1), work(p.normal + 2), 0.0])
            });
            along - work(p.normal)
        });
        let most = most.fold(0.0, f64::max) / power.abs();
        if most.is_nan() { f64::INFINITY } else { most }
    }
}

/// Converts a load about the part's middle, with moments over its size, to a wrench of the geometry.
fn about_middle(part: &ClampedPart, d: &Six) -> Six {
    let moment = scale([d[0], d[1], d[2]], part.size);
    wrench(part.middle, [d[3], d[4], d[5]], moment)
}
