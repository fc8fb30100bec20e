//! The subject of a drawing: a mechanism in one state with its couplings, and the changes of a redesign.

use crate::draw::prelude::*;
use crate::format::decimals;
use crate::redundancy::analysis::StateAnalysis;
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::check::variant_mechanism;
use crate::search::question::space::choice_name;
use itertools::Itertools;

/// The class of the style sheet that the lines of couplings have.
pub(crate) const COUPLING: &str = "fine dash";

/// The subject of a drawing.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The state it is drawn in.
    pub state: StateId,
    /// Its figures in that state, where they are known: contours are tinted by their share of the redundant constraints.
    pub analysis: Option<&'a StateAnalysis>,
    /// The changes, if the mechanism is a redesign.
    pub marks: Option<Marks>,
}

/// The changes of a redesign.
#[derive(Debug, Clone, Default)]
pub struct Marks {
    /// The name of the redesign, such as `variant 1`.
    pub name: String,
    /// Changed joints, with their classes and the words for it: `2-3: V → III spherical`.
    pub changed: Vec<(JointId, String)>,
    /// Joints from this one on are added.
    pub joints: usize,
    /// Links from this one on are added.
    pub links: usize,
    /// The mechanism with its original joints in place of the changed ones, for the same view.
    pub before: Option<Mechanism>,
}

impl Marks {
    /// Returns the mechanism of a variant, with its changes marked for drawing.
    ///
    /// # Examples
    /// ```
    /// use ozols::draw::Marks;
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// let best = outcome.variants().next().expect("there are 14");
    /// let (redesign, marks) = Marks::of_variant(&outcome.search, best.assignment(), "variant 1");
    /// assert_eq!((marks.changed.len(), redesign.joints.len()), (best.change_count() as usize, 4));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn of_variant(search: &Search, variant: &Assignment, name: &str) -> (Mechanism, Marks) {
        let old = &search.mechanism;
        let realized = variant_mechanism::realize_variant(search, &variant.choices);
        let mut changed: Vec<(JointId, String)> = Vec::new();
        for (v, &choice) in search.space.variables.iter().zip(&variant.choices) {
            if choice == 0 {
                continue;
            }
            for &j in &v.joints {
                let joint = &old.joints[j];
                let to = choice_name(old, j, &v.choices[choice]);
                let (from, now) = (
                    joint.joint_type.class_numeral(),
                    realized.joints[j].joint_type.class_numeral(),
                );
                changed.push((j, format!("{}: {from} → {now} {to}", joint.id)));
            }
        }
        changed.sort_unstable();
        let mut before = realized.clone();
        for (joint, present) in before.edit().joints.iter_mut().zip(&old.joints) {
            joint.joint_type = present.joint_type.clone();
            joint.frame = present.frame.clone();
        }
        let marks = Marks {
            name: name.to_owned(),
            changed,
            joints: old.joints.len(),
            links: old.links.len(),
            before: Some(before),
        };
        (realized, marks)
    }
}

/// How a part of the drawing is marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    None,
    Changed,
    New,
}

impl Mark {
    /// Returns the class of the style sheet that shows it, with a space before it.
    pub(crate) fn mark_class(self) -> &'static str {
        match self {
            Mark::None => "",
            Mark::Changed => " changed",
            Mark::New => " new",
        }
    }
}

impl Subject<'_> {
    pub(crate) fn joint_mark(&self, joint: JointId) -> Mark {
        match &self.marks {
            Some(m) if joint.index() >= m.joints => Mark::New,
            Some(m) if m.changed.iter().any(|(j, _)| *j == joint) => Mark::Changed,
            _ => Mark::None,
        }
    }

    pub(crate) fn link_mark(&self, link: LinkId) -> Mark {
        match &self.marks {
            Some(m) if link.index() >= m.links => Mark::New,
            _ => Mark::None,
        }
    }

    /// Returns true if a joint exists in this state but not in the free state.
    pub(crate) fn only_here(&self, joint: JointId) -> bool {
        self.mechanism.joints[joint]
            .states
            .as_ref()
            .is_some_and(|s| !s.contains(&StateId::FREE))
    }

    pub(crate) fn drawing_title(&self) -> String {
        let name = &self.mechanism.name;
        match &self.marks {
            Some(m) if !m.name.is_empty() => format!("{name}, {}", m.name),
            _ => name.clone(),
        }
    }

    /// Returns the name of the drawing and the mechanism's figures.
    pub(crate) fn subtitle_lines(&self, what: &str) -> [String; 2] {
        let state = &self.mechanism.states[self.state];
        let what = if self.mechanism.states.len() > 1 {
            format!("{what}, state {state}")
        } else {
            what.to_owned()
        };
        let figures = self.analysis.map_or(String::new(), |a| {
            format!(
                "n = {}, p = {}, k = {}, f = {}, W = {}, σ = {}{}",
                a.links,
                a.joints,
                a.contours,
                a.freedoms,
                a.mobility,
                a.redundant,
                a.at_most().map_or(String::new(), |(w, sigma)| format!(
                    " as written; undecided, W up to {w}, σ up to {sigma}"
                ))
            )
        });
        [what, figures]
    }

    /// Describes a drawing in words: its figures, and a sentence for each joint.
    pub(crate) fn describe_joints(
        &self,
        what: &str,
        joints: impl Iterator<Item = JointId>,
    ) -> String {
        let m = self.mechanism;
        let [what, figures] = self.subtitle_lines(what);
        let mut out = match &*figures {
            "" => format!("{what}."),
            figures => format!("{what}: {figures}."),
        };
        for joint in joints.map(|j| &m.joints[j]) {
            let [a, b] = joint.links.map(|l| &m.links[l].id);
            let at = joint
                .frame
                .point
                .each_ref()
                .map(|x| decimals(x.to_f64(), 4));
            let _ = write!(
                out,
                " Joint {} of class {} ({}) between {a} and {b} at {} {}{}.",
                joint.id,
                joint.joint_type.class_numeral(),
                joint.joint_type,
                at.join(", "),
                m.length_unit.symbol,
                if joint.drive { ", driven" } else { "" }
            );
        }
        out
    }

    /// Returns rows of the legend for the changes of a redesign.
    pub(crate) fn mark_rows(&self) -> Vec<(Swatch, String)> {
        let Some(marks) = &self.marks else {
            return Vec::new();
        };
        let m = self.mechanism;
        let mut out = Vec::new();
        for (j, words) in &marks.changed {
            let class = m.joints[*j].joint_type.class_numeral().to_owned();
            out.push((Swatch::Joint("joint changed", class), words.clone()));
        }
        for joint in m.joints.iter().skip(marks.joints) {
            let class = joint.joint_type.class_numeral();
            out.push((
                Swatch::Joint("joint new", class.to_owned()),
                format!("{}: added, {class} {}", joint.id, joint.joint_type),
            ));
        }
        for link in m.links.iter().skip(marks.links) {
            out.push((Swatch::line("bone new"), format!("link {}: added", link.id)));
        }
        out
    }

    /// Draws the lines of the couplings between joints; `place` gives their positions.
    pub(crate) fn draw_couplings(
        &self,
        sheet: &mut Sheet,
        place: impl Fn(JointId) -> Option<Point>,
    ) {
        for coupling in self.mechanism.couplings_in(self.state) {
            if let [Some(a), Some(b)] = coupling.ends.map(|e| place(e.joint)) {
                sheet.draw_line(COUPLING, a, b);
            }
        }
    }

    /// Returns the row of the legend for couplings. `None` if there are none.
    pub(crate) fn coupling_row(&self) -> Option<(Swatch, String)> {
        self.mechanism.couplings_in(self.state).next()?;
        Some((Swatch::line(COUPLING), "coupled joints".to_owned()))
    }

    /// Describes the couplings in words, for readers who cannot see the drawing.
    pub(crate) fn coupling_words(&self) -> String {
        let mut out = String::new();
        for c in self.mechanism.couplings_in(self.state) {
            // Writing to a string cannot fail.
            let _ = write!(
                out,
                " Coupled: {}, ratio {}.",
                c.name(self.mechanism),
                c.ratio
            );
        }
        out
    }
}

/// Returns the positions of a link's joints in a list of joints.
pub(crate) fn joints_of_link(m: &Mechanism, joints: &[JointId], link: LinkId) -> Vec<usize> {
    let has = |j: &JointId| m.joints[*j].links.contains(&link);
    joints.iter().positions(has).collect()
}

/// Returns the factor by which a drawing is larger than usual, to make room for long names.
pub(crate) fn roominess(m: &Mechanism, joints: &[JointId]) -> f64 {
    let wide = joints
        .iter()
        .map(|&j| text_width(&m.joints[j].id, SMALL).min(150.0));
    let usual = wide.sum::<f64>() / joints.len().max(1) as f64;
    1.0 + 0.5 * ((usual - 40.0) / 60.0).clamp(0.0, 1.0)
}
