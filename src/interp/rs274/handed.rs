//! Lines that pass values to a subroutine or back to its caller.

/// Where a line passes its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Handed {
    /// `o<name> call [1] [2]`: as #1 to #30.
    ToSubroutine,
    /// `o<name> return [1]`, `o<name> endsub [1]`: as `#<_value>`.
    ToCaller,
}

/// Whether a line does, in upper case and without blanks.
pub(super) fn hands_values(line: &str) -> Option<Handed> {
    let mut rest = line;
    while let Some(comment) = rest.strip_prefix('(') {
        rest = comment.split_once(')')?.1;
    }
    let digits = |c: char| c.is_ascii_digit();
    if let Some(number) = rest.strip_prefix('N') {
        rest = number.trim_start_matches(digits);
    }
    let label = rest.strip_prefix('O')?;
    let keyword = match label.strip_prefix('<') {
        Some(name) => name.split_once('>')?.1,
        // a number, or the value of a variable or an expression: the keyword follows it
        None => label.trim_start_matches(|c: char| !c.is_ascii_alphabetic()),
    };
    if keyword.starts_with("CALL") {
        Some(Handed::ToSubroutine)
    } else if keyword.starts_with("RETURN") || keyword.starts_with("ENDSUB") {
        Some(Handed::ToCaller)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Handed, hands_values};

    #[test]
    fn calls_and_returns_are_told_from_other_lines() {
        let call = Some(Handed::ToSubroutine);
        for line in [
            "O<F>CALL[1][#2]",
            "O100CALL",
            "(A)N10O[#1+2]CALL[3]",
            "O<ENDSUB>CALL",
            "O#5CALL",
        ] {
            assert_eq!(hands_values(line), call, "{line}");
        }
        for line in ["O<F>RETURN[#1*2]", "O<CALL>ENDSUB", "O7ENDSUB[1]"] {
            assert_eq!(hands_values(line), Some(Handed::ToCaller), "{line}");
        }
        for line in ["O<CALL>SUB", "O1IF[#1EQ2]", "G1X#1", "(O<F>CALL)G1X1", "", "("] {
            assert_eq!(hands_values(line), None, "{line}");
        }
    }
}
