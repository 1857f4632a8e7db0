//! Which programs a text calls, as written: M98 and G65 with P, `o<name> call`, CALL and its like.
use trunnion_syntax::{Address, Block, Item, LineIndex, Program, Value};

/// A program that is called.
#[derive(Clone, Debug)]
pub struct Call {
    /// As written, upper case: `M98 P1000`.
    pub name: String,
    /// How often it is written.
    pub count: u64,
    /// Where first, from 1.
    pub line: u32,
}

/// All calls in the order of their first line.
pub(crate) fn calls(program: &Program, lines: &LineIndex) -> Vec<Call> {
    let mut found: Vec<Call> = Vec::new();
    for block in program.blocks() {
        for name in of_block(program, &block) {
            if let Some(known) = found.iter_mut().find(|call| call.name == name) {
                known.count += 1;
                continue;
            }
            let (line, _) = lines.line_column(program.source(), block.range().start);
            found.push(Call { name, count: 1, line });
        }
    }
    found
}

fn of_block(program: &Program, block: &Block<'_>) -> Vec<String> {
    let text = |range| program.text(range).split_whitespace().collect::<String>();
    let (mut calls, mut code, mut label, mut parameter) = (Vec::new(), None, None, None);
    for item in block.items() {
        match item {
            Item::Word(word) => match (word.address, word.value) {
                (Address::Letter(letter @ (b'G' | b'M')), Value::Number(number)) => {
                    let number = number.to_integer();
                    let is_call = matches!((letter, number), (b'M', Some(97 | 98 | 198)) | (b'G', Some(65 | 66)));
                    code = if is_call {
                        number.map(|n| format!("{}{n}", char::from(letter)))
                    } else {
                        code
                    };
                }
                (Address::Letter(b'O'), _) => label = Some(text(word.range).to_ascii_lowercase()),
                (Address::Letter(b'P'), _) => parameter = Some(text(word.range).to_ascii_uppercase()),
                _ => {}
            },
            Item::Call(call) => match (text(call.name).to_ascii_uppercase().as_str(), call.arguments, &label) {
                ("CALL", _, Some(label)) => calls.push(label.clone()),
                (name @ ("CALL" | "PCALL" | "EXTCALL"), Some(arguments), None) => {
                    calls.push(format!("{name} {}", text(arguments)));
                }
                _ => {}
            },
            _ => {}
        }
    }
    if let (Some(code), Some(parameter)) = (code, parameter) {
        calls.push(format!("{code} {parameter}"));
    }
    calls
}
