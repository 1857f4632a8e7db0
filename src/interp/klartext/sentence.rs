//! What a block begins with, and M codes.
use super::Klartext;
use super::flow::Request;
use super::path::Path;
use super::path_words::{FeedSaid, PathWords, is_no_number};
use super::reason::Reason;
use super::words::{Said, Words};
use crate::core::Report;
use crate::{FaultKind, FeedMode, Refusal};
use trunnion_syntax::TextRange;

/// First words of FUNCTION blocks after which coordinates mean what they meant: dwells and pulses, files, the counter, monitoring.
const LEAVES_COORDINATES: [&str; 6] = ["FEED", "S-PULSE", "FILE", "COUNT", "DCM", "LIFTOFF"];

/// Words of positioning blocks that have three letters or more, and no value.
const WORDS: [&[u8]; 4] = [b"FMAX", b"FAUTO", b"LEN", b"CCA"];

/// Whether a name that no statement has can only be meant as one: it is no word of a positioning block.
fn is_statement(name: &[u8]) -> bool {
    name.len() >= 3 && name.iter().all(u8::is_ascii_alphabetic) && !WORDS.contains(&name) && !is_no_number(name)
}

impl Klartext<'_> {
    /// Runs the words of one block.
    pub(crate) fn sentence(&mut self, text: &[u8], report: &mut Report<'_>) -> Request {
        let mut words = Words::new(text);
        let Some(first) = words.next() else {
            return Request::Next;
        };
        if let Some(place) = super::stray::stray(text) {
            self.unknown_word(text, place, report);
        }
        match first.name() {
            b"L" => self.path_block(Path::Line, &mut words, report),
            b"LN" => self.path_block(Path::Vectors, &mut words, report),
            // with a value it is the axis
            b"C" if first.value == Said::Nothing => self.path_block(Path::AboutPole, &mut words, report),
            b"CR" => self.path_block(Path::Radius, &mut words, report),
            b"CT" => self.path_block(Path::Tangent, &mut words, report),
            b"LP" => self.path_block(Path::PolarLine, &mut words, report),
            b"CP" => self.path_block(Path::PolarArc, &mut words, report),
            b"CTP" => self.path_block(Path::PolarTangent, &mut words, report),
            b"CC" => self.pole(&mut words, report),
            b"RND" => self.round(first.value, &mut words, report),
            b"CHF" => self.chamfer(first.value, &mut words, report),
            b"APPR" => self.approach(&mut words, report),
            b"DEP" => self.depart(&mut words, report),
            b"FL" | b"FLT" | b"FC" | b"FCT" | b"FPOL" | b"FSELECT" => self.free_contour(first.name(), report),
            b"TOOL" => self.tool_block(&mut words, report),
            b"CYCL" | b"CYCLE" => self.cycle_block(&mut words, report),
            b"PLANE" => self.plane(&mut words, report),
            b"FUNCTION" => self.function_block(&mut words, report),
            b"BEGIN" => self.begin(&mut words, report),
            b"END" if words.clone().next().is_none_or(|word| word.is("PGM")) => return Request::EndOfProgram,
            b"LBL" => return self.label(first.value, &mut words),
            b"CALL" => return self.call(&mut words, report),
            b"SEL" => self.select(&mut words, report),
            b"FN" => return self.function_of_parameters(first.value, &mut words, report),
            b"" if matches!(first.value, Said::Parameter(..)) => return self.assignment(text, report),
            b"STOP" => {
                self.path_block(Path::None, &mut words, report);
                // a STOP block interrupts the run; no source says whether the spindle stops, as it does at M0
                self.core.state.spindle.leave_to_machine();
            }
            b"PATTERN" => self.pattern(&mut words, report),
            // the blank, and values for cycles that say PREDEF, which is unknown where it stands
            b"BLK" | b"GLOBAL" => {}
            b"SPL" => {
                self.flush(report);
                Self::not_modelled("SPL: a spline", report);
                self.core.forget_position();
                self.unknown_motion(report);
            }
            b"TRANS" if words.takes_word("DATUM") => self.trans_datum(&mut words, report),
            b"TCH" | b"TRANS" | b"PRESET" | b"CONTOUR" | b"DECLARE" => {
                self.not_followed(first.name(), report);
            }
            b"IF" | b"ELSE" | b"ELSEIF" | b"END" | b"WHILE" | b"FOR" | b"BREAK" | b"CONTINUE" => {
                return Self::undecided("IF, WHILE and FOR of newer controls", report);
            }
            // a misspelt statement: TOL CALL
            name if is_statement(name) && first.value == Said::Nothing => {
                let end = words.text.len();
                self.unknown_word(words.text, (first.start, end), report);
            }
            // a block of words alone: M3, X+10 R0 F100
            _ => {
                words.at = 0;
                let found = self.path_words(&mut words, report);
                if found.axes_given() > 1 {
                    // a block without a path function moves along one axis: whether the control takes several is not documented
                    Self::not_modelled("several axes in a block without L", report);
                }
                self.run_path(Path::None, &found, report);
            }
        }
        if self.core.state.ended {
            if self.is_called() {
                let what = "M2 or M30 in a called program, which must not have them";
                self.not_modelled_once(what, report);
            }
            Request::EndOfProgram
        } else {
            Request::Next
        }
    }

    /// A part of a block that its statement does not have.
    fn unknown_word(&mut self, text: &[u8], (from, to): (usize, usize), report: &mut Report<'_>) {
        self.memory.unfollowed = true;
        let whole = report.whole();
        // where nothing is left out of the text, its bytes are those of the file
        let range = if whole.end - whole.start == text.len() as u32 {
            TextRange::new(whole.start + from as u32, whole.start + to as u32)
        } else {
            whole
        };
        report.fault(range, FaultKind::UnknownWord);
    }

    fn begin(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let last = words.text.trim_ascii_end().rsplit(u8::is_ascii_whitespace).next();
        match last.map(<[u8]>::to_ascii_uppercase).as_deref() {
            Some(b"MM") => self.core.state.units(1.0, 1.0),
            // F counts tenths of an inch
            Some(b"INCH") => self.core.state.units(25.4, 2.54),
            _ => Self::rejected(Refusal::Syntax, "BEGIN PGM names no unit: MM or INCH", report),
        }
    }

    /// A block whose effect on positions is not known.
    fn not_followed(&mut self, name: &[u8], report: &mut Report<'_>) {
        let name = String::from_utf8_lossy(name).into_owned();
        self.flush(report);
        let text = report.program.text(report.whole());
        let digits = |byte: char| byte.is_ascii_digit() || byte.is_whitespace();
        let start: Vec<&str> = text.trim_start_matches(digits).split_whitespace().take(2).collect();
        Self::not_modelled(start.join(" "), report);
        match name.as_str() {
            "DECLARE" | "CONTOUR" => {}
            "TCH" => {
                self.core.forget_position();
                self.memory.parameters.lose();
            }
            // cycle 7 ends a shift, but no rotation, mirror image or scaling
            "TRANS" | "PRESET" => self.lose(match start.get(1).map(|word| word.to_ascii_uppercase()).as_deref() {
                Some("SELECT") => Reason::Preset,
                _ => Reason::Other,
            }),
            _ => {
                self.core.forget_everything();
                self.memory.parameters.lose();
            }
        }
    }

    fn free_contour(&mut self, name: &[u8], report: &mut Report<'_>) {
        self.flush(report);
        let name = String::from_utf8_lossy(name).into_owned();
        Self::not_modelled(format!("{name}: free contour programming"), report);
        if name != "FPOL" && name != "FSELECT" {
            self.unknown_motion(report);
        }
    }

    /// FUNCTION DWELL TIME 10: seconds; REV: turns of the spindle (NC-PB/gEdit, docs/planning/syntax/syntax-heidenhain.md, 4.1).
    fn function_dwell(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        let kind = words.next();
        let said = match &kind {
            Some(word) if word.value == Said::Nothing => {
                words.blanks();
                words.value()
            }
            Some(word) => word.value,
            None => Said::Nothing,
        };
        match kind {
            Some(word) if word.is("TIME") => {
                let seconds = self.said(said, report);
                let seconds = Self::from_zero("the time of a dwell", seconds, report);
                self.dwell(seconds, report);
            }
            Some(word) if word.is("REV") => {
                self.not_modelled_once("FUNCTION DWELL REV: how long its turns take", report);
                self.dwell(None, report);
            }
            _ => Self::rejected(Refusal::MissingWord, "FUNCTION DWELL needs TIME or REV", report),
        }
    }

    /// FUNCTION TCPM, FUNCTION RESET TCPM.
    fn function_block(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        if words.takes_word("DWELL") {
            return self.function_dwell(words, report);
        }
        let text = words.rest().to_ascii_uppercase();
        let has = |word: &str| {
            text.split(u8::is_ascii_whitespace)
                .any(|found| found == word.as_bytes())
        };
        if has("RESET") && has("TCPM") {
            return self.guide_tip(false, report);
        }
        if !has("TCPM") {
            let what = String::from_utf8_lossy(&text).trim().to_owned();
            if has("MODE") && has("MILL") {
                return self.found(Reason::Turning);
            }
            self.not_modelled_once(&format!("FUNCTION {what}"), report);
            let first = what.split_ascii_whitespace().next().unwrap_or_default();
            if first == "MODE" {
                self.flush(report);
                self.lose(Reason::Turning);
            } else if !LEAVES_COORDINATES.contains(&first) && !has("OFF") && !has("DISPLAY") {
                self.flush(report);
                self.lose(Reason::Other);
            }
            return;
        }
        self.guide_tip(true, report);
        if has("VECTOR") {
            self.core.state.tool_axis.set_great_circle(Some(true));
        } else if has("PATHCTRL") {
            self.core.state.tool_axis.set_great_circle(Some(false));
        }
        self.memory.spatial = has("SPAT");
        self.memory.other_point = has("CENTER-CENTER") || has("TIP-CENTER");
        if self.memory.spatial {
            Self::not_modelled("FUNCTION TCPM AXIS SPAT: rotary words are spatial angles", report);
        }
        if self.memory.other_point {
            Self::not_modelled("FUNCTION TCPM REFPNT: the programmed point is not the tip", report);
        }
        if has("CONT") {
            self.not_modelled_once("FUNCTION TCPM F CONT: what F means", report);
        }
    }

    /// M128, FUNCTION TCPM: X Y Z change their meaning.
    pub(crate) fn guide_tip(&mut self, on: bool, report: &mut Report<'_>) {
        self.flush(report);
        if self.core.state.tool_axis.tcp() != on {
            self.core.forget_linear();
            if !on {
                self.core.state.orientation = crate::Orientation::Words;
            }
        }
        self.core.state.tool_axis.set_tcp(on);
        (self.memory.spatial, self.memory.other_point) = (false, false);
        if on && self.is_tilted() {
            // the tool is led in the plane's coordinates: rotary words are still those of the axes
            self.not_modelled_once("M128 in a tilted plane", report);
        }
        self.review_scaling(report);
    }

    /// Codes that act before the block's motion.
    pub(crate) fn codes_before(&mut self, words: &PathWords, report: &mut Report<'_>) {
        self.contradicting_codes(words, report);
        for &code in words.codes() {
            match code {
                3 | 4 | 13 | 14 => self.core.state.spindle.switch(true),
                6 => {
                    self.core.relocate(None);
                    self.core.forget_linear();
                }
                89 => {
                    self.memory.runs_after_each = true;
                    let what = "M89: a machine parameter decides whether it calls the cycle (MP 7440 of the TNC 426)";
                    self.not_modelled_once(what, report);
                }
                126 => self.memory.shortest = true,
                127 => self.memory.shortest = false,
                128 => {
                    // the highest feed of the compensating motions is a setting of its own
                    let is_number = matches!(words.own_feed, FeedSaid::Nothing | FeedSaid::Value(_));
                    self.memory.unfollowed |= !is_number;
                    self.guide_tip(true, report);
                }
                129 => self.guide_tip(false, report),
                136 => self.feed_per_turn(true),
                137 => self.feed_per_turn(false),
                114 | 144 => {
                    Self::not_modelled(format!("M{code}"), report);
                    self.lose(Reason::Plane);
                }
                115 | 145 => self.found(Reason::Plane),
                130 | 143 => {
                    Self::not_modelled(format!("M{code}"), report);
                    self.core.forget_linear();
                }
                138 => self.not_modelled_once("M138: which axes tilting turns", report),
                103 | 109 | 110 | 116 => self.not_modelled_once(&format!("M{code}: the feed"), report),
                94 => {
                    self.not_modelled_once("M94: the turns of rotary axes after it", report);
                    let all = words.reduced == 0;
                    self.core.state.position.known &= !if all { crate::core::ROTARY } else { words.reduced };
                }
                _ => {
                    let known = self.core.dialect.m(code * 10).is_some();
                    if !known && self.memory.said.first(&format!("M{code}")) {
                        // all others are the machine builder's
                        let range = m_range(code, report);
                        report.fault(range, FaultKind::UnknownCode { machine_builder: true });
                    }
                }
            }
        }
    }

    /// M136, M137.
    fn feed_per_turn(&mut self, on: bool) {
        self.memory.per_turn = on;
        let mode = if on {
            FeedMode::PerRevolution
        } else {
            FeedMode::PerMinute
        };
        self.core.state.feed.switch_mode(mode);
    }

    /// Codes that act when the block is done.
    pub(crate) fn codes_after(&mut self, words: &PathWords) {
        for &code in words.codes() {
            match code {
                // M0 stops the spindle and the coolant too (TNC 155 programming manual, p. 15; TNC 640 user's manual, M functions)
                0 | 5 => self.core.state.spindle.switch(false),
                // where the operator has chosen the optional stop, so does M1; M6 stops the spindle as well, and the program where a machine
                // parameter says so (helmancnc.com, Heidenhain M codes; TNC 155 programming manual, p. 15)
                1 | 6 => self.core.state.spindle.leave_to_machine(),
                2 | 30 => {
                    self.core.state.spindle.switch(false);
                    self.core.state.ended = true;
                    self.core.proper_end = true;
                }
                _ => {}
            }
        }
        if Self::spindle_is_unclear(words) {
            self.core.state.spindle.switch(true);
            self.core.state.spindle.leave_to_machine();
        }
    }

    /// F of a block: its feed is a rapid for FMAX; all others stay.
    pub(crate) fn take_feed(&mut self, said: FeedSaid, report: &mut Report<'_>) -> bool {
        let unit = self.core.state.feed.unit_mm();
        let (value, unread) = match said {
            FeedSaid::Nothing => return false,
            FeedSaid::Rapid => return true,
            FeedSaid::Auto => (self.memory.tool_feed, self.memory.tool_feed_unread),
            FeedSaid::Value(value) => (value.map(|value| value * unit), value.is_none()),
            FeedSaid::PerTurn(value) => {
                self.core.state.feed.switch_mode(FeedMode::PerRevolution);
                (
                    value.map(|value| value * self.core.state.coordinates.unit_mm()),
                    value.is_none(),
                )
            }
            FeedSaid::PerTooth => {
                self.not_modelled_once("FZ: the number of teeth is in the tool table", report);
                (None, true)
            }
        };
        let per_turn = matches!(said, FeedSaid::PerTurn(_));
        if !per_turn && !self.memory.per_turn && self.core.state.feed.mode() == FeedMode::PerRevolution {
            // FU ends with the next F
            self.core.state.feed.switch_mode(FeedMode::PerMinute);
        }
        self.core.state.feed.set(value);
        self.core.feed_unread = unread;
        false
    }
}

/// Where an M code stands in its block.
fn m_range(code: u32, report: &Report<'_>) -> TextRange {
    let whole = report.whole();
    // as bytes: what is no text would move the place
    let text = report.program.source().get(whole.as_usize()).unwrap_or_default();
    let name = format!("M{code}");
    let found = text.windows(name.len()).position(|found| found == name.as_bytes());
    let found = found.map(|at| whole.start + at as u32);
    found.map_or_else(TextRange::default, |start| {
        TextRange::new(start, start + name.len() as u32)
    })
}
