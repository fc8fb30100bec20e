// The verdict: W and σ, contour by contour, self-stresses and idle freedoms to be pointed at, what is meant by rounded digits.

/** Something to be pointed at, and chosen: by mouse, or by focus. */
function pointer(made, key, value, chosen = null) {
  for (const [name, seen] of [["pointerenter", value], ["focus", value], ["pointerleave", null], ["blur", null]]) {
    made.addEventListener(name, () => {
      pointedAt[key] = seen;
      redraw();
    });
  }
  return chosen ? acted(made, chosen) : made;
}

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
    element("button", { type: "button", class: "row-button" }, element("span", { class: `chip s${Math.min(c.redundant, 6)}` }, String(c.redundant)), ` ${c.contour}`, element("small", {}, ` ${c.least === c.greatest ? c.least : `${c.least} to ${c.greatest}`} in any loop order`)),
    "contour", n, () => select(c.joints.map((id) => ({ what: "joint", id })))));
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
    return k < 0 ? row : pointer(row, "stress", k);
  });
}

/** Plays an idle freedom, or ends it. */
function wiggle(n) {
  const which = player.scene?.moves.findIndex((m) => m.name.startsWith(`idle freedom ${n + 1}:`)) ?? -1;
  if (which < 0) return;
  const going = player.motion === which && player.running !== null;
  show(going ? 0 : which);
  if (!going) start();
}

const idleRows = (s) => s.idle.map((t, n) => acted(element("button", { type: "button", class: "row-button" }, t.text, element("small", {}, " wiggle")), () => wiggle(n)));

const block3 = (head, rows, more = null) => (rows.length ? element("details", { open: rows.length <= 6 ? "" : null }, element("summary", {}, `${head} (${rows.length})`), more, element("div", { class: "rows" }, ...rows)) : null);

/** Whether nothing can be redundant in a state, as no loop is closed and no coupling holds it. */
const isOpen = (s) => s.contours === 0 && s.redundant === 0 && !s.per_coupling?.length;

/** Steps that complete a drawing, with a button for each free end; empty if it is complete. */
function nextSteps(s) {
  if (desk.file?.kind !== "toml" || !desk.look?.file) return [];
  if (isEmpty()) return [element("p", { class: "lead" }, "Nothing drawn yet. Choose Bar (B) and click two points, or start from an example or the tutorial under New.")];
  const frame = frameOf();
  const loose = looseLinks().filter((l) => l.role !== "object").map((l) => l.id);
  const ends = listOf("point").filter((p) => isEnd(p.id));
  const joined = listOf("joint").some((j) => j.links.includes(frame));
  const next = [];
  if (!joined) next.push("Join the drawing to the frame: pin one end, or click it with Frame pin (G).");
  else if (loose.length) next.push(`Join link ${loose.join(", ")} to the rest: draw a bar from pin to pin (B), or pin it to the frame (G).`);
  else if (!s || isOpen(s)) next.push(ends.length ? "Close the loop: pin a free end to the frame, or draw a bar from it (B)." : "Go on: draw a bar from the last link (B).");
  else {
    if (s.mobility > 0 && !listOf("joint").some((j) => j.drive)) next.push("Choose the drive: take Drive (D) and click the joint that the motor moves.");
    if (!listOf("link").some((l) => l.role === "output")) next.push("Choose the output: take Output (O) and click the link whose motion counts.");
  }
  const pinned = (p) => {
    const spot = { pin: pins().find((q) => q.what === "point" && q.id === p.id), link: null, at: placeOf("point", p.id), point: p.point };
    return pointer(button(`Pin ${p.id} to the frame`, () => ground(spot)), "pin", spot.pin);
  };
  const buttons = !s || isOpen(s) || loose.length ? ends.slice(0, 4).map(pinned) : [];
  return next.length ? [element("div", { class: "next" }, ...next.map((words) => element("p", {}, words)), element("div", { class: "acts" }, ...buttons))] : [];
}

function stopSearch({ target }) {
  target.disabled = true;
  desk.stoppedAt = desk.revision;
  return post("stop", {});
}

/** Shows the stages of work under way: words, the share done if it is known, and a button that stops it. */
function showWork() {
  const { look, verdict, motion, ideas, progress: p, revision } = desk;
  const judged = verdict?.revision === revision;
  const searched = p?.nodes !== undefined ? `Searching: joint ${p.done} of ${p.of}, ${grouped(p.nodes)} nodes` : p?.of ? `Ranking: branch ${p.done} of ${p.of}` : p ? "Listing the ideas" : "Searching";
  const stages = {
    judge: !judged && (look?.whole || look?.partly) ? "Analysing the mechanism" : null,
    motion: judged && verdict.analysis && motion?.revision !== revision ? "Computing the motion" : null,
    search: judged && verdict.analysis && !ideas ? searched : null,
  };
  const room = byId("work");
  for (const [stage, words] of Object.entries(stages)) {
    let row = room.querySelector(`[data-stage="${stage}"]`);
    if (words === null) row?.remove();
    else {
      if (!row) {
        row = element("div", { class: "stage", "data-stage": stage }, element("span", {}), element("progress", { "aria-label": stage }), stage === "search" ? button("Stop", stopSearch, "End the search with what it has found") : "");
        room.append(row);
      }
      row.firstChild.textContent = words;
      const bar = row.querySelector("progress");
      if (stage === "search" && p?.of) [bar.max, bar.value] = [p.of, p.done];
      else bar.removeAttribute("value");
    }
  }
}

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
    const wrong = (desk.look?.told ?? []).some((t) => t.grave);
    const why = value?.why ?? (wrong ? "Fix the problems listed below to see the verdict." : "");
    return panel.replaceChildren(...(why ? [element("p", { class: "lead" }, why)] : nextSteps(null)));
  }
  const open = isOpen(s);
  const words = open ? { head: "No closed loop yet", text: `It has ${s.mobility} degree${s.mobility === 1 ? "" : "s"} of freedom. Only a closed loop can have redundant constraints.` } : value.words[desk.state];
  const good = s.redundant === 0 && s.redundant_at_most === null;
  const colour = open || desk.look?.partly ? "" : good ? " good" : " bad";
  const figures = element("p", { class: "figures" },
    element("b", {}, `W = ${s.mobility}`), s.mobility_at_most !== null ? ` to ${s.mobility_at_most}` : "", " · ", element("b", {}, `σ = ${s.redundant}`), s.redundant_at_most !== null ? ` to ${s.redundant_at_most}` : "",
    ` · ${[["link", s.links], ["joint", s.joints], ["contour", s.contours]].map(([word, n]) => `${n} ${word}${n === 1 ? "" : "s"}`).join(", ")}`);
  const meant = s.snapped ?? [];
  const finite = s.finite_mobility === null ? `finite mobility ${s.finite_mobility_at_least} to ${s.finite_mobility_at_most}` : `finite mobility ${s.finite_mobility}`;
  return panel.replaceChildren(...[
    element("div", { class: `verdict${colour}` }, element("p", { class: "head" }, words.head), element("p", {}, words.text)),
    ...nextSteps(s),
    ...(open ? [] : [figures, element("p", { class: "help", title: s.choice }, `${s.certainty.replace(" (--certificate)", "")}; ${finite}${s.finite_mobility_proven ? ", proven" : ""}`)]),
    block3("Contours", contourRows(s)),
    block3("Self-stresses", stressRows(s)),
    block3("Idle freedoms", idleRows(s)),
    meant.length ? element("details", { open: "" }, element("summary", {}, "As meant"), element("ul", { class: "notes" }, ...meant.map((m) => element("li", {}, m)))) : null,
  ].filter(Boolean));
}
