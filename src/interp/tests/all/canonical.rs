//! LinuxCNC's canonical calls as motions: what compensation of the cutter radius holds back keeps what was in effect with it.
use crate::support::{faults, line, lines, run_bytes};
use std::sync::Arc;
use trunnion_interp::{FaultKind, Feed, Files, Library, Loaded, ModalState, ProgramRun, Searched, Setup, Tool};

/// One file under any name.
struct OneFile(&'static str);

impl Files for OneFile {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        Ok(Loaded {
            path: format!("{name}.ngc"),
            bytes: self.0.as_bytes().into(),
        })
    }
}

fn with_file(text: &'static str) -> Setup {
    Setup {
        library: Library(Some(Arc::new(OneFile(text)))),
        ..Setup::default()
    }
}

fn feeds(source: &str) -> Vec<Feed> {
    let log = run_bytes("linuxcnc", source.as_bytes(), &Setup::default()).1;
    log.motions.iter().map(|motion| motion.feed).collect()
}

#[test]
fn a_held_motion_has_its_own_feed_not_that_of_the_next_line() {
    // G93: the control takes the length of the contour times F; the held line keeps that rate whatever the next line says
    let source = "G21 G17 G90\nG0 X0 Y0 Z0\nG93\nG41.1 D2\nG1 X20 F10\nG1 X40 F5\nG1 Y40 F2\nG94 G1 X0 F100\nG40\nM2\n";
    let mut got = feeds(source);
    got.dedup();
    let per_minute = |feed| Feed::PerMinute(feed);
    assert_eq!(
        got,
        [
            Feed::Rapid,
            per_minute(200.0),
            per_minute(100.0),
            per_minute(80.0),
            per_minute(100.0)
        ]
    );
    // without compensation the block lasts 1/F
    assert_eq!(feeds("G0 X0 Y0 Z0\nG93 G1 X20 F10\nM2\n")[1], Feed::InverseTime(10.0));
    // the control feeds no slower than 0.1 per minute
    assert_eq!(feeds("G0 X0 Y0 Z0\nG93 G1 X1 F0.05\nM2\n")[1], Feed::PerMinute(0.1));
}

/// Block of each motion, and whether it is emitted with G91.
struct Modes(Vec<(u32, bool)>);

impl trunnion_interp::Sink for Modes {
    fn motion(&mut self, motion: &trunnion_interp::Motion, state: &trunnion_interp::ModalState) {
        self.0.push((motion.block.0, state.coordinates.incremental()));
    }
    fn fault(&mut self, _: trunnion_interp::Fault) {}
}

#[test]
fn a_held_motion_is_told_with_the_modes_of_its_own_line() {
    let source = "G21 G17 G90 F100\nG0 X0 Y0 Z0\nG41.1 D2\nG1 X20\nG1 X40\nG91 G0 Y40\nG1 X-40\nG40\nM2\n";
    let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
    let program = trunnion_syntax::parse(source.as_bytes().to_vec(), dialect.lex);
    let mut modes = Modes(Vec::new());
    trunnion_interp::run(&program, dialect, &Setup::default(), &mut modes);
    for (block, incremental) in modes.0 {
        assert_eq!(incremental, block >= 5, "block {block}");
    }
}

#[test]
fn the_block_of_a_held_motion_in_a_called_file_is_its_call() {
    let sub = "o<part> sub\nG1 X20\nG1 X40\no<part> endsub\n";
    let source = "G21 G17 G90 F100\nG0 X0 Y0 Z0\nG41.1 D2\no<part> call\nS500\nS600\nG1 Y40\nG40\nM2\n";
    let log = run_bytes("linuxcnc", source.as_bytes(), &with_file(sub)).1;
    let at: Vec<_> = log
        .motions
        .iter()
        .map(|motion| (motion.block.0, line(motion)))
        .collect();
    let cuts = at.iter().filter(|(_, line)| line.contains("Y1 "));
    let blocks: Vec<u32> = cuts.map(|(block, _)| *block).collect();
    assert_eq!(blocks, [3, 3], "{at:?}");
}

#[test]
fn the_place_inside_a_called_file_is_told() {
    let sub = "o<part> sub\n  G1 X20\nG1 X40\no<part> endsub\n";
    let source = "G21 G90 F100\nG0 X0 Y0 Z0\no<part> call\nG1 Y40\nM2\n";
    let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
    let program = trunnion_syntax::parse(source.as_bytes().to_vec(), dialect.lex);
    let mut log = crate::support::Log::default();
    let mut interpreter = trunnion_interp::Interpreter::new(dialect, &with_file(sub));
    while interpreter.advance(&program, &mut log).is_some() {}
    let chain = |index: usize| interpreter.chain(log.motions[index].chain);
    let told: Vec<_> = chain(1)
        .into_iter()
        .map(|frame| (frame.file, frame.line, frame.what, frame.is_place))
        .collect();
    assert_eq!(
        told,
        [
            (String::new(), 3, "o<part> call".to_owned(), false),
            ("part.ngc".to_owned(), 2, "G1 X20".to_owned(), true)
        ]
    );
    assert_eq!(chain(2)[1].line, 3);
    assert!(chain(3).is_empty(), "the main program");
}

#[test]
fn g92_under_compensation_does_not_reach_the_machine() {
    // the control changes its offset without a word to the machine, so that the same words lead to the same place as before
    let source = "G21 G17 G90 F100\nG0 X0 Y0 Z0\nG92 X100\nG1 X110\nG41.1 D2\nG1 X130\nG92.1\nG1 X150\nG40\nM2\n";
    let log = run_bytes("linuxcnc", source.as_bytes(), &Setup::default()).1;
    let zeros: Vec<f64> = log.motions.iter().map(|motion| motion.zero[0]).collect();
    assert_eq!(zeros[0], 0.0);
    assert!(zeros[1..].iter().all(|zero| *zero == -100.0), "{zeros:?}");
}

#[test]
fn a_tool_offset_keeps_its_length_when_the_unit_changes() {
    let setup = Setup {
        tools: vec![Tool {
            number: 1,
            shape: None,
            diameter_mm: None,
            length_mm: Some(80.0),
            holder_mm: None,
        }],
        ..Setup::default()
    };
    for (source, lengths) in [
        ("G21 G90\nT1 M6\nG43 H1\nG0 Z0\nG20\nG0 Z1\nM2\n", [80.0, 80.0]),
        ("G20 G90\nT1 M6\nG43 H1\nG0 Z0\nG21\nG0 Z1\nM2\n", [80.0, 80.0]),
    ] {
        let log = run_bytes("linuxcnc", source.as_bytes(), &setup).1;
        let told: Vec<f64> = log.motions.iter().map(|motion| motion.tool_length_mm).collect();
        assert!(told.iter().zip(lengths).all(|(a, b)| (a - b).abs() < 1e-9), "{told:?}");
    }
}

#[test]
fn an_inch_feed_of_rotary_axes_alone_is_degrees_per_minute() {
    for dialect in ["linuxcnc", "fanuc-30i", "iso-6983"] {
        let source = "G20 G90 G94\nG0 X0. Y0. Z0. A0. C0.\nG1 A90. F100.\nG1 X1. F10.\nG1 X2. A0.\nM2\n";
        let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
        let got: Vec<_> = log.motions[1..].iter().map(|motion| motion.feed).collect();
        let linear = Feed::PerMinute(254.0);
        assert_eq!(got, [Feed::PerMinute(100.0), linear, linear], "{dialect}");
    }
    // a linear axis that is named without moving does not move
    for (dialect, inch) in [("linuxcnc", "G20"), ("fanuc-30i", "G20"), ("sinumerik-840d", "G700")] {
        let source = format!("{inch} G90 G94\nG0 X1. Y0. Z0. A0.\nG1 X1. A90. F100.\nG91 G1 Y0. A5.\nM2\n");
        let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
        let got: Vec<_> = log.motions[1..].iter().map(|motion| motion.feed).collect();
        assert_eq!(got, [Feed::PerMinute(100.0); 2], "{dialect}");
    }
    // a full circle runs along X Y although it names a rotary axis only
    for dialect in ["linuxcnc", "fanuc-30i", "sinumerik-840d"] {
        let inch = if dialect == "sinumerik-840d" { "G700" } else { "G20" };
        let source = format!("{inch} G17 G90 G94\nG0 X0. Y0. Z0. A0.\nG2 A90. I1. J0. F10.\nM2\n");
        let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
        assert_eq!(log.motions[1].feed, Feed::PerMinute(254.0), "{dialect}");
    }
    // whether X moves is not known
    let source = "G20 G91 G94\nG1 X1 A90 F100\nM2\n";
    let log = run_bytes("linuxcnc", source.as_bytes(), &Setup::default()).1;
    assert_eq!(log.motions[0].feed, Feed::Unknown);
    assert!(
        faults("linuxcnc", source)
            .iter()
            .any(|fault| fault.contains("F in inch")),
        "{:?}",
        faults("linuxcnc", source)
    );
}

#[test]
fn a_motion_beside_a_tool_change_starts_nobody_knows_where() {
    let log = run_bytes(
        "linuxcnc",
        b"G21 F100\nG0 X1 Y2 Z3 A4\nT1 M6 G0 X10\nY5\nM2\n",
        &Setup::default(),
    )
    .1;
    let motion = &log.motions[1];
    assert_eq!(motion.start.xyz(), None);
    assert_eq!(crate::support::position(&motion.start), "A4");
    assert_eq!(line(motion), "R X10 A4");
    assert_eq!(line(&log.motions[2]), "R X10 Y5 A4");
}

/// `[TRAJ] COORDINATES`: W is a word of a machine that has such an axis, and of no other.
#[test]
fn letters_of_further_axes_are_words_where_the_machine_has_them() {
    let source = "G21 G0 X1 W2\nM2\n";
    let mut setup = Setup::default();
    setup.control.axes_declared = true;
    let said = |setup: &Setup| {
        let log = run_bytes("linuxcnc", source.as_bytes(), setup).1;
        (
            log.motions.last().and_then(|motion| motion.end.get(8)),
            log.faults.len(),
        )
    };
    assert_eq!(said(&setup).0, None);
    assert!(said(&setup).1 > 0);
    setup.control.further_axes = vec![b'W'];
    assert_eq!(said(&setup), (Some(2.0), 0));
    // without a machine it is followed, and it is said that the axis is not known
    let unknown = Setup::default();
    assert_eq!(said(&unknown), (Some(2.0), 1));
}

#[test]
fn a_diameter_of_zero_that_the_program_says_is_declared() {
    let told = |code: &str| faults("linuxcnc", &format!("G21 F100\nG0 X0 Y0\n{code}\nG1 X20\nG40\nM2\n"));
    assert_eq!(told("G41.1 D0"), [""; 0]);
    assert!(told("G41")[0].contains("the radius of the tool is not declared"));
    assert!(told("G42 D3")[0].contains("the radius of D3 is not declared"));
}

#[test]
fn a_spline_is_run_as_chords_and_said_to_be_unknown() {
    let source = "G21 G17 G90 F100\nG0 X0 Y0 Z0\nG5 I0 J3 P0 Q-3 X10 Y10\nM2\n";
    let told = faults("linuxcnc", source);
    assert!(
        told[0].contains("spline: judged along chords within 0.001 mm of it"),
        "{told:?}"
    );
    let got = lines("linuxcnc", source);
    assert!(got.len() > 5, "{got:?}");
    assert_eq!(got.last().map(String::as_str), Some("L X10 Y10 Z0 F100"));
}

/// A file of its own for each name.
struct Several(&'static [(&'static str, &'static str)]);

impl Files for Several {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let found = self.0.iter().find(|(own, _)| *own == name);
        let (_, text) = found.ok_or_else(|| vec!["subs".into()])?;
        Ok(Loaded {
            path: format!("subs/{name}.ngc"),
            bytes: text.as_bytes().into(),
        })
    }
}

fn kinds(source: &str, files: &'static [(&'static str, &'static str)]) -> (Vec<FaultKind>, Option<ModalState>) {
    let setup = Setup {
        library: Library(Some(Arc::new(Several(files)))),
        ..Setup::default()
    };
    let log = run_bytes("linuxcnc", source.as_bytes(), &setup).1;
    (log.faults.into_iter().map(|fault| fault.kind).collect(), log.state)
}

#[test]
fn what_is_not_modelled_in_a_called_file_names_the_file_and_line() {
    let (kinds, _) = kinds(
        "G21 G0 X0 Y0 Z0\no<probe> call\nM2\n",
        &[("probe", "o<probe> sub\nG38.2 Z-5 F10\no<probe> endsub\n")],
    );
    let FaultKind::NotModelled { what } = &kinds[0] else {
        panic!("{kinds:?}");
    };
    assert_eq!(what, "in subs/probe.ngc, line 2: G38.2: the probed position");
    assert_eq!(kinds.len(), 1, "{kinds:?}");
}

#[test]
fn axes_of_a_refused_line_of_a_called_file_are_not_known() {
    let (kinds, state) = kinds(
        "G21 G0 X0 Y0 Z0 A0\no<bad> call\nG4 P1\nM2\n",
        &[("bad", "o<bad> sub\nG1 X5 Y[1 F100\nG4 P1\no<bad> endsub\n")],
    );
    assert!(
        matches!(&kinds[0], FaultKind::Rejected { message, .. } if message.starts_with("in subs/bad.ngc, line 2: ")),
        "{kinds:?}"
    );
    let position = state.expect("blocks ran").position;
    assert_eq!(
        [0, 1, 2, 3].map(|axis| position.get(axis)),
        [None, None, Some(0.0), Some(0.0)]
    );
}

#[test]
fn a_subprogram_that_is_not_there_keeps_the_controls_sentence_and_its_caller() {
    let missing = |source: &str, files| -> (Option<String>, Option<String>) {
        let (kinds, _) = kinds(source, files);
        match kinds
            .into_iter()
            .find(|kind| matches!(kind, FaultKind::MissingSubprogram { .. }))
        {
            Some(FaultKind::MissingSubprogram { alarm, caller, .. }) => (alarm, caller),
            other => panic!("{other:?}"),
        }
    };
    let (alarm, caller) = missing("o<none> call\nM2\n", &[]);
    assert!(alarm.is_some_and(|alarm| alarm.starts_with("LinuxCNC: ") && alarm.contains("none")));
    assert_eq!(caller, None);
    let (_, caller) = missing(
        "o<outer> call\nM2\n",
        &[("outer", "o<outer> sub\no<none> call\no<outer> endsub\n")],
    );
    assert_eq!(caller.as_deref(), Some("subs/outer.ngc, line 2"));
}

#[test]
fn a_loop_that_comes_back_to_the_same_values_is_proved_to_be_endless() {
    let endless = |source: &str| {
        kinds(source, &[])
            .0
            .into_iter()
            .find(|kind| matches!(kind, FaultKind::EndlessLoop { .. }))
    };
    let proved = endless("o1 while [1]\no1 endwhile\nM2\n");
    assert!(
        matches!(proved, Some(FaultKind::EndlessLoop { blocks, proved: true }) if blocks < 100_000),
        "{proved:?}"
    );
    let moves = endless("G21 G0 X0\no1 while [1]\nG0 X1\no1 endwhile\nM2\n");
    assert!(
        matches!(moves, Some(FaultKind::EndlessLoop { proved: false, .. })),
        "{moves:?}"
    );
}

#[test]
fn what_is_known_of_a_position_is_a_number() {
    // the sum of offset and coordinate is larger than any number
    let source = "G21\nG10 L2 P1 X[EXP[709.7]]\nG0 X[EXP[709.7]] Y0\nG4 P1\nG1 Y1 F1\nM2\n";
    let log = run_bytes("linuxcnc", source.as_bytes(), &Setup::default()).1;
    assert_eq!(log.motions.len(), 3, "{:?}", log.motions);
    for motion in &log.motions {
        let known =
            |position: &trunnion_interp::Position| (0..9).all(|axis| position.get(axis).is_none_or(f64::is_finite));
        assert!(known(&motion.start) && known(&motion.end), "{motion:?}");
    }
}

/// A spindle that is switched on takes S of G96 in the unit of then: 300 feet per minute, then 300 m/min.
#[test]
fn a_spindle_that_starts_takes_the_cutting_speed_in_the_unit_of_now() {
    let (feet, metres) = (91.44, 300.0);
    for (between, wanted) in [
        ("", feet),
        ("G21", feet),
        ("G21\nM3", metres),
        ("G21\nM4", metres),
        ("G21\nM5\nM3\nG20", metres),
        ("G21\nM3\nG20\nM3", feet),
        ("G21\nS200 M3", 200.0),
    ] {
        let text = format!("G20 G94\nG96 D9000 S300 M3\n{between}\nG1 X1 F10\n");
        let state = run_bytes("linuxcnc", text.as_bytes(), &Setup::default()).1.state;
        let found = state.and_then(|state| state.spindle.cutting_speed_m_min());
        assert!(
            found.is_some_and(|found| (found - wanted).abs() < 1e-9),
            "{between}: {found:?}"
        );
    }
}
