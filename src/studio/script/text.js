// The file as text, next to the drawing: changes are read at once, and every problem leads to its line.

let typing = 0;

/** Shows a line, and marks it. */
function showLine(line, upTo = line) {
  byId("text-fold").open = true;
  const field = byId("text");
  const lines = field.value.split("\n");
  const start = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0);
  const end = lines.slice(0, upTo).reduce((sum, l) => sum + l.length + 1, 0) - 1;
  field.focus({ preventScroll: true });
  field.setSelectionRange(start, Math.max(start, end));
  field.scrollTop = Math.max(0, (line - 4) * (field.scrollHeight / lines.length));
}

/** A problem: what is wrong, what to do, and where. */
function problem(t) {
  const where = t.about ? `${t.about[0]} ${listOf(t.about[0])[t.about[1]]?.id ?? t.about[1] + 1}: ` : "";
  const words = `${where}${t.words}${t.remedy ? `; ${t.remedy}` : ""}`;
  const line = t.line === null ? null : button(`line ${t.line}`, () => showLine(t.line));
  return element("li", { class: t.grave ? "bad" : null }, line, " ", words);
}

function showText() {
  const { look } = desk;
  const field = byId("text");
  const binary = look.text === null;
  field.readOnly = binary || look.desk.kind === "description";
  byId("text-room").hidden = binary;
  if (!binary && field.value !== look.text && !(document.activeElement === field && typing)) {
    const { scrollTop, selectionStart, selectionEnd } = field;
    field.value = look.text;
    field.setSelectionRange(Math.min(selectionStart, field.value.length), Math.min(selectionEnd, field.value.length));
    field.scrollTop = scrollTop;
  }
  const told = look.told.filter((t) => !t.unfinished).sort((a, b) => Number(b.grave) - Number(a.grave));
  const wrong = told.filter((t) => t.grave).length;
  byId("problems").replaceChildren(...(told.length ? [element("ul", { class: "problems", "aria-label": "Problems and doubts" }, ...told.map(problem))] : []));
  byId("text-fold").querySelector("summary").textContent = `The file${wrong ? `: ${wrong} wrong` : told.length ? `: ${told.length} doubtful` : ""}`;
}

/** Sends what is typed, once nothing was for a moment. */
function sendText() {
  clearTimeout(typing);
  if (!typing) return;
  typing = 0;
  const { value } = byId("text");
  if (value !== desk.look.text) inTurn("edit", () => ({ edits: [{ do: "text", text: value }], revision: desk.revision })).then((done) => done ?? (byId("text").value = desk.look.text));
}

function listenToText() {
  const field = byId("text");
  field.addEventListener("input", () => {
    clearTimeout(typing);
    typing = setTimeout(sendText, 350);
  });
  field.addEventListener("blur", sendText);
}

/** The lines of what is selected are in sight, where the text is open. */
function followSelection() {
  if (selection.length !== 1 || !byId("text-fold").open || document.activeElement === byId("text")) return;
  const { what, id } = selection[0];
  const n = listOf(what).findIndex((t) => t.id === id);
  const item = desk.look.items.find((i) => i[0] === what && i[1] === n);
  const field = byId("text");
  if (item) field.scrollTop = Math.max(0, (item[2] - 3) * (field.scrollHeight / field.value.split("\n").length));
}
