//! Slides and rods that add up to a definite form of high order, which only rest fulfils, beside motions that are free.
//!
//! A rod of length l between a cross slide and a lift raises the lift by l - sqrt(l² - x²) = x²/(2l) + x⁴/(8l³) + ...; rods in a
//! row add up. Signed curvatures a = 1/l with Σ a = 0 leave Σ a³ x⁴/8, those with Σ a³ = 0, too, Σ a⁵ x⁶/16, and a pair of
//! opposite ones leaves nothing: that slide is free.

use crate::common::*;

const QUARTICS: [[i64; 4]; 3] = [[1, 3, -2, -2], [1, 5, -3, -3], [-1, -4, 6, -1]];
const SEXTIC: [i64; 5] = [9, 5, 1, -7, -8];

/// Returns a length, of another order of magnitude than the others now and then.
fn unit() -> impl Strategy<Value = &'static str> {
    prop_oneof![4 => Just("10"), 1 => Just("1e-8"), 1 => Just("1e6")]
}

/// Returns the curvatures of forms that only rest fulfils: Σ a = 0 and Σ a³ > 0, drawn at random, or of order six. All forms are
/// positive, so that their sum is definite, too.
fn definite_form() -> impl Strategy<Value = Vec<i64>> {
    let balanced = |mut a: Vec<i64>| {
        a.push(-a.iter().sum::<i64>());
        let cubes: i64 = a.iter().map(|a| a.pow(3)).sum();
        let of_order_four = cubes != 0 && a.iter().all(|&a| a != 0);
        of_order_four.then(|| a.iter().map(|a| a * cubes.signum()).collect())
    };
    prop_oneof![
        prop::sample::select(QUARTICS.to_vec()).prop_map(Vec::from),
        Just(SEXTIC.to_vec()),
        prop::collection::vec(-9i64..10, 2..4).prop_filter_map("not of order four", balanced),
    ]
}

/// The curvatures of a slide's rods, the length of a rod of curvature 1, and whether the row of lifts ends behind it.
type Block = (Vec<i64>, &'static str, bool);

/// One slide for each list of curvatures, with rods of length `unit` over each; lifts in rows, the last one of each fixed.
fn forms(blocks: &[Block]) -> String {
    let (mut links, mut all, mut rods) = ("frame".to_owned(), String::new(), 0);
    let mut joint = |ends: [&str; 2], kind: &str, at: String, axis: &str| {
        let n = all.lines().count();
        all += &format!("j{n} | {} | {kind} | {at}, 0 | {axis}\n", ends.join(" "));
    };
    let [x, y, z] = ["1, 0, 0", "0, 1, 0", "0, 0, 1"];
    let mut below = "frame".to_owned();
    for (b, (curvatures, unit, ends)) in blocks.iter().enumerate() {
        let slide = format!("x{b}");
        links += &format!(" {slide}{}", if b == 0 { "*" } else { "" });
        joint(["frame", &slide], "prismatic", format!("0, {b}"), x);
        for a in curvatures {
            rods += 1;
            let (rod, lift) = (format!("r{rods}"), format!("t{rods}"));
            links += &format!(" {rod} {lift}");
            let mut carrier = slide.clone();
            if below != "frame" {
                carrier = format!("c{rods}");
                links += &format!(" {carrier}");
                joint([&slide, &carrier], "prismatic", "4, 3".to_owned(), y);
                joint([&below, &carrier], "prismatic", "4, 5".to_owned(), x);
            }
            let at = 21 * rods;
            joint([&carrier, &rod], "revolute", format!("{at}, 3"), z);
            let end = format!("{at}, \"3-({unit})/({a})\"");
            joint([&rod, &lift], "revolute", end, z);
            joint([&below, &lift], "prismatic", format!("{at}, 5"), y);
            below = lift;
        }
        if *ends || b + 1 == blocks.len() {
            joint([&below, "frame"], "fixed", "0, 0".to_owned(), z);
            below = "frame".to_owned();
        }
    }
    write_mechanism("name = \"forms\"", &links, &all)
}

/// The least and the most that the finite mobility is said to be.
fn range(blocks: &[Block]) -> (usize, usize) {
    let text = forms(blocks);
    let m = read(&text);
    let method = Method::Auto;
    let found = analyse_states(&m, &[StateId::FREE], method)
        .unwrap()
        .remove(0);
    assert_eq!(found.mobility, blocks.len());
    (found.finite.mobility, found.finite.at_most())
}

proptest! {
    #![proptest_config(crate::fuzz::runs(6))]
    #[test]
    fn a_definite_form_beside_free_slides_is_no_motion(
        definite in prop::collection::vec((definite_form(), unit(), any::<bool>()), 1..4),
        free in prop::collection::vec((Just(vec![2, -2]), Just("10"), any::<bool>()), 0..3),
        first in any::<bool>(),
    ) {
        let motions = free.len();
        let (before, after) = if first { (free, definite) } else { (definite, free) };
        let (least, most) = range(&[before, after].concat());
        prop_assert!(least <= motions && motions <= most, "{} to {}, not {}", least, most, motions);
    }
}
