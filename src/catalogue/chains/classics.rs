//! Gripper schemes that are well known, as structures.

use crate::chains::PairKind;
use crate::chains::canonical::Weighted;
use crate::chains::chain::{Chain, Joint, order_links};
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use itertools::Itertools;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

const TEXT: &str = include_str!("classics.toml");

/// A scheme that is well known.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Classic {
    /// Its id.
    pub id: String,
    /// Its description.
    pub about: String,
    /// Its structure, with flat faces as slots.
    #[serde(skip)]
    pub structure: PairStructure,
    /// Properties in addition to its structure.
    #[serde(skip)]
    pub made_as: MadeAs,
}

/// Properties of a gripper in addition to its structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct MadeAs {
    /// Its slots are flat faces, which are redundant even in the plane.
    pub flat: bool,
    /// Its jaws turn in the frame on one pin.
    pub jaws_on_one_pin: bool,
    /// Its pinion is a screw, its racks are nuts: in the plane these do the same.
    pub threaded: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    about: String,
    pairs: String,
    input: String,
    jaws: String,
    #[serde(default)]
    flat: bool,
    #[serde(default)]
    jaws_on_one_pin: bool,
    #[serde(default)]
    threaded: bool,
}

impl Written {
    /// Returns the structure, or `None` if the entry is invalid.
    fn read_structure(&self) -> Option<PairStructure> {
        let pairs = self.pairs.split(", ").map(|p| p.split(' ').collect_tuple());
        let pairs: Vec<(&str, &str, &str)> = pairs.collect::<Option<_>>()?;
        let names = pairs.iter().flat_map(|p| [p.0, p.1]).unique().collect_vec();
        let place = |name: &str| names.iter().position(|n| *n == name);
        let two = |a: &str, b: &str| Some(order_links([place(a)?, place(b)?]));
        let both = |words: &str| words.split_once(' ').and_then(|(a, b)| two(a, b));
        let joint = |&(a, b, kind): &(&str, &str, &str)| {
            let pair = PairKind::of_letter(kind.parse().ok()?)?;
            let links = two(a, b)?;
            Some(Joint { links, pair })
        };
        let joints: Vec<Joint> = pairs.iter().map(joint).collect::<Option<_>>()?;
        Some(PairStructure {
            roles: Roles {
                frame: place("f")?,
                input: both(&self.input)?,
                jaws: both(&self.jaws)?.to_vec(),
            },
            chain: Chain::new(names.len(), joints),
        })
    }
}

/// All schemes by id, with their keys.
static ALL: LazyLock<(Vec<Classic>, Vec<Weighted>)> = LazyLock::new(|| {
    let all: BTreeMap<String, Written> = toml::from_str(TEXT).expect("a test reads it");
    let classic = |(id, entry): (String, Written)| Classic {
        structure: entry.read_structure().expect("a test reads it"),
        about: entry.about,
        made_as: MadeAs {
            flat: entry.flat,
            jaws_on_one_pin: entry.jaws_on_one_pin,
            threaded: entry.threaded,
        },
        id,
    };
    let all: Vec<Classic> = all.into_iter().map(classic).collect();
    let keys = all.iter().map(|c| c.structure.canonical_key()).collect();
    (all, keys)
});

/// Returns all schemes by id.
///
/// # Panics
/// Never: the text is part of the program, and a test reads it.
///
/// # Examples
/// ```
/// use ozols::chains::classics::known_classics;
/// assert_eq!(known_classics().len(), 34);
/// ```
#[must_use]
pub fn known_classics() -> &'static [Classic] {
    &ALL.0
}

/// Returns the schemes with a structure of this key and these properties.
pub fn classics_of(key: &Weighted, made_as: MadeAs) -> impl Iterator<Item = &'static Classic> {
    let (all, keys) = &*ALL;
    let same = keys.iter().positions(move |k| k == key);
    same.map(|i| &all[i]).filter(move |c| c.made_as == made_as)
}
