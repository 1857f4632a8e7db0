//! The built-in tables say what they should.
use crate::{Action, BUILTIN_NAMES, Code, CodeKind, Dialect, Owner, Role, builtin};
use trunnion_syntax::Format;

fn dialect(name: &str) -> &'static Dialect {
    builtin(name).unwrap()
}

fn action(name: &str, id: &str) -> Option<Action> {
    find(name, id).map(|code| code.action)
}

fn find(name: &str, id: &str) -> Option<&'static Code> {
    dialect(name).codes().iter().find(|code| code.id == id)
}

#[test]
fn every_built_in_table_loads_under_its_name() {
    for &name in BUILTIN_NAMES {
        assert_eq!(dialect(name).name, name);
        assert!(!dialect(name).title.is_empty());
        assert!(!dialect(name).arc.source.is_empty());
        assert!(dialect(name).arc.mm > 0.0);
    }
    assert!(builtin("no-such-control").is_none());
    assert!(builtin("").is_none());
}

#[test]
fn look_up_finds_exactly_the_codes_of_the_list() {
    for &name in BUILTIN_NAMES {
        let dialect = dialect(name);
        for tenths in 0..10_100 {
            let id = |letter: char| match tenths % 10 {
                0 => format!("{letter}{}", tenths / 10),
                _ => format!("{letter}{}.{}", tenths / 10, tenths % 10),
            };
            let listed =
                |kind: CodeKind, id: &str| dialect.codes().iter().any(|code| code.kind == kind && code.id == id);
            assert_eq!(
                dialect.g(tenths).map(|code| code.id.clone()).is_some(),
                listed(CodeKind::G, &id('G')),
                "{name} {tenths}"
            );
            assert_eq!(
                dialect.m(tenths).map(|code| code.id.clone()).is_some(),
                listed(CodeKind::M, &id('M')),
                "{name} {tenths}"
            );
            assert!(dialect.g(tenths).is_none_or(|code| code.id == id('G')));
        }
        for code in dialect.codes().iter().filter(|code| code.kind == CodeKind::Name) {
            assert_eq!(dialect.name(&code.id).unwrap().id, code.id);
            assert_eq!(dialect.name(&code.id.to_ascii_lowercase()).unwrap().id, code.id);
        }
        assert!(dialect.g(u32::MAX).is_none());
        assert!(dialect.m(u32::MAX).is_none());
    }
}

#[test]
fn every_code_is_documented_with_a_source_and_a_known_group() {
    for &name in BUILTIN_NAMES {
        let dialect = dialect(name);
        for code in dialect.codes() {
            assert!(
                code.doc.len() > 3 && !code.doc.ends_with('.') && !code.doc.contains('\n'),
                "{name} {}",
                code.id
            );
            assert!(!code.source.is_empty(), "{name} {}", code.id);
            assert!(
                code.group
                    .as_ref()
                    .is_none_or(|group| dialect.groups.contains_key(group)),
                "{name} {}",
                code.id
            );
        }
    }
}

#[test]
fn a_frame_that_is_reset_is_in_the_group_of_its_reset() {
    for &name in BUILTIN_NAMES {
        let codes = dialect(name).codes();
        for reset in codes.iter().filter(|code| code.action == Action::FrameReset) {
            // a change by a name that has no arguments (DIAMON) is `not-modelled`: a `frame-change` without arguments ends
            let changes = |code: &&Code| {
                matches!(
                    code.action,
                    Action::FrameChange | Action::FrameLost | Action::NotModelled | Action::SubprogramCall
                )
            };
            let ended = codes.iter().filter(changes).any(|code| code.group == reset.group);
            assert!(reset.group.is_some() && ended, "{name} {}", reset.id);
        }
    }
}

#[test]
fn motion_codes_are_the_same_everywhere() {
    for name in ["iso-6983", "linuxcnc", "fanuc-30i", "sinumerik-840d"] {
        let expected = [
            ("G0", Action::Rapid),
            ("G1", Action::Linear),
            ("G2", Action::ArcClockwise),
            ("G3", Action::ArcCounterClockwise),
            ("G4", Action::Dwell),
            ("G17", Action::PlaneXy),
            ("G18", Action::PlaneZx),
            ("G19", Action::PlaneYz),
            ("G40", Action::CompensationOff),
            ("G41", Action::CompensationLeft),
            ("G42", Action::CompensationRight),
            ("G53", Action::MachineCoordinates),
            ("G54", Action::WorkOffset),
            ("G90", Action::Absolute),
            ("G91", Action::Incremental),
            ("G93", Action::FeedInverseTime),
            ("G94", Action::FeedPerMinute),
            ("G95", Action::FeedPerRevolution),
            ("M3", Action::SpindleClockwise),
            ("M4", Action::SpindleCounterClockwise),
            ("M5", Action::SpindleStop),
            ("M6", Action::ToolChange),
            ("M30", Action::ProgramEnd),
        ];
        for (id, expected) in expected {
            assert_eq!(action(name, id), Some(expected), "{name} {id}");
        }
    }
}

#[test]
fn controls_differ_where_their_manuals_do() {
    assert_eq!(action("sinumerik-840d", "G70"), Some(Action::InchLengthsOnly));
    assert_eq!(action("sinumerik-840d", "G700"), Some(Action::Inch));
    assert_eq!(action("sinumerik-840d", "G20"), None);
    assert_eq!(action("sinumerik-840d", "G43"), None);
    assert_eq!(action("fanuc-30i", "G70"), None);
    assert_eq!(action("fanuc-30i", "G71"), None);
    assert_eq!(action("fanuc-30i", "G20"), Some(Action::Inch));
    assert_eq!(action("fanuc-30i", "G43.4"), Some(Action::TcpOn));
    assert_eq!(action("fanuc-30i", "G43.5"), Some(Action::TcpVectorOn));
    assert_eq!(action("linuxcnc", "G43.4"), None);
    assert_eq!(action("linuxcnc", "G70"), Some(Action::NotModelled));
    assert_eq!(action("iso-6983", "G70"), Some(Action::Inch));
    assert_eq!(action("iso-6983", "G43.4"), None);
    assert_eq!(action("linuxcnc", "M428"), Some(Action::Kinematics));
    assert_eq!(find("linuxcnc", "M428").unwrap().owner, Owner::MachineBuilder);
    assert_eq!(action("sinumerik-840d", "TRAORI"), Some(Action::TcpOn));
    assert_eq!(action("sinumerik-840d", "G500"), Some(Action::WorkOffsetNone));
    assert_eq!(action("sinumerik-840d", "G505"), Some(Action::WorkOffset));
    assert_eq!(action("sinumerik-840d", "G599"), Some(Action::WorkOffset));
    assert_eq!(action("sinumerik-840d", "G600"), None);
    assert_eq!(dialect("sinumerik-840d").role(b'R'), Some(Role::Variable));
    assert_eq!(dialect("fanuc-30i").role(b'R'), Some(Role::ArcRadius));
    assert_eq!(dialect("linuxcnc").role(b'@'), Some(Role::NotModelled));
    assert_eq!(dialect("iso-6983").role(b'@'), None);
    assert_eq!(dialect("iso-6983").role(b'x'), None);
    assert_eq!(dialect("apt").lex.format, Format::Apt);
    assert!(!dialect("sinumerik-840d").lex.paren_comment);
    assert!(dialect("linuxcnc").lex.blanks_in_numbers);
}

#[test]
fn lathe_systems_give_one_code_different_meanings() {
    let systems = ["fanuc-30i-lathe-a", "fanuc-30i-lathe-b", "fanuc-30i-lathe-c"];
    let of = |id: &str| systems.map(|name| action(name, id));
    let all = |action| [Some(action); 3];
    assert_eq!(
        of("G90"),
        [
            Some(Action::TurningCycle),
            Some(Action::Absolute),
            Some(Action::Absolute)
        ]
    );
    assert_eq!(
        of("G92"),
        [
            Some(Action::ThreadingCycle),
            Some(Action::PositionSet),
            Some(Action::PositionSet)
        ]
    );
    assert_eq!(
        of("G94"),
        [
            Some(Action::FacingCycle),
            Some(Action::FeedPerMinute),
            Some(Action::FeedPerMinute)
        ]
    );
    assert_eq!(
        of("G98"),
        [
            Some(Action::FeedPerMinute),
            Some(Action::ReturnInitial),
            Some(Action::ReturnInitial)
        ]
    );
    assert_eq!(
        of("G50"),
        [
            Some(Action::PositionSet),
            Some(Action::ScalingOff),
            Some(Action::ScalingOff)
        ]
    );
    assert_eq!(
        of("G70"),
        [Some(Action::FinishCycle), Some(Action::FinishCycle), Some(Action::Inch)]
    );
    assert_eq!(
        of("G20"),
        [Some(Action::Inch), Some(Action::Inch), Some(Action::TurningCycle)]
    );
    assert_eq!(
        of("G77"),
        [None, Some(Action::TurningCycle), Some(Action::GroovePeckCycle)]
    );
    assert_eq!(of("G1"), all(Action::Linear));
    assert_eq!(
        systems.map(|name| dialect(name).role(b'U')),
        [Some(Role::Increment), Some(Role::Axis), Some(Role::Axis)]
    );
    assert!(
        systems
            .iter()
            .all(|name| dialect(name).quirks.diameter && dialect(name).quirks.dwell_in_ms)
    );
}

#[test]
fn haas_and_grbl_have_their_own_lists() {
    assert_eq!(action("haas-ngc", "G70"), Some(Action::BoltCircle));
    assert_eq!(action("haas-ngc", "G154"), Some(Action::WorkOffset));
    assert_eq!(action("haas-ngc", "G129"), Some(Action::WorkOffset));
    assert_eq!(action("haas-ngc", "G54.1"), None);
    assert_eq!(action("haas-ngc", "G43.4"), None);
    assert_eq!(action("haas-ngc", "G234"), Some(Action::TcpOn));
    assert_eq!(action("haas-ngc", "M97"), Some(Action::SubprogramCall));
    assert!(
        dialect("haas-ngc").alarm("peck-missing").is_none(),
        "alarms of another control"
    );
    assert_eq!(
        dialect("fanuc-30i-lathe-b").alarm("peck-missing").unwrap().number,
        "PS0045"
    );
    let grbl: Vec<_> = dialect("grbl").codes().iter().map(|code| code.id.as_str()).collect();
    let list = "G0 G1 G2 G3 G4 G10 G17 G18 G19 G20 G21 G28 G28.1 G30 G30.1 G38.2 G38.3 G38.4 G38.5 G40 G43.1 G49 G53 G54 G55 G56 \
                G57 G58 G59 G61 G80 G90 G91 G91.1 G92 G92.1 G93 G94 M0 M1 M2 M3 M4 M5 M7 M8 M9 M30 M56";
    assert_eq!(grbl, list.split_whitespace().collect::<Vec<_>>());
    assert_eq!(dialect("grbl").role(b'A'), None);
    assert!((dialect("grbl").arc_limit_mm(1000.0, false) - 0.5).abs() < 1e-12);
}

#[test]
fn names_with_digits_are_whole_words() {
    let sinumerik = dialect("sinumerik-840d");
    assert_eq!(sinumerik.name("cycle832").unwrap().id, "CYCLE832");
    assert_eq!(sinumerik.name("Cycle800").unwrap().action, Action::SwivelCycle);
    assert!(sinumerik.name("CYCLE8321").is_none());
    assert!(sinumerik.name("CYCLE").is_none());
    assert!(sinumerik.name("").is_none());
    assert!(sinumerik.name("TRAORI\u{e9}").is_none());
    let fanuc = dialect("fanuc-30i");
    assert_eq!(fanuc.name("DO1").unwrap().id, "DO");
    assert_eq!(fanuc.name("goto900").unwrap().id, "GOTO");
    assert!(fanuc.name("900").is_none());
    assert!(sinumerik.name("GOTO900").is_none());
}

#[test]
fn addresses_with_equals() {
    let sinumerik = dialect("sinumerik-840d");
    assert_eq!(sinumerik.named_role(b"cr"), Some(Role::ArcRadius));
    assert_eq!(sinumerik.named_role(b"TURN"), Some(Role::ArcTurns));
    assert_eq!(sinumerik.named_role(b"A3"), Some(Role::ToolVector));
    assert_eq!(sinumerik.named_role(b"A2"), Some(Role::NotModelled));
    assert_eq!(sinumerik.named_role(b"R1"), Some(Role::Variable));
    assert_eq!(sinumerik.named_role(b"R999"), Some(Role::Variable));
    assert_eq!(sinumerik.named_role(b"r"), None);
    assert_eq!(sinumerik.named_role(b"R1A"), None);
    assert_eq!(sinumerik.named_role(b"R#"), Some(Role::Variable));
    assert_eq!(sinumerik.named_role(b""), None);
    assert_eq!(sinumerik.named_role(b"XNOW"), None);
}

#[test]
fn arcs_are_judged_as_the_control_does() {
    let linuxcnc = dialect("linuxcnc");
    // fixed part for small arcs, part of the radius above it, capped
    assert!((linuxcnc.arc_limit_mm(1.0, false) - 0.028_284).abs() < 1e-9);
    assert!((linuxcnc.arc_limit_mm(1000.0, false) - 1.0).abs() < 1e-9);
    assert!((linuxcnc.arc_limit_mm(1e6, false) - 2.8284).abs() < 1e-9);
    let core = dialect("iso-6983");
    assert!((core.arc_limit_mm(1000.0, false) - 0.005).abs() < 1e-12);
    assert!((core.arc_limit_mm(1000.0, true) - 0.0127).abs() < 1e-12);
    let sinumerik = dialect("sinumerik-840d");
    assert!((sinumerik.arc_limit_mm(5.0, false) - 0.01).abs() < 1e-12);
    assert!((sinumerik.arc_limit_mm(50.0, false) - 0.05).abs() < 1e-12);
}

#[test]
fn builders_own_what_the_control_leaves_them() {
    assert!(dialect("fanuc-30i").builder_may_own(CodeKind::M, 1230));
    assert!(!dialect("fanuc-30i").builder_may_own(CodeKind::M, 980));
    assert!(!dialect("fanuc-30i").builder_may_own(CodeKind::G, 1230));
    assert!(dialect("sinumerik-840d").builder_may_own(CodeKind::M, 1000));
    assert!(!dialect("sinumerik-840d").builder_may_own(CodeKind::M, 300));
    assert!(!dialect("iso-6983").builder_may_own(CodeKind::M, 0));
    assert!(dialect("iso-6983").builder_may_own(CodeKind::M, 620));
    assert!(!dialect("linuxcnc").builder_may_own(CodeKind::M, 2000));
}

#[test]
fn hover_names_the_code_its_group_and_its_source() {
    let text = find("fanuc-30i", "G43.4").unwrap().hover();
    assert!(text.starts_with("**G43.4** Tool centre point control"), "{text}");
    assert!(text.contains("Modal group: tool-length"), "{text}");
    assert!(text.contains("Reads: H L"), "{text}");
    assert!(
        text.ends_with("*Fanuc Series 30i/31i/32i operator's manual, machining center system*"),
        "{text}"
    );
    assert!(find("linuxcnc", "M428").unwrap().hover().contains("machine builder"));
    assert!(find("haas-ngc", "G150").unwrap().hover().contains("not modelled"));
}
