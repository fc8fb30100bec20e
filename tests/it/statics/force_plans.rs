//! What the kinetostatics of the shears goes through: accelerations, inertia forces, tangential reactions, force plans.

use crate::common::*;
fn pair(v: &Value) -> [f64; 2] {
    [v[0].real(), v[1].real()]
}

fn link<'a>(position: &'a Value, name: &str) -> &'a Value {
    let all = position["links"].list();
    all.iter().find(|l| l["link"] == name).unwrap()
}

fn point(position: &Value, joint: &str) -> [f64; 2] {
    let all = position["reactions"].list();
    pair(&all.iter().find(|r| r["joint"] == joint).unwrap()["point"])
}

fn mass_of(m: &Mechanism, link: &str) -> f64 {
    let link = m.link_named(link).unwrap();
    m.links[link].mass.as_ref().unwrap().mass
}

/// Accelerations are the second differences of the places by time; inertia forces and moments are by D'Alembert.
#[test]
fn accelerations_are_those_of_the_places() {
    let found = run_json("statics parallel-shears --stroke 0.4:0.5:100 --format json");
    let positions = found["positions"].list();
    let shears = built_in("parallel-shears");
    let step = 0.001 / shears.loads.drive_speeds[0];
    for at in [1, 50, 99] {
        for name in ["4", "6", "7", "10"] {
            let centre = |k: usize| pair(&link(&positions[k], name)["centre"]);
            let [before, now, after] = [centre(at - 1), centre(at), centre(at + 1)];
            let of = link(&positions[at], name);
            let told = pair(&of["acceleration"]);
            let mass = mass_of(&shears, name);
            for i in 0..2 {
                let found = (after[i] - 2.0 * now[i] + before[i]) / (step * step);
                near(told[i], found, 1e-3 * (1.0 + told[i].abs()));
                near(
                    pair(&of["inertia_force"])[i],
                    -mass * told[i],
                    1e-9 * (1.0 + mass),
                );
            }
        }
    }
}

/// [Bychkov, Dvornikov & Zhukov 2018]: R46τ = (F_и6 l + G6 l)/l_FM, R47τ alike, from the moments about the rods' far ends.
#[test]
fn tangential_reactions_are_the_moments_over_the_rods() {
    let found = run_json("statics parallel-shears --stroke 0:360deg:8 --format json");
    let shears = built_in("parallel-shears");
    let gravity = to_vector(shears.loads.gravity.as_ref().unwrap());
    for position in found["positions"].list() {
        let group = &position["contour_groups"][0];
        for (rod, near_end, far_end, key) in [
            ("6", "4-6", "6-10", "R46_tangential"),
            ("7", "4-7", "7-10", "R47_tangential"),
        ] {
            let of = link(position, rod);
            let mass = mass_of(&shears, rod);
            let (at, far) = (point(position, near_end), point(position, far_end));
            let arm = |p: [f64; 2]| [p[0] - far[0], p[1] - far[1]];
            let inertia = pair(&of["inertia_force"]);
            let load = [
                inertia[0] + mass * gravity[0],
                inertia[1] + mass * gravity[1],
            ];
            let moment = cross_plane(arm(pair(&of["centre"])), load) + of["inertia_moment"].real();
            let length = arm(at)[0].hypot(arm(at)[1]);
            let told = group[key].real();
            near(told, -moment / length, 1e-9 * (1.0 + told.abs()));
        }
    }
    let text = run_quiet("statics parallel-shears --stroke 0:360deg:2");
    has_all(
        &text,
        &["R46τ", "R47τ", "R34τ", "inertia force, N", "ε, rad/s²"],
    );
}

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
fn the_force_plan_is_of_the_pose_with_most_load_from_outside() {
    use ozols::statics::kinetostatics::LoadSource;
    use ozols::statics::solve::{Model, SolvedReactions, solve_reactions};
    let m = built_in("parallel-shears");
    let found = solve_reactions(&m, StateId::FREE, m.loads.stroke, Model::Planar).unwrap();
    let SolvedReactions::Planar(found) = found else {
        panic!("it is planar")
    };
    assert_eq!(found.moments.len(), 73);
    let plan = found.heaviest_contour_group().unwrap();
    let outside = plan
        .loads
        .iter()
        .filter(|l| l.source == LoadSource::External);
    let cut: f64 = outside.map(|l| l.force[0].hypot(l.force[1])).sum();
    near(cut, 500_000.0, 1e-6);
}
