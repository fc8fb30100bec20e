//! The symbols that a redesign puts into a scheme in space.

use crate::draw::kinematic::Kinematic;
use crate::draw::kinematic::scene::part::{SymbolPart, flat, part};
use crate::draw::kinematic::scene::{Scene, Swapped, fine};
use crate::draw::place::projection;
use crate::draw::subject::Mark;
use crate::draw::symbol::placed::Symbol;
use crate::draw::symbol::swap::{self, Swap};
use crate::draw::symbol::symbols;
use crate::model::joint_type::JointType;
use crate::model::mechanism::JointId;

impl Kinematic<'_> {
    /// The pieces of a joint's symbol, with what stands round it.
    pub(in crate::draw::kinematic) fn parts(
        &self,
        joint: JointId,
        of: &JointType,
        symbol: &Symbol,
        mark: Mark,
    ) -> Vec<SymbolPart> {
        let (below, above) = symbol.round(self.subject, joint, mark);
        let own = [symbols::pieces(of), symbol.arrow()].concat();
        let own = own.iter().map(|p| part(p, mark.class(), symbol.size));
        let parts = below.iter().map(flat).chain(own);
        parts.chain(above.iter().map(flat)).collect()
    }

    /// What each swap puts into a scene whose joints begin with the points of interest; room is made for all of them.
    pub(in crate::draw::kinematic) fn swap_in(
        &mut self,
        scene: &mut Scene,
        swaps: &[Swap<'_>],
    ) -> Vec<Swapped> {
        let order = self.outer_first();
        let mut out = Vec::new();
        for swap in swaps {
            let there = order.iter().enumerate();
            let there = there.map(|(n, &i)| (n, i));
            let mut there = there.filter(|&(_, i)| self.spots[i].joint == swap.joint);
            let Some((n, i)) = there.next() else { continue };
            let (place, of) = (
                projection::turned(&swap.option.frame),
                &swap.option.joint_type,
            );
            let (view, size) = (&self.projection.view, self.spots[i].symbol.size);
            let slide = self.spots[i].symbol.slide;
            let symbol = Symbol::new(self.subject, swap.joint, of, &place, view, size, slide);
            let mut parts = self.parts(swap.joint, of, &symbol, Mark::Changed);
            if swap.unloading {
                parts.push(flat(&swap::ring(symbol.reach())));
            }
            let spot = &mut self.spots[i];
            spot.rect = spot.rect.with(&symbol.room.moved(spot.at));
            out.push(Swapped {
                joint: self.points.len() + n,
                axes: [place.x, place.y, place.z].map(fine),
                symbol: scene.symbol(parts),
            });
        }
        out
    }
}
