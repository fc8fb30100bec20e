//! Speeds of joints relative to that of the drive.

use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism};
use crate::motion::follow::column_slides;
use crate::motion::pose::Pose;
use ozols_dense::svd;
use thiserror::Error;

/// Fraction of the largest singular value below which values count as zero.
const TOLERANCE: f64 = 1e-9;

/// Reason why there is no transmission ratio.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TransmissionError {
    /// The number of drives is not one.
    #[error("the mechanism has {0} drives; a transmission ratio needs one")]
    Drives(usize),
    /// The drive has no or several freedoms.
    #[error(
        "joint \"{0}\" must have one freedom, a rotation or a translation, for a transmission ratio"
    )]
    Freedoms(String),
    /// The drive cannot move.
    #[error("drive \"{0}\" cannot move in this pose")]
    Stuck(String),
    /// The joint moves independently of the drive.
    #[error("the drive does not determine the speed of joint \"{0}\"")]
    Loose(String),
    /// The decomposition failed.
    #[error(
        "the closure equations could not be decomposed; check the coordinates for extreme values"
    )]
    Numeric,
}

/// Speeds of joints for unit speed of the drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Rates {
    /// Whether the drive slides; it turns otherwise.
    pub slides: bool,
    /// Absolute speed of each joint: `[rad/m]` for turning joints of a sliding drive (with lengths in metres), `[1]`
    /// for those of a rotary one.
    pub rates: Vec<f64>,
}

/// Returns the speeds of turning joints if the single drive moves at unit speed, in a pose of the free state.
///
/// # Errors
/// Returns an error if the mechanism has no such ratio.
///
/// # Complexity
/// One singular value decomposition of J.
pub(crate) fn drive_rates(
    mechanism: &Mechanism,
    pose: &Pose,
    joints: &[JointId],
) -> Result<Rates, TransmissionError> {
    let drives: Vec<JointId> = mechanism
        .joint_ids()
        .filter(|&j| mechanism.joints[j].drive)
        .collect();
    let [drive] = drives[..] else {
        return Err(TransmissionError::Drives(drives.len()));
    };
    let f = pose.columns.len();
    let id = |j: JointId| mechanism.joints[j].id.clone();
    let only = |j: JointId| {
        let mut own = (0..f).filter(|&c| pose.columns[c].joint == j);
        match (own.next(), own.next()) {
            (Some(c), None) if matches!(pose.columns[c].freedom, Freedom::Rz | Freedom::Tz) => {
                Ok(c)
            }
            _ => Err(TransmissionError::Freedoms(id(j))),
        }
    };
    let at = only(drive)?;
    let jacobian = pose.jacobian_at(&vec![0.0; f]);
    let svd = svd(&jacobian).ok_or(TransmissionError::Numeric)?;
    let free = svd.null_space(svd.rank(TOLERANCE));
    let speeds = |c: usize| -> Vec<f64> { (0..free.ncols()).map(|i| free[(c, i)]).collect() };
    let drive_row = speeds(at);
    let size: f64 = drive_row.iter().map(|x| x * x).sum();
    if size.sqrt() <= TOLERANCE {
        return Err(TransmissionError::Stuck(id(drive)));
    }
    let slides = column_slides(pose, at);
    let unit = if slides {
        pose.length * mechanism.length_unit.metres
    } else {
        1.0
    };
    let rates = joints.iter().map(|&j| {
        let c = only(j)?;
        let row = speeds(c);
        let along: f64 = row.iter().zip(&drive_row).map(|(a, b)| a * b).sum::<f64>() / size;
        let rest: f64 = row
            .iter()
            .zip(&drive_row)
            .map(|(a, b)| (a - along * b).powi(2))
            .sum();
        if rest.sqrt() > 1e-6 {
            return Err(TransmissionError::Loose(id(j)));
        }
        Ok((along / unit).abs())
    });
    Ok(Rates {
        slides,
        rates: rates.collect::<Result<_, _>>()?,
    })
}
