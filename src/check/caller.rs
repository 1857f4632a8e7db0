//! Whether a file is a main program or a subprogram: of that, F, S, the spindle and the position may come from the program that calls it.
use crate::coverage::{Mark, mark};
use crate::suppress::has_code;
use trunnion_dialect::{Dialect, Language};
use trunnion_interp::{SentenceWord, sentence_words};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Program, Word};

/// What a file is, as far as its text says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// A main program: it has a program end (M2, M30).
    Main,
    /// A subprogram.
    Called,
    /// Neither says so: a part of a program.
    Fragment,
}

/// What the text says: a subprogram begins with PROC, or the first code that ends a program is one that returns to a caller (M99, M17, RET, RTS).
/// In LinuxCNC, where subprograms come first, the last such code counts.
pub(crate) fn part(program: &Program, dialect: &Dialect) -> Part {
    let sinumerik = dialect.quirks.language == Language::Sinumerik;
    let returns: &[&str] = match dialect.quirks.language {
        Language::Sinumerik => &["M17", "RET"],
        Language::UserTask => &["RTS"],
        _ => &["M99"],
    };
    if dialect.lex.format == Format::Apt {
        let is_end = |id| {
            let record = program.block(BlockId(id)).record();
            record.is_some_and(|record| record.is("FINI") || record.is("END"))
        };
        let ends = (0..program.block_count() as u32).rev().any(is_end);
        return if ends { Part::Main } else { Part::Fragment };
    }
    if dialect.lex.format == Format::Klartext {
        return klartext_part(program);
    }
    if dialect.quirks.language == Language::Linuxcnc && only_defines(program) {
        return Part::Called;
    }
    let mut blocks = (0..program.block_count() as u32).map(BlockId);
    if sinumerik
        && blocks
            .clone()
            .find(|&id| has_code(program, id))
            .is_some_and(|id| says(program, id, &["PROC"]))
    {
        return Part::Called;
    }
    let end = |id: BlockId| {
        if says(program, id, returns) {
            return Some(Part::Called);
        }
        says(program, id, &["M2", "M30"]).then_some(Part::Main)
    };
    let found = if dialect.quirks.language == Language::Linuxcnc {
        blocks.rev().find_map(end)
    } else {
        blocks.find_map(end)
    };
    found.unwrap_or(Part::Fragment)
}

/// A called Klartext program has no M2 or M30, and END PGM ends both sorts: one that calls a tool or has M2 or M30 is a main program.
fn klartext_part(program: &Program) -> Part {
    let is_main = |block: Block<'_>| {
        let Some(sentence) = block.sentence() else {
            return false;
        };
        let words: Vec<SentenceWord> = sentence_words(&sentence.text()).collect();
        let calls = matches!(&words[..], [tool, call, ..] if tool.name == "TOOL" && call.name == "CALL");
        let ends = |word: &SentenceWord| word.name == "M" && matches!(word.number, Some(2.0 | 30.0));
        calls || words.iter().any(ends)
    };
    if program.blocks().any(is_main) {
        Part::Main
    } else {
        Part::Fragment
    }
}

/// Whether a LinuxCNC program does nothing but define subprograms and end.
pub(crate) fn only_defines(program: &Program) -> bool {
    let (mut inside, mut some) = (false, false);
    for block in program.blocks().filter(|block| has_code(program, block.id())) {
        match mark(&block, Language::Linuxcnc) {
            Some(Mark::Begins) => (inside, some) = (true, true),
            Some(Mark::Ends) => inside = false,
            None if inside => {}
            None if block.items().any(|item| matches!(item, Item::Percent(_))) => {}
            None if says(program, block.id(), &["M2", "M30"]) => break,
            None => return false,
        }
    }
    some
}

/// Whether a block of the text has M3 or M4.
pub(crate) fn starts_spindle(program: &Program) -> bool {
    let mut blocks = (0..program.block_count() as u32).map(BlockId);
    blocks.any(|id| says(program, id, &["M3", "M4"]))
}

/// Whether a block of the program names a plane.
pub(crate) fn names_plane(program: &Program) -> bool {
    let mut blocks = (0..program.block_count() as u32).map(BlockId);
    blocks.any(|id| says(program, id, &["G17", "G18", "G19"]))
}

/// Whether a block has one of these codes; M2 is also M02.
fn says(program: &Program, id: BlockId, wanted: &[&str]) -> bool {
    let text = program.bytes(program.block(id).range());
    // most blocks have none of their letters
    let begins = |code: &&str| {
        let letter = code.as_bytes()[0];
        memchr::memchr2(letter, letter.to_ascii_lowercase(), text).is_some()
    };
    if !wanted.iter().any(begins) {
        return false;
    }
    program.block(id).items().any(|item| match item {
        Item::Call(call) => {
            let name = program.bytes(call.name);
            wanted.iter().any(|code| name.eq_ignore_ascii_case(code.as_bytes()))
        }
        Item::Word(Word {
            address: Address::Letter(letter @ (b'G' | b'M')),
            range,
            ..
        }) => {
            let text = program.text(range);
            let number = text.get(1..).unwrap_or_default().trim_start_matches([' ', '0']);
            wanted
                .iter()
                .any(|code| code.strip_prefix(char::from(letter)) == Some(number))
        }
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::{Part, part};

    #[test]
    fn the_text_says_whether_it_is_called() {
        for (dialect, text, wanted) in [
            ("fanuc-30i", "%\nO1\nG1 X1.\nM99\n%\n", Part::Called),
            ("fanuc-30i", "%\nO1\nG1 X1.\nM98 P2\nM30\n%\n", Part::Main),
            ("fanuc-30i", "O1\nG1 X1.\nM30\nO2\nG1 X1.\nM99\n", Part::Main),
            ("linuxcnc", "G1 X1\nM99\n", Part::Called),
            ("linuxcnc", "O1\nG1 X1\nM99\nG1 X1\nM02\n", Part::Main),
            ("linuxcnc", "%\no<slot> sub\nG1 X#1\no<slot> endsub\n%\n", Part::Called),
            ("linuxcnc", "(a)\no1 sub\nG1 X#1\no1 endsub\nM2\nG0\n", Part::Called),
            ("linuxcnc", "o1 sub\nG1 X#1\no1 endsub\no1 call [2]\nM2\n", Part::Main),
            ("linuxcnc", "o1 sub\nG1 X#1\no1 endsub\nG0 X1\nM2\n", Part::Main),
            ("iso-6983", "G1 X1\nM2\n", Part::Main),
            ("sinumerik-840d", "G1 X1\nM17\n", Part::Called),
            ("sinumerik-840d", "G1 X1\nRET\n\n; the end\n", Part::Called),
            (
                "sinumerik-840d",
                "; a part\nPROC SLOT(REAL F1)\nG1 X1\nM30\n",
                Part::Called,
            ),
            ("sinumerik-840d", "G1 X1\nM30\n", Part::Main),
            ("sinumerik-840d", "G1 X1\n", Part::Fragment),
            ("okuma-osp", "OSUB\nG1 X1\nRTS\n", Part::Called),
            (
                "heidenhain-klartext",
                "BEGIN PGM A MM\nL X+0 M30\nEND PGM A MM\n",
                Part::Main,
            ),
            (
                "heidenhain-klartext",
                "BEGIN PGM A MM\nTOOL CALL 1 Z\nEND PGM A MM\n",
                Part::Main,
            ),
            (
                "heidenhain-klartext",
                "BEGIN PGM A MM\nL X+0 M3\nEND PGM A MM\n",
                Part::Fragment,
            ),
            ("okuma-osp", "G1 X1\nM02\nOSUB\nRTS\n", Part::Main),
        ] {
            let dialect = trunnion_dialect::builtin(dialect).expect("built in");
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            assert_eq!(part(&program, dialect), wanted, "{text}");
        }
    }
}
