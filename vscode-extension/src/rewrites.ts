// Rewrites on request: all of them, not only those that a finding offers. The server proves each one; a refusal is shown with its reason.
import * as vscode from 'vscode';
import type { LanguageClient, Range, TextEdit } from 'vscode-languageclient/node';
import type { Backplot } from './backplot';
import { review } from './review';

interface Answer {
  edits: TextEdit[];
  summary: string;
  notes: string[];
  certificate: string;
}

/** What the server can do beside the protocol. */
interface Experimental {
  rewrites?: { name: string; summary: string }[];
}

/** Asks for a rewrite, has it proved, and shows it. `name`, `range`: from a light bulb; `range`: the lines that may change. */
export async function rewriteProgram(client: LanguageClient | undefined, backplot: Backplot, name?: string, range?: Range | null): Promise<boolean> {
  const document = vscode.window.activeTextEditor?.document;
  if (client === undefined || document === undefined) {
    void vscode.window.showErrorMessage('Trunnion: open a program first.');
    return false;
  }
  const known = (client.initializeResult?.capabilities.experimental as Experimental | undefined)?.rewrites ?? [];
  const rewrite = name ?? (await vscode.window.showQuickPick(known.map(({ name: label, summary: detail }) => ({ label, detail })), { placeHolder: 'Rewrite the program, proved', matchOnDetail: true }))?.label;
  if (rewrite === undefined) return false;
  const params = { textDocument: { uri: client.code2ProtocolConverter.asUri(document.uri) }, rewrite, ...(range ? { range } : {}) };
  try {
    const proving = { location: vscode.ProgressLocation.Window, title: `Trunnion: proving ${rewrite}` };
    const answer = await vscode.window.withProgress(proving, () => client.sendRequest<Answer>('trunnion/rewrite', params));
    return await review(client, document, { title: rewrite, ...answer }, backplot);
  } catch (error) {
    void vscode.window.showErrorMessage(`Trunnion: ${rewrite}: ${error instanceof Error ? error.message : String(error)}`);
    return false;
  }
}
