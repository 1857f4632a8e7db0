//! Axes that stand at 0 for the whole program: the one that a machine with two linear axes lacks, and, where one program is judged
//! without a machine, those of X, Y, Z that it never names ([`Setup::unnamed_stand`]): wherever such an axis is, it does not move, so path
//! and time are the same.
use crate::{Position, Setup};
use trunnion_dialect::{Dialect, Role};
use trunnion_syntax::{Address, Program};

/// X, Y and Z of a [`Position`].
const XYZ: u16 = 0b111;
/// Y.
const Y: u16 = 0b010;

/// See the module. Bits as in [`Position::known`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Standing {
    /// Those that the machine lacks.
    absent: u16,
    /// Those that the program does not name.
    unnamed: u16,
    /// The program is still to be read for them.
    unread: bool,
    /// A longer text that begins with the one that was read could name more of them.
    open: bool,
    /// On a lathe only Y may be left out.
    lathe: bool,
}

impl Standing {
    pub(crate) fn new(dialect: &Dialect, setup: &Setup) -> Self {
        let absent = setup.control.absent_axis.map_or(0, |axis| 1 << axis);
        Self {
            absent,
            unnamed: 0,
            unread: setup.unnamed_stand && absent == 0,
            open: false,
            lathe: dialect.quirks.diameter,
        }
    }

    /// All of them.
    pub(crate) fn axes(self) -> u16 {
        self.absent | self.unnamed
    }

    /// Only those that the machine lacks.
    pub(crate) fn absent(self) -> Self {
        Self { unnamed: 0, ..self }
    }

    /// Whether they could be others if the text that was read went on.
    pub(crate) fn is_open(self) -> bool {
        self.open
    }

    /// Puts them at 0.
    #[inline]
    pub(crate) fn hold(self, position: &mut Position) {
        let mut left = self.axes() & !position.known;
        while left != 0 {
            position.set(left.trailing_zeros() as usize, 0.0);
            left &= left - 1;
        }
    }

    /// Something may have moved what the program does not name: a program that is not read, a return of all axes. A lathe's Y stays.
    pub(crate) fn end_unnamed(&mut self) {
        self.unnamed &= if self.lathe { Y } else { 0 };
    }

    /// Reads, once, which axes the program names.
    #[inline]
    pub(crate) fn read(&mut self, program: &Program, dialect: &Dialect) {
        if self.unread {
            self.unread = false;
            let named = named(program, dialect);
            self.open = named != XYZ;
            self.unnamed = (if self.lathe { Y } else { XYZ }) & !named;
            if self.unnamed == XYZ {
                self.unnamed = 0;
            }
        }
    }
}

/// X, Y and Z as far as some word may move them. A word that is no letter with a value may name any of them.
#[cold]
fn named(program: &Program, dialect: &Dialect) -> u16 {
    let mut named = 0;
    for block in program.blocks() {
        for word in block.words() {
            let letter = match word.address {
                Address::Letter(letter) => letter,
                // a variable, or a corner
                Address::Named(range) if matches!(program.bytes(range), [b'#' | b',', ..]) => continue,
                Address::Named(_) | Address::Indexed(..) => return XYZ,
            };
            named |= match letter.to_ascii_uppercase() {
                b'X' => 0b001,
                b'Y' => Y,
                b'Z' => 0b100,
                other if dialect.role(other) == Some(Role::Increment) => match other {
                    b'U' => 0b001,
                    b'V' => Y,
                    b'W' => 0b100,
                    _ => 0,
                },
                _ => 0,
            };
        }
    }
    named
}
