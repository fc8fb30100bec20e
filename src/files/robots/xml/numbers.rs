//! Numbers of attributes and texts.

use crate::file::problem::ImportError;
use crate::geom::vector::Vector;
use crate::robots::problem::bad_value;
use crate::robots::xml::Element;

/// Largest size of a number; the mechanism file takes lengths up to 1e12.
const MAX_NUMBER: f64 = 1e9;

impl Element<'_> {
    /// N numbers of an attribute, if it is there.
    pub(crate) fn numbers<const N: usize>(
        self,
        name: &str,
    ) -> Result<Option<[f64; N]>, ImportError> {
        self.attribute(name)
            .map(|text| self.parse_numbers(name, text))
            .transpose()
    }

    /// A vector attribute, or what is there without it.
    pub(crate) fn vector(self, name: &str, default: Vector) -> Result<Vector, ImportError> {
        Ok(self.numbers::<3>(name)?.unwrap_or(default))
    }

    /// N numbers of the element's text.
    pub(crate) fn text_numbers<const N: usize>(self) -> Result<[f64; N], ImportError> {
        self.parse_numbers("the text", self.text())
    }

    fn parse_numbers<const N: usize>(
        self,
        what: &str,
        text: &str,
    ) -> Result<[f64; N], ImportError> {
        let bad = || {
            let want = match N {
                _ if text.contains("${") => "expand the macros first, with `xacro FILE`".to_owned(),
                1 => "write one finite number up to 1e9 in size".to_owned(),
                n => format!("write {n} finite numbers up to 1e9 in size, with spaces between"),
            };
            let found: String = text.chars().take(60).collect();
            self.fail(Some(what), bad_value(&self.label(), what, &found, &want))
        };
        let mut out = [0.0; N];
        let mut words = text.split_whitespace();
        for x in &mut out {
            *x = words
                .next()
                .and_then(|w| w.parse::<f64>().ok())
                .filter(|x| x.abs() <= MAX_NUMBER)
                .ok_or_else(bad)?;
        }
        if words.next().is_some() {
            return Err(bad());
        }
        Ok(out)
    }
}
