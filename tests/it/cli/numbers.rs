//! Costs and times in words, by hand.

use ozols_kernel::format::{format_cost, format_duration};

#[test]
fn costs_are_decimals_of_their_thousandths() {
    let told = [11_500, -2_000, 7, 50, 1_005, -1, 0].map(format_cost);
    let said = ["11.5", "-2", "0.007", "0.05", "1.005", "-0.001", "0"];
    assert_eq!(told, said);
}

#[test]
fn times_are_in_the_unit_that_suits_them() {
    let told = [2e-9, 4.2e-6, 0.0123, 0.5, 1.0, 7000.0].map(format_duration);
    let said = ["2.0 ns", "4.2 µs", "12 ms", "500 ms", "1.0 s", "117 min"];
    assert_eq!(told, said);
}
