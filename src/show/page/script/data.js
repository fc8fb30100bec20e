// The data of the page: columns of numbers by variant, and words made of them on demand.

const page = JSON.parse(document.getElementById("data").textContent);
/** The list that is shown: ideas, each by its first variant, or single variants. */
let found = page.ideas || page.search;
let [work, total, columns] = [null, 0, []];
/** The texts that the text filter searches. */
let haystacks = [];
const byIdeas = () => found === page.ideas;
/** The name of an item of the list. */
const noun = () => (byIdeas() ? "Idea" : "Variant");

/** Three significant digits, never in the form 1e+21 for what a reader would write out. */
function short(x) {
  if (x === null || x === undefined) return "";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e6) return power(x);
  return String(Number(x.toPrecision(3)));
}

/** 2.3e-2, as the text output writes it. */
const power = (x) => (x === null || x === undefined ? "" : x.toExponential(1).replace("e+", "e"));

/** A share of something: 14.1 %. */
function percent(x) {
  if (x === null || x === undefined) return "";
  const y = 100 * x;
  if (y > 0 && y < 0.1) return "< 0.1\u00a0%";
  return `${y < 1000 ? y.toFixed(1) : grouped(Math.round(y))}\u00a0%`;
}

/** The columns of numbers: format, better direction, and whether a log scale suits. */
function makeColumns() {
  const out = [];
  const add = (key, title, words, values, more) => {
    if (values && values.some((v) => v !== null)) {
      out.push({ key, title, words, values, better: -1, log: false, show: String, table: true, ...more });
    }
  };
  if (byIdeas()) {
    const show = (n) => (n > Number.MAX_SAFE_INTEGER ? power(n) : grouped(n));
    const title = found.exact ? "variants" : "variants ≥";
    add("stands", title, "variants that an idea represents", found.stands_for.map((n) => (n === null ? null : Number(n))), { better: 1, show });
  }
  add("cost", "cost", "cost in revolute joints", found.cost);
  add("changes", "changes", "changed joints", found.changes, { table: !byIdeas() });
  add("mobility", "W", "mobility W", found.mobility);
  if (found.max_redundant > 0) add("redundant", "σ", "redundant constraints σ", found.redundant);
  if (found.external) add("external", "σ ext.", "external redundant constraints", found.external);
  add("idle", "idle", "idle motions", found.idle, { table: false });
  const drivesHeld = work && work.ranked && work.ranked.terms.includes("conditioning");
  add("conditioning", "cond.", "conditioning: smallest over largest singular value", found.conditioning,
    { better: 1, log: true, show: power, table: !drivesHeld });
  if (work) {
    const terms = work.ranked ? work.ranked.terms : [];
    const shown = (term) => !work.ranked || terms.includes(term);
    add("peak-moment", "moment", "peak moment, share of capacity", work.peak_moment,
      { show: percent, table: shown("peak-moment") });
    add("peak-force", "force", "peak force, share of capacity", work.peak_force,
      { show: percent, table: shown("peak-force") });
    add("condit", "cond. held", "conditioning with drives held", work.conditioning,
      { better: 1, log: true, show: power, table: Boolean(drivesHeld) });
    add("output-error", "error, mm", "output error in mm from clearances", work.output_error_mm,
      { show: short, table: shown("output-error") });
    if (work.ranked) add("score", "score", "weighted score", work.ranked.total, { show: short });
  }
  const places = Array.from({ length: total }, (_, i) => i + 1);
  add("place", "№", "place in the list", places, { table: false });
  return out;
}

/** Takes a list for the one that is shown. */
function take(list) {
  found = list;
  work = found.workload && !found.workload.failed ? found.workload : null;
  total = found.cost.length;
  haystacks = [];
  columns = makeColumns();
}

if (found) take(found);
const columnOf = (key) => columns.find((c) => c.key === key);

/** The changes of a variant: joint, names before and after, and where the choice stands. */
function changesOf(i) {
  const out = [];
  const list = found.choices[i];
  for (let n = 0; n < list.length; n += 2) {
    const variable = found.variables[list[n]];
    const [before, after] = [variable.choices[0], variable.choices[list[n + 1]]];
    variable.joints.forEach((joint, at) => {
      out.push({
        joint,
        id: page.joints[joint].id,
        from: before.names[at],
        to: after.names[at],
        classes: [before.class, after.class],
        unloading: after.unloading,
        variable: list[n],
        choice: list[n + 1],
      });
    });
  }
  return out.sort((a, b) => a.joint - b.joint);
}

/** The changes in a line. */
const changeLine = (i) => changesInWords(changesOf(i).map((c) => [c.id, c.to])) || "none: the original mechanism";

/** The text of a variant that the text filter searches. */
function haystack(i) {
  if (haystacks[i] === undefined) {
    const words = changesOf(i).map((c) => `${c.id}:${c.to} ${c.id}: ${c.from} -> ${c.to}`);
    haystacks[i] = [...words, found.adds[i] || ""].join("; ").toLowerCase();
  }
  return haystacks[i];
}

/** A variant in a few words. */
function inWords(i) {
  const n = found.changes[i];
  const parts = [`cost ${found.cost[i]}`, `${n} ${n === 1 ? "change" : "changes"}`, `W = ${found.mobility[i]}`];
  return `${noun()} ${i + 1}: ${parts.join(", ")}`;
}
