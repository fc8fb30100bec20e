//! The work at the newest text: one thread does the verdict and the search, which ends where another text makes it useless. A second
//! thread does the motion, and the forces over it where the file states loads.

use super::idea;
use super::room::{Found, Room};
use crate::model::loads::Stroke;
use crate::model::mechanism::Drives;
use crate::model::mechanism::{Mechanism, StateId};
use crate::page::moving::Moving;
use crate::page::scenes::{moving_scene, still_scene};
use crate::page::verdict;
use crate::redundancy::analysis::{Method, StateAnalysis, analyse_states};
use crate::score::outcome::Outcome;
use crate::score::outcome::variant::Variant;
use crate::score::request::unlisted::part_freedoms;
use crate::score::request::{List, Request};
use crate::score::run::{Event, run};
use crate::statics::reactions::Cycle;
use crate::statics::solve::{Model, SolvedReactions, solve_reactions};
use crate::view::FORMAT;
use crate::view::analysis::Analysis;
use crate::view::analysis::suggestions::{Advice, advise_states};
use crate::view::reactions::stroke::ReactionsOverStroke as Reactions;
use crate::view::search::json;
use crate::view::search::nothing_found::{hopeless_reasons, wider_requests};
use crate::view::search::variant::symmetric_lines;
use crate::view::search::why::rows_of_ideas;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Sender, channel};

/// Ideas that are given.
const IDEAS: usize = 10;

/// A revision, its mechanism and the states of that, from which the motion is computed.
type Judged = (u64, Arc<Mechanism>, Vec<StateAnalysis>);

/// Works until the room is closed. A motion that takes long holds up neither verdicts nor ideas.
pub(super) fn run_worker(room: &Arc<Room>) {
    let (to_motion, next) = channel::<Judged>();
    let moving = room.clone();
    let made = std::thread::Builder::new().name("studio-motion".to_owned());
    let made = made.spawn(move || {
        while let Ok(first) = next.recv() {
            let (revision, m, states) = next.try_iter().last().unwrap_or(first);
            or_trouble(&moving, revision, || {
                compute_motion(&moving, revision, &m, &states)
            });
        }
    });
    if made.is_err() {
        return;
    }
    let mut done = 0;
    while let Some(revision) = room.wait_for_news(done) {
        done = revision;
        let reading = room.desk().reading.clone();
        let Some(m) = reading.mechanism.clone() else {
            room.tell_found(revision, "verdict", &nothing_to_judge(revision));
            continue;
        };
        or_trouble(room, revision, || {
            judge_and_search(room, revision, &m, &to_motion)
        });
    }
}

/// Works at a revision. A flaw in the engine is no reason to lose the window.
fn or_trouble(room: &Room, revision: u64, work: impl FnOnce()) {
    if catch_unwind(AssertUnwindSafe(work)).is_err() {
        let words = "the engine failed on this mechanism; report this with the file. The text is unchanged.";
        room.tell_found(
            revision,
            "trouble",
            &json!({ "revision": revision, "words": words }),
        );
    }
}

/// Returns the verdict without a mechanism.
fn nothing_to_judge(revision: u64) -> Value {
    json!({ "revision": revision, "analysis": null, "words": [], "scenes": [] })
}

fn judge_and_search(room: &Room, revision: u64, m: &Arc<Mechanism>, to_motion: &Sender<Judged>) {
    let states = match all_states(m) {
        Ok(states) => states,
        Err(why) => {
            let mut told = nothing_to_judge(revision);
            told["why"] = why.into();
            return room.tell_found(revision, "verdict", &told);
        }
    };
    let ids: Vec<StateId> = m.state_ids().collect();
    // Single changes are quick: they are shown while the search runs.
    let advice = advise_states(m, &ids, &states).unwrap_or_default();
    room.tell_found(
        revision,
        "verdict",
        &verdict_json(m, (&states, &advice), revision),
    );
    // The thread at the other end lives as long as this one.
    let _ = to_motion.send((revision, m.clone(), states.clone()));
    run_search(room, revision, m, &states);
}

fn compute_motion(room: &Room, revision: u64, m: &Mechanism, states: &[StateAnalysis]) {
    let mut moving = Vec::new();
    for (found, state) in states.iter().zip(m.state_ids()) {
        if room.is_old(revision) {
            return;
        }
        let of = found.meant.as_deref().unwrap_or(m);
        let made = moving_scene(of, (found, state), &[]);
        moving.push(made.map(|(_, scene)| scene));
    }
    room.tell_found(
        revision,
        "motion",
        &json!({ "revision": revision, "scenes": moving }),
    );
    if !room.is_old(revision) {
        let charts = force_charts(m);
        room.tell_found(
            revision,
            "force",
            &json!({ "revision": revision, "charts": charts }),
        );
    }
}

/// Returns the analysis of each state. If one cannot be analysed, returns the reason in words.
pub(super) fn all_states(m: &Mechanism) -> Result<Vec<StateAnalysis>, String> {
    let all: Vec<StateId> = m.state_ids().collect();
    analyse_states(m, &all, Method::Auto).map_err(|e| e.to_string())
}

/// Returns the verdict for the page. It has the analysis of `ozols analyze --format json`, the text of the report, and the
/// mechanism at rest.
pub(super) fn verdict_json(
    m: &Mechanism,
    (states, advice): (&[StateAnalysis], &[Advice]),
    revision: u64,
) -> Value {
    let analysis = Analysis::new(m, states, advice);
    let words = |s| json!({ "head": verdict::verdict_head(s), "text": verdict::state_sentences(s).join(" ") });
    let words: Vec<Value> = analysis.states.iter().map(words).collect();
    let scenes = states.iter().zip(m.state_ids()).map(|(found, state)| {
        let of = found.meant.as_deref().unwrap_or(m);
        still_scene(of, (Some(found), state), &[])
    });
    let scenes: Vec<_> = scenes.collect();
    json!({
        "format": FORMAT,
        "revision": revision,
        "analysis": analysis.json(),
        "words": words,
        "scenes": scenes,
    })
}

fn run_search(room: &Room, revision: u64, m: &Mechanism, states: &[StateAnalysis]) {
    let (asked, wider) = room.current_request();
    let request = Request {
        list: List::Top(IDEAS),
        // A ranking orders variants, not ideas.
        distinct: m.ranking.is_none(),
        // What changes while it is looked at is not gone through whole.
        pool: Some(asked.cheapest_scored()),
        ..asked
    };
    let mut notes = Vec::new();
    let mut tell = |event| match event {
        Event::Note(text) => notes.push(text),
        Event::Building(p) => {
            let told =
                json!({ "revision": revision, "done": p.done, "of": p.of, "nodes": p.nodes });
            room.tell_found(revision, "progress", &told);
        }
        Event::Built => {
            // What was found so far is still given.
            room.stop_search(0);
            room.tell_found(revision, "progress", &json!({ "revision": revision }));
        }
        Event::Proving { done, of } => {
            let told = json!({ "revision": revision, "done": done, "of": of });
            room.tell_found(revision, "progress", &told);
        }
    };
    room.searches[0].fetch_add(1, Ordering::SeqCst);
    let found = run(m.clone(), &request, &|| room.is_over(revision), &mut tell);
    let told = match (found, room.is_old(revision)) {
        (_, true) => Ok(None),
        (Err(why), _) => Err(why.to_string()),
        (Ok(outcome), _) => ideas_json(room, revision, m, states, outcome).map(Some),
    };
    room.searches[1].fetch_add(1, Ordering::SeqCst);
    match told {
        Ok(None) => {}
        Ok(Some(mut ideas)) => {
            ideas["notes"] = notes.into();
            ideas["asked"] = wider.into();
            room.tell_found(revision, "ideas", &ideas);
        }
        Err(why) => room.tell_found(
            revision,
            "ideas",
            &json!({ "revision": revision, "why": why, "asked": wider }),
        ),
    }
}

/// Returns the result of `ozols search --format json`, and the symbols of each change.
fn ideas_json(
    room: &Room,
    revision: u64,
    m: &Mechanism,
    states: &[StateAnalysis],
    outcome: Outcome,
) -> Result<Value, String> {
    let words = |e: &dyn std::fmt::Display| e.to_string();
    let is_over = || room.is_over(revision);
    let remarks = outcome.make_remarks(&is_over).map_err(|e| words(&e))?;
    let variants = outcome.variants_unless(&is_over);
    let mut ideas = Vec::new();
    let each = |v: &Variant<'_>| ideas.push(v.assignment().clone());
    let found = json::search_value(&outcome, variants, &remarks, each).map_err(|e| words(&e))?;
    let marks = idea::idea_marks(m, states, &outcome, &found["variants"]);
    let wider = wider_requests(&outcome, &remarks).into_iter();
    // The pool is set here at each search.
    let own = |(request, gives)| {
        (
            Request {
                pool: None,
                ..request
            },
            gives,
        )
    };
    let wider: Vec<(Request, String)> = wider.map(own).collect();
    // What the file can say is written into it; the rest is asked for by its number.
    let step = |(request, gives): &(Request, String)| {
        let [old, new] = [&outcome.request, request];
        let entry = |name: &String| match part_freedoms(name) {
            Some(freedoms) => json!({ "name": name, "freedoms": freedoms }),
            None => json!(name),
        };
        let list = |names: &[String]| names.iter().map(entry).collect::<Value>();
        let more = new.allow[old.allow.len()..].iter();
        let nuts = new.unloading[old.unloading.len()..].iter();
        let in_file = Request {
            max_redundant: old.max_redundant,
            max_mobility: old.max_mobility,
            drives: old.drives,
            pose_only: old.pose_only,
            allow: old.allow.clone(),
            forbid: old.forbid.clone(),
            unloading: old.unloading.clone(),
            list: old.list,
            distinct: old.distinct,
            pool: old.pool,
            ..new.clone()
        };
        json!({
            "gives": gives,
            "in_file": in_file == *old,
            "max_redundant": (new.max_redundant != old.max_redundant).then_some(new.max_redundant),
            "max_mobility": new.max_mobility.filter(|_| new.max_mobility != old.max_mobility),
            "drives": new.drives.filter(|_| new.drives != old.drives).map(Drives::word),
            "pose_only": (new.pose_only != old.pose_only).then_some(new.pose_only),
            "allow": more.map(|o| json!([o.joint, list(&o.names)])).collect::<Value>(),
            // The joint that these are in series with stays what it is.
            "unloading": nuts.map(|i| json!([i.joints[0], list(&i.names)])).collect::<Value>(),
        })
    };
    let why = rows_of_ideas(&outcome, &ideas.iter().collect::<Vec<_>>());
    let told = json!({
        "revision": revision,
        "found": found,
        "marks": marks,
        // As in the report: reasons of each idea, and the cheapest symmetric redesigns.
        "reasons": why,
        "symmetric": remarks.symmetric.as_ref().map(symmetric_lines),
        "hopeless": hopeless_reasons(m, &remarks.hopeless),
        // In the order in which they are asked for by number.
        "wider": wider.iter().map(step).collect::<Value>(),
    });
    room.keep_found(Found {
        revision,
        outcome,
        wider,
    });
    Ok(told)
}

/// Positions of a stroke that the file does not state.
const STEPS: usize = 24;

/// Returns for each state a chart as SVG, or why there is none. Null if the state has no loads.
fn force_charts(m: &Mechanism) -> Vec<Value> {
    m.state_ids().map(|s| force_chart(m, s)).collect()
}

fn force_chart(m: &Mechanism, state: StateId) -> Value {
    if !m.loads.acts_from_outside(state) {
        return Value::Null;
    }
    let stroke = m.loads.stroke.or_else(|| stroke_reach(m, state));
    match solve_reactions(m, state, stroke, Model::Spatial) {
        Ok(SolvedReactions::Spatial(found)) => {
            let svg = Reactions::new(m, state, &found).chart().map(|c| c.svg());
            json!({ "svg": svg, "drives": drive_efforts(m, &found) })
        }
        Ok(SolvedReactions::Planar(_)) => Value::Null,
        Err(why) => json!({ "why": why.to_string() }),
    }
}

/// Returns the effort of each driven joint over the stroke: the unit, positions of the first drive, and values.
fn drive_efforts(m: &Mechanism, found: &Cycle) -> Value {
    let mut curves = BTreeMap::new();
    for (at, solution) in &found.positions {
        for joint in solution.iter().flat_map(|s| &s.reactions) {
            if let Some((freedom, effort)) = joint.effort {
                let unit = if freedom.is_slide() { "N" } else { "N·m" };
                let id = &m.joints[joint.joint].id;
                let curve = curves.entry(id).or_insert((unit, Vec::new(), Vec::new()));
                curve.1.push(*at);
                curve.2.push(effort);
            }
        }
    }
    json!(curves)
}

/// Returns the stroke, as far as the drive goes.
fn stroke_reach(m: &Mechanism, state: StateId) -> Option<Stroke> {
    let [from, to] = Moving::new(m, state, None, None).ok()?.drive_reach()?;
    Some(Stroke {
        from,
        to,
        steps: STEPS,
    })
}
