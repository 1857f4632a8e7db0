//! Lines whose effect is known by their words alone: commands of grbl, blocks inside the contour of a turning cycle.
use crate::iso::Iso;
use crate::words::Words;
use crate::written::{Keep, written};
use crate::{Argument, Effect};
use trunnion_syntax::Block;

impl Iso<'_> {
    /// A command of grbl (`$H`), one of its settings (`$32=1`), or one of its realtime characters, which act when they arrive (grbl 1.1
    /// documentation, interface and commands). Whether the whole line is done with: it was a command or setting.
    pub(crate) fn grbl_line(&mut self, view: &Block<'_>, sink: &mut impl crate::Sink) -> bool {
        let wanted = self.core.effects.wanted();
        let first = view.first_byte();
        if !wanted && !matches!(first, Some(b'$' | b' ' | b'\t')) {
            return false;
        }
        let text = view.program().text(view.range());
        // grbl drops blanks as it reads a line (grbl 1.1, protocol.c)
        let is_command = text.trim_start().starts_with('$');
        let text = text.trim();
        let bare = text.split([';', '(']).next().unwrap_or_default();
        if wanted && (is_command || bare.contains(['!', '~', '?', '\u{18}'])) {
            let words = vec![Argument::text("", &crate::canonical_text(text))];
            self.unmodelled_line(view, words, sink);
        }
        if is_command {
            self.grbl_command(view, bare.trim(), sink);
        }
        is_command
    }

    /// What a command does to the axes. Reports, the unlocking `$X` and the sleep mode move nothing and change no setting.
    #[cold]
    fn grbl_command(&mut self, view: &Block<'_>, text: &str, sink: &mut impl crate::Sink) {
        self.core.last_content = Some(view.id());
        let upper = text.to_ascii_uppercase();
        let what = match upper.as_str() {
            "$" | "$$" | "$#" | "$G" | "$I" | "$N" | "$X" | "$SLP" => return,
            command if command.starts_with("$H") => {
                self.core.forget_position();
                format!("{text}: homing, which leaves the axes at their switches")
            }
            command if command.starts_with("$J=") => {
                self.core.forget_position();
                format!("{text}: jogging")
            }
            "$C" => "$C: the check mode, in which grbl moves nothing".to_owned(),
            command if command.contains('=') => format!("{text}: a setting of the control"),
            _ => text.to_owned(),
        };
        sink.fault(crate::Fault {
            place: None,
            block: view.id(),
            range: view.range(),
            kind: crate::FaultKind::NotModelled { what },
        });
    }

    /// A line of data between G10 and G11: N names a parameter there.
    #[cold]
    pub(crate) fn data_effect(&mut self, view: &Block<'_>) {
        let text = crate::canonical_text(&format!("data:{}", view.program().text(view.range())));
        let block = self.core.main_block(view.id());
        let words = vec![Argument::text("", &text)];
        self.core.effects.add(block, Effect::Unmodelled(words));
    }

    /// What a block of a contour does apart from the contour: the control does it in the finishing cut, or in every cut.
    #[cold]
    pub(crate) fn contour_effects(&mut self, view: &Block<'_>, sink: &mut impl crate::Sink) {
        let of_contour = |argument: &Argument| match (argument.name.as_ref(), &argument.value) {
            ("G", crate::Value::Number(code)) => matches!(*code, 0.0..=3.0),
            (name, _) => matches!(
                name,
                "X" | "Z" | "U" | "W" | "I" | "K" | "R" | "F" | "C" | "A" | "Y" | "V"
            ),
        };
        let mut words = written(view, self, &Words::default(), Keep::All);
        words.retain(|argument| !of_contour(argument));
        if !words.is_empty() {
            self.unmodelled_line(view, words, sink);
        }
    }

    fn unmodelled_line(&mut self, view: &Block<'_>, words: Vec<Argument>, sink: &mut impl crate::Sink) {
        let block = self.core.main_block(view.id());
        let effect = Effect::Unmodelled(words);
        let reach = effect.usual_reach();
        sink.effect(crate::Placed { block, effect, reach });
        self.core.effects.skip();
    }
}
