//! The reading of a text: the mechanism, its entries and positions, and every problem with the thing that it concerns.

use super::disk::{Kind, OpenFile};
use crate::api;
use crate::file::edit::Thing;
use crate::file::lint::check_file;
use crate::file::locate::{Document, DocumentPath};
use crate::file::loose;
use crate::file::problem::{ImportError, ProblemKind};
use crate::file::read::build_mechanism;
use crate::file::schema::MechanismFile;
use crate::file::text::{read_file, text_of};
use crate::file::write::mechanism_file;
use crate::geom::vector::to_vector;
use crate::model::mechanism::Mechanism;
use crate::robots::{Imported, Options};
use serde_json::{Value, json};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// The reading of a text.
#[derive(Debug, Default)]
pub(super) struct DeskReading {
    /// The mechanism to analyse: all of it, or the part connected to the frame.
    pub(super) mechanism: Option<Arc<Mechanism>>,
    /// Whether that is less than what is written.
    pub(super) partly: bool,
    /// The entries, as far as the text is one of a mechanism.
    pub(super) file: Option<MechanismFile>,
    /// Where joints and points of interest are.
    places: Places,
    /// Errors and warnings.
    told: Vec<Value>,
    /// The lines of each item.
    items: Vec<Value>,
    /// Options that a joint has outgrown: joint and option.
    pub(super) outgrown: Vec<(String, String)>,
    /// The description, where it is one.
    pub(super) imported: Option<Box<Imported>>,
}

/// Where joints and points of interest are, as far as that is known.
type Places = [Vec<Option<[f64; 3]>>; 2];

fn places_of(m: &Mechanism) -> Places {
    let joints = m.joints.iter().map(|j| &j.frame.point);
    let joints = joints.map(|p| Some(to_vector(p))).collect();
    let points = m.points.iter().map(|p| Some(to_vector(&p.point)));
    [joints, points.collect()]
}

/// How much a problem weighs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Weight {
    Wrong,
    Doubtful,
    /// Not there yet: the page says what to draw next.
    Unfinished,
}

impl DeskReading {
    /// Reads a text of a file.
    pub(super) fn new(file: &OpenFile, bytes: &[u8]) -> DeskReading {
        match file.kind {
            Kind::Description => DeskReading::read_description(&file.path, bytes, &file.options),
            kind => DeskReading::read_own(&file.path, kind, bytes),
        }
    }

    /// Reads a text of a mechanism file.
    fn read_own(path: &Path, kind: Kind, bytes: &[u8]) -> DeskReading {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let mut out = DeskReading::default();
        let text = match text_of(&name, bytes) {
            Ok(text) => text,
            Err(e) => {
                out.add_problems(&e, &Items::default());
                return out;
            }
        };
        let items = Items::new(text, kind == Kind::Json);
        let (mut file, mut part) = (None, None);
        let made = read_file(&name, text, |f| {
            file = Some(f.clone());
            build_mechanism(f)
        });
        match made {
            Ok(mechanism) => {
                out.places = places_of(&mechanism);
                if let Ok(checked) = check_file(&name, bytes) {
                    for w in &checked.warnings.warnings {
                        let weight = match w.kind {
                            ProblemKind::NoContour | ProblemKind::NoOutput => Weight::Unfinished,
                            _ => Weight::Doubtful,
                        };
                        out.add_remark(text, w.span.clone(), &w.kind.to_string(), &items, weight);
                    }
                }
                out.mechanism = Some(Arc::new(mechanism));
            }
            Err(e) => {
                out.add_problems(&e, &items);
                if let Some(f) = &file {
                    out.places = loose::read_points(f);
                    part = loose::connected_part(f).and_then(|f| build_mechanism(&f).ok());
                }
            }
        }
        if let Some(mechanism) = part {
            (out.mechanism, out.partly) = (Some(Arc::new(mechanism)), true);
        }
        out.items = items.items_json(text);
        out.file = file;
        out
    }

    fn read_description(path: &Path, bytes: &[u8], options: &Options) -> DeskReading {
        let mut out = DeskReading::default();
        match api::description_of(path, bytes, options) {
            Ok(imported) => {
                let m = &imported.mechanism;
                out.places = places_of(m);
                out.file = Some(mechanism_file(m));
                let doubts = imported.report.list_doubts();
                for line in doubts.lines().filter(|l| !l.trim().is_empty()) {
                    out.add_remark("", None, line.trim(), &Items::default(), Weight::Doubtful);
                }
                out.mechanism = Some(Arc::new(m.clone()));
                out.imported = Some(Box::new(imported));
            }
            Err(api::Error::File(e)) => out.add_problems(&e, &Items::default()),
            Err(e) => out.add_remark("", None, &e.to_string(), &Items::default(), Weight::Wrong),
        }
        out
    }

    fn add_problems(&mut self, e: &ImportError, items: &Items) {
        for p in &e.problems {
            if let ProblemKind::LosesMotion { joint, option, .. } = &p.kind {
                self.outgrown.push((joint.clone(), option.clone()));
            }
            let weight = match p.kind {
                ProblemKind::Unused { .. } | ProblemKind::Disconnected { .. } => Weight::Unfinished,
                _ => Weight::Wrong,
            };
            self.add_remark(&e.text, p.span.clone(), &p.kind.to_string(), items, weight);
        }
    }

    fn add_remark(
        &mut self,
        text: &str,
        span: Option<Range<usize>>,
        words: &str,
        items: &Items,
        weight: Weight,
    ) {
        // What follows a semicolon is the remedy, as in the terminal.
        let (words, remedy) = match words.split_once("; ") {
            Some((words, remedy)) => (words, Some(remedy)),
            None => (words, None),
        };
        let line = span.as_ref().map(|s| line_of(text, s.start));
        let about = span.and_then(|s| items.item_at(s.start));
        let about = about.map(|(what, n)| json!([what.word(), n]));
        self.told.push(json!({
            "words": words, "remedy": remedy, "line": line, "about": about,
            "grave": weight == Weight::Wrong, "unfinished": weight == Weight::Unfinished,
        }));
    }

    /// Returns the whole reading for the page.
    pub(super) fn reading_json(&self) -> Value {
        json!({
            "file": self.file.as_ref().map(MechanismFile::json),
            "places": { "joint": self.places[0], "point": self.places[1] },
            "items": self.items,
            "told": self.told,
            "partly": self.partly,
            "whole": self.mechanism.is_some() && !self.partly,
        })
    }
}

/// Returns the line of a byte, from 1.
fn line_of(text: &str, at: usize) -> usize {
    let before = text.get(..at).unwrap_or(text);
    before.matches('\n').count() + 1
}

/// The ranges of the items of a text, in its order.
#[derive(Debug, Default)]
struct Items(Vec<(Thing, usize, Range<usize>)>);

impl Items {
    fn new(text: &str, json: bool) -> Items {
        let Ok(document) = Document::parse(text, json) else {
            return Items::default();
        };
        let mut out = Vec::new();
        for what in [Thing::Link, Thing::Joint, Thing::Point] {
            let list = DocumentPath::root_key(what.word());
            for n in 0.. {
                let path = list.entry_at(n);
                // The span of a list stands for that of an item that is not there.
                let Some(span) = document
                    .find_span(&path)
                    .filter(|s| out.iter().all(|(_, _, r)| r != s))
                    .filter(|s| document.find_span(&list).as_ref() != Some(s) || n == 0)
                else {
                    break;
                };
                out.push((what, n, span));
            }
        }
        out.sort_by_key(|(_, _, span)| span.start);
        if !json {
            // The span of a table is that of its head: it goes on to the next.
            for (_, _, span) in &mut out {
                let rest = text.get(span.end..).unwrap_or_default();
                let next = rest.find("\n[").map_or(text.len(), |n| span.end + n);
                span.end = next.max(span.end);
            }
        }
        Items(out)
    }

    /// Returns the item that contains a byte.
    fn item_at(&self, byte: usize) -> Option<(Thing, usize)> {
        let found = self.0.iter().rfind(|(_, _, s)| s.contains(&byte));
        found.map(|&(what, n, _)| (what, n))
    }

    fn items_json(&self, text: &str) -> Vec<Value> {
        let line = |at| line_of(text, at);
        let one = |(what, n, s): &(Thing, usize, Range<usize>)| {
            json!([what.word(), n, line(s.start), line(s.end)])
        };
        self.0.iter().map(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_stands_beside_its_item() {
        let text = "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[joint]]\nid = \"a\"\n\
                    links = [\"0\", \"1\"]\ntype = \"revolut\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n";
        let read = DeskReading::read_own(Path::new("x.toml"), Kind::Toml, text.as_bytes());
        assert!(read.mechanism.is_none());
        let told = &read.reading_json()["told"][0];
        assert_eq!(told["about"], json!(["joint", 0]), "{told}");
        assert_eq!(told["line"], 10);
        assert_eq!(
            read.reading_json()["items"].as_array().map(Vec::len),
            Some(3)
        );
    }

    #[test]
    fn a_first_bar_is_unfinished_not_wrong() {
        let text = "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[point]]\nid = \"end 1\"\nlink = \"1\"\n\
                    point = [0, 0, 0]\n";
        let read =
            DeskReading::read_own(Path::new("x.toml"), Kind::Toml, text.as_bytes()).reading_json();
        let told = read["told"].as_array().map_or(&[][..], Vec::as_slice);
        assert_eq!(told.len(), 2, "{told:?}");
        for t in told {
            assert!(t["unfinished"] == true && t["grave"] == false, "{t}");
        }
    }

    #[test]
    fn what_hangs_on_the_frame_is_told_of() {
        let text = "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[link]]\nid = \"2\"\n[[joint]]\nid = \"a\"\n\
                    links = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n[[point]]\nid = \"p\"\nlink = \"2\"\npoint = [1, \"sqrt(2)\", 0]\n";
        let read = DeskReading::read_own(Path::new("x.toml"), Kind::Toml, text.as_bytes());
        assert!(read.partly && read.mechanism.is_some());
        let y = &read.reading_json()["places"]["point"][0][1];
        assert!(
            (y.as_f64().unwrap_or_default() - 2_f64.sqrt()).abs() < 1e-12,
            "{y}"
        );
    }
}
