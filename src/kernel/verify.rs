//! Checks a certificate of rank by slow, simple means that share nothing with how it was found.
//!
//! A certificate that J has rank r over a real number field K shows three things:
//! - K is a field: its first generator is 2 cos(2π/N), whose minimal polynomial is recomputed here. Each later one is
//!   the root of a number that is not a square, which a prime shows.
//! - The rank is at least r. Under a ring homomorphism into a prime field, a minor of size r does not vanish.
//! - The rank is at most r. There are f - r vectors with J v = 0 exactly, each 1 in a column in which all others are 0.

pub mod certificate;
mod field;
pub mod matrix;
mod modular;

pub use certificate::Flaw;

use num_bigint::BigInt;
use num_traits::Zero;

use crate::linalg::common_denominator;
use crate::linalg::number_ring::{Element, combine_integers};
use certificate::{Certificate, KernelVector};
use matrix::MatrixOverRing;
use modular::Homomorphism;

/// Confirms that a matrix has the rank its certificate claims.
///
/// # Errors
/// Returns the first [`Flaw`] found.
///
/// # Complexity
/// O(r³) operations modulo the prime and O(entries · (f - r)) products in the ring.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::certificate, verify::check_certificate};
/// let bennett = ozols::built_in("bennett")?;
/// let field = certificate::number_field(&bennett, StateId::FREE)?;
/// let j = certificate::closure_matrix(&field, &bennett, StateId::FREE)?;
/// let mut claim = certificate::certify_state(&bennett, StateId::FREE)?;
/// assert_eq!(check_certificate(&j, &claim)?, 3);
/// claim.rank = 4;
/// assert!(check_certificate(&j, &claim).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check_certificate(
    matrix: &MatrixOverRing,
    certificate: &Certificate,
) -> Result<usize, Flaw> {
    let (rows, columns, rank) = (certificate.rows, certificate.columns, certificate.rank);
    if (rows, columns) != (matrix.rows(), matrix.columns()) {
        return malformed(format!(
            "it is for a {rows} x {columns} matrix, but this one is {} x {}",
            matrix.rows(),
            matrix.columns()
        ));
    }
    if rank > rows.min(columns) {
        return malformed(format!("rank {rank} exceeds the size of the matrix"));
    }
    field::check_field(matrix, &certificate.field)?;
    at_least(matrix, certificate)?;
    at_most(matrix, certificate)?;
    Ok(rank)
}

fn malformed<T>(why: impl Into<String>) -> Result<T, Flaw> {
    Err(Flaw::Malformed(why.into()))
}

/// Returns true if every index is below a bound and none is repeated.
fn are_distinct(indices: &[usize], bound: usize) -> bool {
    let mut seen = vec![false; bound];
    indices
        .iter()
        .all(|&i| i < bound && !std::mem::replace(&mut seen[i], true))
}

fn at_least(matrix: &MatrixOverRing, certificate: &Certificate) -> Result<(), Flaw> {
    let (rank, minor) = (certificate.rank, &certificate.minor);
    if minor.rows.len() != rank || minor.columns.len() != rank {
        let (rows, columns) = (minor.rows.len(), minor.columns.len());
        return malformed(format!(
            "{rows} pivot rows and {columns} pivot columns do not show rank {rank}"
        ));
    }
    if !are_distinct(&minor.rows, matrix.rows()) || !are_distinct(&minor.columns, matrix.columns())
    {
        return malformed("pivot rows or columns repeat or lie outside the matrix");
    }
    let images = Homomorphism::new(minor.prime, &minor.images, matrix.ring())?;
    images.satisfies_relation(matrix.ring(), matrix.ring().generators())?;
    let mut square = vec![vec![0; rank]; rank];
    for (i, &row) in minor.rows.iter().enumerate() {
        for (j, &column) in minor.columns.iter().enumerate() {
            if let Some(entry) = matrix.entry(row, column) {
                square[i][j] = images.image_of(entry)?;
            }
        }
    }
    if modular::is_singular(square, minor.prime) {
        return Err(Flaw::MinorVanishes { prime: minor.prime });
    }
    Ok(())
}

fn at_most(matrix: &MatrixOverRing, certificate: &Certificate) -> Result<(), Flaw> {
    let kernel = &certificate.kernel;
    if kernel.len() != matrix.columns() - certificate.rank {
        let (given, wanted) = (kernel.len(), matrix.columns() - certificate.rank);
        return malformed(format!(
            "{given} kernel vectors are given, but {wanted} are needed"
        ));
    }
    // Pivot columns and free columns together are all columns.
    let mut all: Vec<usize> = kernel.iter().map(|v| v.free).collect();
    all.extend(&certificate.minor.columns);
    if !are_distinct(&all, matrix.columns()) {
        return malformed(
            "the free columns of the kernel are not the columns without a pivot, each once",
        );
    }
    let mut free = vec![false; matrix.columns()];
    kernel.iter().for_each(|v| free[v.free] = true);
    let (ring, one) = (matrix.ring(), Element::from_integer(1));
    let integral = matrix.integral_rows();
    for (i, vector) in kernel.iter().enumerate() {
        let support: Vec<usize> = vector.entries.iter().map(|(c, _)| *c).collect();
        if !are_distinct(&support, matrix.columns()) {
            return malformed(format!(
                "kernel vector {i} has entries that repeat or lie outside the matrix"
            ));
        }
        if !vector.entries.iter().all(|(_, x)| ring.contains(x)) {
            return malformed(format!("kernel vector {i} has a number outside the field"));
        }
        let reduced = vector.entries.iter().all(|(c, x)| {
            !free[*c]
                || if *c == vector.free {
                    *x == one
                } else {
                    x.is_zero()
                }
        });
        if !reduced || !support.contains(&vector.free) {
            return malformed(format!(
                "kernel vector {i} is not 1 in its own free column and 0 in the others"
            ));
        }
        if let Some(row) = not_annihilated(matrix, &integral, vector) {
            return Err(Flaw::NotInKernel { vector: i, row });
        }
    }
    Ok(())
}

/// Returns the first row that does not give 0 with a vector. It uses integers, because a multiple of either changes
/// nothing, and no fraction has to be reduced.
fn not_annihilated(
    matrix: &MatrixOverRing,
    integral: &[Vec<Vec<BigInt>>],
    vector: &KernelVector,
) -> Option<usize> {
    let entries = vector.entries.iter();
    let below = common_denominator(entries.flat_map(|(_, x)| x.coordinates()));
    let mut sums: Vec<Vec<BigInt>> = vec![Vec::new(); matrix.rows()];
    for (column, x) in &vector.entries {
        let x = x.integral_coordinates(&below);
        for ((row, _), entry) in matrix.column(*column).iter().zip(&integral[*column]) {
            let product = matrix.ring().integral_product(entry, &x);
            combine_integers(&mut sums[*row], product, |s, p| *s += p);
        }
    }
    sums.iter().position(|s| !s.iter().all(Zero::is_zero))
}
