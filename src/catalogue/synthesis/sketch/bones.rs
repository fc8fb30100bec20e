//! Common data of all kinds of layouts: the points of each link, and the roles of the links.

use crate::chains::chain::order_links;
use crate::closure::tree::spanning_forest;
use crate::geom::vector::{add_scaled, sub, unit};
use crate::synthesis::place::{Point, middle_of};
use crate::synthesis::random_normal;
use chacha20::ChaCha8Rng;
use itertools::Itertools;

/// The points of a gripper's links. Points are numbered: joints in their order, then tips.
#[derive(Debug, Clone)]
pub struct Bones {
    /// The fixed link.
    pub frame: usize,
    /// The driven link.
    pub driver: usize,
    /// The jaws.
    pub jaws: Vec<usize>,
    /// Points of each link: its joints, and for a jaw its tip.
    pub of_link: Vec<Vec<usize>>,
    /// Points of each link as bits.
    pub members: Vec<u32>,
    /// Pairs of points of each moving link that are not on one axis by rule.
    pub spans: Vec<[usize; 2]>,
    /// Points of all moving links with more than three points, as bits. Their places decide which of them are corners of the hull.
    pub hulled: u32,
    /// The links of each joint that has a point on both. For a slide, the link with the block comes first.
    pub joints: Vec<Option<[usize; 2]>>,
    /// Joints without a point on their links, where pitch circles touch, as bits.
    pub touching: u32,
    /// For each point, the points on one axis with it by rule, itself included, as bits. They do not count as too near to each other.
    pub together: Vec<u32>,
    /// Whether a joint takes its place from other joints.
    pub follows: Vec<bool>,
    /// Places of the tips of the jaws.
    pub tips: Vec<Point>,
    /// Closing direction of each tip, of length 1.
    pub inward: Vec<Point>,
    /// Links that only push and pull: links of two pins that are neither frame nor driver nor jaw.
    pub rods: Vec<(usize, [usize; 2])>,
    /// Whether the drive turns.
    pub turns: bool,
    /// Whether each jaw turns about a hinge in the frame.
    pub hinged: Vec<bool>,
    /// For a gripper all around the part: minimum distance of joints from its middle.
    pub round: Option<f64>,
    /// Desired minimum distance between joints, and from the joints to the tips ahead of them, in mm.
    pub wished: [f64; 2],
    /// The side of the middle, by its sign, of the half of the jaw that each joint belongs to. 0 if it belongs to no half, or if the jaws
    /// are not on both sides.
    pub halves: Vec<f64>,
    /// For a drive that slides between two links with one other joint each, a cylinder: these links with their other joints.
    pub cylinder: Option<[(usize, usize); 2]>,
    /// Number of jaws, including those that are images of others.
    pub sides: usize,
}

/// Input for [`Bones`]: the roles of the links, and rules for the places of the joints.
#[derive(Debug, Clone)]
pub(in crate::synthesis) struct BonePlan<'a> {
    pub(in crate::synthesis) frame: usize,
    pub(in crate::synthesis) driver: usize,
    pub(in crate::synthesis) jaws: &'a [usize],
    /// The links of each joint that has a point on both.
    pub(in crate::synthesis) joints: Vec<Option<[usize; 2]>>,
    pub(in crate::synthesis) follows: Vec<bool>,
    pub(in crate::synthesis) tips: Vec<Point>,
    pub(in crate::synthesis) turns: bool,
    pub(in crate::synthesis) hinged: Vec<bool>,
    pub(in crate::synthesis) round: Option<f64>,
    pub(in crate::synthesis) wished: [f64; 2],
    /// Sets of joints that are on one axis, as bits.
    pub(in crate::synthesis) together: Vec<u32>,
    /// The links of a drive that slides between two moving links.
    pub(in crate::synthesis) cylinder: Option<[usize; 2]>,
}

/// Returns the number of joints on a shortest path from a link to every link; infinite if there is no path.
fn joints_away(
    links: usize,
    joints: impl IntoIterator<Item = [usize; 2]>,
    from: usize,
) -> Vec<f64> {
    let (_, steps) = spanning_forest(links, joints, |_| false, [from]);
    let mut away = vec![f64::INFINITY; links];
    away[from] = 0.0;
    for s in steps {
        away[s.link] = away[s.from] + 1.0;
    }
    away
}

/// Returns the side of each joint's jaw. This is the jaw that is nearer on paths without frame and driver.
fn joint_halves(links: usize, plan: &BonePlan<'_>) -> Vec<f64> {
    let ([a, b], None) = (plan.jaws, plan.round) else {
        return vec![0.0; plan.joints.len()];
    };
    let between: Vec<[usize; 2]> = plan.joints.iter().flatten().copied().collect();
    let still = |link: usize| link == plan.frame || link == plan.driver && plan.cylinder.is_none();
    let moving = between
        .into_iter()
        .filter(|ends| !ends.iter().any(|l| still(*l)));
    let far = |jaw: usize| joints_away(links, moving.clone(), jaw);
    let (to_a, to_b) = (far(*a), far(*b));
    let half = |ends: &Option<[usize; 2]>| {
        let Some(ends) = ends else { return 0.0 };
        let near = |away: &[f64]| away[ends[0]].min(away[ends[1]]);
        match near(&to_a).total_cmp(&near(&to_b)) {
            std::cmp::Ordering::Less => plan.tips[0][1].signum(),
            std::cmp::Ordering::Greater => plan.tips[1][1].signum(),
            std::cmp::Ordering::Equal => 0.0,
        }
    };
    let halves = plan.joints.iter().map(half).enumerate();
    // A joint on one axis with its image is on no side.
    let shared = |i: usize| plan.together.iter().any(|set| set >> i & 1 == 1);
    halves
        .map(|(i, half)| if shared(i) { 0.0 } else { half })
        .collect()
}

impl Bones {
    /// Creates the points of `links` links. Links for which `pinned` returns true can be rods.
    pub(in crate::synthesis) fn new(
        links: usize,
        plan: BonePlan<'_>,
        pinned: impl Fn(usize) -> bool,
    ) -> Bones {
        let mut of_link = vec![Vec::new(); links];
        for (i, ends) in plan.joints.iter().enumerate() {
            for &link in ends.iter().flatten() {
                of_link[link].push(i);
            }
        }
        for (n, &jaw) in plan.jaws.iter().enumerate() {
            of_link[jaw].push(plan.joints.len() + n);
        }
        let rods = of_link.iter().enumerate().filter_map(|(l, points)| {
            let [a, b] = points[..] else { return None };
            let pulls = l != plan.frame && l != plan.driver && pinned(l);
            pulls.then_some((l, [a, b]))
        });
        let centre = middle_of(&plan.tips);
        let alone = |i: usize| {
            let of = plan.together.iter().find(|set| *set >> i & 1 == 1);
            of.copied().unwrap_or(1 << i)
        };
        let points = plan.joints.len() + plan.tips.len();
        let bits = |points: &Vec<usize>| points.iter().fold(0, |bits, p| bits | 1 << p);
        let members: Vec<u32> = of_link.iter().map(bits).collect();
        let many = |link: &usize| *link != plan.frame && of_link[*link].len() > 3;
        let hulled = (0..links).filter(many).fold(0, |all, l| all | members[l]);
        let joints = plan.joints.iter().enumerate();
        let touching = joints.fold(0, |bits, (i, j)| bits | u32::from(j.is_none()) << i);
        let cylinder = plan.cylinder.and_then(|links| {
            let end = |link: usize| {
                let ends = |i: usize| plan.joints.get(i).map(|ends| ends.map(order_links));
                let other = |&&i: &&usize| ends(i).is_some_and(|e| e != Some(order_links(links)));
                let one = of_link[link].iter().filter(other).exactly_one().ok();
                one.map(|&joint| (link, joint))
            };
            Some([end(links[0])?, end(links[1])?])
        });
        let together: Vec<u32> = (0..points).map(alone).collect();
        let moving = of_link.iter().enumerate().filter(|(l, _)| *l != plan.frame);
        let spans = moving.flat_map(|(_, points)| {
            let ends = points.iter().enumerate();
            ends.flat_map(|(i, &a)| points[..i].iter().map(move |&b| [a, b]))
        });
        let spans = spans.filter(|&[a, b]| together[a] >> b & 1 == 0).collect();
        Bones {
            spans,
            halves: joint_halves(links, &plan),
            cylinder,
            rods: rods.collect(),
            hulled,
            members,
            inward: plan.tips.iter().map(|t| unit(sub(centre, *t))).collect(),
            of_link,
            touching,
            together,
            joints: plan.joints,
            follows: plan.follows,
            tips: plan.tips,
            frame: plan.frame,
            driver: plan.driver,
            jaws: plan.jaws.to_vec(),
            turns: plan.turns,
            hinged: plan.hinged,
            round: plan.round,
            wished: plan.wished,
            sides: plan.jaws.len(),
        }
    }

    /// Returns the unit vector away from the part at each jaw, divided by the number of pairs of jaws. The displacements of the tips along
    /// these vectors add up to the opening.
    #[must_use]
    pub(in crate::synthesis) fn apart_vectors(&self) -> Vec<Point> {
        #[allow(clippy::cast_precision_loss, reason = "two or three")]
        let pairs = self.inward.len() as f64 / 2.0;
        let inward = self.inward.iter();
        inward.map(|i| i.map(|x| -x / pairs)).collect()
    }

    /// Returns the force of each jaw by virtual work, if the drive moves by `rate` for a millimetre of the opening. In N for 1 N of the
    /// drive, or for 1 Nm if it turns.
    #[must_use]
    pub fn jaw_force(&self, rate: f64) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "two or three")]
        let pairs = self.sides as f64 / 2.0;
        // Lengths are in millimetres.
        let metre = if self.turns { 1000.0 } else { 1.0 };
        metre * rate / pairs
    }

    /// Returns true if every jaw turns about a hinge in the frame.
    #[must_use]
    pub fn all_swing(&self) -> bool {
        self.hinged.iter().all(|h| *h)
    }

    /// Returns random places to begin with: each joint between its two links, then the tips. Each link is ahead in proportion to its
    /// distance in joints from frame and jaws.
    pub(in crate::synthesis) fn first_places(
        &self,
        joints: Vec<[usize; 2]>,
        random: &mut ChaCha8Rng,
    ) -> Vec<Point> {
        let far = |from: usize| joints_away(self.of_link.len(), joints.iter().copied(), from);
        let frame = far(self.frame);
        let jaws: Vec<Vec<f64>> = self.jaws.iter().map(|&j| far(j)).collect();
        let ahead_most = middle_of(&self.tips);
        let place = |l: usize| -> Point {
            let away = || jaws.iter().map(|j| j[l]);
            let near = away().fold(f64::INFINITY, f64::min);
            let ahead = frame[l] / (frame[l] + near).max(1.0);
            // A link is drawn towards the side of the nearer jaws.
            let all = away().sum::<f64>();
            #[allow(clippy::cast_precision_loss, reason = "two or three")]
            let mean = all / jaws.len() as f64;
            let start = [0.8 * ahead * ahead_most[0], ahead * ahead_most[1]];
            let sides = away().zip(&self.inward);
            sides.fold(start, |place, (away, inward)| {
                add_scaled(place, 40.0 * (away - mean) / all.max(1.0), *inward)
            })
        };
        let mut at: Vec<Point> = Vec::with_capacity(joints.len() + self.tips.len());
        for &[u, v] in &joints {
            let [x, y] = middle_of(&[place(u), place(v)]);
            at.push(
                [
                    x + 12.0 * random_normal(random),
                    y + 12.0 * random_normal(random),
                ]
                .map(f64::round),
            );
        }
        at.extend(&self.tips);
        at
    }
}
