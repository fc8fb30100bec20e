// The stage: the original mechanism, and next to it the chosen variant, in motion or as still drawings.

const stage = { state: 0, kind: "space" };
/** The pictures of each state in space, as the page came with them. */
const spaceOf = page.states.map((_, s) => document.querySelector(`[data-space="${s}"] svg`));
/** Round the scheme, and below it, where the axes and the scale are; they want some width. */
const [ROUND, BELOW, WIDE] = [8, 88, 240];

/** Whether a kind is in space, and moves. */
const moves = (kind) => kind === "space";

/** A fresh picture of a state and a kind. */
function pictureFor(state, kind) {
  const original = moves(kind) ? spaceOf[state] : document.querySelector(`#mechanism [data-state="${state}"][data-kind="${kind}"] svg`);
  return original.cloneNode(true);
}

/** The part of the sheet that the pictures show: the scheme and the axes, without title and legend. */
function roomOf(scene) {
  const [left, top, right, bottom] = scene.room;
  const width = Math.max(right - left + 2 * ROUND, WIDE);
  return [(left + right - width) / 2, top - ROUND, width, bottom - top + ROUND + BELOW];
}

/** Shows that of a picture. */
function crop(svg, scene) {
  const [from, top, width, height] = roomOf(scene);
  svg.dataset.whole = svg.getAttribute("viewBox");
  svg.setAttribute("viewBox", `${from} ${top} ${width} ${height}`);
  svg.setAttribute("width", width);
  svg.setAttribute("height", height);
  svg.dataset.from = from;
  svg.querySelector('[data-home="scale"]').setAttribute("transform", `translate(${from} 0)`);
}

/** W and σ in a few words. */
const inShort = ({ mobility, redundant }) => `σ = ${redundant}, W = ${mobility}`;

/** The swaps at the joints of a scene, by joint. */
function swapsOf(state, changes) {
  const swaps = changes.map((c) => swapOf(state, c)).filter(Boolean);
  return new Map(swaps.map((swap) => [swap.joint, swap]));
}

/** Puts a picture into a pane. */
function setPicture(id, svg, words) {
  const pane = byId(id);
  pane.querySelector(".turn").replaceChildren(svg);
  pane.querySelector("figcaption > span").textContent = words;
}

/** Draws a variant next to the original mechanism; only the original for null. */
function draw(i) {
  const { state, kind } = stage;
  const scene = page.scenes[state];
  const panes = [{ id: "built", svg: pictureFor(state, kind), swaps: new Map(), words: `As built: ${inShort(page.states[state])}` }];
  byId("drawing").hidden = i === null;
  if (i === null) byId("drawing").querySelector(".turn").replaceChildren();
  else {
    const svg = pictureFor(state, kind);
    const changes = changesOf(i);
    if (moves(kind)) entitle(svg, state, i, changes);
    else dress(svg, state, kind, i);
    const swaps = moves(kind) ? swapsOf(state, changes) : null;
    panes.push({ id: "drawing", svg, swaps, words: `${noun()} ${i + 1}: ${inShort(figures(i, state))}` });
  }
  for (const pane of panes) setPicture(pane.id, pane.svg, pane.words);
  for (const part of document.querySelectorAll("[data-moves]")) part.hidden = !moves(kind);
  for (const help of document.querySelectorAll("[data-state-help]")) help.hidden = !moves(kind) || Number(help.dataset.stateHelp) !== state;
  tellTurns(moves(kind));
  if (moves(kind)) {
    for (const { svg } of panes) crop(svg, scene);
    playOn(scene, () => panes.map(({ id, svg, swaps }) => lineScreen(svg, swaps, id === "built")));
  } else {
    stop();
    player.screens = [];
  }
}

/** Whether the pictures can be turned, for who cannot see that. */
function tellTurns(turns) {
  for (const turn of document.querySelectorAll(".turn")) {
    const words = turns ? "Drag a link to move it. Drag the background or use the arrow keys to turn the view; Home resets it" : "A still drawing";
    turn.setAttribute("aria-label", words);
    turn.setAttribute("role", "group");
    if (turns) {
      turn.setAttribute("aria-roledescription", "drawing to be turned");
      turn.tabIndex = 0;
    } else {
      turn.removeAttribute("aria-roledescription");
      turn.removeAttribute("tabindex");
    }
  }
}

/** A drawing in its own size, over the page. */
function showWhole(svg) {
  const close = element("button", {}, "Close");
  const whole = element("dialog", { class: "whole", "aria-label": "The drawing in full size" },
    element("form", { method: "dialog" }, close), wholeOf(svg));
  document.body.append(whole);
  whole.addEventListener("close", () => whole.remove());
  whole.showModal();
}

function listenToStage() {
  const states = byId("drawn-state");
  const kinds = byId("drawn-kind");
  page.states.forEach((s, n) => states.append(element("option", { value: n }, s.name)));
  byId("drawn-state-field").hidden = page.states.length < 2;
  const redraw = () => {
    stage.state = Number(states.value);
    const inSpace = spaceOf[stage.state] !== null;
    kinds.options[0].disabled = !inSpace;
    if (!inSpace && moves(kinds.value)) kinds.value = "kinematic";
    stage.kind = kinds.value;
    draw(view.chosen);
  };
  states.addEventListener("change", redraw);
  kinds.addEventListener("change", redraw);
  byId("player").hidden = false;
  listenToPlayer();
  for (const turn of document.querySelectorAll(".turn")) listenToTurns(turn);
  redraw();
  startWhenSeen();
}
