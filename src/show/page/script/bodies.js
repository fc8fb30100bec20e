// The links of a scene as bodies: rods and plates between the fittings of their joints.

const LINKS = [[0.42, 0.57, 0.75], [0.83, 0.6, 0.38], [0.5, 0.66, 0.5], [0.66, 0.53, 0.7], [0.78, 0.7, 0.42], [0.45, 0.66, 0.69], [0.76, 0.52, 0.52], [0.64, 0.72, 0.46]];
const FRAME = [0.62, 0.64, 0.67];
/** Distances below this, in pixels, are none. */
const SAME = 2;

const near = (p, q) => length(minus(p, q)) < SAME;
const mean = (points) => times(points.reduce(plus, [0, 0, 0]), 1 / points.length);

/** The joints of a scene as a variant has them. */
const jointsOf = (scene, swaps) => scene.joints.map((j, n) => ({ ...j, ...swaps.get(n), changed: swaps.has(n) }));

/** The places on each link: those of its joints, and its points of interest. */
function placesOf(scene) {
  const of = scene.names.map(() => []);
  for (const j of scene.joints) {
    if (j.turned) continue;
    for (const link of new Set(j.links)) if (!of[link].some((p) => near(p, j.at))) of[link].push(j.at);
  }
  return of;
}

/** How large fittings may be, that those of most links do not run into each other. */
function sizeOf(places) {
  const least = places.map((own) => Math.min(...own.flatMap((p, i) => own.slice(i + 1).map((q) => length(minus(p, q)))))).filter(Number.isFinite);
  least.sort((a, b) => a - b);
  return least.length ? Math.max(0.5, Math.min(2.2, least[Math.floor(least.length / 4)] / 34)) : 1;
}

/** How far each joint slides along z, or x of a slot, over the motions, from where it stands. */
function slideOf(scene, joint) {
  const axis = joint.axes[joint.pair.joint_type === "slotted" ? 0 : 2];
  const reach = [0, 0];
  if (!joint.pair.free.some((f) => f.startsWith("t") || f === "screw")) return reach;
  const guide = joint.pair.joint_type === "slotted" ? joint.links[joint.pair.swapped ? 0 : 1] : joint.links[1];
  const rides = joint.links.find((l) => l !== guide);
  for (const move of scene.moves) {
    for (const pose of move.poses) {
      const far = dot(minus(carried(pose, rides, joint.at), carried(pose, guide, joint.at)), turned(pose, guide, axis));
      reach[0] = Math.min(reach[0], far);
      reach[1] = Math.max(reach[1], far);
    }
  }
  return reach;
}

/** A foot on the frame below where a fitting leaves. */
function foot(heap, root, down, s) {
  const end = plus(root, times(down, 9 * s));
  beam(heap, root, end, across(down), 8 * s, 8 * s, FRAME);
  disk(heap, end, down, 10 * s, 1.6 * s, FRAME);
}

/** What is between the roots of a link's fittings. */
function armsOf(heap, roots, { wire, facet, colour, thick }) {
  if (facet) slab(heap, facet, 2.4, colour);
  if (roots.length < 2) return;
  if (wire) {
    // an arc about the place where its axes meet: round the same way, from fitting to fitting
    wire.forEach((p, i) => {
      if (i) rod(heap, wire[i - 1], p, thick, colour);
      ball(heap, p, thick, colour);
    });
    return;
  }
  if (facet) return;
  const hub = mean(roots);
  const off = roots.map((r) => minus(r, hub));
  const lead = off.reduce((a, b) => (length(b) > length(a) ? b : a));
  const wide = Math.max(...off.map((o) => length(cross(o, unit(lead)))));
  if (roots.length === 2 || wide < SAME) {
    const sorted = [...roots].sort((p, q) => dot(p, lead) - dot(q, lead));
    sorted.forEach((p, i) => i && rod(heap, sorted[i - 1], p, thick, colour));
    return;
  }
  ball(heap, hub, 1.3 * thick, colour);
  for (const r of roots) rod(heap, hub, r, thick, colour);
  const n = unit(cross(lead, off.reduce((a, b) => (length(cross(b, lead)) > length(cross(a, lead)) ? b : a))));
  if (off.every((o) => Math.abs(dot(o, n)) < 0.05 * length(lead))) {
    const x = unit(lead);
    const y = cross(n, x);
    const web = hull(off.map((o) => [dot(o, x), dot(o, y)])).map(([u, v]) => plus(hub, times(plus(times(x, u), times(y, v)), 0.72)));
    if (web.length > 2) slab(heap, web, 0.9 * thick, colour);
  }
}

/** The triangles of each link of a scene, as it stands at rest. */
function bodiesOf(scene, swaps) {
  const places = placesOf(scene);
  const s = sizeOf(places);
  const heaps = scene.names.map(heap);
  const roots = scene.names.map(() => []);
  const colourOf = (link) => (link === scene.frame ? FRAME : LINKS[link % LINKS.length]);
  const taken = [];
  for (const j of jointsOf(scene, swaps)) {
    if (!j.pair) {
      if (!j.turned && j.links[0] !== scene.frame) {
        roots[j.links[0]].push(j.at);
        ball(heaps[j.links[0]], j.at, 3 * s, PIN);
      }
      continue;
    }
    const [x, y, z] = j.axes;
    // joints on one pin stand side by side
    const stacked = taken.filter((t) => near(t.at, j.at) && Math.abs(dot(t.z, z)) > 0.99).length;
    const at = plus(j.at, times(z, 12 * s * stacked));
    taken.push({ at: j.at, z });
    const side = (link) => {
      const others = places[link].filter((p) => !near(p, j.at));
      const toward = link === scene.frame || !others.length ? times(scene.upright, -30) : minus(mean(others), j.at);
      return { link, heap: heaps[link], colour: colourOf(link), toward };
    };
    let [a, b] = (j.pair.swapped ? [1, 0] : [0, 1]).map((n) => side(j.links[n]));
    // the frame has the fork, not the eye; what slides on it is the guide
    const symmetric = ["revolute", "spherical", "prismatic", "cylindrical", "helical", "fixed"].includes(j.pair.joint_type);
    if (symmetric && (a.link === scene.frame || (j.pair.free.join() !== "rz" && b.link !== j.links[1]))) [a, b] = [b, a];
    const mid = j.changed ? NEW : PIN;
    if (j.changed) [a, b] = [a, b].map((one) => ({ ...one, colour: times(plus(one.colour, NEW), 0.5) }));
    const ends = (FITTINGS[j.pair.joint_type] ?? FITTINGS.custom)({ at, x, y, z, a, b, s, mid, slide: slideOf(scene, j) });
    [a, b].forEach((one, n) => {
      if (one.link !== scene.frame) roots[one.link].push(ends[n]);
      else foot(one.heap, ends[n], unit(beside(one.toward, z) ?? times(z, Math.sign(dot(one.toward, z)) || -1)), s);
    });
  }
  scene.names.forEach((_, link) => {
    if (link === scene.frame) return;
    const own = scene.wires.filter((w) => w.link === link && w.of === null && !w.turned && /bone|plate/.test(w.class));
    const wire = own.find((w) => w.form === "line")?.points;
    const plate = own.find((w) => w.form === "hull" && w.points.length > 2 && w.points.some((p) => !places[link].some((q) => near(p, q))));
    const out = own.some((w) => /\bout\b/.test(w.class));
    armsOf(heaps[link], roots[link], { wire, facet: plate?.points, colour: colourOf(link), thick: (out ? 4.2 : 3.2) * s });
  });
  for (const wire of scene.wires.filter((w) => /\bpitch\b/.test(w.class))) {
    const middle = mean(wire.points);
    const [p, q] = [minus(wire.points[0], middle), minus(wire.points[15], middle)];
    const radius = length(p);
    tube(heaps[wire.link], middle, cross(p, q), radius, Math.max(0.7 * radius, radius - 9), 2.2 * s, colourOf(wire.link));
  }
  return heaps.map((h) => new Float32Array(h.numbers));
}

/** The colours of ways, forces and moments. */
const [WAY, FORCE, MOMENT] = [[0.15, 0.45, 0.95], [0.75, 0.2, 0.15], [0.48, 0.3, 0.68]];

/** What stands in space beside the bodies: the ways of points, and arrows, two heads for a moment. */
function besideBodies(scene, motion, traces, loads) {
  const to = heap();
  const line = (way) => way.forEach((p, i) => i && rod(to, way[i - 1], p, 0.9, WAY));
  for (const { form, points } of scene.wires.filter((w) => motion !== null && w.of === motion && w.class === "trace")) line(form === "loop" ? [...points, points[0]] : points);
  for (const { way, now } of traces) {
    line(way);
    ball(to, now, 3.2, WAY);
  }
  for (const { at, along: whole, turns } of loads) {
    const [l, d, colour] = [length(whole), unit(whole), turns ? MOMENT : FORCE];
    const tip = Math.min(9, 0.6 * l);
    rod(to, at, plus(at, times(d, l - tip)), 1.5, colour);
    for (const back of turns ? [0, 0.8 * tip] : [0]) lathe(to, plus(at, times(d, l - tip - back)), d, [[0, 0], [4, 0], [0, tip]], colour);
  }
  return new Float32Array(to.numbers);
}
