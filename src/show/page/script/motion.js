// How a gripper moves: its pins from open to closed, by Newton's method from pose to pose.
const STEPS = 24;

/** The position of a drawn point of a link in a pose: three numbers for each link, its shift and its turn about the origin. */
function placed(pose, link, [x, y]) {
  const [dx, dy, t] = pose.slice(3 * link, 3 * link + 3);
  return [dx + x * Math.cos(t) - y * Math.sin(t), dy + x * Math.sin(t) + y * Math.cos(t)];
}

/** The slopes of where a drawn point of a link is along a direction, the point's place and direction being those of a pose. */
function slopes(pose, link, at, [u, v], sign) {
  const arm = [at[0] - pose[3 * link], at[1] - pose[3 * link + 1]];
  return [[3 * link, sign * u], [3 * link + 1, sign * v], [3 * link + 2, sign * (v * arm[0] - u * arm[1])]];
}

/** How far a joint has gone: its turn, or how far its second link is ahead of its first; with the slopes of that. */
function gone(d, pose, i) {
  const [a, b] = d.ends[i];
  if (d.kinds[i] !== 'slide') return [pose[3 * b + 2] - pose[3 * a + 2], [[3 * b + 2, 1], [3 * a + 2, -1]]];
  const u = turnedBy(pose, a, d.along[i]), [p, q] = [placed(pose, a, d.pins[i]), placed(pose, b, d.pins[i])];
  return [(q[0] - p[0]) * u[0] + (q[1] - p[1]) * u[1], [...slopes(pose, b, q, u, 1), ...slopes(pose, a, q, u, -1)]];
}

/** A direction of a link as it has turned. */
function turnedBy(pose, link, [x, y]) {
  const t = pose[3 * link + 2];
  return [x * Math.cos(t) - y * Math.sin(t), x * Math.sin(t) + y * Math.cos(t)];
}

/** The equations of a pose, each with its slopes and, as the last number, its error: joints fit, and the drive is at its position. */
function conditions(d, pose, drive) {
  const size = 3 * d.links.length, out = [];
  const row = (missed, of) => {
    const made = new Array(size + 1).fill(0);
    for (const [at, slope] of of) made[at] += slope;
    made[size] = -missed;
    out.push(made);
  };
  // A point of one link is on a line of another.
  const line = (i, pinned, slotted, u) => {
    const [p, q] = [placed(pose, pinned, d.pins[i]), placed(pose, slotted, d.pins[i])];
    row((p[0] - q[0]) * u[0] + (p[1] - q[1]) * u[1], [...slopes(pose, pinned, p, u, 1), ...slopes(pose, slotted, p, u, -1)]);
  };
  let together = d.links.map((_, l) => l);
  for (let k = 0; k < 3; k += 1) row(pose[3 * d.frame + k], [[3 * d.frame + k, 1]]);
  const [at, of] = gone(d, pose, d.drive);
  row(at - drive, of);
  d.kinds.forEach((kind, i) => {
    const [a, b] = d.ends[i];
    if (kind === 'hinge') {
      const [p, q] = [placed(pose, a, d.pins[i]), placed(pose, b, d.pins[i])];
      for (const u of [[1, 0], [0, 1]]) row((p[0] - q[0]) * u[0] + (p[1] - q[1]) * u[1], [...slopes(pose, a, p, u, 1), ...slopes(pose, b, q, u, -1)]);
      return;
    }
    // Links joined by other slides do not turn relative to each other.
    if (kind === 'slide' && together[a] !== together[b]) {
      row(pose[3 * b + 2] - pose[3 * a + 2], [[3 * b + 2, 1], [3 * a + 2, -1]]);
      together = together.map((of) => (of === together[b] ? together[a] : of));
    }
    const [pinned, slotted] = kind === 'slot' ? [a, b] : [b, a], [x, y] = turnedBy(pose, slotted, d.along[i]);
    line(i, pinned, slotted, [-y, x]);
  });
  for (const g of d.gears) {
    const [[first, firsts], [second, seconds]] = g.joints.map((i) => gone(d, pose, i));
    row(second - g.ratio * first, [...seconds, ...firsts.map(([k, slope]) => [k, -g.ratio * slope])]);
  }
  return out;
}

/** The pose near another with the drive elsewhere; null if there is none. */
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

/** Pins and tips in a pose; a slide is where its block is. */
function frameAt(d, pose) {
  const block = ([a, b], i) => (b === d.frame && d.kinds[i] === 'slide' ? a : b);
  return { pose, pins: d.pins.map((pin, i) => placed(pose, block(d.ends[i], i), pin)), tips: d.tips.map((tip, n) => placed(pose, d.jaws[n], tip)) };
}

/** The distance of the tips along the lines from their middle; negative if they have passed. */
function opening(d, tips) {
  const middle = (all) => [0, 1].map((k) => all.reduce((sum, t) => sum + t[k], 0) / all.length);
  const [from, to] = [middle(d.tips), middle(tips)];
  const along = (t, n) => {
    const u = [0, 1].map((k) => d.tips[n][k] - from[k]);
    return ((t[0] - to[0]) * u[0] + (t[1] - to[1]) * u[1]) / Math.hypot(...u);
  };
  return (2 / tips.length) * tips.reduce((sum, t, n) => sum + along(t, n), 0);
}

/** Pins and tips until the jaws grip: from the widest opening to the narrowest, or in a hole the other way; none of what is not laid out by a catalogue, or does not move. */
function framesOf(card) {
  const d = card.drawing;
  if (!d || !d.tips || d.driver === null || !(card.travel > 0)) return [];
  const scale = d.scale, still = new Array(3 * d.links.length).fill(0);
  const step = ((d.slides ? scale : 1) * card.travel) / STEPS;
  const slack = (card.opening_max - card.opening_min) / STEPS;
  const way = (sign) => {
    const out = [];
    let pose = still, last = opening(d, d.tips) / scale, opens = 0;
    for (let k = 1; k <= 2 * STEPS; k += 1) {
      pose = poseAt(d, pose, sign * k * step);
      if (!pose) break;
      const frame = frameAt(d, pose);
      const now = opening(d, frame.tips) / scale;
      opens ||= Math.sign(now - last);
      const beyond = opens > 0 ? now - card.opening_max : card.opening_min - now;
      // Jaws may turn back while the drive goes on.
      if ((now - last) * opens <= 0 || beyond >= slack / 2) break;
      last = now;
      out.push(frame);
    }
    return out;
  };
  return [...way(-card.closes).reverse(), { pose: still, pins: d.pins, tips: d.tips }, ...way(card.closes)];
}
