// The ideas: counts and the ten best; the one under the pointer is marked on the drawing, a click takes it.

const changeLine = ({ changes }) => changesInWords(changes.map((c) => [c.joint, c.to])) || "nothing to change";

async function takeIdea(n) {
  const { revision } = desk.ideas;
  const idea = desk.ideas.found.variants[n];
  pointedAt.idea = null;
  const done = await inTurn("take", { idea: idea.position, revision });
  if (done) say(`Idea ${idea.position} is taken: ${changeLine(idea)}. Undo brings back what was.`);
}

function ideaRow(v, n) {
  const stands = v.idea ? `represents ${v.idea.exact ? "" : "at least "}${grouped(v.idea.variants)}` : "";
  const figures = `cost ${v.cost} · W = ${v.mobility} · σ = ${v.redundant}${stands ? ` · ${stands}` : ""}`;
  const none = v.changes.length === 0;
  const row = element("button", { type: "button", class: "idea", disabled: none ? "" : null, title: none ? null : "Take this idea: the file is changed, undo brings it back" },
    element("span", { class: "idea-words" }, ...unbroken(changeLine(v))), element("small", {}, figures));
  return element("li", {}, pointer(row, looked("idea", n), looked("idea", null), () => takeIdea(n)));
}

/** Searches again with the wider request of a number, or with the first one. */
const ask = (wider) => inTurn("ask", { wider, revision: desk.ideas.revision });

/** The reasons why nothing is found, with a button for each request that finds something. */
function nothingFound({ hopeless, wider }) {
  const row = ({ flags, gives }, n) => element("li", {}, pointer(element("button", { type: "button", class: "idea" }, element("span", { class: "idea-words" }, `Search with ${flags}`), element("small", {}, gives)), () => {}, () => {}, () => ask(n)));
  const words = hopeless.map((why) => `${why}.`).join(" ") || (wider.length ? "None with these options." : "None with these options: give the joints more.");
  return [element("p", { class: "help" }, words), element("ul", { class: "idea-list" }, ...wider.map(row))];
}

/** The wider request, with a button that goes back to the first one. */
function askedNow(asked) {
  return element("p", { class: "help" }, `Searched with ${asked}. `, button("Search as at first", () => ask(null)));
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

function showIdeas() {
  const room = byId("ideas");
  pointedAt.idea = null;
  const head = element("h2", {}, "Ideas");
  const value = desk.ideas;
  const part = (...inside) => room.replaceChildren(head, ...inside);
  if (!desk.verdict?.analysis?.states.some((s) => !isOpen(s))) return room.replaceChildren();
  if (!value) return part();
  const asked = value.asked ? [askedNow(value.asked)] : [];
  if (value.why) return part(...asked, element("p", { class: "help" }, `Redesigns were not searched: ${value.why}.`));
  const { found, notes } = value;
  if (found.space === "1" && !value.wider.length) return part(...asked, element("p", { class: "help" }, "No joint has a choice, so there is nothing to search: tick joint types under “Search options”."));
  const left = searchOf().max_redundant;
  const goal = left ? `σ ≤ ${left}` : "σ = 0";
  const counts = `${found.exact ? "" : "at least "}${grouped(found.lasting ?? found.admissible)} of ${grouped(found.space)} variants ${value.asked ? "are found" : `have ${goal} and keep the motion of outputs and drives`} ${found.lasting === null ? "in the drawn pose" : "throughout the motion"}.`;
  const stopped = found.stop === "interrupted" || (desk.stoppedAt === value.revision && !found.exact) ? ["The search was stopped: these are the ideas found until then."] : [];
  const all = found.variants.map(ideaRow);
  const none = found.variants.length ? [] : nothingFound(value);
  return part(...asked, element("p", { class: "counts" }, counts), ...none, element("ol", { class: "idea-list" }, ...all), ...[...stopped, ...(notes ?? [])].map((n) => element("p", { class: "help" }, n)));
}
