// The two questions the extension asks: which machine, which dialect. The machine is written into the folder's trunnion.toml, where the
// command line finds it too; the dialect becomes a setting.
import { execFile } from 'node:child_process';
import { relative } from 'node:path';
import { promisify } from 'node:util';
import * as vscode from 'vscode';
import { firstFolder } from './server';

interface Choice extends vscode.QuickPickItem {
  value: string;
}

const FILE = '\u0000file';

/** Asks for the machine: those `trunnion machine list` knows, a file, or none. `changed`: what to do when trunnion.toml has been written. */
export async function chooseMachine(program: string, changed: (file: vscode.Uri) => Promise<void>): Promise<void> {
  const current = vscode.workspace.getConfiguration('trunnion').get<string>('machine', '') || ((await written()) ?? '');
  const choices: Choice[] = [
    ...(await machines(program)),
    { label: '$(file) From a machine file...', value: FILE },
    { label: '$(circle-slash) No machine', description: 'nothing that needs a machine is checked', value: '' },
  ];
  const picked = await ask(choices, current, 'The machine that runs the program');
  if (picked === FILE) {
    const files = await vscode.window.showOpenDialog({ title: 'Machine file', filters: { 'Machine file': ['toml'] } });
    const path = files?.[0]?.fsPath;
    const inside = path !== undefined && firstFolder() !== undefined ? relative(firstFolder() ?? '', path) : path;
    await use(inside === undefined || inside.startsWith('..') ? path : inside, changed);
  } else {
    await use(picked, changed);
  }
}

/** The folder's trunnion.toml, if a folder is open. */
function settingsFile(): vscode.Uri | undefined {
  const folder = firstFolder();
  return folder === undefined ? undefined : vscode.Uri.joinPath(vscode.Uri.file(folder), 'trunnion.toml');
}

async function read(file: vscode.Uri): Promise<string | undefined> {
  const open = vscode.workspace.textDocuments.find((document) => document.uri.toString() === file.toString());
  if (open) {
    return open.getText();
  }
  return vscode.workspace.fs.readFile(file).then((bytes) => new TextDecoder().decode(bytes), () => undefined);
}

/** The line of the top table that names the machine. */
const MACHINE_LINE = /^[ \t]*machine[ \t]*=[ \t]*(?:"([^"\n]*)"|'([^'\n]*)')[^\n]*\r?\n?/m;

/** The text before the first table: only there `machine` is a key of its own. */
function top(text: string): string {
  const table = /^[ \t]*\[/m.exec(text);
  return table ? text.slice(0, table.index) : text;
}

async function written(): Promise<string | undefined> {
  const file = settingsFile();
  const text = file && (await read(file));
  const found = text === undefined ? null : MACHINE_LINE.exec(top(text));
  return found?.[1] ?? found?.[2];
}

/** Text of trunnion.toml with that machine; everything else stays as it is. */
export function withMachine(text: string, machine: string): string {
  const line = machine === '' ? '' : `machine = ${JSON.stringify(machine)}\n`;
  const head = top(text);
  const old = MACHINE_LINE.exec(head);
  return old ? text.slice(0, old.index) + line + text.slice(old.index + old[0].length) : line + text;
}

/** Writes the machine into the folder's trunnion.toml and clears the setting that would override it; without a folder, into the setting. */
async function use(machine: string | undefined, changed: (file: vscode.Uri) => Promise<void>): Promise<void> {
  const file = settingsFile();
  if (machine === undefined || file === undefined) {
    return save('machine', machine);
  }
  const text = (await read(file)) ?? '';
  const anew = withMachine(text, machine);
  if (anew !== text) {
    await vscode.workspace.fs.writeFile(file, new TextEncoder().encode(anew));
    await changed(file);
  }
  await vscode.workspace.getConfiguration('trunnion').update('machine', undefined, vscode.ConfigurationTarget.Workspace);
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
