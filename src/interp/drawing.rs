//! C and A of a lathe without such axes: C is a chamfer at the end of a straight cut, A the angle of the cut (Fanuc Series 30i operator's
//! manual, lathe system, chamfering and corner R, and direct drawing dimension programming; Haas Lathe Operator's Manual, G01).
//!
//! A machine with two linear axes has no C and no A, one that has the axis moves it. Without a machine the program decides: a letter that
//! only stands beside exactly one of X and Z, and never in a block of another code than G1, positions no axis.
use crate::Setup;
use crate::codes::Found;
use crate::core::Core;
use crate::words::{Number, Places, Words};
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Address, Block, Program, TextRange, Value};

const X: usize = 0;
const Z: usize = 2;
const A: usize = 3;
const C: usize = 5;

/// Whether the letters A and C name no axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Drawing {
    angle: bool,
    chamfer: bool,
    /// The program is still to be read for them.
    unread: bool,
    /// A longer text that begins with the one that was read could use them otherwise.
    open: bool,
}

impl Drawing {
    pub(crate) fn new(dialect: &Dialect, setup: &Setup) -> Self {
        let lathe = dialect.quirks.diameter && dialect.quirks.corner_words;
        let two_axes = setup.control.absent_axis.is_some();
        Self {
            angle: lathe && two_axes,
            chamfer: lathe && two_axes,
            unread: lathe && !two_axes && !setup.control.has_rotary,
            open: false,
        }
    }

    /// Whether the letters could be read otherwise if the text that was read went on.
    pub(crate) fn is_open(self) -> bool {
        self.open
    }

    /// Reads, once, what the program does with the letters.
    #[inline]
    pub(crate) fn read(&mut self, program: &Program) {
        if !self.unread {
            return;
        }
        self.unread = false;
        (self.angle, self.chamfer) = (true, true);
        for block in program.blocks() {
            let (angle, chamfer) = only_beside_a_cut(&block);
            self.angle &= angle;
            self.chamfer &= chamfer;
        }
        self.open = self.angle || self.chamfer;
    }
}

/// Whether A, and C, in a block may be words of a cut.
fn only_beside_a_cut(block: &Block<'_>) -> (bool, bool) {
    let (mut across, mut along, mut other) = (0, 0, false);
    let (mut angles, mut chamfers) = (0, 0);
    for word in block.words() {
        let Address::Letter(letter) = word.address else {
            continue;
        };
        match letter {
            b'X' | b'U' => across += 1,
            b'Z' | b'W' => along += 1,
            b'A' => angles += 1,
            b'C' => chamfers += 1,
            // an increment of C
            b'H' => chamfers = 2,
            b'I' | b'K' | b'R' | b'D' => other = true,
            b'G' => other |= !matches!(word.value, Value::Number(code) if code.to_f64() == 1.0),
            _ => {}
        }
    }
    let cut = !other && across + along == 1;
    (angles == 0 || cut && angles == 1, chamfers == 0 || cut && chamfers == 1)
}

impl Core<'_> {
    /// Takes A and C of a straight cut out of the axes. `words` in units of the program, X as a radius.
    pub(crate) fn drawing_words(&self, codes: &[Found<'_>], words: &mut Words) {
        let Drawing { angle, chamfer, .. } = self.drawing;
        let Places { given, unread, .. } = words.axes;
        let named = (given | unread) & ((1 << A) | (1 << C));
        if named == 0 || !(angle || chamfer) || !self.cuts_straight(codes) {
            return;
        }
        let across = (given | unread) & (1 << X) != 0;
        let along = (given | unread) & (1 << Z) != 0;
        if across == along {
            return;
        }
        // the value of a word where it is known
        let value = |axis: usize| {
            if unread & (1 << axis) == 0 {
                words.axes.values[axis]
            } else {
                f64::NAN
            }
        };
        let [angle_deg, chamfer_size] = [A, C].map(value);
        if chamfer && named & (1 << C) != 0 {
            let number = Number {
                value: chamfer_size.abs(),
                has_point: true,
                range: TextRange::default(),
            };
            words.corner = Some((b'C', number));
            words.axes.given &= !(1 << C);
            words.axes.unread &= !(1 << C);
        }
        if angle && named & (1 << A) != 0 {
            words.axes.given &= !(1 << A);
            words.axes.unread &= !(1 << A);
            let slope = trunnion_geometry::math::tan(trunnion_geometry::rad(angle_deg));
            let (from, to) = if across { (X, Z) } else { (Z, X) };
            let value = self
                .way_of(words, from)
                .filter(|_| unread & (1 << from) == 0)
                .map(|way| if across { way / slope } else { way * slope });
            match value.filter(|way| way.is_finite() && way.abs() < 1e6) {
                Some(way) => {
                    words.axes.values[to] = way;
                    words.axes.given |= 1 << to;
                    words.axes.incremental |= 1 << to;
                    words.axes.absolute &= !(1 << to);
                }
                None => words.axes.unread |= 1 << to,
            }
        }
    }

    /// How far a coordinate of the block moves its axis, in units of the program.
    fn way_of(&self, words: &Words, axis: usize) -> Option<f64> {
        let value = words.axes.values[axis];
        let bit = 1 << axis;
        if words.axes.incremental & bit != 0 || self.state.coordinates.incremental() && words.axes.absolute & bit == 0 {
            return Some(value);
        }
        Some(value - self.state.position.get(axis)? / self.state.coordinates.unit_mm())
    }

    /// Whether the block is a straight cut.
    fn cuts_straight(&self, codes: &[Found<'_>]) -> bool {
        let mut motion = codes.iter().map(|found| found.code.action).filter(|action| {
            matches!(
                action,
                Action::Rapid | Action::Linear | Action::ArcClockwise | Action::ArcCounterClockwise
            ) || action.is_hole_cycle()
                || action.is_pass_cycle()
        });
        motion.next_back().or(self.state.motion) == Some(Action::Linear)
    }
}
