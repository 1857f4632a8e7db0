//! CALL and PCALL: which program they call.
use super::statement::{Statement, Trouble};
use crate::FaultKind;
use crate::flow::{Calling, Transfer, With};

impl Statement<'_> {
    /// `CALL "GROOVE"`, `CALL NAME` of a variable of the type STRING, `PCALL GROOVE(1,2)`. Paths and parts of programs are not followed.
    pub(super) fn call(&mut self, from: usize, keyword: &str) -> Result<Transfer, Trouble> {
        let at = self.text.at();
        let (name, arguments) = if keyword == "CALL" {
            match self.own.joined(self.text.bytes(), at) {
                Some((Ok(name), end)) => {
                    self.text.go_to(end);
                    (name, None)
                }
                _ => (String::new(), None),
            }
        } else {
            (self.text.word(), self.text.in_brackets())
        };
        let plain = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let range = self.text.range(from, self.text.bytes().len());
        if name.is_empty() || !plain || !self.text.is_at_end() {
            let what = format!("{keyword}: which program it calls");
            return Err((range, FaultKind::NotModelled { what }));
        }
        Ok(Transfer::Call(Calling {
            program: super::names::program_key(&name),
            times: 1,
            range,
            with: With::Sinumerik(super::With::read(arguments.as_deref(), self.own)),
        }))
    }
}
