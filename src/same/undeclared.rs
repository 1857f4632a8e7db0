//! What nobody declares, and what two programs still have in common.
use crate::{Input, Steps, offset_name};
use std::{collections::HashMap, sync::Arc};
use trunnion_dialect::Dialect;
use trunnion_interp::{FaultKind, ModalState, Motion, Setup, Tool, UNNAMED_ZERO, WorkOffset};
use trunnion_syntax::Format;

/// Stand-ins of rotary axes are small, so that no axis leaves its travel because of them: 0.07 to 1.07 deg, where linear axes have 7 to 107 mm.
const DEG_PER_MM: f64 = 0.01;

/// Work offsets that the motions of a run depend on and nobody declares; `None`: the zero point without one.
#[derive(Default)]
pub(crate) struct Zeros(Vec<Option<Arc<str>>>);

impl Zeros {
    #[inline]
    pub(crate) fn note(&mut self, motion: &Motion, state: &ModalState) {
        let offset = state.zero.offset();
        if motion.undeclared.zero != 0 && !self.0.iter().any(|known| known.as_deref() == offset) {
            self.0.push(state.zero.offset_name());
        }
    }
}

/// Zero points and tool lengths that a program uses and nobody declares: those that were missing in a run, by name. The zero point at power-on is
/// one, though no word of the program selects it.
pub fn undeclared(steps: &mut Steps<'_>) -> Vec<FaultKind> {
    let dialect = steps.input().dialect;
    let first = dialect.quirks.first_offset_at_start || dialect.lex.format == Format::Apt;
    let unnamed = if first { "G54" } else { UNNAMED_ZERO };
    let zeros = std::mem::take(&mut steps.run.zeros)
        .0
        .into_iter()
        .map(|name| FaultKind::WorkOffsetUnset {
            name: name.as_deref().unwrap_or(unnamed).to_owned(),
        });
    let faults = steps.take_faults().into_iter().map(|fault| fault.kind);
    faults.filter(is_undeclared).chain(zeros).collect()
}

/// The same of the kinds that are assumed to be zero: zero points, and tool lengths.
pub fn assumed(input: Input<'_>, [zeros, lengths]: [bool; 2]) -> Vec<FaultKind> {
    if !(zeros || lengths) {
        return Vec::new();
    }
    let mut steps = Steps::new(input);
    steps.watch_faults();
    steps.by_ref().for_each(drop);
    let mut unset = undeclared(&mut steps);
    unset.retain(|kind| match kind {
        FaultKind::WorkOffsetUnset { .. } => zeros,
        _ => lengths,
    });
    unset
}

fn is_undeclared(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::WorkOffsetUnset { .. } | FaultKind::ToolLengthUnset { .. }
    )
}

/// Names of the zero points and of the tool lengths, each once.
fn named(unset: &[FaultKind]) -> [Vec<String>; 2] {
    let names = |of: fn(&FaultKind) -> Option<String>| {
        let mut names: Vec<String> = unset.iter().filter_map(of).collect();
        names.sort_unstable();
        names.dedup();
        names
    };
    let zeros = names(|kind| match kind {
        FaultKind::WorkOffsetUnset { name } if name == UNNAMED_ZERO => {
            Some(format!("the zero point without a work offset ({UNNAMED_ZERO})"))
        }
        FaultKind::WorkOffsetUnset { name } => Some(offset_name(name).to_string()),
        _ => None,
    });
    let lengths = names(|kind| match kind {
        FaultKind::ToolLengthUnset { tool } => Some(format!("the tool length {tool}")),
        _ => None,
    });
    [zeros, lengths]
}

/// The setup with stand-ins for the zero points and tool lengths of `unset`: see [`with_stand_ins`]. One alone has a relation too: to positions
/// in the machine's frame (G53, a reference point), and to motions without a length. Programs for two controls name the same place differently: then all
/// zero points are one, and all lengths, as what goes together is compared by itself (decision 0369). `None`: everything is declared.
pub fn unrelated(setup: &Setup, dialects: [&Dialect; 2], unset: &[FaultKind]) -> Option<Setup> {
    let alike = crate::across::are_two_controls(dialects);
    unset
        .iter()
        .any(is_undeclared)
        .then(|| with_values(setup, unset, alike, &stand_in))
}

/// The setup with stand-ins for the zero points and tool lengths of `unset`. They are unlike each other and no sums of each other, so that
/// nothing is the same because of them: coordinates depend on these values linearly, and what holds for values without a relation holds
/// for all.
pub fn with_stand_ins(setup: &Setup, unset: &[FaultKind]) -> Setup {
    with_values(setup, unset, false, &stand_in)
}

/// Multiples of the golden ratio are spread evenly.
fn stand_in(at: u32) -> f64 {
    100.0 * f64::fract(f64::from(at) * 0.618_033_988_749_895) + 7.0
}

/// The setup with the zero points and tool lengths of `unset` at 0.
pub fn with_zeros(setup: &Setup, unset: &[FaultKind]) -> Setup {
    with_values(setup, unset, true, &|_| 0.0)
}

/// `value`: of the first, second, ... value; with `alike` these are counted anew for each zero point, and each length is the tenth.
fn with_values(setup: &Setup, unset: &[FaultKind], alike: bool, value: &dyn Fn(u32) -> f64) -> Setup {
    const LENGTH: u32 = 10;
    let mut count = 0;
    let mut next = || {
        count += 1;
        value(count)
    };
    let mut setup = setup.clone();
    // places of the tools by number: a program may use as many as it has lines
    let places = setup.tools.iter().enumerate().rev();
    let mut places: HashMap<u32, usize> = places.map(|(at, tool)| (tool.number, at)).collect();
    for kind in unset {
        match kind {
            FaultKind::WorkOffsetUnset { name } if setup.work_offset(name).is_none() => {
                // under its other name
                let known = setup
                    .work_offsets
                    .iter()
                    .find(|known| offset_name(&known.name) == offset_name(name));
                let of_axis = |axis: usize| if alike { value(axis as u32 + 1) } else { next() };
                let values = match known {
                    Some(known) => known.values,
                    None => core::array::from_fn(of_axis),
                };
                let values = core::array::from_fn(|axis| {
                    let stands_in = known.is_none() && (3..6).contains(&axis);
                    values[axis] * if stands_in { DEG_PER_MM } else { 1.0 }
                });
                let name = name.clone();
                setup.work_offsets.push(WorkOffset { name, values });
            }
            FaultKind::ToolLengthUnset { tool } => {
                let digits: String = tool.chars().filter(char::is_ascii_digit).collect();
                let Ok(number) = digits.parse::<u32>() else { continue };
                let length = Some(if alike { value(LENGTH) } else { next() });
                if let Some(&at) = places.get(&number) {
                    let known = &mut setup.tools[at];
                    known.length_mm = known.length_mm.or(length);
                    continue;
                }
                places.insert(number, setup.tools.len());
                setup.tools.push(Tool {
                    number,
                    shape: None,
                    diameter_mm: None,
                    length_mm: length,
                    holder_mm: None,
                });
            }
            _ => {}
        }
    }
    setup
}

/// Why two programs that are the same with all of `unset` at 0 are not proved to be: one sentence.
pub fn only_by_chance(unset: &[FaultKind]) -> String {
    let [mut names, lengths] = named(unset);
    let flags = [(names.is_empty(), "work-offset"), (lengths.is_empty(), "tool-length")];
    let flags: Vec<&str> = flags.iter().filter(|(none, _)| !none).map(|(_, flag)| *flag).collect();
    names.extend(lengths);
    let (verb, them) = if names.len() == 1 {
        ("is", "it")
    } else {
        ("are", "them")
    };
    let last = names.pop().unwrap_or_default();
    let all = if names.is_empty() {
        last
    } else {
        format!("{} and {last}", names.join(", "))
    };
    format!(
        "they are the same only for certain values of {all}, which {verb} not declared: declare {them}, or take {them} as zero with --assume {}",
        flags.join(",")
    )
}
