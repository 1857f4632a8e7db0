//! How a PLANE block turns the rotary axes: MOVE, TURN or STAY, the retract before the turn, the feed, and which solution.
//!
//! MB leads the tool back along the tool axis before the axes turn, MB MAX to just before the limit. DIST (ABST in German programs) shifts the
//! centre of the turn from the tip along the tool, so that the tip does not stay where it is. F is the contour speed of the turn. Sources: TNC 620
//! 81760x, 10/2017, p. 556; TNC 320 34055x-06, p. 366.
use super::Klartext;
use super::values::Value;
use super::words::{Said, Word, Words};
use crate::core::Report;
use crate::{Feed, MotionKind, Posture, Refusal, Swivel};

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(super) struct Positioning {
    /// `None`: STAY, or none of the three words.
    pub(super) swivel: Option<Swivel>,
    pub(super) posture: Posture,
    /// How the axes turn; unknown for F, whose split between the axes no source states.
    pub(super) feed: Feed,
    /// TABLE ROT.
    pub(super) turns_table: bool,
}

/// The words of a PLANE block after its form: the values of the form by name, and the rest.
pub(super) type PlaneWords = (Vec<(String, Value)>, Positioning);

impl Klartext<'_> {
    /// Reads the words of a PLANE block after its form, and leads the tool back where MB says so.
    pub(super) fn plane_words(&mut self, form: &str, words: &mut Words<'_>, report: &mut Report<'_>) -> PlaneWords {
        let mut numbers = Vec::new();
        let mut positioning = Positioning {
            swivel: None,
            posture: Posture::ByRule,
            feed: Feed::Unknown,
            turns_table: false,
        };
        let (mut says_how, mut says_feed, mut symmetric, mut at_limit) = (false, false, false, false);
        let (mut retract, mut shift) = (None, Some(0.0));
        while let Some(word) = words.next() {
            says_how |= matches!(word.name(), b"MOVE" | b"TURN" | b"STAY");
            says_feed |= matches!(word.name(), b"F" | b"FMAX" | b"FAUTO");
            match word.name() {
                b"MOVE" => positioning.swivel = Some(Swivel::TipStays),
                b"TURN" => positioning.swivel = Some(Swivel::AxesStay),
                b"STAY" => positioning.swivel = None,
                b"SEQ" => solution(&word, &mut positioning, report),
                b"FMAX" => positioning.feed = Feed::Rapid,
                b"MB" => {
                    self.memory.unfollowed = true;
                    // MAX is the limit of the axis, which is not known here
                    let most = word.value == Said::Nothing && words.takes_word("MAX");
                    at_limit |= most;
                    retract = Some(if most { None } else { self.said(word.value, report) });
                }
                b"DIST" | b"ABST" => (shift, self.memory.unfollowed) = (self.said(word.value, report), true),
                b"F" | b"COORD" => self.memory.unfollowed = true,
                b"TABLE" => (positioning.turns_table, self.memory.unfollowed) = (true, true),
                b"SYM" => symmetric = true,
                // where the swivel leaves no free axis it makes no difference
                b"ROT" | b"MAX" | b"AUTO" | b"FAUTO" => {}
                name if word.value == Said::Nothing || !is_value(form, name) => {
                    let what = String::from_utf8_lossy(name);
                    Self::not_modelled(format!("PLANE {form}: {what}"), report);
                }
                name => {
                    let name = String::from_utf8_lossy(name).into_owned();
                    numbers.push((name, self.said(word.value, report)));
                }
            }
        }
        // without MOVE, TURN or STAY, or without a feed, it is up to the control
        self.memory.unfollowed |= !says_how || positioning.swivel.is_some() && !says_feed;
        if symmetric {
            self.not_modelled_once("SYM: the symmetric solution", report);
        }
        if positioning.swivel.is_none() {
            return (numbers, positioning);
        }
        if positioning.swivel == Some(Swivel::TipStays) && shift != Some(0.0) {
            self.not_modelled_once("PLANE MOVE with DIST: the way of the linear axes", report);
            positioning.swivel = Some(Swivel::AxesLost);
        }
        if at_limit {
            self.not_modelled_once(
                "PLANE with MB MAX: where the retract to the limit of the axis ends",
                report,
            );
        }
        if let Some(distance) = retract {
            let unit = self.core.state.coordinates.unit_mm();
            let distance = distance.map(|distance| distance * unit);
            self.retract(distance, MotionKind::Rapid, positioning.feed, report);
        }
        (numbers, positioning)
    }
}

/// SEQ: which of two solutions.
fn solution(word: &Word<'_>, positioning: &mut Positioning, report: &mut Report<'_>) {
    match word.value {
        Said::Sign(true) => positioning.posture = Posture::Lower,
        Said::Sign(false) => positioning.posture = Posture::Higher,
        _ => Klartext::rejected(Refusal::Syntax, "SEQ needs + or -", report),
    }
}

/// Whether a form has values of this name. Those of POINTS are read as P; the axes of AXIAL are looked at there.
fn is_value(form: &str, name: &[u8]) -> bool {
    let of = |names: &[&str]| names.iter().any(|known| name == known.as_bytes());
    match form {
        "SPATIAL" | "RELATIV" | "RELATIVE" => of(&["SPA", "SPB", "SPC"]),
        "EULER" => of(&["EULPR", "EULNU", "EULROT"]),
        "VECTOR" => of(&["BX", "BY", "BZ", "NX", "NY", "NZ"]),
        "RESET" => false,
        _ => true,
    }
}
