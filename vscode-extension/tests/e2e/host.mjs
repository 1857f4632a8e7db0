// Runs host/index.js inside the extension host of the packaged extension; VS Code answers with the exit code.
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launch, open, remote } from './browser.mjs';

const browser = await launch();
const page = await browser.newPage();
let settle;
const finished = new Promise((resolve) => (settle = resolve));
await page.exposeFunction('codeAutomationLog', (_type, parts) => {
  const text = parts.join(' ');
  if (/ok - |passed, /.test(text)) console.log(text);
});
await page.exposeFunction('codeAutomationExit', (code) => settle(code));
await open(page, [
  ['extensionDevelopmentPath', remote(process.env.PACKED)],
  ['extensionTestsPath', remote(`${dirname(fileURLToPath(import.meta.url))}/host/index.js`)],
]);
const code = await Promise.race([finished, new Promise((resolve) => setTimeout(resolve, 120_000, 'none in 120 s'))]);
await browser.close();
if (code !== 0) console.log(`host: exit code ${code}`);
process.exit(code === 0 ? 0 : 1);
