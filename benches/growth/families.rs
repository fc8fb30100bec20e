//! Mechanism files of every size: hinges with four options each, at places in general position.

use std::fmt::Write;

const OPTIONS: &str = "[\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";

/// A mechanism as it is written, hinge by hinge.
struct Written {
    text: String,
    links: usize,
    joints: usize,
    /// Whether hinges point in all directions; along z in a plane where they do not.
    spatial: bool,
    random: u64,
}

impl Written {
    fn new(spatial: bool) -> Written {
        Written {
            text: format!("name = \"generated\"\n[search]\noptions = {OPTIONS}\n"),
            links: 0,
            joints: 0,
            spatial,
            random: 0x9e37_79b9_7f4a_7c15,
        }
    }

    fn below(&mut self, limit: u64) -> u64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 33) % limit
    }

    /// A link; the first is the frame.
    fn link(&mut self, output: bool) -> usize {
        let role = match (self.links, output) {
            (0, _) => "role = \"frame\"\n",
            (_, true) => "role = \"output\"\n",
            _ => "",
        };
        let _ = write!(self.text, "[[link]]\nid = \"{}\"\n{role}", self.links);
        self.links += 1;
        self.links - 1
    }

    fn hinge(&mut self, a: usize, b: usize) {
        self.joint("revolute", a, b);
    }

    fn joint(&mut self, kind: &str, a: usize, b: usize) {
        let (x, y) = (self.below(997), self.below(997));
        let (z, axis) = if self.spatial {
            (
                self.below(997),
                [self.below(19) + 1, self.below(19), self.below(19)],
            )
        } else {
            (0, [0, 0, 1])
        };
        let _ = write!(
            self.text,
            "[[joint]]\nid = \"j{}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"{kind}\"\npoint = [{x}, {y}, {z}]\naxis = {axis:?}\n",
            self.joints
        );
        self.joints += 1;
    }

    /// A chain of new links with so many hinges between two links; returns the new links.
    fn chain(&mut self, from: usize, to: usize, hinges: usize) -> Vec<usize> {
        let new: Vec<usize> = (1..hinges).map(|_| self.link(false)).collect();
        let mut at = from;
        for &next in new.iter().chain([&to]) {
            self.hinge(at, next);
            at = next;
        }
        new
    }
}

/// A slider 1 that drives `m` fingers, each a contour 0-1-rod-finger with all revolute joints: m coupled contours.
pub(crate) fn fingers(m: usize) -> String {
    let mut out = format!(
        "name = \"fingers\"\n[search]\noptions = {OPTIONS}\n\
         [[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n\
         [[joint]]\nid = \"drive\"\nlinks = [\"0\", \"1\"]\ntype = \"cylindrical\"\npoint = [0, 0, 0]\naxis = [1, 0, 0]\ndrive = true\n",
    );
    for i in 0..m {
        let (rod, finger) = (format!("r{i}"), format!("f{i}"));
        let _ = write!(
            out,
            "[[link]]\nid = \"{rod}\"\n[[link]]\nid = \"{finger}\"\nrole = \"output\"\n"
        );
        let ends = [("1", &rod), (&finger, &rod), ("0", &finger)];
        let points = [(i, 1 + i % 5), (3 + 2 * i, 3 + i % 7), (4 + i, i % 3)];
        for (n, ((a, b), (x, y))) in ends.iter().zip(points).enumerate() {
            let _ = write!(
                out,
                "[[joint]]\nid = \"{i}-{n}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"revolute\"\npoint = [{x}, {y}, 0]\naxis = [0, 0, 1]\n"
            );
        }
    }
    out
}

/// A four-bar, and three joints more for each further contour, which shares two links with the one before.
pub(crate) fn ladder(contours: usize, spatial: bool) -> String {
    let mut m = Written::new(spatial);
    let frame = m.link(false);
    let mut side = m.link(true);
    let mut other = m.link(false);
    m.hinge(frame, side);
    m.chain(side, other, 2);
    m.hinge(other, frame);
    for _ in 1..contours {
        let new = m.chain(side, other, 3);
        (side, other) = (new[0], new[1]);
    }
    m.text
}

/// Plates in rows and columns, each on hinges with its neighbours: (rows - 1)(columns - 1) contours in two directions.
pub(crate) fn grid(rows: usize, columns: usize, spatial: bool) -> String {
    let mut m = Written::new(spatial);
    let last = rows * columns - 1;
    for i in 0..=last {
        m.link(i == last);
    }
    for i in 0..=last {
        if i % columns + 1 < columns {
            m.hinge(i, i + 1);
        }
        if i + columns <= last {
            m.hinge(i, i + columns);
        }
    }
    m.text
}

/// A platform on `legs` legs, each of so many hinges.
pub(crate) fn parallel_robot(legs: usize, hinges: usize, spatial: bool) -> String {
    let mut m = Written::new(spatial);
    let frame = m.link(false);
    let platform = m.link(true);
    for _ in 0..legs {
        m.chain(frame, platform, hinges);
    }
    m.text
}

/// Four-bars one on another, each on the coupler of the one before.
pub(crate) fn row(contours: usize) -> String {
    let mut m = Written::new(true);
    let mut on = m.link(false);
    for i in 0..contours {
        let [a, coupler, b] = [false, i + 1 == contours, false].map(|output| m.link(output));
        for (x, y) in [(on, a), (a, coupler), (coupler, b), (b, on)] {
            m.hinge(x, y);
        }
        on = coupler;
    }
    m.text
}

/// A platform on legs of three hinges that stand on the ground by a ball each.
pub(crate) fn walker(legs: usize) -> String {
    let mut m = Written::new(true);
    let ground = m.link(false);
    let body = m.link(true);
    for _ in 0..legs {
        let foot = m.link(false);
        m.joint("spherical", ground, foot);
        m.chain(foot, body, 3);
    }
    m.text
}

/// Pairs of crossed bars in a closed ring in a plane, each on two hinges with the next.
pub(crate) fn ring(pairs: usize) -> String {
    let mut m = Written::new(false);
    let bars: Vec<[usize; 2]> = (0..pairs)
        .map(|i| [m.link(false), m.link(i + 1 == pairs)])
        .collect();
    for (i, [a, b]) in bars.iter().enumerate() {
        let [next_a, next_b] = bars[(i + 1) % pairs];
        m.hinge(*a, *b);
        m.hinge(*a, next_b);
        m.hinge(*b, next_a);
    }
    m.text
}

/// Crossed bars in stages on a slide, under a platform with another.
pub(crate) fn scissor_lift(stages: usize) -> String {
    let mut out = format!(
        "name = \"scissor lift\"\n[search]\noptions = {OPTIONS}\n[[link]]\nid = \"0\"\nrole = \"frame\"\n\
         [[link]]\nid = \"s\"\n[[link]]\nid = \"t\"\nrole = \"output\"\n[[link]]\nid = \"u\"\n"
    );
    let joint = |a: &str, b: &str, kind: &str, (x, y): (usize, usize)| {
        let more = match (kind, a) {
            ("prismatic", "0") => "axis = [1, 0, 0]\ndrive = true",
            ("prismatic", _) => "axis = [1, 0, 0]",
            _ => "axis = [0, 0, 1]",
        };
        format!(
            "[[joint]]\nid = \"{a}-{b}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"{kind}\"\npoint = [{x}, {y}, 0]\n{more}\n"
        )
    };
    let (mut left, mut right) = ("0".to_owned(), "s".to_owned());
    let mut joints = joint("0", "s", "prismatic", (60, 0));
    for i in 1..=stages {
        let (a, b) = (format!("a{i}"), format!("b{i}"));
        let _ = write!(out, "[[link]]\nid = \"{a}\"\n[[link]]\nid = \"{b}\"\n");
        let low = 40 * (i - 1);
        joints += &joint(&left, &a, "revolute", (0, low));
        joints += &joint(&right, &b, "revolute", (60, low));
        joints += &joint(&a, &b, "revolute", (30, low + 20));
        (left, right) = (b, a);
    }
    joints += &joint(&left, "t", "revolute", (0, 40 * stages));
    joints += &joint(&right, "u", "revolute", (60, 40 * stages));
    joints += &joint("t", "u", "prismatic", (60, 40 * stages));
    out + &joints
}

/// A hand in a plane: one slider drives five fingers, each a slider-crank and a four-bar on it that bends the tip.
pub(crate) fn hand() -> String {
    let mut m = Written::new(false);
    let palm = m.link(false);
    let drive = m.link(false);
    m.joint("cylindrical", palm, drive);
    for _ in 0..5 {
        let [rod, finger, tip, coupler] = [false, false, true, false].map(|output| m.link(output));
        for (a, b) in [(drive, rod), (rod, finger), (finger, palm)] {
            m.hinge(a, b);
        }
        for (a, b) in [(finger, tip), (tip, coupler), (coupler, palm)] {
            m.hinge(a, b);
        }
    }
    m.text
}
