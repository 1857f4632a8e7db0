// In headless Chromium: the playground from a file, all samples on a page, and the package from a small server on this computer.
// Prints `N passed, N failed`. PICTURES=FOLDER keeps pictures of the playground.
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";
import { legibleInBoth } from "./legible.mjs";
import { cases } from "./samples.mjs";

const here = fileURLToPath(new URL("..", import.meta.url));
const scratch = mkdtempSync(join(tmpdir(), "trunnion-page-"));
const browser = new Browser();
let passed = 0;
let failed = 0;

async function step(name, work) {
  try {
    await work();
    passed += 1;
    console.log(`ok ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`not ok ${name}: ${error.message}`);
  }
}

function keep(name, picture) {
  if (process.env.PICTURES) writeFileSync(join(process.env.PICTURES, name), picture);
}

const playground = pathToFileURL(join(here, "playground.html")).href;

await step("the playground, opened as a file, checks, follows the editor and explains", async () => {
  const page = await browser.page(playground);
  const first = await page.shows(/FAIL first\.nc on mill-3axis: 10 of 10 blocks run, 4 motions/);
  if (!/error\[missing-feed\] line 7/.test(first)) throw new Error(first);
  keep("playground.png", await page.picture());
  // an edit, as from the keyboard
  await page.value(`program.value = program.value.replace("G1 X10.\\n", ""); program.dispatchEvent(new Event("input"))`.replaceAll("program.", 'document.getElementById("program").'));
  await page.shows(/UNKNOWN first\.nc on mill-3axis: 9 of 9 blocks run/);
  await page.value(`document.getElementById("assume").click()`);
  await page.shows(/PASS first\.nc on mill-3axis[^]*Assumed: G54 = 0/);
  // another example, and a finding that leads to its line
  await page.value(`const e = document.getElementById("example"); e.value = "1"; e.dispatchEvent(new Event("change"))`);
  await page.shows(/FAIL vane\.mpf on mikron-ucp710/);
  await page.value(`[...document.querySelectorAll("button.place")].find((b) => b.textContent.includes("pole-flip")).click()`);
  const chosen = await page.value(`(() => { const p = document.getElementById("program"); return p.value.slice(p.selectionStart, p.selectionEnd); })()`);
  if (!chosen.startsWith("N2930 ")) throw new Error(`the finding leads to ${chosen}`);
  keep("playground-five-axis.png", await page.picture());
  await page.scheme("dark");
  keep("playground-dark.png", await page.picture());
});

await step("the playground in light and in dark", async () => {
  const page = await browser.page(playground);
  await page.shows(/FAIL first/);
  for (const [example, verdict] of [["0", /FAIL first/], ["1", /FAIL vane/]]) {
    await page.value(`{ const e = document.getElementById("example"); e.value = "${example}"; e.dispatchEvent(new Event("change")); }`);
    await page.shows(verdict);
    await legibleInBoth(page);
  }
});

await step("a program that calls another one in an added file", async () => {
  const page = await browser.page(playground);
  await page.shows(/FAIL first/);
  const main = "%\\nO1\\nG21 G90 G94 G17\\nG54 G0 X0. Y0. Z5.\\nM98 P2000\\nG0 Z5.\\nM30\\n%\\n";
  await page.value(`(() => { const p = document.getElementById("program"); p.value = "${main}"; p.dispatchEvent(new Event("input")); })()`);
  await page.shows(/missing-subprogram/);
  // as the file dialog does
  const sub = "%\\nO2000\\nG0 X7.\\nM99\\n%\\n";
  await page.value(`(() => { const t = new DataTransfer(); t.items.add(new File(["${sub}"], "O2000.nc")); const m = document.getElementById("more"); m.files = t.files; m.dispatchEvent(new Event("change")); })()`);
  const said = await page.shows(/Added: O2000\.nc/);
  if (/missing-subprogram/.test(await page.shows(/6 of 6 blocks run|7 of 7 blocks run/))) throw new Error(said);
});

await step("all samples in the browser: the document of the command line", async () => {
  const all = cases().map((one) => ({ ...one, bytes: one.bytes.toString("base64") }));
  const library = readFileSync(join(here, "index.mjs"), "utf8").replaceAll(/^export /gm, "");
  const script = `
    const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const ordered = (value) => Array.isArray(value) ? value.map(ordered) : value && typeof value === "object"
      ? Object.fromEntries(Object.keys(value).sort().map((key) => [key, ordered(value[key])])) : value;
    const data = (id) => document.getElementById(id).textContent;
    const checker = await load(bytes(data("module")));
    const all = JSON.parse(new TextDecoder().decode(bytes(data("cases"))));
    let same = 0;
    const other = [];
    for (const one of all) {
      const found = checker.check(bytes(one.bytes), one.name, one.machine, one.options);
      if (JSON.stringify(ordered(found)) === JSON.stringify(ordered(one.wanted))) same += 1;
      else other.push(one.name + " on " + one.machine);
    }
    document.body.textContent = "done: " + same + " of " + all.length + " the same; other: " + (other.join(", ") || "none");`;
  const data = (id, text) => `<script id="${id}" type="application/octet-stream">${text}</script>`;
  const module = readFileSync(join(here, "trunnion.wasm")).toString("base64");
  const packed = Buffer.from(JSON.stringify(all)).toString("base64");
  const own = library.replace('new URL("trunnion.wasm", import.meta.url)', "undefined");
  const file = join(scratch, "samples.html");
  writeFileSync(file, `<!doctype html><meta charset="utf-8"><body>${data("module", module)}${data("cases", packed)}<script type="module">${own}${script}</script></body>`);
  const page = await browser.page(pathToFileURL(file).href);
  const said = await page.shows(/done: /);
  if (all.length < 100 || !said.includes(`done: ${all.length} of ${all.length} the same; other: none`)) throw new Error(said);
  console.log(`  ${said}`);
});

await step("the package, served from this computer", async () => {
  const types = { ".mjs": "text/javascript", ".wasm": "application/wasm", ".html": "text/html" };
  const html = `<!doctype html><body>waiting<script type="module">import { check } from "./index.mjs";
    const report = await check("%\\nO1\\nG21 G90 G94\\nG1 X1.\\nM30\\n%\\n", "a.nc");
    document.body.textContent = "verdict: " + report.files[0].verdict;</script></body>`;
  const server = createServer((request, response) => {
    const name = request.url === "/" ? "/page.html" : request.url;
    const known = ["/index.mjs", "/trunnion.wasm"].includes(name);
    if (name !== "/page.html" && !known) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": types[extname(name)] });
    return response.end(known ? readFileSync(join(here, name)) : html);
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  try {
    const page = await browser.page(`http://127.0.0.1:${server.address().port}/`);
    await page.shows(/verdict: fail/);
  } finally {
    server.closeAllConnections();
    server.close();
  }
});

if (process.env.PICTURES) {
  const page = await browser.page(playground, 480, 900);
  await page.shows(/FAIL first/);
  keep("playground-narrow.png", await page.picture());
}
await browser.close();
rmSync(scratch, { recursive: true, force: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
