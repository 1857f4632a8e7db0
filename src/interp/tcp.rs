//! Tool centre point control on and off.
use crate::codes::Found;
use crate::core::{LINEAR, ROTARY, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, LengthOf, Motion, Orientation, Position, TcpMistake};
use trunnion_dialect::{Action, Code, CodeKind};

impl<'d> Iso<'d> {
    /// Begins tool centre point control.
    pub(crate) fn tcp_on(&mut self, code: &'d Code, vectors: bool, report: &mut Report<'_>) {
        if !self.core.state.tool_axis.tcp() {
            self.core.forget_linear();
        }
        self.core.state.tool_axis.set_tcp(true);
        self.memory.tcp_used = true;
        self.core.state.tool_axis.set_vectors(vectors);
        self.memory.tcp_group = code.group.as_deref();
        self.frame_of_tip(report);
    }

    /// Ends tool centre point control: X Y Z change their meaning, and rotary axes that were set by a vector are not known.
    pub(crate) fn tcp_off(&mut self) {
        if self.core.state.tool_axis.tcp() {
            self.core.forget_linear();
        }
        self.core.state.tool_axis.set_tcp(false);
        self.core.state.tool_axis.set_vectors(false);
        self.core.state.orientation = Orientation::Words;
    }

    /// Whether the length that G169 H of an Okuma has brought stays after G170 is not stated by a source: it is unknown until G56 or G53.
    pub(crate) fn length_after_tip_control(&mut self) {
        if !self.core.dialect.quirks.user_task() {
            return;
        }
        let ends = |code: &&Code| code.action == Action::ToolLengthOff;
        if let Some(code) = self.core.dialect.codes().iter().find(ends) {
            self.core.unknown.begin(code, true);
            self.core.forget_linear();
            self.memory.tip_length_open = Some(code);
        }
    }

    /// Whether G169 of an Okuma without H guides the tip with the length in effect is not stated by a source (posts always write H): the length is unknown.
    /// The positions of the tip are those that the program says.
    pub(crate) fn tip_length_unstated(&mut self, found: &Found<'d>, report: &mut Report<'_>) {
        let what = format!("{} without H: whether the tool length in effect applies", found.code.id);
        report.fault(found.range, FaultKind::NotModelled { what });
        let length = &mut self.core.state.length;
        length.set_undeclared(length.mm().unwrap_or(0.0), LengthOf::Other);
    }

    /// A word whose end is hidden moves its axis. Of the length after tip control the first motion for which it matters says so.
    pub(crate) fn hidden_ends(&mut self, motion: &mut Motion, words: &Words, report: &mut Report<'_>) {
        let named = words.axes.given | words.axes.unread;
        motion.says_way |= named & !motion.end.known;
        let Some(code) = self.memory.tip_length_open else {
            return;
        };
        if !self.core.unknown.holds(code) {
            self.memory.tip_length_open = None;
        } else if !motion.machine_coordinates && named & LINEAR != 0 {
            self.memory.tip_length_open = None;
            let what = "G170: whether the tool length of G169 stays in effect (write G56 H or G53 after it)".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
    }

    /// G43 and G49 end a tool centre point control that is a code of their own group (G43.4).
    pub(crate) fn end_tcp_of_group(&mut self, code: &Code) {
        if self.core.state.tool_axis.tcp() && code.group.is_some() && code.group.as_deref() == self.memory.tcp_group {
            self.tcp_off();
        }
    }
}

impl Iso<'_> {
    /// Mistakes of tool centre point control in a motion with words of a block.
    pub(crate) fn tcp_mistakes(&mut self, motion: &Motion, words: &Words, report: &mut Report<'_>) {
        let range = words.first.unwrap_or_default();
        if let Some(mistake) = self.tcp_mistake(motion) {
            report.fault(range, FaultKind::TcpState(mistake));
        }
    }

    /// Whether the program has given no number of a tool length, or only that of another tool than the one in use.
    pub(crate) fn lacks_length_number(&self) -> bool {
        let given = self.memory.length_offset;
        given.is_none() || self.core.state.tool.number().is_some_and(|tool| given != Some(tool))
    }

    /// The mistake of a motion that is about to be emitted.
    pub(crate) fn tcp_mistake(&mut self, motion: &Motion) -> Option<TcpMistake> {
        let state = &self.core.state;
        if state.tool_axis.tcp() {
            if motion.machine_coordinates {
                return Some(TcpMistake::MachineCoordinates);
            }
            let without =
                motion.is_feed() && state.length.mm().is_none() && state.tool.number().is_some_and(|tool| tool > 0);
            let news = without && self.memory.tcp_length_reported != state.tool.number();
            if news {
                self.memory.tcp_length_reported = state.tool.number();
            }
            return news.then_some(TcpMistake::NoLength);
        }
        let turns = self.memory.tcp_used && motion.is_feed() && turned(&motion.start, &motion.end);
        turns.then_some(TcpMistake::RotaryWithout)
    }

    /// The tool in the spindle changes.
    pub(crate) fn tcp_at_tool_change(&mut self, report: &mut Report<'_>) {
        if self.core.state.tool_axis.tcp() {
            report.fault(report.whole(), FaultKind::TcpState(TcpMistake::ToolChange));
        }
        self.memory.tcp_used = self.core.state.tool_axis.tcp();
    }
}

/// Whether a rotary axis goes to another value, or to one from an unknown position.
fn turned(start: &Position, end: &Position) -> bool {
    let rotary = (0..9).filter(|axis| ROTARY & (1 << axis) != 0);
    rotary
        .filter_map(|axis| Some((axis, end.get(axis)?)))
        .any(|(axis, value)| start.get(axis) != Some(value))
}

/// The arguments of TRAORI: the first transformation, whose number may be left out, with the basic direction of the tool (its length does not
/// count) that the machine has at home, and no offsets of the rotary axes (Sinumerik 840D sl Programming Manual, Job Planning, 2009, p. 361).
fn is_first(inside: &str, along: [f64; 3]) -> bool {
    let said: Vec<&str> = inside.split(',').map(str::trim).collect();
    let number = |at: usize| match said.get(at).copied().unwrap_or_default() {
        "" => Some(0.0),
        text => text.parse::<f64>().ok(),
    };
    let first = matches!(said[0], "" | "1");
    let basic = said
        .get(1..4)
        .is_some_and(|basic| basic.iter().any(|word| !word.is_empty()));
    let same = || {
        let tool = [number(1)?, number(2)?, number(3)?];
        let dot: f64 = tool.iter().zip(along).map(|(a, b)| a * b).sum();
        let across = [0, 1, 2].map(|axis| tool[axis] - dot * along[axis]);
        Some(dot > 0.0 && across.iter().all(|value| value.abs() <= 1e-9 * dot))
    };
    let still = number(4) == Some(0.0) && number(5) == Some(0.0);
    first && said.len() <= 6 && still && (!basic || same() == Some(true))
}

/// Forms of a code for tool centre point control that are not modelled: TRAORI of another transformation than the first, with another direction of
/// the tool or with offsets; G43.4 with P, Q or L, which choose modes.
pub(crate) fn tcp_variant(found: &Found<'_>, words: &Words, along: [f64; 3], report: &Report<'_>) -> Option<String> {
    let code = &found.code.id;
    if found.code.kind == CodeKind::Name {
        let text = report.program.text(found.range);
        let inside = text.split_once('(')?.1.trim_end_matches(')').trim();
        return (found.with_arguments && !is_first(inside, along)).then(|| format!("{code}({inside})"));
    }
    let letter = *b"PQL"
        .iter()
        .find(|letter| words.letters & (1 << (**letter - b'A')) != 0)?;
    Some(format!("{code} with {}", letter as char))
}
