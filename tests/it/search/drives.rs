//! Drives decide: a redesign keeps the motion of outputs and drives together.
//!
//! The counts of built-in mechanisms are those of a trial that looked at every variant over another prime field, with code of its own.

use crate::common::*;
use ozols::search::question::conditions::SearchError;
use ozols::search::question::kept::Drives;

/// Returns a search of a mechanism, ready to be made.
fn search(m: &Mechanism, drives: Drives) -> Result<Search, SearchError> {
    let conditions = default_with(|c: &mut Conditions| c.drives = drives);
    Search::new(exact_field(m, 0).unwrap(), m, conditions)
}

/// Returns how many variants are admissible, counted on the diagram and one by one.
fn admissible(m: &Mechanism, drives: Drives) -> u64 {
    let search = search(m, drives).unwrap();
    let diagrams = search.build_diagrams(Control::NONE);
    let found = search.count_variants(&diagrams.admissible, true);
    if search.size() <= 4096u32.into() {
        assert_eq!(
            found.total,
            every_variant(&search).unwrap().admissible.total,
            "{}",
            m.name
        );
    }
    found.total.try_into().unwrap()
}

/// Returns a mechanism whose driven joints have the freedom of this name driven.
fn driven(mut m: Mechanism, freedom: &str) -> Mechanism {
    let freedom = ozols::model::joint_type::Freedom::from_name(freedom);
    for j in m.edit().joints.iter_mut().filter(|j| j.drive) {
        j.drive_freedom = freedom;
    }
    m
}

#[test]
fn counts_with_and_without_the_drives_are_those_of_the_trial() {
    for (name, free, kept) in [
        ("watt-six-bar", 325, 325),
        ("sarrus", 6, 6),
        ("four-bar", 14, 14),
        ("altmann", 25, 21),
        ("hooke-double", 256, 16),
        ("oldham", 10, 5),
        ("3-crr", 420, 12),
        ("4-upu", 1_600, 256),
        ("tripteron", 16_872, 47),
        ("gripper-10", 25_761_436, 25_761_436),
    ] {
        let m = built_in(name);
        let found = [Drives::Free, Drives::Kept].map(|drives| admissible(&m, drives));
        assert_eq!(found, [free, kept], "{name}");
    }
    let turned = driven(built_in("3-crr"), "rz");
    assert_eq!(admissible(&turned, Drives::Kept), 420);
}

/// A table on a screw: a plain bush in place of the nut lets the motor spin alone.
fn jack() -> String {
    write_mechanism(
        "name = \"jack\"\nlength_unit = \"mm\"",
        "base screw table*",
        r#"
        motor | base screw | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
        nut | screw table | helical | 0, 0, 40 | 0, 0, 1 | lead = 4\noptions = ["helical", "cylindrical"]\nunloading = [{ name = "floating nut", freedoms = ["rx", "ry", "tx", "ty"] }]
        rail | table base | prismatic | 30, 0, 40 | 0, 0, 1
        "#,
    )
}

#[test]
fn a_bush_in_place_of_a_lead_screw_is_no_redesign_and_costs_no_less_than_nothing() {
    let m = read(&jack());
    assert_eq!(
        [Drives::Free, Drives::Kept].map(|d| admissible(&m, d)),
        [2, 1]
    );
    let search = search(&m, Drives::Kept).unwrap();
    let diagrams = search.build_diagrams(Control::NONE);
    let nut = m.joint_named("nut").unwrap();
    let of = |j: JointId| {
        search
            .space
            .variables
            .iter()
            .position(|v| v.joints == [j])
            .unwrap()
    };
    for v in search.cheapest_variants(&diagrams, 10) {
        let choice = &search.space.variables[of(nut)].choices[v.choices[of(nut)]];
        assert_eq!(m.joints[nut].options[choice.option].name, "helical");
    }
    let mut costs = search.space.variables.iter().flat_map(|v| &v.choices);
    assert!(costs.all(|c| c.cost_milli >= 0));
}

/// A beam on a pivot and a seat that two motors push along parallel rails: as built they fight. With a slide in place of the seat there is
/// one motion for both; with a pin in a slot each motor decides its own side.
fn gantry() -> String {
    write_mechanism(
        "name = \"gantry\"\nmode = \"planar\"",
        "base left right beam*",
        r#"
        left-rail | base left | prismatic | 0, 0, 0 | 0, 1, 0 | drive = true
        right-rail | base right | prismatic | 2, 0, 0 | 0, 1, 0 | drive = true
        left-pin | left beam | revolute | 0, 0, 0 | 0, 0, 1
        right-seat | right beam | fixed | 2, 0, 0 | 0, 0, 1 | reference = [1, 0, 0]\noptions = ["fixed", "slotted", { type = "prismatic", axis = [1, 0, 0] }]
        "#,
    )
}

#[test]
fn independent_drives_are_as_many_as_the_motions_that_they_decide() {
    let m = read(&gantry());
    // By hand: the slide keeps the one motion of the beam, the slot gives it a turn.
    for (drives, mobility) in [(Drives::Kept, 1), (Drives::Independent, 2)] {
        let search = search(&m, drives).unwrap();
        let diagrams = search.build_diagrams(Control::NONE);
        let found = search.count_variants(&diagrams.admissible, true);
        let by_mobility: Vec<_> = found.by_mobility.into_iter().collect();
        assert_eq!(by_mobility, [(mobility, 1u8.into())]);
        assert_eq!(admissible(&m, drives), 1);
    }
    // Without the second motor one drive is left, and the slide has what is asked.
    let mut one = m;
    one.edit().joints[1].drive = false;
    let search = search(&one, Drives::Independent).unwrap();
    let diagrams = search.build_diagrams(Control::NONE);
    let found: Vec<_> = search.cheapest_variants(&diagrams, 5).collect();
    assert_eq!((found.len(), search.mobility(found[0].key)), (1, 1));
}

/// The file states the condition on drives and on the motion, and the command line another one.
#[test]
fn a_file_states_the_condition_on_drives() {
    let with = |keys: &str| format!("{}[search]\n{keys}\n", gantry());
    let ask = |keys: &str, more: &[&str]| {
        let more = [&["--count", "-q"], more].concat();
        let (_, mut found) = answer_on("search", "gantry.toml", &with(keys), &more);
        found["seconds"] = Value::Null;
        found
    };
    let mobilities = |keys: &str, more: &[&str]| ask(keys, more)["admissible_by_mobility"].clone();
    assert_eq!(mobilities("", &[]), json!({ "1": "1" }));
    for word in ["kept", "free", "independent"] {
        let [by_file, by_option] = [
            ask(&format!("drives = \"{word}\""), &[]),
            ask("", &["--drives", word]),
        ];
        assert_eq!(by_file, by_option, "{word}");
    }
    assert_eq!(
        mobilities("drives = \"independent\"", &[]),
        json!({ "2": "1" })
    );
    let other = mobilities("drives = \"independent\"", &["--drives", "kept"]);
    assert_eq!(other, json!({ "1": "1" }));
    assert_eq!(ask("pose_only = true", &[]), ask("", &["--pose-only"]));
    // Both are written again.
    let text = with("drives = \"independent\"\npose_only = true");
    let m = mechanism_from_str("gantry.toml", &text).unwrap();
    let entry = ozols::file::write::mechanism_file(&m).search;
    assert_eq!(
        (entry.drives.as_deref(), entry.pose_only),
        (Some("independent"), true)
    );
    let (code, _, told) = run_on("search", "gantry.toml", &with("drives = \"kep\""), &[]);
    assert!(code == Some(2) && told.contains("kept"), "{told}");
}

/// Where no variant has as many motions as drives, that is an answer and no error.
#[test]
fn nothing_found_with_independent_drives_is_an_answer() {
    let text = replace_once(&gantry(), "\"fixed\", \"slotted\", {", "\"fixed\", {");
    let (code, found) = answer_on("search", "gantry.toml", &text, "--drives independent -q");
    assert_eq!((code, parse_count(&found["admissible"])), (Some(1), 0));
}

#[test]
fn independent_drives_are_refused_where_they_cannot_be() {
    let built = read(&gantry());
    let mut none = built.clone();
    none.edit().joints.iter_mut().for_each(|j| j.drive = false);
    let refused = search(&none, Drives::Independent).map(|_| ()).unwrap_err();
    assert!(matches!(refused, SearchError::NoDrives), "{refused}");
    // A slot as built leaves the beam a motion that one drive does not decide.
    let options =
        "options = [\"fixed\", \"slotted\", { type = \"prismatic\", axis = [1, 0, 0] }]\n";
    let slotted = gantry()
        .replace("type = \"fixed\"", "type = \"slotted\"")
        .replace(options, "");
    let mut slotted = read(&slotted);
    slotted.edit().joints[1].drive = false;
    let refused = search(&slotted, Drives::Independent)
        .map(|_| ())
        .unwrap_err();
    let undecided = matches!(refused, SearchError::UndecidedOutputs { motions: 1 });
    assert!(undecided, "{refused}");
}
