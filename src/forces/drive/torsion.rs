//! The torsion bar of a two-disc drive: its formulas, and its size.

use serde::{Serialize, Serializer};
use std::f64::consts::PI;

/// A round bar in torsion.
///
/// # Examples
/// ```
/// use ozols::drive::torsion::Bar;
/// // 1 m of steel, 20 mm thick.
/// let bar = Bar { length: 1.0, diameter: 0.02, shear_modulus: 80e9 };
/// assert!((bar.stiffness() - 1256.6).abs() < 0.1); // N·m/rad
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bar {
    /// l. `[m]`
    pub length: f64,
    /// d. `[m]`
    pub diameter: f64,
    /// G. `[Pa]`
    #[serde(skip)]
    pub shear_modulus: f64,
}

impl Bar {
    /// Returns k = π d⁴ G / (32 l). `[N·m/rad]`
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]` equation (8).
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        PI * self.diameter.powi(4) * self.shear_modulus / (32.0 * self.length)
    }

    /// Returns `[φ]` = 2 l `[τ_s]` / (d G), the twist at which the rim reaches the allowable shear stress. `[rad]`
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]` equation (11), where the stress shares its letter with the period.
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::torsion::Bar;
    /// let bar = Bar { length: 1.0, diameter: 0.02, shear_modulus: 80e9 };
    /// let twist = bar.allowable_twist(400e6);
    /// assert_eq!(twist, 0.5); // rad
    /// assert!((bar.rim_stress(twist) - 400e6).abs() < 1.0);
    /// ```
    #[must_use]
    pub fn allowable_twist(&self, allowable_stress: f64) -> f64 {
        2.0 * self.length * allowable_stress / (self.diameter * self.shear_modulus)
    }

    /// Returns the shear stress at the rim at a twist. `[Pa]`
    #[must_use]
    pub fn rim_stress(&self, twist: f64) -> f64 {
        self.diameter * self.shear_modulus * twist / (2.0 * self.length)
    }
}

/// Returns Π = k φ0² / 2. `[J]`, `[Klyuchkovskyi 1999]` equation (1).
///
/// # Examples
/// ```
/// use ozols::drive::torsion::stored_energy;
/// assert_eq!(stored_energy(1000.0, 0.5), 125.0); // J
/// ```
#[must_use]
pub fn stored_energy(stiffness: f64, twist: f64) -> f64 {
    stiffness * twist * twist / 2.0
}

/// Returns p = √(k/I). `[rad/s]`, `[Klyuchkovskyi 1999]` equation (4).
///
/// # Examples
/// ```
/// use ozols::drive::torsion::natural_frequency;
/// assert_eq!(natural_frequency(100.0, 0.25), 20.0); // rad/s
/// ```
#[must_use]
pub fn natural_frequency(stiffness: f64, inertia: f64) -> f64 {
    (stiffness / inertia).sqrt()
}

/// Returns δ = ln(A_k / A_{k+1}) of two successive maximal deflections, half a period apart.
///
/// # Sources
/// `[Klyuchkovskyi 1999]` equation (6), which also gives it as about ΔA/A.
#[must_use]
pub fn log_decrement(deflection: f64, next: f64) -> f64 {
    (deflection / next).ln()
}

/// Returns d = ⁴√(128 π I l / (τ² G)). `[m]`, `[Klyuchkovskyi 1999]` equation (10).
///
/// # Examples
/// ```
/// use ozols::drive::torsion::{Bar, bar_diameter, natural_frequency};
/// let bar = Bar { length: 1.0, diameter: 0.02, shear_modulus: 80e9 };
/// let period = std::f64::consts::TAU / natural_frequency(bar.stiffness(), 3.0);
/// // The period of its swing gives the diameter back.
/// assert!((bar_diameter(3.0, bar.length, period, bar.shear_modulus) - 0.02).abs() < 1e-12);
/// ```
#[must_use]
pub fn bar_diameter(inertia: f64, length: f64, period: f64, shear_modulus: f64) -> f64 {
    (128.0 * PI * inertia * length / (period * period * shear_modulus))
        .sqrt()
        .sqrt()
}

/// Returns E_fr = k/2 (2 φ0 Δφ - Δφ²), the energy lost to friction in a swing that ends Δφ short. `[J]`
///
/// # Sources
/// `[Klyuchkovskyi 1999]` equation (12).
///
/// # Examples
/// ```
/// use ozols::drive::torsion::{friction_energy, stored_energy};
/// // The difference of the energies stored at both ends.
/// let lost = stored_energy(1000.0, 0.5) - stored_energy(1000.0, 0.5 - 0.1);
/// assert!((friction_energy(1000.0, 0.5, 0.1) - lost).abs() < 1e-9);
/// ```
#[must_use]
pub fn friction_energy(stiffness: f64, twist: f64, missing: f64) -> f64 {
    stiffness / 2.0 * (2.0 * twist * missing - missing * missing)
}

/// The spring behind the cam's follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamSpring {
    /// c. `[N/m]`
    pub rate: f64,
    /// S, stroke of its end. `[m]`
    pub stroke: f64,
    /// ψ0, deformation when mounted, relative to the stroke.
    pub mounting: f64,
}

impl CamSpring {
    /// Returns A_spring = ½ [(1 + ψ0)² - ψ0²] c S², its energy over the stroke. `[J]`
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]` equation (13). DIFFERENCE: the scan prints (1 + ψ0²); only the square of the sum agrees
    /// with (14).
    #[must_use]
    pub fn stroke_energy(&self) -> f64 {
        let psi = self.mounting;
        0.5 * ((1.0 + psi).powi(2) - psi * psi) * self.rate * self.stroke.powi(2)
    }

    /// Returns the spring that compensates friction: c = 2 E_fr / (η (1 + 2 ψ0) S²).
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]` equation (14).
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::torsion::CamSpring;
    /// let spring = CamSpring::for_friction(2.0, 0.8, 0.25, 0.01);
    /// // It gives what friction takes, and the losses of the cam.
    /// assert!((spring.stroke_energy() - 2.0 / 0.8).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn for_friction(energy: f64, efficiency: f64, mounting: f64, stroke: f64) -> CamSpring {
        let rate = 2.0 * energy / (efficiency * (1.0 + 2.0 * mounting) * stroke * stroke);
        CamSpring {
            rate,
            stroke,
            mounting,
        }
    }
}

impl Serialize for CamSpring {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map([
            ("rate", self.rate),
            ("stroke", self.stroke),
            ("mounting_coefficient", self.mounting),
            ("energy", self.stroke_energy()),
        ])
    }
}

/// Requirements on a bar.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// φ0, half the swing. `[rad]`
    pub twist: f64,
    /// τ, of the largest inertia. `[s]`
    pub period: f64,
    /// I, the largest. `[kg·m²]`
    pub inertia: f64,
    /// G. `[Pa]`
    pub shear_modulus: f64,
    /// `[τ_s]`. `[Pa]`
    pub allowable_stress: f64,
    /// The initial length. `[m]`
    pub length: Option<f64>,
    /// The maximum available length. `[m]`
    pub max_length: Option<f64>,
    /// Step of chosen lengths. `[m]`
    pub length_step: f64,
    /// Available diameters, ascending. If empty, any diameter is allowed. `[m]`
    pub diameters: Vec<f64>,
}

/// A bar that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BarTrial {
    /// The bar.
    #[serde(flatten)]
    pub bar: Bar,
    /// `[φ]`. `[rad]`
    pub allowable_twist: f64,
    /// Whether (11) holds.
    pub strong: bool,
    /// Whether there is enough space for it.
    pub fits: bool,
}

/// Changes that make a bar possible, each on its own, at the maximum length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Remedy {
    /// A bar at least this long. `[m]`
    #[serde(rename = "length_above")]
    pub length: f64,
    /// A material with at least this `[τ_s]`. `[Pa]`
    #[serde(rename = "allowable_stress_above")]
    pub allowable_stress: f64,
    /// A period at least this long. `[s]`
    #[serde(rename = "period_above")]
    pub period: f64,
    /// φ0 below this. `[rad]`
    #[serde(rename = "half_swing_below")]
    pub twist: f64,
    /// I below this. `[kg·m²]`
    #[serde(rename = "inertia_below")]
    pub inertia: f64,
}

/// A bar, or the reason why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sizing {
    /// The trials, in order; the last is the bar if one was found.
    pub trials: Vec<BarTrial>,
    /// The bar.
    #[serde(skip)]
    pub bar: Option<Bar>,
    /// The necessary changes if there is none.
    #[serde(rename = "remedies")]
    pub remedy: Option<Remedy>,
}

impl Wanted {
    /// Returns k = I (2π/τ)². `[N·m/rad]`
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.inertia * (2.0 * PI / self.period).powi(2)
    }

    fn try_bar(&self, length: f64, diameter: f64) -> BarTrial {
        let bar = Bar {
            length,
            diameter,
            shear_modulus: self.shear_modulus,
        };
        let allowable_twist = bar.allowable_twist(self.allowable_stress);
        let fits = self
            .max_length
            .is_none_or(|most| length <= most * (1.0 + 1e-12));
        BarTrial {
            bar,
            allowable_twist,
            strong: allowable_twist > self.twist,
            fits,
        }
    }

    /// Returns the trial of a bar of this length, whose diameter follows by (10).
    fn try_length(&self, length: f64) -> BarTrial {
        let diameter = bar_diameter(self.inertia, length, self.period, self.shear_modulus);
        self.try_bar(length, diameter)
    }

    /// Returns the smallest length, at which (11) is an equality: `[φ]` grows as l^(3/4) if d follows (10). `[m]`
    #[must_use]
    pub fn least_length(&self) -> f64 {
        let one = self.try_length(1.0);
        (self.twist / one.allowable_twist).powf(4.0 / 3.0)
    }

    /// Determines the size of the bar. d follows from l by (10), and l is increased until (11) holds. With a list of
    /// diameters, the result is the smallest one whose length by (8) satisfies (11) and fits.
    ///
    /// # Units
    /// SI.
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]` equations (8), (10), (11) and the procedure after them.
    #[must_use]
    pub fn size_bar(&self) -> Sizing {
        let mut trials = Vec::new();
        if self.diameters.is_empty() {
            let up = |l: f64| (l / self.length_step - 1e-9).ceil().max(1.0) * self.length_step;
            let mut length = self.length.unwrap_or(self.length_step);
            for _ in 0..64 {
                let trial = self.try_length(length);
                trials.push(trial);
                if trial.strong || !trial.fits {
                    break;
                }
                length = up(length * (self.twist / trial.allowable_twist).powf(4.0 / 3.0))
                    .max(length + self.length_step);
            }
        } else {
            let k = self.stiffness();
            for &d in &self.diameters {
                let trial = self.try_bar(PI * d.powi(4) * self.shear_modulus / (32.0 * k), d);
                trials.push(trial);
                if trial.strong {
                    break;
                }
            }
        }
        let bar = trials.last().filter(|t| t.strong && t.fits).map(|t| t.bar);
        let remedy = bar.is_none().then(|| self.find_remedy(&trials));
        Sizing {
            trials,
            bar,
            remedy,
        }
    }

    fn find_remedy(&self, trials: &[BarTrial]) -> Remedy {
        let longest = trials.iter().map(|t| t.bar.length).fold(0.0, f64::max);
        let length = self.max_length.unwrap_or(longest);
        let here = self.try_length(length);
        // The thickest bar of this length that twists by φ0 within its strength.
        let thickest = 2.0 * length * self.allowable_stress / (self.shear_modulus * self.twist);
        Remedy {
            length: self.least_length(),
            allowable_stress: here.bar.rim_stress(self.twist),
            period: (128.0 * PI * self.inertia * length / (thickest.powi(4) * self.shear_modulus))
                .sqrt(),
            twist: here.allowable_twist,
            inertia: thickest.powi(4) * self.period.powi(2) * self.shear_modulus
                / (128.0 * PI * length),
        }
    }
}
