//! `ozols report`.

use crate::cli::option::request::Checked;
use crate::cli::prelude::*;
use crate::cli::terminal::progress::SearchWatch;
use crate::page::scenes::state_scenes;
use crate::page::{Commands, Page, Redesigns, report_html};
use crate::score::outcome::listing::Variants;
use crate::score::outcome::remarks::Remarks;
use crate::view::search::nothing_found::wider_commands;
use crate::view::terminal::next_commands::{file_name, file_stem, request_flags};
use std::sync::Arc;

#[derive(Debug, ClapArgs)]
pub(crate) struct Report {
    #[command(flatten)]
    file: File,
    /// Number of best variants on the page, at most 10000.
    #[arg(long, value_name = "K", default_value_t = 200)]
    top: usize,
    #[command(flatten)]
    checked: Checked,
    #[command(flatten)]
    to: ToFile,
}

/// Maximum number of variants on a page.
const MOST: usize = 10_000;

pub(crate) fn run_report(args: &Global, a: &Report) -> anyhow::Result<Done> {
    output::not_to_terminal(a.to.path(), "a page")?;
    let request = search_request(args, a)?;
    let written = load::load_mechanism(&a.file)?;
    // An unknown state is a mistake; geometry that cannot be searched is not.
    let prepared = request.prepare(written.clone(), &mut print_line)?;
    let states: Vec<StateId> = written.state_ids().collect();
    let states = analyse_states(&written, &states, Method::Auto)?;
    let conditions = request.search_conditions(&prepared, &mut print_line);
    let mechanism = Arc::new(prepared.mechanism);
    let write = |redesigns: Result<Redesigns<'_>, String>, ideas, wider| {
        let page = report_html(&Page {
            mechanism: &mechanism,
            states: &states,
            scenes: state_scenes(
                &mechanism,
                &states,
                redesigns.as_ref().ok().map(|r| r.found),
            ),
            redesigns,
            ideas,
            commands: Commands {
                wider,
                ..page_commands(&mechanism, a, &request)
            },
        })?;
        a.to.write_all_of(page)
    };
    // What is known of the mechanism as it is stands, even where its coordinates do not allow a search.
    let (conditions, measured) = match conditions {
        Ok(conditions) => conditions,
        Err(why) => {
            return write(Err(format!("{why}.")), None, Vec::new());
        }
    };
    let mut watch = SearchWatch::new(args.quiet);
    let outcome = watch.answer_request(mechanism.clone(), conditions, measured, &request)?;
    let ideas = (!request.distinct).then(|| {
        let given = outcome.ideas_unless(&interrupt::is_pending);
        list_redesigns(&outcome, given, Remarks::default())
    });
    let remarks = outcome.make_remarks(&interrupt::is_pending)?;
    let given = outcome.variants_unless(&interrupt::is_pending);
    let wider = wider_commands(&outcome, &remarks, "report", &a.file.as_typed());
    let variants = list_redesigns(&outcome, given, remarks);
    // What is left is to be drawn: whoever interrupts that wants no page.
    interrupt::be_impatient();
    write(Ok(variants), ideas, wider)
}

/// Returns the search that the options ask for.
fn search_request(args: &Global, a: &Report) -> anyhow::Result<Request> {
    ensure!(
        (1..=MOST).contains(&a.top),
        "--top must be from 1 to {MOST} in a report; `ozols search` gives longer lists"
    );
    Ok(Request {
        list: List::Top(a.top),
        ..a.checked.request(args.seed)?
    })
}

/// Builds a list of the page.
fn list_redesigns<'o>(
    found: &'o Outcome,
    mut given: Variants<'o>,
    remarks: Remarks,
) -> Redesigns<'o> {
    let variants = given.by_ref().collect();
    Redesigns {
        found,
        variants,
        summary: given.summary(),
        interrupted: given.is_interrupted(),
        remarks,
    }
}

/// Returns the commands that reproduce what the page shows.
fn page_commands(mechanism: &Mechanism, a: &Report, request: &Request) -> Commands {
    let file = a.file.as_typed();
    let more = list_options(mechanism, a, request);
    let [sdf, svg] = ["sdf", "svg"].map(|ending| file_name(&mechanism.name, ending));
    let longer = join_words(&[&request_flags(mechanism, request), "{}", "--top 10000"]);
    let rows = [
        ("This page", format!("report {file} {more} -o report.html")),
        ("Original mechanism", format!("analyze {file}")),
        (
            "The variants, as text or data",
            format!("search {file} {more} --format text|json|csv"),
        ),
        (
            "The mechanism for other programs",
            format!("export {file} --to sdf -o {sdf}"),
        ),
        (
            "A drawing",
            format!("draw {file} --kind scheme|kinematic -o {svg}"),
        ),
    ];
    let rows = rows.map(|(gives, command)| NextCommand {
        command: format!("ozols {command}"),
        gives: gives.to_owned(),
    });
    Commands {
        rows: rows.to_vec(),
        variant: of_one(mechanism, &file, request, "variant"),
        idea: of_one(mechanism, &file, request, "idea"),
        longer: format!("ozols report {file} {longer} -o report.html"),
        wider: Vec::new(),
    }
}

/// Joins the words of a command, without empty ones.
fn join_words(words: &[&str]) -> String {
    words.iter().filter(|w| !w.is_empty()).join(" ")
}

/// Returns the options that made the list of the page.
fn list_options(mechanism: &Mechanism, a: &Report, request: &Request) -> String {
    let poses = match request.poses {
        0 => String::new(),
        n => format!("--poses {n}"),
    };
    let top = format!("--top {}", a.top);
    join_words(&[&request_flags(mechanism, request), &poses, &top])
}

/// Returns the commands about one variant or idea, called `name`, with `{}` for its number.
fn of_one(
    mechanism: &Mechanism,
    file: &str,
    request: &Request,
    name: &str,
) -> Vec<(String, String)> {
    // `--idea` says that ideas are meant.
    let plain = Request {
        distinct: false,
        ..request.clone()
    };
    let plain = request_flags(mechanism, &plain);
    let one = if request.distinct {
        request.noun_of_one()
    } else {
        name
    };
    let number = format!("--{one} {{}}");
    let row = |what: &str, command: &str, rest: &str| {
        let rest = rest.replace("NAME", &format!("{}-{one}", file_stem(&mechanism.name)));
        let command = join_words(&[command, file, &plain, &number, &rest]);
        (what.to_owned(), command)
    };
    vec![
        row("The same drawing", "ozols draw", "-o NAME-{}.svg"),
        row("Save as file", "ozols export", "--to toml -o NAME-{}.toml"),
    ]
}
