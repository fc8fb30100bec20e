//! The desk: the text with its history, its file, and what other programs have written to the file.

use super::disk::{self, Kind, OpenFile, Opening};
use super::reading::DeskReading;
use crate::file::edit::{Edit, EditError, Thing, apply_edits};
use crate::file::text::MAX_BYTES;
use serde_json::{Value, json};
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use thiserror::Error;

/// Why something is not done.
#[derive(Debug, Error)]
pub(super) enum Refused {
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error("{0}")]
    Words(String),
    /// Somebody else has changed it in between.
    #[error("{0}")]
    Conflict(String),
    #[error("{0}")]
    Disk(#[from] io::Error),
}

/// A text and the file that it belongs to, by its number.
#[derive(Debug, Clone)]
struct DeskStep {
    bytes: Arc<[u8]>,
    file: usize,
}

/// The desk.
#[derive(Debug)]
pub(super) struct Desk {
    files: Vec<OpenFile>,
    steps: Vec<DeskStep>,
    at: usize,
    /// Revision number, incremented with every change of the text.
    pub(super) revision: u64,
    pub(super) reading: Arc<DeskReading>,
    /// The content of the file that another program has written since the last save.
    theirs: Option<Arc<[u8]>>,
    /// Work that a studio left behind unsaved.
    left: Option<(PathBuf, Arc<[u8]>)>,
    /// Why unsaved work could not be kept when it was last tried.
    trouble: Option<String>,
}

impl Desk {
    pub(super) fn new(opening: &Opening) -> io::Result<Desk> {
        let (file, text) = disk::begin_opening(opening)?;
        let bytes: Arc<[u8]> = match (text, &file.held) {
            (Some(text), _) => text.into_bytes().into(),
            (None, Some(held)) => held.clone(),
            (None, None) => disk::BLANK.as_bytes().into(),
        };
        let left = file.left_behind();
        let mut out = Desk {
            files: vec![file],
            steps: vec![DeskStep { bytes, file: 0 }],
            at: 0,
            revision: 0,
            reading: Arc::default(),
            theirs: None,
            left,
            trouble: None,
        };
        out.read_text();
        Ok(out)
    }

    fn open_file(&self) -> &OpenFile {
        &self.files[self.steps[self.at].file]
    }

    fn current_bytes(&self) -> &Arc<[u8]> {
        &self.steps[self.at].bytes
    }

    fn is_saved(&self) -> bool {
        self.open_file().held.as_ref() == Some(self.current_bytes())
    }

    fn current_text(&self) -> Option<&str> {
        std::str::from_utf8(self.current_bytes()).ok()
    }

    /// Returns the path of unsaved work, if there is any.
    pub(super) fn unsaved_path(&self) -> Option<PathBuf> {
        self.open_file().kept.path.clone()
    }

    fn read_text(&mut self) {
        let file = self.open_file();
        self.reading = Arc::new(DeskReading::new(file, self.current_bytes()));
        self.revision += 1;
    }

    /// Reads a changed text, and stores it if it is not saved.
    fn text_changed(&mut self) {
        self.read_text();
        self.keep_unsaved();
    }

    /// Keeps the text if it is not saved.
    fn keep_unsaved(&mut self) {
        let (saved, bytes) = (self.is_saved(), self.current_bytes().clone());
        let number = self.steps[self.at].file;
        let file = &mut self.files[number];
        let kept = if saved {
            file.drop_kept();
            Ok(())
        } else {
            file.keep_bytes(&bytes)
        };
        self.trouble = kept.err().map(|e| {
            format!("unsaved work cannot be stored next to the file ({e}); save it, or download it")
        });
    }

    /// Returns why unsaved work cannot be kept, or `None` if it is kept or saved.
    fn keep_trouble(&self) -> Option<&String> {
        self.trouble.as_ref().filter(|_| !self.is_saved())
    }

    /// Tries once more to keep what could not be kept, and returns why it cannot.
    pub(super) fn keep_again(&mut self) -> Option<String> {
        if self.keep_trouble().is_some() {
            self.keep_unsaved();
        }
        self.keep_trouble().cloned()
    }

    /// Puts a text on top of those there were; what was undone before is gone.
    fn push_step(&mut self, bytes: Arc<[u8]>, file: usize) {
        if *self.current_bytes() == bytes && self.steps[self.at].file == file {
            return;
        }
        self.steps.truncate(self.at + 1);
        self.steps.push(DeskStep { bytes, file });
        self.at += 1;
        self.text_changed();
    }

    /// Returns the text with proposed changes, and the result of reading it.
    pub(super) fn draft_edits(&self, edits: &[Edit]) -> Result<(String, DeskReading), Refused> {
        let file = self.open_file();
        let text = match (file.kind, self.current_text()) {
            (Kind::Description, _) | (_, None) => {
                return Err(Refused::Words(
                    "robot descriptions and assemblies are read-only here; apply an idea, or \
                    convert the file to TOML with `ozols export` to draw it"
                        .to_owned(),
                ));
            }
            (Kind::Json, _) if edits.iter().any(|e| !matches!(e, Edit::Text { .. })) => {
                return Err(Refused::Words(
                    "a JSON file can only be changed as text; convert it to TOML with `ozols export` to draw it".to_owned(),
                ));
            }
            (_, Some(text)) => text,
        };
        let mut text = apply_edits(text, edits)?;
        if text.len() > MAX_BYTES {
            let words = format!("the text is longer than the {MAX_BYTES} bytes allowed");
            return Err(Refused::Words(words));
        }
        let mut reading = DeskReading::new(file, text.as_bytes());
        // Options that a new type does not allow any more are taken out, as the drawing cannot offer them.
        let drawn = edits
            .iter()
            .any(|e| matches!(e, Edit::Set { key, .. } if key == "type"));
        if drawn && !reading.outgrown.is_empty() {
            let fewer = without_outgrown(&reading);
            text = apply_edits(&text, &fewer)?;
            reading = DeskReading::new(file, text.as_bytes());
        }
        Ok((text, reading))
    }

    /// Makes changes. A text as a whole must be made of the newest, which its revision says.
    pub(super) fn apply_edits(
        &mut self,
        edits: &[Edit],
        revision: Option<u64>,
    ) -> Result<(), Refused> {
        let whole = edits.iter().any(|e| matches!(e, Edit::Text { .. }));
        if whole && revision != Some(self.revision) {
            return Err(Refused::Conflict(
                "the text was changed in another window; this is the current version".to_owned(),
            ));
        }
        let (text, _) = self.draft_edits(edits)?;
        self.push_step(text.into_bytes().into(), self.steps[self.at].file);
        Ok(())
    }

    /// Puts another form of the same file there.
    pub(super) fn replace_text(&mut self, bytes: Vec<u8>) {
        self.push_step(bytes.into(), self.steps[self.at].file);
    }

    /// Begins another file, with the steps so far to go back to.
    pub(super) fn begin_file(&mut self, opening: &Opening) -> Result<(), Refused> {
        let (file, text) = disk::begin_opening(opening)?;
        self.files.push(file);
        let text = text.unwrap_or_default();
        self.theirs = None;
        self.push_step(text.into_bytes().into(), self.files.len() - 1);
        Ok(())
    }

    /// Returns the folder of the file.
    pub(super) fn file_folder(&self) -> PathBuf {
        self.open_file().parent_folder().to_path_buf()
    }

    /// Goes one step back or forward in the history, and returns true if there was one.
    pub(super) fn step_history(&mut self, forward: bool) -> bool {
        let to = if forward {
            Some(self.at + 1).filter(|t| *t < self.steps.len())
        } else {
            self.at.checked_sub(1)
        };
        let Some(to) = to else { return false };
        self.at = to;
        self.text_changed();
        true
    }

    /// Saves, under another name in the same folder where one is given.
    pub(super) fn save_file(&mut self, name: Option<&str>) -> Result<(), Refused> {
        if let Some(name) = name.filter(|n| *n != self.open_file().name()) {
            let Some(plain) = disk::plain_name(name) else {
                return Err(Refused::Words(
                    "use letters, digits, blanks, - and _ in a name that ends in .toml; the file \
                    is saved in the folder of the open one"
                        .to_owned(),
                ));
            };
            if self.open_file().kind != Kind::Toml {
                let words = "a description is saved under its own name";
                return Err(Refused::Words(words.to_owned()));
            }
            let path = self.file_folder().join(plain);
            if path.symlink_metadata().is_ok() {
                return Err(Refused::Words(format!(
                    "{plain} already exists; choose another name"
                )));
            }
            let bytes = self.current_bytes().clone();
            let mut file = OpenFile::read(&path)?;
            file.save_bytes(&bytes)?;
            let before = self.steps[self.at].file;
            self.files[before].drop_kept();
            self.files.push(file);
            self.steps[self.at].file = self.files.len() - 1;
            self.theirs = None;
            return Ok(());
        }
        self.look_at_disk()?;
        if self.theirs.is_some() {
            return Err(Refused::Conflict(
                "the file was changed by another program; choose which version to keep".to_owned(),
            ));
        }
        let (number, bytes) = (self.steps[self.at].file, self.current_bytes().clone());
        self.files[number].save_bytes(&bytes)?;
        Ok(())
    }

    /// Looks whether another program has written to the file; whether anything is new.
    pub(super) fn look_at_disk(&mut self) -> io::Result<bool> {
        let now = self.open_file().bytes_now()?;
        let number = self.steps[self.at].file;
        // A file that is gone is waited for: many programs take it away before they write it anew.
        let Some(now) = now.filter(|n| Some(n) != self.open_file().held.as_ref()) else {
            return Ok(false);
        };
        if self.theirs.as_ref() == Some(&now) {
            return Ok(false);
        }
        if &now == self.current_bytes() {
            self.files[number].held = Some(now);
            self.files[number].drop_kept();
            self.theirs = None;
        } else if self.is_saved() {
            self.files[number].held = Some(now.clone());
            self.push_step(now, number);
        } else {
            self.theirs = Some(now);
        }
        Ok(true)
    }

    /// Resolves a conflict between two versions of the file. One version stays, and undo brings back the other.
    pub(super) fn settle_conflict(&mut self, keep_mine: bool) {
        let Some(theirs) = self.theirs.take() else {
            return;
        };
        let (number, mine) = (self.steps[self.at].file, self.current_bytes().clone());
        self.files[number].held = Some(theirs.clone());
        self.push_step(theirs, number);
        if keep_mine {
            self.push_step(mine, number);
        }
    }

    /// Takes what was left behind, or leaves it and takes its file away.
    pub(super) fn restore_left(&mut self, take: bool) {
        let Some((path, bytes)) = self.left.take() else {
            return;
        };
        if take {
            self.push_step(bytes, self.steps[self.at].file);
        }
        // Now it is kept by this studio, or nobody wants it.
        if self.unsaved_path().as_ref() != Some(&path) {
            let _ = std::fs::remove_file(path);
        }
    }

    /// Returns the state of the desk for the page, which changes with every text.
    pub(super) fn desk_json(&self) -> Value {
        let mut out = self.reading.reading_json();
        out["revision"] = json!(self.revision);
        out["text"] = json!(self.current_text());
        out["desk"] = self.file_state();
        out
    }

    /// Returns the state of the file.
    pub(super) fn file_state(&self) -> Value {
        let kind = match self.open_file().kind {
            Kind::Toml => "toml",
            Kind::Json => "json",
            Kind::Description => "description",
        };
        json!({
            "name": self.open_file().name(),
            "kind": kind,
            "saved": self.is_saved(),
            "there": self.open_file().held.is_some(),
            "undo": self.at > 0,
            "redo": self.at + 1 < self.steps.len(),
            "conflict": self.theirs.is_some(),
            "left": self.left.as_ref().map(|(path, _)| path.file_name().unwrap_or_default().to_string_lossy()),
            "trouble": self.keep_trouble(),
        })
    }
}

/// Returns the edits that remove outdated options from the lists of their joints.
fn without_outgrown(reading: &DeskReading) -> Vec<Edit> {
    let joints = reading.file.iter().flat_map(|f| &f.joint);
    let one = |j: &crate::file::schema::JointEntry| {
        let gone: Vec<&str> = reading
            .outgrown
            .iter()
            .filter(|(joint, _)| *joint == j.id)
            .map(|(_, option)| option.as_str())
            .collect();
        let options = j.options.as_ref().filter(|_| !gone.is_empty())?;
        let named = |v: &Value| {
            let word = v.get("name").or_else(|| v.get("type")).unwrap_or(v);
            word.as_str().is_some_and(|w| gone.contains(&w))
        };
        let mut value = serde_json::to_value(options).unwrap_or_default();
        if let Value::Array(list) = &mut value {
            list.retain(|v| !named(v));
            for v in list.iter_mut().filter_map(Value::as_object_mut) {
                v.retain(|_, x| !x.is_null());
            }
        }
        Some(Edit::Set {
            what: Thing::Joint,
            id: j.id.clone(),
            key: "options".to_owned(),
            value,
        })
    };
    joints.filter_map(one).collect()
}
