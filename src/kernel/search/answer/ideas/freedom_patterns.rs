//! Which freedoms a variant gives to which contours.
//!
//! Joints on exactly the same contours are in series with respect to closure. So most variants distribute the same freedoms over them in
//! another way. Which joints share all contours does not depend on the basis of contours.

use crate::closure::contour::contour_basis;

use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, JointOption, Mechanism, StateId};
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use crate::search::question::own_images::own_images;
use crate::search::question::space::Variable;
use itertools::Itertools;
use std::collections::{BTreeMap, BTreeSet};

/// A freedom that is added somewhere, and how often.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Added {
    /// The joints that are on the same contours, any of which may have it.
    pub joints: Vec<JointId>,
    /// The freedom in words: "turn about x".
    pub freedom: String,
    /// How often.
    pub times: u8,
}

/// Returns the added freedoms as text, joint by joint: "turn about x, turn about y at a/b/c".
#[must_use]
pub fn in_words(m: &Mechanism, added: &[Added]) -> String {
    let groups = added.iter().chunk_by(|a| &a.joints);
    let mut out = Vec::new();
    for (joints, here) in &groups {
        let one = |a: &Added| match a.times {
            1 => a.freedom.clone(),
            n => format!("{n} × {}", a.freedom),
        };
        let freedoms = here.map(one).join(", ");
        let joints = joints.iter().map(|&j| m.joints[j].id.as_str()).join("/");
        out.push(format!("{freedoms} at {joints}"));
    }
    out.join("; ")
}

/// How often each freedom is added to each group of joints.
pub(in crate::search) type Pattern = Vec<u8>;

/// A freedom of any of some joints in series.
type Item = (Vec<JointId>, String);

/// The groups of joints in series, and what every choice adds to them.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::search) struct Patterns {
    /// The meaning of each number of a pattern.
    items: Vec<Item>,
    /// `[variable][choice]`.
    pub(in crate::search) of: Vec<Vec<Pattern>>,
    /// The image of each variable under the mechanism's own symmetry; `None` if it has none.
    pub(in crate::search) images: Option<Vec<usize>>,
}

impl Patterns {
    pub(in crate::search) fn sum_pattern(
        &self,
        chosen: impl Iterator<Item = (usize, usize)>,
    ) -> Pattern {
        let mut out = vec![0; self.items.len()];
        for (variable, choice) in chosen {
            let more = self.of[variable][choice].iter();
            out.iter_mut().zip(more).for_each(|(a, b)| *a += b);
        }
        out
    }

    pub(in crate::search) fn of_variant(&self, v: &Assignment) -> Pattern {
        self.sum_pattern(v.choices.iter().copied().enumerate())
    }

    /// Returns what a variant has in common with all of its idea: its pattern or that of an image, whichever is least.
    pub(in crate::search) fn idea_pattern(&self, v: &Assignment) -> Pattern {
        self.of_images(v).pop_first().unwrap_or_default()
    }

    /// Returns the patterns of a variant and of its images.
    pub(in crate::search) fn of_images(&self, v: &Assignment) -> BTreeSet<Pattern> {
        let mut at = (0..v.choices.len()).collect_vec();
        let mut out = BTreeSet::new();
        // The last image is the variant again.
        while out.insert(self.sum_pattern(at.iter().copied().zip(v.choices.iter().copied())))
            && let Some(to) = &self.images
        {
            at.iter_mut().for_each(|v| *v = to[*v]);
        }
        out
    }

    /// Returns how many joints have another choice than their images.
    pub(in crate::search) fn count_unlike(&self, choices: &[usize]) -> usize {
        let images = self.images.iter().flatten();
        let unlike = images.zip(choices).filter(|(to, c)| choices[**to] != **c);
        unlike.count()
    }

    /// Returns whether a variant is its own image; `None` where the mechanism has no symmetry.
    pub(in crate::search) fn is_symmetric(&self, v: &Assignment) -> Option<bool> {
        self.images
            .as_ref()
            .map(|_| self.count_unlike(&v.choices) == 0)
    }

    /// Returns how often each freedom can still be added after each layer of a diagram.
    pub(in crate::search) fn to_come(&self, diagram: &Diagram) -> Vec<Pattern> {
        let mut most = vec![0u8; self.items.len()];
        let mut out = Vec::with_capacity(diagram.layers.len());
        for layer in diagram.layers.iter().rev() {
            out.push(most.clone());
            let here = &self.of[layer.variable];
            for (i, n) in most.iter_mut().enumerate() {
                let times = here.iter().map(|choice| choice[i]).max();
                *n = n.saturating_add(times.unwrap_or(0));
            }
        }
        out.reverse();
        out
    }

    pub(in crate::search) fn added_freedoms(&self, pattern: &Pattern) -> Vec<Added> {
        let all = self.items.iter().zip(pattern).filter(|(_, n)| **n > 0);
        all.map(|((joints, freedom), &times)| Added {
            joints: joints.clone(),
            freedom: freedom.clone(),
            times,
        })
        .collect()
    }
}

/// Returns the joints in series with each joint, itself included: those on the same contours.
fn joints_in_series(m: &Mechanism, state: StateId) -> BTreeMap<JointId, Vec<JointId>> {
    let basis = contour_basis(m, state);
    let of = |j: JointId| {
        basis
            .iter()
            .map(move |c| c.direction_of(j).is_some())
            .collect_vec()
    };
    let mut groups: BTreeMap<(Vec<bool>, Option<JointId>), Vec<JointId>> = BTreeMap::new();
    for j in m.joints_in(state) {
        let contours = of(j);
        // Joints in no contour have nothing in common.
        let alone = (!contours.contains(&true)).then_some(j);
        groups.entry((contours, alone)).or_default().push(j);
    }
    let groups = groups.into_values();
    groups
        .flat_map(|g| g.clone().into_iter().map(move |j| (j, g.clone())))
        .collect()
}

/// Returns the names of an option's freedoms, by their directions.
fn freedom_names(option: &JointOption) -> Vec<String> {
    let axes = option.frame.unit_axes();
    let word = |f: &Freedom| {
        let what = match f {
            Freedom::Screw => "screw about",
            f if f.is_slide() => "slide along",
            _ => "turn about",
        };
        format!("{what} {}", direction_name(axes[f.axis()]))
    };
    option.joint_type.freedoms().iter().map(word).collect()
}

/// Returns the name of a direction, the same for both senses.
fn direction_name(d: [f64; 3]) -> String {
    let d = d.map(|x| (x * 1e6).round() / 1e6 + 0.0);
    let sign = if d.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) {
        -1.0
    } else {
        1.0
    };
    let d = d.map(|x| x * sign + 0.0);
    match d.iter().position(|x| *x == 1.0) {
        Some(i) => ["x", "y", "z"][i].to_owned(),
        None => format!("({})", d.iter().map(|x| format!("{x:.3}")).join(" ")),
    }
}

/// Returns what an option adds to the original joint: freedoms with their directions. If the option does not contain each of
/// the original freedoms, returns the option itself.
fn freedoms_added_by(present: &JointOption, option: &JointOption) -> Vec<String> {
    let mut all = freedom_names(option);
    for f in freedom_names(present) {
        match all.iter().position(|a| *a == f) {
            Some(i) => {
                all.remove(i);
            }
            None => return vec![option.name.clone()],
        }
    }
    all
}

pub(in crate::search) fn freedom_patterns(question: &Question) -> Patterns {
    let m = &question.mechanism;
    let state = question.conditions.state.map_or(StateId::FREE, |s| s.state);
    let mut series = joints_in_series(m, state);
    series.extend(
        m.joints_in(StateId::FREE)
            .filter(|&j| !m.joints[j].is_in(state))
            .map(|j| (j, vec![j])),
    );
    let mut items: BTreeSet<Item> = BTreeSet::new();
    let mut raw: Vec<Vec<Vec<Item>>> = Vec::new();
    for v in &question.space.variables {
        let mut choices = Vec::new();
        for choice in &v.choices {
            let mut here = Vec::new();
            for &j in &v.joints {
                let joint = &m.joints[j];
                let mut words = freedoms_added_by(&joint.options[0], &joint.options[choice.option]);
                if let Some(u) = choice.unloading {
                    words.extend(freedom_names(&joint.unloading[u]));
                }
                here.extend(words.into_iter().map(|w| (series[&j].clone(), w)));
            }
            items.extend(here.iter().cloned());
            choices.push(here);
        }
        raw.push(choices);
    }
    let items: Vec<Item> = items.into_iter().collect();
    let at = |x: &Item| items.binary_search(x).ok();
    let pattern = |here: &Vec<Item>| {
        let mut out = vec![0; items.len()];
        here.iter().filter_map(at).for_each(|i| out[i] += 1);
        out
    };
    let of = raw
        .iter()
        .map(|c| c.iter().map(pattern).collect())
        .collect();
    let searched = question.conditions.state.map(|s| s.state);
    let images = own_images(&question.exact, m, searched);
    Patterns {
        images: images.and_then(|to| images_of_variables(question, &to)),
        items,
        of,
    }
}

/// Returns the image of each variable, if each is the variable of one joint.
fn images_of_variables(question: &Question, to: &[JointId]) -> Option<Vec<usize>> {
    let variables = &question.space.variables;
    let image = |v: &Variable| match v.joints[..] {
        [j] => variables.iter().position(|w| w.joints == [to[j.index()]]),
        _ => None,
    };
    variables.iter().map(image).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{draw_mechanism, four_bar, hinges};

    /// The joints of a ring are in series; those in no contour are not, not even with one another.
    #[test]
    fn a_joint_in_no_contour_is_in_series_with_none() {
        let mut joints = four_bar(0, 1, 0.0);
        joints.extend(hinges(&[
            ([2, 4], [3.0, 3.0, 9.0]),
            ([4, 5], [4.0, 8.0, 9.0]),
        ]));
        let found = joints_in_series(&draw_mechanism(&joints, &[5]), StateId::FREE);
        let ids =
            |all: &[usize]| -> Vec<JointId> { all.iter().map(|&j| JointId::new(j)).collect() };
        for (j, with) in &found {
            let wanted: &[usize] = match j.index() {
                4 => &[4],
                5 => &[5],
                _ => &[0, 1, 2, 3],
            };
            assert_eq!(with, &ids(wanted), "{j:?}");
        }
        assert_eq!(found.len(), 6);
    }
}
