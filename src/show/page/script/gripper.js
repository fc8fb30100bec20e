// A gripper as SVG elements, from pins and links.

// Screen coordinates: y goes down.
const flip = ([x, y]) => [x, -y];
const path = (points, closed) => 'M' + points.map((p) => p.map((v) => v.toFixed(1)).join(' ')).join('L') + (closed ? 'Z' : '');

// The head of an arrow at a point, u being where it goes.
function head(at, u) {
  const wing = (s) => [at[0] - 4 * u[0] - s * 2.5 * u[1], at[1] - 4 * u[1] + s * 2.5 * u[0]];
  return path([wing(1), at, wing(-1)]);
}

function straight(from, to) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  return path([from, to]) + head(to, [(to[0] - from[0]) / length, (to[1] - from[1]) / length]);
}

// Over a pin, counter-clockwise where s is 1.
function round([x, y], r, s) {
  const at = (degrees) => { const t = (degrees * Math.PI) / 180; return [x + r * Math.cos(t), y - r * Math.sin(t)]; };
  const from = at(90 - 75 * s), to = at(90 + 75 * s), t = ((90 + 75 * s) * Math.PI) / 180;
  const [a, b] = [from, to].map((p) => p.map((v) => v.toFixed(1)).join(' '));
  return `M${a}A${r} ${r} 0 0 ${s > 0 ? 0 : 1} ${b}` + head(to, [-s * Math.sin(t), -s * Math.cos(t)]);
}

/** How the tips move as the drive closes, the fastest by the longest arrow. */
function arrows(card, tips) {
  const told = ['a', 'b', 'c'].map((jaw) => [card[`tip_${jaw}_dx`], card[`tip_${jaw}_dy`]]).filter((v) => v[0] !== null).map(flip);
  // Of sides in different planes, the second is drawn opposite the first.
  const moves = card.drawing.folded ? [told[0], [told[0][0], -told[0][1]]] : told;
  const fastest = Math.max(...moves.map((v) => Math.hypot(...v)), 1e-9);
  return moves.flatMap((move, n) => {
    const [x, y] = tips[n], v = move.map((c) => (c / fastest) * 13);
    return Math.hypot(...v) < 1 ? [] : [svgElement('path', { class: 'arrow', d: straight([x, y], [x + v[0], y + v[1]]) })];
  });
}

/** A gripper as it is drawn, or with its pins and tips elsewhere. */
function gripper(card, title, changed, elsewhere) {
  const d = card.drawing;
  if (!d) return element('p', { class: 'help' }, 'Not in one plane: ozols draw shows it.');
  const pose = elsewhere ? elsewhere.pose : new Array(3 * d.links.length).fill(0);
  const at = (link, i) => flip(placed(pose, link, d.pins[i]));
  const tips = (d.tips || []).map((t, n) => flip(placed(pose, d.jaws[n], t)));
  // A slide is where its block is.
  const pins = d.ends.map(([a, b], i) => at(b === d.frame && d.kinds[i] === 'slide' ? a : b, i));
  // The same sight however it moves.
  const all = [...d.pins, ...(d.tips || []), ...pitchBounds(d)].map(flip);
  const low = [0, 1].map((k) => Math.min(...all.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...all.map((p) => p[k])));
  // Labels are next to their pins; those on the right are to the left of them.
  const margin = [changed ? 40 : 20, 20], size = [0, 1].map((k) => high[k] - low[k] + 2 * margin[k]);
  const box = [low[0] - margin[0], low[1] - margin[1], size[0], size[1]], centre = box[0] + size[0] / 2;
  const out = [svgElement('title', {}, title)];
  d.links.forEach((of, l) => {
    if (l === d.frame) return;
    const jaw = d.jaws.indexOf(l);
    const points = [...of.map((i) => at(l, i)), ...rackPoints(d, pose, l), ...(tips[jaw] ? [tips[jaw]] : [])];
    if (points.length < 2) return;
    const kind = jaw >= 0 ? 'jaw' : l === d.driver ? 'driver' : '';
    out.push(svgElement('path', { class: 'link ' + kind, d: path(hull(points), points.length > 2) }));
  });
  // The part that is held.
  if (tips.length) {
    const middle = [0, 1].map((k) => tips.reduce((sum, t) => sum + t[k], 0) / tips.length);
    const radius = Math.hypot(tips[0][0] - middle[0], tips[0][1] - middle[1]);
    out.push(svgElement('circle', { class: 'part', cx: middle[0], cy: middle[1], r: radius }));
  }
  out.push(...gearsOf(d, pose));
  d.kinds.forEach((kind, i) => {
    const [x, y] = pins[i];
    if (kind === 'slide') out.push(...slideOf(d, pose, i, i === d.drive ? '' : ' idle'));
    else if (kind === 'slot') out.push(slotOf(d, pose, i));
    else if (d.ends[i].includes(d.frame)) out.push(svgElement('path', { class: 'ground', d: `M${x} ${y}l-5 8h10zM${x - 7} ${y + 8}h14` }));
  });
  pins.forEach(([x, y], i) => {
    if (d.kinds[i] === 'slide') return;
    const pin = svgElement('circle', { class: 'pin', cx: x, cy: y, r: 2.6 });
    pin.append(svgElement('title', {}, d.names[i]));
    out.push(pin);
  });
  if (card.closes && !elsewhere) {
    const [x, y] = pins[d.drive], s = card.closes;
    const [u, v] = flip(d.along[d.drive]), [left, up] = u < 0 ? [-v, u] : [v, -u];
    const beside = (k) => [x + 11 * (left + k * u), y + 11 * (up + k * v)];
    out.push(svgElement('path', { class: 'drive', d: d.slides ? straight(beside(-s), beside(s)) : round([x, y], 10, s) }));
  }
  if (!elsewhere) out.push(...arrows(card, tips));
  for (const [name, word] of changed || []) {
    const i = d.names.indexOf(name);
    if (i < 0) continue;
    const [x, y] = pins[i];
    out.push(svgElement('circle', { class: 'changed', cx: x, cy: y, r: 5.5 }));
    const right = x > centre;
    const label = (below, words, kind) => svgElement('text', { class: kind, x: right ? x - 7 : x + 7, y: y - 6 + below, 'text-anchor': right ? 'end' : 'start' }, words);
    out.push(label(0, word, ''), label(5.5, name, 'joint'));
  }
  const svg = svgElement('svg', { class: 'gripper', viewBox: box.map((v) => v.toFixed(1)).join(' '), role: 'img' });
  svg.append(...out);
  return svg;
}
