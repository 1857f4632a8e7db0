// Headless Chromium over the debugging pipe: no package and no port. CHROMIUM names another browser.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

// a busy computer is slow; a test never waits this long in vain
const LONGEST_MS = 240_000;

export class Browser {
  #process;
  #profile = mkdtempSync(join(tmpdir(), "trunnion-browser-"));
  #open = new Map();
  #next = 1;
  #rest = "";

  constructor() {
    const words = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", `--user-data-dir=${this.#profile}`, "--remote-debugging-pipe"];
    this.#process = spawn(process.env.CHROMIUM ?? "chromium", words, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.#process.on("error", (error) => this.#fail(error));
    this.#process.on("exit", (status) => this.#fail(new Error(`the browser ended with status ${status}`)));
    this.#process.stdio[3].on("error", (error) => this.#fail(error));
    this.#process.stdio[4].setEncoding("utf8").on("data", (text) => this.#read(text));
  }

  #fail(error) {
    for (const { reject } of this.#open.values()) reject(error);
    this.#open.clear();
  }

  #read(text) {
    const parts = (this.#rest + text).split("\0");
    this.#rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      const waiting = this.#open.get(message.id);
      if (!waiting) continue;
      this.#open.delete(message.id);
      if (message.error) waiting.reject(new Error(message.error.message));
      else waiting.resolve(message.result);
    }
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#open.set(id, { resolve, reject });
      this.#process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }

  /** Opens a page of this size. */
  async page(url, width = 1280, height = 800) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const send = (method, params) => this.send(method, params, sessionId);
    await send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await send("Page.navigate", { url });
    const value = async (expression) => {
      const { result, exceptionDetails } = await send("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    };
    return {
      value,
      /** Waits until the text of the page has the pattern. */
      async shows(pattern) {
        const end = Date.now() + LONGEST_MS;
        let text = "";
        while (Date.now() < end) {
          text = (await value("document.body ? document.body.innerText : ''")) ?? "";
          if (pattern.test(text)) return text;
          await new Promise((later) => setTimeout(later, 100));
        }
        throw new Error(`no ${pattern} in: ${text.slice(0, 2000)}`);
      },
      /** Waits until the page and its scripts are loaded. */
      loaded: () => value("new Promise((done) => { if (document.readyState === 'complete') done(); else addEventListener('load', () => done()); })"),
      /** What the reader prefers, "light" or "dark"; the page has followed. */
      async scheme(wanted) {
        await send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: wanted }] });
        await value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())))");
      },
      picture: async () => Buffer.from((await send("Page.captureScreenshot", { format: "png" })).data, "base64"),
    };
  }

  async close() {
    const ended = new Promise((resolve) => this.#process.once("exit", resolve));
    this.#process.kill();
    await ended;
    // its own processes may still write there for a moment; what stays is a folder of temporary files
    try {
      rmSync(this.#profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 200 });
    } catch (error) {
      console.warn(`not removed: ${this.#profile}: ${error.code}`);
    }
  }
}
