//! Small mechanisms made of bytes, searched as the program does and by looking at every variant: the counts are the same.

use super::mechanism_files::told;
use super::slow_search::{Choice, Twin, all_variants, look_at_variant as look_at, suits_state};
use crate::common::*;
use ozols::Mechanism;
use ozols::search::answer::counts::Counts;
use ozols::search::check::brute::every_variant;
use ozols::search::solve::Diagrams;
use std::fmt::Write;

/// Variants looked at, at most.
const MOST: usize = 96;

const TYPES: [&str; 15] = [
    "revolute",
    "prismatic",
    "cylindrical",
    "universal",
    "spherical",
    "slotted",
    "planar",
    "cylindrical-universal",
    "sphere-in-cylinder",
    "cylinder-on-plane",
    "sphere-on-plane",
    "fixed",
    "helical",
    "custom",
    "revolute",
];
const CUSTOM: [&str; 4] = [
    "\"tx\"",
    "\"rz\", \"ry\"",
    "\"tx\", \"ty\"",
    "\"rx\", \"tz\"",
];
const AXES: [[i32; 3]; 8] = [
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, -2],
    [1, 2, -1],
    [0, 3, 4],
    [1, 1, 0],
    [1, 0, 1],
];

/// What is left of the bytes; nothing but zeros behind their end.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn next(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else {
            return 0;
        };
        self.0 = rest;
        first
    }

    fn below(&mut self, n: usize) -> usize {
        usize::from(self.next()) % n
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

/// The file of a mechanism.
fn mechanism(bytes: &mut Bytes<'_>) -> String {
    let mut out = String::from("name = \"x\"\n");
    if bytes.below(4) == 1 {
        out += "mode = \"planar\"\n";
    }
    let links = 2 + bytes.below(4);
    let two = bytes.below(2) == 1;
    let offered = bytes.next();
    let all = (0..8).filter(|i| offered >> i & 1 == 1).map(|i| TYPES[i]);
    writeln!(out, "[search]\noptions = {:?}", all.collect_vec()).unwrap();
    for l in 0..links {
        let role = match l {
            0 => "role = \"frame\"",
            _ if l == links - 1 || l == 1 && two => "role = \"output\"",
            _ => "",
        };
        writeln!(out, "[[link]]\nid = \"{l}\"\n{role}").unwrap();
    }
    let mut ends: Vec<[usize; 2]> = (1..links).map(|l| [bytes.below(l), l]).collect();
    let more = 1 + bytes.below(3);
    ends.extend((0..more).map(|_| [bytes.below(links), bytes.below(links)]));
    ends.retain(|[a, b]| a != b);
    for (i, [a, b]) in ends.into_iter().enumerate() {
        writeln!(out, "[[joint]]\nid = \"j{i}\"\nlinks = [\"{a}\", \"{b}\"]").unwrap();
        joint(bytes, &mut out);
    }
    out
}

/// The rest of a joint: its type, place, and what may become of it.
fn joint(bytes: &mut Bytes<'_>, out: &mut String) {
    let kind = bytes.one(&TYPES);
    writeln!(out, "type = {kind:?}").unwrap();
    if kind == "custom" {
        writeln!(out, "freedoms = [{}]", bytes.one(&CUSTOM)).unwrap();
    }
    if kind == "helical" {
        writeln!(out, "pitch = \"{}/2\"", 1 + bytes.below(3)).unwrap();
    }
    let point: [i32; 3] = std::array::from_fn(|_| bytes.below(7) as i32 - 3);
    writeln!(out, "point = {point:?}\naxis = {:?}", bytes.one(&AXES)).unwrap();
    let more = bytes.next();
    if more & 3 != 0 {
        // The mechanism's options are for few of them.
        out.push_str("options = []\n");
    }
    if more & 28 == 4 {
        writeln!(out, "reference = {:?}", bytes.one(&AXES)).unwrap();
    }
    match more >> 5 {
        1 => writeln!(out, "unloading = [{:?}]", bytes.one(&TYPES[..7])).unwrap(),
        2 => writeln!(
            out,
            "unloading = [{{ type = {:?}, point = [1, 0, 2] }}, \"spherical\"]",
            bytes.one(&TYPES[..7])
        )
        .unwrap(),
        _ => {}
    }
}

/// What is asked of the search.
fn conditions(bytes: &mut Bytes<'_>) -> Conditions {
    let some = |x: u8| (x & 4 != 0).then_some(x & 3);
    Conditions {
        max_redundant: bytes.below(3) as u32,
        keep_output: bytes.below(2) == 0,
        max_mobility: some(bytes.next()).map(i64::from),
        max_changes: some(bytes.next()).map(u32::from),
        ..Conditions::default()
    }
}

/// How many variants there are of each kind.
type Tally<K> = BTreeMap<K, String>;

fn tally<'f, K: Ord>(all: impl Iterator<Item = &'f Twin>, kind: impl Fn(&Twin) -> K) -> Tally<K> {
    let mut counts: BTreeMap<K, usize> = BTreeMap::new();
    for figures in all {
        *counts.entry(kind(figures)).or_default() += 1;
    }
    let words = counts.into_iter().map(|(k, n)| (k, n.to_string()));
    words.collect()
}

fn told_by<K: Ord + Clone, N: ToString>(counts: &BTreeMap<K, N>) -> Tally<K> {
    let words = counts.iter().map(|(k, n)| (k.clone(), n.to_string()));
    words.collect()
}

/// The counts of a diagram are those of the variants that are meant.
fn same(what: &str, counts: &Counts, seen: &[&Twin], text: &str) {
    let all = || seen.iter().copied();
    let both = told_by(&counts.by_mobility_and_changes);
    assert_eq!(
        both,
        tally(all(), |f| (f.mobility, f.changes)),
        "{what} by W and changes of\n{text}"
    );
    for (by, told, wanted) in [
        (
            "σ",
            told_by(&counts.by_redundant),
            tally(all(), |f| f.internal),
        ),
        (
            "f",
            told_by(&counts.by_freedoms),
            tally(all(), |f| f.freedoms),
        ),
        (
            "changes",
            told_by(&counts.by_changes),
            tally(all(), |f| f.changes),
        ),
    ] {
        assert_eq!(told, wanted, "{what} by {by} of\n{text}");
    }
    let by_mobility = told_by(&counts.by_mobility);
    assert_eq!(
        by_mobility,
        tally(all(), |f| f.mobility),
        "{what} by W of\n{text}"
    );
    assert_eq!(
        counts.total.to_string(),
        seen.len().to_string(),
        "{what} of\n{text}"
    );
}

/// Makes a mechanism, and searches it. Returns what was found.
pub(crate) fn look(bytes: &[u8]) -> String {
    let mut bytes = Bytes(bytes);
    let text = mechanism(&mut bytes);
    let m = match mechanism_from_str("x.toml", &text) {
        Ok(m) => m,
        Err(e) => return told(&e),
    };
    let size = m
        .joint_ids()
        .map(|j| m.joints[j].options.len() * (1 + m.joints[j].unloading.len()));
    if size.product::<usize>() > MOST {
        return "large".to_owned();
    }
    let all = all_variants(&m, false);
    let seen: Vec<Twin> = all.iter().map(|v| look_at(&m, false, v)).collect();
    let present = &seen[0];
    let found = &analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap()[0];
    assert_eq!(
        (
            found.mobility as i64,
            found.redundant,
            found.working_mobility
        ),
        (present.mobility, present.internal as usize, present.motion),
        "{text}"
    );
    let asked = conditions(&mut bytes);
    let search = match Search::new(exact_field(&m, 0).unwrap(), &m, asked) {
        Ok(search) => search,
        Err(e) => return e.to_string(),
    };
    let diagrams = assert_as_the_twins(&m, &search, &all, &seen, &text);
    let wanted = search.count_variants(&diagrams.admissible, true);
    format!("{wanted} of {} variants", all.len())
}

/// Asserts that a search counts just those variants that are meant, lists each of them once, the cheapest first, and says of each what
/// it has; the first variant is the mechanism as it is. Returns the diagrams of the search.
pub(crate) fn assert_as_the_twins(
    m: &Mechanism,
    search: &Search,
    all: &[Vec<Choice>],
    seen: &[Twin],
    text: &str,
) -> Diagrams {
    let asked = &search.conditions;
    assert_eq!(search.size().to_string(), all.len().to_string(), "{text}");
    let determinate = |f: &Twin| f.internal <= asked.max_redundant;
    let admissible = |f: &Twin| {
        determinate(f)
            && suits_state(asked.state, f)
            && (!asked.keep_output || f.motion == seen[0].motion)
            && asked.max_mobility.is_none_or(|most| f.mobility <= most)
            && asked.max_changes.is_none_or(|most| f.changes <= most)
    };
    let those = |is: &dyn Fn(&Twin) -> bool| seen.iter().filter(|f| is(f)).collect_vec();
    let diagrams = search.build_diagrams(Control::NONE);
    let first = search.count_variants(&diagrams.determinate, false);
    let second = search.count_variants(&diagrams.admissible, true);
    let wanted = those(&admissible);
    same("determinate", &first, &those(&determinate), text);
    same("admissible", &second, &wanted, text);
    let every = every_variant(search).unwrap();
    assert!(
        first == every.determinate && second == every.admissible,
        "{text}"
    );
    let mut last = 0;
    let mut given = Vec::new();
    for v in search.cheapest_variants(&diagrams, usize::MAX / 4) {
        let key = v.key;
        assert!(key.cost() >= last, "{text}");
        last = key.cost();
        let mut choices: Vec<Choice> = vec![(0, None); m.joints.len()];
        for (variable, &c) in search.space.variables.iter().zip(&v.choices) {
            let c = &variable.choices[c];
            choices[variable.joints[0].index()] = (c.option, c.unloading);
        }
        let at = all.iter().position(|a| *a == choices).unwrap();
        let f = &seen[at];
        assert!(admissible(f), "{choices:?} of\n{text}");
        assert_eq!(
            (
                key.internal(),
                key.external(),
                key.harmful(),
                key.freedoms(),
                key.changes()
            ),
            (f.internal, f.external, f.harmful, f.freedoms, f.changes),
            "{choices:?} of\n{text}"
        );
        given.push(at);
    }
    given.sort_unstable();
    given.dedup();
    assert_eq!(given.len(), wanted.len(), "{text}");
    diagrams
}

/// A mechanism of a few hinges, and what bytes in order come to.
pub(crate) fn seeds() -> Vec<Vec<u8>> {
    vec![vec![0; 60], (0..=120).collect()]
}
