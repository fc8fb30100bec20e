// Which variants are shown, and in what order.

const view = {
  /** Variants that pass the filter, in order. */
  order: [],
  /** The column sorted by: a key, "position" or "list". */
  sort: { key: "position", down: false },
  /** The chosen variant, or null for the original mechanism. */
  chosen: null,
  /** The place in the order that the keyboard is at. */
  active: 0,
};

/** A number typed in, or null. */
function limit(id) {
  const value = byId(id).value.trim();
  return value === "" || Number.isNaN(Number(value)) ? null : Number(value);
}

/** Boxes to tick: by field, its words and its test. */
const TICKS = {
  "no-idle": ["no idle links", (i) => found.idle?.[i] === 0],
  "symmetric-only": ["symmetric", (i) => found.symmetric[i] === true],
  "in-all-poses": ["throughout the motion", (i) => found.lucky[i] === false],
};

/** Hides a box that would not divide the list. */
function showTicks() {
  const all = Array.from({ length: total }, (_, i) => i);
  for (const [field, [, passes]] of Object.entries(TICKS)) byId(`${field}-field`).hidden = all.every(passes) || !all.some(passes);
}

/** The criteria of the filter: each with its field, and a test. */
function criteria() {
  const out = [];
  for (const word of byId("find").value.replaceAll("→", "->").split(/\s+/).filter(Boolean)) {
    out.push({ words: `“${word}”`, word, passes: (i) => haystack(i).includes(word.toLowerCase()) });
  }
  const limits = [["most-cost", "cost ≤", found.cost], ["most-changes", "changes ≤", found.changes], ["most-mobility", "W ≤", found.mobility]];
  for (const [id, words, values] of limits) {
    const most = limit(id);
    if (most !== null) out.push({ words: `${words} ${most}`, field: id, passes: (i) => values[i] <= most });
  }
  for (const [field, [words, passes]] of Object.entries(TICKS)) {
    if (byId(field).checked && !byId(`${field}-field`).hidden) out.push({ words, field, passes });
  }
  return out;
}

/** How many of the list pass all of some criteria. */
function countOf(list) {
  let n = 0;
  for (let i = 0; i < total; i += 1) n += Number(list.every((c) => c.passes(i)));
  return n;
}

/** Takes a part of the filter away. */
function drop(criterion) {
  if (criterion.word) {
    const words = byId("find").value.split(/\s+/).filter((w) => w.replaceAll("→", "->") !== criterion.word);
    byId("find").value = words.join(" ");
  } else if (criterion.field in TICKS) byId(criterion.field).checked = false;
  else byId(criterion.field).value = "";
  refresh();
}

/** The joint and type of a word such as 5-1:cylindrical, or null. */
function wish(word) {
  const at = word.lastIndexOf(":");
  if (at < 1) return null;
  const [id, type] = [word.slice(0, at), word.slice(at + 1).toLowerCase()];
  for (const variable of found.variables) {
    const n = variable.joints.findIndex((j) => page.joints[j].id.toLowerCase() === id.toLowerCase());
    if (n >= 0) {
      const names = variable.choices.map((c) => c.names[n]);
      return { id: page.joints[variable.joints[n]].id, type, names, known: names.slice(1).find((name) => name.toLowerCase() === type) };
    }
  }
  return { id, type, names: null, known: undefined };
}

/** For a filter that nothing passes: what would, and where there is more. */
function insteadOfNothing() {
  const asked = criteria();
  const parts = [element("p", {}, `None of the ${grouped(total)} ${noun().toLowerCase()}s listed matches the filter.`)];
  const without = asked.map((c) => [c, countOf(asked.filter((other) => other !== c))]).filter(([, n]) => n > 0);
  for (const [c, n] of asked.length > 1 ? without : []) {
    parts.push(button(`Without ${c.words}: ${grouped(n)}`, () => drop(c)), " ");
  }
  const wishes = asked.filter((c) => c.word).map((c) => wish(c.word)).filter(Boolean);
  for (const { id, type, names, known } of wishes) {
    if (!names) parts.push(element("p", {}, `There is no joint ${id} that the search may change.`));
    else if (!known) parts.push(element("p", {}, `Joint ${id} may be ${names.join(", ")}; ${type} is none of its options.`));
  }
  const allowed = wishes.filter((w) => w.known);
  if (allowed.length && Number(found.admissible) > total) {
    const flags = allowed.map((w) => `--allow '${w.id}=${w.known}'`).join(" ");
    parts.push(element("p", {},
      `The page lists the cheapest of ${grouped(found.admissible)}. For the cheapest in which ${allowed.map((w) => `${w.id} stays or becomes ${w.known}`).join(", ")}: `,
      element("code", {}, page.longer.replace("{}", flags))));
  }
  return parts;
}

function passes() {
  const asked = criteria();
  return (i) => asked.every((c) => c.passes(i));
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
  const [whole, listed, shown] = [found.admissible, total, view.order.length].map(grouped);
  const each = byIdeas() ? "ideas" : "variants";
  let words = `${listed} listed of ${whole} admissible variants`;
  if (view.order.length < total) words = `${shown} of the ${listed} listed ${each} ${view.order.length === 1 ? "passes" : "pass"} the filter`;
  else if (byIdeas()) {
    const stand = found.stands_for.reduce((sum, n) => sum + BigInt(n || 0), 0n);
    words = `${total === 1 ? "One idea; it represents" : `${listed} ideas; they represent`} ${found.exact ? "" : "at least "}${grouped(stand)} of ${whole} admissible variants`;
  } else if (total === Number(found.admissible)) words = total === 1 ? "The only admissible variant" : `All ${listed} admissible variants`;
  byId("count").textContent = words;
}
