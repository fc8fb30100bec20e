//! Common parts of texts for people: tables that fit the terminal, prefixes of units, next commands.

use itertools::Itertools;
use std::borrow::Cow;
use std::fmt::Display;
use textwrap::core::display_width;

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
    let of_column = |(c, head): (usize, &_)| -> Vec<&str> {
        let cells = rows.iter().map(|r| r.get(c).map_or("", String::as_str));
        std::iter::once(*head).chain(cells).collect()
    };
    let columns: Vec<Vec<&str>> = header.iter().enumerate().map(of_column).collect();
    let Some(width) = width.map(usize::from) else {
        let full = columns.iter().map(|column| used_width(column, usize::MAX));
        return render_columns(columns.iter().zip(full));
    };
    let least = columns.iter().map(|column| least_width(column, width));
    let least = least.collect_vec();
    let part = |part: &Vec<usize>| {
        let of_part = part.iter().map(|&c| &columns[c]).collect_vec();
        let least = part.iter().map(|&c| least[c]).collect();
        let widths = fitting_widths(&of_part, least, width);
        render_columns(of_part.into_iter().zip(widths))
    };
    fitting_parts(&least, width).iter().map(part).join("\n\n")
}

/// Returns the width of each column of a table that is `width` wide, at least its `least`. Heads are wrapped before cells are, and the
/// columns that need most share what the others leave.
fn fitting_widths(columns: &[&Vec<&str>], least: Vec<usize>, width: usize) -> Vec<usize> {
    let fits = |widths: &Vec<usize>| taken_width(widths.iter().copied()) <= width;
    let cells = columns.iter().zip(&least);
    let cells = cells.map(|(column, &least)| used_width(&column[1..], usize::MAX).max(least));
    let least = Some(cells.collect()).filter(fits).unwrap_or(least);
    let up_to = |most: usize| {
        let widths = columns.iter().zip(&least);
        let widths = widths.map(|(column, &least)| used_width(column, most.max(least)).max(least));
        widths.collect_vec()
    };
    let shares = (0..=width).collect_vec();
    let fitting = shares.partition_point(|&most| fits(&up_to(most)));
    let widths = fitting.checked_sub(1).map(up_to);
    widths.filter(fits).unwrap_or(least)
}

/// Renders columns next to each other, the cells of each wrapped to its width; the first cell is the head.
fn render_columns<'a>(columns: impl Iterator<Item = (&'a Vec<&'a str>, usize)>) -> String {
    let columns = columns.collect_vec();
    let mut out = Vec::new();
    for row in 0..columns.first().map_or(0, |(column, _)| column.len()) {
        let cells = columns.iter().map(|(c, width)| wrapped(c[row], *width));
        let cells = cells.collect_vec();
        let height = cells.iter().map(Vec::len).max().unwrap_or(0);
        for line in 0..height {
            let mut text = String::new();
            for (lines, (_, width)) in cells.iter().zip(&columns) {
                let cell = lines.get(line).map_or("", |l| l);
                // A wide letter does not fit a column of one.
                let gap = (width + PADDING - 1).saturating_sub(display_width(cell));
                text.extend(["  ", cell]);
                text.extend(std::iter::repeat_n(' ', gap));
            }
            text.truncate(text.trim_end().len());
            out.push(text);
        }
        if row == 0 {
            let rules = columns.iter().map(|(_, width)| "-".repeat(width + PADDING));
            out.push(format!(" {}", rules.format(" ")));
        }
    }
    out.join("\n")
}

/// Spaces on both sides of a cell.
const PADDING: usize = 2;

/// Returns the width of a table with such columns, a margin on the left and gaps between columns.
fn taken_width(widths: impl Iterator<Item = usize>) -> usize {
    widths.map(|w| w + PADDING + 1).sum()
}

/// Returns the width of some cells if they are wrapped to `most`.
fn used_width(cells: &[&str], most: usize) -> usize {
    let lines = cells.iter().flat_map(|cell| wrapped(cell, most));
    lines.map(|l| display_width(&l)).max().unwrap_or(0).max(1)
}

/// Returns the least width of a column of a table that is `width` wide: its longest word, but no more than of two columns that fit.
fn least_width(column: &[&str], width: usize) -> usize {
    let words = column.iter().flat_map(|cell| cell.split_whitespace());
    let longest = words.map(display_width).max().unwrap_or(0);
    let half = (width / 2).saturating_sub(PADDING + 1);
    longest.min(half).max(1)
}

/// Splits the columns into parts that fit, with the first column in each.
fn fitting_parts(least: &[usize], width: usize) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = vec![Vec::new()];
    for c in 0..least.len() {
        let last = out.len() - 1;
        let with = out[last].iter().chain([&c]).map(|&c| least[c]);
        if taken_width(with) > width && out[last].len() > 1 {
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
    if display_width(line) <= width {
        return line.to_owned();
    }
    let margin = line.len() - line.trim_start_matches(' ').len();
    let indent = " ".repeat(margin + 2);
    let options = between_words(width)
        .initial_indent(&line[..margin])
        .subsequent_indent(&indent)
        .break_words(false);
    textwrap::fill(&line[margin..], options)
}

/// Returns the lines of a cell, broken within words that are wider than the column.
fn wrapped(cell: &str, width: usize) -> Vec<Cow<'_, str>> {
    textwrap::wrap(cell, between_words(width))
}

fn between_words<'a>(width: usize) -> textwrap::Options<'a> {
    textwrap::Options::new(width)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit)
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
        text.lines().map(display_width).max().unwrap_or(0)
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
    fn two_columns_of_long_words_fit() {
        let row = |i: usize| vec![format!("{}{i}", "contour-".repeat(4)), "joint-".repeat(5)];
        for width in 12..100 {
            let text = text_table("contour | joints", [row(1), row(2)], Some(width));
            assert!(widest(&text) <= usize::from(width), "{width}:\n{text}");
        }
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
            let long = fitted.lines().find(|l| display_width(l.trim_end()) > usize::from(width));
            prop_assert!(long.is_none(), "{fitted}");
        }
    }
}
