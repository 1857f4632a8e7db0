// What the colours of a path mean. Chosen so that people who confuse red and green can tell them apart (Okabe and Ito, 2008), and
// so that they stand out on light and dark.
import { type Path, RAPID, kindOf, levelOf, postureOf } from './path';
import type { Unit } from './unit';

export type Mode = 'finding' | 'deviation' | 'feed' | 'posture';

type Rgb = [number, number, number];

const hex = (text: string): Rgb => [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16) / 255) as Rgb;
const BLUE = hex('#0072b2');
const SKY = hex('#56b4e9');
const ORANGE = hex('#e69f00');
const VERMILION = hex('#d55e00');
const PURPLE = hex('#cc79a7');
const GREEN = hex('#009e73');
const GREY = hex('#8a8a8a');

export interface Legend {
  title: string;
  entries: { colour: string; text: string }[];
}

const css = ([r, g, b]: Rgb): string => `rgb(${Math.round(r * 255)}, ${Math.round(g * 255)}, ${Math.round(b * 255)})`;

/** From good to bad. */
const STEPS: Rgb[] = [BLUE, SKY, GREEN, ORANGE, VERMILION];

/** The colours of all vertices, r g b each, and what they mean. `tolerance`: of the tip, mm. `unit`: of the lengths in the meaning. */
export function colours(path: Path, mode: Mode, tolerance: number, unit: Unit): { values: Float32Array; legend: Legend } {
  const values = new Float32Array(3 * path.count);
  const { of, legend } = scale(path, mode, tolerance, unit);
  for (let at = 0; at < path.count; at += 1) {
    values.set(kindOf(path, at) === RAPID ? GREY : of(at), 3 * at);
  }
  return { values, legend };
}

function scale(path: Path, mode: Mode, tolerance: number, unit: Unit): { of: (at: number) => Rgb; legend: Legend } {
  const entry = (colour: Rgb, text: string) => ({ colour: css(colour), text });
  const rapid = entry(GREY, 'rapid');
  switch (mode) {
    case 'finding': {
      const levels = [BLUE, PURPLE, ORANGE, VERMILION];
      return {
        of: (at) => levels[levelOf(path, at)]!,
        legend: { title: 'Findings', entries: [entry(BLUE, 'nothing found'), entry(PURPLE, 'info or unknown'), entry(ORANGE, 'warning'), entry(VERMILION, 'error'), rapid] },
      };
    }
    case 'posture': {
      const postures = [GREY, PURPLE, BLUE, ORANGE];
      return {
        of: (at) => postures[postureOf(path, at)]!,
        legend: { title: 'Posture', entries: [entry(BLUE, 'posture +'), entry(ORANGE, 'posture \u2212'), entry(PURPLE, 'at the pole'), entry(GREY, 'rapid, or none')] },
      };
    }
    case 'deviation': {
      const bounds = [0.1, 0.5, 1, 2].map((share) => share * tolerance);
      const length = (mm: number) => `${short(unit.of(mm))} ${unit.name}`;
      return {
        of: (at) => step(path.deviation[at]!, bounds),
        legend: {
          title: `Deviation of the tip (tolerance ${length(tolerance)})`,
          entries: [...STEPS.map((colour, at) => entry(colour, at < 4 ? `up to ${length(bounds[at]!)}` : `more than ${length(bounds[3]!)}`)), entry(PURPLE, 'not known'), rapid],
        },
      };
    }
    case 'feed': {
      const bounds = [1, 1 / 0.8, 1 / 0.5, 1 / 0.3];
      return {
        // how many times the programmed feed is faster than what the axes allow
        of: (at) => step(path.feed[at]! / path.feedLimit[at]!, bounds),
        legend: {
          title: 'Feed that the axes allow',
          entries: [
            ...STEPS.map((colour, at) => entry(colour, ['all of the programmed feed', 'at least 80 %', 'at least 50 %', 'at least 30 %', 'less than 30 %'][at]!)),
            entry(PURPLE, 'not known'),
            rapid,
          ],
        },
      };
    }
  }
}

function step(value: number, bounds: number[]): Rgb {
  if (Number.isNaN(value)) return PURPLE;
  const at = bounds.findIndex((bound) => value <= bound * (1 + 1e-6));
  return STEPS[at < 0 ? STEPS.length - 1 : at]!;
}

/** A number with three digits that count. */
export const short = (value: number): string => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : '?');
