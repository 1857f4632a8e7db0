//! Words in machine coordinates: G53, SUPA, G16 H0.
use crate::codes::BlockCodes;
use crate::core::{LINEAR, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Motion, MotionKind, Position};
use trunnion_dialect::Macros;

impl Iso<'_> {
    /// G53 of a Fanuc positions at rapid, whatever motion code is in effect (Series 30i operator's manual, machine coordinate system).
    pub(crate) fn rapid_to_machine(&self, block: &BlockCodes) -> bool {
        block.machine_coordinates && self.core.dialect.quirks.macros == Macros::Fanuc
    }

    /// G53 with distances, of G91 or U and W: a Fanuc ignores the code, and the words may then be distances (Series 30i operator's manual, machine coordinate system; Mitsubishi
    /// M700V programming manual, p. 508: incremental). Where the axes go is unknown.
    fn machine_words_incremental(
        &mut self,
        words: &Words,
        kind: &mut MotionKind,
        end: &mut Position,
        report: &mut Report<'_>,
    ) {
        let named = words.axes.given | words.axes.unread;
        *kind = MotionKind::Unknown;
        end.known &= !named;
        self.core.state.position.known &= !named;
        let what = if self.core.state.coordinates.incremental() {
            "G53 under G91: write G90 before it"
        } else {
            "G53 with distances: name X and Z"
        };
        let what = what.to_owned();
        report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
    }

    pub(crate) fn in_machine_coordinates(&self, motion: &mut Motion, moved: u16) {
        motion.in_machine_coordinates(moved);
        // G16 H0 of an Okuma: whether the length acts is not stated by a source
        let acts = self.core.dialect.quirks.user_task() && self.core.state.length.is_undeclared();
        motion.undeclared.length |= acts && moved & LINEAR != 0;
    }

    /// Machine coordinates of which it is not known where they lead.
    pub(crate) fn machine_words(
        &mut self,
        words: &Words,
        kind: &mut MotionKind,
        end: &mut Position,
        report: &mut Report<'_>,
    ) {
        if self.core.state.tool_axis.tcp() {
            self.machine_words_under_tcp(words, kind, end, report);
        } else if self.distances(words) != 0 && self.core.dialect.quirks.macro_b() {
            self.machine_words_incremental(words, kind, end, report);
        }
    }

    /// Linear machine coordinates under tool centre point control: G53 of a Fanuc may be refused there; SUPA of a Sinumerik suppresses frames,
    /// and its transformation stays, so that its words are no joints. Where the axes go is unknown.
    fn machine_words_under_tcp(
        &mut self,
        words: &Words,
        kind: &mut MotionKind,
        end: &mut Position,
        report: &mut Report<'_>,
    ) {
        if (words.axes.given | words.axes.unread) & LINEAR == 0 {
            return;
        }
        *kind = MotionKind::Unknown;
        self.core.state.position.known &= !words.axes.given;
        self.core.forget_linear();
        end.known &= self.core.state.position.known;
        let what = "machine coordinates under tool centre point control: where the axes go".to_owned();
        report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
    }
}
