// The report page as its readers meet it: by mouse, by keyboard, in the dark, on a small screen and on paper.

import assert from "node:assert/strict";
import path from "node:path";
import { dragTests } from "./drags.mjs";
import { catalogueTests } from "./catalogue.mjs";
import { drawingTests } from "./drawing.mjs";
import { pairTests } from "./pairs.mjs";
import { stageTests } from "./stage.mjs";
import { hourTests } from "./hour.mjs";
import { studioTests } from "./studio.mjs";
import { browser, column, fits, open, picture, report } from "./pages.mjs";

const text = (tab, selector) => tab.locator(selector).innerText();
const rows = (tab) => tab.locator("#variants tbody tr[data-variant]");
const tests = [];
const test = (name, body) => tests.push([name, body]);
/** Turns to the list of single variants. */
const variants = (tab) => tab.selectOption("#list", "variants");
/** Turns to still drawings of a kind. */
const drawn = (tab, kind) => tab.selectOption("#drawn-kind", kind);
/** Nothing of a drawing is cut off. */
const uncut = async (tab, selector) => {
  const [inner, room] = await tab.locator(selector).evaluate((f) => [f.scrollWidth, f.clientWidth]);
  assert.ok(inner <= room, `${selector}: ${inner} pixels in ${room}`);
};

const gripper = report("gripper-10", "gripper-10");
const many = report("gripper-10-many", "gripper-10", "--top", "10000");
const loaded = report("gripper-10-loaded", "gripper-10-loaded", "--pool", "20000");

catalogueTests(test);
pairTests(test);
stageTests(test, { gripper, loaded });
dragTests(test, { gripper });
studioTests(test);
hourTests(test);
drawingTests(test);

test("the verdict stands at the top, and every part has its words", async () => {
  await open(gripper, {}, async (tab) => {
    const verdict = await text(tab, "#verdict");
    for (const words of ["11 redundant constraints", "21,817,629 of 13,841,287,201 variants", "changes 6 joints at cost 11.5", "16 redundant"]) {
      assert.ok(verdict.includes(words), words);
    }
    assert.match(await text(tab, "#certainty"), /rank proven by a checked certificate/);
    assert.doesNotMatch(await text(tab, "#certainty"), /Singular values agree/, "methods are folded away");
    await tab.locator("#certainty summary").last().click();
    assert.match(await text(tab, "#certainty"), /Singular values agree/);
    assert.match(await text(tab, "#commands"), /ozols export gripper-10 --to sdf/);
    assert.equal(await tab.locator("#mechanism .drawings svg").count(), 4);
    for (const svg of await tab.locator("svg[role=img]").all()) {
      for (const name of ["title", "desc"]) assert.ok((await svg.locator(`> ${name}`).textContent()).length > 3);
    }
    await fits(tab);
    await picture(tab, "gripper-10");
  });
});

test("heads sort, and say so", async () => {
  await open(gripper, {}, async (tab) => {
    const head = tab.locator('th[data-key="conditioning"]');
    assert.equal(await head.getAttribute("aria-sort"), "none");
    await head.locator("button").click();
    assert.equal(await head.getAttribute("aria-sort"), "descending");
    const numbers = (await column(tab, "conditioning")).map(Number);
    assert.deepEqual(numbers, [...numbers].sort((a, b) => b - a));
    await tab.keyboard.press("Enter");
    assert.equal(await head.getAttribute("aria-sort"), "ascending");
    const up = (await column(tab, "conditioning")).map(Number);
    assert.deepEqual(up, [...up].sort((a, b) => a - b));
    assert.ok(up[0] < numbers[0]);
  });
});

test("filters narrow the list, and Escape widens it again", async () => {
  await open(gripper, {}, async (tab) => {
    await variants(tab);
    await tab.fill("#find", "2-3:spherical 7-0");
    await tab.waitForFunction(() => document.querySelector("#count").textContent.includes("pass"));
    for (const changes of await column(tab, "list")) {
      assert.match(changes, /2-3[^;]*→ spherical/);
      assert.match(changes, /7-0/);
    }
    await tab.fill("#find", "no such joint");
    await tab.waitForFunction(() => !document.querySelector("#variants tr[data-variant]"));
    assert.match(await text(tab, "#variants tbody"), /None of the 200 variants listed matches/);
    await tab.keyboard.press("Escape");
    await tab.waitForFunction(() => document.querySelector("#variants tr[data-variant]"));
    assert.match(await text(tab, "#count"), /^200 listed of 21,817,629/);
  });
});

test("a variant is chosen by mouse: changes, figures and drawing", async () => {
  await open(gripper, {}, async (tab) => {
    await variants(tab);
    await drawn(tab, "scheme");
    const row = rows(tab).nth(2);
    await row.click();
    assert.equal(await row.getAttribute("aria-selected"), "true");
    assert.equal(await text(tab, "#chosen-head"), "Variant 3");
    assert.match(await text(tab, "#chosen-words"), /cost 11.5, 6 changes/);
    const changes = await tab.locator(".changes li").allInnerTexts();
    assert.equal(changes.length, 6);
    const marked = tab.locator("#drawing g[data-joint]:has(.changed)");
    assert.equal(await marked.count(), 6);
    const names = await marked.evaluateAll((groups) => groups.map((g) => g.dataset.joint));
    for (const change of changes) assert.ok(names.some((n) => change.startsWith(`${n}: `)), change);
    assert.match(await tab.locator("#drawing desc").textContent(), /W = 1, σ = 0/);
    assert.match(await text(tab, "#chosen"), /11 → 0/);
    assert.match(await text(tab, "#chosen"), /ozols draw gripper-10 --variant 3 /);
    await drawn(tab, "kinematic");
    assert.equal(await marked.count(), 6);
    await tab.selectOption("#drawn-state", { label: "clamped" });
    assert.equal(await marked.count(), 6);
    await tab.keyboard.press("Escape");
    assert.equal(await marked.count(), 0);
    assert.match(await text(tab, "#chosen-head"), /original mechanism/);
    await picture(tab, "gripper-10-as-it-is", false);
  });
});

test("by keyboard alone: skip link, table, pages, chart", async () => {
  await open(gripper, {}, async (tab) => {
    await variants(tab);
    await tab.evaluate(() => document.activeElement.blur());
    await tab.evaluate(() => scrollTo(0, 0));
    await tab.keyboard.press("Tab");
    assert.equal(await tab.evaluate(() => document.activeElement.className), "skip");
    await tab.keyboard.press("Enter");
    const focused = () => tab.evaluate(() => document.activeElement.dataset.variant);
    let steps = 0;
    while ((await focused()) === undefined && steps < 40) {
      await tab.keyboard.press("Tab");
      steps += 1;
    }
    assert.equal(await focused(), "0", "the first row is reached");
    await tab.keyboard.press("ArrowDown");
    await tab.keyboard.press("ArrowDown");
    await tab.keyboard.press("Enter");
    assert.equal(await focused(), "2");
    assert.equal(await text(tab, "#chosen-head"), "Variant 3");
    await tab.keyboard.press("PageDown");
    assert.equal(await focused(), "27");
    await tab.keyboard.press("End");
    assert.equal(await focused(), "199");
    await tab.keyboard.press("Home");
    assert.equal(await focused(), "0");
    await tab.keyboard.press("Escape");
    assert.match(await text(tab, "#chosen-head"), /original mechanism/);
    const outline = await tab.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.equal(outline, "solid", "focus is seen");
    await tab.locator('#chart circle.front[tabindex="0"]').focus();
    await tab.keyboard.press("Enter");
    assert.match(await text(tab, "#chosen-head"), /^Variant \d+$/);
    assert.equal(await tab.locator("#chart .ring").getAttribute("visibility"), "visible");
  });
});

test("under loads: scores, reactions, and a chart of two figures", async () => {
  await open(loaded, { colorScheme: "dark" }, async (tab) => {
    await variants(tab);
    assert.match(await text(tab, "#redesigns"), /ranked under the workload/);
    assert.match(await text(tab, "#chosen"), /Loads of the joints/);
    assert.match(await text(tab, "#chosen"), /\d+th by cost: peak moment/);
    const front = tab.locator("#chart circle.front");
    assert.ok((await front.count()) > 1);
    await front.last().click();
    assert.equal(await tab.locator('#variants tr[aria-selected="true"]').count(), 1);
    await tab.selectOption("#axis-y", "output-error");
    assert.ok((await tab.locator("#chart circle.dot").count()) > 5);
    const back = await tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(back, "rgb(21, 25, 29)", "dark");
    await fits(tab);
    await picture(tab, "gripper-10-loaded-dark");
  });
  await open(loaded, {}, (tab) => picture(tab, "gripper-10-loaded"));
});

test("ten thousand variants, on a small screen", async () => {
  await open(many, { viewport: { width: 360, height: 780 } }, async (tab, took) => {
    console.log(`  10,000 variants loaded in ${took} ms`);
    await fits(tab);
    await variants(tab);
    await tab.locator("#last").click();
    // It stays there: nothing that was put off turns back.
    await tab.waitForTimeout(150);
    const shown = await rows(tab).evaluateAll((all) => all.map((r) => r.dataset.variant));
    assert.equal(shown.at(-1), "9999");
    assert.ok(shown.length <= 50, "few rows are drawn");
    const begun = performance.now();
    await tab.fill("#find", "5-1:spherical");
    await tab.waitForFunction(() => document.querySelector("#count").textContent.includes("pass"));
    console.log(`  filtered in ${Math.round(performance.now() - begun)} ms`);
    await tab.locator('th[data-key="cost"] button').click();
    await tab.locator('th[data-key="cost"] button').click();
    const costs = (await column(tab, "cost")).map(Number);
    assert.deepEqual(costs, [...costs].sort((a, b) => b - a));
    await rows(tab).first().click();
    await fits(tab);
    await picture(tab, "gripper-10-360");
  });
});

test("the first list is of ideas, and single variants are a choice away", async () => {
  await open(gripper, {}, async (tab) => {
    assert.match(await text(tab, "#count"), /^200 ideas; they represent [\d,]+ of 21,817,629/);
    assert.match((await column(tab, "list"))[0], /^1-2, .* → spherical; 8-9 → cylindrical$/);
    assert.match(await text(tab, "#chosen"), /Idea 1/);
    assert.match(await text(tab, "#chosen"), /ozols draw gripper-10 --idea 1 -o gripper-10-idea-1.svg/);
    await variants(tab);
    assert.match(await text(tab, "#chosen"), /Variant 1\n/);
    assert.match(await text(tab, "#chosen"), /ozols draw gripper-10 --variant 1 -o gripper-10-variant-1.svg/);
  });
});

test("a filter that nothing passes says what would, and the command for more", async () => {
  await open(gripper, {}, async (tab) => {
    await variants(tab);
    await tab.fill("#find", "5-1:cylindrical 8-9:cylindrical");
    await tab.waitForFunction(() => !document.querySelector("#variants tr[data-variant]"));
    assert.match(await text(tab, "#variants tbody"), /ozols report gripper-10 --allow '5-1=cylindrical' --allow '8-9=cylindrical' --top 10000/);
    await tab.fill("#find", "5-1:glue");
    await tab.waitForFunction(() => document.querySelector("#variants tbody").innerText.includes("glue"));
    assert.match(await text(tab, "#variants tbody"), /Joint 5-1 may be revolute, .*glue is none of its options/);
    await tab.fill("#find", "2-3:spherical");
    await tab.fill("#most-cost", "1");
    const button = tab.locator("#variants tbody button").first();
    await button.waitFor();
    assert.match(await button.innerText(), /^Without cost ≤ 1: \d+/);
    const promised = Number((await button.innerText()).match(/(\d+)$/)[1]);
    await button.click();
    await tab.waitForFunction((n) => document.querySelector("#count").textContent.startsWith(`${n} of`), promised);
  });
});

test("nothing of the chosen drawing is cut, and a tapped row leads to it", async () => {
  for (const width of [1300, 360]) {
    await open(gripper, { viewport: { width, height: 780 } }, async (tab) => {
      await fits(tab);
      for (const pane of ["#built", "#drawing"]) await uncut(tab, pane);
      for (const figure of await tab.locator("#mechanism figure.drawing").all()) {
        const [inner, room] = await figure.evaluate((f) => [f.scrollWidth, f.clientWidth]);
        assert.ok(inner <= room, `${inner} in ${room}`);
      }
      await rows(tab).nth(3).click();
      await tab.waitForFunction(() => {
        const box = document.querySelector("#drawing").getBoundingClientRect();
        return box.top >= -1 && box.bottom <= innerHeight;
      });
      await tab.locator("#drawing button", { hasText: "Full size" }).click();
      assert.ok(await tab.locator("dialog.whole svg").isVisible());
      await tab.keyboard.press("Escape");
      // A dialog tells that it was closed in a task of its own.
      await tab.locator("dialog.whole").waitFor({ state: "detached" });
      await picture(tab, `gripper-10-chosen-${width}`, false);
    });
  }
});

const space = (tab, part) => tab.locator(part === "turn" ? "#built .turn" : part ? `[data-part="${part}"]` : "#built");
/** The corners of what is drawn of a mechanism in space. */
const corners = (tab) => space(tab).locator("[data-scene] path").evaluateAll((all) => all.map((p) => p.getAttribute("d")).join());

test("the motion plays at thirty pictures a second, and rests for who wants it to", async () => {
  const picture = (tab) => tab.locator("#stage").getAttribute("data-picture");
  await open(gripper, {}, async (tab) => {
    await space(tab, "turn").scrollIntoViewIfNeeded();
    await tab.waitForFunction(() => document.querySelector('[data-part="play"]').textContent === "Stop");
    // However busy the machine is, the motion goes on by thirty pictures a second: what it has no time to draw is left out.
    const { went, different, seconds } = await tab.evaluate(() => new Promise((done) => {
      const shown = [];
      let begun = null;
      const look = (time) => {
        begun ??= time;
        shown.push(Number(document.querySelector("#stage").dataset.picture));
        if (time - begun < 1500) return requestAnimationFrame(look);
        const steps = shown.slice(1).map((n, i) => Math.abs(n - shown[i]));
        done({ went: steps.reduce((sum, n) => sum + n, 0), different: new Set(shown).size, seconds: (time - begun) / 1000 });
      };
      requestAnimationFrame(look);
    }));
    console.log(`  ${went} pictures on in ${seconds.toFixed(1)} s, ${different} of them seen`);
    // Where it turns back between two looks, it has gone further than it seems.
    assert.ok(went >= 15 * seconds && went <= 33 * seconds + 2, `${went} in ${seconds} s`);
    assert.ok(different > 3, `${different}`);
    await space(tab, "play").click();
    const before = await corners(tab);
    await space(tab, "range").fill("5");
    assert.equal(await picture(tab), "5");
    assert.notEqual(await corners(tab), before);
    assert.equal(await text(tab, '[data-part="play"] >> nth=0'), "Play");
  });
  await open(gripper, { reducedMotion: "reduce" }, async (tab) => {
    await space(tab, "turn").scrollIntoViewIfNeeded();
    const before = await picture(tab);
    await tab.waitForTimeout(600);
    assert.equal(await picture(tab), before);
  });
});

test("a mechanism in space turns by keys, by mouse and by finger, and back", async () => {
  const bennett = report("bennett", "bennett");
  /** The lengths of the bars on paper, each as hundredths of all. */
  const lengths = (tab) => space(tab).locator('[data-scene] path[class^="bone"][d$="Z"]').evaluateAll((all) => {
    const own = all.map((p) => p.getTotalLength());
    return own.map((x) => Math.round((100 * x) / own.reduce((a, b) => a + b)));
  });
  for (const more of [{}, { viewport: { width: 360, height: 780 }, hasTouch: true, colorScheme: "dark" }]) {
    await open(bennett, { reducedMotion: "reduce", ...more }, async (tab) => {
      const first = await corners(tab);
      const name = await space(tab, "turn").getAttribute("aria-label");
      assert.match(name, /arrow keys to turn the view/);
      assert.ok(await space(tab, "home").isDisabled());
      await space(tab, "turn").focus();
      await tab.keyboard.press("ArrowRight");
      const right = await corners(tab);
      assert.notEqual(right, first);
      assert.match(await text(tab, '[data-part="say"]'), /turned by 10° to the side and 0° up/);
      await tab.keyboard.press("ArrowLeft");
      await tab.keyboard.press("ArrowUp");
      assert.notEqual(await corners(tab), right);
      await tab.keyboard.press("Home");
      assert.equal(await corners(tab), first);
      assert.ok(await space(tab, "home").isDisabled());
      for (let i = 0; i < 9; i += 1) await tab.keyboard.press("ArrowUp");
      const above = await lengths(tab);
      for (let i = 0; i < 12; i += 1) await tab.keyboard.press("ArrowRight");
      assert.deepEqual(await lengths(tab), above, "from above, a turn to the side leaves the plan as it is");
      await space(tab, "home").click();
      assert.equal(await corners(tab), first);
      const box = await space(tab, "turn").boundingBox();
      await tab.evaluate((y) => scrollBy(0, y - 100), box.y);
      const { x, y } = await space(tab, "turn").boundingBox();
      if (more.hasTouch) {
        const finger = await tab.context().newCDPSession(tab);
        const at = (type, dx) => finger.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x: x + 150 + dx, y: y + 150 }] });
        await at("touchStart", 0);
        for (const dx of [10, 25, 40, 60]) await at("touchMove", dx);
        await at("touchEnd", 0);
      } else {
        await tab.mouse.move(x + 150, y + 150);
        await tab.mouse.down();
        await tab.mouse.move(x + 210, y + 160, { steps: 4 });
        await tab.mouse.up();
      }
      assert.notEqual(await corners(tab), first);
      const turned = await corners(tab);
      await tab.mouse.move(x + 20, y + 20);
      assert.equal(await corners(tab), turned, "only a drag turns");
      await fits(tab);
      await picture(tab, `bennett-turned-${more.hasTouch ? 360 : 1360}`);
    });
  }
});

test("idle freedoms and self-stresses are shown on demand", async () => {
  const rssr = report("rssr", "rssr");
  await open(rssr, { reducedMotion: "reduce" }, async (tab) => {
    const options = await space(tab, "shown").locator("option").allInnerTexts();
    const idle = options.findIndex((o) => o.startsWith("idle freedom 1: link 2 spins about"));
    assert.ok(idle > 0, options.join());
    await space(tab, "shown").selectOption(String(idle));
    const flag = () => space(tab).locator("[data-scene] .flag").getAttribute("d");
    const upright = await flag();
    await space(tab, "range").fill("12");
    assert.notEqual(await flag(), upright);
    assert.match(await text(tab, '[data-part="say"]'), /^idle freedom 1/);
  });
  await open(gripper, { reducedMotion: "reduce" }, async (tab) => {
    const options = await space(tab, "shown").locator("option").allInnerTexts();
    assert.equal(options.filter((o) => o.startsWith("self-stress")).length, 11);
    await space(tab, "shown").selectOption(String(options.findIndex((o) => o.startsWith("self-stress 2:"))));
    assert.equal(await space(tab, "play").isVisible(), false);
    const arrows = space(tab).locator("[data-scene] .load");
    assert.ok((await arrows.count()) >= 8);
    assert.match(await arrows.first().locator("title").textContent(), /^(force|moment) on link \S+ at \S+: 0?\.?\d/);
  });
});

test("on paper: no controls, and what was chosen", async () => {
  await open(gripper, {}, async (tab) => {
    await rows(tab).nth(1).click();
    await tab.emulateMedia({ media: "print" });
    for (const hidden of ["nav", "#filters", ".pager", ".skip"]) {
      assert.equal(await tab.locator(hidden).first().isVisible(), false, hidden);
    }
    for (const shown of ["#verdict", "#chosen", "#drawing", "#mechanism"]) assert.ok(await tab.locator(shown).isVisible(), shown);
  });
  for (const file of [gripper, loaded]) {
    await open(file, {}, async (tab) => {
      await tab.emulateMedia({ media: "print" });
      const pdf = await tab.pdf({ path: file.replace(".html", ".pdf"), format: "A4" });
      const pages = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g).length;
      assert.ok(pages <= 4, `${file}: ${pages} pages`);
    });
  }
});

test("names from files stay text", async () => {
  const hostile = report("hostile", path.join(import.meta.dirname, "hostile.toml"));
  await open(hostile, {}, async (tab) => {
    assert.equal(await text(tab, "h1"), "</script><script>alert(1)</script>");
    assert.equal(await tab.locator("script").count(), 2);
    assert.equal(await tab.locator("img").count(), 0);
    await drawn(tab, "scheme");
    await rows(tab).first().click();
    const count = await tab.locator(".changes li").count();
    assert.ok(count > 0);
    assert.equal(await tab.locator("#drawing g[data-joint]:has(.changed)").count(), count);
    const all = await tab.evaluate(() => document.documentElement.outerHTML);
    assert.doesNotMatch(all, /[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/, "nothing turns letters round");
    assert.match(await text(tab, "#mechanism"), /<b>\\u\{202e\}tab\\u\{2066\}<\/b>/, "and readers are told");
    await picture(tab, "hostile");
  });
});

test("pages without a list of variants, and imported robots", async () => {
  const cases = [
    ["bennett", /redundant constraint/],
    ["slider-crank-determinate", /Statically determinate/],
    ["gripper-10-redesign-unloaded", /redundant|determinate/],
    ["parallel-shears", /determinate|redundant/],
    ["tests/data/robots/gripper.xml", /2 redundant constraints/],
    ["tests/data/robots/leg.urdf", /redundant|determinate/],
  ];
  for (const [name, words] of cases) {
    const file = report(name.replaceAll("/", "-"), name);
    for (const [width, height] of [[1360, 950], [360, 780]]) {
      await open(file, { viewport: { width, height } }, async (tab) => {
        assert.match(await text(tab, "#verdict"), words);
        await fits(tab);
        await picture(tab, `${path.basename(file, ".html")}-${width}`);
      });
    }
  }
});

let failed = 0;
// An argument names the tests to run.
for (const [name, body] of tests.filter(([name]) => name.includes(process.argv[2] ?? ""))) {
  try {
    await body();
    console.log(`ok: ${name}`);
  } catch (e) {
    failed += 1;
    console.log(`FAILED: ${name}\n${e.stack}`);
  }
}
await browser.close();
process.exit(failed ? 1 : 0);
