//! What is proved may be worse, and one place may fail where others hold.
use super::*;
use crate::{Proposal, Proposed};
use trunnion_machine::Limits;
use trunnion_syntax::Address;

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
        places: vec![Place::around(program, edits)],
        claim: Claim::SamePoses {
            tolerance_mm: 1e-6,
            tolerance_deg: 1e-6,
        },
        summary: String::new(),
    }
}

fn refusal(propose: fn(&Program, &Settings<'_>, &Options, &Known) -> Proposed) -> String {
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
        writes: None,
        proposes: propose,
    };
    let outcome = attempt(&rewrite, &program, &settings, &Options::default()).outcome();
    outcome.expect_err("a reason")
}

/// What is proved may still be worse: more turning, or an axis outside its travel.
#[test]
fn a_proved_rewrite_that_makes_things_worse_is_refused() {
    let more = refusal(|program, _, _, _| Ok(Some(every_c(program, |c| if c == 5.0 { 365.0 } else { c }))));
    assert!(more.contains("of C would grow"), "{more}");
    let outside = refusal(|program, _, _, _| Ok(Some(every_c(program, |c| c - 720.0))));
    assert!(
        outside.contains("it would cause an error") && outside.contains("axis-limit"),
        "{outside}"
    );
}
/// Each word is a place of its own: the one that makes an axis leave its travel is left out, the others stay.
#[test]
fn a_place_that_cannot_be_proved_is_left_out() {
    let mut machine = trunnion_machine::builtin("mikron-ucp710").expect("built in").clone();
    let c = machine.joint(b'C').expect("C");
    machine.axes[c].limits = Limits::Range(-500.0, 500.0);
    let settings = Settings::new(
        trunnion_dialect::builtin("sinumerik-840d").expect("built in"),
        Some(&machine),
        trunnion_interp::Setup::default(),
    );
    let text = "TRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 X1 C365 F100\nX2 C3\nX3 C364\nX4 C5\nM30\n";
    let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
    let rewrite = Rewrite {
        name: "short-ways",
        docs: "",
        cures: &[],
        writes: None,
        proposes: |program, _, _, _| {
            let mut proposal = every_c(program, |c| {
                if c == 365.0 {
                    5.0
                } else if c == 364.0 {
                    4.5
                } else {
                    c
                }
            });
            let Change::Edits(edits) = proposal.places.remove(0).change else {
                panic!("edits")
            };
            proposal.places = edits
                .into_iter()
                .map(|edit| Place::around(program, vec![edit]))
                .collect();
            Ok(Some(proposal))
        },
    };
    let attempt = attempt(&rewrite, &program, &settings, &Options::default());
    let states: Vec<bool> = attempt
        .places
        .iter()
        .map(|place| place.state == State::Proved)
        .collect();
    assert_eq!(states, [true, true, true, false, true], "{attempt:?}");
    assert!(
        attempt.reasons().expect("a reason").starts_with("refuted: line 5: "),
        "{attempt:?}"
    );
    let after = attempt.proved.expect("proved").after;
    assert_eq!(String::from_utf8_lossy(&after), text.replace("C365", "C5"));
}

#[test]
fn a_long_program_is_proved_less_often() {
    assert_eq!([10, 125_000, 400_000, 9_000_000].map(most_proofs), [32, 32, 10, 4]);
}
