//! Ratios and pitches that are written as decimals and are all but fractions.

use crate::file::locate::{DocumentStep, index, key};
use crate::file::schema::MechanismFile;
use crate::file::warning::WarningKind;
use crate::format::significant;
use crate::geom::expr::Expr;
use crate::model::mechanism::Mechanism;
use crate::model::rounded::ratio::{doubt, doubt_of};

/// What is doubted of the couplings and screws of a mechanism.
pub(super) fn doubted(
    file: &MechanismFile,
    m: &Mechanism,
) -> Vec<(Vec<DocumentStep>, WarningKind)> {
    let root = |k: &str| vec![DocumentStep::Key(k.to_owned())];
    let couplings = m.couplings.iter().enumerate().filter_map(|(i, c)| {
        let doubt = doubt_of(c)?;
        let kind = WarningKind::DoubtedRatio {
            coupling: c.name(m),
            ratio: c.ratio.to_string(),
            half: significant(doubt.half),
            fraction: doubt.fraction.to_string(),
        };
        Some((key(&index(&root("coupling"), i), "ratio"), kind))
    });
    let screws = file.joint.iter().zip(&m.joints).enumerate();
    let screws = screws.filter_map(|(i, (entry, joint))| {
        entry.pitch.as_ref()?;
        let pitch = &joint.frame.pitch;
        let turn = Expr::from(2) * Expr::pi();
        // The lead is what screws are made to.
        let lead = Expr::from_f64((pitch * &turn).to_f64()).ok()?;
        let lead = doubt(&pitch.scaled_as_written(lead, turn.to_f64()))?;
        let kind = WarningKind::DoubtedPitch {
            joint: joint.id.clone(),
            pitch: pitch.to_string(),
            lead: lead.simple()?.to_string(),
        };
        Some((key(&index(&root("joint"), i), "pitch"), kind))
    });
    couplings.chain(screws).collect()
}
