//! Discs of unequal inertia: the bar and the damping are for the heavier one, whichever is named first.

use crate::common::*;
use ozols::drive::driving::{Design, design_drive};
use ozols::drive::swing::Latch;

/// The heavier disc is the first or the second.
fn designs(more: &str) -> [(Design, f64, usize); 2] {
    [("0.3", "0.1", 0), ("0.1", "0.3", 1)].map(|(first, second, heavier)| {
        let text = format!(
            "name = \"d\"\n[workload.drive]\nswing_angle = 90\nswing_time = 0.4\nshear_modulus = 8e10\n\
             allowable_stress = 6e8\ninertia = {first}\nsecond_inertia = {second}\n{more}"
        );
        let spec = drive_from_bytes("d.toml", text.as_bytes()).unwrap().spec;
        (design_drive(&spec).unwrap().design.unwrap(), spec.twist, heavier)
    })
}

/// A swing is half a period, so that 0.3 kg·m² in 0.4 s ask for k = I (2π / 0.8 s)².
#[test]
fn the_bar_is_as_stiff_as_the_heavier_disc_asks() {
    for (design, ..) in designs("") {
        let asked = 0.3 * (TAU / 0.8).powi(2);
        near(design.stiffness / asked, 1.0, 1e-9);
    }
}

/// Damping that a missing angle stands for is that with which the heavier disc misses so much.
#[test]
fn the_missing_angle_is_the_heavier_discs() {
    for (design, twist, heavier) in designs("missing_angle = 3\n") {
        let latch = Latch {
            at: twist,
            capture: twist,
        };
        let disc = design.module.discs[heavier];
        let swing = disc.swing_from(twist, latch, Feed::NONE).unwrap();
        near(twist - swing.place, 3f64.to_radians(), 1e-9);
    }
}

/// Of friction that is stated the drive's figures are those of the disc that asks for more: it misses by as much as a free swing of it.
#[test]
fn the_missing_angle_is_that_of_the_disc_that_misses_more() {
    for (design, twist, _) in designs("viscous_damping = 0.02\nfriction_moment = 0.3\n") {
        let latch = Latch {
            at: twist,
            capture: twist,
        };
        let short = (design.module.discs)
            .map(|disc| twist - disc.swing_from(twist, latch, Feed::NONE).unwrap().place);
        assert!((short[0] - short[1]).abs() > 1e-3, "{short:?}");
        near(design.missing, short[0].max(short[1]), 1e-9);
    }
}
