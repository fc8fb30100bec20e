// The view of the sheet: along an axis of the coordinates, or oblique. It stays while the mechanism changes.

/** Right, up and towards the reader. */
const PLANES = {
  xy: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  xz: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  yz: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
};
const camera = {
  view: PLANES.xy,
  plane: "xy",
  /** The place of the file's coordinates in the middle of the sheet, and pixels of a unit of length. */
  centre: [0, 0, 0],
  zoom: 4,
  size: [800, 600],
  /** Whether the grid, its numbers and the scale are shown. */
  grid: true,
};

const flatOf = (v) => [dot(camera.view[0], v), -dot(camera.view[1], v)];
const middleOf = () => camera.size.map((s) => s / 2);
const toPaper = (p) => plus(times(flatOf(minus(p, camera.centre)), camera.zoom), middleOf());

/** The axis of the coordinates that looks at the reader the most: what is drawn lies across it. */
const depthAxis = () => [0, 1, 2].reduce((k, i) => (Math.abs(camera.view[2][i]) > Math.abs(camera.view[2][k]) + 1e-9 ? i : k), 0);

/** The place that is seen at a place of the paper, as deep as another. */
function fromPaper(q, deep) {
  const [a, b] = minus(q, middleOf()).map((x) => x / camera.zoom);
  const [right, up, toward] = camera.view;
  const p = plus(plus(camera.centre, times(right, a)), times(up, -b));
  const k = depthAxis();
  const out = plus(p, times(toward, (deep[k] - p[k]) / toward[k]));
  out[k] = deep[k];
  return out;
}

/** How the player's scene is seen. */
function sightNow() {
  const { scene } = player;
  const scale = camera.zoom / scene.scale;
  const at = plus(times(flatOf(minus(scene.middle, camera.centre)), camera.zoom), middleOf());
  return { view: camera.view, fit: { scale, at }, away: true };
}

/** Whether the mechanism stands as the file has it. */
const isAtHome = () => !player.scene || (player.motion === 0 && player.pulled === null && player.now === player.scene.moves[0].start && player.stress === null);

/** Puts it back into the pose of the file. */
function goHome() {
  if (player.scene) show(0);
}

/** Draws what is seen anew. */
function redraw() {
  if (player.scene) look();
  else drawSheet([]);
}

/** Places that are to be seen: pins, and where links end as the file has them. */
function toBeSeen() {
  const scene = sceneNow();
  const wires = (scene?.wires ?? []).filter((w) => w.of === null && /bone|plate/.test(w.class));
  return [...pins().map((p) => p.at), ...wires.flatMap((w) => w.points.map((p) => plus(times(p, 1 / scene.scale), scene.middle)))];
}

/** All of the mechanism in the middle. */
function fit() {
  const all = toBeSeen();
  const low = [0, 1].map((k) => Math.min(...all.map((p) => flatOf(p)[k])));
  const high = [0, 1].map((k) => Math.max(...all.map((p) => flatOf(p)[k])));
  if (!all.length) {
    [camera.centre, camera.zoom] = [[0, 0, 0], 4];
  } else {
    const span = low.map((l, k) => high[k] - l);
    const room = camera.size.map((s) => Math.max(60, s - 140));
    const zooms = span.map((s, k) => room[k] / (s || 1e-9));
    const zoom = Math.min(...zooms, 1e9);
    camera.zoom = zoom < 1e8 ? zoom : 4;
    const [x, y] = low.map((l, k) => (l + high[k]) / 2);
    const mean = times(all.reduce(plus), 1 / all.length);
    const deep = dot(mean, camera.view[2]);
    camera.centre = plus(plus(times(camera.view[0], x), times(camera.view[1], -y)), times(camera.view[2], deep));
  }
}

function fitAll() {
  fit();
  redraw();
}

/** Looks along an axis of the coordinates. */
function lookAt(plane) {
  [camera.view, camera.plane] = [PLANES[plane], plane];
  tellViews();
  fitAll();
}

/** Turns to the side about the axis z, and up. */
function turnView(side, up) {
  const about = (v, by) => v.map((d) => spun(d, by));
  let view = about(camera.view, [0, 0, side]);
  const tilted = about(view, times(view[0], up));
  if (Math.abs(tilted[1][2]) > 1e-3 && Math.sign(tilted[1][2]) === Math.sign(view[1][2] || 1)) view = tilted;
  [camera.view, camera.plane] = [view, null];
  tellViews();
  redraw();
}

/** Aslant, from where all three axes are seen. */
function lookAslant() {
  camera.view = PLANES.xz;
  turnView(-0.6, -0.45);
  fitAll();
}

function zoomBy(factor, at = middleOf()) {
  const before = fromPaper(at, camera.centre);
  camera.zoom = Math.max(1e-6, Math.min(1e9, camera.zoom * factor));
  camera.centre = plus(camera.centre, minus(before, fromPaper(at, camera.centre)));
  redraw();
}

function panBy(dx, dy) {
  const [right, up] = camera.view;
  camera.centre = plus(camera.centre, plus(times(right, -dx / camera.zoom), times(up, dy / camera.zoom)));
  redraw();
}

/** A step of the grid: 1, 2 or 5 and zeros, some pixels wide. */
function gridStep() {
  const least = 9 / camera.zoom;
  const ten = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((s) => s * ten).find((s) => s >= least - 1e-12);
}

/** The first view of a mechanism: along an axis if its drawing is, else oblique. */
function firstView(scene) {
  const same = Object.entries(PLANES).find(([, view]) => view.every((v, i) => dot(v, scene.view[i]) > 0.999));
  const flat = scene.view[2].some((x) => Math.abs(x) > 0.999);
  if (same) [camera.plane, camera.view] = same;
  else if (flat) {
    const k = scene.view[2].findIndex((x) => Math.abs(x) > 0.999);
    camera.plane = ["yz", "xz", "xy"][k];
    camera.view = PLANES[camera.plane];
  } else [camera.plane, camera.view] = [null, scene.view];
  tellViews();
  fit();
}
