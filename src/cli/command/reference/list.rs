//! `ozols list`.

use crate::cli::prelude::*;
use crate::file::template;
use crate::format::{csv, did_you_mean};
use serde::{Deserialize, Serialize};

#[derive(Debug, ClapArgs)]
pub(crate) struct List {
    /// List only mechanisms with all of these words in name, family or description.
    #[arg(value_name = "WORD")]
    words: Vec<String>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextJsonOrCsv,
}

/// Output of `--format csv` for all mechanisms; reading and ranking every file takes twenty times as long. A test compares it
/// with the files.
const ALL: &str = include_str!("../../../../catalogs/list.csv");

/// A state of a mechanism as data; the same keys in JSON and CSV.
#[derive(Debug, Serialize, Deserialize)]
struct ListRow {
    name: String,
    family: String,
    state: String,
    links: usize,
    joints: usize,
    contours: usize,
    freedoms: usize,
    mobility: usize,
    redundant: usize,
    description: String,
}

pub(crate) fn run_list(a: &List) -> anyhow::Result<Done> {
    let rows = wanted_rows(a)?;
    if rows.is_empty() {
        let hint = did_you_mean::suggest_words(&a.words.join("-"), builtin::names());
        output::print_note(&format!(
            "no built-in mechanism has all of: {}{hint}\n",
            a.words.join(", ")
        ));
        return Ok(Done::Nothing);
    }
    match a.format {
        TextJsonOrCsv::Text => write_list(a, rows),
        TextJsonOrCsv::Json => output::write_bytes(None, output::json_text(&rows)?),
        TextJsonOrCsv::Csv => output::write_bytes(None, csv::write_records(rows)),
    }
}

/// Lists all of them for people.
pub(crate) fn list_all() -> anyhow::Result<Done> {
    run_list(&List {
        words: Vec::new(),
        format: TextJsonOrCsv::Text,
    })
}

fn write_list(a: &List, rows: Vec<ListRow>) -> anyhow::Result<Done> {
    let header = "mechanism | state | n | p | k | f | W | σ | description";
    let (mut cells, mut families) = (Vec::new(), Vec::new());
    let (mut family, mut name) = (String::new(), String::new());
    for r in rows {
        let first = name != r.name;
        families.push((family != r.family).then(|| r.family.clone()));
        let shown = |text: &str| if first { text } else { "" }.to_owned();
        cells.push(row_cells([
            &shown(&r.name),
            &r.state,
            &r.links,
            &r.joints,
            &r.contours,
            &r.freedoms,
            &r.mobility,
            &r.redundant,
            &shown(&r.description),
        ]));
        (family, name) = (r.family, r.name);
    }
    let width = output::output_width(None);
    let room = width.map_or(usize::MAX, usize::from);
    output::write_with(None, |out| {
        // The first two lines are the head.
        let families = [None, None].into_iter().chain(families);
        for (line, family) in text_table(header, cells, None).lines().zip(families) {
            if let Some(family) = family {
                writeln!(out, "\n{family}")?;
            }
            writeln!(out, "{}", console::truncate_str(line, room, "…"))?;
        }
        if a.words.is_empty() {
            let signs = "\nn links, p joints, k contours, f freedoms, W mobility, σ redundant constraints; see `ozols explain`\n";
            write!(out, "{}", fit_lines(signs, width))?;
        }
        Ok(Done::Found)
    })
}

/// Returns a row for each state of the mechanisms that have all the words.
fn wanted_rows(a: &List) -> anyhow::Result<Vec<ListRow>> {
    let words: Vec<String> = a.words.iter().map(|w| w.to_lowercase()).collect();
    let mut out = Vec::new();
    for row in ::csv::Reader::from_reader(ALL.as_bytes()).deserialize() {
        let row: ListRow = row?;
        let about = format!("{} {} {}", row.name, row.family, row.description).to_lowercase();
        if words.iter().all(|w| about.contains(w)) {
            out.push(row);
        }
    }
    Ok(out)
}

#[derive(Debug, ClapArgs)]
pub(crate) struct New {
    /// File to write, with the ending .toml; the mechanism is named after it. If omitted, the built-in mechanisms are listed.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: Option<PathBuf>,
    /// Built-in mechanism to start from [default: four-bar].
    #[arg(long, value_name = "NAME", requires = "file")]
    from: Option<String>,
    /// Replace an existing file.
    #[arg(long, requires = "file")]
    force: bool,
}

pub(crate) fn run_new(args: &Global, a: &New) -> anyhow::Result<Done> {
    if let Some(file) = &a.file {
        let from = a.from.as_deref().unwrap_or("four-bar");
        return write(args, file, from, a.force);
    }
    let done = list_all()?;
    output::print_note("to start from one of these: ozols new mine.toml --from NAME\n");
    Ok(done)
}

fn write(args: &Global, file: &Path, from: &str, force: bool) -> anyhow::Result<Done> {
    let shown = file.display();
    let toml = file.extension().is_some_and(|e| e == "toml");
    // The name of a file may be any bytes; that of a mechanism is text.
    let stem = file.file_stem().map(|s| s.to_string_lossy());
    let Some(name) = stem.filter(|_| toml) else {
        let like = file.with_extension("toml");
        bail!(
            "{shown} does not end in .toml; name it {}, because only TOML has comments",
            like.display()
        );
    };
    let Some(text) = builtin::text(from) else {
        bail!(load::no_built_in(from));
    };
    // A link that leads nowhere is there, too.
    if !force && file.symlink_metadata().is_ok() {
        bail!("{shown} already exists; choose another name or use --force");
    }
    let text = template::with_comments(text, from, &name)
        .with_context(|| format!("built-in mechanism {from}"))?;
    output::write_bytes(Some(file), text)?;
    if args.quiet {
        return Ok(Done::Found);
    }
    let next = ["check", "analyze", "search"].map(|c| format!("  ozols {c} {shown}\n"));
    let head = format!("{shown}: the built-in {from} with comments\n");
    output::write_bytes(None, head + &next.concat())
}
