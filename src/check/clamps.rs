//! Whether rotary axes are clamped: by the M codes that the machine file names for each.
use core::cmp::Ordering;
use trunnion_interp::{ChainId, Motion};
use trunnion_machine::{ClampCodes, MAX_AXES, Machine};
use trunnion_syntax::{Address, Block, BlockId, Program, Value};

/// What is known of one clamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Clamp {
    /// The program has said nothing yet.
    #[default]
    Unsaid,
    Closed,
    Open,
    /// A code is told by an expression, or by a file that is called.
    NotRead,
}

/// The clamps of all axes, by their index in the machine.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Clamps([Clamp; MAX_AXES]);

impl Clamps {
    /// Whether the machine file names codes of any clamp.
    pub(crate) fn on(machine: &Machine) -> bool {
        machine.axes.iter().any(|axis| axis.extra.clamp_codes.is_some())
    }

    /// Whether the text of a code is one of those that the machine file names, so that it is known what it does.
    pub(crate) fn names(machine: &Machine, code: &str) -> bool {
        let number = code
            .strip_prefix(['M', 'm'])
            .and_then(|digits| digits.trim().parse::<u16>().ok());
        let codes = machine.axes.iter().filter_map(|axis| axis.extra.clamp_codes);
        number.is_some_and(|number| codes.into_iter().any(|codes| codes.on == number || codes.off == number))
    }

    /// The clamp of an axis.
    pub(crate) fn of(&self, axis: usize) -> Clamp {
        self.0[axis]
    }

    /// Takes a block that has run.
    pub(crate) fn ran(&mut self, machine: &Machine, program: &Program, block: BlockId) {
        if (block.0 as usize) >= program.block_count() {
            return;
        }
        let block = program.block(block);
        for (clamp, axis) in self.0.iter_mut().zip(&machine.axes) {
            if let Some(said) = axis.extra.clamp_codes.and_then(|codes| said(&block, codes)) {
                *clamp = said;
            }
        }
    }

    /// Takes a motion before it is judged: what stands in a file that is called is not read here.
    pub(crate) fn before(&mut self, program: &Program, motion: &Motion) {
        let elsewhere = motion.chain != ChainId::MAIN
            && (motion.block.0 as usize) < program.block_count()
            && calls(&program.block(motion.block));
        if elsewhere {
            self.0 = [Clamp::NotRead; MAX_AXES];
        }
    }
}

/// What a block says of a clamp.
pub(crate) fn said(block: &Block<'_>, codes: ClampCodes) -> Option<Clamp> {
    let mut found = None;
    for word in block.words() {
        if word.address != Address::Letter(b'M') {
            continue;
        }
        let Value::Number(number) = word.value else {
            found = Some(Clamp::NotRead);
            continue;
        };
        let is = |code: u16| number.to_f64().total_cmp(&f64::from(code)) == Ordering::Equal;
        let now = if is(codes.on) {
            Clamp::Closed
        } else if is(codes.off) {
            Clamp::Open
        } else {
            continue;
        };
        found = match found {
            // both in one block
            Some(before) if before != now => Some(Clamp::NotRead),
            _ => Some(now),
        };
    }
    found
}

/// Whether a block calls a subprogram: M98, M198, G65, G66, an O word.
fn calls(block: &Block<'_>) -> bool {
    let is = |letter: u8, numbers: &[f64]| {
        block.words().any(|word| {
            word.address == Address::Letter(letter)
                && matches!(word.value, Value::Number(number) if numbers.contains(&number.to_f64()))
        })
    };
    let o_word = block.program().text(block.range());
    is(b'M', &[98.0, 198.0]) || is(b'G', &[65.0, 66.0]) || o_word.trim_start().starts_with(['o', 'O'])
}
