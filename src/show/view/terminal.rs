//! Common parts of texts for people: tables that fit the terminal, prefixes of units, next commands.

use comfy_table::{ColumnConstraint, ContentArrangement, TableComponent, Width, presets};
use console::measure_text_width;
use itertools::Itertools;
use std::fmt::Display;

pub mod next_commands;

/// A text for people: lines and tables, fitted to a terminal of some width if one is given.
#[derive(Debug)]
pub(crate) struct Report {
    text: String,
    width: Option<u16>,
}

impl Report {
    pub(crate) fn new(width: Option<u16>) -> Report {
        let text = String::new();
        Report { text, width }
    }

    /// Adds a line, or a paragraph of several.
    pub(crate) fn add_line(&mut self, line: impl AsRef<str>) {
        self.text += line.as_ref();
        self.text.push('\n');
    }

    /// Adds a table.
    pub(crate) fn add_table(&mut self, heads: &str, rows: impl IntoIterator<Item = Vec<String>>) {
        self.add_line(text_table(heads, rows, self.width));
    }

    /// Adds a table, if there is one, after an empty line.
    pub(crate) fn add_part(&mut self, table: Option<Table>) {
        if let Some(Table { heads, rows }) = table {
            self.add_line("");
            self.add_table(&heads, rows);
        }
    }

    /// Returns the text; lines that are too long are broken between words.
    pub(crate) fn text(self) -> String {
        fit_lines(&self.text, self.width)
    }
}

/// A table for texts and pages.
#[derive(Debug)]
pub(crate) struct Table {
    /// The heads, separated by ` | `.
    pub(crate) heads: String,
    /// The rows.
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    /// Creates a table of at least one row.
    pub(crate) fn from_rows(
        heads: impl Into<String>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Option<Table> {
        let rows: Vec<Vec<String>> = rows.into_iter().collect();
        let heads = heads.into();
        (!rows.is_empty()).then_some(Table { heads, rows })
    }
}

/// Returns a row of a table.
pub fn row_cells<const N: usize>(of: [&dyn Display; N]) -> Vec<String> {
    of.iter().map(ToString::to_string).collect()
}

/// Returns a plain table; its heads are separated by ` | `. If the output is a terminal of `width` columns, columns of words are
/// wrapped, and numbers and names only if one takes more than half of the width. A table that is still too wide is given in parts, one
/// below the other, each with the first column.
///
/// # Examples
/// ```
/// use ozols::view::terminal::{row_cells, text_table};
/// let table = text_table("link | joints", [row_cells([&"crank", &2])], None);
/// assert!(table.contains("crank") && table.lines().count() >= 2);
/// ```
pub fn text_table(
    heads: &str,
    rows: impl IntoIterator<Item = Vec<String>>,
    width: Option<u16>,
) -> String {
    let heads: Vec<&str> = heads.split(" | ").collect();
    table_of(&heads, rows.into_iter().collect(), width)
}

/// Returns the same with heads that may hold any text.
pub fn table_of(header: &[&str], rows: Vec<Vec<String>>, width: Option<u16>) -> String {
    let Some(width) = width.map(usize::from) else {
        return render_table(header, rows, None);
    };
    let least = header.iter().enumerate().map(|(c, head)| {
        let cells = rows.iter().filter_map(|r| r.get(c)).map(String::as_str);
        least_width(cells.chain([*head]), width / 2)
    });
    let least: Vec<usize> = least.collect();
    let part = |part: &Vec<usize>| {
        let header: Vec<&str> = part.iter().map(|&c| header[c]).collect();
        let rows = rows.iter().map(|r| {
            let cells = part.iter().map(|&c| r.get(c).cloned().unwrap_or_default());
            cells.collect()
        });
        let least = part.iter().map(|&c| least[c]).collect();
        render_table(&header, rows.collect(), Some((width, least)))
    };
    fitting_parts(&least, width).iter().map(part).join("\n\n")
}

/// Renders a table; one of a width has the least widths of its columns.
fn render_table(
    header: &[&str],
    rows: Vec<Vec<String>>,
    fit: Option<(usize, Vec<usize>)>,
) -> String {
    let mut table = comfy_table::Table::new();
    table
        .load_preset(presets::NOTHING)
        .set_style(TableComponent::HeaderLines, '-')
        .set_style(TableComponent::MiddleHeaderIntersections, ' ')
        .set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(header.to_vec());
    table.add_rows(rows);
    if let Some((width, least)) = fit {
        let cells = |n: usize| u16::try_from(n).unwrap_or(u16::MAX);
        // A margin on the left is added below.
        table.set_width(cells(width.max(taken_width(&least)) - 1));
        let least = least.iter().map(|w| Width::Fixed(cells(w + PADDING)));
        table.set_constraints(least.map(ColumnConstraint::LowerBoundary));
    }
    let text = table.to_string();
    text.lines()
        .map(|l| format!(" {}", l.trim_end()))
        .join("\n")
}

/// Spaces on both sides of a cell.
const PADDING: usize = 2;

/// Returns the width of a table with such columns, a margin on the left and gaps between columns.
fn taken_width(widths: &[usize]) -> usize {
    widths.iter().map(|w| w + PADDING + 1).sum()
}

/// Returns the least width of a column: its longest word, but no more than `most`.
fn least_width<'a>(cells: impl Iterator<Item = &'a str>, most: usize) -> usize {
    let words = cells.flat_map(str::split_whitespace);
    let longest = words.map(measure_text_width).max().unwrap_or(0);
    // No column of a table is narrower than this.
    longest.min(most).max(1)
}

/// Splits the columns into parts that fit, with the first column in each.
fn fitting_parts(least: &[usize], width: usize) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = vec![Vec::new()];
    for c in 0..least.len() {
        let last = out.len() - 1;
        let with = out[last].iter().chain([&c]).map(|&c| least[c]);
        if taken_width(&with.collect::<Vec<_>>()) > width && out[last].len() > 1 {
            out.push(vec![0, c]);
        } else {
            out[last].push(c);
        }
    }
    out
}

/// Breaks lines that are too long between words, and indents the rest of them by two more.
///
/// # Examples
/// ```
/// use ozols::view::terminal::fit_lines;
/// let fitted = fit_lines("a line that is too long", Some(12));
/// assert!(fitted.lines().count() > 1 && fitted.lines().all(|l| l.len() <= 12));
/// ```
pub fn fit_lines(text: &str, width: Option<u16>) -> String {
    let Some(width) = width.map(usize::from) else {
        return text.to_owned();
    };
    text.split('\n').map(|l| wrap_line(l, width)).join("\n")
}

fn wrap_line(line: &str, width: usize) -> String {
    if measure_text_width(line) <= width {
        return line.to_owned();
    }
    let margin = line.len() - line.trim_start_matches(' ').len();
    let indent = " ".repeat(margin + 2);
    let options = textwrap::Options::new(width)
        .initial_indent(&line[..margin])
        .subsequent_indent(&indent)
        .break_words(false)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    textwrap::fill(&line[margin..], options)
}

/// Returns the factor to divide by and the unit prefix for values up to `greatest`.
pub(crate) fn unit_prefix(greatest: f64) -> (f64, &'static str) {
    match greatest {
        x if x >= 1e7 => (1e6, "M"),
        x if x >= 1e4 => (1e3, "k"),
        _ => (1.0, ""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn widest(text: &str) -> usize {
        text.lines().map(measure_text_width).max().unwrap_or(0)
    }

    #[test]
    fn words_wrap_and_numbers_do_not() {
        let rows = vec![
            vec![
                "1".to_owned(),
                "0.1414".to_owned(),
                "3-0, 1-6, 7-0, 8-9 -> spherical; 5-1 -> cylindrical".to_owned(),
            ],
            vec![
                "10".to_owned(),
                "12.5".to_owned(),
                "2-3 -> spherical".to_owned(),
            ],
        ];
        let head = " | moment | changes";
        let text = text_table(head, rows.clone(), Some(40));
        assert!(widest(&text) <= 40, "{text}");
        assert!(text.contains("0.1414") && text.contains("; 5-1"), "{text}");
        let free = text_table(head, rows.clone(), None);
        assert_eq!(free, text_table(head, rows.clone(), Some(200)));
        let narrow = text_table(head, rows, Some(20));
        assert!(
            widest(&narrow) <= 20 && narrow.contains("moment"),
            "{narrow}"
        );
    }

    // A contour of a robot is called by all of its links.
    #[test]
    fn names_wider_than_half_the_table_are_broken() {
        let name = "foot-roll-crank-rod-toe-".repeat(6);
        let row = |i: usize| {
            vec![
                name.clone(),
                format!("joint{i}, joint{}", i + 1),
                "12".to_owned(),
            ]
        };
        let text = text_table("contour | joints | rank", [row(1), row(3)], Some(60));
        assert!(widest(&text) <= 60, "{text}");
        assert!(text.contains("joint4") && text.contains("12"), "{text}");
        let rule = text.lines().nth(1).unwrap().trim_start();
        let wide = 1 + rule.find(' ').unwrap();
        let first = text.lines().map(|l| l.get(..wide).unwrap_or(l).trim());
        assert!(first.collect::<String>().contains(&name), "{text}");
    }

    #[test]
    fn long_lines_hang() {
        let text = fit_lines("a\n  one two three four\n  wait", Some(12));
        assert_eq!(text, "a\n  one two\n    three\n    four\n  wait");
        assert_eq!(fit_lines("  as it is", None), "  as it is");
    }

    proptest! {
        #[test]
        fn every_word_is_kept_and_every_line_fits(text in "( {0,4}([a-zσ]{1,9} {1,3}){0,12}\n){0,5}", width in 24u16..90) {
            let fitted = fit_lines(&text, Some(width));
            prop_assert!(fitted.split_whitespace().eq(text.split_whitespace()));
            let long = fitted.lines().find(|l| measure_text_width(l.trim_end()) > usize::from(width));
            prop_assert!(long.is_none(), "{fitted}");
        }
    }
}
