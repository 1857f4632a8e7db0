// The bytes of a path (docs/scene.md), as arrays.

export const START = 0;
export const RAPID = 1;
export const FEED = 2;

export interface Path {
  count: number;
  axes: number;
  origin: [number, number, number];
  /** x y z of the tip relative to the origin, mm. */
  tip: Float32Array;
  /** Unit tool axis. */
  axis: Float32Array;
  /** s */
  time: Float32Array;
  /** Proven deviation bound, mm. */
  deviation: Float32Array;
  /** Highest feed the axes allow, and programmed feed, mm/min. */
  feedLimit: Float32Array;
  feed: Float32Array;
  line: Uint32Array;
  flags: Uint32Array;
  /** mm or deg, `axes` values a vertex. */
  joints: Float32Array;
}

export const kindOf = (path: Path, at: number): number => path.flags[at]! & 3;
export const levelOf = (path: Path, at: number): number => (path.flags[at]! >> 8) & 3;
/** 0 none, 1 at the pole, 2 plus, 3 minus. */
export const postureOf = (path: Path, at: number): number => (path.flags[at]! >> 4) & 3;

/** The tips of the cuts, or of all motions where nothing is cut. */
export function cuts(path: Path): number[] | Float32Array {
  const points: number[] = [];
  for (let at = 0; at < path.count; at += 1) {
    if (kindOf(path, at) !== RAPID && kindOf(path, at) !== START) points.push(path.tip[3 * at]!, path.tip[3 * at + 1]!, path.tip[3 * at + 2]!);
  }
  return points.length > 0 ? points : path.tip;
}

/** Reads the bytes; throws where they are not what docs/scene.md says. */
export function read(bytes: ArrayBuffer): Path {
  const view = new DataView(bytes);
  if (view.getUint32(0, false) !== 0x54525343 || view.getUint32(4, true) !== 1) {
    throw new Error('these bytes are no path of this version');
  }
  const count = view.getUint32(8, true);
  const axes = view.getUint32(12, true);
  const origin: [number, number, number] = [view.getFloat64(16, true), view.getFloat64(24, true), view.getFloat64(32, true)];
  let at = 40;
  const floats = (many: number): Float32Array => {
    const values = new Float32Array(bytes, at, many);
    at += 4 * many;
    return values;
  };
  const words = (many: number): Uint32Array => {
    const values = new Uint32Array(bytes, at, many);
    at += 4 * many;
    return values;
  };
  return {
    count,
    axes,
    origin,
    tip: floats(3 * count),
    axis: floats(3 * count),
    time: floats(count),
    deviation: floats(count),
    feedLimit: floats(count),
    feed: floats(count),
    line: words(count),
    flags: words(count),
    joints: floats(count * axes),
  };
}

/** The last vertex of the first stretch of a line; where the line has none, that of the nearest line before it. */
export function vertexOfLine(path: Path, line: number): number | undefined {
  let best: number | undefined;
  for (let at = 0; at < path.count; at += 1) {
    const own = path.line[at]!;
    if (own === line) {
      let last = at;
      while (last + 1 < path.count && path.line[last + 1] === line && kindOf(path, last + 1) !== START) last += 1;
      return last;
    }
    if (own < line && (best === undefined || own >= path.line[best]!)) best = at;
  }
  return best;
}
