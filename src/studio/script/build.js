// Drawing as changes to the file.

const add = (what, entry) => ({ do: "add", what, entry });
const set = (what, id, key, value) => ({ do: "set", what, id, key, value });
const remove = (items) => ({ do: "remove", items: items.map(({ what, id }) => [what, id]) });

/** The type that is put at new pins. */
let type = "revolute";
/** Types whose axis is the way that they slide. */
const SLIDES = ["prismatic"];
/** Points that a drawing put at the free ends of links. */
const isEnd = (id) => /^end \d+$/.test(id);

const axisAlong = (k) => [0, 1, 2].map((i) => (i === k ? 1 : 0));
/** The axis of a new joint: that of a turn looks at the reader, a slide or a screw goes to the right. */
const axisFor = (kind) => axisAlong([...SLIDES, "helical"].includes(kind) ? paperAxes()[0] : depthAxis());

/** A joint more. */
function newJoint(links, point, kind, also, more = {}) {
  const id = freeId("joint", links.join("-"), also);
  also.push(id);
  const own = { helical: { lead: 5 }, custom: { freedoms: ["rz", "tx"] } }[kind] ?? {};
  return add("joint", { id, links, type: kind, point, axis: more.axis ?? axisFor(kind), ...own, ...more });
}

/** The link that a new one is joined to at a pin; another than the frame if there is a choice. */
const partnerAt = (pin) => pin.links.find((l) => l !== frameOf()) ?? pin.links[0];

/** The changes that put a link at a position: a joint with the pin there, or a free end. */
function ending(link, spot, also) {
  if (spot.pin?.what === "joint") {
    const old = thing("joint", spot.pin.id);
    // what turns about one line there turns about the same
    const alike = old.axis && !SLIDES.includes(type) && !SLIDES.includes(old.type);
    return [newJoint([partnerAt(spot.pin), link], old.point, type, also.joints, { axis: alike ? old.axis : axisFor(type) })];
  }
  if (spot.pin) {
    const gone = isEnd(spot.pin.id) && !also.gone.includes(spot.pin.id) ? [remove([spot.pin])] : [];
    also.gone.push(spot.pin.id);
    return [...gone, newJoint([spot.pin.links[0], link], spot.point, type, also.joints)];
  }
  if (spot.link) return [newJoint([spot.link, link], spot.point, type, also.joints)];
  return [newEnd(link, spot.point, also)];
}

function newEnd(link, point, also) {
  const id = freeName("point", also.ends, (n) => `end ${n}`);
  also.ends.push(id);
  return add("point", { id, link, point });
}

const nothingYet = () => ({ joints: [], ends: [], gone: [] });

/** A bar or a plate through some places. */
async function addLink(spots) {
  const id = freeLink();
  const also = nothingYet();
  await change(add("link", { id }), ...spots.flatMap((s) => ending(id, s, also)));
  select([{ what: "link", id }]);
}

/** Joins to the frame what is at a place. */
async function ground(spot, kind = type) {
  const frame = frameOf();
  if (frame === null) return say("No link is the frame yet: select one and choose the role frame.", true);
  const link = spot.pin ? partnerAt(spot.pin) : spot.link;
  if (!link || link === frame) return say("Click a pin or a link to pivot it on the frame.", true);
  if (pinsAt(spot.at).some((p) => p.links.includes(frame) && p.links.includes(link))) return say(`Link ${link} is already joined to the frame there.`, true);
  const gone = spot.pin?.what === "point" && isEnd(spot.pin.id) ? [remove([spot.pin])] : [];
  const joint = newJoint([frame, link], spot.point, kind, []);
  await change(...gone, joint);
  select([{ what: "joint", id: joint.entry.id }]);
}

/** Adds a slide along the frame: of the link at a position, or of a new one. */
async function addSlide(spot) {
  if (spot.pin || spot.link) return ground(spot, "prismatic");
  const id = freeLink();
  const joint = newJoint([frameOf() ?? id, id], spot.point, "prismatic", []);
  await change(add("link", { id }), joint);
  select([{ what: "joint", id: joint.entry.id }]);
}

/** Adds a screw on the frame with its nut at a link; it is the drive if there is none. */
function addScrew([bearing, nut]) {
  if (!nut) return null;
  const link = linkOfSpot(nut);
  if (!link || link === frameOf()) return say("Click the bearing first, then a pin or a link that carries the nut.", true);
  const along = minus(nut.at, bearing.at).map(Math.abs);
  const axis = axisAlong(along.indexOf(Math.max(...along)));
  const id = freeLink();
  const also = [];
  const drive = listOf("joint").some((j) => j.drive) ? {} : { drive: true };
  const turns = newJoint([frameOf(), id], nut.point.map((c, i) => (axis[i] ? bearing.point[i] : c)), "revolute", also, { axis, ...drive });
  const thread = newJoint([id, link], nut.point, "helical", also, { axis });
  return change(add("link", { id }), turns, thread).then(() => select([{ what: "joint", id: thread.entry.id }]));
}

/** Adds a contact of a held part with a link, in a separate state. */
async function addContact(spot) {
  const link = spot.pin ? partnerAt(spot.pin) : spot.link;
  if (!link || link === frameOf()) return say("Click the face of a jaw: a pin, a point or a place of a link.", true);
  const object = listOf("link").find((l) => l.role === "object");
  const id = object?.id ?? freeId("link", "part");
  const edits = object ? [] : [add("link", { id, role: "object" })];
  const kind = type === "revolute" ? "fixed" : type;
  await change(...edits, newJoint([link, id], spot.point, kind, [], { axis: axisAlong(paperAxes()[1]), state: "clamped" }));
  say(`Link ${link} touches ${id} there in the state clamped, as ${kind}.`);
}

/** Turns the drive of a joint on or off. */
const toggleDrive = (id) => change(set("joint", id, "drive", thing("joint", id).drive ? null : true));

/** Gives a link a role, or takes it away; there is one frame. */
function toggleRole(id, role) {
  const own = thing("link", id).role === role;
  const others = role === "frame" && !own ? listOf("link").filter((l) => l.role === "frame").map((l) => set("link", l.id, "role", null)) : [];
  return change(...others, set("link", id, "role", own ? null : role));
}

/** Puts another type at some joints. */
const setType = (ids, kind) => change(...ids.flatMap((id) => {
  const own = { helical: ["lead", 5], custom: ["freedoms", ["rz", "tx"]] };
  const old = Object.entries(own).filter(([k]) => k === thing("joint", id).type && k !== kind).map(([, [key]]) => set("joint", id, key, null));
  const more = own[kind] && thing("joint", id)[own[kind][0]] === undefined ? [set("joint", id, ...own[kind])] : [];
  const axis = thing("joint", id).axis ? [] : [set("joint", id, "axis", axisFor(kind))];
  return [...old, set("joint", id, "type", kind), ...more, ...axis];
}));

function deleteSelection() {
  const all = selection.filter(({ what, id }) => !(what === "link" && id === frameOf()));
  if (!all.length) return selection.length ? say("The frame cannot be deleted; make another link the frame first.", true) : undefined;
  const links = all.filter((s) => s.what === "link").map((s) => s.id);
  // what is on a link goes with it
  const rest = all.filter(({ what, id }) => what === "link" || ![thing(what, id).links ?? thing(what, id).link].flat().some((l) => links.includes(l)));
  return change(remove(rest)).then(() => select([]));
}

/** Copies what is selected, each point put elsewhere: links with their joints and points, or joints between links that stay. */
async function copies(where, axisOf) {
  const links = selection.filter((s) => s.what === "link").map((s) => s.id).filter((id) => id !== frameOf());
  const on = (t) => (t.links ?? [t.link]).some((l) => links.includes(l));
  const picked = (what) => listOf(what).filter((t) => isSelected(what, t.id) || on(t));
  const [joints, points] = [picked("joint"), picked("point")];
  if (!joints.length && !points.length && !links.length) return say("Select links or pins first.", true);
  const also = nothingYet();
  const named = new Map();
  const edits = [];
  const chosen = [];
  for (const id of links) {
    const fresh = freeLink([...named.values()]);
    named.set(id, fresh);
    const { id: _, ...rest } = thing("link", id);
    edits.push(add("link", { id: fresh, ...rest }));
    chosen.push({ what: "link", id: fresh });
  }
  const linkOf = (l) => named.get(l) ?? l;
  const pairs = [];
  for (const j of joints) {
    const { id, links: ends, point, axis, reference, drive, options, ...rest } = j;
    const fresh = newJoint(ends.map(linkOf), where(point), j.type, also.joints, { ...rest, ...(axis ? { axis: axisOf(axis) } : {}), ...(reference ? { reference: axisOf(reference) } : {}) });
    pairs.push([id, fresh.entry.id]);
    edits.push(fresh);
    if (!links.length) chosen.push({ what: "joint", id: fresh.entry.id });
  }
  for (const p of points) {
    if (isEnd(p.id)) edits.push(newEnd(linkOf(p.link), where(p.point), also));
    else {
      const id = freeId("point", p.id, also.ends);
      also.ends.push(id);
      edits.push(add("point", { ...p, id, link: linkOf(p.link), point: where(p.point) }));
    }
  }
  await change(...edits);
  select(chosen);
  return pairs;
}

/** The mirror image of the selection in a plane of the coordinates; the search learns which joints are images. */
async function mirrorSelection(k) {
  const flip = (v) => flipped(v, k);
  const pairs = await copies(flip, flip);
  if (!pairs?.length) return;
  const known = desk.look?.file?.search?.mirror ?? [];
  // each has one image: the newest
  const others = known.filter((pair) => !pairs.some(([own]) => pair.includes(own)));
  await change({ do: "put", path: ["search", "mirror"], value: [...others, ...pairs] });
  say(`Mirrored in ${"xyz"[k]}.`);
}

/** A copy next to the selection. */
function copySelection() {
  const by = 4 * gridStep();
  const [a, b] = paperAxes();
  return copies((p) => p.map((c, i) => (i === a || i === b ? moved1(c, by) : c)), (v) => v);
}

/** A point, or where it is, on the other side of a plane of the coordinates. */
const flipped = (p, k) => p.map((c, i) => (i === k ? negated(c) : c));

/**
 * Puts pins elsewhere, and their mirror images along with them: the file says which joints are images of which. If the plane is not
 * a plane of coordinates, the pair stops being a pair. Returns the changes, and the images that move along.
 */
function putPins(moves) {
  const pairs = desk.look?.file?.search?.mirror ?? [];
  const images = [];
  const apartNow = [];
  for (const move of moves.filter((m) => m.what === "joint")) {
    const pair = pairs.find((p) => p.includes(move.id));
    const other = pair?.find((id) => id !== move.id);
    const own = placeOf("joint", move.id);
    const at = other && placeOf("joint", other);
    if (!at || !own || moves.some((m) => m.what === "joint" && m.id === other)) continue;
    const k = [0, 1, 2].find((i) => apart(flipped(own, i), at) < touching());
    if (k === undefined) apartNow.push(pair);
    else images.push({ what: "joint", id: other, from: at, to: move.to && flipped(move.to, k), point: flipped(move.point, k) });
  }
  const edits = [...moves, ...images].map((m) => set(m.what, m.id, "point", m.point));
  if (apartNow.length) edits.push({ do: "put", path: ["search", "mirror"], value: pairs.filter((p) => !apartNow.includes(p)) });
  return { edits, images };
}

/** Moves the pins that are selected, and those of links that are, by a step of the grid. */
function nudge(dx, dy) {
  const links = selection.filter((s) => s.what === "link").map((s) => s.id);
  const all = pins().filter((p) => isSelected(p.what, p.id) || p.links.some((l) => links.includes(l) && l !== frameOf()));
  const together = [...new Map(all.flatMap((p) => pinsAt(p.at)).map((p) => [`${p.what} ${p.id}`, p])).values()];
  if (!together.length) return null;
  const step = gridStep();
  const by = plus(times(camera.view[0], dx * step), times(camera.view[1], dy * step)).map((x) => rounded(x, step));
  return change(...putPins(together.map((p) => ({ ...p, point: coordinatesOf(p).map((c, i) => moved1(c, by[i])) }))).edits);
}
