// Starts the page, and keeps its parts in step.

/** Saves; asks for a name if the file does not exist yet. */
function save() {
  const { name, there, kind } = desk.file;
  if (there || kind !== "toml") return inTurn("save", { name: null }).then((done) => done && say("Saved."));
  return askName(name);
}

function askName(name) {
  const input = element("input", { type: "text", value: name, "aria-label": "Name of the file", size: 24 });
  const send = () => inTurn("save", { name: input.value.trim() }).then((done) => {
    if (!done) return;
    notice("name", null);
    say("Saved.");
  });
  input.addEventListener("keydown", (event) => event.key === "Enter" && send());
  notice("name", "Save as", ["Save", send], ["Not now", () => notice("name", null)]);
  byId("notice-name").firstElementChild.after(input);
  input.focus();
  input.setSelectionRange(0, name.lastIndexOf("."));
}

/** How things stand with the file: its name, what is unsaved, what others did to it. */
function showFile(file) {
  byId("name").textContent = desk.look?.file?.name ?? file.name;
  document.title = `${file.saved ? "" : "• "}${desk.look?.file?.name ?? file.name} – ozols studio`;
  const state = file.saved ? "saved" : file.there ? "not saved" : "not saved yet";
  byId("file").textContent = `${file.name} · ${state}`;
  byId("undo").disabled = !file.undo;
  byId("redo").disabled = !file.redo;
  byId("save").disabled = file.saved;
  const settle = (yes) => () => inTurn("settle", { yes });
  notice("conflict", file.conflict ? "Another program has changed the file while you changed it here. Choose which to keep; Undo returns to the other." : null,
    ["Keep mine", settle(true)], ["Take theirs", settle(false)]);
  const restore = (yes) => () => inTurn("restore", { yes });
  notice("left", file.left ? `Unsaved work from an earlier session was found (${file.left}).` : null, ["Restore it", restore(true)], ["Discard it", restore(false)]);
  notice("trouble", file.trouble);
}

const EXPORTS = [["toml", "mechanism file (TOML)"], ["json", "mechanism file (JSON)"], ["kinematic.svg", "drawing (SVG)"], ["scheme.svg", "structural scheme (SVG)"], ["urdf", "URDF"], ["mjcf", "MJCF"], ["sdf", "SDF"], ["dot", "graph (DOT)"]];

/** Hands a file of another format to the browser. */
async function exportAs(format) {
  const answer = await fetch(`export/${format}`);
  if (!answer.ok) return say((await answer.json()).refused, true);
  const name = /filename="([^"]*)"/.exec(answer.headers.get("content-disposition") ?? "")?.[1] ?? "mechanism";
  saveFile(name, await answer.blob());
  return say(`${name} is in the downloads of the browser.`);
}

const VIEWS = [["xy", "z", () => lookAt("xy")], ["xz", "y", () => lookAt("xz")], ["yz", "x", () => lookAt("yz")], ["space", "a", lookAslant]];

function tellViews() {
  for (const b of document.querySelectorAll("#views [data-plane]")) b.setAttribute("aria-pressed", b.dataset.plane === (camera.plane ?? "space"));
}

function makeViews() {
  const room = byId("views");
  for (const [plane, key, act] of VIEWS) {
    const one = button(plane === "space" ? "Space" : plane, act, plane === "space" ? "At an angle, can be turned (A)" : `Seen along ${key} (${key.toUpperCase()})`);
    one.dataset.plane = plane;
    room.append(one);
  }
  const grid = button("Grid", () => {
    camera.grid = !camera.grid;
    grid.setAttribute("aria-pressed", camera.grid);
    redraw();
  }, "Grid, numbers and scale");
  grid.setAttribute("aria-pressed", true);
  const units = element("select", { id: "unit", "aria-label": "Unit of length", title: "Unit of length; the numbers of the file are converted" }, ...Object.keys(UNITS).map((u) => element("option", {}, u)));
  const show = () => (units.value = desk.look.file?.length_unit ?? "m");
  units.addEventListener("change", () => Promise.resolve(convertTo(units.value)).then(show));
  hear("look", () => {
    show();
    units.disabled = desk.file.kind !== "toml";
  });
  room.append(button("All", fitAll, "Fit all (F)"), grid, units);
  tellViews();
}

function listenToButtons() {
  byId("new").addEventListener("click", openShelf);
  byId("undo").addEventListener("click", () => undo("undo"));
  byId("redo").addEventListener("click", () => undo("redo"));
  byId("save").addEventListener("click", () => save());
  byId("show-help").addEventListener("click", openHelp);
  const box = byId("export");
  box.append(...EXPORTS.map(([format, words]) => element("option", { value: format }, words)));
  box.addEventListener("change", () => {
    if (box.value) exportAs(box.value);
    box.value = "";
  });
}

async function begin() {
  makeSheet();
  makeViews();
  listenToPointer();
  listenToKeys();
  listenToButtons();
  listenToText();
  listenToPlayer();
  hear("file", showFile);
  hear("look", () => {
    select(selection);
    showFile(desk.file);
    showText();
    showIdeas();
    showSearch();
    tellTool();
    if (!desk.look.whole && !desk.look.partly) {
      desk.verdict = null;
      // an empty sheet stays as it is while something is put on it
      if (!takeScene.seen && isEmpty()) {
        takeScene.seen = true;
        fit();
      }
      takeScene();
      showVerdict();
    } else redraw();
  });
  hear("verdict", () => {
    if (!hand.act) endPreview();
    desk.judgedAt = performance.now();
    showVerdict();
    showIdeas();
    setTimeout(() => desk.ideas ?? showIdeas(), PATIENCE + 50);
  });
  hear("motion", () => {
    if (!hand.act && player.pulled === null) takeScene();
    showVerdict();
  });
  hear("draft", showVerdict);
  hear("ideas", showIdeas);
  for (const name of ["look", "verdict", "motion", "progress", "ideas"]) hear(name, showWork);
  for (const name of ["force", "look", "state"]) hear(name, showForce);
  for (const name of ["motion", "selection", "look", "state", "force"]) hear(name, showCurves);
  for (const name of ["look", "verdict"]) hear(name, teach);
  hear("selection", () => {
    inspect();
    followSelection();
    redraw();
  });
  await makeTools();
  tellTool();
  listenToServer();
}

begin();
