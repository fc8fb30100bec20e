// The screenshots of the README: `.ci/pictures` calls this with the folder that takes them.

import { execFileSync } from "node:child_process";
import path from "node:path";
import { browser, open, ozols } from "./pages.mjs";
import { fresh, ideas, served, windowed } from "./windows.mjs";

const out = path.resolve(process.argv[2]);
const folder = fresh();
const run = (...words) => execFileSync(ozols, words, { cwd: folder, stdio: "ignore" });
// Two thirds of the pixels, as wide as a README shows them side by side.
const small = { viewport: { width: 1280, height: 880 }, deviceScaleFactor: 0.66 };
const shot = (tab, name) => tab.screenshot({ path: path.join(out, `${name}.png`) });

const { address, child } = await served(folder, "gripper-10");
await windowed(address, small, async (tab) => {
  await ideas(tab);
  await shot(tab, "studio");
});
child.kill();

run("report", "gripper-10-loaded", "-o", "report.html");
await open(path.join(folder, "report.html"), small, (tab) => shot(tab, "report"));

run("catalog", "build", "--classics", "-o", "known.db");
run("catalog", "page", "known.db", "-o", "known.html");
await open(path.join(folder, "known.html"), small, (tab) => shot(tab, "catalogue"));

await browser.close();
