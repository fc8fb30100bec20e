//! Capacities that a choice gives a place.

use crate::score::evaluation::pose_tables::Cell;

/// How much of what a place bears counts.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadLimits {
    /// One over the least capacity of the joints in series. `[1/N]`
    pub(super) force: f64,
    /// The same for moments `[1/(N·m)]`; 0 if none is borne.
    pub(super) moment: f64,
    /// `[m]`
    pub(super) clearance: f64,
}

impl LoadLimits {
    /// Returns the limits of the joints that a choice puts at a place.
    pub(super) fn of(cell: &Cell) -> LoadLimits {
        let forces = cell.bears.iter().map(|b| 1.0 / b.0);
        let moments = cell.bears.iter().filter_map(|b| b.1);
        LoadLimits {
            force: forces.fold(0.0, f64::max),
            moment: moments.map(|m| 1.0 / m).fold(0.0, f64::max),
            clearance: cell.clearance,
        }
    }

    /// Returns the least of each limit.
    pub(super) fn least_of_both(self, other: LoadLimits) -> LoadLimits {
        LoadLimits {
            force: self.force.min(other.force),
            moment: self.moment.min(other.moment),
            clearance: self.clearance.min(other.clearance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(l: LoadLimits) -> [f64; 3] {
        [l.force, l.moment, l.clearance]
    }

    #[test]
    fn the_least_of_two_is_so_in_each() {
        let [one, other] =
            [[0.1, 0.6, 0.5], [0.4, 0.3, 0.2]].map(|[force, moment, clearance]| LoadLimits {
                force,
                moment,
                clearance,
            });
        assert_eq!(told(one.least_of_both(other)), [0.1, 0.3, 0.2]);
        assert_eq!(told(other.least_of_both(one)), [0.1, 0.3, 0.2]);
    }

    /// Joints in series bear as much as the weakest of them; what bears no moment limits none.
    #[test]
    fn the_weakest_of_a_series_limits() {
        let limits = |bears: &[(f64, Option<f64>)]| {
            told(LoadLimits::of(&Cell {
                rows: Vec::new(),
                gram: Vec::new(),
                bears: bears.to_vec(),
                clearance: 0.3,
                coupled: Vec::new(),
            }))
        };
        assert_eq!(
            limits(&[(10.0, Some(2.0)), (5.0, Some(4.0))]),
            [0.2, 0.5, 0.3]
        );
        assert_eq!(
            limits(&[(10.0, Some(8.0)), (20.0, None)]),
            [0.1, 0.125, 0.3]
        );
        assert_eq!(limits(&[(4.0, None)]), [0.25, 0.0, 0.3]);
    }
}
