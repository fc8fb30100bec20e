// Links that are taken by mouse or finger, and points whose ways are traced.

/** So near, in pixels of the drawing, a link is meant. */
const GRASP = 9;
/** Distances below this, in pixels, are none. */
const SAME = 2;

/** How far right and up of the origin of space a place of the drawing is. */
const inView = ([x, y]) => {
  const { fit } = player.sight;
  return [(x - fit.at[0]) / fit.scale, -(y - fit.at[1]) / fit.scale];
};

/** The places on each link: those of its joints, and its points of interest. */
function placesOf(scene) {
  const of = scene.names.map(() => []);
  for (const j of scene.joints) {
    if (j.turned) continue;
    for (const link of new Set(j.links)) if (!of[link].some((p) => length(minus(p, j.at)) < SAME)) of[link].push(j.at);
  }
  return of;
}

/** The segments by which links are dragged: their outlines, or the point of a link whose joints are all at one place. */
function segmentsOf(scene) {
  const wires = scene.wires.filter((w) => w.of === null && !w.turned && /bone|plate/.test(w.class));
  const outlines = wires.flatMap(({ link, form, points }) => {
    const all = points.map((p, i) => [p, points[(i + 1) % points.length]]);
    return (form !== "line" && points.length > 2 ? all : all.slice(0, -1)).map((ends) => ({ link, ends }));
  });
  const blocks = placesOf(scene).flatMap((own, link) => (own.length === 1 ? [{ link, ends: [own[0], own[0]] }] : []));
  return [...outlines, ...blocks].filter((s) => s.link !== scene.frame);
}

/** The link at a place of the picture, and its point at rest; null if there is none. */
function linkAt(place) {
  const { scene, sight } = player;
  const pose = poseNow();
  const target = inView(place);
  const flat = (p) => [dot(sight.view[0], p), dot(sight.view[1], p)];
  let best = null;
  for (const { link, ends: [p, q] } of segmentsOf(scene)) {
    const [a, b] = [p, q].map((x) => flat(carried(pose, link, x)));
    const d = minus(b, a);
    const t = Math.max(0, Math.min(1, dot(minus(target, a), d) / (dot(d, d) || 1)));
    const off = length(minus(target, plus(a, times(d, t)))) * sight.fit.scale;
    if (!best || off < best.off) best = { off, link, point: plus(p, times(minus(q, p), t)) };
  }
  return best && best.off < GRASP ? best : null;
}

/** Starts a drag of the link under the pointer: returns the function that moves it, or null if there is none. */
function grasp(turn, event) {
  if (player.stress !== null) return null;
  const found = linkAt(pointed(turn, event));
  if (!found) return null;
  stop();
  const { start } = player.scene.moves[player.motion];
  const way = player.now < start ? poses().slice(player.now, start + 1).reverse() : poses().slice(start, player.now + 1);
  player.body ??= pullable(player.scene, way);
  return (later) => {
    player.body.pull(found.link, found.point, player.sight.view, inView(pointed(turn, later)));
    player.pulled = player.body.pose();
    byId("stage").dataset.gap = player.body.gap().toExponential(1);
    drawScreens();
  };
}

/** Back on the way of the motion. */
function release() {
  [player.body, player.pulled] = [null, null];
}

/** Draws the way of a point that is pointed at, too. */
function traceAt(turn, event) {
  const found = linkAt(pointed(turn, event));
  if (!found) return;
  player.traced.push(found);
  player.tracing = false;
  tellTraces();
  drawScreens();
}

/** The ways of the traced points over the motion that is shown, and where they are now. */
function tracesOf() {
  if (player.stress !== null) return [];
  const round = player.scene.moves[player.motion].closed;
  return player.traced.map(({ link, point }) => {
    const way = poses().map((pose) => carried(pose, link, point));
    return { way: round ? [...way, way[0]] : way, now: carried(poseNow(), link, point) };
  });
}

function tellTraces() {
  const count = player.traced.length;
  knob.untrace.hidden = count === 0;
  knob.trace.setAttribute("aria-pressed", player.tracing);
}
