//! What to do next: commands, with what each is for.

use crate::view::layout::fit;
use itertools::Itertools;

/// A command and what it gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// The command, ready to be typed; a sentence where no command will do.
    pub command: String,
    /// What it gives.
    pub gives: String,
}

impl Step {
    /// A command of this program about a file.
    #[must_use]
    pub fn new(command: &str, file: &str, more: &str, gives: &str) -> Step {
        let more = if more.is_empty() {
            String::new()
        } else {
            format!(" {more}")
        };
        Step {
            command: format!("ozols {command} {}{more}", word(file)),
            gives: gives.to_owned(),
        }
    }
}

/// The steps as the end of a report, fitted to a terminal of `width` columns but for the commands: a command broken in two
/// could not be copied. Nothing where there are none.
#[must_use]
pub fn text(steps: &[Step], width: Option<u16>) -> String {
    if steps.is_empty() {
        return String::new();
    }
    let lines = steps.iter().map(|s| {
        format!(
            "    {}\n{}\n",
            s.command,
            fit(&format!("      {}", s.gives), width)
        )
    });
    format!("\n  Next:\n{}", lines.collect_vec().concat())
}

/// A word as a shell takes it; standard input cannot be read again, so it is FILE.
#[must_use]
pub fn word(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,+:@%".contains(c);
    match text {
        "-" => "FILE".to_owned(),
        t if !t.is_empty() && t.chars().all(plain) => t.to_owned(),
        t => format!("'{}'", t.replace('\'', "'\\''")),
    }
}

/// A file name made of a mechanism's name.
#[must_use]
pub fn file_name(name: &str, ending: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let stem: String = name
        .chars()
        .map(|c| if plain(c) { c } else { '-' })
        .take(40)
        .collect();
    word(&format!("{}.{ending}", stem.trim_start_matches('-')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_quoted_for_the_shell() {
        assert_eq!(word("my hand.toml"), "'my hand.toml'");
        assert_eq!(word("it's"), "'it'\\''s'");
        assert_eq!(word("-"), "FILE");
        assert_eq!(word("a/b-c.toml"), "a/b-c.toml");
        assert_eq!(file_name("my hand", "svg"), "my-hand.svg");
    }
}
