//! What is recorded at a block apart from its effects: what something unmodelled could read, and words that restate what may be lost.
use crate::item::{Around, Waiting, Waits};
use crate::process::{Process, Restated};
use crate::since::{keeps_place, only_steers, reads_data, writes_control, writes_data};
use crate::steps::Steps;
use std::sync::Arc;
use trunnion_dialect::Role;
use trunnion_interp::{Argument, Effect, Situation};
use trunnion_syntax::{Address, BlockId, Format, Item as AnyItem, Value as SyntaxValue};

impl Steps<'_> {
    /// Gives those effects of a block that depend on other state what they may read. `before`: what was in effect and set before the
    /// block; `effects`: how many effects there were; `own_locals`: what runs there begins with its own local variables.
    pub(super) fn note_situation(
        &mut self,
        before: (Situation, Arc<Process>),
        effects: u32,
        lost: bool,
        own_locals: bool,
    ) {
        // in order of `before`; while motions are held back, what came before this block waits too
        let new = self.run.waiting.partition_point(|waiting| waiting.before <= effects);
        let mut own = false;
        let (mut opaque, mut builder) = (false, false);
        for waiting in self.run.waiting.range(new..) {
            own |= waiting.is_own_code();
            opaque |= waiting.is_unmodelled() || waiting.is_own_code();
            builder |= waiting.is_builder_code();
        }
        if opaque {
            let around = Arc::new(Around {
                situations: [before.0, self.interpreter.situation()],
                process: before.1,
            });
            // an M code of the machine builder may call a macro, which reads common variables; locals are its own
            let own_locals = own_locals || builder && !(lost || own);
            let mut variables = (lost || own || builder).then(|| self.interpreter.known_variables());
            self.run.actions.add_variables(variables.as_ref().map_or(0, Vec::len));
            if let Some(variables) = variables.as_mut().filter(|_| own_locals) {
                variables.retain(|variable| !is_local(&variable.name));
            }
            for waiting in self.run.waiting.range_mut(new..) {
                if !(waiting.is_unmodelled() || waiting.is_own_code()) {
                    continue;
                }
                waiting.around = Some(Arc::clone(&around));
                if let (Waits::Effect(Effect::Unmodelled(words) | Effect::Event(words), _), Some(variables)) =
                    (&mut waiting.what, variables.take())
                {
                    words.extend(variables);
                }
            }
        }
        for waiting in self.run.waiting.range_mut(new..) {
            match &mut waiting.what {
                Waits::Effect(Effect::Set { to: words, .. }, _) if words.is_empty() => {}
                Waits::Effect(Effect::Set { to: words, .. } | Effect::Event(words) | Effect::Unmodelled(words), _) => {
                    let written = words.len();
                    self.interpreter.add_values(words);
                    self.run.actions.add_variables(words.len() - written);
                }
                Waits::Effect(Effect::Store(_) | Effect::End(_), _)
                | Waits::Restated(..)
                | Waits::Lost
                | Waits::Written => {}
            }
        }
        self.note_written(new);
        if lost || own {
            self.since.lost = true;
            self.run.wait(self.run.count + 1, BlockId(0), Waits::Lost);
        }
    }

    /// Data that offsets are read from may have been written in this block. LinuxCNC's and grbl's own rules are modelled: there nothing is open.
    fn note_written(&mut self, new: usize) {
        let quirks = &self.input.dialect.quirks;
        if quirks.rs274() || self.input.program.options().format != Format::Iso && !quirks.user_names() {
            return;
        }
        let writes = |waiting: &Waiting| matches!(&waiting.what, Waits::Effect(effect, _) if writes_data(effect));
        if self.run.waiting.range(new..).any(writes) {
            self.since.written = true;
            self.run.wait(self.run.count + 1, BlockId(0), Waits::Written);
        }
    }

    /// Words of a block of the main program: what they restate matters if everything was unknown, and what they change may move the
    /// coordinates.
    pub(super) fn note_block(&mut self, block: BlockId, effects: u32, lost: bool) {
        if self.input.program.options().format == Format::Apt {
            return;
        }
        // a block of a loop is read once, as long as what it restates does not count
        if lost || !(self.since.lost || self.since.written) {
            let known = self.disturbs[block.0 as usize];
            let disturbs = known.unwrap_or_else(|| {
                let before = std::mem::take(&mut self.since.disturbed);
                self.read_block(block, effects, false);
                let found = std::mem::replace(&mut self.since.disturbed, before);
                self.disturbs[block.0 as usize] = Some(found);
                found
            });
            self.since.disturbed |= disturbs;
        } else {
            self.read_block(block, effects, true);
        }
    }

    /// See [`Self::note_block`]; `restates`: whether what it restates counts.
    fn read_block(&mut self, block: BlockId, effects: u32, restates: bool) {
        let (program, dialect) = (self.input.program, self.input.dialect);
        let view = program.block(block);
        let text = program.text(view.range());
        if program.options().format == Format::Klartext {
            self.since.disturbed |= !crate::klartext::keeps_place(&text);
            return;
        }
        if only_steers(&text) {
            return;
        }
        let all = self.since.lost;
        for item in view.items() {
            let (key, to, reads) = match item {
                AnyItem::Word(word) => {
                    let Address::Letter(letter) = word.address else {
                        self.since.disturbed |= writes_control(&program.text(word.range));
                        continue;
                    };
                    let letter = letter.to_ascii_uppercase();
                    let role = dialect.role(letter);
                    if matches!(role, Some(Role::G | Role::M)) {
                        let number = match word.value {
                            SyntaxValue::Number(number) => (number.to_f64() * 10.0).round(),
                            _ => -1.0,
                        };
                        let known = (0.0..1e6).contains(&number).then_some(number as u32);
                        let code = known.and_then(|tenths| match role {
                            Some(Role::G) => dialect.g(tenths),
                            _ => dialect.m(tenths),
                        });
                        self.since.disturbed |= code.is_none_or(|code| !keeps_place(code, dialect));
                        let Some(code) = code else { continue };
                        let key = code.group.clone().unwrap_or_else(|| code.id.clone());
                        (key, code.id.clone(), reads_data(code))
                    } else if matches!(letter, b'F' | b'S' | b'T' | b'D' | b'H') {
                        self.since.disturbed |= matches!(letter, b'D' | b'H');
                        let text = program.text(word.value_range).into_owned();
                        // T of a turret brings its offsets, D of a Sinumerik those of the edge
                        let turret = dialect.quirks.tool_word.changes();
                        let reads = matches!(letter, b'D' | b'H') || letter == b'T' && turret;
                        (char::from(letter).to_string(), text, reads)
                    } else {
                        continue;
                    }
                }
                AnyItem::Call(call) => {
                    let code = dialect.name(&program.text(call.name));
                    self.since.disturbed |= code.is_none_or(|code| !keeps_place(code, dialect));
                    let Some(code) = code else { continue };
                    let key = code.group.clone().unwrap_or_else(|| code.id.clone());
                    (key, code.id.clone(), reads_data(code))
                }
                AnyItem::Other(range) => {
                    self.since.disturbed |= writes_control(&program.text(range));
                    continue;
                }
                _ => continue,
            };
            if restates && (all || reads) {
                let to = self.interpreter.resolved_text(&trunnion_interp::canonical_text(&to));
                let to = vec![Argument::text("", &to)];
                // what it reads is what was written up to here
                let word = Restated { group: key, reads };
                // before the motion of its block
                self.run.wait(effects, block, Waits::Restated(word, to));
            }
        }
    }
}

/// #1 to #33 of Macro B.
fn is_local(name: &str) -> bool {
    let number = name.strip_prefix('#').and_then(|digits| digits.parse::<u32>().ok());
    number.is_some_and(|number| number <= 33)
}

/// A text in which variables of Macro B with a known value are replaced by it.
pub(super) fn with_values(text: &str, known: &[Argument]) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('#') {
        let digits = rest[at + 1..].bytes().take_while(u8::is_ascii_digit).count();
        let (name, after) = rest[at..].split_at(1 + digits);
        out.push_str(&rest[..at]);
        match known
            .iter()
            .find(|variable| variable.name == name)
            .map(|variable| &variable.value)
        {
            Some(trunnion_interp::Value::Number(value)) => out.push_str(&value.to_string()),
            _ => out.push_str(name),
        }
        rest = after;
    }
    out + rest
}

/// The words of a macro call in one order. I, J and K keep their order, which decides to which variables they go (Series 30i operator's manual,
/// custom macro, argument specification II).
pub(super) fn arguments_in_order(text: &str) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut deep = 0;
    for sign in text.chars() {
        match words.last_mut() {
            Some(word) if deep > 0 || !sign.is_ascii_alphabetic() => word.push(sign),
            _ => words.push(sign.to_string()),
        }
        deep += i32::from(sign == '[') - i32::from(sign == ']');
    }
    // the code and its program come first, as in a usual call
    let key = |word: &String| match word.as_bytes().first() {
        Some(b'G') => 0,
        Some(b'P') => 1,
        Some(b'I' | b'J' | b'K') => b'I',
        first => first.copied().unwrap_or_default(),
    };
    words.sort_by_key(key);
    words.concat()
}

#[cfg(test)]
mod tests {
    use super::arguments_in_order;

    #[test]
    fn arguments_of_a_macro_have_no_order_but_i_j_k() {
        let [one, other] = ["G65P100B[#500*ABS[2]]A1", "G65A1P100B[#500*ABS[2]]"].map(arguments_in_order);
        assert_eq!(one, other);
        assert_ne!(arguments_in_order("G65P1I1J2"), arguments_in_order("G65P1J2I1"));
    }
}
