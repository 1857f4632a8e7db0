//! G codes that a settings or machine file names as in effect at power-on.
use crate::code::CodeKind;
use crate::nearest::did_you_mean;
use crate::{Action, BUILTIN_NAMES, Dialect, builtin};

/// Why a code cannot be in effect at power-on: the control does not have it, or, where it is not known which control it is, no control that this
/// program reads has it.
///
/// # Errors
/// The sentence, with the code that is near.
pub fn known_at_power_on(code: &str, dialect: Option<&Dialect>) -> Result<(), String> {
    let all = BUILTIN_NAMES.iter().filter_map(|name| builtin(name));
    let dialects: Vec<&Dialect> = match dialect {
        Some(one) => vec![one],
        None => all.collect(),
    };
    let codes = || {
        dialects
            .iter()
            .flat_map(|dialect| dialect.codes())
            .filter(|own| own.kind == CodeKind::G)
    };
    if codes().any(|own| own.id == code) {
        return Ok(());
    }
    let mut known: Vec<&str> = codes()
        .filter(|own| sets(own.action))
        .map(|own| own.id.as_str())
        .collect();
    known.sort_unstable();
    known.dedup();
    let whose = dialect.map_or_else(
        || "no control that is known here has a".to_owned(),
        |dialect| format!("{} has no", dialect.name),
    );
    let other = "; write the codes as the page of the dialect lists them, for example `power_on = [\"G17\", \"G90\"]`";
    let hint = did_you_mean(code, &known, other);
    Err(format!("`power_on`: {whose} G code `{code}`{hint}"))
}

/// What `power_on` puts into effect: plane, distance, unit, feed mode, motion.
fn sets(action: Action) -> bool {
    matches!(
        action,
        Action::PlaneXy
            | Action::PlaneZx
            | Action::PlaneYz
            | Action::Absolute
            | Action::Incremental
            | Action::Inch
            | Action::Metric
            | Action::FeedPerMinute
            | Action::FeedPerRevolution
            | Action::Rapid
            | Action::Linear
    )
}

#[cfg(test)]
mod tests {
    use super::known_at_power_on;
    use crate::builtin;

    #[test]
    fn a_code_that_the_control_does_not_have_is_named() {
        let fanuc = builtin("fanuc-30i");
        assert_eq!(known_at_power_on("G17", fanuc), Ok(()));
        assert_eq!(known_at_power_on("G710", builtin("sinumerik-840d")), Ok(()));
        let said = known_at_power_on("G177", fanuc).expect_err("no code");
        assert_eq!(said, "`power_on`: fanuc-30i has no G code `G177`; did you mean `G17`?");
        // a code of another control
        let said = known_at_power_on("G710", fanuc).expect_err("no code of this one");
        assert!(said.contains("fanuc-30i has no G code `G710`"), "{said}");
        assert_eq!(known_at_power_on("G710", None), Ok(()));
        let said = known_at_power_on("G9999", None).expect_err("no code");
        assert!(said.contains("no control that is known here"), "{said}");
    }
}
