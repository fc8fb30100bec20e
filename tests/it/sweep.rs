//! Sweeps: each row is what the other commands say of the file with the numbers written in; a table does not depend on how it
//! was made; what is wrong is said.

mod command;
mod redesigns;
mod samples;
mod table;
mod wrong;

use ozols::Mechanism;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::StateId;
use ozols::redundancy::analysis::{Method, analyse};
use ozols::score::request::{Check, List, Request};
use ozols::shard::Shard;
use ozols::statics::solve::{Model, SolvedReactions, solve};
use ozols::sweep::row::SampleRow;
use ozols::sweep::space::Sampling;
use ozols::sweep::table::{SweepWatch, Table, make};
use ozols::sweep::{Spec, Sweep, SweepRequest};
use std::path::Path;

/// A slider-crank in its plane, with a load: the crank's pin at (x, y), the piston where a rod of (96, -y) has it.
pub(crate) const LOADED: &str = r#"
name = "swept"
length_unit = "mm"
mode = "planar"
[parameter]
x = { range = [20, 40], default = 30 }
y = { values = [30, 40, "10*sqrt(2)"] }
rod = 96
[[link]]
id = "0"
role = "frame"
[[link]]
id = "1"
[[link]]
id = "2"
[[link]]
id = "3"
role = "output"
[[joint]]
id = "0-1"
links = ["0", "1"]
type = "revolute"
point = [0, 0, 0]
axis = [0, 0, 1]
drive = true
[[joint]]
id = "1-2"
links = ["1", "2"]
type = "revolute"
point = ["x", "y", 0]
axis = [0, 0, 1]
[[joint]]
id = "2-3"
links = ["2", "3"]
type = "revolute"
point = ["x + rod", 0, 0]
axis = [0, 0, 1]
[[joint]]
id = "3-0"
links = ["3", "0"]
type = "prismatic"
point = ["x + rod", 0, 0]
axis = [1, 0, 0]
[[workload.force]]
link = "3"
point = ["x + rod", 0, 0]
force = [-100, 0, 0]
[workload.stroke]
from = 0
to = "30deg"
steps = 3
"#;

pub(crate) fn three_rods() -> String {
    ozols::builtin::text("parallelogram-3-rods")
        .unwrap()
        .to_owned()
}

pub(crate) fn asked() -> SweepRequest {
    SweepRequest {
        search: None,
        top: 3,
        stroke: None,
        methods: false,
        as_written: false,
    }
}

pub(crate) fn sweep(text: &str, sampling: Sampling, asked: SweepRequest) -> Sweep {
    Sweep::new(Spec {
        file: "swept.toml".to_owned(),
        text: text.to_owned(),
        sampling,
        asked,
    })
    .unwrap()
}

/// Works to the end.
struct Works;

impl SweepWatch for Works {
    fn done(&mut self, _: usize, _: usize) {}
    fn ended(&self) -> bool {
        false
    }
}

fn all(sweep: &Sweep, path: Option<&Path>) -> Table {
    make(sweep, Shard::WHOLE, path, &mut Works).unwrap()
}

/// The file with the numbers of a sample written in: no table of parameters, and in strings no names.
fn written_in(text: &str, values: &[(&str, String)]) -> String {
    let (before, rest) = text.split_once("[parameter]\n").unwrap();
    let table = rest.split("\n[[").next().unwrap();
    let mut out = format!("{before}{}", &rest[table.len()..]);
    for (name, value) in values {
        let mut next = String::new();
        let mut inside = false;
        let mut word = String::new();
        for c in out.chars().chain(['\n']) {
            if inside && (c.is_ascii_alphanumeric() || c == '_') {
                word.push(c);
                continue;
            }
            next += &if word == *name {
                format!("({value})")
            } else {
                word.clone()
            };
            word.clear();
            inside ^= c == '"';
            next.push(c);
        }
        out = next;
    }
    out
}

/// What the other commands say of the mechanism of a row, found on a path of its own.
fn as_others_say(m: &Mechanism, row: &SampleRow, search: Option<&Request>) {
    let states: Vec<StateId> = m.state_ids().collect();
    let found = analyse(m, &states, Method::Auto).unwrap();
    assert_eq!(row.states.len(), found.len());
    for (state, found) in row.states.iter().zip(&found) {
        assert_eq!(state.state, found.state);
        assert_eq!(
            (state.mobility, state.redundant),
            (found.mobility, found.redundant)
        );
        let shares: Vec<usize> = found.per_contour.iter().map(|c| c.redundant).collect();
        assert_eq!(state.per_contour, shares);
        assert_eq!(state.certainty, found.certainty.word());
        assert_eq!(state.finite_mobility, found.finite.figure());
    }
    if let Some(request) = search {
        let outcome = ozols::search(m, request).unwrap();
        let told = row.redesigns.as_ref().unwrap().get().unwrap();
        assert_eq!(told.admissible, outcome.admissible.total.to_string());
        assert_eq!(told.determinate, outcome.determinate.total.to_string());
        // The best are the first of the list as long as they cost the same.
        let list: Vec<_> = outcome.variants().collect();
        let first = list[0].cost_milli();
        assert!(
            list.last().unwrap().cost_milli() > first,
            "the list is long enough"
        );
        let words = |v: &ozols::Variant<'_>| v.to_string().split_once(": ").unwrap().1.to_owned();
        let mut best: Vec<String> = list
            .iter()
            .take_while(|v| v.cost_milli() == first)
            .map(words)
            .collect();
        best.sort();
        assert_eq!(told.best, best);
        assert!(told.proven);
        let ranking: Vec<(String, f64)> =
            list.iter().take(3).map(|v| (words(v), v.cost())).collect();
        let told: Vec<(String, f64)> = told
            .ranking
            .iter()
            .map(|r| (r.changes.clone(), r.cost))
            .collect();
        assert_eq!(told, ranking);
    }
}

#[test]
fn a_row_is_what_the_other_commands_say_of_the_numbers_written_in() {
    let search = Request {
        list: List::Top(60),
        check: Check::Prime,
        ..Request::default()
    };
    for sampling in [
        Sampling::Grid { points: 3 },
        Sampling::Sobol { count: 4, seed: 3 },
    ] {
        let text = three_rods();
        let asked = SweepRequest {
            search: Some(Request::default()),
            ..asked()
        };
        let sweep = sweep(&text, sampling, asked);
        let table = all(&sweep, None);
        assert_eq!(table.rows.len(), sweep.space.len());
        for row in &table.rows {
            let sample = sweep.space.sample(row.sample);
            // As exact as a sample is, which decimals would not be.
            let value = |name: &str| match sample.values[name].to_string().split_once('.') {
                Some((whole, part)) => format!("{whole}{part}/10^{}", part.len()),
                None => sample.values[name].to_string(),
            };
            let values = ["height", "offset"].map(|n| (n, value(n)));
            let text = written_in(&text, &values);
            let m = mechanism_from_str("written.toml", &text).unwrap();
            as_others_say(&m, row, Some(&search));
        }
    }
}

#[test]
fn the_peak_force_is_the_greatest_that_statics_gives_over_the_stroke() {
    let sweep = sweep(LOADED, Sampling::Grid { points: 3 }, asked());
    let table = all(&sweep, None);
    assert_eq!(table.rows.len(), 9);
    for row in &table.rows {
        let sample = sweep.space.sample(row.sample);
        let values = [
            ("x", sample.values["x"].to_string()),
            ("y", sample.values["y"].to_string()),
            ("rod", "96".to_owned()),
        ];
        let m = mechanism_from_str("written.toml", &written_in(LOADED, &values)).unwrap();
        as_others_say(&m, row, None);
        let SolvedReactions::Planar(found) =
            solve(&m, StateId::FREE, m.loads.stroke, Model::Planar).unwrap()
        else {
            panic!("it is planar")
        };
        let reactions = found
            .moments
            .iter()
            .flat_map(|x| &x.whole.as_ref().unwrap().reactions);
        let most = reactions
            .map(|r| r.force[0].hypot(r.force[1]))
            .fold(0.0, f64::max);
        let told = row.forces.as_ref().unwrap().get().unwrap();
        assert!(
            (told.peak_force - most).abs() <= 1e-5 * most,
            "{told:?} {most}"
        );
        assert!(told.complete && told.unique && told.positions == 4);
    }
    // By hand, at the pose of the file: the rod bears 100 N over its cosine, and so does the crank's pin, the greatest there is.
    let at_rest = LOADED.replace(
        "to = \"30deg\"\nsteps = 3",
        "to = \"0.000001deg\"\nsteps = 1",
    );
    let sweep = crate::sweep::sweep(&at_rest, Sampling::Grid { points: 2 }, asked());
    for row in all(&sweep, None).rows {
        let (y, told) = (row.at["y"], row.forces.as_ref().unwrap().get().unwrap());
        let by_hand = 100.0 * 96f64.hypot(y) / 96.0;
        assert!(
            (told.peak_force - by_hand).abs() < 1e-3,
            "{told:?} {by_hand}"
        );
        // Both pins of the rod bear as much: the first of equals is told.
        assert_eq!(told.joint, "0-1");
    }
}

#[test]
fn a_special_geometry_is_found_exactly_where_an_expression_makes_it() {
    // The third rod is equal where a² is 2, and nowhere else, however near.
    let text = three_rods()
        .replace(
            "offset = { range = [-2, 2], default = 0 }",
            "a = { values = [1.41421356, \"sqrt(2)\", 1.41421357] }",
        )
        .replace("600 + offset", "600 + a^2 - 2");
    let table = all(&sweep(&text, Sampling::Grid { points: 2 }, asked()), None);
    let free = |r: &SampleRow| {
        (
            r.exact.contains_key("a"),
            r.states[0].redundant,
            r.states[0].certainty.clone(),
        )
    };
    for row in &table.rows {
        match free(row) {
            (true, redundant, certainty) => {
                assert_eq!((redundant, certainty.as_str()), (7, "proven"))
            }
            // Digits so near may be meant for it; what is said with certainty is never that they are.
            (false, 6, _) => {}
            (false, redundant, certainty) => {
                assert_eq!((redundant, certainty.as_str()), (7, "snapped"))
            }
        }
    }
    let written = SweepRequest {
        as_written: true,
        ..asked()
    };
    let table = all(&sweep(&text, Sampling::Grid { points: 2 }, written), None);
    let special = table.rows.iter().filter(|r| r.states[0].redundant == 7);
    assert!(special.clone().count() == 2 && special.clone().all(|r| r.exact.contains_key("a")));
}

#[test]
fn a_summary_says_what_holds_at_the_samples_and_no_more() {
    let asked = SweepRequest {
        search: Some(Request::default()),
        ..asked()
    };
    let table = all(
        &sweep(&three_rods(), Sampling::Grid { points: 3 }, asked),
        None,
    );
    let summary = table.summary();
    let free = &summary.redundant[0];
    let figures: Vec<_> = free
        .by_figure
        .iter()
        .map(|(f, t)| (*f, t.samples))
        .collect();
    assert_eq!(figures, [((6, 6), 6), ((7, 7), 3)]);
    let special: Vec<f64> = free
        .special
        .iter()
        .map(|&i| table.rows[i].at["offset"])
        .collect();
    assert_eq!(special, [0.0; 3]);
    // Counted by hand from the rows.
    let best = summary.best.unwrap();
    let of = |words: &str| {
        let has = |r: &&SampleRow| {
            r.redesigns
                .as_ref()
                .unwrap()
                .get()
                .unwrap()
                .best
                .iter()
                .any(|b| b == words)
        };
        table.rows.iter().filter(has).count()
    };
    assert_eq!((best.samples, best.without, best.unproven), (9, 0, 0));
    for (words, tally) in &best.anywhere {
        assert_eq!(tally.samples, of(words), "{words}");
    }
    assert_eq!(
        best.everywhere().count(),
        best.anywhere.iter().filter(|(w, _)| of(w) == 9).count()
    );
}

#[test]
fn strokes_states_and_methods_are_swept_too() {
    let asked = SweepRequest {
        stroke: Some((
            "0:20deg:2".to_owned(),
            ozols::file::read::workload::motion::stroke("0:20deg:2").unwrap(),
        )),
        methods: true,
        ..asked()
    };
    let text = three_rods();
    let table = all(&sweep(&text, Sampling::Grid { points: 3 }, asked), None);
    for row in &table.rows {
        let moves = row.at["offset"] == 0.0;
        let stroke = row.stroke["free"].get();
        assert_eq!(
            stroke.is_some_and(|s| s.complete && s.poses == 3),
            moves,
            "{row:?}"
        );
        // What moves is proven, and what does not, so that methods can be judged: a counting formula gives -6 everywhere.
        assert_eq!(row.methods["count"], "wrong");
        assert_eq!(row.methods["auto"], "right");
    }
}

/// Positions of a sliding drive are in the file's unit, as its stroke is, and so are the ranges in which forces act.
#[test]
fn sliding_drives_are_told_in_the_files_unit() {
    let text = LOADED
        .replacen("drive = true\n", "", 1)
        .replace("axis = [1, 0, 0]\n", "axis = [1, 0, 0]\ndrive = true\n")
        .replace("to = \"30deg\"\nsteps = 3", "to = 8\nsteps = 4")
        .replace(
            "force = [-100, 0, 0]\n",
            "force = [-100, 0, 0]\nfrom = 3\nto = 5\n",
        );
    let table = all(&sweep(&text, Sampling::Grid { points: 2 }, asked()), None);
    for row in &table.rows {
        let told = row.forces.as_ref().unwrap().get().unwrap();
        // Of 0, 2, 4, 6 and 8 mm the one where the force acts.
        assert!((told.drive_position - 4.0).abs() < 1e-6, "{told:?}");
        assert!(told.peak_force > 99.0 && told.complete);
    }
}

/// Of two figures that are as common the lesser is the common one, and what has more is special; strokes that end early have no
/// say in the greatest and the least peak.
#[test]
fn ties_and_strokes_that_end_early_are_told_apart() {
    use ozols::sweep::forces::Forces;
    use ozols::sweep::known_or_why::Known;
    let mut table = all(&sweep(LOADED, Sampling::Grid { points: 2 }, asked()), None);
    table.rows.truncate(5);
    let peak = |peak_force: f64, complete| {
        Some(Known::Yes(Forces {
            peak_force,
            joint: "1-2".to_owned(),
            drive_position: 0.0,
            positions: 4,
            complete,
            unique: true,
        }))
    };
    let rows = [
        (7, peak(1.0, false)),
        (6, peak(5.0, true)),
        (6, peak(9.0, false)),
        (7, peak(3.0, true)),
        (8, peak(5.0, true)),
    ];
    for (row, (redundant, forces)) in table.rows.iter_mut().zip(rows) {
        (row.states[0].redundant, row.forces) = (redundant, forces);
    }
    let summary = table.summary();
    assert_eq!(summary.redundant[0].special, [0, 3, 4]);
    let peaks = summary.peaks.unwrap();
    // The first of several that are as great.
    assert_eq!(peaks.least_and_greatest, Some([3, 1]));
    assert_eq!((peaks.samples, peaks.incomplete), (5, 2));
}
