//! What an MJCF file says of how bodies are weighed.

use crate::file::problem::ImportError;
use crate::robots::mjcf::context::{Compiler, compiler};
use crate::robots::mjcf::weights::weight::Weight;
use crate::robots::xml::Element;

/// What `<compiler>` says of weights.
pub(super) struct Settings {
    pub(super) compiler: Compiler,
    /// The least mass and moment of inertia of a body.
    pub(super) least: [f64; 2],
    /// Whether a tensor that no body has becomes a ball's.
    pub(super) balance: bool,
    /// Whether shapes say what bodies weigh; where the file leaves it open, those of bodies without `<inertial>`.
    pub(super) from_shapes: Option<bool>,
    /// The groups of shapes that weigh anything, from the first to the last.
    pub(super) groups: [f64; 2],
}

impl Settings {
    /// Returns the settings of a file.
    pub(super) fn read(root: Element<'_>) -> Result<Settings, ImportError> {
        let mut out = Settings {
            compiler: compiler(root)?,
            least: [0.0; 2],
            balance: false,
            from_shapes: None,
            groups: [0.0, 5.0],
        };
        for c in root.named("compiler") {
            out.balance |= c.attribute("balanceinertia") == Some("true");
            for (x, key) in out.least.iter_mut().zip(["boundmass", "boundinertia"]) {
                *x = c.numbers::<1>(key)?.map_or(*x, |[x]| x);
            }
            match c.attribute("inertiafromgeom") {
                Some("true") => out.from_shapes = Some(true),
                Some("false") => out.from_shapes = Some(false),
                _ => {}
            }
            out.groups = c.numbers::<2>("inertiagrouprange")?.unwrap_or(out.groups);
        }
        Ok(out)
    }

    /// Returns a weight that is no less than the file asks for.
    pub(super) fn bounded(&self, weight: Weight) -> Weight {
        let mut out = weight;
        let [mass, inertia] = self.least;
        out.mass = out.mass.max(mass);
        out.tensor[..3].iter_mut().for_each(|x| *x = x.max(inertia));
        let [x, y, z, ..] = out.tensor;
        if self.balance && (x + y < z || x + z < y || y + z < x) {
            out.tensor[..3].fill((x + y + z) / 3.0);
        }
        out
    }
}
