// Asserts on the vscode API, inside the extension host.
const assert = require('node:assert/strict');
const vscode = require('vscode');

async function until(what, ask, milliseconds = 30_000) {
  for (const end = Date.now() + milliseconds; Date.now() < end; ) {
    const answer = await ask();
    if (answer) return answer;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`no ${what} after ${milliseconds / 1000} s`);
}

const file = (name) => vscode.Uri.joinPath(vscode.workspace.workspaceFolders[0].uri, name);
const codeOf = (diagnostic) => (typeof diagnostic.code === 'object' ? diagnostic.code.value : diagnostic.code);
const flips = (uri) => vscode.languages.getDiagnostics(uri).filter((diagnostic) => codeOf(diagnostic) === 'pole-flip');

async function show(name) {
  const document = await vscode.workspace.openTextDocument(file(name));
  await vscode.window.showTextDocument(document);
  return document;
}

const tests = {
  async 'the language is found from the file name'() {
    assert.equal((await show('strategy-2.mpf')).languageId, 'gcode');
    assert.equal((await show('strategy-2.apt')).languageId, 'apt');
  },
  async 'the first pole-flip of strategy 2 lies on C52.595'() {
    const document = await show('strategy-2.mpf');
    const found = await until('pole-flip', () => flips(document.uri).length > 0 && flips(document.uri));
    assert.equal(document.getText(found[0].range), 'C52.595');
    assert.match(document.lineAt(found[0].range.start.line).text, /^N2930\b/);
    // it leads the event at the pole, of which the feed drop is an error
    assert.equal(found[0].severity, vscode.DiagnosticSeverity.Error);
  },
  async 'the APT form of strategy 2 is judged too'() {
    const document = await show('strategy-2.apt');
    await until('pole-flip', () => flips(document.uri).length > 0);
  },
  async 'an edit that removes the flip removes the squiggle, undo brings it back'() {
    const document = await show('strategy-2.mpf');
    await until('pole-flip', () => flips(document.uri).length > 0);
    const line = flips(document.uri)[0].range.start.line;
    const on = () => flips(document.uri).filter((diagnostic) => diagnostic.range.start.line === line).length;
    const edit = new vscode.WorkspaceEdit();
    edit.replace(document.uri, flips(document.uri)[0].range, 'C4.822');
    assert.ok(await vscode.workspace.applyEdit(edit));
    await until('line without a flip', () => on() === 0);
    await vscode.commands.executeCommand('undo');
    await until('flip again', () => on() === 1);
    assert.equal(document.isDirty, false);
  },
  async 'another machine in the settings judges anew'() {
    const document = await show('strategy-2.mpf');
    await until('pole-flip', () => flips(document.uri).length > 0);
    const settings = vscode.workspace.getConfiguration('trunnion');
    await settings.update('machine', '', vscode.ConfigurationTarget.Workspace);
    await until('no flip without a machine', () => flips(document.uri).length === 0);
    await settings.update('machine', 'mikron-ucp710', vscode.ConfigurationTarget.Workspace);
    await until('the flip again', () => flips(document.uri).length > 0);
  },
  async 'a hover on a block shows text of the server'() {
    const document = await show('strategy-2.mpf');
    const found = await until('pole-flip', () => flips(document.uri)[0]);
    const hovers = await vscode.commands.executeCommand('vscode.executeHoverProvider', document.uri, found.range.start);
    const text = hovers.flatMap((hover) => hover.contents.map((part) => part.value ?? part)).join('\n');
    assert.match(text, /52\.595/, `hover: ${text}`);
  },
  async 'the quick fix smooth-pole is proved for a declared ball and cures the flip'() {
    const document = await show('strategy-2.mpf');
    const [flip] = await until('pole-flip', () => flips(document.uri).length > 0 && flips(document.uri));
    const offered = async () => {
      const all = await vscode.commands.executeCommand('vscode.executeCodeActionProvider', document.uri, flip.range);
      return all.find((action) => action.title.startsWith('smooth-pole') && action.edit && !action.disabled);
    };
    assert.equal(await offered(), undefined, 'no tool is declared, so nothing can be proved');
    const settings = vscode.workspace.getConfiguration('trunnion');
    await settings.update('tool', 'ball:10', vscode.ConfigurationTarget.Workspace);
    try {
      const action = await until('smooth-pole', offered);
      const all = await vscode.commands.executeCommand('vscode.executeCodeActionProvider', document.uri, flip.range);
      const shows = all.find((one) => one.command?.command === 'trunnion.rewriteProgram');
      assert.match(shows?.title ?? '', /^smooth-pole: show before and after, or the certificate/);
      assert.ok(await vscode.workspace.applyEdit(action.edit));
      await until('no flip', () => flips(document.uri).length === 0);
    } finally {
      await vscode.commands.executeCommand('workbench.action.files.revert');
      await settings.update('tool', undefined, vscode.ConfigurationTarget.Workspace);
    }
    await until('the flip of the original', () => flips(document.uri).length > 0);
  },
  async 'the outline, definitions, completion and colours come from the server'() {
    const content = '(trunnion: dialect fanuc-30i)\nO1\nT1 M6 (DRILL)\n#100=1\nG1 X#100 F100.\nGOTO20\nN20 M30\n';
    const { uri } = await vscode.workspace.openTextDocument({ language: 'gcode', content });
    const ask = (command, ...rest) => vscode.commands.executeCommand(command, uri, ...rest);
    const names = (list) => list.flatMap((one) => [one.name, ...names(one.children ?? [])]);
    const outline = await until('outline', async () => names((await ask('vscode.executeDocumentSymbolProvider')) ?? []));
    assert.deepEqual(outline, ['O1', 'T1', 'N20']);
    const [target] = await ask('vscode.executeDefinitionProvider', new vscode.Position(5, 5));
    assert.equal(target.range.start.line, 6);
    const edit = await ask('vscode.executeDocumentRenameProvider', new vscode.Position(3, 2), '101');
    assert.equal(edit.get(uri).length, 2);
    const { items } = await ask('vscode.executeCompletionItemProvider', new vscode.Position(4, 2));
    assert.ok(items.some((item) => item.label === 'G1'));
    const tokens = await ask('vscode.provideDocumentRangeSemanticTokens', new vscode.Range(0, 0, 5, 0));
    assert.ok(tokens.data.length > 0);
  },
  async 'chosen lines are moved alone, and what would bend a cut is refused'() {
    const content = '(trunnion: dialect fanuc-30i)\nG21 G90 G17 G94 G54\nG0 X0. Y0. Z50.\nG0 X10. Y10. Z2.\nG1 Z-1. F100.\nG1 X20.\nG0 Z50.\nG0 X40.\nG1 Z-1. F100.\nG0 Z50.\nM30\n';
    const document = await vscode.workspace.openTextDocument({ language: 'gcode', content });
    await vscode.window.showTextDocument(document);
    const lines = (first, last) => ({ start: { line: first, character: 0 }, end: { line: last, character: 0 } });
    const shift = { kind: 'shift', by: [3, 0, 0] };
    assert.equal(await vscode.commands.executeCommand('trunnion.editProgram', shift, lines(3, 5)), false, 'the cut after it would begin elsewhere');
    assert.equal(document.getText(), content);
    assert.equal(await vscode.commands.executeCommand('trunnion.editProgram', shift, lines(3, 6)), true);
    assert.equal(document.getText(), content.replace('X10.', 'X13.').replace('X20.', 'X23.'));
  },
  async 'formatting, and the lens that shows an operation in the backplot'() {
    const content = '(trunnion: dialect fanuc-30i)\nO1\nT1 M6 (DRILL)\ng0x1.y2.\nM30\n';
    const { uri } = await vscode.workspace.openTextDocument({ language: 'gcode', content });
    const edits = await until('edits', () => vscode.commands.executeCommand('vscode.executeFormatDocumentProvider', uri, { tabSize: 2, insertSpaces: true }));
    assert.ok(edits.some((edit) => /G0 X1\. Y2\./.test(edit.newText)) || edits.length > 2, JSON.stringify(edits));
    const lenses = await until('lens', async () => {
      const all = await vscode.commands.executeCommand('vscode.executeCodeLensProvider', uri, 10);
      return all.find((lens) => lens.command?.command === 'trunnion.showInBackplot');
    });
    assert.equal(lenses.command.arguments[1], 2);
  },
  async 'a machine file is read as one, and another TOML file is left alone'() {
    const machine = await show('ours.toml');
    const at = machine.positionAt(machine.getText().indexOf('name') + 1);
    const hover = await until('hover', async () => (await vscode.commands.executeCommand('vscode.executeHoverProvider', machine.uri, at))[0]);
    assert.match(hover.contents.map((part) => part.value ?? part).join(''), /\*\*name\*\*/);
    const edit = new vscode.WorkspaceEdit();
    edit.insert(machine.uri, new vscode.Position(0, 0), 'nonsense = 1\n');
    assert.ok(await vscode.workspace.applyEdit(edit));
    await until('finding', () => vscode.languages.getDiagnostics(machine.uri).length > 0);
    await vscode.commands.executeCommand('workbench.action.files.revert');
    const other = await vscode.workspace.openTextDocument(file('other.toml'));
    await show('strategy-2.mpf');
    await until('pole-flip', () => flips(file('strategy-2.mpf')).length > 0);
    assert.deepEqual(vscode.languages.getDiagnostics(other.uri), []);
  },
  async 'words end where the next address begins'() {
    const document = await vscode.workspace.openTextDocument({ language: 'gcode', content: 'N10G1X10Y-2.5 #<_a b>=#101' });
    const words = [1, 4, 6, 10, 16, 24].map((at) => document.getText(document.getWordRangeAtPosition(new vscode.Position(0, at))));
    assert.deepEqual(words, ['N10', 'G1', 'X10', 'Y-2.5', '#<_a b>', '#101']);
  },
  async 'the commands are there'() {
    const all = await vscode.commands.getCommands(true);
    for (const name of ['restartServer', 'chooseMachine', 'chooseDialect', 'checkFile', 'editProgram', 'rewriteProgram', 'showInBackplot']) assert.ok(all.includes(`trunnion.${name}`), name);
  },
  async 'a restarted server finds the flip again'() {
    const document = await show('strategy-2.mpf');
    await until('pole-flip', () => flips(document.uri).length > 0);
    await vscode.commands.executeCommand('trunnion.restartServer');
    await until('pole-flip after the restart', () => flips(document.uri).length > 0);
  },
  async 'the check in the terminal ends with a verdict'() {
    await show('strategy-2.mpf');
    const ended = new Promise((resolve) => {
      const listener = vscode.tasks.onDidEndTaskProcess((event) => {
        listener.dispose();
        resolve(event);
      });
    });
    await vscode.commands.executeCommand('trunnion.checkFile');
    const { execution, exitCode } = await ended;
    assert.equal(execution.task.definition.path, 'strategy-2.mpf');
    assert.ok(exitCode === 0 || exitCode === 1, `exit code ${exitCode}`);
  },
  async 'the task reports through the problem matcher'() {
    await vscode.commands.executeCommand('workbench.action.closeAllEditors');
    const tasks = await vscode.tasks.fetchTasks({ type: 'trunnion' });
    assert.equal(tasks.length, 1);
    await vscode.tasks.executeTask(tasks[0]);
    const found = await until('pole-flip by the task', () => flips(file('strategy-2.mpf'))[0]);
    assert.equal(found.source, 'trunnion');
    assert.equal(found.range.start.character > 0, true);
  },
};

exports.run = async () => {
  let failed = 0;
  for (const [name, body] of Object.entries(tests)) {
    try {
      await body();
      console.log(`ok - host: ${name}`);
    } catch (error) {
      failed += 1;
      console.log(`not ok - host: ${name}: ${error.message}`);
    }
  }
  console.log(`host: ${Object.keys(tests).length - failed} passed, ${failed} failed`);
  if (failed > 0) throw new Error(`${failed} failed`);
};
