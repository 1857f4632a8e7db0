//! Differences, for people and for programs.
use crate::cli::{
    json::tidy,
    load::{Loaded, assuming},
    verdict::counted,
};
use std::fmt::Write;
use trunnion_diff::{Body, Change, Found, PathKind, Point, TechChange, Tolerance};
use trunnion_interp::AXIS_LETTERS;
use trunnion_same::Verdict;
use trunnion_syntax::{BlockId, LineIndex};

/// The lines of both programs.
pub(super) struct Lines<'a> {
    sides: [(&'a Loaded, LineIndex); 2],
}

impl<'a> Lines<'a> {
    pub(super) fn new(before: &'a Loaded, after: &'a Loaded) -> Self {
        let lines = |loaded: &'a Loaded| (loaded, LineIndex::new(loaded.program.source()));
        Self {
            sides: [lines(before), lines(after)],
        }
    }
    pub(super) fn line(&self, side: usize, block: BlockId) -> u32 {
        let (loaded, lines) = &self.sides[side];
        lines
            .line_column(loaded.program.source(), loaded.program.block(block).range().start)
            .0
    }
    pub(super) fn number(&self, side: usize, block: BlockId) -> Option<String> {
        let program = &self.sides[side].0.program;
        program
            .block(block)
            .number()
            .map(|range| program.text(range).into_owned())
    }
    fn name(&self, side: usize) -> &str {
        &self.sides[side].0.name
    }
    /// `12`, `12 N120`.
    fn place(&self, side: usize, block: BlockId) -> String {
        let line = self.line(side, block);
        self.number(side, block)
            .map_or_else(|| line.to_string(), |number| format!("{line} {number}"))
    }
}

/// The form for people.
pub(super) fn text(before: &Loaded, after: &Loaded, found: &Found, tolerance: Tolerance, limit: usize) -> String {
    let lines = Lines::new(before, after);
    let mut out = String::new();
    let machine = before.resolved.machine.as_ref();
    out.push_str(&summary(&lines, found, tolerance));
    let on = machine.map_or_else(String::new, |machine| {
        format!("  on {}; coordinates are the positions of its axes", machine.id)
    });
    let _ = writeln!(out, "{} -> {}{on}", lines.name(0), lines.name(1));
    if let Some(line) = assuming(&[before, after]) {
        let _ = writeln!(out, "  {line}");
    }
    let mut rows: Vec<(u32, [String; 2], String)> = Vec::new();
    for change in &found.changes {
        rows.push(change_row(&lines, change));
    }
    for change in &found.techs {
        rows.push(tech_row(&lines, change));
    }
    rows.sort_by_key(|row| row.0);
    let width = |side: usize| {
        rows.iter()
            .take(limit)
            .map(|row| row.1[side].len())
            .max()
            .unwrap_or(0)
            .max(4)
    };
    let widths = [width(0), width(1)];
    if !rows.is_empty() {
        let _ = writeln!(out, "  {:<1$}  line", "line", widths[0]);
    }
    for (_, places, what) in rows.iter().take(limit) {
        let _ = writeln!(
            out,
            "  {:<2$}  {:<3$}  {what}",
            places[0], places[1], widths[0], widths[1]
        );
    }
    if rows.len() > limit {
        let _ = writeln!(out, "  and {} more; see them all with --limit 0", rows.len() - limit);
    }
    out
}

fn change_row(lines: &Lines<'_>, change: &Change) -> (u32, [String; 2], String) {
    match change {
        Change::Moved(a, b) => {
            let places = [lines.place(0, a.0), lines.place(1, b.0)];
            (lines.line(1, b.0), places, moved(&a.1, &b.1))
        }
        Change::Only(after, block, body) => {
            let side = usize::from(*after);
            let mut places = ["-".to_owned(), "-".to_owned()];
            places[side] = lines.place(side, *block);
            let what = match &**body {
                Body::Motion(point, _) => {
                    let length = point
                        .length_mm
                        .map_or_else(String::new, |length| format!(", {length:.3} mm long"));
                    format!("{} {}{length}", point.way.name(), position(point))
                }
                Body::Statement(text) => text.clone(),
            };
            let verb = if *after { "added  " } else { "removed" };
            (lines.line(side, *block), places, format!("{verb} {what}"))
        }
    }
}

/// `X10 Y2.5 Z-1`.
fn position(point: &Point) -> String {
    let known = (0..AXIS_LETTERS.len()).filter(|axis| point.known & (1 << axis) != 0);
    let parts: Vec<String> = known
        .map(|axis| format!("{}{}", letter(axis), short(point.values[axis])))
        .collect();
    if parts.is_empty() {
        "to an unknown position".to_owned()
    } else {
        format!("to {}", parts.join(" "))
    }
}

pub(super) fn letter(axis: usize) -> char {
    char::from(AXIS_LETTERS[axis])
}

/// Up to six digits after the decimal point, without trailing zeros.
fn short(value: f64) -> String {
    let text = format!("{:.6}", tidy(value));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// `linear  X 10 -> 10.5, 0.5 mm away`.
pub(super) fn moved(a: &Point, b: &Point) -> String {
    let mut text = if a.way.name() == b.way.name() {
        a.way.name().to_owned()
    } else {
        format!("{} -> {}", a.way.name(), b.way.name())
    };
    for (rotary, unit) in [(false, "mm"), (true, "deg")] {
        let axes = a
            .moved(b)
            .into_iter()
            .filter(|(axis, ..)| (3..6).contains(axis) == rotary);
        let parts: Vec<String> = axes
            .map(|(axis, from, to)| format!("{} {} -> {}", letter(axis), short(from), short(to)))
            .collect();
        if !parts.is_empty() {
            let _ = write!(text, " {} {unit}", parts.join(" "));
        }
    }
    for (known, other, verb) in [(a.known, b.known, "no longer known"), (b.known, a.known, "now known")] {
        let letters: String = (0..AXIS_LETTERS.len())
            .filter(|axis| known & !other & (1 << axis) != 0)
            .map(letter)
            .collect();
        if !letters.is_empty() {
            let _ = write!(text, " {letters} {verb}");
        }
    }
    match (a.way, b.way) {
        (PathKind::Arc(Some(from)), PathKind::Arc(Some(to))) if from != to => {
            let _ = write!(
                text,
                " centre {} -> {} mm, sweep {} -> {} deg",
                vector(from.0),
                vector(to.0),
                short(from.2),
                short(to.2)
            );
        }
        (PathKind::Dwell(from), PathKind::Dwell(to)) => {
            let seconds = |time: Option<f64>| time.map_or("unknown".to_owned(), |time| format!("{} s", short(time)));
            let _ = write!(text, " {} -> {}", seconds(from), seconds(to));
        }
        _ => {}
    }
    if let Some(distance) = a.distance_mm(b).filter(|distance| *distance > 0.0) {
        let _ = write!(text, ", tip {} mm away", short(distance));
    }
    if let Some(angle) = a.angle_deg(b).filter(|angle| *angle > 1e-9) {
        let _ = write!(text, ", tool axis {} deg off", short(angle));
    }
    text
}

fn vector(parts: [f64; 3]) -> String {
    parts.map(short).join(" ")
}

fn tech_row(lines: &Lines<'_>, change: &TechChange) -> (u32, [String; 2], String) {
    let place = |side: usize, first, last| {
        let (from, to) = (lines.line(side, first), lines.line(side, last));
        if from == to {
            lines.place(side, first)
        } else {
            format!("{from}-{to}")
        }
    };
    let places = [
        place(0, change.first.0, change.last.0),
        place(1, change.first.1, change.last.1),
    ];
    let parts: Vec<String> = change
        .parts
        .iter()
        .map(|(name, from, to)| format!("{name} {from} -> {to}"))
        .collect();
    let count = if change.count == 1 {
        String::new()
    } else {
        format!(" ({} motions)", change.count)
    };
    (
        lines.line(1, change.first.1),
        places,
        format!("{}{count}", parts.join(", ")),
    )
}

/// How many motions are the same and how many are not, for `certify`.
pub(super) fn shared(found: &Found) -> String {
    if found.too_different {
        return "the programs have too little in common to say which motion is which".to_owned();
    }
    let [moved, removed, added, state] = counts(found);
    let only = |after: bool| {
        let is_motion = |change: &&Change| matches!(change, Change::Only(side, _, body) if *side == after && matches!(**body, Body::Motion(..)));
        found.changes.iter().filter(is_motion).count() as u64
    };
    let paired = found.motions[0].saturating_sub(moved + only(false) + found.not_compared);
    format!(
        "{paired} of {} follow the same path, {moved} differ in their path, {state} in their settings; motions and statements only in the original \
         program: {removed}, only in the changed one: {added}; `trunnion diff` lists them",
        counted(found.motions[0], "motion")
    )
}

/// The largest distance between paired ends, mm, with the line of the second program.
pub(super) fn farthest(lines: &Lines<'_>, found: &Found) -> Option<(f64, u32)> {
    let mut worst: Option<(f64, u32)> = None;
    for change in &found.changes {
        if let Change::Moved(a, b) = change
            && let Some(distance) = a.1.distance_mm(&b.1)
            && worst.is_none_or(|(known, _)| distance > known)
        {
            worst = Some((distance, lines.line(1, b.0)));
        }
    }
    worst
}

/// How many of each kind: moved, only before, only after, motions with other feed and the like.
pub(super) fn counts(found: &Found) -> [u64; 4] {
    let mut counts = [0; 4];
    for change in &found.changes {
        match change {
            Change::Moved(..) => counts[0] += 1,
            Change::Only(false, ..) => counts[1] += 1,
            Change::Only(true, ..) => counts[2] += 1,
        }
    }
    counts[3] = found.techs.iter().map(|change| change.count).sum::<u64>() + found.techs_not_listed;
    counts
}

fn summary(lines: &Lines<'_>, found: &Found, tolerance: Tolerance) -> String {
    let within = format!("within {} mm and {} deg", tolerance.mm, tolerance.deg);
    let unknown = if found.unknown == 0 {
        String::new()
    } else {
        format!(
            "; compared only by their words, because their ends are unknown: {}",
            counted(found.unknown, "motion")
        )
    };
    let stops = stops(lines, found);
    if found.same() {
        return format!("SAME {} {within}{unknown}\n", counted(found.motions[0], "motion"));
    }
    let first = first(lines, found);
    let word = if matches!(found.verdict, Verdict::Unknown(_)) {
        "UNKNOWN"
    } else {
        "DIFFERENT"
    };
    let [moved, removed, added, techs] = counts(found);
    let mut parts = Vec::new();
    if moved > 0 {
        let far = farthest(lines, found).filter(|(distance, _)| *distance > 0.0);
        let most = far.map_or_else(String::new, |(distance, line)| {
            format!(" (at most {} mm, line {line})", short(distance))
        });
        parts.push(format!("{moved} moved{most}"));
    }
    for (count, what) in [(removed, "removed"), (added, "added")] {
        if count > 0 {
            parts.push(format!("{count} {what}"));
        }
    }
    if techs > 0 {
        parts.push(format!(
            "{} with other feed, spindle, tool, offset or coolant",
            counted(techs, "motion")
        ));
    }
    if found.not_compared > 0 {
        parts.push(format!("{} more not compared in detail", found.not_compared));
    }
    let numbers = format!("{} -> {}", found.motions[0], counted(found.motions[1], "motion"));
    let listed = if parts.is_empty() {
        String::new()
    } else {
        format!("; {}", parts.join(", "))
    };
    let mut text = format!("{word} {first}\n{numbers}{listed}; other motions are the same {within}{unknown}\n");
    if found.too_different {
        text = format!(
            "{word} {first}\n{numbers}: too little in common to say which motion is which; they differ from the first line above on\n"
        );
    } else if found.one_by_one {
        text.push_str(
            "(too many differences to look for the best match: the motions were compared one by one, in order)\n",
        );
    }
    text + &stops
}

/// The first difference, or what is unknown, with the lines.
pub(super) fn first(lines: &Lines<'_>, found: &Found) -> String {
    let (Verdict::Differs(difference) | Verdict::Unknown(difference)) = &found.verdict else {
        return String::new();
    };
    let place = |side: usize, block: Option<BlockId>| {
        block.map(|block| format!("{}:{}", lines.name(side), lines.line(side, block)))
    };
    let places: Vec<String> = [place(0, difference.before), place(1, difference.after)]
        .into_iter()
        .flatten()
        .collect();
    if places.is_empty() {
        difference.what.clone()
    } else {
        format!("{}: {}", places.join(" and "), difference.what)
    }
}

/// Where the runs stopped before the end, one line each.
fn stops(lines: &Lines<'_>, found: &Found) -> String {
    let mut out = String::new();
    for (side, stop) in found.stops.iter().enumerate() {
        if let Some(stop) = stop {
            let (name, line) = (lines.name(side), lines.line(side, stop.block));
            let _ = writeln!(out, "{name}:{line}: not followed from here: {}", stop.why);
        }
    }
    out
}
