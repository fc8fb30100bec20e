//! Layouts with slides, gears and slots, against the statics of their own files over the whole stroke, which solve contours of
//! joints in space.

use crate::common::*;
mod axial;
mod by_hand;
mod flat;
mod made;
mod passing;
mod strongest;
pub(super) mod three_generic;
pub(super) mod twin_figures;

use super::carried_on::scattered_numbers;
use super::command::{path_in, query_lines, query_rows};
use super::pairs::classics::schemes;
use super::pairs::menu;
use ozols::synthesis::structure::listed::symmetric_structures;

/// A catalogue, built once.
pub(super) type Built = OnceLock<(TempDir, String)>;

pub(super) fn built(once: &'static Built, line: &str) -> &'static str {
    let (_, file) = once.get_or_init(|| {
        let folder = tempdir().unwrap();
        let file = path_in(&folder, "grippers.db");
        stdout_of(&format!("catalog build {line} --quiet -o {file}"));
        (folder, file)
    });
    file
}

/// The well-known schemes.
fn known() -> &'static str {
    static FILE: Built = OnceLock::new();
    built(&FILE, "--classics")
}

/// Those that have three jaws, too.
fn known_three() -> &'static str {
    static FILE: Built = OnceLock::new();
    built(&FILE, "--classics --jaws 3 --ideas 1")
}

/// Every structure of up to five links, and of six with a left and a right pair that is no hinge.
fn some() -> &'static str {
    static FILE: Built = OnceLock::new();
    let pairs = "--pairs slide,gear,slot --at-most 2 --symmetry mirror,half-turn";
    built(&FILE, &format!("{pairs} --links 4..6 --ideas=2"))
}

/// Every structure of five links with three jaws: a scroll, three racks on a pinion, levers on a disc of cams.
fn three() -> &'static str {
    static FILE: Built = OnceLock::new();
    let pairs = "--jaws 3 --pairs slide,gear,slot --symmetry threefold";
    built(&FILE, &format!("{pairs} --input turn --links 5 --ideas 2"))
}

/// What a third of a turn carries to each other is searched as such, and its redesigns are as many by the plain command.
#[test]
fn sides_of_three_jaws_are_images_of_each_other() {
    are_images(three());
}

fn are_images(file: &str) {
    let folder = tempdir().unwrap();
    for row in query_rows(
        file,
        "SELECT id, determinate, orbits_w1 FROM structures JOIN layouts ON structure = id",
    ) {
        let toml = path_in(&folder, "chuck.toml");
        stdout_of(&["catalog", "export", file, row["id"].word(), "-o", &toml]);
        let found = run_json(&format!(
            "search {toml} --max-mobility 1 --quiet --format json"
        ));
        assert_eq!(
            found["determinate"],
            row["determinate"].to_string(),
            "{row}"
        );
        let m = ozols::open(&toml).unwrap();
        assert_eq!(m.search.symmetry_order(), 3);
    }
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap()
}

/// A pose of a stroke by the statics of a file.
#[derive(Clone, Copy)]
struct Pulled {
    /// In mm, or rad.
    drive: f64,
    /// In N, or N m.
    effort: f64,
    /// The greatest force of a joint in the plane, in N; of a guide what presses on it.
    joint: f64,
}

/// The force of a joint in its plane of motion: that of x and y, or another, out of which nothing acts then.
fn in_plane(reaction: &Value, flat: bool) -> f64 {
    let force = |frame: &str, k: usize| reaction[frame][k].as_f64().unwrap();
    if reaction["type"] == "prismatic" {
        // Its frame: z along the guide, x square to the plane.
        return force("force", 1).abs();
    }
    let out = if flat { 0.0 } else { force("global_force", 2) };
    force("global_force", 0)
        .hypot(force("global_force", 1))
        .hypot(out)
}

/// Poses from the drawn one on.
fn efforts(toml: &str, to: f64, flat: bool) -> Vec<Pulled> {
    const STEPS: u32 = 60;
    // Where links lock before the end it gives what is reached, with exit code 1.
    let (_, told, _) = run_full(&format!(
        "statics {toml} --stroke 0:{to:?}:{STEPS} --format json"
    ));
    let told: Value = serde_json::from_str(&told).unwrap();
    let pulled = |p: &Value| {
        let reactions = p["reactions"].list();
        let driven = reactions.iter().find(|r| !r["drive"].is_null()).unwrap();
        Pulled {
            drive: number(p, "drive"),
            effort: number(&driven["drive"], "effort"),
            joint: reactions
                .iter()
                .map(|r| in_plane(r, flat))
                .fold(0.0, f64::max),
        }
    };
    let mut out = told["positions"].list().iter().map(pulled).collect_vec();
    out.sort_by(|a, b| a.drive.abs().total_cmp(&b.drive.abs()));
    out
}

/// The poses until so much work is done, N mm, the last between two.
fn until(poses: &[Pulled], work: f64, metre: f64) -> Option<Vec<Pulled>> {
    let (mut done, mut out) = (0.0, vec![poses[0]]);
    for pair in poses.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let part = ((a.effort + b.effort) / 2.0 * (b.drive - a.drive)).abs() * metre;
        if done + part >= work {
            let between = |x: f64, y: f64| x + (y - x) * (work - done) / part;
            out.push(Pulled {
                drive: between(a.drive, b.drive),
                effort: between(a.effort, b.effort),
                joint: between(a.joint, b.joint),
            });
            return Some(out);
        }
        done += part;
        out.push(b);
    }
    None
}

/// The jaws, each pressed on by 100 N, are drawn 30 mm apart: closing them does 3,000 N mm of work and opening them to 50 mm takes
/// 2,000. The drive that does as much by the forces of the file goes as far as the layout says.
fn pulls_as_its_file_says(file: &str, row: &Value, folder: &TempDir) {
    let id = row["id"].as_str().unwrap();
    let toml = path_in(folder, &format!("{id}.toml"));
    stdout_of(&["catalog", "export", file, id, "-o", &toml]);
    let metre = if row["input"] == "turn" { 1000.0 } else { 1.0 };
    let (travel, closes) = (number(row, "travel"), number(row, "closes"));
    let (mut gone, mut all) = (0.0, Vec::new());
    // Three jaws go as far to the middle each.
    let jaws = if row["jaw_c"].is_null() { 2.0 } else { 3.0 };
    let flat = row["symmetry"] != "threefold" || row["input"] == "turn";
    for (way, work) in [(closes, 1500.0 * jaws), (-closes, 1000.0 * jaws)] {
        // Beyond the end links may lock: a little less, where that does.
        let found = [0.8, 0.999]
            .into_iter()
            .find_map(|share| until(&efforts(&toml, way * share * travel, flat), work, metre));
        let found = found.unwrap_or_else(|| panic!("{id}: no end"));
        gone += found.last().unwrap().drive.abs();
        all.extend(found);
    }
    let near = |told: f64, found: f64, what: &str| {
        // A drive that acts on the jaws themselves loads no joint.
        let nothing = told == 0.0 && found < 1e-9;
        assert!(
            nothing || (told / found - 1.0).abs() < 0.02,
            "{id}: {what}: told {told}, found {found}"
        );
    };
    assert!(
        (gone / travel - 1.0).abs() < 2e-3,
        "{id}: travel {travel}, by work {gone}"
    );
    let forces = all.iter().map(|p| 100.0 / p.effort.abs());
    let least = forces.clone().fold(f64::INFINITY, f64::min);
    near(number(row, "force_min"), least, "least force");
    near(
        number(row, "force_max"),
        forces.fold(0.0, f64::max),
        "greatest force",
    );
    // Teeth press on hinges that the one reaction of a coupling leaves out.
    if row["gears"] == 0 {
        let joint = all.iter().map(|p| p.joint / 100.0).fold(0.0, f64::max);
        near(number(row, "pin_force"), joint, "joint force");
    }
}

const LAID: &str = "SELECT id, links, input, symmetry, travel, closes, force_min, force_max, pin_force, gears, finite, certainty, mobility, jaw_c FROM structures \
     JOIN layouts l ON l.structure = id JOIN strokes k ON k.structure = id JOIN pairs p ON p.structure = id WHERE reached = 1 ORDER BY id";

#[test]
fn strokes_are_those_of_the_files_statics() {
    let folder = tempdir().unwrap();
    let well_known = query_rows(known(), LAID);
    assert_eq!(well_known.len(), 34);
    let all = query_rows(some(), LAID);
    let of = |i: u64| usize::try_from(i % all.len() as u64).unwrap();
    let drawn: BTreeSet<usize> = scattered_numbers(11).take(12).map(of).collect();
    for row in well_known.iter().chain(drawn.iter().map(|&i| &all[i])) {
        assert_eq!(row["finite"], "1, proven");
        assert_eq!(row["mobility"], 1);
    }
    // Of the many links one: they take longest, and have no other joints.
    let one = first_of("cam-plate-parallelograms");
    let few = |r: &&Value| number(r, "links") < 8.0 || r["id"] == one;
    for row in well_known.iter().filter(few) {
        pulls_as_its_file_says(known(), row, &folder);
    }
    for &i in &drawn {
        pulls_as_its_file_says(some(), &all[i], &folder);
    }
    let three = query_rows(three(), LAID);
    assert_eq!(three.len(), 8);
    for row in &three {
        assert_eq!(row["finite"], "1, proven");
        pulls_as_its_file_says(self::three(), row, &folder);
    }
}

/// Every scheme that is a structure is there by its name, and does its task.
#[test]
fn well_known_schemes_stand_in_a_catalogue_by_name() {
    let found = query_rows(
        known(),
        "SELECT c.id, g.jaws, g.turn FROM classics c JOIN grippers g ON g.id = c.structure WHERE reached = 1 AND shortfall IS NULL",
    );
    let names: BTreeSet<&str> = found.iter().map(|r| r["id"].as_str().unwrap()).collect();
    let counted = schemes();
    // Three more are outside of the count. One is redundant in the plane already, one has two pairs between the same links, one has
    // a thread.
    let others = [
        ("wedge-flat-faces", "parallel"),
        ("slot-guided-jaws", "general"),
        ("screw-two-nuts", "parallel"),
    ];
    let counted = counted.iter().map(|s| (s.id.as_str(), s.jaws.as_str()));
    let all: BTreeMap<&str, &str> = counted.chain(others).collect();
    assert_eq!(names, all.keys().copied().collect());
    // What translates by structure, or on parallelograms, does not turn.
    for row in &found {
        let jaws = all[row["id"].as_str().unwrap()];
        assert_eq!(row["jaws"] == "parallel", jaws == "parallel", "{row}");
    }
    let shown = |scheme| stdout_of(&["catalog", "show", known(), &first_of(scheme)]);
    has_all(
        &shown("wedge-hook"),
        &["Known as wedge-hook", "5 joints (3 slides, 2 slots)"],
    );
    has(&shown("slot-coupled-jaws"), "(slide against ");
}

fn first_of(scheme: &str) -> String {
    scheme_in(known(), scheme)
}

/// The structure of a catalogue that is a scheme.
fn scheme_in(file: &str, scheme: &str) -> String {
    query_lines(
        file,
        &format!("SELECT structure FROM classics WHERE id = '{scheme}'"),
    )
    .remove(0)
}

/// A catalogue finds its own files again.
#[test]
fn what_is_exported_is_found() {
    let folder = tempdir().unwrap();
    for id in query_lines(known(), "SELECT DISTINCT structure FROM classics") {
        let toml = path_in(&folder, "gripper.toml");
        stdout_of(&["catalog", "export", known(), &id, "-o", &toml]);
        has(
            &stdout_of(&["catalog", "find", &toml, "--in", known()]),
            &id,
        );
    }
}

#[test]
fn what_is_not_laid_out_is_refused() {
    let folder = tempdir().unwrap();
    let file = path_in(&folder, "none.db");
    for [words, says] in read_cases::<2>(
        "
        --pairs cam | \"cam\" is none of slide, gear, slot
        --pairs slide --links 6..9 | at most 8 links
        --pairs slide --jaws 3 --symmetry generic --links 6 | threefold
        --pairs gear --symmetry generic | mirror or half-turn
        --pairs gear --at-most 0 | at_most must be from 1 to 12
        --links 4 --at-most 1 | name them with --pairs
        --classics --links 4 | cannot be used with
        --generic-pairs | --pairs
        --jaws 3 --generic-pairs --symmetry generic --pairs slide --links 4..9 | at most 8 links
        --jaws 3 --generic-pairs --symmetry generic --pairs slide --links 4 --parallel only | each side has its own plane
        --jaws 3 --generic-pairs --symmetry generic --pairs slide --links 3 | three jaws need at least four links
        --jaws 3 --generic-pairs --symmetry generic --pairs slide --links 5 | the number of links is even
        --jaws 3 --generic-pairs --symmetry generic --links 4 | --pairs
        --jaws 3 --generic-pairs --symmetry threefold --pairs slide | free layouts need generic among the symmetries; add --symmetry generic, or omit --generic-pairs
        ",
    ) {
        assert_fails(&format!("catalog build {words} -o {file}"), says);
        assert!(!Path::new(&file).exists(), "{words}");
    }
}

/// A key says all of a structure, and every structure that is counted moves in some symmetric places.
#[test]
fn keys_are_read_back_and_symmetric_structures_lie_somewhere() {
    for links in 4..=6 {
        for paired in symmetric_structures(links, menu(2)) {
            let structure = &paired.structure;
            assert_eq!(
                &PairStructure::of_key(&structure.canonical_key()),
                structure
            );
            assert!(!paired.symmetry_lays().is_empty(), "{}", paired.name());
        }
    }
}
