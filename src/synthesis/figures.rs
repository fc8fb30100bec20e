//! What a laid-out gripper does over its stroke: how far it opens, with what force it closes, how the jaws move.

use crate::geom::exact::ExactError;
use crate::geom::vector::{dot, sub, unit as unit_vector};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::follow::{Follower, Why, slides};
use crate::motion::pose::Pose;
use crate::synthesis::layout::Layout;
use crate::synthesis::mechanism::link_names;
use crate::synthesis::skeleton::{Point, middle};
use crate::synthesis::structure::Structure;

/// Steps over the drawn opening.
const STEPS: f64 = 12.0;
/// Steps in either direction at most.
const MOST: usize = 30;
/// Openings followed to, as fractions of the drawn one.
const OPENINGS: [f64; 2] = [0.2, 1.8];
/// A jaw that turns by less than this over the stroke keeps its attitude: what is left is the error of closing. In rad.
const STILL: f64 = 1e-6;

/// How a jaw moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JawMotion {
    /// It keeps its attitude.
    Parallel,
    /// It turns about a hinge in the frame.
    Swinging,
    /// It turns, and no point of it stands still.
    Floating,
}

impl JawMotion {
    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            JawMotion::Parallel => "parallel",
            JawMotion::Swinging => "swinging",
            JawMotion::Floating => "floating",
        }
    }
}

/// Figures over the stroke, by following the mechanism numerically.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutFigures {
    /// The least and the greatest opening reached, in millimetres.
    pub openings: [f64; 2],
    /// Which way the drive goes as the jaws close: 1, or -1 where its coordinate falls.
    pub closes: f64,
    /// Travel of the drive between them: millimetres, or radians.
    pub travel: f64,
    /// Force of each jaw over the force of the drive, without friction: the least, the mean and the greatest of the steps.
    /// Where the drive turns, newtons for a newton metre.
    pub force: [f64; 3],
    /// How each jaw moves.
    pub jaws: Vec<JawMotion>,
    /// How far each jaw turns over the stroke, in rad.
    pub turns: Vec<f64>,
    /// Why the stroke ends before the jaws have closed, and before they have opened so far.
    pub ends: [Option<Why>; 2],
}

/// Figures of a laid-out gripper, `mechanism` being its [`mechanism_file`](crate::synthesis::mechanism::mechanism_file).
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// Some dozen poses, each of O(n³) for n links.
pub fn figures(
    structure: &Structure,
    layout: &Layout,
    mechanism: &Mechanism,
) -> Result<LayoutFigures, ExactError> {
    let pose = Pose::of_file(mechanism, StateId::FREE)?;
    let names = link_names(structure);
    let drive = |j: JointId| mechanism.joints[j].drive;
    let drive = (0..pose.columns.len()).find(|&c| drive(pose.columns[c].joint));
    let jaws = structure.roles.jaws.iter();
    let jaws: Option<Vec<LinkId>> = jaws.map(|&j| mechanism.link(&names[j])).collect();
    let (Some(drive), Some(jaws)) = (drive, jaws) else {
        unreachable!("the file of a layout has a drive and its jaws");
    };
    let unit = if slides(&pose, drive) {
        pose.length
    } else {
        1.0
    };
    let tips: Vec<Point> = layout.tips.iter().map(|t| t.real()).collect();
    let centre = middle(&tips);
    #[allow(clippy::cast_precision_loss, reason = "two or three")]
    let pairs = jaws.len() as f64 / 2.0;
    // Twice the tips' mean distance from where they close, which for two is their distance.
    let opening = |p: &Pose| {
        let out = jaws.iter().zip(&tips).map(|(&jaw, tip)| {
            let [u, v, w] = pose.middle;
            let place = [tip[0] - u, tip[1] - v, -w].map(|x| x / pose.length);
            let [x, y, _] = p.links[jaw].point(place).map(|x| x * pose.length);
            let outward = unit_vector(sub(*tip, centre));
            dot(sub([x + u, y + v], centre), outward)
        });
        out.sum::<f64>() / pairs
    };
    let turn = |p: &Pose, jaw: LinkId| {
        let m = &p.links[jaw];
        m.sine()[2].atan2(m.cosine()).abs()
    };
    let drawn = opening(&pose);
    // Towards closing first.
    let rate = layout.looks.closing;
    let ahead = drawn / STEPS / rate.max(1e-9) / unit;
    let sign = {
        let mut probe = Follower::new(pose.clone(), drive, &[]);
        let small = 0.01 * ahead;
        match probe.advance(small, |_| {}) {
            Ok(()) if opening(&probe.pose()) > drawn => -1.0,
            _ => 1.0,
        }
    };
    let mut way = vec![(0.0, drawn)];
    let mut turns = vec![0.0_f64; jaws.len()];
    let mut ends = [None; 2];
    for (n, until) in OPENINGS.into_iter().enumerate() {
        let direction = if n == 0 { sign } else { -sign };
        let mut follower = Follower::new(pose.clone(), drive, &[]);
        let mut last = drawn;
        for i in 1..=MOST {
            #[allow(clippy::cast_precision_loss, reason = "a few")]
            let to = direction * ahead * i as f64;
            if let Err(stop) = follower.advance(to, |_| {}) {
                ends[n] = Some(stop.why);
                break;
            }
            let here = follower.pose();
            let now = opening(&here);
            // The jaws turn back: what comes is another stroke.
            if (now < last) != (n == 0) {
                break;
            }
            last = now;
            way.push((to * unit, now));
            for (most, &jaw) in turns.iter_mut().zip(&jaws) {
                *most = most.max(turn(&here, jaw));
            }
            if (now <= until * drawn) == (n == 0) {
                break;
            }
        }
    }
    way.sort_by(|x, y| x.1.total_cmp(&y.1));
    // Newtons for a newton metre where the drive turns: lengths are in millimetres.
    let metre = if slides(&pose, drive) { 1.0 } else { 1000.0 };
    let ratios: Vec<f64> = way
        .windows(2)
        .map(|w| metre / pairs * (w[1].0 - w[0].0).abs() / (w[1].1 - w[0].1))
        .collect();
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let count = ratios.len().max(1) as f64;
    let (first, last) = (way[0], way[way.len() - 1]);
    let motion = |n: usize| match turns[n] {
        t if t < STILL => JawMotion::Parallel,
        _ if structure
            .chain
            .joined(structure.roles.frame, structure.roles.jaws[n]) =>
        {
            JawMotion::Swinging
        }
        _ => JawMotion::Floating,
    };
    Ok(LayoutFigures {
        openings: [first.1, last.1],
        closes: sign,
        travel: (last.0 - first.0).abs(),
        force: [
            ratios.iter().copied().fold(f64::INFINITY, f64::min),
            ratios.iter().sum::<f64>() / count,
            ratios.iter().copied().fold(0.0, f64::max),
        ],
        jaws: (0..jaws.len()).map(motion).collect(),
        turns,
        ends,
    })
}
