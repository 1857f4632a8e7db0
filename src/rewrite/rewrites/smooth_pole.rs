//! Turns the tool axis a little where it passes near the pole, so that the rotary table does not have to spin.
//!
//! # Why
//! Near the pole (tool axis parallel to the first rotary axis) a tiny change of the tool axis needs a large turn of the table. The
//! feed drops, and the dwell leaves a mark. Seen from above, the tool axis walks around the pole; this rewrite makes it walk
//! straight, as far as the tolerance allows.
//!
//! # How
//! The unit is a chain: straight feed motions under tool centre point control, one after the other. In a chain with a steep motion (one that
//! `pole-flip` reports, or in which the first rotary axis limits the feed near the pole) the first rotary axis may be anywhere in the
//! tube `|C' - C| <= 2 asin(sin(tol / 2) / sin theta)` around its value. What counts is the slope: degrees per millimetre of path, or
//! per time under G93, because the slope limits the feed.
//!
//! 1. Postures and turns. Where the tool axis is within half the tolerance of the pole, its azimuth is free, and the posture may change.
//!    Turns are free everywhere, and both are free at an end of the chain that a rapid leads to or away from. The choice is a shortest path
//!    over the chain. An exact search checks that it is within 1 % of the least possible slope, and replaces it where it is not.
//! 2. The taut string through the tubes: the least travel and the least slope at once.
//! 3. At most 1.003 times as steep as the string around it, the axis takes the course with the least sum of squares of the changes of slope.
//!
//! Points far from the pole keep their tool axis (beyond twice the pole cone, where the tube is narrower than a degree), unless that
//! would make the chain steeper. The tip moves by `r (u - u')`, so that the centre of the ball, and with it the contact with the surface,
//! stays where it was. With `--point centre` X Y Z are the centre of the ball, and stay. A tool vector on the pole has no azimuth; it is
//! turned by less than half the tolerance to carry one.
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
//! N2920 G1 X-28.38059 Y-1.84015 Z59.90263 A1.047 C2.212 F2000 ; trunnion: turned 0.1
//! N2930 G1 X-28.38161 Y-1.53288 Z59.93222 A0.081 C1.066
//! N2940 G1 X-28.38489 Y-1.28033 Z59.95290 A-0.79 C0.107
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
//! M30
//! ```
//!
//! # Claim
//! At every block end the tool axis turns relative to the part by at most the tolerance, and the centre of the ball stays within
//! `--tolerance-mm`. No cut swaps the posture where it did not before. No feed, no spindle word and no other byte changes, except for the comment
//! `trunnion: turned`. The
//! certificate states a measured value and a proven bound of how far apart the paths are between block ends.
//!
//! # Traps
//! - Only a ball keeps its contact when the tool axis turns. The shape of the tool must be declared; a flat or bull-nosed tool
//!   needs the surface normal, which a program does not contain.
//! - A word that was omitted because its value did not change may have to be written.
//! - Near the pole rounded numbers matter: `A0.081` and `k = 0.999999` are not the same tool axis. The rewrite works on the words
//!   of the program, digit by digit, and is verified after rounding.
//! - Shank and holder turn with the tool axis, by at most the tolerance.
//! - Where the digits of the program are too few, up to 0.001 mm, 0.0001 in and 0.001 deg are written.
//! - The tolerance counts from the program as it was before the first run: the comment `trunnion: turned 0.08` at each place records it,
//!   and a further run subtracts it. Without the comment, each run may turn the tool axis by as much again.
//! - A low slope over a long block can be a large step. The largest step may grow while the slope falls.
//! - Arcs, motions of more than a whole turn and changes of posture far from the pole are left alone. Where tool vectors are
//!   programmed, the control chooses the posture.
//!
//! # Sources
//! Guide-vane paper (2006), deformation on the circle i^2 + j^2 = 1 - k^2; docs/kinematics.md#smoothing-at-the-pole.
use super::Body;
use crate::propose::ProgrammedPoint;
use crate::reposition::Writer;
use crate::slots::{Scheme, Styles, finer, styles};
use crate::smooth::chain::{Station, chain, half_width};
use crate::smooth::mark::{Marks, mark};
use crate::smooth::obstacles::{obstacle, refused, unknown_position};
use crate::smooth::plan::{Plan, plan};
use crate::smooth::window::{Smoothed, steepest, write};
use crate::survey::{Point, Tip, survey};
use crate::{Change, Known, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_check::Settings;
use trunnion_geometry::{deg, rad};
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, LineIndex, Program};

pub(super) const REWRITE: Body = Body {
    cures: &[
        "axis-overspeed",
        "excess-rotary-travel",
        "fast-pole",
        "feed-drop",
        "pole-flip",
    ],
    writes: Some("X, Y, Z and rotary words of blocks"),
    propose,
};

/// Beyond the pole cone, a motion is looked at where the tube is so wide to either side, deg: there the tolerance matters.
const WIDE_TUBE_DEG: f64 = 5.0;

/// What was found so far.
#[derive(Default)]
struct Found {
    places: Vec<Place>,
    windows: Vec<Smoothed>,
    /// Radius of the ball, mm.
    radius: Option<f64>,
}

/// What is the same for all windows.
struct Task<'a> {
    program: &'a Program,
    machine: &'a Machine,
    options: &'a Options,
    points: &'a [Point],
    lines: LineIndex,
    /// What is recorded about earlier runs.
    marks: Marks,
    /// How the program writes the numbers of each scheme.
    styles: Vec<(Scheme, Styles)>,
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and poles depend on the machine (--machine)".into());
    };
    if machine.rotary.len() < 2 {
        return Ok(None);
    }
    let points = survey(program, settings, machine);
    let mut task = Task {
        program,
        machine,
        options,
        points: &points,
        lines: LineIndex::new(program.source()),
        marks: Marks::of(program),
        styles: Vec::new(),
    };
    let steep: Vec<usize> = (0..points.len()).filter(|&index| task.steep(index)).collect();
    if steep.is_empty() {
        return unknown_position(&points, |at| task.line(at)).map_or(Ok(None), |reason| Err(reason.into()));
    }
    let mut done: Option<usize> = None;
    let mut found = Found::default();
    for index in steep {
        if done.is_some_and(|last| index <= last) {
            continue;
        }
        match (obstacle(&points[index]), points[index].tip) {
            (None, Tip::Ball(ball)) => done = Some(task.smooth_chain(index, ball, &mut found)),
            (obstacle, _) => {
                let why = obstacle.unwrap_or_else(|| refused("the tool is not a ball"));
                found.places.push(task.place((index, index), why));
            }
        }
    }
    let Found {
        places,
        windows,
        radius,
    } = found;
    let Some(ball_radius_mm) = radius.filter(|_| !windows.is_empty()) else {
        return Err(Refusal::Places(places));
    };
    let claim = match options.point {
        ProgrammedPoint::Tip => Claim::SameBallCentre {
            ball_radius_mm,
            tolerance_mm: options.tolerance_mm,
            tolerance_deg: options.tolerance_deg,
        },
        ProgrammedPoint::Centre => Claim::SameProgrammedCentre {
            tolerance_mm: options.tolerance_mm,
            tolerance_deg: options.tolerance_deg,
        },
    };
    let summary = task.summary(&windows);
    Ok(Some(Proposal { places, claim, summary }))
}

/// How far a tool axis may turn, rad, from the tolerance in degrees: slightly less, so that the last bit of a double decides nothing.
fn room(tolerance_deg: f64) -> f64 {
    rad(tolerance_deg) * (1.0 - 1e-8)
}

impl Task<'_> {
    /// The first rotary axis turns as far as the rule pole-flip reports, or limits the feed, near the pole or where the tube is wide.
    fn steep(&self, index: usize) -> bool {
        let point = &self.points[index];
        let tolerances = &self.machine.tolerances;
        let wide = || half_width(room(self.options.tolerance_deg), point.pole_angle_min) >= rad(WIDE_TUBE_DEG);
        if !point.feed || point.pole_angle_min >= tolerances.pole_cone && !wide() {
            return false;
        }
        let fastest = self.machine.axes[self.machine.rotary[0]].max_speed;
        let slows = || {
            let limits = |(fastest, seconds)| point.rotary_change[0] > fastest * seconds;
            point.tcp && fastest.zip(point.seconds()).is_some_and(limits)
        };
        point.rotary_change[0] > tolerances.pole_angle || slows()
    }

    fn line(&self, index: usize) -> u32 {
        let start = self.program.block(self.points[index].block).range().start;
        self.lines.line_column(self.program.source(), start).0
    }

    /// Motions as a place.
    fn place(&self, (first, last): (usize, usize), change: Change) -> Place {
        let block = |index: usize| -> BlockId { self.points[index].block };
        Place {
            first: block(first),
            last: block(last),
            change,
        }
    }

    /// Smooths the chain around one steep motion, window by window. Gives the last motion of the chain.
    fn smooth_chain(&mut self, index: usize, ball: f64, found: &mut Found) -> usize {
        let mut stations = chain(self.machine, self.points, index, room(self.options.tolerance_deg));
        let last = stations.last().map_or(index, |station| station.last);
        let only = |task: &Self, change| vec![task.place((index, last), change)];
        let begin = stations.first().map_or(index, |station| station.first);
        let allowed = match self.allowed(begin, last) {
            Ok(allowed) => allowed,
            Err(change) => {
                found.places.extend(only(self, change));
                return last;
            }
        };
        if allowed < self.options.tolerance_deg {
            stations = chain(self.machine, self.points, index, room(allowed));
        }
        if *found.radius.get_or_insert(ball) != ball {
            let why = "a different ball radius, which needs a separate run";
            found.places.extend(only(self, refused(why)));
            return last;
        }
        if stations.len() < 3 {
            found
                .places
                .extend(only(self, refused("there is no point between the two fixed ends")));
            return last;
        }
        let asks = |station: &Station| self.steep(station.first);
        let Some(plan) = plan(self.machine, self.points, stations, &asks) else {
            found
                .places
                .extend(only(self, refused("the rotary axis is already outside its limits")));
            return last;
        };
        let mut places = Vec::new();
        for &(station, was, is) in &plan.useless {
            let at = plan.stations[station].first;
            let why = Change::Possible(format!(
                "within {} deg the slope of the table can only be reduced from {:.3} to {:.3} deg/mm (--tolerance-deg)",
                self.options.tolerance_deg,
                deg(was),
                deg(is)
            ));
            places.push(self.place((at, at), why));
        }
        let (scheme, styles) = self.scheme(index);
        let writers = [styles, finer(styles, scheme, self.points[index].unit_mm)]
            .map(|styles| self.writer(index, (ball, allowed), (scheme, styles)));
        let mut windows = Vec::new();
        for &(first, end) in &plan.stretches {
            let planned = steepest(&plan, (first, end), |at| plan.q[at]);
            let mut written = write(self.points, &writers[0], &plan, (first, end));
            let coarse = written
                .as_ref()
                .map_or(true, |window| window.slopes.1 > 1.005 * planned);
            if coarse && writers[0].styles != writers[1].styles {
                written = write(self.points, &writers[1], &plan, (first, end)).or(written);
            }
            match written.and_then(|window| self.recorded(window, &plan, (first, end))) {
                Ok(window) => {
                    places.push(self.place(window.changed, Change::Edits(window.edits.clone())));
                    windows.push(window);
                }
                Err(change) => {
                    let lines = (plan.stations[first].last + 1, plan.stations[end].first);
                    places.push(self.place(lines, change));
                }
            }
        }
        places.sort_by_key(|place| place.first);
        found.places.extend(places);
        found.windows.extend(windows);
        last
    }

    /// How far the tool axes of a chain may still turn, deg: what earlier runs recorded is subtracted.
    fn allowed(&self, first: usize, last: usize) -> Result<f64, Change> {
        let tolerance = self.options.tolerance_deg;
        let blocks = [first, last].map(|at| self.points[at].block);
        let Some((byte, turned)) = self.marks.within(self.program, blocks[0], blocks[1]) else {
            return Ok(tolerance);
        };
        if tolerance - turned > 1e-6 {
            return Ok(tolerance - turned);
        }
        let (line, _) = self.lines.line_column(self.program.source(), byte);
        Err(Change::Possible(format!(
            "line {line} says that the tool axes were already turned by up to {turned} deg, and no more than {tolerance} deg is allowed (--tolerance-deg)"
        )))
    }

    /// The window with the comment that records how far its tool axes are turned.
    fn recorded(&self, mut window: Smoothed, plan: &Plan, (first, end): (usize, usize)) -> Result<Smoothed, Change> {
        let inner = &self.points[plan.stations[first].last + 1..=plan.stations[end].first];
        let blocks = inner.iter().map(|point| point.block);
        let Some(edit) = mark(self.program, blocks, self.options.tolerance_deg) else {
            let why = "no block has room for the comment that records how far its tool axes are turned";
            return Err(refused(why));
        };
        window.edits.push(edit);
        Ok(window)
    }

    /// Which words the chain around a motion is written in, and how.
    fn scheme(&mut self, index: usize) -> (Scheme, Styles) {
        let point = &self.points[index];
        let scheme = if point.vector {
            Scheme::of_vector(self.program, &self.program.block(point.block))
        } else {
            let letter = |at: usize| self.machine.axes[self.machine.rotary[at]].letter;
            Scheme::Rotaries([letter(0), letter(1)])
        };
        if let Some(&known) = self.styles.iter().find(|(of, _)| *of == scheme) {
            return known;
        }
        let found = (scheme, styles(self.program, scheme));
        self.styles.push(found);
        found
    }

    fn writer(
        &self,
        index: usize,
        (ball, tolerance_deg): (f64, f64),
        (scheme, styles): (Scheme, Styles),
    ) -> Writer<'_> {
        let point = &self.points[index];
        Writer {
            program: self.program,
            machine: self.machine,
            scheme,
            styles,
            unit_mm: point.unit_mm,
            ball_radius: if self.options.point == ProgrammedPoint::Centre {
                0.0
            } else {
                ball
            },
            rotary_zero: point.rotary_zero,
            tolerance_deg,
            tolerance_mm: self.options.tolerance_mm,
        }
    }

    /// What was done, in one line.
    fn summary(&self, windows: &[Smoothed]) -> String {
        let letter = char::from(self.machine.axes[self.machine.rotary[0]].letter);
        let worst = windows.iter().fold((0.0f64, 0.0f64), |worst, w| {
            (worst.0.max(w.slopes.0), worst.1.max(w.slopes.1))
        });
        let lines = |at: usize, last: bool| {
            windows
                .get(at)
                .map_or(0, |w| self.line(if last { w.points.1 } else { w.points.0 }))
        };
        let count = if windows.len() > 1 {
            format!(" in {} windows", windows.len())
        } else {
            String::new()
        };
        let crossings = windows
            .iter()
            .fold((0, 0), |sum, w| (sum.0 + w.crossings.0, sum.1 + w.crossings.1));
        let postures = if crossings.0 == crossings.1 {
            String::new()
        } else {
            format!("; {} -> {} changes of posture", crossings.0, crossings.1)
        };
        format!(
            "lines {} to {}{count}: largest slope of {letter} {:.3} -> {:.3} deg/mm{postures}",
            lines(0, false),
            lines(windows.len().saturating_sub(1), true),
            deg(worst.0),
            deg(worst.1)
        )
    }
}
