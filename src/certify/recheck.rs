//! Certificate and files to verdict, from scratch: the file to read if you trust nobody.
//!
//! Both texts are parsed, run and followed again by floors 0 to 3. Each pair of motions is compared (`compare`), the paths between
//! block ends are bounded (`path`), and the texts are compared byte by byte outside coordinate words (`text`).
use crate::certificate::{NamedDigest, SCHEMA, TextDigest, other_schema, other_text};
use crate::claim::for_any_values;
use crate::digest::{dialect_digest, machine_digest, setup_digest};
use crate::library::Recorder;
use crate::proof::Proof;
use crate::switch;
use crate::text::text_change;
use crate::{Certificate, Claim, Outcome, RefitSource};
use std::sync::Arc;
use trunnion_dialect::Dialect;
use trunnion_interp::{FaultKind, Library, Setup};
use trunnion_machine::Machine;
use trunnion_same::{
    Input, Refit, Steps, Verdict, are_two_controls, compare, only_by_chance, undeclared, unrelated, variables_differ,
};
use trunnion_syntax::{LineIndex, Program, parse};

/// Tries to prove `claim` for two texts.
pub fn certify(
    before: &[u8],
    after: &[u8],
    dialect: &Dialect,
    machine: &Machine,
    setup: &Setup,
    claim: &Claim,
) -> Outcome {
    certify_across(before, after, [dialect, dialect], machine, setup, claim)
}

/// The same for two texts in two dialects: APT against G code.
pub fn certify_across(
    before: &[u8],
    after: &[u8],
    dialects: [&Dialect; 2],
    machine: &Machine,
    setup: &Setup,
    claim: &Claim,
) -> Outcome {
    certify_with_libraries([before, after], dialects, machine, (setup, &setup.library), claim)
}

/// The same where the changed program has its own called programs. Such a certificate can be checked again only where both call the same.
pub fn certify_with_libraries(
    [before, after]: [&[u8]; 2],
    dialects: [&Dialect; 2],
    machine: &Machine,
    (setup, after_library): (&Setup, &Library),
    claim: &Claim,
) -> Outcome {
    let question = Question {
        texts: [before, after],
        dialects,
        machine,
        setup,
        after_library,
        claim,
    };
    match prove(question) {
        Ok(certificate) => Outcome::Proved(Box::new(certificate)),
        Err(outcome) => outcome,
    }
}

/// Proves the certificate's claim again and compares every number in it.
pub fn recheck(
    certificate: &Certificate,
    before: &[u8],
    after: &[u8],
    dialect: &Dialect,
    machine: &Machine,
    setup: &Setup,
) -> Outcome {
    let fresh = match inputs_match(certificate, before, after, dialect, machine, setup)
        .and_then(|()| after_dialect(certificate, dialect))
        .and_then(|other| {
            prove(Question {
                texts: [before, after],
                dialects: [dialect, other],
                machine,
                setup,
                after_library: &setup.library,
                claim: &certificate.claim,
            })
        }) {
        Ok(fresh) => fresh,
        Err(outcome) => return outcome,
    };
    // the version is not a number of the proof: another version may check, but the seal keeps it as it was
    let fresh = Certificate {
        tool_version: certificate.tool_version.clone(),
        ..fresh
    }
    .sealed();
    match crate::difference::first_difference(certificate, &fresh) {
        Some(message) => Outcome::refuted(message),
        None => Outcome::Proved(Box::new(fresh)),
    }
}

/// The certificate is about these inputs.
fn inputs_match(
    certificate: &Certificate,
    before: &[u8],
    after: &[u8],
    dialect: &Dialect,
    machine: &Machine,
    setup: &Setup,
) -> Result<(), Outcome> {
    let refuse = |what: &str| {
        Err(Outcome::refuted(format!(
            "the certificate was made for {what}: the SHA-256 values differ"
        )))
    };
    if let Some(why) = other_schema(&certificate.schema) {
        return Err(Outcome::refuted(why));
    }
    if let Some(why) = other_text([&certificate.before, &certificate.after], [before, after]) {
        return Err(Outcome::refuted(why));
    }
    if certificate.dialect.name != dialect.name || certificate.dialect.sha256 != dialect_digest(dialect) {
        return refuse(&format!(
            "another dialect ({}, here it is {})",
            certificate.dialect.name, dialect.name
        ));
    }
    if certificate.machine.name != machine.id || certificate.machine.sha256 != machine_digest(machine) {
        return refuse(&format!(
            "another machine ({}, here it is {})",
            certificate.machine.name, machine.id
        ));
    }
    if certificate.setup_sha256 != setup_digest(setup) {
        return refuse(
            "other tools, work offsets, control parameters or variables (values that --assume takes as zero are among them)",
        );
    }
    Ok(())
}

/// The dialect of the text after: that of the text before, or the built-in one that the certificate names.
fn after_dialect<'d>(certificate: &Certificate, dialect: &'d Dialect) -> Result<&'d Dialect, Outcome> {
    let Some(named) = &certificate.after_dialect else {
        return Ok(dialect);
    };
    trunnion_dialect::builtin(&named.name)
        .filter(|other| dialect_digest(other) == named.sha256)
        .ok_or_else(|| Outcome::refuted(format!("the certificate was made for another dialect {}", named.name)))
}

/// What is to be proved of what.
#[derive(Clone, Copy)]
struct Question<'a> {
    texts: [&'a [u8]; 2],
    dialects: [&'a Dialect; 2],
    machine: &'a Machine,
    setup: &'a Setup,
    /// Called programs of the text after.
    after_library: &'a Library,
    claim: &'a Claim,
}

/// The proof: where blocks with `/` run, and where they are skipped, unless it is declared which.
fn prove(question: Question<'_>) -> Result<Certificate, Outcome> {
    let Question {
        texts, dialects, setup, ..
    } = question;
    let mut proved = prove_for_all(question)?;
    if texts[0] == texts[1] || setup.control.block_delete.is_some() {
        return Ok(proved);
    }
    let switches = switch::switches(texts, dialects);
    // called programs may have such blocks too
    if switches.is_empty() && proved.library.is_empty() {
        return Ok(proved);
    }
    switch::at_most_one(&switches)?;
    let mut skipping = setup.clone();
    skipping.control.block_delete = Some(true);
    let other = prove_for_all(Question {
        setup: &skipping,
        ..question
    })
    .map_err(switch::where_skipped)?;
    proved.worst.join(&other.worst);
    Ok(proved.sealed())
}

/// The proof for one state of the switch for block delete. Two programs are the same only with any values of what nobody declares.
fn prove_for_all(question: Question<'_>) -> Result<Certificate, Outcome> {
    let Question {
        texts,
        dialects,
        setup,
        claim,
        ..
    } = question;
    let (proved, unset) = prove_run(question)?;
    if texts[0] != texts[1]
        && let Some(claim) = &for_any_values(claim)
        && let Some(unrelated) = unrelated(setup, dialects, &unset)
    {
        // of one control only that they differ counts: with stand-ins a pose may be out of reach
        let again = prove_run(Question {
            setup: &unrelated,
            claim,
            ..question
        });
        let line = match again {
            Err(Outcome::Refuted(found)) => found.line,
            Err(Outcome::Unknown(gap)) if are_two_controls(dialects) || variables_differ(&gap.to_string()) => gap.line,
            _ => return Ok(proved),
        };
        let place = line.map_or_else(String::new, |line| format!("line {line}: "));
        return Err(Outcome::unknown_at(line, place + &only_by_chance(&unset)));
    }
    Ok(proved)
}

/// The proof with the values that the setup declares, all others at 0, and what was not declared.
fn prove_run(question: Question<'_>) -> Result<(Certificate, Vec<FaultKind>), Outcome> {
    let Question {
        texts: [before, after],
        dialects: [dialect, other],
        machine,
        setup,
        after_library,
        claim,
    } = question;
    claim_makes_sense(claim)?;
    let old = parse(before.to_vec(), dialect.lex);
    // a program is compared with itself to see what of it is known: its text is held once
    let other_text = (before != after || dialect.lex != other.lex).then(|| parse(after.to_vec(), other.lex));
    let new = other_text.as_ref().unwrap_or(&old);
    let text = text_change(&old, new, dialect);
    if claim.is_rewrite() && !text.rest_identical {
        return Err(Outcome::refuted(
            "the texts differ in more than numbers of coordinate words",
        ));
    }
    let mut proof = Proof::new((machine, other.advice.rotary_feed), claim, new);
    let (recorded, recorded_after, libraries) = record_both(setup, after_library);
    let input = |program, dialect, setup| Input {
        program,
        dialect,
        setup,
        machine: Some(machine),
    };
    let mut sides = [
        Steps::new(input(&old, dialect, &recorded)),
        Steps::new(input(new, other, &recorded_after)),
    ];
    for side in &mut sides {
        side.watch_faults();
    }
    let [old_steps, new_steps] = &mut sides;
    let verdict = compare(old_steps, new_steps, &asked(claim), &mut proof);
    if verdict != Verdict::Same {
        // the comparison may withdraw a refutation: where it is unknown whether a block moves the machine at all
        let taken_back = |outcome: &Outcome| matches!((outcome, &verdict), (Outcome::Refuted(_), Verdict::Unknown(_)));
        if let Some(outcome) = proof.failed.take().filter(|outcome| !taken_back(outcome)) {
            return Err(outcome);
        }
        return Err(proof.outcome(verdict, &old));
    }
    // a rewrite claims that each change is proved; two programs are compared by what they do
    // where blocks are skipped, what they say makes no difference
    if text.rest_identical && claim.is_rewrite() && setup.control.block_delete != Some(true) {
        every_change_ran(&sides, (&old, new))?;
    }
    let postures = proof.postures()?;
    let unset = sides.iter_mut().flat_map(undeclared).collect();
    let certificate = Certificate {
        schema: SCHEMA.into(),
        tool_version: env!("CARGO_PKG_VERSION").into(),
        before: TextDigest::of(before),
        after: TextDigest::of(after),
        dialect: NamedDigest {
            name: dialect.name.clone(),
            sha256: dialect_digest(dialect),
        },
        after_dialect: (other.name != dialect.name).then(|| NamedDigest {
            name: other.name.clone(),
            sha256: dialect_digest(other),
        }),
        machine: NamedDigest {
            name: machine.id.clone(),
            sha256: machine_digest(machine),
        },
        setup_sha256: setup_digest(setup),
        library: libraries.iter().flat_map(|library| library.loaded()).collect(),
        claim: claim.clone(),
        text,
        motions: proof.motions,
        worst: proof.worst,
        rotary: proof.rotary,
        postures,
        rapids: proof.rapids,
        changes: proof.changes,
        seal_sha256: String::new(),
    };
    Ok((certificate.sealed(), unset))
}

/// What the comparison is asked.
fn asked(claim: &Claim) -> trunnion_same::Claim {
    let (mm, degrees) = claim.tolerances();
    trunnion_same::Claim {
        mm,
        deg: degrees,
        pieces: matches!(claim, Claim::InsertedPoints { .. }),
        frees_feed: matches!(claim, Claim::AdaptedFeed { .. }),
        path_only: matches!(claim, Claim::SamePath { .. }),
        cuts: !claim.is_rewrite() && !matches!(claim, Claim::ClearRapids { .. } | Claim::InsertedRetracts { .. }),
        rapid_runs: matches!(claim, Claim::ClearRapids { .. }),
        retracts: matches!(claim, Claim::InsertedRetracts { .. }),
        refit: refit(claim),
        ..trunnion_same::Claim::STRICT
    }
}

/// The settings of both runs with recorders of the programs that they call: one recorder where both call from the same places, so that runs
/// of one text are seen to be the same.
fn record_both(setup: &Setup, after_library: &Library) -> (Setup, Setup, Vec<Arc<Recorder>>) {
    let (recorded, library) = Recorder::wrap(setup);
    if *after_library == setup.library {
        return (recorded.clone(), recorded, library.into_iter().collect());
    }
    let mut beside = setup.clone();
    beside.library = after_library.clone();
    let (recorded_after, other) = Recorder::wrap(&beside);
    (recorded, recorded_after, library.into_iter().chain(other).collect())
}

/// Every block that differs ran: what did not run was not compared.
fn every_change_ran([old, new]: &[Steps<'_>; 2], (before, after): (&Program, &Program)) -> Result<(), Outcome> {
    for (was, is) in before.blocks().zip(after.blocks()) {
        let same = before.source()[was.range().as_usize()] == after.source()[is.range().as_usize()];
        if !(same || old.has_run(was.id()) && new.has_run(is.id())) {
            let (line, _) = LineIndex::new(after.source()).line_column(after.source(), is.range().start);
            return Err(Outcome::unknown(format!(
                "line {line} differs, and never runs: nothing was compared there"
            )));
        }
    }
    Ok(())
}

/// How far lines that are put together may be from what takes their place.
fn refit(claim: &Claim) -> Option<Refit> {
    match *claim {
        Claim::RefittedPath { tolerance_mm, source } => Some(Refit {
            mm: tolerance_mm,
            points_only: source == RefitSource::Points,
        }),
        _ => None,
    }
}

/// Tolerances and radius must be finite and not negative.
fn claim_makes_sense(claim: &Claim) -> Result<(), Outcome> {
    let (mm, degrees) = claim.tolerances();
    let further = match *claim {
        Claim::AdaptedFeed { asked_mm_min, .. } => asked_mm_min,
        Claim::RefittedPath { tolerance_mm, .. } => tolerance_mm,
        Claim::ClearRapids { clearance_mm, .. } | Claim::InsertedRetracts { clearance_mm, .. } => clearance_mm,
        _ => 0.0,
    };
    let fine = [mm, degrees, claim.point_height_mm(), further]
        .iter()
        .all(|value| value.is_finite() && *value >= 0.0);
    if fine {
        Ok(())
    } else {
        Err(Outcome::refuted(
            "claim: tolerances, radius, clearance and feed must be finite and not negative",
        ))
    }
}

#[cfg(test)]
mod path_tests;
#[cfg(test)]
mod tests;
