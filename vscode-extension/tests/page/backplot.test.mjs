// The page of the backplot in Chromium: what is drawn, and that all of it is reached by keys and seen in high contrast.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { build } from 'esbuild';
import { open, over, pixels, settled, show } from './page.mjs';
import { path } from './server.mjs';

const here = (name) => new URL(`../../${name}`, import.meta.url).pathname;
const built = ['release', 'debug'].map((kind) => here(`../target/${kind}/trunnion`)).filter(existsSync);
const trunnion = process.env.TRUNNION_BIN ?? built.sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs)[0];
const chromium = existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium');
const skip = trunnion === undefined ? 'there is no built trunnion' : !chromium && 'there is no Chromium';

const folder = mkdtempSync(join(tmpdir(), 'trunnion-page-'));
after(() => rmSync(folder, { recursive: true }));

/** A frustum of a cone for a machine, and what the server says of its path. */
async function cone(machine) {
  const file = join(folder, `${machine}.mpf`);
  writeFileSync(join(folder, 'trunnion.toml'), '[work_offsets]\nG54 = { X = 20, Y = -10, Z = 30 }\n');
  execFileSync(trunnion, ['sample', 'cone', '--machine', machine, '--tilt', '20', '-o', file], { stdio: 'pipe' });
  return path(trunnion, file, join(folder, 'path.bin'), { machine });
}

const differ = (a, b) => Object.entries(a.count).reduce((sum, [colour, many]) => sum + Math.abs(many - (b.count[colour] ?? 0)), 0);
const seek = (page, share) =>
  page.locator('#time').evaluate((slider, at) => {
    slider.value = String(Math.round(at * Number(slider.max)));
    slider.dispatchEvent(new Event('input'));
  }, share);

let mikron;
before(async () => {
  if (!skip) mikron = await cone('mikron-ucp710');
});

test('the machine moves, and the part alone does not', { skip }, async () => {
  const { browser, page, errors } = await open('dark');
  try {
    await show(page, 'cone', mikron);
    const part = await pixels(page);
    await page.locator('#machine').check();
    await settled(page);
    const first = await pixels(page);
    assert.ok(differ(part, first) > 2000, 'the machine is drawn');
    await seek(page, 0.4);
    await settled(page);
    const later = await pixels(page);
    // the table is tilted otherwise: it covers other pixels, more than the tool hides of it
    const [was, is] = [new Set(first.ochre), new Set(later.ochre)];
    const changed = [...was].filter((pixel) => !is.has(pixel)).length + [...is].filter((pixel) => !was.has(pixel)).length;
    assert.ok(was.size > 4_000 && changed > 0.3 * was.size, `${changed} of ${was.size} pixels`);
    await page.locator('#machine').uncheck();
    await settled(page);
    await seek(page, 0);
    await settled(page);
    assert.ok(differ(part, await pixels(page)) < 200, 'the part is where it was');
    assert.equal(await page.locator('#notice').textContent(), '');
    assert.deepEqual(errors, []);
  } finally {
    await browser.close();
  }
});

test('part and spindle meet where the axes say, on every kind of machine', { skip }, async () => {
  const { outputFiles } = await build({
    stdin: { contents: "export * from './src/webview/chain'; export * from './src/webview/path'; export { Vector3 } from 'three';", resolveDir: here('.') },
    bundle: true, write: false, format: 'esm', platform: 'node', logLevel: 'silent',
  });
  const module = join(folder, 'chain.mjs');
  writeFileSync(module, outputFiles[0].text);
  const { read, setUp, bodyAt, jointsAt, carried, kindOf, START, Vector3 } = await import(module);
  for (const machine of ['mikron-ucp710', 'fork-head-ca', 'head-table-bc', 'nutating-head-b45', 'nutating-table-b45', 'linuxcnc-xyzac-trt']) {
    const { bytes, summary } = machine === 'mikron-ucp710' ? mikron : await cone(machine);
    const drawn = read(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
    const { axes } = summary.machine;
    const found = setUp(drawn, axes, new Vector3());
    assert.equal(found.others, 0, machine);
    // the same the other way: a tip on the part, carried by the table, is where the head holds it
    let compared = 0;
    for (let at = 0; at < drawn.count; at += 7) {
      const joints = jointsAt(drawn, at);
      if (!joints) continue;
      const table = carried(axes);
      const onPart = new Vector3().fromArray(drawn.tip, 3 * at).add(found.offset);
      if (table > 0) onPart.applyMatrix4(bodyAt(axes, joints, 0));
      const inHead = found.tip.clone();
      if (axes.length > table) inHead.applyMatrix4(bodyAt(axes, joints, axes.length - 1));
      assert.ok(onPart.distanceTo(inHead) < 0.02, `${machine}: ${onPart.distanceTo(inHead)} mm at ${at}`);
      compared += 1;
      // half way to the next vertex, where play draws too
      const half = at + 1 < drawn.count && kindOf(drawn, at + 1) !== START && jointsAt(drawn, at, 0.5);
      if (!half) continue;
      const tip = new Vector3().fromArray(drawn.tip, 3 * at).lerp(new Vector3().fromArray(drawn.tip, 3 * at + 3), 0.5).add(found.offset);
      if (table > 0) tip.applyMatrix4(bodyAt(axes, half, 0));
      const head = found.tip.clone();
      if (axes.length > table) head.applyMatrix4(bodyAt(axes, half, axes.length - 1));
      assert.ok(tip.distanceTo(head) < 0.1, `${machine}: ${tip.distanceTo(head)} mm behind ${at}`);
    }
    assert.ok(compared > 40, `${machine}: ${compared}`);
  }
});

test('before and after are seen in space, in the plane of the tool axis and over the axes', { skip }, async () => {
  const file = join(folder, 'flip.mpf');
  const text = readFileSync(here('tests/e2e/programs/strategy-2.mpf'), 'utf8');
  writeFileSync(file, text);
  const before = await path(trunnion, file, join(folder, 'path.bin'), { machine: 'mikron-ucp710' });
  // the block at the pole keeps its posture, and the next one lies 0.5 mm beside it
  writeFileSync(file, text.replace('A0.081 C52.595', 'A0.081 C4.822').replace('X-28.38873', 'X-28.88873'));
  const after = await path(trunnion, file, join(folder, 'path.bin'), { machine: 'mikron-ucp710' });
  for (const theme of ['light', 'high contrast']) {
    const { browser, page, said, errors } = await open(theme);
    try {
      await show(page, 'flip', before);
      const drawn = async () => ({ space: await pixels(page), ...(await page.evaluate(() => Object.fromEntries(['plane', 'joints'].map((id) => [id, document.getElementById(id).toDataURL()])))) });
      await seek(page, 0);
      const alone = await drawn();
      await over(page, 'after smooth-pole', after);
      assert.match(await page.locator('#legend').textContent(), /after smooth-pole/);
      const both = await drawn();
      assert.ok(differ(alone.space, both.space) > 40, `${theme}: ${differ(alone.space, both.space)} pixels`);
      assert.ok(alone.plane !== both.plane, 'the plane of the tool axis');
      assert.ok(alone.joints !== both.joints, 'the axes');
      if (process.env.TRUNNION_SHOTS) await page.screenshot({ path: join(process.env.TRUNNION_SHOTS, `before-after-${theme.replace(' ', '-')}.png`) });
      assert.deepEqual(said.at(-1), { type: 'compared', vertices: after.summary.vertices });
      // a new text of the program ends the comparison
      await show(page, 'flip', before);
      assert.doesNotMatch(await page.locator('#legend').textContent(), /after/);
      await seek(page, 0);
      assert.ok((await drawn()).joints === alone.joints, 'the axes alone again');
      assert.deepEqual(errors, []);
    } finally {
      await browser.close();
    }
  }
});

test('the bodies of the machine stand out in high contrast, and an axis at the end of its travel is marked', { skip }, async () => {
  for (const theme of ['high contrast', 'light']) {
    const { browser, page, errors } = await open(theme);
    try {
      await show(page, 'cone', mikron);
      const alone = (await pixels(page)).count;
      await page.locator('#machine').check();
      await settled(page);
      // edges in the colour of text, smoothed
      const inked = (count) => Object.entries(count).reduce((sum, [colour, many]) => {
        const parts = [16, 8, 0].map((shift) => (Number(colour) >> shift) & 255);
        return sum + (parts.every((part) => (theme === 'light' ? part < 70 : part > 170)) ? many : 0);
      }, 0);
      const { count } = await pixels(page);
      if (process.env.TRUNNION_SHOTS) await page.screenshot({ path: join(process.env.TRUNNION_SHOTS, `machine-${theme.replace(' ', '-')}.png`) });
      assert.ok(inked(count) > inked(alone) + 800, `${theme}: ${inked(count)} pixels of edges after ${inked(alone)}`);
      const near = { bytes: mikron.bytes, summary: structuredClone(mikron.summary) };
      const tilt = near.summary.machine.axes.find(({ letter }) => letter === 'A');
      tilt.limits = [-0.001, 0.001];
      await show(page, 'at the end', near);
      await settled(page);
      const marked = Object.entries((await pixels(page)).count).filter(([colour]) => {
        const [r, g, b] = [16, 8, 0].map((shift) => (Number(colour) >> shift) & 255);
        return r > 100 && r > 1.8 * g && g > 3 * b;
      });
      assert.ok(marked.reduce((sum, [, many]) => sum + many, 0) > 300, `${theme}: vermilion bodies`);
      assert.deepEqual(errors, []);
    } finally {
      await browser.close();
    }
  }
});

test('a program in inch is read in inch', { skip }, async () => {
  const { browser, page, errors } = await open('dark');
  try {
    const read = async (unit, x, feed) => {
      const file = join(folder, 'unit.nc');
      writeFileSync(file, `${unit} G90 G17 G94 G54\nG0 X0. Y0. Z0.\nG1 X${x} F${feed}\nM30\n`);
      const answer = await path(trunnion, file, join(folder, 'path.bin'), { machine: 'mill-3axis', dialect: 'fanuc-30i', assume: ['work-offset', 'tool-length'] });
      await show(page, unit, answer);
      await seek(page, 1);
      await page.locator('#mode').selectOption('deviation');
      return `${await page.locator('#readout').textContent()} ${await page.locator('#legend').textContent()}`;
    };
    const inch = await read('G20', '2.', '10.');
    assert.match(inch, /X 2\.00000 .*F 10 in\/min.*tolerance 0\.000394 in/s);
    assert.doesNotMatch(inch, / mm/);
    assert.match(await read('G21', '50.8', '254.'), /X 50\.800 .*F 254 mm\/min.*tolerance 0\.01 mm/s);
    assert.deepEqual(errors, []);
  } finally {
    await browser.close();
  }
});

test('each control is reached and worked by keys', { skip }, async () => {
  const { browser, page, said } = await open('dark');
  try {
    await show(page, 'cone', mikron);
    const reached = [];
    for (let step = 0; step < 14; step += 1) {
      await page.keyboard.press('Tab');
      const { id, outline } = await page.evaluate(() => ({ id: document.activeElement.id, outline: getComputedStyle(document.activeElement).outlineStyle }));
      if (id === '') break;
      reached.push(id);
      assert.equal(outline, 'solid', `the focus is seen on ${id}`);
    }
    assert.deepEqual(reached, ['mode', 'iso', 'top', 'front', 'right', 'rapids', 'normals', 'tool', 'machine', 'view', 'play', 'time']);
    await page.locator('#machine').focus();
    await page.keyboard.press('Space');
    assert.ok(await page.locator('#machine').isChecked());
    await page.locator('#view').focus();
    for (const key of ['ArrowLeft', 'ArrowUp', '+', 'Home']) {
      const was = (await pixels(page)).sum;
      await page.keyboard.press(key);
      await settled(page);
      assert.notEqual((await pixels(page)).sum, was, `${key} changes the view`);
    }
    await page.locator('#time').focus();
    const was = await page.locator('#readout').textContent();
    await page.keyboard.press('End');
    assert.notEqual(await page.locator('#readout').textContent(), was);
    assert.ok(said.some(({ type }) => type === 'pick'), 'the editor is told the line');
    await page.keyboard.press('Home');
    await page.locator('#play').focus();
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('#play').textContent(), 'Stop');
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('#play').textContent(), 'Play');
  } finally {
    await browser.close();
  }
});

for (const theme of ['high contrast', 'dark', 'light']) {
  test(`text and controls stand out: ${theme}`, { skip }, async () => {
    const { browser, page } = await open(theme);
    try {
      await show(page, 'cone', mikron);
      const found = await page.evaluate(() => {
        const rgba = (text) => text.match(/[\d.]+/g).map((part, at) => Number(part) * (text.startsWith('color(') && at < 3 ? 255 : 1));
        const light = (colour) => {
          const [r, g, b] = colour.slice(0, 3).map((value) => (value / 255 <= 0.03928 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
          return 0.2126 * r + 0.7152 * g + 0.0722 * b;
        };
        const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
        const behind = (element) => {
          for (let at = element; at; at = at.parentElement) {
            const colour = rgba(getComputedStyle(at).backgroundColor);
            if (colour.length < 4 || colour[3] > 0.5) return colour;
          }
          return [255, 255, 255];
        };
        const texts = [...document.querySelectorAll('button, select, label, #readout, #legend strong, #legend span')];
        const page = behind(document.body);
        return {
          texts: texts.map((element) => [element.textContent.trim().slice(0, 30), contrast(rgba(getComputedStyle(element).color), behind(element))]),
          swatches: [...document.querySelectorAll('#legend i')].map((swatch) => [swatch.parentElement.textContent, contrast(rgba(swatch.style.background), page)]),
          borders: [...document.querySelectorAll('button, select')].map((element) => [element.id, contrast(rgba(getComputedStyle(element).borderTopColor), page)]),
        };
      });
      // WCAG 2.1: 4.5 for text, 3 for what is not text
      for (const [text, contrast] of found.texts) assert.ok(contrast >= 4.5, `${text}: ${contrast}`);
      assert.equal(found.swatches.length, 5);
      if (theme !== 'light') for (const [text, contrast] of found.swatches) assert.ok(contrast >= 3, `${text}: ${contrast}`);
      if (theme === 'high contrast') for (const [id, contrast] of found.borders) assert.ok(contrast >= 3, `${id}: ${contrast}`);
    } finally {
      await browser.close();
    }
  });
}
