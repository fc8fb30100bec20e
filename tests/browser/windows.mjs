// The studio under test: its program, windows on it, and a hand that clicks and counts.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync } from "node:fs";
import path from "node:path";
import { browser, ozols, work } from "./pages.mjs";

export const fresh = () => mkdtempSync(path.join(work, "studio-"));

/** Starts the program; what it says of its address, and how it ends. */
export async function served(folder, ...args) {
  const child = spawn(ozols, ["studio", "--no-open", ...args], { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  child.stderr.on("data", (d) => (said += d));
  const ended = new Promise((resolve) => child.on("exit", (code, signal) => resolve({ code, signal, said })));
  const address = await new Promise((resolve, reject) => {
    let out = "";
    child.stdout.on("data", (d) => {
      out += d;
      if (out.includes("\n")) resolve(out.trim());
    });
    ended.then((e) => reject(new Error(`ended: ${e.said}`)));
  });
  assert.match(address, /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$/);
  return { child, address, ended, status: async () => (await fetch(`${address}status`)).json() };
}

/** Opens a window on it, gives it to `use`, and holds it to silence: no message, no error, nothing asked of others. */
export async function windowed(address, options, use) {
  const tab = await browser.newPage({ viewport: { width: 1300, height: 900 }, ...options });
  const noise = [];
  let bytes = 0;
  const slow = /GPU stall due to ReadPixels/;
  // who ends the program hears of it from the browser, too
  const ending = /net::ERR|Failed to load resource/;
  tab.on("console", (m) => slow.test(m.text()) || (options.ends && ending.test(m.text())) || noise.push(`console ${m.type()}: ${m.text()}`));
  tab.on("pageerror", (e) => noise.push(`error: ${e.message}`));
  tab.on("dialog", (d) => {
    noise.push(`dialog: ${d.message()}`);
    d.dismiss();
  });
  tab.on("request", (r) => /^(data|blob):/.test(r.url()) || r.url().startsWith(address) || noise.push(`request: ${r.url()}`));
  tab.on("response", async (r) => {
    const length = Number(r.headers()["content-length"] ?? 0);
    bytes += length;
  });
  await tab.goto(address);
  await tab.waitForSelector("#types button");
  await use(tab, () => bytes);
  assert.deepEqual(noise, []);
  await tab.close();
}

export const ideas = (tab) => tab.waitForSelector(".idea");
export const source = (tab) => tab.locator("#text").inputValue();
export const verdict = (tab) => tab.locator("#verdict-panel").innerText();
export const told = (tab, words) => tab.waitForFunction((w) => document.body.innerText.includes(w), words);

/** Waits for what was asked last. A promise that is awaited from outside may be collected, so that the page notes when it is kept. */
export const settledOn = async (tab) => {
  await tab.evaluate(() => {
    const asked = { kept: false }, keep = () => { asked.kept = true; };
    globalThis.asked = asked;
    last.then(keep, keep);
  });
  await tab.waitForFunction(() => globalThis.asked.kept);
};

/** A hand that counts: clicks on places of the file's coordinates, on buttons, and keys. */
export function handOn(tab, zoom = 4) {
  const count = { clicks: 0 };
  const at = async (x, y) => {
    // On a small screen a form below may have scrolled it away.
    await tab.locator("#sheet").scrollIntoViewIfNeeded();
    const b = await tab.locator("#sheet").boundingBox();
    return [b.x + b.width / 2 + zoom * x, b.y + b.height / 2 - zoom * y];
  };
  const settled = () => settledOn(tab);
  return {
    count,
    at,
    settled,
    async place(x, y) {
      count.clicks += 1;
      const [a, b] = await at(x, y);
      await tab.mouse.move(a, b);
      await tab.mouse.click(a, b);
      await settled();
    },
    async press(selector) {
      count.clicks += 1;
      await tab.locator(selector).first().click();
      await settled();
    },
    /** Types into a field of the selection. */
    async fill(label, text) {
      count.clicks += 1;
      const field = tab.locator(`#thing input[aria-label="${label}"]`).first();
      await field.fill(text);
      await field.press("Enter");
      await settled();
    },
    /** Does something with a key held. */
    async key(name, act) {
      await tab.keyboard.down(name);
      await act();
      await tab.keyboard.up(name);
    },
    tool(name) {
      return this.press(`[data-tool="${name}"]`);
    },
  };
}

/** Draws a gripper of six links: a slide, two rods, two jaws whose tips are at x = `tip`, a frame. The jaws are outputs. */
export async function drawGripper(hand, tip) {
  const middle = (10 + tip) / 2;
  await hand.tool("slide");
  await hand.place(-40, 0);
  await hand.tool("bar");
  await hand.place(-40, 0);
  await hand.place(-10, 30);
  await hand.tool("plate");
  for (const [x, y] of [[-10, 30], [10, 15], [tip, 10], [tip, 10]]) await hand.place(x, y);
  await hand.tool("ground");
  await hand.place(10, 15);
  await hand.tool("output");
  await hand.place(middle, 12.5);
  await hand.tool("drive");
  await hand.place(-40, 0);
  await hand.tool("select");
  await hand.place(-25, 15);
  await hand.key("Shift", () => hand.place(middle, 12.5));
  await hand.press('.acts button:has-text("Mirror y")');
}
