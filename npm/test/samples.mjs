// The samples, each for several machines, with what the command line says about them.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { dirname, join, relative, sep } from "node:path";
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

/** The settings that the command line finds above a program, and the dialect tables by the names that they have there. */
function settings(program, tables) {
  let folder = dirname(program);
  while (!existsSync(join(root, folder, "trunnion.toml"))) folder = dirname(folder);
  const text = (name) => readFileSync(join(root, name), "utf8");
  const named = tables.map((table) => [relative(folder, table).replaceAll(sep, "/"), text(table)]);
  return { "trunnion.toml": text(join(folder, "trunnion.toml")), ...Object.fromEntries(named) };
}

/** Cases: name, machine, options, the bytes of the program, and the document of the command line. */
export function cases() {
  const all = readdirSync(join(root, "samples"), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name).slice(root.length))
    .sort();
  // what is no program: settings, machines, dialect tables and the page about them
  const names = all.filter((name) => !/\.(toml|md)$/.test(name));
  const tables = all.filter((name) => dirname(name) === join("samples", "dialects"));
  const found = [];
  for (const name of names) {
    const files = settings(name, tables);
    for (const machine of MACHINES) {
      const options = machine ? ["--assume", "tool-length"] : [];
      const wanted = JSON.parse(commandLine(name, machine, options));
      const given = machine ? { files, assume: ["tool-length"] } : { files };
      found.push({ name, machine, options: given, bytes: readFileSync(join(root, name)), wanted });
    }
  }
  return found;
}
