//! Comma-separated values as RFC 4180 has them, with bare line feeds.

use serde::Serialize;

/// A table with the heads of its columns, as text. What is too long to be held as a whole is written row by row with
/// [`csv::Writer`], whose defaults these are.
pub(crate) fn table<Row, Cell>(heads: &[&str], rows: impl IntoIterator<Item = Row>) -> String
where
    Row: IntoIterator<Item = Cell>,
    Cell: AsRef<[u8]>,
{
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut written = out.write_record(heads);
    for row in rows {
        written = written.and_then(|()| out.write_record(row));
    }
    text(written, out)
}

/// A table of one row a value, under the names of its fields. Figures are to be text already: how many digits they have is
/// not for this to say.
pub(crate) fn records<Row: Serialize>(rows: impl IntoIterator<Item = Row>) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut written = Ok(());
    for row in rows {
        written = written.and_then(|()| out.serialize(row));
    }
    text(written, out)
}

fn text(written: csv::Result<()>, out: csv::Writer<Vec<u8>>) -> String {
    written.expect("memory takes rows of plain cells, as many in each");
    let bytes = out.into_inner().expect("memory needs no flushing");
    String::from_utf8(bytes).expect("cells are text")
}

#[cfg(test)]
mod tests {
    use super::table;

    #[test]
    fn cells_with_commas_quotes_and_line_ends_are_quoted() {
        let rows = [["1,5", "say \"x\""], ["", "two\nlines"]];
        assert_eq!(
            table(&["a", "b"], rows),
            "a,b\n\"1,5\",\"say \"\"x\"\"\"\n,\"two\nlines\"\n"
        );
    }
}
