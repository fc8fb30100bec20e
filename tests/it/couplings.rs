//! Couplings of joints: figures derived by hand, what the file may say, and every method on the same rows.

use crate::common::*;
mod counted;
mod exchange;

use ozols::rank::method::NoAnswer;
use ozols::rank::method::registry::by_name;

/// Two joints on the frame, with couplings.
fn pair(first: &str, second: &str, couplings: &str) -> String {
    let frame = write_mechanism("name = \"pair\"\nlength_unit = \"mm\"", "0 1 2*", "");
    format!(
        "{frame}\n[[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\npoint = [0, 0, 0]\n{first}\n\
         [[joint]]\nid = \"b\"\nlinks = [\"0\", \"2\"]\npoint = [100, 0, 0]\n{second}\n{couplings}\n"
    )
}

const TURN: &str = "type = \"revolute\"\naxis = [0, 0, 1]";
const SLIDE: &str = "type = \"prismatic\"\naxis = [1, 0, 0]";

fn coupled(a: &str, b: &str, ratio: &str) -> String {
    format!("[[coupling]]\njoints = [\"{a}\", \"{b}\"]\nratio = {ratio}\n")
}

fn problem(text: &str) -> String {
    mechanism_from_str("pair.toml", text)
        .unwrap_err()
        .to_string()
}

#[test]
fn what_a_file_may_not_say() {
    let ball = "type = \"spherical\"";
    let fixed = "type = \"fixed\"";
    let both = "type = \"cylindrical\"\naxis = [0, 0, 1]";
    let tilted = "type = \"revolute\"\naxis = [1, 0, 0]";
    let clamped = format!("{TURN}\nstate = \"clamped\"");
    let own = format!("{TURN}\noptions = [\"spherical\"]");
    let kind = |name: &str| match name {
        "turn" => TURN,
        "ball" => ball,
        "fixed" => fixed,
        "both" => both,
        "clamped" => &clamped,
        _ => &own,
    };
    for [joints, ends, ratio, wanted] in read_cases::<4>(
        r#"
        turn turn | a c | 1 | unknown joint "c"
        turn turn | a b | 0 | ratio of a coupling is zero
        turn turn | a b | "sqrt(2)-sqrt(2)" | ratio of a coupling is zero
        turn turn | a a | 1 | coupled with itself
        turn ball | a b | 1 | no freedom that can be coupled
        turn ball | a b:rz | 1 | no freedom that can be coupled
        fixed turn | a b | 1 | no freedom that can be coupled
        turn both | a b | 1 | several freedoms; name the coupled one: b:rz, b:tz
        turn both | a b:rx | 1 | known: b:rz, b:tz
        clamped turn | a b | 1 | not present in the same states
        own turn | a b | 1 | does not keep the coupled freedom
        "#,
    ) {
        let (first, second) = joints.split_once(' ').unwrap();
        let (a, b) = ends.split_once(' ').unwrap();
        has(
            &problem(&pair(kind(first), kind(second), &coupled(a, b, ratio))),
            wanted,
        );
    }
    let twice = coupled("a", "b", "1") + &coupled("b", "a", "1");
    has(&problem(&pair(TURN, TURN, &twice)), "coupled twice");
    let planar = pair(tilted, TURN, &coupled("a", "b", "1"));
    let planar = replace_once(&planar, "length_unit", "mode = \"planar\"\nlength_unit");
    has(&problem(&planar), "no freedom that can be coupled");
    let one = "[[coupling]]\njoints = [\"a\"]\nratio = 1";
    has(&problem(&pair(TURN, TURN, one)), "has 1 value");
}

#[test]
fn options_that_cannot_be_coupled_are_not_offered() {
    let search = "[search]\noptions = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\", \"planar\"]\n";
    let m = read(&pair(TURN, TURN, &(coupled("a", "b", "-1") + search)));
    let names: Vec<&str> = m.joints[0]
        .options
        .iter()
        .map(|o| o.name.as_str())
        .collect();
    assert_eq!(names, ["revolute", "cylindrical", "universal", "planar"]);
}

/// Rates do not depend on the length of the axes in the file.
#[test]
fn axes_of_any_length_make_the_same_row() {
    use ozols::closure::coupling::coupling_coefficient;
    let of = |first: &str, second: &str| {
        let m = read(&pair(first, second, &coupled("a", "b", "\"-1/2\"")));
        coupling_coefficient(&m, &m.couplings[0]).to_f64()
    };
    let long = "type = \"revolute\"\naxis = [0, 0, 3]";
    let skew = "type = \"revolute\"\naxis = [1, 1, 0]";
    let turned = "type = \"revolute\"\naxis = [\"cos(36deg)\", \"sin(36deg)\", 0]";
    assert_eq!(of(TURN, TURN), 0.5);
    assert_eq!((of(long, TURN), of(TURN, long)), (1.5, 0.5 / 3.0));
    assert!((of(skew, TURN) - 0.5 * 2f64.sqrt()).abs() < 1e-15);
    assert_eq!(of(turned, TURN), 0.5);
    // Many digits: no root of theirs has to be found.
    let measured = "type = \"revolute\"\naxis = [0.123456789012, 0.3141592653589, 0.9]";
    let length = (0.123456789012f64.powi(2) + 0.3141592653589f64.powi(2) + 0.81).sqrt();
    assert!((of(measured, TURN) - 0.5 * length).abs() < 1e-15);
    // x and y of a frame are made of axis and reference, and longer still.
    let slot = "type = \"slotted\"\naxis = [0, 0, 2]\nreference = [1, 1, 0]";
    let m = read(&pair(slot, SLIDE, &coupled("a:tx", "b", "1")));
    assert!((coupling_coefficient(&m, &m.couplings[0]).to_f64() + 4.0 * 2f64.sqrt()).abs() < 1e-14);
}

/// A rack moves by the pitch radius for each radian of its pinion, over the stroke too.
#[test]
fn rack_and_pinion() {
    let m = read(&pair(TURN, SLIDE, &coupled("a", "b", "12.5")));
    let s = analysed(&m);
    assert_eq!(
        (s.mobility, s.redundant, s.rows, s.finite.mobility),
        (1, 0, 1, 1)
    );
    assert!(s.finite.is_proven());
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let mut follower = Follower::new(pose, 0, &[]);
    follower.advance_to(7.0, |_| {}).unwrap();
    let last = follower.current_pose();
    assert!((last.columns[0].moved - 7.0).abs() < 1e-12);
    assert!((last.columns[1].moved * last.length - 87.5).abs() < 1e-9);
}

/// Two parallelograms driven by one slider move alike already: gears between them are one more redundant constraint,
/// and lock the mechanism where their ratio is another.
#[test]
fn gears_that_repeat_or_contradict() {
    let text = ozols::builtin::text("parallelogram-gripper").unwrap();
    let base = analysed(&read(text));
    let geared = |ratio: &str| {
        let coupling =
            format!("[[coupling]]\njoints = [\"3-0\", \"7-0\"]\nratio = {ratio}\n\n[search]");
        let text = text.replacen("[search]", &coupling, 1);
        let cut = text.find("[[expected]]").unwrap();
        analysed(&read(&text[..cut]))
    };
    let repeats = geared("-1");
    assert_eq!(
        (repeats.mobility, repeats.redundant),
        (1, base.redundant + 1)
    );
    assert_eq!(
        (
            repeats.per_coupling[0].redundant,
            repeats.per_coupling[0].most
        ),
        (1, 1)
    );
    assert!(repeats.self_stresses.iter().any(|s| s.couplings == [0]));
    assert_eq!(
        (repeats.finite.mobility, repeats.self_stresses.len()),
        (1, repeats.redundant)
    );
    let contradicts = geared("2");
    assert_eq!(
        (contradicts.mobility, contradicts.redundant),
        (0, base.redundant)
    );
    assert_eq!(contradicts.per_coupling[0].redundant, 0);
}

/// Willis: the sun of an epicyclic gear turns four times as fast as the carrier where the ring has three times its teeth.
#[test]
fn the_carrier_follows_the_sun() {
    let m = built_in("planetary-gear");
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let mut follower = Follower::new(pose, 0, &[]);
    follower.advance_to(1.0, |_| {}).unwrap();
    let last = follower.current_pose();
    let at = |id: &str| {
        let j = m.joint_named(id).unwrap();
        last.columns.iter().find(|c| c.joint == j).unwrap().moved
    };
    let (carrier, sun) = (at("0-c"), at("0-c") + at("c-s"));
    assert!((sun / carrier - 4.0).abs() < 1e-9);
    // One planet alone is not redundant.
    let text = ozols::builtin::text("planetary-gear").unwrap();
    let s = analysed(&m);
    assert_eq!((s.mobility, s.redundant), (1, 2));
    assert!(
        s.finite.is_proven(),
        "linear couplings alone: no pose differs from another"
    );
    let other = text.replacen(
        "joints = [\"0-c\", \"c-3\"]\nratio = -3",
        "joints = [\"0-c\", \"c-3\"]\nratio = -2",
        1,
    );
    assert_ne!(other, text);
    let cut = other.find("[[expected]]").unwrap();
    assert_eq!(
        analysed(&read(&other[..cut])).mobility,
        0,
        "a planet of other teeth locks it"
    );
}

#[test]
fn every_method_counts_the_rows() {
    for (name, w) in [
        ("geared-five-bar", 1),
        ("geared-gripper", 1),
        ("planetary-gear", 1),
    ] {
        let m = built_in(name);
        for method in [
            "lu32", "lu", "qr32", "qr", "svd", "modular", "finite", "auto",
        ] {
            let answer = by_name(method).unwrap().answer(&m, StateId::FREE).unwrap();
            assert_eq!(answer.mobility, w, "{name} by {method}");
        }
        match by_name("rational").unwrap().answer(&m, StateId::FREE) {
            Ok(answer) => assert_eq!(answer.mobility, w),
            Err(e) => assert!(matches!(e, NoAnswer::DoesNotApply(_)) && name == "planetary-gear"),
        }
        let e = by_name("generic")
            .unwrap()
            .answer(&m, StateId::FREE)
            .unwrap_err();
        assert!(e.to_string().contains("not support couplings of joints"));
    }
    // 6·4 - 25 - 1, 3·4 - 10 - 1, and 5 - 3 - 1 by contours.
    let m = built_in("geared-five-bar");
    for (method, w) in [("count", -2), ("count-planar", 1), ("loops", 1)] {
        assert_eq!(
            by_name(method)
                .unwrap()
                .answer(&m, StateId::FREE)
                .unwrap()
                .mobility,
            w
        );
    }
}

/// A certificate proves the rank with the coupling of its file, and of no other.
#[test]
fn certificates_hold_the_coupling() {
    let text = ozols::builtin::text("geared-five-bar").unwrap();
    let m = read(text);
    let certificate = certify_state(&m, StateId::FREE).unwrap();
    assert_eq!(
        (certificate.rows, certificate.columns, certificate.rank),
        (7, 5, 4)
    );
    let of = |m: &Mechanism| {
        closure_matrix(&number_field(m, StateId::FREE).unwrap(), m, StateId::FREE).unwrap()
    };
    assert_eq!(
        ozols::verify::check_certificate(&of(&m), &certificate),
        Ok(4)
    );
    let other = read(&text.replacen("ratio = \"-1/2\"", "ratio = \"-1/3\"", 1));
    assert!(ozols::verify::check_certificate(&of(&other), &certificate).is_err());
    let without = read(&text.replacen(
        "[[coupling]]\njoints = [\"0-1\", \"0-4\"]\nratio = \"-1/2\"\ngear = true",
        "",
        1,
    ));
    assert!(ozols::verify::check_certificate(&of(&without), &certificate).is_err());
}

#[test]
fn couplings_have_mirror_images() {
    let text = pair(
        TURN,
        TURN,
        "[search]\noptions = [\"cylindrical\"]\nmirror = [[\"a\", \"b\"]]\n",
    )
    // Mirror images are both kept.
    .replace("id = \"1\"\n", "id = \"1\"\nrole = \"output\"\n");
    let with =
        |ratio: &str| read(&text.replacen("[search]", &(coupled("a", "b", ratio) + "[search]"), 1));
    let request = || default_with(|c: &mut Conditions| c.symmetry = Symmetry::OnePerOrbit);
    let made = |m: &Mechanism| {
        Search::new(exact_field(m, 0).unwrap(), m, request())
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    assert_eq!(made(&with("-1")), Ok(()));
    assert!(
        made(&with("2"))
            .unwrap_err()
            .contains("their images are not")
    );
}
