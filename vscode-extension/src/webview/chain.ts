// The chain of axes of a machine, from workpiece to tool: where the part and the tool stand at a vertex.
//
// Formula (docs/kinematics.md, machine model): tip in the part = A1 A2 ... An u. Each A turns about its line or shifts along its
// direction, by the value of its joint times its sign. Axes of the table move the part the other way.
import { Matrix4, Vector3 } from 'three';
import type { AxisSketch } from '../messages';
import { FEED, type Path, kindOf } from './path';

/** What one axis does at a value (mm or deg), as the tool moves in the part. */
export function motion(axis: AxisSketch, value: number): Matrix4 {
  const direction = new Vector3(...axis.direction);
  const by = value * axis.sign;
  if (!axis.rotary) return new Matrix4().makeTranslation(direction.multiplyScalar(by));
  const point = new Vector3(...axis.point);
  const turn = new Matrix4().makeRotationAxis(direction.normalize(), (by * Math.PI) / 180);
  return new Matrix4().makeTranslation(point).multiply(turn).multiply(new Matrix4().makeTranslation(point.clone().negate()));
}

/** The joints of a vertex, or at a share of the way to the next one; undefined where one of them is not known. */
export function jointsAt(path: Path, at: number, share = 0): number[] | undefined {
  const of = (vertex: number): number[] => Array.from(path.joints.subarray(vertex * path.axes, (vertex + 1) * path.axes));
  const here = of(at);
  const values = share > 0 ? of(at + 1).map((next, k) => here[k]! + share * (next - here[k]!)) : here;
  return values.length > 0 && values.every(Number.isFinite) ? values : undefined;
}

/** How many axes at the start of the chain carry the part. */
export const carried = (axes: AxisSketch[]): number => axes.filter((axis) => axis.table).length;

/** Where a body that moves with axis `index` stands in the machine: with it and all axes between it and the bed. */
export function bodyAt(axes: AxisSketch[], joints: number[], index: number): Matrix4 {
  const table = carried(axes);
  const pose = new Matrix4();
  if (index >= table) {
    for (let k = table; k <= index; k += 1) pose.multiply(motion(axes[k]!, joints[k]!));
    return pose;
  }
  for (let k = index; k < table; k += 1) pose.multiply(motion(axes[k]!, joints[k]!));
  return pose.invert();
}

/** What the path tells about the set-up. */
export interface SetUp {
  /** From the frame of the program (relative to the origin of the path) to that of the part on the table, mm. */
  offset: Vector3;
  /** The tip with all axes at zero, mm. */
  tip: Vector3;
  /** Share of the vertices where a tip that is computed from the axes lies off the path: other tool lengths or offsets. */
  others: number;
}

const SAMPLES = 2000;
/** A tip that is this near to the path agrees with it, mm: the numbers of a path have seven digits. */
const AGREES = 0.05;

interface Row {
  chain: Matrix4;
  at: Vector3;
  weight: number;
}

/**
 * Work offset and tip from tips and joints. Where a program changes its tool length or its offset, those of most of the cuts:
 * least squares whose weights are the inverse of the distance. Where the axes do not turn, only the difference of both counts; then
 * the tip is `guess`.
 */
export function setUp(path: Path, axes: AxisSketch[], guess: Vector3): SetUp | undefined {
  const known = Array.from({ length: path.count }, (_, at) => at).filter((at) => jointsAt(path, at));
  const feeds = known.filter((at) => kindOf(path, at) === FEED);
  const chosen = feeds.length > 0 ? feeds : known;
  const every = Math.max(1, Math.floor(chosen.length / SAMPLES));
  const rows: Row[] = [];
  for (let k = 0; k < chosen.length; k += every) {
    const joints = jointsAt(path, chosen[k]!)!;
    const chain = axes.reduce((all, axis, n) => all.multiply(motion(axis, joints[n]!)), new Matrix4());
    rows.push({ chain, at: new Vector3().fromArray(path.tip, 3 * chosen[k]!), weight: 1 });
  }
  if (rows.length === 0) return undefined;
  let found: SetUp | undefined;
  for (let turn = 0; turn < 30; turn += 1) {
    const x = solve(normal(rows, guess));
    if (!x) return undefined;
    const [tip, offset] = [guess.clone().add(new Vector3(x[0], x[1], x[2])), new Vector3(x[3], x[4], x[5])];
    let others = 0;
    for (const row of rows) {
      const apart = tip.clone().applyMatrix4(row.chain).sub(row.at).sub(offset).length();
      if (apart > AGREES) others += 1 / rows.length;
      row.weight = 1 / Math.max(apart, 1e-3);
    }
    found = { offset, tip, others };
    if (others === 0) return found;
  }
  return found;
}

/** Normal equations of R x - offset = p - A guess, where tip = guess + x; the last column is the right-hand side. */
function normal(rows: Row[], guess: Vector3): number[][] {
  const sums = Array.from({ length: 6 }, () => new Array<number>(7).fill(0));
  const whole = rows.reduce((sum, { weight }) => sum + weight, 0);
  for (const { chain, at, weight } of rows) {
    const right = at.clone().sub(guess.clone().applyMatrix4(chain));
    const e = chain.elements;
    for (let k = 0; k < 3; k += 1) {
      const row = [e[k]!, e[4 + k]!, e[8 + k]!, 0, 0, 0, right.getComponent(k)];
      row[3 + k] = -1;
      for (let i = 0; i < 6; i += 1) for (let j = 0; j < 7; j += 1) sums[i]![j]! += (row[i]! * row[j]! * weight) / whole;
    }
  }
  // what the path does not tell stays at the guess
  for (let k = 0; k < 3; k += 1) sums[k]![k]! += 1e-7;
  return sums;
}

/** Gauss with pivots; the last column is the right-hand side. */
function solve(rows: number[][]): number[] | undefined {
  const size = rows.length;
  for (let k = 0; k < size; k += 1) {
    let best = k;
    for (let i = k + 1; i < size; i += 1) if (Math.abs(rows[i]![k]!) > Math.abs(rows[best]![k]!)) best = i;
    [rows[k], rows[best]] = [rows[best]!, rows[k]!];
    const pivot = rows[k]![k]!;
    if (Math.abs(pivot) < 1e-14) return undefined;
    for (let i = 0; i < size; i += 1) {
      if (i === k) continue;
      const share = rows[i]![k]! / pivot;
      for (let j = k; j <= size; j += 1) rows[i]![j]! -= share * rows[k]![j]!;
    }
  }
  return rows.map((row, k) => row[size]! / row[k]!);
}
