//! Where the subprograms of a file begin and end, as far as their first lines show.
use crate::visited::Visited;
use trunnion_dialect::{Dialect, Language};
use trunnion_syntax::{Address, Block, BlockId, Item, Program};

/// The parts of a file, in order.
pub(super) struct Sections {
    parts: Vec<Part>,
}

struct Part {
    first: BlockId,
    /// It is the main program, or some of its blocks ran.
    called: bool,
}

/// What a block says about the part that it belongs to.
pub(crate) enum Mark {
    /// A subprogram begins with it.
    Begins,
    /// A subprogram ends with it.
    Ends,
}

impl Sections {
    /// The parts of a program. The blocks before the first head are the main program; in Macro B the first program is the main one.
    pub(super) fn of(program: &Program, dialect: &Dialect, ran: &Visited) -> Self {
        let language = dialect.quirks.language;
        let mut parts = vec![Part {
            first: BlockId(0),
            called: true,
        }];
        let mut heads = 0;
        let mut after_end = false;
        for block in program.blocks() {
            let id = block.id();
            if std::mem::take(&mut after_end) {
                parts.push(Part {
                    first: id,
                    called: true,
                });
            }
            match mark(&block, language) {
                Some(Mark::Begins) => {
                    heads += 1;
                    // the first program number of a file is that of the main program
                    let called = heads == 1 && language != Language::Linuxcnc;
                    parts.push(Part { first: id, called });
                }
                Some(Mark::Ends) => after_end = true,
                None => {}
            }
            // LinuxCNC passes the line that begins a subprogram without running what is in it
            if ran.has(id)
                && let Some(part) = parts.last_mut()
                && (language != Language::Linuxcnc || part.first != id)
                && !after_end
            {
                part.called = true;
            }
        }
        Self { parts }
    }

    /// The number of the part in which a block is, and whether it is the main program or was called.
    pub(super) fn at(&self, block: BlockId) -> (usize, bool) {
        let part = self.parts.partition_point(|part| part.first <= block).saturating_sub(1);
        (part, self.parts[part].called)
    }
}

/// See [`Mark`].
pub(crate) fn mark(block: &Block<'_>, language: Language) -> Option<Mark> {
    let program = block.program();
    let first = block.first_byte()?;
    match language {
        Language::Linuxcnc if first.eq_ignore_ascii_case(&b'o') || first.eq_ignore_ascii_case(&b'n') => {
            let mut items = block.items();
            let is_o = items.any(|item| matches!(item, Item::Word(word) if word.address == Address::Letter(b'O')));
            let Some(Item::Call(call)) = items.next().filter(|_| is_o) else {
                return None;
            };
            let name = program.bytes(call.name);
            if name.eq_ignore_ascii_case(b"sub") {
                Some(Mark::Begins)
            } else if name.eq_ignore_ascii_case(b"endsub") {
                Some(Mark::Ends)
            } else {
                None
            }
        }
        Language::MacroB | Language::Words | Language::UserTask if matches!(first, b'O' | b'o' | b':') => {
            let head = match block.items().next()? {
                Item::Word(word) => word.address == Address::Letter(b'O'),
                Item::Label(_) => true,
                _ => false,
            };
            head.then_some(Mark::Begins)
        }
        Language::Sinumerik if matches!(first, b'%' | b'P' | b'p') => {
            let begins = match block.items().next()? {
                Item::Percent(_) => true,
                Item::Call(call) => program.bytes(call.name).eq_ignore_ascii_case(b"PROC"),
                _ => false,
            };
            begins.then_some(Mark::Begins)
        }
        _ => None,
    }
}
