// What joins the links of a gripper, as SVG elements: hinges and guides in the frame, sleeves, slots, pitch circles.

/** A symbol of a link at a point: it shifts and turns with the link. */
function symbol(kind, d, pose, link, at, along, points) {
  const [x, y] = placed(pose, link, at), t = Math.atan2(along[1], along[0]) + pose[3 * link + 2], [c, s] = [Math.cos(t), Math.sin(t)];
  const put = ([u, v]) => flip([x + u * c - v * s, y + u * s + v * c]);
  return svgElement('path', { class: kind, d: points.map((line) => path(line.map(put), kind.startsWith('block'))).join('') });
}

/** A slide: its guide on the frame, or on the first of its links, and the block that runs there. */
function slideOf(d, pose, i, class_) {
  const [a, b] = d.ends[i], guide = b === d.frame ? b : a, rides = guide === a ? b : a;
  const rails = [[[-16, 6], [16, 6]], [[-16, -6], [16, -6]]], block = [[[-8, -5], [8, -5], [8, 5], [-8, 5]]];
  return [symbol('guide', d, pose, guide, d.pins[i], d.along[i], rails), symbol('block' + class_, d, pose, rides, d.pins[i], d.along[i], block)];
}

/** A slot: round at its ends. */
function slotOf(d, pose, i) {
  const arc = (x, from) => Array.from({ length: 7 }, (_, k) => [x + 4 * Math.cos(from + (k * Math.PI) / 6), 4 * Math.sin(from + (k * Math.PI) / 6)]);
  const outline = [...arc(12, -Math.PI / 2), ...arc(-12, Math.PI / 2), [12, -4]];
  return symbol('slot', d, pose, d.ends[i][1], d.pins[i], d.along[i], [outline]);
}

/** The radius of a gear that turns about a pin. */
const pitchRadius = (d, g, i) => Math.hypot(g.pitch[0] - d.pins[i][0], g.pitch[1] - d.pins[i][1]);

/** Corners of what pitch circles and racks take up as drawn. */
function pitchBounds(d) {
  return d.gears.flatMap((g) => g.joints.flatMap((i) => {
    const [at, r] = d.kinds[i] === 'slide' ? [g.pitch, 14] : [d.pins[i], g.thread ? 3 : pitchRadius(d, g, i)];
    return [[at[0] - r, at[1] - r], [at[0] + r, at[1] + r]];
  }));
}

/** The positions of the racks on a link. */
function rackPoints(d, pose, link) {
  const own = d.gears.filter((g) => g.links.some((l, k) => l === link && d.kinds[g.joints[k]] === 'slide'));
  return own.map((g) => flip(placed(pose, link, g.pitch)));
}

/** Pitch circles, and of a rack the line on which it rolls; of a screw its axis to the nut, and the nut's thread. */
function gearsOf(d, pose) {
  return d.gears.flatMap((g) => g.joints.map((i, k) => {
    if (d.kinds[i] === 'slide') return symbol('gear', d, pose, g.links[k], g.pitch, d.along[i], [[[-20, 0], [20, 0]]]);
    const [x, y] = flip(placed(pose, g.carrier, d.pins[i])), r = pitchRadius(d, g, i);
    if (g.thread) return svgElement('path', { class: 'gear', d: path([[x, y], flip(placed(pose, g.links[1], g.pitch))]) });
    return svgElement('circle', { class: 'gear', cx: x, cy: y, r });
  }));
}
