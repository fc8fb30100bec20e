//! `[workload.drive]`.

use super::number::Coordinate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Two discs on a torsion bar, for `ozols drive`. Lengths in the file's unit; angles in degrees, or as "120deg", "2.1rad",
/// "pi/2"; all else in SI units.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveEntry {
    /// 2 φ0, from one latched position to the next.
    pub swing_angle: Coordinate,
    /// τ in s, a whole oscillation: two swings.
    #[serde(default)]
    pub period: Option<Coordinate>,
    /// Time of one swing in s, in place of `period`.
    #[serde(default)]
    pub swing_time: Option<Coordinate>,
    /// I in kg·m², the largest inertia of a disc with its payload.
    #[serde(default)]
    pub inertia: Option<Coordinate>,
    /// Inertia in kg·m² of the bare disc, in place of `inertia`; with the payload.
    #[serde(default)]
    pub disc_inertia: Option<Coordinate>,
    /// The link whose mass and inertia are those of the bare disc, in place of `disc_inertia`; it turns on the frame.
    #[serde(default)]
    pub disc_link: Option<String>,
    /// Mass of the payload in kg, taken as a point.
    #[serde(default)]
    pub payload_mass: Option<Coordinate>,
    /// From the axis to the payload.
    #[serde(default)]
    pub payload_radius: Option<Coordinate>,
    /// Inertia of the second disc in kg·m² where it differs.
    #[serde(default)]
    pub second_inertia: Option<Coordinate>,
    /// G of the bar in Pa.
    pub shear_modulus: Coordinate,
    /// Allowable shear stress of the bar in Pa.
    pub allowable_stress: Coordinate,
    /// Length of the bar to begin with; it is lengthened until strong enough.
    #[serde(default)]
    pub torsion_length: Option<Coordinate>,
    /// Greatest length of the bar.
    #[serde(default)]
    pub max_length: Option<Coordinate>,
    /// Diameters that bars come in; any where left out.
    #[serde(default)]
    pub diameters: Vec<Coordinate>,
    /// Δφ, the angle missing after a swing without the cam, measured.
    #[serde(default)]
    pub missing_angle: Option<Coordinate>,
    /// Damping moment per speed in N·m·s/rad.
    #[serde(default)]
    pub viscous_damping: Option<Coordinate>,
    /// Moment of dry friction in N·m.
    #[serde(default)]
    pub friction_moment: Option<Coordinate>,
    /// S, stroke of the cam spring's end.
    #[serde(default)]
    pub spring_stroke: Option<Coordinate>,
    /// ψ0, deformation of the mounted spring over its stroke; 0 where left out.
    #[serde(default)]
    pub mounting_coefficient: Option<Coordinate>,
    /// η, mean efficiency of the cam; 1 where left out.
    #[serde(default)]
    pub cam_efficiency: Option<Coordinate>,
    /// From the disc's axis to the centre of the follower's roller where it is lifted; with `roller_radius` the cam's profile
    /// follows.
    #[serde(default)]
    pub cam_radius: Option<Coordinate>,
    /// Radius of the follower's roller.
    #[serde(default)]
    pub roller_radius: Option<Coordinate>,
    /// Work of the cam in a swing in J, in place of what friction takes by equation (12).
    #[serde(default)]
    pub feed_energy: Option<Coordinate>,
    /// Where the cam begins to push, from the middle of the swing; the middle where left out. It pushes up to the latch.
    #[serde(default)]
    pub feed_from: Option<Coordinate>,
    /// In place of `feed_energy` and `feed_from`, a push of several moments: where each piece begins, from the middle of the
    /// swing, and its moment in N·m, as in [[0, 0.5], [20, 0.3]]. The last lasts up to the latch.
    #[serde(default)]
    pub feed_moments: Option<Vec<[Coordinate; 2]>>,
    /// How far short of its groove a latch still catches a disc; 1 degree where left out.
    #[serde(default)]
    pub latch_capture: Option<Coordinate>,
    /// "stepwise" (the default): the discs take turns, and both step on the same way; "reversing": one disc goes to and fro.
    #[serde(default)]
    pub motion: Option<String>,
    /// Number of swings; 8 where left out.
    #[serde(default)]
    pub swings: Option<i64>,
    /// Dwell after each swing in s; none where left out.
    #[serde(default)]
    pub dwell: Option<Coordinate>,
    /// In place of `motion`, `swings` and `dwell`: steps such as ["1", "wait 0.3", "2"], a disc swinging or a dwell in s.
    #[serde(default)]
    pub programme: Option<Vec<String>>,
}
