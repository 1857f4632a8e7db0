//! The dialect has no such code.
//!
//! # Why
//! The control stops or, worse, uses that code number for something else: what follows cannot be judged. M codes
//! that a control leaves to the machine builder are not an error, but their effect is unknown. Where nothing shows for which control a program
//! is, a code that other controls have is not an error either: it is unknown until the control is named.
//!
//! # Example
//! ```gcode
//! N10 G0 G198 X10
//! ;      ^^^^ unknown-code: iso-6983 has no code G198
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for the dialect's table; the table gives the source of each code.
//!
//! # Sources
//! * grammar/README.md, the dialect tables and their sources.
use crate::elsewhere::dialects_with;
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    const HELP: &str = "correct the code, or name the dialect of the program: --dialect NAME";
    // most faults are others: no text is written for them
    if !is_of_code(&fault.kind) {
        return;
    }
    let is_unknown = matches!(fault.kind, FaultKind::UnknownCode { machine_builder: false });
    if is_unknown && out.is_slip(fault.range) {
        return;
    }
    let text = out.text(fault.range);
    let dialect = &out.dialect().name;
    let near = out.near_code(&text);
    let message = match &near {
        Some(near) => format!("{dialect} has no code {text}; did you mean `{near}`?"),
        None => format!("{dialect} has no code {text}"),
    };
    let once = hash(&text);
    if let Some(draft) = out.refused(fault, Refusal::UnknownCode) {
        draft.say(message).help(HELP).merge(Merge::run(once, 0.0));
        return;
    }
    match fault.kind {
        FaultKind::UnknownCode { machine_builder: true } => {
            out.report(
                fault.range,
                format!("{dialect} leaves {text} to the machine builder: its effect is unknown"),
            )
            .note("it is assumed to move nothing and to change nothing that is checked")
            .help(format!(
                "if it is harmless, say so: (trunnion: allow unknown-code because {text} only ...)"
            ))
            .unknown()
            .merge(Merge::once(once));
        }
        FaultKind::UnknownCode { machine_builder: false } if !out.knows_control() && is_of_another(&text) => {
            let whose = match &dialects_with(&text)[..] {
                [] => format!("{text} is a code that machine builders give a meaning"),
                found => format!("{text} is a code of {}", these(found)),
            };
            out.report(
                fault.range,
                format!("{whose}, and the control of this program is not known"),
            )
            .note("it is ignored: the rest is checked as if it were not there")
            .help("name the control: --dialect NAME, or `(trunnion: dialect NAME)` in the program")
            .unknown()
            .merge(Merge::once(once));
        }
        FaultKind::UnknownCode { machine_builder: false } => {
            out.report(fault.range, message)
                .note("it is ignored: the rest is checked as if it were not there")
                .help(HELP)
                .merge(Merge::run(once, 0.0))
                .replace_with_some(near);
        }
        _ => {}
    }
}

/// Whether a fault is about a code that the dialect does not have.
fn is_of_code(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::UnknownCode { .. }
            | FaultKind::Rejected {
                refusal: Refusal::UnknownCode,
                ..
            }
    )
}

/// Whether another control, or the builder of its machine, may have a code. Tables list builders' M codes up to M999.
fn is_of_another(code: &str) -> bool {
    let builders = || {
        let number = code
            .strip_prefix(['M', 'm'])
            .and_then(|number| number.parse::<u32>().ok());
        number.is_some_and(|number| number > 999)
    };
    !dialects_with(code).is_empty() || builders()
}

/// The first names of a list, and how many more there are.
fn these(names: &[&str]) -> String {
    /// Names that are listed.
    const LISTED: usize = 3;
    match names {
        [before @ .., last] if !before.is_empty() && names.len() <= LISTED => {
            format!("{} and {last}", before.join(", "))
        }
        [..] if names.len() <= LISTED => names.concat(),
        _ => format!("{} and {} more", names[..LISTED].join(", "), names.len() - LISTED),
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_letter_o_for_a_zero_is_one_finding() {
        for (dialect, rule) in [
            ("iso-6983", "unknown-code"),
            ("fanuc-30i", "unknown-code"),
            ("linuxcnc", "bad-expression"),
        ] {
            let text = format!(
                "G21 G90 G94 M3 S900\nGO X0. Y0. Z5.\n;^ {rule}: `GO` contains the letter O; did you mean `G0`?\nM2\n"
            );
            let report = assert_drawn(&format!("gcode {dialect}"), &text);
            assert_eq!(report.diagnostics[0].replacement.as_deref(), Some("G0"));
        }
        for dialect in ["iso-6983", "fanuc-30i"] {
            let text = "G21 G90 G94 M3 S900\nG1 X5O. F1OO\n;  ^^^^ bad-number: `X5O.` contains the letter O; did you mean `X50.`?\n;       ^^^^ unknown-code: `F1OO` contains the letter O; did you mean `F100`?\nX60. F100.\nM2\n";
            assert_drawn(&format!("gcode {dialect}"), text);
        }
    }

    /// Where nothing shows the control, a code of another one is no mistake; one that no control has is.
    #[test]
    fn a_code_of_another_control_is_unknown_where_the_control_is() {
        let core = trunnion_dialect::builtin("iso-6983").expect("built in");
        let text = "G21 G90 G94\nG52 X1.\nG28.1\nG0 X1. G77.7\nM2000\nM30\n";
        let program = trunnion_syntax::parse(text.as_bytes().to_vec(), core.lex);
        let judge = |control_known| {
            let settings = crate::Settings {
                control_known,
                ..crate::Settings::new(core, None, trunnion_interp::Setup::default())
            };
            let report = crate::check(&program, &settings);
            let own = report
                .diagnostics
                .into_iter()
                .filter(|found| found.rule == "unknown-code");
            own.map(|found| (found.status, found.message)).collect::<Vec<_>>()
        };
        let known = judge(true);
        assert!(
            known.len() == 4 && known.iter().all(|found| found.0 == crate::Status::Fail),
            "{known:?}"
        );
        let unknown = judge(false);
        assert_eq!(unknown[0].0, crate::Status::Unknown);
        assert!(
            unknown[0]
                .1
                .starts_with("G52 is a code of linuxcnc, fanuc-30i, haas-ngc and "),
            "{unknown:?}"
        );
        let end = "and the control of this program is not known";
        assert_eq!(
            unknown[1],
            (
                crate::Status::Unknown,
                format!("G28.1 is a code of linuxcnc and grbl, {end}")
            )
        );
        assert_eq!(unknown[3].0, crate::Status::Unknown, "{unknown:?}");
        assert_eq!(unknown[2].0, crate::Status::Fail, "{unknown:?}");
    }

    #[test]
    fn a_misspelt_name_is_near_a_known_one() {
        let text = "G71 G0 X0\nTRAORY\n;^^^^^ not-modelled: `TRAORY` is no code of sinumerik-840d, and no program TRAORY.SPF or .MPF was found; did you mean `TRAORI`?\nM30\n";
        assert_drawn("gcode sinumerik-840d", text);
    }
}
