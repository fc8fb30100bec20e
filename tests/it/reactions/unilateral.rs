//! Clamped objects: forces that stand for them, contacts that would pull, contacts that only push.

use crate::common::*;
fn statics(content: &str, more: &[&str]) -> (Option<i32>, String, String) {
    run_on("statics", "clamp.toml", content, more)
}

fn solved(content: &str, more: &[&str]) -> Value {
    json_on("statics", "clamp.toml", content, more)
}

fn contact<'a>(v: &'a Value, name: &str) -> &'a Value {
    let all = v["contacts"].list();
    all.iter().find(|c| c["contact"] == name).unwrap()
}

/// A part of 1 kg with faces of the frame, along y above it and below it; gravity as asked for.
fn held_by(faces: &[&str], gravity: &str) -> String {
    let mut joints =
        "hinge | 0 handle | revolute | 0, 0.3, 0 | 0, 0, 1 | drive = true\n".to_owned();
    let mut contacts = String::new();
    for face in faces {
        let (ends, y) = if *face == "above" {
            ("0 part", "0.1")
        } else {
            ("part 0", "-0.1")
        };
        joints += &format!("{face} | {ends} | fixed | 0, {y}, 0 | 0, 1, 0 | state = \"clamped\"\n");
        contacts += &format!("[[workload.contact]]\njoint = \"{face}\"\nfriction = 0.2\n");
    }
    let text = write_mechanism("name = \"vice\"", "0 handle* part!", &joints);
    let heavy = "role = \"object\"\nmass = 1\ncentre = [0, 0, 0]";
    let workload = format!("[workload]\ngravity = {gravity}\n{contacts}");
    replace_once(&text, "role = \"object\"", heavy) + &workload
}

fn between(gravity: &str) -> String {
    held_by(&["above", "below"], gravity)
}

/// By hand: as joints two faces share the weight, the upper one by pulling; as faces the lower one bears it all.
#[test]
fn a_part_that_lies_is_borne_from_below() {
    let content = between("[0, -9.81, 0]");
    let joints = solved(&content, &["--state", "clamped"]);
    assert_eq!(contact(&joints, "above")["touch"], "pulls");
    near(contact(&joints, "above")["normal"].real(), -4.905, 1e-9);
    let (code, said, _) = statics(&content, &["--state", "clamped"]);
    assert_eq!(code, Some(0));
    let line = said
        .lines()
        .find(|l| l.starts_with("NOT AS CONTACTS ACT"))
        .unwrap();
    has(line, "above would pull with 4.905 N");
    let faces = solved(&content, &["--state", "clamped", "--unilateral"]);
    assert_eq!(faces["choice"], "pushing");
    near(contact(&faces, "below")["normal"].real(), 9.81, 1e-5);
    near(contact(&faces, "above")["normal"].real(), 0.0, 1e-5);
}

/// By hand: a weight along the faces needs N = G/2μ on each of two, and the least that does is of minimum norm.
#[test]
fn a_part_that_hangs_needs_its_pressure() {
    let content = between("[0, 0, -9.81]");
    let joints = solved(&content, &["--state", "clamped"]);
    assert_eq!(contact(&joints, "above")["touch"], "slips");
    let faces = solved(&content, &["--state", "clamped", "--unilateral"]);
    for name in ["above", "below"] {
        let c = contact(&faces, name);
        assert_eq!(c["touch"], "pushes", "{c}");
        near(c["normal"].real(), 9.81 / 2.0 / 0.2, 1e-4);
        near(c["along_face"].real(), 9.81 / 2.0, 1e-4);
    }
    // Without a coefficient there is as much friction as it takes, and nothing to press for.
    let free = content.replace("friction = 0.2", "radius = 1");
    let faces = solved(&free, &["--state", "clamped", "--unilateral"]);
    assert!(contact(&faces, "above")["normal"].real().abs() < 1e-6);
}

#[test]
fn what_slips_off_is_told_and_not_solved() {
    let content = held_by(&["above"], "[0, -9.81, 0]");
    let (code, said, errors) = statics(&content, &["--state", "clamped", "--unilateral"]);
    assert_eq!((code, errors.as_str()), (Some(1), ""));
    has(&said, "slips, lifts off or tilts");
    // As a joint the face is the only support, and the report says that the part is not held.
    let (_, said, _) = statics(&content, &["--state", "clamped"]);
    has(&said, "so the object is not held");
}

/// The weight aside of a face of 10 mm radius tips the part off it; a face of 60 mm bears it.
#[test]
fn pressure_stays_on_the_face() {
    let content = between("[0, -9.81, 0]");
    let content = replace_once(&content, "centre = [0, 0, 0]", "centre = [0.05, 0, 0]");
    let with = |radius: &str| {
        content.replace(
            "friction = 0.2",
            &format!("friction = 0.2\nradius = {radius}"),
        )
    };
    let faces = solved(&with("0.06"), &["--state", "clamped", "--unilateral"]);
    let c = contact(&faces, "below");
    assert!(
        c["tilting"].real() <= 0.06 * c["normal"].real() * (1.0 + 1e-6),
        "{c}"
    );
    // Tilted on a small face, the part is wedged between both: each presses more than the weight alone.
    let wedged = solved(&with("0.01"), &["--state", "clamped", "--unilateral"]);
    for name in ["above", "below"] {
        let c = contact(&wedged, name);
        assert!(
            c["tilting"].real() <= 0.01 * c["normal"].real() * (1.0 + 1e-6),
            "{c}"
        );
        assert!(c["normal"].real() > 1.0, "{c}");
    }
    assert!(contact(&wedged, "below")["normal"].real() > 9.81);
}

/// By hand: a moment about the normal asks each of two faces for M/2, which even pressure on a round face bears where N is at
/// least M/2 over 2/3 μ r: ∫ μ p ρ dA over the disc. In millimetres as in metres.
#[test]
fn a_part_that_is_twisted_needs_its_pressure() {
    let metres =
        between("[0, 0, 0]") + "[[workload.moment]]\nlink = \"part\"\nmoment = [0, 1.5, 0]\n";
    let metres = metres.replace("friction = 0.2", "friction = 0.2\nradius = 0.03");
    let millimetres = metres
        .replace("name = \"vice\"", "name = \"vice\"\nlength_unit = \"mm\"")
        .replace("radius = 0.03", "radius = 30")
        .replace("0.3, 0]", "300, 0]")
        .replace("0.1, 0]", "100, 0]");
    for content in [&metres, &millimetres] {
        let faces = solved(content, &["--state", "clamped", "--unilateral"]);
        for name in ["above", "below"] {
            let c = contact(&faces, name);
            assert_eq!(c["touch"], "pushes", "{c}");
            near(c["normal"].real(), 0.75 / (2.0 / 3.0 * 0.2 * 0.03), 1e-3);
        }
        let joints = solved(content, &["--state", "clamped"]);
        assert_eq!(contact(&joints, "above")["touch"], "slips");
    }
}

/// By hand: the weight along the faces and the moment about the normal share the friction, (G/2)² + (M/2 : 2/3 r)² = (μN)².
#[test]
fn what_hangs_and_twists_needs_more_than_either() {
    let content = between("[0, 0, -9.81]")
        .replace("friction = 0.2", "friction = 0.2\nradius = 0.03")
        + "[[workload.moment]]\nlink = \"part\"\nmoment = [0, 1.5, 0]\n";
    let faces = solved(&content, &["--state", "clamped", "--unilateral"]);
    for name in ["above", "below"] {
        let c = contact(&faces, name);
        assert_eq!(c["touch"], "pushes", "{c}");
        let least = (9.81_f64 / 2.0).hypot(0.75 / (2.0 / 3.0 * 0.03)) / 0.2;
        near(c["normal"].real(), least, 1e-3);
    }
}

/// Faces that a moment tips have less left for one about the normal: T ≤ 2/3 μ (rN - M), whatever else they bear.
#[test]
fn what_tips_and_twists_shares_the_face() {
    let content = |tipping: &str| {
        between("[0, -9.81, 0]").replace("friction = 0.2", "friction = 0.2\nradius = 0.03")
            + &format!("[[workload.moment]]\nlink = \"part\"\nmoment = [{tipping}, 1.5, 0]\n")
    };
    let mut normals = Vec::new();
    for tipping in ["0", "2", "6"] {
        let faces = solved(&content(tipping), &["--state", "clamped", "--unilateral"]);
        let all = faces["reactions"].list();
        let mut turned = 0.0;
        for name in ["above", "below"] {
            let c = contact(&faces, name);
            assert_eq!(c["touch"], "pushes", "{c}");
            let r = all.iter().find(|r| r["joint"] == name).unwrap();
            let turn = r["global_moment"][1].real().abs();
            let left = 0.03 * c["normal"].real() - c["tilting"].real();
            assert!(turn <= 2.0 / 3.0 * 0.2 * left * (1.0 + 1e-5), "{turn} {c}");
            turned += turn;
            normals.push(c["normal"].real());
        }
        near(turned, 1.5, 1e-6);
    }
    assert!(
        normals[4] > normals[0] && normals[5] > normals[1],
        "{normals:?}"
    );
}

/// The built-in gripper: with the forces that stand for the part left in the clamped state, its pads pulled with 54 N.
#[test]
fn the_gripper_no_longer_pulls_at_its_part() {
    let text = run_quiet("show gripper-10-loaded");
    let doubled = text.replace("state = \"free\"\n\n", "\n");
    assert_ne!(text, doubled);
    let (_, said, _) = statics(&doubled, &["--state", "clamped"]);
    has(&said, "NOT AS CONTACTS ACT: 4-a would pull with 53.96 N");
    let clamped = run_json("statics gripper-10-loaded --state clamped --format json");
    for name in ["4-a", "a-8"] {
        assert_ne!(contact(&clamped, name)["touch"], "pulls");
    }
    let faces = run_json("statics gripper-10-loaded --state clamped --unilateral --format json");
    let mut part = [0.0, 0.0, -9.81];
    for (name, sign) in [("4-a", 1.0), ("a-8", -1.0)] {
        let c = contact(&faces, name);
        assert_eq!(c["touch"], "pushes");
        let (normal, along) = (c["normal"].real(), c["along_face"].real());
        assert!(
            along <= 0.2 * normal * (1.0 + 1e-6) && normal >= 9.81 / 2.0 / 0.2 * (1.0 - 1e-6),
            "{c}"
        );
        let all = faces["reactions"].list();
        let r = all.iter().find(|r| r["joint"] == name).unwrap();
        (0..3).for_each(|i| part[i] += sign * r["global_force"][i].real());
    }
    // The part is in equilibrium; the free state still bears the forces that stand for it.
    part.iter().for_each(|x| near(*x, 0.0, 1e-9));
    let free = run_quiet("statics gripper-10-loaded");
    has(&free, "Drive 0-1 holds tz: force -53.333 N");
}

#[test]
fn contacts_that_push_anyway_change_nothing() {
    let force = "[[workload.force]]\nlink = \"part\"\npoint = [0, 0.05, 0]\nforce = [0, -20, 0]\nstate = [\"clamped\"]\n";
    let pressed = held_by(&["below"], "[0, -9.81, 0]") + force;
    let clamped = ["--state", "clamped"];
    let [a, b] =
        [&clamped[..], &["--state", "clamped", "--unilateral"]].map(|more| solved(&pressed, more));
    assert_eq!(a["reactions"], b["reactions"]);
    near(contact(&b, "below")["normal"].real(), 29.81, 1e-9);
}

#[test]
fn words_that_are_no_states_or_contacts_are_refused() {
    let content = between("[0, -9.81, 0]");
    for [from, to, part] in read_cases::<3>(
        r#"
        joint = "below"\nfriction | joint = "side"\nfriction | unknown joint "side"
        friction = 0.2 | friction = -1 | a number from 0 to 10
        friction = 0.2 | radius = 0 | a number above 0
        [[workload.contact]] | [[workload.force]]\nlink = "part"\npoint = [0, 0, 0]\nforce = [1, 0, 0]\nstate = "closed"\n[[workload.contact]] | unknown state "closed"
"#,
    ) {
        let (code, _, errors) = statics(&replace_once(&content, from, to), &["--state", "clamped"]);
        assert_eq!(code, Some(2), "{to}");
        assert!(errors.contains(part), "{to}: {errors}");
    }
    let (code, _, errors) = statics(&run_quiet("show four-bar"), &["--unilateral"]);
    assert_eq!(code, Some(2));
    has(&errors, "--unilateral is for contacts with a clamped part");
}

/// What a file says of states and contacts, its export says again.
#[test]
fn states_of_forces_and_contacts_are_exported() {
    let again = run_quiet("export gripper-10-loaded --to toml");
    assert_eq!(again.matches("[[workload.contact]]").count(), 2, "{again}");
    let forces = again.split("[[workload.force]]").skip(1);
    let tables = forces.map(|rest| rest.split("\n[").next().unwrap());
    let states = tables.map(|table| table.contains("state = \"free\""));
    assert_eq!(states.collect_vec(), [true; 4]);
}
