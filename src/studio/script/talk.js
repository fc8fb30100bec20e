// The state of the desk, and the requests to the program. Its answers are the values that the command line and Python
// give.

const desk = {
  /** The reading of the newest text. */
  look: null,
  /** The verdict, the scenes that move and the ideas of it, each as it comes. */
  verdict: null,
  motion: null,
  ideas: null,
  force: null,
  /** How far the search has come. */
  progress: null,
  /** The revision whose search the user stopped. */
  stoppedAt: -1,
  /** How things stand with the file. */
  file: null,
  revision: -1,
  /** When the verdict came, in milliseconds. */
  judgedAt: 0,
  /** The index of the shown state. */
  state: 0,
};

const ears = {};
const hear = (name, act) => (ears[name] ??= []).push(act);
const tell = (name, value) => (ears[name] ?? []).forEach((act) => act(value));

/** An element of a form, and what it does when it is pressed or changed. */
function acted(made, act, on = "click") {
  made.addEventListener(on, act);
  return made;
}

/** Says something to who sees it and to who hears it. */
function say(words, grave = false) {
  byId("said").textContent = words;
  const note = element("p", { class: grave ? "note bad" : "note" }, words);
  byId("hint").replaceChildren(note);
  clearTimeout(say.over);
  say.over = setTimeout(() => {
    if (note.isConnected) note.remove();
    tellTool();
  }, grave ? 12000 : 5000);
}

/** A bar across the page that stays until it is dealt with. */
function notice(id, words, ...buttons) {
  byId(`notice-${id}`)?.remove();
  if (words === null) return;
  const made = buttons.map(([name, act]) => button(name, act));
  byId("notices").append(element("div", { class: "notice", id: `notice-${id}`, role: "alert" }, element("span", {}, words), ...made));
}

/** Sends a request; returns the answer, or null if it was refused, which is shown. */
async function post(path, body) {
  try {
    const answer = await fetch(path, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) });
    const value = await answer.json();
    if (answer.ok) return value;
    if (path !== "draft") say(value.refused, true);
    return null;
  } catch {
    lost();
    return null;
  }
}

/** One after another: each is made of what the one before has left. */
let last = Promise.resolve();
function inTurn(path, body) {
  const sent = last.then(() => post(path, typeof body === "function" ? body() : body));
  last = sent;
  return sent.then((value) => {
    if (value?.revision !== undefined) takeLook(value);
    return value;
  });
}

/** Makes changes. */
const change = (...edits) => (edits.length ? inTurn("edit", { edits, revision: null }) : Promise.resolve(null));

function lost() {
  notice("lost", "The ozols program has stopped or cannot be reached. Your work is safe: it is autosaved next to the file, and the text is still here.",
    ["Copy the text", () => copyText(byId("text").value)], ["Try again", () => location.reload()]);
}

async function copyText(text) {
  await navigator.clipboard.writeText(text);
  say("The text is on the clipboard.");
}

function takeFile(file) {
  desk.file = file;
  tell("file", file);
}

/** Takes the reading of a text, unless a newer one is known. */
function takeLook(value) {
  takeFile(value.desk);
  if (value.file === undefined || value.revision < desk.revision) return;
  const same = value.revision === desk.revision;
  desk.look = value;
  desk.revision = value.revision;
  if (!same) [desk.ideas, desk.progress, desk.force] = [null, null, null];
  tell("look", value);
}

const EVENTS = {
  look: takeLook,
  desk: takeFile,
  verdict: (value) => of(value, "verdict"),
  motion: (value) => of(value, "motion"),
  progress: (value) => of(value, "progress"),
  ideas: (value) => of(value, "ideas"),
  force: (value) => of(value, "force"),
  trouble: (value) => say(value.words, true),
};

/** Takes what was found of the newest text. */
function of(value, name) {
  if (value.revision !== desk.revision) return;
  desk[name] = value;
  tell(name, value);
}

function listenToServer() {
  const source = new EventSource("events");
  for (const [name, act] of Object.entries(EVENTS)) source.addEventListener(name, (event) => act(JSON.parse(event.data)));
  source.addEventListener("open", () => notice("lost", null));
  source.addEventListener("error", lost);
}

/** Asks what a change would make of the mechanism, without making it: the newest question alone is answered. */
const drafts = { asked: null, busy: false, number: 0 };
async function draft(edits, use) {
  drafts.asked = { edits, use };
  if (drafts.busy) return;
  drafts.busy = true;
  while (drafts.asked) {
    const { edits: now, use: then } = drafts.asked;
    drafts.asked = null;
    const number = drafts.number;
    const value = await post("draft", { edits: now, revision: null });
    if (value && number === drafts.number) then(value);
  }
  drafts.busy = false;
}

/** Discards the drafts so far. */
function endDrafts() {
  drafts.asked = null;
  drafts.number += 1;
}
