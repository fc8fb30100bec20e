// Links that are pulled about while their joints stay closed: each link has six coordinates, each joint its equations, and a
// pull is followed by least squares (Gauss and Newton).

/** A radian counts as so many pixels. */
const REACH = 60;
/** The weight of equations of joints, relative to a pull. */
const FIRM = 1e4;
/** A joint that gapes more than this, in pixels, is open; one below the second is closed. */
const [OPEN, SHUT] = [0.05, 1e-4];

const turnOf = (v, [x, y, z]) => [0, 1, 2].map((i) => v[0] * x[i] + v[1] * y[i] + v[2] * z[i]);
const mean = (points) => times(points.reduce(plus, [0, 0, 0]), 1 / points.length);
const AXES = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** Where links are: of each the images of the three axes, and of the origin. */
const placesIn = (pose, count) => Array.from({ length: count }, (_, link) => ({
  axes: AXES.map((e) => turned(pose, link, e)),
  at: carried(pose, link, [0, 0, 0]),
}));

/** The rotation vector that turns the axes so. */
function spinOf([x, y, z]) {
  const c = Math.max(-1, Math.min(1, (x[0] + y[1] + z[2] - 1) / 2));
  const v = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
  const angle = Math.acos(c);
  if (angle < 1e-6) return times(v, 0.5);
  if (angle < 3.1) return times(v, angle / (2 * Math.sin(angle)));
  // half a turn: the axis is in what is symmetric
  const square = [x[0], y[1], z[2]].map((d) => Math.sqrt(Math.max(0, (d - c) / (1 - c))));
  const k = square.indexOf(Math.max(...square));
  const columns = [x, y, z];
  const axis = unit([0, 1, 2].map((i) => (i === k ? square[k] : (columns[k][i] + columns[i][k]) / (2 * (1 - c) * square[k]))));
  return times(axis, dot(axis, v) < 0 ? -angle : angle);
}

/** Such places as a pose of a scene. */
const poseOf = (links) => links.map(({ axes, at }) => [...spinOf(axes), ...at]);

/** The equations of each joint of a scene: slides go along axes of the joint's second link if turns come before them. */
function holdsOf(scene) {
  return scene.joints.filter((j) => j.pair && j.links[0] !== j.links[1]).map((j) => {
    const [a, b] = j.pair.swapped ? [j.links[1], j.links[0]] : j.links;
    const { free } = j.pair;
    const screw = free.includes("screw");
    const turns = [...free.filter((f) => f[0] === "r").map((f) => "xyz".indexOf(f[1])), ...(screw && !free.includes("rz") ? [2] : [])];
    const slides = [...free.filter((f) => f[0] === "t").map((f) => "xyz".indexOf(f[1])), ...(screw ? [2] : [])];
    const early = free.length > 0 && free[0][0] === "t" && turns.length > 0;
    return { a, b, at: j.at, axes: j.axes, turns, slides, carrier: early ? a : b, pitch: screw && free.length === 1 ? j.pair.pitch : null, wound: 0 };
  });
}

/** The axes and places of a joint on its two links. */
function standing(hold, links) {
  const on = (n) => hold.axes.map((v) => turnOf(v, links[n].axes));
  const place = (n) => plus(turnOf(hold.at, links[n].axes), links[n].at);
  return { A: on(hold.a), B: on(hold.b), pa: place(hold.a), pb: place(hold.b) };
}

/** The part of an equation in what a link does: it turns about its middle, and shifts. */
const block = (link, turn, shift) => ({ link, row: [...times(turn, 1 / REACH), ...shift] });

/** How fast the place of a joint goes along a direction with each of its links, the second backwards. */
function slideRow(hold, links, { pa, pb }, direction, carrier) {
  const arm = (n, p) => cross(minus(p, links[n].middle), direction);
  const lever = cross(direction, minus(pa, pb));
  const [ta, tb] = [arm(hold.a, pa), times(arm(hold.b, pb), -1)];
  return [
    block(hold.a, carrier === hold.a ? plus(ta, lever) : ta, direction),
    block(hold.b, carrier === hold.b ? plus(tb, lever) : tb, times(direction, -1)),
  ];
}

const spinRow = (hold, direction) => [block(hold.a, times(direction, REACH), [0, 0, 0]), block(hold.b, times(direction, -REACH), [0, 0, 0])];

/** How far a joint has turned about z, near to what it was last. */
function windOf(hold, { A, B }) {
  const angle = Math.atan2(dot(B[0], A[1]), dot(B[0], A[0]));
  return angle + 2 * Math.PI * Math.round((hold.wound - angle) / (2 * Math.PI));
}

/** The equations of a joint: each its parts by link, and what it gapes. */
function equationsOf(hold, links) {
  const now = standing(hold, links);
  const { A, B, pa, pb } = now;
  const out = [];
  const spin = (direction, value) => out.push({ parts: spinRow(hold, direction), value: value * REACH });
  const { turns } = hold;
  if (turns.length === 0) {
    const apart = times([0, 1, 2].map((i) => cross(B[i], A[i])).reduce(plus), 0.5);
    for (const e of AXES) spin(e, dot(apart, e));
  } else if (turns.length === 1) {
    const n = turns[0];
    for (const m of [(n + 1) % 3, (n + 2) % 3]) spin(cross(A[n], B[m]), dot(A[n], B[m]));
  } else if (turns.length === 2) {
    const [n, m] = turns;
    spin(cross(A[n], B[m]), dot(A[n], B[m]));
  }
  const frame = hold.carrier === hold.a ? A : B;
  for (const k of [0, 1, 2].filter((i) => !hold.slides.includes(i))) {
    out.push({ parts: slideRow(hold, links, now, frame[k], hold.carrier), value: dot(frame[k], minus(pa, pb)) });
  }
  if (hold.pitch !== null) {
    // the second link goes along z by the pitch for each radian it has turned about it
    const parts = [...slideRow(hold, links, now, B[2], hold.b), ...spinRow(hold, times(B[2], -hold.pitch / REACH))];
    out.push({ parts, value: dot(B[2], minus(pa, pb)) + hold.pitch * windOf(hold, now) });
  }
  return out;
}

/** The coordinate of a coupled freedom and how it changes. */
function freedomOf(hold, links, name) {
  const now = standing(hold, links);
  const k = "xyz".indexOf(name[1]);
  const back = (parts, by) => parts.map((p) => ({ link: p.link, row: times(p.row, -by) }));
  if (name[0] === "t") {
    const frame = hold.carrier === hold.a ? now.A : now.B;
    return { parts: back(slideRow(hold, links, now, frame[k], hold.carrier), 1), value: dot(frame[k], minus(now.pb, now.pa)) };
  }
  const axis = hold.turns[0] === k ? now.A[k] : now.B[k];
  // the angles of hinges are known; of other joints only how they change
  const value = hold.turns.join() === "2" ? windOf(hold, now) : null;
  return { parts: back(spinRow(hold, axis), 1 / REACH), value };
}

/** The equations of couplings. */
function tiesOf(scene, holds, links) {
  const known = scene.joints.filter((j) => j.pair && j.links[0] !== j.links[1]);
  return scene.couplings.map((tie) => {
    const ends = tie.joints.map((n, i) => freedomOf(holds[known.indexOf(scene.joints[n])], links, tie.freedoms[i]));
    const parts = ends.flatMap((e, i) => e.parts.map((p) => ({ link: p.link, row: times(p.row, REACH * tie.factors[i]) })));
    const value = ends.every((e) => e.value !== null) ? REACH * ends.reduce((sum, e, i) => sum + tie.factors[i] * e.value, 0) : 0;
    return { parts, value };
  });
}

/** The step that meets weighted equations best, six numbers a link: from the normal equations, damped so that each has a solution. */
function stepFor(equations, weights, damping, count, fixed) {
  const size = 6 * count;
  const rows = Array.from({ length: size }, (_, i) => new Float64Array(size + 1).fill(damping, i, i + 1));
  equations.forEach(({ parts, value }, n) => {
    const moving = parts.filter((p) => p.link !== fixed);
    for (const p of moving) {
      for (let r = 0; r < 6; r += 1) {
        const [row, by] = [rows[6 * p.link + r], weights(n) * p.row[r]];
        row[size] -= by * value;
        for (const q of by === 0 ? [] : moving) for (let k = 0; k < 6; k += 1) row[6 * q.link + k] += by * q.row[k];
      }
    }
  });
  return solved(rows);
}

/** Moves links by a step: each turns about its middle and shifts. */
function moved(links, step) {
  return links.map((l, n) => {
    const turn = times(step.slice(6 * n, 6 * n + 3), 1 / REACH);
    const shift = step.slice(6 * n + 3, 6 * n + 6);
    if (turn.every((x) => x === 0) && shift.every((x) => x === 0)) return l;
    const middle = plus(l.middle, shift);
    return { axes: l.axes.map((v) => spun(v, turn)), at: plus(middle, spun(minus(l.at, l.middle), turn)), middle };
  });
}

/** A mechanism that can be pulled from the last of some poses; the first of them is the one at rest, which angles count from. */
function pullable(scene, poses) {
  const places = placesOf(scene);
  const holds = holdsOf(scene);
  const linksIn = (pose) => placesIn(pose, scene.names.length).map((l, n) => ({ ...l, middle: plus(turnOf(places[n].length ? mean(places[n]) : [0, 0, 0], l.axes), l.at) }));
  let links = null;
  const wind = () => holds.forEach((h) => (h.wound = windOf(h, standing(h, links))));
  for (const pose of poses) {
    links = linksIn(pose);
    wind();
  }
  const equations = (at) => [...holds.flatMap((h) => equationsOf(h, at)), ...tiesOf(scene, holds, at)];
  const gap = (list) => list.reduce((most, e) => Math.max(most, Math.abs(e.value)), 0);
  const step = (list, firm, damping) => stepFor(list, (n) => (n < firm ? FIRM : 1), damping, links.length, scene.frame);
  /** Closes the joints of some places; null where they do not. */
  const closed = (from) => {
    let at = from;
    for (let n = 0; n < 12; n += 1) {
      const list = equations(at);
      if (gap(list) < SHUT) break;
      at = moved(at, step(list, list.length, 1e-3));
    }
    return gap(equations(at)) < OPEN ? at : null;
  };
  return {
    pose: () => poseOf(links),
    gap: () => gap(equations(links)),
    /** Pulls a point of a link, given at rest, to a position right and up in the view; false if it does not move. */
    pull(link, point, view, target) {
      const before = links;
      let at = links;
      for (let n = 0; n < 4; n += 1) {
        const list = equations(at);
        const p = plus(turnOf(point, at[link].axes), at[link].at);
        const off = [0, 1].map((k) => dot(view[k], p) - target[k]);
        // a long way is gone in steps, so that it stays on its branch
        const short = Math.min(1, 25 / (Math.hypot(...off) || 1));
        const pulls = [0, 1].map((k) => ({ parts: [block(link, cross(minus(p, at[link].middle), view[k]), view[k])], value: short * off[k] }));
        at = moved(at, step([...list, ...pulls], list.length, 0.02));
      }
      links = closed(at) ?? before;
      wind();
      return links !== before;
    },
  };
}
