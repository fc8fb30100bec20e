//! Couplings, places and limits that are carried over where a pose, another joint or another frame counts, by hand.

use super::closures::four_bar;
use super::{again, numbers, tags, taken, to};
use crate::robots::none;
use ozols::robots::convert::{LoopClosure, Target, Wanted, convert, figures};
use ozols::robots::{Imported, Options, import};

/// Three hinges, coupled.
fn arm(equality: &str) -> String {
    let body = |n: usize| {
        format!(
            "<body name='l{n}' pos='0 {n} 0'><joint name='j{n}' axis='0 0 1'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>"
        )
    };
    let bodies: String = (0..3).map(body).collect();
    format!(
        "<mujoco><compiler angle='radian'/><worldbody>{bodies}</worldbody><equality>{equality}</equality></mujoco>"
    )
}

fn in_pose(text: &str, pose: &[(&str, f64)]) -> Imported {
    let pose = pose.iter().map(|(j, x)| ((*j).to_owned(), vec![*x]));
    let options = Options {
        pose: pose.collect(),
        ..Options::default()
    };
    import("arm.xml", text.as_bytes(), &none, &options).unwrap_or_else(|e| panic!("{e}"))
}

/// What the mimic joint of a URDF follows: ratio and offset.
fn mimic(urdf: &str, leader: &str) -> [f64; 2] {
    let all = tags(urdf, "mimic");
    let own = all.iter().find(|m| m["joint"] == leader).unwrap();
    [&own["multiplier"], &own["offset"]].map(|x| x.parse().unwrap())
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-9, "{found}, not {wanted}");
}

/// The second of two that lead one joint follows it: of y = 0.5 + 2x is x = -0.25 + y/2.
#[test]
fn a_leader_that_follows_has_its_offset_turned_round() {
    let two = "<joint joint1='j1' joint2='j0' polycoef='0.2 -3 0 0 0'/><joint joint1='j1' joint2='j2' polycoef='0.5 2 0 0 0'/>";
    let urdf = to(&taken("arm.xml", &arm(two)), Target::Urdf).text;
    let [ratio, offset] = mimic(&urdf, "j1");
    near(ratio, 0.5);
    near(offset, -0.25);
    let [ratio, offset] = mimic(&urdf, "j0");
    near(ratio, -3.0);
    near(offset, 0.2);
}

/// At x = 0.5 of y = 0.1 + 2x + x²/2 + 4x³ + x⁴ the tangent has the rate 2 + x + 12x² + 4x³ = 6, and meets y = 1.7875 there.
#[test]
fn the_tangent_of_a_polynomial_is_that_of_the_pose() {
    let text = arm("<joint joint1='j1' joint2='j0' polycoef='0.1 2 0.5 4 1'/>");
    let i = in_pose(&text, &[("j0", 0.5), ("j1", 1.7875)]);
    let [ratio, offset] = mimic(&to(&i, Target::Urdf).text, "j0");
    near(ratio, 6.0);
    near(offset, 1.7875 - 6.0 * 0.5);
}

/// SDF counts from the pose that is drawn, in which a coupling that holds has no offset.
#[test]
fn from_a_pose_that_keeps_it_a_coupling_has_no_offset() {
    let text = arm("<joint joint1='j1' joint2='j0' polycoef='0.2 -3 0 0 0'/>");
    let i = in_pose(&text, &[("j0", 0.3), ("j1", -0.7)]);
    let sdf = to(&i, Target::Sdf).text;
    let of = |tag: &str| -> f64 {
        let rest = sdf.split(&format!("<{tag}>")).nth(1);
        rest.map_or(0.0, |r| r.split('<').next().unwrap().parse().unwrap())
    };
    near(of("multiplier"), -3.0);
    near(of("offset"), 0.0);
    let [ratio, offset] = mimic(&to(&i, Target::Urdf).text, "j0");
    near(ratio, -3.0);
    near(offset, 0.2);
}

/// The four-bar of the other tests in the plane of y and z, its pin on bodies that are fixed to rod and rocker: the hinges beside
/// it are those of what they are fixed to.
#[test]
fn bodies_fixed_together_have_the_same_hinges_beside_a_loop() {
    let inertia = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";
    let tip = |name: &str| format!("<body name='{name}'>{inertia}</body>");
    let pin = "<connect name='pin' body1='rod tip' body2='rocker tip' anchor='0 2 0.5'/>";
    let text = format!(
        "<mujoco><compiler angle='radian'/><worldbody>
          <body name='crank'><joint name='a' axis='1 0 0'/>{inertia}<body name='rod' pos='0 0 1'><joint name='b' axis='1 0 0'/>{inertia}{}</body></body>
          <body name='rocker' pos='0 2 0'><joint name='c' axis='1 0 0'/>{inertia}{}</body>
        </worldbody><equality>{pin}</equality></mujoco>",
        tip("rod tip"),
        tip("rocker tip")
    );
    let wanted = Wanted {
        all: Some(None),
        each: Vec::new(),
    };
    let c = convert(&taken("m.xml", &text), Target::Mjcf, &wanted);
    let c = c.unwrap_or_else(|e| panic!("{e}"));
    let [pin] = &c.closures[..] else {
        panic!("{:?}", c.closures)
    };
    assert_eq!(pin.options[pin.chosen].closure, LoopClosure::Line);
    assert_eq!(figures(&again(&c).mechanism), Some((1, 0)));
    // In the plane of x and y, as it is there.
    let flat = four_bar("<connect name='pin' body1='rod' body2='rocker' anchor='2 0.5 0'/>");
    let c = convert(&taken("m.xml", &flat), Target::Mjcf, &wanted);
    assert_eq!(c.unwrap_or_else(|e| panic!("{e}")).figures, Some((1, 0)));
}

/// Places given in a frame of the link are those of the frame and then their own.
#[test]
fn places_in_a_frame_of_the_link_come_after_the_frame() {
    let text = "<sdf version='1.9'><model name='m'>
      <link name='a'><inertial><pose relative_to='mark'>0 0.5 0 0 0 0</pose><mass>2</mass></inertial>
        <visual name='v'><pose relative_to='mark'>0.25 0 0 0 0 0</pose><geometry><sphere><radius>0.1</radius></sphere></geometry></visual></link>
      <frame name='mark' attached_to='a'><pose>1 2 3 0 0 0</pose></frame>
      <joint name='j' type='revolute'><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>
    </model></sdf>";
    let mjcf = to(&taken("m.sdf", text), Target::Mjcf).text;
    let place = |tag: &str| numbers(&tags(&mjcf, tag)[0]["pos"]);
    for (tag, wanted) in [("geom", [1.25, 2.0, 3.0]), ("inertial", [1.0, 2.5, 3.0])] {
        let found = place(tag);
        found.iter().zip(wanted).for_each(|(f, w)| near(*f, w));
    }
}

/// A limit beyond all numbers is none, whichever end it is of.
#[test]
fn a_limit_without_end_is_not_written() {
    let urdf = |lower: &str, upper: &str| {
        format!("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>
          <limit lower='{lower}' upper='{upper}' effort='1' velocity='1'/></joint></robot>")
    };
    let range = |lower: &str, upper: &str| {
        let mjcf = to(&taken("r.urdf", &urdf(lower, upper)), Target::Mjcf).text;
        let joint = tags(&mjcf, "joint").into_iter().find(|j| j["name"] == "j");
        joint.unwrap().get("range").cloned()
    };
    assert_eq!(range("-1", "2").as_deref(), Some("-1 2"));
    for (lower, upper) in [("-1e16", "2"), ("-1", "inf"), ("-inf", "1e16")] {
        assert_eq!(range(lower, upper), None, "{lower} {upper}");
    }
}

/// A universal joint of Drake turns about x of its first link and then about y: after a quarter turn about x that is z.
#[test]
fn a_second_axis_is_carried_by_the_first() {
    use ozols::geom::vector::{cross, real};
    let urdf = "<robot name='r' xmlns:drake='http://drake.mit.edu'><link name='a'/><link name='b'/>
      <drake:joint name='j' type='universal'><parent link='a'/><child link='b'/></drake:joint></robot>";
    let square = |first: f64| {
        let options = Options {
            pose: vec![("j".to_owned(), vec![first, 0.0])],
            ..Options::default()
        };
        let i =
            import("r.urdf", urdf.as_bytes(), &none, &options).unwrap_or_else(|e| panic!("{e}"));
        let frame = &i.mechanism.joints[0].frame;
        cross(real(&frame.axis), real(&frame.reference)).map(f64::abs)
    };
    let wanted = [
        (0.0, [0.0, 0.0, 1.0]),
        (std::f64::consts::FRAC_PI_2, [0.0, 1.0, 0.0]),
    ];
    for (first, wanted) in wanted {
        square(first)
            .iter()
            .zip(wanted)
            .for_each(|(f, w)| near(*f, w));
    }
}
