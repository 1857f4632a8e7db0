// In headless Chromium: the playground from a file, all samples on a page, and the package from a small server on this computer.
// Prints `N passed, N failed`. CHROMIUM names the browser; PICTURES=FOLDER keeps pictures of the playground.
import { execFile } from "node:child_process";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { cases } from "./samples.mjs";

const here = fileURLToPath(new URL("..", import.meta.url));
const scratch = mkdtempSync(join(tmpdir(), "trunnion-page-"));
const browser = process.env.CHROMIUM ?? "chromium";
let passed = 0;
let failed = 0;

async function chromium(url, ...more) {
  const words = ["--headless", "--no-sandbox", "--disable-gpu", `--user-data-dir=${join(scratch, "profile")}`, "--virtual-time-budget=60000", "--timeout=120000"];
  const { stdout } = await promisify(execFile)(browser, [...words, ...more, url], { maxBuffer: 1 << 28, timeout: 240_000 });
  return stdout;
}

async function step(name, work) {
  try {
    await work();
    passed += 1;
    console.log(`ok ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`not ok ${name}: ${String(error.message).slice(0, 2000)}`);
  }
}

function holds(text, pattern) {
  if (!pattern.test(text)) throw new Error(`no ${pattern} in ${text.replace(/<script id="module"[\s\S]*?<\/script>/, "").slice(0, 6000)}`);
}

const playground = pathToFileURL(join(here, "playground.html")).href;

await step("the playground checks its example, opened as a file", async () => {
  const page = await chromium(playground, "--dump-dom");
  holds(page, /<p id="verdict" class="fail">FAIL first\.nc on mill-3axis: 10 of 10 blocks run, 4 motions/);
  holds(page, /error\[missing-feed\]/);
  holds(page, /<option value="mikron-ucp710">/);
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
    document.body.replaceChildren("same: " + same + " of " + all.length + "; other: " + other.join(", "));`;
  const data = (id, text) => `<script id="${id}" type="application/octet-stream">${text}</script>`;
  const module = readFileSync(join(here, "trunnion.wasm")).toString("base64");
  const packed = Buffer.from(JSON.stringify(all)).toString("base64");
  const file = join(scratch, "samples.html");
  writeFileSync(file, `<!doctype html><body>${data("module", module)}${data("cases", packed)}<script type="module">${library.replace(
    'new URL("trunnion.wasm", import.meta.url)', "undefined")}${script}</script></body>`);
  const page = await chromium(pathToFileURL(file).href, "--dump-dom");
  holds(page, new RegExp(`same: ${all.length} of ${all.length}; other: <`));
  console.log(`  ${all.length} documents`);
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
    holds(await chromium(`http://127.0.0.1:${server.address().port}/`, "--dump-dom"), /verdict: fail/);
  } finally {
    server.close();
  }
});

if (process.env.PICTURES) {
  await chromium(playground, "--window-size=1280,800", `--screenshot=${join(process.env.PICTURES, "playground.png")}`);
  await chromium(playground, "--window-size=1280,800", "--blink-settings=preferredColorScheme=0", `--screenshot=${join(process.env.PICTURES, "playground-dark.png")}`);
  await chromium(playground, "--window-size=480,900", `--screenshot=${join(process.env.PICTURES, "playground-narrow.png")}`);
}
rmSync(scratch, { recursive: true, force: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
