// The first hour: four mechanisms from an empty sheet to a redesign that is applied, by mouse and keyboard alone, on three
// sizes of screen. The text of the file is never touched.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { fits, picture } from "./pages.mjs";
import { SKETCHES } from "./sketches.mjs";
import { drawGripper, fresh, handOn, ideas, served, settledOn, source, told, verdict, windowed } from "./windows.mjs";

/** By name: how it is drawn, how many redundant constraints it has, and the part that is allowed before there are ideas. */
const DRAWN = {
  "lever gripper": {
    redundant: 6,
    draw: (hand) => drawGripper(hand, 40),
  },
  "toggle clamp": {
    redundant: 3,
    async draw(hand) {
      await hand.tool("plate");
      for (const [x, y] of [[20, 0], [10, 20], [-35, 20], [-35, 20]]) await hand.place(x, y);
      await hand.tool("bar");
      for (const [x, y] of [[10, 20], [30, 30], [30, 30], [40, 5]]) await hand.place(x, y);
      await hand.tool("ground");
      await hand.place(20, 0);
      await hand.place(40, 5);
      await hand.tool("drive");
      await hand.place(40, 5);
      await hand.tool("output");
      await hand.place(-15, 20);
    },
  },
  "screw gripper": {
    redundant: 10,
    async draw(hand) {
      await hand.tool("slide");
      await hand.place(-20, 0);
      for (const y of [30, -30]) {
        await hand.place(20, y);
        await hand.press('.axes button:has-text("y")');
      }
      await hand.tool("screw");
      await hand.place(-40, 0);
      await hand.place(-20, 0);
      await hand.tool("bar");
      for (const [x, y] of [[-20, 0], [20, 30], [-20, 0], [20, -30]]) await hand.place(x, y);
      await hand.tool("output");
      await hand.place(20, 30);
      await hand.place(20, -30);
    },
    /** No joint type removes all of them: a nut that floats is a button. */
    part: "floating-nut-z in series",
  },
  gantry: {
    redundant: 5,
    async draw(hand) {
      await hand.tool("slide");
      await hand.place(0, -25);
      await hand.place(0, 25);
      await hand.press('#types [data-type="fixed"]');
      await hand.tool("bar");
      await hand.place(0, -25);
      await hand.place(0, 25);
      await hand.tool("output");
      await hand.place(0, 0);
      await hand.tool("drive");
      await hand.place(0, -25);
    },
    /** What is bolted gets a seat with a direction. */
    part: "ball-in-v-groove-y",
  },
};
const SCREENS = [[1300, 900], [900, 700], [390, 844]];

export function hourTests(test) {
  for (const [name, { redundant, draw, part }] of Object.entries(DRAWN)) {
    test(`studio: a ${name} from an empty sheet to an applied redesign, on three sizes of screen`, async () => {
      for (const [width, height] of SCREENS) {
        const { address, child } = await served(fresh());
        const colorScheme = width === 900 ? "dark" : "light";
        await windowed(address, { viewport: { width, height }, colorScheme }, async (tab) => {
          const hand = handOn(tab);
          const begun = await source(tab);
          await draw(hand);
          await told(tab, `σ = ${redundant} `);
          if (part) await hand.press(`#ideas .idea:has-text("${part}")`);
          await tab.waitForSelector(".idea-list .idea small");
          await tab.waitForFunction(() => desk.motion?.revision === desk.revision && desk.ideas);
          assert.doesNotMatch(await tab.locator("#side").innerText(), /--[a-z]/, "no option of the command line is named");
          await fits(tab);
          await hand.press(".idea:has(small):enabled");
          await tab.waitForFunction((n) => desk.verdict?.analysis?.states[0].redundant < n, redundant);
          assert.match(await verdict(tab), /W = [12] · σ = 0 /);
          assert.notEqual(await source(tab), begun);
          assert.equal(await tab.evaluate(() => document.querySelector("#text-fold").open), false, "the text stayed folded");
          console.log(`  ${name} at ${width} x ${height}: ${hand.count.clicks} clicks`);
          assert.ok(hand.count.clicks < 25);
          for (const scheme of ["light", "dark"]) {
            await tab.emulateMedia({ colorScheme: scheme });
            await picture(tab, `hour-${name.replace(" ", "-")}-${width}-${scheme}`, false);
          }
        });
        child.kill("SIGINT");
      }
    });
  }

  /** By name: the clicks that make parts and conditions available, and the mobility and the joints in which an engineer sets it right. */
  const FIXED = {
    "screw-gripper": [['#ideas .idea:has-text("floating-nut-z in series with thread")'], 1, /thread/],
    "bed-on-three-balls": [['#ideas .idea:has-text("groove")'], 3, /groove/],
    "printer-bed": [["#search-fold > summary", "drives", '#ideas .idea:has-text("in series with n1")'], 3, /gimbal/],
    gantry: [["#search-fold > summary", "drives", '#ideas .idea:has-text("in series with nut-l")'], 2, /nut-[lr]/],
    "double-wishbone": [['#ideas .idea:has-text("sphere-in-cylinder at")'], 2, /sphere-in-cylinder/],
    "screw-jack": [['#ideas .idea:has-text("floating-nut-z in series with nut")'], 1, /nut/],
    "hand-one-pin": [[], 1, /spherical/],
  };
  test("studio: seven sketches reach a determinate redesign from the panel alone", async () => {
    for (const [name, [steps, mobility, words]] of Object.entries(FIXED)) {
      const folder = fresh();
      const file = path.join(folder, `${name}.toml`);
      writeFileSync(file, SKETCHES[name]);
      const { address, child } = await served(folder, file);
      await windowed(address, {}, async (tab) => {
        const hand = handOn(tab);
        for (const step of steps) {
          if (step !== "drives") await hand.press(step);
          else await tab.locator('label:has-text("Drives") select').selectOption("independent");
          await settledOn(tab);
        }
        await tab.waitForSelector(".idea-list .idea:enabled small");
        const idea = await tab.locator(".idea-list .idea-words").first().innerText();
        assert.match(idea, words, name);
        await hand.press(".idea:has(small):enabled");
        await tab.waitForFunction(() => desk.verdict?.analysis?.states[0].redundant === 0);
        const w = await tab.evaluate(() => desk.verdict.analysis.states[0].mobility);
        assert.equal(w, mobility, name);
        console.log(`  ${name}: ${hand.count.clicks + steps.includes("drives")} clicks: ${idea}`);
      });
      child.kill("SIGINT");
    }
  });

  test("studio: lengths, loads, gears, ranking and the stroke by forms and tools", async () => {
    const { address, child } = await served(fresh(), "four-bar");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      const entry = (path) => tab.evaluate((keys) => keys.reduce((v, k) => v?.[k], desk.look.file), path);
      await tab.evaluate(() => select([{ what: "link", id: "1" }]));
      const length = tab.locator('#thing .pair-fields input').first();
      await length.fill("45");
      await length.press("Enter");
      await settledOn(tab);
      const far = await tab.evaluate(() => { const [a, b] = pinsOf("1"); return apart(a.at, b.at); });
      assert.ok(Math.abs(far - 45) < 1e-6, `${far}`);
      await tab.keyboard.press("Escape");
      const spot = await tab.evaluate(() => {
        const [a, b] = pinsOf("2").map((p) => toPaper(p.at));
        const { left, top } = document.querySelector("#sheet").getBoundingClientRect();
        return [(a[0] + b[0]) / 2 + left, (a[1] + b[1]) / 2 + top];
      });
      await tab.locator('[data-tool="force"]').click();
      await tab.mouse.click(...spot);
      await settledOn(tab);
      assert.match(await source(tab), /\[\[workload\.force\]\]\nlink = "2"/);
      await tab.waitForFunction(() => desk.force?.charts.some(Boolean));
      await tab.locator("#search-fold > summary").click();
      await tab.locator("#search-fold details > summary").click();
      await tab.locator('label:has-text("largest joint force") input').fill("2");
      await tab.locator('label:has-text("largest joint force") input').press("Enter");
      await settledOn(tab);
      assert.deepEqual(await entry(["ranking", "terms"]), [{ term: "peak-force", weight: 2 }]);
      await tab.waitForFunction(() => desk.motion?.revision === desk.revision);
      await tab.evaluate(() => select([{ what: "joint", id: "1-2" }]));
      await tab.waitForSelector("#curves .curve");
      const [count, right] = await tab.evaluate(() => {
        // the x of the crank's pin swings between the ends of its circle
        const scene = desk.motion.scenes[0], [[, , x]] = seriesOf({ what: "joint", id: "1-2" }, scene);
        const pivot = placeOf("joint", "0-1")[0], far = apart(placeOf("joint", "0-1"), placeOf("joint", "1-2"));
        return [document.querySelectorAll("#curves .curve").length, Math.abs(Math.max(...x) - (pivot + far)) < 0.02 * far];
      });
      assert.ok(count >= 6 && right, `${count}`);
      await tab.locator('[data-part="range"]').fill("40");
      await tab.locator('#limits button:has-text("End here")').click();
      await settledOn(tab);
      assert.match(await entry(["workload", "stroke", "to"]), /deg$/);
      await tab.waitForFunction(() => desk.motion?.revision === desk.revision);
      await tab.locator('#limits button:has-text("Whole stroke")').click();
      await settledOn(tab);
      assert.equal(await entry(["workload", "stroke"]), undefined);
      // The drive is held by a torque, under the force of the tool.
      await tab.evaluate(() => select([{ what: "joint", id: listOf("joint").find((j) => j.drive).id }]));
      await tab.waitForFunction(() => desk.force?.charts[0]?.drives);
      await tab.waitForSelector('#curves figcaption:has-text("drive torque, N·m")');
      // Another unit converts all lengths, the sheet stays, and the way back is exact.
      const now = () => tab.evaluate(() => ({ file: JSON.stringify(desk.look.file), places: desk.look.places.joint, pins: desk.look.places.joint.map(toPaper), sigma: desk.verdict?.analysis.states[0].redundant }));
      const before = await now();
      await tab.selectOption("#unit", "in");
      await tab.waitForFunction(() => desk.look.file.length_unit === "in" && desk.verdict?.revision === desk.revision);
      const inches = await now();
      assert.equal(inches.sigma, before.sigma);
      before.places.flat().forEach((x, n) => assert.ok(Math.abs(x / 25.4 - inches.places.flat()[n]) < 1e-9));
      before.pins.flat().forEach((x, n) => assert.ok(Math.abs(x - inches.pins.flat()[n]) < 1e-6));
      await tab.selectOption("#unit", "mm");
      await tab.waitForFunction(() => desk.look.file.length_unit === "mm");
      assert.deepEqual((await now()).places, before.places);
      // Conditions of the search are written, and single changes stand where the ideas will be.
      await tab.locator('label:has-text("Drives") select').selectOption("independent");
      await settledOn(tab);
      assert.match(await source(tab), /drives = "independent"/);
      const single = await tab.evaluate(() => singleChanges().map((e) => e.textContent).join(" "));
      assert.match(single, /removes \d of 3/);
      await tab.evaluate(() => select([{ what: "joint", id: "2-3" }]));
      await tab.locator("#thing details > summary").first().click();
      await tab.locator("#thing details details > summary").click();
      await tab.locator('#thing details details [data-type="floating-nut-z"]').click();
      await settledOn(tab);
      assert.deepEqual(await tab.evaluate(() => thing("joint", "2-3").unloading), [{ name: "floating-nut-z", freedoms: ["rx", "ry", "tx", "ty"] }]);
    });
    child.kill("SIGINT");
  });

  test("studio: two ideas are compared, and the tutorial ends with a redesign", async () => {
    const { address, child } = await served(fresh(), "gripper-10");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      const said = await tab.locator("#ideas").innerText();
      for (const words of ["Hardware", "rod end", "Removes", "throughout the motion", "symmetric", "Most heavily loaded"]) assert.ok(said.includes(words), words);
      const boxes = tab.locator('.idea-list .check input');
      await boxes.nth(0).click();
      await boxes.nth(2).click();
      assert.equal(await tab.locator(".compared thead button").count(), 2);
      assert.ok(await tab.locator(".compared .differs").count() > 0);
      await picture(tab, "studio-compared", false);
    });
    child.kill("SIGINT");
    const empty = await served(fresh());
    await windowed(empty.address, {}, async (tab) => {
      const hand = handOn(tab);
      await hand.press("#new");
      await hand.press('#shelf button:has-text("Tutorial")');
      const step = (n) => told(tab, `${n} of 8:`);
      await step(1);
      await hand.tool("bar");
      for (const [x, y] of [[-30, -20], [-30, 0]]) await hand.place(x, y);
      await step(2);
      for (const [x, y] of [[-30, 0], [20, 20]]) await hand.place(x, y);
      await step(3);
      for (const [x, y] of [[20, 20], [30, -20]]) await hand.place(x, y);
      await step(4);
      await hand.tool("ground");
      await hand.place(-30, -20);
      await hand.place(30, -20);
      await step(5);
      await hand.tool("drive");
      await hand.place(-30, -20);
      await step(6);
      await hand.tool("output");
      await hand.place(25, 0);
      await step(7);
      await ideas(tab);
      await hand.press(".idea:enabled");
      await step(8);
    });
    empty.child.kill("SIGINT");
  });
}
