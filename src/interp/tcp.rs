//! Tool centre point control on and off.
use crate::Orientation;
use crate::codes::Found;
use crate::run::{Interpreter, Report};
use crate::words::Words;
use trunnion_dialect::{Code, CodeKind};

impl<'d> Interpreter<'d> {
    /// Begins tool centre point control.
    pub(crate) fn tcp_on(&mut self, code: &'d Code, vectors: bool) {
        if !self.state.tcp {
            self.forget_linear();
        }
        self.state.tcp = true;
        self.state.vector_mode = vectors;
        self.memory.tcp_group = code.group.as_deref();
    }

    /// Ends tool centre point control: X Y Z change their meaning, and rotary axes that were set by a vector are not known.
    pub(crate) fn tcp_off(&mut self) {
        if self.state.tcp {
            self.forget_linear();
        }
        self.state.tcp = false;
        self.state.vector_mode = false;
        self.state.orientation = Orientation::Words;
    }

    /// G43 and G49 end a tool centre point control that is a code of their own group (G43.4).
    pub(crate) fn end_tcp_of_group(&mut self, code: &Code) {
        if self.state.tcp && code.group.is_some() && code.group.as_deref() == self.memory.tcp_group {
            self.tcp_off();
        }
    }
}

/// What of a code for tool centre point control is not modelled: TRAORI of another transformation than the first, or with further
/// arguments; G43.4 with P, Q or L, which choose modes.
pub(crate) fn tcp_variant(found: &Found<'_>, words: &Words, report: &Report<'_>) -> Option<String> {
    let code = &found.code.id;
    if found.code.kind == CodeKind::Name {
        let text = report.program.text(found.range);
        let inside = text.split_once('(')?.1.trim_end_matches(')').trim();
        return (found.with_arguments && inside != "1").then(|| format!("{code}({inside})"));
    }
    let letter = *b"PQL"
        .iter()
        .find(|letter| words.letters & (1 << (**letter - b'A')) != 0)?;
    Some(format!("{code} with {}", letter as char))
}
