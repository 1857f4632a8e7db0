/** Options of `trunnion check`. */
export interface Options {
  /** Dialect of the program; default: found out. */
  dialect?: string;
  /** The tool in use: `shape:diameter[:corner radius]`, for example `ball:10`, in mm. */
  tool?: string;
  /** Rules to silence. */
  allow?: string[];
  /** Dialects of the controls that the program is meant to run on too. */
  portTo?: string[];
  /** What is taken as zero although it is not declared: `work-offset`, `tool-length`. */
  assume?: string[];
  /** Blocks that begin with `/`: run them (`off`) or skip them (`on`). */
  blockDelete?: "on" | "off";
  /** What is judged. */
  scope?: "language" | "motion" | "machine";
  /** The severity from which a finding makes the verdict `fail`. */
  deny?: "error" | "warning" | "info";
  /** Texts of files by name: `trunnion.toml` (settings), the machine files and dialect tables that it or `machine` names, and programs that are called (`O2000.nc`). */
  files?: Record<string, string>;
}

/** A finding; all keys: `trunnion schema check`. */
export interface Finding {
  rule: string;
  severity: "error" | "warning" | "info";
  status: "fail" | "unknown";
  line: number;
  column: number;
  end_line: number;
  end_column: number;
  byte_start: number;
  byte_end: number;
  block: string | null;
  message: string;
  notes: string[];
  help: string | null;
  values: Record<string, number | string>;
  fixes: string[];
  docs: string;
  fingerprint?: string;
  replacement?: string;
  count?: number;
  last_line?: number;
  related?: { line: number; column: number; message: string }[];
  also?: Finding[];
}

/** A checked program. */
export interface CheckedFile {
  path: string;
  dialect: string | null;
  dialect_reason: string;
  machine: string | null;
  verdict: "pass" | "fail" | "unknown";
  scope: "language" | "motion" | "machine";
  blocks: number;
  motions: number;
  cycle_time_s: [number, number] | null;
  coverage: {
    blocks: number;
    blocks_run: number;
    motions: number;
    motions_known: number;
    not_run: { line: number; last_line: number; reason: string }[];
    not_judged: { rule: string; needs: string }[];
    given_up: { line: number; reason: string } | null;
  };
  assumptions: string[];
  diagnostics: Finding[];
}

/** The document `trunnion-check/1`. */
export interface Report {
  schema: "trunnion-check/1";
  version: string;
  machine: string | null;
  files: CheckedFile[];
  not_checked: { place: string; message: string }[];
  summary: Record<"files" | "blocks" | "motions" | "errors" | "warnings" | "infos" | "unknown" | "accepted", number>;
}

/** What is built in. */
export interface Lists {
  version: string;
  machines: { name: string; title: string }[];
  dialects: { name: string; title: string }[];
  rules: { name: string; summary: string; page: string }[];
}

/** The checker, loaded once: `load()` makes one. */
export class Checker {
  constructor(module: WebAssembly.Module, instance: WebAssembly.Instance);
  check(text: string | Uint8Array, name: string, machine?: string | null, options?: Options): Report;
  lists(): Lists;
}

/** Loads the checker: from bytes, a compiled module, a Response or an address; without any, the module beside this file. */
export function load(source?: BufferSource | WebAssembly.Module | Response | URL | string): Promise<Checker>;

/** Checks one program with the module beside this file. */
export function check(text: string | Uint8Array, name: string, machine?: string | null, options?: Options): Promise<Report>;
