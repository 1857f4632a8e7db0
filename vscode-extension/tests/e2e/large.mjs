// Programs that VS Code treats as large: 400 000 lines, where it colours nothing by itself, and 51 MB, which it hands to no extension.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { open, remote, work } from './browser.mjs';
import { coloured, look, shots, squigglesUnder } from './look.mjs';

/** Rows over a plate with four tools; the fifth line has the letter O for a zero. */
function rows(lines, comment = '') {
  const text = ['%', 'O1000', 'G21 G90 G17 G54 G40', 'T1 M6', 'GO X0. Y0. S3000 M3', 'G43 Z5. H1', 'G1 Z-1. F500.'];
  for (let at = text.length; at < lines - 2; at += 1) {
    if (at % 100_000 === 0) text.push(`T${1 + at / 100_000} M6`, 'G0 X0. Y0.', `G43 Z5. H${1 + at / 100_000}`, 'G1 Z-1. F500.');
    else text.push(`G1 X${((at * 37) % 400).toFixed(1)} Y${(at / 2000).toFixed(4)}${comment}`);
  }
  return `${text.join('\n')}\nM30\n%\n`;
}

writeFileSync(`${work}/rows.nc`, rows(400_000));
writeFileSync(`${work}/huge.nc`, rows(1_000_000, ' (ROW BY ROW OVER THE WHOLE PLATE)'));
writeFileSync(`${work}/.vscode/settings.json`, '{ "trunnion.machine": "mill-3axis", "trunnion.dialect": "fanuc-30i" }');

const { page, test, until, backplotPage, finish } = await look('large');
const keys = page.keyboard;

async function goTo(line) {
  await keys.press('Control+g');
  await page.locator('.quick-input-widget input').first().waitFor();
  await keys.type(String(line));
  await keys.press('Enter');
}

await open(page, [['openFile', remote(`${work}/rows.nc`)]]);

await test('400 000 lines: a squiggle and a hover', async () => {
  const found = await until('squiggle under GO', () => page.evaluate(squigglesUnder, 'GO'), 90_000);
  assert.ok(found.classes.some((name) => name.includes('squiggly-error')), `${found.classes}`);
  await page.screenshot({ path: `${shots}/large.png` });
  await page.locator('.view-line', { hasText: 'G43' }).first().click();
  await keys.press('Home');
  await keys.press('Control+k');
  await keys.press('Control+i');
  await page.locator('.monaco-hover', { hasText: /length/i }).first().waitFor({ timeout: 30_000 });
  await keys.press('Escape');
});

await test('400 000 lines: the lines that are shown are coloured, at the end too', async () => {
  await goTo(399_000);
  await until('colours', async () => {
    const kinds = await page.evaluate(() => new Set([...document.querySelectorAll('.view-line span > span')].map((span) => getComputedStyle(span).color)).size);
    return kinds >= 3 || `${kinds} colours`;
  }, 30_000);
  await page.screenshot({ path: `${shots}/large-end.png` });
});

await test('400 000 lines: the outline names the tools', async () => {
  await keys.press('F1');
  await page.locator('.quick-input-widget input').first().waitFor();
  await keys.type('Explorer: Focus on Outline View');
  await keys.press('Enter');
  for (const tool of ['T1', 'T2', 'T4']) await page.locator('.outline-pane .monaco-list-row', { hasText: tool }).first().waitFor({ timeout: 60_000 });
  await page.locator('.tab', { hasText: /^rows\.nc/ }).first().click();
});

await test('400 000 lines: the backplot draws a level of detail and says so', async () => {
  await goTo(7);
  await keys.press('F1');
  await page.locator('.quick-input-widget input').first().waitFor();
  await keys.type('Trunnion: Show Backplot');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'Show Backplot' }).first().waitFor();
  await keys.press('Enter');
  const frame = await until('page of the backplot', backplotPage);
  const levels = new Set();
  await until('the coarse level, then all points', async () => {
    levels.add(Number(await frame.locator('#time').getAttribute('max')));
    return [...levels].some((most) => most > 0 && most <= 20_000) && Math.max(...levels) > 300_000 || JSON.stringify([...levels]);
  }, 90_000);
  await until('path', async () => {
    const { count } = await frame.evaluate(coloured);
    return count > 1000 || `${count} pixels`;
  });
  await page.screenshot({ path: `${shots}/large-backplot.png` });
});

await test('51 MB: the file on disk is checked', async () => {
  await open(page, [['openFile', remote(`${work}/huge.nc`)]]);
  // older versions open it at once
  const anyway = page.locator('.monaco-button', { hasText: 'Open Anyway' });
  const item = page.locator('.statusbar-item[id="trunnion.trunnion.trunnion.disk"]');
  await anyway.or(item).first().waitFor({ timeout: 60_000 });
  if (await anyway.count()) await anyway.click();
  await item.filter({ hasText: 'file on disk' }).waitFor({ timeout: 60_000 });
  await until('verdict', async () => /fail · the file on disk/.test(await item.innerText()) || (await item.innerText()), 90_000);
  await until('squiggle', async () => (await page.locator('[class*="squiggly-error"]').count()) > 0);
  await page.screenshot({ path: `${shots}/large-disk.png` });
});

await finish();
