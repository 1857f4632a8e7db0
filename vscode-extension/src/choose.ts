// The two questions the extension asks: which machine, which dialect. The answers become settings.
import { execFile } from 'node:child_process';
import { relative } from 'node:path';
import { promisify } from 'node:util';
import * as vscode from 'vscode';
import { firstFolder } from './server';

interface Choice extends vscode.QuickPickItem {
  value: string;
}

const FILE = '\u0000file';

/** Asks for the machine: those `trunnion machine list` knows, a file, or none. */
export async function chooseMachine(program: string): Promise<void> {
  const current = vscode.workspace.getConfiguration('trunnion').get<string>('machine', '');
  const choices: Choice[] = [
    ...(await machines(program)),
    { label: '$(file) From a machine file...', value: FILE },
    { label: '$(circle-slash) No machine', description: 'use the machine in trunnion.toml, if any', value: '' },
  ];
  const picked = await ask(choices, current, 'The machine that runs the program');
  if (picked === FILE) {
    const files = await vscode.window.showOpenDialog({ title: 'Machine file', filters: { 'Machine file': ['toml'] } });
    const path = files?.[0]?.fsPath;
    const inside = path !== undefined && firstFolder() !== undefined ? relative(firstFolder() ?? '', path) : path;
    await save('machine', inside === undefined || inside.startsWith('..') ? path : inside);
  } else {
    await save('machine', picked);
  }
}

/** Asks for the dialect, among those the setting may take. */
export async function chooseDialect(context: vscode.ExtensionContext): Promise<void> {
  const setting = context.extension.packageJSON.contributes.configuration.properties['trunnion.dialect'];
  const choices = setting.enum.map((value: string, index: number): Choice => ({
    label: value || '$(search) Automatic',
    description: setting.enumDescriptions[index],
    value,
  }));
  const current = vscode.workspace.getConfiguration('trunnion').get<string>('dialect', '');
  await save('dialect', await ask(choices, current, 'The dialect of the programs'));
}

async function machines(program: string): Promise<Choice[]> {
  const { stdout } = await promisify(execFile)(program, ['machine', 'list'], { timeout: 10_000 });
  const rows = stdout.split(/\r?\n/).map((line) => /^(\S+)\s*(.*)$/.exec(line));
  return rows.flatMap((row) => (row?.[1] ? [{ label: row[1], description: row[2] ?? '', value: row[1] }] : []));
}

async function ask(choices: Choice[], current: string, placeHolder: string): Promise<string | undefined> {
  const marked = choices.map((choice) => (choice.value === current ? { ...choice, detail: 'in use' } : choice));
  return (await vscode.window.showQuickPick(marked, { placeHolder, matchOnDescription: true }))?.value;
}

async function save(name: string, value: string | undefined): Promise<void> {
  if (value !== undefined) {
    await vscode.workspace.getConfiguration('trunnion').update(name, value, vscode.workspace.workspaceFolders === undefined);
  }
}
