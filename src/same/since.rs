//! What happened since the last motion, and since something ran that may have changed everything modal.
use crate::process::Held;
use trunnion_dialect::{Action, Code, Dialect};
use trunnion_interp::{Argument, Effect, Motion};

/// See the module.
#[derive(Default)]
pub(crate) struct Since {
    /// Something may have moved the coordinates, or the machine, since the last motion.
    pub(crate) disturbed: bool,
    /// Something ran that may have changed everything modal: what is restated from then on matters.
    pub(crate) lost: bool,
    /// Data of the control that offsets are read from (zero points, lengths, radii) may have been written: a code that reads them again matters
    /// from then on. Whether an offset that is in effect follows at once is a parameter of the control, where it is known at all.
    pub(crate) written: bool,
    /// Some motion was made in machine coordinates, or with another offset or length than the one after it: an axis may still be where
    /// that motion put it.
    strayed: bool,
    /// Frame of the last motion.
    last: Option<(Motion, Held)>,
}

impl Since {
    /// Whether a motion starts elsewhere than the one before ended, in the same frame.
    pub(crate) fn starts_anew(&self, motion: &Motion) -> bool {
        let Some((last, _)) = &self.last else {
            return motion.start.known != 0;
        };
        let bits = |zero: &[f64; 9]| zero.map(f64::to_bits);
        let frame = bits(&last.zero) == bits(&motion.zero) && last.tcp == motion.tcp && last.tilt == motion.tilt;
        let both = last.end.known & motion.start.known;
        let moved = |axis: usize| last.end.values[axis].to_bits() != motion.start.values[axis].to_bits();
        frame && (0..9).any(|axis| both & (1 << axis) != 0 && moved(axis))
    }

    /// A motion is made: whether it is in the frame of the motion before, with nothing between that may have changed it.
    pub(crate) fn motion(&mut self, motion: &Motion, held: &Held) -> bool {
        let same = self.last.as_ref().is_some_and(|(last, was)| {
            let zero = last
                .zero
                .iter()
                .zip(motion.zero)
                .all(|(a, b)| a.to_bits() == b.to_bits());
            zero && was == held
                && last.tool_length_mm.to_bits() == motion.tool_length_mm.to_bits()
                && last.tool == motion.tool
                && last.tcp == motion.tcp
                && last.machine_coordinates == motion.machine_coordinates
                && last.radii == motion.radii
                && last.tilt == motion.tilt
        });
        // a new length acts along Z: after a motion along Z nothing is left of the old one
        let to_new_height = motion.start.get(2) != motion.end.get(2);
        let other_frame = |(_, was): &(Motion, Held)| {
            was.work_offset != held.work_offset || was.length_of != held.length_of && !to_new_height
        };
        // LinuxCNC's motions in machine coordinates depend on no undeclared zero point of the axes that they name
        let other_zero = |(last, _): &(Motion, Held)| last.undeclared.zero != motion.undeclared.zero;
        self.strayed |= motion.machine_coordinates
            || !motion.undeclared.any()
            || self
                .last
                .as_ref()
                .is_some_and(|last| other_frame(last) || other_zero(last));
        self.last = Some((*motion, held.clone()));
        !std::mem::take(&mut self.disturbed) && same
    }

    /// Whether an event only says that a zero point is set from here, with the offset and the length of all motions so far: then no
    /// undeclared value matters.
    pub(crate) fn is_set_plainly(&self, words: &[Argument]) -> bool {
        let [name, offset, length] = words else { return false };
        name.name == FROM_HERE
            && !self.strayed
            && self.last.as_ref().is_some_and(|(_, held)| {
                let text = |word: &Argument, to: &str| word.value == Argument::text("", to).value;
                text(offset, held.work_offset.as_deref().unwrap_or("no work offset"))
                    && text(length, &held.length_of.to_string())
            })
    }
}

/// The event of a zero point that is set at the position of the machine (G92).
const FROM_HERE: &str = "zero point set from here";

/// Whether an event is that one.
pub(crate) fn sets_from_here(words: &[Argument]) -> bool {
    words.first().is_some_and(|word| word.name == FROM_HERE)
}

/// Whether an effect may write data of the control that offsets are read from: G10, a system variable, or words whose effect is not modelled.
pub(crate) fn writes_data(effect: &Effect) -> bool {
    let is_data = |word: &Argument| {
        let is_number = word
            .name
            .strip_prefix('#')
            .and_then(|digits| digits.parse::<u32>().ok());
        word.name.starts_with("G10") || word.name.starts_with('$') || is_number.is_some_and(|number| number >= 1000)
    };
    match effect {
        // a code of the machine builder, or a block whose moment is open, writes none by itself
        Effect::Unmodelled(words) => words.first().is_none_or(|word| {
            let digits = word.name.strip_prefix('M').unwrap_or("?");
            !digits.bytes().all(|byte| byte.is_ascii_digit()) && word.name != "T" && !word.name.contains(' ')
        }),
        Effect::Event(words) => words.iter().any(is_data),
        Effect::Store(word) => is_data(word),
        Effect::Set { .. } | Effect::End(_) => false,
    }
}

/// Whether a code reads a zero point, a length or a radius from the data of the control.
pub(crate) fn reads_data(code: &Code) -> bool {
    matches!(
        code.action,
        Action::WorkOffset
            | Action::WorkSystem
            | Action::ToolLengthOn
            | Action::CompensationLeft
            | Action::CompensationRight
            | Action::TcpOn
            | Action::TcpVectorOn
    )
}

/// Whether the text of a statement may write a variable of the control (#1000 and above, `$...`), where offsets may be kept.
pub(crate) fn writes_control(text: &str) -> bool {
    let mut text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    text.make_ascii_uppercase();
    // the statement that is run in the end
    let then = text.rsplit_once("THEN").map_or(text.as_str(), |(_, then)| then.trim());
    !steers(then) && assigns_control(then)
}

/// Whether a block only decides which block runs next: `N10 IF [#1 EQ 1] GOTO 20`.
pub(crate) fn only_steers(text: &str) -> bool {
    // every word that steers has two letters side by side, and most blocks have none
    if !text
        .as_bytes()
        .windows(2)
        .any(|pair| pair.iter().all(u8::is_ascii_alphabetic))
    {
        return false;
    }
    let text = text.trim().to_ascii_uppercase();
    let numbered = text
        .strip_prefix('N')
        .map(|rest| rest.trim_start_matches(|sign: char| sign.is_ascii_digit()));
    let text = numbered
        .filter(|rest| text.len() > rest.len() + 1)
        .unwrap_or(&text)
        .trim();
    match text.split_once("THEN") {
        Some((_, then)) => then.contains('=') && !writes_control(then),
        None => steers(text),
    }
}

/// Whether a statement only decides which block runs next.
fn steers(text: &str) -> bool {
    let assigns = text.contains('=')
        && ["==", "<=", ">=", "<>"]
            .iter()
            .fold(text.to_owned(), |text, sign| text.replace(sign, " "))
            .contains('=');
    // a block of LinuxCNC: `o100 while [...]`, `o<name> if [...]`
    let labelled = text.strip_prefix('O').and_then(|rest| match rest.strip_prefix('<') {
        Some(rest) => rest.split_once('>').map(|(_, rest)| rest),
        None => {
            Some(rest.trim_start().trim_start_matches(|sign: char| sign.is_ascii_digit())).filter(|left| *left != rest)
        }
    });
    let statement = labelled.unwrap_or(text).trim_start();
    let length = statement.bytes().take_while(u8::is_ascii_alphabetic).count();
    let word = &statement[..length];
    let loops = ["IF", "WHILE", "DO", "ELSE", "ENDIF", "ENDWHILE", "REPEAT"];
    let found = match labelled {
        Some(_) => ["ELSEIF", "ENDREPEAT", "BREAK", "CONTINUE"].contains(&word),
        None => [
            "END", "GOTO", "GOTOF", "GOTOB", "GOTOC", "LOOP", "ENDLOOP", "UNTIL", "ENDFOR",
        ]
        .contains(&word),
    };
    !assigns && (found || loops.contains(&word))
}

fn assigns_control(text: &str) -> bool {
    let name: String = text.split('=').next().unwrap_or_default().split_whitespace().collect();
    match name.strip_prefix('#') {
        Some(rest) => !rest.starts_with('<') && rest.parse::<u32>().map_or(true, |number| number >= 1000),
        None => !(name.starts_with(['R', 'r']) || name.starts_with('/')),
    }
}

/// Whether a code certainly leaves the machine and its coordinates where they are, apart from what the motion itself does.
pub(crate) fn keeps_place(code: &Code, dialect: &Dialect) -> bool {
    // LinuxCNC's engine runs its cycles itself
    let runs_cycles = dialect.quirks.rs274() && code.action == Action::CannedCycle;
    runs_cycles
        || code.action.keeps_place()
        || code.action == Action::NoMotion && matches!(code.group.as_deref(), Some("coolant" | "mist"))
}

#[cfg(test)]
mod tests {
    use super::{only_steers, writes_control};

    #[test]
    fn a_line_of_conditions_needs_no_stack() {
        let many = "IF[#1EQ1]THEN ".repeat(200_000);
        assert!(writes_control(&format!("{many}#5221=7.")));
        assert!(!writes_control(&format!("{many}GOTO 10")));
    }

    #[test]
    fn what_only_steers_the_run_writes_nothing() {
        let steer = [
            "WHILE[#1LE2]DO1",
            "END1",
            "IF [#1 EQ 2] GOTO 10",
            "GOTO10",
            "IF[#5EQ1]THEN #2=7.",
            "IF R1==1",
            "WHILE I_1<=3",
            "o100 while [#1 LT 3]",
            "o<a> endif",
            "#33=5",
            "R5=3",
        ];
        for text in steer {
            assert!(!writes_control(text), "{text}");
            assert!(
                text.starts_with(['#', 'R']) || only_steers(&format!("N10 {text}")),
                "{text}"
            );
        }
        let writes = [
            "IF[#1EQ1]THEN #5221=7.",
            "o<probe> call [1]",
            "o100 call",
            "#5221=0",
            "$P_UIFR[1,X,TR]=0",
            "POS[X]=5",
            "ENDE_1=5",
            "#[#1]=5",
        ];
        for text in writes {
            assert!(writes_control(text), "{text}");
            assert!(!only_steers(text), "{text}");
        }
    }
}
