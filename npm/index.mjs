// `trunnion check` in the browser and in Node. The module trunnion.wasm touches no file and no network; this file carries texts in and out of it.

const FIELDS = new Map([
  ["dialect", "dialect"], ["tool", "tool"], ["allow", "allow"], ["portTo", "port_to"], ["assume", "assume"], ["blockDelete", "block_delete"],
  ["scope", "scope"], ["deny", "deny"], ["files", "files"],
]);

/** The checker, loaded once: `load()` makes one. */
export class Checker {
  #module;
  #exports;

  constructor(module, instance) {
    this.#module = module;
    this.#exports = instance.exports;
  }

  #push(to, bytes) {
    const { trunnion_push: push } = this.#exports;
    const whole = bytes.length - (bytes.length % 4);
    for (let at = 0; at < whole; at += 4) {
      push(to, bytes[at] | (bytes[at + 1] << 8) | (bytes[at + 2] << 16) | (bytes[at + 3] << 24), 4);
    }
    for (let at = whole; at < bytes.length; at += 1) push(to, bytes[at], 1);
  }

  #pull(length) {
    const words = new Uint8Array((length + 3) & ~3);
    const view = new DataView(words.buffer);
    for (let at = 0; at < length; at += 4) view.setUint32(at, this.#exports.trunnion_pull(at / 4), true);
    return JSON.parse(new TextDecoder().decode(words.subarray(0, length)));
  }

  #run(work) {
    try {
      return work();
    } catch (error) {
      // after a trap the memory of an instance is in no known state
      this.#exports = new WebAssembly.Instance(this.#module, {}).exports;
      if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) {
        throw new Error(`the program was not checked: ${error.message}; the command line may still check it`, { cause: error });
      }
      throw error;
    }
  }

  /**
   * The document of `trunnion check --format json` for one program (text, or bytes as they lie on disk).
   * What cannot be checked is listed in `not_checked`.
   */
  check(text, name, machine, options = {}) {
    const request = { name: String(name) };
    if (machine !== undefined && machine !== null) request.machine = machine;
    for (const [key, value] of Object.entries(options)) {
      if (!FIELDS.has(key)) throw new TypeError(`unknown option ${key}; known: ${[...FIELDS.keys()].join(", ")}`);
      if (value !== undefined && value !== null) request[FIELDS.get(key)] = value;
    }
    const encoder = new TextEncoder();
    const bytes = typeof text === "string" ? encoder.encode(text) : text;
    if (!(bytes instanceof Uint8Array)) throw new TypeError("the program must be a string or a Uint8Array");
    return this.#run(() => {
      this.#push(0, encoder.encode(JSON.stringify(request)));
      this.#push(1, bytes);
      return this.#pull(this.#exports.trunnion_check() >>> 0);
    });
  }

  /** Machines, dialects and rules that are built in. */
  lists() {
    return this.#run(() => this.#pull(this.#exports.trunnion_lists() >>> 0));
  }
}

/** Loads the checker: from bytes, a compiled module, a Response or an address; without any, the module beside this file. */
export async function load(source) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytesOf(source));
  // browsers refuse to do this at once on a page if the module is large
  return new Checker(module, await WebAssembly.instantiate(module, {}));
}

async function bytesOf(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  const from = source ?? new URL("trunnion.wasm", import.meta.url);
  if (from instanceof URL && from.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    return readFile(from);
  }
  const response = from instanceof Response ? from : await fetch(from);
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

let shared;

/** Checks one program with the module beside this file. */
export async function check(text, name, machine, options) {
  shared ??= load();
  return (await shared).check(text, name, machine, options);
}
