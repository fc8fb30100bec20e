// Which variants are shown, and in what order.

const view = {
  /** Variants that pass the filter, in order. */
  order: [],
  /** The column sorted by: a key, "position" or "list". */
  sort: { key: "position", down: false },
  /** The variant chosen, or null for the mechanism as it is. */
  chosen: null,
  /** The place in the order that the keyboard is at. */
  active: 0,
};

/** A number typed in, or null. */
function limit(id) {
  const value = byId(id).value.trim();
  return value === "" || Number.isNaN(Number(value)) ? null : Number(value);
}

function passes() {
  const words = byId("find").value.toLowerCase().replaceAll("→", "->").split(/\s+/).filter(Boolean);
  const [cost, changes, mobility] = ["most-cost", "most-changes", "most-mobility"].map(limit);
  const noIdle = byId("no-idle").checked && found.idle;
  return (i) =>
    (cost === null || found.cost[i] <= cost) &&
    (changes === null || found.changes[i] <= changes) &&
    (mobility === null || found.mobility[i] <= mobility) &&
    (!noIdle || found.idle[i] === 0) &&
    words.every((w) => haystack(i).includes(w));
}

/** Values to sort by; what is not known comes last either way. */
function compare() {
  const { key, down } = view.sort;
  const sign = down ? -1 : 1;
  if (key === "position") return (a, b) => sign * (a - b);
  if (key === "list") {
    const lines = new Map(view.order.map((i) => [i, changeLine(i)]));
    const less = (a, b) => (lines.get(a) < lines.get(b) ? -1 : Number(lines.get(a) > lines.get(b)));
    return (a, b) => sign * less(a, b) || a - b;
  }
  const { values } = columnOf(key);
  return (a, b) => {
    const [x, y] = [values[a], values[b]];
    if (x === null || y === null) return Number(x === null) - Number(y === null) || a - b;
    return sign * (x - y) || a - b;
  };
}

/** Filters and sorts anew. */
function arrange() {
  const pass = passes();
  view.order = [];
  for (let i = 0; i < total; i += 1) if (pass(i)) view.order.push(i);
  view.order.sort(compare());
}

function tellCount() {
  const whole = grouped(found.admissible);
  const listed = grouped(total);
  const shown = grouped(view.order.length);
  const all = total === 1 ? "The only admissible variant" : `All ${listed} admissible variants`;
  const part = `${listed} listed of ${whole} admissible variants`;
  if (view.order.length < total) byId("count").textContent = `${shown} of the ${listed} listed variants pass the filter`;
  else byId("count").textContent = total === Number(found.admissible) ? all : part;
}
