//! The reference of joint types.

use crate::cli::option::picture;
use crate::cli::prelude::*;
use crate::draw::{self, Size};
use crate::format::format_cost;
use crate::model::joint_type::{Freedom, JointType};
use crate::terms::PairWords;

/// Width of running text, in columns, if the output is not a terminal.
const COLUMNS: u16 = 100;

/// Returns the name of a joint type as files spell it.
pub(super) fn spelled_type(typed: &str) -> String {
    typed.trim().to_lowercase().replace(['_', ' '], "-")
}

/// Returns a table of all joint types, one row each.
pub(super) fn table_of_types(width: Option<u16>) -> String {
    let words = PairWords::builtin();
    let rows = JointType::NAMED.iter().map(|t| {
        let freedoms = t.freedoms().iter().map(|f| f.name()).join(" ");
        let made_as = words.get(t.name()).and_then(|w| w.hardware.first());
        let (also, cost) = (
            t.trade_names().join(", "),
            format_cost(t.default_cost_milli()),
        );
        let made_as = made_as.map_or("", String::as_str);
        row_cells([
            &t.name(),
            &also,
            &t.class_numeral(),
            &freedoms,
            &cost,
            &made_as,
        ])
    });
    let head = "joint type | also | class | freedoms | cost | made as";
    text_table(head, rows, width)
}

/// Explains one joint type; writes its picture to a file if one is given.
pub(super) fn explain_type(of: &JointType, file: Option<&Path>) -> anyhow::Result<Done> {
    if let Some(path) = file {
        draw_to(of, path)?;
    }
    let words = PairWords::builtin();
    let Some(w) = words.get(of.name()) else {
        return Ok(Done::Nothing);
    };
    let width = usize::from(output::output_width(None).unwrap_or(COLUMNS).min(COLUMNS));
    let needs = !w.reference.starts_with("does not matter");
    let (name, about) = (of.name(), textwrap::fill(&w.about, width));
    let figures = type_figures(of, w, width).join("\n");
    let mut out = format!(
        "{name}\n\n{about}\n\n{figures}\n\n{}\n",
        toml_example(of, needs)
    );
    if needs {
        let guess = "Without a reference, x is the first of the global axes that is not along z, which may not be what you want.";
        out += &format!("\n{}\n", textwrap::fill(guess, width));
    }
    if file.is_none() {
        out += &format!("\nozols explain {name} -o {name}.svg draws it.\n");
    }
    output::write_bytes(None, out)
}

/// Writes the picture of a joint type to a file, as PNG if its name ends in .png.
fn draw_to(of: &JointType, path: &Path) -> anyhow::Result<()> {
    let drawing = draw::joint_type(of);
    let bytes = if picture::named(Some(path)) {
        picture::ensure_png()?;
        picture::render_png(&drawing, Size::Scale(picture::SCALE))?
    } else {
        drawing.svg.into_bytes()
    };
    output::write_bytes(Some(path), bytes)?;
    Ok(())
}

/// Returns freedoms, class, axes, cost and hardware, a paragraph each.
fn type_figures(of: &JointType, w: &PairWords, width: usize) -> Vec<String> {
    let row = |head: &str, text: &str| {
        let options = textwrap::Options::new(width)
            .initial_indent("  ")
            .subsequent_indent("             ");
        textwrap::fill(&format!("{head:<11}{text}"), options)
    };
    let freedoms = match of.freedoms() {
        [] => "none".to_owned(),
        list => list
            .iter()
            .map(|f| format!("{} {}", f.name(), freedom_meaning(*f)))
            .join(", "),
    };
    let constraints = count_noun(6 - of.freedoms().len(), "constraint");
    let class = format!("{} ({constraints})", of.class_numeral());
    let cost = format!(
        "{} by default, in units of one revolute joint; [search.costs] of a file or --costs sets others (`ozols show costs`)",
        format_cost(of.default_cost_milli())
    );
    let also = of.trade_names().join(", ");
    let also = (!also.is_empty()).then(|| row("also", &also));
    let figures = [
        row("freedoms", &freedoms),
        row("class", &class),
        row("axis z", &w.axis),
        row("reference x", &w.reference),
        row("cost", &cost),
        row("made as", &w.hardware.join("; ")),
    ];
    also.into_iter().chain(figures).collect()
}

/// Returns an example of the joint type as TOML.
fn toml_example(of: &JointType, needs_reference: bool) -> String {
    let screws = of.freedoms().contains(&Freedom::Screw);
    let own = if screws { "\nlead = 5" } else { "" };
    let reference = if needs_reference {
        "\nreference = [1, 0, 0]"
    } else {
        ""
    };
    format!(
        "[[joint]]\nid = \"1-2\"\nlinks = [\"1\", \"2\"]\ntype = \"{}\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]{reference}{own}",
        of.name()
    )
}

/// Describes a freedom in words.
fn freedom_meaning(f: Freedom) -> &'static str {
    match f {
        Freedom::Rx => "(turn about x)",
        Freedom::Ry => "(turn about y)",
        Freedom::Rz => "(turn about z)",
        Freedom::Tx => "(shift along x)",
        Freedom::Ty => "(shift along y)",
        Freedom::Tz => "(shift along z)",
        Freedom::Screw => "(turn about z with a shift along it)",
    }
}
