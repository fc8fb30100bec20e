//! Frame, input joint and jaws of a gripper: every choice among the links of a chain, once up to the chain's automorphisms.

use crate::chains::chain::{Chain, Joint, carry_links};
use crate::chains::motion::{Swap, Velocity, single_motion, symmetric_motions};
use crate::chains::{PairKind, Symmetry};
use itertools::Itertools;
use std::cell::OnceCell;

/// Frame, input joint and jaws of a gripper.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Roles {
    /// The link that stands still.
    pub frame: usize,
    /// The links of the driven joint, the lesser first.
    pub input: [usize; 2],
    /// The jaws, two or three, in order of their numbers.
    pub jaws: Vec<usize>,
}

/// Returns the images of jaws under an automorphism, in order of their numbers.
fn jaws_carried(jaws: &[usize], by: &[usize]) -> Vec<usize> {
    jaws.iter().map(|&j| by[j]).sorted_unstable().collect()
}

/// Returns whether an automorphism carries each jaw to the next, and carries every link back after as many steps as there are jaws.
pub(crate) fn carries_round(jaws: &[usize], by: &[usize]) -> bool {
    let next = jaws.iter().cycle().skip(1);
    let back = |l: usize| jaws.iter().fold(l, |l, _| by[l]) == l;
    jaws.iter().zip(next).all(|(&a, &b)| by[a] == b) && (0..by.len()).all(back)
}

impl Roles {
    /// Returns the images of the roles under an automorphism.
    #[must_use]
    pub fn image_under(&self, by: &[usize]) -> Roles {
        Roles {
            frame: by[self.frame],
            input: carry_links(self.input, by),
            jaws: jaws_carried(&self.jaws, by),
        }
    }

    /// Returns whether the frame is a link of the input joint.
    #[must_use]
    pub fn is_driven_from_frame(&self) -> bool {
        self.input.contains(&self.frame)
    }

    /// Returns the link against which the driver moves, then the driver. If the frame is one of the two, it comes first.
    #[must_use]
    pub fn drive_links(&self) -> [usize; 2] {
        let [u, v] = self.input;
        if v == self.frame { [v, u] } else { [u, v] }
    }

    /// Returns whether a jaw is a link of the input joint.
    #[must_use]
    pub fn has_driven_jaw(&self) -> bool {
        self.jaws.iter().any(|j| self.input.contains(j))
    }

    /// Returns whether the input and the jaws move in a motion, and the jaws also move against each other.
    #[must_use]
    pub(crate) fn moves_in(&self, motion: &[Velocity]) -> bool {
        let apart = self.jaws.iter().chain([&self.frame]);
        let [u, v] = self.input;
        apart.map(|&l| motion[l]).all_unique() && motion[u] != motion[v]
    }

    fn role_links(&self) -> usize {
        let all = self.input.iter().chain(&self.jaws).chain([&self.frame]);
        all.fold(0, |bits, &l| bits | 1 << l)
    }
}

/// How a gripper is symmetric.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Symmetries {
    /// Whether an automorphism of order two keeps the frame and the input joint and swaps the jaws.
    pub graph: bool,
    /// Whether it moves symmetrically in places that mirror each other.
    pub mirror: bool,
    /// The same without the demand on the input joint.
    pub mirror_but_input: bool,
    /// Whether it moves symmetrically in places that half a turn carries to each other.
    pub half_turn: bool,
    /// The same without the demand on the input joint.
    pub half_turn_but_input: bool,
}

/// An automorphism of order two, with the motions that are their own images.
#[derive(Debug, Clone)]
struct Involution<'a> {
    links: &'a [usize],
    mirror: Vec<Vec<Velocity>>,
    half_turn: Vec<Vec<Velocity>>,
}

/// A chain with its automorphisms, and with properties that are computed once.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// Its automorphisms as the images of the links, the identity among them.
    pub automorphisms: Vec<&'a Vec<usize>>,
    joints: Vec<Joint>,
    moving_parts: OnceCell<Vec<usize>>,
    motion: OnceCell<Vec<Velocity>>,
    involutions: OnceCell<Vec<Involution<'a>>>,
}

impl<'a> Subject<'a> {
    /// Returns the chain with its automorphisms, ready to be analysed.
    #[must_use]
    pub fn new(
        chain: &'a Chain,
        automorphisms: impl IntoIterator<Item = &'a Vec<usize>>,
    ) -> Subject<'a> {
        Subject {
            chain,
            automorphisms: automorphisms.into_iter().collect(),
            joints: chain.joints(),
            moving_parts: OnceCell::new(),
            motion: OnceCell::new(),
            involutions: OnceCell::new(),
        }
    }

    /// Returns the parts of mobility 1 that have more than two links, without the whole chain. Counting is enough: the rows of a
    /// chain are independent, and so are the rows of its parts.
    fn moving_parts(&self) -> &[usize] {
        self.moving_parts.get_or_init(|| {
            let mobilities = self.chain.part_mobilities();
            let part = |p: &(usize, &i16)| *p.1 == 1;
            let parts = mobilities.iter().enumerate().filter(part).map(|p| p.0);
            let all = mobilities.len() - 1;
            let small = |&p: &usize| p != all && p.count_ones() > 2;
            parts.filter(small).collect()
        })
    }

    fn is_first<T: Ord>(&self, x: &T, image: impl Fn(&T, &[usize]) -> T) -> bool {
        self.automorphisms.iter().all(|a| image(x, a) >= *x)
    }

    /// Returns the number of choices of a frame.
    ///
    /// # Examples
    /// ```
    /// use ozols::chains::{enumerate::list_chains, roles::Subject};
    /// let mut frames = Vec::new();
    /// for chain in list_chains(6, 1)? {
    ///     frames.push(Subject::new(&chain, &chain.automorphisms()).count_frames());
    /// }
    /// frames.sort();
    /// assert_eq!(frames, [2, 3]); // Watt's chain makes two mechanisms and Stephenson's three.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn count_frames(&self) -> usize {
        let all = 0..self.chain.links();
        all.filter(|l| self.is_first(l, |&l, a| a[l])).count()
    }

    /// Returns the joints that may be driven: hinges and slides.
    pub fn iter_inputs(&self) -> impl Iterator<Item = &Joint> {
        let lower = self.joints.iter().filter(|j| j.pair.is_lower());
        lower.filter(|j| self.is_first(&j.links, |&links, a| carry_links(links, a)))
    }

    /// Returns the choices of a frame and an input joint, a hinge or a slide.
    #[must_use]
    pub fn list_drives(&self) -> Vec<(usize, Joint)> {
        let lower = self.joints.iter().filter(|j| j.pair.is_lower());
        let all = lower.cartesian_product(0..self.chain.links());
        let first = |&(j, frame): &(&Joint, usize)| {
            self.is_first(&(frame, j.links), |&(f, links), a| {
                (a[f], carry_links(links, a))
            })
        };
        all.filter(first).map(|(j, frame)| (frame, *j)).collect()
    }

    /// Returns every choice of N jaws for a frame and an input joint.
    #[must_use]
    pub fn list_grippers(&self, frame: usize, input: &Joint, jaws: usize) -> Vec<Roles> {
        let keeps =
            |a: &&&Vec<usize>| a[frame] == frame && carry_links(input.links, a) == input.links;
        let keeping: Vec<_> = self.automorphisms.iter().filter(keeps).collect();
        let others = (0..self.chain.links()).filter(|&l| l != frame);
        let all = others.combinations(jaws).map(|jaws| Roles {
            frame,
            input: input.links,
            jaws,
        });
        all.filter(|r| keeping.iter().all(|a| r.image_under(a) >= *r))
            .collect()
    }

    /// Returns the grippers that are driven from the frame, by a link other than a jaw.
    pub fn grippers_apart(&self, jaws: usize) -> impl Iterator<Item = Roles> {
        let drives = self
            .list_drives()
            .into_iter()
            .sorted_by_key(|(frame, input)| (*frame, input.links));
        let drives = drives.filter(|(frame, input)| input.is_at(*frame));
        let all = drives.flat_map(move |(frame, input)| self.list_grippers(frame, &input, jaws));
        all.filter(|r| !r.has_driven_jaw())
    }

    /// Returns every choice of roles that an involution keeps: frame and input joint are their own images, and the jaws change places.
    #[must_use]
    pub(crate) fn symmetric_roles(&self, swap: &[usize]) -> Vec<Roles> {
        let n = swap.len();
        let own = |j: &&Joint| j.pair.is_lower() && carry_links(j.links, swap) == j.links;
        let inputs = self.joints.iter().filter(own);
        let frames = (0..n).filter(|&l| swap[l] == l);
        let jaws = (0..n).filter(|&l| l < swap[l]);
        let jaws = jaws.map(|l| vec![l, swap[l]]);
        let all = inputs.cartesian_product(frames).cartesian_product(jaws);
        let roles = all.map(|((input, frame), jaws)| Roles {
            frame,
            input: input.links,
            jaws,
        });
        roles
            .filter(|r| self.is_first(r, Roles::image_under))
            .collect()
    }

    /// Returns the smaller moving parts that hold all roles, as bits.
    pub(super) fn moving_parts_with(&self, roles: &Roles) -> impl Iterator<Item = usize> {
        let links = roles.role_links();
        let parts = self.moving_parts().iter().copied();
        parts.filter(move |part| part & links == links)
    }

    /// Returns whether no smaller moving part holds all roles.
    #[must_use]
    pub fn is_essential(&self, roles: &Roles) -> bool {
        self.moving_parts_with(roles).next().is_none()
    }

    /// Returns whether all jaws keep their attitude in nearly all places.
    #[must_use]
    pub fn is_translating(&self, roles: &Roles) -> bool {
        let motion = self
            .motion
            .get_or_init(|| single_motion(self.chain).expect("a chain has one motion"));
        let turning = |link: usize| motion[link][0];
        roles
            .jaws
            .iter()
            .all(|&j| turning(j) == turning(roles.frame))
    }

    /// Returns whether there is an automorphism that keeps frame and input joint and carries each jaw to the next: one of
    /// [`Subject::swaps`].
    #[must_use]
    pub fn is_graph_symmetric(&self, roles: &Roles) -> bool {
        self.iter_swaps(roles).next().is_some()
    }

    /// Returns the automorphisms that keep frame and input joint, carry each jaw to the next, and carry every link back after as many
    /// steps as there are jaws.
    pub fn iter_swaps<'b>(&'b self, roles: &'b Roles) -> impl Iterator<Item = &'b Vec<usize>> {
        let all = self.automorphisms.iter().copied();
        all.filter(|s| {
            let kept = s[roles.frame] == roles.frame && carry_links(roles.input, s) == roles.input;
            kept && carries_round(&roles.jaws, s)
        })
    }

    /// Returns the number of jaws that are joined to the frame.
    #[must_use]
    pub fn jaws_at_frame(&self, roles: &Roles) -> usize {
        let joined = |&&j: &&usize| self.chain.is_joined(roles.frame, j);
        roles.jaws.iter().filter(joined).count()
    }

    /// Returns whether a part hinged to both jaws makes a truss with them: nothing moves any more, and no smaller part is rigid.
    #[must_use]
    pub fn is_truss(&self, roles: &Roles) -> bool {
        let &[a, b] = &roles.jaws[..] else {
            return false;
        };
        let both = |part: &usize| part >> a & part >> b & 1 == 1;
        !self.chain.is_joined(a, b) && !self.moving_parts().iter().any(both)
    }

    /// Returns the symmetries of a gripper of two jaws. A gripper of three jaws has none of these.
    #[must_use]
    pub fn find_symmetries(&self, roles: &Roles) -> Symmetries {
        let mut out = Symmetries::default();
        let &[a, b] = &roles.jaws[..] else {
            return out;
        };
        for s in self.find_involutions() {
            if s.links[roles.frame] != roles.frame || s.links[a] != b {
                continue;
            }
            let keeps_input = carry_links(roles.input, s.links) == roles.input;
            let works = |motions: &[Vec<Velocity>]| motions.iter().any(|m| roles.moves_in(m));
            let (mirror, half_turn) = (works(&s.mirror), works(&s.half_turn));
            out.graph |= keeps_input;
            out.mirror |= mirror && keeps_input;
            out.mirror_but_input |= mirror;
            out.half_turn |= half_turn && keeps_input;
            out.half_turn_but_input |= half_turn;
        }
        out
    }

    /// Returns the automorphisms of order two that keep at least one link.
    fn find_involutions(&self) -> &[Involution<'a>] {
        self.involutions.get_or_init(|| {
            let twice = |s: &&&Vec<usize>| {
                let back = (0..s.len()).all(|l| s[s[l]] == l);
                back && (0..s.len()).any(|l| s[l] != l)
            };
            let of = |s: &&'a Vec<usize>| {
                let frame = s.iter().enumerate().position(|(l, &to)| l == to)?;
                let motions = |image| {
                    let links = s.as_slice();
                    symmetric_motions(self.chain, Swap { links, image }, frame)
                };
                Some(Involution {
                    links: s,
                    mirror: motions(Symmetry::Mirror),
                    half_turn: motions(Symmetry::HalfTurn),
                })
            };
            self.automorphisms
                .iter()
                .filter(twice)
                .filter_map(of)
                .collect()
        })
    }

    /// Returns the number of pairs other than hinges. Pairs that `swap` carries to each other count as one.
    #[must_use]
    pub(crate) fn other_pairs_up_to(&self, swap: &[usize]) -> usize {
        let others = self.joints.iter().filter(|j| j.pair != PairKind::Hinge);
        let first = |j: &&Joint| carry_links(j.links, swap) >= j.links;
        others.filter(first).count()
    }
}
