//! Specification of a torsional drive in a file: two discs on a bar, latches, a cam. SI units, angles in radians.

/// One step of a programme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProgrammeStep {
    /// The latch of disc 0 or 1 opens, and the disc swings.
    Swing(usize),
    /// Both discs stay latched. `[s]`
    Dwell(f64),
}

/// Damping, which consumes the energy of a swing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// `[N·m·s/rad]`
    pub viscous: f64,
    /// `[N·m]`
    pub coulomb: f64,
}

/// The cam and its spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cam {
    /// S, stroke of the spring's end. `[m]`
    pub stroke: f64,
    /// ψ0, deformation when mounted, relative to the stroke.
    pub mounting: f64,
    /// η, mean efficiency.
    pub efficiency: f64,
}

/// The cam's push on a swinging disc: a constant moment from its start to the latch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Work in a swing, which replaces that of equation (12). `[J]`
    pub energy: Option<f64>,
    /// Start of the push, from the middle of the swing. `[rad]`
    pub from: f64,
}

/// A payload carried on a disc, for which accelerations are reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Payload {
    /// `[kg]`
    pub mass: f64,
    /// Distance of its centre from the axis. `[m]`
    pub radius: f64,
}

/// A torsional drive. `[Klyuchkovskyi 1999]`
#[derive(Debug, Clone, PartialEq)]
pub struct DriveSpec {
    /// φ0, half of a swing. `[rad]`
    pub twist: f64,
    /// τ of the disc with the larger inertia. `[s]`
    pub period: f64,
    /// I of the two discs with their payloads. `[kg·m²]`
    pub inertias: [f64; 2],
    /// The payload, if stated.
    pub payload: Option<Payload>,
    /// G. `[Pa]`
    pub shear_modulus: f64,
    /// `[τ_s]`. `[Pa]`
    pub allowable_stress: f64,
    /// Initial length of the bar. `[m]`
    pub length: Option<f64>,
    /// Greatest length of the bar. `[m]`
    pub max_length: Option<f64>,
    /// Available diameters. If empty, any diameter is allowed. `[m]`
    pub diameters: Vec<f64>,
    /// Δφ, measured. `[rad]`
    pub missing: Option<f64>,
    /// Damping, if stated.
    pub damping: Option<Damping>,
    /// The cam, if stated.
    pub cam: Option<Cam>,
    /// The cam's push.
    pub push: Push,
    /// Distance from its groove at which a latch still catches a disc. `[rad]`
    pub capture: f64,
    /// The motion of the discs.
    pub programme: Vec<ProgrammeStep>,
}
