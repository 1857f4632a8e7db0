//! A dialect: look-ups over a loaded table.
use crate::{
    Action, Advice, Code, CodeKind, Language, LengthAfterReturn, LengthChange, Macros, Role, ToolWord, WholeNumbers,
};
use core::cmp::Ordering;
use core::ops::RangeInclusive;
use std::collections::BTreeMap;
use trunnion_syntax::LexOptions;

/// Slots of the look-up of G and of M codes: 0 to 999.9 in tenths.
pub(crate) const G_SLOTS: usize = 10_000;

/// Facts of a control that are neither letters nor codes. In TOML: table `[quirks]`, each key optional: missing keys stay as in the table that
/// it extends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quirks {
    /// What the language has in addition to words and codes.
    pub language: Language,
    /// Which control's rules custom macros follow.
    pub macros: Macros,
    /// What T does.
    pub tool_word: ToolWord,
    /// What numbers without a decimal point mean.
    pub whole_numbers: WholeNumbers,
    /// Motion code in effect at the start of a program (Sinumerik: `linear`); `None`: none until one is programmed.
    pub motion_at_start: Option<Action>,
    /// The length of a programmed tool vector must be 1 (I J K of G43.5; not A3= B3= C3=).
    pub unit_vectors: bool,
    /// A second `%` is a program end (LinuxCNC); else it only ends the text.
    pub percent_ends_program: bool,
    /// G54 is in effect from the start (LinuxCNC, Fanuc); else no settable offset (Sinumerik G500).
    pub first_offset_at_start: bool,
    /// A tool change makes its first cutting edge (D1), and so its length, active.
    pub edge_at_tool_change: bool,
    /// In a dwell P without a decimal point is ms (Fanuc); else s. X and U without a decimal point then are ms too.
    pub dwell_in_ms: bool,
    /// Radii of an arc's start and end that differ by less than this part of the radius agree, whatever [`Dialect::arc`] says
    /// (LinuxCNC 0.001). In TOML: `relative` in `[arc-tolerance]`.
    pub arc_tolerance_relative: f64,
    /// Of two codes of one group, or two words with one letter, in a block the last one wins, without a message.
    pub last_code_wins: bool,
    /// A number may follow a name directly (`DO1`, `GOTO900`).
    pub numbers_follow_names: bool,
    /// Parameters up to this number (`#5000`) are the program's own; those above are the control's: offsets, positions, tools.
    pub own_parameters_to: u32,
    /// X, its increments and offsets are diameters (lathes).
    pub diameter: bool,
    /// G28 without coordinates returns all axes (Haas); else it moves none.
    pub return_moves_all: bool,
    /// P of a scaling is the factor itself (Haas); else a parameter says in what unit a whole number is (Fanuc 5400.7).
    pub plain_scale_factor: bool,
    /// `,R` and `,C` round or cut off the corner to the next motion.
    pub corner_words: bool,
    /// G41 and G42 offset the path in the plane by the radius of offset D, as Fanuc does.
    pub offset_compensation: bool,
    /// G10 writes the diameter or the radius of a cutter as a setting says (Haas setting 40); else the radius.
    pub cutter_offset_ambiguous: bool,
    /// A `/` inside a block deletes what follows it, if the block delete switch is on (Fanuc); otherwise only one at the start counts.
    pub delete_rest: bool,
    /// Axes in the block of a dwell move after it.
    pub dwell_then_moves: bool,
    /// A rapid runs on a straight line; else each axis may move at its own speed.
    pub straight_rapids: bool,
    /// A drilling cycle may leave out R: where its feed starts then is not known here.
    pub cycle_level_optional: bool,
    /// Where a drilling cycle returns to is not stated by a source that is read here.
    pub cycle_return_unknown: bool,
    /// M6 stops the spindle and the coolant, and nothing starts them again.
    pub tool_change_stops_spindle: bool,
    /// M0 stops the spindle and the coolant, and nothing starts them again.
    pub program_stop_stops_spindle: bool,
    /// What G28, G30 and G53 do to the length of the tool.
    pub length_after_return: LengthAfterReturn,
    /// What a change of the tool length moves.
    pub length_change: LengthChange,
    /// A line that begins with `$` is a command to the control, and `!`, `~` and `?` act when they arrive (grbl).
    pub dollar_commands: bool,
    /// Text before the first `%` is the leader of the tape: the control skips it (Fanuc).
    pub skips_leader: bool,
    /// Machine data decide whether a block in machine coordinates is without the tool's length (Sinumerik 10760 MN_G53_TOOLCORR);
    /// else it is without.
    pub machine_data_suppress_length: bool,
}

/// An alarm of a control, as its manual numbers it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Alarm {
    /// `PS0045`.
    pub number: String,
    /// Where that is written down.
    pub source: String,
}

/// How far the radii of an arc's start and end may differ.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcTolerance {
    /// mm, programs in millimetres.
    pub mm: f64,
    /// mm, programs in inch.
    pub inch_mm: f64,
    /// Or this part of the radius; 0 where the control has no such rule.
    pub relative: f64,
    /// The part of the radius counts up to this many times the fixed tolerance.
    pub relative_up_to: f64,
    /// Where that is written down.
    pub source: String,
}

/// A loaded dialect.
#[derive(Clone, Debug)]
pub struct Dialect {
    /// Its name: `sinumerik-840d`.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// How its text is split into tokens.
    pub lex: LexOptions,
    /// How much an arc's end radius may differ from its start radius.
    pub arc: ArcTolerance,
    /// File name extensions that name this dialect, lower case, no dot.
    pub extensions: Vec<String>,
    /// Modal groups: name to one line for people.
    pub groups: BTreeMap<String, String>,
    pub(crate) alarms: BTreeMap<String, Alarm>,
    pub(crate) builder_codes: Vec<(CodeKind, RangeInclusive<u32>)>,
    /// G by number, then M by number, then names by text.
    pub(crate) codes: Vec<Code>,
    /// Index into `codes` plus one by number x 10 for G 0..=999.9; 0 = unknown.
    pub(crate) g: Vec<u16>,
    /// The same for M.
    pub(crate) m: Vec<u16>,
    /// Indexes into `codes` of the names, sorted by name.
    pub(crate) names: Vec<u16>,
    /// By letter, then `@`, `^` and `$`.
    pub(crate) roles: [Option<Role>; 29],
    /// Roles of names with `=`, upper case: `CR`, `TURN`, `A3`.
    pub(crate) named: Vec<(String, Role)>,
    /// Facts that are neither letters nor codes.
    pub quirks: Quirks,
    /// What a check knows about the control.
    pub advice: Advice,
}

impl Dialect {
    /// The code `G` number / 10 (G43.4 is 434), O(1).
    pub fn g(&self, tenths: u32) -> Option<&Code> {
        let i = *self.g.get(tenths as usize)?;
        (i != 0).then(|| &self.codes[usize::from(i) - 1])
    }
    /// The code `M` number / 10, O(1).
    pub fn m(&self, tenths: u32) -> Option<&Code> {
        let i = *self.m.get(tenths as usize)?;
        (i != 0).then(|| &self.codes[usize::from(i) - 1])
    }
    /// A name such as TRAORI or CYCLE832, ASCII case ignored; O(log n). Where the control lets numbers follow names (`DO1`),
    /// the name without them.
    pub fn name(&self, name: &str) -> Option<&Code> {
        let exact = |name: &str| {
            let found = self
                .names
                .binary_search_by(|&i| ignore_case(&self.codes[usize::from(i)].id, name))
                .ok()?;
            Some(&self.codes[usize::from(self.names[found])])
        };
        let stem = || name.trim_end_matches(|c: char| c.is_ascii_digit());
        exact(name).or_else(|| {
            if self.quirks.numbers_follow_names {
                exact(stem())
            } else {
                None
            }
        })
    }
    /// Whether the machine builder may give the code, unknown to the control, a meaning (number in tenths).
    pub fn builder_may_own(&self, kind: CodeKind, tenths: u32) -> bool {
        self.builder_codes
            .iter()
            .any(|(known, range)| *known == kind && range.contains(&tenths))
    }
    /// How far the radii of an arc's start and end may differ, mm, if the larger one is `radius_mm`; `inch`: in a program in inch.
    pub fn arc_limit_mm(&self, radius_mm: f64, inch: bool) -> f64 {
        let fixed = if inch { self.arc.inch_mm } else { self.arc.mm };
        fixed.max((self.arc.relative * radius_mm).min(self.arc.relative_up_to * fixed))
    }
    /// What a letter (upper case, or `@`, `^`, `$`) means.
    pub fn role(&self, letter: u8) -> Option<Role> {
        self.roles[role_slot(letter)?]
    }
    /// What a name before `=` means (`CR`, `TURN`, `A3`), ASCII case ignored. A letter with any number (`R#` in the table) is
    /// found when the very name is not.
    pub fn named_role(&self, name: &[u8]) -> Option<Role> {
        let exact = |name: &[u8]| {
            self.named
                .iter()
                .find(|(known, _)| known.as_bytes().eq_ignore_ascii_case(name))
                .map(|row| row.1)
        };
        let any_number = || match name {
            [letter, digits @ ..] if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) => {
                exact(&[*letter, b'#'])
            }
            _ => None,
        };
        exact(name).or_else(any_number)
    }
    /// Whether a code switches the tool's length on (G43); on lathes the tool word does it, on other controls the tool change.
    pub fn length_by_code(&self) -> bool {
        let on = |code: &Code| code.action == Action::ToolLengthOn && (code.id == "G43" || code.id == "G56");
        self.quirks.tool_word != ToolWord::ChangesWithOffset && self.codes.iter().any(on)
    }
    /// The control's alarm for a mistake by its key in `[alarms]`: `peck-missing`.
    pub fn alarm(&self, mistake: &str) -> Option<&Alarm> {
        self.alarms.get(mistake)
    }
    /// All codes.
    pub fn codes(&self) -> &[Code] {
        &self.codes
    }
    /// A dialect that knows nothing.
    pub(crate) fn empty() -> Self {
        let arc = ArcTolerance {
            mm: 0.0,
            inch_mm: 0.0,
            relative: 0.0,
            relative_up_to: 0.0,
            source: String::new(),
        };
        Self {
            name: String::new(),
            title: String::new(),
            lex: LexOptions::default(),
            arc,
            extensions: Vec::new(),
            groups: BTreeMap::new(),
            alarms: BTreeMap::new(),
            builder_codes: Vec::new(),
            codes: Vec::new(),
            g: Vec::new(),
            m: Vec::new(),
            names: Vec::new(),
            roles: [None; 29],
            named: Vec::new(),
            quirks: Quirks::default(),
            advice: Advice::default(),
        }
    }
}

/// Order of text with ASCII lower case taken as upper case.
fn ignore_case(a: &str, b: &str) -> Ordering {
    a.bytes()
        .map(|b| b.to_ascii_uppercase())
        .cmp(b.bytes().map(|b| b.to_ascii_uppercase()))
}

/// Index of a letter in the table of roles.
pub(crate) fn role_slot(letter: u8) -> Option<usize> {
    match letter {
        b'A'..=b'Z' => Some(usize::from(letter - b'A')),
        b'@' => Some(26),
        b'^' => Some(27),
        b'$' => Some(28),
        _ => None,
    }
}
