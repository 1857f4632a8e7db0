//! Reads one statement of the flow, decides it with the known values, and returns what it requests.
use super::text::Text;
use crate::FaultKind;
use crate::flow::{Back, Index, Label, Transfer};
use crate::own::Own;
use trunnion_flow::{Key, Search};
use trunnion_syntax::TextRange;

/// A place and what is wrong or unknown there.
pub(super) type Trouble = (TextRange, FaultKind);

/// One statement of the current block.
pub(super) struct Statement<'a> {
    pub(super) text: Text,
    pub(super) own: &'a mut Own,
    /// File and block.
    pub(super) place: (u16, u32),
    /// The labels of the file.
    pub(super) index: &'a mut dyn FnMut() -> std::sync::Arc<Index>,
    /// The end of the loop that the block opens has led here.
    pub(super) again: bool,
    /// Facts that do not end the run.
    pub(super) remarks: Vec<Trouble>,
}

fn not_decided<T>(range: TextRange, what: impl Into<String>) -> Result<T, Trouble> {
    Err((range, FaultKind::NotDecided { what: what.into() }))
}

impl Statement<'_> {
    /// What the statement requests.
    pub(super) fn read(&mut self) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let keyword = self.text.letters();
        let transfer = match keyword.as_str() {
            "IF" => return self.branch(),
            "WHILE" => Transfer::Open(self.condition()?),
            "UNTIL" if self.condition()? => self.passes_end(),
            "UNTIL" | "ENDLOOP" | "ENDWHILE" | "ENDFOR" => Transfer::Close,
            "LOOP" => Transfer::Open(true),
            "ELSE" => Transfer::Leave,
            "ENDIF" => self.passes_end(),
            "FOR" => self.count()?,
            "CASE" => self.case()?,
            "REPEAT" if self.text.is_at_end() => Transfer::Open(true),
            "REPEAT" | "REPEATB" => self.repeat(&keyword)?,
            "CALL" | "PCALL" | "EXTCALL" | "ISOCALL" => self.call(from, &keyword)?,
            "RET" => {
                let range = self.text.range(from, from + 3);
                Transfer::Return(Back { label: None, range })
            }
            jump => {
                self.text.go_to(from);
                match self.jump()? {
                    Some(transfer) => transfer,
                    None => return not_decided(self.text.rest(), format!("{jump}: the statement")),
                }
            }
        };
        self.end()?;
        Ok(transfer)
    }

    /// The end of a structure that is left: without its beginning the structure is broken, as it is for the others.
    fn passes_end(&mut self) -> Transfer {
        let (_, block) = self.place;
        match (self.index)().loops.closed_by(block) {
            Some(_) => Transfer::Next,
            None => Transfer::Close,
        }
    }

    /// Nothing may follow a statement.
    fn end(&mut self) -> Result<(), Trouble> {
        if self.text.is_at_end() {
            return Ok(());
        }
        not_decided(self.text.rest(), "a flow statement that is not understood")
    }

    /// The value of the expression at this point, and its place.
    fn value(&mut self) -> Result<(f64, TextRange), Trouble> {
        let from = self.text.at();
        match self.own.evaluate(self.text.bytes(), from) {
            Ok((Some(value), _, end)) => {
                self.text.go_to(end);
                Ok((value, self.text.range(from, end)))
            }
            Ok((None, why, end)) => {
                let text = String::from_utf8_lossy(&self.text.bytes()[from..end]).into_owned();
                let range = self.text.range(from, end);
                match self.own.reads_outside(&text) {
                    Some(kind) => Err((range, kind)),
                    None => not_decided(range, why.unwrap_or_default()),
                }
            }
            Err(error) => {
                let text = String::from_utf8_lossy(&self.text.bytes()[from..]).into_owned();
                match crate::own::without_value(&error, &text) {
                    Some(kind) => Err((self.text.rest(), kind)),
                    None => not_decided(self.text.rest(), format!("an expression that cannot be read: {error}")),
                }
            }
        }
    }

    fn condition(&mut self) -> Result<bool, Trouble> {
        Ok(self.value()?.0 != 0.0)
    }

    /// A whole number as the value of an expression.
    fn whole(&mut self, what: &str) -> Result<f64, Trouble> {
        let (value, range) = self.value()?;
        if value.fract() == 0.0 && value.abs() < 2_147_483_647.0 {
            return Ok(value);
        }
        not_decided(range, format!("{what}: {value} is not a whole number"))
    }

    /// IF: alone it opens a branch; with GOTO after it, several in one block, the first true one jumps.
    fn branch(&mut self) -> Result<Transfer, Trouble> {
        let mut holds = self.condition()?;
        if self.text.is_at_end() {
            return Ok(Transfer::Open(holds));
        }
        let mut taken = None;
        loop {
            let Some(jump) = self.jump()? else {
                self.end()?;
                return Ok(taken.unwrap_or(Transfer::Next));
            };
            if holds && taken.is_none() {
                taken = Some(jump);
            }
            if self.text.is_at_end() {
                return Ok(taken.unwrap_or(Transfer::Next));
            }
            let at = self.text.at();
            if self.text.letters() != "IF" {
                self.text.go_to(at);
                self.end()?;
            }
            // once a jump is taken the conditions after it are not tested
            if taken.is_some() {
                return Ok(taken.unwrap_or(Transfer::Next));
            }
            holds = self.condition()?;
        }
    }

    /// GOTOF, GOTOB, GOTO, GOTOC with its target, GOTOS; `None`: there is another word.
    fn jump(&mut self) -> Result<Option<Transfer>, Trouble> {
        let from = self.text.at();
        let (search, may_miss) = match self.text.letters().as_str() {
            "GOTOF" => (Search::Forward, false),
            "GOTOB" => (Search::Backward, false),
            "GOTO" => (Search::ForwardThenBackward, false),
            "GOTOC" => (Search::ForwardThenBackward, true),
            "GOTOS" => {
                let what =
                    "GOTOS: it jumps only if the PLC asks for it; the run continues with the next block".to_owned();
                let range = self.text.range(from, from + 5);
                self.remarks.push((range, FaultKind::NotModelled { what }));
                return Ok(Some(Transfer::Next));
            }
            _ => {
                self.text.go_to(from);
                return Ok(None);
            }
        };
        let mut label = self.target()?;
        label.may_miss = may_miss;
        Ok(Some(Transfer::Jump(label, search)))
    }

    /// A label, `N100`, `100`, or either as a string.
    fn target(&mut self) -> Result<Label, Trouble> {
        let from = self.text.at();
        let joined = self.own.joined(self.text.bytes(), from);
        let is_text = joined.is_some();
        let name = match joined {
            Some((Ok(text), end)) => {
                self.text.go_to(end);
                text.trim().to_ascii_uppercase()
            }
            Some((Err((from, to)), _)) => {
                let part = String::from_utf8_lossy(&self.text.bytes()[from..to]).into_owned();
                let what = format!("`{part}`, a part of the target of a jump: no text or whole number is known for it");
                return not_decided(self.text.range(from, to), what);
            }
            None => {
                self.text.eat(b':');
                self.text.word()
            }
        };
        let end = self.text.at();
        let range = self.text.range(from, end);
        if name.is_empty() || matches!(self.text.bytes().get(end), Some(b'<' | b'[' | b'$')) {
            return not_decided(range, "the target of a jump, which is built while the program runs");
        }
        if !is_text && self.own.is_declared(&name) {
            return not_decided(range, format!("{name}: the target of a jump in a variable"));
        }
        let digits = name.strip_prefix('N').unwrap_or(&name);
        let key = match digits.parse() {
            Ok(number) => Key::Number(number),
            Err(_) => Key::Name(name.into()),
        };
        Ok(Label {
            key,
            range,
            may_miss: false,
        })
    }

    /// `FOR R1=0 TO 7`: counts by 1, and is tested before its body runs.
    fn count(&mut self) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let equals = self.text.bytes()[from..].iter().position(|&byte| byte == b'=');
        let Some(equals) = equals else {
            return not_decided(self.text.rest(), "FOR without a counter");
        };
        let name = String::from_utf8_lossy(&self.text.bytes()[from..from + equals])
            .trim()
            .to_owned();
        let counter = self.text.range(from, from + equals);
        self.text.go_to(from + equals + 1);
        let first = if self.again {
            // its first value is not read again
            let end = self.own.evaluate(self.text.bytes(), from + equals + 1);
            self.text.go_to(end.map_or(from + equals + 1, |found| found.2));
            match self.own.value(&name) {
                Some(value) => value + 1.0,
                None => return not_decided(counter, format!("{name}: the counter of FOR is unknown")),
            }
        } else {
            self.whole("the first value of FOR")?
        };
        if self.text.letters() != "TO" {
            return not_decided(self.text.rest(), "FOR without TO");
        }
        let at = self.text.at();
        let last = self.whole("the last value of FOR")?;
        if first.fract() != 0.0 {
            return not_decided(
                counter,
                format!("{name}: the counter of FOR is {first}, not a whole number"),
            );
        }
        let known = if self.again {
            self.own.counted_to.get(&self.place)
        } else {
            None
        };
        if known.is_some_and(|&known| known != last) {
            let what = "the last value of FOR, which changes while the loop runs";
            return not_decided(self.text.range(at, at + 1), what);
        }
        self.own.counted_to.insert(self.place, last);
        self.own.assign(&name, Some(first));
        Ok(Transfer::Open(first <= last))
    }

    /// `CASE(R1) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`.
    fn case(&mut self) -> Result<Transfer, Trouble> {
        let value = self.whole("CASE")?;
        if self.text.letters() != "OF" {
            return not_decided(self.text.rest(), "CASE without OF");
        }
        let (mut taken, mut other) = (None, None);
        while !self.text.is_at_end() {
            let constant = self.text.integer();
            let at = self.text.at();
            let is_default = constant.is_none() && self.text.letters() == "DEFAULT";
            if constant.is_none() && !is_default {
                self.text.go_to(at);
                return not_decided(self.text.rest(), "a CASE that is not understood");
            }
            let Some(jump) = self.jump()? else {
                return not_decided(self.text.rest(), "CASE without GOTO");
            };
            match constant {
                Some(constant) if constant == value && taken.is_none() => taken = Some(jump),
                None => other = Some(jump),
                Some(_) => {}
            }
        }
        Ok(taken.or(other).unwrap_or(Transfer::Next))
    }

    /// `REPEAT A P=3`, `REPEAT A B P=3`, `REPEATB A P=3`.
    fn repeat(&mut self, keyword: &str) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let mut names = Vec::new();
        let mut times = 1.0;
        while !self.text.is_at_end() {
            let at = self.text.at();
            let word = self.text.word();
            let end = self.text.at();
            let number = word
                .strip_prefix('P')
                .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
            match number {
                // a label begins with two letters
                Some(digits) => {
                    self.text
                        .go_to(at + 1 + if digits.is_empty() { 0 } else { end - at - 1 });
                    if digits.is_empty() {
                        self.text.eat(b'=');
                        times = self.whole("the repetitions of REPEAT")?;
                    } else {
                        times = digits.parse().unwrap_or(f64::NAN);
                    }
                    break;
                }
                None if word.is_empty() => break,
                None => names.push((word, self.text.range(at, end))),
            }
        }
        let whole = self.text.range(from, self.text.bytes().len());
        if !(1.0..=f64::from(u32::MAX)).contains(&times) {
            return not_decided(whole, format!("how often {keyword} repeats: {times} times"));
        }
        let index = (self.index)();
        let here = self.place.1;
        let mut blocks = Vec::new();
        for (name, range) in &names {
            blocks.push(self.only(&index, name, *range)?);
        }
        let section = index.section(here);
        let end_label = Key::Name("ENDLABEL".into());
        let found = match (keyword, blocks.as_slice()) {
            ("REPEATB", &[only]) => Some((only, only)),
            ("REPEAT", &[first, last]) => Some((first, last)),
            ("REPEAT", &[first]) if first < here => {
                let marked = index.all(&end_label, (first, here)).next();
                Some((first, marked.unwrap_or(here - 1)))
            }
            ("REPEAT", &[first]) => index
                .all(&end_label, (first, section.1))
                .next()
                .map(|last| (first, last)),
            _ => None,
        };
        match found {
            Some((first, last)) if first <= last && !(first..=last).contains(&here) => Ok(Transfer::Repeat {
                first,
                last,
                times: times as u32,
            }),
            _ => not_decided(whole, format!("which blocks {keyword} repeats")),
        }
    }

    /// The block of a label that REPEAT names. If it is both before and after the statement, it is not documented which one is used.
    fn only(&self, index: &Index, name: &str, range: TextRange) -> Result<u32, Trouble> {
        let here = self.place.1;
        let section = index.section(here);
        let key = match name.strip_prefix('N').and_then(|digits| digits.parse().ok()) {
            Some(number) => Key::Number(number),
            None => Key::Name(name.into()),
        };
        let before = index.all(&key, (section.0, here)).next_back();
        let after = index.all(&key, (here, section.1)).next();
        match (before, after) {
            (Some(block), None) | (None, Some(block)) => Ok(block),
            (None, None) => Err((
                range,
                super::no_label(format!("there is no label {name} in this program"), true),
            )),
            (Some(_), Some(_)) => not_decided(
                range,
                format!("{name}: the label is defined both before and after REPEAT"),
            ),
        }
    }
}
