//! The words of macro statements.

/// The words of macro statements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Statement {
    If,
    Then,
    Goto,
    While,
    Do,
    End,
}

pub(super) fn statement(name: &[u8]) -> Option<Statement> {
    let known: [(&[u8], Statement); 7] = [
        (b"IF", Statement::If),
        (b"THEN", Statement::Then),
        (b"GOTO", Statement::Goto),
        (b"WHILE", Statement::While),
        (b"WH", Statement::While),
        (b"DO", Statement::Do),
        (b"END", Statement::End),
    ];
    known
        .iter()
        .find(|(text, _)| name.eq_ignore_ascii_case(text))
        .map(|row| row.1)
}
