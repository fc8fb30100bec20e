//! Every built-in mechanism has the figures its file states, with their sources.

use crate::common::*;
use ozols::redundancy::StateFigures;
use ozols::redundancy::analysis::Elimination;
use serde_json::json as value;

#[test]
fn every_built_in_mechanism_has_the_figures_it_states() {
    let mut wrong = Vec::new();
    for name in builtin::names() {
        let m = built_in(name);
        assert_eq!(m.name, name, "a file is named for its mechanism");
        assert!(!m.sources.is_empty(), "{name} states no source");
        assert!(
            m.expected.iter().any(|e| e.redundant.is_some()),
            "{name} states no redundancy"
        );
        for e in &m.expected {
            let (Some(w), Some(finite)) = (e.mobility, e.finite_mobility) else {
                panic!(
                    "{name} {} states no mobility or no finite mobility",
                    e.state
                );
            };
            assert!(
                (0..=w).contains(&finite),
                "{name} {}: what moves, moves at first order",
                e.state
            );
        }
        for method in [Method::Modular, Method::Numeric(Elimination::Svd, 1e-9)] {
            let states: Vec<StateId> = m.state_ids().collect();
            for s in analyse_states(&m, &states, method).unwrap() {
                let state = m.state_named(&s.state).unwrap();
                let of_analysis = StateFigures {
                    links: s.links,
                    joints: s.joints,
                    contours: s.contours,
                    freedoms: s.freedoms,
                    mobility: s.mobility,
                    redundant: s.redundant,
                };
                assert_eq!(
                    state_figures(&m, state).unwrap(),
                    of_analysis,
                    "{name} {}",
                    s.state
                );
                // σ = W + 6k - f holds identically, p = n + k - 1 for a connected mechanism.
                assert_eq!(
                    s.redundant + s.freedoms,
                    s.mobility + s.rows,
                    "{name} {}",
                    s.state
                );
                assert_eq!(s.joints + 1, s.links + s.contours, "{name} {}", s.state);
                assert_eq!(
                    s.per_contour.iter().map(|c| c.redundant).sum::<usize>()
                        + s.per_coupling.iter().map(|c| c.redundant).sum::<usize>(),
                    s.rows - s.rank,
                    "{name}"
                );
                assert!(
                    s.per_contour
                        .iter()
                        .all(|c| (c.range.0..=c.range.1).contains(&c.redundant)),
                    "{name}"
                );
                assert_eq!(s.self_stresses.len(), s.redundant, "{name} {}", s.state);
                assert_eq!(s.idle.len(), s.local_mobility, "{name} {}", s.state);
                if let Some(e) = s.external {
                    assert_eq!(
                        e.redundant, e.by_rank,
                        "{name} {}: external formula against ranks",
                        s.state
                    );
                }
                for e in m.expected.iter().filter(|e| e.state == s.state) {
                    let is = [
                        (e.mobility, s.mobility as i64, "W"),
                        (e.working_mobility, s.working_mobility as i64, "working"),
                        (e.local_mobility, s.local_mobility as i64, "local"),
                        (e.redundant, s.redundant as i64, "σ"),
                        (
                            e.external_redundant,
                            s.external.map_or(0, |x| x.redundant),
                            "external σ",
                        ),
                    ];
                    for (stated, found, what) in is {
                        if stated.is_some_and(|x| x != found) {
                            wrong.push(format!(
                                "{name} {} {what}: stated {stated:?}, found {found}",
                                s.state
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// [Pogrebnyak 2018]: three of the five external constraints are friction doubled by the two jaws, two demand parallel
/// faces; with an unloading joint two are left, both harmless.
#[test]
fn friction_shared_by_the_jaws_is_told_from_harm() {
    use ozols::redundancy::stress::StressVerdict;
    for (name, harmless, harmful) in [
        ("gripper-10", 3, 2),
        ("gripper-10-unloaded", 2, 0),
        ("gripper-10-redesign-unloaded", 2, 0),
    ] {
        let m = built_in(name);
        let clamped = m.state_named("clamped").unwrap();
        let s = &analysed_in(&m, clamped);
        let count = |v: StressVerdict| {
            let those = s
                .self_stresses
                .iter()
                .filter(|t| t.external && t.verdict == v);
            those.count()
        };
        let found = (
            count(StressVerdict::Harmless),
            count(StressVerdict::Harmful),
        );
        assert_eq!(found, (harmless, harmful), "{name}");
    }
}

/// What is listed is `catalogs/list.csv`. If this fails, correct the lines of it that differ.
#[test]
fn the_list_has_the_figures_of_the_files() {
    let listed = run_json("list --format json");
    let mut computed: Vec<Value> = Vec::new();
    for (family, names) in builtin::families() {
        for name in names {
            let m = built_in(name);
            for (state, word) in m.states_with_ids() {
                let f = state_figures(&m, state).unwrap();
                computed.push(value!({
                    "name": name,
                    "family": family,
                    "state": word,
                    "links": f.links,
                    "joints": f.joints,
                    "contours": f.contours,
                    "freedoms": f.freedoms,
                    "mobility": f.mobility,
                    "redundant": f.redundant,
                    "description": m.description,
                }));
            }
        }
    }
    assert_eq!(listed, Value::Array(computed));
}
