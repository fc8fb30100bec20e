//! What commands say, phrase by phrase: verdicts first and digits last, directions named, remedies that work.

use crate::common::*;
fn coloured<L: Line + ?Sized>(args: &L, variable: (&str, &str)) -> String {
    let mut command = ozols(args);
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    utf8_text(&command.env(variable.0, variable.1).output().unwrap().stdout)
}

#[test]
fn verdicts_have_colour_where_a_person_looks() {
    for (args, verdict) in [
        ("analyze gripper-10", "^1m^31m11 redundant constraints^0m"),
        ("analyze rssr", "^1m^32mstatically determinate^0m"),
        ("lint four-bar", "^1m^31m3 redundant constraints"),
        ("check four-bar", "^1m^32mvalid^0m"),
        ("search four-bar --top 1", "^1m^3"),
    ] {
        let verdict = verdict.replace('^', "\u{1b}[");
        let forced = coloured(args, ("CLICOLOR_FORCE", "1"));
        assert!(forced.contains(&verdict), "{args:?}: {forced}");
        let plain = coloured(args, ("NO_COLOR", "1"));
        assert!(!plain.contains('\u{1b}'), "{args:?}");
        let bare = forced.replace("\u{1b}[1m", "").replace("\u{1b}[0m", "");
        let bare = bare.replace("\u{1b}[31m", "").replace("\u{1b}[32m", "");
        assert_eq!(bare, plain, "{args:?}");
    }
    // not into a file
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.txt");
    coloured(
        &["analyze", "four-bar", "-o", path.to_str().unwrap()],
        ("CLICOLOR_FORCE", "1"),
    );
    assert!(!fs::read_to_string(path).unwrap().contains('\u{1b}'));
}

#[test]
fn verdicts_come_first_and_primes_last() {
    let said = run_quiet("analyze four-bar --verbose");
    let first = said.lines().next().unwrap();
    has(first, "3 redundant constraints");
    let data = run_json("analyze four-bar --format json");
    let prime = data["states"][0]["primes"][0].word();
    assert_eq!(prime.len(), 19);
    let digits: Vec<&str> = said.lines().filter(|l| l.contains(prime)).collect();
    assert_eq!(digits.len(), 1, "{digits:?}");
    let block = said.split("\n\n").nth(1).unwrap();
    assert_eq!(block.lines().last(), Some(digits[0]));
    assert!(!run_quiet("search four-bar --options spherical").contains(prime));
}

/// A slide across a frame, with an output that does not move with it.
fn slide(axis: &str) -> String {
    let axis = axis.trim_matches(['[', ']']);
    let joints = format!(
        "hinge | 0 1 | revolute | 0, 0, 0 | 0, 0, 1\nslide | 0 2 | prismatic | 1, 0, 0 | {axis}"
    );
    write_mechanism("name = \"slide\"\nlength_unit = \"mm\"", "0 1* 2", &joints)
}

#[test]
fn idle_motions_name_their_direction() {
    let idle = |axis: &str| {
        let (_, said, err) = run_on("analyze", "slide.toml", &slide(axis), "");
        let found = said
            .lines()
            .find_map(|l| l.trim().strip_prefix("idle: ").map(str::to_owned));
        found.unwrap_or_else(|| panic!("{said}{err}"))
    };
    assert_eq!(idle("[0, 1, 0]"), "link 2 slides along y");
    assert_eq!(idle("[0, -2, 4]"), "link 2 slides along [0, 1, -2]");
    assert_eq!(
        idle("[\"sqrt(2)\", 1, 0]"),
        "link 2 slides along the axis of slide"
    );
}

#[test]
fn a_mechanism_without_an_output_can_be_analysed() {
    let own = replace_once(&run_quiet("show four-bar"), "role = \"output\"", "");
    let found = json_on("analyze", "own.toml", &own, "");
    let known = run_json("analyze four-bar --format json");
    for key in split_words("mobility redundant working_mobility local_mobility") {
        assert_eq!(found["states"][0][key], known["states"][0][key], "{key}");
    }
    let (code, _, err) = run_on("check", "own.toml", &own, "");
    assert_eq!(code, Some(0));
    has(&err, "no link has the role \"output\"");
    let (code, said, err) = run_on(
        "search",
        "own.toml",
        &own,
        "--options spherical,cylindrical --top 1",
    );
    assert_eq!(code, Some(0), "{said}{err}");
}

#[test]
fn options_may_name_types_that_the_file_does_not_list() {
    let own = run_quiet("show four-bar");
    assert!(!own.contains("sphere-in-cylinder"));
    let search = |more: &str| run_full(&format!("search four-bar --format json --top 3 {more}"));
    let (code, said, err) = search("--options sphere-in-cylinder");
    assert_eq!(code, Some(0), "{err}");
    assert!(said.contains("sphere-in-cylinder"));
    has(&err, "sphere-in-cylinder is not in the file");
    let (code, said, _) = search("--allow 2-3=sphere-in-cylinder");
    assert!(code.is_some_and(|c| c < 2), "{said}");
    // a type that loses the present motion, and no type at all
    let (code, _, err) = search("--options prismatic");
    assert_eq!(code, Some(2));
    has(&err, "prismatic does not allow the motion that a joint");
    let (code, _, err) = search("--options nonsuch");
    assert_eq!(code, Some(2));
    has(&err, "no joint type has that name; there are: ");
}

#[test]
fn exported_variants_can_be_searched_again() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("v.toml");
    let path = path.to_str().unwrap();
    for asked in [
        "gripper-10",
        "parallelogram-gripper",
        "gripper-10 --state clamped",
    ] {
        let name = split_words(asked)[0];
        run_successful(&format!("export {asked} --variant 2 --to toml -o {path}"));
        run_successful(&["check", path]);
        let said = fs::read_to_string(path).unwrap();
        assert!(
            said.contains(&format!("Variant 2 of {name}")) && said.contains("options = "),
            "{name}"
        );
        // what it has now needs no change, and more can be chosen
        let again = run_json(&format!(
            "search {path} --top 1 --check none --no-count --format json"
        ));
        assert_eq!(again["variants"][0]["cost"], 0, "{name}");
        let total: String = again["space"].word().to_owned();
        assert!(total.len() > 1, "{name}: {total}");
    }
}

#[test]
fn directions_that_are_guessed_are_told() {
    let own = run_quiet("show four-bar");
    let pin = replace_once(
        &own,
        "[search]",
        "[[joint]]\nid = \"pin\"\nlinks = [\"0\", \"2\"]\ntype = \"slotted\"\npoint = [50, 50, 0]\naxis = [0, 0, 1]\nreference = [1, 0, 0]\n\
         options = [OPTION]\n[search]",
    );
    let told = |option: &str| run_on("check", "pin.toml", &pin.replace("OPTION", option), "").2;
    let guessed = told("\"cylinder-on-plane\"");
    let words = guessed.split_whitespace().collect_vec().join(" ");
    has(
        &words,
        "the normal of the plane of option \"cylinder-on-plane\" is not given and is taken along the pin at pin",
    );
    let stated = told("{ type = \"cylinder-on-plane\", axis = [0, 1, 0], reference = [0, 0, 1] }");
    lacks(&stated, "taken along");
}

/// The planar formula refuses a mechanism that is not planar, and names the mode that makes it planar.
#[test]
fn the_planar_formula_names_the_mode_that_it_needs() {
    assert_fails("analyze gripper-10 --method count-planar", "planar mode");
    run_quiet("analyze gripper-10 --planar --method count-planar");
}
