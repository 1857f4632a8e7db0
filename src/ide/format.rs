//! Layout of a document or of some of its lines, as edits. The new text is proved to do the same, or there are no edits.
use trunnion_check::config::{FormatCase, FormatSettings, FormatSpacing, FormatZeros};
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_layout::{Case, Layout, Refusal, Spacing, Style, Zeros, first_difference, layout};
use trunnion_syntax::{Program, TextEdit, TextRange, apply_edits, parse};

/// The style that `[format]` of the settings asks for.
pub fn style(settings: &FormatSettings) -> Style {
    let default = Style::default();
    Style {
        case: settings.case.map_or(default.case, |case| match case {
            FormatCase::Upper => Case::Upper,
            FormatCase::Lower => Case::Lower,
            FormatCase::Keep => Case::Keep,
        }),
        spacing: settings.spacing.map_or(default.spacing, |spacing| match spacing {
            FormatSpacing::One => Spacing::One,
            FormatSpacing::Packed => Spacing::Packed,
        }),
        zeros: settings.leading_zeros.map_or(default.zeros, |zeros| match zeros {
            FormatZeros::Keep => Zeros::Keep,
            FormatZeros::Drop => Zeros::Drop,
            FormatZeros::Two => Zeros::Two,
        }),
        comment_column: settings.comment_column.or(default.comment_column),
        indent: settings.indent.unwrap_or(default.indent),
        blank_lines: settings.blank_lines.unwrap_or(default.blank_lines),
    }
}

/// Larger programs are not laid out in an editor: the old and the new text are run and compared step by step, which takes ten seconds and a gigabyte
/// for a million lines. As much as `trunnion fmt` reads by default.
const MOST_BYTES: usize = 16_000_000;
const MOST_LINES: usize = 300_000;

/// So many edits are sent one by one: each costs more on its way to the editor than the line that it changes.
const EDITS: usize = 20_000;

/// The edits that lay out a program, or only the lines that touch `lines`. Of lines alone, blank ones are not removed.
///
/// # Errors
/// The reason why the layout could not be proved, or that the program is too large.
pub fn format(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    style: &Style,
    lines: Option<TextRange>,
) -> Result<Vec<TextEdit>, String> {
    let (bytes, count) = (program.source().len(), program.block_count());
    if bytes > MOST_BYTES || count > MOST_LINES {
        return Err(format!(
            "the document has {count} lines and {bytes} bytes, and at most {MOST_LINES} lines and {MOST_BYTES} bytes are laid out here; \
             `trunnion fmt --max-lines {} --max-file-mb {}` lays it out",
            count + 1,
            bytes / 1_000_000 + 1
        ));
    }
    let mut style = *style;
    if lines.is_some() {
        style.blank_lines = u8::MAX;
    }
    let text = match layout(program, dialect, setup, &style) {
        Layout::Unchanged => return Ok(Vec::new()),
        Layout::Changed(text) => text,
        Layout::Refused(refusal) => return Err(why(&refusal)),
    };
    let edits = edits(program.source(), &text);
    let Some(lines) = lines else {
        let few = edits.len() <= EDITS;
        return Ok(if few {
            edits
        } else {
            vec![edit(0, program.source(), &text)]
        });
    };
    let within: Vec<TextEdit> = edits
        .into_iter()
        .filter(|edit| edit.range.start <= lines.end && lines.start <= edit.range.end)
        .collect();
    if within.is_empty() {
        return Ok(within);
    }
    let text = apply_edits(program.source(), &within).ok_or_else(|| "two edits overlap".to_owned())?;
    let after = parse(text, program.options());
    match first_difference(program, &after, dialect, setup, false) {
        None => Ok(within),
        Some(_) => Err("these lines alone cannot be laid out: the program would not do the same".to_owned()),
    }
}

fn why(refusal: &Refusal) -> String {
    match refusal {
        Refusal::Words(_) => "the new text would not contain the same words".to_owned(),
        Refusal::Motions(_) => "it could not be proved that the new text does the same".to_owned(),
        Refusal::NotStable(_) => "the new text would be laid out differently once more".to_owned(),
    }
}

/// The edits from one text to the other: line by line where both have the same number of lines, else the part that differs.
fn edits(old: &[u8], new: &[u8]) -> Vec<TextEdit> {
    let cut = |text: &[u8]| {
        text.split_inclusive(|byte| *byte == b'\n')
            .map(<[u8]>::to_vec)
            .collect::<Vec<_>>()
    };
    let (before, after) = (cut(old), cut(new));
    if before.len() == after.len() {
        let mut at = 0;
        let mut edits = Vec::new();
        for (was, is) in before.iter().zip(&after) {
            if was != is {
                edits.push(edit(at, was, is));
            }
            at += was.len();
        }
        return edits;
    }
    let head = before.iter().zip(&after).take_while(|(a, b)| a == b).count();
    let most = before.len().min(after.len()) - head;
    let tail = before
        .iter()
        .rev()
        .zip(after.iter().rev())
        .take(most)
        .take_while(|(a, b)| a == b)
        .count();
    let at: usize = before[..head].iter().map(Vec::len).sum();
    vec![edit(
        at,
        &before[head..before.len() - tail].concat(),
        &after[head..after.len() - tail].concat(),
    )]
}

/// One edit, without what both ends share; never inside a character.
fn edit(at: usize, was: &[u8], is: &[u8]) -> TextEdit {
    let ascii = was.is_ascii() && is.is_ascii();
    let head = if ascii {
        was.iter().zip(is).take_while(|(a, b)| a == b).count()
    } else {
        0
    };
    let most = was.len().min(is.len()) - head;
    let tail = if ascii {
        was.iter()
            .rev()
            .zip(is.iter().rev())
            .take(most)
            .take_while(|(a, b)| a == b)
            .count()
    } else {
        0
    };
    TextEdit {
        range: TextRange::new((at + head) as u32, (at + was.len() - tail) as u32),
        new_text: String::from_utf8_lossy(&is[head..is.len() - tail]).into_owned(),
    }
}
