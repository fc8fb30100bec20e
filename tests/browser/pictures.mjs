// The screenshots of the README: `.ci/pictures` calls this with the folder that takes them.

import { execFileSync } from "node:child_process";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { browser, ozols } from "./pages.mjs";
import { fresh, served } from "./windows.mjs";

const out = path.resolve(process.argv[2]);
const folder = fresh();
const run = (...words) => execFileSync(ozols, words, { cwd: folder, stdio: "ignore" });

/** Writes a screenshot of an address once something is there: two thirds of the pixels, as a README shows three side by side. */
async function shot(name, address, there) {
  const tab = await browser.newPage({ viewport: { width: 1280, height: 880 }, deviceScaleFactor: 0.66 });
  // A busy machine may take minutes.
  tab.setDefaultTimeout(300_000);
  await tab.goto(address);
  await tab.waitForSelector(there);
  await tab.screenshot({ path: path.join(out, `${name}.png`) });
  await tab.close();
}
const page = (name) => pathToFileURL(path.join(folder, name)).href;

const { address, child } = await served(folder, "gripper-10");
await shot("studio", address, ".idea");
child.kill();

run("report", "gripper-10-loaded", "-o", "report.html");
await shot("report", page("report.html"), "#verdict");

run("catalog", "build", "--classics", "-o", "known.db");
run("catalog", "page", "known.db", "-o", "known.html");
await shot("catalogue", page("known.html"), "#cards .card");

await browser.close();
