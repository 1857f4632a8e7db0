//! Signature help: the words that a code reads, and which one the cursor is on.
use crate::text::codes;
use trunnion_dialect::{Action, Code, Dialect, Role};
use trunnion_syntax::{Address, Item, Program};

/// A code with the words that it reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// `G83 R Q F K`.
    pub label: String,
    /// What the code does, Markdown.
    pub docs: String,
    /// The words: their bytes in the label, and what each means.
    pub words: Vec<((u32, u32), String)>,
    /// The word that the cursor is on or behind.
    pub active: Option<u32>,
}

/// The signature of the code that the cursor's block programs last before the cursor.
pub fn signature(program: &Program, dialect: &Dialect, offset: u32) -> Option<Signature> {
    let block = program.block(program.block_at(offset)?);
    let mut before = codes(dialect, &block)
        .into_iter()
        .filter(|(_, range)| range.start < offset);
    let (code, range) = before.rfind(|(code, _)| takes_words(code))?;
    let mut label = code.id.clone();
    let mut words = Vec::new();
    for word in &code.words {
        label.push(' ');
        let start = label.len() as u32;
        label.push_str(word);
        words.push(((start, label.len() as u32), meaning(dialect, word)));
    }
    let active = if block.record().is_some() {
        None
    } else {
        let on = block.items().filter_map(|item| match item {
            Item::Word(word) if word.range.start < offset && word.range.start >= range.end => Some(word.address),
            _ => None,
        });
        on.last().and_then(|address| {
            let text = match address {
                Address::Letter(letter) => char::from(letter).to_string(),
                Address::Indexed(letter, number) => format!("{}{number}", char::from(letter)),
                Address::Named(range) => program.text(range).to_ascii_uppercase(),
            };
            code.words.iter().position(|word| *word == text).map(|at| at as u32)
        })
    };
    Some(Signature {
        label,
        docs: code.hover(),
        words,
        active,
    })
}

/// Whether people look up which words belong to it.
fn takes_words(code: &Code) -> bool {
    !code.words.is_empty() || matches!(code.action, Action::HoleCall | Action::SwivelCycle)
}

/// What a word means by its role on the control.
pub(crate) fn meaning(dialect: &Dialect, word: &str) -> String {
    let role = match word.as_bytes() {
        [letter] => dialect.role(*letter),
        name => dialect.named_role(name),
    };
    match role {
        Some(Role::BlockNumber) => "block number",
        Some(Role::ProgramNumber) => "program number",
        Some(Role::G) => "preparatory code",
        Some(Role::M) => "miscellaneous code",
        Some(Role::Axis) => "coordinate of the axis",
        Some(Role::ArcCentre) => "centre of the arc along its axis, or a parameter of the code",
        Some(Role::ArcRadius) => "radius of the arc, or a level of the cycle",
        Some(Role::ArcTurns) => "further full turns of the arc",
        Some(Role::ToolVector) => "component of the tool vector",
        Some(Role::PostureStatus) => "which posture",
        Some(Role::PostureTurn) => "which turn of the rotary axes",
        Some(Role::FixedPoint) => "number of the fixed point",
        Some(Role::FeedReference) => "radius at which the rotary axis counts for the feed",
        Some(Role::Feed) => "feed",
        Some(Role::Speed) => "spindle speed",
        Some(Role::Tool) => "tool",
        Some(Role::LengthOffset) => "number of the tool length offset",
        Some(Role::EdgeOffset) => "number of the cutting edge or radius offset",
        Some(Role::Increment) => "distance from the present point",
        Some(Role::Variable) => "variable",
        Some(Role::PathWord) => "part of the path",
        Some(Role::FeedOverride) => "percent of the programmed feed",
        Some(Role::RapidOverride) => "percent of the rapid",
        Some(Role::Parameter) => "parameter of the code",
        Some(Role::NotFollowed | Role::NotModelled) | None => "not followed here",
    }
    .to_owned()
}
