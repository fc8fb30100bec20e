//! Mechanism files in TOML and JSON.

use super::readers::mechanism_files::read;
use ozols::file::text::mechanism_from_bytes;

/// A mechanism of one hinge, with more behind its joint.
fn hinge(more: &str) -> String {
    format!(
        "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\nrole = \"output\"\n\
         [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n{more}\n"
    )
}

/// Directions are made shorter by a power of ten, which is then written beside what is no fraction.
#[test]
fn what_is_made_shorter_by_the_largest_number_is_read_again() {
    for largest in ["1e307", "1e308", "-1.7e308"] {
        let axis = format!("axis = [\"2*sqrt(3)\", {largest}, 0]");
        let text = hinge("").replace("axis = [0, 0, 1]", &axis);
        assert_eq!(read("x.toml", text.as_bytes()), "analysed", "{largest}");
    }
}

/// Each mistake was once looked up by reading the whole file again, and all of them were drawn: minutes for a few megabytes.
#[test]
fn of_very_many_mistakes_the_first_are_told() {
    let mirror = r#"["a", "a"], "#.repeat(5000);
    let costs: String = (0..5000).map(|i| format!("b{i} = 1\n")).collect();
    for more in [
        format!("[search]\nmirror = [{mirror}]"),
        format!("[search.costs]\n{costs}"),
        "[[expected]]\nstate = \"nowhere\"\n".repeat(5000),
    ] {
        let e = mechanism_from_bytes("x.toml", hinge(&more).as_bytes()).unwrap_err();
        assert_eq!(e.problems.len(), 101);
        assert!(e.problems[..100].iter().all(|p| p.span.is_some()));
        let last = e.problems[100].kind.to_string();
        assert!(
            last.ends_with("more problems are not listed; correct those above first"),
            "{last}"
        );
    }
}

#[test]
fn lists_have_limits() {
    let words = |n: usize| (0..n).map(|i| format!("\"s{i}\", ")).collect::<String>();
    for (more, said) in [
        (format!("state = [{}]", words(200)), "states"),
        (
            format!("unloading = [{}]", "\"spherical\", ".repeat(65)),
            "65 unloading joints",
        ),
        (
            "[[contour]]\njoints = [\"a\"]\n".repeat(4001),
            "4001 contours",
        ),
    ] {
        let e = mechanism_from_bytes("x.toml", hinge(&more).as_bytes()).unwrap_err();
        let e = e.to_string();
        assert!(e.contains(said) && e.contains("allowed"), "{said}: {e}");
    }
}
