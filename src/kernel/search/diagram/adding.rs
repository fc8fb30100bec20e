//! What happens in each layer of a diagram in the space dual to self-stresses.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::choice_inclusion::{Grown, one_from_another};
use crate::search::diagram::stage::Collapse;
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use std::ops::Range;

/// A variable of the diagram in the space dual to self-stresses.
#[derive(Debug, Clone)]
pub(in crate::search) struct Adding {
    /// Index of the variable in the space.
    pub(in crate::search) variable: usize,
    /// Its choices, one grown from another.
    pub(in crate::search) growth: Vec<Grown>,
    /// The coordinates of contours in use, by their numbers; those of kept links come after these.
    pub(in crate::search) contours: Vec<usize>,
    /// Coordinates of both.
    pub(in crate::search) width: usize,
    /// Where each coordinate that there was before the stage stands among these; at the others nothing was added yet.
    pub(in crate::search) places: Vec<usize>,
    /// The first of them, which no variable after this one reaches.
    pub(in crate::search) gap: usize,
    /// Simplification of motions of kept links that no variable after this one reaches.
    pub(in crate::search) folding: Option<Folding>,
}

/// Folds away how kept links go wrong.
#[derive(Debug, Clone)]
pub(in crate::search) struct Folding {
    pub(in crate::search) collapse: Collapse,
    /// Coordinates in which nothing is left then: so many ways to go wrong there cannot be.
    pub(in crate::search) dropped: Range<usize>,
}

/// Which coordinates of kept links stages have; of contours, those that variables up to a stage and from it on reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::search) enum Kept {
    /// Those that such variables reach.
    Live,
    /// All, so that motions that go wrong need not be folded away.
    All,
}

/// The coordinates of a stage: those of contours, those that tell which motions of kept links went wrong, and those of kept links.
struct StageCoordinates {
    /// The numbers of those of contours and of kept links, which there were before the stage, and which are in use.
    before: [Vec<usize>; 2],
    at: [Vec<usize>; 2],
    wrong: Range<usize>,
}

impl StageCoordinates {
    fn new(lifetimes: &[Vec<Lifetime>; 2], stage: usize, wrong: usize) -> StageCoordinates {
        let of = |live: fn(Lifetime, usize) -> bool| {
            lifetimes.each_ref().map(|all| -> Vec<usize> {
                let live = all.iter().enumerate().filter(|(_, l)| live(**l, stage));
                live.map(|(number, _)| number).collect()
            })
        };
        let at = of(Lifetime::is_live_at);
        StageCoordinates {
            before: of(Lifetime::is_live_before),
            wrong: at[0].len()..at[0].len() + wrong,
            at,
        }
    }

    fn width(&self) -> usize {
        self.wrong.end + self.at[1].len()
    }

    /// Where the coordinates before the stage stand.
    fn places(&self) -> Vec<usize> {
        let place = |of: usize, number| self.at[of].binary_search(number).expect("in use still");
        let [contours, kept] = &self.before;
        let kept = kept.iter().map(|number| self.wrong.end + place(1, number));
        let contours = contours.iter().map(|number| place(0, number));
        contours.chain(self.wrong.clone()).chain(kept).collect()
    }

    /// A vector, of which the numbers of contours come before those of kept links.
    fn row(&self, contours: &[Residue], kept: &[Residue]) -> Vec<Residue> {
        let [at, links] = &self.at;
        let wrong = std::iter::repeat_n(0, self.wrong.len());
        let own = at.iter().map(|&i| contours[i]).chain(wrong);
        own.chain(links.iter().map(|&i| kept[i])).collect()
    }
}

/// The stages of a space for the variables in its order.
pub(in crate::search) fn adding(
    field: Field,
    order: &[usize],
    space: &SelfStressSpace,
    kept: Kept,
) -> Vec<Adding> {
    let always = |l: &Lifetime| Lifetime { from: 0, to: l.to };
    let lifetimes = [
        space.contours.clone(),
        match kept {
            Kept::Live => space.kept.clone(),
            Kept::All => space.kept.iter().map(always).collect(),
        },
    ];
    let mut wrong = 0;
    let stage = |(t, &variable): (usize, &usize)| {
        let coordinates = StageCoordinates::new(&lifetimes, t, wrong);
        let spans = space.added[t].iter();
        let spans: Vec<Vec<Vec<Residue>>> = spans
            .map(|choice| {
                let parts = choice.iter().map(|v| v.split_at(space.contours.len()));
                parts
                    .map(|(own, kept)| coordinates.row(own, kept))
                    .collect()
            })
            .collect();
        let spans: Vec<_> = spans.iter().map(Vec::as_slice).collect();
        let ending = [0, 1].map(|of| {
            let at = coordinates.at[of].iter();
            at.filter(|&&number| lifetimes[of][number].to == t).count()
        });
        let (gap, width) = (ending[0], coordinates.width());
        let left = coordinates.at[0].len() - gap;
        let finished = left..left + wrong + ending[1];
        // What went wrong reaches contours still, each motion in a way of its own.
        wrong = match kept {
            Kept::Live => finished.len().min(left),
            Kept::All => finished.len(),
        };
        let places = coordinates.places();
        let [contours, _] = coordinates.at;
        Adding {
            variable,
            growth: one_from_another(field, &spans),
            contours,
            width,
            places,
            gap,
            folding: (!finished.is_empty()).then(|| Folding {
                dropped: left + wrong..finished.end,
                collapse: Collapse::at_rest(finished, left..width - gap),
            }),
        }
    };
    order.iter().enumerate().map(stage).collect()
}
