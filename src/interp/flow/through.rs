//! The sink between a block that runs in a call or a loop and the sink of the run: it reports each fault once, and gives events in
//! another file a place in the main program.
use super::reported::{ReportedFaults, is_textual};
use crate::{Fault, FaultKind, ModalState, Motion, MotionKind, Sink};
use trunnion_flow::{Called, Place};

/// See the module.
pub(crate) struct Through<'s, S> {
    pub(crate) sink: &'s mut S,
    pub(crate) reported: ReportedFaults,
    pub(crate) place: Place,
    /// The file that contains the block, unless it is the main program's.
    pub(crate) called: Option<&'s Called>,
    /// The block has run before.
    pub(crate) again: bool,
    /// A motion was made.
    pub(crate) moved: bool,
}

impl<S: Sink> Sink for Through<'_, S> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.moved |= !matches!(motion.kind, MotionKind::Dwell(_));
        self.sink.motion(motion, state);
    }

    fn effect(&mut self, effect: crate::Placed) {
        self.sink.effect(effect);
    }

    fn fault(&mut self, fault: Fault) {
        if !self.reported.is_new(self.place.file, &fault, self.again) {
            return;
        }
        let Some(called) = self.called else {
            return self.sink.fault(fault);
        };
        let (kind, place) = carried(called, &fault);
        self.sink.fault(Fault {
            kind,
            place,
            block: self.place.main,
            range: self.place.main_range,
        });
    }
}

/// Characters of a line that are shown.
const SHOWN: usize = 60;

/// A fact about a block of another file, reported at the call; and its line, where the fact does not say it.
fn carried(called: &Called, fault: &Fault) -> (FaultKind, Option<Box<str>>) {
    let line = fault.block.0 + 1;
    let Some(kind) = placed(called, fault, &format!("{}, line {line}", called.path)) else {
        let text = called.program.text(called.program.block(fault.block).range());
        let text: String = text.trim().chars().take(SHOWN).collect();
        let place = format!("{} line {line}: {text}", called.path);
        return (fault.kind.clone(), Some(place.into()));
    };
    (kind, None)
}

/// The fact with its place in its text; `None`: it has none.
fn placed(called: &Called, fault: &Fault, place: &str) -> Option<FaultKind> {
    Some(match &fault.kind {
        kind if is_textual(kind) => FaultKind::NotModelled {
            what: format!(
                "`{}` in {place}: check that file",
                called.program.text(fault.range).trim()
            ),
        },
        FaultKind::NotModelled { what } => FaultKind::NotModelled {
            what: format!("{what} in {place}"),
        },
        FaultKind::NotDecided { what } => FaultKind::NotDecided {
            what: format!("{what} in {place}"),
        },
        FaultKind::Rejected {
            refusal,
            message,
            alarm,
        } => FaultKind::Rejected {
            refusal: *refusal,
            message: format!("{place}: {message}"),
            alarm: alarm.clone(),
        },
        FaultKind::MissingSubprogram {
            name, searched, alarm, ..
        } => FaultKind::MissingSubprogram {
            name: name.clone(),
            searched: searched.clone(),
            alarm: alarm.clone(),
            caller: Some(place.to_owned()),
        },
        _ => return None,
    })
}
