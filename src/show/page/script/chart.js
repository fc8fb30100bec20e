// Two figures of the variants against each other, with those that nothing beats in both.

const CHART = { width: 640, height: 340, left: 64, right: 16, top: 14, bottom: 46 };

/** Round numbers over a range: some so many even steps. */
function steps(low, high, count) {
  const out = [];
  const raw = (high - low) / count || 1;
  const size = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((s) => s * size).find((s) => s >= raw * 0.999);
  for (let x = Math.ceil(low / step - 1e-9) * step; x <= high + step * 1e-9; x += step) out.push(Number(x.toPrecision(12)));
  return out;
}

/** The fewest marks of decades, or of parts of them, that are at least three; even steps where decades have too few. */
function decades(low, high) {
  for (const parts of [[1], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const out = [];
    for (let e = Math.floor(low); e <= Math.ceil(high); e += 1) for (const p of parts) out.push(e + Math.log10(p));
    const inside = out.filter((e) => e >= low - 1e-9 && e <= high + 1e-9);
    if (inside.length > 2) return inside;
  }
  return steps(10 ** low, 10 ** high, 4).map(Math.log10);
}

const ticks = (low, high, log) => (log ? decades(low, high) : steps(low, high, 5));

/** From values to pixels, with some room at the ends. */
function scale(column, shown, from, to) {
  const of = (v) => (column.log ? Math.log10(Math.max(v, 1e-300)) : v);
  let [low, high] = [Infinity, -Infinity];
  for (const i of shown) {
    const x = of(column.values[i]);
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  const room = high > low ? 0.06 * (high - low) : column.log ? 0.5 : 1;
  [low, high] = [low - room, high + room];
  const place = (x) => from + ((x - low) / (high - low)) * (to - from);
  const marks = ticks(low, high, column.log);
  // As many digits as tell one mark from the next.
  const digits = [0, 1, 2, 3, 4, 5].find((n) => new Set(marks.map((x) => (10 ** x).toExponential(n))).size === marks.length) ?? 6;
  const decade = (x) => (10 ** x).toExponential(digits).replace(/\.?0*e\+?/, "e");
  const name = (x) => (column.log ? decade(x) : column.show === percent ? percent(x) : String(x));
  return { at: (v) => place(of(v)), ticks: marks.map((x) => [place(x), name(x)]) };
}

/** Those that no other is at least as good as in both and better in one: sorted along the first. */
function paretoFront(shown, x, y) {
  const sorted = [...shown].sort((a, b) => -x.better * (x.values[a] - x.values[b]) || -y.better * (y.values[a] - y.values[b]) || a - b);
  const out = [];
  let best = null;
  for (const i of sorted) {
    const value = -y.better * y.values[i];
    if (best === null || value < best) {
      out.push(i);
      best = value;
    }
  }
  return out;
}

function drawAxes(svg, sx, sy, x, y) {
  const { width, height, left, right, top, bottom } = CHART;
  for (const [at, name] of sx.ticks) {
    svg.append(svgElement("path", { class: "grid", d: `M${at} ${top}V${height - bottom}` }));
    svg.append(svgElement("text", { x: at, y: height - bottom + 16, "text-anchor": "middle" }, name));
  }
  for (const [at, name] of sy.ticks) {
    svg.append(svgElement("path", { class: "grid", d: `M${left} ${at}H${width - right}` }));
    svg.append(svgElement("text", { x: left - 7, y: at + 4, "text-anchor": "end" }, name));
  }
  svg.append(svgElement("path", { class: "axis", d: `M${left} ${top}V${height - bottom}H${width - right}` }));
  svg.append(svgElement("text", { x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle", class: "soft" }, x.words));
  const middle = (top + height - bottom) / 2;
  svg.append(svgElement("text", { x: 14, y: middle, "text-anchor": "middle", class: "soft", transform: `rotate(-90 14 ${middle})` }, y.words));
}

let point = () => [0, 0];

/** The ring around the chosen variant. */
function markPoint() {
  const ring = document.querySelector("#chart .ring");
  if (!ring) return;
  const at = view.chosen === null ? null : point(view.chosen);
  ring.setAttribute("visibility", at ? "visible" : "hidden");
  if (at) {
    ring.setAttribute("cx", at[0]);
    ring.setAttribute("cy", at[1]);
  }
}

/** Chooses from the chart, and turns the table to it. */
function chooseInChart(i) {
  const place = view.order.indexOf(i);
  if (place >= 0) {
    view.active = place;
    drawTable();
  }
  choose(i);
}

/** The points of the front can be walked along. */
function frontPoints(svg, front, x, y) {
  const made = front.map((i, n) => {
    const [cx, cy] = point(i);
    const label = `${noun()} ${i + 1}: ${x.words} ${x.show(x.values[i])}, ${y.words} ${y.show(y.values[i])}`;
    const dot = svgElement("circle", { class: "front", cx, cy, r: 5, tabindex: n ? -1 : 0, role: "button", "aria-label": label });
    dot.append(svgElement("title", {}, label));
    dot.addEventListener("click", () => chooseInChart(i));
    dot.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (step) {
        event.preventDefault();
        const to = Math.max(0, Math.min(n + step, made.length - 1));
        made.forEach((d, m) => d.setAttribute("tabindex", m === to ? 0 : -1));
        made[to].focus();
      } else if (event.key === "Enter" || event.key === " ") {
        event.preventDefault();
        chooseInChart(i);
      }
    });
    return dot;
  });
  svg.append(...made);
}

function drawChart() {
  const [x, y] = [columnOf(byId("axis-x").value), columnOf(byId("axis-y").value)];
  const { width, height, left, right, top, bottom } = CHART;
  const shown = view.order.filter((i) => x.values[i] !== null && y.values[i] !== null);
  const svg = svgElement("svg", { viewBox: `0 0 ${width} ${height}`, class: "pareto", role: "group", "aria-label": `${y.words} against ${x.words}` });
  point = () => null;
  if (shown.length) {
    const [sx, sy] = [scale(x, shown, left, width - right), scale(y, shown, height - bottom, top)];
    point = (i) => (x.values[i] === null || y.values[i] === null ? null : [sx.at(x.values[i]), sy.at(y.values[i])]);
    drawAxes(svg, sx, sy, x, y);
    // Variants of the same figures lie on each other: one dot for them, which chooses the first.
    const dots = new Map();
    for (const i of shown) {
      const key = point(i).map(Math.round).join(" ");
      if (!dots.has(key)) dots.set(key, i);
    }
    for (const i of dots.values()) {
      const [cx, cy] = point(i);
      const dot = svgElement("circle", { class: "dot", cx, cy, r: 3.5, "data-variant": i });
      dot.append(svgElement("title", {}, `${inWords(i)}. ${changeLine(i)}`));
      dot.addEventListener("click", () => chooseInChart(i));
      svg.append(dot);
    }
    const front = paretoFront(shown, x, y);
    const corners = front.map((i) => point(i).map((p) => p.toFixed(1)).join(" "));
    svg.append(svgElement("path", { class: "front-line", d: `M${corners.join("L")}` }));
    svg.append(svgElement("circle", { class: "ring", r: 9, visibility: "hidden" }));
    frontPoints(svg, front, x, y);
    const part = shown.length === view.order.length ? "" : `The ${grouped(shown.length)} of ${grouped(view.order.length)} variants that have both figures. `;
    const best = front.length === 1
      ? "The larger dot is best in both."
      : `The line joins the ${front.length} Pareto-optimal variants; use the arrow keys to step along it.`;
    byId("chart-words").textContent = `${part}${best}`;
  } else {
    byId("chart-words").textContent = "No variant has both figures.";
  }
  byId("chart-room").replaceChildren(svg);
  markPoint();
}

function listenToChart() {
  for (const axis of ["axis-x", "axis-y"]) byId(axis).addEventListener("change", drawChart);
}

/** Offers the figures of the list, beginning with two that vary; a list without two has no chart. */
function offerAxes() {
  const varies = (c) => c && c.key !== "place" && new Set(c.values.filter((v) => v !== null)).size > 1;
  const wanted = work && work.ranked ? work.ranked.terms.map((t) => (t === "conditioning" ? "condit" : t)) : [];
  const order = [...wanted, "peak-moment", "peak-force", "conditioning", "stands", "mobility", "changes", "idle"];
  const first = ["cost", ...order].map(columnOf).find(varies);
  const second = order.map(columnOf).find((c) => varies(c) && c !== first);
  byId("chart").hidden = !second;
  for (const [id, chosen] of [["axis-x", first], ["axis-y", second]]) {
    byId(id).replaceChildren(...columns.map((c) => element("option", { value: c.key }, c.words)));
    byId(id).value = (chosen || columns[0]).key;
  }
}
