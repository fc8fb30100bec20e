//! Structures: a chain, what its links do in a gripper, how its driver moves, and the symmetry it is to have.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::roles::{Roles, Subject};
use crate::chains::{Chain, graph6};
use crate::synthesis::place::Place;
use crate::synthesis::task;
use crate::synthesis::task::Task;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// How a structure is to be laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Form {
    /// How its driver moves.
    pub input: Input,
    /// How it lies on itself.
    pub symmetry: Symmetry,
    /// Whether each jaw stands on a parallelogram with the frame or a sliding driver, so that it does not turn.
    pub parallel: bool,
}

impl Form {
    /// Every form that there is, in order.
    pub fn all() -> impl Iterator<Item = Form> {
        let inputs = Input::ALL.into_iter().map(|(i, _)| i);
        inputs
            .flat_map(|input| Symmetry::ALL.map(move |(symmetry, _)| (input, symmetry)))
            .flat_map(|(input, symmetry)| {
                [false, true].map(|parallel| Form {
                    input,
                    symmetry,
                    parallel,
                })
            })
            .filter(|f| f.symmetry.suits(f.input))
    }

    /// Whether a gripper of so many jaws can have it: three stand on no parallelograms.
    #[must_use]
    pub fn suits(self, jaws: usize) -> bool {
        suits(self.symmetry, self.parallel, jaws)
    }

    /// The form in words: "slide mirror parallel".
    #[must_use]
    pub fn name(self) -> String {
        let parallel = if self.parallel { " parallel" } else { "" };
        format!("{} {}{parallel}", self.input.name(), self.symmetry.name())
    }
}

/// A short name that a shell takes as it is: the number of links, and the beginning of the SHA-256 of the whole name.
pub(super) fn short_id(links: usize, name: &str) -> String {
    let mut id = format!("{links}-");
    for byte in &Sha256::digest(name)[..6] {
        // Writing to a string does not fail.
        let _ = write!(id, "{byte:02x}");
    }
    id
}

/// Whether grippers of so many jaws are laid out so in a plane, on parallelograms or not. Three jaws stand on none: that takes many
/// links.
#[must_use]
pub(crate) fn suits(symmetry: Symmetry, parallel: bool, jaws: usize) -> bool {
    symmetry.jaws().is_none_or(|n| n == jaws) && (jaws == 2 || !parallel)
}

/// A gripper without places.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Structure {
    /// Its chain, in canonical numbering.
    pub chain: Chain,
    /// What the links do, by their canonical numbers.
    pub roles: Roles,
    /// How it is laid out.
    pub form: Form,
}

impl Structure {
    /// The name that says all of it: "E`ow 0-3 1,4 slide mirror" is the chain, frame and driver, jaws, and the form.
    #[must_use]
    pub fn name(&self) -> String {
        let r = &self.roles;
        let jaws: Vec<String> = r.jaws.iter().map(ToString::to_string).collect();
        format!(
            "{} {}-{} {} {}",
            graph6::write(&self.chain),
            r.frame,
            r.driver,
            jaws.join(","),
            self.form.name()
        )
    }

    /// A short name that a shell takes as it is: the number of links, and the beginning of the SHA-256 of the whole name.
    #[must_use]
    pub fn id(&self) -> String {
        short_id(self.chain.links(), &self.name())
    }
}

/// The essential grippers of so many jaws of a chain that a form can be asked of: for a symmetric one those whose graph is
/// symmetric, for a parallel one those whose jaws stand on rings of four links with the frame or a sliding driver.
///
/// # Complexity
/// A step for each choice of roles and each form.
#[must_use]
pub fn structures(subject: &Subject<'_>, jaws: usize, forms: &[Form]) -> Vec<Structure> {
    let mut out = Vec::new();
    let forms: Vec<Form> = forms.iter().copied().filter(|f| f.suits(jaws)).collect();
    let generic = forms.iter().any(|f| f.symmetry == Symmetry::Generic);
    // Nothing carries the jaws of a chain without symmetries to each other.
    if !generic && subject.automorphisms.len() == 1 {
        return out;
    }
    for roles in subject.grippers(jaws) {
        let symmetric = subject.swaps(&roles).next().is_some();
        if !(generic || symmetric) || !subject.is_essential(&roles) {
            continue;
        }
        let asked = |f: &&Form| symmetric || f.symmetry == Symmetry::Generic;
        for &form in forms.iter().filter(asked) {
            let structure = Structure {
                chain: subject.chain.clone(),
                roles: roles.clone(),
                form,
            };
            if !form.parallel || structure.rings().is_some() {
                out.push(structure);
            }
        }
    }
    out
}

/// A ring of four links on which a jaw stands: two rods, both joined to the base and to the jaw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ring {
    /// The frame, or a driver that slides.
    pub base: usize,
    /// The rods.
    pub rods: [usize; 2],
    /// The jaw.
    pub jaw: usize,
}

impl Structure {
    /// Where the tips of the jaws are drawn for a task, in millimetres.
    #[must_use]
    pub fn tips(&self, task: &Task) -> Vec<Place> {
        task::draw_tips(self.roles.jaws.len(), self.form.symmetry, task)
    }

    /// A ring for each jaw, or `None` where one has none. The first by numbers, base before rods.
    #[must_use]
    pub fn rings(&self) -> Option<Vec<Ring>> {
        let (c, r) = (&self.chain, &self.roles);
        let ring = |jaw: usize| {
            let sliding = (self.form.input == Input::Slide).then_some(r.driver);
            std::iter::once(r.frame).chain(sliding).find_map(|base| {
                // The joint of frame and driver is no pin where the driver slides.
                let rod = |l: &usize| {
                    let input =
                        [base, *l] == [r.frame, r.driver] || [*l, base] == [r.frame, r.driver];
                    let slides = input && self.form.input == Input::Slide;
                    c.joined(*l, jaw) && c.joined(*l, base) && !slides && !r.jaws.contains(l)
                };
                let mut rods = (0..c.links()).filter(rod);
                let rods = [rods.next()?, rods.next()?];
                Some(Ring { base, rods, jaw })
            })
        };
        r.jaws.iter().map(|&jaw| ring(jaw)).collect()
    }
}
