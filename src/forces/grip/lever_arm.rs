//! Lever arms of the forces on a clamping lever with a V-block, in closed form.

use serde::Serialize;
use std::f64::consts::PI;
use thiserror::Error;

/// A clamping lever with a V-block at its end. `[Pavlenko & Godunko 2010]`, fig. 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Lever {
    /// L, from the pivot to the vertex of the V-block. `[m]`
    pub length: f64,
    /// α, between the faces of the V-block. `[rad]`
    pub prism_angle: f64,
    /// γ, between the lever and the near face. `[rad]`
    pub mounting_angle: f64,
}

/// Reason why there is no such lever.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LeverError {
    /// The value is not a length.
    #[error("the lever length is {0} m; give a positive length")]
    Length(f64),
    /// The faces are flat or folded.
    #[error(
        "the prism angle is {0} degrees; give one above 0 and below 180, where the faces form a V"
    )]
    PrismAngle(f64),
    /// The angle is beyond the lever.
    #[error("the mounting angle is {0} degrees; give one from 0 to below 180")]
    MountingAngle(f64),
}

/// The arms of the two clamping forces about the lever's pivot, with their parts. `[m]`
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Arms {
    /// l11 = L cos(180° - α - γ), equation (4).
    pub l11: f64,
    /// l12 = D/2 tan(90° - α/2), equation (5).
    pub l12: f64,
    /// l1 = l11 + l12, of the contact far from the pivot, equations (1) and (3).
    pub l1: f64,
    /// l21 = L cos γ, equation (7).
    pub l21: f64,
    /// l22 = l12, equation (8).
    pub l22: f64,
    /// l2 = l21 - l22, of the contact near the pivot, equations (2) and (6).
    pub l2: f64,
}

impl Lever {
    /// Creates a lever with angles in their ranges.
    ///
    /// # Units
    /// `[m]`, `[rad]`.
    ///
    /// # Errors
    /// Returns an error if the length is not positive, α is outside (0, 180°), or γ is outside [0, 180°).
    ///
    /// # Examples
    /// ```
    /// use ozols::grip::lever_arm::Lever;
    /// let angle = |degrees: f64| degrees.to_radians();
    /// assert!(Lever::new(0.1, angle(120.0), angle(30.0)).is_ok());
    /// assert!(Lever::new(0.1, angle(180.0), angle(30.0)).is_err()); // The faces are flat.
    /// ```
    pub fn new(length: f64, prism_angle: f64, mounting_angle: f64) -> Result<Lever, LeverError> {
        if !(length > 0.0 && length.is_finite()) {
            return Err(LeverError::Length(length));
        }
        // An angle this near to its limit is the limit, written in decimals.
        let open = |x: f64| x > 1e-9 && x < PI - 1e-9;
        if !open(prism_angle) {
            return Err(LeverError::PrismAngle(prism_angle.to_degrees()));
        }
        if !(0.0..PI).contains(&mounting_angle) {
            return Err(LeverError::MountingAngle(mounting_angle.to_degrees()));
        }
        Ok(Lever {
            length,
            prism_angle,
            mounting_angle,
        })
    }

    /// Returns the arms of the clamping forces on a part of diameter D.
    ///
    /// They do not depend on the turn of the lever: a force normal to a face has its arm along that face.
    ///
    /// # Units
    /// `[m]`
    ///
    /// # Sources
    /// `[Pavlenko & Godunko 2010]` equations (1) to (8).
    ///
    /// # Examples
    /// ```
    /// use ozols::grip::lever_arm::Lever;
    /// let arms = |mounting: f64| {
    ///     let lever = Lever::new(0.1, 120f64.to_radians(), mounting.to_radians())?;
    ///     Ok::<_, ozols::grip::lever_arm::LeverError>(lever.force_arms(0.05))
    /// };
    /// // From γ = 0° to 40° l11 grows by 44.0 mm and l21 falls by 23.4 mm.
    /// assert!((arms(40.0)?.l11 - arms(0.0)?.l11 - 0.0440).abs() < 1e-4);
    /// assert!((arms(0.0)?.l21 - arms(40.0)?.l21 - 0.0234).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn force_arms(&self, diameter: f64) -> Arms {
        let part = self.face_distance(diameter);
        let l11 = self.length * (PI - self.prism_angle - self.mounting_angle).cos();
        let l21 = self.length * self.mounting_angle.cos();
        Arms {
            l11,
            l12: part,
            l1: l11 + part,
            l21,
            l22: part,
            l2: l21 - part,
        }
    }

    /// Returns the distance of the contacts from the vertex along the faces, D/2 cot(α/2). `[m]`
    #[must_use]
    pub fn face_distance(&self, diameter: f64) -> f64 {
        diameter / 2.0 / (self.prism_angle / 2.0).tan()
    }

    /// Returns the distance of the part's centre from the vertex along the bisector, D/2 / sin(α/2). `[m]`
    #[must_use]
    pub(crate) fn centre_distance(&self, diameter: f64) -> f64 {
        diameter / 2.0 / (self.prism_angle / 2.0).sin()
    }

    /// Returns θ = γ + α/2, the angle between the lever and the bisector of its V-block. `[rad]`
    #[must_use]
    pub(crate) fn bisector_angle(&self) -> f64 {
        self.mounting_angle + self.prism_angle / 2.0
    }

    /// Returns the signed distance of the pivot from the gripper's axis at which this diameter is the nominal one.
    /// There both bisectors lie on one line through the part's centre: D/2 / sin(α/2) - L cos(γ + α/2). Its size is a;
    /// it is negative if the levers cross. `[m]`
    #[must_use]
    pub fn nominal_pivot(&self, diameter: f64) -> f64 {
        self.centre_distance(diameter) - self.length * self.bisector_angle().cos()
    }

    /// Returns the diameter that is nominal for a pivot at this signed distance from the axis. It is not positive if
    /// there is none. `[m]`
    ///
    /// # Examples
    /// ```
    /// use ozols::grip::lever_arm::Lever;
    /// let lever = Lever::new(0.1, 120f64.to_radians(), 30f64.to_radians())?;
    /// let pivot = lever.nominal_pivot(0.05);
    /// assert!((lever.nominal_diameter(pivot) - 0.05).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn nominal_diameter(&self, pivot: f64) -> f64 {
        2.0 * (pivot + self.length * self.bisector_angle().cos()) * (self.prism_angle / 2.0).sin()
    }
}
