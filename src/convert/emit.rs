//! What both writers share: texts of comments and tools, and which motions belong together.
use crate::number::number;
use crate::plan::Out;
use core::fmt::Write;
use trunnion_certify::conversion::{Part, Reading};
use trunnion_interp::{Tool, ToolShape};
use trunnion_syntax::LineIndex;

/// Which motions of the output belong to which of the original.
pub(crate) fn parts(outs: &[Out]) -> Vec<Part> {
    outs.iter()
        .map(|out| match out {
            Out::Left => Part::Left,
            Out::Words { .. } => Part::Words,
            Out::Dwell(_) => Part::Moves(1),
            Out::Moves(moves) => Part::Moves(moves.len() as u32),
        })
        .collect()
}

/// The same, with the motions that templates of the post make: those whose line is not one of `moved` (ascending).
pub(crate) fn parts_without(outs: &[Out], after: &Reading, moved: &[u32]) -> Vec<Part> {
    let source = after.program.source();
    let index = LineIndex::new(source);
    let line = |block| index.line_column(source, after.program.block(block).range().start).0;
    let own = after
        .motions
        .iter()
        .map(|posed| moved.binary_search(&line(posed.motion.block)).is_err());
    let mut own = own.peekable();
    let mut all = Vec::with_capacity(outs.len());
    let added = |all: &mut Vec<Part>, own: &mut core::iter::Peekable<_>| {
        let mut count = 0;
        while own.next_if(|beside| *beside).is_some() {
            count += 1;
        }
        if count > 0 {
            all.push(Part::Added(count));
        }
    };
    for part in parts(outs) {
        added(&mut all, &mut own);
        let count = match part {
            Part::Moves(count) => count as usize,
            Part::Words => 1,
            Part::Left | Part::Added(_) => 0,
        };
        own.by_ref().take(count).for_each(drop);
        all.push(part);
    }
    added(&mut all, &mut own);
    all
}

/// A tool as a comment declares it (`trunnion: tool 1 ball diameter 10 length 100`), as far as it is known.
pub(crate) fn declaration(count: u32, tool: Option<&Tool>) -> String {
    let mm = |value: f64| number(value, 6, false);
    let mut text = String::new();
    let Some(tool) = tool else { return format!("T{count}") };
    let named = tool.shape.and_then(|shape| match shape {
        ToolShape::Ball => Some(("ball", None)),
        ToolShape::Flat => Some(("flat", None)),
        ToolShape::Bull(radius) => Some(("bull", Some(radius))),
        // comments have no word for a nose
        ToolShape::Turning(_) => None,
    });
    match (named, tool.diameter_mm) {
        (Some((name, radius)), Some(diameter)) => {
            let _ = write!(text, " {name} diameter {}", mm(diameter));
            if let Some(radius) = radius {
                let _ = write!(text, " radius {}", mm(radius));
            }
        }
        (None, Some(diameter)) => {
            let _ = write!(text, " diameter {}", mm(diameter));
        }
        (_, None) => {}
    }
    if let Some(length) = tool.length_mm {
        let _ = write!(text, " length {}", mm(length));
    }
    if text.is_empty() {
        format!("T{count}")
    } else {
        format!("trunnion: tool {count}{text}")
    }
}

/// A text that every control can hold: one line, printable ASCII.
pub(crate) fn plain(text: &str) -> String {
    let letter = |c: char| match c {
        ' '..='~' => c,
        '\t' => ' ',
        _ => '?',
    };
    let text: String = text.chars().map(letter).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
