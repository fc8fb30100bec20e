// Lengths and angles: typed in for a link, and measured between the pins that are selected.

const degrees = (x) => Number(((x * 180) / Math.PI).toFixed(4));

/** Distance and direction on the sheet from one place to another. */
function polarOf(from, to) {
  const [u, v] = [0, 1].map((n) => dot(camera.view[n], minus(to, from)));
  return { far: Number(apart(from, to).toPrecision(9)), angle: degrees(Math.atan2(v, u)), onSheet: Math.hypot(u, v) };
}

/** Moves a pin, with all pins there, to a place; coordinates that stay keep their spelling. */
function putAt(pin, to) {
  const moves = pinsAt(pin.at).map((p) => ({ ...p, to, point: coordinatesOf(p).map((c, i) => (Math.abs(to[i] - p.at[i]) < touching() ? c : Number(to[i].toFixed(9)))) }));
  return change(...putPins(moves).edits);
}

/** Fields for the length and the angle from the first pin of a link to each other one. */
function lengthFields(link) {
  const all = pinsOf(link).filter((p, n, list) => list.findIndex((q) => apart(p.at, q.at) < touching()) === n);
  const frame = frameOf();
  const first = all.find((p) => p.links.includes(frame)) ?? all[0];
  if (all.length < 2 || !camera.plane) return [];
  const number = (act) => (text) => {
    const x = numeral(text);
    return x === null ? say("Enter a number.", true) : act(x);
  };
  return all.filter((p) => p !== first).map((p) => {
    const { far, angle, onSheet } = polarOf(first.at, p.at);
    const aside = minus(minus(p.at, first.at), plus(times(camera.view[0], dot(camera.view[0], minus(p.at, first.at))), times(camera.view[1], dot(camera.view[1], minus(p.at, first.at)))));
    const turned = (degree) => {
      const t = (degree * Math.PI) / 180;
      return plus(plus(first.at, aside), plus(times(camera.view[0], onSheet * Math.cos(t)), times(camera.view[1], onSheet * Math.sin(t))));
    };
    return element("div", { class: "pair-fields" },
      field(`to ${p.id}`, String(far), { take: number((x) => putAt(p, plus(first.at, times(minus(p.at, first.at), x / far)))) }),
      field("angle °", String(angle), { take: number((x) => putAt(p, turned(x))) }));
  });
}

/** Distances between two selected pins, or the angle at the second of three. */
function measured() {
  const places = selection.map((s) => pins().find((p) => p.what === s.what && p.id === s.id)).filter(Boolean);
  if (places.length !== selection.length || places.length < 2 || places.length > 3) return [];
  const unitWord = desk.look.file.length_unit ?? "m";
  const rows = places.slice(1).map((p, n) => {
    const { far, angle } = polarOf(places[n].at, p.at);
    return `${places[n].id} to ${p.id}: ${far} ${unitWord}, at ${angle}°`;
  });
  if (places.length === 3) {
    const [a, b] = [0, 2].map((n) => unit(minus(places[n].at, places[1].at)));
    rows.push(`angle at ${places[1].id}: ${degrees(Math.acos(Math.max(-1, Math.min(1, dot(a, b)))))}°`);
  }
  return rows.map((words) => element("p", { class: "told" }, words));
}

const forcesOf = () => desk.look?.file?.workload?.force ?? [];
const putForces = (list) => change({ do: "put", path: ["workload", "force"], value: list });
const putForce = (n, key, value) => putForces(forcesOf().map((f, k) => (k === n ? { ...f, [key]: value } : f)));

/** A force at a place of a link: ten newtons down the sheet, to be changed in its form. */
async function addForce(spot) {
  const link = spot.pin ? partnerAt(spot.pin) : spot.link ?? spot.plate;
  if (!link || link === frameOf()) return say("Click a pin, a point or a place of a moving link.", true);
  await putForces([...forcesOf(), { link, point: spot.point, force: camera.view[1].map((x) => rounded(-10 * x, 0.01)) }]);
  return select([{ what: "link", id: link }]);
}

/** Fields of the loads on a link: forces at points, and its mass. */
function loadFields(l) {
  const rows = forcesOf().map((f, n) => [f, n]).filter(([f]) => f.link === l.id);
  const triples = ([f, n]) => element("div", {},
    ...[["point", "force at"], ["force", "force, N"]].map(([key, words]) => element("fieldset", { class: "triple" }, element("legend", {}, words),
      ...f[key].map((c, i) => field("xyz"[i], shown(c), { take: (text) => putForce(n, key, f[key].map((old, k) => (k === i ? typed(text) : old))) })))),
    button("No force", () => putForces(forcesOf().filter((_, k) => k !== n))));
  return [...rows.map(triples), field("mass, kg", shown(l.mass ?? ""), { take: (text) => change(set("link", l.id, "mass", numeral(text))) })];
}

/** The forces of the file as arrows on the sheet. */
function forceArrows() {
  if (!isAtHome()) return [];
  return forcesOf().flatMap((f) => {
    const at = f.point.map(Number);
    const along = f.force.map(Number);
    if ([...at, ...along].some(Number.isNaN)) return [];
    const way = flatOf(along);
    if (Math.hypot(...way) < 1e-12) return [];
    const to = plus(toPaper(at), times(unit(way), 42));
    return [svgElement("path", { class: "applied", d: path([toPaper(at), to], false) }), head(to, unit(way), 9, "applied")];
  });
}

const couplingsOf = () => desk.look?.file?.coupling ?? [];

/** Gears between two joints that turn, or a rack where one of them slides. */
function meshJoints(spots) {
  const [a, b] = spots.map((s) => (s.pin?.what === "joint" ? s.pin.id : null));
  if (!a || (spots.length > 1 && (!b || a === b))) return say("Click two joints.", true);
  if (spots.length < 2) return null;
  const slides = (id) => SLIDES.includes(thing("joint", id).type);
  const [first, second] = slides(b) && !slides(a) ? [b, a] : [a, b];
  const [p, q] = [placeOf("joint", first), placeOf("joint", second)];
  // the pitch radius of a pinion is its distance from the rack
  const along = slides(first) ? unit(thing("joint", first).axis.map(Number)) : [0, 0, 0];
  const off = minus(minus(q, p), times(along, dot(along, minus(q, p))));
  const radius = Number(length(off).toPrecision(9));
  const ratio = !slides(first) ? -1 : radius > touching() ? `1/${radius}` : 1;
  return change({ do: "put", path: ["coupling"], value: [...couplingsOf(), { joints: [first, second], ratio, ...(slides(first) === slides(second) && slides(first) ? {} : { gear: true }) }] })
    .then(() => select([{ what: "joint", id: first }]));
}

/** Fields of the couplings of a joint. */
function couplingFields(id) {
  const all = couplingsOf();
  const put = (value) => change({ do: "put", path: ["coupling"], value });
  return all.map((c, n) => [c, n]).filter(([c]) => c.joints.includes(id)).map(([c, n]) => element("div", { class: "pair-fields" },
    field(`${c.joints[1]} per ${c.joints[0]}`, shown(c.ratio), { take: (text) => put(all.map((o, k) => (k === n ? { ...o, ratio: typed(text) } : o))) }),
    button("No gears", () => put(all.filter((_, k) => k !== n)))));
}
