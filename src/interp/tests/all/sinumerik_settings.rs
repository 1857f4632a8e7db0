//! CYCLE832 in both forms, positions of the machine as values.
use crate::support::{fault_line, faults, lines, run_bytes};
use trunnion_interp::{Feed, Setup, WorkOffset};

/// Whether each line is one of the tip, its end if known, and what was reported.
fn run(text: &str, setup: &Setup) -> (Vec<(bool, bool)>, Vec<String>) {
    let (program, log) = run_bytes("sinumerik-840d", text.as_bytes(), setup);
    let told = log.faults.iter().map(|fault| fault_line(&program, fault));
    (
        log.motions
            .iter()
            .map(|motion| (motion.tcp, motion.end.xyz().is_some()))
            .collect(),
        told.filter(|fault| fault.contains("NotModelled")).collect(),
    )
}

#[test]
fn the_older_form_of_cycle832_switches_the_transformation() {
    let setup = Setup::default();
    for (before, call, tip) in [
        // new: 0 to 4, and plus 10
        ("", "CYCLE832(0.01,1,1)", false),
        ("TRAORI", "CYCLE832(0.01,12,0.5)", true),
        ("TRAORI", "CYCLE832(0.01,_ORI_FINISH,0.5)", true),
        ("TRAORI", "CYCLE832()", true),
        ("TRAORI", "CYCLE832(0.01)", true),
        // old: the third digit from the right
        ("", "CYCLE832(0.01,112101)", true),
        ("TRAORI", "CYCLE832(0.01,112101)", true),
        ("TRAORI", "CYCLE832(0.01,112001)", false),
        ("", "CYCLE832(0.01,2001)", false),
        ("R1=112101", "CYCLE832(0.01,R1)", true),
    ] {
        let text = format!("{before}\n{call}\nG1 X1 Y2 Z3 F100\n");
        let (found, told) = run(&text, &setup);
        assert_eq!((found, told), (vec![(tip, true)], vec![]), "{text}");
    }
    for mode in ["112201", "112901", "R99"] {
        let text = format!("CYCLE832(0.01,{mode})\nG1 X1 Y2 Z3 F100\nTRAFOOF\nG1 X1 Y2 Z3\n");
        let (found, told) = run(&text, &setup);
        let ends: Vec<bool> = found.iter().map(|(_, known)| *known).collect();
        assert_eq!(ends, [false, true], "{text}: {told:?}");
        assert!(
            told.iter().any(|fault| fault.contains("which transformation")),
            "{told:?}"
        );
    }
}

/// $AA_IM is known where the zero point and the tool's length are declared, $P_TOOLR where the tool is.
#[test]
fn positions_of_the_machine_and_the_radius_of_the_tool() {
    let mut setup = trunnion_interp::Setup::default();
    let mut values = [0.0; 9];
    (values[0], values[2], values[5]) = (100.0, -50.0, 7.0);
    setup.work_offsets.push(trunnion_interp::WorkOffset {
        name: "G54".to_owned(),
        values,
    });
    setup.tools.push(trunnion_interp::Tool {
        number: 1,
        shape: None,
        diameter_mm: Some(12.0),
        length_mm: Some(80.0),
        holder_mm: None,
    });
    let ends = |text: &str, setup: &trunnion_interp::Setup| {
        let log = run_bytes("sinumerik-840d", text.as_bytes(), setup).1;
        log.motions.last().expect("a motion").end
    };
    let head = "G54 G90 G71 T1 D1\nM6\nG1 X1 Y2 Z3 C20 F100\n";
    for (name, x) in [
        ("$AA_IM[X]", Some(101.0)),
        ("$AA_IM[Y]", Some(2.0)),
        // the length of 80 mm lies along Z
        ("$AA_IM[Z]", Some(33.0)),
        ("$AA_IM[C]", Some(27.0)),
        ("$P_TOOLR", Some(6.0)),
    ] {
        assert_eq!(ends(&format!("{head}X={name}"), &setup).get(0), x, "{name}");
        let undeclared = ends(&format!("{head}X={name}"), &trunnion_interp::Setup::default());
        assert_eq!(undeclared.get(0), None, "{name}");
        let other = if name == "$P_TOOLR" { "D2" } else { "TRAORI" };
        assert_eq!(
            ends(&format!("{head}{other}\nX={name}"), &setup).get(0),
            None,
            "{name} {other}"
        );
    }
}

/// Where the axis is after `blocks` from X0 Y0 Z0, with what the setting data say, and what was reported.
fn after(blocks: &str, frames: Option<bool>, lengths: Option<bool>) -> ([Option<f64>; 3], Vec<String>) {
    let mut setup = Setup::default();
    setup.control.increment_adds_frame = frames;
    setup.control.increment_adds_length = lengths;
    for (name, x) in [("G54", 0.0), ("G55", 100.0)] {
        setup.work_offsets.push(WorkOffset {
            name: name.to_owned(),
            values: [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        });
    }
    setup.tools.push(trunnion_interp::Tool {
        number: 1,
        shape: None,
        diameter_mm: None,
        length_mm: Some(80.0),
        holder_mm: None,
    });
    let text = format!("G17 G90 G71 G94 G54 D0\nG1 X0 Y0 Z0 F9\n{blocks}\n");
    let (program, log) = run_bytes("sinumerik-840d", text.as_bytes(), &setup);
    let told = log.faults.iter().map(|fault| fault_line(&program, fault));
    let end = log.motions.last().expect("a motion").end;
    (
        [0, 1, 2].map(|axis| end.get(axis)),
        told.filter(|fault| fault.contains("setting data")).collect(),
    )
}

/// The words are those of the new zero point: there X0 of G54 is X-100 of G55.
#[test]
fn setting_data_say_whether_an_increment_travels_another_offset() {
    for (blocks, axis, travels, stays, data) in [
        ("G91 G55 X5", 0, 5.0, -95.0, "42440"),
        ("G55\nG91 Y1\nX5", 0, 5.0, -95.0, "42440"),
        ("G55\nX=IC(5)", 0, 5.0, -95.0, "42440"),
        ("TRANS X10\nG91 X5", 0, 5.0, -5.0, "42440"),
        ("TRANS X10\nX0\nTRANS\nG91 X5", 0, 5.0, 15.0, "42440"),
    ] {
        assert_eq!(
            after(blocks, Some(true), None),
            (expect(axis, travels, blocks), vec![]),
            "{blocks}"
        );
        assert_eq!(
            after(blocks, Some(false), None),
            (expect(axis, stays, blocks), vec![]),
            "{blocks}"
        );
        let (end, told) = after(blocks, None, Some(true));
        assert_eq!(end[axis], None, "{blocks}");
        assert!(told.len() == 1 && told[0].contains(data), "{blocks}: {told:?}");
    }
    // without another offset, and with an absolute coordinate first, nothing depends on them
    for blocks in ["G54\nG91 X5", "G55 X0\nG91 X5", "G55\nG91 X=AC(0)\nX5", "D0\nG91 X5"] {
        let (end, told) = after(blocks, None, None);
        assert_eq!((end[0], told), (Some(5.0), vec![]), "{blocks}");
    }
}

fn expect(axis: usize, value: f64, blocks: &str) -> [Option<f64>; 3] {
    let mut end = [Some(0.0); 3];
    end[axis] = Some(value);
    if blocks.contains("Y1") {
        end[1] = Some(1.0);
    }
    end
}

#[test]
fn setting_data_say_whether_an_increment_travels_another_length() {
    let blocks = "T1\nM6\nD0\nX0 Y0 Z100\nG91 D1 Z5";
    // the tip is 80 mm below the point before it
    assert_eq!(after(blocks, None, Some(false)).0[2], Some(25.0));
    assert_eq!(after(blocks, None, Some(true)).0[2], Some(105.0));
    let (end, told) = after(blocks, Some(true), None);
    assert_eq!(end[2], None);
    assert!(told.len() == 1 && told[0].contains("42442"), "{told:?}");
    // an edge whose length is not declared
    let other = "T1\nM6\nX0 Y0 Z100\nG91 D2 Z5";
    assert_eq!(after(other, None, Some(true)).0[2], Some(105.0));
    assert_eq!(after(other, None, Some(false)).0[2], None);
    assert_eq!(after("T1\nM6\nX0 Y0 Z100\nG91 D1 Z5", None, None).0[2], Some(105.0));
}

/// Each line is the code and the motion after it.
#[test]
fn a_cutting_speed_sets_the_meaning_of_f() {
    let head = "G17 G90 G71 G94 F100\nG1 X0 Y0 Z0 S500 M3\n";
    for (codes, motion) in [
        ("G97 S2000", "L X10 Y0 Z0"),
        ("G97 S2000 F0.2", "L X10 Y0 Z0 F0.2/rev"),
        ("G96 S200 F0.2", "L X10 Y0 Z0 F0.2/rev"),
        ("G973 S2000 F0.2", "L X10 Y0 Z0 F0.2/rev"),
        ("G961 S200", "L X10 Y0 Z0 F100"),
        ("G971 S2000", "L X10 Y0 Z0 F100"),
        ("G95 F0.3\nG971 S2000 F90", "L X10 Y0 Z0 F90"),
        ("G95 F0.3\nG97 S2000", "L X10 Y0 Z0 F0.3/rev"),
        ("G962 S200", "L X10 Y0 Z0 F100"),
        ("G95 F0.3\nG972 S200", "L X10 Y0 Z0 F0.3/rev"),
        ("G97 S2000\nG94", "L X10 Y0 Z0"),
        ("G942", "L X10 Y0 Z0 F100"),
        ("G95 F0.3\nG942 F90", "L X10 Y0 Z0 F90"),
        ("G952 F0.2", "L X10 Y0 Z0 F0.2/rev"),
        ("G95 F0.3\nG952", "L X10 Y0 Z0 F0.3/rev"),
    ] {
        let text = format!("{head}{codes}\nG1 X10\n");
        let found = lines("sinumerik-840d", &text);
        assert_eq!(found.last().map(String::as_str), Some(motion), "{codes}");
        let missing = faults("sinumerik-840d", &text)
            .iter()
            .any(|fault| fault.contains("MissingFeed"));
        assert_eq!(missing, !motion.contains('F'), "{codes}");
    }
}

/// F is a time, and not modelled, until another code of the group comes.
#[test]
fn a_feed_by_travel_time_is_unknown() {
    let feed = |codes: &str| {
        let text = format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\n{codes}\nG1 X10\n");
        let (_, log) = run_bytes("sinumerik-840d", text.as_bytes(), &Setup::default());
        log.motions.last().map(|motion| motion.feed)
    };
    assert_eq!(feed("G931 F2"), Some(Feed::Unknown));
    assert_eq!(feed("G931"), Some(Feed::Unknown));
    assert_eq!(feed("G931 F2\nG94 F80"), Some(Feed::PerMinute(80.0)));
    assert_eq!(feed("G942 F80"), Some(Feed::PerMinute(80.0)));
}

#[test]
fn a_feed_profile_another_spindle_and_an_alarm_do_not_pass_in_silence() {
    let head = "G17 G90 G71 G94 F100\nG1 X0 Y0 Z0 S500 M3\n";
    for profile in ["FLIN", "FCUB", "FPO"] {
        let text = format!("{head}{profile}\nG1 X10 F200\nFNORM\nX20 F300\n");
        assert_eq!(
            lines("sinumerik-840d", &text)[1..],
            ["L X10 Y0 Z0", "L X20 Y0 Z0 F300"],
            "{profile}"
        );
        assert_eq!(faults("sinumerik-840d", &text).len(), 1, "{profile}");
    }
    let spindle = |text: &str| {
        let motion = crate::support::run_text("sinumerik-840d", text)
            .motions
            .pop()
            .expect("a motion");
        (motion.spindle_on, motion.spindle_rpm)
    };
    assert_eq!(spindle(&format!("{head}SETMS(2)\nX10\n")), (None, None));
    assert_eq!(
        spindle(&format!("{head}SETMS(2)\nS900 M3\nX10\n")),
        (Some(true), Some(900.0))
    );
    let alarm = faults("sinumerik-840d", &format!("{head}SETAL(65000)\nX10\n"));
    assert!(alarm.len() == 1 && alarm[0].contains("SETAL"), "{alarm:?}");
}

/// G75: the values of the axes do not count, and neither do zero points, frames and the tool's length (SINUMERIK ONE, NC programming, 12/2019, p. 361).
#[test]
fn fixed_points_are_reached_in_machine_coordinates() {
    let mut setup = Setup::default();
    let mut first = trunnion_interp::Position::default();
    for (axis, value) in [(0, -500.0), (1, -400.0), (2, 300.0)] {
        first.set(axis, value);
    }
    let mut second = trunnion_interp::Position::default();
    second.set(2, 250.0);
    setup.control.fixed_points = Some(vec![first, second]);
    setup.work_offsets = vec![WorkOffset {
        name: "G54".to_owned(),
        values: [10.0, 20.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    }];
    let run = |text: &str| {
        let (program, log) = run_bytes("sinumerik-840d", text.as_bytes(), &setup);
        let motions: Vec<_> = log.motions.iter().map(crate::support::line).collect();
        let faults = log.faults.iter().map(|fault| fault_line(&program, fault));
        (
            motions,
            faults.filter(|fault| fault.contains("NotModelled")).collect::<Vec<_>>(),
        )
    };
    let head = "G54 G90 G1 F100\nG0 X1 Y2 Z3\n";
    for (turned, block, ends) in [
        ("", "G75 Z0", ["R X11 Y22 Z300 machine", "L X4 Y2 Z270 F100"]),
        (
            "",
            "G75 FP=1 X0 Y0",
            ["R X-500 Y-400 Z33 machine", "L X4 Y-420 Z3 F100"],
        ),
        ("", "G75 FP=2 Z99", ["R X11 Y22 Z250 machine", "L X4 Y2 Z220 F100"]),
        ("G91", "G75 Z-5", ["R X11 Y22 Z300 machine", "L X5 Y2 Z270 F100"]),
        ("TRANS Z7", "G75 Z0", ["R X11 Y22 Z300 machine", "L X4 Y2 Z263 F100"]),
    ] {
        let (motions, faults) = run(&format!("{head}{turned}\n{block}\nG1 X4\nM30\n"));
        let own: Vec<_> = motions.iter().rev().take(2).rev().cloned().collect();
        assert_eq!(
            (own, faults),
            (ends.map(str::to_owned).to_vec(), vec![]),
            "{turned} {block}"
        );
    }
    let (motions, faults) = run(&format!("{head}G75 FP=2\nG1 X4\nM30\n"));
    assert_eq!(motions.last().map(String::as_str), Some("L X4 F100"), "{motions:?}");
    assert!(faults.len() == 1 && faults[0].contains("without an axis"), "{faults:?}");
    // what is not declared, or cannot be so: the axes that are named are unknown, the others are not
    for (block, why) in [
        ("G75 FP=3 Z0", "fixed point 3: its position is not declared"),
        ("G75 FP=2 X0", "fixed point 2: its position is not declared"),
        ("G75 FP=0 Z0", "FP is not a whole number"),
        ("G75 FP=1.5 Z0", "FP is not a whole number"),
        ("TRAORI\nG75 Z0", "while a transformation is active"),
    ] {
        let (motions, faults) = run(&format!("{head}{block}\nG1 X4 Y5\nM30\n"));
        assert!(faults.len() == 1 && faults[0].contains(why), "{block}: {faults:?}");
        let lost = &motions[motions.len() - 2];
        let axis = if block.contains('Z') { 'Z' } else { 'X' };
        assert!(lost.starts_with('U') && !lost.contains(axis), "{block}: {motions:?}");
    }
    // both reasons are said, and an axis by its name in the machine moves no less
    let (_, faults) = run(&format!("{head}G75 FP=3 Z0\nG75 FP=4 Z0\nTRAORI\nG75 Z0\nM30\n"));
    assert!(faults.len() == 2 && faults[1].contains("transformation"), "{faults:?}");
    let (motions, faults) = run(&format!("{head}G75 X0 Z1=0\nG1 X4\nM30\n"));
    assert!(faults.iter().any(|fault| fault.contains("Z1=0")), "{faults:?}");
    assert_eq!(motions.last().map(String::as_str), Some("L X4 F100"), "{motions:?}");
}

/// S1= and M1= are words of the main spindle where the machine says which one that is; S0= always is.
#[test]
fn words_of_a_spindle_by_its_number() {
    let head = "G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\n";
    let run = |main: Option<u32>, text: &str| {
        let mut setup = Setup::default();
        setup.control.main_spindle = main;
        let (program, log) = run_bytes("sinumerik-840d", format!("{head}{text}\nX10\n").as_bytes(), &setup);
        let told = log.faults.iter().map(|fault| fault_line(&program, fault));
        let told = told.filter(|fault| fault.contains("NotModelled")).count();
        let motion = log.motions.last().copied().expect("a motion");
        (motion.spindle_on, motion.spindle_rpm, told)
    };
    assert_eq!(run(Some(1), "S1=900 M1=3"), (Some(true), Some(900.0), 0));
    assert_eq!(run(None, "S0=900 M0=3"), (Some(true), Some(900.0), 0));
    assert_eq!(run(Some(1), "S900 M3\nS2=500 M2=5"), (Some(true), Some(900.0), 2));
    assert_eq!(run(None, "S900 M3\nS1=500 M1=5"), (None, None, 2));
    assert_eq!(run(Some(1), "S900 M3\nSETMS(2)\nS1=500"), (None, None, 1));
    assert_eq!(
        run(Some(1), "SETMS(2)\nS2=400 M2=4\nS1=500"),
        (Some(true), Some(400.0), 1)
    );
    assert_eq!(run(Some(1), "S900 M3\nSETMS(1)\nSETMS"), (Some(true), Some(900.0), 0));
    assert_eq!(run(Some(2), "R1=$P_MSNUM\nS=R1 M3"), (Some(true), Some(2.0), 0));
    // what other functions with a number do is the machine builder's
    assert_eq!(run(Some(1), "S900 M3\nM1=8").2, 1);
}
