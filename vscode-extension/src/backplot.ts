// The backplot beside a program: it follows the cursor, and a click on the path goes to the line.
import { randomBytes } from 'node:crypto';
import { mkdir, readFile, rm } from 'node:fs/promises';
import { join } from 'node:path';
import * as vscode from 'vscode';
import type { LanguageClient } from 'vscode-languageclient/node';
import { isProgram } from './languages';
import type { FromPage, Summary, ToPage } from './messages';
import { page } from './page';

/** Points that are drawn first, at once, and then. */
const COARSE = 20_000;
const FINE = 400_000;

/** The open backplot, one for all programs: it shows the program in front. */
export class Backplot implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private document: vscode.TextDocument | undefined;
  private drawn: string | undefined;
  /** What is drawn over a program: another text. `version`: of the program, where it is a change of that. */
  private over: { document: vscode.TextDocument; version: number | undefined; title: string; text: string } | undefined;
  private turn = 0;
  private files = 0;
  /** For tests: how many points the page drew last, of the program and over it, and the line that was picked last. */
  readonly seen = { vertices: 0, compared: 0, picked: 0 };

  constructor(
    private readonly context: vscode.ExtensionContext,
    private readonly client: () => LanguageClient | undefined,
  ) {
    context.subscriptions.push(
      this,
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.follow(textEditor)),
      vscode.window.onDidChangeActiveTextEditor((editor) => editor && isProgram(editor.document) && this.panel && this.show(editor.document)),
    );
  }

  /** Opens the backplot beside the editor in front. */
  async open(): Promise<void> {
    const document = inFront();
    if (!document) {
      void vscode.window.showInformationMessage('Open a program first: the backplot shows the path of the program in front.');
      return;
    }
    this.panel ??= this.make();
    this.panel.reveal(vscode.ViewColumn.Beside, true);
    await this.show(document);
  }

  /** Draws a second program over the one that is shown: before and after. */
  async compare(): Promise<void> {
    await this.open();
    const picked = await vscode.window.showOpenDialog({ title: 'Draw this program over the one that is shown' });
    if (!picked?.[0] || !this.document) return;
    const text = Buffer.from(await vscode.workspace.fs.readFile(picked[0])).toString('utf8');
    this.over = { document: this.document, version: undefined, title: picked[0].path.split('/').pop() ?? '', text };
    await this.draw();
  }

  /** Draws a changed text over the program, until the program itself changes: before and after. */
  async overlay(document: vscode.TextDocument, title: string, text: string): Promise<void> {
    this.panel ??= this.make();
    this.panel.reveal(vscode.ViewColumn.Beside, true);
    this.over = { document, version: document.version, title, text };
    this.document = document;
    this.panel.title = `Backplot: ${name(document)}`;
    await this.draw();
  }

  /** Opens the backplot at a line. */
  async openAt(line: number): Promise<void> {
    await this.open();
    this.post({ type: 'line', line });
  }

  /** After each analysis: the path of the newest text. */
  analysed(uri: string): void {
    if (this.panel && this.document && vscode.Uri.parse(uri).toString() === this.document.uri.toString()) void this.draw();
  }

  dispose(): void {
    this.panel?.dispose();
  }

  private async show(document: vscode.TextDocument): Promise<void> {
    if (this.document === document && this.drawn !== undefined) return;
    this.document = document;
    if (this.panel) this.panel.title = `Backplot: ${name(document)}`;
    await this.draw();
  }

  private async draw(): Promise<void> {
    const document = this.document;
    if (!document) return;
    const turn = (this.turn += 1);
    const coarse = await this.fetch('path', document.uri.toString(), { most: COARSE });
    if (turn !== this.turn || !coarse) return;
    this.drawn = document.uri.toString();
    if (coarse.vertices < coarse.whole) await this.fetch('path', document.uri.toString(), { most: FINE });
    const { over } = this;
    if (over?.document === document && (over.version === undefined || over.version === document.version)) {
      await this.fetch('other', over.title, { most: FINE, text: over.text });
    } else this.over = undefined;
    const editor = vscode.window.visibleTextEditors.find((visible) => visible.document === document);
    if (editor) this.follow(editor);
  }

  /** Asks the server for a path and hands it on to the page. */
  private async fetch(type: 'path' | 'other', title: string, ask: { most: number; text?: string }): Promise<Summary | undefined> {
    const client = this.client();
    if (!client || !this.document) return undefined;
    const folder = this.context.globalStorageUri.fsPath;
    await mkdir(folder, { recursive: true });
    const file = join(folder, `backplot-${process.pid}-${(this.files += 1)}.bin`);
    try {
      const summary = await client.sendRequest<Summary>('trunnion/backplot', { textDocument: { uri: this.document.uri.toString() }, file, ...ask });
      const read = await readFile(file);
      const bytes = read.buffer.slice(read.byteOffset, read.byteOffset + read.byteLength) as ArrayBuffer;
      this.post({ type, title, summary, bytes });
      return summary;
    } catch (error) {
      // a newer text came in between: its own path follows
      const text = error instanceof Error ? error.message : String(error);
      if (!/content modified|cancel/i.test(text)) this.post({ type: 'problem', text });
      return undefined;
    } finally {
      await rm(file, { force: true });
    }
  }

  private follow(editor: vscode.TextEditor): void {
    if (this.panel && editor.document === this.document) this.post({ type: 'line', line: editor.selection.active.line + 1 });
  }

  private post(message: ToPage): void {
    void this.panel?.webview.postMessage(message);
  }

  private async heard(message: FromPage): Promise<void> {
    switch (message.type) {
      case 'ready':
        return this.draw();
      case 'drawn':
        this.seen.vertices = message.vertices;
        this.seen.compared = 0;
        return;
      case 'compared':
        this.seen.compared = message.vertices;
        return;
      case 'pick': {
        this.seen.picked = message.line;
        const document = this.document;
        if (!document) return;
        const visible = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
        const place = new vscode.Range(message.line - 1, 0, message.line - 1, 0);
        await vscode.window.showTextDocument(document, {
          ...(visible?.viewColumn !== undefined ? { viewColumn: visible.viewColumn } : { viewColumn: vscode.ViewColumn.One }),
          preserveFocus: true,
          selection: place,
        });
      }
    }
  }

  private make(): vscode.WebviewPanel {
    const { extensionUri } = this.context;
    const [dist, media] = [vscode.Uri.joinPath(extensionUri, 'dist'), vscode.Uri.joinPath(extensionUri, 'media')];
    const panel = vscode.window.createWebviewPanel('trunnion.backplot', 'Backplot', { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, {
      enableScripts: true,
      retainContextWhenHidden: true,
      localResourceRoots: [dist, media],
    });
    const uri = (folder: vscode.Uri, file: string) => panel.webview.asWebviewUri(vscode.Uri.joinPath(folder, file)).toString();
    panel.webview.html = page({
      script: uri(dist, 'backplot.js'),
      style: uri(media, 'backplot.css'),
      source: panel.webview.cspSource,
      nonce: randomBytes(16).toString('base64url'),
    });
    panel.webview.onDidReceiveMessage((message: FromPage) => this.heard(message));
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.drawn = undefined;
      this.over = undefined;
    });
    return panel;
  }
}

/** The program in front; where something else is in front, such as the walkthrough, one that is open. */
function inFront(): vscode.TextDocument | undefined {
  const { activeTextEditor, visibleTextEditors } = vscode.window;
  const shown = [activeTextEditor, ...visibleTextEditors].flatMap((editor) => editor?.document ?? []);
  return [...shown, ...vscode.workspace.textDocuments].find(isProgram);
}

const name = (document: vscode.TextDocument): string => document.uri.path.split('/').pop() ?? '';
