//! What a run takes for granted where nobody declared it: radii of tools as zero, numbers without a decimal point as whole units.
use crate::diagnostic::{Diagnostic, Status, ValueKey};
use crate::sink::Reporter;
use crate::{Severity, words::letter};
use std::collections::BTreeSet;
use trunnion_dialect::{Dialect, Role};
use trunnion_interp::{Fault, FaultKind, Lacks};
use trunnion_machine::{Leg, Machine, direction_letter};
use trunnion_syntax::{Address, Block, Value};

/// What was taken for granted so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Assumed {
    /// Radii that are taken as zero.
    radii: BTreeSet<String>,
    /// Numbers without a decimal point were read.
    whole: bool,
    /// The axes whose position depends on such a number, by their letters.
    axes: BTreeSet<u8>,
    /// Such a number is an increment, a centre, a radius or an argument of a macro: any axis may depend on it.
    any_axis: bool,
    /// The axis to which the preferred direction of a swivel is taken to refer: data of the machine's builder that nothing declares.
    direction: Option<u8>,
    /// The program is a subprogram that does not say what its caller does.
    of_caller: bool,
}

impl Assumed {
    /// Takes a fault; whether it is an assumption and nothing else. `zero`: undeclared radii are taken as zero.
    pub(crate) fn takes(&mut self, fault: &Fault, reporter: &Reporter<'_>, zero: bool) -> bool {
        if fault.kind == FaultKind::AmbiguousDecimal && !reporter.has_letter_o(fault.range) {
            self.whole = true;
            let block = reporter.program().block_at(fault.range.start);
            if let Some(block) = block {
                self.read(&reporter.program().block(block), reporter.dialect());
            }
        }
        match fault.kind.lacks() {
            Some(Lacks::Radius(number)) if zero => {
                self.radii.insert(format!("the radius of {number} = 0 (not declared)"));
                true
            }
            _ => false,
        }
    }

    /// A swivel has a preferred direction, which is taken to refer to an axis.
    pub(crate) fn swivels(&mut self, (machine, dialect): (&Machine, &Dialect), leg: &Leg) {
        if leg.motion.tilt.posture.is_direction() && dialect.quirks.declares_names() {
            self.direction = self.direction.or_else(|| direction_letter(machine));
        }
    }

    /// Whether the program is a subprogram that does not say what its caller does.
    pub(crate) fn relies_on_caller(&mut self, relies: bool) {
        self.of_caller = relies;
    }

    /// The axes that depend on a number without a decimal point in a block.
    fn read(&mut self, block: &Block<'_>, dialect: &Dialect) {
        for word in block.words() {
            let (Address::Letter(letter), Value::Number(number)) = (word.address, word.value) else {
                continue;
            };
            if number.has_point || number.mantissa == 0 {
                continue;
            }
            let macro_call = letter == b'G' && matches!(number.mantissa, 65 | 66);
            match dialect.role(letter) {
                Some(Role::Axis) => _ = self.axes.insert(letter),
                Some(Role::Increment | Role::ArcCentre | Role::ArcRadius) => self.any_axis = true,
                _ => self.any_axis |= macro_call,
            }
        }
    }

    /// The assumptions, for people.
    pub(crate) fn listed(&self) -> impl Iterator<Item = String> {
        let whole = "numbers without a decimal point in whole units (not declared)";
        let whole = self.whole.then(|| whole.to_owned());
        let direction = self.direction.map(|axis| {
            let axis = letter(axis);
            format!("the direction in CYCLE800 refers to the axis {axis} (not declared)")
        });
        whole.into_iter().chain(self.radii.iter().cloned()).chain(direction)
    }

    /// No axis limit is proven to be broken in a subprogram that does not say what its caller does. An axis that leaves its travel only as
    /// such numbers are read is no error: it is unknown how they are meant. Where rotary axes turn part or tool (`turns`), each position
    /// depends on all words.
    pub(crate) fn weigh(&self, found: &mut [Diagnostic], turns: bool) {
        if !self.whole && !self.of_caller {
            return;
        }
        for one in found {
            self.weigh(&mut one.also, turns);
            if self.of_caller {
                leave_open(one, ", in the state that is usual at power-on", OF_CALLER);
                continue;
            }
            let axis = one.values.iter().find_map(|(key, value)| match value {
                ValueKey::Text(text) if *key == "axis" => Some(text.as_str()),
                _ => None,
            });
            let depends = axis.is_some_and(|axis| {
                let all = self.any_axis || (turns && !self.axes.is_empty());
                all || self.axes.iter().any(|own| letter(*own) == axis)
            });
            if depends {
                leave_open(one, ", where a number without a decimal point is in whole units", HELP);
            }
        }
    }
}

/// An axis limit that a program breaks is unknown: `why`, as the end of its sentence.
fn leave_open(one: &mut Diagnostic, why: &str, help: &str) {
    if one.rule == "axis-limit" && one.status == Status::Fail {
        (one.status, one.severity) = (Status::Unknown, Severity::Info);
        one.message.push_str(why);
        one.help = Some(help.to_owned());
    }
}

const HELP: &str = "write the decimal points, or declare in trunnion.toml what numbers without one mean: implicit_decimals under [control]";
const OF_CALLER: &str =
    "check the program that calls this one, write the codes here, or take the usual state: `--assume power-on`";

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use crate::{Severity, Verdict};

    fn judged(fence: &str, line: &str) -> (Verdict, Vec<String>, Vec<String>) {
        let text = format!("%\nO1\nG21 G17 G90 G94 G54\nM3 S1000\nG0 X0 Y0 Z5.\n{line}\nM30\n%\n");
        let report = Fixture::parse(fence, &text).check().expect("a report");
        let limits = report.diagnostics.iter().filter(|found| found.rule == "axis-limit");
        let limits = limits.map(|found| found.message.clone()).collect();
        (report.verdict(Severity::Error), report.assumptions.clone(), limits)
    }

    const WHOLE: &str = "numbers without a decimal point in whole units (not declared)";

    /// What only the reading of a number makes wrong is unknown; the reading is listed once.
    #[test]
    fn a_limit_that_depends_on_a_missing_point_is_unknown() {
        for dialect in ["fanuc-30i", "haas-ngc"] {
            let fence = format!("gcode {dialect} mill-3axis");
            let (verdict, assumptions, limits) = judged(&fence, "G1 X4000 F100.\nX10.");
            assert_eq!(verdict, Verdict::Unknown, "{limits:?}");
            assert_eq!(
                assumptions.iter().filter(|one| *one == WHOLE).count(),
                1,
                "{assumptions:?}"
            );
            assert!(limits[0].contains("X reaches 4000 mm"), "{limits:?}");
            assert!(
                limits[0].ends_with("without a decimal point is in whole units"),
                "{limits:?}"
            );
            let (verdict, assumptions, _) = judged(&fence, "G1 X100 F100.\nY10");
            assert_eq!(verdict, Verdict::Pass);
            assert_eq!(
                assumptions.iter().filter(|one| *one == WHOLE).count(),
                1,
                "{assumptions:?}"
            );
            // with a point, on another axis, or in machine units it is what it is
            for line in ["G1 X4000. F100.", "G1 X4000. Y10 F100."] {
                assert_eq!(judged(&fence, line).0, Verdict::Fail, "{line}");
            }
            let (verdict, assumptions, _) = judged(&fence, "G1 X100. F100.");
            assert_eq!(
                (verdict, assumptions.contains(&WHOLE.to_owned())),
                (Verdict::Pass, false)
            );
        }
        assert_eq!(judged("gcode linuxcnc mill-3axis", "G1 X4000 F100").0, Verdict::Fail);
    }

    /// To which rotary axis _DIR refers is data of the swivel, which nothing declares.
    #[test]
    fn the_axis_of_a_direction_is_assumed() {
        let listed = |machine: &str, direction: &str| {
            let text = format!(
                "G54 G17 G90 G71 G94\nT1 D1 M6\nM3 S1000\nG0 X0 Y0 Z50 A0 C0\nCYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,{direction})\nCYCLE800()\nM30\n"
            );
            let report = Fixture::parse(&format!("gcode sinumerik-840d {machine}"), &text).check();
            let found = report.expect("a report").assumptions;
            found
                .into_iter()
                .filter(|one| one.contains("CYCLE800"))
                .collect::<Vec<_>>()
        };
        for direction in ["1", "-1"] {
            assert_eq!(
                listed("mikron-ucp710", direction),
                ["the direction in CYCLE800 refers to the axis A (not declared)"],
                "{direction}"
            );
        }
        assert_eq!(listed("mikron-ucp710", "0"), [""; 0]);
    }

    /// A subprogram alone may be called in G91.
    #[test]
    fn a_limit_that_depends_on_the_caller_is_unknown() {
        let verdict = |fence: &str, body: &str| {
            let text = format!("O1000\n{body}\nG0 X0 Y0 Z0\nX5000. Y10.\nM99\n");
            let report = Fixture::parse(fence, &text).check().expect("a report");
            report.verdict(Severity::Error)
        };
        for fence in ["gcode fanuc-30i mill-3axis", "gcode fanuc-30i mill-3axis undeclared"] {
            assert_eq!(verdict(fence, "G21 G17"), Verdict::Unknown, "{fence}");
            assert_eq!(verdict(fence, "G21 G17 G90"), Verdict::Fail, "{fence}");
        }
    }
}
