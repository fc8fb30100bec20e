//! What links of a chain do in a gripper: frame, driver and jaws, each choice once up to the chain's automorphisms.

use crate::chains::Chain;
use itertools::Itertools;
use std::cell::OnceCell;

/// A chain with its automorphisms, and its smaller moving parts.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// Its automorphisms as the images of the links, the identity among them.
    pub automorphisms: &'a [Vec<usize>],
    /// Parts of mobility 1, as bits, without the whole; looked for when grippers are asked about.
    moving_parts: OnceCell<Vec<u32>>,
}

/// Frame, driver and jaws of a gripper.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Roles {
    /// The link that stands still.
    pub frame: usize,
    /// The link that is driven, next to the frame.
    pub driver: usize,
    /// The jaws, in order of their numbers.
    pub jaws: Vec<usize>,
}

/// Where an automorphism takes jaws, in order of their numbers.
#[must_use]
pub(crate) fn jaws_carried(jaws: &[usize], by: &[usize]) -> Vec<usize> {
    jaws.iter().map(|&j| by[j]).sorted_unstable().collect()
}

/// Whether an automorphism carries each jaw to the next and the last to the first, and changes nothing when it is done as often as
/// there are jaws.
#[must_use]
pub(crate) fn carries_round(jaws: &[usize], by: &[usize]) -> bool {
    let next = jaws.iter().cycle().skip(1);
    let back = |l: usize| jaws.iter().fold(l, |l, _| by[l]) == l;
    jaws.iter().zip(next).all(|(&a, &b)| by[a] == b) && (0..by.len()).all(back)
}

impl Roles {
    fn image(&self, by: &[usize]) -> Roles {
        Roles {
            frame: by[self.frame],
            driver: by[self.driver],
            jaws: jaws_carried(&self.jaws, by),
        }
    }

    fn links(&self) -> u32 {
        let all = self.jaws.iter().chain([&self.frame, &self.driver]);
        all.fold(0, |bits, &l| bits | 1 << l)
    }
}

impl<'a> Subject<'a> {
    /// A chain to be looked at.
    #[must_use]
    pub fn new(chain: &'a Chain, automorphisms: &'a [Vec<usize>]) -> Subject<'a> {
        Subject {
            chain,
            automorphisms,
            moving_parts: OnceCell::new(),
        }
    }

    /// One step for each set of links, the first time.
    fn moving_parts(&self) -> &[u32] {
        let moving = |&part: &u32| self.chain.mobility_of(part) == 1 && part.count_ones() > 2;
        self.moving_parts
            .get_or_init(|| (0..self.chain.all()).filter(moving).collect())
    }

    /// How many of some things there are up to automorphism.
    fn up_to_symmetry<T: Ord>(
        &self,
        all: impl IntoIterator<Item = T>,
        image: impl Fn(&T, &[usize]) -> T,
    ) -> Vec<T> {
        let first = |x: &T| self.automorphisms.iter().all(|a| image(x, a) >= *x);
        all.into_iter().filter(first).collect()
    }

    /// Frames.
    #[must_use]
    pub fn frames(&self) -> Vec<usize> {
        self.up_to_symmetry(0..self.chain.links(), |&l, a| a[l])
    }

    /// Input joints, each by its links.
    #[must_use]
    pub fn inputs(&self) -> Vec<(usize, usize)> {
        self.up_to_symmetry(self.chain.joints(), |&(u, v), a| {
            (a[u].min(a[v]), a[u].max(a[v]))
        })
    }

    /// Drives: a frame and a driver joined to it.
    #[must_use]
    pub fn drives(&self) -> Vec<(usize, usize)> {
        let both = |(u, v)| [(u, v), (v, u)];
        let all = self.chain.joints().into_iter().flat_map(both).sorted();
        self.up_to_symmetry(all, |&(r, d), a| (a[r], a[d]))
    }

    /// Grippers of so many jaws. Neither frame nor driver is a jaw.
    ///
    /// # Complexity
    /// One look at each image of each choice.
    #[must_use]
    pub fn grippers(&self, jaws: usize) -> Vec<Roles> {
        let mut out = Vec::new();
        for (frame, driver) in self.drives() {
            // Images that keep frame and driver: of the others the drives are chosen already.
            let keeps = |a: &&Vec<usize>| a[frame] == frame && a[driver] == driver;
            let keeping: Vec<_> = self.automorphisms.iter().filter(keeps).collect();
            let free = (0..self.chain.links()).filter(|&l| l != frame && l != driver);
            let all = free.combinations(jaws).map(|jaws| Roles {
                frame,
                driver,
                jaws,
            });
            out.extend(all.filter(|r| keeping.iter().all(|a| r.image(a) >= *r)));
        }
        out
    }

    /// Whether no smaller moving part holds all roles.
    #[must_use]
    pub fn is_essential(&self, roles: &Roles) -> bool {
        let links = roles.links();
        self.moving_parts().iter().all(|part| part & links != links)
    }

    /// Whether the part, hinged to both jaws, makes a truss of the whole and of nothing less; hinged to three, it is held more
    /// than once.
    #[must_use]
    pub(crate) fn is_truss(&self, roles: &Roles) -> bool {
        let jaws = roles.jaws.iter().fold(0, |bits, &l| bits | 1 << l);
        let &[a, b] = &roles.jaws[..] else {
            return false;
        };
        let both = |part: &u32| part & jaws == jaws;
        !self.chain.joined(a, b) && !self.moving_parts().iter().any(both)
    }

    /// How many of the jaws are joined to the frame; the others float.
    #[must_use]
    pub fn jaws_at_frame(&self, roles: &Roles) -> usize {
        let joined = |&&j: &&usize| self.chain.joined(roles.frame, j);
        roles.jaws.iter().filter(joined).count()
    }

    /// The automorphisms that keep frame and driver, carry each jaw to the next and the last to the first, and change nothing
    /// when they are done as often as there are jaws: those that swap two.
    pub fn swaps<'b>(&'b self, roles: &'b Roles) -> impl Iterator<Item = &'b Vec<usize>> {
        self.automorphisms.iter().filter(move |s| {
            let kept = s[roles.frame] == roles.frame && s[roles.driver] == roles.driver;
            kept && carries_round(&roles.jaws, s)
        })
    }
}
