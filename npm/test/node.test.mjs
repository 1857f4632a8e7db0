// The module says in Node what the command line says. Needs trunnion.wasm (scripts/wasm.sh) and the built program (TRUNNION_BIN).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { check, load } from "../index.mjs";
import { cases } from "./samples.mjs";

test("all samples: the document of the command line", async () => {
  const checker = await load();
  const all = cases();
  assert.ok(all.length > 100, `${all.length}`);
  const verdicts = new Set();
  for (const { name, machine, options, bytes, wanted } of all) {
    const found = checker.check(bytes, name, machine, options);
    assert.deepEqual(found, wanted, `${name} on ${machine}`);
    verdicts.add(found.files[0].verdict);
  }
  assert.deepEqual([...verdicts].sort(), ["fail", "pass", "unknown"]);
});

test("text and bytes are one program, in any encoding of its comments", async () => {
  const checker = await load();
  const text = "%\nO1 (Fr\u00e4sen)\nG21 G90 G94\nG1 X1.\nM30\n%\n";
  const utf8 = checker.check(text, "a.nc");
  assert.deepEqual(checker.check(new TextEncoder().encode(text), "a.nc"), utf8);
  const latin1 = checker.check(Uint8Array.from(text, (c) => c.charCodeAt(0)), "a.nc");
  assert.equal(latin1.files[0].verdict, utf8.files[0].verdict);
  for (const length of [0, 1, 2, 3, 4, 5]) assert.equal(checker.check("G1 X1"[0]?.repeat(length) ?? "", "a.nc").files.length, 1);
});

test("what cannot be checked is said, and what is no option is refused", async () => {
  const checker = await load();
  const report = checker.check("M30\n", "a.nc", "mil-3axis");
  assert.match(report.not_checked[0].message, /unknown machine `mil-3axis`.*mill-3axis/s);
  assert.throws(() => checker.check("M30\n", "a.nc", null, { machin: "x" }), /unknown option machin/);
  assert.throws(() => checker.check(5, "a.nc"), TypeError);
  assert.match(checker.check("M30\n", "a.nc", null, { deny: "all" }).not_checked[0].message, /options cannot be read/);
  // and goes on
  assert.equal(checker.check("G21 G90\nG0 X1.\nM30\n", "a.nc").files[0].motions, 1);
});

test("the shared checker, the lists and the versions", async () => {
  assert.equal((await check("M30\n", "a.nc")).schema, "trunnion-check/1");
  const lists = (await load()).lists();
  assert.ok(lists.machines.some((machine) => machine.name === "mill-3axis") && lists.rules.length > 60);
  const manifest = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));
  assert.equal(lists.version, manifest.version);
});
