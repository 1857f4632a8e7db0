//! Whether a block would move the machine, judged by its text alone: in doubt it does.
use trunnion_dialect::{Action, Dialect, Language, Role};
use trunnion_syntax::{Address, Block, Item, Value};

/// Names of statements that move nothing, whatever a dialect's table says.
const STILL: &[&str] = &[
    "SUB",
    "ENDSUB",
    "IF",
    "ELSEIF",
    "ELSE",
    "ENDIF",
    "WHILE",
    "ENDWHILE",
    "DO",
    "END",
    "REPEAT",
    "ENDREPEAT",
    "UNTIL",
    "LOOP",
    "ENDLOOP",
    "FOR",
    "TO",
    "ENDFOR",
    "BREAK",
    "CONTINUE",
    "RETURN",
    "RET",
    "GOTO",
    "GOTOF",
    "GOTOB",
    "GOTOC",
    "GOTOS",
    "CASE",
    "OF",
    "DEFAULT",
    "DEF",
    "PROC",
    "EXTERN",
    "MSG",
    "SETAL",
    "STOPRE",
    "THEN",
    "DISPLOF",
    "SBLOF",
    "SBLON",
    "SAVE",
    "POPEN",
    "PCLOS",
    "DPRNT",
    "BPRNT",
    "SETVN",
];

/// Major words of APT that move.
const RECORDS: &[&str] = &["GOTO", "GODLTA", "GOHOME", "CIRCLE", "CYCLE", "CALSUB", "CALL"];

/// First words of Klartext blocks that move nothing.
const PHRASES: &[&str] = &[
    "BEGIN", "END", "LBL", "FN", "Q", "QL", "QR", "QS", "BLK", "CC", "STOP", "SEL", "DECLARE", "M",
];

/// See the module.
pub(super) fn moves(block: &Block<'_>, dialect: &Dialect) -> bool {
    if let Some(record) = block.record() {
        return RECORDS.iter().any(|major| record.is(major));
    }
    if let Some(sentence) = block.sentence() {
        let text = sentence.text();
        let name = text
            .split(|byte| !byte.is_ascii_alphabetic())
            .next()
            .unwrap_or_default()
            .to_ascii_uppercase();
        return !PHRASES.iter().any(|still| name == still.as_bytes());
    }
    let program = block.program();
    block.items().any(|item| match item {
        Item::Word(word) => match word.address {
            Address::Letter(letter @ (b'G' | b'M')) => match word.value {
                Value::Number(number) => code_moves(dialect, letter, number.to_f64()),
                _ => true,
            },
            Address::Letter(letter) => dialect.role(letter).is_some_and(role_moves),
            Address::Indexed(..) | Address::Named(_) => false,
        },
        Item::Call(call) => {
            let name = program.text(call.name).to_ascii_uppercase();
            if STILL.contains(&name.as_str()) {
                return false;
            }
            match dialect.name(&name) {
                Some(code) => action_moves(code.action),
                // a call of a subprogram
                None => true,
            }
        }
        Item::Comment(_) | Item::Skip(..) | Item::Percent(_) | Item::Label(_) | Item::Other(_) => false,
    })
}

fn code_moves(dialect: &Dialect, letter: u8, number: f64) -> bool {
    let tenths = (number * 10.0).round();
    if !(0.0..10_000.0).contains(&tenths) {
        return false;
    }
    let code = if letter == b'G' {
        dialect.g(tenths as u32)
    } else {
        dialect.m(tenths as u32)
    };
    let calls = dialect.quirks.language != Language::Words
        && matches!((letter, number as u32), (b'M', 98 | 97 | 198) | (b'G', 65 | 66));
    calls || code.is_some_and(|code| action_moves(code.action))
}

fn role_moves(role: Role) -> bool {
    matches!(role, Role::Axis | Role::Increment | Role::ArcCentre | Role::ArcRadius)
}

/// Codes that move the machine even in a block without a coordinate, or call something that may.
fn action_moves(action: Action) -> bool {
    matches!(
        action,
        Action::SubprogramCall
            | Action::HoleCall
            | Action::ReferenceReturn
            | Action::ReferenceReturnOther
            | Action::FixedPoint
            | Action::SwivelCycle
            | Action::TiltedPlaneTurn
            | Action::TiltedPlaneTurnTip
            | Action::BoltCircle
            | Action::BoltArc
            | Action::BoltLine
            | Action::CirclePocket
            | Action::CannedCycle
            | Action::FinishCycle
            | Action::NotModelled
    )
}
