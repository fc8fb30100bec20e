//! Certificates of rank: made here, checked by [`crate::verify`].
//!
//! ```
//! use ozols::file::text::mechanism_from_str;
//! use ozols::model::mechanism::StateId;
//! use ozols::rank::exact::certificate::{certify_state, closure_matrix, number_field};
//! use ozols::verify;
//!
//! let text = ozols::builtin::text("gripper-10").expect("it is built in");
//! let gripper = mechanism_from_str("gripper-10.toml", text)?;
//! let certificate = certify_state(&gripper, StateId::FREE)?;
//!
//! // Whoever doubts it needs only the file and the certificate.
//! let field = number_field(&gripper, StateId::FREE)?;
//! let j = closure_matrix(&field, &gripper, StateId::FREE)?;
//! assert_eq!(verify::check_certificate(&j, &certificate)?, 13);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::closure::Closure;
use crate::geom::exact::ExactError;
use crate::geom::number_field::{NumberField, NumberFieldError};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::expressions_in;
use crate::rank::exact::kernel::Kernel;
pub use crate::rank::exact::kernel::{Budget, NoCertificate};
pub use crate::verify::certificate::Certificate;
use crate::verify::certificate::{FieldClaim, Witness};
use crate::verify::matrix::MatrixOverRing;
use crate::verify::{self, Flaw};

/// Returns the number field of the joints present in a state.
///
/// # Errors
/// Returns an error if the roots and angles of these joints have no number field that is small enough.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::certificate::number_field};
/// // The gripper's coordinates are rational.
/// let field = number_field(&ozols::built_in("gripper-10")?, StateId::FREE)?;
/// assert_eq!(field.ring().dimension(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn number_field(
    mechanism: &Mechanism,
    state: StateId,
) -> Result<NumberField, NumberFieldError> {
    NumberField::for_expressions(&expressions_in(mechanism, state))
}

/// Returns J of a state over its number field, the matrix that a certificate is checked against.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(entries) operations in the field.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::certificate::{closure_matrix, number_field}};
/// let bennett = ozols::built_in("bennett")?;
/// let field = number_field(&bennett, StateId::FREE)?;
/// let j = closure_matrix(&field, &bennett, StateId::FREE)?;
/// assert_eq!((j.rows(), j.columns()), (6, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn closure_matrix(
    field: &NumberField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<MatrixOverRing, ExactError> {
    let closure = Closure::new(field, mechanism, state)?;
    let columns = closure.dense_columns(field);
    let size = [closure.rows(), columns.len()];
    let entries = columns.into_iter().enumerate().flat_map(|(c, column)| {
        column
            .into_iter()
            .enumerate()
            .map(move |(r, number)| (r, c, number))
    });
    MatrixOverRing::new(field.ring().clone(), field.cosine_order(), size, entries).ok_or_else(
        || ExactError::NotInField {
            expression: "an entry of the matrix".to_owned(),
        },
    )
}

/// Returns a certificate of the rank of a state's J, confirmed by [`verify::check_certificate`].
///
/// # Errors
/// Returns a [`NoCertificate`] if there is none within the [`Budget`].
///
/// # Complexity
/// As [`certify_matrix`].
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::certificate::certify_state};
/// let certificate = certify_state(&ozols::built_in("bennett")?, StateId::FREE)?;
/// assert_eq!((certificate.rank, certificate.columns), (3, 4)); // So W = 1.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify_state(mechanism: &Mechanism, state: StateId) -> Result<Certificate, NoCertificate> {
    certify_within(mechanism, state, Budget::default())
}

/// Works as [`certify`], within a budget.
///
/// # Errors
/// Returns a [`NoCertificate`] if there is none within the budget.
///
/// # Complexity
/// As [`certify_matrix`].
pub(crate) fn certify_within(
    mechanism: &Mechanism,
    state: StateId,
    budget: Budget,
) -> Result<Certificate, NoCertificate> {
    let field = number_field(mechanism, state)?;
    let matrix = closure_matrix(&field, mechanism, state)?;
    certify_matrix(&field, &matrix, &mechanism.states[state], budget)
}

/// Returns a certificate of the rank of a matrix over a number field.
///
/// # Errors
/// Returns a [`NoCertificate`] if there is none within the budget.
///
/// # Complexity
/// The degree of the field is d. Each prime takes O(d · rows · rank · columns + d² · kernel entries) operations modulo
/// it. There are about two primes for each 60 bits of the kernel's numbers. Then as [`verify::check_certificate`].
pub fn certify_matrix(
    field: &NumberField,
    matrix: &MatrixOverRing,
    state: &str,
    budget: Budget,
) -> Result<Certificate, NoCertificate> {
    let ring = field.ring();
    let witnesses = field.witnesses().ok_or(NoCertificate::NoPrimes)?;
    let field_claim = FieldClaim {
        cosine_order: field.cosine_order(),
        relations: (0..ring.generators())
            .map(|g| ring.relation(g).to_vec())
            .collect(),
        witnesses: witnesses
            .into_iter()
            .map(|(prime, images)| Witness { prime, images })
            .collect(),
    };
    Kernel::new(field, matrix, budget).find_kernel(|minor, kernel| {
        let certificate = Certificate {
            state: state.to_owned(),
            rows: matrix.rows(),
            columns: matrix.columns(),
            rank: minor.columns.len(),
            field: field_claim.clone(),
            minor,
            kernel,
        };
        match verify::check_certificate(matrix, &certificate) {
            Ok(_) => Ok(Some(certificate)),
            // Some numbers were settled too early.
            Err(Flaw::NotInKernel { .. }) => Ok(None),
            Err(flaw) => Err(NoCertificate::Rejected(flaw)),
        }
    })
}
