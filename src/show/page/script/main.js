// Starts the page, and keeps its parts in step.

/** After the filter or the order has changed. */
function refresh() {
  arrange();
  tellCount();
  drawTable();
  drawChart();
}

function listenToFilters() {
  const form = byId("filters");
  const anew = () => {
    view.active = 0;
    refresh();
  };
  let waiting = 0;
  form.addEventListener("input", (event) => {
    // Another list is drawn at once; drawn again later, it would turn back to its first page.
    if (event.target.id === "list") return;
    clearTimeout(waiting);
    waiting = setTimeout(anew, 60);
  });
  // The fields are emptied after the event.
  form.addEventListener("reset", () => setTimeout(anew, 0));
  form.addEventListener("submit", (event) => event.preventDefault());
}

/** Escape clears a filter with text, or else returns to the original mechanism. */
function listenToEscape() {
  byId("explorer").addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    if (event.target.form === byId("filters")) byId("filters").reset();
    else choose(null);
  });
}

function headLine() {
  const parts = [];
  if (work && work.ranked) parts.push(`In order: ${work.ranked.head}.`, ...work.ranked.notes.map((n) => (/[.:]$/.test(n) ? n : `${n}.`)));
  else parts.push("In order of cost, in revolute joints by the table of [search.costs].");
  if (found.workload && found.workload.failed) parts.push(`The loads were not examined: ${found.workload.failed}.`);
  if (found.notes.some(Boolean)) parts.push("Marked variants (!, *, ~) need care: point at them or choose them to see why.");
  return parts.join(" ");
}

/** Another list is chosen. */
function relist() {
  view.sort = { key: "position", down: false };
  view.active = 0;
  byId("head").textContent = headLine();
  showTicks();
  offerAxes();
  refresh();
  choose(view.order.length ? view.order[0] : null);
}

function listenToList() {
  byId("list-field").hidden = !(page.ideas && page.search);
  byId("list").value = byIdeas() ? "ideas" : "variants";
  byId("list").addEventListener("change", () => {
    take(byId("list").value === "ideas" ? page.ideas : page.search);
    relist();
  });
}

listenToStage();
listenToKeepers();
if (found) {
  byId("explorer").hidden = false;
  byId("chosen").hidden = false;
  listenToFilters();
  listenToTable();
  listenToChart();
  listenToEscape();
  listenToList();
  relist();
}
