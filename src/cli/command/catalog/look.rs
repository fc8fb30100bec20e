//! `ozols catalog query`, `show`, `export`, `page` and `find`.

use super::wanted::WantedGrippers;
use crate::api::Scheme;
use crate::catalog::find::entries;
use crate::catalog::neighbours::neighbours;
use crate::catalog::store::Store;
use crate::cli::prelude::*;
use crate::format::plain;
use crate::page::catalogue::catalogue;
use crate::redundancy::analysis::exact_field;
use crate::search::Search;
use crate::search::check::variant_mechanism;
use crate::search::question::conditions::Conditions;
use crate::synthesis::recognize::recognize;
use crate::view::catalog::find::{FoundData, InCatalogue};
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
pub(super) fn open(file: &Path) -> anyhow::Result<Store> {
    ensure!(
        file.exists(),
        "no file {0}; `ozols catalog build -o {0}` makes a catalogue",
        file.display()
    );
    output::kept::keep(file);
    Ok(Store::open(file)?)
}

/// Returns the mechanism of a structure as TOML.
fn laid_out(store: &Store, file: &Path, id: &str) -> anyhow::Result<String> {
    store.mechanism(id)?.with_context(|| {
        format!(
            "{id} has no layout; `ozols catalog show {} {id}` explains why",
            file.display()
        )
    })
}

pub(super) fn query(a: &Query) -> anyhow::Result<Done> {
    let store = open(&a.file)?;
    let wanted = a.wanted.question();
    let asked = a.sql.as_ref().unwrap_or(&wanted);
    let (names, rows) = store.query(asked, None)?;
    let answer = QueryAnswer { names, rows };
    if answer.rows.is_empty() && a.wanted.is_any() {
        output::note(&a.wanted.in_the_way(&store)?);
    }
    a.to.put(match a.format {
        TextJsonOrCsv::Text => answer.text(a.to.width()),
        TextJsonOrCsv::Json => output::json(&answer)?,
        TextJsonOrCsv::Csv => answer.csv(),
    })?;
    Ok(Done::found(!answer.rows.is_empty()))
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

pub(super) fn show(a: &Show) -> anyhow::Result<Done> {
    let store = open(&a.file)?;
    let id = store.find(&a.id)?;
    if let Some(picture) = &a.svg {
        let mechanism = crate::from_toml(&laid_out(&store, &a.file, &id)?)?;
        let drawn = crate::api::draw(&mechanism, Scheme::Kinematic)?;
        output::put(Some(picture), drawn)?;
    }
    let data = StructureData::read(&store, &id)?;
    if a.json {
        return a.to.put(output::json(&data)?);
    }
    let mut text = data.text(a.to.width());
    if !data.has_layout() {
        return a.to.put(text);
    }
    let file = plain::plain(&a.file.display().to_string()).into_owned();
    let export = format!("ozols catalog export {file} {id}");
    text += &format!(
        "\nThe mechanism, and with idea 1 carried out:\n\n  {export} -o gripper.toml\n  {export} --idea 1 -o redesign.toml\n"
    );
    a.to.put(text)
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
    /// Format: toml, json, urdf, mjcf, sdf, dot or graphml.
    #[arg(long, value_name = "FORMAT", default_value = "toml")]
    to: String,
    #[command(flatten)]
    out: ToFile,
}

pub(super) fn export(a: &Export) -> anyhow::Result<Done> {
    let store = open(&a.file)?;
    let id = store.find(&a.id)?;
    let text = laid_out(&store, &a.file, &id)?;
    let text = match a.idea {
        None if a.to == "toml" => text,
        None => crate::cli::command::export::text(&crate::from_toml(&text)?, &a.to, None)?,
        Some(k) => {
            let choices = store
                .choices(&id, k)?
                .with_context(|| format!("{id} has no idea {k} in {}", a.file.display()))?;
            let mechanism = crate::from_toml(&text)?;
            let field = exact_field(&mechanism, 0)?;
            let search = Search::new(field, mechanism, Conditions::default())?;
            let mut made = variant_mechanism::realize(&search, &choices);
            made.name = format!("{id}-idea-{k}");
            crate::cli::command::export::text(&made, &a.to, None)?
        }
    };
    a.out.put(text)
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

pub(super) fn page(a: &Page) -> anyhow::Result<Done> {
    let store = open(&a.file)?;
    let page = catalogue(&store, &a.file.display().to_string())?;
    output::put(Some(&a.output), page)
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

pub(super) fn find(a: &Find) -> anyhow::Result<Done> {
    let m = load::mechanism(&a.file)?;
    let found = recognize(&m).with_context(|| {
        format!(
            "{}: not a gripper structure; it needs two or three jaws, and links joined by hinges, slides, gears and slots",
            a.file.file
        )
    })?;
    let store = a.within.as_deref().map(open).transpose()?;
    let part = found.structure.essential_links();
    let essential = found.structure.part(&part);
    let known = store.map(|s| -> anyhow::Result<InCatalogue> {
        let whole = found.whole.part(&found.whole.essential_links());
        Ok(InCatalogue {
            entries: entries(&s, &whole, found.made_as)?,
            // Three sides that are alike are not compared.
            neighbours: if found.sides() == 3 {
                Vec::new()
            } else {
                neighbours(&s, &essential)?
            },
        })
    });
    let data = FoundData::new(&found, &part, known.transpose()?);
    a.to.put(if a.json {
        output::json(&data.json())?
    } else {
        data.text(&m.name, a.to.width())
    })?;
    Ok(Done::found(data.is_known()))
}
