//! How much of a program is judged, what is known of its control, and how much of what is found is wanted.
use super::Reporter;
use crate::caller::Part;
use crate::slip::letter_o;
use core::cell::OnceCell;
use trunnion_syntax::TextRange;

impl Reporter<'_> {
    /// The axes of a machine are judged.
    pub(crate) fn judging_machine(mut self, judges: bool) -> Self {
        self.judges_machine = judges;
        self
    }

    /// Whether the control of the program is known.
    pub(crate) fn knowing_control(mut self, known: bool) -> Self {
        self.control_known = known;
        self
    }

    /// Leaves out findings of legs that are no errors.
    pub(crate) fn objections_only(&mut self) {
        self.objections_only = true;
    }

    /// What follows is a part of the program; `continues`: one after its beginning. Whether the whole is a subprogram is not known, so what
    /// is right in one is not reported.
    pub(crate) fn only_part(&mut self, continues: bool) {
        self.continues = continues;
        self.part = OnceCell::from(Part::Called);
    }

    /// Whether the axes of a machine are judged.
    pub(crate) fn judges_machine(&self) -> bool {
        self.judges_machine
    }

    /// The codes that are declared to be in effect at power-on.
    pub(crate) fn powered_on_with(self, codes: Option<&[String]>) -> Self {
        let planes = ["G17", "G18", "G19"];
        if codes.is_some_and(|codes| codes.iter().any(|code| planes.contains(&code.as_str()))) {
            let _ = self.names_plane.set(true);
        }
        self
    }

    /// Whether the control is declared, or the text shows it.
    pub(crate) fn knows_control(&self) -> bool {
        self.control_known
    }

    /// Whether the program, or what is declared for power-on, names a plane (G17, G18, G19).
    pub(crate) fn names_plane(&self) -> bool {
        *self
            .names_plane
            .get_or_init(|| crate::caller::names_plane(self.program))
    }

    /// The code that a text resembles.
    pub(crate) fn near_code(&mut self, text: &str) -> Option<String> {
        self.near.of(text)
    }

    /// A code with zeros in place of the letter O: G0 for `GO`. Names that begin otherwise may be those of programs.
    pub(crate) fn code_with_zeros(&self, range: TextRange) -> Option<String> {
        let meant = letter_o(self.program, range.start)?.meant;
        let is_code = meant.starts_with(['G', 'g', 'M', 'm']);
        is_code.then_some(meant)
    }

    /// Whether the file is a main program or a subprogram.
    pub(crate) fn part(&self) -> Part {
        *self
            .part
            .get_or_init(|| crate::caller::part(self.program, self.dialect))
    }
}
