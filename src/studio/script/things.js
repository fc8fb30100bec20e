// The links, joints and points of the file, and which of them are selected.

const listOf = (what) => desk.look?.file?.[what] ?? [];
const thing = (what, id) => listOf(what).find((t) => t.id === id) ?? null;
const frameOf = () => listOf("link").find((l) => l.role === "frame")?.id ?? null;

/** Whether a readable sheet has no drawing yet. */
const isEmpty = () => Boolean(desk.look?.file) && !listOf("joint").length && !listOf("point").length;

/** The position of a joint or a point in numbers; null if its expressions have no value. */
function placeOf(what, id) {
  const n = listOf(what).findIndex((t) => t.id === id);
  return desk.look?.places?.[what]?.[n] ?? null;
}

/** All pins: joints of the shown state, and points, with their positions. */
function pins() {
  const state = stateName();
  const there = (j) => !j.state || [j.state].flat().includes(state);
  const joints = listOf("joint").filter(there).map((t) => ({ what: "joint", id: t.id, links: t.links, at: placeOf("joint", t.id) }));
  const points = listOf("point").map((t) => ({ what: "point", id: t.id, links: [t.link], at: placeOf("point", t.id) }));
  return [...joints, ...points].filter((p) => p.at);
}

const stateName = () => desk.verdict?.analysis?.states[desk.state]?.state ?? "free";

/** The pins of a link. */
const pinsOf = (link) => pins().filter((p) => p.links.includes(link));

const apart = (p, q) => Math.hypot(...p.map((x, i) => x - q[i]));
/** Distances in the file below this are none. */
const touching = () => 1e-6 * Math.max(1, ...pins().map((p) => Math.max(...p.at.map(Math.abs))));

/** All pins at one position. */
const pinsAt = (at) => pins().filter((p) => apart(p.at, at) < touching());

/** The first of numbered names that nothing of a kind has. */
function freeName(what, also, named) {
  const taken = new Set([...listOf(what).map((t) => t.id), ...also]);
  for (let n = 1; ; n += 1) if (!taken.has(named(n))) return named(n);
}
const freeId = (what, wanted, also = []) => freeName(what, also, (n) => (n > 1 ? `${wanted} ${n}` : wanted));
const freeLink = (also = []) => freeName("link", also, String);

let selection = [];
const isSelected = (what, id) => selection.some((s) => s.what === what && s.id === id);

/** Selects some things, or one more. */
function select(list, more = false) {
  const all = more ? [...selection, ...list] : list;
  const seen = new Set();
  selection = all.filter(({ what, id }) => thing(what, id) && !seen.has(`${what} ${id}`) && seen.add(`${what} ${id}`));
  tell("selection", selection);
}

/** The next thing in the order of the file, for who has no mouse. */
function selectNext(step) {
  const all = [...listOf("joint").map((t) => ["joint", t.id]), ...listOf("point").map((t) => ["point", t.id]), ...listOf("link").map((t) => ["link", t.id])];
  if (!all.length) return;
  const now = selection.length ? all.findIndex(([what, id]) => isSelected(what, id)) : step > 0 ? -1 : 0;
  const [what, id] = all[(now + step + all.length) % all.length];
  select([{ what, id }]);
  say(`${what} ${id}`);
}

/** The errors and warnings about a thing. */
function toldOf(what, id) {
  const n = listOf(what).findIndex((t) => t.id === id);
  return (desk.look?.told ?? []).filter((t) => t.about && t.about[0] === what && t.about[1] === n);
}
