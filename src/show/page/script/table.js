// The table of variants, a page at a time.

const ROWS = 25;

const pages = () => Math.max(1, Math.ceil(view.order.length / ROWS));
const pageNumber = () => Math.floor(view.active / ROWS);

/** The classes of a column; less important ones are hidden if there is little space. */
const classOf = (key, numeric) => `${numeric ? "n" : ""}${["position", "list", "cost"].includes(key) ? "" : " more"}`;

function drawHead() {
  const row = element("tr", { "aria-rowindex": 1 });
  const head = (key, title, words, numeric) => {
    const sorted = view.sort.key === key;
    const order = sorted ? (view.sort.down ? "descending" : "ascending") : "none";
    const sorts = button(title, () => sortBy(key), `Sort by ${words}`);
    row.append(element("th", { scope: "col", "data-key": key, "aria-sort": order, class: classOf(key, numeric) }, sorts));
  };
  head("position", "№", "position", true);
  head("list", "changed joints", "changed joints", false);
  for (const c of columns.filter((c) => c.table)) head(c.key, c.title, c.words, true);
  document.querySelector("#variants thead").replaceChildren(row);
}

/** Sorts by a column, the better end first; again, the other way round. */
function sortBy(key) {
  const column = columnOf(key);
  const first = Boolean(column && column.better > 0);
  view.sort = { key, down: view.sort.key === key ? !view.sort.down : first };
  view.active = 0;
  refresh();
  document.querySelector(`#variants th[data-key="${key}"] button`).focus();
}

/** The signs that the text output uses for doubtful variants. */
function doubt(i) {
  if (found.lucky[i] === true) return "!";
  if (found.agree[i] === false) return "*";
  return found.notes[i] ? "~" : "";
}

function drawRow(i, place) {
  const row = element("tr", {
    role: "row",
    tabindex: place === view.active ? 0 : -1,
    "aria-rowindex": place + 2,
    "aria-selected": i === view.chosen,
    "data-variant": i,
    title: found.notes[i],
  });
  row.append(element("th", { scope: "row", class: "n" }, `${i + 1}${doubt(i) && ` ${doubt(i)}`}`));
  const words = changeLine(i);
  row.append(element("td", { class: "list" }, element("span", { class: "two", title: words }, ...unbroken(words))));
  for (const c of columns.filter((c) => c.table)) {
    const value = c.values[i];
    row.append(element("td", { class: classOf(c.key, true) }, value === null ? "" : c.show(value)));
  }
  row.addEventListener("click", () => {
    view.active = place;
    choose(i);
    focusRow(true);
    reveal();
  });
  return row;
}

/** The whole list in its order, as the table has it. */
function listRows() {
  const shown = columns.filter((c) => c.table);
  const heads = [noun().toLowerCase(), "changed joints", ...shown.map((c) => c.title)];
  const row = (i) => [String(i + 1), changeLine(i), ...shown.map((c) => (c.values[i] === null ? "" : String(c.values[i])))];
  return [heads, ...view.order.map(row)];
}

function drawTable() {
  drawHead();
  view.active = Math.max(0, Math.min(view.active, view.order.length - 1));
  const from = pageNumber() * ROWS;
  const shown = view.order.slice(from, from + ROWS);
  const body = document.querySelector("#variants tbody");
  body.replaceChildren(...shown.map((i, n) => drawRow(i, from + n)));
  if (!shown.length) {
    const cell = element("td", { colspan: columns.length + 2, class: "nothing" }, ...insteadOfNothing());
    body.append(element("tr", {}, cell));
  }
  byId("variants").setAttribute("aria-rowcount", view.order.length + 1);
  const range = shown.length ? `${grouped(from + 1)} to ${grouped(from + shown.length)} of ${grouped(view.order.length)}` : "none";
  byId("place").textContent = range;
  byId("pager").hidden = pages() === 1;
  byId("table-caption").textContent = `${noun()}s ${range}`;
  const [first, last] = [pageNumber() === 0, pageNumber() === pages() - 1];
  for (const [id, off] of [["first", first], ["previous", first], ["next", last], ["last", last]]) byId(id).disabled = off;
}

/** Moves the focus to the row the keyboard is at; the page stays where it is if that is asked for. */
function focusRow(quietly = false) {
  const row = document.querySelector('#variants tbody tr[tabindex="0"]');
  if (row) row.focus({ preventScroll: quietly });
}

/** Moves the keyboard to a place in the order. */
function moveTo(place) {
  const old = pageNumber();
  view.active = Math.max(0, Math.min(place, view.order.length - 1));
  if (pageNumber() === old) {
    for (const row of document.querySelectorAll("#variants tbody tr")) {
      row.tabIndex = Number(row.dataset.variant) === view.order[view.active] ? 0 : -1;
    }
  } else {
    drawTable();
  }
}

function listenToTable() {
  const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: ROWS, PageUp: -ROWS, Home: -Infinity, End: Infinity };
  document.querySelector("#variants tbody").addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key in steps) {
      event.preventDefault();
      moveTo(view.active + steps[event.key]);
      focusRow();
    } else if ((event.key === "Enter" || event.key === " ") && view.order.length) {
      event.preventDefault();
      choose(view.order[view.active]);
      focusRow();
    }
  });
  const turn = (id, place) => byId(id).addEventListener("click", () => moveTo(place()));
  turn("first", () => 0);
  turn("previous", () => (pageNumber() - 1) * ROWS);
  turn("next", () => (pageNumber() + 1) * ROWS);
  turn("last", () => view.order.length - 1);
}
