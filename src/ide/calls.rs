//! Who calls whom in a file.
use crate::{Kind, Names, Occurrence, Role};
use trunnion_syntax::Program;

/// A call with the program that it stands in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallSite {
    /// The call.
    pub call: Occurrence,
    /// The definition of the program around it; `None` for a main program without a name.
    pub caller: Option<Occurrence>,
}

/// All calls of a file.
pub fn calls_of(program: &Program, names: &Names) -> Vec<CallSite> {
    let part = |one: &Occurrence| program.block_at(one.range.start).map(|block| names.part_of(block));
    let programs = || names.all.iter().filter(|one| one.kind == Kind::Program);
    let caller = |call: &Occurrence| {
        let own = part(call);
        programs()
            .find(|one| one.role == Role::Definition && part(one) == own)
            .cloned()
    };
    let closing = |one: &&Occurrence| {
        // endsub and return name the subprogram and call nothing
        let behind = program.source().get(one.range.end as usize..).unwrap_or_default();
        let text: Vec<u8> = behind
            .iter()
            .copied()
            .skip_while(|byte| matches!(byte, b'>' | b' ' | b'\t'))
            .take(7)
            .collect();
        let text = text.to_ascii_lowercase();
        !(text.starts_with(b"endsub") || text.starts_with(b"return"))
    };
    programs()
        .filter(|one| one.role == Role::Read)
        .filter(closing)
        .map(|call| CallSite {
            call: call.clone(),
            caller: caller(call),
        })
        .collect()
}
