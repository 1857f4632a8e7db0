// What is proved is shown before it is applied: before and after in the backplot, and the proof as a text.
import * as vscode from 'vscode';
import type { LanguageClient, TextEdit } from 'vscode-languageclient/node';
import type { Backplot } from './backplot';

/** A change that the server has proved. */
export interface Proved {
  title: string;
  edits: TextEdit[];
  summary: string;
  notes: string[];
  /** The certificate (JSON), where there is one. */
  certificate?: string;
}

/** Certificates as pages that can be read and saved elsewhere, not edited. */
class Proofs implements vscode.TextDocumentContentProvider {
  private readonly pages = new Map<string, string>();

  page(name: string, content: string): vscode.Uri {
    const uri = vscode.Uri.from({ scheme: PROOF, path: `/${this.pages.size + 1}/${name}` });
    this.pages.set(uri.toString(), content);
    return uri;
  }

  provideTextDocumentContent(uri: vscode.Uri): string {
    return this.pages.get(uri.toString()) ?? '';
  }
}

const PROOF = 'trunnion-proof';
const proofs = new Proofs();

export const proofPages = (): vscode.Disposable => vscode.workspace.registerTextDocumentContentProvider(PROOF, proofs);

interface Step extends vscode.QuickPickItem {
  run: () => Promise<boolean | undefined>;
}

/** The text of a document after edits that do not overlap. */
export function edited(document: vscode.TextDocument, edits: readonly vscode.TextEdit[]): string {
  const text = document.getText();
  const parts: string[] = [];
  let at = 0;
  for (const { range, newText } of [...edits].sort((a, b) => a.range.start.compareTo(b.range.start))) {
    const from = document.offsetAt(range.start);
    parts.push(text.slice(at, from), newText);
    at = document.offsetAt(range.end);
  }
  return parts.join('') + text.slice(at);
}

/** Asks what to do with a proved change, until it is applied or left. True: it was applied. */
export async function review(client: LanguageClient, document: vscode.TextDocument, proved: Proved, backplot: Backplot): Promise<boolean> {
  const { version } = document;
  const edits = await client.protocol2CodeConverter.asTextEdits(proved.edits);
  const fresh = () => document.version === version;
  const steps: Step[] = [
    { label: '$(check) Apply', detail: proved.summary, run: () => apply(document, edits, fresh(), proved) },
    { label: '$(graph-line) Show before and after in the backplot', run: () => overlay(document, edits, fresh(), proved, backplot) },
    {
      label: proved.certificate === undefined ? '$(verified) Show what was proved' : '$(verified) Show the certificate',
      detail: proved.notes.join(' '),
      run: () => certificate(proved),
    },
  ];
  for (;;) {
    const step = await vscode.window.showQuickPick(steps, { title: `${proved.title} (proved)`, placeHolder: 'It is proved. What now?', ignoreFocusOut: true });
    const done = step === undefined ? false : await step.run();
    if (done !== undefined) return done;
  }
}

/** Applies a change to the text for which it was proved. */
export async function apply(document: vscode.TextDocument, edits: vscode.TextEdit[], fresh: boolean, proved: Proved): Promise<boolean> {
  if (!fresh) return changed();
  const changes = new vscode.WorkspaceEdit();
  changes.set(document.uri, edits);
  const applied = await vscode.workspace.applyEdit(changes);
  if (applied) void vscode.window.showInformationMessage(`Trunnion: ${[proved.summary, ...proved.notes].join('. ')}`);
  return applied;
}

async function overlay(document: vscode.TextDocument, edits: vscode.TextEdit[], fresh: boolean, { title }: Proved, backplot: Backplot): Promise<boolean | undefined> {
  if (!fresh) return changed();
  await backplot.overlay(document, `after ${title}`, edited(document, edits));
  return undefined;
}

async function certificate(proved: Proved): Promise<undefined> {
  const [ending, content] = proved.certificate === undefined ? ['md', said(proved)] : ['json', proved.certificate];
  await vscode.window.showTextDocument(proofs.page(`${proved.title}.${ending}`, content), { preview: true, preserveFocus: true });
  return undefined;
}

const said = ({ title, summary, notes }: Proved): string => [`# ${title}`, '', `${summary}.`, '', ...notes.map((note) => `* ${note}`), ''].join('\n');

function changed(): false {
  void vscode.window.showErrorMessage('Trunnion: not edited: the program was changed meanwhile.');
  return false;
}
