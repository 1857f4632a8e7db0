//! Names of an APT program: `P1 = POINT/...`, `ID)` labels, macros.
use super::{Kind, Names, Role, Scope};
use crate::text::significant;
use std::collections::BTreeMap;
use trunnion_syntax::{Program, TokenKind};

pub(super) fn read(program: &Program, found: &mut Names) {
    let tokens = program.tokens();
    let mut defined: BTreeMap<String, Kind> = BTreeMap::new();
    let mut places = Vec::new();
    for block in program.blocks() {
        let ids = block.tokens();
        let Some(first) = significant(program, ids.start, ids.end) else {
            continue;
        };
        let behind = significant(program, first + 1, ids.end);
        let Some(behind) = behind.filter(|_| tokens.kind(first) == TokenKind::Name) else {
            continue;
        };
        let after = significant(program, behind + 1, ids.end);
        let word = after.map(|id| program.text(tokens.range(id)).to_ascii_uppercase());
        let kind = match tokens.kind(behind) {
            TokenKind::Equals if word.as_deref() == Some("MACRO") => Kind::Program,
            TokenKind::Equals => Kind::Variable,
            TokenKind::ParenClose => Kind::Label,
            _ => continue,
        };
        let range = tokens.range(first);
        defined.insert(program.text(range).to_ascii_uppercase(), kind);
        places.push(range);
    }
    if defined.is_empty() {
        return;
    }
    for id in (0..tokens.len() as u32).filter(|&id| tokens.kind(id) == TokenKind::Name) {
        let range = tokens.range(id);
        let name = program.text(range).to_ascii_uppercase();
        let Some(kind) = defined.get(&name) else { continue };
        let role = if places.binary_search(&range).is_ok() {
            Role::Definition
        } else {
            Role::Read
        };
        found.add(range, *kind, role, &name, Scope::Part(0));
    }
}
