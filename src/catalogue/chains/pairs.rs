//! Planar chains of hinges, slides, gear pairs and slots, and the grippers that their links make.
//!
//! A [`PairKind`] leaves one freedom (hinge, slide) or two (gear pair or rack; pin in a slot, cam, wedge), so that a chain of
//! n links has the mobility W = 3(n - 1) - 2(R + P) - (G + S). A chain counts where in nearly all places of its joints W is 1
//! in truth and every two links move against each other. Between hinges and pairs of two freedoms a count of every part tells
//! that; with slides the rank decides (loops of slides alone, hinges locked by slides), see [`motion`].
//!
//! Conventions: two links have one pair at most and every link has two or more; no hinge joins three links; a gear pair needs
//! a carrier, a link that is hinged to both gears, or to the pinion and slides on the rack. The input is a hinge or a slide,
//! at the frame or between two moving links; a jaw is never the frame, and *driven* where it is a link of the input joint.

pub mod census;
pub mod chain;
pub mod classics;
pub mod motion;
pub mod roles;
pub mod sharing;
pub mod structure;
pub mod symmetric_census;

/// A pair of links in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PairKind {
    /// They turn about a pin.
    Hinge = 1,
    /// One slides along the other.
    Slide,
    /// Teeth: two gears, or a rack and its pinion. They roll, and their centres do not keep their distance by it.
    Gear,
    /// A pin in a slot, a cam and its follower, a wedge: they touch along a line of action.
    Slot,
    /// Two pins in two slots: they turn about where the lines of action meet, as about a hinge that goes elsewhere as they move.
    TwoSlots,
}

impl PairKind {
    /// Every kind with the word and the letter it has in codes.
    pub const ALL: [(PairKind, &'static str, char); 5] = [
        (PairKind::Hinge, "hinge", 'R'),
        (PairKind::Slide, "slide", 'P'),
        (PairKind::Gear, "gear", 'G'),
        (PairKind::Slot, "slot", 'S'),
        (PairKind::TwoSlots, "two-slots", 'D'),
    ];

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        PairKind::ALL[self as usize - 1].1
    }

    /// Its letter in codes.
    #[must_use]
    pub fn letter(self) -> char {
        PairKind::ALL[self as usize - 1].2
    }

    /// The kind of a weight of a graph's edge, where there is an edge.
    #[must_use]
    pub(crate) fn of_weight(weight: u8) -> Option<PairKind> {
        let at = usize::from(weight).checked_sub(1)?;
        PairKind::ALL.get(at).map(|kind| kind.0)
    }

    /// Whether it is a hinge or a slide, which may be driven or carry gears.
    #[must_use]
    pub(crate) fn is_lower(self) -> bool {
        matches!(self, PairKind::Hinge | PairKind::Slide)
    }

    /// Whether it leaves two freedoms; the others leave one.
    #[must_use]
    pub(crate) fn leaves_two(self) -> bool {
        matches!(self, PairKind::Gear | PairKind::Slot)
    }
}
