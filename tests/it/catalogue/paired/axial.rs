//! Three jaws round the axis along which their drive slides, each in a plane of its own: wedge chucks, fingers on a piston.

use super::super::carried_on::scattered_numbers;
use super::{
    Built, LAID, are_images, built, known_three, number, path_in, pulls_as_its_file_says,
    query_rows, scheme_in, stdout_of,
};
use crate::common::*;

/// Every structure of up to eight links, without the weight of a part, which acts across all planes.
fn axial() -> &'static str {
    static FILE: Built = OnceLock::new();
    static SPEC: OnceLock<tempfile::NamedTempFile> = OnceLock::new();
    let spec = SPEC.get_or_init(|| {
        let file = tempfile::NamedTempFile::new().unwrap();
        let text = "links = \"4..8\"\njaws = 3\ninputs = [\"slide\"]\nsymmetries = [\"threefold\"]\n\
             pairs = [\"slide\", \"gear\", \"slot\"]\nideas = 1\n[workload]\npart = 0\n";
        fs::write(file.path(), text).unwrap();
        file
    });
    built(&FILE, &format!("--spec {}", spec.path().display()))
}

/// A side of one link has three constraints at frame and driver: one pair of two freedoms, one of one. Teeth want a hinge beside
/// them, a pin in a slot a hinge or a slide: six ways, by hand.
#[test]
fn sides_of_one_link_are_six() {
    let found = query_rows(
        axial(),
        "SELECT count(*) AS n FROM structures WHERE links = 5",
    );
    assert_eq!(number(&found[0], "n"), 6.0);
}

#[test]
fn forces_and_strokes_are_those_of_the_files_statics_in_space() {
    let folder = tempdir().unwrap();
    let all = query_rows(axial(), LAID);
    // All of them: where a pose is not proven to be a regular one, others are looked for.
    assert_eq!(all.len(), 46);
    for row in &all {
        assert_eq!(row["finite"], "1, proven");
        assert_eq!(row["mobility"], 1);
    }
    let of = |i: u64| usize::try_from(i % all.len() as u64).unwrap();
    let drawn: BTreeSet<usize> = scattered_numbers(5).take(10).map(of).collect();
    for &i in &drawn {
        pulls_as_its_file_says(axial(), &all[i], &folder);
    }
}

#[test]
fn sides_in_planes_of_their_own_are_images_of_each_other() {
    are_images(axial());
}

/// Well-known schemes whose sides meet at frame and driver alone have three jaws, too, among them the three-jaw scroll that is told.
#[test]
fn well_known_schemes_have_three_jaws() {
    let file = known_three();
    let sql = "SELECT c.id, s.links, s.joints, l.redundant, s.input FROM classics c JOIN structures s ON s.id = c.structure \
         JOIN layouts l ON l.structure = s.id JOIN strokes k ON k.structure = s.id WHERE shortfall IS NULL";
    let found = query_rows(file, sql);
    let of = |id: &str| found.iter().find(|r| r["id"] == id).unwrap();
    // By hand, the scroll with three jaws: frame, disc and jaws; the disc turns in the frame, and each jaw slides in the frame and has
    // a slot on the disc.
    let ours = of("scroll-two-jaws");
    assert_eq!(
        (ours["links"].as_u64(), ours["joints"].as_u64()),
        (Some(5), Some(1 + 3 * 2))
    );
    // In space each side of a wedge is one contour of 5 + 5 + 4 constraints and one motion with its slides: three redundant ones; with
    // flat faces four.
    assert_eq!(number(of("wedge-hook"), "redundant"), 9.0);
    assert_eq!(number(of("wedge-flat-faces"), "redundant"), 12.0);
    for id in [
        "parallelogram-piston",
        "toggle-sliding-jaws",
        "wedge-levers",
    ] {
        assert_eq!(of(id)["input"], "slide", "{id}");
    }
    let shown = stdout_of(&["catalog", "show", file, &scheme_in(file, "wedge-hook")]);
    has(&shown, "With two jaws known as wedge-hook");
}

/// Three sides that are alike are found by two of them, in a plane or round an axis, with the catalogue's own entry.
#[test]
fn sides_of_three_jaws_are_found() {
    let folder = tempdir().unwrap();
    let file = known_three();
    let all = query_rows(
        file,
        "SELECT structure, group_concat(id) AS ids FROM classics GROUP BY structure",
    );
    assert_eq!(all.len(), 21);
    for row in &all {
        let id = row["structure"].as_str().unwrap();
        let toml = path_in(&folder, "chuck.toml");
        stdout_of(&["catalog", "export", file, id, "-o", &toml]);
        let found = stdout_of(&["catalog", "find", &toml, "--in", file]);
        assert!(
            found.contains("three equal sides") && found.contains(id),
            "{id}: {found}"
        );
        for known in row["ids"].as_str().unwrap().split(',') {
            assert!(
                found.contains(&format!("Known as {known}:")),
                "{known}: {found}"
            );
        }
    }
}
