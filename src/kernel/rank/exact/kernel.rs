//! The kernel of a matrix over a number field, in reduced form, from its images modulo many primes.
//!
//! A prime that splits the field has as many homomorphisms as the degree of the field. The reduced kernels of the
//! images are the images of the reduced kernel, so their values give the coordinates of each entry modulo the prime.
//! The coordinates themselves follow by the Chinese remainder theorem and rational reconstruction.
//!
//! # Sources
//! von zur Gathen & Gerhard, "Modern Computer Algebra", ch. 5 (computing modulo many small primes, Chinese remainders,
//! rational reconstruction).

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;
use thiserror::Error;

use crate::geom::exact::ExactError;
use crate::geom::number_field::splitting::Splitting;
use crate::geom::number_field::{NumberField, NumberFieldError};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::linalg::number_ring::Element;
use crate::rank::exact::reconstruct::{Modulus, Settled, Unknown, inverse_of};
use crate::verify::Flaw;
use crate::verify::certificate::{KernelVector, Minor};
use crate::verify::matrix::MatrixOverRing;

/// Number of useless primes after which the search stops.
const MAX_BAD_PRIMES: usize = 64;

/// Number of consecutive numbers that may still be too long before the attempt stops.
const MAX_FAILURES: usize = 8;

/// Reason why there is no certificate. It casts no doubt on the rank modulo primes.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoCertificate {
    /// The coordinates have no number field to compute in.
    #[error(transparent)]
    Field(#[from] NumberFieldError),
    /// The matrix has no entries in the field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The kernel is larger than the budget allows.
    #[error("the kernel has {coordinates} coordinates, over the budget")]
    TooLarge {
        /// f · (f - r) · degree.
        coordinates: usize,
    },
    /// The computation would take longer than the budget allows.
    #[error("it needs about {operations} operations, over the budget")]
    TooMuchWork {
        /// Number of operations, done and remaining.
        operations: u64,
    },
    /// The numbers in the kernel are longer than the budget allows.
    #[error("the numbers in the kernel do not settle after {primes} primes")]
    TooManyPrimes {
        /// Number of primes used.
        primes: usize,
    },
    /// Not enough primes split the field.
    #[error("no prime was found that splits the number field, or proves that it is a field")]
    NoPrimes,
    /// The certificate has a flaw, which is a bug.
    #[error("the certificate was rejected: {0}; report this with the file")]
    Rejected(Flaw),
}

/// Cost limits of a certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Maximum number of coordinates of a kernel, f · (f - r) · degree.
    pub coordinates: usize,
    /// Maximum number of primes.
    pub primes: usize,
    /// Maximum number of elementary operations, of a few nanoseconds each.
    pub operations: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            coordinates: 2_000_000,
            primes: 400,
            operations: 2_000_000_000,
        }
    }
}

/// Returns true if pivot columns are worse than others. A prime can only lower the rank and move the pivots to the right.
fn are_worse(columns: &[usize], than: &[usize]) -> bool {
    (than.len(), columns) > (columns.len(), than)
}

/// The reduced matrix modulo a prime under one homomorphism.
struct Image {
    /// Pivot rows.
    rows: Vec<usize>,
    /// Pivot columns.
    columns: Vec<usize>,
    /// Entries of the reduced kernel at the pivots, vector by vector, with ascending pivots.
    entries: Vec<Residue>,
}

/// Results for one prime.
struct Views {
    /// The minor of the pivots.
    minor: Minor,
    /// Coordinates of the kernel's entries at the pivots, entry by entry.
    coordinates: Vec<Residue>,
}

/// A kernel under construction.
#[derive(Debug)]
pub(in crate::rank) struct Kernel<'a> {
    field: &'a NumberField,
    matrix: &'a MatrixOverRing,
    budget: Budget,
    modulus: Modulus,
    found: Option<Minor>,
    unknowns: Vec<Unknown>,
    operations: u64,
}

impl<'a> Kernel<'a> {
    pub(in crate::rank) fn new(
        field: &'a NumberField,
        matrix: &'a MatrixOverRing,
        budget: Budget,
    ) -> Self {
        Kernel {
            field,
            matrix,
            budget,
            modulus: Modulus::default(),
            found: None,
            unknowns: Vec::new(),
            operations: 0,
        }
    }

    /// Adds primes until the kernel stops changing and `confirm` accepts it. `confirm` gets the minor and the vectors,
    /// and returns `None` if they were settled too early.
    pub(in crate::rank) fn find_kernel<T>(
        mut self,
        mut confirm: impl FnMut(Minor, Vec<KernelVector>) -> Result<Option<T>, NoCertificate>,
    ) -> Result<T, NoCertificate> {
        let degree = self.field.ring().dimension();
        let (mut bad, mut attempt) = (0, 1);
        for splitting in self.field.splittings() {
            let f = splitting.field;
            let used = self.modulus.primes();
            if used >= self.budget.primes {
                return Err(NoCertificate::TooManyPrimes { primes: used });
            }
            let views = self.kernel_at_prime(&splitting);
            let worse = |views: &Views| {
                let found = self.found.as_ref();
                found.is_some_and(|m| are_worse(&views.minor.columns, &m.columns))
            };
            let Some(views) = views.filter(|views| !worse(views)) else {
                bad += 1;
                if bad > MAX_BAD_PRIMES {
                    break;
                }
                continue;
            };
            if self
                .found
                .as_ref()
                .is_none_or(|m| m.columns != views.minor.columns)
            {
                // This is the first prime, or all earlier ones were unlucky.
                let free = self.matrix.columns() - views.minor.columns.len();
                let coordinates = [self.matrix.columns(), free, degree]
                    .into_iter()
                    .fold(1, usize::saturating_mul);
                if coordinates > self.budget.coordinates {
                    return Err(NoCertificate::TooLarge { coordinates });
                }
                self.unknowns = vec![Unknown::default(); views.coordinates.len()];
                self.modulus = Modulus::default();
                self.found = Some(views.minor);
                attempt = 1;
            }
            let Some(inverse) = inverse_of(&self.modulus, f) else {
                continue;
            };
            let mut quiet = self.modulus.primes() > 0;
            for (unknown, &residue) in self.unknowns.iter_mut().zip(&views.coordinates) {
                quiet &= unknown.see_residue(f, residue, &self.modulus, inverse);
            }
            self.modulus.extend(f);
            let primes = self.modulus.primes();
            if quiet {
                let vectors = self.current_vectors();
                self.operations += self.cost_of_checking(&vectors);
                self.within_budget()?;
                if let Some(minor) = &self.found
                    && let Some(done) = confirm(minor.clone(), vectors)?
                {
                    return Ok(done);
                }
            } else {
                let open = self
                    .unknowns
                    .iter()
                    .filter(|u| matches!(u, Unknown::Open(_)));
                self.operations += (open.count() * primes) as u64;
            }
            // Reconstruction costs the square of the number of primes, so it is not tried after every prime.
            if primes >= attempt {
                self.settle_numbers()?;
                attempt = primes + 1 + primes / 8;
            }
            self.within_budget()?;
        }
        Err(NoCertificate::NoPrimes)
    }

    fn within_budget(&self) -> Result<(), NoCertificate> {
        let operations = self.operations;
        if operations > self.budget.operations {
            return Err(NoCertificate::TooMuchWork { operations });
        }
        Ok(())
    }

    /// Returns the number of operations in the checker's products of J with the kernel.
    fn cost_of_checking(&self, vectors: &[KernelVector]) -> u64 {
        let products: usize = vectors
            .iter()
            .flat_map(|v| &v.entries)
            .map(|(column, _)| self.matrix.column(*column).len())
            .sum();
        let degree = self.field.ring().dimension();
        // Each takes degree² products of integers, whose length is that of all primes.
        (products * degree * degree * (16 + self.modulus.primes())) as u64
    }

    /// Reconstructs the open numbers, as far as the budget allows.
    fn settle_numbers(&mut self) -> Result<(), NoCertificate> {
        let primes = self.modulus.primes() as u64;
        let pivots = self.found.as_ref().map_or(0, |m| m.columns.len());
        let of_vector = (pivots * self.field.ring().dimension()).max(1);
        let mut failures = 0;
        for vector in self.unknowns.chunks_mut(of_vector) {
            let mut denominator = BigInt::one();
            for unknown in vector {
                self.operations += match unknown.settle_fraction(&self.modulus, &mut denominator) {
                    Settled::Before => 0,
                    Settled::Cheaply => 4 * primes * primes,
                    Settled::Newly => {
                        failures = 0;
                        64 * primes * primes
                    }
                    Settled::NotYet => {
                        failures += 1;
                        64 * primes * primes
                    }
                };
                // The remaining numbers are unlikely to be shorter.
                if failures >= MAX_FAILURES {
                    return Ok(());
                }
            }
            if self.operations > self.budget.operations {
                break;
            }
        }
        self.within_budget()
    }

    /// Returns the pivots and the coordinates of the kernel at a prime. Returns `None` if its homomorphisms disagree,
    /// or if the prime divides a denominator or the discriminant.
    fn kernel_at_prime(&mut self, splitting: &Splitting) -> Option<Views> {
        let (f, ring) = (splitting.field, self.field.ring());
        let mut values: Vec<Vec<Residue>> = Vec::new();
        let mut images: Vec<Image> = Vec::new();
        for homomorphism in &splitting.homomorphisms {
            let monomials = ring.monomials(f, homomorphism);
            let image = self.kernel_image(f, &monomials)?;
            if images
                .first()
                .is_some_and(|first| first.columns != image.columns)
            {
                return None;
            }
            images.push(image);
            values.push(monomials);
        }
        let degree = values.len();
        let inverse = invert_matrix(f, values)?;
        let count = images.first()?.entries.len();
        let mut coordinates = vec![0; count * degree];
        for (i, out) in coordinates.chunks_mut(degree).enumerate() {
            // Most entries are zero.
            if images.iter().all(|image| image.entries[i] == 0) {
                continue;
            }
            for (o, row) in out.iter_mut().zip(&inverse) {
                let terms = images.iter().zip(row);
                *o = f.sum_of_products(terms.map(|(image, &c)| (c, image.entries[i])));
            }
        }
        let (rank, columns) = (images[0].columns.len(), self.matrix.columns());
        self.operations += (degree * (self.matrix.rows() * rank * columns + count * degree)) as u64;
        let plain = |r: &Residue| f.to_u64(*r);
        let first = images.swap_remove(0);
        Some(Views {
            minor: Minor {
                prime: f.modulus(),
                images: splitting.homomorphisms[0].iter().map(plain).collect(),
                rows: first.rows,
                columns: first.columns,
            },
            coordinates,
        })
    }

    /// Returns the reduced kernel under one homomorphism.
    fn kernel_image(&self, f: Field, monomials: &[Residue]) -> Option<Image> {
        let width = self.matrix.columns();
        let mut rows = vec![vec![f.zero(); width]; self.matrix.rows()];
        for (row, column, entry) in self.matrix.entries() {
            rows[row][column] = entry.image_in(f, monomials)?;
        }
        let mut echelon = Echelon::new(f);
        let independent: Vec<usize> = (0..rows.len())
            .filter(|&r| echelon.insert(&rows[r]))
            .collect();
        let reduced = echelon.reduced_rows();
        let columns = echelon.pivots();
        let entries = free_columns(&columns, width)
            .flat_map(|free| reduced.iter().map(move |row| f.neg(row[free])))
            .collect();
        Some(Image {
            rows: independent,
            columns,
            entries,
        })
    }

    /// Returns the vectors in their current state.
    fn current_vectors(&self) -> Vec<KernelVector> {
        let Some(minor) = &self.found else {
            return Vec::new();
        };
        let degree = self.field.ring().dimension();
        let value = |u: &Unknown| match u {
            Unknown::Settled(q) => q.clone(),
            Unknown::Open(_) => BigRational::default(),
        };
        let mut elements = self
            .unknowns
            .chunks(degree)
            .map(|c| Element::new(c.iter().map(value).collect()));
        free_columns(&minor.columns, self.matrix.columns())
            .map(|free| {
                let mut entries: Vec<(usize, Element)> = minor
                    .columns
                    .iter()
                    .copied()
                    .zip(elements.by_ref())
                    .filter(|(_, x)| !x.is_zero())
                    .collect();
                let at = entries.partition_point(|(c, _)| *c < free);
                entries.insert(at, (free, Element::from_integer(1)));
                KernelVector { free, entries }
            })
            .collect()
    }
}

fn free_columns(pivots: &[usize], width: usize) -> impl Iterator<Item = usize> {
    (0..width).filter(move |c| pivots.binary_search(c).is_err())
}

/// Inverts a square matrix, in O(n³). Returns `None` if it is singular.
fn invert_matrix(f: Field, m: Vec<Vec<Residue>>) -> Option<Vec<Vec<Residue>>> {
    let size = m.len();
    let beside_unit = m.into_iter().enumerate().map(|(i, mut row)| {
        row.resize(2 * size, f.zero());
        row[size + i] = f.one();
        row
    });
    let span = Echelon::from_vectors(f, beside_unit);
    let regular = span.pivots().into_iter().eq(0..size);
    let rows = span.reduced_rows().into_iter();
    regular.then(|| rows.map(|row| row[size..].to_vec()).collect())
}
