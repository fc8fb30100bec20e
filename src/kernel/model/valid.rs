//! Conditions that the parts of a mechanism must satisfy.

use crate::geom::expr::Expr;
use crate::model::mechanism::{Joint, LinkId, Mechanism, Mode, Parts, Role, StateId};
use petgraph::unionfind::UnionFind;
use std::collections::BTreeSet;
use std::ops::{Deref, DerefMut};

/// A contradiction between the parts of a mechanism.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidMechanism {
    /// Not exactly one link is the frame.
    #[error("a mechanism has exactly one frame, not {0}")]
    Frames(usize),
    /// The first state is not the free one.
    #[error("the first state is \"free\"")]
    FreeState,
    /// Two links, joints or states have one id.
    #[error("{what} \"{id}\" exists twice; rename one of them")]
    Twice {
        /// Link, joint or state.
        what: &'static str,
        /// The id.
        id: String,
    },
    /// An index is larger than its list.
    #[error("{0} refers to a link, joint or state that does not exist")]
    Dangling(String),
    /// A direction is zero.
    #[error("the {what} of {of} is zero; give it a direction")]
    Zero {
        /// Axis, reference or normal.
        what: &'static str,
        /// The joint, or the plane.
        of: String,
    },
    /// A link of a joint is not connected to the frame.
    #[error(
        "link \"{link}\" is not connected to the frame in state {state}; add the missing joint, or remove the link"
    )]
    Disconnected {
        /// The link.
        link: String,
        /// The state.
        state: String,
    },
}

impl Mechanism {
    /// Creates a mechanism.
    ///
    /// # Guarantee
    /// It has one frame; the free state is the first; ids are unique; links, joints and states that are referred to exist;
    /// axes, references and the normal of the plane are not zero; and in each state every link that has a joint is connected
    /// to the frame.
    ///
    /// # Errors
    /// Returns the first contradiction.
    ///
    /// # Complexity
    /// O(states · (links + joints) + joints log joints).
    ///
    /// # Examples
    /// ```
    /// use ozols::model::{mechanism::Mechanism, valid::InvalidMechanism};
    /// let mut parts = ozols::built_in("four-bar")?.into_parts();
    /// parts.joints[0].drive = false;
    /// let undriven = Mechanism::new(parts)?;
    ///
    /// let mut parts = undriven.into_parts();
    /// parts.links[0].role = ozols::model::mechanism::Role::Inner;
    /// assert_eq!(Mechanism::new(parts).unwrap_err(), InvalidMechanism::Frames(0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(parts: Parts) -> Result<Mechanism, InvalidMechanism> {
        check(&parts).map(|()| Mechanism(parts))
    }

    /// Returns the parts for a change. They are checked when it is dropped.
    ///
    /// # Panics
    /// Panics when it is dropped, if the change breaks a guarantee of [`Mechanism::new`].
    ///
    /// # Examples
    /// ```
    /// let mut m = ozols::built_in("four-bar")?;
    /// m.edit().name = "mine".to_owned();
    /// assert_eq!(m.name, "mine");
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn edit(&mut self) -> Edit<'_> {
        Edit(&mut self.0)
    }
}

/// The parts of a mechanism under change; see [`Mechanism::edit`].
#[derive(Debug)]
pub struct Edit<'a>(&'a mut Parts);

impl Deref for Edit<'_> {
    type Target = Parts;

    fn deref(&self) -> &Parts {
        self.0
    }
}

impl DerefMut for Edit<'_> {
    fn deref_mut(&mut self) -> &mut Parts {
        self.0
    }
}

impl Drop for Edit<'_> {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            check(self.0).expect("a change keeps a mechanism valid");
        }
    }
}

fn check(parts: &Parts) -> Result<(), InvalidMechanism> {
    let frames = parts.links.iter().filter(|l| l.role == Role::Frame).count();
    if frames != 1 {
        return Err(InvalidMechanism::Frames(frames));
    }
    if parts.states.first().is_none_or(|s| s != "free") {
        return Err(InvalidMechanism::FreeState);
    }
    check_unique("link", parts.links.iter().map(|l| &l.id))?;
    check_unique("joint", parts.joints.iter().map(|j| &j.id))?;
    check_unique("state", parts.states.iter())?;
    check_references(parts)?;
    for joint in &parts.joints {
        check_axes(joint)?;
    }
    if let Mode::Planar { normal } = &parts.mode {
        check_direction("normal", "the plane", normal)?;
    }
    for state in parts.state_ids() {
        check_connected(parts, state)?;
    }
    Ok(())
}

fn check_unique<'a>(
    what: &'static str,
    ids: impl Iterator<Item = &'a String>,
) -> Result<(), InvalidMechanism> {
    let mut seen = BTreeSet::new();
    for id in ids {
        if !seen.insert(id) {
            let id = id.clone();
            return Err(InvalidMechanism::Twice { what, id });
        }
    }
    Ok(())
}

fn check_references(parts: &Parts) -> Result<(), InvalidMechanism> {
    let (links, joints) = (parts.links.len(), parts.joints.len());
    let states = parts.states.len();
    let dangling = |of: String| Err(InvalidMechanism::Dangling(of));
    for joint in &parts.joints {
        let present = joint.states.iter().flatten();
        if joint.links.iter().any(|l| l.index() >= links)
            || present.clone().any(|s| s.index() >= states)
        {
            return dangling(format!("joint \"{}\"", joint.id));
        }
    }
    if parts.contours.iter().flatten().any(|j| j.index() >= joints) {
        return dangling("a contour".to_owned());
    }
    let coupled = parts.couplings.iter().flat_map(|c| &c.ends);
    if coupled.into_iter().any(|e| e.joint.index() >= joints) {
        return dangling("a coupling".to_owned());
    }
    match parts.points.iter().find(|p| p.link.index() >= links) {
        Some(p) => dangling(format!("point \"{}\"", p.id)),
        None => Ok(()),
    }
}

fn check_axes(joint: &Joint) -> Result<(), InvalidMechanism> {
    let of = || format!("joint \"{}\"", joint.id);
    check_direction("axis", &of(), &joint.frame.axis)?;
    check_direction("reference", &of(), &joint.frame.reference)
}

fn check_direction(what: &'static str, of: &str, v: &[Expr; 3]) -> Result<(), InvalidMechanism> {
    if v.iter().any(|c| c.to_f64() != 0.0) {
        return Ok(());
    }
    Err(InvalidMechanism::Zero {
        what,
        of: of.to_owned(),
    })
}

/// Checks that every link that has a joint in a state is connected to the frame.
fn check_connected(parts: &Parts, state: StateId) -> Result<(), InvalidMechanism> {
    let mut sets = UnionFind::<usize>::new(parts.links.len());
    for j in parts.joints_in(state) {
        let [a, b] = parts.joints[j].links.map(LinkId::index);
        sets.union(a, b);
    }
    let frame = parts.frame_link().index();
    match parts
        .links_in(state)
        .find(|l| !sets.equiv(l.index(), frame))
    {
        Some(l) => Err(InvalidMechanism::Disconnected {
            link: parts.links[l].id.clone(),
            state: parts.states[state].clone(),
        }),
        None => Ok(()),
    }
}
