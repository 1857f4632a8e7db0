// The status bar item: the machine and the dialect of the program in front, and its verdict.
import * as vscode from 'vscode';
import { isProgram } from './languages';

/** What the server says after each analysis (`trunnion/status`). */
export interface Status {
  uri: string;
  machine: string | null;
  dialect: string | null;
  /** Why this dialect was taken, or what is wrong with the settings. */
  reason: string;
  /** `checking`: only a part of a long program is judged so far, and the counts are zero. */
  verdict: 'pass' | 'fail' | 'unknown' | 'checking';
  errors: number;
  warnings: number;
  unknown: number;
  version: number;
  /** Blocks with content, and those that were run. */
  blocks: number;
  blocks_run: number;
  /** Lowest and highest time of the program, s. */
  cycle_time_s: [number, number] | null;
}

const ICONS = { pass: '$(pass)', fail: '$(error)', unknown: '$(question)', checking: '$(sync~spin)' } as const;

export class StatusItem implements vscode.Disposable {
  private readonly item = vscode.window.createStatusBarItem('trunnion.status', vscode.StatusBarAlignment.Right, 90);
  private readonly latest = new Map<string, Status>();
  private problem: string | undefined;
  private last: vscode.TextDocument | undefined;

  constructor() {
    this.item.name = 'Trunnion: machine, dialect, verdict, coverage, time';
    this.item.command = 'trunnion.chooseMachine';
  }

  /** Stores what the server said; shown when that program is in front. */
  update(status: Status): void {
    this.latest.set(vscode.Uri.parse(status.uri).toString(), status);
    this.show();
  }

  forget(uri: vscode.Uri): void {
    this.latest.delete(uri.toString());
  }

  /** Shows that there is no server, and why; undefined when it runs again. */
  fail(problem: string | undefined): void {
    this.problem = problem;
    this.latest.clear();
    this.show();
  }

  show(): void {
    const document = this.inFront();
    if (!document) {
      this.item.hide();
      return;
    }
    const settings = vscode.workspace.getConfiguration('trunnion');
    const status = this.latest.get(document.uri.toString());
    const machine = status ? status.machine : settings.get<string>('machine', '');
    const dialect = status ? status.dialect : settings.get<string>('dialect', '');
    const icon = this.problem !== undefined ? '$(warning)' : status ? ICONS[status.verdict] : '$(circle-outline)';
    const parts = [machine || 'no machine', dialect, status?.verdict, status && coverage(status), status?.cycle_time_s && time(status.cycle_time_s)];
    this.item.text = `${icon} ${parts.filter(Boolean).join(' · ')}`;
    this.item.tooltip = this.problem ?? tooltip(status);
    this.item.show();
  }

  dispose(): void {
    this.item.dispose();
  }

  /** The program in front; where no text is, as while the backplot has the focus, the last one, as long as it is on the screen. */
  private inFront(): vscode.TextDocument | undefined {
    const { activeTextEditor, visibleTextEditors } = vscode.window;
    if (activeTextEditor) this.last = isProgram(activeTextEditor.document) ? activeTextEditor.document : undefined;
    return visibleTextEditors.some(({ document }) => document === this.last) ? this.last : undefined;
  }
}

/** Which part of the program was run; nothing to say where it is all of it. */
function coverage({ blocks, blocks_run }: Status): string {
  return blocks_run < blocks ? `${Math.floor((100 * blocks_run) / blocks)} % run` : '';
}

function time([low, high]: [number, number]): string {
  const words = (seconds: number) => (seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.floor(seconds % 60)} s`);
  return low === high ? words(low) : `${words(low)} to ${words(high)}`;
}

function tooltip(status: Status | undefined): string {
  if (!status) {
    return 'Trunnion: not checked yet. Click to choose the machine.';
  }
  if (status.verdict === 'checking') {
    return ['Checking the program: what is shown so far is of the visible lines.', status.reason, 'Click to choose the machine.'].join('\n');
  }
  const counts = `${status.errors} errors, ${status.warnings} warnings, ${status.unknown} unknown`;
  const lines = [
    `Verdict: ${status.verdict} (${counts})`,
    `${status.blocks_run} of ${status.blocks} blocks run`,
    ...(status.cycle_time_s ? [`Time: ${time(status.cycle_time_s)}`] : []),
    status.reason,
    'Click to choose the machine.',
  ];
  return lines.join('\n');
}
