//! Ideas against a slow twin: every variant listed, its pattern made of cycles found by walking.

use crate::common::*;
mod minimal;
mod named;
mod textbook;
mod toggle;
mod why;

use ozols::search;
use ozols::search::answer::ideas::Idea;

/// The freedoms of an option by what they are and where they point, either way.
fn freedoms(o: &JointOption) -> Vec<(bool, [i64; 3])> {
    let one = |f: &Freedom| {
        #[allow(clippy::cast_possible_truncation, reason = "a unit vector")]
        let d = direction_of(&o.frame, *f).map(|c| (c * 1e5).round() as i64);
        let back = d.iter().find(|c| **c != 0).is_some_and(|c| *c < 0);
        (f.is_turn(), if back { d.map(|c| -c) } else { d })
    };
    o.joint_type.freedoms().iter().map(one).collect()
}

type Pattern = BTreeMap<(BTreeSet<JointId>, (bool, [i64; 3])), usize>;

struct Twin<'o> {
    outcome: &'o Outcome,
    series: BTreeMap<JointId, BTreeSet<JointId>>,
}

impl<'o> Twin<'o> {
    fn new(outcome: &'o Outcome) -> Twin<'o> {
        let m = &outcome.search.mechanism;
        let cycles = simple_cycles(m, StateId::FREE);
        let on = |j: JointId| cycles.iter().map(|c| c.contains(&j)).collect_vec();
        let series = |j: JointId| {
            m.joints_in(StateId::FREE)
                .filter(|&k| on(k) == on(j))
                .collect()
        };
        let series = m.joints_in(StateId::FREE).map(|j| (j, series(j))).collect();
        Twin { outcome, series }
    }

    /// The pattern, with each joint become its image; freedoms point the same way after these mirrors.
    fn pattern(&self, v: &Assignment, images: &[(&str, &str)]) -> Pattern {
        let m = &self.outcome.search.mechanism;
        let image = |j: JointId| {
            let id = m.joints[j].id.as_str();
            let pair = images.iter().find(|p| p.0 == id || p.1 == id);
            let to = pair.map(|&(a, b)| if a == id { b } else { a });
            m.joint_named(to.unwrap_or(id)).unwrap()
        };
        let mut out = Pattern::new();
        for (variable, &choice) in self.outcome.search.space.variables.iter().zip(&v.choices) {
            let [j] = variable.joints[..] else { panic!() };
            let joint = &m.joints[j];
            let mut added = freedoms(&joint.options[variable.choices[choice].option]);
            for f in freedoms(&joint.options[0]) {
                let at = added.iter().position(|a| *a == f).unwrap();
                added.remove(at);
            }
            let series: BTreeSet<JointId> = self.series[&j].iter().map(|&k| image(k)).collect();
            for f in added {
                *out.entry((series.clone(), f)).or_default() += 1;
            }
        }
        out
    }
}

/// Whether a variant has all the freedoms of another, at joints that cost and change no less, and more of them.
fn is_beyond(outcome: &Outcome, a: &Assignment, b: &Assignment) -> bool {
    let space = &outcome.search.space;
    let (mut within, mut less) = (true, false);
    for (v, (&x, &y)) in space.variables.iter().zip(a.choices.iter().zip(&b.choices)) {
        let joint = &outcome.search.mechanism.joints[v.joints[0]];
        let [x, y] = [x, y].map(|c| &v.choices[c]);
        let of = |c: &ozols::search::question::space::Choice| -> BTreeSet<_> {
            freedoms(&joint.options[c.option]).into_iter().collect()
        };
        let (p, q) = (of(x), of(y));
        within &= q.is_subset(&p) && y.cost_milli <= x.cost_milli && y.changes <= x.changes;
        less |= p != q;
    }
    within && less
}

/// What an engineer leaves as it is, if he can: the drive, pivots in the frame, what is no rod's end.
fn weight(m: &Mechanism, outcome: &Outcome, v: &Assignment) -> u64 {
    let joints_at = |l| m.joints.iter().filter(move |j| j.links.contains(&l));
    let frame = m.frame_link();
    let rod = |l| {
        let ends = joints_at(l).collect_vec();
        let inner = m.links[l].role == Role::Inner;
        inner && ends.len() == 2 && ends.iter().all(|j| !j.links.contains(&frame))
    };
    let variables = outcome.search.space.variables.iter().zip(&v.choices);
    let changed = variables
        .filter(|(_, c)| **c != 0)
        .map(|(v, _)| &m.joints[v.joints[0]]);
    changed
        .map(|j| {
            let place = match j.links {
                [a, b] if a == frame || b == frame => 2,
                [a, b] if rod(a) || rod(b) => 0,
                _ => 1,
            };
            place + 4 * u64::from(j.drive)
        })
        .sum()
}

/// How many joints are not changed as their images are.
fn unlike(outcome: &Outcome, v: &Assignment, images: &[(&str, &str)]) -> usize {
    let m = &outcome.search.mechanism;
    let choice = |id: &str| {
        let j = m.joint_named(id).unwrap();
        let at = outcome
            .search
            .space
            .variables
            .iter()
            .position(|x| x.joints == [j]);
        v.choices[at.unwrap()]
    };
    2 * images
        .iter()
        .filter(|(a, b)| choice(a) != choice(b))
        .count()
}

/// How many kinds of joints a variant puts in.
fn kinds(outcome: &Outcome, v: &Assignment) -> usize {
    let m = &outcome.search.mechanism;
    let chosen = outcome.search.space.variables.iter().zip(&v.choices);
    let put = chosen.filter(|(_, c)| **c != 0).map(|(variable, &c)| {
        let option = variable.choices[c].option;
        &m.joints[variable.joints[0]].options[option].name
    });
    put.unique().count()
}

fn agrees(m: &Mechanism, request: &Request, images: &[(&str, &str)]) {
    let outcome = search(m, request).unwrap();
    let diagrams = outcome.diagrams.as_ref().unwrap();
    let twin = Twin::new(&outcome);
    let all = outcome
        .search
        .cheapest_variants(diagrams, usize::MAX)
        .collect_vec();
    assert_eq!(outcome.admissible.total, BigUint::from(all.len()));
    let minimal = all
        .iter()
        .filter(|v| !all.iter().any(|w| is_beyond(&outcome, v, w)));
    let mut classes: BTreeMap<Pattern, Vec<&Assignment>> = BTreeMap::new();
    for v in minimal {
        let (own, image) = (twin.pattern(v, &[]), twin.pattern(v, images));
        classes.entry(own.min(image)).or_default().push(v);
    }
    let rank = |v: &Assignment| {
        let weight = weight(m, &outcome, v);
        let (w, changes) = (outcome.search.mobility(v.key), v.key.changes());
        (
            v.key.cost(),
            unlike(&outcome, v, images),
            weight,
            w,
            changes,
        )
    };
    let ideas = outcome.search.list_ideas(diagrams, classes.len() + 3);
    assert_eq!(ideas.len(), classes.len());
    let mut before = None;
    for idea in &ideas {
        let (own, image) = (
            twin.pattern(&idea.first, &[]),
            twin.pattern(&idea.first, images),
        );
        let members = classes.remove(&own.min(image)).unwrap();
        assert!(members.contains(&&idea.first));
        assert_eq!(idea.variants, BigUint::from(members.len()));
        // What an image makes of a variant is as good.
        let best = members.iter().map(|v| rank(v)).min().unwrap();
        assert_eq!(rank(&idea.first), best);
        let cheap = members.iter().filter(|v| v.key.cost() == best.0);
        let least = cheap.map(|v| weight(m, &outcome, v)).min().unwrap();
        let symmetric = unlike(&outcome, &idea.first, images) == 0;
        assert_eq!(idea.symmetric, (!images.is_empty()).then_some(symmetric));
        let place = Some((best.0, !symmetric, kinds(&outcome, &idea.first), least));
        assert!(before <= place, "{before:?} {place:?}");
        before = place;
    }
    for top in [1, 7] {
        let few = outcome.search.list_ideas(diagrams, top);
        let firsts = |list: &[Idea]| list.iter().map(|i| i.first.clone()).collect_vec();
        assert_eq!(firsts(&few), firsts(&ideas[..top.min(ideas.len())]));
    }
}

#[test]
fn ideas_are_those_of_a_list_of_all_variants() {
    let names = |n: &[&str]| n.iter().map(|&s| s.to_owned()).collect();
    for (name, options, max_mobility, images) in [
        ("four-bar", &[][..], None, &[][..]),
        ("four-bar", &[], Some(1), &[]),
        (
            "parallelogram-3-rods",
            &["spherical", "cylindrical"],
            Some(1),
            &[],
        ),
        ("slider-crank-spatial", &[], None, &[]),
        (
            "stephenson-six-bar",
            &["spherical", "cylindrical"],
            None,
            &[],
        ),
    ] {
        let m = built_in(name);
        let request = default_with(|r: &mut Request| {
            (r.options, r.max_mobility) = (names(options), max_mobility)
        });
        agrees(&m, &request, images);
    }
    let gripper = built_in("gripper-10");
    let request = default_with(|r: &mut Request| {
        (r.options, r.max_mobility) = (names(&["spherical", "sphere-in-cylinder"]), Some(1))
    });
    let id = |j: JointId| gripper.joints[j].id.as_str();
    let free = gripper.joints_in(StateId::FREE).collect_vec();
    let pairs = gripper.search.mirror.iter().filter(|p| free.contains(&p.0));
    let pairs = pairs.map(|&(a, b)| (id(a), id(b))).collect_vec();
    agrees(&gripper, &request, &pairs);
}

/// Of what a small budget leaves out some may be cheaper, and less than what it finds: an idea then stands for all that is known,
/// minimal or not.
#[test]
fn of_a_search_cut_short_ideas_are_bounds_and_none_is_proven_the_cheapest() {
    let line = "search gripper-10 --distinct --top 3";
    let whole = run_json(&format!("{line} --format json"));
    let cut = run_json(&format!("{line} --nodes 60 --format json"));
    assert_eq!(cut["variants_proven"], Value::Null);
    for (data, exact) in [(&whole, true), (&cut, false)] {
        let ideas = data["variants"].list().iter().map(|v| &v["idea"]);
        assert!(ideas.clone().all(|i| i["exact"] == exact));
        assert_eq!(ideas.count(), 3);
    }
    let known = |of: &Value, n: usize| parse_count(&of["variants"][n]["idea"]["variants"]);
    assert_eq!(known(&whole, 2), 840);
    assert!((0..3).all(|n| known(&cut, n) > 0));
}

/// The ways of sharing out the freedoms of the cheapest redesign of the gripper: each half alike.
#[test]
fn an_idea_says_what_is_added_where() {
    let gripper = built_in("gripper-10");
    let request = default_with(|r: &mut Request| r.max_mobility = Some(1));
    let outcome = search(&gripper, &request).unwrap();
    let ideas = outcome
        .search
        .list_ideas(outcome.diagrams.as_ref().unwrap(), 20);
    // 11 redundant constraints, one of which is the turn of the slider that the rods share: 11 freedoms are added.
    for idea in &ideas {
        let added: u32 = idea.added.iter().map(|a| u32::from(a.times)).sum();
        assert_eq!(added, 11);
        assert!(idea.variants > BigUint::from(1u8));
        assert!(idea.added.iter().all(|a| {
            ["turn about x", "turn about y", "slide along z"].contains(&a.freedom.as_str())
        }));
    }
}

/// The text gives ideas where all variants are counted and the list is a short one, and says how to go on with them.
#[test]
fn people_are_told_ideas_and_programs_variants() {
    let search = |more: &str| run_successful(&format!("search four-bar --quiet {more}")).0;
    let plain = search("");
    assert_eq!(plain, search("--distinct"));
    has(&plain, "stands for");
    lacks(&search("--no-distinct"), "stands for");
    let idea = |more: &str| -> Value {
        let said = search(&format!("--format json {more}"));
        let found: Value = serde_json::from_str(&said).unwrap();
        found["variants"][0]["idea"].clone()
    };
    assert!(idea("").is_null());
    assert!(idea("--distinct").is_object());
    let exported = |which: &str| run_successful(&format!("export four-bar --to toml {which}")).0;
    assert_eq!(exported("--idea 2"), exported("--distinct --variant 2"));
    assert_ne!(exported("--idea 2"), exported("--variant 2"));
    assert_fails("draw four-bar --idea 2 --variant 2", "");
}
