// A mechanism in space as SVG elements: shapes and symbols on links, carried by a pose and seen in a view. The program
// that writes the page draws the first view in the same way.

/** The share of an axis towards the reader from which it counts as seen from its end. */
const END_ON = 0.9;

const plus = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const length = (a) => Math.hypot(...a);
const unit = (a) => times(a, 1 / (length(a) || 1));
const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);

/** A direction turned by a rotation vector. */
function spun(v, by) {
  const angle = Math.hypot(...by);
  if (angle === 0) return v;
  const axis = times(by, 1 / angle);
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  return plus(plus(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}

const path = (points, closed) => `M${points.map((p) => p.map((x) => x.toFixed(1)).join(" ")).join("L")}${closed ? "Z" : ""}`;
const disc = (p, r) => Array.from({ length: 24 }, (_, i) => plus(p, [r * Math.cos(i * Math.PI / 12), r * Math.sin(i * Math.PI / 12)]));
const turning = (points) => points.reduce((sum, p, i) => {
  const q = points[(i + 1) % points.length];
  return sum + p[0] * q[1] - p[1] * q[0];
}, 0);

/** Across a direction on paper, upwards; of one that goes up itself, to where no rail is. */
function upperSide(along) {
  const [x, y] = times(along, 1 / Math.hypot(...along));
  return -x > 1e-9 ? [-y, x] : [y, -x];
}

/** A piece of a symbol with its corners on paper; null if it is hidden. */
function shape(part, points, at) {
  if (part.form === "ball") return svgElement("circle", { class: part.class, cx: at[0] + points[0][0], cy: at[1] + points[0][1], r: part.radius });
  if (part.form === "face" && turning(points) > -0.05) return null;
  const round = part.form === "hull" ? hull(part.radius ? points.flatMap((p) => disc(p, part.radius)) : points) : points;
  return svgElement("path", { class: part.class, d: path(round.map((p) => plus(p, at)), part.form !== "line") });
}

/** The head of an arrow. */
function head(tip, along, size, kind) {
  const back = times(along, -size / Math.hypot(...along));
  const side = times([-back[1], back[0]], 0.4);
  const foot = plus(tip, back);
  return svgElement("path", { class: `${kind} head`, d: path([tip, plus(foot, side), plus(foot, times(side, -1))], true) });
}

/** An arrow: two heads for a moment, or an arc where it is seen from its end. */
function arrow(load, at, along, toward) {
  const kind = load.turns ? "moment" : "force";
  const group = svgElement("g", { class: "load" });
  group.append(svgElement("title", {}, load.tip));
  const [length, ahead] = [Math.hypot(...load.along), dot(load.along, toward)];
  if (load.turns && Math.abs(ahead) > 0.9 * length) {
    const radius = 0.3 * length;
    const arc = Array.from({ length: 25 }, (_, i) => {
      const angle = (-Math.sign(ahead) * 1.5 * Math.PI * i) / 24;
      return plus(at, [radius * Math.cos(angle), radius * Math.sin(angle)]);
    });
    group.append(svgElement("path", { class: kind, d: path(arc, false) }), head(arc[24], plus(arc[24], times(arc[22], -1)), Math.min(8, 0.8 * radius), kind));
    return group;
  }
  if (Math.abs(ahead) > 0.9 * length) {
    const [d, r] = [0.07 * length, 0.1 * length];
    const feather = (s) => svgElement("path", { class: kind, d: path([plus(at, [-d, -s * d]), plus(at, [d, s * d])], false) });
    const inside = ahead > 0 ? [svgElement("circle", { class: `${kind} head`, cx: at[0], cy: at[1], r: 0.3 * r })] : [feather(1), feather(-1)];
    group.append(svgElement("path", { class: kind, d: path(disc(at, r), true) }), ...inside);
    return group;
  }
  const [tip, size] = [plus(at, along), Math.min(8, 0.6 * Math.hypot(...along))];
  group.append(svgElement("path", { class: kind, d: path([at, tip], false) }));
  group.append(head(tip, along, size, kind));
  if (load.turns) group.append(head(plus(tip, times(along, (-0.8 * size) / Math.hypot(...along))), along, size, kind));
  return group;
}

/** The directions of the coordinates, below the scheme of a picture that begins at some place. */
function axesOf(scene, view, from) {
  const at = [from + 64, scene.room[3] + 60];
  return [0, 1, 2].flatMap((n) => {
    const tip = [30 * view[0][n], -30 * view[1][n]];
    const line = svgElement("path", { class: "line", d: path([at, plus(at, tip)], false) });
    const name = svgElement("text", { class: "axis", x: at[0] + 1.35 * tip[0], y: at[1] + 1.35 * tip[1] + 4, "text-anchor": "middle" }, "xyz"[n]);
    return [line, name];
  });
}

/** The image of a point or a direction of a link in a pose: by link a rotation vector and a shift, or nothing if it rests. */
const carried = (pose, link, p) => (pose && pose[link].length ? plus(spun(p, pose[link].slice(0, 3)), pose[link].slice(3)) : p);
const turned = (pose, link, v) => (pose && pose[link].length ? spun(v, pose[link].slice(0, 3)) : v);

/** A symbol of pieces whose axes stand in space, at a place on paper. */
function symbolAt(pieces, axes, view, at) {
  const out = [];
  const ahead = Math.abs(dot(axes[2], view[2]));
  const paper = axes.map((v) => [dot(view[0], v), -dot(view[1], v)]);
  for (const part of pieces) {
    if (ahead < part.seen[0] || ahead >= part.seen[1]) continue;
    const { along } = part;
    if (along !== null && Math.abs(dot(axes[along], view[2])) >= END_ON) continue;
    const corner = along !== null
      ? (p) => plus(times(paper[along], p[0]), times(upperSide(paper[along]), p[1]))
      : (p) => (p.length === 2 ? p : p.map((x, n) => times(paper[n], x)).reduce(plus));
    const drawn = shape(part, part.points.map(corner), at);
    if (drawn) out.push(drawn);
  }
  return out;
}

/** The elements of a scene in a pose, with the lines of one of its motions and some loads, and other symbols at some joints; the directions of the
 * coordinates where they have a place to begin at. */
function pictureOf(scene, { view, fit, away }, pose, motion, loads, swaps, from) {
  const flat = (v) => [dot(view[0], v), -dot(view[1], v)];
  const onPaper = (p) => plus(times(flat(p), fit.scale), fit.at);
  const out = [];
  for (const wire of scene.wires) {
    if ((wire.of !== null && wire.of !== motion) || (wire.turned && !away)) continue;
    const points = wire.points.map((p) => onPaper(carried(pose, wire.link, p)));
    out.push(svgElement("path", { class: wire.class, d: path(wire.form === "hull" ? hull(points) : points, wire.form !== "line") }));
  }
  const near = (j) => (away ? Math.round(dot(view[2], carried(pose, j.links[0], j.at))) : 0);
  const placed = scene.joints.map((j, n) => ({ ...j, ...swaps.get(n) })).filter((j) => away || !j.turned).map((j) => [near(j), j]);
  placed.sort((a, b) => a[0] - b[0]);
  for (const [, joint] of placed) {
    const at = onPaper(carried(pose, joint.links[0], joint.at));
    const axes = joint.axes.map((a) => turned(pose, joint.links[1], a));
    out.push(...symbolAt(scene.symbols[joint.symbol], axes, view, at));
  }
  out.push(...loads.map((l) => arrow(l, onPaper(l.at), flat(l.along), view[2])));
  if (away && from !== null) out.push(...axesOf(scene, view, from));
  return out;
}

/** The way of a point and where it is. */
function tracePicture({ way, now }, { view, fit }) {
  const onPaper = (p) => plus(times([dot(view[0], p), -dot(view[1], p)], fit.scale), fit.at);
  const [cx, cy] = onPaper(now);
  return [svgElement("path", { class: "trace", d: path(way.map(onPaper), false) }), svgElement("circle", { class: "trace point", cx, cy, r: 3.5 })];
}
