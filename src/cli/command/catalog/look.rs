//! `ozols catalog query`, `show`, `export`, `page` and `find`.

use super::wanted::{LISTED, WantedGrippers};
use crate::api::Scheme;
use crate::catalog::find::find_entries;
use crate::catalog::store::Store;
use crate::cli::prelude::*;
use crate::format::plain;
use crate::page::catalogue::catalogue_page;
use crate::redundancy::analysis::exact_field;
use crate::search::Search;
use crate::search::check::variant_mechanism;
use crate::search::question::conditions::Conditions;
use crate::synthesis::recognize::recognize_structure;
use crate::view::catalog::find::FoundData;
use crate::view::catalog::query::QueryAnswer;
use crate::view::catalog::structures::StructureData;

#[derive(Debug, ClapArgs)]
pub(crate) struct Query {
    /// The database.
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Question in SQL [default: the grippers that do the task first]. `ozols catalog query FILE "SELECT sql FROM sqlite_schema"` shows the
    /// tables with all columns explained.
    #[arg(conflicts_with_all = ["WantedGrippers"])]
    sql: Option<String>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextJsonOrCsv,
    #[command(flatten)]
    to: ToFile,
    // Last: what follows would stand under its heading in the help.
    #[command(flatten)]
    wanted: WantedGrippers,
}

/// Opens the catalogue in a file.
pub(super) fn open_catalogue(file: &Path) -> anyhow::Result<Store> {
    ensure!(
        file.exists(),
        "no file {0}; `ozols catalog build -o {0}` makes a catalogue",
        file.display()
    );
    output::kept::keep_file(file);
    Ok(Store::open_readonly(file)?)
}

/// Returns the mechanism of a structure as TOML.
fn laid_out(store: &Store, file: &Path, id: &str) -> anyhow::Result<String> {
    store.mechanism_text(id)?.with_context(|| {
        format!(
            "{id} has no layout; `ozols catalog show {} {id}` explains why",
            file.display()
        )
    })
}

pub(super) fn run_query(a: &Query) -> anyhow::Result<Done> {
    let store = open_catalogue(&a.file)?;
    let wanted = a.wanted.sql_question();
    let asked = a.sql.as_ref().unwrap_or(&wanted);
    let (names, rows) = store.query_rows(asked, None)?;
    let answer = QueryAnswer { names, rows };
    if answer.rows.is_empty() && a.wanted.is_any() {
        output::print_note(&a.wanted.in_the_way(&store)?);
    }
    let text = || -> anyhow::Result<String> {
        let text = answer.text(a.to.width());
        if a.sql.is_some() || a.wanted.is_any() || answer.rows.len() < LISTED {
            return Ok(text);
        }
        let (_, counted) = store.query_rows("SELECT count(*) FROM grippers", None)?;
        let all = crate::format::group_thousands(&counted[0][0]);
        Ok(format!(
            "{text}\nThese are {LISTED} of {all} grippers. A filter such as --does-task lists all that pass it.\n"
        ))
    };
    a.to.write_all_of(match a.format {
        TextJsonOrCsv::Text => text()?,
        TextJsonOrCsv::Json => output::json_text(&answer)?,
        TextJsonOrCsv::Csv => answer.csv(),
    })?;
    Ok(Done::found_or_nothing(!answer.rows.is_empty()))
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Show {
    /// The database.
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Structure: its id, the beginning of it, or its whole name.
    id: String,
    /// JSON instead of text.
    #[arg(long)]
    json: bool,
    /// Also write its kinematic scheme to a file.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

pub(super) fn run_show(a: &Show) -> anyhow::Result<Done> {
    let store = open_catalogue(&a.file)?;
    let id = store.find_id(&a.id)?;
    if let Some(picture) = &a.svg {
        let mechanism = crate::from_toml(&laid_out(&store, &a.file, &id)?)?;
        let drawn = crate::api::draw(&mechanism, Scheme::Kinematic)?;
        output::write_bytes(Some(picture), drawn)?;
    }
    let data = StructureData::read_structure(&store, &id)?;
    if a.json {
        return a.to.write_all_of(output::json_text(&data)?);
    }
    let mut text = data.text(a.to.width());
    if !data.has_layout() {
        return a.to.write_all_of(text);
    }
    let file = plain::escape_control(&a.file.display().to_string()).into_owned();
    let export = format!("ozols catalog export {file} {id}");
    text += &format!(
        "\nExport the mechanism, or idea 1:\n\n  {export} -o gripper.toml\n  {export} --idea 1 -o redesign.toml\n"
    );
    a.to.write_all_of(text)
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Export {
    /// The database.
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Structure: its id, the beginning of it, or its whole name.
    id: String,
    /// Apply idea K.
    #[arg(long, value_name = "K", alias = "variant")]
    idea: Option<usize>,
    /// Format: toml, json, urdf, mjcf, sdf or dot.
    #[arg(long, value_name = "FORMAT", default_value = "toml")]
    to: String,
    #[command(flatten)]
    out: ToFile,
}

pub(super) fn run_export(a: &Export) -> anyhow::Result<Done> {
    let store = open_catalogue(&a.file)?;
    let id = store.find_id(&a.id)?;
    let text = laid_out(&store, &a.file, &id)?;
    let text = match a.idea {
        None if a.to == "toml" => text,
        None => crate::cli::command::export::export_text(&crate::from_toml(&text)?, &a.to, None)?,
        Some(k) => {
            let choices = store
                .idea_choices(&id, k)?
                .with_context(|| format!("{id} has no idea {k} in {}", a.file.display()))?;
            let mechanism = crate::from_toml(&text)?;
            let field = exact_field(&mechanism, 0)?;
            let search = Search::new(field, mechanism, Conditions::default())?;
            let mut made = variant_mechanism::realize_variant(&search, &choices);
            made.edit().name = format!("{id}-idea-{k}");
            crate::cli::command::export::export_text(&made, &a.to, None)?
        }
    };
    a.out.write_all_of(text)
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Page {
    /// The database.
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Page to write.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
}

pub(super) fn run_page(a: &Page) -> anyhow::Result<Done> {
    let store = open_catalogue(&a.file)?;
    let page = catalogue_page(&store, &a.file.display().to_string())?;
    output::write_bytes(Some(&a.output), page)
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Find {
    #[command(flatten)]
    file: File,
    /// Catalogue to search for the structure.
    #[arg(long = "in", value_name = "CATALOGUE", value_hint = ValueHint::FilePath)]
    within: Option<PathBuf>,
    /// JSON instead of text.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    to: ToFile,
}

pub(super) fn run_find(a: &Find) -> anyhow::Result<Done> {
    let m = load::load_mechanism(&a.file)?;
    let found = recognize_structure(&m).with_context(|| {
        format!(
            "{}: not a gripper structure; it needs two or three jaws, and links joined by hinges, slides, gears and slots",
            a.file.file
        )
    })?;
    let store = a.within.as_deref().map(open_catalogue).transpose()?;
    let part = found.structure.essential_links();
    let known = store.map(|s| {
        let whole = found.whole.part_of(&found.whole.essential_links());
        find_entries(&s, &whole, found.made_as)
    });
    let data = FoundData::new(&found, &part, known.transpose()?);
    a.to.write_all_of(if a.json {
        output::json_text(&data.json())?
    } else {
        data.text(&m.name, a.to.width())
    })?;
    Ok(Done::found_or_nothing(data.is_known()))
}
