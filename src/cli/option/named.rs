//! FILE arguments as they were typed: paths of any bytes, which are told as text.

use clap::{Args as ClapArgs, ValueHint};
use std::ffi::OsString;
use std::fmt;
use std::ops::Deref;
use std::path::Path;

/// A path, `-`, or the name of a built-in mechanism. As a text, what is none in it is replaced.
#[derive(Debug, Clone)]
pub(in crate::cli) struct Named {
    typed: OsString,
    text: String,
}

impl Named {
    /// What it is as a path.
    pub(in crate::cli) fn path(&self) -> &Path {
        Path::new(&self.typed)
    }
}

impl From<OsString> for Named {
    fn from(typed: OsString) -> Named {
        let text = typed.to_string_lossy().into_owned();
        Named { typed, text }
    }
}

impl From<&str> for Named {
    fn from(name: &str) -> Named {
        Named::from(OsString::from(name))
    }
}

impl Deref for Named {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct File {
    /// A path, `-`, or the name of a built-in mechanism.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) file: Named,
}
