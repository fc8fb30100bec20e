//! Reasons for a redesign and its cost in stiffness: freedoms that each change adds, redundant constraints that it removes, directions
//! that remain held, unchanged joints, and loads of joints.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, cross, length, to_vector, unit};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::loads::ExternalForce;
use crate::model::mechanism::{JointId, JointOption, LinkId, Mechanism, Role, StateId};
use crate::model::ranking::ClearanceSum;
use crate::redundancy::contour_shares::contour_shares;
use crate::redundancy::release::added_freedoms;
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::load_cases::is_loaded;
use crate::score::evaluation::terms::Peak;
use crate::score::outcome::Outcome;
use crate::search::Search;
use crate::search::answer::ideas::preferred::is_rod;
use crate::search::answer::k_best::Assignment;
use crate::search::check::variant_mechanism::realize_variant;
use crate::search::question::conditions::Conditions;
use itertools::Itertools;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The side load of a file without loads. `[N]`
pub const SIDE_LOAD: f64 = 10.0;

/// The freedoms that one change adds.
#[derive(Debug, Clone, PartialEq)]
pub struct LetGo {
    /// The joint.
    pub joint: JointId,
    /// The part that may move: the rod, where one ends here.
    pub part: LinkId,
    /// Whether that is a rod.
    pub is_rod: bool,
    /// Turns across the joint's present axis.
    pub tilts: usize,
    /// Whether it may turn about that axis, and could not.
    pub turns: bool,
    /// Whether it may shift along that axis, and could not.
    pub floats: bool,
    /// Slides across that axis.
    pub shifts: usize,
    /// The new type; `None` for a joint in series or a custom set of freedoms.
    pub to: Option<JointType>,
    /// In how many directions forces and moments are still held.
    pub holds: (usize, usize),
}

/// Redundant constraints of a contour that had some, before and after a redesign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Removed {
    /// The name of the contour.
    pub contour: String,
    /// How many it had as built.
    pub of: usize,
    /// How many are left.
    pub left: usize,
}

/// Why a redesign helps.
#[derive(Debug, Clone, PartialEq)]
pub struct Why {
    /// The freedoms that each change adds, in file order.
    pub lets: Vec<LetGo>,
    /// The removed constraints of each contour; `None` if a coordinate has no exact value.
    pub removes: Option<Vec<Removed>>,
    /// The unchanged joints.
    pub unchanged: Vec<JointId>,
    /// The joints that bear most of what they may, by force and by moment; `None` where the loads have no equilibrium, or nothing is
    /// known of them.
    pub peaks: Option<[Peak; 2]>,
}

/// The data that explain the redesigns of one search.
#[derive(Debug)]
pub struct Whys<'o> {
    outcome: &'o Outcome,
    /// The contours that have redundant constraints as built.
    contours: Vec<(Contour, usize)>,
    /// The same search under the side load, where the file has no load.
    side: Option<Search>,
}

impl<'o> Whys<'o> {
    /// Prepares the data of an outcome.
    pub fn new(outcome: &'o Outcome) -> Whys<'o> {
        let (search, m) = (&outcome.search, &outcome.search.mechanism);
        let closure = Closure::new(search.field(), m, StateId::FREE);
        let all = closure.map_or(Vec::new(), |c| contour_shares(search.field(), &c));
        let redundant = all.into_iter().filter(|s| s.redundant > 0);
        let redundant = redundant.map(|s| (s.contour, s.redundant));
        let side = (!is_loaded(m)).then(|| {
            let loaded = Arc::new(pressed_aside(m));
            let conditions = Conditions {
                throughout: false,
                ..search.conditions.clone()
            };
            Search::new(search.field().clone(), loaded, conditions).ok()
        });
        Whys {
            outcome,
            contours: redundant.collect(),
            side: side.flatten(),
        }
    }

    /// Returns true if peaks are those of the side load of [`SIDE_LOAD`] on each output, along its hinges.
    pub fn is_side_load(&self) -> bool {
        self.side.is_some()
    }

    /// Returns a function that explains redesigns one after another.
    ///
    /// # Complexity
    /// That of analysing a stroke under the loads, once; then O((6k)²·f) for each redesign and pose.
    pub fn explain_each(&self) -> impl FnMut(&Assignment) -> Why + '_ {
        let search = self.side.as_ref().unwrap_or(&self.outcome.search);
        let evaluator = Evaluator::new(search, ClearanceSum::default()).ok();
        let mut scratch = Scratch::default();
        move |v| {
            let scores = evaluator.as_ref().map(|e| e.score_variant(v, &mut scratch));
            let known = scores.and_then(Result::ok).filter(|s| !s.minimum_norm);
            let peaks = known.map(|s| [s.force, s.moment]);
            Why {
                peaks,
                ..self.explain_unloaded(v)
            }
        }
    }

    /// Returns the explanation without loads.
    fn explain_unloaded(&self, v: &Assignment) -> Why {
        let search = &self.outcome.search;
        let m = &*search.mechanism;
        let chosen = || search.space.variables.iter().zip(&v.choices);
        let mut lets = Vec::new();
        for (variable, &choice) in chosen().filter(|(_, c)| **c != 0) {
            let c = &variable.choices[choice];
            lets.extend(variable.joints.iter().map(|&j| {
                let series = c.unloading.map(|u| &m.joints[j].unloading[u]);
                self.let_go(j, &m.joints[j].options[c.option], series)
            }));
        }
        lets.sort_by_key(|l: &LetGo| l.joint);
        let kept = chosen().filter(|(v, c)| **c == 0 && !v.external);
        let kept: Vec<JointId> = kept.flat_map(|(v, _)| v.joints.clone()).collect();
        Why {
            lets,
            removes: self.removed_constraints(v),
            unchanged: kept.into_iter().sorted_unstable().collect(),
            peaks: None,
        }
    }

    /// Returns what a redesign removes: the difference of what contours have as built and with it.
    fn removed_constraints(&self, v: &Assignment) -> Option<Vec<Removed>> {
        let search = &self.outcome.search;
        let m = &*search.mechanism;
        let mut left: Vec<(BTreeSet<JointId>, usize)> = Vec::new();
        if v.key.internal() > 0 {
            let realized = realize_variant(search, &v.choices);
            let closure = Closure::new(search.field(), &realized, StateId::FREE).ok()?;
            // Joints put in series come after those of the mechanism.
            let of_mechanism = |c: &Contour| -> BTreeSet<JointId> {
                let joints = c.joints.iter().map(|(j, _)| *j);
                joints.filter(|j| j.index() < m.joints.len()).collect()
            };
            let all = contour_shares(search.field(), &closure).into_iter();
            left.extend(all.map(|s| (of_mechanism(&s.contour), s.redundant)));
        }
        let removed = |(contour, of): &(Contour, usize)| {
            let own: BTreeSet<JointId> = contour.joints.iter().map(|(j, _)| *j).collect();
            let left = left.iter().find(|(joints, _)| *joints == own);
            Removed {
                contour: contour.name(m),
                of: *of,
                left: left.map_or(0, |(_, n)| *n),
            }
        };
        Some(self.contours.iter().map(removed).collect())
    }

    fn let_go(&self, joint: JointId, to: &JointOption, series: Option<&JointOption>) -> LetGo {
        let m = &self.outcome.search.mechanism;
        let here = &m.joints[joint];
        let now = (&here.frame, &here.joint_type);
        let mut more = added_freedoms(now, (&to.frame, &to.joint_type)).unwrap_or_default();
        if let Some(s) = series {
            let nothing = JointType::Custom(Vec::new());
            more.extend(
                added_freedoms((&s.frame, &nothing), (&s.frame, &s.joint_type)).unwrap_or_default(),
            );
        }
        let axis = unit(to_vector(&here.frame.axis));
        let along = |d: &Vector| length(cross(*d, axis)) < 1e-6;
        let count = |slides: bool, is_along: bool| {
            let some = more
                .iter()
                .filter(|(s, d)| *s == slides && along(d) == is_along);
            some.count()
        };
        let [a, b] = here.links;
        let rod = [a, b].into_iter().find(|&l| is_rod(m, l));
        let free = to.joint_type.freedoms().iter();
        let slides = free.clone().filter(|f| f.is_slide()).count();
        let turns = free
            .filter(|f| f.is_turn() || **f == Freedom::Screw)
            .count();
        LetGo {
            joint,
            part: rod.unwrap_or(if b == m.frame_link() { a } else { b }),
            is_rod: rod.is_some(),
            tilts: count(false, false),
            turns: count(false, true) > 0,
            floats: count(true, true) > 0,
            shifts: count(true, false),
            to: (series.is_none() && JointType::NAMED.contains(&to.joint_type))
                .then(|| to.joint_type.clone()),
            holds: (3 - slides.min(3), 3 - turns.min(3)),
        }
    }
}

/// Returns a mechanism with a force on each output at the middle of its joints, along the hinges on which it turns.
fn pressed_aside(m: &Mechanism) -> Mechanism {
    let mut out = m.clone();
    let joints: Vec<_> = m.joints_in(StateId::FREE).map(|j| &m.joints[j]).collect();
    for (l, link) in m.link_ids().zip(&m.links) {
        let own: Vec<_> = joints.iter().filter(|j| j.links.contains(&l)).collect();
        if link.role != Role::Output || own.is_empty() {
            continue;
        }
        let mut hinges = own.iter().copied().chain(&joints);
        let hinge = hinges.find(|j| j.joint_type == JointType::Revolute);
        let across = hinge.map_or([0.0, 0.0, 1.0], |j| unit(to_vector(&j.frame.axis)));
        let many = own.len() as f64;
        let points = own.iter().map(|j| to_vector(&j.frame.point));
        let sum = points.fold([0.0; 3], |s, p| [0, 1, 2].map(|i| s[i] + p[i] / many));
        let expr = |x: f64| Expr::from_f64(x).unwrap_or_else(|_| Expr::from(0));
        out.edit().loads.forces.push(ExternalForce {
            link: l,
            point: sum.map(expr),
            force: across.map(|x| expr(x * SIDE_LOAD)),
            range: None,
            states: None,
        });
    }
    out
}
