//! Slides and rods that add up to a definite form of high order, which only rest fulfils, beside motions that are free.
//!
//! A rod of length l between a cross slide and a lift raises the lift by l - sqrt(l² - x²) = x²/(2l) + x⁴/(8l³) + ...; rods in a
//! row add up. Signed curvatures a = 1/l with Σ a = 0 leave Σ a³ x⁴/8, those with Σ a³ = 0, too, Σ a⁵ x⁶/16, and a pair of
//! opposite ones leaves nothing: that slide is free.

use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::StateId;
use ozols::redundancy::analysis::{Method, analyse};
use proptest::prelude::*;

const QUARTICS: [[i64; 4]; 3] = [[1, 3, -2, -2], [1, 5, -3, -3], [-1, -4, 6, -1]];
const SEXTIC: [i64; 5] = [9, 5, 1, -7, -8];

/// One slide for each list of curvatures, with rods of length `unit` over each; all lifts in a row, the last one fixed.
fn forms(blocks: &[(Vec<i64>, &str)]) -> String {
    let mut out = "name = \"forms\"\n[[link]]\nid = \"frame\"\nrole = \"frame\"\n".to_owned();
    let mut joints = 0;
    let mut joint = |out: &mut String, links: [&str; 2], kind: &str, at: String, axis: [i64; 3]| {
        joints += 1;
        *out += &format!(
            "[[joint]]\nid = \"j{joints}\"\nlinks = {links:?}\ntype = {kind:?}\npoint = [{at}, 0]\naxis = {axis:?}\n"
        );
    };
    let ([x, y, z], mut below, mut rods) =
        ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], "frame".to_owned(), 0);
    for (b, (curvatures, unit)) in blocks.iter().enumerate() {
        let slide = format!("x{b}");
        let role = if b == 0 { "role = \"output\"\n" } else { "" };
        out += &format!("[[link]]\nid = {slide:?}\n{role}");
        joint(
            &mut out,
            ["frame", &slide],
            "prismatic",
            format!("0, {b}"),
            x,
        );
        for a in curvatures {
            rods += 1;
            let (rod, lift) = (format!("r{rods}"), format!("t{rods}"));
            out += &format!("[[link]]\nid = {rod:?}\n[[link]]\nid = {lift:?}\n");
            let mut carrier = slide.clone();
            if below != "frame" {
                carrier = format!("c{rods}");
                out += &format!("[[link]]\nid = {carrier:?}\n");
                joint(
                    &mut out,
                    [&slide, &carrier],
                    "prismatic",
                    "4, 3".to_owned(),
                    y,
                );
                joint(
                    &mut out,
                    [&below, &carrier],
                    "prismatic",
                    "4, 5".to_owned(),
                    x,
                );
            }
            let at = 21 * rods;
            joint(
                &mut out,
                [&carrier, &rod],
                "revolute",
                format!("{at}, 3"),
                z,
            );
            let end = format!("{at}, \"3-({unit})/({a})\"");
            joint(&mut out, [&rod, &lift], "revolute", end, z);
            joint(
                &mut out,
                [&below, &lift],
                "prismatic",
                format!("{at}, 5"),
                y,
            );
            below = lift;
        }
    }
    joint(&mut out, [&below, "frame"], "fixed", "0, 0".to_owned(), z);
    out
}

/// The least and the most that the finite mobility is said to be.
fn range(blocks: &[(Vec<i64>, &str)]) -> (usize, usize) {
    let text = forms(blocks);
    let m = mechanism_from_str("forms.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let method = Method::Auto { tolerance: None };
    let found = analyse(&m, &[StateId::FREE], method).unwrap().remove(0);
    assert_eq!(found.mobility, blocks.len());
    (found.finite.mobility, found.finite.at_most())
}

proptest! {
    #![proptest_config(crate::fuzz::runs(6))]
    #[test]
    fn a_definite_form_beside_free_slides_is_no_motion(
        quartic in prop::sample::select(QUARTICS.to_vec()),
        sextic in any::<bool>(),
        free in 0usize..3,
        unit in prop::sample::select(vec!["10", "1e-8", "1e6"]),
        first in any::<bool>(),
    ) {
        let form = if sextic { SEXTIC.to_vec() } else { quartic.to_vec() };
        // Of very different lengths where the unit is another.
        let mut blocks = vec![(form, unit)];
        blocks.extend(vec![(vec![2, -2], "10"); free]);
        if first {
            blocks.reverse();
        }
        let (least, most) = range(&blocks);
        prop_assert!(least <= free && free <= most, "{} to {}, not {}", least, most, free);
    }
}
