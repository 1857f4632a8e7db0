//! What an ISO block asks for beside its motions: each word is held by motions, has a name of its own, or is the control's own.
use super::ask::{Ask, Found, Why};
use super::ask_code::{Held, by_code};
use std::collections::BTreeSet;
use trunnion_dialect::{Action, Code, Dialect, Role};
use trunnion_interp::AllClampCodes;
use trunnion_syntax::{Address, Block, Call, Item, Program, TextRange, Value, Word};

/// Keywords of comments that LinuxCNC acts on, and whether they only show a text.
const ACTIVE: &[(&str, bool)] = &[
    ("MSG", true),
    ("DEBUG", true),
    ("PRINT", true),
    ("LOG", false),
    ("LOGOPEN", false),
    ("LOGAPPEND", false),
    ("LOGCLOSE", false),
    ("PROBEOPEN", false),
    ("PROBECLOSE", false),
    ("ABORT", false),
    ("PY", false),
];

/// Reads block after block: what words mean depends on the codes in effect.
pub(super) struct Blocks<'a> {
    program: &'a Program,
    dialect: &'a Dialect,
    clamps: &'a AllClampCodes,
    /// Active codes of the groups whose words may come in a later block.
    motion: Option<&'a Code>,
    cycle: Option<&'a Code>,
    /// Variables that the program declares for itself, upper case.
    local: BTreeSet<String>,
}

/// A code in a block, and how it is written.
struct Coded<'a> {
    code: &'a Code,
    range: TextRange,
    /// Its name with words that belong to it.
    text: String,
    held: Held,
}

impl<'a> Blocks<'a> {
    pub(super) fn new(program: &'a Program, dialect: &'a Dialect, clamps: &'a AllClampCodes) -> Self {
        let mut local = BTreeSet::new();
        if dialect.quirks.user_names() {
            for block in program.blocks() {
                for item in block.items() {
                    if let Item::Call(call) = item {
                        declared(program, dialect, &call, &mut local);
                    }
                }
            }
        }
        Self {
            program,
            dialect,
            clamps,
            motion: None,
            cycle: None,
            local,
        }
    }

    pub(super) fn next(&mut self, block: &Block<'_>) -> Found {
        let mut found = Found::default();
        let items: Vec<Item> = block.items().collect();
        let mut codes: Vec<Coded<'a>> = Vec::new();
        for item in &items {
            match item {
                Item::Word(word) => self.code(word, &mut codes, &mut found),
                Item::Call(call) => self.name(call, &mut codes, &mut found),
                Item::Comment(comment) => self.comment(&self.program.text(comment.inner), comment.range, &mut found),
                Item::Skip(_, range) => found.own(*range, "/", "/", Why::Switch),
                Item::Percent(_) | Item::Label(_) | Item::Other(_) => {}
            }
        }
        let calls = codes.iter().any(|coded| coded.code.action == Action::SubprogramCall);
        let declares = codes.iter().any(|coded| coded.code.action == Action::Declaration);
        for item in &items {
            match item {
                Item::Word(word) => self.word(word, &mut codes, (calls, declares), &mut found),
                Item::Other(range) if !calls => {
                    let text = self.program.text(*range);
                    if !text.trim().is_empty() {
                        // a `/` inside a block deletes the rest of it
                        let why = if text.trim() == "/" { Why::Switch } else { Why::Machine };
                        found.own(*range, plain(&text), plain(&text), why);
                    }
                }
                _ => {}
            }
        }
        for coded in codes {
            by_code(
                coded.code,
                coded.held,
                coded.range,
                &coded.text,
                self.dialect,
                &mut found,
            );
        }
        // in the order of the text, so that the first to be refused is the first that is read
        found.asks.sort_by_key(|(range, _)| range.start);
        found
    }

    /// A G or M word.
    fn code(&mut self, word: &Word, codes: &mut Vec<Coded<'a>>, found: &mut Found) {
        let Address::Letter(letter) = word.address else { return };
        let role = self.dialect.role(letter);
        if !matches!(role, Some(Role::G | Role::M)) {
            return;
        }
        let text = plain(&self.program.text(word.range));
        let Value::Number(number) = word.value else {
            found.own(word.range, text.clone(), text, Why::Machine);
            return;
        };
        let tenths = (number.to_f64() * 10.0).round();
        let is_g = role == Some(Role::G);
        let name = named(if is_g { 'G' } else { 'M' }, tenths);
        let code = if (0.0..1e6).contains(&tenths) {
            let tenths = tenths as u32;
            if is_g {
                self.dialect.g(tenths)
            } else {
                self.dialect.m(tenths)
            }
        } else {
            None
        };
        if !is_g && tenths >= 0.0 && self.is_clamp(number.to_f64()) {
            found.asks.push((word.range, Ask::Clamp(name)));
            return;
        }
        let Some(code) = code else {
            found.own(word.range, name.clone(), name, Why::Machine);
            return;
        };
        if is_g {
            self.remember(code);
        }
        codes.push(Coded {
            code,
            range: word.range,
            text: name,
            held: Held::Whole,
        });
    }

    fn is_clamp(&self, number: f64) -> bool {
        let is = |code: u16| number.total_cmp(&f64::from(code)).is_eq();
        self.clamps.iter().flatten().any(|codes| is(codes.on) || is(codes.off))
    }

    /// Codes whose words may stand alone in later blocks.
    fn remember(&mut self, code: &'a Code) {
        let group = code.group.as_deref();
        if code.action == Action::CycleOff {
            (self.motion, self.cycle) = (None, None);
        } else if code.action.is_hole_cycle() || matches!(code.action, Action::CannedCycle) || group == Some("cycle") {
            self.cycle = Some(code);
        } else if group == Some("motion") {
            (self.motion, self.cycle) = (Some(code), None);
        }
    }

    /// A name with or without arguments.
    fn name(&mut self, call: &Call, codes: &mut Vec<Coded<'a>>, found: &mut Found) {
        let name = self.program.text(call.name);
        let text = plain(&self.program.text(call.range));
        match self.dialect.name(&name) {
            Some(code) => {
                let empty = call
                    .arguments
                    .is_none_or(|range| self.program.text(range).trim().is_empty());
                codes.push(Coded {
                    code,
                    range: call.range,
                    text,
                    held: if empty { Held::Bare } else { Held::Whole },
                });
            }
            None => found.own(call.range, name.to_ascii_uppercase(), text, Why::Machine),
        }
    }

    fn comment(&self, text: &str, range: TextRange, found: &mut Found) {
        let Some((head, _)) = text.split_once(',').filter(|_| self.dialect.quirks.rs274()) else {
            return;
        };
        let head = head.trim().to_ascii_uppercase();
        match ACTIVE.iter().find(|(name, _)| *name == head) {
            Some((_, true)) => found.asks.push((range, Ask::Idle(format!("({head},...)")))),
            Some((_, false)) => found.own(range, head, plain(text), Why::Stored),
            None => {}
        }
    }

    /// A word that is not a code.
    fn word(&self, word: &Word, codes: &mut [Coded<'a>], (calls, declares): (bool, bool), found: &mut Found) {
        let text = plain(&self.program.text(word.range));
        let role = match word.address {
            Address::Letter(letter) => self.dialect.role(letter),
            Address::Indexed(letter, number) => {
                let name = format!("{}{number}", char::from(letter));
                self.dialect.named_role(name.as_bytes())
            }
            Address::Named(range) => return self.named_word(word, range, (calls, declares), &text, found),
        };
        let why = match role {
            Some(Role::G | Role::M) if matches!(word.address, Address::Letter(_)) => return,
            Some(Role::Parameter) => match word.address {
                Address::Letter(letter) if calls || self.is_read(letter, &text, codes) => return,
                _ => Why::Machine,
            },
            Some(Role::Variable) => Why::Stored,
            Some(role) if is_held(role) => {
                if let Address::Letter(letter) = word.address {
                    belongs(letter, &text, codes);
                }
                return;
            }
            // arguments of a call are variables of the program that is called
            _ if calls && matches!(word.address, Address::Letter(_)) => return,
            _ => Why::Machine,
        };
        let name = match word.address {
            Address::Letter(_) => text.clone(),
            _ => text.split('=').next().unwrap_or(&text).to_owned(),
        };
        found.own(word.range, name, text, why);
    }

    /// A word with `=`.
    fn named_word(
        &self,
        word: &Word,
        address: TextRange,
        (calls, declares): (bool, bool),
        text: &str,
        found: &mut Found,
    ) {
        let name = plain(&self.program.text(address));
        let stem = name.split(['[', '(']).next().unwrap_or(&name).trim();
        if name.starts_with('#') {
            if self.is_kept(&name) {
                let why = if waits(&name) { Why::Waits } else { Why::Stored };
                found.own(word.range, name, text, why);
            }
            return;
        }
        let corner = matches!(name.as_str(), ",R" | ",C") && self.dialect.quirks.corner_words;
        if corner || declares || self.local.contains(stem) {
            return;
        }
        match self.dialect.named_role(stem.as_bytes()) {
            Some(role) if is_held(role) => {}
            Some(Role::Variable) => found.own(word.range, name, text, Why::Stored),
            Some(_) => {
                let why = match stem {
                    "SPOS" | "SPOSA" => Why::Oriented,
                    "LIMS" => Why::SpindleLimit,
                    "CTOL" | "OTOL" | "ATOL" => Why::PathControl,
                    _ => Why::Machine,
                };
                found.own(word.range, stem, text, why);
            }
            None => {
                let code = self.dialect.name(stem);
                let why = match code.map(|code| code.action) {
                    Some(Action::PathMode | Action::NoMotion) => Why::PathControl,
                    _ if calls => return,
                    _ => Why::Stored,
                };
                found.own(word.range, stem, text, why);
            }
        }
    }

    /// Whether a `#` variable outlives the program, or does something when it is written. One whose number is computed is treated so.
    fn is_kept(&self, name: &str) -> bool {
        let rest = name[1..].trim();
        if let Some(own) = rest.strip_prefix('<') {
            // `#<name>` ends with the program, `#<_name>` is global
            return own.trim_start().starts_with('_');
        }
        let Ok(number) = rest.parse::<u32>() else { return true };
        if self.dialect.quirks.rs274() {
            return number > 30;
        }
        // common variables from 500 on are kept; up to 199 they are the program's own or cleared when the control is switched on
        number >= 500
    }

    /// Whether a parameter word is read by a code of the block or by an active one. It then belongs to the text of that code.
    fn is_read(&self, letter: u8, text: &str, codes: &mut [Coded<'a>]) -> bool {
        // the offset of the compensation, whose path the motions hold
        belongs(letter, text, codes)
            || letter == b'D'
            || [self.motion, self.cycle]
                .into_iter()
                .flatten()
                .any(|code| reads(code, letter))
    }
}

/// Adds a word to the text of the code that reads it; whether there is one.
fn belongs(letter: u8, text: &str, codes: &mut [Coded<'_>]) -> bool {
    match codes.iter_mut().find(|coded| reads(coded.code, letter)) {
        Some(coded) => {
            coded.text.push(' ');
            coded.text.push_str(text);
            true
        }
        None => false,
    }
}

fn reads(code: &Code, letter: u8) -> bool {
    code.words.iter().any(|word| word.as_bytes() == [letter])
}

/// Words that motions, tools, feeds and spindle speeds hold.
fn is_held(role: Role) -> bool {
    matches!(
        role,
        Role::BlockNumber
            | Role::ProgramNumber
            | Role::Axis
            | Role::ArcCentre
            | Role::ArcRadius
            | Role::ArcTurns
            | Role::ToolVector
            | Role::PathWord
            | Role::PostureStatus
            | Role::PostureTurn
            | Role::Feed
            | Role::Speed
            | Role::Tool
            | Role::LengthOffset
            | Role::EdgeOffset
            | Role::Increment
    )
}

/// `#3000` raises an alarm, `#3006` stops with a message.
fn waits(name: &str) -> bool {
    matches!(name[1..].trim(), "3000" | "3006")
}

/// Names after DEF, PROC and the like.
fn declared(program: &Program, dialect: &Dialect, call: &Call, local: &mut BTreeSet<String>) {
    let is = |code: &Code| code.action == Action::Declaration;
    if !dialect.name(&program.text(call.name)).is_some_and(is) {
        return;
    }
    let Some(arguments) = call.arguments else { return };
    let text = program.text(arguments).to_ascii_uppercase();
    let parts = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    local.extend(
        parts
            .filter(|part| part.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_'))
            .map(str::to_owned),
    );
}

/// `G43.4`, `M6`.
fn named(letter: char, tenths: f64) -> String {
    if tenths % 10.0 == 0.0 {
        format!("{letter}{}", tenths / 10.0)
    } else {
        format!("{letter}{:.1}", tenths / 10.0)
    }
}

/// Upper case, blanks as one.
pub(super) fn plain(text: &str) -> String {
    let text = text.to_ascii_uppercase();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
