//! What a code asks for beside motions. What this file does not name is the control's own: a new code is refused until it is named here.
use super::ask::{Ask, Coolant, Found, Why};
use trunnion_dialect::{Action, Code, CodeKind, Dialect};
use trunnion_syntax::TextRange;

/// How much of a code is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// A name without arguments.
    Bare,
    /// A number, or a name with arguments.
    Whole,
}

/// Adds what a code asks for; `text` is the code with the words that belong to it.
pub(super) fn by_code(code: &Code, held: Held, range: TextRange, text: &str, dialect: &Dialect, found: &mut Found) {
    match code.action {
        Action::SpindleClockwise => found.counter_clockwise = Some(false),
        Action::SpindleCounterClockwise => found.counter_clockwise = Some(true),
        _ => {}
    }
    let is_name = code.kind == CodeKind::Name;
    let name = if is_name { code.id.as_str() } else { head(text) };
    match why(code, held, text, dialect) {
        Judged::Motions => {}
        Judged::Named(ask) => found.asks.push((range, ask)),
        Judged::Own(why) => found.own(range, name, text, why),
    }
}

enum Judged {
    /// Motions, tools, feeds and spindle speeds hold it.
    Motions,
    Named(Ask),
    Own(Why),
}

fn why(code: &Code, held: Held, text: &str, dialect: &Dialect) -> Judged {
    use Judged::{Motions, Named, Own};
    if dialect.quirks.rs274()
        && let Some(judged) = linuxcnc(code)
    {
        return judged;
    }
    match code.action {
        action if action.is_in_motions() => Motions,
        // the zero point of G15 and G16 is compared at each motion
        Action::BoreCycle
        | Action::BoreStopCycle
        | Action::DrillCycle
        | Action::WorkSystem
        | Action::ConstantSpindleSpeed
        | Action::WorkSystemOnce => Motions,
        Action::SpindleStop if head(text) == "M5" => Motions,
        Action::SpindleStop => Own(Why::Oriented),
        Action::ProgramStop => match head(text) {
            "M0" => Named(Ask::Stop { optional: false }),
            "M1" => Named(Ask::Stop { optional: true }),
            _ => Own(Why::Waits),
        },
        Action::TapCycle
        | Action::TapLeftCycle
        | Action::Thread
        | Action::VariableThread
        | Action::ThreadingCycle
        | Action::ThreadRepeatCycle => Own(Why::Synchronised),
        // CYCLE84 taps; 86, 87 and 88 stop the spindle at an angle or wait for the operator
        Action::HoleCall => match code.id.as_str() {
            "CYCLE81" | "CYCLE82" | "CYCLE83" | "CYCLE85" | "CYCLE89" | "CYCLE801" | "CYCLE802" | "HOLES1"
            | "HOLES2" => Motions,
            "CYCLE84" => Own(Why::Synchronised),
            _ => Own(Why::Motion),
        },
        // MCALL: the cycle that it calls follows it
        Action::CannedCycle if code.id == "MCALL" => Motions,
        Action::NotModelled if taps(code) => Own(Why::Synchronised),
        Action::ConstantSurfaceSpeed => Own(Why::SurfaceSpeed),
        Action::NotModelled
        | Action::CannedCycle
        | Action::Skip
        | Action::FineBoreCycle
        | Action::BackBoreCycle
        | Action::BoreManualCycle => Own(Why::Motion),
        Action::PositionSet if text.split(' ').any(|word| word.starts_with('S')) => Own(Why::SpindleLimit),
        Action::PositionSet
        | Action::DataEntry
        | Action::DataEntryEnd
        | Action::ReferenceStore
        | Action::ReferenceStoreOther => Own(Why::Stored),
        Action::NotFollowed if code.id == "SETAL" => quiet(code, held, text),
        Action::NotFollowed if text.split(' ').any(|word| word.starts_with('S')) => Own(Why::SpindleLimit),
        Action::PathMode | Action::NoMotion => quiet(code, held, text),
        _ => Own(Why::Machine),
    }
}

/// Whether a code that is not modelled couples the motion to the spindle.
fn taps(code: &Code) -> bool {
    let words = ["thread", "tap", "coupled to the spindle"];
    let doc = code.doc.to_ascii_lowercase();
    words.iter().any(|word| doc.contains(word))
}

/// LinuxCNC's engine runs more than its table of codes says; `None`: as for other controls.
fn linuxcnc(code: &Code) -> Option<Judged> {
    use Judged::{Motions, Own};
    let id = code.id.as_str();
    Some(match id {
        "G33" | "G33.1" | "G76" | "G74" | "G84" => Own(Why::Synchronised),
        // splines, stored positions, planes of U V W, lengths, turning cycles and holes: their motions are those of the engine
        "G5" | "G5.1" | "G5.2" | "G5.3" | "G6.2" | "G6.3" | "G7" | "G8" | "G17.1" | "G18.1" | "G19.1" | "G28"
        | "G30" | "G43.1" | "G43.2" | "G52" | "G70" | "G71" | "G71.1" | "G71.2" | "G72" | "G72.1" | "G72.2" | "G73"
        | "G81" | "G82" | "G83" | "G85" | "G86" | "G89" | "M61" => Motions,
        "G10" | "G92" | "G92.3" | "G28.1" | "G30.1" => Own(Why::Stored),
        _ => return None,
    })
}

/// A code that moves nothing.
fn quiet(code: &Code, held: Held, text: &str) -> Judged {
    use Judged::{Motions, Named, Own};
    if code.kind == CodeKind::M {
        let coolant = match (head(text), code.group.as_deref()) {
            // by convention on controls that leave them to the machine builder
            ("M7", _) => Some(Coolant::Mist),
            ("M8", _) => Some(Coolant::Flood),
            ("M9", _) => Some(Coolant::Off),
            ("M88", Some("coolant")) => Some(Coolant::Thru),
            ("M89", Some("coolant")) => Some(Coolant::ThruOff),
            _ => None,
        };
        return coolant.map_or(Own(Why::Machine), |coolant| Named(Ask::Coolant(coolant)));
    }
    let path = || {
        if code.action == Action::PathMode {
            Why::PathControl
        } else {
            match code.group.as_deref() {
                Some("acceleration" | "feed-forward" | "dynamics" | "compressor" | "orientation-smoothing") => {
                    Why::PathControl
                }
                _ => Why::Machine,
            }
        }
    };
    // words beside it are tolerances, which another control does not have
    if let Some(mode) = code.path.filter(|_| text == code.id) {
        let name = text.to_owned();
        return Named(Ask::Path { mode, name });
    }
    match code.id.as_str() {
        // they end what never begins in the output: the code that begins it is refused
        "COMPOF" | "FFWOF" | "OSOF" | "ORISOF" => Named(Ask::Idle(text.to_owned())),
        "G5.1" if text.ends_with(" Q0") => Named(Ask::Idle(text.to_owned())),
        "G5" | "G8" if text.ends_with(" P0") => Named(Ask::Idle(text.to_owned())),
        // as feeds are programmed: the state of every program that is written
        // texts on the screen, and names for a simulation
        "MSG" | "DISPLOF" | "DISPLON" | "WORKPIECE" | "SETVN" => Named(Ask::Idle(code.id.clone())),
        "FNORM" | "AC" | "IC" | "DC" | "ACP" | "ACN" => Motions,
        "SPOS" | "SPOSA" | "WAITS" => Own(Why::Oriented),
        "SETAL" => Own(Why::Waits),
        "ADIS" | "ADISPOS" | "CTOL" | "OTOL" | "ATOL" => Own(Why::PathControl),
        "POPEN" | "PCLOS" | "BPRNT" | "DPRNT" => Own(Why::Stored),
        "G63" => Own(Why::Synchronised),
        "G25" | "G26" if held == Held::Whole => Own(Why::SpindleLimit),
        _ => Own(path()),
    }
}

/// The code itself.
fn head(text: &str) -> &str {
    text.split(' ').next().unwrap_or(text)
}
