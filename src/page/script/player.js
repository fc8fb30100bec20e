// The player: one slider, one view and one choice of motion or self-stress for all pictures of a mechanism in space, turned
// by mouse, finger and arrow keys; links are dragged.

const RATE = 30;
/** A turn by a key, and by a pixel of a drag. */
const [KEY, PIXEL] = [Math.PI / 18, 0.01];

const player = {
  /** The scene that is played, or null. */
  scene: null,
  /** The pictures: each shows what is played. */
  screens: [],
  /** Whether they are of bodies, which are looked at aslant at first. */
  solid: false,
  now: 0,
  forward: true,
  running: null,
  motion: 0,
  stress: null,
  side: 0,
  tilt: 0,
  sight: null,
  /** What is dragged and where its links are; nothing on the way of the motion. */
  body: null,
  pulled: null,
  /** Whether the next click is to trace a point, and the points. */
  tracing: false,
  traced: [],
};
/** How far bodies are turned at first, to the side and up. */
const ASLANT = [0.55, 0.4];
const knob = Object.fromEntries(["play", "range", "again", "loop", "shown", "home", "say", "trace", "untrace"].map((part) => [part, document.querySelector(`[data-part="${part}"]`)]));
const poses = () => player.scene.moves[player.motion].poses;

/** Where the links are. */
const poseNow = () => (player.stress === null ? player.pulled ?? poses()[player.now] : null);
const homeTurn = () => (player.solid ? ASLANT : [0, 0]);

function drawScreens() {
  const traces = tracesOf();
  for (const show of player.screens) show(traces);
  knob.range.value = player.now;
  byId("stage").dataset.picture = player.now;
}

/** A picture of lines, with other symbols at some joints. */
function lineScreen(svg, swaps, asBuilt) {
  return (traces) => {
    const { scene, sight, stress, motion } = player;
    const loads = stress === null || !asBuilt ? [] : scene.stresses[stress].arrows;
    const parts = pictureOf(scene, sight, poseNow(), stress === null ? motion : null, loads, swaps, Number(svg.dataset.from));
    for (const part of svg.querySelectorAll("[data-home]")) part.setAttribute("visibility", sight.away ? "hidden" : "visible");
    const what = svg.querySelector("text.sub");
    what.dataset.first ??= what.textContent;
    what.textContent = sight.away ? "Kinematic scheme, turned" : what.dataset.first;
    svg.querySelector("[data-scene]").replaceChildren(...parts, ...traces.flatMap((t) => tracePicture(t, sight)));
  };
}

/** A picture of bodies, with other fittings at some joints. */
function bodyScreen(shaded, swaps, asBuilt) {
  const { scene } = player;
  shaded.take(bodiesOf(scene, swaps));
  return (traces) => {
    const { stress, sight, motion } = player;
    const loads = stress === null || !asBuilt ? [] : scene.stresses[stress].arrows;
    shaded.show(sight, poseNow(), roomOf(scene), besideBodies(scene, stress === null ? motion : null, traces, loads));
  };
}

function tellView() {
  const { scene, stress, motion, side, tilt } = player;
  const degrees = (x) => Math.round((x * 180) / Math.PI);
  const view = side !== 0 || tilt !== 0 ? `; turned by ${degrees(side)}° to the side and ${degrees(tilt)}° up` : "";
  knob.say.textContent = `${(stress === null ? scene.moves[motion] : scene.stresses[stress]).name}${view}`;
}

/** Looks from where the view has been turned to. */
function look() {
  const { scene, side, tilt, stress, solid } = player;
  const away = solid || side !== 0 || tilt !== 0;
  const view = away ? seenFrom(scene, side, tilt) : scene.view;
  const [left, top, wide, high] = roomOf(scene);
  const [room, most, margin] = solid ? [[left, top, left + wide, top + high], 2, 44] : [scene.room, 1, 24];
  const fit = away ? fitted(scene, view, stress === null ? poses() : [null], room, most, margin) : { scale: 1, at: scene.origin };
  player.sight = { view, fit, away };
  const [across, up] = homeTurn();
  knob.home.disabled = side === across && tilt === up;
  drawScreens();
  tellView();
}

function turnBy(across, up) {
  const { scene } = player;
  const height = Math.asin(Math.max(-1, Math.min(1, dot(scene.view[2], scene.upright))));
  player.side = (player.side + across) % (2 * Math.PI);
  player.tilt = Math.max(-Math.PI / 2 - height, Math.min(Math.PI / 2 - height, player.tilt + up));
  look();
}

function goHome() {
  [player.side, player.tilt] = homeTurn();
  look();
}

function stop() {
  cancelAnimationFrame(player.running);
  player.running = null;
  knob.play.textContent = "Play";
}

/** The next picture: round again, or back from the end; none at the end where it is not to be repeated. */
function next() {
  const round = player.scene.moves[player.motion].closed;
  const last = player.forward ? poses().length - 1 : 0;
  if (player.now !== last) return player.now + (player.forward ? 1 : -1);
  if (!knob.loop.checked && (round || !player.forward)) return null;
  if (round) return 0;
  player.forward = !player.forward;
  return player.now + (player.forward ? 1 : -1);
}

function start() {
  const round = player.scene.moves[player.motion].closed;
  knob.play.textContent = "Stop";
  release();
  if (!knob.loop.checked && round && player.now === poses().length - 1) player.now = 0;
  if (!knob.loop.checked && !round && player.now === 0) player.forward = true;
  let due = null;
  const tick = (time) => {
    if (due === null) due = time;
    while (time >= due) {
      const to = next();
      if (to === null) return stop();
      player.now = to;
      due += 1000 / RATE;
    }
    drawScreens();
    player.running = requestAnimationFrame(tick);
  };
  player.running = requestAnimationFrame(tick);
}

/** Another motion, or a self-stress. */
function show(which) {
  const { scene } = player;
  const moves = scene.moves.length;
  stop();
  release();
  [player.motion, player.stress] = which < moves ? [which, null] : [0, which - moves];
  [player.now, player.forward] = [scene.moves[player.motion].start, true];
  knob.range.max = poses().length - 1;
  for (const part of [knob.play, knob.range, knob.again]) part.hidden = player.stress !== null || poses().length < 2;
  look();
}

/** Plays a scene on the screens that `make` gives; the view and the picture stay where it is the same scene seen alike. */
function playOn(scene, solid, make) {
  const [same, alike] = [scene === player.scene, solid === player.solid];
  [player.scene, player.solid] = [scene, solid];
  player.screens = make();
  if (!same) {
    player.traced = [];
    knob.shown.replaceChildren(...[...scene.moves, ...scene.stresses].map((s, n) => element("option", { value: n }, s.name)));
  }
  if (!same || !alike) [player.side, player.tilt] = homeTurn();
  tellTraces();
  if (same) look();
  else show(0);
}

/** Keys and drags on a picture turn all of them. */
function listenToTurns(turn) {
  const keys = { ArrowLeft: [-KEY, 0], ArrowRight: [KEY, 0], ArrowUp: [0, KEY], ArrowDown: [0, -KEY] };
  const turns = () => player.screens.length > 0;
  turn.addEventListener("keydown", (event) => {
    if (!turns() || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (event.key === "Home") goHome();
    else if (event.key in keys) turnBy(...keys[event.key]);
    else return;
    event.preventDefault();
  });
  let [from, drag] = [null, null];
  turn.addEventListener("pointerdown", (event) => {
    if (!turns()) return;
    if (player.tracing) return traceAt(turn, event);
    from = [event.clientX, event.clientY];
    drag = grasp(turn, event);
    turn.setPointerCapture(event.pointerId);
  });
  turn.addEventListener("pointermove", (event) => {
    if (!from) return pointAt(turn, event);
    if (drag) return drag(event);
    turnBy((from[0] - event.clientX) * PIXEL, (event.clientY - from[1]) * PIXEL);
    from = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) turn.addEventListener(end, () => ([from, drag] = [null, null]));
}

/** Says what a drag would move. */
function pointAt(turn, event) {
  if (!player.screens.length || event.pointerType === "touch") return;
  const found = player.stress === null ? linkAt(pointed(turn, event)) : null;
  turn.title = found ? `Link ${player.scene.names[found.link]}: drag it` : "";
  turn.classList.toggle("takes", Boolean(found));
}

function listenToPlayer() {
  knob.shown.addEventListener("change", () => show(Number(knob.shown.value)));
  knob.range.addEventListener("input", () => {
    stop();
    release();
    player.now = Number(knob.range.value);
    drawScreens();
  });
  knob.play.addEventListener("click", () => (player.running === null ? start() : stop()));
  knob.home.addEventListener("click", () => {
    goHome();
    document.querySelector("#built .turn").focus();
  });
  knob.trace.addEventListener("click", () => {
    player.tracing = !player.tracing;
    tellTraces();
  });
  knob.untrace.addEventListener("click", () => {
    player.traced = [];
    tellTraces();
    drawScreens();
  });
  for (const turn of document.querySelectorAll(".turn")) listenToTurns(turn);
}

/** Begins by itself once it is seen; readers who want less motion begin it themselves. */
function startWhenSeen() {
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((e) => e.isIntersecting) || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    seen.disconnect();
    if (player.screens.length && poses().length > 1 && player.stress === null) start();
  }, { threshold: 0.4 });
  seen.observe(byId("built"));
}
