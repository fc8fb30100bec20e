//! The workload of a catalogue: what the drive must do for it, by hand and by virtual work.

use super::command::{path_in, query_rows};
use super::stroke::read_layout;
use super::{each_structure, form_of, layout};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::file::write;
use ozols::synthesis::mechanism::mechanism_file;

/// What the drive of a file bears, in N or N·m, by the equilibrium of all links.
fn effort(file: &str) -> f64 {
    let found = run_json(&["statics", "--planar", file, "--format", "json"]);
    let reactions = found["positions"][0]["reactions"].list().iter();
    reactions
        .filter_map(|r| r["effort"].as_f64())
        .exactly_one()
        .unwrap()
}

const SPEC: &str = r#"
links = "6"
inputs = ["slide"]
symmetries = ["mirror"]
parallel = "without"
ideas = 2
[workload]
closing = 250
part = 0
"#;

/// Two jaws hinged in the frame, each pushed by a rod from the slider: moments about the hinge and the slider's balance,
/// with the lever arms read off the file.
#[test]
fn the_force_ratio_is_that_of_the_lever_arms() {
    let folder = tempdir().unwrap();
    let [spec, db, file] = ["spec.toml", "g.db", "m.toml"].map(|n| path_in(&folder, n));
    fs::write(&spec, SPEC).unwrap();
    stdout_of(&format!("catalog build --spec {spec} --quiet -o {db}"));
    let id = "E`hW 4-5 0,2 slide mirror";
    stdout_of(&["catalog", "export", &db, id, "-o", &file]);
    let m = ozols::open(&file).unwrap();
    let pin = |name: &str| {
        let [x, y, _] = to_vector(&m.joints[m.joint_named(name).unwrap()].frame.point);
        [x, y]
    };
    let [hinge, rod, far] = ["jaw-a.frame", "jaw-a.link-1", "link-1.slider"].map(pin);
    let push = m.loads.forces.iter().find(|f| to_vector(&f.force)[1] > 0.0);
    let [tip, force] = push
        .map(|f| [to_vector(&f.point), to_vector(&f.force)])
        .unwrap();
    assert_eq!((force, m.loads.forces.len()), ([0.0, 250.0, 0.0], 2));
    // Along the rod from the jaw, as a multiple of its length: moments about the hinge vanish.
    let along = [far[0] - rod[0], far[1] - rod[1]];
    let lever = (rod[0] - hinge[0]) * along[1] - (rod[1] - hinge[1]) * along[0];
    let pull = -(tip[0] - hinge[0]) * 250.0 / lever;
    let drive = 2.0 * pull * along[0];
    let found = effort(&file);
    assert!(
        (found.abs() - drive.abs()).abs() < 1e-9 * drive.abs(),
        "{found} {drive}"
    );
    // The file keeps what it was made for, and another workload is another catalogue.
    let sql = "SELECT value FROM meta WHERE key = 'spec'";
    has(&stdout_of(&["catalog", "query", &db, sql]), "closing = 250");
    fs::write(&spec, SPEC.replace("250", "251")).unwrap();
    assert_fails(&format!("catalog build --spec {spec} -o {db}"), "closing");
}

/// Reactions are in proportion to a workload of one force.
#[test]
fn peaks_grow_with_the_closing_force() {
    let folder = tempdir().unwrap();
    let spec = path_in(&folder, "spec.toml");
    let peaks = |closing: &str| -> Vec<f64> {
        fs::write(&spec, SPEC.replace("250", closing)).unwrap();
        let db = path_in(&folder, &format!("{closing}.db"));
        stdout_of(&format!("catalog build --spec {spec} --quiet -o {db}"));
        let rows = query_rows(
            &db,
            "SELECT peak_force FROM ideas ORDER BY structure, place",
        );
        rows.iter().map(|r| r["peak_force"].real()).collect()
    };
    let (one, three) = (peaks("100"), peaks("300"));
    assert!(!one.is_empty() && one.iter().all(|p| *p > 0.0));
    for (a, b) in one.iter().zip(&three) {
        near(*b, 3.0 * a, 1e-3 * b);
    }
}

/// What all forces and weights do in a small motion of the drive, the drive does: places by solving all pins afresh, masses
/// as rods from the middle of a link's points.
#[test]
fn the_drive_does_the_work_of_part_and_links() {
    let workload = Workload {
        closing: 40.0,
        part: 0.7,
        gravity: [3.0, -9.81, -1.0],
        link_mass: 2.5,
    };
    let folder = tempdir().unwrap();
    let forms = [
        form_of(Input::Slide, Symmetry::Generic, false),
        form_of(Input::Turn, Symmetry::Generic, false),
    ];
    let (mut n, mut tried) = (0, 0);
    each_structure(6, &forms, |_, s| {
        n += 1;
        if n % 11 != 0 {
            return;
        }
        let l = layout(&s, &Limits::default(), 1).unwrap();
        let file = mechanism_file(&s, &l, &Spec::default().option_menu().unwrap(), &workload);
        let path = path_in(&folder, &format!("{n}.toml"));
        fs::write(&path, write::toml(&file).unwrap()).unwrap();
        // Points that forces act at, with the force in the plane.
        let mut acting: Vec<(usize, [f64; 2], [f64; 2])> = Vec::new();
        for link in (0..s.structure.chain.links()).filter(|&k| k != s.structure.roles.frame) {
            let jaw = s.structure.roles.jaws.iter().position(|&j| j == link);
            let pins = l.pins.iter().zip(&l.at);
            let mut points: Vec<[f64; 2]> = pins
                .filter(|((u, v), _)| *u == link || *v == link)
                .map(|(_, p)| p.real())
                .collect();
            if let Some(jaw) = jaw {
                let tip = l.tips[jaw].real();
                let away = tip[1].signum() * 40.0;
                acting.push((link, tip, [0.35 * 3.0, away - 0.35 * 9.81]));
                points.push(tip);
            }
            let count = points.len() as f64;
            let middle = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / count);
            for p in points {
                let rod = (p[0] - middle[0]).hypot(p[1] - middle[1]);
                let mass = 2.5 * rod / 1000.0;
                let half = [0, 1].map(|k| (p[k] + middle[k]) / 2.0);
                acting.push((link, half, [3.0 * mass, -9.81 * mass]));
            }
        }
        let twin = read_layout(&s, &l);
        let pose = twin.seen(twin.drawn());
        let work = acting.iter().map(|&(link, p, f)| {
            let [x, y] = pose.speed(link, p);
            f[0] * x + f[1] * y
        });
        // N, or N·m for N·mm.
        let metre = if s.drive_input() == Input::Slide {
            1.0
        } else {
            1000.0
        };
        let asked = work.sum::<f64>() / pose.drive() / metre;
        let found = effort(&path);
        tried += 1;
        assert!(
            (found + asked).abs() < 1e-4 * asked.abs().max(1.0),
            "{}: {found} {asked}",
            s.name()
        );
    });
    assert!(tried > 5, "{tried}");
}
