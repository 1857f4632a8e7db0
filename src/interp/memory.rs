//! What an interpreter remembers beside the modal state: what was already reported, and what made positions unknown.
use std::sync::Arc;
use trunnion_dialect::{Action, Code};
use trunnion_syntax::BlockId;

use crate::Tool;

/// The tool that T has chosen and M6 will bring.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Chosen {
    /// No T yet.
    #[default]
    Nothing,
    Number(u32),
    Named(Arc<str>),
    /// T with a value that is not evaluated.
    Unread,
}

/// A code that made positions unknown, until a code of its group ends it.
#[derive(Clone, Copy, Debug)]
struct Frame<'d> {
    /// The group, or the code itself where it has none.
    key: &'d str,
    /// Any modelled code of the group ends it; else only a frame reset.
    any_code_ends: bool,
    /// Rotary coordinates are hidden too.
    rotary: bool,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory<'d> {
    hidden: Vec<Frame<'d>>,
    /// Data of tools were written by the program: no length is known.
    pub(crate) tool_data_written: bool,
    /// How many times everything modal became unknown.
    pub(crate) losses: u64,
    /// Tool centre point control was on since the tool came into the spindle.
    pub(crate) tcp_used: bool,
    /// The tool for which a missing length under tool centre point control was reported.
    pub(crate) tcp_length_said: Option<u32>,
    /// The group of the code that switched tool centre point control on.
    pub(crate) tcp_group: Option<&'d str>,
    /// How the axes run between positions under a transformation.
    pub(crate) travel: crate::travel::Travel,
    /// STAT in force.
    pub(crate) status: Option<u16>,
    /// F has a value that is not evaluated.
    pub(crate) feed_unread: bool,
    /// A turning cycle's block and the last of its contour, which the cycle has run.
    pub(crate) passed_over: Option<(u32, u32)>,
    /// The contour of a turning cycle is read.
    pub(crate) in_contour: bool,
    /// First blocks of contours whose faults were reported.
    pub(crate) contours_told: Vec<u32>,
    /// What G10.9 says of X: a diameter, or a radius.
    pub(crate) diameter: Option<bool>,
    /// S is a cutting speed (G96).
    pub(crate) surface_speed: bool,
    pub(crate) compensation_said: bool,
    pub(crate) prepared: Chosen,
    pub(crate) in_spindle: Chosen,
    /// A tool vector has turned the rotary axes.
    pub(crate) led_by_vector: bool,
    /// It was reported that no code loads the tool that T selected.
    pub(crate) tool_never_changed: bool,
    /// Cutting edge in force (D); `None` before the first.
    pub(crate) edge: Option<u32>,
    /// Last H.
    pub(crate) length_offset: Option<u32>,
    pub(crate) before_cycle: Option<Action>,
    /// APT: the tool shape that CUTTER gives.
    pub(crate) cutter: Option<Tool>,
    /// APT: a motion was made with it.
    pub(crate) cutter_used: bool,
    /// Tools that the program's comments declare.
    pub(crate) declared: Vec<Tool>,
    pub(crate) directives_read: bool,
    lengths_said: Vec<Box<str>>,
    offsets_said: Vec<Box<str>>,
    /// Coordinates that the program shifts and turns.
    pub(crate) frames: crate::frames::Frames,
    /// The drilling or turning cycle in force.
    pub(crate) cycle: crate::cycles::Cycle,
    /// Rounded and cut off corners.
    pub(crate) corners: crate::corner::Corners,
    /// Cutter radius compensation in the plane.
    pub(crate) compensation: crate::compensation::Compensation,
    /// Variables of a Sinumerik program.
    pub(crate) own: crate::own::Own,
    /// What the program does beside its motions.
    pub(crate) effects: crate::effects::Effects,
    /// Motions of the block in hand beside its last.
    pub(crate) out: Vec<crate::Motion>,
    /// The last block with content, for a missing program end.
    pub(crate) last_content: Option<BlockId>,
    pub(crate) percent_seen: bool,
    /// A code or character that ends the program was seen.
    pub(crate) proper_end: bool,
}

impl<'d> Memory<'d> {
    fn key(code: &'d Code) -> &'d str {
        code.group.as_deref().unwrap_or(&code.id)
    }
    /// From here on positions are unknown.
    pub(crate) fn begin_frame(&mut self, code: &'d Code, any_code_ends: bool) {
        let key = Self::key(code);
        if !self.hidden.iter().any(|frame| frame.key == key) {
            self.hidden.push(Frame {
                key,
                any_code_ends,
                rotary: false,
            });
        }
    }
    /// The frame that the code has begun moves rotary coordinates too.
    pub(crate) fn frame_turns_axes(&mut self, code: &Code) {
        let key = code.group.as_deref().unwrap_or(&code.id);
        for frame in self.hidden.iter_mut().filter(|frame| frame.key == key) {
            frame.rotary = true;
        }
    }
    /// From here on positions, rotary ones too, are unknown until the end of the program.
    pub(crate) fn hide_for_good(&mut self) {
        // no group has a name with a blank in it
        self.hidden.retain(|frame| frame.key != "for good");
        self.hidden.push(Frame {
            key: "for good",
            any_code_ends: false,
            rotary: true,
        });
    }
    /// Whether rotary coordinates say nothing about the machine.
    pub(crate) fn rotary_unknown(&self) -> bool {
        self.hidden.iter().any(|frame| frame.rotary)
    }
    /// Ends the frame of a code's group; whether there was one.
    pub(crate) fn end_frame(&mut self, code: &Code) -> bool {
        let key = code.group.as_deref().unwrap_or(&code.id);
        let before = self.hidden.len();
        self.hidden.retain(|frame| frame.key != key);
        before != self.hidden.len()
    }
    /// A modelled code of a group makes known again what another code of the group made unknown.
    #[inline]
    pub(crate) fn known_again(&mut self, code: &Code) {
        if !self.hidden.is_empty() && !matches!(code.action, Action::NotModelled | Action::FrameChange) {
            let key = code.group.as_deref();
            self.hidden
                .retain(|frame| !(frame.any_code_ends && Some(frame.key) == key));
        }
    }
    pub(crate) fn frame_unknown(&self) -> bool {
        !self.hidden.is_empty()
    }
    /// Whether this is the first time that the tool's length is found missing.
    pub(crate) fn length_is_news(&mut self, tool: &str) -> bool {
        news(&mut self.lengths_said, tool)
    }
    /// Whether this is the first time that the work offset is found missing.
    pub(crate) fn offset_is_news(&mut self, name: &str) -> bool {
        news(&mut self.offsets_said, name)
    }
}

fn news(said: &mut Vec<Box<str>>, what: &str) -> bool {
    let new = !said.iter().any(|known| &**known == what);
    if new {
        said.push(what.into());
    }
    new
}
