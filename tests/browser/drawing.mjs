// Drawing in the studio: a sheet that stays where it is, unfinished drawings, what a search may change, and long work.

import assert from "node:assert/strict";
import { picture } from "./pages.mjs";
import { fresh, handOn, ideas, served, source, told, windowed } from "./windows.mjs";

export function drawingTests(test) {
  test("studio: the sheet never moves by itself, has numbers and a unit, and all pins at a place are reached", async () => {
    const { address, child } = await served(fresh(), "four-bar");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      await tab.locator("#new").click();
      await tab.locator('.card:has-text("An empty sheet")').click();
      await tab.waitForFunction(() => isEmpty());
      const begun = await tab.evaluate(() => toPaper([0, 0, 0]));
      const hand = handOn(tab);
      const stays = async () => assert.deepEqual(await tab.evaluate(() => toPaper([0, 0, 0])), begun);
      await hand.tool("slide");
      await hand.place(-40, 0);
      await tab.waitForFunction(() => player.scene !== null);
      await stays();
      for (const [x, y] of [[-40, 0], [40, 0]]) {
        await hand.tool("bar");
        await hand.place(x, y);
        await hand.place(0, 40);
      }
      await hand.tool("ground");
      await hand.place(0, 40);
      await hand.tool("drive");
      await hand.place(0, 40);
      await tab.waitForFunction(() => desk.motion?.revision === desk.revision && desk.ideas);
      await stays();
      const numbers = await tab.locator('[data-layer="grid"] text').allTextContents();
      for (const words of ["-25", "0", "50", "25 mm"]) assert.ok(numbers.includes(words), `${words} in ${numbers}`);
      await picture(tab, "studio-numbers", false);
      await hand.press('#views button:has-text("Grid")');
      assert.equal(await tab.locator(".grid-line").count(), 0);
      await hand.tool("select");
      const seen = new Set();
      for (let i = 0; i < 3; i += 1) {
        await hand.place(0, 40);
        seen.add(await tab.evaluate(() => selection[0].id));
      }
      const named = await tab.locator('[aria-label="At this place"] button').allInnerTexts();
      assert.ok(named.length >= 2, "each has a button");
      assert.deepEqual([...seen].sort(), named.sort());
    });
    child.kill("SIGINT");
  });

  test("studio: an unfinished drawing is grey, and says what to do next", async () => {
    const { address, child } = await served(fresh());
    await windowed(address, {}, async (tab) => {
      const hand = handOn(tab);
      await told(tab, "Nothing drawn yet");
      const calm = async (words) => {
        await told(tab, words);
        assert.equal(await tab.locator(".bad, .good, .wrong, #problems li").count(), 0, words);
      };
      await hand.tool("bar");
      await hand.place(-40, 0);
      await hand.place(-40, 40);
      await calm("Join the drawing to the frame");
      await picture(tab, "studio-first-bar", false);
      await hand.press('.next button:has-text("end 1")');
      await calm("Close the loop: pin a free end to the frame");
      await hand.tool("bar");
      await hand.place(-40, 40);
      await hand.place(40, 50);
      await hand.place(40, 50);
      await hand.place(40, 0);
      await calm("No closed loop yet");
      await tab.locator(".next button").first().hover();
      assert.equal(await tab.locator(".looked-ring").count(), 1, "the end is shown");
      await hand.press(".next button");
      await told(tab, "3 redundant constraints");
      await told(tab, "Choose the drive");
      assert.equal(await tab.locator(".verdict.bad").count(), 1);
      await hand.tool("drive");
      await hand.place(-40, 0);
      await hand.tool("output");
      await hand.place(40, 25);
      await ideas(tab);
      assert.equal(await tab.locator(".next").count(), 0);
      await hand.tool("ground");
      await hand.place(40, 0);
      await told(tab, "Link 3 is already joined to the frame there.");
      assert.ok(hand.count.clicks <= 20, `${hand.count.clicks} clicks`);
    });
    child.kill("SIGINT");
  });

  test("studio: what a search may change is set on the page and written into the file", async () => {
    const { address, child } = await served(fresh(), "four-bar");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      const before = await source(tab);
      const counted = async (words) => {
        await told(tab, words);
        await tab.waitForFunction(() => desk.ideas?.revision === desk.revision);
      };
      const written = (words) => tab.waitForFunction((w) => document.querySelector("#text").value.includes(w), words);
      await counted("14 of 64 variants have σ = 0");
      await tab.locator("#search-fold > summary").click();
      const box = (room, kind) => tab.locator(`${room} .type-box`).filter({ hasText: new RegExp(`^${kind}( |$)`) }).locator("input");
      await told(tab, "ball, rod end");
      await picture(tab, "studio-search", false);
      await box("#search", "universal").uncheck();
      await written('options = ["revolute", "cylindrical", "spherical"]');
      await counted("of 27 variants");
      await tab.locator(".number-field input").first().fill("1");
      await tab.locator(".number-field input").first().press("Enter");
      await written("max_redundant = 1");
      await counted("have σ ≤ 1");
      await tab.locator(".number-field input").nth(1).fill("1");
      await tab.locator(".number-field input").nth(1).press("Enter");
      await written("max_mobility = 1");
      await tab.waitForFunction(() => desk.ideas?.found?.variants.length && desk.ideas.found.variants.every((v) => v.mobility <= 1 && v.redundant <= 1));
      await tab.evaluate(() => select([{ what: "joint", id: "1-2" }]));
      await tab.getByText("A search may put here").click();
      await box("#thing .wide > .type-boxes", "spherical").uncheck();
      await written('forbid = ["spherical"]');
      await counted("of 18 variants");
      await tab.locator('#thing button:has-text("Never change it")').click();
      await written("options = []");
      await counted("of 9 variants");
      await tab.locator('#thing button:has-text("As everywhere")').click();
      await counted("of 27 variants");
      for (let i = 0; i < 6; i += 1) await tab.keyboard.press("Control+z");
      await tab.waitForFunction((text) => document.querySelector("#text").value === text, before);
      assert.doesNotMatch(await tab.locator("body").innerText(), /--[a-z]/, "no flag is named");
    });
    child.kill("SIGINT");
  });

  test("studio: long work names its stage, and a search is stopped with what it has found", async () => {
    const { address, child } = await served(fresh(), "hoberman-ring-6");
    await windowed(address, {}, async (tab) => {
      await tab.waitForFunction(() => desk.verdict);
      await tab.evaluate(() => putSearch("options", palette.filter((t) => !NEED_MORE.includes(t.type)).map((t) => t.type)));
      await tab.waitForFunction(() => /^Searching: joint \d+ of 18/.test(document.querySelector("#work").innerText));
      assert.ok(await tab.locator("#work progress").getAttribute("value"), "the share done");
      await picture(tab, "studio-searching", false);
      await tab.locator('#work button:has-text("Stop")').click();
      await ideas(tab);
      await told(tab, "The search was stopped");
      assert.match(await tab.locator(".counts").innerText(), /^at least /);
      await tab.waitForFunction(() => !document.querySelector('#work [data-stage="search"]'));
    });
    child.kill("SIGINT");
  });
}
