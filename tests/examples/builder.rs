//! A mechanism built in code: a slider between two equal rods, each of which turns a jaw.
//!
//! `cargo run --example builder`

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ozols::model::joint_type::JointType::{Cylindrical, Prismatic, Revolute, Spherical};
use ozols::model::mechanism::Role;
use ozols::{Builder, Error, Request, Scheme};

pub(crate) fn main() -> Result<(), Error> {
    let z = [0, 0, 1];
    let mut plan = Builder::new("idea", "mm")
        .link("frame", Role::Frame)
        .link("upper", Role::Output)
        .link("lower", Role::Output)
        .joint(
            "slide",
            ["frame", "driver"],
            Prismatic,
            [0, 0, 0],
            [1, 0, 0],
        )
        .driven();
    for (jaw, side) in [("upper", 1), ("lower", -1)] {
        let rod = format!("{jaw} rod");
        let id = |pin: &str| format!("{jaw} {pin}");
        plan = plan
            .joint(&id("a"), ["driver", &rod], Revolute, [0, 10 * side, 0], z)
            .joint(&id("b"), [&rod, jaw], Revolute, [30, 25 * side, 0], z)
            .joint(&id("c"), [jaw, "frame"], Revolute, [35, 5 * side, 0], z);
    }
    let gripper = plan.options(&[Cylindrical, Spherical]).build()?;
    assert_eq!(ozols::analyze(&gripper)?[0].redundant, 6);

    let outcome = ozols::search(&gripper, &Request::default())?;
    println!("{} redesigns; the cheapest:", outcome.admissible);
    outcome.variants().take(1).for_each(|v| println!("{v}"));
    let svg = ozols::draw(&gripper, Scheme::Kinematic)?;
    println!("{} bytes of SVG", svg.len());
    Ok(())
}
