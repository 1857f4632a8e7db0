//! Two texts that must do exactly the same, to the last bit: only their layout, or the numbers of their blocks, may differ.
//!
//! Both run block by block. After each block with content, every motion, effect and fault, and the whole modal state, must be
//! equal. A number that is unknown equals another unknown number: both texts have the same words, so both are unknown for the same reason.
use crate::item::Item;
use crate::process::{Process, stops, unlike, unlike_in_motions};
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;
use trunnion_interp::{Argument, Fault, FaultKind, ModalState, Motion, MotionKind, Position, Value};
use trunnion_syntax::{BlockId, Program, TokenKind};

/// An exact comparison.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// The numbers of blocks may differ, and what names them: texts in faults, and the words of blocks that are not modelled.
    pub frees_block_numbers: bool,
    /// This many blocks are run at most, and motions and steps of cycles of blocks that ran before; an endless loop is the same as far as it was followed. The
    /// bound of the interpreters must be larger: empty blocks of one side would make its interpreter stop before the other.
    pub most_blocks: u64,
    /// A program whose blocks do more actions than that, besides motions, before one of them runs again is not compared to its end.
    pub most_actions: u64,
}

/// Replaces an unknown number in comparisons; the interpreters accept no number above 1e12.
const UNKNOWN: f64 = f64::MAX;

/// One program of the comparison.
struct Side<'r, 'a> {
    steps: &'r mut Steps<'a>,
    /// How many blocks with content come before each block.
    ordinals: Vec<u32>,
    /// Blocks that it has run, empty ones too, and what those that had run before made: a cycle in a loop makes many motions, or follows a long
    /// contour for a few.
    blocks: u64,
    /// Whether each block has run.
    ran: Vec<bool>,
    /// Blocks of which a mistake was found.
    refused: BTreeSet<u32>,
    /// Motions and effects that the other side has not matched yet.
    items: VecDeque<Item>,
    faults: VecDeque<Fault>,
}

/// Runs both programs to their ends, or to the first difference.
pub(crate) fn walk(before: &mut Steps<'_>, after: &mut Steps<'_>, exact: Exact) -> Result<(), Verdict> {
    let (mut a, mut b) = (Side::new(before), Side::new(after));
    let mut reached = BlockId(0);
    // the settings of both sides that were found equal last
    let mut settled: Option<(Arc<Process>, Arc<Process>)> = None;
    loop {
        if a.blocks.max(b.blocks) >= exact.most_blocks {
            return Ok(());
        }
        if let Some(why) = a.does_too_much(exact) {
            return Err(not_to_its_end(reached, &why));
        }
        let (left, right) = (a.advance(), b.advance());
        reached = left.unwrap_or(reached);
        let at = |what: &str| {
            Err(Verdict::Differs(Difference {
                before: Some(reached),
                after: right,
                what: what.to_owned(),
            }))
        };
        while let (Some(x), Some(y)) = (a.items.front(), b.items.front()) {
            if let Some(what) = item_difference(x, y, (&a, &b), exact, &mut settled) {
                return at(what);
            }
            a.items.pop_front();
            b.items.pop_front();
        }
        while let (Some(one), Some(other)) = (a.faults.front(), b.faults.front()) {
            if a.ordinal(one.block) != b.ordinal(other.block) || !same_fault(&one.kind, &other.kind, exact) {
                return at("a fault differs");
            }
            a.faults.pop_front();
            b.faults.pop_front();
        }
        match (left, right) {
            (None, None) if a.is_compared() && b.is_compared() => {
                let cut_off = a.steps.given_up().or_else(|| b.steps.given_up());
                return cut_off.map_or(Ok(()), |why| Err(not_to_its_end(reached, &why)));
            }
            (None, None) => return at("one program does more than the other at its end"),
            (Some(x), Some(y)) if a.ordinal(x) == b.ordinal(y) => {}
            _ => return at("the order in which blocks run differs"),
        }
        if !ModalState::is_alike(a.steps.state(), b.steps.state()) {
            // effects of the end of the text come with the last block, or with an empty one after it
            let more = a.advance().is_some() || b.advance().is_some();
            if more || !ModalState::is_alike(a.steps.state(), b.steps.state()) {
                return at("what is in effect after the block differs");
            }
        }
    }
}

/// What follows a block is not compared, although it runs.
fn not_to_its_end(reached: BlockId, why: &str) -> Verdict {
    Verdict::Unknown(Difference {
        before: Some(reached),
        after: None,
        what: format!("the program is not compared to its end: {why}"),
    })
}

impl<'r, 'a> Side<'r, 'a> {
    fn new(steps: &'r mut Steps<'a>) -> Self {
        steps.watch_faults();
        let mut count = 0;
        let program = steps.input().program;
        let ordinals = program.blocks().map(|block| {
            let own = count;
            count += u32::from(!is_empty(program, block.id()));
            own
        });
        let ordinals: Vec<u32> = ordinals.collect();
        Self {
            ran: vec![false; ordinals.len()],
            ordinals,
            blocks: 0,
            refused: BTreeSet::new(),
            items: VecDeque::new(),
            faults: VecDeque::new(),
            steps,
        }
    }

    fn ordinal(&self, block: BlockId) -> u32 {
        self.ordinals.get(block.0 as usize).copied().unwrap_or(u32::MAX)
    }

    fn is_compared(&self) -> bool {
        self.items.is_empty() && self.faults.is_empty()
    }

    /// Why the rest of the text is not compared, if it is not. A loop is compared as far as it is followed.
    fn does_too_much(&self, exact: Exact) -> Option<String> {
        let loops = self.blocks > self.ordinals.len() as u64;
        let why = (!loops).then(|| self.steps.run.actions.beyond(exact.most_actions));
        why.flatten()
    }

    /// Runs to the end of the next block with content; `None` at the end.
    fn advance(&mut self) -> Option<BlockId> {
        loop {
            let worked = self.steps.interpreter.cycle_work();
            let block = self.steps.advance();
            let worked = self.steps.interpreter.cycle_work().saturating_sub(worked);
            let mut ready = self.steps.take_ready();
            let motions = ready.iter().filter(|item| matches!(item, Item::Motion(_))).count();
            self.items.append(&mut ready);
            let mut faults = self.steps.take_faults();
            faults.retain(|fault| self.is_first(fault));
            if self.faults.is_empty() {
                // a line of loops that do not fit together may bring a million at once: they are not copied
                self.faults = faults.into();
            } else {
                self.faults.extend(faults);
            }
            let block = block?;
            self.blocks += 1;
            if let Some(ran) = self.ran.get_mut(block.0 as usize)
                && core::mem::replace(ran, true)
            {
                self.blocks += worked.max(motions as u64);
            }
            if !is_empty(self.steps.input().program, block) {
                return Some(block);
            }
        }
    }

    /// Only the first mistake of a line is compared: what is found after it depends on the blanks, because reading continues at the next
    /// apparent word. The control stops at the first. LinuxCNC's reader does not look at blanks.
    fn is_first(&mut self, fault: &Fault) -> bool {
        let ordinal = self.ordinal(fault.block);
        self.steps.input().dialect.quirks.rs274() || !is_refusal(&fault.kind) || self.refused.insert(ordinal)
    }
}

/// Whether a block has no token but blanks.
fn is_empty(program: &Program, block: BlockId) -> bool {
    let table = program.tokens();
    let blank = |id| matches!(table.kind(id), TokenKind::Newline | TokenKind::Blank);
    program.block(block).tokens().all(blank)
}

/// What differs between two things that the programs do, if anything does.
fn item_difference(
    x: &Item,
    y: &Item,
    (a, b): (&Side<'_, '_>, &Side<'_, '_>),
    exact: Exact,
    settled: &mut Option<(Arc<Process>, Arc<Process>)>,
) -> Option<&'static str> {
    if a.ordinal(x.block()) != b.ordinal(y.block()) {
        return Some("the block that moves or does something differs");
    }
    let (was, is) = match (x, y) {
        (Item::Motion(was), Item::Motion(is)) => {
            if !same_motion(&was.motion, &is.motion) || was.held != is.held {
                return Some("a motion differs");
            }
            (&was.process, &is.process)
        }
        (
            Item::Happens {
                sort, words, process, ..
            },
            Item::Happens {
                sort: other_sort,
                words: others,
                process: other,
                ..
            },
        ) => {
            // P and Q name blocks: of a return, of a contour
            let free = |word: &Argument| {
                exact.frees_block_numbers
                    && (*sort == crate::Sort::Unmodelled || matches!(word.name.as_ref(), "P" | "Q"))
            };
            let same = |(a, b): (&Argument, &Argument)| same_word(a, b) || free(a) && a.name == b.name;
            if sort != other_sort || words.len() != others.len() || !words.iter().zip(others).all(same) {
                return Some("what a block does apart from motions differs");
            }
            // elsewhere a message only appears on the screen, and may contain the number of its line
            if stops(words) && process.message() != other.message() {
                return Some("the message at a stop differs");
            }
            (process, other)
        }
        _ => return Some("the number of motions differs"),
    };
    let known = |(one, other): &(Arc<Process>, Arc<Process>)| Arc::ptr_eq(one, was) && Arc::ptr_eq(other, is);
    if settled.as_ref().is_some_and(known) {
        return None;
    }
    if unlike(was, is, false).is_some() || unlike_in_motions(was, is).is_some() {
        return Some("a setting differs");
    }
    *settled = Some((Arc::clone(was), Arc::clone(is)));
    None
}

fn same_word(a: &Argument, b: &Argument) -> bool {
    a.name == b.name
        && match (&a.value, &b.value) {
            (Value::Number(a), Value::Number(b)) => a.to_bits() == b.to_bits(),
            (a, b) => a == b,
        }
}

fn known(value: &mut f64) {
    if value.is_nan() {
        *value = UNKNOWN;
    }
}

fn known_place(position: &mut Position) {
    position.values.iter_mut().for_each(known);
}

/// Whether two motions are the same apart from their blocks.
pub(crate) fn same_motion(a: &Motion, b: &Motion) -> bool {
    let comparable = |motion: &Motion| {
        let mut motion = *motion;
        motion.block = BlockId(0);
        known_place(&mut motion.start);
        known_place(&mut motion.end);
        motion.zero.iter_mut().for_each(known);
        known(&mut motion.tool_length_mm);
        motion.spindle_rpm.iter_mut().for_each(known);
        if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
            let values = [&mut arc.sweep, &mut arc.radius_start, &mut arc.radius_end];
            values.into_iter().for_each(known);
            for point in [&mut arc.start, &mut arc.end, &mut arc.centre, &mut arc.normal] {
                point.iter_mut().for_each(known);
            }
        }
        motion
    };
    comparable(a) == comparable(b)
}

/// Whether a control stops at the fault.
fn is_refusal(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::Rejected { .. }
            | FaultKind::UnknownCode { .. }
            | FaultKind::UnknownWord
            | FaultKind::RepeatedWord
            | FaultKind::GroupConflict { .. }
    )
}

/// Whether two faults are the same apart from places and the spelling of texts that they quote.
fn same_fault(a: &FaultKind, b: &FaultKind, exact: Exact) -> bool {
    let free = exact.frees_block_numbers;
    let alike = |a: &str, b: &str| free || folded(a).eq(folded(b));
    if a == b {
        return true;
    }
    match (a, b) {
        // the sentence may quote the text and name lines
        (
            FaultKind::Rejected { refusal, alarm, .. },
            FaultKind::Rejected {
                refusal: other,
                alarm: number,
                ..
            },
        ) => refusal == other && (alarm == number || quotes(alarm.as_ref()) && quotes(number.as_ref())),
        (
            FaultKind::MissingSubprogram {
                name: a, searched: x, ..
            },
            FaultKind::MissingSubprogram {
                name: b, searched: y, ..
            },
        ) => x == y && alike(a, b),
        // how many blocks ran depends on empty ones
        (FaultKind::EndlessLoop { proved: a, .. }, FaultKind::EndlessLoop { proved: b, .. }) => a == b,
        (FaultKind::GroupConflict { group, .. }, FaultKind::GroupConflict { group: other, .. }) => group == other,
        // texts as written
        (FaultKind::NotModelled { what: a }, FaultKind::NotModelled { what: b })
        | (FaultKind::NotDecided { what: a }, FaultKind::NotDecided { what: b })
        | (FaultKind::WorkOffsetUnset { name: a }, FaultKind::WorkOffsetUnset { name: b })
        | (FaultKind::ToolLengthUnset { tool: a }, FaultKind::ToolLengthUnset { tool: b })
        | (FaultKind::ProgramAlarm { message: a }, FaultKind::ProgramAlarm { message: b }) => alike(a, b),
        _ => free && std::mem::discriminant(a) == std::mem::discriminant(b),
    }
}

/// LinuxCNC's messages may quote the text and name lines, too.
fn quotes(alarm: Option<&String>) -> bool {
    alarm.is_some_and(|alarm| alarm.starts_with("LinuxCNC: "))
}

/// A text without blanks and case.
fn folded(text: &str) -> impl Iterator<Item = char> {
    let visible = text.chars().filter(|c| !c.is_whitespace());
    visible.map(|c| c.to_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::{Item, Side};
    use crate::input::Input;
    use crate::steps::Steps;
    use trunnion_interp::Setup;

    /// Motions of a program up to a count of 1000, or to its end.
    fn compared(text: &str) -> usize {
        compared_on("fanuc-30i", text)
    }

    fn compared_on(dialect: &str, text: &str) -> usize {
        let dialect = trunnion_dialect::builtin(dialect).expect("embedded");
        let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
        let setup = Setup::default();
        let mut steps = Steps::new(Input {
            program: &program,
            dialect,
            setup: &setup,
            machine: None,
        });
        let mut side = Side::new(&mut steps);
        let mut motions = 0;
        while side.blocks < 1000 && side.advance().is_some() {
            let items = side.items.drain(..);
            motions += items.filter(|item| matches!(item, Item::Motion(_))).count();
        }
        motions
    }

    #[test]
    fn motions_of_a_cycle_count_where_a_loop_repeats_it() {
        let head = "G21 G90 G94 G17\nG0 X0. Y0. Z9.\n";
        let cycle = "G83 X1. Y1. Z-40. R1. Q1. F100.\n";
        let looped = compared(&format!("{head}#1=0\nWHILE[#1LT900]DO1\n#1=#1+1\n{cycle}END1\nM30\n"));
        assert!((900..1300).contains(&looped), "{looped}");
        // 200 lines of a contour for each pass: they count, too
        let lines: Vec<String> = (0..200).map(|z| format!("G1 X{} Z-{z}.\n", 20 + z % 7)).collect();
        let rough = "#1=0\nWHILE[#1LT900]DO1\n#1=#1+1\nG71 U90. R1.\nG71 P10 Q20 F.1\nEND1\nGOTO 30\n";
        let contour = format!(
            "G21 G18\nG0 X50. Z9.\n{rough}N10 G0 X20.\n{}N20 G1 X50.\nN30 M30\n",
            lines.concat()
        );
        let looped = compared_on("fanuc-30i-lathe-a", &contour);
        assert!((2..60).contains(&looped), "{looped}");
        // each block of the text once: to its end
        let written = compared(&format!("{head}{}G80\nM30\n", cycle.repeat(100)));
        assert!(written > 10_000, "{written}");
    }
}
