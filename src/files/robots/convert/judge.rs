//! Which closure of a loop holds nothing twice and lets nothing else move, by W, σ and the motion of all other joints in the pose
//! that is written.

use crate::closure::matrix::Closure as Contours;
use crate::file::problem::ImportError;
use crate::geom::rigid::{RigidMotion, perpendicular};
use crate::geom::scalars::Reals;
use crate::geom::vector::Vector;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::numeric::scaling::{Scaling, scaled};
use crate::rank::rounded::verdict::verdict;
use crate::robots::convert::closure::{LoopClosure, applied, directions};
use crate::robots::convert::plan::TreePlan;
use crate::robots::description::parts::Robot;
use crate::robots::import::{Imported, mechanism};
use crate::robots::mechanism::loop_closing::size;
use crate::robots::problem::{RobotProblem, known};
use ozols_dense::svd;
use std::collections::BTreeSet;

/// What is asked of the closures.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Of all; the best for each where this says so.
    pub all: Option<Option<LoopClosure>>,
    /// Of single ones by name, before all.
    pub each: Vec<(String, Option<LoopClosure>)>,
}

/// What a closure makes of the robot, the other loops closed as they are then.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The closure.
    pub closure: LoopClosure,
    /// Its axis in the world, where it has one.
    pub axis: Option<Vector>,
    /// W and σ.
    pub figures: (usize, usize),
    /// Whether the other joints move as they do with the file's own closures: exactly so, less, or otherwise.
    pub motion: Motions,
}

/// How the motion of the other joints compares with that of the file as given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motions {
    /// The same.
    Same,
    /// Part of it.
    Less,
    /// Other motions, too.
    Other,
}

impl Motions {
    /// A word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Motions::Same => "same",
            Motions::Less => "less",
            Motions::Other => "more",
        }
    }
}

/// What was found for a loop.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedLoop {
    /// The closure's name.
    pub joint: String,
    /// What was tried, each kind about its best axis.
    pub options: Vec<Judgement>,
    /// The one taken.
    pub chosen: usize,
}

/// The robot with its closures as asked.
pub(super) struct JudgedRobot {
    pub(super) robot: Robot,
    pub(super) closures: Vec<JudgedLoop>,
    pub(super) figures: Option<(usize, usize)>,
}

/// How far W, σ and the motion are known.
struct KnownMotion {
    figures: (usize, usize),
    decided: bool,
    /// Speeds of the freedoms that are no closure's, by name, for each motion: orthonormal.
    motions: Vec<Vec<f64>>,
}

/// Largest part of a motion that counts as none, and how far motions may be apart that are one but for the digits of the file.
const NOTHING: f64 = 1e-3;
const ALIKE: f64 = 0.03;

/// Judges the closures, and takes those asked for.
pub(super) fn judge(imported: &Imported, wanted: &Wanted) -> Result<JudgedRobot, ImportError> {
    let origin = &imported.origin;
    let mut robot = origin.robot.clone();
    let plan = TreePlan::new(&robot, origin.frame);
    let names: Vec<String> = plan
        .loops
        .iter()
        .map(|&j| robot.joints[j].id.clone())
        .collect();
    every_name_is_known(wanted, &names)?;
    let asked = |name: &String| {
        let own = wanted.each.iter().find(|(n, _)| n == name);
        own.map(|(_, c)| *c).or(wanted.all)
    };
    let mut closures = Vec::new();
    let judged = plan
        .loops
        .iter()
        .any(|&j| asked(&robot.joints[j].id).is_some());
    if !judged {
        let figures = figures(&imported.mechanism);
        return Ok(JudgedRobot {
            robot,
            closures,
            figures,
        });
    }
    let closing: BTreeSet<String> = names.into_iter().collect();
    let given = seen(&robot, imported, &closing)?;
    let mut figures = given.decided.then_some(given.figures);
    for &j in &plan.loops {
        let Some(choice) = asked(&robot.joints[j].id) else {
            continue;
        };
        let options = options(&robot, imported, j, &closing, &given)?;
        let chosen = taken(choice, &options, given.figures.0);
        figures = options[chosen].2.then_some(options[chosen].0.figures);
        let joint = robot.joints[j].id.clone();
        robot = options[chosen].1.clone();
        let options = options.into_iter().map(|o| o.0).collect();
        closures.push(JudgedLoop {
            joint,
            options,
            chosen,
        });
    }
    Ok(JudgedRobot {
        robot,
        closures,
        figures,
    })
}

fn every_name_is_known(wanted: &Wanted, names: &[String]) -> Result<(), ImportError> {
    let unknown = wanted.each.iter().find(|(n, _)| !names.contains(n));
    let Some((name, _)) = unknown else {
        return Ok(());
    };
    let problem = RobotProblem::UnknownName {
        element: "the command line".to_owned(),
        what: "loop closure",
        name: name.clone(),
        known: known("loop closures", names.iter().map(String::as_str)),
    };
    Err(problem.at("--closure", "", None))
}

/// The option that is asked for; where the best is, one that keeps the motion and W, then the one with least σ.
fn taken(
    choice: Option<LoopClosure>,
    options: &[(Judgement, Robot, bool)],
    mobility: usize,
) -> usize {
    let place = match choice {
        Some(closure) => options.iter().position(|o| o.0.closure == closure),
        None => (0..options.len()).min_by_key(|&i| {
            let o = &options[i].0;
            let other = o.motion != Motions::Same || o.figures.0 != mobility;
            (other, o.figures.1, i)
        }),
    };
    place.unwrap_or(0)
}

/// W and σ of a mechanism, where its digits decide them.
#[must_use]
pub fn figures(m: &Mechanism) -> Option<(usize, usize)> {
    let found = verdict(m, StateId::FREE, None).ok()?;
    found.is_decided().then(|| found.figures(found.rank()))
}

/// Each kind of closure of a loop, that of joint `j`, about its best axis, with the robot that has it, and whether its figures are decided.
fn options(
    robot: &Robot,
    imported: &Imported,
    j: usize,
    closing: &BTreeSet<String>,
    given: &KnownMotion,
) -> Result<Vec<(Judgement, Robot, bool)>, ImportError> {
    let places: &[RigidMotion] = &imported.origin.places;
    let all = directions(robot, places, j);
    let far = size(robot) * 0.1;
    let mut out = Vec::new();
    for (_, closure) in LoopClosure::ALL {
        let mut tried: Vec<(Judgement, Robot, bool)> = Vec::new();
        for axes in axes(closure, &all) {
            let with = applied(robot, places, j, closure, axes, far);
            let found = seen(&with, imported, closing)?;
            let judgement = Judgement {
                closure,
                axis: closure.is_directed().then_some(axes[0]),
                figures: found.figures,
                motion: compared(&found.motions, &given.motions),
            };
            tried.push((judgement, with, found.decided));
        }
        let key = |t: &(Judgement, Robot, bool)| {
            (
                t.0.motion != Motions::Same,
                t.0.figures.1,
                t.0.figures.0.abs_diff(given.figures.0),
            )
        };
        let best = (0..tried.len()).min_by_key(|&i| key(&tried[i]));
        out.extend(best.map(|i| tried.swap_remove(i)));
    }
    Ok(out)
}

/// The axes to try: pairs for what has two.
fn axes(closure: LoopClosure, all: &[Vector]) -> Vec<[Vector; 2]> {
    let first = all[0];
    match closure {
        LoopClosure::Universal => {
            let pairs = all
                .iter()
                .flat_map(|a| all.iter().filter(move |b| *b != a).map(|b| [*a, *b]));
            let pairs: Vec<[Vector; 2]> = pairs.collect();
            if pairs.is_empty() {
                vec![[first, perpendicular(first)]]
            } else {
                pairs
            }
        }
        c if c.is_directed() => all.iter().map(|d| [*d, perpendicular(*d)]).collect(),
        _ => vec![[first, perpendicular(first)]],
    }
}

fn seen(
    robot: &Robot,
    imported: &Imported,
    closing: &BTreeSet<String>,
) -> Result<KnownMotion, ImportError> {
    let m = mechanism(
        robot.clone(),
        imported.origin.frame,
        imported.file.tolerance.clone(),
    )?;
    let problem = |message: String| RobotProblem::Whole { message }.at("--closure", "", None);
    let found = verdict(&m, StateId::FREE, None).map_err(|e| problem(e.to_string()))?;
    let rank = found.rank();
    let geometry = found.mechanism().unwrap_or(&m);
    let closure =
        Contours::new(&Reals, geometry, StateId::FREE).map_err(|e| problem(e.to_string()))?;
    Ok(KnownMotion {
        figures: found.figures(rank),
        decided: found.is_decided(),
        motions: motions(geometry, &closure, rank, closing),
    })
}

/// Speeds of the freedoms that close no loop, in each motion.
fn motions(
    m: &Mechanism,
    closure: &Contours<f64>,
    rank: usize,
    closing: &BTreeSet<String>,
) -> Vec<Vec<f64>> {
    let sizes = Scaling::of(closure);
    let Some(found) = svd(&scaled(closure)) else {
        return Vec::new();
    };
    let kernel = found.null_space(rank);
    let closes = |id: &String| {
        closing.iter().any(|c| {
            id == c
                || id
                    .strip_prefix(c.as_str())
                    .is_some_and(|r| r.starts_with('~'))
        })
    };
    let own =
        (0..closure.columns.len()).filter(|&c| !closes(&m.joints[closure.columns[c].joint].id));
    let own: Vec<usize> = own.collect();
    let speeds = (0..kernel.ncols()).map(|k| {
        own.iter()
            .map(|&c| kernel[(c, k)] / sizes.sizes()[c])
            .collect::<Vec<f64>>()
    });
    let mut span: Vec<Vec<f64>> = Vec::new();
    for v in speeds {
        let whole = norm(&v);
        let r = rest(&rest(&v, &span), &span);
        if norm(&r) > NOTHING * whole.max(NOTHING) {
            let n = norm(&r);
            span.push(r.iter().map(|x| x / n).collect());
        }
    }
    span
}

/// One span of motions beside another.
fn compared(found: &[Vec<f64>], given: &[Vec<f64>]) -> Motions {
    let within = found.iter().all(|v| norm(&rest(v, given)) < ALIKE);
    match within {
        true if found.len() == given.len() => Motions::Same,
        true => Motions::Less,
        false => Motions::Other,
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// What orthonormal vectors leave of another.
fn rest(v: &[f64], span: &[Vec<f64>]) -> Vec<f64> {
    let mut out = v.to_vec();
    for s in span.iter().filter(|s| s.len() == v.len()) {
        let along: f64 = out.iter().zip(s).map(|(a, b)| a * b).sum();
        out.iter_mut().zip(s).for_each(|(a, b)| *a -= along * b);
    }
    out
}
