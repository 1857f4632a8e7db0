//! Runs programs and writes motions and faults as short lines, so that a test shows what it expects as text.
use std::fmt::Write as _;
use trunnion_dialect::builtin;
use trunnion_interp::{
    AXIS_LETTERS, Fault, FaultKind, Feed, ModalState, Motion, MotionKind, Orientation, Position, Setup, Sink, run,
};
use trunnion_syntax::{Program, parse};

#[derive(Default)]
pub(crate) struct Log {
    pub(crate) motions: Vec<Motion>,
    pub(crate) faults: Vec<Fault>,
    pub(crate) state: Option<ModalState>,
}

impl Sink for Log {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        self.motions.push(*motion);
    }
    fn fault(&mut self, fault: Fault) {
        self.faults.push(fault);
    }
    fn block_done(&mut self, _: trunnion_syntax::BlockId, run: &dyn trunnion_interp::ProgramRun) {
        self.state = Some(run.state().clone());
    }
}

pub(crate) fn run_bytes(dialect: &str, source: &[u8], setup: &Setup) -> (Program, Log) {
    let dialect = builtin(dialect).expect("a built-in dialect");
    let program = parse(source.to_vec(), dialect.lex);
    let mut log = Log::default();
    run(&program, dialect, setup, &mut log);
    (program, log)
}

/// Without a program end, so that tests need none: that fault is left out.
pub(crate) fn run_text(dialect: &str, source: &str) -> Log {
    let mut log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
    log.faults.retain(|fault| fault.kind != FaultKind::MissingProgramEnd);
    log
}

pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

pub(crate) fn position(position: &Position) -> String {
    let mut text = String::new();
    for (axis, &letter) in AXIS_LETTERS.iter().enumerate() {
        if let Some(value) = position.get(axis) {
            let _ = write!(
                text,
                "{}{}{}",
                if text.is_empty() { "" } else { " " },
                letter as char,
                number(value)
            );
        }
    }
    if text.is_empty() { "-".to_owned() } else { text }
}

/// `L X1 Y2 F100 tcp <0 0 1>`: kind, end, feed, what else is in effect.
pub(crate) fn line(motion: &Motion) -> String {
    let mut text = match motion.kind {
        MotionKind::Rapid => "R".to_owned(),
        MotionKind::Linear => "L".to_owned(),
        MotionKind::Arc(None) => "A?".to_owned(),
        MotionKind::Arc(Some(arc)) => {
            let centre = arc.centre;
            let sweep = number(arc.sweep.to_degrees());
            format!(
                "A({} {} {}; {sweep})",
                number(centre.x),
                number(centre.y),
                number(centre.z)
            )
        }
        MotionKind::Dwell(Some(seconds)) => format!("D{}", number(seconds)),
        MotionKind::Dwell(None) => "D?".to_owned(),
        MotionKind::Unknown => "U".to_owned(),
    };
    let _ = write!(text, " {}", position(&motion.end));
    match motion.feed {
        Feed::PerMinute(feed) => text += &format!(" F{}", number(feed)),
        Feed::PerRevolution(feed) => text += &format!(" F{}/rev", number(feed)),
        Feed::InverseTime(feed) => text += &format!(" F1/{}", number(feed)),
        Feed::Unknown | Feed::Rapid => {}
    }
    if motion.tcp {
        text += " tcp";
    }
    if motion.machine_coordinates {
        text += " machine";
    }
    if let Orientation::Vector(_, v) = motion.orientation {
        text += &format!(" <{} {} {}>", number(v.x), number(v.y), number(v.z));
    }
    text
}

pub(crate) fn lines(dialect: &str, source: &str) -> Vec<String> {
    run_text(dialect, source).motions.iter().map(line).collect()
}

pub(crate) fn faults(dialect: &str, source: &str) -> Vec<String> {
    let (program, log) = run_bytes(dialect, source.as_bytes(), &Setup::default());
    let end = FaultKind::MissingProgramEnd;
    log.faults
        .iter()
        .filter(|fault| fault.kind != end)
        .map(|fault| fault_line(&program, fault))
        .collect()
}

pub(crate) fn fault_line(program: &Program, fault: &Fault) -> String {
    format!(
        "{}: {}: {:?}",
        fault.block.0 + 1,
        program.text(fault.range).trim(),
        fault.kind
    )
}

/// A file of the shared data; `None`, with a printed message, where it is missing.
pub(crate) fn shared(path: &str) -> Option<Vec<u8>> {
    let file = format!("{}/../../../shared/data/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&file)
        .map_err(|error| eprintln!("skipped: {path}: {error}"))
        .ok()
}
