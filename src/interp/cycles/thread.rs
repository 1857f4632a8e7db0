//! Threads in many passes, in two blocks: G76 (G78 of system C).
//!
//! First block: P is six digits, two each for the number of finishing passes, the pull-out in tenths of the lead, and the angle of the tool; Q the
//! least depth of a cut, R the finishing allowance (parameters 5142, 5130, 5143, 5140, 5141). Second block: X and Z the root of the thread at its
//! end, R the radius at its beginning less that at its end, P the height, Q the depth of the first cut, F the lead. P and Q are radii in
//! least increments. The nth cut is Q times the root of n below the crest, and at least the least depth below the one before; at the height less the
//! allowance the finishing passes follow at the whole height. In in rapid, along the thread by the lead, out and back in rapid.
//!
//! Sources: HUST H6D-T manual, pages 3-59 and 3-60 (the same cycle: the least depth, and rapids everywhere but along the thread). Fanuc's own (Series
//! 30i operator's manual, lathe system, multiple threading cycle) was not available. Where in Z a cut begins that goes in along the flank (angle above 0), and
//! the shape of the pull-out (parameter 5131), are shown in pictures only: unknown.
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Feed, MotionKind, Position};

const X: usize = 0;
const Z: usize = 2;
/// Cuts of one thread.
const MOST: usize = 10_000;
/// Angles of the tool that a control takes, degrees.
const ANGLES: [u32; 6] = [0, 29, 30, 55, 60, 80];

/// What the first block keeps; `None`: not programmed, or unknown.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Thread {
    /// Finishing passes, pull-out in tenths of the lead, angle in degrees.
    digits: Option<[u32; 3]>,
    /// mm.
    least: Option<f64>,
    /// mm.
    allowance: Option<f64>,
}

impl Thread {
    pub(super) fn numbers(&self) -> [Option<f64>; 5] {
        let [passes, out, angle] = self
            .digits
            .map_or([None; 3], |digits| digits.map(|digit| Some(f64::from(digit))));
        [passes, out, angle, self.least, self.allowance]
    }
}

/// A thread as it is programmed, mm.
struct Data {
    finishing: u32,
    /// How many leads before its end the tool pulls out.
    leads_out: f64,
    flank: bool,
    least: f64,
    allowance: f64,
    height: f64,
    first: f64,
    taper: f64,
}

/// A thread that can be computed, mm.
struct Plan {
    start: Position,
    /// Root of the thread at its end.
    root: [f64; 2],
    /// Direction of X out of the work: 1 or -1.
    out: f64,
    taper: f64,
    height: f64,
    /// Depths of all passes.
    depths: Vec<f64>,
    /// Length of the pull-out along Z.
    pull_out: f64,
    /// Whether the tool goes in along the flank.
    flank: bool,
    lead: Feed,
}

impl Iso<'_> {
    /// G76: the first of two blocks has no coordinates.
    pub(super) fn thread_repeat(&mut self, words: &Words, report: &mut Report<'_>) {
        if !words.axes.any() {
            return self.keep_thread(words);
        }
        let start = self.core.state.position;
        let lead = self.lead(words, report);
        match self.plan_thread(start, lead, words) {
            Ok(plan) => self.thread(&plan, report),
            Err(why) => {
                let what = format!(
                    "passes of {}: {why}; the cycle is taken to end where it started",
                    self.memory.cycle.id
                );
                self.unknown_path_to_start(&what, start, report);
            }
        }
    }

    fn keep_thread(&mut self, words: &Words) {
        if words.p.is_given() {
            let digits = words
                .p
                .number()
                .filter(|number| !number.has_point)
                .map(|number| number.value);
            let digits = digits.filter(|value| value.fract() == 0.0 && (0.0..1e6).contains(value));
            self.memory.cycle.kept.thread.digits = digits.map(|value| {
                let value = value as u32;
                [value / 10_000, value / 100 % 100, value % 100]
            });
        }
        if words.letter(b'Q').is_given() {
            self.memory.cycle.kept.thread.least = self.increment_word(words, b'Q');
        }
        if words.radius.is_given() {
            self.memory.cycle.kept.thread.allowance = self.length_word(words, b'R').filter(|value| *value >= 0.0);
        }
    }

    /// The thread, or why it cannot be computed.
    fn plan_thread(&mut self, start: Position, lead: Feed, words: &Words) -> Result<Plan, &'static str> {
        let data = if [b'A', b'D', b'I', b'K']
            .iter()
            .any(|&letter| words.letter(letter).is_given())
        {
            self.thread_in_one(words)?
        } else {
            self.thread_in_two(words)?
        };
        let Data {
            finishing,
            leads_out,
            flank,
            least,
            allowance,
            height,
            first,
            taper,
        } = data;
        let mut end = start;
        self.targets(&words.axes, false, &mut end);
        let known = [start, end]
            .iter()
            .all(|place| place.get(X).is_some() && place.get(Z).is_some());
        if !known || self.memory.frames.active || self.core.state.zero.is_lost() {
            return Err("from or to an unknown position");
        }
        let Feed::PerRevolution(pitch) = lead else {
            return Err("without its lead (F)");
        };
        let root = [end.values[X], end.values[Z]];
        let (rise, way) = (start.values[X] - root[X], root[1] - start.values[Z]);
        let out = rise.signum();
        // the start is outside the thread at both ends
        if rise * out < height - 1e-9 || (rise - taper) * out < height - 1e-9 || way == 0.0 {
            return Err("it starts inside its thread, or has no length");
        }
        let pull_out = pitch * leads_out;
        if pull_out >= way.abs() {
            return Err("its pull-out is as long as the thread");
        }
        let Some(mut depths) = cuts(first, least, height - allowance) else {
            self.cycle_motions.add_in_vain(MOST as u64);
            return Err("a finishing allowance as large as its height, or more than 10000 cuts");
        };
        depths.extend(core::iter::repeat_n(height, finishing as usize));
        Ok(Plan {
            start,
            root,
            out,
            taper,
            height,
            depths,
            pull_out,
            flank,
            lead,
        })
    }

    /// What the two blocks say.
    fn thread_in_two(&self, words: &Words) -> Result<Data, &'static str> {
        let Thread {
            digits,
            least,
            allowance,
        } = self.memory.cycle.kept.thread;
        let [finishing, tenths, angle] = digits.ok_or("without P in its first block (parameters 5142, 5130, 5143)")?;
        let least = least.ok_or("without Q in its first block (parameter 5140)")?;
        let allowance = allowance.ok_or("without R in its first block (parameter 5141)")?;
        if finishing == 0 || !ANGLES.contains(&angle) {
            return Err("no finishing pass, or an angle other than 0, 29, 30, 55, 60 or 80");
        }
        let taper = match self.length_word(words, b'R') {
            None if words.radius.is_given() => return Err("its taper (R) is unknown"),
            taper => taper.unwrap_or(0.0),
        };
        let size = |letter| self.increment_word(words, letter).filter(|size| *size > 0.0);
        let (Some(height), Some(first)) = (size(b'P'), size(b'Q')) else {
            return Err("without its height (P) and the depth of its first cut (Q), both greater than 0");
        };
        Ok(Data {
            finishing,
            leads_out: f64::from(tenths) / 10.0,
            flank: angle > 0,
            least,
            allowance,
            height,
            first,
            taper,
        })
    }

    /// What one block says and the control has set (Haas; Fanuc Series 10/11 format): K the height, D the first cut, I the radius at the
    /// beginning less that at the end, A the angle of the tool, P the way of cutting. One pass at the whole height ends it where the
    /// control leaves an allowance.
    fn thread_in_one(&self, words: &Words) -> Result<Data, &'static str> {
        if words.p.is_given() && words.p.index() != Some(1) {
            return Err("a cutting method (P) other than 1");
        }
        let size = |letter| self.one_block_length(words, letter).filter(|size| *size > 0.0);
        let (Some(height), Some(first)) = (size(b'K'), size(b'D')) else {
            return Err(
                "the format in one block: its height (K) or first cut (D) is missing, not above 0, or has no decimal point",
            );
        };
        let taper = match self.length_word(words, b'I') {
            None if words.letter(b'I').is_given() => return Err("its taper (I) is unknown"),
            taper => taper.unwrap_or(0.0),
        };
        let angle = words.letter(b'A');
        let angle = match angle.number() {
            None if angle.is_given() => return Err("the angle of its tool (A) is unknown"),
            angle => angle.map_or(0.0, |angle| angle.value),
        };
        let control = &self.core.setup.control;
        let least = control.thread_least_cut_mm;
        let allowance = control.thread_finish_mm;
        let (Some(least), Some(allowance)) = (least, allowance) else {
            return Err(
                "the format in one block: declare [control] thread_least_cut and thread_finish (Haas settings 99 and 86, parameters 5140 and 5141)",
            );
        };
        let leads_out = if self.memory.thread_chamfer_off {
            Some(0.0)
        } else {
            control.thread_pull_out
        };
        let leads_out =
            leads_out.ok_or("the format in one block: declare [control] thread_pull_out (Haas setting 95)")?;
        Ok(Data {
            finishing: u32::from(allowance > 0.0),
            leads_out,
            flank: angle > 0.0,
            least,
            allowance,
            height,
            first,
            taper,
        })
    }

    fn thread(&mut self, plan: &Plan, report: &mut Report<'_>) {
        let [x, z] = plan.root;
        let way = z - plan.start.values[Z];
        for depth in &plan.depths {
            let level = x + plan.out * (plan.height - depth);
            let mut place = plan.start;
            place.set(X, level + plan.taper);
            if plan.flank {
                place.forget(Z);
                if plan.taper != 0.0 {
                    place.forget(X);
                }
            }
            self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
            let begins = place;
            let mut place = plan.start;
            place.set(X, level + plan.taper * plan.pull_out / way.abs());
            place.set(Z, z - way.signum() * plan.pull_out);
            if plan.flank && plan.taper != 0.0 && plan.pull_out > 0.0 {
                place.forget(X);
            }
            let feed = self.along_thread(plan.lead, [&begins, &place]);
            self.goes(MotionKind::Linear, place, feed, report);
            if plan.pull_out > 0.0 {
                self.goes(MotionKind::Unknown, plan.start, Feed::Unknown, report);
            } else {
                place.set(X, plan.start.values[X]);
                self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
                self.goes(MotionKind::Rapid, plan.start, Feed::Rapid, report);
            }
        }
        if plan.flank {
            self.report_not_modelled(
                "where in Z its cuts start, which feed in along the flank (tool angle greater than 0)",
                report,
            );
        }
        if plan.pull_out > 0.0 {
            self.report_not_modelled(
                "the shape of its pull-out (parameter 5131), and the return after it",
                report,
            );
        }
    }
}

/// Depths of the cuts down to `depth`, mm; `None` where there are none, or too many.
fn cuts(first: f64, least: f64, depth: f64) -> Option<Vec<f64>> {
    let mut cuts = Vec::new();
    let mut done = 0.0_f64;
    while done < depth - 1e-9 && cuts.len() < MOST {
        let count = cuts.len() as f64 + 1.0;
        done = (first * count.sqrt())
            .max(if count > 1.0 { done + least } else { first })
            .min(depth);
        cuts.push(done);
    }
    (depth > 0.0 && done >= depth - 1e-9).then_some(cuts)
}
