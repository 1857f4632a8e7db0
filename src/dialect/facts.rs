//! What a run of a program depends on in a dialect, apart from its prose.
use crate::{ArcTolerance, Code, CodeKind, Dialect, Quirks, Role};
use trunnion_syntax::LexOptions;

/// The facts of a [`Dialect`]; its titles, explanations, sources and file name extensions are not among them. Two dialects with
/// the same facts run every program alike.
#[derive(Clone, Debug)]
pub struct DialectFacts<'a> {
    /// Its name.
    pub name: &'a str,
    /// How its text is split into tokens.
    pub lex: LexOptions,
    /// How far the radii of an arc's start and end may differ.
    pub arc: &'a ArcTolerance,
    /// Codes that the machine builder may own: kind, first and last number in tenths.
    pub builder_codes: Vec<(CodeKind, u32, u32)>,
    /// Codes: G by number, then M by number, then names by text.
    pub codes: &'a [Code],
    /// Letters that have a role, A to Z, then `@` and `^`.
    pub roles: Vec<(u8, Role)>,
    /// Roles of names before `=`, in the order in which they are looked up.
    pub named_roles: &'a [(String, Role)],
    /// Facts that are neither letters nor codes.
    pub quirks: &'a Quirks,
    /// Mistakes that the control refuses with an alarm, by key, and the alarm's number.
    pub alarms: Vec<(&'a str, &'a str)>,
}

impl Dialect {
    /// What a run depends on.
    pub fn facts(&self) -> DialectFacts<'_> {
        // without `..`: a new field must be classified here: does a run depend on it?
        let Self {
            name,
            title: _,
            lex,
            arc,
            extensions: _,
            groups: _,
            alarms,
            builder_codes,
            codes,
            // the indexes follow from `codes`
            g: _,
            m: _,
            names: _,
            roles: _,
            named,
            quirks,
            // what a check knows, which changes no run
            advice: _,
        } = self;
        DialectFacts {
            name,
            lex: *lex,
            arc,
            builder_codes: builder_codes
                .iter()
                .map(|(kind, range)| (*kind, *range.start(), *range.end()))
                .collect(),
            codes,
            roles: (b'A'..=b'Z')
                .chain(*b"@^")
                .filter_map(|letter| Some((letter, self.role(letter)?)))
                .collect(),
            named_roles: named,
            quirks,
            alarms: alarms
                .iter()
                .map(|(mistake, alarm)| (mistake.as_str(), alarm.number.as_str()))
                .collect(),
        }
    }
}
