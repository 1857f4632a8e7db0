//! Turns the tool axis a little where it passes near the pole, so that the rotary table does not have to spin.
//!
//! # Why
//! Near the pole (tool axis parallel to the first rotary axis) a tiny change of the tool axis needs a large turn of the table. The
//! feed drops, and the dwell leaves a mark. Seen from above, the tool axis walks around the pole; this rewrite makes it walk
//! straight, as far as the tolerance allows.
//!
//! # How
//! In each run of straight feed motions around a `pole-flip`, the second rotary axis keeps its values. The first one follows the
//! taut string through the tube `|C' - C| <= 2 asin(sin(tol / 2) / sin theta)`: the least total travel and the least peak speed at
//! once. The ends of the window (the first points outside the pole cone, or the ends of the run) stay. The tip moves by
//! `r (u - u')`, so that the centre of the ball, and with it the contact with the surface, stays where it was.
//!
//! # Example
//! ```gcode before sinumerik-840d mikron-ucp710
//! ; trunnion: tool 1 ball diameter 10
//! T1 M6
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822 F2000
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
//! N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
//! M30
//! ```
//! ```gcode after
//! ; trunnion: tool 1 ball diameter 10
//! T1 M6
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38059 Y-1.84015 Z59.90263 A1.047 C2.212 F2000
//! N2930 G1 X-28.38161 Y-1.53288 Z59.93222 A0.081 C1.066
//! N2940 G1 X-28.38489 Y-1.28033 Z59.95290 A-0.79 C0.107
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
//! M30
//! ```
//!
//! # Claim
//! At every block end the tool axis turns relative to the part by at most the tolerance, and the centre of the ball stays within
//! `--tolerance-mm`. No feed, no spindle word and no other byte changes. The certificate states a measured value and a proven bound
//! of how far apart the paths are between block ends.
//!
//! # Traps
//! - Only a ball keeps its contact when the tool axis turns. The shape of the tool must be declared; a flat or bull-nosed tool
//!   needs the surface normal, which a program does not contain.
//! - A word that was omitted because its value did not change may have to be written.
//! - Near the pole rounded numbers matter: `A0.081` and `k = 0.999999` are not the same tool axis. The rewrite works on the words
//!   of the program, digit by digit, and is verified after rounding.
//! - Shank and holder turn with the tool axis, by at most the tolerance.
//!
//! # Sources
//! Guide-vane paper (2006), deformation on the circle i^2 + j^2 = 1 - k^2; docs/kinematics.md#smoothing-at-the-pole.
use super::Body;
use crate::reposition::Writer;
use crate::slots::{Scheme, Styles, styles};
use crate::stations::{Station, chain, largest_step, stance, straighten, window};
use crate::survey::{Point, Tip, survey};
use crate::{Change, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_check::Settings;
use trunnion_geometry::{deg, rad};
use trunnion_machine::{Machine, NoStance};
use trunnion_syntax::{LineIndex, Program, TextEdit};

pub(super) const REWRITE: Body = Body {
    cures: &[
        "axis-overspeed",
        "excess-rotary-travel",
        "fast-pole",
        "feed-drop",
        "pole-flip",
    ],
    propose,
};

/// What was done in one window.
struct Smoothed {
    edits: Vec<TextEdit>,
    ball_radius: f64,
    /// Indices of the window's first and last point, and the lines of its ends.
    first: usize,
    last: usize,
    lines: (u32, u32),
    /// Largest step of the rotary axis before and after, deg.
    steps: (f64, f64),
}

/// Values computed for one window that the next one reuses.
#[derive(Default)]
struct Memory {
    chain: Vec<Station>,
    styles: Vec<(Scheme, Styles)>,
}

struct Task<'a> {
    program: &'a Program,
    machine: &'a Machine,
    options: &'a Options,
    points: &'a [Point],
    lines: LineIndex,
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and poles depend on the machine (--machine)".into());
    };
    if machine.rotary.len() < 2 {
        return Ok(None);
    }
    let points = survey(program, settings, machine);
    let task = Task {
        program,
        machine,
        options,
        points: &points,
        lines: LineIndex::new(program.source()),
    };
    let flips: Vec<usize> = (0..points.len()).filter(|&index| task.flips(index)).collect();
    if flips.is_empty() {
        return task.unknown_position().map_or(Ok(None), |reason| Err(reason.into()));
    }
    let mut memory = Memory::default();
    let mut done: Option<usize> = None;
    let mut radius = None;
    let mut windows = Vec::new();
    let mut places = Vec::new();
    for flip in flips {
        if done.is_some_and(|last| flip <= last) {
            continue;
        }
        let smoothed = match task.smooth(flip, &mut memory) {
            Ok(smoothed) if *radius.get_or_insert(smoothed.ball_radius) == smoothed.ball_radius => smoothed,
            Ok(_) => {
                let why = "a different ball radius, which needs a separate run";
                places.push(task.place(flip, Change::Refused(why.to_owned())));
                continue;
            }
            Err(change) => {
                places.push(task.place(flip, change));
                continue;
            }
        };
        done = Some(smoothed.last);
        places.push(Place {
            first: points[smoothed.first].block,
            last: points[smoothed.last].block,
            change: Change::Edits(smoothed.edits.clone()),
        });
        windows.push(smoothed);
    }
    let Some(ball_radius_mm) = radius else {
        return Err(Refusal::Places(places));
    };
    let claim = Claim::SameBallCentre {
        ball_radius_mm,
        tolerance_mm: options.tolerance_mm,
        tolerance_deg: options.tolerance_deg,
    };
    let letter = char::from(machine.axes[machine.rotary[0]].letter);
    Ok(Some(Proposal {
        places,
        claim,
        summary: summary(&windows, letter),
    }))
}

/// What was done, in one line.
fn summary(windows: &[Smoothed], letter: char) -> String {
    let worst = windows.iter().fold((0.0f64, 0.0f64), |worst, w| {
        (worst.0.max(w.steps.0), worst.1.max(w.steps.1))
    });
    let (first, last) = windows
        .first()
        .zip(windows.last())
        .map_or((0, 0), |(a, b)| (a.lines.0, b.lines.1));
    let count = if windows.len() > 1 {
        format!(" in {} windows", windows.len())
    } else {
        String::new()
    };
    format!(
        "lines {first} to {last}{count}: largest step of {letter} {:.3} -> {:.3} deg",
        worst.0, worst.1
    )
}

/// Why a motion with a flip cannot be changed.
fn obstacle(point: &Point) -> Option<Change> {
    if !point.tcp {
        return Some(Change::Refused(
            "tool centre point control is off, so turning the table would move the tip".into(),
        ));
    }
    if !point.linear {
        return Some(Change::Refused(
            "the motion is an arc: the rewrite handles straight motions".into(),
        ));
    }
    if !point.from_known {
        return Some(Change::Refused("the position before the motion is unknown".into()));
    }
    tool_obstacle(point)
}

/// Why a tool or its coordinates cannot be turned.
fn tool_obstacle(point: &Point) -> Option<Change> {
    match point.tip {
        Tip::Undeclared => Some(Change::Possible(
            "the tool shape is not declared, and only a ball keeps its contact point: declare it by (trunnion: tool 1 ball diameter 10), by [[tool]] in trunnion.toml, or by --tool ball:10"
                .into(),
        )),
        Tip::Other => Some(Change::Refused("the tool is not a ball: its contact with the surface would move".into())),
        Tip::Ball(_) if point.incremental => Some(Change::Refused("coordinates are incremental (G91)".into())),
        Tip::Ball(_) => None,
    }
}

fn refused(why: impl Into<String>) -> Change {
    Change::Refused(why.into())
}

impl Task<'_> {
    /// One motion as a place.
    fn place(&self, index: usize, change: Change) -> Place {
        let block = self.points[index].block;
        Place {
            first: block,
            last: block,
            change,
        }
    }

    /// The rule pole-flip fires here.
    fn flips(&self, index: usize) -> bool {
        let point = &self.points[index];
        let tolerances = &self.machine.tolerances;
        point.feed && point.pole_angle_min < tolerances.pole_cone && point.rotary_change[0] > tolerances.pole_angle
    }

    fn line(&self, index: usize) -> u32 {
        let start = self.program.block(self.points[index].block).range().start;
        self.lines.line_column(self.program.source(), start).0
    }

    /// The first feed motion whose pose is unknown: a flip there would not be seen.
    fn unknown_position(&self) -> Option<String> {
        let unknown = |point: &Point| {
            let unknown = |why: &NoStance| {
                matches!(
                    why,
                    NoStance::PositionUnknown(_)
                        | NoStance::NotModelled
                        | NoStance::RotaryOffset(_)
                        | NoStance::HeldElsewhere { .. }
                        | NoStance::PlaneMisaligned(_)
                )
            };
            point.feed && point.end.as_ref().is_err_and(unknown)
        };
        let index = self.points.iter().position(unknown)?;
        let why = match &self.points[index].end {
            Err(NoStance::PositionUnknown(letters)) => format!(
                "the position of {} is unknown",
                letters.chars().map(String::from).collect::<Vec<_>>().join(", ")
            ),
            Err(NoStance::RotaryOffset(letter)) => format!("the work offset turns {}", char::from(*letter)),
            Err(NoStance::HeldElsewhere { axis, .. }) => {
                format!(
                    "the machine file holds axis {} at a different position",
                    char::from(*axis)
                )
            }
            _ => "the motion is not modelled".into(),
        };
        Some(format!(
            "line {}: {why}, so it is unknown whether the table flips at the pole",
            self.line(index)
        ))
    }

    /// Smooths the window around one flip.
    fn smooth(&self, flip: usize, memory: &mut Memory) -> Result<Smoothed, Change> {
        let point = &self.points[flip];
        if let Some(obstacle) = obstacle(point) {
            return Err(obstacle);
        }
        let Tip::Ball(ball_radius) = point.tip else {
            return Err(refused("the tool is not a ball"));
        };
        let covers = memory.chain.first().is_some_and(|station| station.first <= flip)
            && memory.chain.last().is_some_and(|station| flip <= station.last);
        if !covers {
            memory.chain = chain(self.machine, self.points, flip);
        }
        let stations = &memory.chain;
        let Some((left, right)) = window(stations, flip, self.machine.tolerances.pole_cone) else {
            return Err(refused("there is no point between the two fixed ends"));
        };
        let stations = &stations[left..=right];
        let writer = self.writer(point, ball_radius, &mut memory.styles);
        // slightly less than allowed, so that the last bit of a double decides nothing
        let room = rad(self.options.tolerance_deg) * (1.0 - 1e-8);
        let q = straighten(self.machine, stations, room)
            .ok_or_else(|| refused("the rotary axis is already outside its limits"))?;
        let before = largest_step(stations.iter().map(|station| station.q));
        let after = largest_step(q.iter().copied());
        if after > 0.99 * before {
            return Err(Change::Possible(format!(
                "within {} deg the largest step can only be reduced from {:.3} deg to {:.3} deg (--tolerance-deg)",
                self.options.tolerance_deg,
                deg(before),
                deg(after)
            )));
        }
        let (edits, written) = self.write(&writer, stations, &q)?;
        let last = stations[stations.len() - 1].first;
        let steps = (deg(before), deg(largest_step(written.iter().copied())));
        let lines = (self.line(stations[0].last), self.line(last));
        Ok(Smoothed {
            edits,
            ball_radius,
            first: stations[0].last + 1,
            last,
            lines,
            steps,
        })
    }

    fn writer(&self, point: &Point, ball_radius: f64, known: &mut Vec<(Scheme, Styles)>) -> Writer<'_> {
        let scheme = if point.vector {
            Scheme::of_vector(self.program, &self.program.block(point.block))
        } else {
            Scheme::Rotary(self.machine.axes[self.machine.rotary[0]].letter)
        };
        let styles = if let Some(&(_, styles)) = known.iter().find(|(of, _)| *of == scheme) {
            styles
        } else {
            let found = styles(self.program, scheme);
            known.push((scheme, found));
            found
        };
        Writer {
            program: self.program,
            machine: self.machine,
            scheme,
            styles,
            unit_mm: point.unit_mm,
            ball_radius,
            rotary_zero: point.rotary_zero,
            tolerance_deg: self.options.tolerance_deg,
            tolerance_mm: self.options.tolerance_mm,
        }
    }

    /// Edits for all points between the ends, and for what the last one takes over from them; and the rotary joint as written, rad,
    /// each station.
    fn write(&self, writer: &Writer<'_>, stations: &[Station], q: &[f64]) -> Result<(Vec<TextEdit>, Vec<f64>), Change> {
        let unknown = || refused("a position inside the window is unknown");
        let last = stations.len() - 1;
        let start = stance(&self.points[stations[0].last]).ok_or_else(unknown)?;
        let mut current = writer.programmed(start);
        let mut edits = Vec::new();
        let mut written = vec![stations[0].q];
        for (station, &q) in stations.iter().zip(q).take(last).skip(1) {
            for (index, point) in self
                .points
                .iter()
                .enumerate()
                .take(station.last + 1)
                .skip(station.first)
            {
                if let Some(obstacle) = tool_obstacle(point) {
                    return Err(obstacle);
                }
                if point.rotary_zero != writer.rotary_zero {
                    return Err(refused("the work offset of the rotary axis changes inside the window"));
                }
                let q = writer
                    .turn(
                        point.block,
                        stance(point).ok_or_else(unknown)?,
                        q,
                        &mut current,
                        &mut edits,
                    )
                    .map_err(refused)?;
                if index == station.first {
                    written.push(q);
                }
            }
        }
        written.push(stations[last].q);
        let end = &self.points[stations[last].first];
        let stance = stance(end).ok_or_else(unknown)?;
        writer
            .restore(end.block, stance, &mut current, &mut edits)
            .map_err(refused)?;
        Ok((edits, written))
    }
}
