//! What is noted at a block beside its effects: what something that is not modelled could read, and words that restate what may be lost.
use crate::since::{is_own_code, keeps_place, writes_control};
use crate::steps::Steps;
use std::sync::Arc;
use trunnion_dialect::Role;
use trunnion_interp::{Argument, Effect, Placed, Sink as _, Situation};
use trunnion_syntax::{Address, BlockId, Format, Item as AnyItem, Value as SyntaxValue};

impl Steps<'_> {
    /// Gives the effects of a block that something else may decide what that may read. `effects`: how many there were before the block.
    pub(super) fn note_situation(&mut self, before: Situation, effects: u32, lost: bool) {
        let own_code = |effect: &Effect| self.input.dialect.quirks.rs274() && is_own_code(effect);
        let counts = |effect: &Effect| matches!(effect, Effect::Unmodelled(_)) || own_code(effect);
        // while motions are held back the effects before this block wait too
        let new = self.run.effects.partition_point(|(index, ..)| *index < effects);
        let fresh = self.run.effects.range(new..);
        let own = fresh.clone().any(|(_, placed, _)| own_code(&placed.effect));
        let opaque = fresh.clone().any(|(_, placed, _)| counts(&placed.effect));
        let first = fresh.map(|(_, placed, _)| placed.block).next();
        if opaque {
            let situation = Arc::new([before, self.interpreter.situation()]);
            let mut variables = (lost || own).then(|| self.interpreter.known_variables());
            for (_, placed, at) in self.run.effects.range_mut(new..) {
                if !(matches!(placed.effect, Effect::Unmodelled(_)) || is_own_code(&placed.effect)) {
                    continue;
                }
                *at = Some(Arc::clone(&situation));
                if let (Effect::Unmodelled(words) | Effect::Event(words), Some(variables)) =
                    (&mut placed.effect, variables.take())
                {
                    words.extend(variables);
                }
            }
        }
        for (_, placed, _) in self.run.effects.range_mut(new..) {
            match &mut placed.effect {
                Effect::Set { to: words, .. } if words.is_empty() => {}
                Effect::Set { to: words, .. } | Effect::Event(words) | Effect::Unmodelled(words) => {
                    self.interpreter.add_values(words);
                }
                Effect::Store(_) | Effect::End(_) => {}
            }
        }
        if lost || own {
            let block = first.unwrap_or(BlockId(0));
            for key in self.since.lose() {
                let effect = Effect::set(key, []);
                self.run.effect(Placed { block, effect });
            }
        }
    }

    /// Words of a block of the main program: what they restate counts where everything was unknown, and what they change may move the
    /// coordinates.
    pub(super) fn note_block(&mut self, block: BlockId, lost: bool) {
        let (program, dialect) = (self.input.program, self.input.dialect);
        if program.options().format == Format::Apt {
            return;
        }
        let view = program.block(block);
        for item in view.items() {
            let (key, to) = match item {
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
                        self.since.disturbed |= code.is_none_or(|code| !keeps_place(code));
                        let Some(code) = code else { continue };
                        let key = code.group.clone().unwrap_or_else(|| code.id.clone());
                        (key, code.id.clone())
                    } else if matches!(letter, b'F' | b'S' | b'T' | b'D' | b'H') {
                        self.since.disturbed |= matches!(letter, b'D' | b'H');
                        let text = program.text(word.value_range).into_owned();
                        (char::from(letter).to_string(), text)
                    } else {
                        continue;
                    }
                }
                AnyItem::Call(call) => {
                    let code = dialect.name(&program.text(call.name));
                    self.since.disturbed |= code.is_none_or(|code| !keeps_place(code));
                    let Some(code) = code else { continue };
                    let key = code.group.clone().unwrap_or_else(|| code.id.clone());
                    (key, code.id.clone())
                }
                AnyItem::Other(range) => {
                    self.since.disturbed |= writes_control(&program.text(range));
                    continue;
                }
                _ => continue,
            };
            if !lost && let Some(key) = self.since.restated(&key) {
                let effect = Effect::set(key, [Argument::text("", &trunnion_interp::canonical_text(&to))]);
                self.run.effect(Placed { block, effect });
            }
        }
    }
}
