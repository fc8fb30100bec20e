//! What several tests need: closeness, a text with one thing changed, the program on a file of one's own.

use crate::cli::ozols;
use std::fs;

pub(crate) fn near(found: f64, stated: f64, tolerance: f64) {
    assert!(
        (found - stated).abs() <= tolerance,
        "found {found}, stated {stated}"
    );
}

/// A text with the first of one thing replaced; it must be there.
pub(crate) fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

/// Exit code, standard output and standard error of a command on a file with this text.
pub(crate) fn run_on(
    command: &str,
    name: &str,
    text: &str,
    more: &[&str],
) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let args = [&[command, path.to_str().unwrap()], more].concat();
    let o = ozols(&args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (o.status.code(), text(o.stdout), text(o.stderr))
}
