//! Which pins of a layout are free to be placed, and which follow from them.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::synthesis::place::{Place, third};
use crate::synthesis::structure::{Ring, Structure};

/// Where a pin is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// Where it likes.
    Free,
    /// On the line of the mirror, or of the slide.
    OnLine,
    /// At the centre of half a turn, or of a third.
    Centre,
    /// What another pin becomes when the symmetry is done so often.
    Image {
        /// The other.
        of: usize,
        /// How often: once or twice.
        times: u8,
    },
    /// The fourth corner of a parallelogram: from the first pin to the second as from the third to this one.
    Parallelogram([usize; 3]),
}

/// The pins of a structure, each with its rule.
#[derive(Debug, Clone)]
pub struct Rules {
    /// The links of each pin, in the order of the chain's joints; the input joint is one of them.
    pub pins: Vec<(usize, usize)>,
    /// Their rules.
    pub rules: Vec<Rule>,
    /// Pins in an order in which each comes after those that it follows from.
    order: Vec<usize>,
    symmetry: Symmetry,
    /// The input joint.
    pub input: usize,
}

impl Rules {
    /// The rules of a structure whose symmetry is `swap`; `None` where the parallelograms ask for what cannot be.
    #[must_use]
    pub fn new(structure: &Structure, swap: &[usize]) -> Option<Rules> {
        let pins = structure.chain.joints();
        let symmetry = structure.form.symmetry;
        let at = |u: usize, v: usize| pins.iter().position(|&p| p == (u.min(v), u.max(v)));
        let mut rules = vec![Rule::Free; pins.len()];
        for first in 0..pins.len() {
            // Images of a pin before.
            if rules[first] != Rule::Free {
                continue;
            }
            let (mut of, mut times) = (first, 0);
            loop {
                let (u, v) = pins[of];
                (of, times) = (at(swap[u], swap[v])?, times + 1);
                if of == first {
                    break;
                }
                rules[of] = Rule::Image { of: first, times };
            }
            rules[first] = match symmetry {
                Symmetry::Mirror if times == 1 => Rule::OnLine,
                Symmetry::HalfTurn | Symmetry::Threefold if times == 1 => Rule::Centre,
                _ => Rule::Free,
            };
        }
        let input = at(structure.roles.frame, structure.roles.driver)?;
        if structure.form.input == Input::Slide {
            rules[input] = Rule::OnLine;
        }
        if structure.form.parallel {
            let corners = |r: Ring| {
                let [p, q] = r.rods;
                Some([at(p, r.base)?, at(q, r.base)?, at(p, r.jaw)?, at(q, r.jaw)?])
            };
            for ring in structure.rings()? {
                let [a, b, c, d] = corners(ring)?;
                // Any corner can be the one that follows; of a ring that is an image all do already.
                let corners = [[a, b, c, d], [b, a, d, c], [c, d, a, b], [d, c, b, a]];
                let free = corners.iter().find(|k| rules[k[3]] == Rule::Free);
                let image = |i: usize| matches!(rules[i], Rule::Image { .. });
                match free {
                    Some(&[a, b, c, d]) => rules[d] = Rule::Parallelogram([a, b, c]),
                    None if [a, b, c, d].into_iter().any(image)
                        && symmetry != Symmetry::Generic => {}
                    None => return None,
                }
            }
        }
        let order = in_order(&rules)?;
        Some(Rules {
            pins,
            rules,
            order,
            symmetry,
            input,
        })
    }

    /// The pins of a structure without any rule, for places that are known already.
    #[must_use]
    pub fn free(structure: &Structure) -> Option<Rules> {
        let pins = structure.chain.joints();
        let (frame, driver) = (structure.roles.frame, structure.roles.driver);
        let input = (frame.min(driver), frame.max(driver));
        Some(Rules {
            rules: vec![Rule::Free; pins.len()],
            order: (0..pins.len()).collect(),
            symmetry: Symmetry::Generic,
            input: pins.iter().position(|&p| p == input)?,
            pins,
        })
    }

    /// Puts what follows in its place.
    pub fn settle(&self, at: &mut [[f64; 2]]) {
        for &i in &self.order {
            at[i] = match self.rules[i] {
                Rule::Free => at[i],
                Rule::OnLine => [at[i][0], 0.0],
                Rule::Centre => [0.0, 0.0],
                Rule::Image { of, times } => (0..times).fold(at[of], |p, _| self.image(p)),
                Rule::Parallelogram([a, b, c]) => [0, 1].map(|k| at[b][k] + at[c][k] - at[a][k]),
            };
        }
    }

    /// The image of a place.
    #[must_use]
    pub fn image(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self.symmetry {
            Symmetry::Generic => [x, y],
            Symmetry::Mirror => [x, -y],
            Symmetry::HalfTurn => [-x, -y],
            Symmetry::Threefold => third([x, y]),
        }
    }

    /// Places of whole millimetres as what they are exactly.
    #[must_use]
    pub fn places(&self, at: &[[f64; 2]]) -> Vec<Place> {
        #[allow(clippy::cast_possible_truncation, reason = "whole and small")]
        let whole = |i: usize| at[i].map(|x| x.round() as i32);
        let place = |(i, rule): (usize, &Rule)| match (rule, self.symmetry) {
            (&Rule::Image { of, times }, Symmetry::Threefold) => Place {
                whole: whole(of),
                thirds: times,
                ..Place::default()
            },
            _ => Place::from(whole(i)),
        };
        self.rules.iter().enumerate().map(place).collect()
    }

    /// Whether a pin is where others have it.
    #[must_use]
    pub fn follows(&self, pin: usize) -> bool {
        self.rules[pin] != Rule::Free
    }

    /// The pins that may be moved.
    pub(crate) fn movable(&self) -> impl Iterator<Item = usize> + '_ {
        let free = |i: &usize| matches!(self.rules[*i], Rule::Free | Rule::OnLine);
        (0..self.pins.len()).filter(free)
    }

    /// The pairs of joints that are images of each other.
    pub fn images(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let pair = |(i, r): (usize, &Rule)| match r {
            Rule::Image { of, .. } => Some((*of, i)),
            _ => None,
        };
        self.rules.iter().enumerate().filter_map(pair)
    }
}

/// Every pin after those it follows from; `None` where they follow from each other.
fn in_order(rules: &[Rule]) -> Option<Vec<usize>> {
    let mut order: Vec<usize> = Vec::new();
    while order.len() < rules.len() {
        let done = |i: &usize| order.contains(i);
        let ready = |&i: &usize| {
            !done(&i)
                && match rules[i] {
                    Rule::Image { of, .. } => done(&of),
                    Rule::Parallelogram(of) => of.iter().all(done),
                    Rule::Free | Rule::OnLine | Rule::Centre => true,
                }
        };
        let next = (0..rules.len()).find(ready)?;
        order.push(next);
    }
    Some(order)
}
