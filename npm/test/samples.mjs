// The samples, each for several machines, with what the command line says about them.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../..", import.meta.url));
const binary = process.env.TRUNNION_BIN ?? join(root, "target/debug/trunnion");
const MACHINES = [null, "mill-3axis", "mikron-ucp710"];

function commandLine(path, machine, options) {
  const words = ["check", "--format", "json", path, ...options, ...(machine ? ["--machine", machine] : [])];
  try {
    return execFileSync(binary, words, { cwd: root, maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  } catch (error) {
    // 1: something is found
    if (error.status !== 1) throw error;
    return error.stdout;
  }
}

/** Cases: name, machine, options, the bytes of the program, and the document of the command line. */
export function cases() {
  const folder = join(root, "samples/programs");
  const names = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name).slice(root.length))
    .sort();
  // the settings that the command line finds above the programs
  const files = { "trunnion.toml": readFileSync(join(root, "samples/trunnion.toml"), "utf8") };
  const found = [];
  for (const name of names) {
    for (const machine of MACHINES) {
      const options = machine ? ["--assume", "tool-length"] : [];
      const wanted = JSON.parse(commandLine(name, machine, options));
      const given = machine ? { files, assume: ["tool-length"] } : { files };
      found.push({ name, machine, options: given, bytes: readFileSync(join(root, name)), wanted });
    }
  }
  return found;
}
