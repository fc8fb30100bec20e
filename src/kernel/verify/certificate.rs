//! Certificates as data for JSON files. Numbers are written as strings.

use crate::linalg::number_ring::Element;
use num_rational::BigRational;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use thiserror::Error;

/// The format name at the start of a file of certificates.
pub const FORMAT: &str = "ozols-certificate-1";

/// A file of certificates of one mechanism.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertificateFile {
    /// [`FORMAT`].
    pub format: String,
    /// Name of the mechanism.
    pub mechanism: String,
    /// The certificates, one for each state that has one.
    pub certificates: Vec<Certificate>,
    /// The states without a certificate.
    pub without: Vec<Without>,
}

/// A state without a certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Without {
    /// Name of the state.
    pub state: String,
    /// The reason.
    pub reason: String,
}

/// Reason why a text is not a file of certificates.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The text has the wrong form.
    #[error("not a file of certificates: {0}")]
    Json(#[from] serde_json::Error),
    /// The file has another format.
    #[error("not a file of certificates: its format is `{format}`, not `ozols-certificate-1`")]
    Format {
        /// The stated format.
        format: String,
    },
}

impl CertificateFile {
    /// Reads a file of certificates. Its claims have to be confirmed by [`super::check_certificate`]. O(length).
    ///
    /// # Errors
    /// Returns an error if the text is not such a file.
    ///
    /// # Examples
    /// ```
    /// use ozols::verify::certificate::CertificateFile;
    /// assert!(CertificateFile::read(b"{}").is_err());
    /// let text = br#"{"format": "ozols-certificate-1", "mechanism": "m", "certificates": [], "without": []}"#;
    /// assert_eq!(CertificateFile::read(text)?.mechanism, "m");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(json: &[u8]) -> Result<CertificateFile, ReadError> {
        let file: CertificateFile = serde_json::from_slice(json)?;
        if file.format == FORMAT {
            Ok(file)
        } else {
            Err(ReadError::Format {
                format: file.format,
            })
        }
    }
}

/// Reason why a certificate does not prove its rank.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Flaw {
    /// Its numbers are not those of a certificate of the matrix.
    #[error("{0}")]
    Malformed(String),
    /// A generator is not shown to generate a field.
    #[error("generator {generator} is not shown to give a field: {why}")]
    NotAField {
        /// Position of the generator.
        generator: usize,
        /// The missing evidence.
        why: &'static str,
    },
    /// A number has no image.
    #[error("a denominator is divisible by {prime}")]
    Denominator {
        /// The prime.
        prime: u64,
    },
    /// The minor is zero.
    #[error("the minor vanishes modulo {prime}")]
    MinorVanishes {
        /// The prime.
        prime: u64,
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

/// A proof that a matrix has a rank; see [`super`] for its meaning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Name of the state the matrix belongs to.
    pub state: String,
    /// Rows of the matrix.
    pub rows: usize,
    /// Columns of the matrix.
    pub columns: usize,
    /// The rank.
    pub rank: usize,
    /// The number field.
    pub field: FieldClaim,
    /// A minor whose size is a lower bound of the rank.
    pub minor: Minor,
    /// Kernel vectors. The number of columns less their number is an upper bound of the rank.
    pub kernel: Vec<KernelVector>,
}

/// A number field: the rationals, 2 cos(2π/N), and square roots.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FieldClaim {
    /// N if the first generator is 2 cos(2π/N).
    pub cosine_order: Option<u64>,
    /// The monic relation of each generator over those before it, lowest coefficient first, without the leading 1.
    pub relations: Vec<Vec<Element>>,
    /// For each generator except a cosine, evidence that its relation has no root yet.
    pub witnesses: Vec<Witness>,
}

/// A prime modulo which a radicand is not a square.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Witness {
    /// The prime.
    #[serde(with = "word")]
    pub prime: u64,
    /// Images of the generators before the root.
    #[serde(with = "words")]
    pub images: Vec<u64>,
}

/// A minor that does not vanish modulo a prime.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Minor {
    /// The prime.
    #[serde(with = "word")]
    pub prime: u64,
    /// Images of the generators of the field.
    #[serde(with = "words")]
    pub images: Vec<u64>,
    /// Pivot rows.
    pub rows: Vec<usize>,
    /// Pivot columns.
    pub columns: Vec<usize>,
}

/// A vector that the matrix sends to zero.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelVector {
    /// The column in which it is 1 and all others are 0.
    pub free: usize,
    /// Its nonzero entries by column.
    pub entries: Vec<(usize, Element)>,
}

impl Serialize for Element {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.coordinates().iter().map(ToString::to_string))
    }
}

impl<'de> Deserialize<'de> for Element {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Element, D::Error> {
        let texts = Vec::<String>::deserialize(from)?;
        let number = |text: &String| {
            text.parse::<BigRational>()
                .map_err(|_| D::Error::custom(format!("`{text}` is not a rational number")))
        };
        Ok(Element::new(
            texts.iter().map(number).collect::<Result<_, _>>()?,
        ))
    }
}

/// Writes a 64-bit number as a string, because many readers treat JSON numbers as doubles.
mod word {
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(x: &u64, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(x)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
        let text = String::deserialize(from)?;
        text.parse()
            .map_err(|_| D::Error::custom(format!("`{text}` is not a whole number below 2^64")))
    }
}

mod words {
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(x: &[u64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(x.iter().map(ToString::to_string))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<u64>, D::Error> {
        let number = |text: &String| {
            text.parse()
                .map_err(|_| D::Error::custom(format!("`{text}` is not a whole number below 2^64")))
        };
        Vec::<String>::deserialize(from)?
            .iter()
            .map(number)
            .collect()
    }
}
