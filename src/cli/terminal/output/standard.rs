//! Standard output. Nothing is drawn over what is written, and where a person looks, no text of a file steers the terminal.

use crate::cli::terminal::spinner;
use crate::format::plain::coloured;
use std::io::{self, IsTerminal, StdoutLock, Write};

/// Standard output, held.
pub(super) struct Standard {
    out: StdoutLock<'static>,
    /// The beginning of a line whose rest is to come, where there is a terminal.
    line: Option<Vec<u8>>,
}

impl Standard {
    pub(super) fn new() -> Standard {
        let out = io::stdout();
        let line = out.is_terminal().then(Vec::new);
        Standard {
            out: out.lock(),
            line,
        }
    }
}

impl Write for Standard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        spinner::rest();
        let Some(line) = &mut self.line else {
            return self.out.write(bytes);
        };
        line.extend_from_slice(bytes);
        if let Some(end) = line.iter().rposition(|b| *b == b'\n') {
            let rest = line.split_off(end + 1);
            let whole = std::mem::replace(line, rest);
            show(&mut self.out, &whole)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(line) = &mut self.line {
            show(&mut self.out, &std::mem::take(line))?;
        }
        self.out.flush()
    }
}

fn show(out: &mut dyn Write, bytes: &[u8]) -> io::Result<()> {
    out.write_all(coloured(&String::from_utf8_lossy(bytes)).as_bytes())
}

#[cfg(test)]
mod tests {
    use super::show;

    #[test]
    fn colours_pass_and_nothing_else_does() {
        let mut out = Vec::new();
        show(&mut out, "\u{1b}[1mσ\u{1b}[0m \u{1b}]0;x\u{7}\n".as_bytes()).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text, "\u{1b}[1mσ\u{1b}[0m \\u{1b}]0;x\\u{7}\n");
    }
}
