//! Unloading joints anywhere, σ by contour, joints of the free state alone, and what to do where nothing is found.

use super::{gripper_with_pads, refused, run_search};
use crate::common::*;
use ozols::search::check::variant_mechanism::realize_variant;

#[test]
fn unloading_joints_are_offered_by_name() {
    let (_folder, path) = write_temporary("m.toml", gripper_with_pads());
    let space = |more: &[&str]| {
        let args = [&["--state", "clamped", "--count"][..], more].concat();
        parse_count(&run_search(path, &args)["space"])
    };
    let four = 4u64.pow(12);
    assert_eq!(space(&[]), four * 2 * 2);
    let both = ["--unloading", "spherical,planar=4-a,a-8"];
    assert_eq!(space(&both), four * 3 * 3);
    assert_eq!(space(&["--unloading", "planar"]), four * 3 * 3);
    let two = ["--unloading", "planar=a-8", "--unloading", "universal=1-2"];
    assert_eq!(space(&two), four * 2 * 2 * 3);
    // In the free mechanism, too.
    let free = run_search(path, "--unloading prismatic=2-4 --count");
    assert_eq!(parse_count(&free["space"]), 2 * four);
    for (rule, parts) in [
        ("planar=4-a", &["joint 4-a", "search state clamped"][..]),
        ("planar", &["search a state"]),
        ("rope=2-4", &["rope is not a joint type", "spherical"]),
        ("helical=2-4", &["helical is not a joint type"]),
        ("fixed=2-4", &["fixed is not a joint type"]),
        ("planar=zz", &["no joint zz"]),
    ] {
        let text = refused(&["search", "gripper-10", "--unloading", rule]);
        assert!(parts.iter().all(|p| text.contains(p)), "{rule}: {text}");
    }
}

/// The gripper of the catalogue offers both pads and crosses in the jaws' hinges, and the latter to clamped searches alone.
#[test]
fn the_gripper_offers_both_pads_and_the_jaws_joints() {
    let space = |more: &[&str]| {
        let args = [&["--count"][..], more].concat();
        parse_count(&run_search("gripper-10", &args)["space"])
    };
    assert_eq!(space(&[]), 7u64.pow(12));
    let clamped = 7u64.pow(8) * 14u64.pow(4) * 4;
    assert_eq!(space(&["--state", "clamped"]), clamped);
    assert_eq!(space(&["--unloading", "cross=2-4"]), 2 * 7u64.pow(12));
}

/// A ball pivot elsewhere on the jaw than at its face.
#[test]
fn an_unloading_joint_has_a_place_of_its_own() {
    let place = "point = [6, -2, 0], axis = [1, 0, 0]";
    let list = format!("unloading = [{{ type = \"planar\", {place} }}]\n\n[[contour]]");
    let text = replace_once(
        &gripper_with_pads(),
        "unloading = true\n\n[[contour]]",
        &list,
    );
    let text = replace_once(&text, "unloading = true", "unloading = false");
    let m = mechanism_from_str("m.toml", &text).unwrap();
    let pad = &m.joints[m.joint_named("a-8").unwrap()].unloading[0];
    let point = pad.frame.point.each_ref().map(Expr::to_f64);
    assert_eq!(point, [6.0, -2.0, 0.0]);
    // Written and read again it stays where it is.
    let (_folder, path) = write_temporary("m.toml", &text);
    let read = |name: &str| {
        let written = run_quiet(&["export", name, "--to", "toml"]);
        mechanism_from_str("m.toml", &written).unwrap()
    };
    let again = read(path);
    let again = &again.joints[again.joint_named("a-8").unwrap()].unloading[0];
    assert_eq!(format!("{:?}", again.frame), format!("{:?}", pad.frame));
    // So does the state that an option is for.
    let again = read("gripper-10");
    let cross = &again.joints[again.joint_named("2-4").unwrap()].unloading[0];
    let offered = (cross.name.as_str(), cross.state);
    assert_eq!(offered, ("cross", Some(StateId::new(1))));
    // The variant is the mechanism with the joint there.
    let to = ["--to", "toml", "--variant", "1", "--state", "clamped"];
    let more = split_words("--max-external 3 --options revolute --max-redundant 11");
    let written = run_quiet(&[&["export", path][..], &to, &more].concat());
    let v = mechanism_from_str("v.toml", &written).unwrap();
    let series = &v.joints[v.joint_named("a-8 unloading").unwrap()];
    assert_eq!(series.frame.point.each_ref().map(Expr::to_f64), point);
}

#[test]
fn variants_say_where_their_redundant_constraints_are() {
    let question = split_words("--max-redundant 2 --max-external 5 --max-changes 5 --top 3");
    let found = run_search("gripper-10", &question);
    for v in found["variants"].list() {
        let shares = v["per_contour"].list();
        let number = |c: &Value, key: &str| c[key].as_i64().unwrap();
        let sum: i64 = shares.iter().map(|c| number(c, "redundant")).sum();
        assert_eq!(
            sum,
            number(v, "redundant") + number(v, "external_redundant")
        );
        for c in shares {
            assert!(number(c, "least") <= number(c, "redundant"));
            assert!(number(c, "redundant") <= number(c, "greatest"));
            assert!(c["contour"].word().contains('-'));
        }
    }
}

/// A rest that the gripper leaves as it clamps: σ_a is σ clamped less σ free.
#[test]
fn a_joint_of_the_free_state_alone_counts_in_it_alone() {
    let rest = "[[joint]]\nid = \"rest\"\nlinks = [\"0\", \"5\"]\ntype = \"planar\"\npoint = [2, 4, 0]\n\
                axis = [0, 0, 1]\nstate = \"free\"\n\n[[contour]]  # 0-1-2-3\n";
    let text = replace_once(&gripper_with_pads(), "[[contour]]  # 0-1-2-3\n", rest);
    let text = &text[..text.find("[[expected]]").unwrap()];
    let m = mechanism_from_str("m.toml", text).unwrap();
    let states = [StateId::FREE, StateId::new(1)];
    let found = analyse_states(&m, &states, Method::Modular).unwrap();
    let e = found[1].external.unwrap();
    let sigma = |i: usize| i64::try_from(found[i].redundant).unwrap();
    let difference = sigma(1) - sigma(0);
    assert_eq!((e.redundant, e.by_rank), (difference, difference));
    let (_folder, path) = write_temporary("m.toml", text);
    let present =
        split_words("--options revolute --max-redundant 30 --state clamped --max-changes 0");
    let v = run_search(path, &present)["variants"][0].clone();
    assert_eq!(v["external_redundant"].as_i64(), Some(difference));
    assert_eq!(v["agree"], true);
    // The diagram, and every variant looked at.
    let small = "--options revolute,spherical --max-redundant 6 --max-external 1 --forbid 1-2 --forbid 2-3 --forbid 6-7 \
        --forbid 3-0 --forbid 5-1 --count";
    let brute = format!("{small} --method brute");
    let (a, b) = (run_search(path, small), run_search(path, &brute));
    for key in split_words("determinate admissible admissible_by_mobility_and_changes") {
        assert_eq!(a[key], b[key], "{key}");
    }
    assert!(parse_count(&a["admissible"]) > 0, "{a}");
}

/// The clamped search has advice as any other.
#[test]
fn what_helps_a_clamped_search_is_said() {
    // What balls alone hold turns between them, in the mechanism as it is and in every variant.
    let loose = gripper_with_pads().replace("type = \"fixed\"", "type = \"spherical\"");
    let loose = &loose[..loose.find("[[expected]]").unwrap()];
    let (_folder, path) = write_temporary("m.toml", loose);
    let (code, text, notes) = run_full(&["search", path, "--state", "clamped"]);
    assert_eq!(code, Some(1));
    has(&notes, "a is loose in state");
    has(&text, "--allow-loose-object\n");
}

/// Where no choice of the options offered is enough, that is said, with the drive that stays as it is.
#[test]
fn where_no_option_can_help_that_is_said() {
    let (code, said, _) = run_full("search four-bar --options revolute -q");
    assert_eq!(code, Some(1));
    let part = "Even with the freest option at every joint, σ = 3 remains, so no choice of these options is enough";
    assert!(said.contains(part), "{said}");
    has(&said, "stays unchanged, because it is driven");
}

/// The tongs with a ball pivot put at their contact are the tongs with a pad: 1 + 3 motions while nothing is held, for the pad stays
/// on its jaw, and 2 redundant constraints round a part [Pogrebnyak 2018, by the external formula 12 - (4 - 0) - 6].
#[test]
fn pads_stay_on_their_jaws_when_the_part_is_gone() {
    let m = built_in("tongs");
    let state = StateId::new(1);
    let conditions = default_with(|c: &mut Conditions| c.state = Some(InState::holding(state)));
    let (s, diagrams) = searched(&m, conditions);
    let mut padded = 0;
    for v in s.cheapest_variants(&diagrams, 100) {
        let variant = realize_variant(&s, &v.choices);
        let found = analyse_states(&variant, &[StateId::FREE, state], Method::Modular).unwrap();
        let external = found[1].external.unwrap();
        assert_eq!(found[0].mobility as i64, s.mobility(v.key));
        assert_eq!(external.by_rank, i64::from(v.key.external()));
        assert_eq!(external.redundant, external.by_rank);
        if v.key.changes() == 1 {
            assert_eq!((found[0].mobility, external.redundant), (4, 2));
            padded += 1;
        }
    }
    assert_eq!(padded, 1);
}
