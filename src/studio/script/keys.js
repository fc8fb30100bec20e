// All of it by keyboard.

/** The keys in the help. */
const KEYS = [
  [Object.values(TOOLS).map((t) => t.key.toUpperCase()).join(" "), `tools: ${Object.values(TOOLS).map((t) => t.name).join(", ").toLowerCase()}`],
  ["arrow keys", "move the cursor (with a tool) or the selection by one grid step; with Shift by five"],
  ["Enter", "places a point at the cursor; a second time ends a plate"],
  ["Escape", "cancels the points, the tool or the selection; returns the mechanism to its drawn pose"],
  ["Tab, Shift+Tab with Ctrl", "the next thing, the one before: use ] and [ where the browser keeps these"],
  ["Delete", "deletes what is selected"],
  ["M", "mirrors what is selected, first across the paper; Shift+M upside down"],
  ["Ctrl+D", "duplicates the selection"],
  ["Ctrl+Z, Ctrl+Y", "undo and redo (unlimited)"],
  ["Ctrl+S", "saves"],
  ["1 to 9", "applies an idea from the list"],
  ["Space", "plays or stops the motion"],
  ["X Y Z", "view along that axis; A free view, F fit, + and - zoom"],
  ["Shift with the arrow keys and A", "at an angle, the arrow keys turn when nothing is selected"],
  ["N", "new: start from an example or a file"],
  ["Alt while drawing", "no snapping"],
];

function openHelp() {
  const dialog = byId("help");
  if (!dialog.childElementCount) {
    const rows = KEYS.map(([keys, words]) => element("div", {}, element("dt", {}, keys), element("dd", {}, words)));
    dialog.append(element("div", { class: "dialog-head" }, element("h2", { id: "help-head" }, "Keys"), button("Close", () => dialog.close())), element("dl", { class: "keys" }, ...rows));
  }
  dialog.showModal();
}

/** Moves the cross of a tool, or what is selected, or turns what is seen. */
function arrows(dx, dy) {
  if (tool.name !== "select") {
    const step = gridStep();
    const from = tool.at ? toPaper(tool.at.at) : middleOf();
    const grid = fromPaper(from, lastDeep());
    const to = plus(grid, plus(times(camera.view[0], dx * step), times(camera.view[1], dy * step)));
    tool.at = spotAt(toPaper(to), "pen");
    // a cross that is drawn back could never leave a pin
    if (apart(tool.at.at, tool.at.pin ? grid : to) > touching() && apart(tool.at.at, grid) < touching()) {
      const at = to.map((x) => rounded(x, step));
      tool.at = { pin: null, link: linkIdAt(toPaper(at)), at, point: at, guides: [], words: "" };
    }
    say(tool.at.point.map(shown).join(", "));
    redraw();
  } else if (selection.length && desk.file?.kind === "toml") {
    goHome();
    nudge(dx, dy);
  } else if (camera.plane === null) turnView(-dx * 0.17, dy * 0.17);
  else panBy(-40 * dx, 40 * dy);
}

function letGo() {
  if (tool.spots.length) tool.spots = [];
  else if (tool.name !== "select") takeTool("select");
  else if (!isAtHome()) goHome();
  else select([]);
  redraw();
}

const undo = (which) => inTurn(which, {});

/** The spot under the cross; something may be new there. */
function crossNow() {
  if (!tool.at) return spotAt(middleOf(), "pen");
  const again = spotAt(toPaper(tool.at.at), "pen");
  return apart(again.at, tool.at.at) < touching() ? again : tool.at;
}

const SHEET_KEYS = {
  ArrowLeft: (e) => arrows(e.shiftKey ? -5 : -1, 0),
  ArrowRight: (e) => arrows(e.shiftKey ? 5 : 1, 0),
  ArrowUp: (e) => arrows(0, e.shiftKey ? 5 : 1),
  ArrowDown: (e) => arrows(0, e.shiftKey ? -5 : -1),
  Enter: () => (tool.name !== "select" ? useTool(crossNow()) : null),
  "]": () => selectNext(1),
  "[": () => selectNext(-1),
};

const KEYED = {
  Escape: letGo,
  Delete: deleteSelection,
  Backspace: deleteSelection,
  m: () => mirrorSelection(paperAxes()[0]),
  M: () => mirrorSelection(paperAxes()[1]),
  " ": () => (player.scene ? (player.running === null ? start() : stop()) : null),
  x: () => lookAt("yz"),
  y: () => lookAt("xz"),
  z: () => lookAt("xy"),
  a: lookAslant,
  f: fitAll,
  "+": () => zoomBy(1.25),
  "=": () => zoomBy(1.25),
  "-": () => zoomBy(0.8),
  n: openShelf,
  "?": openHelp,
};
const HELD = { z: () => undo("undo"), y: () => undo("redo"), Z: () => undo("redo"), s: () => save(), d: copySelection };

function listenToKeys() {
  addEventListener("keydown", (event) => {
    const writes = event.target.matches?.("input, textarea, select");
    if (document.querySelector("dialog[open]")) return;
    const held = event.ctrlKey || event.metaKey;
    // the text field has its own undo while it has the focus
    if (held && !event.altKey && event.key in HELD && (!writes || event.key === "s")) {
      event.preventDefault();
      sendText();
      HELD[event.key]();
      return;
    }
    if (writes || held || event.altKey) return;
    const onSheet = document.activeElement === byId("sheet") || document.activeElement === document.body;
    const tooled = Object.entries(TOOLS).find(([, t]) => t.key === event.key.toLowerCase() && !event.shiftKey);
    const idea = /^[1-9]$/.test(event.key) && desk.ideas?.found?.variants[Number(event.key) - 1];
    const pressed = event.target.matches?.("button, summary") && [" ", "Enter"].includes(event.key);
    if (pressed) return;
    if (onSheet && event.key in SHEET_KEYS) SHEET_KEYS[event.key](event);
    else if (tooled) takeTool(tooled[0]);
    else if (idea) takeIdea(Number(event.key) - 1);
    else if (event.key in KEYED) KEYED[event.key](event);
    else return;
    event.preventDefault();
  });
}
