// Starts `trunnion lsp` for G-code and APT programs, and shows what it says about machine and dialect.
import * as vscode from 'vscode';
import { FileChangeType, LanguageClient, type Range, RevealOutputChannelOn, State, TransportKind } from 'vscode-languageclient/node';
import { Backplot } from './backplot';
import { chooseDialect, chooseMachine } from './choose';
import { type Edit, editProgram } from './edits';
import { largeFiles } from './large';
import { LANGUAGES } from './languages';
import { proofPages } from './review';
import { rewriteProgram } from './rewrites';
import { findProgram, firstFolder } from './server';
import { type Status, StatusItem } from './status';
import { checkTask, taskProvider } from './tasks';

let client: LanguageClient | undefined;

/** What lives as long as the extension and outlives each server. */
interface Surroundings {
  context: vscode.ExtensionContext;
  status: StatusItem;
  output: vscode.LogOutputChannel;
  configs: vscode.FileSystemWatcher;
  backplot: Backplot;
}

/** Starts and stops of the server wait for each other here. */
let turn: Promise<void> = Promise.resolve();

/** What tests in the extension host may look at. */
export interface Api {
  backplot: Backplot['seen'];
}

export async function activate(context: vscode.ExtensionContext): Promise<Api> {
  const status = new StatusItem();
  const output = vscode.window.createOutputChannel('Trunnion', { log: true });
  const configs = vscode.workspace.createFileSystemWatcher('**/trunnion.toml');
  const backplot = new Backplot(context, () => client);
  const restart = () => (turn = turn.then(() => stop()).then(() => start({ context, status, output, configs, backplot })));
  const withProgram = (action: (program: string) => unknown) => async () => {
    const found = findProgram(context);
    await ('program' in found ? Promise.resolve(action(found.program)).catch(complain) : complain(found.problem));
  };
  context.subscriptions.push(
    status,
    output,
    configs,
    vscode.commands.registerCommand('trunnion.restartServer', restart),
    vscode.commands.registerCommand('trunnion.chooseMachine', withProgram((program) => chooseMachine(program, settingsWritten))),
    vscode.commands.registerCommand('trunnion.chooseDialect', () => chooseDialect(context)),
    vscode.commands.registerCommand('trunnion.showBackplot', () => backplot.open()),
    vscode.commands.registerCommand('trunnion.compareBackplot', () => backplot.compare()),
    vscode.commands.registerCommand('trunnion.editProgram', (edit?: Edit, range?: Range) => editProgram(client, backplot, edit, range)),
    vscode.commands.registerCommand('trunnion.rewriteProgram', (name?: string, range?: Range | null) => rewriteProgram(client, backplot, name, range)),
    // what a lens does: it shows the block with which the operation begins
    vscode.commands.registerCommand('trunnion.showOperation', async (uri: string, line: number) => {
      const start = new vscode.Position(line, 0);
      await vscode.window.showTextDocument(vscode.Uri.parse(uri), { selection: new vscode.Range(start, start) });
    }),
    vscode.commands.registerCommand('trunnion.showInBackplot', async (uri: string, line: number) => {
      await vscode.window.showTextDocument(vscode.Uri.parse(uri));
      await backplot.openAt(line + 1);
    }),
    largeFiles(context),
    proofPages(),
    vscode.commands.registerCommand('trunnion.checkFile', withProgram(checkActiveFile)),
    vscode.tasks.registerTaskProvider('trunnion', taskProvider(() => {
      const found = findProgram(context);
      return 'program' in found ? found.program : undefined;
    })),
    vscode.window.onDidChangeActiveTextEditor(() => status.show()),
    vscode.workspace.onDidCloseTextDocument((document) => status.forget(document.uri)),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration('trunnion.path')) {
        void restart();
      }
      status.show();
    }),
  );
  await restart();
  return { backplot: backplot.seen };
}

export function deactivate(): Promise<void> {
  return (turn = turn.then(() => stop()));
}

async function start({ context, status, output, configs, backplot }: Surroundings): Promise<void> {
  const found = findProgram(context);
  if ('problem' in found) {
    status.fail(found.problem);
    void complain(found.problem);
    return;
  }
  output.info(`starting ${found.program} lsp`);
  const settings = vscode.workspace.getConfiguration('trunnion');
  const folder = firstFolder();
  const started = new LanguageClient(
    'trunnion',
    'Trunnion',
    { command: found.program, args: ['lsp'], transport: TransportKind.stdio, options: folder ? { cwd: folder } : {} },
    {
      documentSelector: [
        ...LANGUAGES.flatMap((language) => ['file', 'untitled'].map((scheme) => ({ language, scheme }))),
        // settings and machine files; the server says nothing of others
        { scheme: 'file', pattern: '**/*.toml' },
      ],
      initializationOptions: {
        machine: settings.get('machine'),
        dialect: settings.get('dialect'),
        tool: settings.get('tool'),
        hints: settings.get('hints'),
        codeLens: settings.get('codeLens'),
        commands: true,
      },
      // the server sends the findings of each version by itself; asked for too, each would be shown twice
      middleware: {
        provideDiagnostics: () => undefined,
        // of a long text the server colours what is shown alone; an empty answer would be taken for all colours, and nothing more be asked for
        provideDocumentSemanticTokens: async (document, token, next) => {
          const tokens = await next(document, token);
          if (!tokens) throw new vscode.CancellationError();
          return tokens;
        },
      },
      synchronize: { configurationSection: 'trunnion', fileEvents: configs },
      outputChannel: output,
      revealOutputChannelOn: RevealOutputChannelOn.Never,
    },
  );
  client = started;
  started.onNotification('trunnion/status', (said: Status) => {
    status.update(said);
    backplot.analysed(said.uri);
  });
  started.onDidChangeState(({ newState }) => {
    if (newState === State.Running) {
      status.fail(undefined);
    } else if (newState === State.Stopped && client === started) {
      status.fail(`The language server ${found.program} has stopped. "Trunnion: Restart Server" starts it again.`);
    }
  });
  try {
    await started.start();
  } catch (error) {
    const problem = `The language server ${found.program} did not start: ${error instanceof Error ? error.message : String(error)}`;
    status.fail(problem);
    void complain(problem);
  }
}

async function stop(): Promise<void> {
  const running = client;
  client = undefined;
  await running?.dispose().catch(() => undefined);
}

/** Tells the server that trunnion.toml has new text. Watching sees it too, but late or not at all on some file systems. */
async function settingsWritten(file: vscode.Uri): Promise<void> {
  const changes = [{ uri: file.toString(), type: FileChangeType.Changed }];
  await client?.sendNotification('workspace/didChangeWatchedFiles', { changes });
}

async function checkActiveFile(program: string): Promise<void> {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.uri.scheme !== 'file') {
    return complain('Only a program that is saved as a file can be checked in the terminal.');
  }
  await document.save();
  const path = vscode.workspace.asRelativePath(document.uri, false);
  await vscode.tasks.executeTask(checkTask(program, path, `check ${path}`, 'pretty'));
}

/** Shows a problem with the two things one can do about it. */
async function complain(problem: unknown): Promise<void> {
  const text = problem instanceof Error ? problem.message : String(problem);
  const answer = await vscode.window.showErrorMessage(`Trunnion: ${text}`, 'Open Settings', 'Restart Server');
  if (answer === 'Open Settings') {
    await vscode.commands.executeCommand('workbench.action.openSettings', 'trunnion.path');
  } else if (answer === 'Restart Server') {
    await vscode.commands.executeCommand('trunnion.restartServer');
  }
}
