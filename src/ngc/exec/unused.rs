//! Words that nothing in the block uses.
use super::problems;
use crate::{Block, Class, Error, Problem};

macro_rules! unused {
    ($($name:ident $message:literal)*) => {
        $(const $name: Problem = Problem {
            class: Class::UnusedWord,
            message: $message,
            help: "Remove the word, or add the code that it belongs to.",
        };)*
    };
}

unused! {
    D "D word with no G41, G41.1, G42, G42.1, G71, G71.1, G71.2 or G96 to use it"
    E "E word with no G70, G76, M66, M67 or M68 to use it"
    H "H word with no G43 or G76 to use it"
    I "I word with no G2, G3, G5, G5.1, G10, G33.1, G76, or G87 to use it"
    J "J word with no G2, G3, G5, G5.1, G10, G76 or G87 to use it"
    K "K word with no G2, G3, G33, G33.1, G76, or G87 to use it"
    L "L word with no G10, cutter compensation, canned cycle, digital/analog input, M98 or NURBS code"
    P "P word with no G2 G3 G4 G10 G64 G5 G5.2 G76 G82 G86 G88 G89 or M50 M51 M52 M53 M62 M63 M64 M65 M66 M98 or user M code to use it"
    Q "Q word with no G5, G10, G64, G73, G76, G83, M19, M66, M67, M68 or user M code that uses it"
    R "R word with no g code that uses it"
    DOLLAR "$ (spindle selection) word with no M3, M4, M5, M19, M51, G33, G33.1, G76, G95, G96 or G97 to use it"
}

macro_rules! rotary {
    ($($name:ident $message:literal)*) => {
        $(const $name: Problem = Problem {
            class: Class::CannedCycle,
            message: $message,
            help: "Remove the rotary axis, or move it in a separate line.",
        };)*
    };
}

rotary! {
    AXIS_A "Cannot put an a in canned cycle"
    AXIS_B "Cannot put a b in canned cycle"
    AXIS_C "Cannot put a c in canned cycle"
}

/// Which codes a block has, to decide which of them uses its words.
struct Codes<'b>(&'b Block);

impl Codes<'_> {
    fn motion(&self, codes: &[i16]) -> bool {
        codes.contains(&self.0.motion)
    }
    fn g(&self, group: usize, codes: &[i16]) -> bool {
        codes.contains(&self.0.g[group])
    }
    fn m(&self, group: usize, codes: &[i16]) -> bool {
        codes.contains(&self.0.m[group])
    }
    fn arc(&self) -> bool {
        self.motion(&[20, 30])
    }
    fn cycle(&self) -> bool {
        self.motion(&[730, 740]) || (810..=890).contains(&self.0.motion)
    }
    fn turning(&self) -> bool {
        (700..=722).contains(&self.0.motion)
    }
    fn roughing(&self) -> bool {
        (710..=722).contains(&self.0.motion)
    }
    fn g10(&self) -> bool {
        self.g(0, &[100])
    }
    fn user(&self) -> bool {
        self.0.m[10] >= 0
    }
    /// Whether something uses the word of a letter.
    fn uses(&self, letter: u8) -> bool {
        match letter {
            b'D' => self.g(7, &[410, 411, 420, 421]) || self.g(14, &[960]) || self.turning(),
            b'E' => self.motion(&[330, 331, 700, 760]) || self.m(5, &[66, 67, 68]),
            b'H' => self.g(8, &[430, 432]) || self.motion(&[760]),
            b'I' => self.arc() || self.motion(&[50, 51, 331, 760, 870]) || self.roughing() || self.g10(),
            b'J' => self.arc() || self.motion(&[50, 51, 760, 870]) || self.g10(),
            b'K' => self.arc() || self.motion(&[330, 331, 760, 870, 61, 62]),
            b'L' => {
                (self.cycle() && !self.motion(&[740]))
                    || self.g10()
                    || self.g(7, &[410, 411, 420, 421])
                    || self.motion(&[52, 53, 62, 63, 760])
                    || self.m(5, &[66])
                    || self.0.m.contains(&98)
            }
            b'P' => {
                self.arc()
                    || self.g10()
                    || self.g(0, &[40])
                    || self.g(13, &[640])
                    || self.motion(&[50, 52, 61, 62, 740, 760, 820, 840, 860, 880, 890])
                    || self.motion(&[700])
                    || self.m(9, &[50, 51, 52, 53])
                    || self.m(5, &[62, 63, 64, 65, 66])
                    || self.m(7, &[19])
                    || self.0.m.contains(&98)
                    || self.user()
            }
            b'Q' => {
                self.g10()
                    || self.g(13, &[640])
                    || self.motion(&[50, 730, 760, 830, 61, 62])
                    || self.turning()
                    || self.m(5, &[66, 67, 68])
                    || self.m(6, &[61])
                    || self.m(7, &[19])
                    || self.user()
            }
            b'R' => {
                // G41.1 and G42.1 take an R that means nothing
                self.arc()
                    || self.cycle()
                    || self.motion(&[760])
                    || self.roughing()
                    || self.g10()
                    || self.m(7, &[19])
                    || self.g(7, &[411, 421])
            }
            _ => true,
        }
    }
    /// Whether something uses `$`.
    fn uses_spindle(&self) -> bool {
        self.m(7, &[3, 4, 5, 19]) || self.m(9, &[51]) || self.motion(&[330, 331, 760]) || self.0.has(b'S')
    }
}

/// The first word that nothing in the block uses, in the order in which the control looks.
#[inline]
pub(crate) fn check(block: &Block) -> Result<(), Error> {
    let rotary = block.given & 0b111 != 0 && Codes(block).cycle();
    if block.given & ASKED == 0 && !rotary && block.spindle.is_none() {
        return Ok(());
    }
    check_each(block)
}

/// Letters that may have nothing to use them.
const ASKED: u32 = {
    let mut bits = 0;
    let letters = b"DEHIJKLPQR";
    let mut at = 0;
    while at < letters.len() {
        bits |= 1 << (letters[at] - b'A');
        at += 1;
    }
    bits
};

fn check_each(block: &Block) -> Result<(), Error> {
    let codes = Codes(block);
    // the control checks these before the block does anything, and before all other words
    for (letter, problem) in [(b'A', &AXIS_A), (b'B', &AXIS_B), (b'C', &AXIS_C)] {
        if block.has(letter) && codes.cycle() {
            return Err(Error::new(problem, block.range_of(letter)));
        }
    }
    // the control marks an absent Q by -1
    let given = |letter: u8| match letter {
        b'Q' => block.word(letter).is_some_and(|q| q != -1.0),
        _ => block.has(letter),
    };
    for (letter, problem) in [
        (b'D', &D),
        (b'E', &E),
        (b'H', &H),
        (b'I', &I),
        (b'J', &J),
        (b'K', &K),
        (b'L', &L),
        (b'P', &P),
        (b'Q', &Q),
        (b'R', &R),
    ] {
        if given(letter) && !codes.uses(letter) {
            return Err(Error::new(problem, block.range_of(letter)));
        }
        match letter {
            b'D' if block.spindle.is_some() && !codes.uses_spindle() => return Err(Error::new(&DOLLAR, block.range)),
            b'P' => check_p(block)?,
            b'R' => check_angle(block)?,
            _ => {}
        }
    }
    Ok(())
}

/// P of arcs and of M19 is a count.
fn check_p(block: &Block) -> Result<(), Error> {
    let Some(p) = block.word(b'P') else { return Ok(()) };
    let (arc, orient) = (matches!(block.motion, 20 | 30), block.m[7] == 19);
    let problem = if (arc || orient) && (p - p.round()).abs() > 0.001 {
        &problems::P_NOT_INTEGER
    } else if orient && !(0.0..=2.0).contains(&p.round()) && !p.is_nan() {
        &problems::M19_P
    } else if arc && p.round() < 1.0 {
        &problems::P_TURNS
    } else {
        return Ok(());
    };
    Err(Error::new(problem, block.range_of(b'P')))
}

/// R of M19 is an angle.
fn check_angle(block: &Block) -> Result<(), Error> {
    match block.word(b'R') {
        Some(angle) if block.m[7] == 19 && !(0.0..=360.0).contains(&angle) && !angle.is_nan() => {
            Err(Error::new(&problems::M19_R, block.range_of(b'R')))
        }
        _ => Ok(()),
    }
}
