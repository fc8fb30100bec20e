//! Each number of a file is known to half a unit of its last digit, as it is written there.

use crate::common::*;
use ozols::model::rounded::{Uncertainties, looks_rounded};

/// A door on two hinges, with these two points and axes.
pub(crate) fn door(points: [&str; 2], axes: [&str; 2], more: &str) -> String {
    let mut file = "name = \"door\"\nlength_unit = \"mm\"\n".to_owned();
    file += more;
    file += "[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"door\"\nrole = \"output\"\n";
    for (i, (point, axis)) in points.into_iter().zip(axes).enumerate() {
        file += &format!(
            "[[joint]]\nid = \"h{i}\"\nlinks = [\"0\", \"door\"]\ntype = \"revolute\"\npoint = {point}\naxis = {axis}\n"
        );
    }
    file
}

pub(super) fn read(text: &str) -> Mechanism {
    mechanism_from_str("door.toml", text).unwrap()
}

fn known(text: &str) -> Option<Uncertainties> {
    uncertainties(&read(text))
}

fn point_halves(half: &Uncertainties) -> Vec<[f64; 3]> {
    half.frames.iter().map(|f| f.point).collect()
}

fn halves(v: &[Expr; 3]) -> [Option<f64>; 3] {
    v.each_ref().map(Expr::half_unit)
}

pub(super) const Z: &str = "[0, 0, 1]";

#[test]
fn a_number_knows_its_last_digit_and_arithmetic_does_not() {
    let half = |s: &str| s.parse::<Expr>().unwrap().half_unit();
    for (text, expected) in [
        ("0.49400", 5e-6),
        ("0.494", 5e-4),
        ("-12.5", 0.05),
        ("1.5e-3", 5e-5),
        ("1.50e-3", 5e-6),
        ("2e-3", 5e-4),
        ("(0.5)", 0.05),
    ] {
        assert_eq!(half(text), Some(expected), "{text}");
    }
    for exact in
        split_words("12 -2/3 1001/1000 123456789/10^20 sqrt(0.5) 0.5+0.25 2*0.125 cos(36deg)")
    {
        assert_eq!(half(exact), None, "{exact}");
    }
    let e: Expr = "0.49400".parse().unwrap();
    assert_eq!((-&e).half_unit(), Some(5e-6));
    assert_eq!(e.clone().half_unit(), Some(5e-6));
    assert_eq!((&e + &e).half_unit(), None);
    assert_eq!((&e + &Expr::from(0)).half_unit(), None);
    assert_eq!(e.clone().with_half_unit(0.25).half_unit(), Some(0.25));
    assert_eq!(e.clone().with_half_unit(0.0).half_unit(), None);
    assert_eq!(
        e.as_rational(),
        "0.494".parse::<Expr>().unwrap().as_rational()
    );
    assert!("-80".parse::<Expr>().unwrap().is_written_whole());
    assert!(!"80.0".parse::<Expr>().unwrap().is_written_whole());
    assert!(!"160/2".parse::<Expr>().unwrap().is_written_whole());
    assert!(!Expr::from(80).is_written_whole());
}

#[test]
fn trailing_zeros_count_in_toml_and_in_json() {
    let expected = [Some(5e-6), Some(0.005), Some(5e-6)];
    let text = door(
        ["[0.49400, -12.50, 1.500e-2]", "[0, 0, 1_00.250]"],
        [Z, Z],
        "",
    );
    let m = read(&text);
    assert_eq!(halves(&m.joints[0].frame.point), expected);
    assert_eq!(halves(&m.joints[1].frame.point), [None, None, Some(5e-4)]);
    assert!(m.joints[1].frame.point[0].is_written_whole());
    assert_eq!(m.joints[0].frame.point[1].to_f64(), -12.5);
    // In quotes, too.
    let quoted = read(&door(
        ["[\"0.49400\", \"-12.50\", \"0.01500\"]", "[0, 0, 9]"],
        [Z, Z],
        "",
    ));
    assert_eq!(halves(&quoted.joints[0].frame.point), expected);

    let point = |p: &str| {
        format!(
            "{{\"id\": \"h\", \"links\": [\"0\", \"door\"], \"type\": \"revolute\", \"point\": {p}, \"axis\": [0, 0, 1.0]}}"
        )
    };
    let links = r#"[{"id": "0", "role": "frame"}, {"id": "door", "role": "output"}]"#;
    let text = format!(
        "{{\"name\": \"door\", \"link\": {links}, \"joint\": [{}]}}",
        point("[0.49400, -12.50, 1.500e-2]")
    );
    let m = mechanism_from_str("door.json", &text).unwrap();
    assert_eq!(halves(&m.joints[0].frame.point), expected);
}

#[test]
fn options_parameters_points_ratios_and_leads_are_read_alike() {
    let text = door(["[1.50, \"h\", 0]", "[0, 0, 9]"], [Z, Z], "")
        + "options = [{ type = \"cylindrical\", point = [0, 0, 2.250] }]\n\
           [parameter]\nh = 7.40\n\
           [[point]]\nid = \"tip\"\nlink = \"door\"\npoint = [3.10, 0, 0]\n";
    let m = read(&text);
    assert_eq!(m.joints[0].frame.point[1].half_unit(), Some(0.005));
    let option = m.joints[1].options.iter().find(|o| o.name == "cylindrical");
    assert_eq!(option.unwrap().frame.point[2].half_unit(), Some(5e-4));
    assert_eq!(m.points[0].point[0].half_unit(), Some(0.005));
    let screw = "[[joint]]\nid = \"s\"\nlinks = [\"0\", \"door\"]\ntype = \"helical\"\npoint = [0, 0, 0]\n\
                 axis = [0, 0, 1]\nlead = 5.000\n";
    let m = read(&(door(["[1, 0, 0]", "[0, 0, 9]"], [Z, Z], "") + screw));
    let half = m.joints[2].frame.pitch.half_unit().unwrap();
    assert!((half * TAU - 5e-4).abs() < 1e-15, "{half}");
}

#[test]
fn short_decimals_fractions_and_whole_numbers_are_exact() {
    let files = [
        door(["[12.5, 7.5, 0]", "[0, 80, 120]"], [Z, "[0.6, 0.8, 0]"], ""),
        door(
            ["[80.0, 151.0, 0.0]", "[0.0, 80.0, 120.0]"],
            [Z, "[0.0, 0.0, 1.0]"],
            "",
        ),
        door(
            [
                "[\"123456789/10^20\", \"1001/1000\", 0]",
                "[\"12345/1000\", 1, 1]",
            ],
            [Z, "[\"866/1000\", 0, 1]"],
            "",
        ),
    ];
    for text in files {
        assert_eq!(known(&text), None, "{text}");
        assert_eq!(looks_rounded(&read(&text)), None, "{text}");
    }
}

#[test]
fn every_decimal_of_a_rounded_file_has_its_own_unit() {
    let u = known(&door(
        ["[151.23, 0.00, 12.0]", "[-149.85, 80, 0]"],
        ["[0.99998, 0.00001, 0.00632]", Z],
        "",
    ))
    .unwrap();
    assert_eq!(u.frames[0].point, [0.005, 0.005, 0.005]);
    assert_eq!(u.frames[1].point, [0.005, 0.005, 0.0]);
    assert_eq!(u.frames[0].axis, [5e-6; 3]);
    assert_eq!(u.frames[1].axis, [0.0; 3]);
    assert!(u.frames.iter().all(|f| f.reference == [0.0; 3]));
}

#[test]
fn directions_that_are_chosen_stay_exact_beside_long_lengths() {
    let u =
        |axis: &str| known(&door(["[151.23, 7.01, 12.04]", "[1, 2, 3]"], [axis, Z], "")).unwrap();
    for chosen in [
        "[0.6, 0.8, 0]",
        "[0.5, 0.5, 0]",
        "[0.0, 0.0, 1.0]",
        "[1, 1, 0]",
        "[-0.5, \"sqrt(3)/2\", 0]",
    ] {
        assert_eq!(u(chosen).frames[0].axis, [0.0; 3], "{chosen}");
    }
    // Rounded from a length of 1.
    assert_eq!(u("[0.71, 0.71, 0]").frames[0].axis, [0.005, 0.005, 0.0]);
    // One number of places for all three.
    assert_eq!(u("[0.866, 0.5, 0]").frames[0].axis, [5e-4, 5e-4, 0.0]);
}

#[test]
fn lost_zeros_are_found_again_where_many_decimals_show_none() {
    let points: Vec<[f64; 3]> = (1..=6)
        .map(|i| {
            let x = f64::from(i);
            [12.345_671 * x, -3.456_783 * x, 7.891_237 * x]
        })
        .collect();
    let joint = |(i, p): (usize, &[f64; 3])| json!({"id": i.to_string(), "links": ["0", "door"], "type": "spherical", "point": p});
    let mut all: Vec<Value> = points.iter().enumerate().map(joint).collect();
    all[0]["point"] = json!([12.345_67, 5, 0.0]);
    all[1]["point"] = json!([12.34, 80.0, 1.5]);
    let file = json!({"name": "x", "link": [{"id": "0", "role": "frame"}, {"id": "door", "role": "output"}], "joint": all});
    let m = mechanism_from_str("x.json", &file.to_string()).unwrap();
    let u = uncertainties(&m).unwrap();
    // One place less: a lost zero. Whole: the writer's, too.
    assert_eq!(u.frames[0].point, [5e-7, 5e-7, 5e-7]);
    // Four places less: chosen, and not to be taken for something else.
    assert_eq!(u.frames[1].point, [5e-7, 5e-7, 5e-7]);
}

/// A direction that is written with fewer digits than others has its own unit, however many have more.
#[test]
fn a_direction_of_fewer_digits_has_its_own_unit() {
    let points = ["[1.2340, 0.2000, 0.1000]", "[2.3450, 0.3000, 0.7000]"];
    for (axes, halves) in [
        (["[0, -0.5, 0.866025]", "[0, -0.5, 0.866]"], [5e-7, 5e-4]),
        (
            ["[0.267261, 0.534522, 0.801784]", "[0.267, 0.535, 0.802]"],
            [5e-7, 5e-4],
        ),
        (
            [
                "[0.267261, 0.534522, 0.801784]",
                "[0.26726, 0.53452, 0.80178]",
            ],
            [5e-7, 5e-6],
        ),
    ] {
        let u = known(&door(points, axes, "")).unwrap();
        for (found, half) in u.frames.iter().map(|f| &f.axis).zip(halves) {
            assert!(
                found.iter().all(|h| *h == 0.0 || *h == half),
                "{axes:?}: {found:?}"
            );
        }
    }
}

#[test]
fn whole_lengths_beside_turned_directions_are_rounded_to_half_a_unit() {
    let u = known(&door(
        ["[151, 0, 12]", "[-150, 80, 7]"],
        [
            "[0.267261, 0.534522, 0.801784]",
            "[0.267261, 0.534522, 0.801784]",
        ],
        "",
    ))
    .unwrap();
    assert_eq!(point_halves(&u), [[0.5; 3]; 2]);
    assert_eq!(
        known(&door(["[151, 0, 12]", "[-150, 80, 7]"], [Z, Z], "")),
        None
    );
}

#[test]
fn directions_of_any_size_are_directions() {
    let axis = |text: &str| {
        let m = read(&door(["[0, 0, 0]", "[0, 0, 9]"], [text, Z], ""));
        let [x, y, z] = m.joints[0].frame.axis.each_ref().map(Expr::to_f64);
        [x / z, y / z]
    };
    assert_eq!(axis("[2.6e-49, 0, 1]"), [0.0, 0.0]);
    assert_eq!(
        axis("[0, 12345678901234567, 12345678901234567]"),
        [0.0, 1.0]
    );
    assert_eq!(axis("[3e-60, 0, 4e-60]"), [0.75, 0.0]);
    assert_eq!(axis("[3e200, 0, 4e200]"), [0.75, 0.0]);
    // Said on purpose.
    assert_eq!(axis("[\"26/10^50\", 0, 1]"), [2.6e-49, 0.0]);
    let lengths = door(["[2.6e-49, 0, 0]", "[0, 0, 9]"], [Z, Z], "");
    let error = mechanism_from_str("door.toml", &lengths).unwrap_err();
    assert!(error.to_string().contains("out of range"), "{error}");
}

#[test]
fn what_is_stated_goes_before_digits() {
    let points = ["[151.23, 0, \"1/8\"]", "[-149.85, 80, 0]"];
    let axes = ["[0.99998, 0.00001, 0.00632]", Z];
    let u = |more: &str| known(&door(points, axes, more));
    let both = u("[tolerance]\nlength = 0.01\ndirection = 1e-6\n").unwrap();
    assert_eq!(point_halves(&both), [[0.01, 0.0, 0.0], [0.01, 0.01, 0.0]]);
    let norm = (0.99998f64.powi(2) + 0.00001f64.powi(2) + 0.00632f64.powi(2)).sqrt();
    assert!(
        both.frames[0]
            .axis
            .iter()
            .all(|h| (h - 1e-6 * norm).abs() < 1e-18)
    );
    assert_eq!(both.frames[1].axis, [0.0; 3]);
    let lengths = u("[tolerance]\nlength = 0\n").unwrap();
    assert_eq!(
        (point_halves(&lengths), lengths.frames[0].axis),
        (vec![[0.0; 3]; 2], [5e-6; 3])
    );
    assert_eq!(u("[tolerance]\nlength = 0\ndirection = 0\n"), None);
    // A joint's own holds for the whole of its point.
    let own = door(points, axes, "").replacen("axis =", "tolerance = 0.2\naxis =", 1)
        + "[[point]]\nid = \"tip\"\nlink = \"door\"\npoint = [3, 4, 0]\ntolerance = 0.1\n";
    let m = read(&own);
    let u = uncertainties(&m).unwrap();
    assert_eq!(point_halves(&u), [[0.2; 3], [0.005, 0.005, 0.0]]);
}

#[test]
fn absurd_tolerances_are_refused_where_they_stand() {
    for stated in [
        "length = -1",
        "length = 100",
        "direction = 0.5",
        "direction = \"two\"",
        "angle = 0.5",
    ] {
        let more = format!("[tolerance]\n{stated}\n");
        let text = door(["[0, 0, 0]", "[0, 0, 120]"], [Z, Z], &more);
        assert_fails_on("check", "door.toml", &text, "", "door.toml:4:");
    }
    let text = door(["[0, 0, 0]", "[0, 0, 120]"], [Z, Z], "");
    let text = replace_once(&text, "axis =", "tolerance = -2\naxis =");
    assert_fails_on(
        "check",
        "door.toml",
        &text,
        "",
        "tolerance -2 is out of range",
    );
}

#[test]
fn what_is_written_again_says_the_same() {
    let stated = door(
        ["[151.23, 0, 5]", "[-149.85, 80, 0]"],
        [Z, Z],
        "[tolerance]\nlength = 0.01\n",
    );
    let own = door(["[151.23, 0, 5]", "[-149.85, 80, 0]"], [Z, Z], "").replacen(
        "axis =",
        "tolerance = 0.2\naxis =",
        1,
    );
    let turned = door(
        [
            "[151.230, 0.000, \"1001/1000\"]",
            "[\"123456789/10^20\", -80.50, 7.004]",
        ],
        ["[0.60000, 0.00000, 0.80000]", Z],
        "[tolerance]\ndirection = 1e-6\n",
    );
    for text in [stated, own, turned] {
        let (code, again, stderr) = run_on("export", "door.toml", &text, "--to toml --as-written");
        assert_eq!(code, Some(0), "{stderr}");
        assert_eq!(known(&again), known(&text), "{again}");
        assert!(known(&again).is_some());
    }
}

/// A bar on two hinges, with these places and axes.
fn urdf(first: &str, second: &str, axis: &str) -> String {
    format!(
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>
        <joint name='p' type='revolute'><parent link='a'/><child link='b'/><origin {first}/><axis xyz='{axis}'/></joint>
        <joint name='q' type='revolute'><parent link='b'/><child link='c'/><origin {second}/><axis xyz='0 0 1'/></joint></robot>"
    )
}

fn of_robot(name: &str, text: &str) -> Option<Uncertainties> {
    let imported = crate::robots::read_robot(name, text);
    // What is written says the same.
    let toml = imported.toml().unwrap();
    let again = mechanism_from_str("r.toml", &toml).unwrap();
    let found = uncertainties(&imported.mechanism);
    assert_eq!(uncertainties(&again), found, "{toml}");
    found
}

#[test]
fn importers_state_what_the_digits_of_their_formats_say() {
    let exact = urdf("xyz='0.1 0 0'", "xyz='0.25 0 0' rpy='0 0 0'", "0 0 1");
    assert_eq!(of_robot("r.urdf", &exact), None);
    // Five decimals, and trailing zeros among them.
    let lengths = of_robot(
        "r.urdf",
        &urdf("xyz='0.49400 0 0'", "xyz='0.25012 0 0'", "0 0 1"),
    )
    .unwrap();
    assert_eq!(lengths.frames[0].point, [5e-6, 0.0, 0.0]);
    assert!(lengths.frames.iter().all(|f| f.axis == [0.0; 3]));
    // A turn to five digits moves what is half a metre off by as much.
    let turned = urdf("xyz='0.4 0 0' rpy='1.5708 0 0'", "xyz='0.5 0 0'", "0 0 1");
    let turned = of_robot("r.urdf", &turned).unwrap();
    assert!(
        (turned.frames[1].point[0] - 2.5e-5).abs() < 1e-6,
        "{turned:?}"
    );
    assert!((turned.frames[0].axis[1] - 5e-5).abs() < 1e-9, "{turned:?}");
    let mjcf = "<mujoco><worldbody><body name='a' pos='0.1 0 0'><joint name='p' axis='0 0 1'/>
        <body name='b' pos='0.25 0 0' euler='0 12.50 0'><joint name='q' axis='0 0 1'/></body></body></worldbody></mujoco>";
    let mjcf = of_robot("r.xml", mjcf).unwrap();
    let half = 0.005f64.to_radians();
    let found = mjcf.frames[1].axis.into_iter().fold(0.0, f64::max);
    assert!((found - half).abs() < 0.05 * half, "{mjcf:?}");
    let sdf = "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'><pose>0.12345 0 0 0 0 0</pose></link>
        <joint name='w' type='fixed'><parent>world</parent><child>a</child></joint>
        <joint name='p' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>";
    assert_eq!(
        of_robot("r.sdf", sdf).unwrap().frames[0].point,
        [5e-6, 0.0, 0.0]
    );
}
