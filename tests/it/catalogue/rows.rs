//! Rows of a catalogue against the plain commands, and its fronts against a slow look at all.

use super::carried_on::scattered_numbers;
use super::command::{self, free_state, path_in};
use super::paired::{Built, built};
use crate::common::*;

/// All structures of four and six links, made once for the tests that look at them.
pub(super) fn all_of_six() -> &'static str {
    static FILE: Built = OnceLock::new();
    built(&FILE, "--links 4..6 --ideas 6")
}

#[test]
fn rows_that_are_exported_have_the_same_figures_by_the_plain_commands() {
    let file = all_of_six();
    let folder = tempdir().unwrap();
    let sql = "SELECT id, mobility, redundant, finite, determinate, determinate_w1, best_cost FROM structures JOIN layouts \
               ON structure = id ORDER BY id";
    let rows = command::query_rows(file, sql);
    let count = u64::try_from(rows.len()).unwrap();
    let drawn: BTreeSet<u64> = scattered_numbers(2)
        .map(|x| x % count)
        .unique()
        .take(20)
        .collect();
    for row in drawn.iter().map(|&i| &rows[usize::try_from(i).unwrap()]) {
        let id = row["id"].as_str().unwrap();
        let toml = path_in(&folder, &format!("{id}.toml"));
        stdout_of(&["catalog", "export", file, id, "-o", &toml]);
        let free = free_state(&toml);
        for key in ["mobility", "redundant"] {
            assert_eq!(free[key], row[key], "{id}");
        }
        assert_eq!(row["finite"], "1, proven");
        assert_eq!(free["finite_mobility"], 1, "{id}");
        assert_eq!(free["finite_mobility_proven"], true, "{id}");
        let found = run_json(&format!(
            "search {toml} --max-mobility 1 --quiet --format json"
        ));
        let told = |key: &str| Value::from(row[key].to_string());
        assert_eq!(found["determinate"], told("determinate"), "{id}");
        assert_eq!(found["admissible"], told("determinate_w1"), "{id}");
        // Variants with W = 1 hold outputs and drives throughout the motion, so that all ideas do.
        assert_eq!(found["lasting"], found["admissible"], "{id}");
        assert_eq!(found["by_mobility"]["1"], told("determinate_w1"), "{id}");
        assert_eq!(
            found["variants"][0]["cost"].real(),
            row["best_cost"].real(),
            "{id}"
        );
    }
}

/// The rows that no other is as good as in all figures and better than in one; larger is worse.
fn unbeaten(rows: &[(String, String, Vec<f64>)]) -> Vec<&str> {
    let beats = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(x, y)| x <= y) && a != b;
    let free = rows.iter().filter(|(_, group, row)| {
        !rows
            .iter()
            .any(|(_, g, other)| g == group && beats(other, row))
    });
    free.map(|(id, ..)| id.as_str()).collect()
}

#[test]
fn the_fronts_are_what_no_other_beats() {
    let file = all_of_six();
    let rows = |sql: &str| -> Vec<(String, String, Vec<f64>)> {
        let csv = stdout_of(&["catalog", "query", file, sql, "--format", "csv"]);
        let row = |line: &str| {
            let mut cells = line.split(',').map(str::to_owned);
            let [id, group] = [cells.next().unwrap(), cells.next().unwrap()];
            (id, group, cells.map(|c| c.parse().unwrap()).collect())
        };
        csv.lines().skip(1).map(row).collect()
    };
    let structures = rows(
        "SELECT s.id, input, links, best_cost + links + joints + (input = 'slide'), -force_min, pin_force, jaw_turn, width * height, \
         round(travel * iif(input = 'turn', 1000, 1) / (force_min * efficiency), 2) FROM structures s \
         JOIN layouts l ON l.structure = s.id JOIN strokes k ON k.structure = s.id \
         WHERE best_cost IS NOT NULL AND reached = 1 AND shortfall IS NULL ORDER BY s.id",
    );
    let front = rows("SELECT id, input FROM front ORDER BY id");
    let front: Vec<&str> = front.iter().map(|(id, ..)| id.as_str()).collect();
    assert_eq!(front, unbeaten(&structures));
    assert!(
        !front.is_empty() && 4 * front.len() < 3 * structures.len(),
        "{} of {}",
        front.len(),
        structures.len()
    );
    let ideas = rows(
        "SELECT structure || ' ' || place, structure, cost, peak_force, peak_moment, output_error FROM ideas \
         WHERE peak_force IS NOT NULL ORDER BY structure, place",
    );
    let best = rows(
        "SELECT structure || ' ' || place, structure FROM idea_front ORDER BY structure, place",
    );
    let best: Vec<&str> = best.iter().map(|(id, ..)| id.as_str()).collect();
    assert_eq!(best, unbeaten(&ideas));
    assert!(best.len() < ideas.len());
}

/// The area is that of the box round all that is drawn, in mm²; what the tips may be off by is in mm, where scores are in metres.
#[test]
fn areas_and_errors_are_in_millimetres() {
    let sql = "SELECT layouts.structure, mechanism, area, output_error FROM layouts JOIN ideas ON ideas.structure = layouts.structure \
               JOIN structures ON id = layouts.structure WHERE place = 1 AND symmetry = 'mirror' ORDER BY id LIMIT 4";
    let rows = command::query_rows(all_of_six(), sql);
    assert!(rows.len() > 1);
    for row in rows {
        let m = ozols::from_toml(row["mechanism"].as_str().unwrap()).unwrap();
        let joints = m.joints.iter().map(|j| to_vector(&j.frame.point));
        let points = joints.chain(m.points.iter().map(|p| to_vector(&p.point)));
        let points: Vec<[f64; 3]> = points.collect();
        let side = |k: usize| {
            let (least, most) = points.iter().map(|p| p[k]).minmax().into_option().unwrap();
            most - least
        };
        let is = |key: &str, by_hand: f64| {
            let told = row[key].as_f64().unwrap();
            assert!(
                (told / by_hand - 1.0).abs() < 1e-3,
                "{key} {by_hand}: {row}"
            );
        };
        is("area", side(0) * side(1));
        let request = default_with(|r: &mut Request| r.max_mobility = Some(1));
        let outcome = ozols::search(&m, &request).unwrap();
        let ideas = outcome
            .search
            .list_ideas(outcome.diagrams.as_ref().unwrap(), 1);
        let evaluator = Evaluator::new(&outcome.search, ClearanceSum::Worst).unwrap();
        let scores = evaluator.score_variant(&ideas[0].first, &mut Scratch::default());
        is("output_error", 1000.0 * scores.unwrap().output_error);
    }
}

/// Of one structure no two ideas change the same joints to the same types, nor are images of each other; those that are their own images
/// come first, and the cheapest is among them.
#[test]
fn ideas_differ_and_symmetric_ones_come_first() {
    let sql = "SELECT structure, mechanism, changes, cost, best_cost FROM ideas JOIN layouts USING (structure) JOIN structures ON id = structure \
               WHERE symmetry IN ('mirror', 'half-turn') ORDER BY structure, place";
    let rows = command::query_rows(all_of_six(), sql);
    let (mut symmetric, mut other) = (0, 0);
    for (_, ideas) in &rows.iter().chunk_by(|r| r["structure"].to_string()) {
        let ideas: Vec<_> = ideas.collect();
        let m = ozols::from_toml(ideas[0]["mechanism"].as_str().unwrap()).unwrap();
        let image = |joint: &str| {
            let of = m.joint_ids().find(|&j| m.joints[j].id == joint).unwrap();
            m.joints[m.search.image_of_joint(of)].id.clone()
        };
        let mut seen = BTreeSet::new();
        let mut asymmetric = false;
        for idea in &ideas {
            let parts = idea["changes"].as_str().unwrap().split("; ");
            let own: BTreeSet<(String, &str)> = parts
                .flat_map(|part| {
                    let (joints, to) = part.split_once(" -> ").unwrap();
                    let to = to.trim_end_matches("-y");
                    joints.split(", ").map(move |j| (j.to_owned(), to))
                })
                .collect();
            let images: BTreeSet<_> = own.iter().map(|(j, to)| (image(j), *to)).collect();
            assert!(!seen.contains(&own) && !seen.contains(&images), "{idea}");
            assert!(own != images || !asymmetric, "{idea}");
            asymmetric |= own != images;
            *if own == images {
                &mut symmetric
            } else {
                &mut other
            } += 1;
            seen.extend([own, images]);
        }
        let cheapest = ideas.iter().map(|i| i["cost"].as_f64().unwrap());
        let cheapest = cheapest.fold(f64::INFINITY, f64::min);
        assert_eq!(ideas[0]["best_cost"].as_f64(), Some(cheapest));
    }
    assert!(symmetric > 3 && other > 3, "{symmetric} {other}");
}

/// The only symmetry of a generic layout is none: every variant is its own image, and an orbit by itself.
#[test]
fn variants_of_generic_layouts_are_their_own_images() {
    let sql = "SELECT variants, orbits, symmetric FROM counts JOIN structures ON id = structure WHERE symmetry = 'generic'";
    let rows = command::query_rows(all_of_six(), sql);
    assert!(rows.len() > 20);
    for row in rows {
        assert!(
            row["variants"] == row["orbits"] && row["variants"] == row["symmetric"],
            "{row}"
        );
    }
}
