//! The file's unit of length.

use crate::file::findings::Findings;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::schema::MechanismFile;
use crate::model::mechanism::LengthUnit;
use itertools::Itertools;

const UNITS: [LengthUnit; 5] = [
    LengthUnit {
        symbol: "m",
        metres: 1.0,
    },
    LengthUnit {
        symbol: "mm",
        metres: 1e-3,
    },
    LengthUnit {
        symbol: "cm",
        metres: 1e-2,
    },
    LengthUnit {
        symbol: "um",
        metres: 1e-6,
    },
    LengthUnit {
        symbol: "in",
        metres: 0.0254,
    },
];

/// The file's unit of length.
pub(crate) fn length_unit(file: &MechanismFile, out: &mut Findings) -> LengthUnit {
    let symbol = file.length_unit.as_deref().unwrap_or("m");
    let found = UNITS.into_iter().find(|u| u.symbol == symbol);
    found.unwrap_or_else(|| {
        let known = UNITS.iter().map(|u| u.symbol).join(", ");
        out.add(
            &[DocumentStep::Key("length_unit".to_owned())],
            ProblemKind::UnknownWord {
                what: "length unit",
                word: symbol.to_owned(),
                known,
            },
        );
        UNITS[0]
    })
}
