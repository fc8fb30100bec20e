//! Comma-separated values as in RFC 4180, with bare line feeds.

use serde::Serialize;
use std::borrow::Cow;

/// Returns a cell that no spreadsheet interprets as a formula. Words that begin like one get an apostrophe before them,
/// numbers stay unchanged.
pub(crate) fn safe_cell(text: &str) -> Cow<'_, str> {
    let formula = text.len() > 1 && text.starts_with(['=', '+', '-', '@']);
    if formula && text.parse::<f64>().is_err() {
        return Cow::Owned(format!("'{text}"));
    }
    Cow::Borrowed(text)
}

/// Returns a `cell` encoded for a line, quoted if necessary, for lines that are assembled separately.
pub fn encode_cell(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let mut line = write_table::<[&str; 1], &str>(&[text], []);
    line.pop();
    line
}

/// Returns a table with column heads, as text. Tables too long to hold in memory are written row by row with
/// [`encode_cell`] cells.
pub fn write_table<Row, Cell>(heads: &[&str], rows: impl IntoIterator<Item = Row>) -> String
where
    Row: IntoIterator<Item = Cell>,
    Cell: AsRef<str>,
{
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut written = out.write_record(heads.iter().map(|h| safe_cell(h).into_owned()));
    for row in rows {
        let cells = row.into_iter().map(|c| safe_cell(c.as_ref()).into_owned());
        written = written.and_then(|()| out.write_record(cells));
    }
    into_text(written, out)
}

/// Returns a table of one row per value, with the field names as heads. Figures must be text already, because their
/// number of digits is not decided here.
pub fn write_records<Row: Serialize>(rows: impl IntoIterator<Item = Row>) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut written = Ok(());
    for row in rows {
        written = written.and_then(|()| out.serialize(row));
    }
    into_text(written, out)
}

fn into_text(written: csv::Result<()>, out: csv::Writer<Vec<u8>>) -> String {
    written.expect("memory takes rows of plain cells, as many in each");
    let bytes = out.into_inner().expect("memory needs no flushing");
    String::from_utf8(bytes).expect("cells are text")
}

#[cfg(test)]
mod tests {
    use super::{encode_cell, write_table};

    #[test]
    fn no_word_is_taken_for_a_formula() {
        let rows = [
            ["=HYPERLINK(1)", "-1.5e-3"],
            ["@a", "-"],
            ["+b", "-inf"],
            ["-c", "x=1"],
        ];
        assert_eq!(
            write_table(&["=a", "b"], rows),
            "'=a,b\n'=HYPERLINK(1),-1.5e-3\n'@a,-\n'+b,-inf\n'-c,x=1\n"
        );
    }

    #[test]
    fn a_line_of_encoded_cells_is_that_of_a_table() {
        let cells = ["1,5", "", "=a", "say \"x\"", "plain", "two\nlines", "-1"];
        let line = cells.map(encode_cell).join(",") + "\n";
        assert_eq!(line, write_table::<[&str; 0], &str>(&cells, []));
    }

    #[test]
    fn cells_with_commas_quotes_and_line_ends_are_quoted() {
        let rows = [["1,5", "say \"x\""], ["", "two\nlines"]];
        assert_eq!(
            write_table(&["a", "b"], rows),
            "a,b\n\"1,5\",\"say \"\"x\"\"\"\n,\"two\nlines\"\n"
        );
    }
}
