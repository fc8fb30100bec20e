//! A file with more than it may have.

use super::bad_files::{bad_file, with};
use super::four_bar;
use crate::common::*;

/// What is beyond a limit is refused, and not left out.
#[test]
fn error_too_many_entries() {
    let many = |n: usize, entry: &str| vec![entry; n].join(", ");
    for [what, key, head, n, entry] in read_cases::<5>(
        r#"
        states | states | [ranking]\nterms = [{ term = "cost" }]\n | 101 | "free"
        limits | limits | [ranking]\nterms = [{ term = "cost" }]\n | 101 | { term = "cost", max = 9 }
        forces | force | [workload]\n | 10001 | { link = "3", force = [1, 0, 0], point = [0, 0, 0] }
        moments | moment | [workload]\n | 10001 | { link = "3", moment = [0, 0, 1] }
        "#,
    ) {
        let list = many(n.parse().unwrap(), entry);
        let text = format!("{}{head}{key} = [{list}]\n", four_bar());
        let parts = [what, "more than the"];
        bad_file("many.toml", &text, &format!("{key} = ["), &parts);
    }
    let four = "options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    let text = with(four, &format!("options = [{}]", many(65, "\"spherical\"")));
    let parts = ["options", "more than the"];
    bad_file("many.toml", &text, "options = [", &parts);
    let drive = builtin::text("torsion-module").unwrap();
    let line = drive.lines().find(|l| l.starts_with("diameters")).unwrap();
    let text = drive.replace(line, &format!("diameters = [{}]", many(10_001, "3")));
    let parts = ["10001 diameters, more than the 10000"];
    bad_file("many.toml", &text, "diameters = [", &parts);
}
