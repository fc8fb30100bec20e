//! Which address does what.

use super::desk::Refused;
use super::http::{Asked, Reply};
use super::idea::{self, Taken};
use super::room::{self, Found, Room};
use super::{paper, shelf, work};
use crate::api::export;
use crate::draw::{Subject, kinematic, scheme};
use crate::file::edit::Edit;
use crate::model::mechanism::StateId;
use crate::robots::formats;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::sync::Arc;

/// The content of a request: each address takes some of these.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Sent {
    edits: Vec<Edit>,
    /// The revision that it is made of, or that ideas are of.
    revision: Option<u64>,
    name: Option<String>,
    /// The number of an idea, from 1.
    idea: usize,
    /// The number of a wider request, from 0; `None` for the first request.
    wider: Option<usize>,
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
                let analysed = Subject {
                    analysis: found.first(),
                    ..subject()
                };
                ("svg", Ok(scheme(&analysed).svg))
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

fn post(asked: &Asked, path: &str, room: &Room) -> Result<Value, Refused> {
    // As an object first: a list would be taken for the fields in their order.
    let sent = serde_json::from_slice::<Map<String, Value>>(&asked.body)
        .and_then(|all| serde_json::from_value::<Sent>(all.into()))
        .map_err(|e| Refused::Words(format!("invalid request: {e}")))?;
    match path {
        "edit" => {
            let done = room.at_desk(|desk| desk.edit(&sent.edits, sent.revision));
            if let Err(Refused::Conflict(_)) = &done {
                // Whoever was too late gets what there is now.
                room.windows.tell(&room::event("look", &room.desk().json()));
            }
            done
        }
        "draft" => {
            let (_, reading) = room.desk().draft(&sent.edits)?;
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
        "save" => room.at_desk(|desk| desk.save(sent.name.as_deref())),
        "begin" => room.at_desk(|desk| {
            let name = sent.name.unwrap_or_default();
            let opening = shelf::opening(&name, desk.folder());
            let none = || Refused::Words(format!("there is no {name} to start from"));
            desk.begin(&opening.ok_or_else(none)?)
        }),
        "take" => take(&sent, room),
        "ask" => ask(&sent, room),
        "stop" => {
            room.stop(room.desk().revision);
            Ok(json!({}))
        }
        "settle" => room.at_desk(|desk| {
            desk.settle(sent.yes);
            Ok(())
        }),
        "restore" => room.at_desk(|desk| {
            desk.restore(sent.yes);
            Ok(())
        }),
        _ => Err(Refused::Words("nothing exists at this address".to_owned())),
    }
}

/// Returns the refusal of ideas of an older state of the mechanism.
fn old() -> Refused {
    Refused::Conflict(
        "the mechanism was changed after these ideas; the search runs again".to_owned(),
    )
}

/// Returns what was found of the revision that a request is of.
fn found(sent: &Sent, room: &Room) -> Result<Arc<Found>, Refused> {
    let found = sent.revision.and_then(|r| room.found(r));
    found.ok_or_else(old)
}

fn ask(sent: &Sent, room: &Room) -> Result<Value, Refused> {
    let wider = |n| found(sent, room)?.wider.get(n).cloned().ok_or_else(old);
    room.ask(sent.wider.map(wider).transpose()?)
}

fn take(sent: &Sent, room: &Room) -> Result<Value, Refused> {
    let found = found(sent, room)?;
    let reading = {
        let desk = room.desk();
        if desk.revision != found.revision {
            return Err(old());
        }
        desk.reading.clone()
    };
    let taken = idea::take(&reading, &found.outcome, sent.idea)?;
    let mut told = room.at_desk(|desk| match taken {
        Taken::Edits(edits) => desk.edit(&edits, None),
        Taken::Fixed(bytes) => {
            desk.replace(bytes);
            Ok(())
        }
    })?;
    told["taken"] = json!(sent.idea);
    Ok(told)
}
