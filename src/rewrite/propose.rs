//! Rewrites, proposals and their outcome.
use trunnion_certify::postures::PostureCost;
use trunnion_certify::{Certificate, Claim, Outcome, certify, recheck};
use trunnion_check::{Diagnostic, Report, Settings, Severity, Status, check};
use trunnion_syntax::{Program, TextEdit, apply_edits, parse};

/// What the user allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Tip (or ball centre) may move by this much, mm.
    pub tolerance_mm: f64,
    /// Tool axis may turn by this much, deg.
    pub tolerance_deg: f64,
    /// What a sequence of postures is chosen by (`switch-angles`).
    pub cost: PostureCost,
    /// Which point of a ball X Y Z are (`smooth-pole`).
    pub point: ProgrammedPoint,
}

/// Which point of a ball X Y Z of a program are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProgrammedPoint {
    /// Its tip.
    #[default]
    Tip,
    /// Its centre: the tool length is measured to there.
    Centre,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance_mm: 0.001,
            tolerance_deg: 0.1,
            cost: PostureCost::default(),
            point: ProgrammedPoint::default(),
        }
    }
}

/// A proposal: edits and what they claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// Sorted, not overlapping.
    pub edits: Vec<TextEdit>,
    /// The claim to prove.
    pub claim: Claim,
    /// What it does, in numbers, for people.
    pub summary: String,
}

/// One rewrite; its docs are its file's header.
#[derive(Clone, Copy)]
pub struct Rewrite {
    /// `smooth-pole`.
    pub name: &'static str,
    /// Header of its file.
    pub docs: &'static str,
    /// Rules whose findings it may fix.
    pub cures: &'static [&'static str],
    /// Proposes; `Err` says why not (for people); `Ok(None)`: nothing to do.
    pub propose: fn(&Program, &Settings<'_>, &Options) -> Result<Option<Proposal>, String>,
}

/// The outcome of a rewrite.
#[derive(Clone, Debug)]
pub enum Attempt {
    /// Nothing to do.
    NothingToDo,
    /// Refused: the reason (undeclared tool shape, unknown position, not proved ...).
    Refused(String),
    /// Proved.
    Certified {
        /// Edits, sorted.
        edits: Vec<TextEdit>,
        /// The text after.
        after: Vec<u8>,
        /// The proof.
        certificate: Box<Certificate>,
        /// What it does.
        summary: String,
    },
}

/// Proposes, has it certified, and re-checks the certificate as it will be stored. Refused too when a rotary axis would turn
/// farther or in larger steps than before, or when a rule that it does not
/// claim to fix would report more errors than before (findings that it fixes may spread: less in one block, a little more in the next).
pub fn attempt(rewrite: &Rewrite, program: &Program, settings: &Settings<'_>, options: &Options) -> Attempt {
    if let Err(reason) = crate::survey::runs_straight(program, settings) {
        return Attempt::Refused(reason);
    }
    let proposal = match (rewrite.propose)(program, settings, options) {
        Ok(Some(proposal)) => proposal,
        Ok(None) => return Attempt::NothingToDo,
        Err(reason) => return Attempt::Refused(reason),
    };
    match prove(rewrite, program, settings, proposal) {
        Ok(certified) => certified,
        Err(reason) => Attempt::Refused(reason),
    }
}

fn prove(rewrite: &Rewrite, program: &Program, settings: &Settings<'_>, proposal: Proposal) -> Result<Attempt, String> {
    let Some(machine) = settings.machine else {
        return Err("no machine is named (--machine)".into());
    };
    let Proposal { edits, claim, summary } = proposal;
    let before = program.source();
    let Some(after) = apply_edits(before, &edits) else {
        return Err("the edits overlap".into());
    };
    let outcome = certify(before, &after, settings.dialect, machine, &settings.setup, &claim);
    let certificate = proved(outcome)?;
    let stored = Certificate::from_json(&certificate.to_json())?;
    proved(recheck(
        &stored,
        before,
        &after,
        settings.dialect,
        machine,
        &settings.setup,
    ))?;
    // the guard follows what a rewrite makes least: postures their cost, smooth-pole the slope, which it compares itself
    if matches!(certificate.claim, Claim::SamePoses { .. }) {
        no_worse_turns(&certificate)?;
    }
    no_new_errors(rewrite, program, &after, settings)?;
    Ok(Attempt::Certified {
        edits,
        after,
        certificate,
        summary,
    })
}

fn proved(outcome: Outcome) -> Result<Box<Certificate>, String> {
    match outcome {
        Outcome::Proved(certificate) => Ok(certificate),
        Outcome::Refuted(witness) => Err(format!("refuted: {witness}")),
        Outcome::Unknown(gap) => Err(format!("not proved: {gap}")),
    }
}

/// No rotary axis turns farther in all, nor in a larger step (beyond the rounding of numbers).
fn no_worse_turns(certificate: &Certificate) -> Result<(), String> {
    for rotary in &certificate.rotary {
        let pairs = [
            ("largest step", rotary.step_before_deg, rotary.step_after_deg),
            ("travel", rotary.travel_before_deg, rotary.travel_after_deg),
        ];
        for (what, before, after) in pairs {
            if after > before * (1.0 + 1e-6) + 0.01 {
                return Err(format!(
                    "the {what} of {} would grow from {before:.3} to {after:.3} deg",
                    rotary.axis
                ));
            }
        }
    }
    Ok(())
}

/// No rule reports more errors than before, except those that the rewrite fixes; these report none where they
/// reported none.
fn no_new_errors(rewrite: &Rewrite, program: &Program, after: &[u8], settings: &Settings<'_>) -> Result<(), String> {
    let was = check(program, settings);
    let is = check(&parse(after.to_vec(), program.options()), settings);
    let is_error =
        |d: &Diagnostic, rule: &str| d.rule == rule && d.own_severity() == Severity::Error && d.status == Status::Fail;
    let errors = |report: &Report, rule: &str| -> u64 {
        report
            .findings()
            .filter(|d| is_error(d, rule))
            .map(|d| u64::from(d.count))
            .sum()
    };
    let more = |d: &&Diagnostic| !rewrite.cures.contains(&d.rule) && errors(&is, d.rule) > errors(&was, d.rule);
    if let Some(d) = is.findings().find(more) {
        return Err(format!("it would cause an error: {} ({})", d.message, d.rule));
    }
    let sum = |report: &Report| rewrite.cures.iter().map(|rule| errors(report, rule)).sum::<u64>();
    // what it fixes may move from block to block, but a program without such an error must not get one
    if sum(&was) == 0 && sum(&is) > 0 {
        let cured = |d: &&Diagnostic| rewrite.cures.contains(&d.rule) && errors(&is, d.rule) > errors(&was, d.rule);
        let what = is.findings().find(cured).map_or("", |d| d.rule);
        return Err(format!("it would cause an error where there was none ({what})"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_machine::Limits;
    use trunnion_syntax::{Address, TextEdit};

    /// Proposes other numbers for all C words.
    fn every_c(program: &Program, number: fn(f64) -> f64) -> Proposal {
        let words = program.blocks().flat_map(|block| block.words().collect::<Vec<_>>());
        let edits = words
            .filter(|word| word.address == Address::Letter(b'C'))
            .map(|word| TextEdit {
                range: word.value_range,
                new_text: number(program.text(word.value_range).parse().expect("a number")).to_string(),
            })
            .collect();
        Proposal {
            edits,
            claim: Claim::SamePoses {
                tolerance_mm: 1e-6,
                tolerance_deg: 1e-6,
            },
            summary: String::new(),
        }
    }

    fn refusal(propose: fn(&Program, &Settings<'_>, &Options) -> Result<Option<Proposal>, String>) -> String {
        let mut machine = trunnion_machine::builtin("mikron-ucp710").expect("built in").clone();
        let c = machine.joint(b'C').expect("C");
        machine.axes[c].limits = Limits::Range(-2.0, 20.0);
        let settings = Settings::new(
            trunnion_dialect::builtin("sinumerik-840d").expect("built in"),
            Some(&machine),
            trunnion_interp::Setup::default(),
        );
        let text = "TRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 X1 C5 F100\nX2 C3\nM30\n";
        let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
        let rewrite = Rewrite {
            name: "every-c",
            docs: "",
            cures: &[],
            propose,
        };
        match attempt(&rewrite, &program, &settings, &Options::default()) {
            Attempt::Refused(reason) => reason,
            other => panic!("{other:?}"),
        }
    }

    /// What is proved may still be worse: more turning, or an axis outside its travel.
    #[test]
    fn a_proved_rewrite_that_makes_things_worse_is_refused() {
        let more = refusal(|program, _, _| Ok(Some(every_c(program, |c| if c == 5.0 { 365.0 } else { c }))));
        assert!(more.contains("of C would grow"), "{more}");
        let outside = refusal(|program, _, _| Ok(Some(every_c(program, |c| c - 720.0))));
        assert!(
            outside.contains("it would cause an error") && outside.contains("axis-limit"),
            "{outside}"
        );
    }
}
