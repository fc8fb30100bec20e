//! What is wrong with a certificate.

use thiserror::Error;

/// Why a certificate does not prove its rank.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Flaw {
    /// It is about a matrix of another size.
    #[error(
        "it is about a {} x {} matrix, and this one is {} x {}", claimed[0], claimed[1], actual[0], actual[1]
    )]
    Shape {
        /// Rows and columns it states.
        claimed: [usize; 2],
        /// Rows and columns there are.
        actual: [usize; 2],
    },
    /// The rank exceeds the matrix.
    #[error("rank {rank} exceeds the size of the matrix")]
    RankTooLarge {
        /// The rank it states.
        rank: usize,
    },
    /// It is about another number field.
    #[error("its number field is not that of the matrix")]
    FieldDiffers,
    /// A generator is not shown to generate a field.
    #[error("generator {generator} is not shown to give a field: {why}")]
    NotAField {
        /// Position of the generator.
        generator: usize,
        /// What is missing.
        why: &'static str,
    },
    /// The modulus is no prime.
    #[error("{modulus} is not a prime between 3 and 2^63")]
    NotPrime {
        /// The modulus.
        modulus: u64,
    },
    /// The wrong number of images, or images that are not residues.
    #[error("{given} images of generators modulo {prime} do not fit the {wanted} of the field")]
    Images {
        /// The prime.
        prime: u64,
        /// Images needed.
        wanted: usize,
        /// Images given.
        given: usize,
    },
    /// The images do not satisfy a relation of the field.
    #[error("the image of generator {generator} modulo {prime} does not satisfy its relation")]
    Relation {
        /// The prime.
        prime: u64,
        /// Position of the generator.
        generator: usize,
    },
    /// A number has no image.
    #[error("a denominator is divisible by {prime}")]
    Denominator {
        /// The prime.
        prime: u64,
    },
    /// The number of pivots is not the rank.
    #[error("{rows} pivot rows and {columns} pivot columns do not show rank {rank}")]
    PivotCount {
        /// The rank it states.
        rank: usize,
        /// Pivot rows given.
        rows: usize,
        /// Pivot columns given.
        columns: usize,
    },
    /// Pivots repeat or lie outside the matrix.
    #[error("pivot rows or columns repeat or lie outside the matrix")]
    PivotIndices,
    /// The minor is zero.
    #[error("the minor vanishes modulo {prime}")]
    MinorVanishes {
        /// The prime.
        prime: u64,
    },
    /// The number of kernel vectors is not what the rank asks for.
    #[error("{given} kernel vectors are given where {wanted} are needed")]
    KernelCount {
        /// Vectors needed.
        wanted: usize,
        /// Vectors given.
        given: usize,
    },
    /// The free columns are not those without a pivot.
    #[error("the free columns of the kernel are not the columns without a pivot, each once")]
    FreeColumns,
    /// A kernel vector has entries twice or outside the matrix.
    #[error("kernel vector {vector} has entries that repeat or lie outside the matrix")]
    KernelIndices {
        /// Position of the vector.
        vector: usize,
    },
    /// A kernel vector has a number with more coordinates than the field.
    #[error("kernel vector {vector} has a number outside the field")]
    KernelNumber {
        /// Position of the vector.
        vector: usize,
    },
    /// A kernel vector is not 1 in its free column and 0 in the others.
    #[error("kernel vector {vector} is not 1 in its own free column and 0 in the others")]
    NotReduced {
        /// Position of the vector.
        vector: usize,
    },
    /// A kernel vector is none.
    #[error("row {row} of the matrix times kernel vector {vector} is not zero")]
    NotInKernel {
        /// Position of the vector.
        vector: usize,
        /// The row.
        row: usize,
    },
}
