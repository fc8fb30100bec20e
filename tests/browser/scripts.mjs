// The scripts of the pages, looked at before they are run: they can be read, each name stands once and is used, and nothing in
// them makes markup or code of a text. Lines and functions are such that a person reads them at one sitting.

import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

const root = path.resolve(import.meta.dirname, "../..");
const read = (file) => readFileSync(path.join(root, file), "utf8");
/** The scripts that a page has, in the order of its Rust file. */
const listed = (file, pattern, folder) => [...read(file).matchAll(pattern)].map((m) => path.join(folder, m[1]));

const report = listed("src/show/page.rs", /include_str!\("(page\/script\/[\w/]+\.js)"\)/g, "src/show");
const shared = Number(/SHARED: \[&str; (\d+)\]/.exec(read("src/show/page.rs"))[1]);
const PAGES = {
  report,
  studio: [...report.slice(0, shared), ...listed("src/studio/routes.rs", /include_str!\("([\w/]+\.js)"\)/g, "src/studio")],
  catalogue: listed("src/show/page/catalogue.rs", /include_str!\("(script\/[\w/]+\.js)"\)/g, "src/show/page"),
};

/** What no script may have, and why. */
const NEVER = [
  [/\b(innerHTML|outerHTML|insertAdjacentHTML|document\.write|srcdoc)\b\s*[=(]/, "makes markup of a text"],
  [/\beval\(|new Function\(|setTimeout\("/, "makes code of a text"],
  [/\bon(click|load|error|input|change|key\w+)=/, "has a handler in markup"],
  [/\bvar\b (?!of)\w+ =/, "has var"],
  [/[^=!<>]==[^=]|!=[^=]/, "compares loosely"],
  [/\t| $/, "has a tab, or blanks at the end of a line"],
  [/^.{301}/, "is longer than 300 letters"],
  [/\bdebugger\b|console\.log/, "is left from a search for a mistake"],
];
const [LINES, FUNCTION] = [450, 65];

const wrong = [];
for (const file of new Set(Object.values(PAGES).flat())) {
  const lines = read(file).split("\n");
  if (lines.length > LINES) wrong.push(`${file} has ${lines.length} lines`);
  lines.forEach((line, n) => {
    if (line.trimStart().startsWith("//") || line.trimStart().startsWith("/*")) return;
    for (const [pattern, why] of NEVER) if (pattern.test(line)) wrong.push(`${file}:${n + 1} ${why}: ${line.trim().slice(0, 80)}`);
    if (!/^(async )?function /.test(line)) return;
    const long = lines.slice(n).findIndex((l) => l === "}");
    if (long >= FUNCTION) wrong.push(`${file}:${n + 1} is a function of ${long} lines`);
  });
}
for (const [page, files] of Object.entries(PAGES)) {
  if (!files.length) wrong.push(`${page} has no scripts`);
  const whole = files.map(read).join("");
  const at = path.resolve(root, process.env.CARGO_TARGET_DIR ?? "target", "browser", `${page}.js`);
  writeFileSync(at, whole);
  try {
    execFileSync(process.execPath, ["--check", at], { stdio: ["ignore", "ignore", "pipe"] });
  } catch (e) {
    wrong.push(`${page}: ${e.stderr}`);
  }
  const names = [...whole.matchAll(/^(?:async )?(?:function|const|let) (\w+)/gm)].map((m) => m[1]);
  const seen = new Set();
  for (const name of names) {
    if (seen.has(name)) wrong.push(`${page}: ${name} stands twice`);
    seen.add(name);
    if ([...whole.matchAll(new RegExp(`\\b${name}\\b`, "g"))].length < 2) wrong.push(`${page}: ${name} is used nowhere`);
  }
}
if (wrong.length) {
  console.log(wrong.join("\n"));
  process.exit(1);
}
console.log(`ok: ${Object.values(PAGES).flat().length} scripts of ${Object.keys(PAGES).length} pages`);
