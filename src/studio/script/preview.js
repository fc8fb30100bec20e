// The preview of a change before the program has answered: dragged pins take the ends of their links along.

const preview = {
  /** Pins that are dragged, with where they are now, in the coordinates of the file. */
  moved: [],
  /** The answer of the program, or null. */
  answer: null,
};

/** Shows the text again. */
function endPreview() {
  Object.assign(preview, { moved: [], answer: null });
  takeScene();
}

const inScene = (scene, p) => times(minus(p, scene.middle), scene.scale);

/** The present scene: of a change that is tried, or of the newest verdict. */
function sceneNow() {
  const tried = preview.answer?.verdict?.scenes?.[desk.state];
  const moving = desk.motion?.revision === desk.verdict?.revision ? desk.motion : null;
  return tried ?? moving?.scenes?.[desk.state] ?? desk.verdict?.scenes?.[desk.state] ?? null;
}

/** A scene with the ends of its links where the pins are. */
function bent(scene) {
  if (!preview.moved.length || preview.answer?.verdict) return scene;
  const ends = preview.moved.map(({ from, to }) => [from, to].map((p) => inScene(scene, p)));
  const put = (p) => ends.find(([from]) => length(minus(from, p)) < 0.6)?.[1] ?? p;
  return {
    ...scene,
    joints: scene.joints.map((j) => ({ ...j, at: put(j.at) })),
    wires: scene.wires.filter((w) => w.of === null).map((w) => ({ ...w, points: w.points.map(put) })),
  };
}

/** The position of a pin while it is dragged. */
const previewed = (at) => preview.moved.find(({ from }) => apart(from, at) < touching())?.to ?? at;

/** Links that are not in the scene: those not yet joined to the frame, or all if there is no verdict. */
function looseLinks() {
  const names = new Set(sceneNow()?.names ?? []);
  const stale = !desk.look?.whole && !desk.look?.partly;
  return listOf("link").filter((l) => l.id !== frameOf() && (stale || !names.has(l.id)));
}

/** Such a link on paper: its pins in a line, or round a plate. */
function looseShape(link) {
  const places = pinsOf(link.id).map((p) => toPaper(previewed(p.at)));
  if (!places.length) return [];
  const round = places.length > 2 ? hull(places) : places;
  const kind = `${places.length > 2 ? "plate" : "bone"}${link.role === "output" ? " out" : ""} loose`;
  return [svgElement("path", { class: kind, d: path(round, places.length > 2) })];
}
