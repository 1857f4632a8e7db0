// What tests of the workbench share: a page, tests with a picture of what failed, and looks at squiggles and at the backplot.
import { launch } from './browser.mjs';

export const shots = process.env.SHOTS;

/** In the page: `text` as it is drawn, and every squiggle that lies under it (same line, same columns, within 1.5 px). */
export function squigglesUnder(text) {
  const lines = [...document.querySelectorAll('.monaco-editor .view-line')];
  const line = lines.find((node) => node.textContent.includes(text));
  if (!line) return 'the text is not on the screen';
  const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT);
  const places = [];
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    for (let i = 0; i < node.data.length; i += 1) places.push([node, i]);
  }
  const start = line.textContent.indexOf(text);
  const range = document.createRange();
  range.setStart(...places[start]);
  const [last, offset] = places[start + text.length - 1];
  range.setEnd(last, offset + 1);
  const box = range.getBoundingClientRect();
  const under = [...document.querySelectorAll('.monaco-editor .view-overlays .cdr[class*="squiggly-"]')].filter((node) => {
    const place = node.getBoundingClientRect();
    const middle = (place.top + place.bottom) / 2;
    return Math.abs(place.left - box.left) < 1.5 && Math.abs(place.right - box.right) < 1.5 && middle > box.top - 2 && middle < box.bottom + 4;
  });
  const middle = { x: (box.left + box.right) / 2, y: (box.top + box.bottom) / 2 };
  return under.length > 0 ? { classes: under.map((node) => node.className), middle } : `no squiggle at ${JSON.stringify(box)}`;
}

/** In the page: how many pixels of the drawing have a colour, and where their middle one is. */
export function coloured() {
  const canvas = document.getElementById('view');
  const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
  const pen = copy.getContext('2d');
  pen.drawImage(canvas, 0, 0);
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  const found = [];
  for (let at = 0; at < data.length; at += 4) {
    const [r, g, b] = [data[at], data[at + 1], data[at + 2]];
    if (Math.max(r, g, b) - Math.min(r, g, b) > 90) found.push(at / 4);
  }
  const middle = found[Math.floor(found.length / 2)] ?? 0;
  const box = canvas.getBoundingClientRect();
  return { count: found.length, x: ((middle % copy.width) * box.width) / copy.width, y: (Math.floor(middle / copy.width) * box.height) / copy.height };
}

/** Opens a browser for a suite of tests. */
export async function look(suite) {
  const browser = await launch();
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  let passed = 0;
  let failed = 0;

  async function test(name, body) {
    try {
      await body();
      passed += 1;
      console.log(`ok - ${suite}: ${name}`);
    } catch (error) {
      failed += 1;
      console.log(`not ok - ${suite}: ${name}\n${error.stack}`);
      await page.screenshot({ path: `${shots}/failed-${name.replace(/\W+/g, '-')}.png` }).catch(() => undefined);
    }
  }

  /** Repeats until the answer is truthy; the last answer goes into the error. */
  async function until(what, ask, milliseconds = 60_000) {
    const end = Date.now() + milliseconds;
    let last;
    while (Date.now() < end) {
      last = await ask().catch((error) => error.message);
      if (last && typeof last !== 'string') return last;
      await page.waitForTimeout(200);
    }
    throw new Error(`no ${what} after ${milliseconds / 1000} s; last: ${JSON.stringify(last)}`);
  }

  /** Does something again until its answer is on the screen. VS Code drops a request of the keyboard when its own, which a moved cursor or a new
   *  finding starts a quarter of a second later, comes before the answer; a person presses the keys once more. */
  async function insist(answer, act) {
    for (let tries = 1; ; tries += 1) {
      await act();
      try {
        return await answer.waitFor({ timeout: 5_000 });
      } catch (error) {
        if (tries === 6) throw error;
      }
    }
  }

  /** The page of the backplot, among the frames in frames of a webview. */
  async function backplotPage() {
    for (const frame of page.frames()) {
      if (await frame.evaluate(() => document.getElementById('readout') !== null).catch(() => false)) return frame;
    }
    return undefined;
  }

  async function finish() {
    await browser.close();
    console.log(`${suite}: ${passed} passed, ${failed} failed`);
    process.exit(failed === 0 ? 0 : 1);
  }

  return { page, test, until, insist, backplotPage, finish };
}
