//! CYCLE832: tolerance and smoothing, which change no programmed point. In its older form it also switches the transformation.
//!
//! CYCLE832(tolerance, mode, orientation tolerance): mode 0 to 4, plus 10 where the third argument is a tolerance of the orientation. Software 6: the digits of
//! the mode are, from the right, method, (nothing), TRAFOOF, TRAORI or TRAORI(2), path mode, feedforward, compressor. Sources: NC-PB/gEdit,
//! docs/planning/syntax, Sinumerik 6.3; a Siemens NX 840D post, PB_CMD__check_block_CYCLE832.
use crate::FaultKind;
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;

impl Iso<'_> {
    pub(crate) fn high_speed(&mut self, found: &Found<'_>, report: &mut Report<'_>) {
        let text = report.program.text(found.range).into_owned();
        let inside = text
            .split_once('(')
            .map_or("", |(_, inside)| inside.trim_end_matches(')'));
        let mode = inside.split(',').nth(1).map(str::trim).unwrap_or_default();
        let value = self.memory.own.value(mode);
        // `_FINISH` and the like are names of the newer form
        if value.is_some_and(|mode| mode < 100.0) || mode.is_empty() || mode.starts_with('_') {
            return;
        }
        let digit = value.map(|mode| (mode / 100.0) as u64 % 10);
        let dialect = self.core.dialect;
        let on = self.core.state.tool_axis.tcp();
        let (first, off) = (dialect.name("TRAORI"), dialect.name("TRAFOOF"));
        match (digit, first, off) {
            (Some(0), _, Some(off)) => {
                self.core.unknown.end(off);
                self.tcp_off();
            }
            (Some(1), Some(first), _) if !on => self.tcp_on(first, false, report),
            (Some(1), ..) => {}
            (_, Some(first), _) => {
                let what = format!("CYCLE832 with the mode {mode}: which transformation is on after it");
                report.fault(found.range, FaultKind::NotModelled { what });
                self.tcp_on(first, false, report);
                self.core.unknown.begin(first, true);
                self.core.forget_position();
            }
            _ => {}
        }
    }
}
