// A new user: a clean profile without settings, a program with a mistake. Choose a machine, break the program, mend it by the light bulb, look at
// completion, hover and outline, rename a variable, format, have a rewrite proved and see it in the backplot. scripts/lsp_tee.py records this session.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { open, remote, work } from './browser.mjs';
import { coloured, look, shots, squigglesUnder } from './look.mjs';

const { page, test, until, insist, backplotPage, finish } = await look('newcomer');
const keys = page.keyboard;
const rows = page.locator('.quick-input-list .monaco-list-row');
const status = page.locator('.statusbar-item[id="trunnion.trunnion.trunnion.status"]');
/** The text on the screen; blanks are drawn as spaces that do not break. */
const text = async () => {
  const lines = await page.locator('.editor-group-container .view-line').evaluateAll((nodes) => nodes.map((node) => [node.getBoundingClientRect().top, node.innerText]));
  return lines.sort(([a], [b]) => a - b).map(([, line]) => line).join('\n').replaceAll('\u00a0', ' ');
};
const line = (part) => page.locator('.view-line', { hasText: part }).first();

async function command(name) {
  await keys.press('F1');
  await page.locator('.quick-input-widget input').first().waitFor();
  await keys.type(name);
  await rows.filter({ hasText: name }).first().waitFor({ timeout: 10_000 });
  await keys.press('Enter');
}

/** Puts the cursor into a word, whose letters may have several colours. */
async function into(word) {
  const found = await page.evaluate((word) => {
    const line = [...document.querySelectorAll('.monaco-editor .view-line')].find((node) => node.textContent.includes(word));
    if (!line) return undefined;
    const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT);
    const places = [];
    for (let node = walker.nextNode(); node; node = walker.nextNode()) for (let at = 0; at < node.data.length; at += 1) places.push([node, at]);
    const [node, at] = places[line.textContent.indexOf(word) + 1];
    const range = document.createRange();
    range.setStart(node, at);
    range.setEnd(node, at + 1);
    const box = range.getBoundingClientRect();
    return { x: (box.left + box.right) / 2, y: (box.top + box.bottom) / 2 };
  }, word);
  assert.ok(found, `${word} is not on the screen`);
  await page.mouse.click(found.x, found.y);
}

await open(page, [['openFile', remote(`${work}/part.nc`)]]);

await test('without settings the status bar says that there is no machine', async () => {
  await status.filter({ hasText: 'no machine' }).waitFor({ timeout: 60_000 });
  await until('dialect', async () => /fanuc-30i/.test(await status.innerText()) || (await status.innerText()));
});

await test('a click there chooses a machine, and writes it down', async () => {
  await status.click();
  await rows.filter({ hasText: 'mill-3axis' }).first().click();
  await status.filter({ hasText: 'mill-3axis' }).waitFor({ timeout: 20_000 });
  assert.match(readFileSync(`${work}/trunnion.toml`, 'utf8'), /^machine = "mill-3axis"$/m);
});

await test('a mistake gets a squiggle, and the light bulb mends it', async () => {
  await line('N50').click();
  await keys.press('Home');
  for (let step = 0; step < 5; step += 1) await keys.press('ArrowRight');
  await keys.press('Delete');
  await keys.type('O');
  await until('squiggle under GO', () => page.evaluate(squigglesUnder, 'GO'));
  await page.screenshot({ path: `${shots}/mistake.png` });
  // the list of completions is open
  await keys.press('Escape');
  await keys.press('ArrowLeft');
  await insist(page.locator('.action-widget .monaco-list-row', { hasText: 'write G0' }), () => keys.press('Control+.'));
  await page.screenshot({ path: `${shots}/light-bulb.png` });
  // the first one has the focus; older versions take no click while the menu opens
  await keys.press('Enter');
  await until('the code that was meant', async () => /N50 G0 X0\./.test(await text()) || (await text()));
});

await test('completion explains the codes, and a hover the block', async () => {
  await line('N130').click();
  await keys.press('End');
  await keys.press('Enter');
  await keys.type('G8');
  await insist(page.locator('.suggest-widget .monaco-list-row', { hasText: 'G81' }).first(), () => keys.press('Control+Space'));
  await page.screenshot({ path: `${shots}/completion.png` });
  await keys.press('Escape');
  await line('N140').click();
  // back to the text before, and no farther
  await until('the old text', async () => {
    const now = await text();
    if (/N130 M5\nN140/.test(now)) return true;
    await keys.press('Control+z');
    return now;
  });
  await into('N110');
  await insist(page.locator('.monaco-hover', { hasText: 'feed' }).first(), async () => {
    await keys.press('Control+k');
    await keys.press('Control+i');
  });
  await keys.press('Escape');
});

await test('F2 renames a variable at all places', async () => {
  await into('#100');
  const box = page.locator('.rename-box input');
  await insist(box, () => keys.press('F2'));
  await box.fill('#110');
  await keys.press('Enter');
  await until('the new name', async () => /#110=12\.5/.test(await text()) && /y#110/i.test(await text()) || (await text()));
});

await test('the outline names program and tool', async () => {
  await command('Explorer: Focus on Outline View');
  await page.locator('.outline-pane .monaco-list-row', { hasText: 'T1' }).waitFor({ timeout: 20_000 });
  await page.locator('.outline-pane .monaco-list-row', { hasText: 'O1000' }).waitFor({ timeout: 20_000 });
  await line('N110').click();
});

await test('formatting puts the block straight', async () => {
  await command('Format Document');
  await until('straight block', async () => /^N110 G1 Y#110/m.test(await text()) || (await text()));
});

await test('a rewrite is proved, shown before and after, and applied', async () => {
  await command('Trunnion: Rewrite the Program, Proved');
  await rows.filter({ hasText: 'drop-redundant' }).first().waitFor({ timeout: 20_000 });
  await page.screenshot({ path: `${shots}/rewrites.png` });
  await rows.filter({ hasText: 'drop-redundant' }).first().click();
  await rows.filter({ hasText: 'before and after' }).click();
  const frame = await until('page of the backplot', backplotPage);
  await until('overlay', async () => (await frame.locator('#other').count()) > 0);
  assert.match(await frame.locator('#legend').innerText(), /after drop-redundant/);
  await rows.filter({ hasText: 'Show the certificate' }).click();
  await page.locator('.view-line', { hasText: '"schema"' }).first().waitFor({ timeout: 20_000 });
  await page.waitForTimeout(500);
  await page.screenshot({ path: `${shots}/certificate.png` });
  await rows.filter({ hasText: 'Apply' }).click();
  await page.locator('.tab', { hasText: /^part\.nc/ }).first().click();
  await until('shorter program', async () => !/X20\./.test(await text()) || (await text()));
});

await test('the backplot follows, and its machine moves with the slider', async () => {
  await line('N110').click();
  await page.locator('.editor-actions a[aria-label^="Show Backplot"]').first().click();
  const frame = await until('page of the backplot', backplotPage);
  const lines = (await frame.evaluate(coloured)).count;
  await frame.locator('#machine').check();
  const first = await until('machine', async () => {
    const found = await frame.evaluate(coloured);
    return found.count > 1.5 * lines + 100 ? found : `${found.count} pixels after ${lines}`;
  });
  const picture = () => frame.evaluate(() => document.getElementById('view').toDataURL());
  await frame.locator('#time').focus();
  await keys.press('Home');
  const was = await picture();
  await keys.press('End');
  await until('another place of the axes', async () => (await picture()) !== was);
  assert.ok(first.count > lines);
  // the status bar stays while the backplot has the focus
  assert.match(await status.innerText(), /mill-3axis/);
  await page.screenshot({ path: `${shots}/machine-moves.png` });
});

await test('what was edited is saved and read again without a finding that was not there', async () => {
  await page.locator('.tab', { hasText: /^part\.nc/ }).first().click();
  await keys.press('Control+s');
  await until('saved text', async () => /#110=12\.5/.test(readFileSync(`${work}/part.nc`, 'utf8')));
  assert.ok(!(await page.locator('.squiggly-error').count()), 'no error is left');
});

await finish();
