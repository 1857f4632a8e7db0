//! No machine is named, so axes, limits and speeds were not checked.
//!
//! # Why
//! The same program is right on one machine and wrong on another. Without a machine only the text and the
//! programmed motion are judged, and a pass says no more than that.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! ;^ machine-unset: no machine is named
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound; reported once per file, at its first byte. Not reported under `--scope motion` or `--scope language`, which need no
//! machine; under `--scope machine` the verdict is unknown. Where nothing shows the control and the blocks look like those of a lathe (surface
//! speed, X and Z alone), it is unknown in each scope that judges motions: on a lathe X may be a diameter.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::config::Scope;
use crate::prelude::*;
use trunnion_dialect::possible_lathe;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let settings = overview.settings;
    if settings.machine.is_some() || settings.scope == Some(Scope::Language) {
        return;
    }
    let first = TextRange::new(0, u32::from(!overview.program.source().is_empty()));
    let open = !settings.control_known;
    if let Some(signs) = open.then(|| possible_lathe(overview.program.source())).flatten() {
        out.report(
            first,
            format!("neither machine nor control is known, and the program may be one for a lathe: {signs}"),
        )
        .note("on a lathe X may be a diameter, and F a feed per revolution")
        .help("name the control, `--dialect fanuc-30i-lathe-a` for example, or the machine: --machine NAME or FILE")
        .unknown();
        return;
    }
    if settings.scope.is_some_and(|scope| scope < Scope::Machine) {
        return;
    }
    let draft = out.report(first, "no machine is named: axes, limits and speeds were not checked");
    draft.help("name the machine: --machine NAME or FILE, or `machine = \"NAME\"` in trunnion.toml; `trunnion machine list` lists the built-in ones");
    if settings.scope.is_some() {
        draft.unknown();
    }
}

#[cfg(test)]
mod tests {
    use crate::config::Scope;
    use crate::{Settings, Severity, Verdict};

    /// Where nothing shows the control, a program that may be one for a lathe does not pass as one for a mill.
    #[test]
    fn a_possible_lathe_is_unknown_where_the_control_is() {
        let core = trunnion_dialect::builtin("iso-6983").expect("built in");
        let verdict = |text: &str, control_known, scope| {
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), core.lex);
            let settings = Settings {
                scope,
                control_known,
                ..Settings::new(core, None, trunnion_interp::Setup::default())
            };
            crate::check(&program, &settings).verdict(Severity::Error)
        };
        let lathe = "G21 G90 G95\nG96 S150 M3\nG0 X50. Z2.\nG1 Z-5. F.2\nX52.\nM30\n";
        let mill = lathe.replace("X52.", "X52. Y1.");
        for scope in [None, Some(Scope::Motion)] {
            assert_eq!(verdict(lathe, false, scope), Verdict::Unknown);
            assert_eq!(verdict(lathe, true, scope), Verdict::Pass);
            assert_eq!(verdict(&mill, false, scope), Verdict::Pass);
        }
        assert_eq!(verdict(lathe, false, Some(Scope::Language)), Verdict::Pass);
    }
}
