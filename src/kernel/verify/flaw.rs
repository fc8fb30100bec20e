//! Flaws of certificates.

use thiserror::Error;

/// Reason why a certificate does not prove its rank.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Flaw {
    /// It is for a matrix of another size.
    #[error(
        "it is for a {} x {} matrix, but this one is {} x {}", claimed[0], claimed[1], actual[0], actual[1]
    )]
    Shape {
        /// Stated rows and columns.
        claimed: [usize; 2],
        /// Actual rows and columns.
        actual: [usize; 2],
    },
    /// The rank exceeds the matrix.
    #[error("rank {rank} exceeds the size of the matrix")]
    RankTooLarge {
        /// The stated rank.
        rank: usize,
    },
    /// It is for another number field.
    #[error("its number field is not that of the matrix")]
    FieldDiffers,
    /// A generator is not shown to generate a field.
    #[error("generator {generator} is not shown to give a field: {why}")]
    NotAField {
        /// Position of the generator.
        generator: usize,
        /// The missing evidence.
        why: &'static str,
    },
    /// The modulus is not a prime.
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
        /// Number of images required.
        wanted: usize,
        /// Number of images given.
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
    /// The number of pivots differs from the rank.
    #[error("{rows} pivot rows and {columns} pivot columns do not show rank {rank}")]
    PivotCount {
        /// The stated rank.
        rank: usize,
        /// Number of pivot rows given.
        rows: usize,
        /// Number of pivot columns given.
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
    /// The number of kernel vectors does not match the rank.
    #[error("{given} kernel vectors are given, but {wanted} are needed")]
    KernelCount {
        /// Number of vectors required.
        wanted: usize,
        /// Number of vectors given.
        given: usize,
    },
    /// The free columns are not those without a pivot.
    #[error("the free columns of the kernel are not the columns without a pivot, each once")]
    FreeColumns,
    /// A kernel vector has repeated entries or entries outside the matrix.
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
    /// A vector is not in the kernel.
    #[error("row {row} of the matrix times kernel vector {vector} is not zero")]
    NotInKernel {
        /// Position of the vector.
        vector: usize,
        /// The row.
        row: usize,
    },
}
