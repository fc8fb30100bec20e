//! Ranking of geared mechanisms: the fast scores, the plain ones, the floor, and the program.

use super::{assert_above_floor, both_ways, cheapest, near, search};
use crate::common::*;

/// The geared gripper with a part that pushes its jaws apart and weighs on them.
fn text() -> String {
    let force = |link: &str, y: i32, f: i32| {
        format!(
            "[[workload.force]]\nlink = \"{link}\"\npoint = [60, {y}, 0]\nforce = [0, {f}, -5]\n\n"
        )
    };
    let stroke = "[workload]\nstroke = { from = -0.2, to = 0.2, steps = 2 }\n\n";
    let more = stroke.to_owned() + &force("2", 20, 80) + &force("5", -20, -80);
    replace_once(
        builtin::text("geared-gripper").unwrap(),
        "[search]",
        &format!("{more}[search]"),
    )
}

#[test]
fn fast_scores_of_geared_variants_are_those_of_the_variants_built_and_solved() {
    let m = read(&text());
    let (solved, refused) = both_ways(&m, 0, ClearanceSum::Worst, 60);
    assert!(solved > 20, "{solved} {refused}");
    both_ways(&m, 2, ClearanceSum::Rms, 12);
    // No teeth, no force of theirs in the bearings.
    let belt = read(&replace_once(&text(), "gear = true", ""));
    let (solved, refused) = both_ways(&belt, 0, ClearanceSum::Worst, 30);
    assert!(solved > 10, "{solved} {refused}");
}

/// Options that teeth would push aside are scored as built, each as its teeth mesh or not, and joints in series, too.
#[test]
fn variants_whose_teeth_do_not_mesh_score_as_they_are() {
    let some = replace_once(
        &text(),
        "point = [0, -10, 0]\naxis = [0, 0, 1]",
        "point = [0, -10, 0]\naxis = [0, 0, 1]\noptions = [\"revolute\", \"planar\", \"universal\"]",
    );
    let (solved, refused) = both_ways(&read(&some), 0, ClearanceSum::Worst, 60);
    assert!(solved > 20, "{solved} {refused}");
    let series = replace_once(
        &text(),
        "point = [0, -10, 0]\naxis = [0, 0, 1]",
        "point = [0, -10, 0]\naxis = [0, 0, 1]\nunloading = [\"spherical\"]",
    );
    let (solved, refused) = both_ways(&read(&series), 0, ClearanceSum::Worst, 40);
    assert!(solved > 10, "{solved} {refused}");
}

/// No variant of a sample is better than the floor says, and with nothing to choose the floor is the score.
#[test]
fn no_geared_variant_is_below_the_floor() {
    for clearance in [ClearanceSum::Worst, ClearanceSum::Rms] {
        assert_above_floor(&read(&text()), 0, clearance, 60);
    }
    let mut m = built_in("rack-gripper");
    m.edit()
        .joints
        .iter_mut()
        .for_each(|j| j.options.truncate(1));
    let s = search(&m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    let only = e.score_variant(&cheapest(&s, 1)[0], &mut Scratch::default());
    let (floor, scores) = (e.least_terms(), only.unwrap());
    assert!(
        near(floor.force, scores.force.utilisation, 1e-4),
        "{floor:?} {scores:?}"
    );
}

/// A geared gripper is ranked by force like others: by a crank's bearing, which bears the teeth.
#[test]
fn the_program_ranks_geared_grippers_by_force() {
    let ranking = "[ranking]\norder = \"weighted\"\nterms = [{ term = \"peak-force\", weight = 10 }, { term = \"cost\", weight = 1 }]\n\n[search]";
    let text = replace_once(&text(), "[search]", ranking);
    let data = json_on("search", "geared.toml", &text, "--top 3");
    let first = &data["variants"][0];
    assert_eq!(first["redundant"], 0, "{first}");
}
