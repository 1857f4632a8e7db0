//! What a line of a LinuxCNC program does apart from its motions and calls, as it is compared.
use super::handed::{Handed, hands_values};
use super::stored::stored_offsets;
use super::{Codes, Ngc};
use crate::engine::Engine;
use crate::words::Words;
use crate::written::{Keep, resolved, written};
use crate::{Argument, Effect, Sink};
use trunnion_ngc::{At, FileId};
use trunnion_syntax::{BlockId, Item, Program};

impl Ngc<'_> {
    /// What the line does that is neither in its motions nor in its calls.
    #[cold]
    pub(super) fn line_effect(&mut self, program: &Program, block: BlockId, at: At, sink: &mut impl Sink) {
        let Some(run) = &mut self.run else { return };
        let has_other_effects = std::mem::take(&mut run.calls.has_other_effects);
        let unknown_end = std::mem::take(&mut run.calls.unknown_end);
        let text = run.engine.text_of(at.file, at.line);
        let codes = Codes::of(run.engine.block_at(at));
        let upper = crate::written::packed(&text);
        let names = crate::written::names(&text);
        self.line_events(program, block, (at, &text, &upper), &codes, sink);
        // the control keeps what is written to its offsets, also where that is what they are without a declaration
        let unit = self.core.state.coordinates.unit_mm();
        let stores = stored_offsets(&upper, &names, unit, |name| self.variable(name));
        let from_here = |store: &Argument| store.name.starts_with("G10 L20") || store.name == "written by G10";
        if upper.contains("L20") && stores.iter().any(from_here) {
            self.core.set_from_here(block, Some("G10 L20"));
            self.hand_on(sink);
        }
        for store in stores {
            self.core.effects.add(block, Effect::Store(store));
            self.hand_on(sink);
        }
        let in_main = at.file == FileId::MAIN;
        if codes.own && in_main {
            self.own_code(program, block, sink);
        }
        if let Some(handed) = hands_values(&upper) {
            self.handed(handed, &upper, block, sink);
            return;
        }
        let lost = codes.shifts && (codes.ninth || self.core.state.position.xyz().is_none());
        let unknown = lost || names.iter().any(|name| self.is_unknown(name));
        if !(has_other_effects || unknown_end || unknown) {
            return;
        }
        if names
            .iter()
            .any(|name| name.to_ascii_lowercase().starts_with("#<_value"))
        {
            let returned = self.run.as_mut().and_then(|run| run.calls.returned.take());
            self.unmodelled(block, returned.unwrap_or_default(), sink);
        }
        let words = if in_main {
            let keep = if unknown_end || unknown {
                Keep::All
            } else {
                Keep::BesideMotion
            };
            written(&program.block(block), self, &Words::default(), keep)
        } else {
            vec![Argument::text("", &resolved(self, &text))]
        };
        self.unmodelled(block, words, sink);
    }

    /// A block that may be skipped, an M99 of the main program, and moves to points of the machine.
    fn line_events(
        &mut self,
        program: &Program,
        block: BlockId,
        (at, text, upper): (At, &str, &str),
        codes: &Codes,
        sink: &mut impl Sink,
    ) {
        let in_main = at.file == FileId::MAIN;
        let skip = match program.block(block).items().next() {
            Some(Item::Skip(level, _)) if self.core.setup.control.block_delete.is_none() => Some(level),
            _ => None,
        };
        if let Some(level) = skip.filter(|_| in_main) {
            let words = vec![Argument::number("/", f64::from(level))];
            let effect = Effect::Event(words);
            self.core.effects.add_with(block, effect, crate::Reach::Itself);
            self.hand_on(sink);
        }
        let Some(run) = &mut self.run else { return };
        // in the main program it starts again, or ends, as the control is set up
        if (codes.returns || is_return(upper)) && run.calls.places.chain(at) == crate::ChainId::MAIN {
            self.core.effects.add(block, Effect::End(vec![Argument::code("M99")]));
            self.hand_on(sink);
        }
        // which point it is, and that the control moves there even where no axis is named
        if ["G28", "G30", "G43.2", "M19"].iter().any(|code| upper.contains(code)) {
            let words = if in_main {
                written(&program.block(block), self, &Words::default(), Keep::All)
            } else {
                vec![Argument::text("", &resolved(self, text))]
            };
            let counts = |word: &Argument| matches!(word.name.as_ref(), "G" | "M" | "H" | "R" | "P" | "Q" | "");
            let words = words.into_iter().filter(counts).collect();
            self.core.effects.add(block, Effect::Event(words));
            self.hand_on(sink);
        }
    }

    /// What the machine's own codes do is unknown: they may read any word of their line.
    fn own_code(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        let held = |word: &Argument| {
            let letter = word.name.as_bytes();
            matches!(
                letter,
                [b'G' | b'M' | b'F' | b'S' | b'T' | b'D' | b'H' | b'A'..=b'C' | b'U'..=b'Z']
            )
        };
        let words = written(&program.block(block), self, &Words::default(), Keep::All);
        let words = words.into_iter().filter(|word| !held(word)).collect();
        self.unmodelled(block, words, sink);
    }

    /// The line passes values to a subroutine or to its caller: it matters if some of them are unknown. By now the local variables are
    /// those of the subroutine, or those of the caller.
    fn handed(&mut self, handed: Handed, line: &str, block: BlockId, sink: &mut impl Sink) {
        let words = vec![Argument::text("", line)];
        match handed {
            Handed::ToSubroutine => {
                // in a definition that is skipped nothing is called
                let called = self.run.as_ref().is_some_and(|run| !run.engine.is_defining());
                if called && (1..=30).any(|number| self.is_unknown(&format!("#{number}"))) {
                    self.unmodelled(block, words, sink);
                }
            }
            Handed::ToCaller => {
                // the control sets it in a definition that is skipped, too; it matters where the program reads it
                let returned = self.is_unknown("#<_value>").then_some(words);
                if let Some(run) = &mut self.run {
                    run.calls.returned = returned;
                }
            }
        }
    }

    fn is_unknown(&self, name: &str) -> bool {
        self.variable(name).is_some_and(f64::is_nan)
    }

    fn unmodelled(&mut self, block: BlockId, words: Vec<Argument>, sink: &mut impl Sink) {
        if !words.is_empty() {
            self.core.effects.add(block, Effect::Unmodelled(words));
            self.hand_on(sink);
        }
    }
}

/// Whether a line is M99, which is read as a line of the flow and not as a block.
fn is_return(line: &str) -> bool {
    let line = line.trim_start_matches('/');
    let after_number = line.strip_prefix('N');
    let line = after_number.map_or(line, |rest| {
        rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.')
    });
    let digits = line.strip_prefix('M').unwrap_or_default();
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    digits[..end].parse() == Ok(99)
}
