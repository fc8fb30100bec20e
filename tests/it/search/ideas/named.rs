//! An idea and a variant of the same number are two mechanisms, and each says which it is.

use crate::common::*;
use ozols::score::request::Inserts;
use ozols::search::answer::ideas::Idea;

fn named(which: &str, k: &str) -> (String, String) {
    let export = run_quiet(&["export", "four-bar", which, k, "--to", "toml"]);
    let draw = run_quiet(&["draw", "four-bar", which, k]);
    (export, draw)
}

#[test]
fn files_names_and_titles_say_which() {
    let (idea, drawn) = named("--idea", "3");
    has(&idea, "name = \"four-bar-idea-3\"");
    has(&idea, "Idea 3 of four-bar: ");
    assert!(drawn.contains("idea 3") && !drawn.contains("variant 3"));
    let (variant, other) = named("--variant", "3");
    has(&variant, "name = \"four-bar-variant-3\"");
    has(&variant, "Variant 3 of four-bar: ");
    assert!(other.contains("variant 3") && !other.contains("idea 3"));
    assert_ne!(idea, variant);
}

#[test]
fn what_is_not_there_is_called_what_was_asked_for() {
    for (which, one) in [("--idea", "idea"), ("--variant", "variant")] {
        let o = run(&["draw", "four-bar", which, "99"]);
        let said = utf8_text(&o.stderr);
        has(&said, &format!("four-bar has no {one} 99"));
    }
}

#[test]
fn the_page_gives_commands_that_say_which() {
    let page = run_quiet("report four-bar");
    for one in ["idea", "variant"] {
        let file = format!("--{one} {{}} -o four-bar-{one}-{{}}.svg");
        assert!(page.contains(&file), "{one}");
    }
    let ideas = run_quiet("report four-bar --distinct");
    assert!(ideas.contains("--idea {} -o four-bar-idea-{}.svg"));
    assert!(!ideas.contains("four-bar-variant-{}"));
}

/// A four-bar has three redundant constraints, and balls alone do not rid it of its slides across: of an idea that moves in one way
/// the freedoms that are added are three, those of joints put in series among them.
#[test]
fn freedoms_of_unloading_joints_are_named_and_counted() {
    let request = Request {
        options: vec!["revolute".to_owned(), "spherical".to_owned()],
        unloading: vec![Inserts {
            names: vec!["prismatic".to_owned()],
            joints: ["0-1", "1-2", "2-3", "3-0"].map(str::to_owned).into(),
        }],
        max_mobility: Some(1),
        ..Request::default()
    };
    let outcome = ozols::search(&built_in("four-bar"), &request).unwrap();
    let ideas = outcome
        .search
        .list_ideas(outcome.diagrams.as_ref().unwrap(), 20);
    assert!(!ideas.is_empty());
    for idea in &ideas {
        let added: u32 = idea.added.iter().map(|a| u32::from(a.times)).sum();
        assert_eq!(added, 3, "{:?}", idea.added);
        let slides = idea
            .added
            .iter()
            .any(|a| a.freedom.starts_with("slide along"));
        assert!(slides, "{:?}", idea.added);
    }
}

/// Four-bars on the frame, side by side, their hinges along a direction; the first hinge has the motor, or none.
fn four_bars(places: &[[[i32; 3]; 4]], axis: [i32; 3], driven: bool) -> Mechanism {
    let (mut links, mut joints) = ("0".to_owned(), String::new());
    for (k, at) in places.iter().enumerate() {
        links += &format!(" a{k} b{k}* c{k}");
        let names = [
            "0".to_owned(),
            format!("a{k}"),
            format!("b{k}"),
            format!("c{k}"),
        ];
        for (i, place) in at.iter().enumerate() {
            let (from, to) = (&names[i], &names[(i + 1) % 4]);
            let (place, axis) = (commas(place), commas(axis));
            let drive = driven && k == 0 && i == 0;
            joints += &format!("{from}-{to} | {from} {to} | revolute | {place} | {axis}");
            // Named at the joint, so that one with the motor has them, too.
            joints += &format!(
                " | drive = {drive}\\noptions = [\"revolute\", \"cylindrical\", \"spherical\"]\n"
            );
        }
    }
    read(&write_mechanism("name = \"four\"", &links, &joints))
}

fn ideas(m: &Mechanism) -> Vec<Idea> {
    let outcome = ozols::search(m, &Request::default()).unwrap();
    let diagrams = outcome.diagrams.as_ref().unwrap();
    outcome.search.list_ideas(diagrams, 1000)
}

/// A direction and its opposite are one, and its first part that is not 0 is told as positive.
#[test]
fn oblique_directions_are_told_one_way() {
    let across = [[0, 0, 0], [1, 9, 12], [7, 12, 16], [9, 3, 4]];
    for axis in [[0, -4, 3], [0, 4, -3]] {
        let ideas = ideas(&four_bars(&[across], axis, false));
        let added: Vec<_> = ideas.iter().flat_map(|i| &i.added).collect();
        let slide = "slide along (0.000 0.800 -0.600)";
        assert!(added.iter().any(|a| a.freedom == slide), "{added:?}");
        assert!(added.iter().all(|a| !a.freedom.contains("(0.000 -0.800")));
    }
}

const RIGHT: [[i32; 3]; 4] = [[1, 0, 0], [3, 4, 0], [9, 5, 0], [11, 1, 0]];

/// Of two four-bars that are each other's image each has a ideas of its own, and both together a (a + 1) / 2 without the images. A
/// motor in one of them tells the sides apart: a² then.
#[test]
fn a_motor_tells_the_sides_apart() {
    let left = RIGHT.map(|[x, y, z]| [-x, y, z]);
    let one = ideas(&four_bars(&[RIGHT], [0, 0, 1], false)).len();
    let both = |driven| ideas(&four_bars(&[RIGHT, left], [0, 0, 1], driven)).len();
    assert!(one > 1);
    assert_eq!((both(false), both(true)), (one * (one + 1) / 2, one * one));
}

/// Two of three joints are to be changed, for as much whichever they are, where the motor's costs nothing more: it stays.
#[test]
fn the_motor_stays_where_it_can() {
    for driven in ["0-a0", "c0-0"] {
        let mut m = four_bars(&[RIGHT], [0, 0, 1], false);
        let [motor, left_out] = [driven, "b0-c0"].map(|id| m.joint_named(id).unwrap());
        m.edit().joints[left_out].options.truncate(1);
        m.edit().joints[motor].drive = true;
        m.edit().search.costs.driven_milli = Some(0);
        let outcome = ozols::search(&m, &Request::default()).unwrap();
        let ideas = outcome
            .search
            .list_ideas(outcome.diagrams.as_ref().unwrap(), 1);
        let variables = outcome.search.space.variables.iter();
        let chosen = variables.zip(&ideas[0].first.choices);
        let changed: Vec<_> = chosen.filter(|(_, choice)| **choice != 0).collect();
        assert_eq!(changed.len(), 2);
        assert!(
            changed.iter().all(|(v, _)| !v.joints.contains(&motor)),
            "{driven}"
        );
    }
}
