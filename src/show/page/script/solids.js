// Solids as triangles, each with its corners and normals: what bodies are made of.

const minus = (a, b) => a.map((x, i) => x - b[i]);
const length = (a) => Math.hypot(...a);
const unit = (a) => times(a, 1 / (length(a) || 1));

/** A direction across another. */
function across(n) {
  const least = n.map(Math.abs);
  const k = least.indexOf(Math.min(...least));
  return unit(cross(n, [0, 1, 2].map((i) => (i === k ? 1 : 0))));
}

/** A list of triangles that grows: nine numbers a corner, its place, its normal and its colour. */
const heap = () => ({ numbers: [] });

function corner(to, p, n, colour) {
  to.numbers.push(...p, ...n, ...colour);
}

/** A polygon whose corners run counter-clockwise seen from outside, as a fan. */
function face(to, points, colour, normal = null) {
  const n = normal ?? unit(cross(minus(points[1], points[0]), minus(points[2], points[0])));
  for (let i = 2; i < points.length; i += 1) {
    for (const p of [points[0], points[i - 1], points[i]]) corner(to, p, n, colour);
  }
}

/** Round an axis: a profile of [radius, height], from below upwards on the outside, closed where it ends as it begins. */
function lathe(to, at, axis, profile, colour, part = 2 * Math.PI, from = null) {
  const z = unit(axis);
  const x = from ? unit(minus(from, times(z, dot(from, z)))) : across(z);
  const y = cross(z, x);
  const steps = Math.max(6, Math.round((24 * part) / (2 * Math.PI)));
  const out = (i) => {
    const angle = part * (i / steps - 0.5);
    return plus(times(x, Math.cos(angle)), times(y, Math.sin(angle)));
  };
  for (let k = 1; k < profile.length; k += 1) {
    const [[r0, h0], [r1, h1]] = [profile[k - 1], profile[k]];
    const on = (d, r, h) => plus(plus(at, times(d, r)), times(z, h));
    const lean = (d) => unit(plus(times(d, h1 - h0), times(z, r0 - r1)));
    for (let i = 0; i < steps; i += 1) {
      const [a, b] = [out(i), out(i + 1)];
      const [p, q, r, s] = [on(a, r0, h0), on(b, r0, h0), on(b, r1, h1), on(a, r1, h1)];
      const [na, nb] = [lean(a), lean(b)];
      if (r0 > 0) for (const [c, n] of [[p, na], [q, nb], [r, nb]]) corner(to, c, n, colour);
      if (r1 > 0) for (const [c, n] of [[p, na], [r, nb], [s, na]]) corner(to, c, n, colour);
    }
  }
  if (part < 2 * Math.PI) {
    for (const i of [0, steps]) {
      const flat = profile.map(([r, h]) => plus(plus(at, times(out(i), r)), times(z, h)));
      const side = times(cross(z, out(i)), i ? 1 : -1);
      face(to, i ? flat.reverse() : flat, colour, side);
    }
  }
}

/** A cylinder between two points. */
function rod(to, a, b, radius, colour) {
  const l = length(minus(b, a));
  if (l > 1e-6) lathe(to, a, minus(b, a), [[0, 0], [radius, 0], [radius, l], [0, l]], colour);
}

/** A cylinder of half a height with a bore about a point. */
const tube = (to, at, axis, outer, inner, half, colour, ...part) =>
  lathe(to, at, axis, [[inner, -half], [outer, -half], [outer, half], [inner, half], [inner, -half]], colour, ...part);

const disk = (to, at, axis, radius, half, colour) => lathe(to, at, axis, [[0, -half], [radius, -half], [radius, half], [0, half]], colour);

const arcOf = (radius, from, upTo, steps) => Array.from({ length: steps + 1 }, (_, i) => {
  const angle = from + ((upTo - from) * i) / steps;
  return [Math.max(0, radius * Math.cos(angle)), radius * Math.sin(angle)];
});
const ball = (to, at, radius, colour) => lathe(to, at, [0, 0, 1], arcOf(radius, -Math.PI / 2, Math.PI / 2, 10), colour);

/** A socket that holds a ball and is open along a direction. */
function socket(to, at, open, outer, inner, colour) {
  const [low, high] = [-Math.PI / 2, 0];
  lathe(to, at, open, [...arcOf(outer, low, high, 8), ...arcOf(inner, low, high, 8).reverse()], colour);
}

/** A box by the half of each side along three axes. */
function box(to, at, axes, half, colour) {
  for (const k of [0, 1, 2]) {
    const [u, v] = [(k + 1) % 3, (k + 2) % 3].map((i) => times(axes[i], half[i]));
    for (const side of [1, -1]) {
      const middle = plus(at, times(axes[k], side * half[k]));
      const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([s, t]) => plus(middle, plus(times(u, s), times(v, t))));
      face(to, side > 0 ? corners : corners.reverse(), colour, times(axes[k], side));
    }
  }
}

/** A beam from a point to another, as wide as `wide` along an axis and `high` across it. */
function beam(to, a, b, axis, wide, high, colour) {
  const along = minus(b, a);
  const l = length(along);
  if (l < 1e-6) return;
  const x = times(along, 1 / l);
  const z = unit(minus(axis, times(x, dot(axis, x))));
  box(to, times(plus(a, b), 0.5), [x, cross(z, x), z], [l / 2, high / 2, wide / 2], colour);
}

/** A flat polygon with a thickness. */
function slab(to, points, thick, colour) {
  const middle = times(points.reduce(plus), 1 / points.length);
  const n = unit(points.map((p, i) => cross(minus(p, middle), minus(points[(i + 1) % points.length], middle))).reduce(plus));
  const [low, high] = [-0.5, 0.5].map((s) => points.map((p) => plus(p, times(n, s * thick))));
  face(to, high, colour, n);
  face(to, [...low].reverse(), colour, times(n, -1));
  points.forEach((_, i) => {
    const k = (i + 1) % points.length;
    face(to, [low[i], low[k], high[k], high[i]], colour);
  });
}
