//! Of how many motions the end of the tip is known, and why it is not.
use std::{collections::BTreeMap, fs, path::Path};
use trunnion_interp::{Fault, FaultKind, Lacks, ModalState, Motion, MotionKind, Sink, run};
use trunnion_syntax::{Address, Program, Value};
use trunnion_workspace::{Overrides, resolve};

/// What is counted of the motions of main programs.
#[derive(Default)]
pub(super) struct Known {
    pub(super) programs: u64,
    pub(super) in_full: u64,
    /// Motions whose end is unknown for a reason that lies outside the program, by that reason.
    pub(super) outside: BTreeMap<&'static str, u64>,
    /// All other motions with an unknown end, by the last fault before.
    pub(super) open: BTreeMap<String, u64>,
}

impl Known {
    /// Per cent of the motions whose end does not rest on something outside the program.
    pub(super) fn per_cent(&self) -> f64 {
        let open: u64 = self.open.values().sum();
        100.0 * self.in_full as f64 / (self.in_full + open).max(1) as f64
    }
}

/// Why the axes of the tip are unknown.
struct Watch<'k> {
    into: &'k mut Known,
    /// X Y Z, or X Z on a lathe.
    tip: u16,
    /// Axes that were known once.
    ever: u16,
    /// Why an axis is not known, since it was known last.
    why: [Option<String>; 3],
    last_fault: Option<String>,
    /// There was a motion, with this tool.
    moved: bool,
    tool: Option<u32>,
}

impl Sink for Watch<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        if matches!(motion.kind, MotionKind::Dwell(_)) {
            return;
        }
        let known = motion.end.known & self.tip;
        let last = std::mem::replace(&mut self.tool, motion.tool);
        let changed = std::mem::replace(&mut self.moved, true) && last != motion.tool;
        for axis in 0..3 {
            let bit = 1 << axis;
            if known & bit != 0 {
                self.ever |= bit;
                self.why[axis] = None;
            } else if self.why[axis].is_none() && self.tip & bit != 0 {
                let never = self.ever & bit == 0;
                let change = changed.then(|| "tool change".to_owned());
                let cause = change.or_else(|| self.last_fault.clone());
                self.why[axis] =
                    Some(cause.unwrap_or_else(|| if never { "start" } else { "nothing is said" }.to_owned()));
            }
        }
        if known == self.tip && motion.kind != MotionKind::Unknown {
            self.into.in_full += 1;
            return;
        }
        let causes: Vec<&str> = self.why.iter().flatten().map(String::as_str).collect();
        let inside = causes.iter().find(|cause| outside(cause).is_none());
        match (inside, causes.first().and_then(|cause| outside(cause))) {
            (None, Some(cause)) => *self.into.outside.entry(cause).or_default() += 1,
            (inside, _) => {
                let text = inside.map_or("the kind of motion", |text| text);
                *self.into.open.entry(text.to_owned()).or_default() += 1;
            }
        }
    }

    fn fault(&mut self, fault: Fault) {
        self.last_fault = match &fault.kind {
            kind if kind.lacks() == Some(Lacks::ReferencePoint) => Some("reference point".to_owned()),
            FaultKind::NotModelled { what } => Some(what.clone()),
            FaultKind::MissingSubprogram { .. } => Some("a program that is missing".to_owned()),
            FaultKind::UnknownCode { .. } | FaultKind::Rejected { .. } => Some(format!("{:?}", fault.kind)),
            _ => return,
        };
    }
}

/// The reasons that lie outside a program.
fn outside(cause: &str) -> Option<&'static str> {
    match cause {
        "start" => Some("the start is not programmed"),
        "reference point" => Some("a reference point"),
        // the axes stand where the machine changes tools, which is a reference point
        "tool change" => Some("a reference point (the tool change)"),
        _ if cause.contains("the probed position") => Some("a probe"),
        _ => None,
    }
}

/// Whether a program has an end of its own, and does not return to a caller.
fn is_main(program: &Program) -> bool {
    let end = |word: trunnion_syntax::Word| match (word.address, word.value) {
        (Address::Letter(b'M'), Value::Number(number)) => {
            Some(number.to_f64()).filter(|m| [2.0, 30.0, 99.0].contains(m))
        }
        _ => None,
    };
    let found: Vec<f64> = program
        .blocks()
        .flat_map(|block| block.words().filter_map(end).collect::<Vec<_>>())
        .collect();
    found.iter().any(|number| *number != 99.0) && found.first() != Some(&99.0)
}

/// Whether a file is a main program; its motions are counted.
pub(super) fn count(path: &Path, into: &mut Known) -> bool {
    let text = fs::read(path).expect("a file");
    let Ok(resolved) = resolve(Some(path), &text, &Overrides::default()) else {
        return false;
    };
    if resolved.foreign.is_some() {
        return false;
    }
    let program = trunnion_syntax::parse(text, resolved.dialect.lex);
    if !is_main(&program) {
        return false;
    }
    into.programs += 1;
    let mut watch = Watch {
        into,
        tip: if resolved.dialect.quirks.diameter { 0b101 } else { 0b111 },
        ever: 0,
        why: [None, None, None],
        last_fault: None,
        moved: false,
        tool: None,
    };
    run(&program, resolved.dialect, &resolved.setup, &mut watch);
    true
}
