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
    let whole: Vec<Vec<char>> = straight.iter().map(|n| n.chars().collect()).collect();
    let fits = |n: usize| text_width(&straight[n], size) <= room;
    // The number of characters left next to the dots, assuming the widest ones.
    let wide = |c: &&char| text_width(&c.to_string(), size) > 0.6 * size;
    let left = |n: usize| {
        let one = if whole[n].iter().any(|c| wide(&c)) {
            size
        } else {
            0.6 * size
        };
        ((room / one) as usize).saturating_sub(1).max(2)
    };
    // The given number of the remaining characters are at the front.
    let short = |n: usize, front: usize| -> String {
        let (chars, left) = (&whole[n], left(n));
        let (front, back) = (front.min(left), left - front.min(left));
        let (head, tail) = (&chars[..front], &chars[chars.len() - back..]);
        head.iter().chain(&['…']).chain(tail).collect()
    };
    let mut out: Vec<String> = Vec::new();
    for (n, name) in straight.iter().enumerate() {
        if fits(n) {
            out.push(name.clone());
            continue;
        }
        let middle = left(n).div_ceil(2);
        let taken = |s: &String| {
            let before = out
                .iter()
                .zip(&straight)
                .any(|(o, of)| o == s && of != name);
            before || (0..all.len()).any(|k| fits(k) && straight[k] == *s && straight[k] != *name)
        };
        // From the middle outwards, with a number if every cut equals that of another.
        let cuts = (0..=left(n)).flat_map(|by| [middle.checked_sub(by), Some(middle + by)]);
        let free = cuts
            .flatten()
            .filter(|f| *f <= left(n))
            .map(|f| short(n, f))
            .find(|s| !taken(s));
        out.push(free.unwrap_or_else(|| {
            let numbered = |k: usize| {
                let short = short(n, middle);
                let number = format!("…{k}");
                let kept = short.chars().count().saturating_sub(number.chars().count());
                short
                    .chars()
                    .take(kept)
                    .chain(number.chars())
                    .collect::<String>()
            };
            (2..).map(numbered).find(|s| !taken(s)).unwrap_or_default()
        }));
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
