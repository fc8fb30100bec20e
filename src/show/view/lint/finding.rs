//! A redundant constraint of a robot description in words, and files that were skipped.

use crate::format::plain::escape_line;
use crate::geom::vector::Vector;
use crate::redundancy::duplicate_constraints::HeldTwice;
use crate::redundancy::release::{Duplicate, Release, released_type};
use crate::robots::{ElementPlace, Origin};
use crate::view::prelude::*;

/// The verdict on a file without redundant constraints.
pub const NONE: &str = "no redundant constraints";

/// Remedies told of each finding.
const REMEDIES: usize = 3;
/// Joints named in a line.
const JOINTS: usize = 8;

/// A redundant constraint.
#[derive(Debug, Serialize)]
pub struct Finding {
    /// File, line and column of the element of the constraint. `None` if it comes from a separate file.
    pub file: Option<String>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
    /// The joint or coupling.
    pub constraint: String,
    /// Its row: x, y or z, a direction, a turn about one.
    pub row: String,
    /// The joints and couplings that hold the same.
    pub duplicates: Vec<String>,
    /// The contours that its self-stress goes round.
    pub contours: Vec<String>,
    /// Effect of an inaccurate part.
    pub assembly: String,
    /// How far the two frames of its joint are apart, where a CAD assembly places both.
    pub misfit: Option<Misfit>,
    /// The cheapest releases that remove it.
    pub remedies: Vec<String>,
    /// True if it is redundant over the motion, as far as is known. Otherwise it is at this pose only, which is harmless.
    pub lasts: bool,
    /// All that in a sentence.
    pub message: String,
}

/// A mechanism and its duplicate constraints, to be described.
pub(super) struct LintWords<'a> {
    pub(super) m: &'a Mechanism,
    pub(super) found: &'a HeldTwice,
}

/// Returns the duplicates of a constraint in a sentence; `a_row` is empty if `row` is not of a joint.
fn finding_message(
    constraint: &str,
    [a_row, row, assembly]: [&str; 3],
    duplicates: &[String],
    lasts: bool,
) -> String {
    let more = match duplicates.len().saturating_sub(JOINTS) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let shown = duplicates.iter().take(JOINTS).join(" / ");
    let head = format!("{constraint}, {a_row}{row} duplicates {shown}{more}");
    if lasts {
        format!("{head}; assembly {assembly}")
    } else {
        format!("{head} at this pose only")
    }
}

impl LintWords<'_> {
    fn coupling_name(&self, q: usize) -> String {
        let found = self.m.couplings_in(StateId::FREE).nth(q);
        found.map_or(String::new(), |c| c.name(self.m))
    }

    fn joint_name(&self, j: JointId) -> &str {
        &self.m.joints[j].id
    }

    /// Returns the finding of a duplicate row; `lasts` is true if it is redundant over the motion.
    pub(super) fn make_finding(
        &self,
        d: &Duplicate,
        lasts: bool,
        origin: Option<&Origin>,
    ) -> Finding {
        let (constraint, [a_row, row, assembly]) = self.describe_constraint(d.row);
        let joints = d.by.iter().map(|&j| self.joint_name(j).to_owned());
        let itself = |q: &&usize| d.row != Release::Coupling(**q);
        let couplings = d
            .couplings
            .iter()
            .filter(itself)
            .map(|&q| self.coupling_name(q));
        let duplicates: Vec<String> = joints.chain(couplings).collect();
        let contours = &self.found.analysis.per_contour;
        let contours = d.contours.iter().filter_map(|&k| contours.get(k));
        // What passes as the model moves needs none.
        let remedies = d.remedies.iter().take(if lasts { REMEDIES } else { 0 });
        let (place, of_joint): (Option<ElementPlace>, _) = match d.row {
            Release::Coupling(q) => (origin.and_then(|o| o.coupling_place(q)), None),
            Release::Freedom { joint, .. } => {
                (origin.and_then(|o| o.joint_place(joint)), Some(joint))
            }
        };
        let open = origin.and_then(|o| o.open_by(of_joint?));
        let open = open.map_or(String::new(), |o| format!("; its frames are {o} apart"));
        Finding {
            message: finding_message(&constraint, [&a_row, &row, &assembly], &duplicates, lasts)
                + &open,
            misfit: origin.and_then(|o| self.find_misfit(o, of_joint?)),
            lasts,
            file: place.as_ref().map(|p| p.file.clone()),
            line: place.as_ref().map(|p| p.at[0]),
            column: place.as_ref().map(|p| p.at[1]),
            contours: contours.map(|c| c.contour.name(self.m)).collect(),
            remedies: remedies.map(|&i| self.describe_remedy(i, origin)).collect(),
            constraint,
            row,
            duplicates,
            assembly,
        }
    }

    /// Describes a row of a joint, or a coupling. Has the name, "row " if it belongs to a joint, the row, and the effect of
    /// an inexact part.
    fn describe_constraint(&self, row: Release) -> (String, [String; 3]) {
        match row {
            Release::Coupling(q) => {
                let assembly = "a force or moment through the coupling".to_owned();
                (
                    self.coupling_name(q),
                    [String::new(), "the coupling".to_owned(), assembly],
                )
            }
            Release::Freedom {
                joint,
                slides,
                direction,
            } => {
                let line = direction_name(direction);
                let (row, assembly) = if slides {
                    (line.clone(), format!("force along {line}"))
                } else {
                    (format!("turn about {line}"), format!("moment about {line}"))
                };
                (
                    self.joint_name(joint).to_owned(),
                    ["row ".to_owned(), row, assembly],
                )
            }
        }
    }

    /// Returns the distance between the frames of a joint, in millimetres and degrees.
    fn find_misfit(&self, origin: &Origin, joint: JointId) -> Option<Misfit> {
        let [shift, turn] = origin.misfit(joint)?;
        let metres = self.m.length_unit.metres;
        Some(Misfit {
            millimetres: shift * metres * 1e3,
            degrees: turn.to_degrees(),
        })
    }

    /// Describes a remedy: "slide hinge along y: revolute -> cylindrical (cost 1.5)". For an assembly: "hinge: Revolute ->
    /// Cylindrical (cost 1.5)".
    pub(super) fn describe_remedy(&self, i: usize, origin: Option<&Origin>) -> String {
        let (milli, release) = &self.found.releases[i];
        let other = origin.and_then(|o| TypeChange::from_release(self.m, o, release));
        let words = other.map_or_else(
            || describe_release(self.m, release),
            |c| c.describe_change(),
        );
        format!("{words} (cost {})", format_cost(*milli))
    }
}

/// Describes a release: "let a slide along y: revolute -> cylindrical".
pub fn describe_release(m: &Mechanism, release: &Release) -> String {
    match *release {
        Release::Coupling(q) => {
            let found = m.couplings_in(StateId::FREE).nth(q);
            let name = found.map_or(String::new(), |c| c.name(m));
            format!("remove the coupling {name}")
        }
        Release::Freedom {
            joint,
            slides,
            direction,
        } => {
            let j = &m.joints[joint];
            let does = if slides { "slide along" } else { "turn about" };
            format!(
                "let {} {does} {}: {} -> {}",
                j.id,
                direction_name(direction),
                j.joint_type.name(),
                released_type(m, joint, slides, direction)
            )
        }
    }
}

/// Returns the name of a direction: "y", or "(0.6, 0.8, 0)".
fn direction_name(d: Vector) -> String {
    let axes = ["x", "y", "z"];
    let along = (0..3).find(|&i| d[i].abs() > 1.0 - 1e-9);
    match along {
        Some(i) => axes[i].to_owned(),
        None => format!("({})", d.map(three_digits).join(", ")),
    }
}

/// A file that could not be examined, or has nothing to examine. Every format lists it, so that the results of other files are not
/// lost.
#[derive(Debug, Clone, Serialize)]
pub struct PassedOver {
    /// Name of the file.
    pub file: String,
    /// Why, in a line.
    pub why: String,
    /// Whether nothing in it can move: then nothing is redundant, and nothing is wrong.
    pub rigid: bool,
}

impl PassedOver {
    /// Creates the record of a skipped file with its reason.
    pub fn new(file: &str, why: &str, rigid: bool) -> PassedOver {
        let line = why.lines().next().unwrap_or_default();
        // The file stands in front of the line already: `FILE:3:7: why`, `FILE: why` or `FILE is no such thing`.
        let named = line.strip_prefix(file).and_then(|rest| {
            let of_place = rest.strip_prefix(':').map(str::trim_start);
            of_place.or_else(|| rest.strip_prefix(" is "))
        });
        PassedOver {
            file: file.to_owned(),
            why: named.unwrap_or(line).to_owned(),
            rigid,
        }
    }

    /// Returns one line for people.
    pub fn text(&self) -> String {
        let (file, why) = (escape_line(&self.file), escape_line(&self.why));
        if self.rigid {
            format!("{file}: {NONE}: {why}\n")
        } else {
            format!("{file}: not examined: {why}\n")
        }
    }
}

/// Another type for a joint of a CAD assembly.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TypeChange {
    /// The joint.
    pub joint: String,
    /// Its type, as the CAD program calls it.
    pub from: String,
    /// Its new type.
    pub to: String,
}

impl TypeChange {
    /// Returns the type of a joint of an assembly after a release.
    pub(super) fn from_release(
        m: &Mechanism,
        origin: &Origin,
        release: &Release,
    ) -> Option<TypeChange> {
        let (joint, slides, direction) = release.added_freedom()?;
        TypeChange::at_joint(m, origin, joint, &[(slides, direction)])
    }

    /// Returns its type with more freedoms. Returns `None` if the file is not an assembly, or there is no such type.
    pub fn at_joint(
        m: &Mechanism,
        origin: &Origin,
        joint: JointId,
        more: &[(bool, Vector)],
    ) -> Option<TypeChange> {
        if !origin.is_assembly() {
            return None;
        }
        let now = origin.cad_type(joint, &[]);
        Some(TypeChange {
            joint: m.joints[joint].id.clone(),
            from: now.unwrap_or(m.joints[joint].joint_type.name()).to_owned(),
            to: origin.cad_type(joint, more)?.to_owned(),
        })
    }

    /// Describes a change: "Hinge: Revolute -> Ball".
    pub fn describe_change(&self) -> String {
        format!("{}: {} -> {}", self.joint, self.from, self.to)
    }
}

/// How far the two frames of a joint are apart in what the joint holds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Misfit {
    /// In millimetres.
    pub millimetres: f64,
    /// In degrees.
    pub degrees: f64,
}

/// Describes W with other joint types, if it is more than the current one.
pub(super) fn describe_then(now: usize, then: Option<usize>) -> String {
    match then {
        Some(w) if w > now => format!(" (W = {w}: a part may turn or slide by itself)"),
        _ => String::new(),
    }
}

/// Describes the freedoms as a CAD program counts them, in one line, if they differ.
pub(super) fn describe_count(counted: Option<i64>, mobility: usize) -> String {
    match counted {
        Some(n) if i64::try_from(mobility) != Ok(n) => format!(
            "  6 freedoms per part less all constraints would be {n}; the true number of freedoms is {mobility}\n"
        ),
        _ => String::new(),
    }
}
