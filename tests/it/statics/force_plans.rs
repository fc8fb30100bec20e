//! What the kinetostatics of the shears goes through: accelerations, inertia forces, tangential reactions, force plans.

use crate::common::*;

/// Whether a vector's name stands at its arrow, which it does where it is long enough.
fn visible(svg: &str, name: &str) -> bool {
    svg.contains(&format!("text-anchor=\"start\">{name}<"))
        || svg.contains(&format!("text-anchor=\"end\">{name}<"))
        || svg.contains(&format!("text-anchor=\"middle\">{name}<"))
}

/// Every plan closes, and those of the δ-point method add up as those of the full solve do.
#[test]
fn force_plans_close_beside_those_of_the_full_solve() {
    let folder = Folder::new();
    folder.succeed("statics parallel-shears --stroke 0:360deg:36 --svg plans");
    for group in ["4-6-7-10", "5-8-9-11"] {
        let [svg, table] =
            ["svg", "csv"].map(|e| folder.text(&format!("plans/force-plan-{group}.{e}")));
        let names = "R34τ R34n R0/10 R64τ R64n R46τ R47τ Fи4 G4 P10";
        has_all(&svg, &split_words(names));
        let mut sums: BTreeMap<String, ([f64; 2], f64)> = BTreeMap::new();
        for line in table.lines().skip(1) {
            // The plan's title has a comma and stands in quotes.
            let (title, rest) = line[1..].split_once('"').unwrap();
            let cells: Vec<&str> = rest.trim_start_matches(',').split(',').collect();
            let v = [1, 2].map(|i| cells[i].parse::<f64>().unwrap());
            let sum = sums.entry(title.to_owned()).or_default();
            sum.0 = [sum.0[0] + v[0], sum.0[1] + v[1]];
            sum.1 = sum.1.max(v[0].hypot(v[1]));
        }
        // Four plans by two methods, and the weights and the inertia forces on their own.
        assert_eq!(sums.len(), 10, "{sums:?}");
        assert!(visible(&svg, "Fи10") && visible(&svg, "G10"), "{group}");
        for (title, (sum, longest)) in sums {
            assert!(sum[0].hypot(sum[1]) <= 1e-9 * longest, "{title}: {sum:?}");
        }
    }
    // A chart's sentence stands in the chart, and not a second time over it.
    let page = folder.text("plans/index.html");
    assert!(page.contains("with its sign") && !page.contains("<p>D = 3-4"));
    assert!(page.contains("force plans of group 4-6-7-10"));
    for file in ["tangential-4-6-7-10", "accelerations", "inertia-forces"] {
        folder.bytes(&format!("plans/{file}.svg"));
    }
}

/// The force plan is of a pose in which the knives cut, by the file from 165 to 200 degrees of the crank, and not of one in which they
/// do not.
#[test]
fn the_heaviest_group_is_that_of_the_cut() {
    use ozols::statics::kinetostatics::LoadSource;
    use ozols::statics::solve::{Model, SolvedReactions, solve_reactions};
    let m = built_in("parallel-shears");
    let found = solve_reactions(&m, StateId::FREE, m.loads.stroke, Model::Planar).unwrap();
    let SolvedReactions::Planar(found) = found else {
        panic!("it is planar")
    };
    assert_eq!(found.moments.len(), 73);
    let plan = super::stability::study::heaviest_group(&found).unwrap();
    let outside = plan
        .loads
        .iter()
        .filter(|l| l.source == LoadSource::External);
    let cut: f64 = outside.map(|l| l.force[0].hypot(l.force[1])).sum();
    near(cut, 500_000.0, 1e-6);
}
