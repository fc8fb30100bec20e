//! Colour for the verdicts of a text on a terminal that supports it (NO_COLOR, CLICOLOR_FORCE).

use anstream::{AutoStream, ColorChoice};
use anstyle::AnsiColor;
use std::path::Path;

/// The kind of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tone {
    Good,
    Doubtful,
    Bad,
}

/// Returns a text with each of the verdicts in its colour; each verdict is searched for after the one before. Returns it
/// unchanged if it goes to a file or nobody looks.
pub(crate) fn toned(
    text: String,
    path: Option<&Path>,
    verdicts: impl IntoIterator<Item = (String, Tone)>,
) -> String {
    let to_file = path.is_some_and(|p| p != Path::new("-"));
    if to_file || AutoStream::choice(&std::io::stdout()) == ColorChoice::Never {
        return text;
    }
    let mut rest = text.as_str();
    let mut out = String::with_capacity(text.len());
    for (words, tone) in verdicts {
        // A terminal so narrow that the words are broken has them without colour.
        let Some((before, after)) = rest.split_once(&words) else {
            continue;
        };
        let colour = match tone {
            Tone::Good => AnsiColor::Green,
            Tone::Doubtful => AnsiColor::Yellow,
            Tone::Bad => AnsiColor::Red,
        };
        let style = colour.on_default().bold();
        out += &format!("{before}{style}{words}{style:#}");
        rest = after;
    }
    out + rest
}
