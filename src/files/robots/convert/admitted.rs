//! Tensors of inertia that engines take: no moment is nothing, and none is more than the other two together.

use crate::robots::convert::lost::Lost;
use crate::robots::convert::payload::Weight;
use crate::robots::convert::scene::RobotScene;
use ozols_dense::{Matrix, symmetric_eigen};

/// What is less is nothing to MuJoCo, which refuses it.
const NOTHING: f64 = 1e-14;
/// How near a bound a moment of inertia is on it, and how far past it is still on it but for the digits of the file.
const BOUND: f64 = 1e-10;
const THIN: f64 = 1e-4;

impl RobotScene<'_> {
    /// The weight of a link with a tensor that engines take, and whether it is; what is changed is noted. Thin plates are at the
    /// bound, give or take rounding.
    pub(crate) fn admitted(
        &self,
        link: usize,
        w: &Weight,
        moving: bool,
        lost: &mut Lost,
    ) -> (Weight, bool) {
        let [xx, yy, zz, xy, xz, yz] = w.tensor;
        let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let matrix = Matrix::from_fn(3, 3, |i, j| rows[i][j]);
        let Some((mut moments, _)) = symmetric_eigen(&matrix) else {
            return (*w, true);
        };
        moments.sort_by(f64::total_cmp);
        let [least, middle, most] = moments[..] else {
            return (*w, true);
        };
        let name = &self.robot.links[link];
        let mut more = 0.0;
        if moving && least < NOTHING {
            let why = "engines refuse what moves without: next to nothing stands there";
            lost.one("moment of inertia of zero", Some(name), why);
            more = self.light.moment() - least;
        }
        let over = most - least - middle - more;
        let mut whole = true;
        if over > -BOUND * most && most > 0.0 {
            whole = over < THIN * most;
            if whole {
                more += over.max(0.0) + BOUND * most;
            } else {
                let why = "one moment is more than the other two together; MuJoCo is told to take their mean";
                lost.one("tensor of inertia that no body has", Some(name), why);
            }
        }
        let mut out = *w;
        out.tensor[..3].iter_mut().for_each(|x| *x += more);
        (out, whole)
    }
}
