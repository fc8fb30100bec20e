//! How to get what a page shows from the command line.

use super::embed::text;

/// Commands, quoted for a shell.
#[derive(Debug, Clone)]
pub struct Commands {
    /// What each gives, and the command.
    pub rows: Vec<(String, String)>,
    /// The same about one variant, with `{}` for its number; none where other commands cannot be asked the same.
    pub variant: Vec<(String, String)>,
}

impl Commands {
    pub(super) fn html(&self) -> String {
        let mut out = String::from("<dl class=\"commands\">\n");
        for (what, command) in &self.rows {
            out += &format!(
                "<dt>{}</dt><dd><code>{}</code></dd>\n",
                text(what),
                text(command)
            );
        }
        out + "</dl>\n"
    }
}
