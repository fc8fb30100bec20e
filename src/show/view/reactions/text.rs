//! Joint reactions in one pose for people.

use crate::statics::reactions::contact::{ContactForce, Touch};
use crate::statics::reactions::{JointReaction, NEARLY_SINGULAR, Uniqueness};
use crate::view::prelude::*;
use crate::view::reactions::couplings::{effort_unit, state_couplings, write_couplings};
use crate::view::reactions::{Reactions, is_possible, open_components, touch_word};

/// The remedy for a file that states no loads.
pub(super) const ADD_LOADS: &str =
    "give links a mass and centre and the [workload] gravity, or forces under [[workload.force]]";

/// The effect of misalignments if no redundant constraint is left.
pub(crate) const NO_STRAIN: &str = "Misalignments cause no reactions here: the mechanism is determinate and assembles without strain.";

/// Returns the sentence on a file that states no loads, but perhaps misalignments.
pub(crate) fn no_loads(misalignments: usize) -> String {
    let only = match misalignments {
        0 => String::new(),
        n => format!(" but {}", count_noun(n, "misalignment")),
    };
    format!("The file states no loads{only}: {ADD_LOADS}.")
}

/// Returns the remedy for contacts that would pull.
pub(super) fn pushing_remedy() -> String {
    format!(
        "{} solves with contacts that only push",
        typed_option("unilateral", "")
    )
}

/// Returns a number of self-stresses in words.
fn count_stresses(n: usize) -> String {
    let many = if n == 1 { "" } else { "es" };
    format!("{n} self-stress{many}")
}

impl Reactions<'_> {
    /// Returns the report, fitted to a terminal of `width` columns if one is given; `pose` in words.
    pub fn text(&self, pose: &str, width: Option<u16>) -> String {
        let (s, mut out) = (self.found, Report::new(width));
        self.write_head(&mut out, pose);
        self.write_refuted(&mut out);
        out.add_line(
            "Force of the first link on the second, in the joint frame (z = joint axis); moments about the joint's point\n",
        );
        if !self.is_unique() {
            out.add_line(self.left_open() + "\n");
        }
        self.write_loads(&mut out);
        self.write_joints(&mut out, &s.reactions);
        out.add_line("");
        if !s.contacts.is_empty() {
            self.write_contacts(&mut out);
        }
        write_couplings(&mut out, "Couplings", &self.couplings());
        for r in &s.reactions {
            let Some((freedom, effort)) = r.effort else {
                continue;
            };
            let unit = effort_unit(freedom);
            let what = if unit == "N" { "force" } else { "torque" };
            let (id, freedom, effort) = (
                self.joint_name(r.joint),
                freedom.name(),
                five_digits(effort),
            );
            out.add_line(format!(
                "Drive {id} holds {freedom}: {what} {effort} {unit}"
            ));
        }
        self.write_equilibrium(&mut out);
        if !s.self_stresses.is_empty() {
            let push = match s.choice {
                Uniqueness::Pushing => " with which contacts still push",
                _ => "",
            };
            out.add_line(format!(
                "\nThe redundant constraints leave these reactions undetermined: any combination of the {} may be added{push}; {} has them",
                count_stresses(s.self_stresses.len()),
                typed_option("format", "json")
            ));
        }
        self.write_elastic(&mut out);
        out.text()
    }

    fn write_joints(&self, out: &mut Report, list: &[JointReaction]) {
        let size = self.found.size;
        let each = list
            .iter()
            .map(|r| r.force_size().max(r.moment_size() / size));
        let (unit, n) = unit_prefix(each.fold(0.0, f64::max));
        let rows = list.iter().map(|r| {
            let mut row = self.joint_and_type(r.joint).to_vec();
            for ([x, y, z], size) in [(r.force, r.force_size()), (r.moment, r.moment_size())] {
                row.extend([x, y, z, size].map(|x| five_digits(x / unit)));
            }
            row
        });
        let heads = format!("joint |  | Fx | Fy | Fz | |F|, {n}N | Mx | My | Mz | |M|, {n}N·m");
        out.add_table(&heads, rows);
    }

    /// Adds the forces of the faces on objects.
    fn write_contacts(&self, out: &mut Report) {
        let list = &self.found.contacts;
        let greatest = list.iter().map(|c| c.normal.abs().max(c.along));
        let (unit, n) = unit_prefix(greatest.fold(0.0, f64::max));
        let show = |x: f64| five_digits(x / unit);
        let stated = |x: Option<f64>| x.map_or_else(|| "not stated".to_owned(), four_digits);
        let rows = list.iter().map(|c| {
            let [normal, along, tilting] = [c.normal, c.along, c.tilting].map(show);
            let [friction, radius] = [c.friction, c.radius].map(stated);
            let name = self.joint_name(c.joint);
            row_cells([
                &name,
                &touch_word(c),
                &normal,
                &along,
                &friction,
                &tilting,
                &radius,
            ])
        });
        out.add_table(
            &format!(
                "contact |  | normal, {n}N | along the face, {n}N | friction | tilting, {n}N·m | face radius, m"
            ),
            rows,
        );
        out.add_line("");
    }

    /// Adds contacts that would have to do what faces cannot.
    fn write_refuted(&self, out: &mut Report) {
        let words = |c: &ContactForce| {
            let (unit, prefix) = unit_prefix(c.normal.abs().max(c.along));
            let force = |x: f64| format!("{} {prefix}N", four_digits(x / unit));
            let limit = |x: Option<f64>| x.map_or_else(String::new, four_digits);
            let (normal, along) = (force(c.normal), force(c.along));
            match c.touch {
                Touch::Pulls => format!("would pull with {}", force(-c.normal)),
                Touch::Slips => format!(
                    "would need friction of {along} under {normal}, more than the coefficient {} gives",
                    limit(c.friction)
                ),
                _ => format!(
                    "would need its pressure beyond the face's radius of {} m",
                    limit(c.radius)
                ),
            }
        };
        let bad = self
            .found
            .contacts
            .iter()
            .filter(|c| !is_possible(c))
            .collect_vec();
        for c in &bad {
            out.add_line(format!(
                "NOT AS CONTACTS ACT: {} {}",
                self.joint_name(c.joint),
                words(c)
            ));
        }
        if !bad.is_empty() {
            let way = if self.is_unique() {
                "no other reactions are in equilibrium, so the object is not held".to_owned()
            } else {
                pushing_remedy()
            };
            out.add_line(format!("  contacts are taken as joints here; {way}"));
        }
    }

    /// Returns which components the choice within the family is about.
    fn left_open(&self) -> String {
        let joints = self.found.reactions.iter().zip(&self.found.open);
        let joints = joints.filter(|(_, open)| open.contains(&true));
        let alike = group_by_key(joints.map(|(r, open)| (open, self.joint_name(r.joint))));
        let each = alike.iter().map(|(open, joints)| {
            let open = join_and(&open_components(open));
            format!("{open} of {}", join_and(joints))
        });
        let passed = self.couplings().into_iter().zip(&self.found.couplings_open);
        let passed = passed
            .filter(|(_, open)| **open)
            .map(|(c, _)| c.name())
            .collect_vec();
        let passed = (!passed.is_empty()).then(|| format!("what {} pass", join_and(&passed)));
        format!(
            "Left open by the self-stresses: {}; all other components are unique",
            each.chain(passed).join("; ")
        )
    }

    /// Says which reactions these are, and whether numbers decide it.
    fn write_head(&self, out: &mut Report, pose: &str) {
        let s = self.found;
        let among = match s.choice {
            Uniqueness::Unique => None,
            Uniqueness::Pushing => Some("those in which contacts only push".to_owned()),
            Uniqueness::MinimumNorm => Some(format!(
                "a family with {}",
                count_stresses(s.self_stresses.len())
            )),
        };
        let what = among.map_or("the only ones in equilibrium".to_owned(), |among| {
            let size = five_digits(s.size);
            format!("of minimum norm among {among}: Σ |F|² + |M|²/ℓ² least, ℓ = {size} m")
        });
        let (name, state) = (&self.of.name, &self.of.states[self.state]);
        out.add_line(format!(
            "{name}, state {state}, {pose}: joint reactions, {what}"
        ));
        if let Some(n) = self.exact_self_stresses {
            out.add_line(format!(
                "NOT DECIDED BY NUMBERS: in exact geometry there are {}, and the difference is below what singular values tell from zero; look for points or axes that are nearly alike",
                count_stresses(n)
            ));
        }
    }

    /// Says which loads the reactions answer to, if a reader may expect others.
    fn write_loads(&self, out: &mut Report) {
        let (m, loads) = (self.of, &self.of.loads);
        let moving = loads.drive_speeds.iter().any(|s| *s != 0.0);
        if moving {
            out.add_line("Inertia forces of the stated drive speed included\n");
        }
        let accelerated = loads.gravity.is_some() || moving;
        let no_mass = m.links.iter().all(|l| l.mass.is_none()) || !accelerated;
        if no_mass && !loads.acts_from_outside(self.state) {
            out.add_line(no_loads(loads.misalignments.len()) + "\n");
        }
    }

    /// Says how well the equations are solved.
    fn write_equilibrium(&self, out: &mut Report) {
        let s = self.found;
        if s.undriven > 0 {
            let freedoms = count_noun(s.undriven, "freedom");
            out.add_line(format!(
                "{freedoms} left with the drives held, on which the loads do no work"
            ));
        }
        let (condition, residual) = (five_digits(s.condition), s.residual);
        out.add_line(format!(
            "Equilibrium: condition {condition}, residual {residual:.0e} of the load"
        ));
        if s.nearly_singular() {
            out.add_line(format!(
                "Warning: nearly singular (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
            ));
        }
    }

    /// Says which of the family elastic joints choose, or what to state to see it.
    fn write_elastic(&self, out: &mut Report) {
        let s = self.found;
        let (open, misalignments) = (s.self_stresses.len(), self.of.loads.misalignments.len());
        if let Some(list) = &s.elastic {
            let askew = match misalignments {
                0 => "no misalignment".to_owned(),
                n => count_noun(n, "misalignment"),
            };
            out.add_line(format!(
                "\nReactions of elastic joints of the stated stiffness, {askew}\n"
            ));
            self.write_joints(out, list);
            let coupled = s.elastic_couplings.as_deref().unwrap_or_default();
            let coupled = state_couplings(self.of, self.state, coupled);
            write_couplings(out, "Couplings, which are taken as rigid,", &coupled);
        } else if open > 0 && s.choice != Uniqueness::Pushing {
            out.add_line(
                "State [workload.stiffness.default] linear and angular, and [[workload.misalignment]], to compute the actual reactions.",
            );
        } else if open == 0 && misalignments > 0 {
            out.add_line(NO_STRAIN);
        }
    }
}
