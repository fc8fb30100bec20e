// What stands at a joint: a part on either link, as such joints are made. Each fitting puts its triangles on the two links and
// says where the arm of each begins.

/** The colour of pins, balls and threads, and of what a redesign has changed. */
const PIN = [0.3, 0.33, 0.37];
const NEW = [0.1, 0.42, 0.95];

/** The part of a direction across an axis; null where it is along it. */
function beside(direction, axis) {
  const flat = minus(direction, times(axis, dot(direction, axis)));
  return length(flat) > 0.25 * length(direction) && length(flat) > 1e-9 ? unit(flat) : null;
}

/** Where an arm begins that leaves a part about an axis. */
function leave(side, at, axis, far, high) {
  const d = beside(side.toward, axis);
  return plus(at, d ? times(d, far) : times(axis, Math.sign(dot(side.toward, axis)) * high));
}

/** A fork about an axis: two cheeks, and a bridge where its arm begins. */
function fork(side, at, axis, gap, radius, s) {
  const cheeks = [-gap, gap].map((h) => plus(at, times(axis, h)));
  const d = beside(side.toward, axis);
  for (const c of cheeks) disk(side.heap, c, axis, radius, 1.3 * s, side.colour);
  if (!d) {
    // the arm goes along the axis: it begins at the cheek on its side
    return plus(at, times(axis, Math.sign(dot(side.toward, axis)) * gap));
  }
  const out = times(d, radius + 7 * s);
  for (const c of cheeks) beam(side.heap, c, plus(c, out), axis, 2.6 * s, 1.7 * radius, side.colour);
  beam(side.heap, plus(cheeks[0], out), plus(cheeks[1], out), d, 3 * s, 1.7 * radius, side.colour);
  return plus(at, out);
}

const along = ({ at }, axis, far) => plus(at, times(axis, far));

/** The fittings by joint type, `custom` for one that has none: `f` has the place, the axes x, y, z, the sides a and b, the size s, and the colour of what is between. */
const FITTINGS = {
  revolute({ at, z, a, b, s, mid }) {
    tube(a.heap, at, z, 6 * s, 2.3 * s, 2.4 * s, a.colour);
    rod(b.heap, plus(at, times(z, -6 * s)), plus(at, times(z, 6 * s)), 2.3 * s, mid);
    return [leave(a, at, z, 5.5 * s, 2.4 * s), fork(b, at, z, 4.2 * s, 6 * s, s)];
  },
  prismatic(f) {
    const { at, x, y, z, a, b, s, mid, slide } = f;
    box(b.heap, along(f, z, (slide[0] + slide[1]) / 2), [x, y, z], [3 * s, 3 * s, (slide[1] - slide[0]) / 2 + 12 * s], mid);
    box(a.heap, at, [x, y, z], [6.5 * s, 6.5 * s, 8 * s], a.colour);
    return [at, along(f, z, Math.sign(dot(b.toward, z) || 1) * 12 * s)];
  },
  cylindrical(f) {
    const { at, z, a, b, s, mid, slide } = f;
    rod(b.heap, along(f, z, slide[0] - 12 * s), along(f, z, slide[1] + 12 * s), 2.8 * s, mid);
    tube(a.heap, at, z, 6.5 * s, 2.9 * s, 8 * s, a.colour);
    return [leave(a, at, z, 6 * s, 8 * s), along(f, z, Math.sign(dot(b.toward, z) || 1) * 12 * s)];
  },
  helical(f) {
    const { at, z, a, b, s, mid, slide } = f;
    const [low, high] = [slide[0] - 14 * s, slide[1] + 14 * s];
    const turns = Math.max(6, Math.round((high - low) / (3 * s)));
    const thread = Array.from({ length: 2 * turns + 1 }, (_, i) => [(i % 2 ? 3.4 : 2.4) * s, low + ((high - low) * i) / (2 * turns)]);
    lathe(b.heap, at, z, [[0, low], ...thread, [0, high]], mid);
    const nut = Array.from({ length: 6 }, (_, i) => plus(at, plus(times(f.x, 7.5 * s * Math.cos((i * Math.PI) / 3)), times(f.y, 7.5 * s * Math.sin((i * Math.PI) / 3)))));
    slab(a.heap, nut, 9 * s, a.colour);
    return [leave(a, at, z, 6 * s, 4.5 * s), along(f, z, Math.sign(dot(b.toward, z) || 1) * 14 * s)];
  },
  slotted({ at, x, y, z, a, b, s, mid, slide }) {
    rod(a.heap, plus(at, times(z, -5 * s)), plus(at, times(z, 5 * s)), 2.6 * s, mid);
    disk(a.heap, plus(at, times(z, 5 * s)), z, 5 * s, 1.5 * s, a.colour);
    const [low, high] = [slide[0] - 10 * s, slide[1] + 10 * s];
    for (const side of [-4.3, 4.3]) {
      const off = plus(at, times(y, side * s));
      beam(b.heap, plus(off, times(x, low)), plus(off, times(x, high)), z, 4 * s, 2.6 * s, b.colour);
    }
    for (const end of [low, high]) beam(b.heap, plus(plus(at, times(x, end)), times(y, -5.6 * s)), plus(plus(at, times(x, end)), times(y, 5.6 * s)), z, 4 * s, 2.6 * s, b.colour);
    const far = dot(b.toward, x) >= 0 ? high : low;
    return [plus(at, times(z, 5 * s)), plus(at, times(x, far))];
  },
  spherical({ at, a, b, s, mid }) {
    ball(a.heap, at, 5.6 * s, mid);
    socket(b.heap, at, a.toward, 8 * s, 6 * s, b.colour);
    return [at, plus(at, times(unit(times(a.toward, -1)), 7 * s))].map((p, n) => (n ? meet(p, b, at, 7.5 * s) : p));
  },
  universal({ at, x, z, a, b, s, mid }) {
    return crossed({ at, first: z, second: x, a, b, s, mid });
  },
  "cylindrical-universal": (f) => {
    const { at, x, z, a, b, s, mid, slide } = f;
    rod(b.heap, along(f, z, slide[0] - 14 * s), along(f, z, slide[1] + 14 * s), 2.4 * s, b.colour);
    tube(b.heap, at, z, 5 * s, 2.4 * s, 4.5 * s, mid);
    rod(b.heap, plus(at, times(x, -9 * s)), plus(at, times(x, 9 * s)), 1.8 * s, mid);
    return [fork(a, at, x, 8 * s, 4.5 * s, s), along(f, z, Math.sign(dot(b.toward, z) || 1) * 14 * s)];
  },
  planar({ at, x, y, z, a, b, s }) {
    return onPlate({ at, x, y, z, b, s, low: -2 * s }, () => {
      disk(a.heap, plus(at, times(z, 1.5 * s)), z, 8 * s, 2.5 * s, a.colour);
      return leave(a, plus(at, times(z, 1.5 * s)), z, 7 * s, 2.5 * s);
    });
  },
  "sphere-in-cylinder": (f) => {
    const { at, z, a, b, s, mid, slide } = f;
    const middle = along(f, z, (slide[0] + slide[1]) / 2);
    const half = (slide[1] - slide[0]) / 2 + 12 * s;
    // open on the side that the ball's rod comes from
    const away = beside(times(a.toward, -1), z) ?? across(z);
    tube(b.heap, middle, z, 8.5 * s, 6.4 * s, half, b.colour, 1.3 * Math.PI, away);
    ball(a.heap, at, 6.2 * s, mid);
    return [at, plus(at, times(away, 7.5 * s))];
  },
  "cylinder-on-plane": ({ at, x, y, z, a, b, s }) => onPlate({ at, x, y, z, b, s, low: -6 * s }, () => {
    rod(a.heap, plus(at, times(x, -8 * s)), plus(at, times(x, 8 * s)), 6 * s, a.colour);
    return at;
  }),
  "sphere-on-plane": ({ at, x, y, z, a, b, s, mid }) => onPlate({ at, x, y, z, b, s, low: -6 * s }, () => {
    ball(a.heap, at, 6 * s, mid);
    return at;
  }),
  fixed({ at, x, y, z, a, s, mid }) {
    box(a.heap, at, [x, y, z], [5 * s, 5 * s, 5 * s], mid);
    return [at, at];
  },
  custom({ at, x, y, z, a, b, s, mid }) {
    ball(a.heap, at, 4.5 * s, mid);
    for (const axis of [x, y, z]) tube(b.heap, at, axis, 7 * s, 6 * s, 1 * s, b.colour);
    return [at, at];
  },
};

/** From the surface of a ball's housing towards where its link goes, round the ball and not through it. */
function meet(back, side, at, far) {
  const d = unit(side.toward);
  return dot(d, minus(back, at)) > -0.3 * length(minus(back, at)) ? plus(at, times(d, far)) : back;
}

/** A cross of two pins, each in a fork. */
function crossed({ at, first, second, a, b, s, mid }) {
  const heaps = [[first, a], [second, b]];
  for (const [axis, side] of heaps) rod(side.heap, plus(at, times(axis, -8.5 * s)), plus(at, times(axis, 8.5 * s)), 2 * s, mid);
  ball(a.heap, at, 3.4 * s, mid);
  return heaps.map(([axis, side]) => fork(side, at, axis, 7.5 * s, 3.6 * s, s));
}

/** A plate on the second link, with something on it. */
function onPlate({ at, x, y, z, b, s, low }, put) {
  const root = put();
  const plate = plus(at, times(z, low - 1.2 * s));
  box(b.heap, plate, [x, y, z], [16 * s, 16 * s, 1.2 * s], b.colour);
  return [root, plus(plate, times(beside(b.toward, z) ?? times(z, -1), beside(b.toward, z) ? 14 * s : 1.2 * s))];
}
