//! Verdicts in rows and columns.

use super::data::{Cell, Matrix, VerdictKind};
use super::frame::{self, Head};
use crate::chart::style::{PAD, WIDTH};
use crate::svg::text;
use crate::svg::xml::{Xml, number};

/// The size of names.
const SIZE: f64 = 12.0;
/// The size of text in cells.
const SMALL: f64 = 11.0;
/// The height of a row.
const ROW: f64 = 21.0;
/// After so many rows the column heads stand again, so that they are in sight wherever one reads.
const BLOCK: usize = 25;

impl VerdictKind {
    /// The class of its colours.
    pub(super) fn class(self) -> &'static str {
        match self {
            VerdictKind::Good => "good",
            VerdictKind::Bad => "bad",
            VerdictKind::Warn => "warn",
            VerdictKind::None => "none",
        }
    }
}

/// Widths of a matrix in pixels.
struct MatrixLayout {
    /// Where the first column begins.
    left: f64,
    /// Where the last one ends.
    right: f64,
    /// The width of a column.
    cell: f64,
    /// The height of the column heads.
    heads: f64,
    /// The width of the picture.
    width: f64,
}

impl Matrix {
    /// The matrix as a self-contained SVG element, for a file of its own or inside HTML.
    ///
    /// Rows of too few cells end early; cells beyond the last column have a column without a head.
    pub fn svg(&self) -> String {
        let layout = self.layout();
        let width = layout.width;
        let head = Head::new(&self.title, &self.subtitle, width);
        let rows = self.rows.len().max(self.cells.len());
        let blocks = rows.div_ceil(BLOCK).max(1);
        let first = head.height() + layout.heads;
        let top = |row: usize| first + row as f64 * ROW + (row / BLOCK) as f64 * layout.heads;
        let height = first + rows as f64 * ROW + (blocks - 1) as f64 * layout.heads + PAD;
        let about = self.about();
        let mut xml = frame::begin((width, height), "oz oz-matrix", &self.title, &about, &head);
        for block in 0..blocks {
            let top = top(block * BLOCK);
            for (n, name) in self.columns.iter().enumerate() {
                let middle = layout.left + (n as f64 + 0.5) * layout.cell;
                column(&mut xml, name, middle, top - 8.0);
            }
            let rows = BLOCK.min(rows - block * BLOCK) as f64;
            let bottom = top + rows * ROW;
            frame::stroke(&mut xml, "grid", (PAD, bottom), (layout.right, bottom));
        }
        for row in 0..rows {
            let y = top(row);
            if row % 5 == 0 {
                frame::stroke(&mut xml, "grid", (PAD, y), (layout.right, y));
            }
            self.row(&mut xml, row, y, &layout);
        }
        xml.finish()
    }

    /// How wide everything is.
    fn layout(&self) -> MatrixLayout {
        let widest = |names: &[String], most: f64| {
            let widths = names.iter().map(|n| text::width(n.trim(), SIZE));
            widths.fold(0.0, f64::max).min(most)
        };
        let columns = self
            .cells
            .iter()
            .map(Vec::len)
            .fold(self.columns.len(), usize::max);
        let texts = self
            .cells
            .iter()
            .flatten()
            .map(|c| text::width(c.text.trim(), SMALL));
        let cell = (texts.fold(0.0, f64::max) + 12.0).clamp(34.0, 130.0);
        let before = widest(&self.rows, 300.0) + 12.0;
        let slant = widest(&self.columns, 190.0) * std::f64::consts::FRAC_1_SQRT_2;
        let (left, across) = (PAD + before, columns as f64 * cell);
        MatrixLayout {
            left,
            right: left + across,
            cell,
            heads: slant + 22.0,
            width: (left + across + PAD.max(slant - cell / 2.0 + 16.0)).max(WIDTH / 2.0),
        }
    }

    /// The name of a row and its cells, below `y`.
    fn row(&self, xml: &mut Xml, row: usize, y: f64, layout: &MatrixLayout) {
        let name = self.rows.get(row).map_or("", String::as_str);
        let at = xml
            .tag("text")
            .set("class", "name")
            .set("text-anchor", "end");
        let at = at.num("x", layout.left - 10.0).num("y", y + 15.0);
        at.text_and_tip(&text::cut(name, SIZE, 300.0), name.trim());
        for (n, c) in self.cells.get(row).into_iter().flatten().enumerate() {
            let column = self.columns.get(n).map_or("", String::as_str);
            let x = layout.left + n as f64 * layout.cell;
            one(xml, c, &tip(c, name, column), x, y, layout.cell);
        }
    }

    /// What a screen reader says.
    fn about(&self) -> String {
        let count = |kind| {
            self.cells
                .iter()
                .flatten()
                .filter(|c| c.kind == kind)
                .count()
        };
        let (good, bad, warn) = (
            count(VerdictKind::Good),
            count(VerdictKind::Bad),
            count(VerdictKind::Warn),
        );
        let (rows, columns) = (self.rows.len(), self.columns.join(", "));
        let subtitle = &self.subtitle;
        format!(
            "{subtitle} {rows} rows; columns: {columns}. {good} good, {bad} bad, {warn} in doubt."
        )
        .trim_start()
        .to_owned()
    }
}

fn tip(cell: &Cell, row: &str, column: &str) -> String {
    let said = if cell.tooltip.is_empty() {
        &cell.text
    } else {
        &cell.tooltip
    };
    format!("{row}, {column}: {said}")
}

/// The head of a column, aslant from its start.
fn column(xml: &mut Xml, name: &str, x: f64, y: f64) {
    let turn = format!("translate({} {}) rotate(-45)", number(x), number(y));
    let text = xml.tag("text").set("class", "name").set("transform", &turn);
    text.text_and_tip(&text::cut(name, SIZE, 190.0), name.trim());
}

/// A cell: its colour with its text, or with a sign where it has none.
fn one(xml: &mut Xml, cell: &Cell, tip: &str, x: f64, y: f64, width: f64) {
    let class = cell.kind.class();
    xml.tag("g").open();
    xml.tag("title").text(tip);
    let back = xml
        .tag("rect")
        .set("class", class)
        .num("x", x + 1.0)
        .num("y", y + 1.0);
    back.num("width", width - 2.0)
        .num("height", ROW - 2.0)
        .num("rx", 3.0)
        .close();
    let middle = x + width / 2.0;
    let text = text::cut(&cell.text, SMALL, width - 4.0);
    if text.is_empty() {
        let shape = match cell.kind {
            VerdictKind::Good => "m-4 0 l3 3 l5 -6",
            VerdictKind::Bad => "m-3.5 -3.5 l7 7 m0 -7 l-7 7",
            VerdictKind::Warn => "m0 -4.5 v5 m0 2.5 v1.5",
            VerdictKind::None => "",
        };
        if !shape.is_empty() {
            let path = format!("M{} {}{shape}", number(middle), number(y + ROW / 2.0));
            xml.tag("path")
                .set("class", &format!("sign {class}"))
                .set("d", &path)
                .close();
        }
    } else {
        let at = xml.tag("text").set("class", &format!("small {class}"));
        let at = at.set("text-anchor", "middle").num("x", middle);
        at.num("y", y + ROW / 2.0 + 4.0).text(&text);
    }
    xml.end();
}
