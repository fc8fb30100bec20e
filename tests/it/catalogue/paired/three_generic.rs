//! Three jaws with slides, gears and slots, laid out without symmetry.

use crate::common::*;
pub(in super::super) mod every_way;

use super::super::carried_on::scattered_numbers;
use super::super::command::{cards_of, dump_catalogue, path_in, query_lines};
use super::{Built, LAID, built, pulls_as_its_file_says, query_rows};
use ozols::chains::PairKind;
use ozols::chains::sharing::Menu;
use ozols::synthesis::structure::listed::generic_structures;

const BUILD: &str = "catalog build --jaws 3 --symmetry generic --generic-pairs --quiet -o";

/// Every structure of four links with two pairs at most that are no hinges.
pub(super) fn free() -> &'static str {
    static FILE: Built = OnceLock::new();
    let pairs = "--jaws 3 --symmetry generic --generic-pairs --pairs slide,gear,slot";
    built(&FILE, &format!("{pairs} --at-most 2 --links 4 --ideas 2"))
}

/// As many as there are by trying all, and these: every chain of labelled links, every choice of roles, up to every numbering.
#[test]
fn structures_are_those_of_every_way_to_join_links_and_to_choose_jaws() {
    let all = [PairKind::Slide, PairKind::Gear, PairKind::Slot];
    let cases = [
        (4, &all[..], 3, 314),
        (4, &all[..1], 4, 22),
        (5, &all[2..], 3, 1_399),
    ];
    for (links, kinds, most, count) in cases {
        let own = generic_structures(links, 3, Menu { kinds, most });
        let codes: BTreeSet<_> = own.iter().map(|p| every_way::code(&p.structure)).collect();
        assert_eq!(codes.len(), own.len(), "{links} links: twice the same");
        let tried = every_way::grippers(links, kinds, most);
        let both = codes.symmetric_difference(&tried).count();
        assert_eq!((both, tried.len()), (0, count), "{links} links, {kinds:?}");
    }
}

/// Hinges and a drive that slides in the frame beside jaws that are not driven make what is counted without pairs: 31 for each
/// input.
#[test]
fn hinges_alone_make_what_is_counted_without_pairs() {
    let kinds = &[PairKind::Slide];
    let all = generic_structures(6, 3, Menu { kinds, most: 1 });
    let hinged = all.iter().filter(|p| p.is_hinged());
    let (slides, turns): (Vec<_>, Vec<_>) = hinged.partition(|p| p.structure.input_slides());
    assert_eq!([slides.len(), turns.len()], [31, 31]);
}

#[test]
fn keys_of_three_jaws_are_read_back() {
    let kinds = &[PairKind::Slide, PairKind::Gear, PairKind::Slot];
    for paired in generic_structures(4, 3, Menu { kinds, most: 3 }) {
        let structure = &paired.structure;
        assert_eq!(
            &PairStructure::of_key(&structure.canonical_key()),
            structure
        );
        assert_eq!(structure.roles.jaws.len(), 3);
    }
}

#[test]
fn forces_and_strokes_are_those_of_the_files_statics() {
    let folder = tempdir().unwrap();
    let all = query_rows(free(), LAID);
    assert!(all.len() > 75, "{}", all.len());
    for row in &all {
        let found = (&row["finite"], &row["mobility"], &row["certainty"]);
        assert_eq!(found, (&"1, proven".into(), &1.into(), &"exact".into()));
    }
    let of = |i: u64| usize::try_from(i % all.len() as u64).unwrap();
    let drawn: BTreeSet<usize> = scattered_numbers(3).take(12).map(of).collect();
    for &i in &drawn {
        pulls_as_its_file_says(free(), &all[i], &folder);
    }
}

/// Ids are those of one structure each, and every exported file is found again, by its own entry alone.
#[test]
fn what_is_laid_out_has_an_id_of_its_own_and_is_found() {
    let folder = tempdir().unwrap();
    let all = query_rows(
        free(),
        "SELECT id, no_layout IS NULL AS laid FROM structures",
    );
    let ids: BTreeSet<&str> = all.iter().map(|r| r["id"].as_str().unwrap()).collect();
    let kinds = &[PairKind::Slide, PairKind::Gear, PairKind::Slot];
    let own = generic_structures(4, 3, Menu { kinds, most: 2 });
    let told: BTreeSet<String> = own.iter().map(|p| p.id()).collect();
    assert_eq!(ids, told.iter().map(String::as_str).collect());
    let laid = all.iter().filter(|r| r["laid"] == 1);
    for row in laid.step_by(3) {
        let id = row["id"].as_str().unwrap();
        let toml = path_in(&folder, "gripper.toml");
        stdout_of(&["catalog", "export", free(), id, "-o", &toml]);
        let found = run_json(&["catalog", "find", &toml, "--in", free(), "--json"]);
        assert_eq!(found["sides"], 1, "{found}");
        let entries = found["catalogue"].as_array().unwrap();
        let [entry] = &entries[..] else {
            panic!("{id}: {found}");
        };
        assert_eq!(entry["id"], id);
    }
}

/// Jaws that slide in the frame go straight to the middle: each along the line from there to its tip, exactly.
#[test]
fn jaws_that_slide_in_the_frame_go_straight_to_the_part() {
    let mut seen = [0; 3];
    for row in query_rows(free(), "SELECT mechanism FROM layouts") {
        let m = ozols::from_toml(row["mechanism"].as_str().unwrap()).unwrap();
        for joint in &m.joints {
            let ends = joint.links.map(|l| m.links[l].id.as_str());
            let jaw = ["jaw-a", "jaw-b", "jaw-c"]
                .iter()
                .position(|j| ends.contains(j));
            let guides = joint.joint_type.freedoms() == [Freedom::Tz] && ends.contains(&"frame");
            let Some(n) = jaw.filter(|_| guides) else {
                continue;
            };
            let [x, y, _] = to_vector(&joint.frame.axis);
            // Upward, and so much more of a turn to the left.
            let angle = TAU / 4.0 + n as f64 * TAU / 3.0;
            let off = (x * angle.sin() - y * angle.cos()) / x.hypot(y);
            assert!(off.abs() < 1e-12, "{}: {x} {y}", joint.id);
            seen[n] += 1;
        }
    }
    assert!(seen.iter().all(|n| *n > 2), "{seen:?}");
}

#[test]
fn it_is_queried_shown_drawn_and_merged() {
    let folder = tempdir().unwrap();
    let [one, merged, page] = ["one.db", "merged.db", "page.html"].map(|n| path_in(&folder, n));
    let build = |file: &str, more: &str| {
        stdout_of(&format!(
            "{BUILD} {file} --pairs slide --links 4..5 --ideas 1 {more}"
        ))
    };
    has(&build(&one, ""), "22 structures added");
    has(&build(&one, "--threads 1"), "0 structures added");
    let parts = [1, 2].map(|i| {
        let part = path_in(&folder, &format!("{i}.db"));
        build(&part, &format!("--shard {i}/2"));
        part
    });
    stdout_of(&["catalog", "merge", &parts[0], &parts[1], "-o", &merged]);
    assert_eq!(dump_catalogue(&merged), dump_catalogue(&one));
    let sql = "SELECT id FROM structures JOIN pairs ON structure = id WHERE slides = 2 AND no_layout IS NULL LIMIT 1";
    let id = &query_lines(&one, sql)[0];
    let shown = stdout_of(&["catalog", "show", &one, id]);
    has_all(
        &shown,
        &["round the part", "laid out generic", "(2 slides)"],
    );
    stdout_of(&["catalog", "page", &one, "-o", &page]);
    let cards = cards_of(&fs::read_to_string(&page).unwrap());
    let card = cards.iter().find(|c| c["id"] == **id).unwrap();
    assert!(card["tip_c_dx"].is_number(), "{card}");
}
