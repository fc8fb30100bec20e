//! What can be wrong with expressions that an exact field is asked for.

/// Why expressions have no image in a prime field.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactError {
    /// A nested root lies in the field already, and its sign could not be settled.
    #[error(
        "the nested root sqrt({radicand}) depends on the other roots and angles in a way that is not resolved exactly; \
         write it without nesting, or give a decimal"
    )]
    AmbiguousNestedRoot {
        /// What stands under the root.
        radicand: String,
    },
    /// A divisor is zero.
    #[error("`{expression}` divides by zero; correct the divisor")]
    DivisionByZero {
        /// The expression.
        expression: String,
    },
    /// A radicand could not be factored.
    #[error(
        "the number under sqrt({radicand}) is too large to factor; write it with fewer digits, or give a decimal"
    )]
    RadicandTooLarge {
        /// What stands under the root.
        radicand: String,
    },
    /// The angles have no small common denominator.
    #[error("the angles have no common denominator below 2^44; round them to fewer decimals")]
    AnglesTooFine,
    /// Too many independent square roots.
    #[error(
        "{count} independent square roots exceed the limit of {limit}; give some of them as decimals"
    )]
    TooManyRoots {
        /// How many there are.
        count: usize,
        /// How many may be.
        limit: usize,
    },
    /// No more primes of the size wanted.
    #[error(
        "no suitable prime number {nth} below 2^62; ask for fewer, or simplify roots and angles"
    )]
    NoPrime {
        /// Which prime was asked for.
        nth: usize,
    },
    /// The expression was not among those the field was made for.
    #[error(
        "`{expression}` lies outside the field; include it among the expressions the field is made for"
    )]
    NotInField {
        /// The expression.
        expression: String,
    },
}
