// Puts the package together: node build.mjs MODULE.wasm copies the module here and makes playground.html, one page that loads nothing.
import { copyFile, readFile, writeFile } from "node:fs/promises";

const here = (name) => new URL(name, import.meta.url);
const module = process.argv[2];
if (!module) {
  console.error("usage: node build.mjs target/wasm32-unknown-unknown/PROFILE/trunnion_wasm.wasm");
  process.exit(2);
}
await copyFile(module, here("trunnion.wasm"));
const library = (await readFile(here("index.mjs"), "utf8")).replaceAll(/^export /gm, "");
const script = await readFile(here("playground/playground.js"), "utf8");
const page = await readFile(here("playground/index.html"), "utf8");
const bytes = (await readFile(module)).toString("base64");
// functions, so that a `$` in a text is only a `$`
const whole = page
  .replace("/* LIBRARY */", () => library.replace('new URL("trunnion.wasm", import.meta.url)', "undefined"))
  .replace("/* SCRIPT */", () => script)
  .replace("<!-- MODULE -->", () => bytes);
await writeFile(here("playground.html"), whole);
console.log(`playground.html: ${(whole.length / 1e6).toFixed(1)} MB`);
