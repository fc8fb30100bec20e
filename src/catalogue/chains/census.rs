//! How many chains there are, and in how many ways their links make grippers.

use crate::chains::Chain;
use crate::chains::enumerate::{ChainsError, visit_chains};
use crate::chains::layout_symmetry::{Input, Symmetry, working_swap};
use crate::chains::roles::Subject;
use std::ops::AddAssign;
use std::sync::{Mutex, PoisonError};

/// Counts over all chains of a number of links, everything up to automorphism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Census {
    /// Chains.
    pub chains: u64,
    /// Choices of a frame.
    pub frames: u64,
    /// Choices of an input joint.
    pub inputs: u64,
    /// Choices of a frame and of a driver joined to it.
    pub drives: u64,
    /// Grippers, where they were asked for.
    pub grippers: Option<Grippers>,
}

/// Counts of choices of frame, driver and jaws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Grippers {
    /// With two jaws.
    pub two_jaws: u64,
    /// Of these, those of which no smaller moving part holds all roles. The rest counts such alone.
    pub essential: u64,
    /// By how many jaws are joined to the frame: none, one, both.
    pub jaws_at_frame: [u64; 3],
    /// Those that make a truss with a part hinged to both jaws.
    pub truss: u64,
    /// Those with an automorphism of order two that keeps frame and driver and swaps the jaws.
    pub symmetric: u64,
    /// Those that move in mirror-symmetric places with a sliding input.
    pub mirror: u64,
    /// Those that move in places symmetric by half a turn with a turning input.
    pub half_turn: u64,
    /// With three jaws, essential or not.
    pub three_jaws: u64,
    /// Of these, the essential ones.
    pub three_essential: u64,
    /// Of the essential ones, those with an automorphism that keeps frame and driver and carries the jaws round.
    pub three_symmetric: u64,
    /// Those that move in places symmetric by a third of a turn with a turning input.
    pub threefold: u64,
}

impl AddAssign for Grippers {
    fn add_assign(&mut self, o: Grippers) {
        self.two_jaws += o.two_jaws;
        self.essential += o.essential;
        let both = self.jaws_at_frame.iter_mut().zip(o.jaws_at_frame);
        both.for_each(|(a, b)| *a += b);
        self.truss += o.truss;
        self.symmetric += o.symmetric;
        self.mirror += o.mirror;
        self.half_turn += o.half_turn;
        self.three_jaws += o.three_jaws;
        self.three_essential += o.three_essential;
        self.three_symmetric += o.three_symmetric;
        self.threefold += o.threefold;
    }
}

impl AddAssign for Census {
    fn add_assign(&mut self, o: Census) {
        self.chains += o.chains;
        self.frames += o.frames;
        self.inputs += o.inputs;
        self.drives += o.drives;
        if let Some(more) = o.grippers {
            *self.grippers.get_or_insert_default() += more;
        }
    }
}

impl Grippers {
    /// Of one chain.
    ///
    /// # Complexity
    /// A step for each choice of roles, and an elimination for each symmetric one.
    #[must_use]
    pub fn of(subject: &Subject<'_>) -> Grippers {
        let mut out = Grippers::default();
        for roles in subject.grippers(2) {
            out.two_jaws += 1;
            if !subject.is_essential(&roles) {
                continue;
            }
            out.essential += 1;
            out.jaws_at_frame[subject.jaws_at_frame(&roles)] += 1;
            out.truss += u64::from(subject.is_truss(&roles));
            if subject.swaps(&roles).next().is_some() {
                out.symmetric += 1;
                let works = |symmetry, input| {
                    u64::from(working_swap(subject, &roles, symmetry, input).is_ok())
                };
                out.mirror += works(Symmetry::Mirror, Input::Slide);
                out.half_turn += works(Symmetry::HalfTurn, Input::Turn);
            }
        }
        for roles in subject.grippers(3) {
            out.three_jaws += 1;
            if !subject.is_essential(&roles) {
                continue;
            }
            out.three_essential += 1;
            if subject.swaps(&roles).next().is_some() {
                out.three_symmetric += 1;
                let swap = working_swap(subject, &roles, Symmetry::Threefold, Input::Turn);
                out.threefold += u64::from(swap.is_ok());
            }
        }
        out
    }
}

impl Census {
    /// Of one chain.
    #[must_use]
    pub fn of(chain: &Chain, grippers: bool) -> Census {
        let (chain, automorphisms) = chain.canonical();
        Census::of_subject(&Subject::new(&chain, &automorphisms), grippers)
    }

    /// Of one chain whose automorphisms are known.
    #[must_use]
    pub fn of_subject(subject: &Subject<'_>, grippers: bool) -> Census {
        Census {
            chains: 1,
            frames: subject.frames().len() as u64,
            inputs: subject.inputs().len() as u64,
            drives: subject.drives().len() as u64,
            grippers: grippers.then(|| Grippers::of(subject)),
        }
    }
}

/// Counts over all chains of so many links and this mobility; grippers are counted of chains with a mobility of 1.
///
/// # Errors
/// As [`visit_chains`].
pub fn census(links: usize, mobility: usize, grippers: bool) -> Result<Census, ChainsError> {
    let all = Mutex::new(Census::default());
    visit_chains(links, mobility, &|chain| {
        let one = Census::of(chain, grippers && mobility == 1);
        *all.lock().unwrap_or_else(PoisonError::into_inner) += one;
    })?;
    Ok(all.into_inner().unwrap_or_else(PoisonError::into_inner))
}
