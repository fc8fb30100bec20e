// How a gripper moves: its pins from open to closed, by Newton's method from pose to pose.
const STEPS = 24;

/** The solution of a square system, the right side in the last column; null where it is singular. */
function solved(rows) {
  const n = rows.length;
  for (let k = 0; k < n; k += 1) {
    let best = k;
    for (let i = k + 1; i < n; i += 1) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    if (Math.abs(rows[best][k]) < 1e-9) return null;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = 0; i < n; i += 1) {
      const f = i === k ? 0 : rows[i][k] / rows[k][k];
      if (f) for (let j = k; j <= n; j += 1) rows[i][j] -= f * rows[k][j];
    }
  }
  return rows.map((row, k) => row[n] / row[k]);
}

/** Where a drawn point of a link is in a pose: three numbers for each link, its shift and its turn about the origin. */
function placed(pose, link, [x, y]) {
  const [dx, dy, t] = pose.slice(3 * link, 3 * link + 3);
  return [dx + x * Math.cos(t) - y * Math.sin(t), dy + x * Math.sin(t) + y * Math.cos(t)];
}

/** What holds a pose together, each with its slopes, the last number what it misses: pins meet, and the drive is where it is asked. */
function conditions(d, pose, drive) {
  const size = 3 * d.links.length, out = [];
  const row = (missed, slopes) => {
    const made = new Array(size + 1).fill(0);
    for (const [at, slope] of slopes) made[at] += slope;
    made[size] = -missed;
    out.push(made);
  };
  for (let k = 0; k < 3; k += 1) row(pose[3 * d.frame + k], [[3 * d.frame + k, 1]]);
  const driver = 3 * d.driver;
  if (d.slides) {
    row(pose[driver] - drive, [[driver, 1]]);
    row(pose[driver + 1], [[driver + 1, 1]]);
    row(pose[driver + 2], [[driver + 2, 1]]);
  } else row(pose[driver + 2] - drive, [[driver + 2, 1]]);
  d.pins.forEach((pin, i) => {
    if (d.slides && i === d.drive) return;
    const [a, b] = d.links.flatMap((of, l) => (of.includes(i) ? [l] : []));
    const [p, q] = [placed(pose, a, pin), placed(pose, b, pin)];
    // A point turns square to its arm.
    const arm = (l, at) => [at[0] - pose[3 * l], at[1] - pose[3 * l + 1]];
    const [u, v] = [arm(a, p), arm(b, q)];
    row(p[0] - q[0], [[3 * a, 1], [3 * b, -1], [3 * a + 2, -u[1]], [3 * b + 2, v[1]]]);
    row(p[1] - q[1], [[3 * a + 1, 1], [3 * b + 1, -1], [3 * a + 2, u[0]], [3 * b + 2, -v[0]]]);
  });
  return out;
}

/** The pose near another with the drive elsewhere; null where there is none. */
function poseAt(d, near, drive) {
  let pose = near.slice();
  for (let round = 0; round < 20; round += 1) {
    const rows = conditions(d, pose, drive);
    if (rows.length !== pose.length) return null;
    if (Math.max(...rows.map((r) => Math.abs(r[pose.length]))) < 1e-8) return pose;
    const step = solved(rows);
    if (!step) return null;
    pose = pose.map((x, i) => x + step[i]);
  }
  return null;
}

/** Pins and tips in a pose. */
function frameAt(d, pose) {
  const owner = (i) => d.links.findIndex((of) => of.includes(i));
  const slid = (pin, i) => (d.slides && i === d.drive ? placed(pose, d.driver, pin) : placed(pose, owner(i), pin));
  return { pins: d.pins.map(slid), tips: d.tips.map((tip, n) => placed(pose, d.jaws[n], tip)) };
}

/** How far the tips are apart, along the lines on which they are drawn from their middle; less than nothing where they have passed. */
function opening(d, tips) {
  const middle = (all) => [0, 1].map((k) => all.reduce((sum, t) => sum + t[k], 0) / all.length);
  const [from, to] = [middle(d.tips), middle(tips)];
  const along = (t, n) => {
    const u = [0, 1].map((k) => d.tips[n][k] - from[k]);
    return ((t[0] - to[0]) * u[0] + (t[1] - to[1]) * u[1]) / Math.hypot(...u);
  };
  return (2 / tips.length) * tips.reduce((sum, t, n) => sum + along(t, n), 0);
}

/** Pins and tips from the widest opening to the narrowest; none of what is not laid out by a catalogue, or does not move. */
function framesOf(card) {
  const d = card.drawing;
  if (!d || card.drawn || !d.tips || d.driver === null || !(card.travel > 0)) return [];
  const scale = d.scale, still = new Array(3 * d.links.length).fill(0);
  const step = ((d.slides ? scale : 1) * card.travel) / STEPS;
  const way = (sign, goesOn) => {
    const out = [];
    let pose = still;
    for (let k = 1; k <= 2 * STEPS; k += 1) {
      pose = poseAt(d, pose, sign * k * step);
      if (!pose) break;
      const frame = frameAt(d, pose);
      if (!goesOn(opening(d, frame.tips) / scale)) break;
      out.push(frame);
    }
    return out;
  };
  const slack = (card.opening_max - card.opening_min) / STEPS;
  const closing = way(card.closes, (w) => w > card.opening_min - slack / 2);
  const wider = way(-card.closes, (w) => w < card.opening_max + slack / 2);
  return [...wider.reverse(), { pins: d.pins, tips: d.tips }, ...closing];
}
