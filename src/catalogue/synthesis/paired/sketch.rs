//! What of a paired structure does not depend on where its joints are, gathered once for the many places that are tried.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::pairs::PairKind;
use crate::chains::pairs::chain::Joint;
use crate::synthesis::bones::{BonePlan, Bones};
use crate::synthesis::paired::rules::{PairRule, PairRules};
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::paired::threefold::{Around, SIDES, ThreefoldStructure};
use crate::synthesis::place::Point;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::task::{Limits, room_round_part};

/// A paired structure with the rules of its joints.
#[derive(Debug)]
pub struct PairSketch<'a> {
    /// The structure.
    pub paired: &'a PairedStructure,
    /// Which joints may be placed.
    pub rules: PairRules,
    /// The points of its links.
    pub bones: Bones,
    /// The driven joint.
    pub input: usize,
    /// The link against which the driver moves, and the driver.
    pub drive: [usize; 2],
    /// What it is to be like and to do.
    pub limits: Limits,
    /// All sides, where there are three in one plane.
    pub(super) around: Option<Around>,
    /// Which way each tip opens, as [`Bones::apart`].
    pub(super) apart: Vec<Point>,
    /// All links as drawn.
    pub(super) at_rest: Vec<LinkPose>,
}

impl<'a> PairSketch<'a> {
    /// Of a structure.
    #[must_use]
    pub fn new(paired: &'a PairedStructure, rules: PairRules, limits: Limits) -> PairSketch<'a> {
        PairSketch::thrice(paired, None, rules, limits)
    }

    /// Of a structure that may stand for three sides.
    #[must_use]
    pub(crate) fn thrice(
        paired: &'a PairedStructure,
        threefold: Option<&ThreefoldStructure>,
        rules: PairRules,
        limits: Limits,
    ) -> PairSketch<'a> {
        let (chain, roles) = (&paired.structure.chain, &paired.structure.roles);
        let drive = paired.drive();
        let pinned = |link: usize| {
            let mut own = rules.joints.iter().filter(|j| j.is_at(link));
            own.all(|j| j.pair == PairKind::Hinge)
        };
        let point = |(j, &block): (&Joint, &usize)| {
            let [u, v] = j.links;
            let links = if block == u { [u, v] } else { [v, u] };
            (j.pair != PairKind::Gear).then_some(links)
        };
        let hinged = |&jaw: &usize| chain.between(roles.frame, jaw) == Some(PairKind::Hinge);
        let free = |r: &PairRule| *r == PairRule::Free;
        let turned = paired.form.symmetry == Symmetry::HalfTurn;
        let rows = rules.rules.iter().enumerate();
        let own = rows.filter(|(_, r)| turned && matches!(r, PairRule::Own(_)));
        let central = own.fold(0, |bits, (i, _)| bits | 1u32 << i);
        let shared = rules
            .images()
            .filter(|(of, _)| rules.rules[*of] == PairRule::OnePin);
        let shared = shared.map(|(of, image)| 1u32 << of | 1 << image);
        let plan = BonePlan {
            frame: roles.frame,
            driver: drive[1],
            jaws: &roles.jaws,
            joints: rules.joints.iter().zip(&rules.blocks).map(point).collect(),
            follows: rules.rules.iter().map(|r| !free(r)).collect(),
            tips: (paired.tips(&limits.task).iter().map(|t| t.real())).collect(),
            turns: paired.input() == Input::Turn,
            hinged: roles.jaws.iter().map(hinged).collect(),
            round: room_round_part(roles.jaws.len(), paired.form.symmetry),
            wished: limits.task.distances(),
            together: shared.chain((central > 0).then_some(central)).collect(),
            cylinder: (paired.structure.slides() && drive[0] != roles.frame).then_some(drive),
        };
        let at_input = |j: &Joint| j.links == roles.input;
        let mut bones = Bones::new(chain.links(), plan, pinned);
        if threefold.is_some() {
            bones.sides = SIDES;
        }
        PairSketch {
            around: threefold
                .filter(|t| !t.is_axial())
                .map(|t| Around::new(t, &rules, &bones)),
            apart: bones.apart(),
            bones,
            input: rules.joints.iter().position(at_input).unwrap_or(0),
            at_rest: vec![LinkPose::AT_REST; chain.links()],
            paired,
            rules,
            drive,
            limits,
        }
    }
}

/// The sketches of all well-known structures that have rules of their own, each with its name.
#[cfg(test)]
pub(in crate::synthesis) fn each_classic(mut take: impl FnMut(&str, &PairSketch<'_>)) {
    use crate::chains::pairs::classics::classics;
    use crate::synthesis::paired::layout::most_symmetric;
    for classic in classics() {
        let paired = most_symmetric(&classic.structure).unwrap();
        let lay = paired.lays().swap_remove(0);
        if let Ok(rules) = PairRules::new(&paired, &lay) {
            take(
                &classic.id,
                &PairSketch::new(&paired, rules, Limits::default()),
            );
        }
    }
}
