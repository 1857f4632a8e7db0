//! Numbers without a decimal point whose size a parameter of the control decides.
use crate::FaultKind;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use trunnion_dialect::{Action, Role};
use trunnion_syntax::{Address, Value};

impl Iso<'_> {
    /// Reports the first coordinate, centre or radius of a block whose missing decimal point makes its size ambiguous.
    pub(super) fn whole_numbers(&mut self, words: &Words, report: &mut Report<'_>) {
        if self.core.setup.control.implicit_decimals.is_some() {
            return;
        }
        let cycle = self.core.state.motion.is_some_and(Action::is_hole_cycle);
        let radius = words.radius.number().is_some_and(|r| !r.has_point);
        if !cycle && !radius && words.axes.all_pointed() && words.centre.all_pointed() {
            return;
        }
        let size = |word: &trunnion_syntax::Word| {
            let Address::Letter(letter) = word.address else {
                return false;
            };
            let role = self.core.dialect.role(letter);
            let Value::Number(number) = word.value else {
                return false;
            };
            let sized = match role {
                Some(Role::Axis | Role::Increment | Role::ArcRadius) => true,
                // under G43.5 I J K are a direction; K of a cycle counts
                Some(Role::ArcCentre) => !self.core.state.tool_axis.vectors() && (!cycle || letter != b'K'),
                Some(Role::Parameter) => cycle && letter == b'Q',
                _ => false,
            };
            sized && !number.has_point && number.mantissa != 0
        };
        let found = report.program.block(report.block).words().find(size);
        if let Some(word) = found {
            report.fault(word.range, FaultKind::AmbiguousDecimal);
            // before the motions whose size it decides
            let block = self.core.main_block(report.block);
            self.core.effects.ambiguous_number(block);
        }
    }
}
