//! A file with more than it may have.

use super::bad_files::{bad_file, with};
use super::four_bar;
use crate::common::*;

/// What is beyond a limit is refused, and not left out.
#[test]
fn error_too_many_entries() {
    let many = |n: usize, entry: &str| vec![entry; n].join(", ");
    for (what, text) in [
        (
            "options",
            with(
                "options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]",
                &format!("options = [{}]", many(65, "\"spherical\"")),
            ),
        ),
        (
            "states",
            four_bar()
                + &format!(
                    "[ranking]\nterms = [{{ term = \"cost\" }}]\nstates = [{}]\n",
                    many(101, "\"free\"")
                ),
        ),
        (
            "limits",
            four_bar()
                + &format!(
                    "[ranking]\nterms = [{{ term = \"cost\" }}]\nlimits = [{}]\n",
                    many(101, "{ term = \"cost\", max = 9 }")
                ),
        ),
        (
            "forces",
            four_bar()
                + &format!(
                    "[workload]\nforce = [{}]\n",
                    many(
                        10_001,
                        "{ link = \"3\", force = [1, 0, 0], point = [0, 0, 0] }"
                    )
                ),
        ),
        (
            "moments",
            four_bar()
                + &format!(
                    "[workload]\nmoment = [{}]\n",
                    many(10_001, "{ link = \"3\", moment = [0, 0, 1] }")
                ),
        ),
    ] {
        let line = format!("{what} = [")
            .replace("forces", "force")
            .replace("moments", "moment");
        bad_file("many.toml", &text, &line, &[what, "more than the"]);
    }
    let drive = builtin::text("torsion-module").unwrap();
    let line = drive.lines().find(|l| l.starts_with("diameters")).unwrap();
    let text = drive.replace(line, &format!("diameters = [{}]", many(10_001, "3")));
    bad_file(
        "many.toml",
        &text,
        "diameters = [",
        &["10001 diameters, more than the 10000"],
    );
}
