//! Common data of all kinds of layouts: the points of each link, and the roles of the links.

use crate::chains::chain::order_links;
use crate::closure::tree::spanning_forest;
use crate::geom::vector::{add_scaled, sub, unit};
use crate::synthesis::place::{Point, middle_of};
use crate::synthesis::random_normal;
use chacha20::ChaCha8Rng;
use itertools::Itertools;

/// The points of a gripper's links. Points are numbered: joints in their order, then tips.
#[derive(Debug, Clone, Default)]
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

impl Bones {
    /// Completes the roles of the links and the rules of the joints with the points of `links` links. `together` are the sets of joints that
    /// are on one axis, as bits. `cylinder` are the links of a drive that slides between two moving links. Links for which `pinned` returns
    /// true can be rods.
    pub(in crate::synthesis) fn joined(
        mut self,
        links: usize,
        together: &[u32],
        cylinder: Option<[usize; 2]>,
        pinned: impl Fn(usize) -> bool,
    ) -> Bones {
        let mut of_link = vec![Vec::new(); links];
        for (i, ends) in self.joints.iter().enumerate() {
            for &link in ends.iter().flatten() {
                of_link[link].push(i);
            }
        }
        for (n, &jaw) in self.jaws.iter().enumerate() {
            of_link[jaw].push(self.joints.len() + n);
        }
        let rods = of_link.iter().enumerate().filter_map(|(l, points)| {
            let [a, b] = points[..] else { return None };
            let pulls = l != self.frame && l != self.driver && pinned(l);
            pulls.then_some((l, [a, b]))
        });
        self.rods = rods.collect();
        let centre = middle_of(&self.tips);
        self.inward = self.tips.iter().map(|t| unit(sub(centre, *t))).collect();
        let alone = |i: usize| {
            let of = together.iter().find(|set| *set >> i & 1 == 1);
            of.copied().unwrap_or(1 << i)
        };
        let points = self.joints.len() + self.tips.len();
        self.together = (0..points).map(alone).collect();
        let bits = |points: &Vec<usize>| points.iter().fold(0, |bits, p| bits | 1 << p);
        self.members = of_link.iter().map(bits).collect();
        let many = |link: &usize| *link != self.frame && of_link[*link].len() > 3;
        self.hulled = (0..links)
            .filter(many)
            .fold(0, |all, l| all | self.members[l]);
        let joints = self.joints.iter().enumerate();
        self.touching = joints.fold(0, |bits, (i, j)| bits | u32::from(j.is_none()) << i);
        self.cylinder = cylinder.and_then(|links| {
            let end = |link: usize| {
                let ends = |i: usize| self.joints.get(i).map(|ends| ends.map(order_links));
                let other = |&&i: &&usize| ends(i).is_some_and(|e| e != Some(order_links(links)));
                let one = of_link[link].iter().filter(other).exactly_one().ok();
                one.map(|&joint| (link, joint))
            };
            Some([end(links[0])?, end(links[1])?])
        });
        let moving = of_link.iter().enumerate().filter(|(l, _)| *l != self.frame);
        let spans = moving.flat_map(|(_, points)| {
            let ends = points.iter().enumerate();
            ends.flat_map(|(i, &a)| points[..i].iter().map(move |&b| [a, b]))
        });
        let spans = spans.filter(|&[a, b]| self.together[a] >> b & 1 == 0);
        self.spans = spans.collect();
        self.of_link = of_link;
        self.sides = self.jaws.len();
        self.halves = self.joint_halves(cylinder.is_some());
        self
    }

    /// Returns the side of each joint's jaw. This is the jaw that is nearer on paths without frame and driver; the driver of a cylinder
    /// counts.
    fn joint_halves(&self, cylinder: bool) -> Vec<f64> {
        let ([a, b], None) = (&self.jaws[..], self.round) else {
            return vec![0.0; self.joints.len()];
        };
        let between: Vec<[usize; 2]> = self.joints.iter().flatten().copied().collect();
        let still = |link: usize| link == self.frame || link == self.driver && !cylinder;
        let moving = between
            .into_iter()
            .filter(|ends| !ends.iter().any(|l| still(*l)));
        let far = |jaw: usize| joints_away(self.of_link.len(), moving.clone(), jaw);
        let (to_a, to_b) = (far(*a), far(*b));
        let half = |(i, ends): (usize, &Option<[usize; 2]>)| {
            // A joint on one axis with its image is on no side.
            let Some(ends) = ends.filter(|_| self.together[i] == 1 << i) else {
                return 0.0;
            };
            let near = |away: &[f64]| away[ends[0]].min(away[ends[1]]);
            match near(&to_a).total_cmp(&near(&to_b)) {
                std::cmp::Ordering::Less => self.tips[0][1].signum(),
                std::cmp::Ordering::Greater => self.tips[1][1].signum(),
                std::cmp::Ordering::Equal => 0.0,
            }
        };
        self.joints.iter().enumerate().map(half).collect()
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
