// The text about the chosen variant.

/** The list of changes, each with the symbol that is put in. */
function changeList(changes) {
  const list = element("ul", { class: "changes" });
  for (const c of changes) {
    const from = `${c.id}: ${c.from}`;
    const item = element("li", {});
    const state = page.swaps.findIndex((_, n) => swapOf(n, c));
    if (state >= 0) {
      const picture = svgElement("svg", { class: "ozd", viewBox: "-19 -19 38 38", width: 30, height: 30, "aria-hidden": "true" });
      picture.append(...symbolOf(state, swapOf(state, c)));
      item.append(picture);
    }
    const classes = c.classes.every(Boolean) ? ` (class ${c.classes.join(" → ")})` : "";
    item.append(element("span", {}, from, " → ", element("b", {}, c.to), classes));
    list.append(item);
  }
  return list;
}

function table(caption, heads, rows) {
  const head = element("tr", {}, ...heads.map((h, n) => element("th", { scope: "col", class: n ? "n" : null }, h)));
  const body = rows.map((r) =>
    element("tr", {}, ...r.map((cell, n) => element(n ? "td" : "th", n ? { class: "n" } : { scope: "row" }, cell))));
  const made = element("table", {}, element("caption", {}, caption, " "), element("thead", {}, head), element("tbody", {}, ...body));
  made.caption.append(copyButton(() => rowsOf(made)));
  return element("div", { class: "wide", tabindex: 0, role: "group", "aria-label": caption }, made);
}

/** An idea in a few words. */
function ideaWords(i) {
  const n = found.stands_for[i];
  const least = found.exact ? "" : "at least ";
  const stands = n === "1" ? (found.exact ? "represents only itself" : "represents at least itself") : `represents ${least}${grouped(n)} variants, and is closest to the original`;
  return `${inWords(i).replace(/^[^:]*: /, "")}; ${stands}`;
}

/** The terminal's explanation of an idea, or what it adds if there is none. */
function whyList(i) {
  if (!byIdeas()) return null;
  const rows = found.why[i] && found.why[i].length ? found.why[i] : [["adds", found.adds[i] || "nothing"]];
  const each = rows.flatMap(([what, words]) => [element("dt", {}, what.replace(/^./, (c) => c.toUpperCase())), element("dd", {}, words)]);
  return element("dl", { class: "why" }, ...each);
}

/** W and σ in every state, now and then. */
function figureTable(i) {
  const free = figures(i, 0).redundant;
  const rows = page.states.map((now, s) => {
    const { mobility, redundant } = figures(i, s);
    const external = s === 0 ? "" : `${now.external ?? ""} → ${redundant - free}`;
    const row = [now.name, `${now.mobility} → ${mobility}`, `${now.redundant} → ${redundant}`];
    return page.states.length > 1 ? [...row, external] : row;
  });
  const heads = ["state", "mobility W", "redundant σ"];
  return table("As it is → with the changes", page.states.length > 1 ? [...heads, "external σ"] : heads, rows);
}

/** A figure with a bar of its share. */
function bar(share) {
  if (share === null || share === undefined) return "";
  const box = element("span", { class: share > 1 ? "bar over" : "bar" }, percent(share));
  box.style.setProperty("--share", `${Math.min(100, 100 * share)}%`);
  return box;
}

function loadTable(i) {
  if (!work || !work.force[i]) return null;
  const rows = [];
  page.joints.forEach((joint, j) => {
    if (work.force[i][j] === null) return;
    rows.push([
      joint.id,
      short(work.force[i][j]),
      bar(work.force_share[i][j]),
      short(work.moment[i][j]),
      bar(work.moment_share[i][j]),
    ]);
  });
  const poses = work.poses > 1 ? `the most over ${work.poses} poses` : "at the pose of the file";
  const norm = work.minimum_norm[i] ? "; redundant constraints leave them open, these are of minimum norm" : "";
  const heads = ["joint", "force, N", "of capacity", "moment, N·m", "of capacity"];
  return table(`Loads of the joints, ${poses}${norm}`, heads, rows);
}

/** Remarks on the variant. */
function remarks(i) {
  const out = [];
  const idle = found.idle_words[found.idle_word[i]];
  if (idle) out.push(`Idle: ${idle}.`);
  if (found.conditioning[i] !== null) {
    out.push(`Conditioning ${power(found.conditioning[i])}: the smallest singular value over the largest; the nearer to 0, the nearer to a singular pose.`);
  }
  if (found.notes[i]) out.push(found.notes[i].replace(/^(\S) \d+: /, "Take care: "));
  if (work) {
    if (work.peak_force[i] === null) out.push("No equilibrium: the loads move an idle freedom.");
    else {
      out.push(`Peak force ${percent(work.peak_force[i])} and peak moment ${percent(work.peak_moment[i])} of what a joint bears; output error ${short(work.output_error_mm[i])} mm from clearances.`);
    }
    const { ranked } = work;
    if (ranked && ranked.reason[i]) out.push(`${ranked.reason[i].replace(/^rank \d+ was /, "")}.`);
    else if (ranked && ranked.by_cost[i] !== null) out.push(`Number ${ranked.by_cost[i]} by cost.`);
  }
  return out.map((t) => element("p", { class: "note" }, t));
}

function showAsItIs() {
  byId("chosen-head").textContent = "The original mechanism";
  byId("chosen-words").textContent = "Nothing is chosen: choose a row in the table or the chart to see what it changes.";
  byId("chosen-changes").replaceChildren();
  byId("chosen-more").replaceChildren();
}

/** Scrolls the pictures into view if they are not next to the table. */
function reveal() {
  if (matchMedia("(min-width: 64rem)").matches) return;
  const less = matchMedia("(prefers-reduced-motion: reduce)").matches;
  byId("stage").scrollIntoView({ block: "start", behavior: less ? "auto" : "smooth" });
}

/** Chooses a variant, or none for null. */
function choose(i) {
  view.chosen = i;
  for (const row of document.querySelectorAll("#variants tbody tr[data-variant]")) {
    row.setAttribute("aria-selected", Number(row.dataset.variant) === i);
  }
  if (i === null) {
    showAsItIs();
  } else {
    const changes = changesOf(i);
    byId("chosen-head").textContent = `${noun()} ${i + 1}`;
    byId("chosen-words").textContent = byIdeas() ? `${ideaWords(i)}.` : `${inWords(i)}.`;
    byId("chosen-changes").replaceChildren(changeList(changes));
    const more = [whyList(i), figureTable(i), ...remarks(i), loadTable(i)];
    for (const [what, command] of byIdeas() ? page.idea_commands : page.variant_commands) {
      more.push(element("p", { class: "help" }, `${what}: `, element("code", {}, command.replaceAll("{}", i + 1))));
    }
    byId("chosen-more").replaceChildren(...more.filter(Boolean));
  }
  draw(i);
  markPoint();
}
