//! The entries of a catalogue for a given structure.

use crate::catalog::store::{Store, StoreError};
use crate::chains::chain::{Chain, order_links};
use crate::chains::classics::MadeAs;
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::chains::{PairKind, graph6};
use itertools::Itertools;
use serde::Serialize;
use serde_json::Value;

/// A structure, its id and form first.
const STRUCTURES: &str = "SELECT id, concat_ws(' ', input, symmetry, iif(parallel, 'parallel', NULL), iif(name LIKE '% flat', 'flat', NULL), \
     iif(name LIKE '% threaded', 'threaded', NULL), iif(name LIKE '% pin%', 'on one pin:' || replace(substr(name, instr(name, ' pin')), ' pin', ' '), NULL)), \
     chain, input, frame, driver, jaw_a, jaw_b, jaw_c, code, driven_from FROM structures LEFT JOIN pairs ON structure = id WHERE links = ?1 ORDER BY symmetry = 'generic', parallel, id";

/// A structure of a catalogue.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Entry {
    /// Its short name.
    pub id: String,
    /// Its layout, in words.
    pub form: String,
}

/// Returns the entries of a catalogue for a structure, in any form, symmetric ones first.
///
/// # Errors
/// Returns an error if the database cannot be read.
///
/// # Complexity
/// One canonical numbering for each structure with the same number of links.
pub fn find_entries(
    store: &Store,
    structure: &PairStructure,
    made_as: MadeAs,
) -> Result<Vec<Entry>, StoreError> {
    let key = structure.canonical_key();
    let links = structure.chain.links().to_string();
    let (_, rows) = store.query_rows(STRUCTURES, Some(&links))?;
    let same = |row: &&Vec<Value>| read_structure(row).is_some_and(|s| s.canonical_key() == key);
    let found = rows.iter().filter(same).map(|r| Entry::new(r));
    // A screw is not a pinion. Other forms of the same structure follow those made in the same way.
    let alike = found.filter(|e| e.has_word("threaded") == made_as.threaded);
    let other = |e: &Entry| {
        let pins = e.has_word("on one pin") != made_as.jaws_on_one_pin;
        pins || e.has_word("flat") != made_as.flat
    };
    Ok(alike.sorted_by_key(other).collect())
}

impl Entry {
    /// Creates the entry of a row that begins with id and form.
    fn new(row: &[Value]) -> Entry {
        let word = |v: &Value| v.as_str().unwrap_or_default().to_owned();
        Entry {
            id: word(&row[0]),
            form: word(&row[1]),
        }
    }

    fn has_word(&self, word: &str) -> bool {
        self.form.contains(word)
    }
}

/// Returns the structure of a row that begins as those of [`STRUCTURES`].
fn read_structure(row: &[Value]) -> Option<PairStructure> {
    let chain = graph6::read_graph(row.get(2)?.as_str()?).ok()?;
    let slides = row.get(3)?.as_str()? == "slide";
    let link = |i: usize| usize::try_from(row.get(i)?.as_u64()?).ok();
    let (frame, driver) = (link(4)?, link(5)?);
    let input = order_links([link(10).unwrap_or(frame), driver]);
    let jaws = [link(6)?, link(7)?].into_iter().chain(link(8));
    Some(PairStructure {
        chain: match row.get(9)?.as_str() {
            Some(code) => Chain::of_code(chain.links(), code)?,
            None => {
                if slides {
                    chain.with_pair(input, PairKind::Slide)
                } else {
                    chain
                }
            }
        },
        roles: Roles {
            frame,
            input,
            jaws: jaws.sorted().collect(),
        },
    })
}
