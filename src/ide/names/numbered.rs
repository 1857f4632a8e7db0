//! Block numbers that something refers to, and programs that are called by number.
use super::{Kind, Names, Role, Scope};
use trunnion_dialect::{Dialect, Language};
use trunnion_layout::block_references;
use trunnion_syntax::{Program, TextRange};

pub(super) fn read(program: &Program, dialect: &Dialect, found: &mut Names) {
    let references = block_references(program, dialect);
    for reference in &references.references {
        let Some((block, digits)) = reference.target else {
            continue;
        };
        let (name, scope) = (reference.number.to_string(), Scope::Part(found.part_of(block)));
        found.add(reference.digits, Kind::Block, Role::Read, &name, scope);
        found.add(digits, Kind::Block, Role::Definition, &name, scope);
    }
    for obstacle in references.obstacles {
        found.blocked(Kind::Block, obstacle.range, obstacle.why);
    }
    if dialect.quirks.language == Language::Linuxcnc {
        return;
    }
    for call in references.calls.iter().filter(|call| call.number >= 0) {
        let bytes = program.bytes(call.range);
        let digits = bytes.iter().rev().take_while(|byte| byte.is_ascii_digit()).count() as u32;
        let range = TextRange::new(call.range.end - digits, call.range.end);
        found.add(
            range,
            Kind::Program,
            Role::Read,
            &call.number.to_string(),
            Scope::Shared,
        );
    }
}
