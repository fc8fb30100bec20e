//! What joins two links in the plane.

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
}

impl PairKind {
    /// Every kind with the word and the letter it has in codes.
    pub const ALL: [(PairKind, &'static str, char); 4] = [
        (PairKind::Hinge, "hinge", 'R'),
        (PairKind::Slide, "slide", 'P'),
        (PairKind::Gear, "gear", 'G'),
        (PairKind::Slot, "slot", 'S'),
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

    /// Whether it leaves one freedom; the others leave two.
    #[must_use]
    pub(crate) fn is_lower(self) -> bool {
        matches!(self, PairKind::Hinge | PairKind::Slide)
    }
}
