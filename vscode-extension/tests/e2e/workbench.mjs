// What a person sees: strategy 2 opens, `C52.595` has a squiggle under it, the status bar names machine and dialect.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { open, remote, work } from './browser.mjs';
import { coloured, look, shots, squigglesUnder } from './look.mjs';

const settings = `${work}/.vscode/settings.json`;
const set = (values) => writeFileSync(settings, JSON.stringify(values));
const { page, test, until, backplotPage, finish } = await look('workbench');

await open(page, [['openFile', remote(`${work}/strategy-2.mpf`)]]);

await test('a squiggle under C52.595', async () => {
  const { classes } = await until('squiggle under C52.595', () => page.evaluate(squigglesUnder, 'C52.595'), 90_000);
  assert.ok(classes.some((name) => /squiggly-(warning|error)/.test(name)), `classes: ${classes}`);
  await page.screenshot({ path: `${shots}/squiggle.png` });
});

await test('A0.081 beside it has none of its own', async () => {
  assert.equal(typeof (await page.evaluate(squigglesUnder, 'A0.081')), 'string');
});

await test('the status bar names machine and dialect', async () => {
  const item = page.locator('.statusbar-item', { hasText: 'mikron-ucp710' });
  await item.waitFor({ timeout: 20_000 });
  assert.match(await item.innerText(), /mikron-ucp710 · sinumerik-840d/);
});

await test('words are coloured', async () => {
  const kinds = await page.evaluate(() => {
    const line = [...document.querySelectorAll('.view-line')].find((node) => node.textContent.includes('C52.595'));
    return new Set([...line.querySelectorAll('span > span')].map((span) => getComputedStyle(span).color)).size;
  });
  assert.ok(kinds >= 2, `${kinds} colour(s) on the line of N2930`);
});

await test('the hover of the squiggle names the rule', async () => {
  // a code lens that comes late moves the lines below it
  await page.locator('.codelens-decoration', { hasText: 'T1' }).waitFor({ timeout: 20_000 });
  let last;
  const { middle } = await until('squiggle under C52.595 that stays', async () => {
    const found = await page.evaluate(squigglesUnder, 'C52.595');
    const before = last;
    last = found.middle && JSON.stringify(found.middle);
    return last !== undefined && before === last ? found : last;
  });
  await page.mouse.move(middle.x - 3, middle.y);
  await page.mouse.move(middle.x, middle.y);
  const hover = page.locator('.monaco-hover', { hasText: 'pole-flip' }).first();
  await hover.waitFor({ timeout: 20_000 });
  await page.screenshot({ path: `${shots}/hover.png` });
});

await test('a click on the status bar offers the machines, the choice is used', async () => {
  await page.keyboard.press('Escape');
  const item = page.locator('.statusbar-item', { hasText: 'mikron-ucp710' });
  await item.click();
  const rows = page.locator('.quick-input-list .monaco-list-row');
  await rows.filter({ hasText: 'mikron-ucp710' }).waitFor({ timeout: 20_000 });
  await page.screenshot({ path: `${shots}/machines.png` });
  await rows.filter({ hasText: 'ferrari-bc' }).click();
  await page.locator('.statusbar-item', { hasText: 'ferrari-bc' }).waitFor({ timeout: 20_000 });
  // the command line finds it there too, and no setting overrides it
  assert.match(readFileSync(`${work}/trunnion.toml`, 'utf8'), /^machine = "ferrari-bc"$/m);
  assert.equal(JSON.parse(readFileSync(settings, 'utf8'))['trunnion.machine'], undefined);
});

await test('the backplot draws the path, follows the cursor, and a click on it goes to the line', async () => {
  set({ 'trunnion.machine': 'mikron-ucp710' });
  await page.locator('.statusbar-item', { hasText: 'mikron-ucp710' }).waitFor({ timeout: 20_000 });
  await page.locator('.editor-actions a[aria-label^="Show Backplot"]').first().click();
  const frame = await until('page of the backplot', backplotPage);
  const drawn = await until('path', async () => {
    const found = await frame.evaluate(coloured);
    return found.count > 50 ? found : JSON.stringify(found);
  });
  assert.match(await frame.locator('#legend').innerText(), /Findings/);
  // from the line to the path
  await page.locator('.view-line', { hasText: 'C52.595' }).click();
  await until('line of the flip', async () => /^line 10 /.test(await frame.locator('#readout').innerText()) || (await frame.locator('#readout').innerText()));
  await page.screenshot({ path: `${shots}/backplot.png` });
  // and back
  await frame.locator('#top').click();
  const place = await until('path from above', async () => {
    const found = await frame.evaluate(coloured);
    return found.count > 20 ? found : JSON.stringify(found);
  });
  assert.ok(drawn.count > 0);
  await frame.locator('#view').click({ position: { x: place.x, y: place.y } });
  const line = /^line (\d+) /.exec(await frame.locator('#readout').innerText())?.[1];
  // the backplot keeps the focus, so the status bar names no position
  await until(`cursor on line ${line}`, async () => (await page.locator('.line-numbers.active-line-number').first().innerText()) === line);
  await frame.locator('#mode').selectOption('feed');
  assert.match(await frame.locator('#legend').innerText(), /Feed that the axes allow/);
  await page.screenshot({ path: `${shots}/backplot-feed.png` });
  // the machine: its bodies are far more than the lines of the path
  const lines = (await frame.evaluate(coloured)).count;
  await frame.locator('#machine').check();
  await until('machine', async () => {
    const { count } = await frame.evaluate(coloured);
    return count > 3 * lines + 1000 || `${count} after ${lines}`;
  });
  await page.screenshot({ path: `${shots}/backplot-machine.png` });
  await page.locator('.tab', { hasText: /^strategy-2\.mpf/ }).first().click();
});

await test('the walkthrough leads to the machine and to the backplot', async () => {
  await page.locator('.view-line').first().click();
  await page.keyboard.press('F1');
  await page.locator('.quick-input-widget input').first().waitFor();
  await page.keyboard.type('Welcome: Open Walkthrough');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'Open Walkthrough' }).first().click();
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'Get started with Trunnion' }).first().click();
  const steps = page.locator('.gettingStartedContainer .step-title');
  await until('steps', async () => (await steps.allInnerTexts()).length >= 5 || JSON.stringify(await steps.allInnerTexts()));
  assert.deepEqual((await steps.allInnerTexts()).slice(-5), ['Open a program', 'Choose your machine', 'Read the findings', 'Fix one with the light bulb', 'Look at the path']);
  await page.locator('.gettingStartedContainer .getting-started-step', { hasText: 'Choose your machine' }).click();
  await page.locator('.gettingStartedContainer .getting-started-step.expanded', { hasText: 'Choose Machine' }).waitFor();
  await page.screenshot({ path: `${shots}/walkthrough-machine.png` });
  await page.locator('.gettingStartedContainer .getting-started-step', { hasText: 'Look at the path' }).click();
  await page.waitForTimeout(1500);
  await page.screenshot({ path: `${shots}/walkthrough-backplot.png` });
  // the program is not in front now, and is found all the same
  await page.locator('.gettingStartedContainer .getting-started-step.expanded .monaco-button', { hasText: 'Show Backplot' }).click();
  await until('page of the backplot', backplotPage);
  await page.locator('.notification-list-item', { hasText: 'Open a program first' }).waitFor({ state: 'detached', timeout: 1000 });
  await page.locator('.tab', { hasText: /^strategy-2\.mpf/ }).first().click();
});

await test('a program that is not there is named in a message, and a good setting ends it', async () => {
  set({ 'trunnion.machine': 'mikron-ucp710', 'trunnion.path': '/no/such/program' });
  await page.locator('.statusbar-item[id="trunnion.trunnion.trunnion.status"]', { has: page.locator('.codicon-warning') }).waitFor({ timeout: 30_000 });
  // the smoke-test driver keeps messages in the notification centre, so open that
  await page.locator('.statusbar-item[id="status.notifications"]').click();
  await page.locator('.notification-list-item', { hasText: '"/no/such/program"' }).waitFor({ timeout: 30_000 });
  await page.screenshot({ path: `${shots}/missing.png` });
  await until('no squiggle without a server', () => page.evaluate(squigglesUnder, 'C52.595').then((found) => typeof found === 'string'));
  set({ 'trunnion.machine': 'mikron-ucp710' });
  await until('squiggle under C52.595', () => page.evaluate(squigglesUnder, 'C52.595'));
});

await finish();
