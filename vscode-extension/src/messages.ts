// What the extension and the backplot's page say to each other.

/** What the server says of a path (`trunnion/backplot`); lengths in mm. */
export interface Summary {
  vertices: number;
  whole: number;
  leftOutMm: number | null;
  /** People read the lengths of the program in inch. */
  inch: boolean;
  unknown: number;
  givenUp: string | null;
  origin: [number, number, number];
  low: [number, number, number];
  high: [number, number, number];
  machine: Machine | null;
  tool: { number: number | null; diameter: number | null; length: number | null } | null;
}

/** A machine as far as a page draws it; limits in mm or deg. */
export interface Machine {
  id: string;
  name: string;
  /** From workpiece to tool. */
  axes: AxisSketch[];
  tipToleranceMm: number;
}

/** One axis: limits in mm or deg; direction and point (mm) in the machine with all axes at zero; `table`: it carries the part. */
export interface AxisSketch {
  letter: string;
  rotary: boolean;
  table: boolean;
  direction: [number, number, number];
  point: [number, number, number];
  sign: number;
  limits: [number, number] | null;
}

/** To the page. */
export type ToPage =
  | { type: 'path'; title: string; summary: Summary; bytes: ArrayBuffer }
  | { type: 'other'; title: string; summary: Summary; bytes: ArrayBuffer }
  | { type: 'line'; line: number }
  | { type: 'problem'; text: string };

/** From the page. */
export type FromPage = { type: 'ready' } | { type: 'pick'; line: number } | { type: 'drawn' | 'compared'; vertices: number };
