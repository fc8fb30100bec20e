//! Whether the mechanism moves in space or in a plane.

use crate::file::findings::Findings;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::direction;
use crate::file::schema::MechanismFile;
use crate::geom::expr::Expr;
use crate::model::mechanism::Mode;

pub(crate) fn mode(file: &MechanismFile, out: &mut Findings) -> Mode {
    let root = |k: &str| vec![DocumentStep::Key(k.to_owned())];
    match file.mode.as_deref().unwrap_or("spatial") {
        "planar" => {
            let at = root("plane_normal");
            let given = file.plane_normal.as_ref().map(|v| direction(v, &at, out));
            let normal = given.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
            if normal.iter().all(|c| c.to_f64() == 0.0) {
                out.add(
                    &at,
                    ProblemKind::ZeroVector {
                        joint: "of the plane".to_owned(),
                        what: "normal",
                    },
                );
            }
            Mode::Planar { normal }
        }
        other => {
            if other != "spatial" {
                let known = "spatial, planar".to_owned();
                out.add(
                    &root("mode"),
                    ProblemKind::UnknownWord {
                        what: "mode",
                        word: other.to_owned(),
                        known,
                    },
                );
            }
            Mode::Spatial
        }
    }
}
