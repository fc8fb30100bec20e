// The ideas: counts and the ten best; the one under the pointer is marked on the drawing, a click takes it.

const changeLine = ({ changes }) => changesInWords(changes.map((c) => [c.joint, c.to])) || "nothing to change";

async function takeIdea(n) {
  const { revision } = desk.ideas;
  const idea = desk.ideas.found.variants[n];
  pointedAt.idea = null;
  const done = await inTurn("take", { idea: idea.position, revision });
  if (done) say(`Applied idea ${idea.position}: ${changeLine(idea)}. Undo goes back.`);
}

/** The figures of an idea, each with its name; the same words as in the report. */
function figuresOf(v) {
  const { found } = desk.ideas;
  const motion = found.lasting !== null ? "throughout the motion" : v.lucky ? "in the drawn pose only" : "in the drawn pose";
  return [
    ["cost", String(v.cost)],
    ["mobility", `W = ${v.mobility}`],
    ["left", `σ = ${v.redundant}`],
    ["represents", v.idea ? `${v.idea.exact ? "" : "at least "}${grouped(v.idea.variants)}` : ""],
    ["symmetry", typeof v.idea?.symmetric === "boolean" ? (v.idea.symmetric ? "symmetric" : "not symmetric") : ""],
    ["works", motion],
  ];
}

/** The explanation of an idea, line by line. */
const whyOf = (n) => (desk.ideas.reasons?.[n] ?? []).map(([what, words]) => [what.replace(/:$/, ""), words]);

const listRows = (rows) => element("dl", { class: "why" }, ...rows.flatMap(([what, words]) => [element("dt", {}, what.replace(/^./, (c) => c.toUpperCase())), element("dd", {}, ...unbroken(words))]));

/** The ideas that are compared, by their numbers in the list. */
let compared = [];

function ideaRow(v, n) {
  const figures = figuresOf(v).filter(([, words]) => words).map(([name, words]) => (["cost", "represents"].includes(name) ? `${name} ${words}` : words)).join(" · ");
  const none = v.changes.length === 0;
  const row = element("button", { type: "button", class: "idea", disabled: none ? "" : null, title: none ? null : "Apply this idea to the file; Undo reverts it" },
    element("span", { class: "idea-words" }, ...unbroken(changeLine(v))), element("small", {}, figures));
  const out = element("li", {}, pointer(row, "idea", n, () => takeIdea(n)));
  const rows = whyOf(n);
  if (rows.length) out.append(element("details", { open: n === 0 ? "" : null }, element("summary", {}, "Why"), listRows(rows)));
  if (desk.ideas.found.variants.length > 1) {
    out.append(tick("compare", compared.includes(n), (on) => {
      compared = on ? [...compared.slice(-1), n] : compared.filter((k) => k !== n);
      showIdeas();
    }));
  }
  return out;
}

/** Two ideas side by side; what differs is bold. */
function comparison(variants) {
  if (compared.length < 2) return [];
  const columns = compared.map((n) => new Map([["changes", changeLine(variants[n])], ...figuresOf(variants[n]), ...whyOf(n)]));
  const keys = [...new Set(columns.flatMap((c) => [...c.keys()]))].filter((k) => columns.some((c) => c.get(k)));
  const head = element("tr", {}, element("td", {}), ...compared.map((n) => element("th", { scope: "col" }, pointer(button(`Idea ${n + 1}`, () => takeIdea(n)), "idea", n))));
  const row = (k) => {
    const cells = columns.map((c) => c.get(k) || "–");
    return element("tr", { class: cells[0] === cells[1] ? null : "differs" }, element("th", { scope: "row" }, k), ...cells.map((c) => element("td", {}, ...unbroken(c))));
  };
  return [element("table", { class: "compared" }, element("caption", { class: "unseen" }, "Two ideas compared"), element("thead", {}, head), element("tbody", {}, ...keys.map(row)))];
}

/** Searches again with the wider request of a number, or with the first one. */
const ask = (wider) => inTurn("ask", { wider, revision: desk.ideas.revision });

/** Widens the search: in the file, where the file has a key for it. */
function widen(step, n) {
  if (!step.in_file || desk.file.kind !== "toml") return ask(n);
  const put = (key) => (step[key] === null ? [] : [{ do: "put", path: ["search", key], value: step[key] }]);
  const more = (list, wanted) => [...list, ...wanted.filter((w) => !list.some((o) => optionName(o) === optionName(w)))];
  const options = step.allow.map(([id, wanted]) => set("joint", id, "options", more(offeredAt(thing("joint", id)), wanted)));
  // a screw with a joint in series stays a screw
  const series = step.unloading.flatMap(([id, wanted]) => [set("joint", id, "unloading", more(seriesAt(thing("joint", id)), wanted)), set("joint", id, "options", [])]);
  return change(...["max_redundant", "max_mobility", "drives", "pose_only"].flatMap(put), ...options, ...series);
}

/** The reasons why nothing is found, with a button for each request that finds something. */
function nothingFound({ found, hopeless, wider }) {
  const opens = (step) => Number(step.allow.length + step.unloading.length > 0);
  const offer = (step) => element("button", { type: "button", class: "idea offer" }, `Show ${step.gives.replace(/^Allow more joint types: there are/, "the")}`);
  const row = ([step, n]) => element("li", {}, acted(offer(step), () => widen(step, n)));
  const words = hopeless.map((why) => `${why}.`).join(" ") || (wider.length ? "No redesign meets the conditions." : "No redesign meets the conditions. Allow more joint types.");
  const fixed = [...new Set([...(found.unchanged ?? []), ...(found.frozen ?? [])])].filter((id) => thing("joint", id));
  const open = (id) => button(`Joint types at ${id}`, () => {
    typesAt.open = true;
    select([{ what: "joint", id }]);
  });
  return [element("p", { class: "help" }, words), element("ul", { class: "idea-list" }, ...wider.map((step, n) => [step, n]).sort(([a], [b]) => opens(b) - opens(a)).map(row)), element("div", { class: "acts" }, ...fixed.slice(0, 6).map(open), button("Search options", openOptions))];
}

function openOptions() {
  byId("search-fold").open = true;
  byId("search").scrollIntoView({ block: "nearest" });
}

/** The wider request, with a button that goes back to the first one. */
function askedNow(asked) {
  return element("p", { class: "help" }, `Shown: ${asked}. `, button("Back to the first search", () => ask(null)));
}

/** Forces over the stroke, where the file states loads. */
function showForce() {
  const room = byId("force");
  const chart = desk.force?.charts[desk.state];
  room.hidden = !chart;
  if (!chart) return;
  const picture = chart.svg ? element("img", { class: "chart", alt: "Forces over the stroke", src: `data:image/svg+xml,${encodeURIComponent(chart.svg)}` }) : null;
  room.replaceChildren(element("h2", {}, "Forces over the stroke"), picture ?? element("p", { class: "help" }, `There are none: ${chart.why ?? "no position has an equilibrium"}.`));
}

/** The condition on drives, in the sentence of the counts. */
const KEPT = { kept: "keep the motion of outputs and drives", free: "keep the motion of outputs", independent: "have drives that determine the outputs, each freely" };

/** After so many milliseconds without ideas, single changes are shown. */
const PATIENCE = 500;

/** Changes of one joint that remove some redundant constraints, while the search for whole redesigns runs. */
function singleChanges() {
  const all = desk.verdict.analysis.states[desk.state]?.suggestions?.changes ?? [];
  const row = ({ text, joint, to, unloading }) => {
    const known = !unloading && palette.some((t) => t.type === to);
    return known ? button(text, () => setType([joint], to), "Apply this change to the file; Undo reverts it") : element("p", {}, text);
  };
  return all.length ? [element("p", { class: "help" }, "The search runs. Single changes that help:"), element("div", { class: "rows" }, ...all.slice(0, 5).map(row))] : [];
}

function showIdeas() {
  const room = byId("ideas");
  pointedAt.idea = null;
  const head = element("h2", {}, "Ideas");
  const value = desk.ideas;
  const part = (...inside) => room.replaceChildren(head, ...inside);
  if (!desk.verdict?.analysis?.states.some((s) => !isOpen(s))) return room.replaceChildren();
  // a short search would only make them flicker
  if (!value) return part(...(performance.now() - desk.judgedAt > PATIENCE ? singleChanges() : []));
  const asked = value.asked ? [askedNow(value.asked)] : [];
  if (value.why) return part(...asked, element("p", { class: "help" }, `Redesigns were not searched: ${value.why}.`));
  const { found, notes } = value;
  compared = compared.filter((n) => n < found.variants.length);
  if (found.space === "1" && !value.wider.length) return part(...asked, element("p", { class: "help" }, "Nothing to search: no joint has options. "), button("Search options", openOptions));
  const left = searchOf().max_redundant;
  const goal = left ? `σ ≤ ${left}` : "σ = 0";
  const counts = `${found.exact ? "" : "at least "}${grouped(found.lasting ?? found.admissible)} of ${grouped(found.space)} variants ${value.asked ? "are found" : `have ${goal} and ${KEPT[searchOf().drives ?? "kept"]}`} ${found.lasting === null ? "in the drawn pose" : "throughout the motion"}.`;
  const stopped = found.stop === "interrupted" || (desk.stoppedAt === value.revision && !found.exact) ? ["The search was stopped: these are the ideas found until then."] : [];
  const none = found.variants.length ? [] : nothingFound(value);
  const divided = found.variants.some((v) => v.idea?.symmetric === false) && (found.variants.some((v) => v.idea?.symmetric) || value.symmetric);
  const only = searchOf().symmetric || divided ? [tick("symmetric ideas only", searchOf().symmetric, (on) => putSearch("symmetric", on || null))] : [];
  const best = value.symmetric ? [element("details", {}, element("summary", {}, "Symmetric redesigns"), element("ul", { class: "notes" }, ...value.symmetric.map((line) => element("li", {}, ...unbroken(line)))))] : [];
  return part(...asked, element("p", { class: "counts" }, counts), ...only, ...none, ...comparison(found.variants), element("ol", { class: "idea-list" }, ...found.variants.map(ideaRow)),
    ...best, ...[...stopped, ...(notes ?? [])].map((n) => element("p", { class: "help" }, n)));
}
