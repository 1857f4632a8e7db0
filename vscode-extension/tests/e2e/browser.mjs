// Chromium without a screen, on the VS Code that run.sh started.
import { chromium } from 'playwright-core';

const { CHROMIUM, PORT, RUN } = process.env;
const host = `127.0.0.1:${PORT}`;

/** The folder the tests open: copies of the programs. */
export const work = `${RUN}/work`;

/** A path on the server's disk, as the workbench writes it. */
export const remote = (path) => `vscode-remote://${host}${path}`;

export async function launch() {
  return chromium.launch({
    executablePath: CHROMIUM,
    headless: true,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader'],
  });
}

/** Opens the workbench on the folder, with what its URL may carry. */
export async function open(page, payload) {
  const query = `folder=${work}&payload=${encodeURIComponent(JSON.stringify(payload))}`;
  await page.goto(`http://${host}/?${query}`, { waitUntil: 'domcontentloaded', timeout: 60_000 });
}
