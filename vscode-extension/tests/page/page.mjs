// The page of the backplot in Chromium, without VS Code: what VS Code gives it (colours, messages) comes from here.
import { build } from 'esbuild';
import { readFileSync } from 'node:fs';
import { chromium } from 'playwright-core';

const here = (path) => new URL(`../../${path}`, import.meta.url);

/** Colours as VS Code hands them to a page. */
export const THEMES = {
  dark: { kind: 'vscode-dark', '--vscode-editor-background': '#1e1e1e', '--vscode-editor-foreground': '#d4d4d4', '--vscode-foreground': '#cccccc', '--vscode-focusBorder': '#007fd4', '--vscode-button-secondaryBackground': '#3a3d41', '--vscode-button-secondaryForeground': '#ffffff', '--vscode-dropdown-background': '#3c3c3c', '--vscode-dropdown-foreground': '#f0f0f0', '--vscode-descriptionForeground': '#b0b0b0' },
  light: { kind: 'vscode-light', '--vscode-editor-background': '#ffffff', '--vscode-editor-foreground': '#000000', '--vscode-foreground': '#616161', '--vscode-focusBorder': '#0090f1', '--vscode-button-secondaryBackground': '#5f6a79', '--vscode-button-secondaryForeground': '#ffffff', '--vscode-dropdown-background': '#ffffff', '--vscode-dropdown-foreground': '#000000', '--vscode-descriptionForeground': '#717171' },
  'high contrast': { kind: 'vscode-high-contrast', '--vscode-editor-background': '#000000', '--vscode-editor-foreground': '#ffffff', '--vscode-foreground': '#ffffff', '--vscode-focusBorder': '#f38518', '--vscode-contrastBorder': '#6fc3df', '--vscode-button-secondaryForeground': '#ffffff', '--vscode-dropdown-background': '#000000', '--vscode-dropdown-foreground': '#ffffff', '--vscode-descriptionForeground': '#ffffff' },
};

/** Opens the page in a theme; `said` collects what it says to the extension. */
export async function open(theme, viewport = { width: 1200, height: 800 }) {
  const { outputFiles } = await build({ entryPoints: [here('src/page.ts').pathname], bundle: true, write: false, format: 'esm', logLevel: 'silent' });
  const { page: markup } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString('base64')}`);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader'],
  });
  const page = await browser.newPage({ viewport });
  const said = [];
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  await page.exposeFunction('said', (message) => void said.push(message));
  const files = {
    '/': ['text/html', markup({ script: '/backplot.js', style: '/backplot.css', source: 'http://page.test', nonce: 'test' })],
    '/backplot.js': ['text/javascript', readFileSync(here('dist/backplot.js'))],
    '/backplot.css': ['text/css', readFileSync(here('media/backplot.css'))],
  };
  await page.route('**/*', (route) => {
    const [contentType, body] = files[new URL(route.request().url()).pathname] ?? ['text/plain', ''];
    return route.fulfill({ contentType, body });
  });
  const { kind, ...variables } = THEMES[theme];
  await page.addInitScript(({ kind, variables }) => {
    let state;
    globalThis.acquireVsCodeApi = () => ({ postMessage: (message) => void globalThis.said(message), getState: () => state, setState: (next) => (state = next) });
    addEventListener('DOMContentLoaded', () => {
      document.body.classList.add(kind);
      for (const [name, value] of Object.entries(variables)) document.documentElement.style.setProperty(name, value);
      document.documentElement.style.setProperty('--vscode-font-family', 'sans-serif');
      document.documentElement.style.setProperty('--vscode-font-size', '13px');
      document.body.style.background = variables['--vscode-editor-background'];
    });
  }, { kind, variables });
  await page.goto('http://page.test/');
  return { browser, page, said, errors };
}

/** Hands a path to the page, and waits until it is drawn. */
export async function show(page, title, { summary, bytes }) {
  await page.evaluate(({ title, summary, base64 }) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
    postMessage({ type: 'path', title, summary, bytes }, '*');
  }, { title, summary, base64: bytes.toString('base64') });
  await page.waitForFunction(() => Number(document.getElementById('time').max) > 0);
  await settled(page);
}

/** Hands over what is drawn over it. */
export async function over(page, title, { summary, bytes }) {
  await page.evaluate(({ title, summary, base64 }) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
    postMessage({ type: 'other', title, summary, bytes }, '*');
  }, { title, summary, base64: bytes.toString('base64') });
  await page.locator('#other').waitFor({ state: 'attached' });
  await settled(page);
}

/** Two frames: what was asked for is on the canvas. */
export const settled = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** What is on the canvas in three dimensions: how often each colour, a sum over all, and the pixels of a rotary axis (ochre). */
export const pixels = (page) =>
  page.evaluate(() => {
    const canvas = document.getElementById('view');
    const gl = canvas.getContext('webgl2');
    const all = new Uint8Array(canvas.width * canvas.height * 4);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
    const count = {};
    let sum = 0;
    const ochre = [];
    for (let k = 0; k < all.length; k += 4) {
      const colour = (all[k] << 16) | (all[k + 1] << 8) | all[k + 2];
      count[colour] = (count[colour] ?? 0) + 1;
      sum = (Math.imul(sum, 31) + colour) | 0;
      if (all[k] > 100 && all[k] > 1.2 * all[k + 1] && all[k + 1] > 3 * all[k + 2]) ochre.push(k / 4);
    }
    return { count, sum, ochre };
  });
