//! What a drive must do for two levers, by virtual work.

use crate::common::*;
use ozols::grip::drive_effort;
use ozols::grip::holding::Holding;
use ozols::statics::transmission::Rates;

/// Moments of 3 and 5 N·m on levers that turn 2 and 4 rad per metre of the drive take 26 N of it; levers with a drive each have no
/// drive in common.
#[test]
fn one_drive_does_the_work_of_both_levers() {
    let nothing = ContactForce {
        normal: 0.0,
        along: 0.0,
        axial: 0.0,
    };
    let holding = Holding {
        forces: [nothing; 4],
        moments: [3.0, 5.0],
        drive: 5.0,
        lower_bound: 5.0,
    };
    let rates = Rates {
        slides: true,
        rates: vec![2.0, 4.0],
    };
    for (levers, wanted) in [
        (LeverDrive::Coupled, Some(26.0)),
        (LeverDrive::Equal, Some(26.0)),
        (LeverDrive::Independent, None),
    ] {
        assert_eq!(drive_effort(levers, &holding, &rates), wanted, "{levers:?}");
    }
}
