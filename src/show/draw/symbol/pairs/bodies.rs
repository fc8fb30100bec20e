//! What each type of joint is made of, in the frame of the joint.

use super::solids::{
    HALF, PairPart, Solid, SolidFace, Turned, WHOLE, ball, cuboid, cylinder, lug, moved, prism,
    shell, swung, tube, turned,
};
use crate::geom::vector::{X, Y, Z, scale};
use crate::model::joint_type::JointType;
use crate::svg::plane::Point;

/// Half the length of a rod.
const ROD: f64 = 78.0;
/// Half the width of a plate.
const PLATE: f64 = 62.0;
/// How thick a plate is.
const THICK: f64 = 14.0;

/// The faces of both links; none of a type that has no name of its own, or is drawn by its symbol.
pub(super) fn bodies(of: &JointType) -> Vec<SolidFace> {
    match of {
        JointType::Revolute => hinge(),
        JointType::Prismatic => slide(),
        JointType::Helical => screw(),
        JointType::Cylindrical => [
            cylinder(PairPart::A, 15.0, [-ROD, ROD]),
            tube(PairPart::B, [16.0, 32.0], [-38.0, 38.0], HALF),
        ]
        .concat(),
        JointType::Universal => universal(),
        JointType::Slotted => pin_in_slot(),
        JointType::Spherical => ball_in_socket(),
        JointType::Planar => [
            plate(),
            cylinder(PairPart::A, 30.0, [0.0, 16.0]),
            cylinder(PairPart::A, 12.0, [16.0, 44.0]),
        ]
        .concat(),
        JointType::CylindricalUniversal => rod_in_cross(),
        JointType::SphereInCylinder => {
            let strip = with_stem(ball(25.0, 74.0), 84.0);
            [
                turned(PairPart::A, &strip, WHOLE, 36),
                tube(PairPart::B, [26.0, 36.0], [-62.0, 48.0], HALF),
            ]
            .concat()
        }
        JointType::CylinderOnPlane => {
            let round = cylinder(PairPart::A, 24.0, [-50.0, 50.0]);
            let lying = moved(swung(round, [Y, Z, X]), [0.0, 0.0, 24.0]);
            [plate(), lying].concat()
        }
        JointType::SphereOnPlane => {
            let round = turned(PairPart::A, &ball(30.0, 90.0), WHOLE, 36);
            [plate(), moved(round, [0.0, 0.0, 30.0])].concat()
        }
        JointType::Fixed => bolted(),
        _ => Vec::new(),
    }
}

/// A plate below the plane z = 0.
fn plate() -> Solid {
    let side = [-PLATE, PLATE];
    cuboid(PairPart::B, [side, side, [-THICK, 0.0]])
}

/// A fork round z: two cheeks so far from the plane z = 0, the bridge between them and a shaft, all towards -y.
fn fork(part: PairPart, [inner, outer]: [f64; 2], radius: f64) -> Solid {
    let (to, back) = (48.0, 60.0);
    let cheek = lug(radius, to);
    let shaft = cylinder(part, 12.0, [0.0, 28.0]);
    let shaft = swung(shaft, [X, Z, scale(Y, -1.0)]);
    [
        prism(part, &cheek, [inner, outer]),
        prism(part, &cheek, [-outer, -inner]),
        cuboid(part, [[-radius, radius], [-back, -to], [-outer, outer]]),
        moved(shaft, [0.0, -back, 0.0]),
    ]
    .concat()
}

/// Both ends of a pin along z.
fn ends(part: PairPart, radius: f64, [from, to]: [f64; 2]) -> Solid {
    [
        cylinder(part, radius, [from, to]),
        cylinder(part, radius, [-to, -from]),
    ]
    .concat()
}

/// An eye between the cheeks of a fork, on a pin.
fn hinge() -> Solid {
    // the eye goes along x, towards the reader, and the fork the other way
    let eye = prism(PairPart::A, &lug(22.0, 84.0), [-13.0, 13.0]);
    let fork = fork(PairPart::B, [14.0, 27.0], 22.0);
    [
        swung(eye, [Y, scale(X, -1.0), Z]),
        swung(fork, [scale(Y, -1.0), X, Z]),
        ends(PairPart::B, 11.0, [27.0, 36.0]),
    ]
    .concat()
}

/// A square bar in a sleeve, of which two walls are left.
fn slide() -> Solid {
    let half = 14.0;
    let bar = cuboid(PairPart::A, [[-half, half], [-half, half], [-ROD, ROD]]);
    let strip = [-38.0, 38.0].map(|z| [15.0, 30.0].map(|r: f64| [r * 2f64.sqrt(), z]));
    [bar, turned(PairPart::B, &strip, HALF, 2)].concat()
}

/// A threaded rod in a nut.
fn screw() -> Solid {
    let pitch = 13.0;
    let thread: Vec<[Point; 2]> = (-12..=12)
        .map(|i: i32| {
            let z = pitch / 2.0 * f64::from(i);
            let r = if i % 2 == 0 { 14.0 } else { 19.0 };
            [[0.0, z], [r, z]]
        })
        .collect();
    let rod = Turned {
        strip: &thread,
        angles: WHOLE,
        steps: 24,
        rise: pitch,
    };
    let nut = [-26.0, 26.0].map(|z| [[20.0, z], [40.0, z]]);
    [rod.of(PairPart::A), turned(PairPart::B, &nut, HALF, 3)].concat()
}

/// Two forks on a cross.
fn universal() -> Solid {
    let other = fork(PairPart::A, [30.0, 40.0], 15.0);
    let hub = [-10.0, 10.0];
    let arms = [
        ends(PairPart::Between, 8.0, [10.0, 30.0]),
        ends(PairPart::Between, 8.0, [40.0, 46.0]),
    ]
    .concat();
    [
        fork(PairPart::B, [30.0, 40.0], 15.0),
        swung(other, [Z, scale(Y, -1.0), X]),
        cuboid(PairPart::Between, [hub, hub, hub]),
        arms.clone(),
        swung(arms, [Y, Z, X]),
    ]
    .concat()
}

/// A pin on an arm, in the slot of a bar.
fn pin_in_slot() -> Solid {
    let (inner, outer, along, z) = (13.0, 28.0, 40.0, [-9.0, 9.0]);
    let end = |from: f64, x: f64| {
        let round = tube(PairPart::B, [inner, outer], z, [from, from + 180.0]);
        let round = round.into_iter().map(|f| SolidFace { cut: false, ..f });
        moved(round.collect(), [x, 0.0, 0.0])
    };
    let side = |y: [f64; 2]| cuboid(PairPart::B, [[-along, along], y, z]);
    let arm = prism(PairPart::A, &lug(17.0, 74.0), [-30.0, -12.0]);
    [
        arm,
        cylinder(PairPart::A, 12.0, [-12.0, 30.0]),
        end(-90.0, along),
        end(90.0, -along),
        side([inner, outer]),
        side([-outer, -inner]),
    ]
    .concat()
}

/// A ball on a rod, in a socket on another.
fn ball_in_socket() -> Solid {
    let ball = with_stem(ball(28.0, 72.0), ROD);
    let (outer, stem) = (40.0, 12.0f64);
    let neck = [stem, -(outer * outer - stem * stem).sqrt()];
    let round = shell([29.0, outer], 28.0);
    let round = round
        .into_iter()
        .map(|[i, o]| [i, if o[0] < stem { neck } else { o }]);
    let below = [[0.0, -ROD], [stem, -ROD]];
    let socket: Vec<[Point; 2]> = std::iter::once(below).chain(round).collect();
    [
        turned(PairPart::A, &ball, WHOLE, 36),
        turned(PairPart::B, &socket, HALF, 18),
    ]
    .concat()
}

/// A profile that goes on as a stem up to a height.
fn with_stem(mut of: Vec<[Point; 2]>, to: f64) -> Vec<[Point; 2]> {
    if let Some(&[_, [r, _]]) = of.last() {
        of.push([[0.0, to], [r, to]]);
    }
    of
}

/// A rod that slides in the ring of a cross, whose pins turn in a fork.
fn rod_in_cross() -> Solid {
    let pins = [
        ends(PairPart::Between, 8.0, [27.0, 38.0]),
        ends(PairPart::Between, 8.0, [48.0, 54.0]),
    ]
    .concat();
    let fork = fork(PairPart::B, [38.0, 48.0], 15.0);
    [
        cylinder(PairPart::A, 14.0, [-ROD, ROD]),
        tube(
            PairPart::Between,
            [15.0, 27.0],
            [-17.0, 17.0],
            [150.0, 390.0],
        ),
        swung(pins, [Y, Z, X]),
        swung(fork, [scale(Z, -1.0), Y, X]),
    ]
    .concat()
}

/// Two blocks, one on the other, with a bolt.
fn bolted() -> Solid {
    let block = |part, x, z| cuboid(part, [x, [-34.0, 34.0], z]);
    let head: Vec<Point> = (0..6)
        .map(|i| {
            let angle = f64::to_radians(60.0 * f64::from(i));
            [18.0 * angle.cos(), 18.0 * angle.sin()]
        })
        .collect();
    [
        block(PairPart::A, [-40.0, 80.0], [0.0, 24.0]),
        block(PairPart::B, [-80.0, 40.0], [-24.0, 0.0]),
        prism(PairPart::Between, &head, [24.0, 36.0]),
        cylinder(PairPart::Between, 9.0, [36.0, 42.0]),
    ]
    .concat()
}
