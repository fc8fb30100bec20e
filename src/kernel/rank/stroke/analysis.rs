//! Rank, mobility, redundancy and conditioning over a stroke of a drive, and where they change.
//!
//! Ranks are by singular values of J in lengths of the mechanism's size, at poses closed by Newton's method. A change
//! between two poses is bracketed by bisection. A rank that falls in a single pose only, between two poses asked for,
//! shows as a smallest kept singular value that falls and rises again; its lowest point is found by golden section and
//! counts where the value vanishes there.

use crate::closure::tree::path_from_frame;
use crate::model::mechanism::{LinkId, Mechanism, Mode, Role, StateId};
use crate::motion::follow::{Follower, Stop, Why, positions};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::numeric::scaling::{NumericRank, rank_of_values};
use ozols_dense::{Matrix, singular_values};

/// Changes of rank are bracketed to this fraction of the stroke, or to the stretch where singular values are below the
/// tolerance where that is longer.
pub(crate) const BRACKET: f64 = 1e-6;
/// The lowest point of a singular value is found to this fraction of the stroke.
const LOWEST: f64 = 1e-9;
/// Golden section.
const GOLDEN: f64 = 0.381_966_011_250_105;

/// Where an output link is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output {
    /// The link.
    pub link: LinkId,
    /// Where the middle of its joints has gone to, in the file's length unit.
    pub point: [f64; 3],
    /// The angle of its turn since the pose of the file `[rad]`, 0 to π.
    pub turn: f64,
}

/// The figures of one pose.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFigures {
    /// Position of the drive: radians, or the file's length unit, from the pose of the file.
    pub at: f64,
    /// Rank of J, with the gap in the singular values; [`NumericRank::kept`] is the conditioning.
    pub rank: NumericRank,
    /// W = f - rank.
    pub mobility: usize,
    /// σ = rows - rank.
    pub redundant: usize,
    /// Share of the drive's speed in the motion of unit length; 0 at a dead point of the drive.
    pub share: f64,
    /// What the contours are open by: radians, and fractions of the mechanism's size.
    pub gap: f64,
    /// The output links.
    pub outputs: Vec<Output>,
}

/// A change of the rank along the stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankChange {
    /// Positions of the drive on either side, in the order of the stroke: radians or the file's length unit.
    pub between: [f64; 2],
    /// Rank before, between and after. Before and after are the same where it falls in one pose only.
    pub ranks: [usize; 3],
}

/// A stroke with its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeFigures {
    /// The poses reached of those asked for, in order.
    pub poses: Vec<PoseFigures>,
    /// Changes of rank between the first of them and the end.
    pub changes: Vec<RankChange>,
    /// The end of the way before the last pose asked for, the position in radians or the file's length unit.
    pub stop: Option<Stop>,
    /// Output motions that no drive decides: with them the way taken is one of many, the shortest.
    pub undriven: usize,
}

/// The input of a stroke analysis.
#[derive(Debug, Clone)]
pub struct StrokeRequest<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The state.
    pub state: StateId,
    /// The column of the drive in [`Pose::columns`].
    pub drive: usize,
    /// Columns of the other drives.
    pub held: &'a [usize],
    /// From and to, radians or the file's length unit.
    pub range: [f64; 2],
    /// Equal steps.
    pub steps: usize,
    /// Singular values below this fraction of the largest count as zero; [`FLAT`] where none is given.
    pub tolerance: Option<f64>,
}

fn values(matrix: &Matrix) -> Vec<f64> {
    singular_values(matrix).unwrap_or_default()
}

struct Looker<'a> {
    request: &'a StrokeRequest<'a>,
    tolerance: f64,
    /// Rows of a contour: 6 or 3.
    dim: usize,
    /// File's unit of the drive's coordinate.
    unit: f64,
    /// Output links with the middle of their joints, in the pose's coordinates.
    outputs: Vec<(LinkId, [f64; 3])>,
}

/// Singular values in a pose on the way.
#[derive(Debug, Clone)]
struct PoseValues {
    follower: Follower,
    at: f64,
    rank: NumericRank,
    /// Relative singular values, falling.
    values: Vec<f64>,
}

impl<'a> Looker<'a> {
    fn new(request: &'a StrokeRequest<'a>, pose: &Pose) -> Looker<'a> {
        let m = request.mechanism;
        let slides = pose.columns[request.drive].freedom.slides();
        let middle = |l: LinkId| {
            let of = m
                .joints_in(request.state)
                .filter(|&j| m.joints[j].links.contains(&l));
            let points: Vec<[f64; 3]> = of
                .map(|j| m.joints[j].frame.point.each_ref().map(|c| c.to_f64()))
                .collect();
            #[allow(clippy::cast_precision_loss, reason = "joints of a link")]
            let n = points.len().max(1) as f64;
            [0, 1, 2].map(|i| {
                (points.iter().map(|p| p[i]).sum::<f64>() / n - pose.middle[i]) / pose.length
            })
        };
        let present = |l: &LinkId| {
            m.joints_in(request.state)
                .any(|j| m.joints[j].links.contains(l))
        };
        Looker {
            request,
            tolerance: request.tolerance.unwrap_or(FLAT),
            dim: match m.mode {
                Mode::Spatial => 6,
                Mode::Planar { .. } => 3,
            },
            unit: if slides { pose.length } else { 1.0 },
            outputs: m
                .link_ids()
                .filter(|&l| m.links[l].role == Role::Output)
                .filter(present)
                .map(|l| (l, middle(l)))
                .collect(),
        }
    }

    fn sample(&self, follower: &Follower) -> PoseValues {
        let pose = follower.pose();
        let mut all = values(&pose.jacobian(&vec![0.0; pose.columns.len()]));
        let rank = rank_of_values(all.clone(), self.tolerance);
        let largest = all.first().copied().unwrap_or(1.0).max(f64::MIN_POSITIVE);
        all.iter_mut().for_each(|v| *v /= largest);
        PoseValues {
            follower: follower.clone(),
            at: follower.at(),
            rank,
            values: all,
        }
    }

    fn figures(&self, sample: &PoseValues) -> PoseFigures {
        let pose = sample.follower.pose();
        let rank = sample.rank;
        let outputs = self.outputs.iter().map(|&(link, p)| {
            let d = &pose.links[link];
            let to = d.point(p);
            Output {
                link,
                point: [0, 1, 2].map(|i| pose.middle[i] + pose.length * to[i]),
                turn: d.angle(),
            }
        });
        PoseFigures {
            at: sample.at * self.unit,
            rank,
            mobility: pose.columns.len() - rank.rank,
            redundant: pose.constraints(self.dim).saturating_sub(rank.rank),
            share: sample.follower.share(),
            gap: sample.follower.gap(),
            outputs: outputs.collect(),
        }
    }

    /// The sample at a position, reached from one near it.
    fn from(&self, near: &PoseValues, at: f64) -> Option<PoseValues> {
        let mut follower = near.follower.clone();
        follower.advance(at, |_| {}).ok()?;
        Some(self.sample(&follower))
    }

    /// Brackets the change between two poses of different ranks.
    fn bisect(&self, low: &PoseValues, high: &PoseValues, width: f64, out: &mut Vec<RankChange>) {
        let (mut low, mut high) = (low.clone(), high.clone());
        // Two such brackets and the flat stretch between them make one change in one pose.
        while (high.at - low.at).abs() > width / 8.0 {
            let Some(middle) = self.from(&low, f64::midpoint(low.at, high.at)) else {
                break;
            };
            if middle.rank.rank == low.rank.rank {
                low = middle;
            } else {
                high = middle;
            }
        }
        out.push(RankChange {
            between: [low.at, high.at],
            ranks: [low.rank.rank, high.rank.rank, high.rank.rank],
        });
    }

    /// The lowest kept singular value between two poses of one rank round a third, where it vanishes.
    fn lowest(&self, around: [&PoseValues; 3], width: f64, out: &mut Vec<RankChange>) {
        let rank = around[1].rank.rank;
        let Some(last) = rank.checked_sub(1) else {
            return;
        };
        let value = |s: &PoseValues| s.values.get(last).copied().unwrap_or(0.0);
        let [mut low, mut middle, mut high] = around.map(Clone::clone);
        while (high.at - low.at).abs() > width * LOWEST / BRACKET {
            let up = (high.at - middle.at).abs() > (middle.at - low.at).abs();
            let far = if up { &high } else { &low };
            let Some(next) = self.from(&middle, middle.at + GOLDEN * (far.at - middle.at)) else {
                return;
            };
            match (value(&next) < value(&middle), up) {
                (true, true) => low = std::mem::replace(&mut middle, next),
                (true, false) => high = std::mem::replace(&mut middle, next),
                (false, true) => high = next,
                (false, false) => low = next,
            }
            if middle.rank.rank != rank {
                break;
            }
        }
        if middle.rank.rank < rank {
            let half = width / 2.0 * (around[2].at - around[0].at).signum();
            out.push(RankChange {
                between: [middle.at - half, middle.at + half],
                ranks: [rank, middle.rank.rank, rank],
            });
        }
    }

    /// Changes along the way.
    fn changes(&self, way: &[PoseValues]) -> Vec<RankChange> {
        let [from, to] = self.request.range;
        let width = BRACKET * ((to - from) / self.unit).abs();
        let last = |s: &PoseValues, rank: usize| {
            rank.checked_sub(1).and_then(|i| s.values.get(i).copied())
        };
        let mut found = Vec::new();
        for (i, pair) in way.windows(2).enumerate() {
            if pair[0].rank.rank != pair[1].rank.rank {
                self.bisect(&pair[0], &pair[1], width, &mut found);
            } else if let Some(next) = way.get(i + 2)
                && next.rank.rank == pair[0].rank.rank
            {
                let [a, b, c] = [&pair[0], &pair[1], next].map(|s| last(s, next.rank.rank));
                if b < a && b <= c {
                    self.lowest([&pair[0], &pair[1], next], width, &mut found);
                }
            }
        }
        // A singular value that vanishes before the second pose, or after the last but one, has no pose on its other side.
        let ends = [way.windows(2).next(), way.windows(2).next_back()];
        for pair in ends.into_iter().flatten() {
            let (from, to) = (&pair[0], &pair[1]);
            let (low, high) = (from.at.min(to.at) - width, from.at.max(to.at) + width);
            let known = |c: &RankChange| c.between.iter().any(|x| (low..=high).contains(x));
            if found.iter().any(known) {
                continue;
            }
            let Some(middle) = self.from(from, f64::midpoint(from.at, to.at)) else {
                continue;
            };
            let alike = |s: &PoseValues| s.rank.rank == from.rank.rank;
            if alike(&middle) && alike(to) {
                self.lowest([from, &middle, to], width, &mut found);
            }
        }
        let along = (to - from).signum();
        found.sort_by(|a, b| (a.between[0] * along).total_cmp(&(b.between[0] * along)));
        let mut merged: Vec<RankChange> = Vec::new();
        for c in found {
            match merged.last_mut() {
                // Down and up again is one change in one pose.
                Some(l)
                    if l.ranks[2] == c.ranks[0]
                        && l.ranks[0] == c.ranks[2]
                        && l.ranks[0] != l.ranks[2]
                        && (c.between[1] - l.between[0]).abs() < 100.0 * width =>
                {
                    l.between[1] = c.between[1];
                    l.ranks[2] = c.ranks[2];
                }
                _ => merged.push(c),
            }
        }
        for c in &mut merged {
            c.between = c.between.map(|x| x * self.unit);
        }
        merged
    }

    /// Output motions with all drives held.
    fn undriven(&self, pose: &Pose) -> usize {
        let m = self.request.mechanism;
        let paths: Vec<_> = self
            .outputs
            .iter()
            .map(|(l, _)| path_from_frame(m, self.request.state, *l))
            .collect();
        let f = pose.columns.len();
        let free: Vec<usize> = (0..f)
            .filter(|c| *c != self.request.drive && !self.request.held.contains(c))
            .collect();
        let whole = pose.jacobian_with(&paths, &[]);
        let part = |rows: usize| Matrix::from_fn(rows, free.len(), |r, c| whole[(r, free[c])]);
        let rank = |rows| rank_of_values(values(&part(rows)), self.tolerance).rank;
        rank(whole.nrows()) - rank(pose.rows())
    }
}

/// Follows a drive over a stroke and looks at every pose. `pose` is the file's, closed or nearly so.
///
/// # Complexity
/// Some ten closings and singular values of O((6k + f)³) a radian and step, and some thirty a change.
#[must_use]
pub fn stroke(request: &StrokeRequest<'_>, pose: &Pose) -> StrokeFigures {
    let looker = Looker::new(request, pose);
    let mut follower = Follower::new(pose.clone(), request.drive, request.held);
    let range = request.range.map(|x| x / looker.unit);
    let (mut poses, mut way, mut stop) = (Vec::new(), Vec::new(), None);
    for (i, to) in positions(range, request.steps).enumerate() {
        let arrived = follower.advance(to, |f| {
            if i > 0 {
                way.push(looker.sample(f));
            }
        });
        if i == 0 && arrived.is_ok() {
            way.push(looker.sample(&follower));
        }
        if let Err(s) = arrived {
            stop = Some(Stop {
                at: s.at * looker.unit,
                ..s
            });
            break;
        }
        // A position asked for is a pose on the way, the last one.
        let last = way.last().filter(|s| s.at == follower.at());
        poses.push(match last {
            Some(s) => looker.figures(s),
            None => looker.figures(&looker.sample(&follower)),
        });
    }
    StrokeFigures {
        changes: looker.changes(&way),
        poses,
        stop,
        // Where branches cross there are motions enough, and the drive decides none.
        undriven: match stop.map(|s| s.why) {
            Some(Why::Singular | Why::Instantaneous) => 0,
            _ => looker.undriven(pose),
        },
    }
}
