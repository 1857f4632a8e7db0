//! CALL, PCALL, EXTCALL and ISOCALL: which program they call.
//!
//! Of a path only the last name is looked for, where other called programs are: `_N_SPF_DIR/_N_GROOVE_SPF` is GROOVE.SPF. A name has `_N_` before
//! it or not, and `_SPF`, `.SPF`, `_MPF`, `.MPF` or nothing behind it (SINUMERIK 828D, Function Manual, Basic Functions, 09/2011, p. 626: EXTCALL).
use super::statement::{Statement, Trouble};
use crate::FaultKind;
use crate::flow::{Calling, Transfer, With};

/// Why a program in ISO language is not followed.
const ISO_LANGUAGE: &str =
    "ISOCALL: ISO language, as after G291, is not read: positions, codes in effect and variables after it";

impl Statement<'_> {
    /// `CALL "GROOVE"`, `CALL NAME` of a variable of the type STRING, `PCALL /_N_SPF_DIR/GROOVE(1,2)`, `EXTCALL("C:/GROOVE.SPF")`. Parts of
    /// programs are not followed.
    pub(super) fn call(&mut self, from: usize, keyword: &str) -> Result<Transfer, Trouble> {
        let (path, arguments) = match keyword {
            "PCALL" => (self.text.path(), self.text.in_brackets()),
            "EXTCALL" => {
                let open = self.text.eat(b'(');
                let path = self.path_in_text();
                let closed = !open || self.text.eat(b')');
                (path.filter(|_| closed).unwrap_or_default(), None)
            }
            _ => (self.path_in_text().unwrap_or_default(), None),
        };
        let range = self.text.range(from, self.text.bytes().len());
        if keyword == "ISOCALL" {
            let what = ISO_LANGUAGE.to_owned();
            return Err((range, FaultKind::NotModelled { what }));
        }
        let name = path.rsplit(['/', '\\', ':']).next().unwrap_or_default();
        let program = super::names::called_key(name).filter(|_| self.text.is_at_end());
        let Some(program) = program else {
            let what = format!("{keyword}: which program it calls");
            return Err((range, FaultKind::NotModelled { what }));
        };
        let stops = super::call::stops(arguments.as_deref(), self.own);
        self.remarks.extend(stops.into_iter().map(|kind| (range, kind)));
        let mut with = super::With::read(arguments.as_deref(), self.own);
        with.is_elsewhere = keyword == "EXTCALL" || name.len() < path.len();
        Ok(Transfer::Call(Calling {
            program,
            times: 1,
            range,
            with: With::Sinumerik(with),
        }))
    }

    /// The text at this point; `None`: its value is not known, or there is none.
    fn path_in_text(&mut self) -> Option<String> {
        let at = self.text.at();
        match self.own.joined(self.text.bytes(), at) {
            Some((Ok(path), end)) => {
                self.text.go_to(end);
                Some(path)
            }
            _ => None,
        }
    }
}
