//! Decimals that are all but simple fractions are doubted where a file is checked.

use super::digits::{Z, door};
use crate::common::*;

#[test]
fn decimal_ratios_that_are_all_but_fractions_are_doubted() {
    let hinges =
        "h0 | 0 a | revolute | 0, 0, 0 | 0, 0, 1\nh1 | 0 b | revolute | 30, 0, 0 | 0, 0, 1";
    let gears = |ratio: &str| {
        write_mechanism("name = \"gears\"\nlength_unit = \"mm\"", "0 a b*", hinges)
            + &format!("[[coupling]]\njoints = [\"h0\", \"h1\"]\nratio = {ratio}\n")
    };
    let told = |ratio: &str| run_on("check", "gears.toml", &gears(ratio), "");
    for (ratio, fraction) in [("-0.6667", "-2/3"), ("1.4286", "10/7")] {
        let (code, _, stderr) = told(ratio);
        assert_eq!(code, Some(0), "{stderr}");
        has(&stderr, &format!("ratio = \"{fraction}\""));
        has(&stderr, "h0 ~ h1");
    }
    for exact in ["\"-2/3\"", "\"1001/1000\"", "-1.5", "\"6667/10^4\"", "3"] {
        let (_, _, stderr) = told(exact);
        assert!(!stderr.contains("ratio"), "{exact}: {stderr}");
    }
}

#[test]
fn a_pitch_that_is_all_but_that_of_a_simple_lead_is_doubted() {
    let screw = |pitch: &str| {
        door(["[0, 0, 0]", "[0, 0, 9]"], [Z, Z], "")
            + &format!(
                "[[joint]]\nid = \"s\"\nlinks = [\"0\", \"door\"]\ntype = \"helical\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n{pitch}\n"
            )
    };
    let told = |pitch: &str| run_on("check", "screw.toml", &screw(pitch), "").2;
    has(&told("pitch = 0.7958"), "write lead = \"5\"");
    for fine in ["lead = 5", "pitch = 0.8", "pitch = \"5/(2*pi)\""] {
        assert!(!told(fine).contains("simple lead"), "{}", told(fine));
    }
}
