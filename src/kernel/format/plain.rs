//! Foreign text made safe for display: no character of it controls the terminal.

use std::borrow::Cow;
use std::fmt::Write;

/// Returns true if a character changes the direction of letters: the marks, embeddings and isolates of Unicode's
/// bidirectional text.
#[must_use]
pub fn changes_direction(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Returns a text with such characters spelt out, as `\u{202e}`.
#[must_use]
pub fn escape_direction(text: &str) -> Cow<'_, str> {
    escape_where(text, changes_direction)
}

/// Returns true if a character does anything other than display itself: terminal control characters, and those that
/// change the direction of letters. Line ends and tabs are allowed.
fn is_control(c: char) -> bool {
    changes_direction(c) || c.is_control() && !matches!(c, '\n' | '\t')
}

/// Returns a text with such characters spelt out, as `\u{1b}`.
#[must_use]
pub fn escape_control(text: &str) -> Cow<'_, str> {
    escape_where(text, is_control)
}

/// Returns a text made safe for a line or a cell: line ends are spelt out, too.
#[must_use]
pub fn escape_line(text: &str) -> Cow<'_, str> {
    escape_where(text, |c| is_control(c) || c == '\n')
}

/// Returns a text made safe except for our own colour sequences, such as `ESC [ 1 m`, which are kept.
#[must_use]
pub fn escape_except_colours(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_control) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("\u{1b}[") {
        let (before, from) = rest.split_at(at);
        out += &escape_control(before);
        let digits = from[2..].find(|c: char| !c.is_ascii_digit() && c != ';');
        let end = digits.map_or(from.len(), |n| n + 2);
        let whole = from[end..].starts_with('m');
        let (colour, after) = from.split_at(end + usize::from(whole));
        if whole {
            out += colour
        } else {
            out += &escape_control(colour)
        }
        rest = after;
    }
    out += &escape_control(rest);
    Cow::Owned(out)
}

fn escape_where(text: &str, steers: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.chars().any(&steers) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if steers(c) {
            let _ = write!(out, "\\u{{{:x}}}", u32::from(c));
        } else {
            out.push(c)
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::{escape_control, escape_except_colours, escape_line};

    #[test]
    fn what_steers_a_terminal_is_spelt_out() {
        assert_eq!(
            escape_control("a\u{1b}[2Jb\r\u{9b}1m\u{7f}"),
            "a\\u{1b}[2Jb\\u{d}\\u{9b}1m\\u{7f}"
        );
        assert_eq!(escape_control("\u{202e}abc"), "\\u{202e}abc");
        assert_eq!(escape_control("σ = 0\n\té"), "σ = 0\n\té");
        assert_eq!(escape_line("a\nb"), "a\\u{a}b");
    }

    #[test]
    fn colours_of_ours_stay() {
        let ours = "\u{1b}[1m\u{1b}[31;1merror:\u{1b}[0m x\u{1b}[m";
        assert_eq!(escape_except_colours(ours), ours);
        assert_eq!(
            escape_except_colours("\u{1b}[2J\u{1b}[1"),
            "\\u{1b}[2J\\u{1b}[1"
        );
        assert_eq!(
            escape_except_colours("\u{1b}]0;x\u{7}"),
            "\\u{1b}]0;x\\u{7}"
        );
    }
}
