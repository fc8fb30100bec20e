// The player: one slider, one view and one choice of motion or self-stress for all pictures of a mechanism in space.
// The page provides the view: `sightNow`, `isAtHome` and `goHome`.

const RATE = 30;

const player = {
  /** The scene that is played, or null. */
  scene: null,
  /** The pictures: each shows what is played. */
  screens: [],
  now: 0,
  forward: true,
  running: null,
  motion: 0,
  stress: null,
  side: 0,
  tilt: 0,
  sight: null,
  /** The dragged link and the pose of all links; null on the motion. */
  body: null,
  pulled: null,
  /** Whether the next click is to trace a point, and the points. */
  tracing: false,
  traced: [],
};
const knob = Object.fromEntries(["play", "range", "again", "loop", "shown", "home", "say", "trace", "untrace"].map((part) => [part, document.querySelector(`[data-part="${part}"]`)]));
const poses = () => player.scene.moves[player.motion].poses;

/** The pose of the links. */
const poseNow = () => (player.stress === null ? player.pulled ?? poses()[player.now] : null);

function drawScreens() {
  const traces = tracesOf();
  for (const show of player.screens) show(traces);
  knob.range.value = player.now;
  byId("stage").dataset.picture = player.now;
}

function tellView() {
  const { scene, stress, motion, side, tilt } = player;
  const degrees = (x) => Math.round((x * 180) / Math.PI);
  const view = side !== 0 || tilt !== 0 ? `; turned by ${degrees(side)}° to the side and ${degrees(tilt)}° up` : "";
  knob.say.textContent = `${(stress === null ? scene.moves[motion] : scene.stresses[stress]).name}${view}`;
}

/** Looks from where the view has been turned to. */
function look() {
  player.sight = sightNow();
  knob.home.disabled = isAtHome();
  drawScreens();
  tellView();
}

function stop() {
  cancelAnimationFrame(player.running);
  player.running = null;
  knob.play.textContent = "Play";
}

/** The next picture: around again, or back from the end; null at the end if the motion is not repeated. */
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

/** Plays a scene on the screens that `make` gives; the view and the picture stay where it is the same scene. */
function playOn(scene, make) {
  const same = scene === player.scene;
  player.scene = scene;
  player.screens = make();
  if (!same) {
    [player.traced, player.side, player.tilt] = [[], 0, 0];
    knob.shown.replaceChildren(...[...scene.moves, ...scene.stresses].map((s, n) => element("option", { value: n }, s.name)));
  }
  tellTraces();
  if (same) look();
  else show(0);
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
    document.querySelector(".turn").focus();
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
}
