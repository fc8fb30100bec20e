//! What shapes weigh and how they turn, where a file leaves it to them: against sums over thin slices, and by hand.

use super::{numbers, tags, taken, to};
use ozols::robots::convert::Target;

/// What a body of these shapes weighs: mass, centre, and xx yy zz xy xz yz.
fn inertial(shapes: &str) -> (f64, Vec<f64>, Vec<f64>) {
    let text = format!(
        "<mujoco><worldbody><body name='b'><joint name='j'/>{shapes}</body></worldbody></mujoco>"
    );
    of(&to(&taken("m.xml", &text), Target::Mjcf).text)
}

fn of(text: &str) -> (f64, Vec<f64>, Vec<f64>) {
    let all = tags(text, "inertial");
    let own = all.last().unwrap_or_else(|| panic!("{text}"));
    let tensor = match own.get("fullinertia") {
        Some(all) => numbers(all),
        None => [numbers(&own["diaginertia"]), vec![0.0; 3]].concat(),
    };
    (own["mass"].parse().unwrap(), numbers(&own["pos"]), tensor)
}

fn alike(found: &[f64], wanted: &[f64], what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let near = |(f, w): (&f64, &f64)| (f - w).abs() <= 1e-6 * size;
    assert!(
        found.iter().zip(wanted).all(near),
        "{what}: {found:?} for {wanted:?}"
    );
}

/// A body of water round z, by its radius at each height: discs of πr², each r²/4 across and r²/2 along of its mass.
fn turned(half: f64, radius: impl Fn(f64) -> f64) -> (f64, [f64; 6]) {
    const SLICES: i32 = 200_000;
    let thick = 2.0 * half / f64::from(SLICES);
    let (mut mass, mut across, mut along) = (0.0, 0.0, 0.0);
    for i in 0..SLICES {
        let z = -half + thick * (f64::from(i) + 0.5);
        let square = radius(z).powi(2);
        let disc = 1000.0 * std::f64::consts::PI * square * thick;
        mass += disc;
        across += disc * (square / 4.0 + z * z);
        along += disc * square / 2.0;
    }
    (mass, [across, across, along, 0.0, 0.0, 0.0])
}

#[test]
fn round_shapes_weigh_what_their_slices_do() {
    let ball = |r: f64, z: f64| (r * r - z * z).max(0.0).sqrt();
    let all: [(&str, (f64, [f64; 6])); 4] = [
        ("type='sphere' size='0.2'", turned(0.2, |z| ball(0.2, z))),
        ("type='cylinder' size='0.1 0.4'", turned(0.4, |_| 0.1)),
        (
            "type='capsule' size='0.1 0.4'",
            turned(0.5, |z| ball(0.1, (z.abs() - 0.4).max(0.0))),
        ),
        (
            "type='ellipsoid' size='0.2 0.2 0.3'",
            turned(0.3, |z| 0.2 * ball(1.0, z / 0.3)),
        ),
    ];
    for (shape, (mass, tensor)) in all {
        let found = inertial(&format!("<geom {shape}/>"));
        alike(&[found.0], &[mass], shape);
        alike(&found.2, &tensor, shape);
    }
}

/// Masses of 3 and 1 kg at (0, 0, 0) and (0.2, 0.1, 0.4) have their middle a quarter of the way, and, beside what each is itself,
/// the inertia of 3/4 kg so far apart.
#[test]
fn shapes_apart_weigh_together() {
    let (mass, centre, tensor) = inertial(
        "<geom type='sphere' size='0.1' mass='3'/><geom type='sphere' size='0.1' mass='1' pos='0.2 0.1 0.4'/>",
    );
    alike(&[mass], &[4.0], "mass");
    alike(&centre, &[0.05, 0.025, 0.1], "centre");
    let own = 4.0 * 0.4 * 0.01;
    let wanted = [
        own + 0.75 * (0.01 + 0.16),
        own + 0.75 * (0.04 + 0.16),
        own + 0.75 * (0.04 + 0.01),
        -0.75 * 0.02,
        -0.75 * 0.08,
        -0.75 * 0.04,
    ];
    alike(&tensor, &wanted, "tensor");
}

/// A box of 2 by 1 by 1 m turned by 30° about z: (Ix - Iy) sin cos is its product of inertia.
#[test]
fn what_is_turned_has_products_of_inertia() {
    let (_, _, tensor) = inertial("<geom type='box' size='1 0.5 0.5' mass='12' euler='0 0 30'/>");
    let (x, y) = (1.0 + 1.0, 4.0 + 1.0);
    let (s, c) = (0.5, 3f64.sqrt() / 2.0);
    let wanted = [
        c * c * x + s * s * y,
        s * s * x + c * c * y,
        y,
        (x - y) * s * c,
        0.0,
        0.0,
    ];
    alike(&tensor, &wanted, "tensor");
}

/// What is stated is carried in each format's own order and by its own defaults.
#[test]
fn stated_inertias_are_in_their_formats_order() {
    let (_, _, tensor) = inertial("<inertial pos='0 0 0' mass='2' diaginertia='0.3 0.4 0.5'/>");
    alike(&tensor, &[0.3, 0.4, 0.5, 0.0, 0.0, 0.0], "diaginertia");
    let urdf = "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='2'/>\
        <inertia ixx='0.3' iyy='0.4' izz='0.5' ixy='0.01' ixz='0.02' iyz='0.03'/></inertial></link>\
        <joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>";
    let (_, _, tensor) = of(&to(&taken("r.urdf", urdf), Target::Mjcf).text);
    alike(&tensor, &[0.3, 0.4, 0.5, 0.01, 0.02, 0.03], "urdf");
    let sdf = "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'><inertial><inertia><ixx>0.3</ixx></inertia></inertial></link>\
        <joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>";
    let (mass, _, tensor) = of(&to(&taken("m.sdf", sdf), Target::Mjcf).text);
    alike(&[mass], &[1.0], "sdf");
    alike(&tensor, &[0.3, 1.0, 1.0, 0.0, 0.0, 0.0], "sdf");
}

/// A motor's force is limited to either side, and a rotor behind a gear of 3 weighs nine times as much.
#[test]
fn motors_are_carried_with_their_gears() {
    let text = "<mujoco><worldbody><body name='b'><joint name='j' actuatorfrcrange='-9 7'/><geom size='0.1'/></body></worldbody></mujoco>";
    let urdf = to(&taken("m.xml", text), Target::Urdf).text;
    assert_eq!(tags(&urdf, "limit")[0]["effort"], "9", "{urdf}");
    let drake = "<robot name='r' xmlns:drake='http://drake.mit.edu'><link name='a'/><link name='b'/>\
        <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>\
        <transmission><type>transmission_interface/SimpleTransmission</type><joint name='j'/><actuator name='m'>\
        <drake:rotor_inertia value='0.01'/><drake:gear_ratio value='3'/></actuator></transmission></robot>";
    let mjcf = to(&taken("r.urdf", drake), Target::Mjcf).text;
    let armature: f64 = tags(&mjcf, "joint")[0]["armature"].parse().unwrap();
    alike(&[armature], &[0.09], "armature");
}
