//! What was written is read back: a wrong number anywhere in it is found.
use crate::support::machine;
use trunnion_certify::conversion::{Assume, ConversionClaim, Part, Reading, Run, converted, read};
use trunnion_interp::Setup;

const BEFORE: &str = "UNITS/MM
LOADTL/1,LENGTH,100
SPINDL/5000,RPM,CLW
RAPID
GOTO/0,0,50,0,0.1,0.994987437
FEDRAT/500,MMPM
GOTO/0,0,0,0,0.1,0.994987437
GOTO/10,0,0,0,0.2,0.979795897
CIRCLE/10,10,0,0,0,1,10
GOTO/20,10,0,0,0.2,0.979795897
DELAY/2
FINI
";

const AFTER: &str = "; trunnion: tool 1 length 100
N10 G90 G17 G710 G94
T1 M6
D1
S5000 M3
TRAORI
G0 X0 Y0 Z50 A5.73917 C180
G1 Z0 F500
X10 A11.53696
G3 X20 Y10 I0 J10
G4 F2
M30
";

fn reading(text: &str, dialect: &str, name: &str) -> Reading {
    read(&Run {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine: machine(name),
        setup: &Setup::default(),
        assume: Assume::default(),
    })
}

fn claim() -> ConversionClaim {
    ConversionClaim {
        end_mm: 1e-4,
        end_deg: 1e-4,
        path_mm: 1e-3,
        path_deg: None,
        feed_mm_min: 1e-3,
        time_share: 1e-4,
    }
}

fn outcome(after: &str, parts: &[Part], claim: &ConversionClaim) -> Result<f64, String> {
    let name = "mikron-ucp710";
    let after = reading(after, "sinumerik-840d", name);
    converted(
        (&reading(BEFORE, "apt", ""), None),
        (&after, machine(name)),
        parts,
        claim,
    )
    .map(|proof| proof.end_deg)
    .map_err(|outcome| format!("{outcome:?}"))
}

const ONE_EACH: [Part; 5] = [Part::Moves(1); 5];

#[test]
fn the_same_program_is_proved() {
    let off = outcome(AFTER, &ONE_EACH, &claim()).expect("proved");
    assert!(off < 1e-5, "{off}");
}

#[test]
fn every_wrong_word_is_found() {
    for (right, wrong, why) in [
        ("X10 A", "X10.001 A", "from where it was"),
        ("A11.53696", "A11.53796", "from where it was"),
        ("C180", "C0", "from where it was"),
        ("F500", "F501", "the feed differs"),
        ("S5000", "S5001", "the spindle differs"),
        ("M3", "M5", "the spindle differs"),
        ("T1 M6", "T2 M6", "the tool differs"),
        ("G3 X20", "G2 X20", "inside the block"),
        ("I0 J10", "I10 J0", "inside the block"),
        ("G4 F2", "G4 F3", "the kind of motion"),
        ("G1 Z0", "G0 Z0", "the kind of motion"),
        ("TRAORI\n", "", "from where it was"),
        ("M30", "G1 X30\nM30", "were compared"),
        ("G4 F2\n", "", "ends too early"),
        ("M30", "G999\nM30", "is not understood"),
    ] {
        assert!(AFTER.contains(right), "{right}");
        let found = outcome(&AFTER.replacen(right, wrong, 1), &ONE_EACH, &claim());
        let found = found.expect_err(&format!("{right} -> {wrong} was accepted"));
        assert!(found.contains(why), "{right} -> {wrong}: {found}");
    }
}

#[test]
fn a_wrong_hint_proves_nothing() {
    for parts in [
        &[Part::Moves(1); 4][..],
        &[Part::Moves(2), Part::Moves(1), Part::Moves(1), Part::Moves(1)],
        &[
            Part::Left,
            Part::Moves(1),
            Part::Moves(1),
            Part::Moves(1),
            Part::Moves(1),
        ],
        &[
            Part::Added(1),
            Part::Moves(1),
            Part::Moves(1),
            Part::Moves(1),
            Part::Moves(1),
        ],
        &[],
    ] {
        outcome(AFTER, parts, &claim()).expect_err("refused");
    }
}

/// The tip of a machine that runs its joints strays between the ends of a block: ends alone prove nothing.
#[test]
fn joints_that_run_straight_are_bounded_between_the_ends() {
    let before = "UNITS/MM\nFEDRAT/500\nRAPID\nGOTO/80,0,0\nGOTO/0,80,0\nFINI\n";
    // C turns by a quarter while the tool stays: the same end, and a quarter of a circle on the part
    let after = "G90 G17 G94\nG0 X80 Y0 Z0 A0 C0\nG93 G1 X80 Y0 C90 F4.419417\nM30\n";
    let name = "mikron-ucp710";
    let after = reading(after, "sinumerik-840d", name);
    let before = reading(before, "apt", "");
    let parts = [Part::Moves(1), Part::Moves(1)];
    let outcome = converted((&before, None), (&after, machine(name)), &parts, &claim());
    let outcome = format!("{:?}", outcome.expect_err("23 mm beside the chord"));
    assert!(outcome.contains("inside the block the tip may be 23.4"), "{outcome}");
}
