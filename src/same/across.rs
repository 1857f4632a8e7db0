//! Programs for two controls: what is in effect has another name in each.
//!
//! Zero points and tool lengths that are declared are in the motions. One that is not must have gone with the same one of the other program
//! wherever it counts. The kind of a cycle is compared as far as the words of both controls are known; other settings have no common words.
use crate::item::{Item, Sort, Step};
use crate::process::{Process, Unlike, shown, stops};
use crate::verdict::{Difference, Verdict};
use std::sync::Arc;
use trunnion_dialect::{Dialect, Plane};
use trunnion_interp::{Argument, Feed, LengthOf, Motion, Value, same_number};

/// Settings that the motions, [`Counterparts`] or [`unlike_cycles`] compare, or that only prepare what comes later: each control has its own words.
const NAMED_OTHERWISE: [&str; 15] = [
    "compensation",
    "coordinates",
    "cycle",
    "cycle data",
    "D",
    "diameter",
    "H",
    "MULTAX",
    "radius offset",
    "reference point",
    "side of the compensation",
    "spindle words",
    "tool prepared",
    "tool words",
    "message",
];

/// The kinds of cycles that turn the spindle with the feed into the hole and back out.
const TAPS: [&str; 10] = [
    "tap", "CYCLE84", "CYCLE840", "G33.1", "G63", "G74", "G84", "G84.2", "G84.3", "G331",
];

/// Axis Z, in a mask as in [`trunnion_interp::Position::known`].
const Z: u16 = 1 << 2;

/// The linear axes of the workpiece.
const XYZ: u16 = 7;

/// Zero points and tool lengths of two programs that have gone together so far.
#[derive(Default)]
pub(crate) struct Counterparts {
    zeros: Vec<[Option<Arc<str>>; 2]>,
    lengths: Vec<[LengthOf; 2]>,
}

/// Keeps what goes together; the pair that one of them was in before.
fn join<T: PartialEq + Clone>(known: &mut Vec<[T; 2]>, pair: [&T; 2]) -> Option<[T; 2]> {
    let [one, other] = pair;
    let found = known.iter().find(|[a, b]| a == one || b == other);
    match found {
        Some([a, b]) if a == one && b == other => None,
        Some(earlier) => Some(earlier.clone()),
        None => {
            known.push([one.clone(), other.clone()]);
            None
        }
    }
}

impl Counterparts {
    /// Whether zero points, tool lengths and the radius that the motions do not show are the same at both.
    ///
    /// # Errors
    /// What is not known to be the same.
    pub(crate) fn agree(&mut self, was: &Step, is: &Step) -> Result<(), Verdict> {
        let (a, b) = (&was.motion, &is.motion);
        let unknown = |what: String| {
            Err(Verdict::Unknown(Difference {
                before: Some(a.block),
                after: Some(b.block),
                what,
            }))
        };
        let open = [a, b].map(|motion| motion.undeclared.zero & XYZ != 0);
        if open[0] != open[1] {
            return unknown("only one of them depends on a zero point that is not declared: declare it".to_owned());
        }
        let machine = a.machine_coordinates || b.machine_coordinates;
        if !machine
            && (a.undeclared.zero | b.undeclared.zero) != 0
            && let Some([one, other]) = join(&mut self.zeros, [&was.held.work_offset, &is.held.work_offset])
        {
            let name = |zero: &Option<Arc<str>>| zero.as_deref().unwrap_or("no work offset").to_owned();
            return unknown(format!(
                "the zero points are {} and {}, but before this {} went with {}: declare them",
                name(&was.held.work_offset),
                name(&is.held.work_offset),
                name(&one),
                name(&other)
            ));
        }
        if !machine && length_counts(a, b) && (a.undeclared.length || b.undeclared.length) {
            let lengths = [&was.held.length_of, &is.held.length_of];
            let one_has_none = lengths.contains(&&LengthOf::Nothing) && lengths[0] != lengths[1];
            let what = format!("the tool lengths in effect are {} and {}", lengths[0], lengths[1]);
            if one_has_none {
                return unknown(what);
            }
            if let Some([one, other]) = join(&mut self.lengths, lengths) {
                return unknown(format!("{what}, but before this {one} went with {other}: declare them"));
            }
            if was.held.plane != Plane::Xy || is.held.plane != Plane::Xy {
                return unknown(format!(
                    "{what}, in a working plane other than G17: along which axis each control applies it is not compared; declare the length"
                ));
            }
        }
        let sides = [was.held.compensation, is.held.compensation];
        if follows_no_radius(was) || follows_no_radius(is) {
            let name = |code: u8| {
                if code == 0 {
                    "off".to_owned()
                } else {
                    format!("G{code}")
                }
            };
            return unknown(format!(
                "the cutter radius compensation is {} and {}, and how far the tool runs beside the path is not computed in both",
                name(sides[0]),
                name(sides[1])
            ));
        }
        Ok(())
    }
}

/// Whether compensation is in effect and does not show: the motion is the programmed path.
fn follows_no_radius(step: &Step) -> bool {
    step.held.compensation != 0 && !step.held.beside_is_computed
}

/// Whether the length of the tool shows in the motions: the axis along it moves, or the tip is guided.
pub(crate) fn length_counts(a: &Motion, b: &Motion) -> bool {
    let counts = |motion: &Motion| {
        let (start, end) = (&motion.start, &motion.end);
        let stays = start.known & Z != 0 && start.values[2].to_bits() == end.values[2].to_bits();
        motion.tcp || motion.tilt.normal.is_some() || motion.says_way & Z != 0 || end.known & Z != 0 && !stays
    };
    counts(a) || counts(b)
}

/// What a cycle couples to the spindle.
#[derive(PartialEq)]
enum Coupling<'p> {
    Nothing,
    Tap,
    Other(&'p [Argument]),
}

fn coupling(process: &Process) -> Coupling<'_> {
    let words = process.get("cycle");
    match words.first() {
        None => Coupling::Nothing,
        Some(first) if TAPS.contains(&first.name.as_ref()) => Coupling::Tap,
        Some(_) => Coupling::Other(words),
    }
}

/// Whether both motions are made while a cycle taps.
pub(crate) fn are_taps(was: &Step, is: &Step) -> bool {
    [was, is].iter().all(|step| coupling(&step.process) == Coupling::Tap)
}

/// How far a tap moves in a turn of the spindle, mm; negative: a left-hand thread. `None`: not known.
fn pitch(step: &Step) -> Option<f64> {
    let words = step.process.get("cycle");
    let written = words
        .iter()
        .find(|word| word.name == "pitch")
        .and_then(|word| match word.value {
            Value::Number(value) => Some(value),
            _ => None,
        });
    let by_feed = match step.motion.feed {
        Feed::PerRevolution(pitch) => Some(pitch),
        Feed::PerMinute(feed) => step
            .motion
            .spindle_rpm
            .filter(|speed| *speed > 0.0)
            .map(|speed| feed / speed),
        _ => None,
    };
    let size = written.or(by_feed)?;
    let first = words.first()?;
    let left = match first.name.as_ref() {
        "G74" | "G84.3" => true,
        "G84" | "G84.2" => false,
        "tap" if written.is_some() => size < 0.0,
        "CYCLE84" => rigid_pitch(&first.to_string())? < 0.0,
        // the spindle turns as it does before
        _ => match step.process.get("spindle") {
            [only] if only.name == "M4" => true,
            [only] if only.name == "M3" => false,
            _ => return None,
        },
    };
    Some(if left { -size.abs() } else { size.abs() })
}

/// PIT of `CYCLE84=(RTP,RFP,SDIS,DP,DPR,DTB,SDAC,MPIT,PIT,...)`; its sign is the hand of the thread (Sinumerik 840D sl cycles manual, CYCLE84).
fn rigid_pitch(said: &str) -> Option<f64> {
    let arguments = said.split_once('(')?.1.split_once(')')?.0;
    arguments.split(',').nth(8)?.trim().parse().ok()
}

/// How the cycles of two motions differ, in the kind of what the spindle does with the feed.
fn unlike_cycles(was: &Step, is: &Step) -> Option<Unlike> {
    let say = |step: &Step| match step.process.get("cycle") {
        [] => "no cycle that couples the spindle".to_owned(),
        words => shown(words),
    };
    let found = |is_unknown: bool, [from, to]: [String; 2]| {
        Some(Unlike {
            key: "what the spindle does in the cycle".to_owned(),
            from,
            to,
            is_unknown,
        })
    };
    match (coupling(&was.process), coupling(&is.process)) {
        (Coupling::Nothing, Coupling::Nothing) => None,
        // the rapid to the hole has no pitch
        (Coupling::Tap, Coupling::Tap) if !was.motion.is_feed() && !is.motion.is_feed() => None,
        (Coupling::Tap, Coupling::Tap) => {
            let pitches = [pitch(was), pitch(is)];
            if let [Some(a), Some(b)] = pitches
                && same_number(a, b)
            {
                return None;
            }
            let known = pitches.iter().all(Option::is_some);
            let name = |step: &Step, pitch: Option<f64>| match pitch {
                Some(pitch) => format!("{} with a pitch of {pitch} mm", say(step)),
                None => format!("{} with an unknown pitch", say(step)),
            };
            found(!known, [name(was, pitches[0]), name(is, pitches[1])])
        }
        (Coupling::Other(a), Coupling::Other(b)) if a == b => None,
        (Coupling::Tap, Coupling::Nothing) | (Coupling::Nothing, Coupling::Tap) => found(false, [say(was), say(is)]),
        _ => found(true, [say(was), say(is)]),
    }
}

/// The first thing in effect that differs: a setting that both languages have in other words, or one that only one of them has.
pub(crate) fn unlike_across(was: &Step, is: &Step) -> Option<Unlike> {
    let shared = crate::process::unlike(&was.process, &is.process, true);
    if shared.as_ref().is_some_and(|found| !found.is_unknown) {
        return shared;
    }
    let cycle = unlike_cycles(was, is);
    if cycle.as_ref().is_some_and(|found| !found.is_unknown) {
        return cycle;
    }
    let own = || {
        let all = was.process.differences(&is.process).into_iter();
        let mut own = all.filter(|(key, ..)| !NAMED_OTHERWISE.contains(key) && !Process::SHARED.contains(key));
        own.next().map(|(key, from, to)| Unlike {
            key: format!("{key}, which each control has its own words for,"),
            from,
            to,
            is_unknown: true,
        })
    };
    shared.or(cycle).or_else(own)
}

/// Whether two programs are for controls that name what is in effect in other words, or read the same words otherwise. The general dialect of ISO 6983
/// is no control of its own.
pub fn are_two_controls(dialects: [&Dialect; 2]) -> bool {
    let [a, b] = dialects;
    let forms = a.lex.format != b.lex.format || a.quirks.user_names() != b.quirks.user_names();
    forms || a.name != b.name && [a, b].iter().all(|dialect| dialect.name != "iso-6983")
}

/// Whether words that are not modelled do the same on every control: ISO 6983-1, M00, M01, M06.
fn means_the_same(words: &[Argument]) -> bool {
    const WORDS: [&str; 4] = ["tool change", "M0", "M1", "M6"];
    matches!(words, [only] if WORDS.contains(&only.name.as_ref()))
}

/// Whether two things that both do in the same words are the same on two controls; what is in effect is compared where the tool moves.
pub(crate) fn same_words(sort: Sort, words: &[Argument], [was, is]: [&Process; 2]) -> Result<(), String> {
    if sort != Sort::End && !means_the_same(words) {
        return Err(format!(
            "both do `{}`, which is not modelled, and two controls may do different things with it",
            shown(words)
        ));
    }
    if stops(words) && was.message() != is.message() {
        return Err(format!(
            "the operator message at the stop differs: {} and {}",
            shown(was.message()),
            shown(is.message())
        ));
    }
    Ok(())
}

/// The verdict on two items of two controls: where one does something in words of its own, it is not known that the other does not do it too.
pub(crate) fn unless_own_words(verdict: Verdict, was: &Item, is: &Item) -> Verdict {
    let own =
        |item: &Item| matches!(item, Item::Happens { sort, words, .. } if *sort != Sort::End && !means_the_same(words));
    match verdict {
        Verdict::Differs(mut found) if own(was) || own(is) => {
            found.what += ", and whether the other control does the same in other words is not known";
            Verdict::Unknown(found)
        }
        verdict => verdict,
    }
}

/// Words whose whole effect is in the motions and in what is in effect with them: a tilted plane, tool centre point control, the spindle.
pub(crate) fn is_in_motions(words: &[Argument]) -> bool {
    const WORDS: [&str; 13] = [
        "CYCLE800", "G68.2", "G68.3", "G68.4", "G268", "G269", "G53.1", "G53.6", "G69", "TRAORI", "M3", "M4", "M5",
    ];
    words.first().is_some_and(|first| {
        let said = first.to_string();
        WORDS.contains(&said.split('=').next().unwrap_or_default())
    })
}
