//! Renaming: refused where the outcome is not certain. The run of the new text must be that of the old one.
use crate::names::number_of;
use crate::{Kind, Names, Occurrence, names};
use trunnion_dialect::{Dialect, Language};
use trunnion_interp::Setup;
use trunnion_layout::first_difference;
use trunnion_syntax::{Format, Program, TextEdit, apply_edits, parse};

/// Why a name stays, as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenameError(pub String);

/// Whether the name can be the new name of the thing.
///
/// # Errors
/// It is not a name of that kind.
pub fn check_new_name(of: &Occurrence, dialect: &Dialect, new: &str) -> Result<(), RenameError> {
    let was_number = of
        .name
        .trim_start_matches('R')
        .bytes()
        .all(|byte| byte.is_ascii_digit());
    let identifier = || {
        let mut bytes = new.bytes();
        bytes
            .next()
            .is_some_and(|byte| byte.is_ascii_alphabetic() || byte == b'_')
            && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    };
    let fail = |text: &str| Err(RenameError(format!("`{new}` {text}")));
    match (was_number, of.kind) {
        (true, _) if number_of(new).is_none_or(|digits| digits.len() > 8) => {
            fail("is not a whole number of at most 8 digits")
        }
        (true, Kind::Variable) => {
            let (old, new_number) = (class(dialect, &of.name), class(dialect, new));
            if old == new_number {
                Ok(())
            } else {
                fail("is a variable of another kind: how long it keeps its value, or what it means, is different")
            }
        }
        (false, _) if !identifier() => fail("is not a name: letters, digits and `_`, and no digit in front"),
        (false, Kind::Variable) if of.name.starts_with('_') != new.starts_with('_') && dialect.quirks.rs274() => {
            fail("would change where the variable is known: a `_` in front makes it global")
        }
        (false, Kind::Program | Kind::Label) if dialect.quirks.user_task() && new.len() > 4 => {
            fail("is too long: a name behind O or N has at most 4 letters and digits")
        }
        (false, _) if dialect.name(new).is_some() => fail("is a word of the control"),
        (false, _) if dialect.quirks.language == Language::Sinumerik && new.len() < 2 => {
            fail("is too short: one letter is an address of the control")
        }
        (true | false, _) => Ok(()),
    }
}

/// Which kind of numbered variable it is.
fn class(dialect: &Dialect, name: &str) -> u8 {
    let number: u32 = name.trim_start_matches('R').parse().unwrap_or(u32::MAX);
    match dialect.quirks.language {
        Language::Sinumerik | Language::UserTask => 0,
        Language::Linuxcnc => match number {
            0 => 9,
            1..=30 => 1,
            31..=5000 => 2,
            _ => 3,
        },
        _ => match number {
            0 => 9,
            1..=33 => 1,
            100..=499 => 2,
            _ if number <= dialect.quirks.own_parameters_to => 3,
            _ => 4,
        },
    }
}

/// The edits of one file.
///
/// # Errors
/// A computed name may mean the same thing, the new name is in use, or the new text would run differently.
pub fn rename(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    known: &Names,
    of: &Occurrence,
    new: &str,
) -> Result<Vec<TextEdit>, RenameError> {
    check_new_name(of, dialect, new)?;
    let numbered = number_of(&of.name).is_some() || of.name.starts_with('R');
    if let Some((_, obstacle)) = known
        .obstacles
        .iter()
        .find(|(kind, _)| *kind == of.kind && (numbered || *kind == Kind::Label))
    {
        return Err(RenameError(format!("not certain: {}", obstacle.why)));
    }
    if of.kind == Kind::Variable && class(dialect, &of.name) > 3 && numbered {
        return Err(RenameError(format!("`{}` is a variable of the control", of.name)));
    }
    let mut wanted = of.clone();
    wanted.name = compared(of, dialect, program, new);
    if wanted.name == of.name {
        return Ok(Vec::new());
    }
    if known.same(&wanted).next().is_some() || of.kind == Kind::Block && block_exists(program, known, &wanted) {
        return Err(RenameError(format!("`{new}` is in use already")));
    }
    let places: Vec<_> = known.same(of).map(|one| one.range).collect();
    let edits: Vec<TextEdit> = places
        .iter()
        .map(|&range| TextEdit {
            range,
            new_text: new.to_owned(),
        })
        .collect();
    let text = apply_edits(program.source(), &edits).ok_or_else(|| RenameError("two places overlap".to_owned()))?;
    let after = parse(text, program.options());
    let again = names(&after, dialect);
    if again.same(&wanted).count() != places.len() {
        return Err(RenameError(format!("`{new}` would be read differently")));
    }
    if of.kind != Kind::Program
        && let Some(difference) = first_difference(program, &after, dialect, setup, of.kind == Kind::Block)
    {
        return Err(RenameError(format!(
            "the program would not do the same ({}); programs of other files that share the name are not proved together with it",
            difference.what
        )));
    }
    Ok(edits)
}

/// The new name as it is compared.
fn compared(of: &Occurrence, dialect: &Dialect, program: &Program, new: &str) -> Box<str> {
    if let Some(number) = number_of(new) {
        let prefix = if of.name.starts_with('R') && of.kind == Kind::Variable {
            "R"
        } else {
            ""
        };
        return format!("{prefix}{number}").into();
    }
    let upper = program.options().format == Format::Apt || dialect.quirks.user_names();
    if upper {
        new.to_ascii_uppercase().into()
    } else {
        new.to_ascii_lowercase().into()
    }
}

/// Whether a block of the same program has the number, referred to or not.
fn block_exists(program: &Program, known: &Names, wanted: &Occurrence) -> bool {
    program.blocks().any(|block| {
        let same = || {
            known.part_of(block.id())
                == match wanted.scope {
                    crate::Scope::Part(part) => part,
                    crate::Scope::Shared => 0,
                }
        };
        block.number().is_some_and(|range| {
            let text = program.text(range);
            number_of(text.trim_start_matches(['N', 'n'])).as_deref() == Some(&*wanted.name) && same()
        })
    })
}
