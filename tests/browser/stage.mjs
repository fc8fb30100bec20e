// The stage: the mechanism as built beside the verdict, what is chosen beside it, and what a reader may take along.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { open, picture, report } from "./pages.mjs";

const box = (tab, selector) => tab.locator(selector).first().boundingBox();
/** Whether a box is seen whole. */
const inside = (b, { width, height }) => b.x >= 0 && b.y >= 0 && b.x + b.width <= width && b.y + b.height <= height;

export function stageTests(test, { gripper, loaded }) {
  test("the mechanism stands beside the verdict, what is chosen beside it, and the controls below them", async () => {
    const viewport = { width: 1300, height: 900 };
    const pages = [gripper, loaded, report("bennett-stage", "bennett"), report("delta-stage", "delta"), report("leg-stage", "tests/data/robots/leg.urdf")];
    for (const file of pages) {
      for (const colorScheme of ["light", "dark"]) {
        await open(file, { viewport, colorScheme }, async (tab) => {
          const [verdict, built] = [await box(tab, "#verdict"), await box(tab, "#built svg")];
          assert.ok(built.x >= verdict.x + verdict.width && built.y < verdict.y + verdict.height, "beside");
          assert.ok(inside(built, viewport) && built.height > 100, JSON.stringify(built));
          if (await tab.locator("#drawing").isVisible()) {
            const chosen = await box(tab, "#drawing svg");
            assert.ok(inside(chosen, viewport) && chosen.x >= built.x + built.width, "beside");
            assert.ok(Math.abs(chosen.y - built.y) < 1 && Math.abs(chosen.width - built.width) < 1, "side by side");
            if (await tab.locator(".changes li").count()) assert.ok((await tab.locator("#drawing .changed").count()) > 0, "changes are marked");
            assert.equal(await tab.locator("#built .changed").count(), 0);
          }
          if (await tab.locator('[data-part="range"]').isVisible()) assert.ok(inside(await box(tab, '[data-part="range"]'), viewport));
          // However far the list is scrolled, the pictures stay as long as there is room beside it.
          await tab.evaluate(() => scrollTo(0, 600));
          const room = await tab.evaluate(() => document.querySelector(".front").getBoundingClientRect().bottom >= document.querySelector("#stage").offsetHeight);
          if (room) assert.ok(inside(await box(tab, "#built svg"), viewport), "in sight beside the list");
          assert.ok(room || file !== gripper);
          await picture(tab, `${file.match(/([^/]+)\.html$/)[1]}-stage-${colorScheme}`, false);
        });
      }
    }
  });

  test("on a telephone both pictures and their controls are seen together", async () => {
    const viewport = { width: 390, height: 844 };
    await open(gripper, { viewport }, async (tab) => {
      await tab.locator("#variants tbody tr").nth(4).click();
      // Scrolling is smooth: what is measured stands still.
      const top = () => tab.evaluate(() => document.querySelector("#stage").getBoundingClientRect().top);
      for (let [was, is] = [NaN, await top()]; was !== is; [was, is] = [is, await top()]) await tab.waitForTimeout(100);
      for (const part of ["#built svg", "#drawing svg", '[data-part="play"]', '[data-part="range"]', "#drawn-kind", '[data-part="shown"]']) {
        assert.ok(inside(await box(tab, part), viewport), part);
      }
      await picture(tab, "gripper-10-stage-390", false);
    });
  });

  test("both pictures move on one slider", async () => {
    await open(gripper, { reducedMotion: "reduce" }, async (tab) => {
      // The bars alone: symbols differ where a joint is changed.
      const bars = (pane) => tab.locator(`${pane} [data-scene] path`).evaluateAll((all) => all.filter((p) => /bone|plate/.test(p.getAttribute("class"))).map((p) => p.getAttribute("d")).join());
      const before = await bars("#built");
      assert.equal(await bars("#drawing"), before, "as it is and as changed stand alike");
      await tab.locator('[data-part="range"]').fill("3");
      const after = await bars("#built");
      assert.notEqual(after, before);
      assert.equal(await bars("#drawing"), after, "and move alike");
      await tab.locator("#drawing .turn").focus();
      await tab.keyboard.press("ArrowUp");
      assert.equal(await bars("#drawing"), await bars("#built"), "and turn alike");
    });
  });

  test("ideas are lines of at most two, fifteen or more on a screen", async () => {
    for (const viewport of [{ width: 1300, height: 900 }, { width: 390, height: 844 }]) {
      await open(gripper, { viewport }, async (tab) => {
        await tab.locator("#variants tbody tr").first().evaluate((r) => scrollTo(0, scrollY + r.getBoundingClientRect().top));
        const rows = await tab.locator("#variants tbody tr").evaluateAll((all) => all.map((r) => {
          const { top, bottom } = r.getBoundingClientRect();
          const words = r.querySelector(".two");
          return { top, bottom, lines: words.clientHeight / parseFloat(getComputedStyle(words).lineHeight), cut: words.scrollHeight > words.clientHeight + 1 };
        }));
        assert.ok(rows.every((r) => r.lines < 2.2), "two lines");
        const seen = rows.filter((r) => r.top >= -1 && r.bottom <= viewport.height).length;
        assert.ok(seen >= 15, `${seen} on ${viewport.width} x ${viewport.height}`);
        console.log(`  ${seen} ideas on a screen of ${viewport.width} x ${viewport.height}`);
      });
    }
  });

  test("an idea says what the terminal says of it", async () => {
    await open(gripper, {}, async (tab) => {
      const said = await tab.locator("#chosen .why").innerText();
      for (const words of ["tilt both ways: link 2 at 1-2", "rod end (spherical plain bearing) at 1-2", "2 of 2 redundant constraints of loop 0-1-2-3"]) assert.ok(said.includes(words), words);
    });
  });

  const saved = async (tab, button) => {
    const [download] = await Promise.all([tab.waitForEvent("download"), button.click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };

  test("each picture is saved as SVG and as PNG", async () => {
    await open(gripper, { reducedMotion: "reduce", acceptDownloads: true }, async (tab) => {
      const figures = ["#built", "#drawing", '#mechanism figure[data-kind="scheme"] >> nth=0', '#mechanism figure[data-kind="kinematic"] >> nth=1', "#chart"];
      for (const figure of figures) {
        const buttons = tab.locator(figure).locator(".keep");
        const svg = await saved(tab, buttons.filter({ hasText: "SVG" }));
        assert.match(svg.name, /^gripper-10-.*\.svg$/);
        const [width, height, bad] = await tab.evaluate((text) => {
          const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
          return [Number(root.getAttribute("width")), Number(root.getAttribute("height")), root.querySelector("parsererror") !== null || root.localName !== "svg"];
        }, svg.bytes.toString());
        assert.ok(!bad && width > 200 && height > 100, `${figure}: ${width} x ${height}`);
        const png = await saved(tab, buttons.filter({ hasText: "PNG" }));
        assert.deepEqual([...png.bytes.subarray(0, 8)], [137, 80, 78, 71, 13, 10, 26, 10], png.name);
        const size = [png.bytes.readUInt32BE(16), png.bytes.readUInt32BE(20)];
        assert.deepEqual(size, [Math.ceil(2 * width), Math.ceil(2 * height)], figure);
        assert.ok(png.bytes.length > 8000, `${figure}: something is on it`);
      }
      const idea = await saved(tab, tab.locator("#drawing .keep").filter({ hasText: "SVG" }));
      assert.equal(idea.name, "gripper-10-idea-1-space.svg");
      assert.match(idea.bytes.toString(), /gripper-10, idea 1/);
      assert.match(idea.bytes.toString(), /class="[^"]*changed/);
    });
  });

  test("each table is copied as CSV", async () => {
    await open(gripper, { permissions: ["clipboard-read", "clipboard-write"] }, async (tab) => {
      const copied = async (button) => {
        await button.click();
        await tab.waitForFunction((b) => b.textContent === "Copied", await button.elementHandle());
        return tab.evaluate(() => navigator.clipboard.readText());
      };
      const tables = tab.locator("table");
      assert.ok((await tables.count()) >= 4);
      for (const table of await tables.all()) assert.equal(await table.locator("caption button").count(), 1, await table.innerText());
      const list = (await copied(tab.locator("#variants caption button"))).trimEnd().split("\r\n");
      assert.equal(list.length, 201, "all of the list, not its page alone");
      assert.equal(list[0], "idea,changed joints,variants,cost,W,cond.");
      assert.match(list[1], /^1,"1-2, 2-3, .*→ cylindrical",1470,11.5,1,0.0\d+$/);
      const contours = await copied(tab.locator("#mechanism table caption button").first());
      assert.match(contours, /^contour,joints,"σ, this loop order",any loop order,/);
      assert.match(contours, /\r\n0-1-2-3,"0-1, 1-2, 2-3, 3-0",2,2 to 3,2 to 3\r\n/);
    });
  });

  test("what scrolls is reached by keyboard, and says what it is", async () => {
    for (const viewport of [{ width: 1300, height: 900 }, { width: 390, height: 844 }]) {
      for (const file of [gripper, loaded]) {
        await open(file, { viewport }, async (tab) => {
          const regions = await tab.evaluate(() =>
            [...document.querySelectorAll("body *")].filter((e) => {
              const { overflowX, overflowY } = getComputedStyle(e);
              const along = /auto|scroll/.test(overflowX) && e.scrollWidth > e.clientWidth;
              const down = /auto|scroll/.test(overflowY) && e.scrollHeight > e.clientHeight;
              return (along || down) && e.checkVisibility();
            }).map((e) => ({
              what: `${e.localName}#${e.id}.${e.className}`,
              reached: e.tabIndex >= 0,
              named: Boolean(e.getAttribute("role") && (e.getAttribute("aria-label") || e.getAttribute("aria-labelledby"))),
            })));
          assert.ok(regions.length > 0 || viewport.width > 1000);
          for (const r of regions) assert.ok(r.reached && r.named, JSON.stringify(r));
        });
      }
    }
  });

  test("the chart has two named marks or more on each axis", async () => {
    const files = [gripper, loaded, ...["four-bar", "bennett", "rssr", "slider-crank-spatial", "watt-six-bar", "sarrus"].map((name) => report(`${name}-chart`, name))];
    for (const file of files) {
      await open(file, {}, async (tab) => {
        const keys = await tab.locator("#axis-x option").evaluateAll((all) => all.map((o) => o.value));
        for (const key of (await tab.locator("#chart").isVisible()) ? keys : []) {
          await tab.selectOption("#axis-x", key);
          await tab.selectOption("#axis-y", key);
          const labels = await tab.locator("#chart-room text:not(.soft)").evaluateAll((all) => all.map((t) => [t.getAttribute("text-anchor"), t.textContent]));
          for (const anchor of ["middle", "end"]) {
            const of = labels.filter((l) => l[0] === anchor).map((l) => l[1]);
            assert.ok(new Set(of).size === of.length && of.length >= 2, `${file}, ${key}: ${of}`);
          }
        }
      });
    }
  });
}
