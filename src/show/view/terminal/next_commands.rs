//! Next commands, each with its purpose.

use crate::score::request::{JointOptions, List, Request};
use crate::search::question::conditions::Symmetry;
use crate::view::prelude::*;
use std::fmt::Display;

/// A command and what it gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NextCommand {
    /// The command, ready to be typed, or a sentence if no command is enough.
    pub command: String,
    /// Its result.
    pub gives: String,
}

impl NextCommand {
    /// Returns the command that fixes a robot description in a copy of the file.
    ///
    /// # Examples
    /// ```
    /// use ozols::view::terminal::next_commands::NextCommand;
    /// let next = NextCommand::fix_command("arm.urdf", "", "a copy without redundant constraints");
    /// assert_eq!(next.command, "ozols fix arm.urdf -o arm-fixed.urdf");
    /// ```
    pub fn fix_command(file: &str, more: &str, gives: &str) -> NextCommand {
        let (stem, ending) = file.rsplit_once('.').unwrap_or((file, "xml"));
        let out = format!("-o {}", shell_word(&format!("{stem}-fixed.{ending}")));
        NextCommand::new("fix", file, format!("{more} {out}").trim(), gives)
    }

    /// Returns a command of this program about a file.
    pub fn new(command: &str, file: &str, more: &str, gives: &str) -> NextCommand {
        let more = if more.is_empty() {
            String::new()
        } else {
            format!(" {more}")
        };
        NextCommand {
            command: format!("ozols {command} {}{more}", shell_word(file)),
            gives: gives.to_owned(),
        }
    }
}

/// Returns the steps as the end of a report, fitted to a terminal of `width` columns except for the commands: a command broken in two
/// could not be copied. Empty if there are none.
pub fn steps_text(steps: &[NextCommand], width: Option<u16>) -> String {
    if steps.is_empty() {
        return String::new();
    }
    let lines = steps.iter().map(|s| {
        format!(
            "    {}\n{}\n",
            s.command,
            fit_lines(&format!("      {}", s.gives), width)
        )
    });
    format!("\n  Next:\n{}", lines.collect_vec().concat())
}

/// Returns the options that reproduce the list of a search, as they are typed: those of `search`, `draw` and `export` are the same.
///
/// # Examples
/// ```
/// use ozols::view::terminal::next_commands::request_flags;
/// let request = ozols::Request { max_mobility: Some(1), distinct: true, ..Default::default() };
/// assert_eq!(request_flags(&ozols::built_in("four-bar")?, &request), "--max-mobility 1 --distinct");
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn request_flags(mechanism: &Mechanism, r: &Request) -> String {
    let joints = |rule: &JointOptions| match rule.names.as_slice() {
        [] => rule.joint.clone(),
        names => format!("{}={}", rule.joint, names.join(",")),
    };
    let some = |n: u32| (n > 0).then(|| n.to_string());
    let list = |names: Vec<String>| (!names.is_empty()).then(|| names.join(","));
    let state = r.searched_state(mechanism).ok().flatten().is_some();
    let state = r.state.as_ref().filter(|_| state).cloned();
    let unloading = r.unloading.iter().map(|i| match i.joints.as_slice() {
        [] => i.names.join(","),
        joints => format!("{}={}", i.names.join(","), joints.join(",")),
    });
    let rank = r.rank.iter().map(|(term, weight)| match weight {
        1.0 => term.name().to_owned(),
        weight => format!("{}={weight}", term.name()),
    });
    // All variants are listed by cost, whatever ranking the file has.
    let by_cost = r.list == List::All && r.rank.is_empty() && mechanism.ranking.is_some();
    let rank = rank.chain(by_cost.then(|| "cost".to_owned()));
    let pool = r.pool.map(|n| n.to_string());
    let valued = [
        ("max-redundant", some(r.max_redundant)),
        ("max-external", r.max_external.map(|n| n.to_string())),
        ("max-harmful", r.max_harmful.map(|n| n.to_string())),
        ("state", state),
        ("max-mobility", r.max_mobility.map(|w| w.to_string())),
        ("max-changes", r.max_changes.map(|c| c.to_string())),
        ("rank", list(rank.collect())),
        ("pool", pool),
        ("drives", r.drives.map(|d| d.word().to_owned())),
        ("costs", r.costs.as_ref().map(|c| c.name.clone())),
    ]
    .into_iter()
    .chain(r.hold.iter().map(|l| ("hold", Some(l.clone()))))
    .chain(unloading.map(|u| ("unloading", Some(u))))
    .chain([("options", list(r.options.clone()))])
    .chain(r.allow.iter().map(|j| ("allow", Some(joints(j)))))
    .chain(r.forbid.iter().map(|j| ("forbid", Some(joints(j)))));
    let switches = [
        ("allow-output-change", r.allow_output_change),
        ("allow-loose-object", r.allow_loose_object),
        ("symmetric", r.symmetry == Symmetry::SymmetricOnly),
        ("pose-only", r.pose_only),
        ("one-per-orbit", r.symmetry == Symmetry::OnePerOrbit),
        ("distinct", r.distinct),
        ("as-written", r.as_written),
    ];
    valued
        .filter_map(|(option, value)| Some(typed_option(option, shell_word(&value?))))
        .chain(
            switches
                .iter()
                .filter(|s| s.1)
                .map(|s| typed_option(s.0, "")),
        )
        .join(" ")
}

/// Returns an option as it is typed, with its value if it has one: everything else names options by their fields.
pub(crate) fn typed_option(option: &str, value: impl Display) -> String {
    format!("--{option} {value}").trim_end().to_owned()
}

/// Quotes a word for a shell; standard input cannot be read again, so it is FILE.
///
/// # Examples
/// ```
/// use ozols::view::terminal::next_commands::shell_word;
/// assert_eq!(shell_word("four-bar.toml"), "four-bar.toml");
/// assert_eq!(shell_word("my arm.urdf"), "'my arm.urdf'");
/// ```
pub fn shell_word(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,+:@%".contains(c);
    match text {
        "-" => "FILE".to_owned(),
        t if !t.is_empty() && t.chars().all(plain) => t.to_owned(),
        t => format!("'{}'", t.replace('\'', "'\\''")),
    }
}

/// Returns a file name for a mechanism's name.
pub fn file_name(name: &str, ending: &str) -> String {
    shell_word(&format!("{}.{ending}", file_stem(name)))
}

/// Returns the same without its ending.
pub fn file_stem(name: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let stem: String = name
        .chars()
        .map(|c| if plain(c) { c } else { '-' })
        .take(40)
        .collect();
    stem.trim_start_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_quoted_for_the_shell() {
        assert_eq!(shell_word("my hand.toml"), "'my hand.toml'");
        assert_eq!(shell_word("it's"), "'it'\\''s'");
        assert_eq!(shell_word("-"), "FILE");
        assert_eq!(shell_word("a/b-c.toml"), "a/b-c.toml");
        assert_eq!(file_name("my hand", "svg"), "my-hand.svg");
    }
}
