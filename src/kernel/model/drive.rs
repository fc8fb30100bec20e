//! What a file says of a torsional drive: two discs on a bar, latches, a cam. SI units, angles in radians.

/// One step of a programme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProgrammeStep {
    /// The latch of disc 0 or 1 lets go, and the disc swings.
    Swing(usize),
    /// Both discs stay latched. `[s]`
    Dwell(f64),
}

/// What takes the energy of a swing.
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
    /// ψ0, deformation when mounted over the stroke.
    pub mounting: f64,
    /// η, mean efficiency.
    pub efficiency: f64,
    /// From the disc's axis to the roller's centre where the follower is lifted, and the roller's radius, where stated. `[m]`
    pub profile: Option<(f64, f64)>,
}

/// The cam's push on a swinging disc, from where it begins to the latch.
#[derive(Debug, Clone, PartialEq)]
pub enum Push {
    /// One moment all along.
    Even {
        /// Work in a swing, in place of that of equation (12). `[J]`
        energy: Option<f64>,
        /// Where it begins, from the middle of the swing. `[rad]`
        from: f64,
    },
    /// In order: where each piece begins, from the middle of the swing `[rad]`, and its moment `[N·m]`.
    Pieces(Vec<(f64, f64)>),
}

impl Push {
    /// Where pieces begin, and their moments as multiples of one that is the same for all.
    #[must_use]
    pub fn pieces(&self) -> Vec<(f64, f64)> {
        match self {
            Push::Even { from, .. } => vec![(*from, 1.0)],
            Push::Pieces(pieces) => pieces.clone(),
        }
    }

    /// Work up to a latch, where it is stated. `[J]`
    #[must_use]
    pub fn energy(&self, latch: f64) -> Option<f64> {
        match self {
            Push::Even { energy, .. } => *energy,
            Push::Pieces(pieces) => {
                let ends = pieces.iter().skip(1).map(|p| p.0).chain([latch]);
                let work = |(p, end): (&(f64, f64), f64)| p.1 * (end - p.0);
                Some(pieces.iter().zip(ends).map(work).sum())
            }
        }
    }
}

/// A payload carried on a disc, by which accelerations are told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Payload {
    /// `[kg]`
    pub mass: f64,
    /// From the axis to its centre. `[m]`
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
    /// The payload, where stated.
    pub payload: Option<Payload>,
    /// G. `[Pa]`
    pub shear_modulus: f64,
    /// `[τ_s]`. `[Pa]`
    pub allowable_stress: f64,
    /// Length of the bar to begin with. `[m]`
    pub length: Option<f64>,
    /// Greatest length of the bar. `[m]`
    pub max_length: Option<f64>,
    /// Diameters to choose from; any where empty. `[m]`
    pub diameters: Vec<f64>,
    /// Δφ, measured. `[rad]`
    pub missing: Option<f64>,
    /// Damping, where stated.
    pub damping: Option<Damping>,
    /// The cam, where stated.
    pub cam: Option<Cam>,
    /// The cam's push.
    pub push: Push,
    /// How far short of its groove a latch still catches a disc. `[rad]`
    pub capture: f64,
    /// What the discs do.
    pub programme: Vec<ProgrammeStep>,
}
