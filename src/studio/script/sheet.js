// The sheet: grid, contours with what is redundant in them, the mechanism, names, and what is pointed at.

const LAYERS = ["grid", "tints", "things", "loads", "marks", "names", "over"];
const layer = {};
/** The thing, contour, idea or self-stress under the pointer. */
const pointedAt = { pin: null, link: null, contour: null, idea: null, stress: null };
/** The greatest number of names next to pins. */
const NAMED = 60;

function makeSheet() {
  const svg = svgElement("svg", { class: "ozd", "aria-hidden": "true" });
  for (const name of LAYERS) svg.append((layer[name] = svgElement("g", { "data-layer": name })));
  byId("sheet").append(svg);
  new ResizeObserver(() => {
    const { width, height } = byId("sheet").getBoundingClientRect();
    if (!width || (camera.size[0] === width && camera.size[1] === height)) return;
    // the drawing keeps its distance from the left and the top
    if (takeScene.seen) panBy((camera.size[0] - width) / 2, (camera.size[1] - height) / 2);
    camera.size = [width, height];
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    redraw();
  }).observe(byId("sheet"));
}

const fill = (name, parts) => layer[name].replaceChildren(...parts.filter(Boolean));

/** The lines of the grid with their numbers, and the axes; where the paper lies along two axes of the coordinates. */
function gridLines() {
  if (!camera.plane || !camera.grid) return [];
  const [w, h] = camera.size;
  const step = gridStep() * 5;
  const out = [];
  const [k, l] = [0, 1].map((n) => camera.view[n].findIndex((x) => Math.abs(x) > 0.5));
  const [low, high] = [fromPaper([0, h], camera.centre), fromPaper([w, 0], camera.centre)];
  const lines = (axis, line, place) => {
    const [from, to] = [low[axis], high[axis]].sort((a, b) => a - b);
    if ((to - from) / step > 200) return;
    for (let x = Math.ceil(from / step) * step; x <= to; x += step) {
      const p = [...camera.centre];
      p[axis] = x;
      const at = toPaper(p);
      out.push(svgElement("path", { class: Math.abs(x) < step / 2 ? "axis-line" : "grid-line", d: line(at) }));
      const named = place(at);
      if (named.y > 10 && (named.y > 22 || named.x > 3)) out.push(svgElement("text", { class: "small soft", ...named }, String(rounded(x, step))));
    }
  };
  lines(k, ([x]) => `M${x.toFixed(1)} 0V${h}`, ([x]) => ({ x: x + 3, y: 11 }));
  lines(l, ([, y]) => `M0 ${y.toFixed(1)}H${w}`, ([, y]) => ({ x: 3, y: y - 3 }));
  return out;
}

/** How long a length of the file is on the sheet. */
function scaleBar() {
  if (!camera.grid) return [];
  const step = gridStep() * 5;
  const words = `${shown(step)} ${desk.look?.file?.length_unit ?? "m"}`;
  return [
    svgElement("path", { class: "fine", d: `M48 42v6h${(step * camera.zoom).toFixed(1)}v-6` }),
    svgElement("text", { class: "small soft", x: 54 + step * camera.zoom, y: 50 }, words),
  ];
}

/** The directions of the coordinates, in the corner. */
function corner3() {
  const at = [34, camera.size[1] - 34];
  return [0, 1, 2].flatMap((n) => {
    const tip = [24 * camera.view[0][n], -24 * camera.view[1][n]];
    if (Math.hypot(...tip) < 3) return [];
    const line = svgElement("path", { class: "fine", d: path([at, plus(at, tip)], false) });
    const name = svgElement("text", { class: "soft", x: at[0] + 1.35 * tip[0], y: at[1] + 1.35 * tip[1] + 4, "text-anchor": "middle" }, "xyz"[n]);
    return [line, name];
  });
}

/** The state that is judged: of a change that is tried, or of the text. */
const judgedState = () => (preview.answer?.verdict ?? desk.verdict)?.analysis?.states[desk.state] ?? null;

/** The position of a joint of the scene on paper, in the current pose. */
const jointOnPaper = ({ fit }, pose, j) => plus(times(flatOf(carried(pose, j.links[0], j.at)), fit.scale), fit.at);

/** The contours, tinted by what is redundant in each. */
function tints(scene, sight, pose) {
  const state = judgedState();
  if (!state) return [];
  const at = new Map(scene.joints.filter((j) => j.pair).map((j) => [j.id, jointOnPaper(sight, pose, j)]));
  const all = state.per_contour.map((c, n) => ({ ...c, n, round: c.joints.map((id) => at.get(id)).filter(Boolean) }));
  const area = (round) => Math.abs(turning(round));
  all.sort((a, b) => area(b.round) - area(a.round));
  return all.filter((c) => c.round.length > 1).map((c) => {
    const looked = pointedAt.contour === c.n ? " looked" : "";
    return svgElement("path", { class: `tint s s${Math.min(c.redundant, 6)}${looked}`, d: path(c.round, true), "data-contour": c.n });
  });
}

/** The symbols of an idea at the joints of the scene. */
function swapsOfIdea() {
  const marks = desk.ideas?.marks?.[desk.state];
  const idea = pointedAt.idea === null ? null : desk.ideas?.found?.variants[pointedAt.idea];
  if (!idea || !marks) return { swaps: new Map(), symbols: null };
  const rows = idea.changes.map((c) => marks.rows.findIndex(([joint, to]) => joint === c.joint && to === c.to)).filter((n) => n >= 0);
  return { swaps: new Map(rows.map((n) => [marks.swaps[n].joint, marks.swaps[n]])), symbols: marks.symbols };
}

/** The loads that are shown: of a self-stress that is pointed at, or of the first at a joint that is. */
function loadsOf(scene) {
  let k = player.stress ?? pointedAt.stress;
  if (k === null && pointedAt.pin?.what === "joint" && isAtHome()) {
    const id = pointedAt.pin.id;
    const bears = judgedState()?.self_stresses.findIndex((s) => s.joints.some((j) => j.joint === id)) ?? -1;
    k = bears >= 0 ? drawnStress(scene, bears) : null;
  }
  return k === null || k < 0 ? [] : scene.stresses?.[k]?.arrows ?? [];
}

/** A ring round a place. */
const ring = (at, r, kind) => svgElement("circle", { class: kind, cx: at[0], cy: at[1], r });

/** The marks of the selection, of the thing under the pointer, and of errors. */
function marksOf(paperOf) {
  const out = [];
  for (const p of pins()) {
    const at = paperOf(p);
    const told = toldOf(p.what, p.id);
    if (told.some((t) => t.grave)) out.push(ring(at, 15, "wrong"));
    if (isSelected(p.what, p.id)) out.push(ring(at, 13, "chosen-ring"));
    if (pointedAt.pin?.id === p.id && pointedAt.pin?.what === p.what) out.push(ring(at, 13, "looked-ring"));
  }
  for (const l of listOf("link")) {
    const looked = pointedAt.link === l.id;
    if (!isSelected("link", l.id) && !looked) continue;
    const places = pinsOf(l.id).map(paperOf);
    if (places.length) out.push(svgElement("path", { class: isSelected("link", l.id) ? "chosen-link" : "looked-link", d: path(places.length > 2 ? hull(places) : places, places.length > 2) }));
  }
  return out;
}

/** The names of pins; those at one place together. */
function names(paperOf) {
  const all = pins();
  if (all.length > NAMED) return [];
  const groups = [];
  for (const p of all) {
    const at = paperOf(p);
    const group = groups.find((g) => Math.hypot(g.at[0] - at[0], g.at[1] - at[1]) < 4);
    if (group) group.ids.push(p.id);
    else groups.push({ at, ids: [p.id] });
  }
  return groups.map((g) => {
    const words = g.ids.join(", ");
    return svgElement("text", { class: "small soft", x: g.at[0] + 12, y: g.at[1] - 10 }, words.length > 24 ? `${words.slice(0, 23)}…` : words);
  });
}

/** Draws all of it; the player calls this for each picture. */
function drawSheet(traces) {
  const { scene, sight } = player;
  const pose = scene ? poseNow() : null;
  const home = isAtHome();
  const bending = scene ? bent(scene) : null;
  const paperOf = (p) => {
    const j = home || !scene ? null : scene.joints.find((s) => s.id === p.id && Boolean(s.pair) === (p.what === "joint"));
    return j ? jointOnPaper(sight, pose, j) : toPaper(previewed(p.at));
  };
  sheetPins = pins().map((p) => ({ ...p, paper: paperOf(p) }));
  fill("grid", [...gridLines(), ...scaleBar(), ...corner3()]);
  if (scene) {
    const { swaps, symbols } = swapsOfIdea();
    const marked = symbols && bending === scene ? { ...scene, symbols } : bending;
    const loads = loadsOf(scene);
    fill("tints", tints(bending, sight, pose));
    fill("things", [...pictureOf(marked, sight, pose, player.stress === null ? player.motion : null, loads, swaps, null), ...traces.flatMap((t) => tracePicture(t, sight))]);
  } else {
    fill("tints", []);
    fill("things", []);
  }
  fill("loads", [...looseLinks().flatMap(looseShape), ...forceArrows()]);
  fill("marks", [...loosePins(paperOf), ...marksOf(paperOf)]);
  fill("names", names(paperOf));
  fill("over", toolPicture());
  placeProblems(paperOf);
}
let sheetPins = [];

/** Pins that the scene does not have. */
function loosePins(paperOf) {
  const known = new Set((player.scene?.joints ?? []).map((j) => j.id));
  const stale = !desk.look?.whole && !desk.look?.partly;
  return pins().filter((p) => stale || !known.has(p.id)).map((p) => ring(paperOf(p), p.what === "joint" ? 6 : 3.5, p.what === "joint" ? "joint loose" : "ink loose"));
}

/** Problems next to the things that they concern. */
function placeProblems(paperOf) {
  const at = pins().flatMap((p) => toldOf(p.what, p.id).filter((t) => t.grave).map((t) => ({ t, at: paperOf(p) })));
  const list = byId("beside");
  const words = at.map(({ t }) => t.words).join("\n");
  if (list.dataset.words !== words) {
    list.dataset.words = words;
    list.replaceChildren(...at.map(({ t }) => element("li", {}, t.words)));
  }
  [...list.children].forEach((item, n) => {
    item.style.setProperty("left", `${at[n].at[0] + 18}px`);
    item.style.setProperty("top", `${at[n].at[1] + 8}px`);
  });
}

/** Shows another scene, or none. */
function takeScene() {
  const scene = sceneNow();
  if (!scene) {
    stop();
    player.scene = null;
    byId("player").inert = true;
    drawSheet([]);
    return;
  }
  byId("player").inert = false;
  const first = !takeScene.seen;
  if (first) {
    takeScene.seen = true;
    firstView(scene);
  }
  playOn(scene, () => [drawSheet]);
}
