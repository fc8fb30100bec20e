//! Small mechanisms written down as files of their own.

use std::fmt::Write as _;

/// Links, joints and what couples them, on the way to a file: the first link is the frame, the last the output.
#[derive(Debug, Default)]
pub(super) struct Sketch {
    links: Vec<String>,
    tables: String,
    joints: usize,
}

impl Sketch {
    fn link(&mut self, id: &str) {
        if !self.links.iter().any(|l| l == id) {
            self.links.push(id.to_owned());
        }
    }

    /// A hinge between two links, at a point and about an axis written as the file is to have them.
    pub(super) fn hinge(&mut self, ends: [&str; 2], point: [&str; 3], axis: [&str; 3]) {
        ends.iter().for_each(|l| self.link(l));
        let [a, b] = ends;
        // Writing to a string does not fail.
        let _ = write!(
            self.tables,
            "[[joint]]\nid = \"j{}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"revolute\"\npoint = {point:?}\naxis = {axis:?}\n",
            self.joints
        );
        self.joints += 1;
    }

    /// A hinge along z at a place of the plane of x and y.
    pub(super) fn pin(&mut self, ends: [&str; 2], x: &str, y: &str) {
        self.hinge(ends, [x, y, "0"], ["0", "0", "1"]);
    }

    /// Couples two joints, counted from 0, by a ratio.
    pub(super) fn couple(&mut self, [a, b]: [usize; 2], ratio: &str) {
        let _ = write!(
            self.tables,
            "[[coupling]]\njoints = [\"j{a}\", \"j{b}\"]\nratio = \"{ratio}\"\n"
        );
    }

    /// The file.
    pub(super) fn text(&self, name: &str) -> String {
        let mut out = format!("name = \"{name}\"\n");
        for (i, link) in self.links.iter().enumerate() {
            let role = match i {
                0 => "role = \"frame\"\n",
                i if i + 1 == self.links.len() => "role = \"output\"\n",
                _ => "",
            };
            let _ = write!(out, "[[link]]\nid = \"{link}\"\n{role}");
        }
        out + &self.tables
    }
}
