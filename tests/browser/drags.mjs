// Links that are dragged, and points that are traced.

import assert from "node:assert/strict";
import { open, report } from "./pages.mjs";

/** Where on the screen the middle of a link's outline is. */
const placeOf = (tab, name) => tab.evaluate((wanted) => {
  const { scene, sight } = player;
  const wire = scene.wires.find((w) => w.of === null && scene.names[w.link] === wanted && /bone|plate/.test(w.class));
  const middle = wire.points.slice(0, 2).reduce((a, b) => a.map((x, i) => x + b[i])).map((x) => x / 2);
  const p = carried(poseNow(), wire.link, middle);
  const along = (axis) => axis.reduce((sum, x, i) => sum + x * p[i], 0);
  const on = [along(sight.view[0]) * sight.fit.scale + sight.fit.at[0], -along(sight.view[1]) * sight.fit.scale + sight.fit.at[1]];
  const box = document.querySelector("#built .turn svg").getBoundingClientRect();
  const room = roomOf(scene);
  const scale = Math.min(box.width / room[2], box.height / room[3]);
  return [box.left + box.width / 2 + (on[0] - room[0] - room[2] / 2) * scale, box.top + box.height / 2 + (on[1] - room[1] - room[3] / 2) * scale];
}, name);

/** Rodrigues' formula, for what the page has its own code. */
function turnedBy(v, r) {
  const angle = Math.hypot(...r);
  if (angle < 1e-12) return v;
  const k = r.map((x) => x / angle);
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  const kv = k.reduce((sum, x, i) => sum + x * v[i], 0);
  const kxv = [k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]];
  return v.map((x, i) => x * c + kxv[i] * s + k[i] * kv * (1 - c));
}

/** How far joints gape in a pose, in pixels: places of hinges and balls apart, axes of hinges and slides out of line. */
function gapOf(scene, pose) {
  const at = (link, p) => (pose[link].length ? turnedBy(p, pose[link].slice(0, 3)).map((x, i) => x + pose[link][3 + i]) : p);
  const way = (link, v) => (pose[link].length ? turnedBy(v, pose[link].slice(0, 3)) : v);
  const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
  let most = 0;
  for (const j of scene.joints) {
    if (!j.pair) continue;
    const [a, b] = j.links;
    const { free } = j.pair;
    if (!free.some((f) => f[0] === "t" || f === "screw")) most = Math.max(most, apart(at(a, j.at), at(b, j.at)));
    const turns = free.filter((f) => f[0] === "r" || f === "screw");
    if (turns.every((f) => f === "rz" || f === "screw")) most = Math.max(most, 50 * apart(way(a, j.axes[2]), way(b, j.axes[2])));
    if (turns.length === 0) most = Math.max(most, 50 * apart(way(a, j.axes[0]), way(b, j.axes[0])));
    if (free.join() === "tz") {
      const off = at(a, j.at).map((x, i) => x - at(b, j.at)[i]);
      const z = way(b, j.axes[2]);
      const along = off.reduce((sum, x, i) => sum + x * z[i], 0);
      most = Math.max(most, Math.hypot(...off.map((x, i) => x - along * z[i])));
    }
  }
  return most;
}

export function dragTests(test, { gripper }) {
  test("every link can be dragged, and the joints stay closed", async () => {
    const mechanisms = ["delta-universal", "bennett", "rssr", "y-star", "geared-five-bar", "scott-russell"];
    const pages = [gripper, ...mechanisms.map((m) => report(`${m}-dragged`, m))];
    for (const file of pages) {
      await open(file, { reducedMotion: "reduce" }, async (tab) => {
        const scene = await tab.evaluate(() => player.scene);
        const names = [...new Set(scene.wires.filter((w) => w.of === null && /bone|plate/.test(w.class)).map((w) => scene.names[w.link]))];
        assert.ok(names.length > 1);
        let went = 0;
        for (const name of names) {
          await tab.locator('[data-part="range"]').fill(String(scene.moves[0].start));
          await tab.locator("#built .turn").scrollIntoViewIfNeeded();
          const [x, y] = await placeOf(tab, name);
          await tab.mouse.move(x, y);
          await tab.mouse.down();
          for (let i = 1; i <= 6; i += 1) {
            await tab.mouse.move(x + 3 * i, y + 2 * i);
            const pose = await tab.evaluate(() => player.pulled);
            if (!pose) break;
            const gap = gapOf(scene, pose);
            assert.ok(gap < 0.1, `${file} ${name}: a gap of ${gap} pixels`);
            went = Math.max(went, ...pose.map((p) => Math.hypot(...p)));
          }
          await tab.mouse.up();
        }
        assert.ok(went > 1, `${file}: something moved`);
      });
    }
  });

  test("the equations of joints hold in every pose of every motion", async () => {
    const mechanisms = ["screw-jack", "y-star", "planetary-gear", "geared-gripper", "delta-universal", "tricept", "3-crr"];
    for (const m of mechanisms) {
      await open(report(`${m}-equations`, m), { reducedMotion: "reduce" }, async (tab) => {
        const gaps = await tab.evaluate(() => page.scenes.flatMap((scene) => scene.moves.map((move) => {
          const ahead = move.poses.slice(move.start);
          const back = move.poses.slice(0, move.start + 1).reverse();
          return Math.max(...[ahead, back].flatMap((way) => way.map((_, i) => pullable(scene, way.slice(0, i + 1)).gap())));
        })));
        // poses are written to a hundredth of a pixel, turns to 1e-5
        assert.ok(gaps.length > 0 && gaps.every((g) => g < 0.06), `${m}: ${gaps}`);
      });
    }
  });

  test("points are traced", async () => {
    await open(gripper, { reducedMotion: "reduce" }, async (tab) => {
      await tab.locator('[data-part="trace"]').click();
      assert.equal(await tab.locator('[data-part="trace"]').getAttribute("aria-pressed"), "true");
      await tab.locator("#built .turn").scrollIntoViewIfNeeded();
      await tab.mouse.click(...(await placeOf(tab, "3")));
      assert.equal(await tab.locator('[data-part="trace"]').getAttribute("aria-pressed"), "false");
      assert.equal(await tab.locator("#built .trace.point").count(), 1);
      assert.equal(await tab.evaluate(() => player.traced.length), 1);
      await tab.locator('[data-part="untrace"]').click();
      assert.equal(await tab.evaluate(() => player.traced.length), 0);
    });
  });
}
