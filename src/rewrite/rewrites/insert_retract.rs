//! Retracts the tool where the machine must change its posture in a cut, changes it there, and brings the tool back.
//!
//! # Why
//! Where an axis reaches its limit, the machine takes the other posture: the table turns by half a turn while the tool should hardly move.
//! In the cut that leaves a mark or a gouge. `switch-angles` finds another choice of postures for the whole program; where there is none,
//! the machine must change its posture, but not at the part.
//!
//! # How
//! Before the cut that would change the posture, the tool leaves the part along its own axis, up to the first of a series of heights at which
//! it clears all declared obstacles while the axes turn. There the axes take the posture in which the cut ends. Under tool centre point control the tool comes down above
//! the previous cut and joins it on a ramp, so that it does not stand still on the surface; otherwise it comes straight down, at the feed of the cut.
//!
//! # Example
//! ```gcode before sinumerik-840d mikron-ucp710+part
//! ; trunnion: tool 1 flat diameter 6 length 50
//! T1 M6
//! TRAORI
//! G0 X0 Y0 Z20 A20 C10
//! G1 X0 Y0 Z5 A20 C10 S8000 M3 F400
//! N30 X4 A20.2 C10.1
//! N40 X5 A-20.5 C190.2
//! N50 X9 A-20.7 C190.3
//! M30
//! ```
//! ```gcode after
//! ; trunnion: tool 1 flat diameter 6 length 50
//! T1 M6
//! TRAORI
//! G0 X0 Y0 Z20 A20 C10
//! G1 X0 Y0 Z5 A20 C10 S8000 M3 F400
//! N30 X4 A20.2 C10.1
//! G0 X4.294 Y-1.650 Z9.555
//! G1 X0.296 Y-1.679 Z9.684 A-20 C190
//! X0.003 Y-0.017 Z5.047
//! X4.000 Y0.000 Z5.000 A-20.2 C190.1
//! N40 X5 A-20.5 C190.2
//! N50 X9 A-20.7 C190.3
//! M30
//! ```
//!
//! # Claim
//! The programs do the same, but between two cuts the tool leaves the part along its axis, clears all declared obstacles by the clearance, and comes back
//! along its axis, or on a ramp above the previous cut. The cut after it ends where it did, changes no posture and turns no axis farther.
//!
//! # Traps
//! - The part must be declared (`[[obstacle]]` with `part = true`), and its clamps as other obstacles: nothing else is known of the space in which the machine turns.
//! - Shape and diameter of the tool must be declared: a tool that is wider than its shank must not be pulled out along its axis.
//! - Where the axes of a rapid may arrive at different times, it is often unknown what the tool passes. Then the machine turns at the feed of the cut, and `pole-flip`
//!   and `branch-swap` report that turn as they would in the cut.
//!   Where it is unknown whether a rapid keeps to the tool axis (a tilted head), the tool also leaves the part at that feed.
//! - Where the tool leaves the part it stands still for a moment and may leave a mark.
//! - Tool vectors, incremental coordinates, tilted planes and inverse time are left alone.
//!
//! # Sources
//! Guide-vane paper (2006), on posture swaps at an axis limit; docs/kinematics.md#retracting.
use super::Body;
use crate::excursion::{Excursion, Flip, Planner, Pose};
use crate::line_points::{programmed, undeclared_path};
use crate::slots::{Scheme, styles};
use crate::style::newline;
use crate::{Change, Known, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_check::{Assume, Settings};
use trunnion_interp::{AxisLetter, Fault, Feed, ModalState, Motion, MotionKind, Orientation, Sink, Swivel, run};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::{Address, Program, TextEdit, TextRange};

pub(super) const REWRITE: Body = Body {
    cures: &["branch-swap"],
    writes: Some("blocks of G0 and G1"),
    propose,
};

/// A rotary axis turns over if it turns by more, rad.
const HALF_TURN: f64 = core::f64::consts::PI + 1e-6;

struct Collector<'m> {
    machine: &'m Machine,
    follower: Follower<'m>,
    assume: Assume,
    rotary: [Option<usize>; 2],
    last: Option<Box<Leg>>,
    flips: Vec<Flip>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let last = self.last.take();
        if motion.kind == MotionKind::Linear && self.turns_over(&leg) {
            self.flips.push(Flip {
                last,
                words: programmed(&motion.start, self.rotary),
                unit_mm: state.coordinates.unit_mm(),
                tool: state.tool.data(),
                fixed: self.why_fixed(motion, state),
                leg: leg.clone(),
            });
        }
        if motion.kind == MotionKind::Linear && motion.tcp && leg.start.is_some() && leg.end.is_ok() {
            self.last = Some(Box::new(leg));
        }
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

impl Collector<'_> {
    /// The posture changes with much more rotary travel than needed, or, under tool centre point control, an axis turns by more than half a turn. Without
    /// it such a turn may be what is wanted: a groove round the part.
    fn turns_over(&self, leg: &Leg) -> bool {
        let far = leg.motion.tcp && leg.rotary_change.iter().any(|&change| change > HALF_TURN);
        leg.start.is_some() && leg.end.is_ok() && (far || leg.rotary_excess > self.machine.tolerances.swap_excess)
    }

    fn why_fixed(&self, motion: &Motion, state: &ModalState) -> Option<Change> {
        let left = self.assume.leaves(motion.undeclared);
        if left.zero & 0b111 != 0 || left.length {
            return Some(undeclared_path());
        }
        let why = if matches!(motion.orientation, Orientation::Vector(..)) {
            "tool vectors are programmed, so the control chooses the posture"
        } else if state.coordinates.incremental() {
            "coordinates are incremental (G91)"
        } else if motion.machine_coordinates {
            "its words are machine coordinates"
        } else if motion.tilt.normal.is_some() || motion.tilt.swivel != Swivel::No {
            "its words are in a tilted plane"
        } else if matches!(motion.feed, Feed::InverseTime(_)) {
            "its feed is inverse time (G93)"
        } else {
            return None;
        };
        Some(Change::Refused(why.into()))
    }
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and postures depend on the machine (--machine)".into());
    };
    if machine.rotary.len() != 2 || !settings.dialect.lex.format.has_words() {
        return Ok(None);
    }
    let letters = [0, 1].map(|index| machine.axes[machine.rotary[index]].letter);
    let mut collector = Collector {
        machine,
        follower: Follower::new(machine),
        assume: settings.assume,
        rotary: letters.map(|letter| Some(usize::from(AxisLetter::new(letter)?.0))),
        last: None,
        flips: Vec::new(),
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    let flips = collector.flips;
    if flips.is_empty() {
        return Ok(None);
    }
    let mut obstacles = machine.obstacles.iter();
    if !obstacles.any(|obstacle| obstacle.is_part() && obstacle.frame(machine) == Some(0)) {
        return Err(Refusal::missing(
            "the part is not declared, so it is unknown where the machine may turn: declare it as [[obstacle]] with `part = true` and the `axis` \
             that carries it, and its clamps as other obstacles, in trunnion.toml or in the machine file",
        ));
    }
    let scheme = Scheme::Rotaries(letters);
    let styles = styles(program, scheme);
    let planner = Planner {
        machine,
        scheme,
        styles: &styles,
        tolerance_mm: options.tolerance_mm,
    };
    let flips: Vec<Flip> = flips.into_iter().filter(|flip| !planner.is_in_the_air(flip)).collect();
    if flips.is_empty() {
        return Ok(None);
    }
    let mut heights = Vec::new();
    let places: Vec<Place> = flips
        .iter()
        .map(|flip| {
            let planned = match &flip.fixed {
                Some(change) => Err(change.clone()),
                None => planner.plan(flip),
            };
            let change = match planned {
                Ok(excursion) => {
                    heights.push(excursion.height_mm);
                    Change::Edits(vec![lines(program, scheme, flip, &excursion)])
                }
                Err(change) => change,
            };
            Place {
                first: flip.leg.motion.block,
                last: flip.leg.motion.block,
                change,
            }
        })
        .collect();
    if heights.is_empty() {
        return Err(Refusal::Places(places));
    }
    Ok(Some(Proposal {
        places,
        claim: Claim::InsertedRetracts {
            tolerance_mm: options.tolerance_mm,
            tolerance_deg: options.tolerance_deg,
            clearance_mm: machine.tolerances.clearance_mm(),
            assumed_zeros: settings.assume.work_offset && settings.assume.tool_length,
        },
        summary: summary(&heights),
    }))
}

/// What is gained, in one line.
fn summary(heights: &[f64]) -> String {
    let cuts = match heights.len() {
        1 => "one cut".to_owned(),
        count => format!("{count} cuts"),
    };
    let highest = heights.iter().copied().fold(0.0, f64::max);
    format!("before {cuts} the machine changes its posture in the air, up to {highest:.1} mm above the part")
}

/// The lines of an excursion, before the line of the cut.
fn lines(program: &Program, scheme: Scheme, flip: &Flip, excursion: &Excursion) -> TextEdit {
    let end = newline(program.source());
    let view = program.block(flip.leg.motion.block);
    let mut feed = String::new();
    for word in view.words().filter(|word| word.address == Address::Letter(b'F')) {
        feed.push(' ');
        feed.push_str(&String::from_utf8_lossy(&program.source()[word.range.as_usize()]));
    }
    let words = |pose: &Pose, indices: core::ops::Range<usize>| {
        let mut words: Vec<String> = indices
            .filter_map(|index| Some(format!("{}{}", char::from(scheme.letter(index)?), pose.texts[index])))
            .collect();
        // X Y Z, then the rotary axes by letter
        let linear = words.len().min(3);
        words[linear..].sort();
        words.join(" ")
    };
    let mut text = String::new();
    let mut active = "";
    let mut fed = false;
    let mut write = |rapid: bool, words: String| {
        let code = if rapid { "G0" } else { "G1" };
        if code != active {
            text += code;
            text.push(' ');
        }
        text += &words;
        if !rapid && !core::mem::replace(&mut fed, true) {
            text += &feed;
        }
        text += end;
        active = code;
    };
    write(excursion.leaves_at_rapid, words(&excursion.out, 0..3));
    write(excursion.at_rapid, words(&excursion.turned, 0..5));
    match &excursion.ramp {
        Some(ramp) => {
            write(false, words(ramp, 0..3));
            write(false, words(&excursion.back, 0..5));
        }
        None => write(false, words(&excursion.back, 0..3)),
    }
    let at = view.range().start;
    TextEdit {
        range: TextRange::new(at, at),
        new_text: text,
    }
}
