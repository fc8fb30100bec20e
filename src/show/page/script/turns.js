// The pictures of a report are turned by mouse, finger and arrow keys; links are dragged.

/** A turn by a key, and by a pixel of a drag. */
const [KEY, PIXEL] = [Math.PI / 18, 0.01];
/** Round a turned scene in its room. */
const MARGIN = 24;

/** Right, up and towards the reader after a turn to the side and one up, in radians from the first view. */
function seenFrom(scene, side, tilt) {
  const [right, , toward] = scene.view;
  const by = times(scene.upright, side);
  const to = spun(right, by);
  const level = cross(to, scene.upright);
  const height = Math.asin(Math.max(-1, Math.min(1, dot(toward, scene.upright)))) + tilt;
  const [s, c] = [Math.sin(height), Math.cos(height)];
  return [to, plus(times(scene.upright, c), times(level, -s)), plus(times(level, c), times(scene.upright, s))];
}

/** How a view is put into the room of a scene, in the middle: smaller where it would not fit. */
function fitted(scene, view, poses) {
  const [left, top, right, bottom] = scene.room;
  const reach = [0, 1].map(() => [Infinity, -Infinity]);
  const note = (p) => [dot(view[0], p), -dot(view[1], p)].forEach((x, k) => {
    reach[k] = [Math.min(reach[k][0], x), Math.max(reach[k][1], x)];
  });
  for (const pose of poses) {
    for (const wire of scene.wires) wire.points.forEach((p) => note(carried(pose, wire.link, p)));
    for (const joint of scene.joints) note(carried(pose, joint.links[0], joint.at));
  }
  const room = [right - left, bottom - top].map((x) => x - 2 * MARGIN);
  const scale = Math.min(1, ...room.map((x, k) => x / Math.max(reach[k][1] - reach[k][0], 1)));
  const middle = reach.map(([a, b]) => (a + b) / 2);
  return { scale, at: [(left + right) / 2 - scale * middle[0], (top + bottom) / 2 - scale * middle[1]] };
}

/** How the scene is seen. */
function sightNow() {
  const { scene, side, tilt, stress } = player;
  const away = !isAtHome();
  const view = away ? seenFrom(scene, side, tilt) : scene.view;
  const fit = away ? fitted(scene, view, stress === null ? poses() : [null]) : { scale: 1, at: scene.origin };
  return { view, fit, away };
}

const isAtHome = () => player.side === 0 && player.tilt === 0;

function turnBy(across, up) {
  const { scene } = player;
  const height = Math.asin(Math.max(-1, Math.min(1, dot(scene.view[2], scene.upright))));
  player.side = (player.side + across) % (2 * Math.PI);
  player.tilt = Math.max(-Math.PI / 2 - height, Math.min(Math.PI / 2 - height, player.tilt + up));
  look();
}

function goHome() {
  [player.side, player.tilt] = [0, 0];
  look();
}

/** The position of the pointer in a picture, in the coordinates of the drawing. */
function pointed(turn, event) {
  const { left, top, width, height } = turn.querySelector("svg").getBoundingClientRect();
  const room = roomOf(player.scene);
  const scale = Math.min(width / room[2], height / room[3]);
  return [room[0] + room[2] / 2 + (event.clientX - left - width / 2) / scale, room[1] + room[3] / 2 + (event.clientY - top - height / 2) / scale];
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

/** Begins by itself once it is seen; readers who want less motion begin it themselves. */
function startWhenSeen() {
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((e) => e.isIntersecting) || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    seen.disconnect();
    if (player.screens.length && poses().length > 1 && player.stress === null) start();
  }, { threshold: 0.4 });
  seen.observe(byId("built"));
}
