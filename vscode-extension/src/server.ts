// Which `trunnion` program to start, and why: the setting, else the bundled one, else the one on PATH.
import { accessSync, constants, statSync } from 'node:fs';
import { homedir } from 'node:os';
import { delimiter, isAbsolute, join } from 'node:path';
import * as vscode from 'vscode';

/** The program, or the sentence that says why there is none. */
export type Found = { program: string } | { problem: string };

const NAME = process.platform === 'win32' ? 'trunnion.exe' : 'trunnion';

/** The folder that relative paths in the settings start from; undefined without a folder. */
export function firstFolder(): string | undefined {
  return vscode.workspace.workspaceFolders?.find((folder) => folder.uri.scheme === 'file')?.uri.fsPath;
}

/** Looks for the program again, so that a changed setting or a new installation is seen at the next start. */
export function findProgram(context: vscode.ExtensionContext): Found {
  const wanted = vscode.workspace.getConfiguration('trunnion').get<string>('path', '').trim();
  if (wanted !== '') {
    const program = absolute(wanted);
    return isProgram(program) ? { program } : { problem: `The setting trunnion.path names "${program}", which is not a program that can be started.` };
  }
  const bundled = context.asAbsolutePath(join('server', NAME));
  const onPath = (process.env['PATH'] ?? '').split(delimiter).filter((folder) => folder !== '').map((folder) => join(folder, NAME));
  const program = [bundled, ...onPath].find(isProgram);
  return program !== undefined
    ? { program }
    : { problem: `No "${NAME}" program: this extension contains none (${bundled}) and there is none on PATH. Install it, or set trunnion.path.` };
}

function absolute(path: string): string {
  const folder = firstFolder() ?? homedir();
  const full = path.replace(/^~(?=[\\/])/, homedir()).replaceAll('${workspaceFolder}', folder);
  return isAbsolute(full) ? full : join(folder, full);
}

function isProgram(path: string): boolean {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}
