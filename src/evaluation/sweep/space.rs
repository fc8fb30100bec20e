//! The samples of a sweep: points of a grid, or of Sobol's sequence.

use crate::file::read::value::parameters::{Domain, Parameter, Values, between, part};
use crate::geom::expr::Expr;
use itertools::Itertools;
use thiserror::Error;

/// Most samples of a grid.
const MOST: usize = 1_000_000;
/// Most numbers of a range on a grid.
const FINEST: usize = 100_000;
/// Most of a sequence: further numbers have no places in it.
const MOST_SOBOL: usize = 1 << 16;
/// A sequence's fractions have this many: each is a short fraction of two, so that no decimals are made up.
const FRACTIONS: usize = 1 << 16;

/// Where a sweep looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// Every combination of so many numbers of each range, its ends among them, and of all values of each list.
    Grid {
        /// Numbers of a range.
        points: usize,
    },
    /// So many points of Sobol's sequence, scrambled by a seed.
    Sobol {
        /// How many.
        count: usize,
        /// The seed.
        seed: u32,
    },
}

/// Why there are no samples.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// Nothing to vary.
    #[error(
        "the file has no parameter with a range or values; add one, such as [parameter] and a = {{ range = [10, 20] }}, and use it in a coordinate, such as \"2*a\""
    )]
    Nothing,
    /// A grid of one point.
    #[error("--grid must be at least 2, the ends of each range")]
    Points,
    /// A grid of too many.
    #[error(
        "--grid must be at most {FINEST} numbers of each range; choose a coarser grid, or --sobol"
    )]
    TooFine,
    /// No points.
    #[error("--sobol must be from 1 to {MOST_SOBOL}")]
    Count,
    /// A grid too fine.
    #[error(
        "a grid of {points} has more than {MOST} samples over {parameters} parameters; choose a coarser one, or --sobol"
    )]
    TooMany {
        /// Numbers of each range.
        points: usize,
        /// How many parameters vary.
        parameters: usize,
    },
}

/// A parameter that varies.
#[derive(Debug, Clone)]
pub struct VaryingParameter {
    /// Its name.
    pub name: String,
    /// Its numbers on a grid, in order.
    pub grid: Vec<Expr>,
    /// What it may be.
    pub domain: Domain,
}

/// All samples.
#[derive(Debug, Clone)]
pub struct Space {
    /// The parameters that vary, by name.
    pub axes: Vec<VaryingParameter>,
    /// Where they are looked at.
    pub sampling: Sampling,
}

/// Values of the parameters that vary.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Its number, from 0.
    pub number: usize,
    /// The values by name, ascending.
    pub values: Values,
}

impl Sample {
    /// The values in words, which differ from those of every other place: `a=3/2 b=sqrt(2)`.
    #[must_use]
    pub fn name(&self) -> String {
        let one = |(name, value): (&String, &Expr)| format!("{name}={value}");
        self.values.iter().map(one).join(" ")
    }
}

impl Space {
    /// The samples of some parameters.
    ///
    /// # Errors
    /// Where none of them varies, or there are too many or too few samples.
    pub fn new(parameters: &[Parameter], sampling: Sampling) -> Result<Space, SpaceError> {
        let points = match sampling {
            Sampling::Grid { points } if points < 2 => return Err(SpaceError::Points),
            Sampling::Grid { points } => points.min(MOST + 1),
            Sampling::Sobol { count, .. } if !(1..=MOST_SOBOL).contains(&count) => {
                return Err(SpaceError::Count);
            }
            Sampling::Sobol { .. } => 0,
        };
        // Counted first: numbers that come to nothing take time to make, and room.
        let sizes = parameters.iter().filter_map(|p| match &p.domain {
            Domain::Constant => None,
            Domain::Values(all) => Some(all.len()),
            Domain::Range(_) => Some(points),
        });
        let grid = matches!(sampling, Sampling::Grid { .. });
        if grid && sizes.clone().fold(1, usize::saturating_mul) > MOST {
            let parameters = sizes.count();
            return Err(SpaceError::TooMany { points, parameters });
        }
        if points > FINEST {
            return Err(SpaceError::TooFine);
        }
        let axes = parameters.iter().filter_map(|p| {
            let grid = match &p.domain {
                Domain::Constant => return None,
                Domain::Values(all) => all.clone(),
                Domain::Range(ends) => {
                    let all = (0..points).map(|i| between(ends, &part(i, points - 1)));
                    all.collect()
                }
            };
            Some(VaryingParameter {
                name: p.name.clone(),
                grid,
                domain: p.domain.clone(),
            })
        });
        let space = Space {
            axes: axes.collect(),
            sampling,
        };
        if space.axes.is_empty() {
            return Err(SpaceError::Nothing);
        }
        Ok(space)
    }

    /// How many samples there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self.sampling {
            Sampling::Sobol { count, .. } => count,
            Sampling::Grid { .. } => {
                let sizes = self.axes.iter().map(|a| a.grid.len());
                sizes.fold(1, usize::saturating_mul)
            }
        }
    }

    /// Whether there are none: never.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A sample by its number; of a grid the last parameter changes first.
    #[must_use]
    pub fn sample(&self, number: usize) -> Sample {
        let values = match self.sampling {
            Sampling::Grid { .. } => {
                let places = self.places(number);
                let each = self.axes.iter().zip(places);
                each.map(|(a, i)| (a.name.clone(), a.grid[i].clone()))
                    .collect()
            }
            Sampling::Sobol { seed, .. } => {
                let each = self.axes.iter().zip(0..);
                each.map(|(a, dimension)| (a.name.clone(), a.at(fraction(number, dimension, seed))))
                    .collect()
            }
        };
        Sample { number, values }
    }

    /// Where a sample of a grid is on each axis.
    fn places(&self, number: usize) -> Vec<usize> {
        let mut rest = number;
        let mut out: Vec<usize> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            out.push(rest % axis.grid.len());
            rest /= axis.grid.len();
        }
        out.reverse();
        out
    }
}

/// A number of Sobol's sequence, as so many of [`FRACTIONS`].
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "from 0 to 2^16"
)]
fn fraction(number: usize, dimension: u32, seed: u32) -> usize {
    let x = f64::from(sobol_burley::sample(number as u32, dimension, seed));
    ((x * FRACTIONS as f64) as usize).min(FRACTIONS - 1)
}

impl VaryingParameter {
    /// The value at a fraction of the axis.
    fn at(&self, fraction: usize) -> Expr {
        match &self.domain {
            Domain::Range(ends) => between(ends, &part(fraction, FRACTIONS)),
            Domain::Constant | Domain::Values(_) => {
                self.grid[fraction * self.grid.len() / FRACTIONS].clone()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn space(sampling: Sampling) -> Space {
        let number = |x: i64| Expr::from(x);
        let range = Parameter {
            name: "a".to_owned(),
            domain: Domain::Range([number(1), number(3)]),
            default: number(2),
        };
        let list = Parameter {
            name: "b".to_owned(),
            domain: Domain::Values([5, 7, 11].map(number).to_vec()),
            default: number(5),
        };
        let constant = Parameter {
            name: "c".to_owned(),
            domain: Domain::Constant,
            default: number(0),
        };
        Space::new(&[range, list, constant], sampling).unwrap()
    }

    #[test]
    fn a_grid_is_every_combination_with_both_ends() {
        let grid = space(Sampling::Grid { points: 3 });
        let names: Vec<String> = (0..grid.len()).map(|i| grid.sample(i).name()).collect();
        let expected = [
            "a=1 b=5", "a=1 b=7", "a=1 b=11", "a=2 b=5", "a=2 b=7", "a=2 b=11", "a=3 b=5",
            "a=3 b=7", "a=3 b=11",
        ];
        assert_eq!(names, expected);
    }

    #[test]
    fn sobol_has_one_point_in_each_part_of_each_axis() {
        let sobol = space(Sampling::Sobol { count: 64, seed: 7 });
        let a: Vec<f64> = (0..64)
            .map(|i| sobol.sample(i).values["a"].to_f64())
            .collect();
        for part in 0..64 {
            let from = 1.0 + f64::from(part) / 32.0;
            let within = a.iter().filter(|x| (from..from + 1.0 / 32.0).contains(x));
            assert_eq!(within.count(), 1, "{part}");
        }
        let other = space(Sampling::Sobol { count: 64, seed: 8 });
        assert_ne!(sobol.sample(0).name(), other.sample(0).name());
    }

    #[test]
    fn every_value_of_a_list_is_drawn() {
        let sobol = space(Sampling::Sobol { count: 16, seed: 1 });
        let drawn: Vec<String> = (0..16)
            .map(|i| sobol.sample(i).values["b"].to_string())
            .collect();
        assert!(
            ["5", "7", "11"]
                .iter()
                .all(|v| drawn.iter().any(|d| d == v)),
            "{drawn:?}"
        );
    }
}
