//! Equal parallel bars on parallel hinges: the link they carry slides on a circle.

use super::{BondPart, Bonds, Chain, Twist};
use crate::geom::Scalars;
use crate::linalg::echelon::rank;

impl Bonds<'_> {
    /// Replaces two bars of a parallelogram by one part that slides on a circle.
    pub(super) fn parallelogram(&mut self) -> bool {
        for b in 0..self.chains.len() {
            for a in 0..b {
                let other = &self.chains[b];
                let other = if other.ends == self.chains[a].ends {
                    other.clone()
                } else {
                    other.clone().reversed()
                };
                if let Some(part) = self.circle(&self.chains[a], &other) {
                    self.chains[a].parts = vec![part];
                    self.chains.remove(b);
                    return true;
                }
            }
        }
        false
    }

    /// Returns the slide on a circle of two chains that are bars of a parallelogram.
    fn circle(&self, a: &Chain, b: &Chain) -> Option<BondPart> {
        if a.ends != b.ends || a.is_closed() {
            return None;
        }
        let [near, far] = self.hinges(a)?;
        let [near_too, far_too] = self.hinges(b)?;
        let field = self.exact.field();
        let difference = |x: &Twist, y: &Twist| -> Twist {
            x.iter().zip(y).map(|(&x, &y)| field.sub(x, y)).collect()
        };
        let (along, across) = (difference(&near, &far), difference(&near, &near_too));
        // The axes must be parallel, the bars equal, and the points not all on a line.
        let slides = |t: &Twist| t[..3].iter().all(|&x| x == 0);
        let equal = along == difference(&near_too, &far_too);
        let apart = rank(field, [&along[..], &across[..]]) == 2;
        (slides(&along) && slides(&across) && equal && apart).then(|| BondPart {
            span: vec![along.clone()],
            within: vec![along, across],
        })
    }

    /// Returns the twists of a chain of two hinges about parallel axes, with the same angular velocity.
    fn hinges(&self, chain: &Chain) -> Option<[Twist; 2]> {
        let [first, second] = &chain.parts[..] else {
            return None;
        };
        let field = self.exact.field();
        let turn = |part: &BondPart| -> Option<Twist> {
            let [twist] = &part.span[..] else {
                return None;
            };
            let (w, v) = (
                [twist[0], twist[1], twist[2]],
                [twist[3], twist[4], twist[5]],
            );
            let of = w.into_iter().find(|&x| x != 0)?;
            let hinge = part.is_group() && self.exact.dot(w, v) == 0;
            let scale = field.inv(of);
            hinge.then(|| twist.iter().map(|&x| field.mul(scale, x)).collect())
        };
        Some([turn(first)?, turn(second)?])
    }
}
