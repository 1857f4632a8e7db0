//! A path that is turned about the axis of the tool: two coordinates of a block depend on each other, so that a block gets both words.
use super::edits::{decimals_of, rounded, written};
use super::kinds::{Kind, Said};
use super::shape::{LETTERS, Work, along};
use crate::refuse::Refused;
use trunnion_syntax::{TextRange, Word};

/// What a turn keeps from block to block.
#[derive(Default)]
pub(super) struct Turn {
    /// The last position as it is written, in both axes of the plane.
    last: Option<[f64; 2]>,
}

/// Sine and cosine of an angle in degrees, exact at multiples of a quarter turn.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => trunnion_geometry::math::sin_cos(trunnion_geometry::rad(other)),
    }
}

impl Turn {
    pub(super) fn block(
        &mut self,
        work: &mut Work<'_>,
        said: &Said<'_, '_>,
        words: &[(Word, Kind)],
        (axis, degrees): (usize, f64),
    ) -> Result<(), Refused> {
        let here = said.here;
        let plane = here.is.coordinates.plane();
        if along(plane) != axis {
            return said.refuse(
                words[0].0.range,
                format!(
                    "the tool is along {} here: a path is only turned about the axis of the tool",
                    LETTERS[along(plane)]
                ),
            );
        }
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut named = [None, None];
        let mut centre = [None, None];
        let mut steps = 0;
        let mut places = 0;
        for (word, kind) in words {
            match *kind {
                Kind::Axis(a) if a == u || a == v => {
                    named[usize::from(a == v)] = Some(*word);
                    if said.is_step(word, *kind) {
                        steps += 1;
                    } else {
                        places += 1;
                    }
                }
                Kind::Centre(a) if a == u || a == v => centre[usize::from(a == v)] = Some(*word),
                Kind::Axis(a) | Kind::Centre(a) if a == axis => {}
                Kind::Feed | Kind::Plain | Kind::Tolerance | Kind::Radius | Kind::Level | Kind::Length => {}
                _ => {
                    let text = work.program.text(word.range);
                    return said.refuse(
                        word.range,
                        format!("{text}: how it turns with the part is not known here"),
                    );
                }
            }
        }
        let (sin, cos) = sin_cos(degrees);
        let turned = |x: f64, y: f64| [x * cos - y * sin, x * sin + y * cos];
        turn_centre(work, said, centre, (turned, [u, v]))?;
        if named.iter().all(Option::is_none) {
            return Ok(());
        }
        if steps > 0 && places > 0 {
            return said.refuse(words[0].0.range, "steps and positions in one block are not turned");
        }
        if steps > 0 && said.drills() {
            return said.refuse(words[0].0.range, "a drilling cycle with steps is not turned");
        }
        let unit = here.is.coordinates.unit_mm();
        let place = |state: &trunnion_interp::ModalState| {
            let x = state.position.get(u)? / unit;
            Some((x, state.position.get(v)? / unit))
        };
        let Some((x, y)) = place(here.is) else {
            let names = format!("{} and {}", LETTERS[u], LETTERS[v]);
            return said.refuse(
                words[0].0.range,
                format!("where {names} are is unknown here: a turn needs both; program them in one block first"),
            );
        };
        let new = turned(x, y).map(|value| rounded(value, work.decimals));
        let values = if steps > 0 {
            let Some(last) = self.last else {
                return said.refuse(words[0].0.range, "where this step begins is unknown");
            };
            [new[0] - last[0], new[1] - last[1]]
        } else {
            for word in named.iter().flatten() {
                // a computed word would stay as it is
                work.number(said, word)?;
            }
            new
        };
        self.last = Some(new);
        write_both(work, said, named, values, [LETTERS[u], LETTERS[v]])
    }
}

/// Turns the centre of an arc, if the block has one.
fn turn_centre(
    work: &mut Work<'_>,
    said: &Said<'_, '_>,
    centre: [Option<Word>; 2],
    (turned, axes): (impl Fn(f64, f64) -> [f64; 2], [usize; 2]),
) -> Result<(), Refused> {
    let Some(first) = centre.iter().flatten().next() else {
        return Ok(());
    };
    if !centre.iter().flatten().all(|word| said.is_step(word, Kind::Centre(0))) {
        return said.refuse(
            first.range,
            "absolute arc centres are not turned: write them from the start of the arc",
        );
    }
    let value = |word: Option<Word>| word.map_or(Ok(0.0), |word| work.number(said, &word).map(|number| number.0));
    let values = turned(value(centre[0])?, value(centre[1])?);
    write_both(work, said, centre, values, axes.map(|axis| ['I', 'J', 'K'][axis]))
}

/// Writes two words of a block; one that is missing is put beside the other.
fn write_both(
    work: &mut Work<'_>,
    said: &Said<'_, '_>,
    words: [Option<Word>; 2],
    values: [f64; 2],
    letters: [char; 2],
) -> Result<(), Refused> {
    let program = work.program;
    let decimals = work.decimals;
    for place in 0..2 {
        if let Some(word) = words[place] {
            let (_, range, point) = work.number(said, &word)?;
            let old = program.text(range).into_owned();
            let text = written(&old, values[place], decimals, decimals_of(&old), point);
            work.edits.set(program, range, &text)?;
            continue;
        }
        let Some(beside) = words[1 - place] else { continue };
        let (_, range, point) = work.number(said, &beside)?;
        let old = program.text(range).into_owned();
        let number = written(
            old.trim_start_matches(['+', '-']),
            values[place],
            decimals,
            decimals_of(&old),
            point,
        );
        let source = program.source();
        let start = beside.range.start as usize;
        let spaced = start > 0 && matches!(source[start - 1], b' ' | b'\t' | b'\n' | b'\r');
        let blank = if spaced { " " } else { "" };
        let equals = if program.bytes(beside.range).contains(&b'=') {
            "="
        } else {
            ""
        };
        let lower = source[start].is_ascii_lowercase();
        let letter = if lower {
            letters[place].to_ascii_lowercase()
        } else {
            letters[place]
        };
        let (at, text) = if place == 1 {
            (beside.range.end, format!("{blank}{letter}{equals}{number}"))
        } else {
            (beside.range.start, format!("{letter}{equals}{number}{blank}"))
        };
        work.edits.set(program, TextRange::new(at, at), &text)?;
    }
    Ok(())
}
