//! Comma-separated values as RFC 4180 has them, with bare line feeds.

/// A table under construction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Csv(String);

impl Csv {
    /// With the heads of its columns.
    #[must_use]
    pub fn new(heads: &[&str]) -> Csv {
        let mut out = Csv(String::new());
        out.row(&heads.iter().map(|h| (*h).to_owned()).collect::<Vec<_>>());
        out
    }

    /// Adds a row.
    pub fn row(&mut self, cells: &[String]) {
        for (n, cell) in cells.iter().enumerate() {
            if n > 0 {
                self.0.push(',');
            }
            if cell.contains([',', '"', '\n', '\r']) {
                self.0.push('"');
                self.0.push_str(&cell.replace('"', "\"\""));
                self.0.push('"');
            } else {
                self.0.push_str(cell);
            }
        }
        self.0.push('\n');
    }

    /// The text.
    #[must_use]
    pub fn finish(self) -> String {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Csv;

    #[test]
    fn cells_with_commas_and_quotes_are_quoted() {
        let mut csv = Csv::new(&["a", "b"]);
        csv.row(&["1,5".to_owned(), "say \"x\"".to_owned()]);
        assert_eq!(csv.finish(), "a,b\n\"1,5\",\"say \"\"x\"\"\"\n");
    }
}
