//! What the interpreter or the kinematics does not know is always reported: a motion with an unknown path, or one that leads from a
//! known place to nowhere, comes with a finding. Random programs of the codes that move something, on all dialects of controls.
//!
//! `TRUNNION_SILENCE_CASES` sets the number of programs.
use proptest::prelude::*;
use trunnion_check::{Diagnostic, Settings, Severity, Status, check};
use trunnion_interp::{Fault, Limits, ModalState, Motion, MotionKind, Setup, Sink, run};
use trunnion_machine::{Follower, builtin};

const DIALECTS: [&str; 7] = [
    "fanuc-30i",
    "haas-ngc",
    "sinumerik-840d",
    "linuxcnc",
    "iso-6983",
    "fanuc-30i-lathe-a",
    "okuma-osp",
];

const CODES: [&str; 93] = [
    "G15 H1",
    "G16 H1",
    "G16 H0",
    "G56 H1",
    "G169 H1",
    "G170",
    "NCYL",
    "G116 T1",
    "G0",
    "G1",
    "G2",
    "G3",
    "G4 P1.",
    "G5",
    "G7.1",
    "G10 L2 P1",
    "G12",
    "G13",
    "G15",
    "G16",
    "G17",
    "G18",
    "G19",
    "G28",
    "G30",
    "G31",
    "G33",
    "G38.2",
    "G40",
    "G41 D1",
    "G42 D1",
    "G43 H1",
    "G43.4 H1",
    "G43.5 H1",
    "G49",
    "G50",
    "G50.1",
    "G51",
    "G52",
    "G53",
    "G53.1",
    "G54",
    "G61",
    "G64",
    "G65 P1",
    "G68",
    "G68.2",
    "G69",
    "G70",
    "G71",
    "G73",
    "G74",
    "G76",
    "G77",
    "G80",
    "G81",
    "G82",
    "G83",
    "G84",
    "G85",
    "G86",
    "G87",
    "G88",
    "G89",
    "G90",
    "G91",
    "G92",
    "G93",
    "G94",
    "G95",
    "G98",
    "G99",
    "G150",
    "M3 S100",
    "M6 T1",
    "M98 P1",
    "TRAORI",
    "TRAFOOF",
    "TRANS",
    "ATRANS",
    "ROT RPL=30",
    "AROT",
    "ASCALE",
    "AMIRROR",
    "TOROT",
    "TOROTOF",
    "CYCLE81(5,0,2,-3)",
    "CYCLE83(5,0,2,-9,,-3,,1,,,1)",
    "MCALL",
    "CYCLE800()",
    "CYCLE800(0,\"\",0,57,5,0,0,0,30,0,0,0,0,0)",
    "CYCLE800(0,\"\",0,27,0,0,0,0,0,30,0,0,0,1)",
    "CYCLE800(0,\"\",1,57,0,0,0,0,30,0,0,0,0,0)",
];

/// A word with a number, or nothing.
fn word() -> impl Strategy<Value = String> {
    let letter = prop::sample::select(b"XYZABCIJKRQFPLUWHDE".to_vec());
    (letter, -20..20_i32, 0..4_u8).prop_map(|(letter, value, kind)| match kind {
        0 => String::new(),
        1 => format!(" {}{}.5", char::from(letter), value),
        _ => format!(" {}{}.", char::from(letter), value),
    })
}

/// A word that most codes read, with a number or a variable.
fn tame_word() -> impl Strategy<Value = String> {
    let letter = prop::sample::select(b"XYZACRQIJKFP".to_vec());
    let value = prop::sample::select(vec![
        "1.",
        "-3.5",
        "2.",
        "7.",
        "0.",
        "#1",
        "#5061",
        "#5041",
        "#101",
        "[#102+1.]",
    ]);
    (letter, value).prop_map(|(letter, value)| format!(" {}{value}", char::from(letter)))
}

/// One code and few words: often without a mistake.
fn tame_line() -> impl Strategy<Value = String> {
    let code = prop::sample::select(CODES.to_vec());
    (code, prop::collection::vec(tame_word(), 0..6)).prop_map(|(code, words)| format!("{code}{}\n", words.concat()))
}

fn line() -> impl Strategy<Value = String> {
    let codes = prop::collection::vec(prop::sample::select(CODES.to_vec()), 0..3);
    (codes, prop::collection::vec(word(), 0..5)).prop_map(|(codes, words)| codes.join(" ") + &words.concat() + "\n")
}

/// A number of a turning cycle, often a plain one.
fn amount() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "2.", "1.", "0.", "-.5", "300", "010000", "020060", "011060", "30.", "#1", "#500",
    ])
}

/// A roughing, repeating or threading cycle of a lathe in two blocks, and a contour.
fn turning() -> impl Strategy<Value = String> {
    let code = prop::sample::select(vec!["G71", "G72", "G73", "G76"]);
    let word = |letters: &'static [u8]| {
        (prop::sample::select(letters.to_vec()), amount())
            .prop_map(|(letter, amount)| format!(" {}{amount}", char::from(letter)))
    };
    let first = prop::collection::vec(word(b"UWRRPQ"), 0..4);
    let second = prop::collection::vec(word(b"UWRXZPQFK"), 0..5);
    let corners = prop::collection::vec((-30..40_i32, -30..10_i32, 0..4_u8), 0..5);
    (code, first, second, corners, any::<bool>()).prop_map(|(code, first, second, corners, thread)| {
        let contour = if thread { "" } else { " P1 Q2" };
        let line = |(x, z, kind): (i32, i32, u8)| match kind {
            0 => format!("G1 X{x}.\n"),
            1 => format!("G1 Z{z}.\n"),
            2 => format!("G2 X{x}. Z{z}. R9.\n"),
            _ => format!("G1 X{x}. Z{z}.\n"),
        };
        let between = corners.into_iter().map(line).collect::<Vec<_>>().concat();
        format!(
            "{code}{}\n{code}{contour}{}\nN1 G0 X10.\n{between}N2 G1 X60. Z-31.\n",
            first.concat(),
            second.concat()
        )
    })
}

/// Records that move the tool, or change what moves it.
const RECORDS: [&str; 34] = [
    "GOTO/1,2,3,0,0,1",
    "GOTO/4,2,3",
    "GOTO/4,2,3,0.6,0,0.8",
    "GOTO/1,1",
    "GOTO/P1",
    "GOTO/1,2,3,X",
    "GODLTA/1,2,3",
    "GODLTA/1",
    "GODLTA/P1",
    "FROM/0,0,50",
    "GOHOME",
    "GO/TO,L1",
    "GOFWD/L1,TO,L2",
    "INDIRV/1,0,0",
    "TLAXIS/1,0,0",
    "RAPID",
    "FEDRAT/100",
    "FEDRAT/0.1,MMPR",
    "CYCLE/DRILL,5,MMPM,2",
    "CYCLE/OFF",
    "TRACUT/1,0,0,5,0,1,0,0,0,0,1,0",
    "TRACUT/NOMORE",
    "COPY/1,TRANSL,5,0,0,2",
    "INDEX/1",
    "CALL/M1",
    "LOADTL/1",
    "MULTAX/OFF",
    "MULTAX/ON",
    "ROTABL/45,AAXIS",
    "ROTHED/30",
    "CIRCLE/0,0,0,0,0,1,5",
    "MOVARC/0,0,50,0,0,1,5,ANGLE,90",
    "CUTCOM/LEFT",
    "STOP",
];

/// Looks for motions that must not go by in silence.
struct Silent<'m> {
    follower: Follower<'m>,
    found: Option<String>,
}

impl Sink for Silent<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        let nowhere = leg.start.is_some() && leg.end.is_err();
        if (motion.kind == MotionKind::Unknown || nowhere) && self.found.is_none() {
            self.found = Some(format!("{motion:?} {:?}", leg.end.err()));
        }
    }

    fn fault(&mut self, _: Fault) {}
}

fn cases() -> u32 {
    let asked = std::env::var("TRUNNION_SILENCE_CASES").ok();
    asked.and_then(|count| count.parse().ok()).unwrap_or(400)
}

fn judge(dialect: &str, text: &str) -> Result<(), TestCaseError> {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let machine = builtin("mikron-ucp710").expect("built in");
    let limits = Limits {
        blocks: 10_000,
        ..Limits::default()
    };
    let setup = Setup {
        limits,
        ..Setup::default()
    };
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let mut silent = Silent {
        follower: Follower::new(machine),
        found: None,
    };
    run(&program, dialect, &setup, &mut silent);
    let report = check(
        &program,
        &Settings {
            assume: trunnion_check::Assume::ALL,
            ..Settings::new(dialect, Some(machine), setup)
        },
    );
    let open = |found: &Diagnostic| found.status == Status::Unknown || found.severity != Severity::Info;
    let told = report.diagnostics.iter().any(open);
    let silent = silent.found.filter(|_| !told);
    prop_assert!(silent.is_none(), "{}:\n{text}{silent:?}", dialect.name);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) })]

    #[test]
    fn nothing_unknown_is_passed_over(
        wild in prop::collection::vec(line(), 0..4),
        tame in prop::collection::vec(tame_line(), 1..3),
        wildly in any::<bool>(),
        dialect in prop::sample::select(DIALECTS.to_vec()),
    ) {
        let lines = if wildly { [wild, tame].concat() } else { tame };
        judge(dialect, &format!("G21 G90 G94 G0 X1. Y2. Z50. A0. C0. F100\n{}M30\n", lines.concat()))?;
    }

    #[test]
    fn nothing_unknown_of_turning_cycles_is_passed_over(cycle in turning(), y in any::<bool>()) {
        let y = if y { " Y2." } else { "" };
        judge("fanuc-30i-lathe-a", &format!("G21 G99 G0 X60. Z5. A0. C0.{y} F.1\n{cycle}G0 X70.\nM30\n"))?;
    }

    #[test]
    fn nothing_unknown_in_cl_data_is_passed_over(records in prop::collection::vec(prop::sample::select(RECORDS.to_vec()), 1..5)) {
        let head = "UNITS/MM\nMULTAX/ON\nCUTTER/10\nSPINDL/ON\nRAPID\nGOTO/1,2,50,0,0,1\nFEDRAT/100,MMPM\n";
        judge("apt", &format!("{head}{}\nFINI\n", records.join("\n")))?;
    }
}
