//! The values of one line, in fixed places: its words, evaluated, without effect yet.
use trunnion_syntax::TextRange;

/// Modal groups of G codes; a block holds at most one code of each.
pub const G_GROUPS: usize = 17;
/// Modal groups of M codes.
pub const M_GROUPS: usize = 11;

/// No code of a group.
const NONE: i16 = -1;

/// One of the machine's own codes (a remap): `rs274` does not know it, the machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnCode {
    /// `G` or `M`.
    pub letter: u8,
    /// Ten times the number: G68.2 is 682, M428 is 4280.
    pub tenths: u32,
    /// Its bytes.
    pub range: TextRange,
}

impl core::fmt::Display for OwnCode {
    /// As it is written: `G68.2`, `M428`.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}{}", char::from(self.letter), self.tenths / 10)?;
        match self.tenths % 10 {
            0 => Ok(()),
            tenth => write!(f, ".{tenth}"),
        }
    }
}

/// One line, evaluated. Codes are ten times their number (G38.2 is 382; M codes are whole: M6 is 6).
#[derive(Clone, Debug)]
pub struct Block {
    /// The line's bytes.
    pub range: TextRange,
    /// By modal group as LinuxCNC numbers them (0: non-modal, 1: motion, 2: plane, 3: distance, 4: arc distance, 5: feed mode, 6: units,
    /// 7: cutter compensation, 8: tool length, 10: retract, 12: coordinate system, 13: path control, 14: spindle mode, 15: lathe
    /// diameter mode, 16: G92.x); -1 where there is none.
    pub g: [i16; G_GROUPS],
    /// Bit per group: it has a code.
    g_groups: u32,
    /// Range of the code of each group; valid where there is one.
    g_ranges: [TextRange; G_GROUPS],
    /// M codes by group (4: stopping, 5: digital I/O, 6: tool change, 7: spindle, 8: coolant, 9: overrides, 10: user-defined).
    pub m: [i16; M_GROUPS],
    /// Range of the code of each group; valid where there is one.
    m_ranges: [TextRange; M_GROUPS],
    /// How many M codes.
    pub m_count: u8,
    /// The motion code that applies to the block: the one given, or the modal one if there are axis words; -1 for none.
    pub motion: i16,
    /// Values of the words A-Z without G, M, N, O; index = letter - A.
    pub words: [f64; 26],
    /// Bit per letter: the word is there.
    pub given: u32,
    /// Start of each word's bytes and end; valid where given.
    pub ranges: [TextRange; 26],
    /// Polar radius `@`, programmed units.
    pub radius: Option<f64>,
    /// Polar angle `^`, degrees.
    pub angle: Option<f64>,
    /// Spindle number `$`; `None`: not given.
    pub spindle: Option<i32>,
    /// The sequence number N, if there is one.
    pub number: Option<f64>,
    /// The machine's own codes as written in the text; the words of the block are their arguments.
    pub own: Vec<OwnCode>,
}

impl Block {
    /// An empty block.
    pub fn new() -> Self {
        Self {
            range: TextRange::default(),
            g: [NONE; G_GROUPS],
            g_groups: 0,
            g_ranges: [TextRange::default(); G_GROUPS],
            m: [NONE; M_GROUPS],
            m_ranges: [TextRange::default(); M_GROUPS],
            m_count: 0,
            motion: NONE,
            words: [0.0; 26],
            given: 0,
            ranges: [TextRange::default(); 26],
            radius: None,
            angle: None,
            spindle: None,
            number: None,
            own: Vec::new(),
        }
    }
    /// Makes it empty again; values of words stay in memory but are no longer valid.
    pub fn clear(&mut self, range: TextRange) {
        self.range = range;
        self.g = [NONE; G_GROUPS];
        self.g_groups = 0;
        self.m = [NONE; M_GROUPS];
        self.m_count = 0;
        self.motion = NONE;
        self.given = 0;
        self.radius = None;
        self.angle = None;
        self.spindle = None;
        self.number = None;
        self.own.clear();
    }
    /// The value of a word, upper-case letter.
    #[inline]
    pub fn word(&self, letter: u8) -> Option<f64> {
        let place = letter - b'A';
        (self.given & (1 << place) != 0).then(|| self.words[usize::from(place)])
    }
    /// Puts a word in its place, upper-case letter.
    #[inline]
    pub(crate) fn put(&mut self, letter: u8, value: f64, range: TextRange) {
        let place = usize::from(letter - b'A');
        self.words[place] = value;
        self.ranges[place] = range;
        self.given |= 1 << place;
    }
    /// Whether a word is there, upper-case letter.
    #[inline]
    pub fn has(&self, letter: u8) -> bool {
        self.given & (1 << (letter - b'A')) != 0
    }
    /// Bytes of a word, or of the whole line where it is not there.
    pub fn range_of(&self, letter: u8) -> TextRange {
        if self.has(letter) {
            self.ranges[usize::from(letter - b'A')]
        } else {
            self.range
        }
    }
    /// The code of a G group, if there is one.
    #[inline]
    pub fn g_code(&self, group: usize) -> Option<i16> {
        (self.g[group] != NONE).then(|| self.g[group])
    }
    /// Bytes of the code of a G group, or of the whole line where there is none.
    #[inline]
    pub fn g_range(&self, group: usize) -> TextRange {
        if self.g[group] == NONE {
            self.range
        } else {
            self.g_ranges[group]
        }
    }
    /// Bytes of the code of an M group, or of the whole line where there is none.
    #[inline]
    pub fn m_range(&self, group: usize) -> TextRange {
        if self.m[group] == NONE {
            self.range
        } else {
            self.m_ranges[group]
        }
    }
    /// Puts a G code in its group.
    #[inline]
    pub(crate) fn put_g(&mut self, group: usize, code: i16, range: TextRange) {
        self.g[group] = code;
        self.g_groups |= 1 << group;
        self.g_ranges[group] = range;
    }
    /// Puts an M code in its group; it is not counted.
    #[inline]
    pub(crate) fn put_m(&mut self, group: usize, code: i16, range: TextRange) {
        self.m[group] = code;
        self.m_ranges[group] = range;
    }
    /// Whether there are only a motion code, axis words and words that belong to it: no other code, no S, no T.
    #[inline]
    pub(crate) fn is_motion_only(&self) -> bool {
        let codes = self.g_groups & !MOTION == 0 && self.m_count == 0;
        let words = 1 << (b'S' - b'A') | 1 << (b'T' - b'A');
        codes && self.given & words == 0 && self.spindle.is_none() && self.own.is_empty()
    }
    /// Whether there are only a motion code, axis words and F, no polar words.
    #[inline]
    pub(crate) fn is_line_only(&self) -> bool {
        let words = AXES | 1 << (b'F' - b'A');
        self.given & !words == 0 && self.given & AXES != 0 && !self.is_polar() && self.is_motion_only()
    }
    /// The code of an M group, if there is one.
    #[inline]
    pub fn m_code(&self, group: usize) -> Option<i16> {
        (self.m[group] != NONE).then(|| self.m[group])
    }
    /// Whether a polar word is there.
    #[inline]
    pub(crate) fn is_polar(&self) -> bool {
        self.radius.is_some() || self.angle.is_some()
    }
    /// Whether any axis word X Y Z A B C U V W (or a polar word) is there.
    #[inline]
    pub fn has_axes(&self) -> bool {
        self.given & AXES != 0 || self.radius.is_some() || self.angle.is_some()
    }
}

/// The bit of the motion codes' group.
const MOTION: u32 = 1 << 1;

/// Bits of A B C U V W X Y Z.
pub(crate) const AXES: u32 = 0b111 | (0b11_1111 << 20);

impl Default for Block {
    fn default() -> Self {
        Self::new()
    }
}
