//! Leads rapid motions past the declared obstacles on the shortest or quickest path.
//!
//! # Why
//! A rapid through a clamp breaks the tool; a long detour around one costs time in every part. Where obstacles are declared, the shortest path past them
//! is known exactly.
//!
//! # How
//! Each obstacle is a prism or cylinder (`[[obstacle]]`). In a plane it becomes a control barrier: its sides moved outward by the radius of the tool, or
//! of its holder, plus the clearance, with mitred corners. Barriers that touch are one. The shortest path round them turns only at their
//! corners; it is found exactly (visibility graph, A*). The tool may also pass above: at each height at which an obstacle ends, the path
//! past the higher ones is compared. The measure is the length of the path, or with `--cost time` the time of the slowest axis.
//! The level of a run is the highest height at which its rapids go across the tool. What leads up to that level at the beginning of a run, and what comes
//! down from it at its end, stays as it is; where it is too near to an obstacle, the tool rises and comes down along its axis instead. In between the
//! new path goes at the level or above it. A declared part (`part = true`) is an obstacle for it, too.
//! Points are written in the digits of the program, rounded away from the obstacles.
//!
//! # Example
//! Beside the machine a wall is declared: `[[obstacle]] name = "wall"`, `box = [[40, -100, -20], [60, 100, 35]]`.
//! ```gcode before iso-6983 mill-3axis+wall
//! (trunnion: tool 1 flat diameter 8)
//! T1 M6
//! N10 G0 X0 Y0 Z10
//! N20 G1 X10 F500
//! N30 G0 X90
//! N40 G1 X95
//! M30
//! ```
//! ```gcode after
//! (trunnion: tool 1 flat diameter 8)
//! T1 M6
//! N10 G0 X0 Y0 Z10
//! N20 G1 X10 F500
//! G0 Z36
//! G0 X90
//! N30 G0 X90 Z10
//! N40 G1 X95
//! M30
//! ```
//!
//! # Claim
//! Everything but rapid motions is the same, each run of them begins and ends where it did, and every changed motion keeps the tool away
//! from every declared obstacle by the clearance. A motion that the old run does not have is nowhere below its level, or runs straight along the tool above the start or
//! the end of what differs; only the latter may touch the part. `certify` measures that again, without a search. Where the machine file does not say that the axes
//! arrive together in a rapid (`[control] rapid = "synchronous"`), everything between the ends of a motion is kept clear.
//!
//! # Traps
//! - Only declared obstacles are known. A detour around something that is not declared looks needless; declare it, the part among it. A new path
//!   goes across the tool nowhere lower than the highest level at which the rapids since the last cut did. Where they all stay at one level, that level is taken
//!   to be free but for the obstacles.
//! - The diameter of the tool must be declared, and the work offset and tool length that the program uses.
//! - Blocks with other words than G0, X, Y and Z stay as they are; so do motions in which a rotary axis turns, G91, G53 and tilted planes.
//! - New blocks have no block number.
//! - Blocks with `/` stay as they are. Where only one position of the block delete switch needs another path, the message says so.
//! - The column above the tool up to the spindle counts too: the tool may not pass below an overhanging obstacle.
//!
//! # Sources
//! Minimum-route paper (control barrier); docs/kinematics.md#obstacles; Hart, Nilsson, Raphael, A formal basis for the
//! heuristic determination of minimum cost paths (1968).
use super::Body;
use crate::rapid_route::{Grid, Measure, Planner, Stay, Way};
use crate::rapid_runs::{Rapid, Run, rapid_runs};
use crate::style::NumberStyle;
use crate::{Change, Known, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_certify::postures::PostureCost;
use trunnion_check::Settings;
use trunnion_geometry::Vec3;
use trunnion_interp::deleted_levels;
use trunnion_machine::Machine;
use trunnion_syntax::{Address, Item, Program, TextEdit, TextRange, Value, Word};

pub(super) const REWRITE: Body = Body {
    cures: &["rapid-through-obstacle", "excess-rapid-travel"],
    writes: Some("blocks of G0"),
    propose,
};

/// Digits after the point that are written at least: a thousandth of a millimetre, or a ten-thousandth of an inch.
const LEAST_DIGITS: [usize; 2] = [3, 4];

/// Ends of a run are equal within this, mm: numbers are computed, not measured.
const SAME_MM: f64 = 1e-6;

/// Why rapids stay that would be changed in one state of the switch for block delete.
const SKIPPED: &str = "where the blocks with / are skipped, the rapid motions come too near to an obstacle or make a detour, and where they run, they do not: \
                       declare the state of the switch ([control] block_delete = true or false in trunnion.toml, or --block-delete)";

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let search = Search::new(settings, options)?;
    let mut places = Vec::new();
    let (mut runs, mut length) = (0, [0.0; 2]);
    for found in rapid_runs(program, settings, search.machine)? {
        let run = &found.rapids;
        let style = Style::of(program, run[0].unit_mm);
        let change = match search.plan(&found, &style) {
            Ok(None) => continue,
            Ok(Some(way)) => {
                runs += 1;
                length = [length[0] + way.length[0], length[1] + way.length[1]];
                Change::Edits(write(program, run, &way, &style))
            }
            Err(Stay::Missing(why)) => Change::Possible(why),
            Err(Stay::Refused(why)) => Change::Refused(why),
        };
        places.push(Place {
            first: run[0].block,
            last: run[run.len() - 1].block,
            change,
        });
    }
    search.where_skipped(program, settings, &mut places)?;
    if places.is_empty() {
        return Ok(None);
    }
    if runs == 0 {
        return Err(Refusal::Places(places));
    }
    Ok(Some(Proposal {
        places,
        claim: Claim::ClearRapids {
            tolerance_mm: SAME_MM,
            tolerance_deg: SAME_MM,
            clearance_mm: search.keep,
            assumed_zeros: settings.assume.work_offset && settings.assume.tool_length,
        },
        summary: format!(
            "{runs} {} of rapid motions: {:.6} -> {:.6} mm",
            if runs == 1 { "run" } else { "runs" },
            length[0],
            length[1]
        ),
    }))
}

/// What ways are looked for.
struct Search<'a> {
    machine: &'a Machine,
    keep: f64,
    measure: Measure,
}

impl<'a> Search<'a> {
    fn new(settings: &Settings<'a>, options: &Options) -> Result<Self, Refusal> {
        let Some(machine) = settings.machine else {
            return Err(Refusal::missing(
                "no machine is named, and obstacles belong to a machine (--machine)",
            ));
        };
        if machine.obstacles.only_parts() {
            return Err(Refusal::missing(
                "no obstacle is declared, so it is unknown what a shorter path would pass: [[obstacle]] in trunnion.toml",
            ));
        }
        let measure = match options.cost {
            PostureCost::Time => Measure::Time,
            PostureCost::Travel | PostureCost::Deviation => Measure::Length,
        };
        let slow = |joint: &&usize| machine.axes[**joint].max_speed.is_none_or(|speed| speed <= 0.0);
        if let (Measure::Time, Some(&joint)) = (measure, machine.linear.iter().find(slow)) {
            let letter = char::from(machine.axes[joint].letter);
            return Err(Refusal::missing(format!(
                "the machine file does not declare the highest speed of {letter}, and --cost time depends on it"
            )));
        }
        Ok(Self {
            machine,
            keep: machine.tolerances.clearance_mm(),
            measure,
        })
    }

    fn plan(&self, run: &Run, style: &Style) -> Result<Option<Way>, Stay> {
        let planner = Planner {
            machine: self.machine,
            run: &run.rapids,
            level: run.level,
            keep: self.keep,
            measure: self.measure,
        };
        planner.plan(Grid {
            step_mm: 2.0 * style.numbers.rounding() * run.rapids[0].unit_mm,
        })
    }

    /// Adds the runs that would be changed only where blocks with `/` are skipped, if it is not declared whether they run.
    fn where_skipped(
        &self,
        program: &Program,
        settings: &Settings<'_>,
        places: &mut Vec<Place>,
    ) -> Result<(), Refusal> {
        if settings.setup.control.block_delete.is_some() || deleted_levels(program, settings.dialect).1 == 0 {
            return Ok(());
        }
        let mut skipping = settings.clone();
        skipping.setup.control.block_delete = Some(true);
        for found in rapid_runs(program, &skipping, self.machine)? {
            let run = &found.rapids;
            let (first, last) = (run[0].block, run[run.len() - 1].block);
            let known = places.iter().any(|place| place.first <= last && first <= place.last);
            let style = Style::of(program, run[0].unit_mm);
            if !known && !matches!(self.plan(&found, &style), Ok(None)) {
                let change = Change::Refused(SKIPPED.into());
                places.push(Place { first, last, change });
            }
        }
        places.sort_by_key(|place| place.first);
        Ok(())
    }
}

/// How the program writes coordinates.
struct Style {
    numbers: NumberStyle,
    unit_mm: f64,
}

impl Style {
    fn of(program: &Program, unit_mm: f64) -> Self {
        let words = program.blocks().flat_map(|block| block.words().collect::<Vec<_>>());
        let linear = words.filter(|word| matches!(word.address, Address::Letter(b'X'..=b'Z')));
        let texts: Vec<String> = linear
            .filter(|word| matches!(word.value, Value::Number(_)))
            .map(|word| program.text(word.value_range).into_owned())
            .collect();
        let learnt = NumberStyle::learn(texts.iter().map(String::as_str));
        let mut numbers = learnt.unwrap_or(NumberStyle {
            decimals: 0,
            trims: true,
            whole_point: false,
            leading_zero: true,
        });
        let least = LEAST_DIGITS[usize::from(unit_mm > 1.0)];
        if numbers.decimals < least {
            (numbers.decimals, numbers.trims) = (least, true);
        }
        Self { numbers, unit_mm }
    }

    fn number(&self, mm: f64) -> String {
        self.numbers.write(mm / self.unit_mm, false)
    }
}

/// The edits of one way: its points as new blocks before the last block that it replaces, the other replaced blocks empty.
fn write(program: &Program, run: &[Rapid], way: &Way, style: &Style) -> Vec<TextEdit> {
    let mut edits = Vec::new();
    let (first, last) = (*way.replaced.start(), *way.replaced.end());
    for rapid in &run[first..last] {
        edits.push(emptied(program, rapid));
    }
    let block = program.block(run[last].block);
    let words: Vec<Word> = block.words().collect();
    let code_of = |rapid: &Rapid| {
        let code = program
            .block(rapid.block)
            .words()
            .find(|word| word.address == Address::Letter(b'G'));
        code.map(|word| program.text(word.range).into_owned())
    };
    let own = code_of(&run[last]);
    // G0 of a block that goes is written in the first one that stays
    let mut code = own.clone().or_else(|| run[first..last].iter().find_map(code_of));
    let range = block.range();
    let blank = if program.bytes(range).contains(&b' ') { " " } else { "" };
    let mut at = run[first].leg.motion.start.xyz().unwrap_or_default();
    let newline = line_end(program, range);
    let mut lines = String::new();
    let count = way.points.len();
    for point in &way.points[..count - 1] {
        let words = moved(&at, point, style);
        lines.push_str(&code.iter().cloned().chain(words).collect::<Vec<_>>().join(blank));
        code.clone_from(&own);
        lines.push_str(newline);
        at = *point;
    }
    edits.push(TextEdit {
        range: TextRange::new(range.start, range.start),
        new_text: lines,
    });
    let coordinate = words.iter().find(|word| word.address != Address::Letter(b'N'));
    if let (1, None, Some(code), Some(word)) = (count, &own, &code, coordinate) {
        edits.push(TextEdit {
            range: TextRange::new(word.range.start, word.range.start),
            new_text: format!("{code}{blank}"),
        });
    }
    // coordinates that the last block did not need to name
    let named = |letter: u8| words.iter().any(|word| word.address == Address::Letter(letter));
    let missing: Vec<String> = (0..3)
        .filter(|&axis| (way.points[count - 1][axis] - at[axis]).abs() > SAME_MM * 1e-3 && !named(b"XYZ"[axis]))
        .map(|axis| word(axis, way.points[count - 1][axis], style))
        .collect();
    if let (false, Some(after)) = (missing.is_empty(), words.last()) {
        edits.push(TextEdit {
            range: TextRange::new(after.range.end, after.range.end),
            new_text: format!("{blank}{}", missing.join(blank)),
        });
    }
    edits
}

/// A coordinate word.
fn word(axis: usize, mm: f64, style: &Style) -> String {
    format!("{}{}", char::from(b"XYZ"[axis]), style.number(mm))
}

/// The words of a motion between two points.
fn moved(from: &Vec3, to: &Vec3, style: &Style) -> Vec<String> {
    (0..3)
        .filter(|&axis| style.number(from[axis]) != style.number(to[axis]))
        .map(|axis| word(axis, to[axis], style))
        .collect()
}

/// A block without its words: its comments stay; without any, the line goes.
fn emptied(program: &Program, rapid: &Rapid) -> TextEdit {
    let block = program.block(rapid.block);
    let range = block.range();
    let has_comment = block.items().any(|item| matches!(item, Item::Comment(_)));
    if !has_comment {
        let end = range.end + line_end(program, range).len() as u32;
        return TextEdit {
            range: TextRange::new(range.start, end),
            new_text: String::new(),
        };
    }
    let mut text = String::new();
    let mut at = range.start;
    for word in block.words() {
        text.push_str(&program.text(TextRange::new(at, word.range.start)));
        at = word.range.end;
    }
    text.push_str(&program.text(TextRange::new(at, range.end)));
    TextEdit {
        range,
        new_text: text.trim().to_owned(),
    }
}

/// The bytes that end the line of a block; a line feed where it is the last one and has none.
fn line_end(program: &Program, range: TextRange) -> &'static str {
    let rest = program.source().get(range.end as usize..).unwrap_or_default();
    if rest.starts_with(b"\r\n") {
        "\r\n"
    } else if rest.starts_with(b"\r") {
        "\r"
    } else {
        "\n"
    }
}
