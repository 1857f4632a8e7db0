//! Variables with `#`: `#100`, `#<name>`, `#_NAME`.
use super::{Kind, Names, Role, Scope, number_of};
use crate::text::significant;
use trunnion_dialect::{Dialect, Language};
use trunnion_syntax::{Program, TextRange, TokenKind};

/// Numbers below this one belong to one subprogram: RS274/NGC #1 to #30, Macro B #1 to #33.
const SHARED_NGC: u32 = 31;
const SHARED_MACRO: u32 = 34;

pub(super) fn read(program: &Program, dialect: &Dialect, found: &mut Names) {
    if dialect.quirks.user_task() {
        // `#1FH` is a number
        return;
    }
    let rs274 = dialect.quirks.language == Language::Linuxcnc;
    let tokens = program.tokens();
    for block in program.blocks() {
        let ids = block.tokens();
        for id in ids.clone().filter(|&id| tokens.kind(id) == TokenKind::Hash) {
            let own = tokens.range(id);
            let next = significant(program, id + 1, ids.end);
            let (range, name, shared, last) = if program.bytes(own).len() > 2 {
                let inner = TextRange::new(own.start + 2, own.end - 1);
                let name: String = program
                    .text(inner)
                    .split_whitespace()
                    .collect::<String>()
                    .to_ascii_lowercase();
                let shared = name.starts_with('_');
                (inner, name, shared, id)
            } else {
                let Some(next) = next else { continue };
                let range = tokens.range(next);
                match tokens.kind(next) {
                    TokenKind::Number => {
                        let Some(name) = number_of(&program.text(range)) else {
                            continue;
                        };
                        let first = if rs274 { SHARED_NGC } else { SHARED_MACRO };
                        let shared = name.parse::<u32>().map_or(true, |number| number >= first);
                        (range, name, shared, next)
                    }
                    TokenKind::Name => (range, program.text(range).to_ascii_lowercase(), true, next),
                    TokenKind::BracketOpen | TokenKind::Hash => {
                        let why = format!("`{}` computes which variable it is", program.text(own.cover(range)));
                        found.blocked(Kind::Variable, own.cover(range), why);
                        continue;
                    }
                    _ => continue,
                }
            };
            let assigned =
                significant(program, last + 1, ids.end).is_some_and(|behind| tokens.kind(behind) == TokenKind::Equals);
            let role = if assigned { Role::Write } else { Role::Read };
            let part = Scope::Part(found.part_of(block.id()));
            let scope = if shared { Scope::Shared } else { part };
            found.add(range, Kind::Variable, role, &name, scope);
        }
    }
}
