//! Trunnion recognises something but does not simulate it: everything that depends on it is unknown.
//!
//! # Why
//! A verdict must not rest on a guess. Where an expression, a cycle or a call is not evaluated, the positions that
//! depend on it are unknown until the program sets them again, and nothing is checked from them.
//!
//! # Example
//! ```gcode sinumerik-840d
//! N10 G0 X=R1+2
//! ;        ^^^^ not-modelled: not modelled: R1: the program does not set its value
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d
//! N10 G0 X12
//! ```
//!
//! A curve of a Sinumerik (POLY) is followed as lines that it leaves by at most 0.00001 mm. Where that could decide whether an axis
//! stays within its travel or its speed, this rule says so.
//!
//! # Guarantee
//! Sound: what is not modelled is reported, once per cause.
//!
//! # Sources
//! * docs/contract.md#verdicts
//! * FANUC Series 15i-MA B-63324EN/03, helical interpolation: bit HTG (parameter 1401; of the Series 30i 1403).
//! * Sinumerik 6FC5398-2EP40-0BA0 (12/2019), p. 750: the plane assigns the lengths of a tool to axes, setting data 42940.
use crate::config::declaration;
use crate::facts::Margin;
use crate::prelude::*;
use crate::slip::record_with_zeros;
use crate::words::short;
use trunnion_dialect::Plane;
use trunnion_interp::{Lacks, UnknownName};

pub(super) const RULE: Body = Body::sound(
    Info,
    &[
        Wake::Fault(check),
        Wake::Curved(too_near),
        Wake::LengthOffZ(length),
        Wake::SteepHelix(helix),
    ],
);

/// The plane says along which axis the length of a mill's tool acts: G18 along Y, G19 along X.
fn length(motion: &facts::LengthOffZ<'_>, out: &mut Reporter<'_>) {
    if !out.once(hash("length off Z")) {
        return;
    }
    let (plane, axis) = match motion.in_force.plane {
        Plane::Zx => ("G18", "Y"),
        Plane::Yz => ("G19", "X"),
        Plane::Xy => return,
    };
    out.report_block(format!(
        "not modelled: the tool's length in {plane}, which acts along {axis} unless setting data 42940 ($SC_TOOL_LENGTH_CONST) keeps it on Z"
    ))
    .unknown()
    .note("the axes are judged here with the length along Z")
    .help("program the arc in G17, or as CIP; if the setting data are 17, allow the rule and give that reason");
}

/// F along the arc (HTG = 0) or along the helix (HTG = 1).
fn helix(helix: &facts::SteepHelix<'_>, out: &mut Reporter<'_>) {
    if !out.once(hash("feed of a helix")) {
        return;
    }
    out.report_block(format!(
        "not modelled: F of a helix, which parameter HTG applies to the arc or to the helix: this one is {:.3} times as long as its arc",
        helix.ratio
    ))
    .unknown()
    .note("times, feeds and speeds of the axes are judged here with F along the helix; along the arc the tool moves faster by this factor")
    .help("divide F by this factor if HTG is 0; if it is 1, allow the rule and give that reason")
    .value("helix_to_arc", helix.ratio);
}

/// Keys of merging: one for each axis and kind.
const TRAVEL: u64 = 1 << 40;
const SPEED: u64 = 2 << 40;

fn too_near(leg: &facts::Curved<'_>, out: &mut Reporter<'_>) {
    let slack = number(leg.motion().slack_mm);
    let (joint, key, what) = match leg.why {
        Margin::Travel(joint) => (joint, TRAVEL, "comes nearer than that to the end of its travel"),
        Margin::Speed(joint) => (joint, SPEED, "may be too fast where the curve turns into its direction"),
    };
    let axis = &leg.machine.axes[joint];
    out.unknown(leg, Merge::once(key + u64::from(axis.letter)), |draft| {
        draft
            .say(format!(
                "this curve is followed as lines that it leaves by at most {slack} mm, and {} {what}",
                letter(axis.letter)
            ))
            .note("whether the axis exceeds it is unknown")
            .help("keep the path farther from the limit, or reduce the feed");
    });
}

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    match fault.kind.lacks() {
        // without a machine no rule asks where it is
        Some(Lacks::ReferencePoint) if !out.judges_machine() => {
            out.report(
                fault.range,
                "this move goes to a position of the machine that is not declared",
            )
            .note("positions after it are unknown until the program sets them again")
            .help("to check it, name the machine: --machine NAME or FILE, with reference_points (G75: fixed_points) in its [control]")
            .merge(Merge::once(0));
            return;
        }
        Some(Lacks::Caller(label)) => {
            out.report(fault.range, format!("{label} was checked with unknown arguments: nothing in this file calls it"))
                .note("its arguments, F, S and the position of the axes come from the caller; what depends on them was not checked")
                .help("check the program that calls it, with this file in its folder or under `subprogram_path`")
                .unknown()
                .merge(Merge::once(1));
            return;
        }
        Some(Lacks::Meaning(name)) => return unknown_name(fault, name, out),
        _ => {}
    }
    if let FaultKind::NotModelled { what } = &fault.kind {
        if out.is_slip_of_digits(fault.range) {
            return;
        }
        let whole = what;
        let (what, declare) = divided(whole);
        let cause = hash(cause(what));
        if out.repeats(cause, fault.range) {
            return;
        }
        let (note, remedy) = radius_advice(&fault.kind, whole);
        let declare = declare.or_else(|| {
            let line = declaration(what, out.dialect())?;
            Some(format!(
                "if the program does not set its value and it is known, declare it ([variables] in trunnion.toml: {line}); else {BY_HAND}"
            ))
        });
        let near = out.near_code(what).or_else(|| record_with_zeros(what, out.dialect()));
        let hint = near
            .as_ref()
            .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        // an editor can only replace what the place holds
        let meant = near.filter(|_| out.text(fault.range) == *what);
        let draft = out
            .report(fault.range, format!("not modelled: {}{hint}", short(what)))
            .replace_with_some(meant)
            .note(note)
            .unknown()
            .merge(Merge::once(cause));
        draft.help(declare.or(remedy).unwrap_or_else(|| BY_HAND.to_owned()));
    }
}

/// A name that the control may know, or that a file which is not here may define: it is unknown what it does.
fn unknown_name(fault: &Fault, name: UnknownName<'_>, out: &mut Reporter<'_>) {
    if out.is_slip_of_digits(fault.range) {
        return;
    }
    let UnknownName {
        text,
        is_program,
        place,
    } = name;
    let stem = text.split(['(', ' ']).next().unwrap_or_default().to_ascii_uppercase();
    let cause = hash(&stem);
    if out.repeats(cause, fault.range) {
        return;
    }
    let near = out.near_code(text).or_else(|| out.code_with_zeros(fault.range));
    let hint = near
        .as_ref()
        .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let meant = near.filter(|_| out.text(fault.range) == text);
    let program = if is_program {
        format!(", and no program {}.SPF or .MPF was found", short(&stem))
    } else {
        String::new()
    };
    let dialect = &out.dialect().name;
    let message = format!("`{}`{place} is no code of {dialect}{program}{hint}", short(text));
    let draft = out
        .report(fault.range, message)
        .replace_with_some(meant)
        .note(radius_advice(&fault.kind, text).0)
        .unknown()
        .merge(Merge::once(cause));
    if is_program {
        draft
            .note("programs are looked for in this file, in its folder and in the folders of `subprogram_path`")
            .help(
                "correct the name; if it is a program, put it in the folder of this one, or name its folder in trunnion.toml: \
                 subprogram_path = [\"subs\"]",
            );
    } else {
        draft.help("correct the name, or inspect by hand what depends on it");
    }
}

/// What follows for what is not modelled, and what to do about compensation of a radius: there the positions are those of the program.
fn radius_advice(kind: &FaultKind, what: &str) -> (&'static str, Option<String>) {
    if !what.starts_with("cutter radius compensation") && !what.starts_with("tool nose radius compensation") {
        return (
            "everything that depends on it is unknown and not checked, until the program sets it anew",
            (kind.lacks() == Some(Lacks::ReferencePoint)).then(|| POINTS.to_owned()),
        );
    }
    let note = "the tool runs beside the programmed path, and the programmed path is the one that was checked";
    let declare = "declare its diameter: `[[tool]]` with `number` and `diameter` in mm, in trunnion.toml";
    let remedy = match kind.lacks() {
        Some(Lacks::Radius(_)) => format!("{declare}; or take its radius as zero: --assume tool-length"),
        _ => "keep more than the tool radius away from walls and limits, or run the program on the machine without a part"
            .to_owned(),
    };
    (note, Some(remedy))
}

const POINTS: &str =
    "declare `reference_points` (G75: `fixed_points`) in [control] of the machine file or of trunnion.toml";

/// What to do where no setting helps.
const BY_HAND: &str = "inspect by hand what depends on it, or run the program on the machine without a part";

/// What is not modelled, and what to declare so that it is: `a cycle (declare [control] key)` says both.
fn divided(what: &str) -> (&str, Option<String>) {
    if let Some((what, tool)) = what.split_once(" (`[[tool]]`") {
        let tool = tool.trim_end_matches(')');
        return (what, Some(format!("declare `[[tool]]`{tool}, in trunnion.toml")));
    }
    if let Some((what, rest)) = what.split_once(" (declare `") {
        return (what, Some(format!("declare `{}", rest.trim_end_matches(')'))));
    }
    let Some(at) = what.find("declare [control]") else {
        return (what, None);
    };
    let (before, remedy) = what.split_at(at);
    let in_brackets = before.ends_with('(');
    let remedy = if in_brackets {
        remedy.strip_suffix(')').unwrap_or(remedy)
    } else {
        remedy
    };
    let place = "in trunnion.toml or in the machine file";
    let remedy = match remedy.split_once("; ") {
        Some((declare, then)) => format!("{declare}, {place}; {then}"),
        None => format!("{remedy}, {place}"),
    };
    (before.trim_end_matches([' ', ':', '(', ',']), Some(remedy))
}

/// What findings of one cause have in common: the same function of the control with other arguments, another name that nothing defines.
fn cause(what: &str) -> &str {
    const UNNAMED: &str = ": a named variable with an unknown value";
    if what.starts_with('#') && what.ends_with(UNNAMED) {
        return UNNAMED;
    }
    match what.split_once(": ") {
        Some((function, _)) if function.starts_with("FN ") => function,
        _ => what,
    }
}

#[cfg(test)]
mod tests {
    use super::{cause, divided, radius_advice};
    use crate::Severity;
    use trunnion_interp::FaultKind;

    #[test]
    fn what_to_declare_is_the_help() {
        let remedy = |key: &str| {
            Some(format!(
                "declare [control] {key}, in trunnion.toml or in the machine file"
            ))
        };
        assert_eq!(
            divided("G87: the direction (declare [control] bore_shift)"),
            ("G87: the direction", remedy("bore_shift"))
        );
        assert_eq!(
            divided("G71: one block: declare [control] roughing_retract (setting 73)"),
            ("G71: one block", remedy("roughing_retract (setting 73)"))
        );
        let table = "a motion: whether the axis moves (declare `length-change` in a table, or write Z)";
        let help = "declare `length-change` in a table, or write Z".to_owned();
        assert_eq!(divided(table), ("a motion: whether the axis moves", Some(help)));
        assert_eq!(divided("INSERT"), ("INSERT", None));
        let nose = "the nose is not declared (`[[tool]]` with `nose_radius` in mm)";
        let tool = "declare `[[tool]]` with `nose_radius` in mm, in trunnion.toml";
        assert_eq!(divided(nose), ("the nose is not declared", Some(tool.to_owned())));
    }

    /// Where the radius of a tool is missing, the finding names what to declare, and does not say that positions are unknown.
    #[test]
    fn an_undeclared_radius_names_what_to_declare() {
        let kind = FaultKind::radius_lacks("D1");
        let (note, help) = radius_advice(&kind, "cutter radius compensation: the radius of D1 is not declared");
        let help = help.unwrap_or_default();
        assert!(
            help.contains("`[[tool]]`") && help.contains("--assume tool-length"),
            "{help}"
        );
        assert!(note.contains("programmed path"), "{note}");
        for (fence, text) in [
            (
                "gcode linuxcnc undeclared",
                "G21 G17 G90 G94\nM3 S900 T1 M6\nG0 X0 Y0 Z5\nG41 G1 X9 F100\nY9\nG40 X0\nM2\n",
            ),
            (
                "gcode haas-lathe",
                "G21 G18 G99\nT0101\nG97 S900 M3\nG0 X40. Z2.\nG42 G1 X30. F0.1\nZ-9.\nG40 X50.\nM30\n",
            ),
        ] {
            let report = crate::fixture::Fixture::parse(fence, text).check().unwrap();
            let found = report
                .diagnostics
                .iter()
                .find(|d| d.rule == "not-modelled")
                .expect(text);
            let help = found.help.as_deref().unwrap_or_default();
            assert!(
                help.contains("`[[tool]]`") && help.contains("trunnion.toml"),
                "{fence}: {help}"
            );
            assert!(
                found.notes.iter().all(|note| !note.contains("unknown")),
                "{fence}: {:?}",
                found.notes
            );
        }
    }

    /// A curve that keeps clear of all limits passes; nearer to one than its lines are to it, it is unknown.
    #[test]
    fn a_curve_is_unknown_only_where_its_margin_counts() {
        let text = |x: &str, feed: u32| {
            format!(
                "G17 G90 G71 G94 G54\nS900 M3\nG0 X0 Y0 Z5\nG1 F{feed}\nPOLY PO[X]=({x},-2) PO[Y]=(4,3,1)\nG1 Y9\nG0 Z50\nM30\n"
            )
        };
        let found = |text: &str| {
            let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mill-3axis", text)
                .check()
                .unwrap();
            let own = report.diagnostics.iter().filter(|d| d.rule == "not-modelled");
            (
                own.map(|d| d.message.clone()).collect::<Vec<_>>(),
                report.verdict(Severity::Error),
            )
        };
        assert_eq!(found(&text("10", 500)), (Vec::new(), crate::Verdict::Pass));
        let (near, verdict) = found(&text(&format!("{}", limit() - 0.000_004), 500));
        assert!(
            near.len() == 1 && near[0].contains("X comes nearer than that to the end of its travel"),
            "{near:?}"
        );
        assert_eq!(verdict, crate::Verdict::Unknown);
        assert_eq!(found(&text(&format!("{}", limit() - 0.000_1), 500)).0, [""; 0]);
        let (fast, _) = found(&text("10", 200_000));
        assert!(
            fast.iter().any(|message| message.contains("may be too fast")),
            "{fast:?}"
        );
    }

    /// The end of the travel of X on mill-3axis, mm.
    fn limit() -> f64 {
        let machine = trunnion_machine::builtin("mill-3axis").unwrap();
        let axis = machine.axes.iter().find(|axis| axis.letter == b'X').unwrap();
        match axis.limits {
            trunnion_machine::Limits::Range(_, high) => high,
            trunnion_machine::Limits::Unbounded => f64::NAN,
        }
    }

    #[test]
    fn one_function_is_one_cause() {
        assert_eq!(
            cause("FN 18: SYSREAD Q1 = ID50 NR1"),
            cause("FN 18: SYSREAD Q2 = ID50 NR2")
        );
        let name = |name: &str| format!("{name}: a named variable with an unknown value");
        assert_eq!(cause(&name("#TOAX")), cause(&name("#TOAY")));
        assert_ne!(cause("FN 17: what it writes"), cause("FN 18: SYSREAD Q2 = ID50 NR2"));
        assert_ne!(cause("G71: cuts"), cause("G72: cuts"));
        assert_ne!(cause("R1+2"), cause("R2+2"));
    }

    #[test]
    fn one_cause_is_told_once_with_its_count() {
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d", "G0 X=R1\nY0\nX=R1\nM30\n");
        let report = fixture.check().unwrap();
        let found: Vec<_> = report.diagnostics.iter().filter(|d| d.rule == "not-modelled").collect();
        assert_eq!((found.len(), found[0].count), (1, 2));
        assert_eq!(report.verdict(Severity::Error), crate::Verdict::Unknown);
    }
}
