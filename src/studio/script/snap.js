// Snapping of a pin that is set or dragged: to another pin, to its mirror image, in line with one, or to the grid. The
// coordinates are exact; the first three copy those of the other pin.

/** The distance, in pixels, within which a position snaps to another. */
const PULL = 9;

const coordinatesOf = (pin) => thing(pin.what, pin.id).point;

/** The axes of the coordinates that the paper lies along. */
const paperAxes = () => [0, 1, 2].filter((k) => k !== depthAxis());

/** Places that draw a pin to them: others, and mirror images of what is not moved. */
function magnets(without) {
  const all = pins().filter((p) => !without.some((w) => w.what === p.what && w.id === p.id));
  const own = all.map((p) => ({ at: p.at, point: coordinatesOf(p), words: `at ${p.id}`, pin: p }));
  const images = all.flatMap((p) => paperAxes().filter((k) => Math.abs(p.at[k]) > touching())
    .map((k) => ({ at: flipped(p.at, k), point: flipped(coordinatesOf(p), k), words: `mirror image of ${p.id} in ${"xyz"[k]}`, pin: null })));
  return [...own, ...images];
}

/**
 * The place that is meant by one on paper: `deep` says how deep where nothing else does, `base` what is written there. Gives the
 * numbers, the coordinates as they are written, and a line for each other place that it is in line with.
 */
function snapped(paper, { deep, base, without = [], free = false }) {
  const raw = fromPaper(paper, deep);
  const step = gridStep();
  const k = depthAxis();
  if (free) {
    const at = raw.map((x, i) => (i === k ? deep[i] : rounded(x, step / 100)));
    return { at, point: at.map((x, i) => (i === k ? base[i] : x)), guides: [], words: "", pin: null };
  }
  const all = magnets(without);
  const near = all.map((m) => ({ ...m, off: Math.hypot(...minus(toPaper(m.at), paper)) })).sort((a, b) => a.off - b.off)[0];
  if (near && near.off < PULL) return { at: near.at, point: near.point, guides: near.pin ? [] : [[near.at, near.at]], words: near.words, pin: near.pin };
  const guides = [];
  const words = [];
  const at = [...deep];
  const point = [...base];
  for (const i of paperAxes()) {
    const line = all.filter((m) => m.pin).map((m) => ({ m, off: Math.abs(m.at[i] - raw[i]) * camera.zoom })).sort((a, b) => a.off - b.off)[0];
    const grid = rounded(raw[i], step);
    if (line && line.off < PULL * 0.6) {
      [at[i], point[i]] = [line.m.at[i], line.m.point[i]];
      guides.push(line.m.at);
      words.push(`${"xyz"[i]} as ${line.m.pin.id}`);
    } else [at[i], point[i]] = [grid, grid];
  }
  const there = all.find((m) => m.pin && apart(m.at, at) < touching());
  return { at, point, guides: guides.map((g) => [g, at]), words: words.join(", "), pin: null, ...there };
}
