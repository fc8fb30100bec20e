// Pages written by the program under test, and a browser that notes everything a page should not do.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { deflateSync, inflateSync } from "node:zlib";

export const root = path.resolve(import.meta.dirname, "../..");
const target = path.resolve(root, process.env.CARGO_TARGET_DIR ?? "target");
export const work = path.join(target, "browser");
const { chromium } = createRequire(path.join(work, "package.json"))("playwright-core");
export const ozols = process.env.OZOLS ?? path.join(target, "debug/ozols");

/** Writes a page of the arguments' report, and gives its path. */
export function report(name, ...args) {
  const file = path.join(work, `${name}.html`);
  execFileSync(ozols, ["report", "--quiet", ...args, "-o", file], { stdio: ["ignore", "ignore", "pipe"], cwd: root });
  return file;
}

/** Builds a catalogue of the arguments and writes its page, and gives the page's path. */
export function catalogue(name, ...args) {
  const [db, file] = [path.join(work, `${name}.db`), path.join(work, `${name}.html`)];
  rmSync(db, { force: true });
  const run = (...words) => execFileSync(ozols, ["catalog", ...words], { stdio: ["ignore", "ignore", "pipe"], cwd: root });
  run("build", "--quiet", ...args, "-o", db);
  run("page", db, "-o", file);
  return file;
}

/** Makes a page of so many cards of a catalogue's, each many times under names and with figures of its own; gives its path. */
export function multiplied(file, count) {
  const html = readFileSync(file, "utf8");
  const [before, begin] = [html.indexOf('<script id="data"'), html.indexOf(">", html.indexOf('<script id="data"')) + 1];
  const end = html.indexOf("</script>", begin);
  assert.ok(before > 0 && end > begin);
  const data = JSON.parse(html.slice(begin, end));
  const unpacked = (list) => JSON.parse(inflateSync(Buffer.from(list, "base64")));
  const packed = (list) => deflateSync(JSON.stringify(list)).toString("base64");
  const [own, chosen] = [unpacked(data.cards), data.chosen.flatMap(unpacked)];
  const each = Array.from({ length: count }, (_, i) => i % own.length);
  data.cards = packed(each.map((k, i) => ({ ...own[k], id: `${own[k].id}-${i}`, force_min: ((i * 7919) % count) / 100 })));
  const parts = Array.from({ length: Math.ceil(count / data.together) }, (_, p) => each.slice(p * data.together, (p + 1) * data.together));
  data.chosen = parts.map((part) => packed(part.map((k) => chosen[k])));
  const many = file.replace(".html", `-${count}.html`);
  writeFileSync(many, html.slice(0, begin) + JSON.stringify(data).replaceAll("<", "\\u003c") + html.slice(end));
  return many;
}

export const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox"],
});

/** Opens a file, gives the page to `use`, and holds it to silence: no message, no error, no request but the file. */
export async function open(file, options, use) {
  const tab = await browser.newPage({ viewport: { width: 1360, height: 950 }, ...options });
  const noise = [];
  const address = pathToFileURL(file).href;
  tab.on("console", (m) => noise.push(`console ${m.type()}: ${m.text()}`));
  tab.on("pageerror", (e) => noise.push(`error: ${e.message}`));
  tab.on("dialog", (d) => {
    noise.push(`dialog: ${d.message()}`);
    d.dismiss();
  });
  tab.on("request", (r) => {
    if (r.url() !== address) noise.push(`request: ${r.url()}`);
  });
  const begun = performance.now();
  await tab.goto(address);
  // The cards of a catalogue are unpacked.
  if (await tab.locator("#cards").count()) await tab.locator("#cards .card").first().waitFor();
  const took = Math.round(performance.now() - begun);
  await use(tab, took);
  assert.deepEqual(noise, [], file);
  await tab.close();
}

/** A picture for people to look at. */
export const picture = (tab, name, fullPage = true) =>
  tab.screenshot({ path: path.join(work, `${name}.png`), fullPage });

/** The body may not scroll sideways. */
export async function fits(tab) {
  const [content, room] = await tab.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(content <= room, `${content} pixels of content in ${room}`);
}

/** The texts of a column of the rows shown. */
export const column = (tab, key) =>
  tab.evaluate((wanted) => {
    const heads = [...document.querySelectorAll("#variants thead th")];
    const at = heads.findIndex((h) => h.dataset.key === wanted);
    return [...document.querySelectorAll("#variants tbody tr")].map((r) => r.children[at].textContent);
  }, key);
