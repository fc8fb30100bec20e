//! Names of links and joints: as they are declared, and as others refer to them.

use crate::file::Place;
use crate::file::schema::Words;
use crate::model::mechanism::{JointId, Link, LinkId, Mechanism, StateId};
use itertools::Itertools;

/// Most names listed where one is not known.
const LISTED: usize = 30;

impl Words {
    /// Returns the words as a list.
    pub(crate) fn list(&self) -> &[String] {
        match self {
            Words::One(word) => std::slice::from_ref(word),
            Words::Many(words) => words,
        }
    }
}

impl Place<'_> {
    /// Reports what is wrong with the name of an item. `twice` is true if another item has the same name.
    pub(crate) fn check_id(&self, what: &str, id: &str, twice: bool) {
        let at = self.key("id");
        if id.is_empty() || id.chars().count() > 64 || id.chars().any(char::is_control) {
            at.add(format!(
                "an id must have 1 to 64 characters and no control characters, not {id:?}"
            ));
        }
        if twice {
            at.add(used_twice(what, id));
        }
    }

    /// Returns the link with the given name; reports an unknown name.
    pub(crate) fn link(&self, links: &[Link], id: &str) -> Option<LinkId> {
        let found = links.iter().position(|l| l.id == *id).map(LinkId::new);
        if found.is_none() {
            let known = links.iter().take(LISTED).map(|l| l.id.as_str()).join(", ");
            self.add(format!("unknown link \"{id}\"; known links: {known}"));
        }
        found
    }

    /// Returns the joint with the given name; reports an unknown name.
    pub(crate) fn joint(&self, mechanism: &Mechanism, id: &str) -> Option<JointId> {
        let found = mechanism.joint(id);
        if found.is_none() {
            self.unknown_joint(mechanism, id);
        }
        found
    }

    /// Reports an unknown joint.
    pub(crate) fn unknown_joint(&self, mechanism: &Mechanism, id: &str) {
        let mut ids = mechanism.joints.iter().map(|j| j.id.as_str()).take(LISTED);
        let known = ids.join(", ");
        self.add(format!("unknown joint \"{id}\"; known joints: {known}"));
    }

    /// Returns the states that an entry names; `None` if it names none, which means all.
    pub(crate) fn states(&self, m: &Mechanism, named: Option<&Words>) -> Option<Vec<StateId>> {
        let mut found = Vec::new();
        for word in named?.list() {
            match m.state(word) {
                Some(state) => found.push(state),
                None => self.unknown("state", word, m.states.iter().take(LISTED)),
            }
        }
        Some(found)
    }
}

/// Returns the message of an id that two things have.
pub(crate) fn used_twice(what: &str, id: &str) -> String {
    format!("{what} id \"{id}\" is used twice; ids must be unique")
}
