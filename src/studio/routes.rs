//! Which address does what.

use super::desk::Refused;
use super::disk::Opening;
use super::http::{Asked, Reply};
use super::idea::{self, Taken};
use super::room::{self, Room};
use super::{paper, shelf, work};
use crate::api::export;
use crate::draw::{Subject, kinematic, scheme};
use crate::file::edit::Edit;
use crate::model::mechanism::StateId;
use crate::robots::formats;
use serde::Deserialize;
use serde_json::{Value, json};

/// What is sent: a change, and what it is made of.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Changes {
    edits: Vec<Edit>,
    revision: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saving {
    name: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    name: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Idea {
    idea: usize,
    revision: u64,
}

/// The number of a wider request, from 0; `None` for the first request.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Wider {
    wider: Option<usize>,
    revision: u64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Yes {
    yes: bool,
}

/// Answers a request that was let in, by the rest of its path.
pub(super) fn answer(asked: &Asked, path: &str, room: &Room) -> Reply {
    match asked.method.as_str() {
        "GET" => get(path, room),
        "POST" => match post(asked, path, room) {
            Ok(value) => Reply::json(&value),
            Err(Refused::Conflict(why)) => Reply::refusal(409, &why),
            Err(why) => Reply::refusal(422, &why.to_string()),
        },
        _ => Reply::refusal(405, "only GET and POST are supported"),
    }
}

fn nothing_here() -> Reply {
    Reply::refusal(404, "nothing exists at this address")
}

fn get(path: &str, room: &Room) -> Reply {
    match path {
        "" => Reply::new("text/html; charset=utf-8", paper::html()),
        "studio.js" => Reply::new("text/javascript; charset=utf-8", paper::script()),
        "studio.css" => Reply::new("text/css; charset=utf-8", paper::style()),
        "icon.svg" => Reply::new("image/svg+xml", paper::ICON),
        "palette" => Reply::json(&shelf::joint_types()),
        "shelf" => Reply::json(&shelf::list()),
        "status" => Reply::json(&room.status()),
        _ => match path.split_once('/') {
            Some(("picture", name)) => {
                let picture = name.strip_suffix(".svg").and_then(shelf::picture);
                picture.map_or_else(nothing_here, |svg| Reply::new("image/svg+xml", svg))
            }
            Some(("export", format)) => exported(format, room),
            _ => nothing_here(),
        },
    }
}

/// The mechanism in another format, to be saved by the browser.
fn exported(format: &str, room: &Room) -> Reply {
    let (reading, name) = {
        let desk = room.desk();
        (desk.reading.clone(), desk.state()["name"].clone())
    };
    let Some(m) = reading.mechanism.clone().filter(|_| !reading.partly) else {
        return Reply::refusal(
            422,
            "the mechanism is incomplete and cannot be exported; see the problems",
        );
    };
    let subject = || Subject {
        mechanism: &m,
        state: StateId::FREE,
        analysis: None,
        marks: None,
    };
    let (ending, made) = match format {
        "kinematic.svg" => ("svg", Ok(kinematic(&subject()).svg)),
        "scheme.svg" => match work::states(&m) {
            Ok(found) => {
                let analysis = found.first();
                (
                    "svg",
                    Ok(scheme(&Subject {
                        analysis,
                        ..subject()
                    })
                    .svg),
                )
            }
            Err(why) => return Reply::refusal(422, &why),
        },
        word if formats::written().any(|f| f.word == word) => (word, export(&m, word)),
        _ => return nothing_here(),
    };
    match made {
        Err(why) => Reply::refusal(422, &why.to_string()),
        Ok(text) => {
            let name = name.as_str().unwrap_or_default();
            let stem = name.split('.').next().unwrap_or_default();
            let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
            let stem: String = stem.chars().map(plain).collect();
            Reply {
                saved_as: Some(format!("{stem}.{ending}")),
                ..Reply::new("application/octet-stream", text)
            }
        }
    }
}

fn read<'a, T: Deserialize<'a>>(asked: &'a Asked) -> Result<T, Refused> {
    serde_json::from_slice(&asked.body).map_err(|e| Refused::Words(format!("invalid request: {e}")))
}

fn post(asked: &Asked, path: &str, room: &Room) -> Result<Value, Refused> {
    match path {
        "edit" => {
            let Changes { edits, revision } = read(asked)?;
            let done = room.at_desk(|desk| desk.edit(&edits, revision));
            if let Err(Refused::Conflict(_)) = &done {
                // Whoever was too late gets what there is now.
                room.windows.tell(&room::event("look", &room.desk().json()));
            }
            done
        }
        "draft" => {
            let Changes { edits, .. } = read(asked)?;
            let (_, reading) = room.desk().draft(&edits)?;
            let mut out = reading.json();
            if let Some(m) = &reading.mechanism
                && let Ok(found) = work::states(m)
            {
                out["verdict"] = work::judged(m, &found, 0);
            }
            Ok(out)
        }
        "undo" | "redo" => room.at_desk(|desk| {
            desk.step(path == "redo");
            Ok(())
        }),
        "save" => {
            let Saving { name } = read(asked)?;
            room.at_desk(|desk| desk.save(name.as_deref()))
        }
        "begin" => {
            let Named { name } = read(asked)?;
            room.at_desk(|desk| {
                let opening = shelf::opening(&name, desk.folder());
                let none = || Refused::Words(format!("there is no {name} to start from"));
                let opening: Opening = opening.ok_or_else(none)?;
                desk.begin(&opening)
            })
        }
        "take" => take(&read(asked)?, room),
        "ask" => ask(&read(asked)?, room),
        "stop" => {
            room.stop(room.desk().revision);
            Ok(json!({}))
        }
        "settle" => {
            let Yes { yes } = read(asked)?;
            room.at_desk(|desk| {
                desk.settle(yes);
                Ok(())
            })
        }
        "restore" => {
            let Yes { yes } = read(asked)?;
            room.at_desk(|desk| {
                desk.restore(yes);
                Ok(())
            })
        }
        _ => Err(Refused::Words("nothing exists at this address".to_owned())),
    }
}

/// Returns the refusal of ideas of an older state of the mechanism.
fn old() -> Refused {
    Refused::Conflict(
        "the mechanism was changed after these ideas; the search runs again".to_owned(),
    )
}

fn ask(asked: &Wider, room: &Room) -> Result<Value, Refused> {
    let wider = match asked.wider {
        None => None,
        Some(n) => {
            let found = room.found(asked.revision).ok_or_else(old)?;
            Some(found.wider.get(n).cloned().ok_or_else(old)?)
        }
    };
    room.ask(wider)
}

fn take(asked: &Idea, room: &Room) -> Result<Value, Refused> {
    let found = room.found(asked.revision).ok_or_else(old)?;
    let reading = {
        let desk = room.desk();
        if desk.revision != asked.revision {
            return Err(old());
        }
        desk.reading.clone()
    };
    let taken = idea::take(&reading, &found.outcome, asked.idea)?;
    let mut told = room.at_desk(|desk| match taken {
        Taken::Edits(edits) => desk.edit(&edits, None),
        Taken::Fixed(bytes) => {
            desk.replace(bytes);
            Ok(())
        }
    })?;
    told["taken"] = json!(asked.idea);
    Ok(told)
}
