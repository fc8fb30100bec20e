//! Which address does what. The report and the studio draw with the same scripts.

use super::desk::Refused;
use super::disk::Opening;
use super::http::{Asked, Reply};
use super::idea::{self, Taken};
use super::room::{self, Found, Room};
use super::{shelf, work};
use crate::api::export;
use crate::draw::{SHEET_STYLE, Subject, kinematic, scheme};
use crate::file::edit::Edit;
use crate::model::mechanism::StateId;
use crate::page::{LOOK, SHARED};
use crate::robots::formats;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::sync::Arc;

/// The studio's own scripts by idea, in the order they are run, after those that the report's page shares with it.
const SCRIPTS: [&str; 21] = [
    include_str!("script/talk.js"),
    include_str!("script/things.js"),
    include_str!("script/number.js"),
    include_str!("script/units.js"),
    include_str!("script/camera.js"),
    include_str!("script/preview.js"),
    include_str!("script/sheet.js"),
    include_str!("script/snap.js"),
    include_str!("script/build.js"),
    include_str!("script/tools.js"),
    include_str!("script/pointer.js"),
    include_str!("script/measure.js"),
    include_str!("script/inspect.js"),
    include_str!("script/search.js"),
    include_str!("script/verdict.js"),
    include_str!("script/ideas.js"),
    include_str!("script/text.js"),
    include_str!("script/curves.js"),
    include_str!("script/shelf.js"),
    include_str!("script/keys.js"),
    include_str!("script/main.js"),
];
const STYLES: [&str; 3] = [SHEET_STYLE, LOOK, include_str!("studio.css")];

/// The frame of the page, which the scripts fill.
const PAGE: &str = include_str!("page.html");

/// The content of a request: each address takes some of these.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Sent {
    edits: Vec<Edit>,
    /// The revision that it is made of, or that ideas are of.
    revision: Option<u64>,
    name: Option<String>,
    /// The text of a file that the browser has opened.
    text: Option<String>,
    /// The number of an idea, from 1.
    idea: usize,
    /// The number of a wider request, from 0; `None` for the first request.
    wider: Option<usize>,
    yes: bool,
}

/// Handles an admitted request, by the rest of its path.
pub(super) fn answer_request(asked: &Asked, path: &str, room: &Room) -> Reply {
    match asked.method.as_str() {
        "GET" => answer_get(path, room),
        "POST" => match answer_post(asked, path, room) {
            Ok(value) => Reply::json_reply(&value),
            Err(Refused::Conflict(why)) => Reply::refusal_reply(409, &why),
            Err(why) => Reply::refusal_reply(422, &why.to_string()),
        },
        _ => Reply::refusal_reply(405, "only GET and POST are supported"),
    }
}

fn nothing_here() -> Reply {
    Reply::refusal_reply(404, "nothing exists at this address")
}

fn answer_get(path: &str, room: &Room) -> Reply {
    match path {
        "" => Reply::new("text/html; charset=utf-8", PAGE),
        "studio.js" => Reply::new(
            "text/javascript; charset=utf-8",
            [SHARED.concat(), SCRIPTS.concat()].concat(),
        ),
        "studio.css" => Reply::new("text/css; charset=utf-8", STYLES.concat()),
        "icon.svg" => Reply::new("image/svg+xml", shelf::ICON),
        "palette" => Reply::json_reply(&shelf::joint_types()),
        "shelf" => Reply::json_reply(&shelf::shelf_list()),
        "status" => Reply::json_reply(&room.status_json()),
        _ => match path.split_once('/') {
            Some(("picture", name)) => {
                let picture = name.strip_suffix(".svg").and_then(shelf::picture_of);
                picture.map_or_else(nothing_here, |svg| Reply::new("image/svg+xml", svg))
            }
            Some(("export", format)) => export_reply(format, room),
            _ => nothing_here(),
        },
    }
}

/// Returns the mechanism in another format, for the browser to save.
fn export_reply(format: &str, room: &Room) -> Reply {
    let (reading, name) = {
        let desk = room.desk();
        (desk.reading.clone(), desk.file_state()["name"].clone())
    };
    let Some(m) = reading.mechanism.clone().filter(|_| !reading.partly) else {
        return Reply::refusal_reply(
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
        "scheme.svg" => match work::all_states(&m) {
            Ok(found) => {
                let analysed = Subject {
                    analysis: found.first(),
                    ..subject()
                };
                ("svg", Ok(scheme(&analysed).svg))
            }
            Err(why) => return Reply::refusal_reply(422, &why),
        },
        word if formats::writable_formats().any(|f| f.word == word) => (word, export(&m, word)),
        _ => return nothing_here(),
    };
    match made {
        Err(why) => Reply::refusal_reply(422, &why.to_string()),
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

fn answer_post(asked: &Asked, path: &str, room: &Room) -> Result<Value, Refused> {
    // As an object first: a list would be taken for the fields in their order.
    let sent = serde_json::from_slice::<Map<String, Value>>(&asked.body)
        .and_then(|all| serde_json::from_value::<Sent>(all.into()))
        .map_err(|e| Refused::Words(format!("invalid request: {e}")))?;
    match path {
        "edit" => {
            let done = room.at_desk(|desk| desk.apply_edits(&sent.edits, sent.revision));
            if let Err(Refused::Conflict(_)) = &done {
                // Whoever was too late gets what there is now.
                room.windows
                    .tell_found(&room::format_event("look", &room.desk().desk_json()));
            }
            done
        }
        "draft" => {
            let (_, reading) = room.desk().draft_edits(&sent.edits)?;
            let mut out = reading.reading_json();
            if let Some(m) = &reading.mechanism
                && let Ok(found) = work::all_states(m)
            {
                out["verdict"] = work::verdict_json(m, (&found, &[]), 0);
            }
            Ok(out)
        }
        "undo" | "redo" => room.at_desk(|desk| {
            desk.step_history(path == "redo");
            Ok(())
        }),
        "save" => room.at_desk(|desk| desk.save_file(sent.name.as_deref())),
        "begin" => room.at_desk(|desk| {
            let name = sent.name.unwrap_or_default();
            let folder = desk.file_folder();
            let opening = match sent.text {
                Some(text) => Some(Opening::Text(name.clone(), text, folder)),
                None => shelf::opening_of(&name, folder),
            };
            let none = || Refused::Words(format!("there is no {name} to start from"));
            desk.begin_file(&opening.ok_or_else(none)?)
        }),
        "take" => take_sent(&sent, room),
        "ask" => ask_sent(&sent, room),
        "stop" => {
            room.stop_search(room.desk().revision);
            Ok(json!({}))
        }
        "settle" => room.at_desk(|desk| {
            desk.settle_conflict(sent.yes);
            Ok(())
        }),
        "restore" => room.at_desk(|desk| {
            desk.restore_left(sent.yes);
            Ok(())
        }),
        _ => Err(Refused::Words("nothing exists at this address".to_owned())),
    }
}

/// Returns the refusal of ideas of an older state of the mechanism.
fn old_ideas() -> Refused {
    Refused::Conflict(
        "the mechanism was changed after these ideas; the search runs again".to_owned(),
    )
}

/// Returns what was found of the revision that a request is of.
fn found_sent(sent: &Sent, room: &Room) -> Result<Arc<Found>, Refused> {
    let found = sent.revision.and_then(|r| room.found_for(r));
    found.ok_or_else(old_ideas)
}

fn ask_sent(sent: &Sent, room: &Room) -> Result<Value, Refused> {
    let wider = |n| {
        found_sent(sent, room)?
            .wider
            .get(n)
            .cloned()
            .ok_or_else(old_ideas)
    };
    room.ask_search(sent.wider.map(wider).transpose()?)
}

fn take_sent(sent: &Sent, room: &Room) -> Result<Value, Refused> {
    let found = found_sent(sent, room)?;
    let reading = {
        let desk = room.desk();
        if desk.revision != found.revision {
            return Err(old_ideas());
        }
        desk.reading.clone()
    };
    let taken = idea::take_idea(&reading, &found.outcome, sent.idea)?;
    let mut told = room.at_desk(|desk| match taken {
        Taken::Edits(edits) => desk.apply_edits(&edits, None),
        Taken::Fixed(bytes) => {
            desk.replace_text(bytes);
            Ok(())
        }
    })?;
    told["taken"] = json!(sent.idea);
    Ok(told)
}
