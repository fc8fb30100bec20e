// Mouse, pen and finger on the sheet.

/** So near, in pixels, a pin is meant; a finger is wider. */
const REACHES = { mouse: 11, pen: 13, touch: 22 };
/** A pointer that has gone so far drags; nearer by it has clicked. */
const STILL = 4;

const pointers = new Map();
const hand = { act: null, from: null, went: false, pinch: null };

/** A place on the sheet. */
function paperAt(event) {
  const { left, top } = byId("sheet").getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

/** As the parts that drag links ask for it. */
const pointed = (_, event) => paperAt(event);

/** The pin that is meant, of several the nearest. */
function pinAt(paper, kind = "mouse") {
  const near = sheetPins.map((p) => ({ p, off: Math.hypot(p.paper[0] - paper[0], p.paper[1] - paper[1]) })).sort((a, b) => a.off - b.off)[0];
  return near && near.off < (REACHES[kind] ?? 11) ? near.p : null;
}

/** All pins that are seen where one is. */
const seenWith = (pin) => sheetPins.filter((p) => Math.hypot(...minus(p.paper, pin.paper)) < 3);

/** The link that is meant, by its id. */
function linkIdAt(paper) {
  const found = player.scene && player.stress === null ? linkAt(paper) : null;
  const name = found && player.scene.names[found.link];
  // the stub of a link with one pin is as long as the picture: only the pin itself counts
  const ends = name ? pinsOf(name).map((p) => toPaper(p.at)) : [];
  if (name && !(isAtHome() && ends.every((p) => apart(p, ends[0]) < 3) && ends.length && apart(ends[0], paper) > 30)) return name;
  for (const link of looseLinks()) {
    const places = pinsOf(link.id).map((p) => toPaper(p.at));
    const round = places.length > 2 ? [...places, places[0]] : places;
    for (let i = 1; i < round.length; i += 1) {
      const d = minus(round[i], round[i - 1]);
      const t = Math.max(0, Math.min(1, dot(minus(paper, round[i - 1]), d) / (dot(d, d) || 1)));
      if (length(minus(paper, plus(round[i - 1], times(d, t)))) < 9) return link.id;
    }
  }
  return null;
}

/** The link whose plate a place is on, by its id. */
function plateAt(paper) {
  const found = listOf("link").find((l) => {
    const round = l.id === frameOf() ? [] : hull(pinsOf(l.id).map((p) => toPaper(p.at)));
    const sides = round.map((p, i) => Math.sign(turning([p, round[(i + 1) % round.length], paper])));
    return round.length > 2 && sides.every((s) => s === sides[0]);
  });
  return found?.id ?? null;
}

/** The spot of a tool: a pin, a point of a link, or an empty position, with its coordinates as written. */
function spotAt(paper, kind, free = false) {
  const deep = [...camera.centre];
  const k = depthAxis();
  deep[k] = lastDeep()[k];
  const pin = pinAt(paper, kind);
  if (pin) return { pin, link: null, at: pin.at, point: coordinatesOf(pin), guides: [], words: `at ${pin.id}` };
  const base = deep.map((x, i) => (i === k ? x : 0));
  const found = snapped(paper, { deep, base, free });
  return { ...found, link: found.pin ? null : linkIdAt(paper), plate: plateAt(paper) };
}

/** How deep the last pin was set, or most are. */
function lastDeep() {
  const all = pins();
  return (all.find((p) => isSelected(p.what, p.id)) ?? all[0])?.at ?? [0, 0, 0];
}

/** Drags a pin, with everything at its position and with its mirror image. */
function dragPin(pin) {
  const all = pinsAt(pin.at);
  const base = coordinatesOf(pin);
  // what goes along draws nothing to itself
  const images = putPins(all.map((p) => ({ ...p, point: coordinatesOf(p) }))).images;
  let [to, put] = [null, null];
  return {
    move(event) {
      to = snapped(paperAt(event), { deep: pin.at, base, without: [...all, ...images], free: event.altKey });
      put = putPins(all.map((p) => ({ ...p, to: to.at, point: to.point })));
      preview.moved = [{ from: pin.at, to: to.at }, ...put.images];
      preview.answer = null;
      tool.at = to;
      redraw();
      draft(put.edits, (value) => {
        preview.answer = value;
        byId("sheet").dataset.answered = Number(byId("sheet").dataset.answered ?? 0) + 1;
        const scene = sceneNow();
        if (scene) playOn(scene, () => [drawSheet]);
        tell("draft", value);
      });
    },
    async end() {
      endDrafts();
      tool.at = null;
      const done = put ? await change(...put.edits) : null;
      // what is seen stays until the verdict on it is there
      if (!done || desk.verdict?.revision === desk.revision) endPreview();
    },
  };
}

/** Pulls a link: the joints stay closed. */
function pullLink(event) {
  const pull = player.scene ? grasp(byId("sheet"), event) : null;
  if (!pull) return null;
  return { move: pull, end: () => (knob.home.disabled = isAtHome()) };
}

/** Turns what is seen in space, or shifts the sheet. */
function dragSheet(turns) {
  let at = null;
  return {
    move(event) {
      const now = paperAt(event);
      if (at) {
        const [dx, dy] = minus(now, at);
        if (turns) turnView(-dx * 0.01, -dy * 0.01);
        else panBy(dx, dy);
      }
      at = now;
    },
    end() {},
  };
}

function takeHold(event) {
  const paper = paperAt(event);
  const pin = pinAt(paper, event.pointerType);
  const editable = desk.file?.kind === "toml";
  if (event.button === 1 || event.button === 2) return dragSheet(event.button === 2 || camera.plane === null);
  if (tool.name !== "select") return { move() {}, end() {} };
  if (pin && editable && isAtHome()) return dragPin(pin);
  return pullLink(event) ?? dragSheet(camera.plane === null && !event.shiftKey);
}

/** A click: selects, or does what the tool does. */
function click(event) {
  const paper = paperAt(event);
  if (player.tracing) return traceAt(byId("sheet"), event);
  if (tool.name !== "select") {
    if (desk.file?.kind !== "toml") return say(readOnlyWords(), true);
    return useTool(spotAt(paper, event.pointerType, event.altKey));
  }
  const pin = pinAt(paper, event.pointerType);
  const link = pin ? null : linkIdAt(paper) ?? (isAtHome() ? plateAt(paper) : null);
  const found = pin ? [{ what: pin.what, id: pin.id }] : link ? [{ what: "link", id: link }] : [];
  if (!pin || event.shiftKey) return select(found, event.shiftKey);
  // at a place where several stand, the next click takes the next
  const all = seenWith(pin);
  const { what, id } = all[(all.findIndex((p) => isSelected(p.what, p.id)) + 1) % all.length];
  return select([{ what, id }]);
}

/** Marks the thing under the pointer. */
function hover(event) {
  if (event.pointerType === "touch") return;
  const paper = paperAt(event);
  const pin = pinAt(paper);
  const link = pin ? null : linkIdAt(paper);
  if (tool.name !== "select") tool.at = spotAt(paper, event.pointerType, event.altKey);
  Object.assign(pointedAt, { pin, link });
  byId("sheet").classList.toggle("takes", Boolean(pin || link));
  byId("sheet").title = pin ? `${pin.what} ${pin.id}` : link ? `link ${link}: drag it to move the mechanism` : "";
  redraw();
}

/** Two fingers: nearer and farther, and the sheet along. */
function pinch() {
  const [a, b] = [...pointers.values()];
  const now = { middle: times(plus(a, b), 0.5), wide: Math.max(10, length(minus(a, b))) };
  if (hand.pinch) {
    panBy(...minus(now.middle, hand.pinch.middle));
    zoomBy(now.wide / hand.pinch.wide, now.middle);
  }
  hand.pinch = now;
}

function listenToPointer() {
  const sheet = byId("sheet");
  sheet.addEventListener("contextmenu", (event) => event.preventDefault());
  sheet.addEventListener("pointerdown", (event) => {
    sheet.focus({ preventScroll: true });
    pointers.set(event.pointerId, paperAt(event));
    sheet.setPointerCapture(event.pointerId);
    if (pointers.size === 2) return Object.assign(hand, { act: null, pinch: null });
    if (pointers.size > 2) return null;
    stop();
    Object.assign(hand, { act: takeHold(event), from: paperAt(event), went: false });
    return null;
  });
  sheet.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return hover(event);
    pointers.set(event.pointerId, paperAt(event));
    if (pointers.size > 1) return pinch();
    if (!hand.act) return null;
    hand.went ||= length(minus(paperAt(event), hand.from)) > STILL;
    if (hand.went) hand.act.move(event);
    return null;
  });
  const end = (event) => {
    const { act, went } = hand;
    pointers.delete(event.pointerId);
    if (pointers.size) return null;
    Object.assign(hand, { act: null, pinch: null });
    if (event.type === "pointercancel") return act?.end?.();
    if (act && went) return act.end();
    if (act && event.button === 0) return click(event);
    return null;
  };
  for (const name of ["pointerup", "pointercancel"]) sheet.addEventListener(name, end);
  sheet.addEventListener("pointerleave", () => {
    Object.assign(pointedAt, { pin: null, link: null });
    if (tool.name !== "select") tool.at = null;
    redraw();
  });
  sheet.addEventListener("dblclick", () => finishTool());
  sheet.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomBy(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), paperAt(event));
  }, { passive: false });
}
