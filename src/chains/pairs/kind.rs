//! What joins two links in the plane.

/// A pair of links in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Pair {
    /// They turn about a pin.
    Hinge = 1,
    /// One slides along the other.
    Slide,
    /// Teeth: two gears, or a rack and its pinion. They roll, and their centres do not keep their distance by it.
    Gear,
    /// A pin in a slot, a cam and its follower, a wedge: they touch along a line of action.
    Slot,
}

impl Pair {
    /// Every kind with the word and the letter it has in codes.
    pub const ALL: [(Pair, &'static str, char); 4] = [
        (Pair::Hinge, "hinge", 'R'),
        (Pair::Slide, "slide", 'P'),
        (Pair::Gear, "gear", 'G'),
        (Pair::Slot, "slot", 'S'),
    ];

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Pair::ALL[self as usize - 1].1
    }

    /// Its letter in codes.
    #[must_use]
    pub fn letter(self) -> char {
        Pair::ALL[self as usize - 1].2
    }

    /// The kind of a weight of a graph's edge, where there is an edge.
    #[must_use]
    pub fn of_weight(weight: u8) -> Option<Pair> {
        let at = usize::from(weight).checked_sub(1)?;
        Pair::ALL.get(at).map(|kind| kind.0)
    }

    /// Whether it leaves one freedom; the others leave two.
    #[must_use]
    pub fn is_lower(self) -> bool {
        matches!(self, Pair::Hinge | Pair::Slide)
    }
}
