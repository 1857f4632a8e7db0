//! What the engine of ISO programs remembers in addition to the modal state.
use trunnion_dialect::Action;

/// A zero point that was in effect.
pub(crate) type ZeroBefore = (Option<std::sync::Arc<str>>, [f64; 9], u16);

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory<'d> {
    /// Data of tools were written by the program: no length is known.
    pub(crate) tool_data_written: bool,
    /// Tool centre point control was on since the tool came into the spindle.
    pub(crate) tcp_used: bool,
    /// The length after tip control of an Okuma is not known, and no motion has said so: the code whose group settles it.
    pub(crate) tip_length_open: Option<&'d trunnion_dialect::Code>,
    /// The tool for which a missing length under tool centre point control was reported.
    pub(crate) tcp_length_reported: Option<u32>,
    /// The group of the code that switched tool centre point control on.
    pub(crate) tcp_group: Option<&'d str>,
    /// How the axes run between positions under a transformation.
    pub(crate) travel: crate::travel::Travel,
    /// STAT in effect.
    pub(crate) status: Option<u16>,
    /// A turning cycle's block and the last of its contour, which the cycle has run.
    pub(crate) passed_over: Option<(u32, u32)>,
    /// The contour of a turning cycle is read.
    pub(crate) in_contour: bool,
    /// First blocks of contours whose faults were reported.
    pub(crate) contours_reported: Vec<u32>,
    /// What X words are.
    pub(crate) x_words: crate::diameter::XWords,
    /// A tool vector has turned the rotary axes.
    pub(crate) led_by_vector: bool,
    /// It was reported that no code loads the tool that T selected.
    pub(crate) tool_never_changed: bool,
    /// Active cutting edge (D); `None` before the first.
    pub(crate) edge: Option<u32>,
    /// Last H.
    pub(crate) length_offset: Option<u32>,
    /// Position and length before a code of this block that may change the length.
    pub(crate) length_before: Option<crate::length_change::Before>,
    /// What the axes of the tool start from in this block where that is not where they stand: see [`crate::length_change`].
    pub(crate) length_base: Option<crate::Position>,
    /// Where the axis of the tool is since its length has changed is not known.
    pub(crate) length_open: Option<crate::length_change::Open>,
    /// The zero point that is in effect again after this block: its name, its values, the axes for which it is not declared.
    pub(crate) zero_after: Option<ZeroBefore>,
    /// A Sinumerik program has written values of the work offset in effect, and not selected it since.
    pub(crate) offset_open: Option<crate::offsets::Rewritten>,
    pub(crate) before_cycle: Option<Action>,
    /// Coordinates that the program shifts and turns.
    pub(crate) frames: crate::frames::Frames,
    /// The active drilling or turning cycle.
    pub(crate) cycle: crate::cycles::Cycle,
    /// Rounded and cut off corners.
    pub(crate) corners: crate::corner::Corners,
    /// Cutter radius compensation in the plane.
    pub(crate) compensation: crate::compensation::Compensation,
    /// Variables of a Sinumerik program.
    pub(crate) own: crate::own::Own,
    /// Motions of the current block except its last.
    pub(crate) out: Vec<crate::Motion>,
    pub(crate) percent_seen: bool,
    /// Blocks of the leader, where the caller chooses the blocks.
    pub(crate) leader: u32,
    /// M24 of a Haas lathe: threads are left at their end.
    pub(crate) thread_chamfer_off: bool,
}
