// The page of a catalogue whose grippers have slides, gears and slots.

import assert from "node:assert/strict";
import { catalogue, fits, open, picture } from "./pages.mjs";

export function pairTests(test) {
  const known = catalogue("known", "--classics", "--ideas", "2");
  const some = catalogue("pairs", "--pairs", "slide,gear,slot", "--at-most", "2", "--symmetry", "mirror,half-turn", "--links", "4..6", "--ideas", "1");
  const three = catalogue("three", "--jaws", "3", "--pairs", "slide,gear,slot", "--symmetry", "threefold", "--links", "5..8", "--at-most", "2", "--ideas", "1");
  const free = catalogue("free", "--jaws", "3", "--pairs", "slide,gear,slot", "--generic-pairs", "--symmetry", "generic", "--links", "4", "--at-most", "2", "--ideas", "1");
  const cards = (tab) => tab.locator("#cards .card");

  test("slides, slots and gears hold all the way from open to closed", async () => {
    for (const [file, least] of [[known, 30], [some, 100], [three, 50], [free, 80]]) {
      await open(file, {}, async (tab) => {
        const [count, wrong] = await tab.evaluate(() => {
          const out = [];
          for (const c of data.cards) {
            const frames = framesOf(c), d = c.drawing;
            if (frames.length < 10) { out.push([c.id, frames.length]); continue; }
            // Of three jaws twice their distance from the middle, each along its own line.
            const along = (t, [x, y]) => (t[0] * x + t[1] * y) / Math.hypot(x, y);
            const opening = frames.map(({ tips }) => (tips.length === 2 ? Math.abs(tips[0][1] - tips[1][1]) : (2 / 3) * tips.reduce((sum, t, n) => sum + along(t, d.tips[n]), 0)) / d.scale);
            const step = 2 * Math.max(...opening.slice(1).map((w, i) => Math.abs(w - opening[i])));
            if (Math.abs(opening[0] - c.opening_max) > step || Math.abs(opening.at(-1) - c.opening_min) > step) out.push([c.id, opening[0], opening.at(-1)]);
            for (const { pose } of frames) {
              // A link by complex numbers: where the point z is that was drawn there.
              const turn = (l) => pose[3 * l + 2], cos = (l) => Math.cos(turn(l)), sin = (l) => Math.sin(turn(l));
              const dir = (l, [x, y]) => [cos(l) * x - sin(l) * y, sin(l) * x + cos(l) * y];
              const on = (l, p) => { const [x, y] = dir(l, p); return [x + pose[3 * l], y + pose[3 * l + 1]]; };
              const miss = (what, x) => { if (!(Math.abs(x) < 1e-6)) out.push([c.id, what, x]); };
              const rate = (i) => {
                const [a, b] = d.ends[i], p = on(a, d.pins[i]), q = on(b, d.pins[i]), u = dir(a, d.along[i]);
                return d.kinds[i] === "slide" ? (q[0] - p[0]) * u[0] + (q[1] - p[1]) * u[1] : turn(b) - turn(a);
              };
              for (let k = 0; k < 3; k += 1) miss("frame", pose[3 * d.frame + k]);
              d.kinds.forEach((kind, i) => {
                const [a, b] = d.ends[i], p = on(a, d.pins[i]), q = on(b, d.pins[i]);
                if (kind === "hinge") { miss("hinge", p[0] - q[0]); miss("hinge", p[1] - q[1]); return; }
                if (kind === "slide") miss("guide", turn(a) - turn(b));
                // The slot is in the second link.
                const u = dir(b, d.along[i]);
                miss(kind, (p[0] - q[0]) * u[1] - (p[1] - q[1]) * u[0]);
              });
              for (const g of d.gears) miss("gear", rate(g.joints[1]) - g.ratio * rate(g.joints[0]));
            }
          }
          return [data.cards.length, out.slice(0, 20)];
        });
        assert.deepEqual(wrong, []);
        assert.ok(count >= least, `${count}`);
      });
    }
  });

  test("pitch circles touch, and every pair is drawn", async () => {
    await open(known, {}, async (tab) => {
      await fits(tab);
      await picture(tab, "catalogue-known", false);
      const wrong = await tab.evaluate(() => {
        const out = [], of = new Map(data.cards.map((c) => [c.id, c]));
        for (const card of document.querySelectorAll("#cards .card")) {
          const d = of.get(card.dataset.id).drawing, count = (kind) => d.kinds.filter((k) => k === kind).length;
          for (const [sign, n] of [[".block", count("slide")], [".guide", count("slide")], [".slot", count("slot")], [".pin", d.kinds.length - count("slide")], [".gear", 2 * d.gears.length]]) {
            if (card.querySelectorAll(sign).length !== n) out.push([card.dataset.id, sign, n]);
          }
          const box = card.querySelector("svg").viewBox.baseVal;
          for (const g of card.querySelectorAll("circle.gear")) {
            const [x, y, r] = ["cx", "cy", "r"].map((k) => g[k].baseVal.value);
            if (x - r < box.x || y - r < box.y || x + r > box.x + box.width || y + r > box.y + box.height) out.push([card.dataset.id, "a pitch circle is cut off"]);
          }
          for (const g of d.gears.filter((g) => !g.thread)) {
            const far = (i) => Math.hypot(g.pitch[0] - d.pins[i][0], g.pitch[1] - d.pins[i][1]);
            const [i, j] = g.joints, rolls = d.kinds[i] === "slide" ? Math.abs(1 / g.ratio) - far(j) : d.kinds[j] === "slide" ? Math.abs(g.ratio) - far(i) : Math.abs(g.ratio) - far(i) / far(j);
            if (Math.abs(rolls) > 1e-9) out.push([card.dataset.id, "teeth", rolls]);
          }
        }
        return out;
      });
      assert.deepEqual(wrong, []);
    });
  });

  test("a scheme is found by its name", async () => {
    await open(known, {}, async (tab) => {
      await tab.fill("#find", "wedge-hook");
      await tab.waitForFunction(() => document.querySelectorAll("#cards .card").length === 1);
      assert.match(await cards(tab).first().innerText(), /^Wedge hook$/m);
      await cards(tab).first().click();
      assert.match(await tab.locator("#chosen dl").innerText(), /wedge-hook/);
      await picture(tab, "catalogue-wedge", false);
    });
  });
}
