//! Redesigns that keep the motion throughout, against every variant looked at one by one and against poses reached numerically.
//!
//! The poses share nothing with the power series: they are reached by Newton's method in doubles, and ranks there are singular values.

use crate::common::*;
use crate::search::varied::random;
use ozols::search::answer::everywhere::count_everywhere;
use ozols::search::check::brute::{Matrices, Seen, judge_variant};
use ozols::search::check::other_poses::reach_poses;
use ozols::search::check::singular_values::certify_variants;
use ozols::search::diagram::Diagram;
use ozols::search::question::throughout::PoseOnly;

/// Returns a search over the prime that is the `nth`, which is asked what lasts.
fn search(m: &Mechanism, nth: usize, symmetry: Symmetry) -> Search {
    let conditions =
        default_with(|c: &mut Conditions| (c.throughout, c.symmetry) = (true, symmetry));
    Search::new(exact_field(m, nth).unwrap(), m, conditions).unwrap()
}

/// Returns how many variants are admissible in the drawn pose and throughout, counted on the diagram; over both primes, and one by one
/// where there are few.
fn counted(m: &Mechanism) -> [u64; 2] {
    let both = [0, 1].map(|nth| {
        let search = search(m, nth, Symmetry::All);
        let diagrams = search.build_diagrams(Control::NONE);
        let lasting = diagrams.lasting.as_ref().unwrap();
        let here = search.count_variants(&diagrams.admissible, true);
        let lasting = search.count_variants(lasting, true);
        if nth == 0 && search.size() <= 4096u32.into() {
            let all = every_variant(&search).unwrap();
            assert_eq!(all.admissible, here, "{}", m.name);
            assert_eq!(all.lasting.as_ref(), Some(&lasting), "{}", m.name);
        }
        [here, lasting]
    });
    assert_eq!(
        both[0], both[1],
        "{}: another prime, another direction",
        m.name
    );
    let [here, lasting] = &both[0];
    [here, lasting].map(|c| u64::try_from(&c.total).unwrap())
}

/// Asserts that just those variants last whose figures are the same in other poses.
fn assert_as_in_poses(m: &Mechanism, poses: usize) {
    let search = search(m, 0, Symmetry::All);
    let diagrams = search.build_diagrams(Control::NONE);
    let lasting: BTreeSet<Vec<usize>> = search
        .cheapest_variants(&diagrams, usize::MAX / 4)
        .map(|v| v.choices)
        .collect();
    let (here, diagrams) = searched(m, Conditions::default());
    let all = here.cheapest_variants(&diagrams, 1000).collect();
    let stroke = reach_poses(&here, poses, 1, &|| false).unwrap();
    for v in certify_variants(&here, all, false, Some(&stroke), &|| false) {
        let Some(lucky) = v.stroke.and_then(|s| s.is_lucky()) else {
            continue;
        };
        let lasts = lasting.contains(&v.variant.choices);
        assert_eq!(lasts, !lucky, "{}: {:?} {:?}", m.name, v.variant, v.stroke);
    }
}

/// The counts of a trial in another language, over another prime field, that looked at every variant.
#[test]
fn counts_along_the_motion_are_those_of_the_trial() {
    for (name, here, lasting) in [
        ("watt-six-bar", 325, 269),
        ("sarrus", 6, 5),
        ("four-bar", 14, 14),
        ("two-bennetts", 357, 306),
        ("altmann", 21, 14),
        ("hooke-double", 16, 4),
        ("oldham", 5, 5),
        ("3-crr", 12, 12),
        ("roberval-balance", 17, 14),
        ("watt-straight-line", 17, 14),
        ("stephenson-six-bar", 281, 281),
        ("hart-inversor", 190, 190),
        ("scissor-lift", 82, 82),
        ("geared-five-bar", 31, 31),
        ("lever-slot-gripper", 16, 16),
        ("peaucellier", 6_791, 6_179),
        ("tripteron", 47, 27),
        ("parallelogram-gripper", 146_260, 144_436),
        ("gripper-10", 25_761_436, 21_817_629),
    ] {
        let m = built_in(name);
        assert_eq!(counted(&m), [here, lasting], "{name}");
    }
}

#[test]
fn variants_last_whose_figures_are_the_same_in_other_poses() {
    for name in split_words(
"watt-six-bar sarrus altmann hooke-double tripteron 4-upu exechon delta two-bennetts roberval-balance oldham
            geared-five-bar five-bar",
) {
        assert_as_in_poses(&built_in(name), 4);
    }
}

/// Returns the diagram of the variants that last.
fn lasting_of(diagrams: &Diagrams) -> &Diagram {
    diagrams.lasting.as_ref().unwrap()
}

/// Returns the choices of every variant of a search.
fn every_choice(search: &Search) -> impl Iterator<Item = Vec<usize>> {
    let radix = search.space.variables.iter().map(|v| 0..v.choices.len());
    radix.multi_cartesian_product()
}

/// Returns how many variants work in poses next to the drawn one, counted by two spans side by side.
fn count_beside(m: &Mechanism) -> u64 {
    let both = [0, 1].map(|nth| {
        let search = search(m, nth, Symmetry::All);
        let diagrams = search.build_diagrams(Control::NONE);
        let found = count_everywhere(&search, lasting_of(&diagrams));
        u64::try_from(found.unwrap()).unwrap()
    });
    assert_eq!(both[0], both[1], "{}", m.name);
    both[0]
}

/// Returns the same, of every variant put into poses that are reached numerically, where each can be judged in these.
fn count_in_poses(m: &Mechanism) -> Option<u64> {
    let here = Search::new(exact_field(m, 0).unwrap(), m, Conditions::default()).unwrap();
    let matrices = Matrices::new(&here);
    // What is asked of each is σ = 0, whatever it has in the drawn pose.
    let keyed = |choices: Vec<usize>| {
        let seen = matrices.look_at(&choices);
        let wanted = Seen {
            internal: 0,
            ..seen
        };
        let (key, _) = judge_variant(&here, &choices, wanted).unwrap().unwrap();
        Assignment { choices, key }
    };
    let all = every_choice(&here).map(keyed).collect();
    let stroke = reach_poses(&here, 3, 1, &|| false).unwrap();
    let judged = certify_variants(&here, all, false, Some(&stroke), &|| false);
    let lucky = judged.iter().map(|v| v.stroke.and_then(|s| s.is_lucky()));
    let works = lucky.collect::<Option<Vec<bool>>>()?;
    Some(works.into_iter().filter(|lucky| !lucky).count() as u64)
}

/// Variants that are singular just where drawn count, too. The figures of the trial, and of poses.
#[test]
fn variants_work_beside_the_drawn_pose_that_are_singular_there() {
    for (name, stated) in [
        ("watt-six-bar", 269 + 206),
        ("sarrus", 5 + 3),
        ("four-bar", 14 + 4),
        ("two-bennetts", 306 + 156),
        ("stephenson-six-bar", 281 + 222),
        ("hart-inversor", 190 + 273),
        ("scissor-lift", 82 + 54),
        ("roberval-balance", 14 + 4),
        ("watt-straight-line", 14 + 5),
    ] {
        let m = built_in(name);
        assert_eq!(count_beside(&m), stated, "{name}");
    }
    for name in ["watt-six-bar", "sarrus", "four-bar", "roberval-balance"] {
        let m = built_in(name);
        assert_eq!(Some(count_beside(&m)), count_in_poses(&m), "{name}");
    }
    let text = run_quiet("search watt-six-bar --count");
    let said = "206 more keep it in all poses near the drawn one, which is singular for these";
    assert!(text.contains(said), "{text}");
}

/// None of the variants of the gripper that move in one way alone loses its motion, and every symmetric count is of symmetric ones.
#[test]
fn the_gripper_loses_no_variant_with_one_motion() {
    let v = run_json("search gripper-10 --count --format json");
    assert_eq!(v["lasting_by_mobility"]["1"], "7150020");
    assert_eq!(v["admissible_by_mobility"]["1"], "7150020");
    let args = ["search", "gripper-10", "--count", "--format", "json"];
    let orbits = run_json(&[&args[..], &["--one-per-orbit"]].concat());
    let symmetric = run_json(&[&args[..], &["--symmetric"]].concat());
    let count = |v: &Value| -> u64 { v["lasting"].word().parse().unwrap() };
    assert_eq!(2 * count(&orbits), count(&v) + count(&symmetric));
}

/// What is not followed says why.
#[test]
fn a_motion_that_is_not_followed_is_said_to_be() {
    let why = |name: &str, change: fn(&mut Conditions)| {
        let m = built_in(name);
        let mut conditions = default_with(|c: &mut Conditions| c.throughout = true);
        change(&mut conditions);
        let search = Search::new(exact_field(&m, 0).unwrap(), &m, conditions).unwrap();
        search.pose_only().cloned()
    };
    let none = |_: &mut Conditions| {};
    assert_eq!(why("four-bar", none), None);
    assert_eq!(
        why("four-bar", |c| c.throughout = false),
        Some(PoseOnly::Asked)
    );
    assert_eq!(
        why("four-bar", |c| c.max_redundant = 1),
        Some(PoseOnly::Redundant)
    );
    assert_eq!(
        why("four-bar", |c| c.keep_output = false),
        Some(PoseOnly::OutputChange)
    );
    assert_eq!(why("octahedron", none), Some(PoseOnly::Rests));
    assert_eq!(why("parallelogram-flat", none), Some(PoseOnly::Stopped(2)));
    // Its platform shakes to third order before it is stopped.
    assert_eq!(why("wren-platform", none), Some(PoseOnly::Stopped(4)));
}

#[test]
fn the_drawn_pose_alone_is_searched_where_that_is_asked() {
    let args = ["search", "sarrus", "--format", "json", "--all"];
    let [all, pose] = [&[][..], &["--pose-only"]].map(|more| run_json(&[&args[..], more].concat()));
    let given = |v: &Value| v["variants"].list().len();
    assert_eq!([given(&all), given(&pose)], [5, 6]);
    assert_eq!(all["admissible"], pose["admissible"]);
    assert_eq!(all["lasting"], "5");
    assert!(pose["lasting"].is_null() && pose["pose_only"].is_string());
    let o = run("search sarrus");
    let text = String::from_utf8(o.stdout).unwrap();
    assert!(text.starts_with("sarrus: 5 of 3,125 variants"), "{text}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: case_count(48), max_shrink_iters: 200, max_global_rejects: 1 << 20, ..ProptestConfig::default() })]
    #[test]
    fn random_mechanisms_are_as_one_by_one_and_in_poses(text in random()) {
        let m = read(&text);
        let search = search(&m, 0, Symmetry::All);
        prop_assume!(search.pose_only().is_none() && search.size() <= 256u32.into());
        counted(&m);
        assert_as_in_poses(&m, 3);
        let diagrams = search.build_diagrams(Control::NONE);
        if let (Some(series), Some(poses)) = (count_everywhere(&search, lasting_of(&diagrams)), count_in_poses(&m)) {
            prop_assert_eq!(series, poses.into());
        }
    }
}
