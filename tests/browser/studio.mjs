// The studio as its users meet it: from nothing to a gripper that is searched, redesigned and exported; two windows, a killed
// program, a killed browser, a foreign page.

import assert from "node:assert/strict";
import { cpSync, existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import path from "node:path";
import { browser, fits, picture, root, work } from "./pages.mjs";
import { drawGripper, fresh, handOn, ideas, served, settledOn, source, told, verdict, windowed } from "./windows.mjs";

const axe = readFileSync(createRequire(path.join(work, "package.json")).resolve("axe-core/axe.min.js"), "utf8");

const asked = (address, options, body) => new Promise((resolve, reject) => {
  const sent = http.request(address, options, (answer) => {
    answer.resume();
    resolve(answer.statusCode);
  });
  sent.on("error", reject);
  sent.end(body);
});

export function studioTests(test) {
  test("studio: from nothing to a gripper of six links, searched, redesigned and exported, in fewer than sixty clicks", async () => {
    const folder = fresh();
    const { address, child } = await served(folder);
    await windowed(address, {}, async (tab) => {
      const begun = performance.now();
      const hand = handOn(tab);
      await drawGripper(hand, 60);
      await ideas(tab);
      assert.match(await verdict(tab), /W = 1 · σ = 6 · 6 links, 7 joints, 2 contours/);
      await picture(tab, "studio-drawn", false);
      await hand.press(".idea");
      await told(tab, "Statically determinate");
      assert.match(await verdict(tab), /W = 1 · σ = 0/);
      hand.count.clicks += 1;
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.selectOption("#export", "toml")]);
      const text = readFileSync(await download.path(), "utf8");
      assert.match(text, /spherical/);
      await hand.press("#save");
      await tab.keyboard.type("gripper");
      await hand.press("#notice-name button");
      await told(tab, "gripper.toml · saved");
      const saved = readFileSync(path.join(folder, "gripper.toml"), "utf8");
      assert.match(saved, /# A mechanism drawn in `ozols studio`/, "comments are kept");
      assert.match(saved, /mirror = \[/);
      assert.ok(hand.count.clicks < 60, `${hand.count.clicks} clicks`);
      console.log(`  ${hand.count.clicks} clicks, ${((performance.now() - begun) / 1000).toFixed(1)} s by script`);
      await hand.press("#undo");
      await told(tab, "6 redundant constraints");
      await hand.press("#redo");
      await told(tab, "Statically determinate");
      await picture(tab, "studio-redesigned", false);
    });
    child.kill("SIGINT");
  });

  test("studio: the first page is small, asks nobody else, and is well for everybody", async () => {
    const { address, child } = await served(fresh(), "gripper-10");
    for (const [colorScheme, viewport] of [["light", { width: 1300, height: 900 }], ["dark", { width: 390, height: 844 }]]) {
      await windowed(address, { colorScheme, viewport }, async (tab, bytes) => {
        await ideas(tab);
        await tab.waitForFunction(() => desk.motion && desk.ideas);
        // What is told of the mechanism comes as events, whose length no header says.
        const told = await tab.evaluate(() => JSON.stringify([desk.look, desk.verdict, desk.motion, desk.ideas]).length);
        assert.ok(bytes() + told < 300_000, `${bytes()} + ${told} bytes`);
        console.log(`  the first page has ${Math.round(bytes() / 1000)} kB, and ${Math.round(told / 1000)} kB of the mechanism`);
        await tab.locator("#sheet").click({ position: { x: 5, y: 5 } });
        await tab.keyboard.press("]");
        for (const fold of ["#text-fold", "#search-fold", "#thing"]) await tab.locator(`${fold} summary`).first().click();
        await tab.evaluate(axe);
        const found = await tab.evaluate(() => axe.run());
        assert.deepEqual(found.violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), []);
        await fits(tab);
        await picture(tab, `studio-gripper-10-${viewport.width}`, false);
        await tab.keyboard.press("Escape");
        await tab.locator("#new").click();
        await tab.waitForSelector(".card");
        const shelf = await tab.evaluate(() => axe.run());
        assert.deepEqual(shelf.violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), []);
        await picture(tab, `studio-shelf-${viewport.width}`, false);
      });
    }
    child.kill("SIGINT");
  });

  test("studio: a pin that is dragged is drawn with each move, and the engine answers on the way", async () => {
    const { address, child } = await served(fresh(), "gripper-10");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      const from = await tab.evaluate(() => {
        const pin = sheetPins.find((p) => p.id === "2-4");
        const { left, top } = document.querySelector("#sheet").getBoundingClientRect();
        return [pin.paper[0] + left, pin.paper[1] + top];
      });
      await tab.mouse.move(...from);
      await tab.mouse.down();
      // What a move takes until it is drawn, by the browser's own clock.
      await tab.evaluate(() => {
        window.times = [];
        document.querySelector("#sheet").addEventListener("pointermove", (event) => {
          requestAnimationFrame(() => window.times.push(performance.now() - event.timeStamp));
        }, true);
      });
      let far = 6;
      for (let i = 1; i <= 8; i += 1) {
        await tab.mouse.move(from[0] + 20 * i, from[1] + 3 * i);
        // A bar ends where the pin is now, farther to the right each time.
        const now = await tab.waitForFunction((was) => {
          const to = preview.moved[0]?.to;
          if (!(to?.[0] > was)) return false;
          const [x, y] = toPaper(to);
          const bars = [...document.querySelectorAll('[data-layer="things"] path')].map((p) => p.getAttribute("d"));
          const ends = bars.flatMap((d) => [...d.matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map((m) => [Number(m[1]), Number(m[2])]));
          return ends.some(([a, b]) => Math.hypot(a - x, b - y) < 1) && to[0];
        }, far);
        far = await now.jsonValue();
      }
      await tab.waitForFunction(() => Number(document.querySelector("#sheet").dataset.answered) > 0);
      const times = await tab.evaluate(() => window.times.sort((a, b) => a - b));
      console.log(`  a move is on the screen after ${times[times.length >> 1].toFixed(1)} ms (median of ${times.length}), ${times.at(-1).toFixed(1)} ms at most`);
      await tab.mouse.up();
      await tab.waitForFunction(() => desk.look.file.joint.find((j) => j.id === "2-4").point[0] !== 6);
      const [x, image] = await tab.evaluate(() => ["2-4", "6-8"].map((id) => desk.look.file.joint.find((j) => j.id === id).point[0]));
      assert.equal(image, x, "its mirror image goes along");
      const { searches } = await (await fetch(`${address}status`)).json();
      assert.ok(searches.begun - searches.ended <= 1, "one search at work");
      await tab.keyboard.press("Control+z");
      await tab.waitForFunction(() => desk.look.file.joint.find((j) => j.id === "2-4").point[0] === 6);
    });
    child.kill("SIGINT");
  });

  test("studio: a link that is dragged takes the mechanism along, closed, and the stroke plays", async () => {
    const { address, child } = await served(fresh(), "gripper-10");
    await windowed(address, { reducedMotion: "reduce" }, async (tab) => {
      await ideas(tab);
      const bar = await tab.evaluate(() => {
        const [a, b] = ["1-2", "2-3"].map((id) => sheetPins.find((p) => p.id === id).paper);
        const { left, top } = document.querySelector("#sheet").getBoundingClientRect();
        return [(a[0] + b[0]) / 2 + left, (a[1] + b[1]) / 2 + top];
      });
      await tab.mouse.move(...bar);
      await tab.mouse.down();
      await tab.mouse.move(bar[0] + 30, bar[1] - 10, { steps: 6 });
      const gap = await tab.evaluate(() => Number(document.querySelector("#stage").dataset.gap));
      assert.ok(gap < 0.05, `${gap} pixels open`);
      await tab.mouse.up();
      assert.ok(await tab.locator('[data-part="home"]').isEnabled());
      await tab.keyboard.press("Escape");
      assert.ok(await tab.locator('[data-part="home"]').isDisabled());
      await tab.waitForFunction(() => desk.motion !== null);
      await tab.locator('[data-part="play"]').click();
      const seen = new Set();
      while (seen.size < 10) seen.add(await tab.locator("#stage").getAttribute("data-picture"));
      await tab.locator('[data-part="play"]').click();
      assert.ok(await tab.evaluate(() => document.querySelectorAll('[data-layer="things"] path').length > 20));
    });
    child.kill("SIGINT");
  });

  test("studio: all of a four-bar by keyboard alone", async () => {
    const { address, child } = await served(fresh());
    await windowed(address, {}, async (tab) => {
      await tab.locator("#sheet").focus();
      const keys = async (...all) => {
        for (const key of all) {
          await tab.keyboard.press(key);
          await settledOn(tab);
        }
      };
      const far = (key, n) => Array.from({ length: n }, () => `Shift+${key}`);
      await keys("b", ...far("ArrowLeft", 2), "Enter", ...far("ArrowUp", 3), "Enter");
      await keys("Enter", ...far("ArrowRight", 5), "Enter");
      await keys("Enter", ...far("ArrowDown", 3), "Enter");
      await keys("g", "Enter");
      await keys(...far("ArrowLeft", 5), "Enter");
      await keys("Escape");
      await told(tab, "3 redundant constraints");
      assert.match(await verdict(tab), /4 links, 4 joints, 1 contour/);
      await keys("Escape", "]");
      const id = await tab.evaluate(() => selection[0].id);
      const before = await source(tab);
      await keys("ArrowUp");
      assert.notEqual(await source(tab), before, `${id} is moved`);
      await keys("Control+z");
      assert.equal(await source(tab), before);
    });
    child.kill("SIGINT");
  });

  test("studio: places are typed exactly, and checked as they are typed", async () => {
    const { address, child } = await served(fresh(), "four-bar");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      await tab.locator("#sheet").focus();
      await tab.keyboard.press("]");
      await tab.keyboard.press("]");
      const x = tab.locator("#thing .triple input").first();
      await x.fill("10*sqrt(");
      await tab.waitForSelector('#thing [aria-invalid="true"]');
      assert.match(await tab.locator("#thing .wrong-words").allInnerTexts().then((t) => t.join("")), /./);
      await x.fill("10*sqrt(3)");
      await tab.waitForFunction(() => !document.querySelector('#thing [aria-invalid="true"]'));
      await x.press("Enter");
      await tab.waitForFunction(() => document.querySelector("#text").value.includes('"10*sqrt(3)"'));
      assert.match(await source(tab), /# crank, 30 mm/, "comments are kept");
      await tab.locator("#text-fold summary").click();
      await tab.locator("#text").fill((await source(tab)).replace('type = "revolute"', 'type = "revolut"'));
      await told(tab, "unknown joint type");
      assert.equal(await tab.locator("#beside li").count(), 1, "it stands beside the joint");
      await tab.locator("#problems button").first().click();
      assert.match(await tab.evaluate(() => { const t = document.querySelector("#text"); return t.value.slice(t.selectionStart, t.selectionEnd); }), /revolut/);
      await picture(tab, "studio-wrong", false);
    });
    child.kill("SIGINT");
  });

  test("studio: two windows on one file, another editor, and a conflict: nothing is lost", async () => {
    const folder = fresh();
    const file = path.join(folder, "mine.toml");
    const own = readFileSync(path.join(root, "catalogs/planar-linkages/four-bar.toml"), "utf8");
    writeFileSync(file, own);
    const { address, child, status } = await served(folder, "mine.toml");
    await windowed(address, {}, async (one) => {
      await windowed(address, {}, async (two) => {
        await ideas(one);
        await ideas(two);
        assert.equal((await status()).windows, 2);
        await one.evaluate(() => change(set("joint", "1-2", "type", "spherical")));
        await two.waitForFunction(() => document.querySelector("#text").value.includes("spherical\"\npoint"));
        const shared = await source(two);
        assert.equal(shared, await source(one));
        // what another editor writes is a conflict now, since this is not saved
        writeFileSync(file, own.replace("# coupler, 100 mm", "# theirs"));
        await one.waitForSelector("#notice-conflict");
        await two.waitForSelector("#notice-conflict");
        await two.locator('#notice-conflict button:has-text("Keep mine")').click();
        await one.waitForFunction(() => !document.querySelector("#notice-conflict"));
        assert.equal(await source(one), shared);
        await one.locator("#undo").click();
        await one.waitForFunction(() => document.querySelector("#text").value.includes("# theirs"));
        await one.locator("#redo").click();
        await one.locator("#save").click();
        await told(one, "· saved");
        assert.equal(readFileSync(file, "utf8"), shared);
        // saved, so what another editor writes is taken in
        writeFileSync(file, own.replace("# coupler, 100 mm", "# once more"));
        await two.waitForFunction(() => document.querySelector("#text").value.includes("# once more"));
        assert.deepEqual(readdirSync(folder), ["mine.toml"]);
      });
    });
    child.kill("SIGINT");
  });

  test("studio: a killed program and a killed browser lose nothing", async () => {
    const folder = fresh();
    cpSync(path.join(root, "catalogs/planar-linkages/four-bar.toml"), path.join(folder, "mine.toml"));
    const first = await served(folder, "mine.toml");
    let text = "";
    await windowed(first.address, { ends: true }, async (tab) => {
      await ideas(tab);
      await tab.evaluate(() => change(set("joint", "1-2", "type", "spherical")));
      text = await source(tab);
      first.child.kill("SIGKILL");
      await first.ended;
      await tab.waitForSelector("#notice-lost");
      assert.equal(await source(tab), text, "the window still has it");
    });
    assert.ok(existsSync(path.join(folder, "mine.toml.autosave")));
    const second = await served(folder, "mine.toml");
    await windowed(second.address, {}, async (tab) => {
      await tab.waitForSelector("#notice-left");
      assert.doesNotMatch(await source(tab), /spherical"\npoint/);
      await tab.locator('#notice-left button:has-text("Restore it")').click();
      await tab.waitForFunction(() => document.querySelector("#text").value.includes("spherical\"\npoint"));
      assert.equal(await source(tab), text);
    });
    // The window is closed: the program ends, says where the work is, and offers it again.
    const { code, said } = await second.ended;
    assert.equal(code, 0);
    assert.match(said, /unsaved work is in .*mine\.toml\.autosave/);
    const third = await served(folder, "mine.toml");
    await windowed(third.address, {}, async (tab) => {
      await tab.locator('#notice-left button:has-text("Restore it")').click();
      await tab.locator("#save:enabled").click();
      await told(tab, "· saved");
    });
    assert.equal(readFileSync(path.join(folder, "mine.toml"), "utf8"), text);
    await third.ended;
    assert.deepEqual(readdirSync(folder), ["mine.toml"]);
  });

  test("studio: names of a hostile file stay text", async () => {
    const folder = fresh();
    cpSync(path.join(import.meta.dirname, "hostile.toml"), path.join(folder, "hostile.toml"));
    const { address, child } = await served(folder, "hostile.toml");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      assert.equal(await tab.locator("#name").innerText(), "</script><script>alert(1)</script>");
      assert.equal(await tab.locator("script").count(), 1);
      await tab.locator("#sheet").focus();
      for (let i = 0; i < 8; i += 1) await tab.keyboard.press("]");
      await tab.locator(".idea:enabled").first().hover();
      await tab.locator(".idea:enabled").first().click();
      await tab.waitForFunction(() => desk.file.undo);
      assert.equal(await tab.locator("#side img").count(), 0);
      await picture(tab, "studio-hostile", false);
    });
    child.kill("SIGINT");
  });

  test("studio: pages of others are refused, and so is who has not the token", async () => {
    const { address, child } = await served(fresh(), "four-bar");
    const { host, port } = new URL(address);
    const edit = `${address}undo`;
    const own = { "content-type": "application/json", origin: `http://${host}` };
    assert.equal(await asked(edit, { method: "POST", headers: own }, "{}"), 200);
    for (const headers of [{ ...own, origin: "http://evil.example" }, { ...own, origin: "null" }, { "content-type": "application/json" }, { ...own, "sec-fetch-site": "cross-site" }, { ...own, host: `evil.example:${port}` }]) {
      assert.equal(await asked(edit, { method: "POST", headers }, "{}"), 403, JSON.stringify(headers));
    }
    assert.equal(await asked(edit, { method: "POST", headers: { ...own, "content-type": "text/plain" } }, "{}"), 415);
    assert.equal(await asked(`http://${host}/`, {}), 403);
    assert.equal(await asked(`http://${host}/${"0".repeat(32)}/status`, {}), 403);
    // A page of another origin, in the same browser, that knows the whole address.
    const other = http.createServer((_, answer) => answer.setHeader("content-type", "text/html").end("<!doctype html><title>other</title>"));
    await new Promise((resolve) => other.listen(0, "127.0.0.1", resolve));
    const tab = await browser.newPage();
    await tab.goto(`http://127.0.0.1:${other.address().port}/`);
    const got = await tab.evaluate(async (target) => {
      const reads = async (what) => {
        try {
          return (await what()) ? "read" : "nothing";
        } catch {
          return "refused";
        }
      };
      const frame = document.createElement("iframe");
      frame.src = target;
      document.body.append(frame);
      const image = new Image();
      const seen = new Promise((resolve) => Object.assign(image, { onload: () => resolve("read"), onerror: () => resolve("refused") }));
      image.src = `${target}icon.svg`;
      const events = new Promise((resolve) => {
        const from = new EventSource(`${target}events`);
        Object.assign(from, { onopen: () => resolve("read"), onerror: () => resolve("refused") });
      });
      await new Promise((resolve) => (frame.onload = resolve));
      return [
        await reads(async () => (await fetch(`${target}status`)).ok),
        await reads(async () => (await fetch(`${target}undo`, { method: "POST", headers: { "content-type": "application/json" }, body: "{}" })).ok),
        await seen,
        await events,
        await reads(async () => frame.contentDocument),
      ];
    }, address);
    assert.deepEqual(got, ["refused", "refused", "refused", "refused", "nothing"]);
    await tab.close();
    other.close();
    child.kill("SIGINT");
  });

  test("studio: a robot description is looked at, and takes an idea", async () => {
    const folder = fresh();
    cpSync(path.join(root, "tests/data/robots/gripper.xml"), path.join(folder, "gripper.xml"));
    const { address, child } = await served(folder, "gripper.xml");
    await windowed(address, {}, async (tab) => {
      await ideas(tab);
      await told(tab, "2 redundant constraints");
      assert.match(await tab.locator("#hint").innerText(), /read-only here; you can apply an idea/);
      await tab.locator(".idea:enabled").first().click();
      await tab.waitForFunction(() => desk.verdict?.analysis?.states[0].redundant === 0);
      await tab.locator("#save").click();
      await told(tab, "· saved");
      await picture(tab, "studio-robot", false);
    });
    assert.match(readFileSync(path.join(folder, "gripper.xml"), "utf8"), /ozols fix/);
    child.kill("SIGINT");
  });
}
