'use strict';
// A gripper as SVG elements, from pins and links.
const SVG = 'http://www.w3.org/2000/svg';

function element(name, attributes, inside) {
  const e = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  for (const child of inside || []) e.append(child);
  return e;
}

// The corners of the convex hull of points, in order (Andrew's monotone chain).
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const side = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && side(out[out.length - 2], out[out.length - 1], p) <= 0) out.pop();
      out.push(p);
    }
    out.pop();
    return out;
  };
  return half(sorted).concat(half(sorted.reverse()));
}

// Screen coordinates: y goes down.
const flip = ([x, y]) => [x, -y];
const path = (points, closed) => 'M' + points.map((p) => p.map((v) => v.toFixed(1)).join(' ')).join('L') + (closed ? 'Z' : '');

function gripper(card, title, changed) {
  const d = card.drawing;
  if (!d) {
    const note = document.createElement('p');
    note.className = 'help';
    note.textContent = 'Not in one plane: ozols draw shows it.';
    return note;
  }
  const pins = d.pins.map(flip), tips = (d.tips || []).map(flip);
  const all = pins.concat(tips);
  const low = [0, 1].map((k) => Math.min(...all.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...all.map((p) => p[k])));
  // Labels stand beside their pins, those on the right to the left of them.
  const margin = [changed ? 40 : 20, 20], size = [0, 1].map((k) => high[k] - low[k] + 2 * margin[k]);
  const box = [low[0] - margin[0], low[1] - margin[1], size[0], size[1]], centre = box[0] + size[0] / 2;
  const out = [element('title', {}, [title])];
  const slidePin = d.slides ? d.drive : -1;
  d.links.forEach((of, l) => {
    if (l === d.frame) return;
    const jaw = d.jaws.indexOf(l);
    const points = of.map((i) => pins[i]).concat(tips[jaw] ? [tips[jaw]] : []);
    if (points.length < 2) return;
    const kind = jaw >= 0 ? 'jaw' : l === d.driver ? 'driver' : '';
    out.push(element('path', { class: 'link ' + kind, d: path(hull(points), points.length > 2) }));
  });
  // The part that is held.
  if (tips.length) {
    const middle = [0, 1].map((k) => tips.reduce((sum, t) => sum + t[k], 0) / tips.length);
    const radius = Math.hypot(tips[0][0] - middle[0], tips[0][1] - middle[1]);
    out.push(element('circle', { class: 'part', cx: middle[0], cy: middle[1], r: radius }));
  }
  d.links[d.frame].forEach((i) => {
    const [x, y] = pins[i];
    if (i === slidePin) {
      out.push(element('path', { class: 'guide', d: `M${x - 16} ${y - 6}h32M${x - 16} ${y + 6}h32` }));
      out.push(element('rect', { class: 'block', x: x - 8, y: y - 5, width: 16, height: 10, rx: 1 }));
    } else {
      out.push(element('path', { class: 'ground', d: `M${x} ${y}l-5 8h10zM${x - 7} ${y + 8}h14` }));
    }
  });
  pins.forEach(([x, y], i) => {
    if (i !== slidePin) out.push(element('circle', { class: 'pin', cx: x, cy: y, r: 2.6 }));
  });
  const moves = card.drawn ? [] : ['a', 'b', 'c'].map((jaw) => [card[`tip_${jaw}_dx`], card[`tip_${jaw}_dy`]]).filter((v) => v[0] !== null).map(flip);
  const fastest = Math.max(...moves.map((v) => Math.hypot(...v)), 1e-9);
  moves.forEach((move, n) => {
    const [x, y] = tips[n], v = move.map((c) => (c / fastest) * 13), length = Math.hypot(...v);
    if (length < 1) return;
    const u = v.map((c) => c / length), across = [-u[1], u[0]];
    const at = [x + v[0], y + v[1]];
    const wing = (s) => [0, 1].map((k) => at[k] - 4 * u[k] + s * 2.5 * across[k]);
    out.push(element('path', { class: 'arrow', d: path([[x, y], at]) + path([wing(1), at, wing(-1)]) }));
  });
  for (const [name, word] of changed || []) {
    const i = d.names.indexOf(name);
    if (i < 0) continue;
    const [x, y] = pins[i];
    out.push(element('circle', { class: 'changed', cx: x, cy: y, r: 5.5 }));
    const right = x > centre;
    out.push(element('text', { x: right ? x - 7 : x + 7, y: y - 6, 'text-anchor': right ? 'end' : 'start' }, [word]));
  }
  return element('svg', { class: 'gripper', viewBox: box.map((v) => v.toFixed(1)).join(' '), role: 'img' }, out);
}
