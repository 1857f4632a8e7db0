// Programs that are too large for VS Code to hand to extensions (50 MB): `trunnion check` reads them from the disk, when they are shown and when
// they are saved.
import { execFile } from 'node:child_process';
import { stat } from 'node:fs/promises';
import * as vscode from 'vscode';
import { findProgram, firstFolder } from './server';
import { checkArguments } from './tasks';

/** From this size on VS Code keeps a text to itself, bytes. */
const TOO_LARGE = 50 * 1024 * 1024;
/** So many findings are listed. */
const MOST = 2000;

const LINE = /^(.+?):(\d+):(\d+): (error|warning|info|unknown)\[([a-z0-9-]+)\] (.*)$/;
const SEVERITIES: Record<string, vscode.DiagnosticSeverity> = { error: vscode.DiagnosticSeverity.Error, warning: vscode.DiagnosticSeverity.Warning };

/** The findings in what `check --format short` prints. */
export function findings(printed: string): vscode.Diagnostic[] {
  return printed.split(/\r?\n/).flatMap((line) => {
    const found = LINE.exec(line);
    if (!found) return [];
    const [, , row, column, severity, rule, message] = found;
    const at = new vscode.Position(Number(row) - 1, Number(column) - 1);
    const diagnostic = new vscode.Diagnostic(new vscode.Range(at, at), message!, SEVERITIES[severity!] ?? vscode.DiagnosticSeverity.Information);
    return [Object.assign(diagnostic, { source: 'trunnion', code: rule })];
  });
}

class LargeFiles implements vscode.Disposable {
  private readonly found = vscode.languages.createDiagnosticCollection('trunnion-disk');
  private readonly item = vscode.window.createStatusBarItem('trunnion.disk', vscode.StatusBarAlignment.Right, 90);
  /** What was checked: the time of the last change, and what to show. */
  private readonly checked = new Map<string, { changed: number; text: string }>();

  constructor(private readonly context: vscode.ExtensionContext) {
    this.item.name = 'Trunnion: verdict on a large file';
    const watcher = vscode.workspace.createFileSystemWatcher(`**/*{${extensions(context).join(',')}}`, true, false, true);
    context.subscriptions.push(
      this,
      watcher,
      watcher.onDidChange(() => this.look()),
      vscode.window.tabGroups.onDidChangeTabs(() => this.look()),
      vscode.window.tabGroups.onDidChangeTabGroups(() => this.look()),
    );
    void this.look();
  }

  dispose(): void {
    this.found.dispose();
    this.item.dispose();
  }

  /** Looks whether such a file is in front. */
  private async look(): Promise<void> {
    const uri = this.inFront();
    if (!uri) return this.item.hide();
    const { size, mtimeMs } = await stat(uri.fsPath).catch(() => ({ size: 0, mtimeMs: 0 }));
    if (size <= TOO_LARGE || this.inFront()?.toString() !== uri.toString()) return this.item.hide();
    const known = this.checked.get(uri.toString());
    if (known?.changed === mtimeMs) return this.say(known.text);
    this.checked.set(uri.toString(), { changed: mtimeMs, text: '$(sync~spin) checking the file on disk' });
    this.say('$(sync~spin) checking the file on disk');
    const text = await this.check(uri, size);
    // saved again meanwhile: that check says it
    if (this.checked.get(uri.toString())?.changed !== mtimeMs) return;
    this.checked.set(uri.toString(), { changed: mtimeMs, text });
    if (this.inFront()?.toString() === uri.toString()) this.say(text);
  }

  private inFront(): vscode.Uri | undefined {
    const input = vscode.window.tabGroups.activeTabGroup.activeTab?.input;
    if (!(input instanceof vscode.TabInputText) || input.uri.scheme !== 'file') return undefined;
    const name = input.uri.path.toLowerCase();
    return extensions(this.context).some((extension) => name.endsWith(extension)) ? input.uri : undefined;
  }

  private say(text: string): void {
    this.item.text = text;
    this.item.tooltip = 'Trunnion: VS Code does not hand over files above 50 MB, so the file on disk was checked. It is checked again when it is saved.';
    this.item.show();
  }

  /** Runs the check; the answer is what the status bar says. */
  private check(uri: vscode.Uri, size: number): Promise<string> {
    const found = findProgram(this.context);
    if ('problem' in found) return Promise.resolve('$(warning) not checked: there is no trunnion program');
    const limits = ['--max-file-mb', String(Math.ceil(size / 1e6) + 1), '--max-lines', String(Math.ceil(size / 2))];
    const options = { maxBuffer: 64 * 1024 * 1024, ...(firstFolder() ? { cwd: firstFolder() } : {}) };
    return new Promise((resolve) => {
      execFile(found.program, ['check', '--format', 'short', ...checkArguments(), ...limits, '--limit', String(MOST), uri.fsPath], options, (error, out, remarks) => {
        if (error && error.code !== 1) return resolve(`$(warning) not checked: ${remarks.trim().split('\n')[0] ?? ''}`);
        this.found.set(uri, findings(out));
        const verdict = /^(PASS|FAIL|UNKNOWN)\b/m.exec(`${remarks}\n${out}`)?.[1] ?? (error ? 'FAIL' : 'PASS');
        const icon = { PASS: '$(pass)', FAIL: '$(error)', UNKNOWN: '$(question)' }[verdict];
        resolve(`${icon} ${verdict.toLowerCase()} · the file on disk`);
      });
    });
  }
}

const extensions = (context: vscode.ExtensionContext): string[] =>
  (context.extension.packageJSON.contributes.languages as { extensions: string[] }[]).flatMap((language) => language.extensions);

/** Checks such files as they are shown. */
export function largeFiles(context: vscode.ExtensionContext): vscode.Disposable {
  return new LargeFiles(context);
}
