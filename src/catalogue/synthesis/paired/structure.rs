//! Structures of pairs with the symmetry they are to have.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::pairs::chain::carried;
use crate::chains::pairs::kind::PairKind;
use crate::chains::pairs::motion::{Image, Swap, symmetric_ways};
use crate::chains::pairs::sharing::Menu;
use crate::chains::pairs::structure::PairStructure;
use crate::chains::pairs::symmetric_census::symmetric_grippers;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// A gripper of pairs without places.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairedStructure {
    /// Chain and roles, in canonical numbering.
    pub structure: PairStructure,
    /// Mirror image or half turn.
    pub symmetry: Symmetry,
}

/// How a symmetric structure may lie on itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lay {
    /// Where the symmetry carries each link.
    pub swap: Vec<usize>,
    /// A bit for each slide and slot that is its own mirror image, as [`crate::chains::pairs::motion::SymmetricWay`] has them.
    pub bits: u32,
}

impl PairedStructure {
    /// The name that says all of it.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{} {}", self.structure.name(), self.symmetry.name())
    }

    /// A short name that a shell takes as it is: the number of links, and the beginning of the SHA-256 of the whole name.
    #[must_use]
    pub fn id(&self) -> String {
        let mut id = format!("{}-", self.structure.chain.links());
        for byte in &Sha256::digest(self.name())[..6] {
            // Writing to a string does not fail.
            let _ = write!(id, "{byte:02x}");
        }
        id
    }

    /// How it is driven.
    #[must_use]
    pub fn input(&self) -> Input {
        if self.structure.slides() {
            Input::Slide
        } else {
            Input::Turn
        }
    }

    /// The link against which the driver moves, the frame where it is one of the two, and the driver.
    #[must_use]
    pub fn drive(&self) -> [usize; 2] {
        let [u, v] = self.structure.roles.input;
        if v == self.structure.roles.frame {
            [v, u]
        } else {
            [u, v]
        }
    }

    /// The ways it may lie on itself in which it moves as a gripper.
    ///
    /// # Complexity
    /// An elimination for each way of each automorphism.
    #[must_use]
    pub fn lays(&self) -> Vec<Lay> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [a, b] = roles.jaws;
        let image = match self.symmetry {
            Symmetry::HalfTurn => Image::HalfTurn,
            _ => Image::Mirror,
        };
        let involutions = chain.automorphisms().into_iter().filter(|s| {
            let back = (0..s.len()).all(|l| s[s[l]] == l);
            let keeps = s[roles.frame] == roles.frame && carried(roles.input, s) == roles.input;
            back && keeps && s[a] == b
        });
        let mut out = Vec::new();
        for swap in involutions {
            let symmetry = Swap {
                links: &swap,
                image,
            };
            let ways = symmetric_ways(chain, symmetry, roles.frame);
            let moving = ways.into_iter().filter(|w| roles.moves_in(&w.motion));
            out.extend(moving.map(|w| Lay {
                swap: swap.clone(),
                bits: w.bits,
            }));
        }
        out
    }
}

/// The structures of so many links that have such pairs, symmetric ones of the symmetries that are asked for; those of hinges and
/// a driver that slides in the frame are left out, since they are laid out as hinged ones.
///
/// # Complexity
/// As [`symmetric_grippers`].
#[must_use]
pub fn paired_structures(links: usize, menu: Menu<'_>) -> Vec<PairedStructure> {
    let all = symmetric_grippers(links, menu).into_iter();
    let paired = all.map(|g| PairedStructure {
        structure: g.structure,
        symmetry: if g.kind.half_turn {
            Symmetry::HalfTurn
        } else {
            Symmetry::Mirror
        },
    });
    paired.filter(|p| !p.is_hinged()).collect()
}

impl PairedStructure {
    /// Whether all joints are hinges but for a driver that slides in the frame.
    fn is_hinged(&self) -> bool {
        let roles = &self.structure.roles;
        let others = self.structure.chain.joints().into_iter();
        let mut others = others.filter(|j| j.pair != PairKind::Hinge);
        let apart = roles.is_driven_from_frame() && !roles.has_driven_jaw();
        apart && others.all(|j| j.links == roles.input)
    }
}
