// Lengths as people read them: numbers of a path are in mm, those of an inch program are shown in inch.
const MM_PER_INCH = 25.4;

/** A unit of length. */
export interface Unit {
  name: string;
  /** A length or feed in mm, in this unit. */
  of(mm: number): number;
  /** A place as text: as fine as a thousandth of a mm, or finer. */
  place(mm: number): string;
}

const MM: Unit = { name: 'mm', of: (mm) => mm, place: (mm) => mm.toFixed(3) };
const INCH: Unit = { name: 'in', of: (mm) => mm / MM_PER_INCH, place: (mm) => (mm / MM_PER_INCH).toFixed(5) };

/** That of a program. */
export const unitOf = (program: { inch: boolean }): Unit => (program.inch ? INCH : MM);
