//! Neither the program nor the settings say whether lengths are in inches or millimetres: they are taken as mm.
//!
//! # Why
//! Without G20 or G21 the unit is whatever the control was left in, or what a parameter says. A program for the
//! other unit is cut 25.4 times too large or too small.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 Y20
//! ;   ^^^^^^^^^^ units-unset: it is not declared whether lengths are in inches or millimetres
//! N20 X30
//! ```
//!
//! # Use instead
//! ```gcode
//! N5 G21
//! N10 G0 X10 Y20
//! N20 X30
//! ```
//! Or declare the unit that the control starts with, in `trunnion.toml` or in the machine file: `[control] units =
//! "mm"`. APT programs say UNITS/MM, and Klartext programs BEGIN PGM NAME MM:
//! without it the verdict on a Klartext program is unknown.
//!
//! # Guarantee
//! Sound: reported once per program, at the first motion whose length depends on it.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.5.7 on length units.
//! * HEIDENHAIN TNC 640 34059x-07: the first block of a program is BEGIN PGM with its name and its unit.
//! * FANUC Series 30i B-64484EN: G20 and G21, which keep the unit of the last session after power-off.
use crate::prelude::*;
use trunnion_dialect::Action;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::UnsaidUnits(check)]);

fn check(_: &facts::UnsaidUnits<'_>, out: &mut Reporter<'_>) {
    if !out.once(0) {
        return;
    }
    if out.dialect().lex.format == trunnion_syntax::Format::Klartext {
        // the head of a program names the unit
        out.report_block(
            "no BEGIN PGM with MM or INCH: whether the control runs such a text, and in which unit, is not known",
        )
        .unknown()
        .note("the lengths are taken as mm here")
        .help("write BEGIN PGM NAME MM before the first block, and END PGM NAME MM after the last one");
        return;
    }
    let codes = |own: Action| {
        let mut codes = out.dialect().codes().iter();
        codes.find(|code| code.action == own).map(|code| code.id.clone())
    };
    let write = match (codes(Action::Metric), codes(Action::Inch)) {
        (Some(metric), Some(inch)) => format!("write {metric} or {inch}"),
        _ => "write UNITS/MM or UNITS/INCHES".to_owned(),
    };
    out.report_block("it is not declared whether lengths are in inches or millimetres: they are taken as mm")
        .note("the control uses the unit that it was left in, or that its parameters set")
        .help(format!(
            "{write}, or declare `[control] units = \"mm\"` in trunnion.toml or in the machine file"
        ));
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    #[test]
    fn only_lengths_count() {
        // zero and angles are the same in any unit; the first length is reported, once
        assert_drawn(
            "gcode",
            "G0 X0 Y0\nB45\nX5\n;^ units-unset: it is not declared whether lengths are in inches or millimetres\nY7\n",
        );
    }

    #[test]
    fn any_unit_will_do() {
        for (dialect, program) in [
            ("fanuc-30i", "G20 G0 X1.\n"),
            ("sinumerik-840d", "G710\nG0 X1\n"),
            ("linuxcnc", "G21\nG0 X1\nM2\n"),
            ("apt", "UNITS/MM\nGOTO/1,2,3\n"),
        ] {
            let found = |program: &str| {
                let fixture = Fixture::parse(&format!("gcode {dialect}"), &format!("{program}; ^^ units-unset: \n"));
                let report = fixture.check().unwrap();
                report
                    .diagnostics
                    .iter()
                    .filter(|found| found.rule == "units-unset")
                    .count()
            };
            assert_eq!(found(program), 0, "{dialect}");
            let without = program.split_once(['\n', ' ']).unwrap().1;
            assert_eq!(found(without), 1, "{dialect}");
        }
    }

    #[test]
    fn klartext_without_its_head_is_unknown() {
        let statuses = |program: &str| {
            let dialect = trunnion_dialect::builtin("heidenhain-klartext").expect("built in");
            let settings = crate::Settings::new(dialect, None, trunnion_interp::Setup::default());
            let program = trunnion_syntax::parse(program.as_bytes().to_vec(), dialect.lex);
            let report = crate::check(&program, &settings);
            let own = report.diagnostics.iter().filter(|found| found.rule == "units-unset");
            own.map(|found| found.status).collect::<Vec<_>>()
        };
        let body = "TOOL CALL 1 Z S1000\nL X+10 Y+0 Z+50 R0 FMAX M3\nM30\nEND PGM A MM\n";
        assert_eq!(statuses(body), [crate::Status::Unknown]);
        assert_eq!(statuses(&format!("BEGIN PGM A MM\n{body}")), []);
    }
}
