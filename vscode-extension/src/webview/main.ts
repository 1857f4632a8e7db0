// The page of the backplot: controls about the view, and messages to and from the extension.
import type { FromPage, Summary, ToPage } from '../messages';
import { axisPlane, ink, joints } from './charts';
import { type Legend, type Mode, colours, short } from './colour';
import { FEED, type Path, START, kindOf, read, vertexOfLine } from './path';
import { unitOf } from './unit';
import { type Side, View } from './view';

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void; getState(): unknown; setState(state: unknown): void };

const code = acquireVsCodeApi();
const get = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const [mode, slider, readout, legend, notice] = [get<HTMLSelectElement>('mode'), get<HTMLInputElement>('time'), get('readout'), get('legend'), get('notice')];
const play = get<HTMLButtonElement>('play');
const view = new View(get<HTMLCanvasElement>('view'));

let shown: { path: Path; summary: Summary; title: string } | undefined;
/** What is drawn over it. */
let over: { path: Path; title: string } | undefined;
let at = 0;
let running: number | undefined;

const kept = (code.getState() ?? {}) as { mode?: Mode; machine?: boolean };
if (kept.mode) mode.value = kept.mode;
if (kept.machine) {
  get<HTMLInputElement>('machine').checked = true;
  view.showMachine(true);
}
const keep = () => code.setState({ mode: mode.value, machine: get<HTMLInputElement>('machine').checked });

function paint(): Float32Array {
  const { values, legend: meaning } = colours(shown!.path, mode.value as Mode, shown!.summary.machine?.tipToleranceMm ?? 0.01, unitOf(shown!.summary));
  explain(meaning);
  return values;
}

function explain(meaning: Legend): void {
  legend.replaceChildren(
    Object.assign(document.createElement('strong'), { textContent: meaning.title }),
    ...meaning.entries.map(({ colour, text }) => {
      const row = document.createElement('span');
      const swatch = document.createElement('i');
      swatch.style.background = colour;
      row.append(swatch, text);
      return row;
    }),
    ...(over ? [otherRow(over.title)] : []),
  );
}

/** The dashed line of the other program. */
function otherRow(title: string): HTMLElement {
  const row = document.createElement('span');
  row.id = 'other';
  row.append(Object.assign(document.createElement('i'), { className: 'dashed' }), title);
  return row;
}

/** Puts everything on a vertex; `share`: of the way to the next one, for what moves. */
function go(vertex: number, share = 0): void {
  if (!shown) return;
  const { path, summary } = shown;
  at = Math.max(0, Math.min(path.count - 1, vertex));
  slider.value = String(at);
  view.place(at, share);
  const tip = [0, 1, 2].map((k) => path.tip[3 * at + k]! + path.origin[k]!);
  const unit = unitOf(summary);
  const parts = [`line ${path.line[at]}`, ...tip.map((value, k) => `${'XYZ'[k]} ${unit.place(value)}`)];
  if (Number.isFinite(path.time[at])) parts.push(clock(path.time[at]!));
  if (kindOf(path, at) === FEED) {
    if (Number.isFinite(path.feed[at])) parts.push(`F ${short(unit.of(path.feed[at]!))} ${unit.name}/min`);
    if (path.feedLimit[at]! < path.feed[at]!) parts.push(`the axes allow ${short(unit.of(path.feedLimit[at]!))} ${unit.name}/min`);
  }
  readout.textContent = parts.join('   ');
  slider.setAttribute('aria-valuetext', readout.textContent);
  const style = ink(getComputedStyle(document.documentElement));
  axisPlane(get<HTMLCanvasElement>('plane'), path, at, style, over?.path);
  if (summary.machine) joints(get<HTMLCanvasElement>('joints'), path, summary.machine, at, style, unit, over?.path);
}

const clock = (seconds: number): string => `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, '0')} min`;

function show(title: string, summary: Summary, bytes: ArrayBuffer): void {
  const fresh = shown?.title !== title;
  let path: Path;
  try {
    path = read(bytes);
  } catch (error) {
    return warn(String(error));
  }
  const line = shown && !fresh ? shown.path.line[at] : undefined;
  shown = { path, summary, title };
  document.body.classList.toggle('with-machine', summary.machine !== null);
  slider.max = String(Math.max(path.count - 1, 0));
  if (path.count === 0) return warn('No path is known in this program: see its findings.');
  view.show(path, paint(), summary, fresh);
  note();
  go(line === undefined ? 0 : (vertexOfLine(path, line) ?? 0));
  code.postMessage({ type: 'drawn', vertices: path.count });
}

function remarks(summary: Summary): string[] {
  const said: string[] = [];
  if (summary.unknown === 1) said.push('One motion is not drawn: its path is not known.');
  if (summary.unknown > 1) said.push(`${summary.unknown} motions are not drawn: their path is not known.`);
  if (summary.givenUp) said.push(`${summary.givenUp}.`);
  if (summary.leftOutMm === null) said.push('Parts of the path are left out: there are too many separate pieces.');
  else if (summary.leftOutMm > 0) said.push(`${summary.vertices} of ${summary.whole} points are drawn; the others lie within ${short(unitOf(summary).of(summary.leftOutMm))} ${unitOf(summary).name}.`);
  if (!summary.machine) said.push('No machine is chosen: this is the programmed path.');
  return said;
}

/** Says what is not drawn, and why. */
function note(): void {
  if (!shown) return;
  const machine = view.machineRemark();
  warn([...remarks(shown.summary), ...(machine ? [machine] : [])].join(' '));
}

function warn(text: string): void {
  notice.textContent = text;
  notice.hidden = text === '';
}

/** Plays in the program's own time, a long program in a minute; by points where times are not known. */
function toggle(): void {
  if (running !== undefined) return halt();
  if (!shown) return;
  const { path } = shown;
  const end = path.time[path.count - 1]!;
  const timed = Number.isFinite(end) && end > 0;
  const pace = timed ? Math.max(1, end / 60) : path.count / 60;
  if (at >= path.count - 1) go(0);
  let last = performance.now();
  let clockwork = timed ? path.time[at]! : at;
  play.textContent = 'Stop';
  const step = (now: number) => {
    clockwork += ((now - last) / 1000) * pace;
    last = now;
    const clockAt = (vertex: number) => (timed ? path.time[vertex]! : vertex);
    let next = at;
    while (next < path.count - 1 && !(clockAt(next + 1) > clockwork)) next += 1;
    // between two pieces of the path nothing is known to move
    const moves = next < path.count - 1 && kindOf(path, next + 1) !== START;
    go(next, moves ? Math.max(0, (clockwork - clockAt(next)) / (clockAt(next + 1) - clockAt(next))) : 0);
    if (at >= path.count - 1) return halt();
    running = requestAnimationFrame(step);
  };
  running = requestAnimationFrame(step);
}

function halt(): void {
  if (running !== undefined) cancelAnimationFrame(running);
  running = undefined;
  play.textContent = 'Play';
}

window.addEventListener('message', ({ data }: MessageEvent<ToPage>) => {
  switch (data.type) {
    case 'path':
      over = undefined;
      view.compare(undefined);
      return show(data.title, data.summary, data.bytes);
    case 'other':
      if (shown) {
        over = { path: read(data.bytes), title: data.title };
        view.compare(over.path);
        paint();
        go(at);
        code.postMessage({ type: 'compared', vertices: over.path.count });
      }
      return;
    case 'line': {
      const vertex = shown && vertexOfLine(shown.path, data.line);
      if (vertex !== undefined && running === undefined) go(vertex);
      return;
    }
    case 'problem':
      return warn(data.text);
  }
});

mode.addEventListener('change', () => {
  keep();
  if (shown) view.paint(paint());
});
slider.addEventListener('input', () => {
  halt();
  go(Number(slider.value));
});
slider.addEventListener('change', () => shown && code.postMessage({ type: 'pick', line: shown.path.line[at]! }));
play.addEventListener('click', toggle);
for (const side of ['iso', 'top', 'front', 'right'] as Side[]) get(side).addEventListener('click', () => view.look(side));
for (const what of ['rapids', 'normals', 'tool'] as const) {
  const box = get<HTMLInputElement>(what);
  box.addEventListener('change', () => view.toggle(what, box.checked));
}

const machine = get<HTMLInputElement>('machine');
machine.addEventListener('change', () => {
  keep();
  view.showMachine(machine.checked);
  note();
});

get('view').addEventListener('keydown', (event) => {
  if (view.key(event.key)) event.preventDefault();
});

let pressed: [number, number] | undefined;
get('view').addEventListener('pointerdown', (event) => (pressed = [event.offsetX, event.offsetY]));
get('view').addEventListener('pointerup', (event) => {
  // a click, not the end of a turn of the view
  if (!pressed || Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) > 3) return;
  const vertex = view.pick(event.offsetX, event.offsetY);
  if (vertex === undefined || !shown) return;
  halt();
  go(vertex);
  code.postMessage({ type: 'pick', line: shown.path.line[vertex]! });
});

function theme(): void {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string, otherwise: string) => style.getPropertyValue(name).trim() || otherwise;
  view.theme(of('--vscode-editor-background', '#ffffff'), of('--vscode-editor-foreground', '#333333'));
  if (shown) go(at);
}
new MutationObserver(theme).observe(document.body, { attributes: true, attributeFilter: ['class'] });
window.addEventListener('resize', () => go(at));
theme();
code.postMessage({ type: 'ready' });
