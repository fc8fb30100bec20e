// The page of a catalogue: cards, filters, the gripper that is chosen.

import assert from "node:assert/strict";
import { catalogue, fits, open, picture } from "./pages.mjs";

export function catalogueTests(test) {
  const file = catalogue("grippers", "--links", "4..6", "--ideas", "3");
  const cards = (tab) => tab.locator("#cards .card");

  test("the cards of a catalogue fit every screen", async () => {
    for (const [name, options] of [
      ["catalogue", {}],
      ["catalogue-dark", { colorScheme: "dark" }],
      ["catalogue-phone", { viewport: { width: 360, height: 740 } }],
    ]) {
      await open(file, options, async (tab, took) => {
        assert.ok(took < 5000, `${took} ms`);
        assert.ok((await cards(tab).count()) >= 60);
        assert.equal(await cards(tab).first().locator("svg title").count(), 1);
        await fits(tab);
        await picture(tab, name, false);
      });
    }
  });

  test("a catalogue is filtered and sorted, and says how many are left", async () => {
    await open(file, {}, async (tab) => {
      await tab.selectOption("#symmetry", "mirror");
      await tab.waitForFunction(() => document.querySelectorAll("#cards .card").length === 2);
      assert.match(await tab.locator("#count").innerText(), /^2 of \d+ grippers/);
      await tab.fill("#cost", "0.5");
      await tab.waitForFunction(() => document.querySelectorAll("#cards .card").length === 0);
      assert.match(await tab.locator("#count").innerText(), /take a filter away/);
      await tab.click("#filters button[type=reset]");
      await tab.check("#front");
      await tab.waitForFunction(() => /^\d+ of \d+ grippers/.test(document.getElementById("count").textContent));
      const [best, all] = (await tab.locator("#count").innerText()).match(/\d+/g).map(Number);
      assert.ok(best > 0 && 2 * best < all, `${best} of ${all}`);
      await tab.uncheck("#front");
      await tab.selectOption("#sort", "force_mean");
      await tab.waitForFunction(() => document.querySelectorAll("#cards .card").length >= 60);
    });
  });

  test("a gripper is chosen by keyboard, its ideas are drawn, and Escape comes back", async () => {
    for (const viewport of [{ width: 1300, height: 900 }, { width: 360, height: 740 }]) {
      await open(file, { viewport }, async (tab) => {
        const first = cards(tab).nth(2);
        await first.focus();
        await tab.keyboard.press("Enter");
        const chosen = tab.locator("#chosen");
        assert.ok(await chosen.isVisible());
        const idea = chosen.locator("tbody tr").first();
        await idea.focus();
        await tab.keyboard.press("Enter");
        assert.ok((await chosen.locator("svg .changed").count()) > 0);
        assert.match(await chosen.locator("pre").innerText(), /--variant 1/);
        const [content, room] = await chosen.evaluate((d) => [d.scrollWidth, d.clientWidth]);
        assert.ok(content <= room, `${content} pixels of content in ${room}`);
        await picture(tab, `catalogue-chosen-${viewport.width}`, false);
        await tab.keyboard.press("Escape");
        assert.ok(!(await chosen.isVisible()));
        assert.ok(await first.evaluate((e) => e === document.activeElement));
      });
    }
  });
}
