//! Tables say what they leave out, and one name stands for one thing.

use crate::common::*;
use crate::robots::{folder, legs};

/// The rows of a table after a head that begins with `first`.
fn rows<'a>(text: &'a str, first: &str) -> (Vec<&'a str>, Vec<Vec<&'a str>>) {
    let mut lines = text
        .lines()
        .skip_while(|l| !l.trim_start().starts_with(first));
    let cells = |l: &'a str| {
        l.split("  ")
            .map(str::trim)
            .filter(|c| !c.is_empty())
            .collect::<Vec<_>>()
    };
    let head = cells(lines.next().unwrap());
    let body = lines.skip(1).take_while(|l| !l.trim().is_empty());
    (head, body.map(cells).collect())
}

fn count(cell: &str) -> u64 {
    cell.replace(',', "").parse().unwrap()
}

/// The mobilities that no admissible variant has are one row, so that both columns add up to what the first lines say.
#[test]
fn variants_by_mobility_add_up() {
    let text = run_quiet("search gripper-10 --count");
    let (_, body) = rows(&text, "W ");
    assert!(
        body.last().unwrap()[0].starts_with("rest, 12 to "),
        "{text}"
    );
    let column = |i: usize| body.iter().map(|r| count(r[i])).sum::<u64>();
    assert_eq!(column(1), 6_340_592_477);
    assert_eq!(column(2), 25_761_436);
}

/// A robot of many joints has variants of many mobilities: the least are told one by one, the others in a row, and all add up.
#[test]
fn long_tables_of_mobilities_are_folded() {
    let more = ["--count", "--allow-output-change", "--check", "none"];
    let (_, found, _) = run_on("search", "m.xml", &legs(4), &more);
    let (_, body) = rows(&found, "W ");
    assert_eq!(body.len(), 12, "{found}");
    assert_eq!((body[0][0], body[10][0]), ("12", "22"), "{found}");
    assert_eq!(body[11][0], "23 to 36", "{found}");
    let sum: u64 = body.iter().map(|r| count(r[2])).sum();
    let head = found.split("robot: ").nth(1).unwrap();
    assert_eq!(count(head.split(' ').next().unwrap()), sum);
}

/// Runs a command; each line that it writes fits the width, but for what is to be copied.
fn fits(args: &str, folder: &Path, width: usize) -> Output {
    let command = &mut ozols(args);
    let o = command
        .current_dir(folder)
        .env("OZOLS_WIDTH", width.to_string());
    let o = o.output().unwrap();
    let said = utf8_text(&o.stdout);
    let mut lines = said
        .lines()
        .filter(|l| !l.trim_start().starts_with("ozols "));
    let wide = lines.find(|l| l.chars().count() > width);
    assert_eq!(wide, None, "{args:?}");
    o
}

/// What is told of robots with long names fits the width that OZOLS_WIDTH says, and standard error stays silent with -q.
#[test]
fn texts_of_robots_fit() {
    let folder_of_own = tempdir().unwrap();
    let legs_file = folder_of_own.path().join("legs.xml");
    fs::write(&legs_file, legs(3)).unwrap();
    for file in [
        legs_file,
        folder().join("gripper.xml"),
        folder().join("leg.urdf"),
    ] {
        let (of, name) = (file.parent().unwrap(), file.file_name().unwrap());
        for command in [
            "analyze",
            "check",
            "lint",
            "search --top 3 --nodes 20000",
            "statics",
        ] {
            let args = format!("{command} {} -q", name.display());
            let o = fits(&args, of, 80);
            // Statics refuses what it has no forces for.
            if o.status.code() != Some(2) || command != "statics" {
                assert!(matches!(o.status.code(), Some(0 | 1)), "{args:?}");
                assert!(o.stderr.is_empty() && !o.stdout.is_empty(), "{args:?}");
            }
        }
    }
}

/// What every command says fits 80 to 200 columns, but for what is to be copied: commands, and lines of a file.
#[test]
fn texts_fit_the_width_there_is() {
    let lines = "analyze gripper-10/search gripper-10 --top 5/list/check gripper-10/explain universal/explain sphere-in-cylinder\
        /explain class/show costs/statics four-bar/grip lever-gripper/drive torsion-module/catalog count";
    for args in lines.split('/') {
        for width in [80, 120, 200] {
            assert!(
                fits(args, Path::new("."), width).stdout.len() > 20,
                "{args:?}"
            );
        }
    }
}
