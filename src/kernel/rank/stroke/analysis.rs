//! Rank, mobility, redundancy and conditioning over a stroke of a drive, and the positions at which they change.
//!
//! Ranks are by singular values of J in lengths of the mechanism's size, at poses closed by Newton's method. A change
//! between two poses is bracketed by bisection. A rank may fall in a single pose between two requested poses. The
//! smallest kept singular value then falls and rises again. Its lowest point is found by golden section and counts if
//! the value vanishes there.

use crate::closure::tree::path_from_frame;
use crate::model::mechanism::{LinkId, Mechanism, Mode, Role, StateId};
use crate::motion::follow::{Follower, Stop, Why, column_unit, stroke_positions};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::numeric::scaling::{NumericRank, rank_of_values};
use ozols_dense::{Matrix, singular_values};

/// Width of the bracket of a rank change, as a fraction of the stroke. If longer, the interval with singular values
/// below the tolerance is used.
pub(crate) const BRACKET: f64 = 1e-6;
/// Accuracy of the lowest point of a singular value, as a fraction of the stroke.
const LOWEST: f64 = 1e-9;
/// Ratio of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105;

/// Position of an output link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output {
    /// The link.
    pub link: LinkId,
    /// Position of the middle of its joints, in the file's length unit.
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
    /// The gap of the contours: radians, and fractions of the mechanism's size.
    pub gap: f64,
    /// The output links.
    pub outputs: Vec<Output>,
}

/// A change of the rank along the stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankChange {
    /// Positions of the drive on either side, in the order of the stroke: radians or the file's length unit.
    pub between: [f64; 2],
    /// Rank before, between and after. Before and after are equal if the rank falls in one pose only.
    pub ranks: [usize; 3],
}

/// A stroke with its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeFigures {
    /// The requested poses that were reached, in order.
    pub poses: Vec<PoseFigures>,
    /// Changes of rank between the first of them and the end.
    pub changes: Vec<RankChange>,
    /// The end of the path if it lies before the last requested pose, with the position in radians or the file's length
    /// unit.
    pub stop: Option<Stop>,
    /// Number of output motions that no drive determines. If nonzero, the path followed is the shortest of many.
    pub undriven: usize,
}

/// A stroke to follow.
#[derive(Debug, Clone)]
pub struct StrokeRequest<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The state.
    pub state: StateId,
    /// Its pose in the file, closed or nearly so.
    pub pose: Pose,
    /// The column of the drive in [`Pose::columns`].
    pub drive: usize,
    /// Columns of the other drives.
    pub held: Vec<usize>,
    /// Start and end, in radians or the file's length unit.
    pub range: [f64; 2],
    /// Number of equal steps.
    pub steps: usize,
    /// Singular values below this fraction of the largest count as zero. The default is [`FLAT`].
    pub tolerance: Option<f64>,
}

fn values_of(matrix: &Matrix) -> Vec<f64> {
    singular_values(matrix).unwrap_or_default()
}

struct Looker<'a> {
    request: &'a StrokeRequest<'a>,
    tolerance: f64,
    /// Rows per contour: 6 or 3.
    dim: usize,
    /// The file's unit of the drive's coordinate.
    unit: f64,
    /// Output links with the middle of their joints, in the pose's coordinates.
    outputs: Vec<(LinkId, [f64; 3])>,
}

/// Singular values in a pose along the path.
#[derive(Debug, Clone)]
struct PoseValues {
    follower: Follower,
    at: f64,
    rank: NumericRank,
    /// Relative singular values in descending order.
    values: Vec<f64>,
}

impl<'a> Looker<'a> {
    fn new(request: &'a StrokeRequest<'a>) -> Looker<'a> {
        let (m, pose) = (request.mechanism, &request.pose);
        let middle = |l: LinkId| {
            let of = m.joints_at(l, request.state);
            let points: Vec<[f64; 3]> = of
                .map(|j| m.joints[j].frame.point.each_ref().map(|c| c.to_f64()))
                .collect();
            let n = points.len().max(1) as f64;
            [0, 1, 2].map(|i| {
                (points.iter().map(|p| p[i]).sum::<f64>() / n - pose.middle[i]) / pose.length
            })
        };
        Looker {
            request,
            tolerance: request.tolerance.unwrap_or(FLAT),
            dim: match m.mode {
                Mode::Spatial => 6,
                Mode::Planar { .. } => 3,
            },
            unit: column_unit(pose, request.drive),
            outputs: m
                .links_in(request.state)
                .filter(|&l| m.links[l].role == Role::Output)
                .map(|l| (l, middle(l)))
                .collect(),
        }
    }

    fn sample_pose(&self, follower: &Follower) -> PoseValues {
        let pose = follower.current_pose();
        let mut all = values_of(&pose.jacobian_at(&vec![0.0; pose.columns.len()]));
        let rank = rank_of_values(all.clone(), self.tolerance);
        let largest = all.first().copied().unwrap_or(1.0).max(f64::MIN_POSITIVE);
        all.iter_mut().for_each(|v| *v /= largest);
        PoseValues {
            follower: follower.clone(),
            at: follower.drive_position(),
            rank,
            values: all,
        }
    }

    fn figures_of(&self, sample: &PoseValues) -> PoseFigures {
        let pose = sample.follower.current_pose();
        let rank = sample.rank;
        let outputs = self.outputs.iter().map(|&(link, p)| {
            let d = &pose.links[link];
            let to = d.map_point(p);
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
            redundant: pose.constraint_rows(self.dim).saturating_sub(rank.rank),
            share: sample.follower.drive_share(),
            gap: sample.follower.closure_gap(),
            outputs: outputs.collect(),
        }
    }

    /// Returns the sample at a position, reached from a nearby one.
    fn from(&self, near: &PoseValues, at: f64) -> Option<PoseValues> {
        let mut follower = near.follower.clone();
        follower.advance_to(at, |_| {}).ok()?;
        Some(self.sample_pose(&follower))
    }

    /// Brackets the change between two poses of different ranks.
    fn bisect_change(
        &self,
        low: &PoseValues,
        high: &PoseValues,
        width: f64,
        out: &mut Vec<RankChange>,
    ) {
        let (mut low, mut high) = (low.clone(), high.clone());
        // Two such brackets and the flat interval between them form one change in one pose.
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

    /// Finds the lowest kept singular value between two poses of one rank around a third, and records it if it
    /// vanishes.
    fn lowest_value(&self, around: [&PoseValues; 3], width: f64, out: &mut Vec<RankChange>) {
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

    /// Returns the changes along the path.
    fn rank_changes(&self, way: &[PoseValues]) -> Vec<RankChange> {
        let [from, to] = self.request.range;
        let width = BRACKET * ((to - from) / self.unit).abs();
        let last = |s: &PoseValues, rank: usize| {
            rank.checked_sub(1).and_then(|i| s.values.get(i).copied())
        };
        let mut found = Vec::new();
        for (i, pair) in way.windows(2).enumerate() {
            if pair[0].rank.rank != pair[1].rank.rank {
                self.bisect_change(&pair[0], &pair[1], width, &mut found);
            } else if let Some(next) = way.get(i + 2)
                && next.rank.rank == pair[0].rank.rank
            {
                let [a, b, c] = [&pair[0], &pair[1], next].map(|s| last(s, next.rank.rank));
                if b < a && b <= c {
                    self.lowest_value([&pair[0], &pair[1], next], width, &mut found);
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
                self.lowest_value([from, &middle, to], width, &mut found);
            }
        }
        let along = (to - from).signum();
        found.sort_by(|a, b| (a.between[0] * along).total_cmp(&(b.between[0] * along)));
        let mut merged: Vec<RankChange> = Vec::new();
        for c in found {
            match merged.last_mut() {
                // A fall followed by a rise is one change in one pose.
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

    /// Returns the number of output motions with all drives held.
    fn count_undriven(&self) -> usize {
        let (m, pose) = (self.request.mechanism, &self.request.pose);
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
        let rank = |all: &Matrix| {
            rank_of_values(values_of(&all.select_columns(&free)), self.tolerance).rank
        };
        rank(&whole) - rank(&pose.jacobian_at(&vec![0.0; f]))
    }
}

impl StrokeRequest<'_> {
    /// Follows the drive and analyses every pose.
    ///
    /// # Complexity
    /// About ten closures and singular values of O((6k + f)³) per radian and step, and about thirty per change.
    #[must_use]
    pub fn follow_stroke(&self) -> StrokeFigures {
        let looker = Looker::new(self);
        let mut follower = Follower::new(self.pose.clone(), self.drive, &self.held);
        let range = self.range.map(|x| x / looker.unit);
        let (mut poses, mut way, mut stop) = (Vec::new(), Vec::new(), None);
        for (i, to) in stroke_positions(range, self.steps).enumerate() {
            let arrived = follower.advance_to(to, |f| {
                if i > 0 {
                    way.push(looker.sample_pose(f));
                }
            });
            if i == 0 && arrived.is_ok() {
                way.push(looker.sample_pose(&follower));
            }
            if let Err(s) = arrived {
                stop = Some(Stop {
                    at: s.at * looker.unit,
                    ..s
                });
                break;
            }
            // A requested position is a pose along the path, the last one.
            let last = way.last().filter(|s| s.at == follower.drive_position());
            poses.push(match last {
                Some(s) => looker.figures_of(s),
                None => looker.figures_of(&looker.sample_pose(&follower)),
            });
        }
        StrokeFigures {
            changes: looker.rank_changes(&way),
            poses,
            stop,
            // At a crossing of branches there are several motions, and the drive does not choose one.
            undriven: match stop.map(|s| s.why) {
                Some(Why::Singular | Why::Instantaneous) => 0,
                _ => looker.count_undriven(),
            },
        }
    }
}
