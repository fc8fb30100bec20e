//! An idea and a variant of the same number are two mechanisms, and each says which it is.

use crate::common::{out, run, text};

fn named(which: &str, k: &str) -> (String, String) {
    let export = out(&["export", "four-bar", which, k, "--to", "toml"]);
    let draw = out(&["draw", "four-bar", which, k]);
    (export, draw)
}

#[test]
fn files_names_and_titles_say_which() {
    let (idea, drawn) = named("--idea", "3");
    assert!(idea.contains("name = \"four-bar-idea-3\""), "{idea}");
    assert!(idea.contains("Idea 3 of four-bar: "), "{idea}");
    assert!(drawn.contains("idea 3") && !drawn.contains("variant 3"));
    let (variant, other) = named("--variant", "3");
    assert!(
        variant.contains("name = \"four-bar-variant-3\""),
        "{variant}"
    );
    assert!(variant.contains("Variant 3 of four-bar: "), "{variant}");
    assert!(other.contains("variant 3") && !other.contains("idea 3"));
    assert_ne!(idea, variant);
}

#[test]
fn what_is_not_there_is_called_what_was_asked_for() {
    for (which, one) in [("--idea", "idea"), ("--variant", "variant")] {
        let o = run(&["draw", "four-bar", which, "99"]);
        let said = text(&o.stderr);
        assert!(
            said.contains(&format!("four-bar has no {one} 99")),
            "{said}"
        );
    }
}

#[test]
fn the_page_gives_commands_that_say_which() {
    let page = out(&["report", "four-bar"]);
    for one in ["idea", "variant"] {
        let file = format!("--{one} {{}} -o four-bar-{one}-{{}}.svg");
        assert!(page.contains(&file), "{one}");
    }
    let ideas = out(&["report", "four-bar", "--distinct"]);
    assert!(ideas.contains("--idea {} -o four-bar-idea-{}.svg"));
    assert!(!ideas.contains("four-bar-variant-{}"));
}
