//! Cycles at places that are not where the tool is: CYCL CALL POS, CYCL CALL PAT with the points of PATTERN DEF, and the patterns 220 and 221.
//!
//! `PATTERN DEF POS1 (X+25 Y+33,5 Z+0) POS2 (...)` names points, and CYCL CALL PAT runs the cycle at each of them in their order (NC-PB/NCXchange_,
//! docs/controllers/heidenhain.md, 5). How the tool goes from one to the next, what a coordinate along the tool axis other than 0 does, and
//! the other forms (ROW, PAT, FRAME, CIRC, PITCHCIRC) are not taken from a source.
//!
//! 220: Q241 places on the circle of diameter Q244 about Q216, Q217, from the angle Q245 on; the step is Q247, or, where that is 0, divides the arc to Q246
//! (TNC 320 cycle programming, 9/2016, p. 178). 221: Q242 places with distance Q237 from Q225, Q226 on, turned by Q224 (TNC 128 77184x-01, p. 380); in which
//! order it goes through several lines is not taken from a source, nor whether the clearances of the pattern or those of the cycle count where they differ.
use super::Klartext;
use super::drill::MOST;
use super::hole::Cycle;
use super::path_words::{FeedSaid, PathWords};
use super::words::{Said, Words};
use crate::core::Report;
use crate::frames::XYZ;
use crate::frames::sin_cos_degrees;
use crate::{MotionKind, Position, Refusal};

impl Klartext<'_> {
    /// CYCL CALL POS X Y Z: the cycle at a place, whose coordinate along the tool axis shifts the cycle's levels (NC-PB/gEdit,
    /// docs/user/transformations.md: "a second datum shift on top of Q203"). In which order the axes go there is not taken from a source.
    pub(super) fn call_at(&mut self, found: &PathWords, report: &mut Report<'_>) {
        if self.scales_cycles(report) {
            return self.unknown_motion(report);
        }
        if found.given & XYZ != XYZ {
            let message = "CYCL CALL POS needs the coordinates of all three axes";
            Self::rejected(Refusal::MissingWord, message, report);
        }
        self.not_modelled_once("CYCL CALL POS: the path to its position", report);
        let along = self.axes()[2];
        let mut end = self.memory.frames.programmed(&self.core.state.position);
        self.place(found, &mut end);
        let shift = end.get(along).filter(|_| found.given & (1 << along) != 0);
        self.work_at(end, shift, found, report);
    }

    /// The cycle at a place; `shift`: of its levels along the tool axis, mm.
    fn work_at(&mut self, mut end: Position, shift: Option<f64>, found: &PathWords, report: &mut Report<'_>) {
        let along = self.axes()[2];
        let before = self.core.state.feed;
        let mut hole = match &self.memory.cycle {
            Cycle::Hole(hole) if !self.cycle_has_other_unit() => Some(hole.clone()),
            _ => None,
        };
        let unit = self.core.state.coordinates.unit_mm();
        if let Some(hole) = &mut hole {
            hole.surface = hole.surface.zip(shift).map(|(surface, shift)| surface + shift / unit);
        }
        // every hole begins at its clearance
        let level = hole
            .as_ref()
            .and_then(|hole| Some((hole.surface? + hole.clear?) * unit));
        match level {
            Some(level) => end.set(along, level),
            None => end.forget(along),
        }
        let start = self.memory.frames.programmed(&self.core.state.position);
        self.memory.was_rapid = false;
        self.go(MotionKind::Unknown, start, end, found, report);
        match hole {
            Some(hole) => self.drill(&hole, report),
            None => self.run_cycle(report),
        }
        // its F is that of the path to the place
        self.core.state.feed = before;
    }

    /// PATTERN DEF.
    pub(crate) fn pattern(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        // its points count where they are called
        self.memory.unfollowed = true;
        self.memory.pattern = self.points_of(words, report).map(Into::into);
        if self.memory.pattern.is_none() {
            Self::not_modelled(
                "PATTERN DEF: other forms than POS with the two coordinates of the plane",
                report,
            );
        }
    }

    /// `DEF POS1 (X+25 Y+33,5 Z+0) POS2 (...)`, mm; `None`: not of this form.
    fn points_of(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> Option<Vec<Position>> {
        if !words.takes_word("DEF") {
            return None;
        }
        let [a, b, along] = self.axes();
        let mut points = Vec::new();
        while let Some(word) = words.next() {
            let numbered = word.is("POS") && matches!(word.value, Said::Number(_));
            if !numbered || !words.takes(b'(') {
                return None;
            }
            let rest = words.rest();
            let length = rest.iter().position(|byte| *byte == b')')?;
            let found = self.path_words(&mut Words::new(rest.get(..length)?), report);
            words.at += length + 1;
            let plane = 1 << a | 1 << b;
            let level = found.values[along];
            let plain = found.given & !(1 << along) == plane
                && found.incremental == 0
                && (found.given & (1 << along) == 0 || level == Some(0.0))
                && found.feed == FeedSaid::Nothing
                && found.codes().is_empty();
            let mut point = Position::default();
            self.place(&found, &mut point);
            point.get(a).zip(point.get(b)).filter(|_| plain)?;
            points.push(point);
        }
        (!points.is_empty()).then_some(points)
    }

    /// Whether no further place of a pattern is computed: then where the tool is stays unknown, and it is said why.
    fn is_full(&mut self, report: &mut Report<'_>) -> bool {
        let Some(why) = self.cycle_motions.full(self.out.len(), self.core.setup.limits.blocks) else {
            return false;
        };
        self.not_modelled_once(&why, report);
        self.unknown_motion(report);
        true
    }

    /// CYCL CALL PAT F.
    pub(super) fn call_pattern(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let found = self.path_words(words, report);
        self.codes_before(&found, report);
        let over = self.cycle_motions.over(self.core.setup.limits.blocks);
        let points = if over.is_none() {
            self.memory.pattern.clone()
        } else {
            None
        };
        let points = points.filter(|_| !self.scales_cycles(report));
        if let Some(why) = over {
            self.not_modelled_once(&why, report);
            self.unknown_motion(report);
        } else if let Some(points) = points {
            self.not_modelled_once("CYCL CALL PAT: the path between its points", report);
            let axes = self.axes();
            for point in points.iter() {
                if self.is_full(report) {
                    break;
                }
                let mut end = self.memory.frames.programmed(&self.core.state.position);
                for axis in &axes[..2] {
                    match point.get(*axis) {
                        Some(value) => end.set(*axis, value),
                        None => end.forget(*axis),
                    }
                }
                self.work_at(end, Some(0.0), &found, report);
            }
        } else {
            Self::not_modelled("CYCL CALL PAT: the points of a pattern", report);
            self.unknown_motion(report);
        }
        self.codes_after(&found);
    }

    /// CYCL DEF 220 and 221: the last cycle, at once, at each place.
    pub(crate) fn pattern_cycle(&mut self, cycle: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        let numbers: &[u32] = if cycle == 220 {
            &[216, 217, 244, 245, 246, 247, 241, 200, 203, 204]
        } else {
            &[225, 226, 237, 224, 242, 243, 0, 200, 203, 204]
        };
        let said: Vec<Option<f64>> = numbers
            .iter()
            .map(|number| self.parameter_of(*number, words, report).flatten())
            .collect();
        self.read_cycle(cycle, words, report);
        let levels = |at: usize| said.get(at).copied().flatten();
        let alike = match &self.memory.cycle {
            Cycle::Hole(hole) => hole.clear == levels(7) && hole.surface == levels(8) && hole.second == levels(9),
            _ => false,
        };
        let places = said[..6]
            .iter()
            .copied()
            .collect::<Option<Vec<f64>>>()
            .and_then(|numbers| {
                if cycle == 220 {
                    on_circle(&numbers, said[6]?)
                } else {
                    on_line(&numbers)
                }
            });
        let Some(places) = places.filter(|_| alike && !self.scales_cycles(report)) else {
            Self::not_modelled(format!("cycle {cycle}: a pattern of holes"), report);
            return self.unknown_motion(report);
        };
        self.not_modelled_once(&format!("cycle {cycle}: the path between its places"), report);
        let unit = self.core.state.coordinates.unit_mm();
        let axes = self.axes();
        for place in places {
            if self.is_full(report) {
                break;
            }
            let mut end = self.memory.frames.programmed(&self.core.state.position);
            for (axis, value) in axes.iter().zip(place) {
                end.set(*axis, value * unit);
            }
            self.work_at(end, Some(0.0), &PathWords::default(), report);
        }
    }
}

/// A count of places; `None`: none that is followed.
fn count_of(value: f64) -> Option<usize> {
    (value.fract() == 0.0 && (1.0..=MOST as f64).contains(&value)).then_some(value as usize)
}

/// Centre, diameter, first and last angle, step.
fn on_circle(numbers: &[f64], count: f64) -> Option<Vec<[f64; 2]>> {
    let [x, y, diameter, first, last, step] = *numbers else {
        return None;
    };
    let count = count_of(count)?;
    let span = last - first;
    let step = match (step, span.abs()) {
        (0.0, 0.0) => return None,
        (0.0, 360.0) => span / count as f64,
        (0.0, _) if count == 1 => 0.0,
        (0.0, _) => span / (count - 1) as f64,
        (step, _) => step,
    };
    let place = |at: usize| {
        let (sin, cos) = sin_cos_degrees(first + step * at as f64);
        [x + diameter / 2.0 * cos, y + diameter / 2.0 * sin]
    };
    Some((0..count).map(place).collect())
}

/// Start, distance, angle, and how many in how many lines.
fn on_line(numbers: &[f64]) -> Option<Vec<[f64; 2]>> {
    let [x, y, distance, angle, count, lines] = *numbers else {
        return None;
    };
    let (sin, cos) = sin_cos_degrees(angle);
    let place = |at: usize| {
        let way = distance * at as f64;
        [x + way * cos, y + way * sin]
    };
    let count = count_of(count).filter(|_| lines == 1.0)?;
    Some((0..count).map(place).collect())
}
