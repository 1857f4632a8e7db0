//! What a program says beside its motions: words that the motions do not hold, so that they are compared letter for letter.
//!
//! Motions are compared in numbers. What is not modelled (cycles, calls, expressions, frames), tool and M words, skipped blocks
//! and every block whose end is unknown say more than their motion: two programs are only as alike as these are the same.
use trunnion_dialect::{Dialect, Role};
use trunnion_interp::FaultKind;
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Program, Value};

/// What one block says beside its motions.
#[derive(Clone, Debug)]
pub(crate) struct Side {
    /// How many motions the program made before the block.
    pub motions: u64,
    /// The block.
    pub block: BlockId,
    /// The whole block counts, not only some words.
    pub whole: bool,
    /// Names of what is taken as zero because it is not declared (work offsets, tool lengths).
    pub unset: String,
}

/// What a fault means for a comparison.
pub(crate) enum Told {
    /// The motion holds all there is.
    Nothing,
    /// The whole block counts.
    Block,
    /// What is taken as zero counts by its name.
    Unset(String),
    /// The run was not followed to its end, so what may come behind is not compared: why.
    End(String),
}

/// What a fault means for a comparison. Faults not named here make their block count: better too many.
pub(crate) fn of_fault(kind: &FaultKind) -> Told {
    match kind {
        FaultKind::MissingFeed { .. }
        | FaultKind::ArcRadiusMismatch { .. }
        | FaultKind::ArcRadiusTooSmall { .. }
        | FaultKind::VectorNotUnit { .. }
        | FaultKind::AmbiguousDecimal
        | FaultKind::UnusedWord
        | FaultKind::TcpState(_)
        | FaultKind::MissingProgramEnd => Told::Nothing,
        FaultKind::WorkOffsetUnset { name } => Told::Unset(name.clone()),
        FaultKind::ToolLengthUnset { tool } => Told::Unset(tool.clone()),
        FaultKind::EndlessLoop { proved: true, .. } => {
            Told::End("it never ends: a loop comes back to the same values".to_owned())
        }
        FaultKind::EndlessLoop { blocks, .. } => Told::End(format!("it does not end within {blocks} executed blocks")),
        FaultKind::NotDecided { what } => Told::End(format!("where it goes on depends on {what}")),
        FaultKind::Rejected { message, .. } => Told::End(format!("the control refuses it: {message}")),
        _ => Told::Block,
    }
}

/// The text of a side without blanks and comments, upper case; empty where the block says nothing beside its motions.
pub(crate) fn text(program: &Program, dialect: &Dialect, side: &Side) -> String {
    let block = program.block(side.block);
    let mut out = String::new();
    if dialect.lex.format == Format::Apt {
        if let Some(record) = block.record() {
            let spoken = ["GOTO", "FROM", "RAPID", "FEDRAT", "PARTNO", "PPRINT", "REMARK"];
            if side.whole || !spoken.iter().any(|major| record.is(major)) {
                push(&mut out, &program.text(record.range));
            }
        }
    } else {
        words(program, dialect, &block, side.whole, &mut out);
    }
    out.push_str(&side.unset);
    out
}

fn words(program: &Program, dialect: &Dialect, block: &Block<'_>, whole: bool, out: &mut String) {
    for item in block.items() {
        let range = match item {
            Item::Comment(_) => continue,
            Item::Word(word) => {
                let role = match word.address {
                    Address::Letter(letter) => dialect.role(letter),
                    _ => None,
                };
                if role == Some(Role::BlockNumber) {
                    continue;
                }
                let tells = matches!(role, Some(Role::M | Role::Tool | Role::LengthOffset | Role::EdgeOffset));
                let evaluated = matches!(word.value, Value::Number(_) | Value::Call(..));
                if !(whole || tells || !evaluated) {
                    continue;
                }
                word.range
            }
            Item::Call(call) => call.range,
            Item::Skip(_, range) | Item::Percent(range) | Item::Label(range) | Item::Other(range) => range,
        };
        push(out, &program.text(range));
        out.push(' ');
    }
}

fn push(out: &mut String, text: &str) {
    out.extend(
        text.chars()
            .filter(|c| !c.is_ascii_whitespace())
            .map(|c| c.to_ascii_uppercase()),
    );
}
