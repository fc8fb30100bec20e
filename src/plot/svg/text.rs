//! The space that text takes, and text cut and broken to fit a space.

use crate::format::plain::escape_direction;

/// Returns the width of `text` at `size` pixels, estimated generously because the fonts are unknown here.
pub fn text_width(text: &str, size: f64) -> f64 {
    let of = |c| {
        if c < '\u{1100}' || ('\u{2000}'..'\u{2070}').contains(&c) {
            0.6
        } else {
            1.0
        }
    };
    text.chars().map(of).sum::<f64>() * size
}

/// Returns `text` in one line, cut to `room` pixels.
pub fn cut_text(text: &str, size: f64, room: f64) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if text_width(&text, size) <= room {
        return text;
    }
    let mut short = String::new();
    for c in text.chars() {
        short.push(c);
        if text_width(&short, size) > room - size {
            short.pop();
            break;
        }
    }
    format!("{}…", short.trim_end())
}

/// Returns names in one line, each shortened in its middle to `room` pixels. Different names stay different.
pub fn shorten_names(all: &[&str], size: f64, room: f64) -> Vec<String> {
    let straight: Vec<String> = all
        .iter()
        .map(|n| escape_direction(&cut_text(n, size, f64::INFINITY)).into_owned())
        .collect();
    let mut out: Vec<String> = Vec::new();
    for name in &straight {
        if text_width(name, size) <= room {
            out.push(name.clone());
            continue;
        }
        let chars: Vec<char> = name.chars().collect();
        // The number of characters left next to the dots, assuming the widest ones.
        let widths = chars.iter().map(|c| text_width(&c.to_string(), size));
        let widest = widths.fold(0.0, f64::max);
        let left = ((room / widest) as usize).saturating_sub(1).max(2);
        let (head, tail) = (&chars[..left.div_ceil(2)], &chars[chars.len() - left / 2..]);
        let short = || head.iter().chain(&['…']).chain(tail).copied();
        // With a number if it equals that of another.
        let numbered = |k: usize| match k {
            1 => short().collect(),
            k => {
                let number = format!("…{k}");
                let kept = (left + 1).saturating_sub(number.chars().count());
                short().take(kept).chain(number.chars()).collect()
            }
        };
        let is_taken = |s: &String| {
            let mut known = out.iter().zip(&straight);
            let other = straight.iter().any(|of| of == s && of != name);
            other || known.any(|(o, of)| o == s && of != name)
        };
        out.extend((1..).map(numbered).find(|s| !is_taken(s)));
    }
    out
}

/// Returns `text` in lines of at most `room` pixels; a longer word is cut.
pub(crate) fn wrap_text(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word = cut_text(word, size, room);
        if let Some(line) = lines.last_mut() {
            let longer = format!("{line} {word}");
            if text_width(&longer, size) <= room {
                *line = longer;
                continue;
            }
        }
        lines.push(word);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{shorten_names, text_width};
    use std::collections::BTreeSet;

    #[test]
    fn long_names_are_shortened_in_their_middle_and_stay_apart() {
        let same = |n: usize| format!("left_front_suspension_{n:03}_of_the_long_wheelbase_version");
        let all: Vec<String> = (0..300).map(same).collect();
        let all: Vec<&str> = all
            .iter()
            .map(String::as_str)
            .chain(["A", "short"])
            .collect();
        let short = shorten_names(&all, 11.0, 90.0);
        assert!(
            short.iter().all(|s| text_width(s, 11.0) <= 90.0),
            "{short:?}"
        );
        assert_eq!(short.iter().collect::<BTreeSet<_>>().len(), all.len());
        assert!(
            short[0].starts_with("left_") && short[0].ends_with("ersion"),
            "{}",
            short[0]
        );
        assert_eq!(short[300..], ["A", "short"]);
        // The same name gives the same text.
        assert_eq!(
            shorten_names(&[all[0], all[0]], 11.0, 90.0),
            [short[0].clone(), short[0].clone()]
        );
        // No text changes the direction of letters, and no text has two lines.
        assert_eq!(
            shorten_names(&["a\u{202e}b\nc"], 11.0, 150.0),
            ["a\\u{202e}b c"]
        );
    }
}
