//! Text before the first `%`: the leader of the tape, which a Fanuc skips.
use trunnion_dialect::{Dialect, Role};
use trunnion_syntax::{Address, Block, BlockId, Call, Format, Item, Program, Value};

/// Lines that are searched for the `%`. A leader is a few lines of notes.
const LONGEST: usize = 100;
/// Lines after the `%` that are searched for a block of the program.
const AFTER: usize = 20;

/// How many blocks at the start of a file are its leader: text before the first `%` that a program follows. A file whose first lines read
/// like blocks of a program has none: its `%` may be the one at the end.
pub fn leader(program: &Program, dialect: &Dialect) -> u32 {
    if !dialect.quirks.skips_leader || dialect.lex.format != Format::Iso {
        return 0;
    }
    let mut text = false;
    let blocks = program.block_count();
    for id in (0..blocks.min(LONGEST) as u32).map(BlockId) {
        let block = program.block(id);
        let mut items = block.items().filter(|item| !matches!(item, Item::Comment(_)));
        match items.next() {
            Some(Item::Percent(_)) if text && goes_on(program, id.0 as usize + 1) => return id.0,
            Some(Item::Percent(_)) => return 0,
            Some(_) if is_code(program, &block, dialect) => return 0,
            found => text |= found.is_some(),
        }
    }
    0
}

/// Whether a block of the program comes within the next lines.
fn goes_on(program: &Program, from: usize) -> bool {
    let until = program.block_count().min(from + AFTER);
    (from as u32..until as u32).any(|id| {
        let mut words = program.block(BlockId(id)).words();
        words.any(|word| matches!(word.value, Value::Number(_) | Value::Expression(_)))
    })
}

/// Whether a line reads like a block that does something: a code or a coordinate and no text beside it, or a statement of a macro. A mistake
/// in a word makes no text of its line.
fn is_code(program: &Program, block: &Block<'_>, dialect: &Dialect) -> bool {
    let mut acts = false;
    for item in block.items() {
        match item {
            Item::Word(word) => match (word.address, word.value) {
                (Address::Letter(letter), Value::Number(_) | Value::Expression(_)) => {
                    let role = dialect.role(letter);
                    acts |= matches!(role, Some(Role::G | Role::M | Role::Axis | Role::Increment));
                }
                (Address::Named(name), Value::Number(_) | Value::Expression(_)) => {
                    acts |= program.bytes(name).starts_with(b"#");
                }
                _ => {}
            },
            Item::Call(call) => return is_statement(program, &call),
            Item::Comment(_) | Item::Skip(..) => {}
            Item::Percent(_) | Item::Label(_) | Item::Other(_) => return false,
        }
    }
    acts
}

/// Whether a name is that of a statement of a macro, with what it decides or where it goes. Other names with a number are text: `Part 17`.
fn is_statement(program: &Program, call: &Call) -> bool {
    let name = program.bytes(call.name).to_ascii_uppercase();
    let Some(arguments) = call.arguments.map(|range| program.bytes(range).trim_ascii()) else {
        return false;
    };
    match name.as_slice() {
        b"IF" | b"WHILE" => arguments.starts_with(b"["),
        b"GOTO" => {
            arguments.starts_with(b"#") || arguments.starts_with(b"[") || arguments.iter().all(u8::is_ascii_digit)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::leader;

    #[test]
    fn notes_before_the_percent_sign_are_the_leader() {
        for (dialect, text, blocks) in [
            (
                "fanuc-30i",
                "Bracket, rev. 3\nMade by Meier\n%\nO1\nG0 X1.\nM30\n%\n",
                2,
            ),
            ("haas-ngc", "\n\nLEADER\n%\nO1\nG0 X1.\nM30\n%\n", 3),
            ("fanuc-30i", "O9(TITLE)\n%\nO1\nG0 X1.\nM30\n%\n", 1),
            ("fanuc-30i", "Stock X100 by Y50\n%\nO1\nG0 X1.\nM30\n%\n", 1),
            ("fanuc-30i", "(BRACKET)\n%\nO1\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "%\nO1\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "Part 17\n%\nO1\nG0 X1.\nM30\n%\n", 1),
            ("fanuc-30i", "Date 1.2.2020\nPROGRAM 1234.NC\n%O1\nG0 X1.\nM30\n%\n", 2),
            ("haas-ngc", "Part 17\n%\n:0100\nG0 X1.\nM30\n%\n", 1),
            ("fanuc-30i", "If 2 parts\n%\nG0 X1.\nM30\n%\n", 1),
            // the first `%` was lost: this one is at the end
            ("fanuc-30i", "O1\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\nG0 X1.\nM30\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\n#1=5\nG0 X1.\nM30\n%\nnotes X1\n", 0),
            ("fanuc-30i", "O1\nN5 #1=5\nN6 T1\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\nN5 IF[#1EQ5]GOTO9\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\nN5 GOTO 9\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\nG0 X1.,R2.\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "O1\nG0 X1.O Y1.\n%\nO2\nG0 X1.\nM30\n%\n", 0),
            ("fanuc-30i", "Some notes\n%\nand other notes\n", 0),
            ("linuxcnc", "Some notes\n%\nG0 X1\nM2\n%\n", 0),
        ] {
            let dialect = trunnion_dialect::builtin(dialect).expect("built in");
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            assert_eq!(leader(&program, dialect), blocks, "{text}");
        }
    }
}
