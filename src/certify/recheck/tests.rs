//! Claims about small programs, and certificates that were forged and sealed again.
use super::{certify, recheck};
use crate::{Certificate, Claim, Outcome};
use trunnion_interp::Setup;

const TURNS: Claim = Claim::SamePoses {
    tolerance_mm: 1e-6,
    tolerance_deg: 1e-6,
};

fn prove(before: &str, after: &str, claim: &Claim) -> Outcome {
    let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    certify(
        before.as_bytes(),
        after.as_bytes(),
        dialect,
        machine,
        &Setup::default(),
        claim,
    )
}

fn proved(outcome: Outcome) -> Certificate {
    match outcome {
        Outcome::Proved(certificate) => *certificate,
        other => panic!("not proved: {other:?}"),
    }
}

const BEFORE: &str =
    "TRAORI\nG0 X0 Y0 Z50 A10 C350 M3 S1000\nG1 X1 C358 F1000\nX2 C6\nG2 X4 Y0 I1 J0 C14\nG0 Z100\nM30\n";

#[test]
fn whole_turns_are_the_same_poses_and_the_way_changes_in_one_block_only() {
    let after = BEFORE.replace("C6", "C366").replace("C14", "C374");
    let certificate = proved(prove(BEFORE, &after, &TURNS));
    assert_eq!(certificate.motions.changed, 3, "the jump, the arc, the way up");
    assert_eq!(certificate.worst.point_shift_mm.value, 0.0);
    assert_eq!(
        certificate.worst.path_bound_mm.line, 4,
        "only the jump takes another way"
    );
    assert!(certificate.worst.path_axis_bound_deg.value > 10.0);
    assert_eq!(
        certificate.changes[1].path_axis_bound_deg, 0.0,
        "the arc is the same arc one turn on"
    );
    assert_eq!(certificate.changes[1].rotary_change_deg, [360.0, 0.0]);
    assert_eq!(
        (certificate.text.numbers_changed, certificate.text.bytes_changed),
        (2, 3)
    );
}

#[test]
fn half_turns_and_shifted_tips_are_refuted() {
    for (after, why) in [
        (BEFORE.replace("C6", "C186").replace("C14", "C194"), "tool axis turns"),
        (BEFORE.replace("X2 ", "X2.001 "), "tool tip shifts"),
        (BEFORE.replace("F1000", "F999"), "more than numbers"),
        (BEFORE.replace("X2 C6", "X2 C6 M8"), "more than numbers"),
        (BEFORE.replace("X2 C6", "X2\tC6"), "more than numbers"),
        (BEFORE.replace('\n', "\r\n"), "more than numbers"),
    ] {
        let Outcome::Refuted(witness) = prove(BEFORE, &after, &TURNS) else {
            panic!("{after} is not refuted")
        };
        assert!(witness.message.contains(why), "{witness}");
    }
}

#[test]
fn another_arc_with_the_same_ends_is_not_proved() {
    let after = BEFORE.replace("I1 J0", "I1.000 J-0.000");
    proved(prove(BEFORE, &after, &TURNS));
    let wider = BEFORE.replace("G2 X4 Y0 I1 J0", "G2 X4 Y0 I1 J2");
    assert!(matches!(prove(BEFORE, &wider, &TURNS), Outcome::Unknown(_)));
}

#[test]
fn a_dwell_is_not_a_coordinate() {
    let (one, two) = ("TRAORI\nG4 F1\nM30\n", "TRAORI\nG4 F2\nM30\n");
    assert!(matches!(prove(one, two, &TURNS), Outcome::Refuted(_)));
}

#[test]
fn unknown_positions_are_no_proof_unless_programmed_alike() {
    let text = "TRAORI\nG0 X0\nG0 Y0 Z50 A10 C350\nG1 X1 F100 C6\nM30\n";
    let certificate = proved(prove(text, &text.replace("C6", "C366"), &TURNS));
    assert_eq!(certificate.motions.unknown, 1);
    assert!(matches!(
        prove(text, &text.replace("X0", "X1"), &TURNS),
        Outcome::Unknown(_)
    ));
}

#[test]
fn an_inserted_coordinate_word_is_no_other_byte() {
    let text = "TRAORI\nG0 X0 Y0 Z50 A10 C350\nG1 X1 F100\nM30\n";
    let certificate = proved(prove(text, &text.replace("X1 F", "X1 Z50 C350 F"), &TURNS));
    assert_eq!((certificate.text.words_inserted, certificate.motions.changed), (2, 0));
    let swapped = "TRAORI\nG0 X0 Y0 Z50 A10 C350\nG1 F100 X1\nM30\n";
    assert!(matches!(prove(text, swapped, &TURNS), Outcome::Refuted(_)));
}

#[test]
fn a_forged_certificate_is_refused_though_its_seal_is_right() {
    let after = BEFORE.replace("C6", "C366").replace("C14", "C374");
    let certificate = proved(prove(BEFORE, &after, &TURNS));
    let again = |certificate: &Certificate| {
        let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
        let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
        recheck(
            certificate,
            BEFORE.as_bytes(),
            after.as_bytes(),
            dialect,
            machine,
            &Setup::default(),
        )
    };
    assert!(matches!(again(&certificate), Outcome::Proved(_)));
    let mut forged = certificate.clone();
    forged.worst.path_axis_bound_deg.value = 0.001;
    let Outcome::Refuted(witness) = again(&forged.sealed()) else {
        panic!("accepted")
    };
    assert!(
        witness
            .message
            .starts_with("worst.path_axis_bound_deg.value: certificate says 0.001"),
        "{witness}"
    );
    let mut forged = certificate.clone();
    forged.machine.sha256 = forged.dialect.sha256.clone();
    let Outcome::Refuted(witness) = again(&forged.sealed()) else {
        panic!("accepted")
    };
    assert!(witness.message.contains("another machine"), "{witness}");
    let mut unsealed = certificate;
    unsealed.claim = Claim::SamePoses {
        tolerance_mm: 1e-5,
        tolerance_deg: 1e-6,
    };
    let Outcome::Refuted(witness) = again(&unsealed) else {
        panic!("accepted")
    };
    assert!(witness.message.starts_with("seal_sha256"), "{witness}");
}
