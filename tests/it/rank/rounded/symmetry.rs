//! Symmetry that a file states holds in the turned and rounded one, too: variants that are their own images, and one of each pair
//! of images, are counted as in the exact file.

use super::search_numeric::{small_request, turned_bare, without_options};
use crate::common::*;

const BOTH: [Symmetry; 2] = [Symmetry::SymmetricOnly, Symmetry::OnePerOrbit];

fn asked(symmetry: Symmetry) -> Request {
    Request {
        symmetry,
        ..small_request()
    }
}

fn two_rockers() -> Mechanism {
    let mut joints = "o | 0 shaft | revolute | 0, 0, 0 | 0, 0, 1\n".to_owned();
    for (of, sign) in [("", ""), ("2", "-")] {
        joints += &format!(
            "a{of} | shaft rod{of} | revolute | {sign}2, {sign}0, 0 | 0, 0, 1
            b{of} | rod{of} rocker{of} | revolute | {sign}3, {sign}4, 0 | 0, 0, 1
            c{of} | rocker{of} 0 | revolute | {sign}7, {sign}1, 0 | 0, 0, 1\n"
        );
    }
    let turn = "turn = [[\"a\", \"a2\"], [\"b\", \"b2\"], [\"c\", \"c2\"]]";
    let head = format!("name = \"two-rockers\"\n[search]\noptions = [\"revolute\"]\n{turn}");
    let file = write_mechanism(&head, "0 shaft* rod rod2 rocker rocker2", &joints);
    read(&file)
}

/// Turned files that have the counts of the exact one, of all at these decimals; none has others and calls them exact.
fn same(name: &str, exact: &Mechanism, decimals: &[usize]) -> [usize; 2] {
    let (mut same, mut all) = (0, 0);
    for symmetry in BOTH {
        let truth = ozols::search(exact, &asked(symmetry)).unwrap();
        for (n, &d) in decimals.iter().enumerate() {
            let m = turned_bare(exact, d, &mut Noise::new(n as u64, d));
            all += 1;
            let Ok(found) = ozols::search(&m, &asked(symmetry)) else {
                continue;
            };
            let counts = (&found.determinate, &found.admissible);
            let alike = counts == (&truth.determinate, &truth.admissible);
            assert!(alike || !found.is_exact(), "{name} at {d} decimals");
            same += usize::from(alike);
        }
    }
    [same, all]
}

#[test]
fn mirror_pairs_of_built_in_grippers_hold_in_turned_files() {
    let mut sum = [0, 0];
    for name in split_words(
"lever-gripper gripper-slider-two-fingers gripper-slider-two-fingers-balls lever-slot-gripper
            gripper-10-redesign parallelogram-gripper",
) {
        let exact = without_options(built_in(name));
        let [same, all] = same(name, &exact, &[4, 6, 9, 12]);
        sum = [sum[0] + same, sum[1] + all];
    }
    assert!(sum[0] * 10 >= sum[1] * 9, "{sum:?}");
}

#[test]
fn joints_that_become_each_other_by_half_a_turn_do_so_in_turned_files() {
    let exact = without_options(two_rockers());
    let found = ozols::search(&exact, &asked(Symmetry::OnePerOrbit)).unwrap();
    assert!(found.is_exact() && found.admissible.total > 0u32.into());
    assert_eq!(same("two rockers", &exact, &[4, 6, 9, 12, 15]), [10, 10]);
}

#[test]
fn a_stated_image_that_is_off_by_more_than_the_digits_is_refused() {
    let text = builtin::text("gripper-slider-two-fingers").unwrap();
    let exact = without_options(read(text));
    for (seed, symmetry) in [1, 2].into_iter().zip(BOTH) {
        let mut m = turned_bare(&exact, 6, &mut Noise::new(seed, 0));
        let joint = m.search.mirror[1].0;
        for axis in 0..3 {
            let x = &mut m.edit().joints[joint].frame.point[axis];
            // Eight units of the last digit.
            *x = format!("{:.6}", x.to_f64() + 8e-6).parse().unwrap();
        }
        let error = ozols::search(&m, &asked(symmetry)).unwrap_err().to_string();
        has(&error, "counts of images need exact ones");
    }
}
