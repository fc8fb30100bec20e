//! Searches of mechanisms that exact arithmetic does not have as they are meant: by singular values, and said so.

use crate::common::*;
use ozols::rank::exact::field::exact_field;
use ozols::score::request::JointOptions;
use ozols::search::at_tolerance::WHOLE;
use ozols::search::question::rounded_rank::Digits;

/// Options that every joint may take.
pub(super) fn small_request() -> Request {
    Request {
        options: ["revolute", "cylindrical", "spherical"]
            .map(str::to_owned)
            .to_vec(),
        list: List::Nothing,
        check: Check::None,
        ..Request::default()
    }
}

/// The same mechanism with its present joints as the only options.
pub(super) fn without_options(mut m: Mechanism) -> Mechanism {
    for joint in &mut m.edit().joints {
        joint.unloading.clear();
        joint.options = vec![JointOption {
            name: joint.joint_type.name().to_owned(),
            joint_type: joint.joint_type.clone(),
            frame: joint.frame.clone(),
            cost_milli: None,
            state: None,
        }];
    }
    m
}

/// A built-in mechanism without options of its own.
pub(super) fn plain_built_in(name: &str) -> Mechanism {
    without_options(built_in(name))
}

/// It turned and rounded.
pub(super) fn turned_bare(m: &Mechanism, decimals: usize, noise: &mut Noise) -> Mechanism {
    without_options(turned_and_rounded(m, decimals, noise))
}

#[test]
fn a_bennett_linkage_from_cad_has_the_counts_of_the_exact_one() {
    let m = turned_bare(&plain_built_in("bennett"), 6, &mut Noise::new(11, 0));
    let file = ozols::export(&m, "toml").unwrap();
    let v = json_on(
        "search",
        "it.toml",
        &file,
        "--options revolute,cylindrical,spherical",
    );
    let eight = json!({"from": "8", "to": "8", "doubtful": "0"});
    assert_eq!(&v["numeric"]["admissible"], &eight);
    assert_eq!(v["admissible"], "8");
    assert_eq!(v["determinate"], "17");
    assert_eq!(v["exact"], false);
    assert_eq!(v["determinate_exact"], false);
    assert_eq!(v["certainty"], "numeric");
    assert!(v["variants_proven"].is_null() || v["variants_proven"] == 0);
    assert_eq!(v["variants"].list().len(), 8);
}

/// A search ready to be made, of exact geometry.
fn ready(name: &str, request: &Request) -> (Search, Outcome) {
    let m = built_in(name);
    let truth = ozols::search(&m, request).unwrap();
    let prepared = request.prepare(m, &mut |_| {}).unwrap();
    let (conditions, _) = request.search_conditions(&prepared, &mut |_| {}).unwrap();
    let field = exact_field(&prepared.mechanism, 0).unwrap();
    let search = Search::new(field, prepared.mechanism, conditions).unwrap();
    (search, truth)
}

const FINE: Digits = Digits {
    tolerance: 1e-9,
    undecided: false,
};

#[test]
fn every_condition_means_the_same_by_singular_values() {
    let names = |all: &str| all.split(',').map(str::to_owned).collect_vec();
    // Of the twelve joints seven may change: 128 variants.
    let forbid = |joint: &str| JointOptions {
        joint: joint.to_owned(),
        names: Vec::new(),
    };
    let plain = Request {
        options: names("revolute,spherical"),
        forbid: ["2-4", "4-5", "6-8", "8-9", "9-1"].map(forbid).to_vec(),
        max_redundant: 5,
        list: List::Nothing,
        check: Check::None,
        ..Request::default()
    };
    let asked = [
        Request {
            max_mobility: Some(2),
            max_changes: Some(4),
            ..plain.clone()
        },
        Request {
            allow_output_change: true,
            hold: names("5"),
            ..plain.clone()
        },
        Request {
            max_external: Some(3),
            ..plain.clone()
        },
        Request {
            max_harmful: Some(1),
            ..plain.clone()
        },
    ];
    for request in asked {
        let (mut search, truth) = ready("gripper-10", &request);
        let found = search.at_tolerance(FINE, 0, 1, &|| false).unwrap();
        assert_eq!(found.determinate.sure, truth.determinate, "{request:?}");
        assert_eq!(found.admissible.sure, truth.admissible, "{request:?}");
        assert!(found.is_whole() && found.admissible.is_narrow());
        assert_eq!(
            found.list_variants().count().to_string(),
            truth.admissible.to_string()
        );
    }
}

#[test]
fn a_large_space_is_sampled_and_its_cheapest_are_found() {
    let request = Request {
        options: "revolute,cylindrical,universal,spherical,sphere-in-cylinder,planar,slotted,cylindrical-universal,cylinder-on-plane"
            .split(',')
            .map(str::to_owned)
            .collect(),
        max_redundant: 1,
        list: List::Top(5),
        check: Check::None,
        ..Request::default()
    };
    let (mut search, truth) = ready("two-bennetts", &request);
    assert!(search.size() > WHOLE.into(), "{}", search.size());
    let found = search.at_tolerance(FINE, 5, 1, &|| false).unwrap();
    let sampled = found.sampled.clone().unwrap();
    let size: f64 = search.size().to_string().parse().unwrap();
    let share = |n: &Counts| n.to_string().parse::<f64>().unwrap() / size;
    for (bracket, exact, sample) in [
        (&found.determinate, &truth.determinate, sampled.determinate),
        (&found.admissible, &truth.admissible, sampled.admissible),
    ] {
        assert!(bracket.sure.total <= exact.total && exact.total <= bracket.most);
        let share = share(exact);
        assert!(
            sample.low <= share && share <= sample.high,
            "{share} {sample:?}"
        );
    }
    let cost = |v: &Assignment| search.steps.cost_in_milli(v.key.cost());
    let cheapest: Vec<i64> = found.list_variants().take(5).map(|v| cost(&v)).collect();
    let exact: Vec<i64> = truth.variants().map(|v| v.cost_milli()).collect();
    assert_eq!(cheapest, exact);
    assert!(sampled.all_below.unwrap() >= cheapest[4]);
    // Ended at once, nothing is known.
    let none = search.at_tolerance(FINE, 5, 1, &|| true).unwrap();
    assert_eq!((none.looked, &none.admissible.most), (0, &search.size()));
}
