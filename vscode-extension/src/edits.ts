// Edits of the whole program, or of the chosen lines: unit, positions, and a path that is shifted, scaled, mirrored or turned. The server proves each one; a refusal is
// shown with its reason.
import * as vscode from 'vscode';
import type { LanguageClient, Range, TextEdit } from 'vscode-languageclient/node';
import type { Backplot } from './backplot';
import { apply, review } from './review';

/** An edit as the server reads it (`trunnion/edit`). */
export type Edit =
  | { kind: 'unit'; unit: 'mm' | 'inch' }
  | { kind: 'positions'; positions: 'absolute' | 'incremental' }
  | { kind: 'shift'; by: [number, number, number] }
  | { kind: 'scale'; factor: number }
  | { kind: 'mirror'; axis: string }
  | { kind: 'rotate'; axis: string; degrees: number };

interface Answer {
  edits: TextEdit[];
  summary: string;
  notes: string[];
}

interface Choice extends vscode.QuickPickItem {
  ask: () => Promise<Edit | undefined>;
}

const NUMBER = /^[+-]?(?:\d+\.?\d*|\.\d+)$/;

/** A number as people write it; `undefined`: it is none. */
export function number(text: string): number | undefined {
  return NUMBER.test(text.trim()) ? Number(text) : undefined;
}

/** `X10 Z-2`: how far along each axis; `undefined`: it does not say that. */
export function shift(text: string): [number, number, number] | undefined {
  const by: [number, number, number] = [0, 0, 0];
  const seen = new Set<number>();
  const words = text.trim().toUpperCase().split(/[\s,]+/).filter((word) => word !== '');
  for (const word of words) {
    const axis = 'XYZ'.indexOf(word.charAt(0));
    const value = number(word.slice(1).replace(/^=/, ''));
    if (axis < 0 || value === undefined || seen.has(axis)) {
      return undefined;
    }
    seen.add(axis);
    by[axis] = value;
  }
  return words.length > 0 ? by : undefined;
}

async function askNumber(title: string, prompt: string, fits: (value: number) => boolean): Promise<number | undefined> {
  const text = await vscode.window.showInputBox({
    title,
    prompt,
    validateInput: (text) => {
      const value = number(text);
      return value !== undefined && fits(value) ? undefined : prompt;
    },
  });
  return text === undefined ? undefined : number(text);
}

async function askShift(): Promise<Edit | undefined> {
  const prompt = 'How far along each axis, in the unit of the program: X10 Z-2';
  const text = await vscode.window.showInputBox({
    title: 'Shift the path',
    prompt,
    validateInput: (text) => (shift(text) ? undefined : prompt),
  });
  const by = text === undefined ? undefined : shift(text);
  return by && { kind: 'shift', by };
}

async function askScale(): Promise<Edit | undefined> {
  const factor = await askNumber('Scale the path', 'A factor above 0, about the zero point: 1.01', (value) => value > 0);
  return factor === undefined ? undefined : { kind: 'scale', factor };
}

async function askMirror(): Promise<Edit | undefined> {
  const axis = await vscode.window.showQuickPick(['X', 'Y', 'Z'], { placeHolder: 'The axis whose sign turns' });
  return axis === undefined ? undefined : { kind: 'mirror', axis };
}

async function askRotate(): Promise<Edit | undefined> {
  const axis = await vscode.window.showQuickPick(['Z', 'X', 'Y'], { placeHolder: 'The axis of the tool, about which the path turns' });
  if (axis === undefined) {
    return undefined;
  }
  const degrees = await askNumber('Turn the path', 'Degrees, counter-clockwise about the zero point: 90', () => true);
  return degrees === undefined ? undefined : { kind: 'rotate', axis, degrees };
}

const CHOICES: Choice[] = [
  { label: 'Shift', description: 'along X, Y and Z', ask: askShift },
  { label: 'Rotate', description: 'about the axis of the tool', ask: askRotate },
  { label: 'Mirror', description: 'turn the sign of an axis', ask: askMirror },
  { label: 'Scale', description: 'by one factor', ask: askScale },
  { label: 'Write in mm', ask: async () => ({ kind: 'unit', unit: 'mm' }) },
  { label: 'Write in inch', ask: async () => ({ kind: 'unit', unit: 'inch' }) },
  { label: 'Write absolute positions', ask: async () => ({ kind: 'positions', positions: 'absolute' }) },
  { label: 'Write incremental positions', ask: async () => ({ kind: 'positions', positions: 'incremental' }) },
];

/** The lines of the selection, if it has several and the user wants those alone; undefined: the question was left. */
async function askLines(editor: vscode.TextEditor): Promise<vscode.Range | 'all' | undefined> {
  const { start, end } = editor.selection;
  const last = end.line > start.line && end.character === 0 ? end.line - 1 : end.line;
  if (last === start.line) return 'all';
  const lines = new vscode.Range(start.line, 0, last, editor.document.lineAt(last).text.length);
  const choices = [
    { label: `Lines ${start.line + 1} to ${last + 1}`, detail: 'Choose them from a rapid before the first cut to the last block before a rapid.', lines },
    { label: 'The whole program', lines: 'all' as const },
  ];
  return (await vscode.window.showQuickPick(choices, { placeHolder: 'What to edit' }))?.lines;
}

/** Asks for an edit and its numbers, has the server prove it, and shows it. `asked`: an edit that is known already, which is applied at once. */
export async function editProgram(client: LanguageClient | undefined, backplot: Backplot, asked?: Edit, range?: Range): Promise<boolean> {
  const editor = vscode.window.activeTextEditor;
  const document = editor?.document;
  if (client === undefined || editor === undefined || document === undefined) {
    void vscode.window.showErrorMessage('Trunnion: open a program first.');
    return false;
  }
  const lines = asked === undefined ? await askLines(editor) : 'all';
  const choice = asked === undefined && lines !== undefined ? await vscode.window.showQuickPick(CHOICES, { placeHolder: 'Edit the program, proved' }) : undefined;
  const edit = asked ?? (await choice?.ask());
  if (edit === undefined || lines === undefined) {
    return false;
  }
  const version = document.version;
  const chosen = range ?? (lines === 'all' ? undefined : client.code2ProtocolConverter.asRange(lines));
  const params = { textDocument: { uri: client.code2ProtocolConverter.asUri(document.uri) }, edit, ...(chosen ? { range: chosen } : {}) };
  let answer: Answer;
  try {
    answer = await client.sendRequest<Answer>('trunnion/edit', params);
  } catch (error) {
    void vscode.window.showErrorMessage(`Trunnion: not edited: ${error instanceof Error ? error.message : String(error)}`);
    return false;
  }
  const title = `${choice?.label ?? edit.kind}${chosen ? ` of lines ${chosen.start.line + 1} to ${chosen.end.line + 1}` : ''}`;
  const proved = { title, ...answer };
  if (asked === undefined) {
    return review(client, document, proved, backplot);
  }
  const edits = await client.protocol2CodeConverter.asTextEdits(answer.edits);
  return apply(document, edits, document.version === version, proved);
}
