//! Mechanisms for unit tests, which have no files to read.

use crate::geom::expr::Expr;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{
    Frame, Joint, JointOption, LengthUnit, Link, LinkId, Mechanism, Mode, Parts, Role,
};

/// The direction x, in numbers.
pub(crate) const X: [f64; 3] = [1.0, 0.0, 0.0];
/// The direction y, in numbers.
pub(crate) const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// The direction z, in numbers.
pub(crate) const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A joint of a type between two links, with its point and its axis.
pub(crate) type Drawn = (JointType, [usize; 2], [f64; 3], [f64; 3]);

/// Converts numbers to exact ones.
pub(crate) fn to_exact(v: [f64; 3]) -> [Expr; 3] {
    v.map(|x| Expr::from_f64(x).unwrap())
}

/// Returns a mechanism in space whose link 0 is the frame, and whose joints have no options.
pub(crate) fn draw_mechanism(joints: &[Drawn], outputs: &[usize]) -> Mechanism {
    let last = joints.iter().flat_map(|j| j.1).max().unwrap_or(0);
    let role = |i: usize| match i {
        0 => Role::Frame,
        _ if outputs.contains(&i) => Role::Output,
        _ => Role::Inner,
    };
    let link = |i: usize| Link {
        id: i.to_string(),
        role: role(i),
        mass: None,
    };
    Mechanism::of_valid(Parts {
        name: String::new(),
        description: String::new(),
        sources: Vec::new(),
        length_unit: LengthUnit {
            symbol: "m",
            metres: 1.0,
        },
        mode: Mode::Spatial,
        links: (0..=last).map(link).collect(),
        joints: (0..).zip(joints).map(|(n, j)| drawn_joint(n, j)).collect(),
        couplings: Vec::new(),
        states: vec!["free".to_owned()],
        contours: Vec::new(),
        search: Default::default(),
        loads: Default::default(),
        ranking: None,
        joint_types: Vec::new(),
        points: Vec::new(),
        expected: Vec::new(),
        claims: Vec::new(),
        assumed: Vec::new(),
        tables: Default::default(),
    })
}

fn drawn_joint(number: usize, drawn: &Drawn) -> Joint {
    let (joint_type, links, point, axis) = drawn;
    let frame = Frame {
        point: to_exact(*point),
        axis: to_exact(*axis),
        reference: to_exact(if axis[0] == 0.0 {
            X
        } else {
            [axis[2], 1.0, 0.0]
        }),
        pitch: 0.into(),
    };
    Joint {
        id: number.to_string(),
        links: links.map(LinkId::new),
        drive: false,
        drive_freedom: None,
        states: None,
        options: vec![JointOption {
            name: joint_type.name().to_owned(),
            joint_type: joint_type.clone(),
            frame: frame.clone(),
            cost_milli: None,
            state: None,
        }],
        joint_type: joint_type.clone(),
        frame,
        unloading: Vec::new(),
    }
}

/// Returns hinges about z at some points.
pub(crate) fn hinges(all: &[([usize; 2], [f64; 3])]) -> Vec<Drawn> {
    let hinge = |&(links, point)| (JointType::Revolute, links, point, Z);
    all.iter().map(hinge).collect()
}

/// Returns four bars on a link with others numbered after `from`, moved by `by`.
pub(crate) fn four_bar(on: usize, from: usize, by: f64) -> Vec<Drawn> {
    let links = [
        [on, from],
        [from, from + 1],
        [from + 1, from + 2],
        [from + 2, on],
    ];
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 5.0, 0.0],
        [7.0, 6.0, 0.0],
        [8.0, 1.0, 0.0],
    ];
    let moved = |(links, [x, y, z]): ([usize; 2], [f64; 3])| (links, [x + by, y, z]);
    hinges(&links.into_iter().zip(points).map(moved).collect::<Vec<_>>())
}
