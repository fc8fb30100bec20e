//! The constraints of a joint in an assembly.

/// A constraint. Lengths are in the assembly's unit; d is the vector from I's origin to J's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Holds {
    /// All directions.
    Fixed,
    /// Origins, and the directions of z.
    Revolute,
    /// All directions except for translation along z.
    Translational,
    /// The lines along z.
    Cylindrical,
    /// Origins.
    Spherical,
    /// Origins, and the two z at a right angle.
    Universal,
    /// Origins, and equal turns of I and J about their axes.
    ConstantVelocity,
    /// The xy planes, at this distance along z of I.
    Planar(f64),
    /// J's origin and a plane parallel to I's xy plane, at this distance along z.
    PointInPlane(f64),
    /// J's line along z and a plane parallel to I's xy plane, at this distance.
    LineInPlane(f64),
    /// J's origin and I's line along z.
    PointInLine,
    /// The directions of z.
    ParallelAxes,
    /// All rotations.
    NoRotation,
    /// The cosine of the angle between the two z.
    Angle(f64),
    /// The distance of the origins.
    PointPoint(f64),
    /// The distance of J's origin from I's line along z.
    PointLine(f64),
    /// The distance of the two lines along z, which are parallel.
    LineLine(f64),
    /// The same, without translation along them.
    Hinges(f64),
    /// Radii of I's and J's gear; the second is negative for a belt.
    Gear([f64; 2]),
    /// Pitch radius of the pinion J, whose rack slides along x of I.
    RackPinion(f64),
    /// Travel along z per turn.
    Screw(f64),
}

/// Distances below this count as zero.
const NONE: f64 = 1e-9;

impl Holds {
    /// Replaces a distance of 0, which has no gradient, by the condition that points and lines coincide.
    pub(crate) fn settled(self) -> Holds {
        match self {
            Holds::PointPoint(d) if d.abs() < NONE => Holds::Spherical,
            Holds::PointLine(d) if d.abs() < NONE => Holds::PointInLine,
            Holds::LineLine(d) if d.abs() < NONE => Holds::Cylindrical,
            Holds::Hinges(d) if d.abs() < NONE => Holds::Revolute,
            other => other,
        }
    }

    /// Returns the number of constraints.
    pub(crate) fn rows(self) -> usize {
        self.figures().0
    }

    /// Returns true if it couples the motions of two other joints.
    pub(crate) fn couples(self) -> bool {
        matches!(
            self,
            Holds::Gear(_) | Holds::RackPinion(_) | Holds::Screw(_)
        )
    }

    /// Returns its name for reports.
    pub(crate) fn word(self) -> &'static str {
        self.figures().1
    }

    /// Returns the number of constraints and the name.
    fn figures(self) -> (usize, &'static str) {
        match self {
            Holds::Fixed => (6, "fixed"),
            Holds::Revolute => (5, "revolute"),
            Holds::Translational => (5, "slider"),
            Holds::Cylindrical => (4, "cylindrical"),
            Holds::Spherical => (3, "ball"),
            Holds::Universal => (4, "universal"),
            Holds::ConstantVelocity => (4, "constant velocity"),
            Holds::Planar(_) => (3, "plane on plane"),
            Holds::PointInPlane(_) => (1, "point in plane"),
            Holds::LineInPlane(_) => (2, "line in plane"),
            Holds::PointInLine => (2, "point on line"),
            Holds::ParallelAxes => (2, "parallel"),
            Holds::NoRotation => (3, "no rotation"),
            Holds::Angle(_) => (1, "angle"),
            Holds::PointPoint(_) => (1, "distance of points"),
            Holds::PointLine(_) => (1, "distance of point and line"),
            Holds::LineLine(_) => (3, "distance of lines"),
            Holds::Hinges(_) => (4, "distance of hinges"),
            Holds::Gear([_, r]) if r < 0.0 => (1, "belt"),
            Holds::Gear(_) => (1, "gears"),
            Holds::RackPinion(_) => (1, "rack and pinion"),
            Holds::Screw(_) => (1, "screw"),
        }
    }
}
