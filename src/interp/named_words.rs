//! Words whose address is a name, or a letter with a number: `CR=`, `A3=`, `S2=`, `PO[X]=`, variables.
use crate::FaultKind;
use crate::codes::Found;
use crate::reader::Reader;
use crate::system::{SystemWrite, system_write};
use crate::words::WordValue;
use trunnion_dialect::{Action, Role};
use trunnion_syntax::{TextRange, Word};

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `CR=`, `TURN=`; `#1=` and names of the program's own are variables, which move nothing; `,R` and `,C` are corners.
    pub(crate) fn named_word(&mut self, name: TextRange, word: &Word) {
        let (range, name) = (name, self.program.source().get(name.as_usize()).unwrap_or_default());
        if name.first() == Some(&b'#') && self.macro_assignment(range, word) {
            return;
        }
        if self.frame_word(range, word) || self.polynomial(name, word) || self.spline_word(name, word) {
            return;
        }
        self.system_word(name, word.range);
        let variable = self.dialect.quirks.user_names() || matches!(name.first(), Some(b'#' | b'$'));
        // FL[X]= and PO[X]= are FL and PO of an axis
        let stem = name.split(|byte| *byte == b'[').next().unwrap_or_default().trim_ascii();
        if self.axis_by_index((stem, name.get(stem.len()..).unwrap_or_default().trim_ascii()), word) {
            return;
        }
        let positions = stem.eq_ignore_ascii_case(b"SPOS") || stem.eq_ignore_ascii_case(b"SPOSA");
        let index = name.get(stem.len()..).unwrap_or_default().trim_ascii();
        // SPOS[2] is another spindle
        self.words.positions_spindle |= positions && (index.is_empty() || index == b"[1]");
        match (self.dialect.named_role(stem), name.first()) {
            (Some(Role::NotFollowed), _) => {
                let what = String::from_utf8_lossy(stem).to_ascii_uppercase();
                self.words.has_values = true;
                self.words.other_feed |= matches!(what.as_str(), "FB" | "FD" | "FZ");
                if what == "SVC" {
                    self.words.speed = WordValue::Unread;
                }
                (self.report)(word.range, FaultKind::NotModelled { what });
            }
            (Some(Role::FeedReference), _) => self.feed_reference(index, word),
            (Some(role), _) => {
                if stem.eq_ignore_ascii_case(b"LIMS") && self.value_of(word).is_some_and(|limit| limit < 0.0) {
                    (self.report)(word.range, crate::iso::below_zero("LIMS"));
                }
                self.role_word(role, b' ', word);
            }
            (None, Some(b',')) if self.corner(stem, word) => {}
            (None, Some(b',')) => self.role_word(Role::NotModelled, b' ', word),
            _ if variable && self.code_with_value(stem, word) => {}
            _ if variable => self.own_assignment(range, word),
            _ => (self.report)(word.range, FaultKind::UnknownWord),
        }
    }

    /// `TCARR=1`: the name of a code is no variable. A code that moves nothing and leaves coordinates as they are takes its value (ADIS, CTOL).
    fn code_with_value(&mut self, stem: &[u8], word: &Word) -> bool {
        let name = std::str::from_utf8(stem).unwrap_or_default();
        let declared = self.own.as_ref().is_some_and(|own| own.is_declared(name));
        let code = self.dialect.name(name).filter(|_| !declared);
        let Some(code) = code.filter(|code| !matches!(code.action, Action::NoMotion | Action::PathMode)) else {
            return false;
        };
        self.words.has_values = true;
        if matches!(
            code.action,
            Action::NotModelled | Action::FrameChange | Action::NotFollowed
        ) {
            self.codes.push(Found {
                code,
                range: word.range,
                with_arguments: true,
            });
        } else {
            // no control takes it so: what it then does is not known
            self.words.writes_system = true;
            self.not_modelled(word.range);
        }
        true
    }

    /// An assignment to a variable of the control.
    pub(crate) fn system_word(&mut self, name: &[u8], range: TextRange) {
        let write = system_write(self.dialect, name);
        if write != SystemWrite::Nothing {
            self.words.writes_system |= write == SystemWrite::Meaning;
            self.not_modelled(range);
        }
    }

    /// `A3=`, `S2=`, `R1=`: first as a name, then as a further spindle, tool or function, else as a variable.
    pub(crate) fn indexed_word(&mut self, letter: u8, index: u16, word: &Word) {
        let mut name = [0u8; 6];
        name[0] = letter;
        let mut digits = 1;
        let mut divisor = 10_000;
        while divisor > 0 {
            if index >= divisor || divisor == 1 {
                name[digits] = b'0' + (index / divisor % 10) as u8;
                digits += 1;
            }
            divisor /= 10;
        }
        if self.own_frame_word(&name[..digits], word) || self.declared_word(&name[..digits], word) {
            return;
        }
        if let Some(role) = self.dialect.named_role(&name[..digits]) {
            if role == Role::Variable {
                self.own_value(&String::from_utf8_lossy(&name[..digits]), word);
            }
            self.role_word(role, letter, word);
            return;
        }
        let role = self.dialect.role(letter);
        if let Some(role @ (Role::Speed | Role::M)) = role
            && self.spindle_word(role, (letter, index), word)
        {
            return;
        }
        match role {
            Some(Role::Speed) => self.words.speed = WordValue::Unread,
            Some(Role::Tool) => self.words.tool = WordValue::Unread,
            Some(Role::M) => self.words.other_spindle = true,
            // an axis by its name in the machine (Z1=0): which axis moves is not known
            Some(Role::Axis) => self.words.forgets_all = true,
            Some(Role::ArcRadius | Role::Parameter | Role::Variable) => {
                self.words.has_values = true;
                return;
            }
            _ => {}
        }
        self.words.has_values = true;
        self.not_modelled(word.range);
    }
}
