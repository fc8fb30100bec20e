//! The room that text takes, and text cut and broken to fit a room.

/// The width of `text` at `size` pixels, taken wide: the fonts are not known here.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let of = |c| {
        if c < '\u{1100}' || ('\u{2000}'..'\u{2070}').contains(&c) {
            0.6
        } else {
            1.0
        }
    };
    text.chars().map(of).sum::<f64>() * size
}

/// `text` in one line, cut to `room` pixels.
pub(crate) fn cut(text: &str, size: f64, room: f64) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if width(&text, size) <= room {
        return text;
    }
    let mut short = String::new();
    for c in text.chars() {
        short.push(c);
        if width(&short, size) > room - size {
            short.pop();
            break;
        }
    }
    format!("{}…", short.trim_end())
}

/// `text` in lines of at most `room` pixels; a longer word is cut.
pub(crate) fn wrap(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word = cut(word, size, room);
        if let Some(line) = lines.last_mut() {
            let longer = format!("{line} {word}");
            if width(&longer, size) <= room {
                *line = longer;
                continue;
            }
        }
        lines.push(word);
    }
    lines
}
