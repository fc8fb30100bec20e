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

/** The equations of a pose, joints fit and the drive is at its position: each with its slopes `of`, its error, and the force that it is between
 * two links, of a joint, at a place along u. `acts` are the slopes of that force. */
function fits(d, pose, drive) {
  const out = [], row = (missed, of, force) => out.push({ missed, of, acts: of, ...force });
  // A point of one link is on a line of another.
  const line = (i, pinned, slotted, u) => {
    const [p, q] = [placed(pose, pinned, d.pins[i]), placed(pose, slotted, d.pins[i])];
    const of = [...slopes(pose, pinned, p, u, 1), ...slopes(pose, slotted, p, u, -1)];
    row((p[0] - q[0]) * u[0] + (p[1] - q[1]) * u[1], of, { joint: i, ends: d.ends[i], at: p, u });
  };
  let together = d.links.map((_, l) => l);
  const [at, of] = gone(d, pose, d.drive);
  row(at - drive, of);
  for (let k = 0; k < 3; k += 1) row(pose[3 * d.frame + k], [[3 * d.frame + k, 1]]);
  d.kinds.forEach((kind, i) => {
    const [a, b] = d.ends[i];
    if (kind === 'hinge') {
      const [p, q] = [placed(pose, a, d.pins[i]), placed(pose, b, d.pins[i])];
      for (const u of [[1, 0], [0, 1]]) {
        const of = [...slopes(pose, a, p, u, 1), ...slopes(pose, b, q, u, -1)];
        row((p[0] - q[0]) * u[0] + (p[1] - q[1]) * u[1], of, { joint: i, ends: d.ends[i], at: p, u });
      }
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
    // Teeth press where the pitch circles touch, across the line of centres or along the rack.
    const at = placed(pose, g.carrier, g.pitch), [p, q] = g.joints.map((i) => d.pins[i]), rack = g.joints.find((i) => d.kinds[i] === 'slide');
    const u = turnedBy(pose, g.carrier, rack === undefined ? unitOf([p[1] - q[1], q[0] - p[0]]) : d.along[rack]);
    const acts = [...slopes(pose, g.links[0], at, u, 1), ...slopes(pose, g.links[1], at, u, -1)];
    // A nut turns its screw, too.
    if (g.thread) acts.push([3 * g.links[0] + 2, g.ratio], [3 * g.carrier + 2, -g.ratio]);
    row(second - g.ratio * first, [...seconds, ...firsts.map(([k, slope]) => [k, -g.ratio * slope])], { acts, joint: g, ends: g.links, at, u });
  }
  return out;
}

/** The equations as a system for a step; `right` gives the right side of each. */
function systemOf(equations, size, right) {
  return equations.map((e, n) => {
    const row = new Array(size + 1).fill(0);
    for (const [at, slope] of e.of) row[at] += slope;
    row[size] = right(e, n);
    return row;
  });
}

/** The pose near another with the drive elsewhere; null if there is none. */
function poseAt(d, near, drive) {
  let pose = near.slice();
  for (let round = 0; round < 20; round += 1) {
    const equations = fits(d, pose, drive);
    if (equations.length !== pose.length) return null;
    if (Math.max(...equations.map((e) => Math.abs(e.missed))) < 1e-8) return pose;
    const step = solved(systemOf(equations, pose.length, (e) => -e.missed));
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

const unitOf = ([x, y]) => { const far = Math.hypot(x, y); return [x / far, y / far]; };

/** The direction of each tip from the middle of all, as drawn. */
function outwards(d) {
  const middle = [0, 1].map((k) => d.tips.reduce((sum, t) => sum + t[k], 0) / d.tips.length);
  return d.tips.map((t) => unitOf([t[0] - middle[0], t[1] - middle[1]]));
}

/** The distance of the tips along these directions, or how fast it changes by the velocities of the tips; negative if they have passed. */
const opening = (d, tips) => (2 / tips.length) * outwards(d).reduce((sum, u, n) => sum + tips[n][0] * u[0] + tips[n][1] * u[1], 0);

/** The opening at a frame, the force of a jaw for a unit of the drive, in N, and the transmission angle in degrees; null in a singular pose. */
function figuresAt(d, jaws, { pose, tips }) {
  const equations = fits(d, pose, 0), size = pose.length;
  // For a unit of the drive, whose equation is the first.
  const rates = solved(systemOf(equations, size, (_, n) => (n ? 0 : 1)));
  const loads = outwards(d).flatMap((u, n) => slopes(pose, d.jaws[n], tips[n], u, 1));
  const balance = pose.map((_, k) => [...equations.map(() => 0), loads.reduce((sum, [at, x]) => (at === k ? sum - x : sum), 0)]);
  equations.forEach((e, n) => { for (const [at, x] of e.acts) balance[at][n] += x; });
  const sizes = solved(balance);
  if (!rates || !sizes) return null;
  const speed = (link, [x, y]) => {
    const [u, v, w] = rates.slice(3 * link, 3 * link + 3);
    return [u - w * (y - pose[3 * link + 1]), v + w * (x - pose[3 * link])];
  };
  const forces = new Map();
  equations.forEach((e, n) => {
    if (!e.u) return;
    const { force: [x, y] } = forces.get(e.joint) || { force: [0, 0] };
    forces.set(e.joint, { ...e, force: [x + sizes[n] * e.u[0], y + sizes[n] * e.u[1]] });
  });
  const moves = tips.map((t, n) => speed(d.jaws[n], t));
  const works = outwards(d).map((u, n) => Math.abs(moves[n][0] * u[0] + moves[n][1] * u[1]));
  // The work of a link over the largest work of the forces at its moving joints; a thread pushes along its axis.
  const passed = (link, work) => {
    const own = [...forces].filter(([joint, e]) => joint !== d.drive && !joint.thread && e.ends.includes(link) && !e.ends.includes(d.frame));
    return work / own.reduce((sum, [, e]) => sum + Math.hypot(...e.force) * Math.hypot(...speed(link, e.at)), 1e-12);
  };
  const pushes = (l) => l !== d.frame && l !== d.driver && !d.jaws.includes(l) && d.links[l].length === 2
    && d.links[l].every((i) => d.kinds[i] === 'hinge') && !d.gears.some((g) => g.links.includes(l));
  const rods = d.links.flatMap((pins, l) => {
    if (!pushes(l)) return [];
    const [a, b] = pins.map((i) => placed(pose, l, d.pins[i])), [va, vb] = [a, b].map((p) => speed(l, p)), [x, y] = unitOf([b[0] - a[0], b[1] - a[1]]);
    const [slow, fast] = [Math.hypot(...va), Math.hypot(...vb)].sort((m, n) => m - n);
    // A rod from the frame does not pull.
    return slow < 1e-6 * fast ? [] : [Math.abs(va[0] * x + va[1] * y) / fast];
  });
  const sine = Math.min(1, ...rods, passed(d.driver, works.reduce((sum, x) => sum + x, 0)), ...d.jaws.map((l, n) => passed(l, works[n])));
  // A turn has its force per newton metre.
  const unit = d.slides ? 1 : 1000 * d.scale;
  return { width: opening(d, tips), force: (2 * unit) / jaws / Math.abs(opening(d, moves)), angle: (Math.asin(sine) * 180) / Math.PI };
}

/** Pins and tips until the jaws grip: from the widest opening to the narrowest, or in a hole the other way; none of what is not laid out by a catalogue, or does not move. */
function framesOf(card) {
  const d = card.drawing;
  if (!d || !d.tips || d.driver === null || !(card.travel > 0)) return [];
  const scale = d.scale, still = new Array(3 * d.links.length).fill(0);
  const step = ((d.slides ? scale : 1) * card.travel) / STEPS;
  const way = (sign) => {
    const out = [];
    let last = { pose: still, tips: d.tips }, at = 0, opens = 0;
    // Steps are halved at the end of the stroke; only the last of these shorter steps stays.
    for (let by = step; by > step / 200 && out.length <= 2 * STEPS;) {
      const pose = poseAt(d, last.pose, sign * (at + by)), frame = pose && frameAt(d, pose);
      const [before, now] = [last, frame || last].map((f) => opening(d, f.tips) / scale);
      opens ||= Math.sign(now - before);
      // Jaws may turn back while the drive goes on.
      if (!frame || (now - before) * opens <= 0 || now > card.opening_max + 1e-6 || now < card.opening_min - 1e-6) {
        by /= 2;
        continue;
      }
      if (last.short) out.pop();
      last = { ...frame, short: by < step };
      at += by;
      out.push(last);
    }
    return out;
  };
  return [...way(-card.closes).reverse(), { pose: still, pins: d.pins, tips: d.tips }, ...way(card.closes)];
}
