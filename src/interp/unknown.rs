//! Codes that are not modelled and made coordinates unknown, until a code of their group ends them.
use trunnion_dialect::{Action, Code};

/// A code that made positions unknown.
#[derive(Clone, Copy, Debug)]
struct Frame<'d> {
    /// The group, or the code itself where it has none.
    key: &'d str,
    /// Any modelled code of the group ends it; else only a frame reset.
    any_code_ends: bool,
    /// Rotary coordinates are hidden too.
    rotary: bool,
}

/// No group name contains a blank.
const FOR_GOOD: &str = "for good";

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unknown<'d> {
    frames: Vec<Frame<'d>>,
}

fn key(code: &Code) -> &str {
    code.group.as_deref().unwrap_or(&code.id)
}

impl<'d> Unknown<'d> {
    /// From here on positions are unknown.
    pub(crate) fn begin(&mut self, code: &'d Code, any_code_ends: bool) {
        let key = key(code);
        if !self.frames.iter().any(|frame| frame.key == key) {
            self.frames.push(Frame {
                key,
                any_code_ends,
                rotary: false,
            });
        }
    }
    /// The frame that the code has begun moves rotary coordinates too.
    pub(crate) fn turns_axes(&mut self, code: &Code) {
        let key = key(code);
        for frame in self.frames.iter_mut().filter(|frame| frame.key == key) {
            frame.rotary = true;
        }
    }
    /// From here on positions, rotary ones too, are unknown until the end of the program.
    pub(crate) fn for_good(&mut self) {
        self.frames.retain(|frame| frame.key != FOR_GOOD);
        self.frames.push(Frame {
            key: FOR_GOOD,
            any_code_ends: false,
            rotary: true,
        });
    }
    /// Whether rotary coordinates say nothing about the machine.
    pub(crate) fn hides_rotary(&self) -> bool {
        self.frames.iter().any(|frame| frame.rotary)
    }
    /// Ends the frame of a code's group; whether there was one.
    pub(crate) fn end(&mut self, code: &Code) -> bool {
        let key = key(code);
        let before = self.frames.len();
        self.frames.retain(|frame| frame.key != key);
        before != self.frames.len()
    }
    /// A modelled code of a group makes known again what another code of the group made unknown.
    #[inline]
    pub(crate) fn restore_known(&mut self, code: &Code) {
        if !self.frames.is_empty() && !matches!(code.action, Action::NotModelled | Action::FrameChange) {
            let key = code.group.as_deref();
            self.frames
                .retain(|frame| !(frame.any_code_ends && Some(frame.key) == key));
        }
    }
    /// Whether positions are unknown because of the code or of one of its group.
    pub(crate) fn holds(&self, code: &Code) -> bool {
        self.frames.iter().any(|frame| frame.key == key(code))
    }
    /// Whether any position is unknown.
    #[inline]
    pub(crate) fn any(&self) -> bool {
        !self.frames.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::Unknown;

    #[test]
    fn a_frame_ends_with_a_code_of_its_group() {
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let (length, rapid) = (dialect.g(490).expect("G49"), dialect.g(0).expect("G0"));
        let mut unknown = Unknown::default();
        unknown.begin(length, true);
        unknown.restore_known(rapid);
        assert!(unknown.any() && !unknown.hides_rotary());
        unknown.restore_known(length);
        assert!(!unknown.any());
        unknown.begin(length, false);
        unknown.turns_axes(length);
        unknown.restore_known(length);
        assert!(unknown.hides_rotary(), "only a reset ends it");
        assert!(unknown.end(length) && !unknown.end(length) && !unknown.any());
    }

    #[test]
    fn what_is_lost_for_good_stays_lost() {
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let mut unknown = Unknown::default();
        unknown.for_good();
        for code in dialect.codes() {
            unknown.restore_known(code);
            unknown.end(code);
        }
        assert!(unknown.any() && unknown.hides_rotary());
    }
}
