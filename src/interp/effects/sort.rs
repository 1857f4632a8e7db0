//! The purpose of a code in a comparison, and the words that belong to it.
use crate::codes::Found;
use crate::tools::Chosen;
use crate::words::{WordValue, Words};
use crate::written::{call_argument, hole_call_argument};
use crate::{Argument, Value};
use trunnion_dialect::{Action, CodeKind};
use trunnion_syntax::Block;

/// Codes that read the comment of their block (Haas mill operator's manual: G47 text engraving, M95 sleep mode, M109 question to the operator, M130 to M131 media).
pub(super) const READ_COMMENTS: [&str; 5] = ["G47", "M95", "M109", "M130", "M131"];

/// Names of codes that show something to the operator and do nothing else.
const NEUTRAL: [&str; 1] = ["MSG"];

/// Whether the spindle does more in a cycle or along a path than turn: it is coupled to the feed, stops, or is oriented.
pub(super) fn couples(action: Action) -> bool {
    matches!(
        action,
        Action::Thread
            | Action::VariableThread
            | Action::TapCycle
            | Action::TapLeftCycle
            | Action::BoreStopCycle
            | Action::BoreManualCycle
            | Action::FineBoreCycle
            | Action::BackBoreCycle
            | Action::ThreadingCycle
            | Action::ThreadRepeatCycle
            | Action::HoleCall
            | Action::CannedCycle
    )
}

/// Whether a code calls a cycle whose whole effect is in its motions; the others tap, orient the spindle, or wait.
pub(super) fn is_plain_cycle(code: &trunnion_dialect::Code) -> bool {
    let plain = [
        "CYCLE81", "CYCLE82", "CYCLE83", "CYCLE85", "CYCLE89", "CYCLE801", "CYCLE802", "HOLES1", "HOLES2",
    ];
    code.action == Action::HoleCall && plain.contains(&code.id.as_str())
}

/// Whether a code repeats the cycle that is called with it after each motion; alone it ends that.
pub(super) fn is_modal_call(code: &trunnion_dialect::Code) -> bool {
    code.action == Action::CannedCycle && code.id == "MCALL"
}

/// Whether a code writes a text on the screen.
pub(super) fn tells(found: &Found<'_>) -> bool {
    found.code.kind == CodeKind::Name && NEUTRAL.contains(&found.code.id.as_str())
}

/// Whether a code ends what a code that [`couples`] began.
pub(super) fn uncouples(action: Action) -> bool {
    action.is_hole_cycle()
        || action.is_pass_cycle()
        || matches!(
            action,
            Action::Rapid
                | Action::Linear
                | Action::ArcClockwise
                | Action::ArcCounterClockwise
                | Action::ArcThroughPoint
                | Action::ArcTangent
                | Action::Polynomial
                | Action::CycleOff
        )
}

/// The purpose of a code in a comparison.
pub(super) enum Sort {
    /// It is in motions and the modal state.
    Held,
    /// It sets something until another code sets it again.
    Setting(&'static str),
    /// One of a modal group whose codes only set something.
    Group,
    /// It happens once, before the block's motion.
    Before,
    /// It happens once, after the block's motion.
    After,
}

pub(super) fn sort(found: &Found<'_>, words: &Words) -> Sort {
    let code = found.code;
    match code.action {
        _ if tells(found) => Sort::Held,
        Action::SpindleClockwise | Action::SpindleCounterClockwise | Action::SpindleStop => Sort::Setting("spindle"),
        Action::ConstantSurfaceSpeed | Action::ConstantSpindleSpeed => Sort::Setting("speed mode"),
        Action::ProgramStop => Sort::After,
        // a straight line under POLY is compared by its code
        Action::Polynomial if !words.polynomial => Sort::Before,
        Action::OrientationAxes | Action::OrientationVector => Sort::Group,
        Action::DataEntry
        | Action::ReferenceStore
        | Action::ReferenceStoreOther
        | Action::SwivelCycle
        | Action::Kinematics => Sort::Before,
        Action::MachineCoordinates => Sort::Setting("coordinates"),
        // the system of another number is that of the motion
        Action::WorkSystemOnce if words.length_offset.index() == Some(0) => Sort::Setting("coordinates"),
        Action::CompensationLeft | Action::CompensationRight | Action::CompensationOff => Sort::Setting("compensation"),
        // a limit of the spindle's speed
        Action::PositionSet | Action::NotFollowed | Action::FrameChange
            if !words.axes.any() && words.speed.is_given() =>
        {
            Sort::Setting("speed limit")
        }
        Action::NoMotion
        | Action::PathMode
        | Action::DiameterSwitch
        | Action::DiameterOn
        | Action::DiameterAbsolute
        | Action::DiameterOff => match code.group.as_deref() {
            None | Some("one-shot" | "non-modal" | "special-motion" | EXACT_STOP_ONCE | "stopping") => Sort::Before,
            // the limits that it writes stay
            Some("stroke-check") if words.axes.any() => Sort::Before,
            Some(_) => Sort::Group,
        },
        _ => Sort::Held,
    }
}

/// What a limit of the spindle's speed sets: G25, G26 and LIMS of a Sinumerik write limits of their own.
pub(super) fn speed_limit(found: &Found<'_>) -> String {
    match found.code.action {
        Action::NotFollowed => format!("speed limit {}", found.code.id),
        _ => "speed limit".to_owned(),
    }
}

/// Coolant codes that every dialect here shares: flood, mist, or both off.
pub(super) fn coolant(code: &trunnion_dialect::Code) -> Option<&'static [(&'static str, bool)]> {
    let listed = matches!(code.group.as_deref(), Some("coolant" | "mist"));
    match code.id.as_str() {
        "M7" if listed => Some(&[("mist coolant", true)]),
        "M8" if listed => Some(&[("flood coolant", true)]),
        "M9" if listed => Some(&[("mist coolant", false), ("flood coolant", false)]),
        _ => None,
    }
}

/// The group of codes that stop exactly at the end of their block.
const EXACT_STOP_ONCE: &str = "exact-stop-once";

/// Whether a code reads the axis words of its block as data: those beside an exact stop in one block are of the motion.
pub(super) fn takes_axes(code: &trunnion_dialect::Code) -> bool {
    let reads = matches!(
        code.action,
        Action::DataEntry | Action::ReferenceStore | Action::ReferenceStoreOther | Action::NoMotion | Action::PathMode
    );
    reads && code.group.as_deref() != Some(EXACT_STOP_ONCE)
}

/// Whether a code changes what coordinates mean.
pub(super) fn is_frame(action: Action) -> bool {
    matches!(
        action,
        Action::FrameChange
            | Action::FrameLost
            | Action::ProgrammableShift
            | Action::ProgrammableFrame
            | Action::Pole
            | Action::LocalShift
            | Action::PositionSet
            | Action::PositionPreset
            | Action::RotationOn
            | Action::ScalingOn
            | Action::MirrorOn
            | Action::PolarOn
            | Action::TiltedPlane
            | Action::SwivelCycle
    )
}

pub(crate) fn letter_bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

const LETTERS: [&str; 26] = [
    "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N", "O", "P", "Q", "R", "S", "T", "U", "V", "W",
    "X", "Y", "Z",
];

/// The words of some letters in alphabetical order.
pub(super) fn arguments(words: &Words, letters: u32) -> impl Iterator<Item = Argument> {
    LETTERS
        .iter()
        .filter(move |letter| letters & letter_bit(letter.as_bytes()[0]) != 0)
        .map(|letter| said(letter, words.letter(letter.as_bytes()[0])))
        .filter(|argument| !matches!(argument.value, Value::Nothing))
}

/// All words but codes, numbers of blocks and programs, S and T, as they are written.
pub(super) fn all_arguments(words: &Words) -> impl Iterator<Item = Argument> {
    LETTERS.iter().filter_map(|letter| {
        let value = words.letter(letter.as_bytes()[0]);
        (value.is_given() && !matches!(*letter, "S" | "T")).then(|| said(letter, value))
    })
}

pub(super) fn said(name: &'static str, said: WordValue) -> Argument {
    match said {
        WordValue::Nothing => Argument::code(name),
        WordValue::Number(number) => Argument::number(name, number.value),
        WordValue::Name(_) | WordValue::Unread => Argument::text(name, "unknown"),
    }
}

pub(super) fn chosen(tool: &Chosen) -> Argument {
    match tool {
        Chosen::Nothing => Argument::code("T"),
        Chosen::Number(number) => Argument::number("T", f64::from(*number)),
        Chosen::Named(name) => Argument::text("T", name),
        Chosen::Unread => Argument::text("T", "unknown"),
    }
}

/// The code as it is compared: a name with what stands between its parentheses.
pub(super) fn name_of(found: &Found<'_>, view: &Block<'_>) -> Argument {
    if found.code.kind == CodeKind::Name && found.with_arguments {
        let text = view.program().text(found.range);
        match found.code.action {
            Action::HoleCall => hole_call_argument(&found.code.id, &text),
            _ => call_argument(&found.code.id, &text),
        }
    } else {
        Argument::code(found.code.id.clone())
    }
}
