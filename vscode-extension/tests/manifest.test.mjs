// The manifest agrees with the dialect tables, with the word pattern, and with the form the command line prints.
import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

const here = (path) => new URL(`../${path}`, import.meta.url);
const manifest = JSON.parse(readFileSync(here('package.json'), 'utf8'));
const { contributes } = manifest;
const dialects = readdirSync(here('../grammar/dialects')).filter((name) => name.endsWith('.toml'));

test('the dialect setting offers exactly the dialect tables', () => {
  const setting = contributes.configuration.properties['trunnion.dialect'];
  const tables = dialects.map((name) => name.replace(/\.toml$/, ''));
  assert.deepEqual([...setting.enum].sort(), ['', ...tables].sort());
  assert.equal(setting.enum.length, setting.enumDescriptions.length);
});

test('every file extension of a dialect table belongs to a language', () => {
  const known = new Set(contributes.languages.flatMap((language) => language.extensions));
  for (const name of dialects) {
    const list = /^extensions\s*=\s*\[([^\]]*)\]/m.exec(readFileSync(here(`../grammar/dialects/${name}`), 'utf8'))?.[1] ?? '';
    for (const [, extension] of list.matchAll(/"([^"]+)"/g)) {
      assert.ok(known.has(`.${extension}`), `.${extension} of ${name} is in no language of package.json`);
    }
  }
});

test('Neovim takes the same files for programs', () => {
  const lua = readFileSync(here('../integrations/neovim/lua/trunnion/filetypes.lua'), 'utf8');
  const server = readFileSync(here('../integrations/neovim/lsp/trunnion.lua'), 'utf8');
  const tables = [...lua.matchAll(/^  (\w+) = \{\n    extensions = \{([^}]*)\}/gm)];
  const read = tables.map(([, id, list]) => [id, [...list.matchAll(/'([^']+)'/g)].map(([, extension]) => `.${extension}`).sort()]);
  const expected = contributes.languages.map(({ id, extensions }) => [id, [...extensions].sort()]);
  assert.deepEqual(Object.fromEntries(read), Object.fromEntries(expected));
  for (const { id } of contributes.languages) assert.ok(server.includes(`'${id}'`), `${id} is not in lsp/trunnion.lua`);
});

test('Zed takes the same files for programs', () => {
  const extension = readFileSync(here('../integrations/zed/extension.toml'), 'utf8');
  for (const { id, extensions, firstLine } of contributes.languages) {
    const config = readFileSync(here(`../integrations/zed/languages/${id}/config.toml`), 'utf8');
    const suffixes = /path_suffixes = \[([^\]]*)\]/.exec(config)[1].match(/"[^"]+"/g).map((suffix) => `.${suffix.slice(1, -1)}`);
    assert.deepEqual(suffixes.sort(), extensions.filter((one) => one !== '.h').sort(), id);
    assert.ok(config.includes(`first_line_pattern = '${firstLine}'`), id);
    const name = /^name = (".*")$/m.exec(config)[1];
    assert.ok(extension.includes(`${name} = "${id}"`) && new RegExp(`languages = \\[.*${name}`).test(extension), id);
  }
});

test('the configurations in docs/editors.md name the same files', () => {
  const text = readFileSync(here('../docs/editors.md'), 'utf8');
  const [emacs] = /```elisp[^]*?```/.exec(text);
  const [helix] = /```toml[^]*?```/.exec(text);
  for (const { id, extensions } of contributes.languages) {
    // .h belongs to C there, unless the text says otherwise
    for (const extension of extensions.filter((one) => one !== '.h').map((one) => one.slice(1))) {
      assert.match(emacs, new RegExp(`[(|]${extension}\\\\\\\\[|)]`), `${extension} in the configuration of Emacs`);
      assert.ok(helix.includes(`"${extension}"`), `${extension} in the configuration of Helix`);
    }
    assert.ok(helix.includes(`language-id = "${id}"`) && emacs.includes(`:language-id "${id}"`), id);
  }
});

test('no file extension belongs to two languages', () => {
  const all = contributes.languages.flatMap((language) => language.extensions);
  assert.deepEqual([...new Set(all)], all);
});

test('each thing that is shown in addition can be switched off', () => {
  const { properties } = contributes.configuration;
  for (const name of ['hints.values', 'hints.modal', 'codeLens']) assert.equal(properties[`trunnion.${name}`].type, 'boolean', name);
});

test('every file the manifest names exists', () => {
  const named = [manifest.icon, ...contributes.grammars.map((grammar) => grammar.path), ...contributes.languages.map((language) => language.configuration)];
  for (const path of named) assert.ok(existsSync(here(path)), path);
});

test('the walkthrough names commands, texts and events that exist', () => {
  const own = new Set(contributes.commands.map(({ command }) => command));
  // those of VS Code itself, https://code.visualstudio.com/api/references/contribution-points#contributes.walkthroughs
  const known = (command) => own.has(command) || /^(workbench\.action(s)?\.|editor\.action\.)/.test(command);
  const shipped = readFileSync(here('.vscodeignore'), 'utf8');
  assert.ok(shipped.includes('!media/walkthrough/*'));
  const { steps } = contributes.walkthroughs[0];
  assert.deepEqual(steps.map(({ id }) => id), ['program', 'machine', 'findings', 'fix', 'backplot']);
  for (const { id, title, description, media, completionEvents } of steps) {
    const buttons = [...description.matchAll(/\]\(command:([^)]+)\)/g)].map(([, command]) => command);
    assert.ok(title && buttons.length > 0 && completionEvents.length > 0, id);
    for (const command of [...buttons, ...completionEvents.map((event) => event.replace('onCommand:', ''))]) assert.ok(known(command), `${id}: ${command}`);
    const text = readFileSync(here(media.markdown), 'utf8');
    for (const [, picture] of text.matchAll(/!\[[^\]]+\]\(([^)]+)\)/g)) assert.ok(existsSync(here(`media/walkthrough/${picture}`)), picture);
    // commands that a text names in italics are those of the palette
    for (const [, name] of text.matchAll(/\*Trunnion: ([^*]+)\*/g)) assert.ok(contributes.commands.some((command) => command.title === name), name);
  }
});

test('dependencies are pinned exactly', () => {
  for (const [name, version] of Object.entries(manifest.devDependencies)) assert.match(version, /^\d+\.\d+\.\d+$/, name);
});

test('the lock file names no registry', () => {
  assert.equal(readFileSync(here('package-lock.json'), 'utf8').includes('"resolved"'), false);
});

test('the problem pattern reads `check --format short`', () => {
  const [pattern] = contributes.problemPatterns;
  const match = new RegExp(pattern.regexp).exec('parts/strategy-2.mpf:9:48: warning[pole-flip] C turns 47.773 deg');
  const read = ['file', 'line', 'column', 'severity', 'code', 'message'].map((key) => match[pattern[key]]);
  assert.deepEqual(read, ['parts/strategy-2.mpf', '9', '48', 'warning', 'pole-flip', 'C turns 47.773 deg']);
  const unknown = new RegExp(pattern.regexp).exec('a.nc:5:1: unknown[work-offset-unset] G54 is not declared');
  assert.equal(unknown[pattern.code], 'work-offset-unset');
  // VS Code knows no severity of that name and takes that of the matcher
  assert.equal(contributes.problemMatchers[0].severity, 'info');
  const drive = new RegExp(pattern.regexp).exec('C:\\nc\\a.nc:1:2: error[syntax-error] x');
  assert.equal(drive[pattern.file], 'C:\\nc\\a.nc');
});

const words = (language, text) => {
  const { wordPattern } = JSON.parse(readFileSync(here(`${language}.language-configuration.json`), 'utf8'));
  return text.match(new RegExp(wordPattern, 'g'));
};

test('joined G-code words are words of their own', () => {
  const all = {
    'G1X10Y-2.5': ['G1', 'X10', 'Y-2.5'],
    'n10g01x.5f100.': ['n10', 'g01', 'x.5', 'f100.'],
    '#100=#<_depth of cut>': ['#100', '#<_depth of cut>'],
    'A3=0.5 C=DC(90)': ['A3', '0.5', 'C', 'DC', '90'],
    'CYCLE800(1,"TC") TRAORI': ['CYCLE800', '1', 'TC', 'TRAORI'],
    'GOTOF _END R1=$AA_IM': ['GOTOF', '_END', 'R1', '$AA_IM'],
  };
  for (const [text, expected] of Object.entries(all)) assert.deepEqual(words('gcode', text), expected, text);
});

test('APT words, numbers with signs and exponents', () => {
  assert.deepEqual(words('apt', 'GOTO / -28.38,-2.1E-4, .5, 1.'), ['GOTO', '-28.38', '-2.1E-4', '.5', '1.']);
});

test('the licences are those of the project', () => {
  for (const name of ['LICENSE-MIT', 'LICENSE-APACHE']) assert.equal(readFileSync(here(name), 'utf8'), readFileSync(here(`../${name}`), 'utf8'), name);
});

test('pictures of the README are there and packed', () => {
  const pictures = [...readFileSync(here('README.md'), 'utf8').matchAll(/!\[[^\]]+\]\(([^)]+)\)/g)].map(([, picture]) => picture);
  assert.equal(pictures.length, 3);
  const packed = readFileSync(here('.vscodeignore'), 'utf8');
  for (const picture of pictures) {
    assert.ok(existsSync(here(picture)), picture);
    assert.ok(packed.includes(`!${picture.replace(/[^/]+$/, '*')}`), picture);
  }
});
