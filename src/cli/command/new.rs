//! `ozols new`.

use crate::builtin;
use crate::cli::command::list;
use crate::cli::prelude::*;
use crate::file::template;
use crate::model::mechanism::Role;
use std::io::{BufRead, IsTerminal};

#[derive(Debug, ClapArgs)]
pub(crate) struct New {
    /// File to write, with the ending .toml; the mechanism is named after it. If omitted, questions lead to a template.
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
    if !std::io::stdin().is_terminal() || !std::io::stdout().is_terminal() {
        let done = list::list_all()?;
        output::print_note("to start from one of these: ozols new mine.toml --from NAME\n");
        return Ok(done);
    }
    let (from, file) = ask_questions(&mut std::io::stdin().lock())?;
    write(args, Path::new(&file), &from, false)
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

/// The questions, in the order of the answers that each template has.
const QUESTIONS: [&str; 3] = [
    "How many jaws? 0 if it is not a gripper",
    "What drives it?",
    "How many parts, with the frame?",
];

/// Asks which template to start from and how to name the file; returns both. An empty answer takes the first choice.
fn ask_questions(from: &mut impl BufRead) -> anyhow::Result<(String, String)> {
    let mut left: Vec<([String; 3], &str)> = all_templates().collect();
    for (n, question) in QUESTIONS.into_iter().enumerate() {
        let choices: Vec<String> = left.iter().map(|(a, _)| a[n].clone()).collect();
        let answer = ask_choice(from, question, choices)?;
        left.retain(|(a, _)| a[n] == answer);
    }
    let names = left.iter().map(|(_, name)| (*name).to_owned()).collect();
    let name = ask_choice(from, "Which of these?", names)?;
    let file = format!("my-{name}.toml");
    let typed = ask_line(from, &format!("Name of the file? [{file}] "))?;
    Ok((name, if typed.is_empty() { file } else { typed }))
}

/// Every built-in mechanism with its answers: jaws, drive and parts.
fn all_templates() -> impl Iterator<Item = ([String; 3], &'static str)> {
    let all = builtin::families().into_iter();
    let all = all.flat_map(|(family, names)| names.into_iter().map(move |n| (family, n)));
    all.filter_map(|(family, name)| {
        let m = crate::built_in(name).ok()?;
        let outputs = m.links.iter().filter(|l| l.role == Role::Output).count();
        let jaws = if family == "grippers" { outputs } else { 0 };
        let drive = m.joints.iter().find(|j| j.drive).map_or("hand", |j| {
            let freedom = j.drive_freedom.map_or("", |f| f.name());
            match j.joint_type.name() {
                "helical" => "screw",
                "prismatic" => "slide",
                _ if freedom.starts_with('t') => "slide",
                _ => "hinge",
            }
        });
        let parts = m.links.iter().filter(|l| l.role != Role::Object).count();
        Some((
            [jaws.to_string(), drive.to_owned(), parts.to_string()],
            name,
        ))
    })
}

/// Asks until one of some choices is typed; one alone is not asked for.
fn ask_choice(from: &mut impl BufRead, question: &str, all: Vec<String>) -> anyhow::Result<String> {
    let all: Vec<String> = all.into_iter().unique().collect();
    let by_number = |c: &String| c.parse().unwrap_or(usize::MAX);
    let all: Vec<String> = all.into_iter().sorted_by_key(by_number).collect();
    let first = all.first().context("there is no template")?.clone();
    if all.len() == 1 {
        return Ok(first);
    }
    loop {
        let typed = ask_line(from, &format!("{question} [{}] ", all.join(", ")))?;
        if typed.is_empty() {
            return Ok(first);
        }
        if all.contains(&typed) {
            return Ok(typed);
        }
    }
}

/// Asks for a line.
fn ask_line(from: &mut impl BufRead, question: &str) -> anyhow::Result<String> {
    output::print_message(question);
    let mut typed = String::new();
    if from.read_line(&mut typed)? == 0 {
        bail!("the questions were not answered; `ozols new FILE --from NAME` asks none");
    }
    Ok(typed.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::ask_questions;

    #[test]
    fn questions_lead_to_a_template() {
        let (name, file) = ask_questions(&mut &b"2\nslide\n10\ngripper-10\n\n"[..]).unwrap();
        assert_eq!(
            (name.as_str(), file.as_str()),
            ("gripper-10", "my-gripper-10.toml")
        );
        let (name, file) =
            ask_questions(&mut &b"seven\n0\nhinge\n4\nfour-bar\nmine.toml\n"[..]).unwrap();
        assert_eq!((name.as_str(), file.as_str()), ("four-bar", "mine.toml"));
        assert!(ask_questions(&mut &b"2\n"[..]).is_err());
    }
}
