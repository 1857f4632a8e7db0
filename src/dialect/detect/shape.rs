//! Mill or lathe: what the blocks of a program look like together.
use super::CONTENT_BYTES;
use super::text::{has, lines, strip_comments, word, words};

/// What was seen in a program, for any control.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    /// G43, or a T word with M6: no lathe has them.
    pub(super) mill: bool,
    /// Motions with Y.
    y: u32,
    /// Motions with X.
    x: u32,
    /// Motions in X or Z without Y.
    xz: u32,
    /// T words that name tool and offset: T0101.
    turret: bool,
    /// M6 with a T word that names a tool and its own offset: `M6 T0707`. Small lathes for teaching write it, and so may a mill.
    paired: bool,
    /// The first line with G96 S.
    surface_speed: Option<usize>,
    /// M6 without T in its line: the tool is changed by a code.
    changes: bool,
    /// G99 where no canned cycle is: on a lathe of a Fanuc it is feed per revolution, on a mill it means nothing alone.
    per_revolution: bool,
    /// G97 S, or the plane G18: mills have them too.
    hint: Option<&'static str>,
    /// G50 S, G28 U W, a turning cycle: with the line.
    lathe: Option<(&'static str, usize)>,
    /// G92 S.
    limit: Option<usize>,
}

/// Signs of a lathe, the strongest first.
pub(super) struct Lathe {
    pub(super) reason: String,
    /// A code of lathes shows it, not the shape of the blocks alone.
    pub(super) strong: bool,
    /// It is in the manner of a Fanuc: a T word with an offset, G99 for feed per revolution.
    pub(super) names_fanuc: bool,
    /// G code system B: G92 S limits the spindle.
    pub(super) system_b: bool,
}

/// Whether a T word names a tool and the offset of the same number: `0707`.
fn is_pair(digits: &str) -> bool {
    digits.len() == 4 && digits.bytes().all(|b| b.is_ascii_digit()) && digits[..2] == digits[2..] && digits != "0000"
}

/// Codes of mills in whose line G99 is the return to R: canned cycles, and the planes of a first line.
const RETURNS: &[&str] = &[
    "73", "74", "76", "80", "81", "82", "83", "84", "85", "86", "87", "88", "89", "17", "49",
];

/// Why a program may be one for a lathe, as far as its blocks show it.
pub fn possible_lathe(source: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(&source[..source.len().min(CONTENT_BYTES)]).to_ascii_uppercase();
    let mut shape = Shape::default();
    for (at, line) in lines(&text).enumerate() {
        shape.look(strip_comments(line).trim(), at + 1);
    }
    shape.lathe(false).map(|found| found.reason)
}

impl Shape {
    /// Examines a line without comments, in upper case.
    pub(super) fn look(&mut self, code: &str, line: usize) {
        let tool = words(code).find(|(letter, digits)| *letter == b'T' && digits.bytes().any(|b| b.is_ascii_digit()));
        let length = (has(code, b'G', "43") || has(code, b'G', "44")) && word(code, b'H');
        let by_code = has(code, b'M', "6");
        let paired = tool.is_some_and(|(_, digits)| is_pair(digits));
        self.mill |= length || (tool.is_some() && by_code && !paired);
        self.paired |= paired && by_code;
        if let Some((_, digits)) = tool {
            let plain = digits.bytes().all(|b| b.is_ascii_digit());
            self.turret |= plain && !by_code && matches!(digits.len(), 3 | 4) && digits != "0000";
        }
        self.x += u32::from(word(code, b'X'));
        if word(code, b'Y') {
            self.y += 1;
        } else if word(code, b'X') || word(code, b'Z') {
            self.xz += 1;
        }
        if has(code, b'G', "96") && word(code, b'S') {
            self.surface_speed.get_or_insert(line);
        }
        self.changes |= has(code, b'M', "6");
        self.per_revolution |= has(code, b'G', "99") && !RETURNS.iter().any(|other| has(code, b'G', other));
        if has(code, b'G', "97") && word(code, b'S') {
            self.hint.get_or_insert("G97");
        } else if has(code, b'G', "18") {
            self.hint.get_or_insert("G18");
        }
        let mut sign = |seen| _ = self.lathe.get_or_insert((seen, line));
        if has(code, b'G', "50") && word(code, b'S') {
            sign("G50 S");
        }
        if has(code, b'G', "28") && (word(code, b'U') || word(code, b'W')) && !word(code, b'Y') {
            sign("G28 U or W");
        }
        for (cycle, seen) in [
            ("71", "the turning cycle G71"),
            ("72", "the turning cycle G72"),
            ("73", "the turning cycle G73"),
            ("76", "the turning cycle G76"),
        ] {
            let contour = word(code, b'P') && word(code, b'Q');
            let depth = word(code, b'U') && word(code, b'R');
            if has(code, b'G', cycle) && (contour || depth) && !word(code, b'Z') {
                sign(seen);
            }
        }
        if has(code, b'G', "92") && word(code, b'S') && !word(code, b'X') {
            self.limit.get_or_insert(line);
        }
    }

    /// Whether it is the program of a lathe, and what shows it. A code that mills have too needs a second sign: motions in X and Z alone. With
    /// them a turret's T0101 is enough where M6 changes no tool, and so is surface speed. G43, M6 with T (but for T0707), and motions in Y
    /// without a turret are evidence against a lathe. On a machine that has no Y (`no_y`), motions in X and Z alone are enough.
    pub(super) fn lathe(&self, no_y: bool) -> Option<Lathe> {
        let flat = self.y == 0 && self.xz >= 2;
        if self.mill || (self.y > 0 && !self.turret) {
            return None;
        }
        let found = |reason: &str, line: usize, system_b| {
            Some(Lathe {
                reason: format!("{reason} on line {line}"),
                strong: true,
                names_fanuc: true,
                system_b,
            })
        };
        if let Some((sign, line)) = self.lathe {
            return found(sign, line, false);
        }
        if let Some(line) = self
            .limit
            .filter(|_| self.turret || (self.surface_speed.is_some() && flat))
        {
            return found("G92 S", line, true);
        }
        if !flat {
            return None;
        }
        let speed = if self.surface_speed.is_some() {
            Some("G96")
        } else {
            self.hint
        };
        let reason = match (speed, self.surface_speed) {
            (Some(code), _) if self.turret || self.paired => format!("T with an offset, {code}, X and Z alone"),
            _ if self.turret && !self.changes => "T with an offset, X and Z alone".to_owned(),
            (_, Some(line)) => format!("G96 on line {line}, X and Z alone"),
            _ if no_y => "X and Z alone, on a machine without Y".to_owned(),
            _ => return None,
        };
        Some(Lathe {
            reason,
            strong: false,
            names_fanuc: self.turret || self.paired || self.per_revolution || no_y,
            system_b: false,
        })
    }

    /// Whether X moves and Y never does.
    pub(super) fn is_flat(&self) -> bool {
        self.x > 0 && self.y == 0
    }

    /// Whether only X and Z move, with a turret: a lathe of any control.
    pub(super) fn turns(&self) -> bool {
        !self.mill
            && self.y == 0
            && self.xz > 0
            && (self.turret || self.surface_speed.is_some() || self.lathe.is_some())
    }
}
