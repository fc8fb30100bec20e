// The verdict: W and σ, contour by contour, self-stresses and idle freedoms to be pointed at, what is meant by rounded digits.

/** Something to be pointed at, and chosen: by mouse, or by focus. */
function pointer(made, on, off, chosen = null) {
  for (const name of ["pointerenter", "focus"]) made.addEventListener(name, on);
  for (const name of ["pointerleave", "blur"]) made.addEventListener(name, off);
  if (chosen) made.addEventListener("click", chosen);
  return made;
}

const looked = (key, value) => () => {
  pointedAt[key] = value;
  redraw();
};

/** States as tabs. */
function tabs(states) {
  byId("states").hidden = states.length < 2;
  byId("states").replaceChildren(...states.map((s, n) => {
    const tab = element("button", { type: "button", role: "tab", id: `tab-${n}`, "aria-selected": n === desk.state, "aria-controls": "verdict-panel", tabindex: n === desk.state ? 0 : -1 }, `${s.state}: σ = ${s.redundant}`);
    tab.addEventListener("click", () => chooseState(n));
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      chooseState((n + step + states.length) % states.length);
      byId(`tab-${desk.state}`).focus();
    });
    return tab;
  }));
}

function chooseState(n) {
  desk.state = n;
  showVerdict();
  takeScene();
  tell("state", n);
}

function contourRows(s) {
  return s.per_contour.map((c, n) => pointer(
    element("button", { type: "button", class: "row-button" }, element("span", { class: `chip s${Math.min(c.redundant, 6)}` }, String(c.redundant)), ` ${c.contour}`, element("small", {}, ` ${c.least === c.greatest ? c.least : `${c.least} to ${c.greatest}`} in any order`)),
    looked("contour", n), looked("contour", null), () => select(c.joints.map((id) => ({ what: "joint", id })))));
}

/** The self-stress that a place in the list of the verdict has among those that are drawn, and back. */
const stressNumber = (name) => Number(/^self-stress (\d+)/.exec(name)?.[1]) - 1;
const drawnStress = (scene, n) => scene?.stresses?.findIndex((t) => stressNumber(t.name) === n) ?? -1;

function stressRows(s) {
  const scene = desk.motion?.revision === desk.verdict?.revision ? desk.motion?.scenes[desk.state] : null;
  return s.self_stresses.map((t, n) => {
    const k = drawnStress(scene, n);
    const words = k < 0 ? `borne by ${t.joints.map((j) => j.joint).join(", ")} (${t.verdict})` : scene.stresses[k].name.replace(/^self-stress \d+: /, "");
    const row = element("button", { type: "button", class: "row-button" }, words);
    return k < 0 ? row : pointer(row, looked("stress", k), looked("stress", null));
  });
}

/** Plays an idle freedom to and fro; once more to end it. */
function wiggle(n) {
  const which = player.scene?.moves.findIndex((m) => m.name.startsWith(`idle freedom ${n + 1}:`)) ?? -1;
  if (which < 0) return;
  const going = player.motion === which && player.running !== null;
  show(going ? 0 : which);
  if (!going) start();
}

const idleRows = (s) => s.idle.map((t, n) => {
  const row = element("button", { type: "button", class: "row-button" }, t.text, element("small", {}, " wiggle"));
  row.addEventListener("click", () => wiggle(n));
  return row;
});

const block3 = (head, rows, more = null) => (rows.length ? element("details", { open: rows.length <= 6 ? "" : null }, element("summary", {}, `${head} (${rows.length})`), more, element("div", { class: "rows" }, ...rows)) : null);

/** Shows what the newest verdict says, or that of a change that is tried. */
function showVerdict() {
  const value = preview.answer?.verdict ?? desk.verdict;
  Object.assign(pointedAt, { contour: null, stress: null });
  const states = value?.analysis?.states ?? [];
  if (desk.state >= states.length) desk.state = 0;
  tabs(states);
  const panel = byId("verdict-panel");
  const s = states[desk.state];
  panel.setAttribute("aria-labelledby", states.length > 1 ? `tab-${desk.state}` : "");
  if (!s) {
    const empty = "Nothing is drawn yet: take the bar (B) and click both its ends, or start from one of the mechanisms under New.";
    const why = value?.why ?? (isEmpty() ? empty : "It cannot be judged until what is wrong is mended; it stands below.");
    return panel.replaceChildren(element("p", { class: "lead" }, why));
  }
  const words = value.words[desk.state];
  const good = s.redundant === 0 && s.redundant_at_most === null;
  const figures = element("p", { class: "figures" },
    element("b", {}, `W = ${s.mobility}`), s.mobility_at_most !== null ? ` to ${s.mobility_at_most}` : "", " · ", element("b", {}, `σ = ${s.redundant}`), s.redundant_at_most !== null ? ` to ${s.redundant_at_most}` : "",
    ` · ${[["link", s.links], ["joint", s.joints], ["contour", s.contours]].map(([word, n]) => `${n} ${word}${n === 1 ? "" : "s"}`).join(", ")}`);
  const meant = s.snapped ?? [];
  const finite = s.finite_mobility === null ? `finite mobility ${s.finite_mobility_at_least} to ${s.finite_mobility_at_most}` : `finite mobility ${s.finite_mobility}`;
  return panel.replaceChildren(...[
    element("div", { class: `verdict ${good ? "good" : "bad"}` }, element("p", { class: "head" }, words.head), element("p", {}, words.text)),
    desk.look?.partly ? element("p", { class: "told" }, "Of what hangs on the frame so far; the rest is left out.") : null,
    figures,
    element("p", { class: "help", title: s.choice }, `${s.certainty}; ${finite}${s.finite_mobility_proven ? ", proven" : ""}`),
    block3("Contours", contourRows(s)),
    block3("Self-stresses", stressRows(s)),
    block3("Idle freedoms", idleRows(s)),
    meant.length ? element("details", { open: "" }, element("summary", {}, "As meant"), element("ul", { class: "notes" }, ...meant.map((m) => element("li", {}, m)))) : null,
  ].filter(Boolean));
}
