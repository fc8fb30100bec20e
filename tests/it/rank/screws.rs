//! Screws by their lead or their pitch: π is no number that is exact here, and nothing that has it is called exact.

use crate::common::*;
fn jack(pitch: &str) -> String {
    let own = run_quiet("show screw-jack");
    let old = own.lines().find(|l| l.starts_with("pitch = ")).unwrap();
    replace_once(&own, old, pitch)
}

fn analysed(file: &str) -> Value {
    json_on("analyze", "jack.toml", file, "")
}

#[test]
fn a_lead_and_its_pitch_are_one() {
    let by = |pitch: &str| analysed(&jack(pitch))["states"][0].clone();
    let (lead, pitch) = (by("lead = 5"), by("pitch = \"5/(2*pi)\""));
    assert_eq!(lead, pitch);
    let rational = by("pitch = \"4/5\"");
    for key in ["mobility", "redundant", "rank"] {
        assert_eq!(lead[key], rational[key], "{key}");
    }
}

#[test]
fn what_has_pi_is_not_called_exact() {
    let of = |pitch: &str| analysed(&jack(pitch))["states"][0]["certainty"].to_string();
    assert!(of("pitch = \"4/5\"").contains("exact geometry"));
    let said = of("lead = 5");
    lacks(&said, "exact geometry");
    has(&said, "pi to 40 decimals");
    let state = analysed(&jack("lead = 5"))["states"][0].clone();
    assert!(state["choice"].to_string().contains("5/(2*pi)"), "{state}");
    assert_ne!(state["certainty_kind"], "proven");
}

/// Two screws of 5 and 10 mm a turn: 17 digits of each would not have the ratio 2.
#[test]
fn ratios_of_leads_are_exact() {
    let file = |first: &str, second: &str| {
        format!(
            "name = \"turnbuckle\"\nlength_unit = \"mm\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n\
             [[link]]\nid = \"2\"\nrole = \"output\"\n\
             [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"helical\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n{first}\n\
             [[joint]]\nid = \"b\"\nlinks = [\"0\", \"1\"]\ntype = \"helical\"\npoint = [0, 0, 9]\naxis = [0, 0, 2]\n{second}\n\
             [[joint]]\nid = \"c\"\nlinks = [\"1\", \"2\"]\ntype = \"spherical\"\npoint = [0, 0, 20]\n"
        )
    };
    let w =
        |first: &str, second: &str| analysed(&file(first, second))["states"][0]["mobility"].clone();
    assert_eq!(w("lead = 5", "pitch = \"10/(4*pi)\""), 4);
    assert_eq!(w("lead = \"5/3\"", "lead = \"10/6\""), 4);
    assert_eq!(w("lead = 5", "lead = 6"), 3);
}

#[test]
fn a_written_pitch_reads_back() {
    let (code, said, err) = run_on("export", "jack.toml", &jack("lead = -5"), "--to toml");
    assert_eq!(code, Some(0), "{err}");
    has(&said, "pitch = \"-5/(2*pi)\"");
    assert_eq!(
        analysed(&said)["states"],
        analysed(&jack("lead = -5"))["states"]
    );
}

#[test]
fn what_is_wrong_with_a_screw_is_told() {
    for (pitch, said) in [
        ("lead = 5\npitch = 1", "lead and pitch exclude each other"),
        ("# none", "needs a lead, the translation per turn"),
        ("pitch = \"5/(2*pie)\"", "unknown word `pie`"),
        ("pitch = \"5/(pi-pi)\"", "division by zero"),
        ("lead = \"5*pi\"", "only a pitch may have pi"),
    ] {
        let (code, _, err) = run_on("check", "jack.toml", &jack(pitch), "");
        assert_eq!(code, Some(2), "{pitch}");
        let err = err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(said), "{pitch}: {err}");
    }
    let hinge = replace_once(
        &run_quiet("show four-bar"),
        "drive = true",
        "drive = true\nlead = 5",
    );
    assert_fails_on("check", "four.toml", &hinge, "", "takes no lead");
    // in degrees it is an angle, and still exact
    let turned = replace_once(
        &jack("lead = 5"),
        "axis = [0, 0, 1]",
        "axis = [0, 0, \"2*cos(pi/3)\"]",
    );
    assert_eq!(
        analysed(&turned)["states"][0]["mobility"],
        analysed(&jack("lead = 5"))["states"][0]["mobility"]
    );
    let _ = run_json("analyze screw-jack --format json");
}

/// 10 mm a radian: metres a turn in SDF, metres a radian in MuJoCo's equality; by SDF's old tag it is minus radians a metre.
#[test]
fn leads_are_written_and_read_in_the_formats_own_units() {
    let m = read(&jack("pitch = 10"));
    assert_eq!(m.length_unit.symbol, "mm");
    let number = |text: &str, before: &str| -> f64 {
        let from = text.find(before).unwrap_or_else(|| panic!("{text}")) + before.len();
        let end = text[from..].find(['<', ' ', '"']).unwrap();
        text[from..from + end].parse().unwrap()
    };
    let near =
        |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    let sdf = formats::write(&m, "sdf").unwrap();
    near(number(&sdf, "<screw_thread_pitch>"), 0.01 * TAU);
    let mjcf = formats::write(&m, "mjcf").unwrap();
    near(number(&mjcf, "polycoef=\"0 "), 0.01);
    // Read back, and by the old tag; a turn of the screw carries what hangs on it along.
    let none = |_: &str| Err(std::io::Error::other("no files"));
    let model = |pitch: &str| {
        format!(
            "<sdf version='1.9'><model name='m'><link name='0'/><link name='1'/><link name='2'/>\
             <joint name='w' type='fixed'><parent>world</parent><child>0</child></joint>\
             <joint name='s' type='screw'><parent>0</parent><child>1</child><axis><xyz>0 0 2</xyz></axis>{pitch}</joint>\
             <joint name='h' type='revolute'><pose>0 0 1 0 0 0</pose><parent>1</parent><child>2</child>\
             <axis><xyz>1 0 0</xyz></axis></joint></model></sdf>"
        )
    };
    for pitch in [
        "<screw_thread_pitch>0.06283185307179587</screw_thread_pitch>",
        "<thread_pitch>-100</thread_pitch>",
    ] {
        let at = |turns: f64| {
            let options =
                default_with(|o: &mut Options| o.pose = vec![("s".to_owned(), vec![turns * TAU])]);
            import("m.sdf", model(pitch).as_bytes(), &none, &options)
                .unwrap()
                .toml()
                .unwrap()
        };
        near(number(&at(0.0).replace('\n', " "), "pitch = "), 0.01);
        let hinge = |text: &str| {
            let part = text
                .split("[[joint]]")
                .find(|j| j.contains("id = \"h\""))
                .unwrap()
                .to_owned();
            number(&part.replace(']', " "), "point = [0, 0, ")
        };
        near(hinge(&at(0.0)), 1.0);
        assert!((hinge(&at(1.0)) - 1.0 - 0.0628318530718).abs() < 1e-9);
    }
}
