// Beside the path: the tool axis seen along Z, and the joints over the path.
import type { Machine } from '../messages';
import { type Path, RAPID, START, kindOf } from './path';
import type { Unit } from './unit';

interface Ink {
  foreground: string;
  faint: string;
  line: string;
  mark: string;
}

/** The colours of the theme. */
export function ink(style: CSSStyleDeclaration): Ink {
  const of = (name: string, otherwise: string) => style.getPropertyValue(name).trim() || otherwise;
  return {
    foreground: of('--vscode-foreground', '#333333'),
    faint: of('--vscode-editorWidget-border', of('--vscode-contrastBorder', '#888888')),
    line: '#0072b2',
    mark: '#d55e00',
  };
}

function surface(canvas: HTMLCanvasElement): { pen: CanvasRenderingContext2D; width: number; height: number } | undefined {
  const { clientWidth: width, clientHeight: height } = canvas;
  const pen = canvas.getContext('2d');
  if (!pen || width === 0 || height === 0) return undefined;
  const ratio = window.devicePixelRatio;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  pen.scale(ratio, ratio);
  pen.font = '11px var(--vscode-font-family, sans-serif)';
  return { pen, width, height };
}

/** i and j of the tool axis in the cuts: the pole of a machine with an upright first axis is the middle. */
export function axisPlane(canvas: HTMLCanvasElement, path: Path, at: number, colours: Ink, other?: Path): void {
  const drawing = surface(canvas);
  if (!drawing) return;
  const { pen, width, height } = drawing;
  let most = 0.02;
  for (const one of [path, ...(other ? [other] : [])]) {
    for (let k = 0; k < one.count; k += 1) if (kindOf(one, k) !== RAPID) most = Math.max(most, Math.hypot(one.axis[3 * k]!, one.axis[3 * k + 1]!));
  }
  const scale = (0.5 * Math.min(width, height) - 16) / most;
  const place = (k: number, of = path): [number, number] => [width / 2 + of.axis[3 * k]! * scale, height / 2 - of.axis[3 * k + 1]! * scale];
  pen.strokeStyle = colours.faint;
  pen.fillStyle = colours.foreground;
  for (const share of [0.5, 1]) {
    pen.beginPath();
    pen.arc(width / 2, height / 2, most * share * scale, 0, 2 * Math.PI);
    pen.stroke();
    const tilt = (Math.asin(Math.min(1, most * share)) * 180) / Math.PI;
    pen.fillText(`${Number(tilt.toPrecision(2))}\u00b0`, width / 2 + most * share * scale * 0.7 + 3, height / 2 - most * share * scale * 0.7 - 3);
  }
  pen.beginPath();
  pen.moveTo(width / 2 - 5, height / 2);
  pen.lineTo(width / 2 + 5, height / 2);
  pen.moveTo(width / 2, height / 2 - 5);
  pen.lineTo(width / 2, height / 2 + 5);
  pen.stroke();
  const draw = (of: Path) => {
    pen.beginPath();
    for (let k = 0; k < of.count; k += 1) {
      const [x, y] = place(k, of);
      if (k === 0 || kindOf(of, k) === START || kindOf(of, k) === RAPID) pen.moveTo(x, y);
      else pen.lineTo(x, y);
    }
    pen.stroke();
  };
  if (other) dashed(pen, colours, () => draw(other));
  pen.strokeStyle = colours.line;
  draw(path);
  dot(pen, ...place(at), colours.mark);
  pen.fillStyle = colours.foreground;
  pen.fillText('tool axis (i, j)', 6, 13);
}

/** What another program does, in the colour of text. */
function dashed(pen: CanvasRenderingContext2D, colours: Ink, draw: () => void): void {
  pen.strokeStyle = colours.foreground;
  pen.setLineDash([3, 3]);
  draw();
  pen.setLineDash([]);
}

/** How far the tip has gone at each vertex, as a share of the whole way. */
function way(path: Path): Float64Array {
  const gone = new Float64Array(path.count);
  for (let k = 1; k < path.count; k += 1) {
    const step = kindOf(path, k) === START ? 0 : Math.hypot(...[0, 1, 2].map((c) => path.tip[3 * k + c]! - path.tip[3 * k - 3 + c]!));
    gone[k] = gone[k - 1]! + step;
  }
  const whole = gone[path.count - 1] || 1;
  return gone.map((length) => length / whole);
}

/** For each vertex of another path, the vertex of this one (with a fraction) where the tip has gone as far. */
export function beside(other: Path, path: Path): Float64Array {
  const [theirs, own] = [way(other), way(path)];
  let next = 0;
  return theirs.map((gone) => {
    while (next < own.length - 1 && own[next + 1]! <= gone) next += 1;
    const step = next < own.length - 1 ? own[next + 1]! - own[next]! : 0;
    return next + (step > 0 ? Math.min(1, Math.max(0, (gone - own[next]!) / step)) : 0);
  });
}

/** Each joint over the vertices, with its limits. */
export function joints(canvas: HTMLCanvasElement, path: Path, machine: Machine, at: number, colours: Ink, unit: Unit, other?: Path): void {
  const drawing = surface(canvas);
  if (!drawing || path.axes === 0) return;
  const { pen, width, height } = drawing;
  const tall = height / path.axes;
  const compared = other?.axes === path.axes && other.count > 0 ? { path: other, place: beside(other, path) } : undefined;
  machine.axes.forEach((axis, index) => {
    const value = (k: number) => path.joints[k * path.axes + index]!;
    let [low, high] = [Infinity, -Infinity];
    for (let k = 0; k < path.count; k += 1) {
      const v = value(k);
      if (v < low) low = v;
      if (v > high) high = v;
    }
    const theirs = (k: number) => compared!.path.joints[k * path.axes + index]!;
    for (let k = 0; k < (compared?.path.count ?? 0); k += 1) {
      if (theirs(k) < low) low = theirs(k);
      if (theirs(k) > high) high = theirs(k);
    }
    if (low > high) return;
    // limits are drawn where the joint comes near them
    const margin = 0.15 * Math.max(high - low, 1);
    const limits = (axis.limits ?? []).filter((limit) => limit > low - margin && limit < high + margin);
    const [from, to] = [Math.min(low, ...limits), Math.max(high, ...limits)];
    const y = (v: number) => tall * index + 16 + (1 - (v - from) / Math.max(to - from, 1e-9)) * (tall - 22);
    const x = (k: number) => 4 + (k / Math.max(path.count - 1, 1)) * (width - 8);
    pen.strokeStyle = colours.mark;
    pen.setLineDash([4, 3]);
    for (const limit of limits) {
      pen.beginPath();
      pen.moveTo(4, y(limit));
      pen.lineTo(width - 4, y(limit));
      pen.stroke();
    }
    pen.setLineDash([]);
    if (compared) dashed(pen, colours, () => {
      pen.beginPath();
      const every = Math.max(1, Math.floor(compared.path.count / width));
      for (let k = 0; k < compared.path.count; k += every) if (Number.isFinite(theirs(k))) pen.lineTo(x(compared.place[k]!), y(theirs(k)));
      pen.stroke();
    });
    pen.strokeStyle = colours.line;
    pen.beginPath();
    // more vertices than pixels: lowest and highest of each pixel
    const every = Math.max(1, Math.floor(path.count / width));
    for (let k = 0; k < path.count; k += every) {
      const v = value(k);
      if (k === 0 || Number.isNaN(v)) pen.moveTo(x(k), y(Number.isNaN(v) ? from : v));
      else pen.lineTo(x(k), y(v));
    }
    pen.stroke();
    const now = value(at);
    if (Number.isFinite(now)) dot(pen, x(at), y(now), colours.mark);
    pen.fillStyle = colours.foreground;
    const text = axis.rotary ? `${now.toFixed(3)}\u00b0` : `${unit.place(now)} ${unit.name}`;
    const shown = Number.isFinite(now) ? text : 'unknown';
    pen.fillText(`${axis.letter} ${shown}`, 6, tall * index + 12);
  });
}

function dot(pen: CanvasRenderingContext2D, x: number, y: number, colour: string): void {
  pen.fillStyle = colour;
  pen.beginPath();
  pen.arc(x, y, 3.5, 0, 2 * Math.PI);
  pen.fill();
}
