//! The library by its front door: what a program gets is what the command writes.

use crate::common::*;
use ozols::score::outcome::remarks::Remarks;
use ozols::score::request::{JointOptions, Method};
use ozols::score::run::{self, Event};
use ozols::view::search::{csv, json, text};
use ozols::{Error, Scheme};
use std::sync::atomic::AtomicBool;

fn search(name: &str, request: &Request) -> Outcome {
    ozols::search(&built_in(name), request).unwrap()
}

fn json(outcome: &Outcome) -> String {
    let mut out = Vec::new();
    let none = outcome.make_remarks(&|| false).unwrap();
    json::write_json(&mut out, outcome, outcome.variants(), &none, None).unwrap();
    String::from_utf8(out).unwrap()
}

fn printed(name: &str, flags: &str) -> String {
    let mut args = vec!["search", name, "--format", "json"];
    args.extend(flags.split_whitespace());
    without_time(&utf8_text(&run(&args).stdout))
}

#[test]
fn an_outcome_is_what_the_command_writes() {
    let request = Request::default;
    let names = |n: &[&str]| n.iter().map(|n| (*n).to_owned()).collect();
    let cases: Vec<(&str, &str, Request)> = vec![
        ("gripper-10", "", request()),
        ("bennett", "", request()),
        (
            "gripper-10",
            "--max-mobility 1 --options revolute,cylindrical,universal,spherical --top 3",
            Request {
                max_mobility: Some(1),
                options: names(&["revolute", "cylindrical", "universal", "spherical"]),
                list: List::Top(3),
                ..request()
            },
        ),
        (
            "gripper-10",
            "--forbid 2-3=spherical --max-external 2 --state clamped --top 2",
            Request {
                forbid: vec![JointOptions {
                    joint: "2-3".to_owned(),
                    names: names(&["spherical"]),
                }],
                max_external: Some(2),
                state: Some("clamped".to_owned()),
                list: List::Top(2),
                ..request()
            },
        ),
        (
            "gripper-10",
            "--one-per-orbit --check none --sample 4 --seed 7",
            Request {
                symmetry: Symmetry::OnePerOrbit,
                check: Check::None,
                list: List::Sample(4),
                seed: 7,
                ..request()
            },
        ),
        (
            "gripper-10-loaded",
            "--rank peak-force,cost=0.5 --pool 60",
            Request {
                rank: vec![(Term::PeakForce, 1.0), (Term::Cost, 0.5)],
                pool: Some(60),
                ..request()
            },
        ),
        (
            "3-crr",
            "--pose-only --top 4",
            Request {
                pose_only: true,
                list: List::Top(4),
                ..request()
            },
        ),
        (
            "four-bar",
            "--method brute",
            Request {
                method: Method::Brute,
                ..request()
            },
        ),
        (
            "four-bar",
            "--max-mobility 0 --max-changes 0",
            Request {
                max_mobility: Some(0),
                max_changes: Some(0),
                ..request()
            },
        ),
    ];
    for (name, flags, request) in cases {
        assert_eq!(
            json(&search(name, &request)),
            printed(name, flags),
            "{name} {flags}"
        );
    }
}

#[test]
fn a_cancelled_search_says_so() {
    let m = built_in("gripper-10");
    let outcome = run::run(m, &Request::default(), &|| true, &mut |_| {}).unwrap();
    assert_eq!(outcome.stop, Stop::Interrupted);
    assert!(!outcome.is_exact());
    assert!(!outcome.check.unwrap().agree);
}

#[test]
fn cancelled_orbits_are_not_called_exact() {
    let request = default_with(|r: &mut Request| r.symmetry = Symmetry::OnePerOrbit);
    let built = AtomicBool::new(false);
    let outcome = run::run(
        built_in("gripper-10"),
        &request,
        &|| built.load(Ordering::SeqCst),
        &mut |event| built.store(matches!(event, Event::Built), Ordering::SeqCst),
    );
    assert_eq!(outcome.unwrap().stop, Stop::Interrupted);
}

#[test]
fn giving_ends_when_it_is_cancelled() {
    let outcome = search("four-bar", &Request::default());
    let enough = AtomicBool::new(false);
    let cancelled = || enough.load(Ordering::SeqCst);
    let mut given = outcome.variants_unless(&cancelled);
    assert!(given.next().is_some());
    enough.store(true, Ordering::SeqCst);
    assert!(given.next().is_none() && given.is_interrupted());
    assert_eq!(given.summary().given, 1);
}

/// Each variant brings its scores along. Once it was looked up in the pool by its choices, and a list of n took n² looks.
#[test]
fn scores_stay_with_their_variants() {
    let request = Request {
        pool: Some(300),
        list: List::Top(300),
        check: Check::None,
        ..Request::default()
    };
    let outcome = search("gripper-10-loaded", &request);
    let pool = outcome.ranking.as_ref().unwrap();
    assert!(pool.list.len() > 100);
    for (v, r) in outcome.variants().zip(&pool.list) {
        assert!(
            std::ptr::eq(v.ranked().unwrap(), r),
            "a place, not a search"
        );
        assert_eq!(v.assignment(), &r.variant);
    }
}

#[test]
fn a_variant_tells_of_itself() {
    let outcome = search("gripper-10", &Request::default());
    let best = outcome.variants().next().unwrap();
    let alone = &ozols::analyze(&best.as_mechanism()).unwrap()[0];
    assert_eq!(i64::try_from(alone.mobility).unwrap(), best.mobility());
    assert_eq!(alone.redundant, best.redundant() as usize);
    let contours = best.redundant_by_contour().unwrap();
    assert!(contours.is_empty(), "no contour has any");
    let few = default_with(|r: &mut Request| (r.max_redundant, r.max_changes) = (3, Some(3)));
    let outcome = search("gripper-10", &few);
    let best = outcome.variants().next().unwrap();
    let alone = &ozols::analyze(&best.as_mechanism()).unwrap()[0];
    let contours = best.redundant_by_contour().unwrap();
    assert_eq!(contours.len(), alone.contours);
    let sum: usize = contours.iter().map(|(_, c)| c.redundant).sum();
    assert_eq!(sum, alone.redundant);
    assert_eq!(best.list_changes().len(), best.change_count() as usize);
    assert!(
        best.to_string()
            .starts_with(&format!("1. cost {}, W = ", best.cost())),
        "{best}"
    );
}

#[test]
fn formats_and_drawings_are_those_of_the_command() {
    let m = built_in("four-bar");
    let printed = |args: &[&str]| String::from_utf8(run(args).stdout).unwrap();
    let sdf = ozols::export(&m, "sdf").unwrap();
    assert_eq!(sdf, printed(&["export", "four-bar", "--to", "sdf"]));
    let svg = ozols::draw(&m, Scheme::Kinematic).unwrap();
    assert_eq!(svg, printed(&["draw", "four-bar"]));
    let toml = ozols::export(&m, "toml").unwrap();
    let again = ozols::from_toml(&toml).unwrap();
    assert_eq!(ozols::export(&again, "toml").unwrap(), toml);
}

#[test]
fn csv_and_text_are_those_of_the_command() {
    let mut outcome = search("four-bar", &Request::default());
    let printed = |format: &str| ozols(&["search", "four-bar", "--format", format]).output();
    let mut csv = Vec::new();
    csv::write_csv(&mut csv, &outcome, outcome.variants()).unwrap();
    assert_eq!(csv, printed("csv").unwrap().stdout);
    let mut text = Vec::new();
    // People are given ideas.
    outcome.request.distinct = true;
    let variants = outcome.variants();
    let none = &Remarks::default();
    text::write_text(&mut text, &outcome, variants, none, "four-bar", None, false).unwrap();
    assert_eq!(text, printed("text").unwrap().stdout);
}

#[test]
fn errors_read_as_those_of_the_command() {
    let request = default_with(|r: &mut Request| r.hold = vec!["nosuch".to_owned()]);
    let m = built_in("four-bar");
    let why = ozols::search(&m, &request).unwrap_err();
    assert!(matches!(why, Error::Search(_)));
    let printed = ozols("search four-bar --hold nosuch").output();
    let printed = String::from_utf8(printed.unwrap().stderr).unwrap();
    assert_eq!(printed.trim(), format!("error: {why}"));
    assert!(matches!(
        ozols::built_in("nosuch"),
        Err(Error::NotBuiltIn(name)) if name == "nosuch"
    ));
    assert!(matches!(
        ozols::open("/nosuch/file.toml"),
        Err(Error::Read { .. })
    ));
}
