//! What `[Pavlenko & Godunko 2010]` found on the curves of its figures 2 to 5, and the numbers the formulas give there.
//!
//! Neither depends on a user's gripper, so they are stated here once; tests/it/grip/published.rs draws the curves again and
//! holds every claim and number against them.

use serde::Serialize;

/// A finding of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// What is claimed.
    pub claim: &'static str,
    /// Whether it holds on the curves.
    pub holds: bool,
    /// The numbers it rests on.
    pub evidence: &'static str,
}

const fn confirmed(claim: &'static str, evidence: &'static str) -> Finding {
    Finding {
        claim,
        holds: true,
        evidence,
    }
}

/// What the paper draws and says besides, and its own equations contradict.
///
/// # Sources
/// `[Pavlenko & Godunko 2010]` fig. 2 and its discussion.
pub const REFUTED: Finding = Finding {
    claim: "with the pivots held (a = 40 mm) both arms grow less with L: lines 10 and 11 of fig. 2",
    holds: false,
    evidence: "by (1) and (2) the arms do not depend on a: 0.766 and 0.940 mm per mm of L, as lines 1 and 3",
};

/// The paper's findings.
///
/// # Sources
/// `[Pavlenko & Godunko 2010]` discussion of figs. 2 to 5 and conclusions.
pub const FINDINGS: [Finding; 6] = [
    confirmed(
        "both arms are linear in L and in D",
        "slopes along a line differ by 5.7e-14 at most",
    ),
    confirmed(
        "l1 grows and l2 falls with D, alike",
        "0.289 to 0.500 mm and -0.500 to -0.289 mm per mm of D",
    ),
    confirmed(
        "both arms grow with α",
        "from 60° to 140°: l1 by 0.115 to 1.219, l2 by 0.198 to 1.037 mm per degree; l1 falls again near α = 180° - γ",
    ),
    confirmed(
        "γ raises l1 strongly and lowers l2 weakly",
        "from 0° to 40° l1 changes at least 1.88 times as much; equally fast at γ = 90° - α/2",
    ),
    confirmed(
        "the arms may be equal or differ 2 to 3 times",
        "l1/l2 from 0.600 to 6.824 on the curves",
    ),
    confirmed(
        "the near contact can have the longer arm",
        "exactly where the levers cross, since l1 - l2 = 2 cos(α/2) a, a signed",
    ),
];
