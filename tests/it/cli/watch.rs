//! `ozols watch`: the page follows its file, whatever an editor does to it, until it is told to end.
#![cfg(unix)]

use crate::common::{changed, out, text};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// Longer than any machine takes.
const LONG: Duration = Duration::from_secs(120);

struct Watched {
    child: Child,
    said: Receiver<String>,
}

fn listen(err: ChildStderr) -> Receiver<String> {
    let (tell, said) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(err).lines().map_while(Result::ok) {
            if tell.send(line).is_err() {
                return;
            }
        }
    });
    said
}

impl Watched {
    fn new(folder: &Path, more: &[&str]) -> Watched {
        let mut child = Command::new(env!("CARGO_BIN_EXE_ozols"))
            .args(["watch", "mine.toml", "--top", "5"])
            .args(more)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let said = listen(child.stderr.take().unwrap());
        Watched { child, said }
    }

    /// All that is said up to a line that has these words.
    fn until(&self, words: &str) -> String {
        let mut all = String::new();
        loop {
            let line = self
                .said
                .recv_timeout(LONG)
                .unwrap_or_else(|_| panic!("never: {words}\n{all}"));
            all += &line;
            all.push('\n');
            if line.contains(words) {
                return all;
            }
        }
    }

    fn end(mut self) -> (Option<i32>, String) {
        let id = self.child.id().to_string();
        assert!(
            Command::new("kill")
                .args(["-INT", &id])
                .status()
                .unwrap()
                .success()
        );
        let code = self.child.wait().unwrap().code();
        (code, self.said.iter().collect::<Vec<_>>().join("\n"))
    }
}

#[test]
fn the_page_follows_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let at = |name: &str| folder.join(name);
    let own = out(&["show", "four-bar"]);
    fs::write(at("mine.toml"), &own).unwrap();
    let watched = Watched::new(folder, &[]);
    let said = watched.until("is new");
    assert!(
        said.contains("mine.toml: free: 3 redundant constraints, W = 1"),
        "{said}"
    );
    let first = fs::read_to_string(at("mine.html")).unwrap();
    assert!(first.contains("location.reload"));

    // written in place, with a mistake: told, and the page stays
    fs::write(at("mine.toml"), changed(&own, "revolute", "revolut")).unwrap();
    let said = watched.until("stays as it was");
    assert!(
        said.contains("unknown joint type \"revolut\"") && said.contains("mine.toml:"),
        "{said}"
    );
    assert_eq!(fs::read_to_string(at("mine.html")).unwrap(), first);

    // mended as many editors write: another file, which takes the name
    let spherical = changed(&own, "type = \"revolute\"", "type = \"spherical\"");
    fs::write(at("mine.toml~"), &spherical).unwrap();
    fs::rename(at("mine.toml~"), at("mine.toml")).unwrap();
    let said = watched.until("is new");
    assert!(
        said.contains("free: 1 redundant constraint, W = 1"),
        "{said}"
    );
    let second = fs::read_to_string(at("mine.html")).unwrap();
    assert_ne!(first, second);

    // taken away and put back, as others do
    fs::remove_file(at("mine.toml")).unwrap();
    fs::write(at("mine.toml"), &own).unwrap();
    let said = watched.until("is new");
    assert!(said.contains("3 redundant constraints"), "{said}");
    assert_eq!(fs::read_to_string(at("mine.html")).unwrap(), first);

    let (code, said) = watched.end();
    assert_eq!(code, Some(130));
    assert_eq!(said, "interrupted by Ctrl-C");
    let mut left: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(left, ["mine.html", "mine.toml"]);
}

#[test]
fn what_is_written_again_as_it_is_is_not_looked_at_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let own = out(&["show", "four-bar"]);
    fs::write(folder.join("mine.toml"), &own).unwrap();
    fs::write(folder.join("costs.toml"), "spherical = 2\n").unwrap();
    let watched = Watched::new(folder, &["--costs", "costs.toml", "-o", "page.html"]);
    watched.until("page.html is new");
    // the same again, and other files: nothing to tell
    fs::write(folder.join("mine.toml"), &own).unwrap();
    fs::write(folder.join("other.toml"), "x").unwrap();
    fs::write(folder.join("costs.toml"), "spherical = 9\n").unwrap();
    let said = watched.until("page.html is new");
    assert_eq!(said.matches("is new").count(), 1);
    let (code, said) = watched.end();
    assert_eq!((code, said.as_str()), (Some(130), "interrupted by Ctrl-C"));
}

#[test]
fn what_cannot_change_is_not_watched() {
    for file in ["four-bar", "-", "nothing.toml"] {
        let o = crate::common::run(&["watch", file]);
        assert_eq!(o.status.code(), Some(2), "{file}");
        let err = text(&o.stderr);
        assert!(err.contains("ozols new mine.toml"), "{err}");
    }
}
