//! Joints that close loops, which a URDF has no word for: `<loop_joint>`, pairs of links in a file beside it, or Drake's balls.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, X, Y, Z, scale};
use crate::robots::convert::plan::{Moves, Single, ending};
use crate::robots::convert::text::xyz_rpy;
use crate::robots::convert::to_urdf::{Loops, ToUrdf};
use crate::robots::mechanism::series_of_single_joints::{escape, numbers};
use std::fmt::Write;

/// An end of a loop: a link of the file and the place on it.
type End = (String, RigidMotion);

impl ToUrdf<'_> {
    pub(super) fn closing(&mut self, j: usize) {
        let part = self.scene.part(j).clone();
        let mut end = ending(&part);
        let id = self.id(j);
        if self
            .scene
            .payload
            .closures
            .get(&j)
            .is_some_and(|w| !w.is_empty())
        {
            self.out
                .lost
                .no_word("solver settings of a loop closure", Some(&part.id));
        }
        // The last freedom of a joint that is no ball can close the loop by itself.
        let last = match (self.loops, end.point, end.on[0].last().map(|s| s.moves)) {
            (Loops::Beside, ..) | (_, true, _) | (_, _, None | Some(Moves::Screw(_))) => None,
            (Loops::Drake, false, Some(m)) if m != Moves::Turn => None,
            _ => end.on[0].pop(),
        };
        // What closes the loop has no name there, so that the first of the joints before it has its.
        let first = end.on.iter().flatten().next();
        if let (Loops::Beside | Loops::Drake, None, Some(s)) = (self.loops, last, first) {
            self.single.insert((j, s.freedom), id.clone());
        }
        let mut ends: Vec<End> = Vec::new();
        for side in [0, 1] {
            let link = part.links[side];
            let at = self.frames[&link].inverse().then(&part.sides[side]);
            let name = self.names[&link].clone();
            ends.push(if end.on[side].is_empty() {
                (name, at)
            } else {
                let small = self.between(&format!("{id}~{}", ["a", "b"][side]));
                self.series(j, &end.on[side], at, [name, small.clone()]);
                (small, RigidMotion::IDENTITY)
            });
        }
        match self.loops {
            Loops::LoopJoint => self.loop_joint(&id, &ends, last, end.point),
            Loops::Beside => self.pair(&id, &ends, end.point),
            Loops::Drake => self.balls(&part.id, &ends, last.map(|s| s.axis), end.point),
        }
    }

    /// `<loop_joint>`, the last freedom its own.
    fn loop_joint(&mut self, id: &str, ends: &[End], last: Option<Single>, point: bool) {
        let kind = match last.map(|s| s.moves) {
            Some(Moves::Slide) => "prismatic",
            Some(_) => "continuous",
            None if point => "spherical",
            None => "fixed",
        };
        let axis = last.map_or(String::new(), |s| {
            format!("    <axis xyz=\"{}\"/>\n", numbers(s.axis))
        });
        let [a, b] =
            [&ends[0], &ends[1]].map(|(l, at)| format!("link=\"{}\" {}", escape(l), xyz_rpy(at)));
        let _ = write!(
            self.body,
            "  <loop_joint name=\"{}\" type=\"{kind}\">\n    <link1 {a}/>\n    <link2 {b}/>\n{axis}  </loop_joint>\n",
            escape(id)
        );
    }

    /// Two links that coincide, each fixed where its end of the loop is.
    fn pair(&mut self, id: &str, ends: &[End], point: bool) {
        let mut names = Vec::new();
        for ((link, at), letter) in ends.iter().zip(["a", "b"]) {
            let name = self.links.fit(&format!("{id}_{letter}"));
            let _ = writeln!(self.head, "  <link name=\"{}\"/>", escape(&name));
            let joint = self.joints.fit(&format!("{id}_{letter}_mount"));
            self.put(
                "joint",
                &joint,
                "fixed",
                &[link.clone(), name.clone()],
                at,
                "",
            );
            names.push(name);
        }
        let kind = if point { "3d" } else { "6d" };
        self.pairs
            .push([names[0].clone(), names[1].clone(), kind.to_owned()]);
    }

    /// The file of loops beside it.
    pub(super) fn side(&self) -> String {
        let word = |text: &String| serde_json::Value::from(text.as_str()).to_string();
        let pairs: Vec<String> = self
            .pairs
            .iter()
            .map(|[a, b, _]| format!("[{}, {}]", word(a), word(b)))
            .collect();
        let kinds: Vec<String> = self.pairs.iter().map(|p| word(&p[2])).collect();
        let robot = self.scene.robot;
        let driven = (0..robot.joints.len()).filter(|&j| robot.joints[j].drive);
        let driven = driven.filter(|&j| {
            self.scene
                .plan
                .branches
                .iter()
                .any(|b| b.joint == j && b.singles.len() == 1)
        });
        let driven: Vec<String> = driven.map(|j| word(&self.id(j))).collect();
        let mut out = format!(
            "closed_loop: [{}]\ntype: [{}]\n",
            pairs.join(", "),
            kinds.join(", ")
        );
        if !driven.is_empty() {
            let _ = writeln!(out, "name_mot: [{}]", driven.join(", "));
        }
        out
    }

    /// Drake holds points alone: one for a ball, two on the axis of a hinge, three for what is rigid.
    fn balls(&mut self, id: &str, ends: &[End], axis: Option<Vector>, point: bool) {
        let far = self.scene.size * 0.1;
        let points: Vec<Vector> = match (point, axis) {
            (true, _) => vec![[0.0; 3]],
            (false, Some(d)) => vec![scale(d, far), scale(d, -far)],
            (false, None) => [X, Y, Z].map(|d| scale(d, far)).to_vec(),
        };
        if points.len() > 1 {
            let what = match axis {
                Some(_) => "two balls on its axis stand for it, which hold one thing twice",
                None => "three balls stand for it, which hold three things twice",
            };
            self.out
                .lost
                .one("loop closure that is no ball", Some(id), what);
            self.out.repeated += if axis.is_some() { 1 } else { 3 };
        }
        for p in points {
            let [a, b] = [&ends[0], &ends[1]].map(|(l, at)| (escape(l), numbers(at.point(p))));
            let _ = write!(
                self.body,
                "  <drake:ball_constraint>\n    <drake:ball_constraint_body_A name=\"{}\"/>\n    <drake:ball_constraint_p_AP value=\"{}\"/>\n    <drake:ball_constraint_body_B name=\"{}\"/>\n    <drake:ball_constraint_p_BQ value=\"{}\"/>\n  </drake:ball_constraint>\n",
                a.0, a.1, b.0, b.1
            );
        }
    }
}
