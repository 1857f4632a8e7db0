//! Macro B: jumps, loops and calls, checked by hand.
use crate::support::{faults, lines, run_bytes, run_text};
use trunnion_interp::{FaultKind, Limits, ProgramRun, Refusal, Setup};

const FANUC: &str = "fanuc-30i";

/// Refusals with their alarm, other facts by their name.
pub(crate) fn said(source: &str) -> Vec<String> {
    let (program, log) = run_bytes(FANUC, source.as_bytes(), &Setup::default());
    let facts = log.faults.iter().filter_map(|fault| {
        let line = fault.block.0 + 1;
        let text = program.text(fault.range).trim().to_owned();
        Some(match &fault.kind {
            FaultKind::MissingProgramEnd | FaultKind::AmbiguousDecimal => return None,
            FaultKind::Rejected { refusal, alarm, .. } => {
                format!("{line} `{text}` {refusal:?} {}", alarm.clone().unwrap_or_default())
            }
            FaultKind::NotDecided { what } => format!("{line} `{text}` not decided: {what}"),
            FaultKind::NotModelled { what } => format!("{line} `{text}` not modelled: {what}"),
            FaultKind::ProgramAlarm { message } => format!("{line} alarm {message}"),
            FaultKind::EndlessLoop { .. } => format!("{line} `{text}` endless"),
            other => format!("{line} `{text}` {other:?}"),
        })
    });
    facts.collect()
}

fn clean(source: &str) -> Vec<String> {
    assert_eq!(said(source), [""; 0], "{source}");
    lines(FANUC, source)
}

#[test]
fn a_while_loop_runs_while_its_condition_holds() {
    let source = "#1=0\nWHILE[#1LT3]DO1\nG0X[#1*10]\n#1=#1+1\nEND1\nY1.\nM30\n";
    assert_eq!(clean(source), ["R X0", "R X10", "R X20", "R X20 Y1"]);
    let never = "#1=5\nWHILE[#1LT3]DO1\nG0X1.\nEND1\nG0Y1.\nM30\n";
    assert_eq!(clean(never), ["R Y1"]);
}

#[test]
fn a_jump_back_to_the_program_number_does_not_end_the_program() {
    // wherever the number is in the file
    for before in ["", "\n", "(c)\n", "%\n"] {
        let source = format!("{before}O1 #1=0\nN5 G0X#1\n#1=#1+1\nIF[#1LT3]GOTO5\nM30\n");
        assert_eq!(clean(&source), ["R X0", "R X1", "R X2"], "{source}");
        let source = format!("{before}O1 N5 #1=#1+1\nIF[#1EQ0]THEN#1=1\nG0X#1\nIF[#1LT3]GOTO5\nM30\n");
        assert_eq!(clean(&source), ["R X1", "R X2", "R X3"], "{source}");
        let source = format!("{before}O1 DO1\nG0X1.\nEND1\nM30\n");
        let said = said(&source);
        assert!(said.iter().any(|line| line.ends_with("endless")), "{source}: {said:?}");
    }
}

/// `:50` is O50: what comes after it is another program.
#[test]
fn a_colon_begins_a_program_as_o_does() {
    for number in ["O50", ":50", ":0050"] {
        let source = format!("%\n:1\nG0X1.\n{number}\nG0X9.\nM30\n%\n");
        assert_eq!(lines(FANUC, &source), ["R X1"], "{number}");
    }
}

#[test]
fn loops_nest_three_deep_and_numbers_are_used_again() {
    let source = "#1=0\nWHILE[#1LT2]DO1\n#2=0\nWHILE[#2LT2]DO2\n#3=0\nWHILE[#3LT2]DO3\nG0X[#1*100+#2*10+#3]\n#3=#3+1\nEND3\n#2=#2+1\nEND2\n\
                  #1=#1+1\nEND1\nWHILE[#1LT3]DO1\nG0Y1.\n#1=#1+1\nEND1\nM30\n";
    assert_eq!(
        clean(source),
        [
            "R X0",
            "R X1",
            "R X10",
            "R X11",
            "R X100",
            "R X101",
            "R X110",
            "R X111",
            "R X111 Y1"
        ]
    );
}

#[test]
fn goto_leaves_a_loop_and_goes_forward_before_it_goes_back() {
    let source = "#1=0\nWHILE[1EQ1]DO1\n#1=#1+1\nIF[#1EQ3]GOTO20\nEND1\nG0X99.\nN20G0X#1\nM30\n";
    assert_eq!(clean(source), ["R X3"]);
    // no source says which one a jump leads to
    let twice = "N10 #1=#1+1\nG0X#1\nIF[#1GT1]GOTO20\nGOTO10\nN20G0Y1.\nN10G0Z1.\nM30\n";
    let told = crate::support::faults("fanuc-30i", twice);
    assert!(
        told.iter().any(|fault| fault.contains("which of the blocks N10")),
        "{told:?}"
    );
    assert_eq!(
        clean("#1=30\nGOTO#1\nN20G0X20.\nM30\nN30G0X30.\nGOTO[#1-10]\n"),
        ["R X30", "R X20"]
    );
}

#[test]
fn then_assigns_where_the_condition_holds() {
    let source = "#1=5\nIF[#1GT3]THEN#2=10\nIF[#1LT3]THEN#2=20\nIF [#1 EQ #0] THEN #2=30\nG0X#2\nM30\n";
    assert_eq!(clean(source), ["R X10"]);
}

#[test]
fn both_forms_of_m98_repeat() {
    let sub = "M30\nO1000\nG91G0X1.\nM99\n";
    let long = clean(&format!("G90G0X0.\nM98P1000L3\nG90Y5.\n{sub}"));
    assert_eq!(long, ["R X0", "R X1", "R X2", "R X3", "R X3 Y5"]);
    assert_eq!(clean(&format!("G90G0X0.\nM98P31000\nG90Y5.\n{sub}")), long);
    assert_eq!(clean(&format!("G90G0X0.\nM98P1000\n{sub}")), ["R X0", "R X1"]);
}

#[test]
fn a_call_waits_for_the_motion_of_its_block() {
    assert_eq!(clean("G0X5.M98P1\nM30\n:1\nY[#5001+1]\nM99\n"), ["R X5", "R X5 Y6"]);
}

#[test]
fn a_subprogram_shares_local_variables_a_macro_has_its_own() {
    assert_eq!(clean("#1=1\nM98P2\nG0X#1\nM30\nO2\n#1=7\nM99\n"), ["R X7"]);
    assert_eq!(
        clean("#1=1\n#100=0\nG65P2A5.\nG0X#1Y#100\nM30\nO2\n#100=#1\n#1=7\nM99\n"),
        ["R X1 Y5"]
    );
}

#[test]
fn m99_p_goes_on_elsewhere_in_the_caller() {
    assert_eq!(clean("M98P3\nG0X1.\nN50G0Y1.\nM30\nO3\nM99P50\n"), ["R Y1"]);
}

#[test]
fn arguments_of_both_specifications() {
    let show = "M30\nO9\nG0X#1Y#2Z#3\nX#4Y#5Z#6\nX#7Y#8Z#9\nX#24Y#25Z#26\nM99\n";
    let first = format!("G65P9A1.B2.C3.I4.J5.K6.D7.E8.F9.X24.Y25.Z26.\n{show}");
    assert_eq!(
        clean(&first),
        ["R X1 Y2 Z3", "R X4 Y5 Z6", "R X7 Y8 Z9", "R X24 Y25 Z26"]
    );
    let second = format!("G65P9A1.B2.C3.I4.J5.K6.I7.J8.K9.\n{show}");
    assert_eq!(clean(&second), ["R X1 Y2 Z3", "R X4 Y5 Z6", "R X7 Y8 Z9"]);
    // B-63684EN/01, p. 278: I4.0 and D5.0 both are #7, the later counts; #3, #5, #6 stay vacant
    let mixed = "#500=0\nG65A1.0B2.0I-3.0I4.0D5.0P1000\nM30\nO1000\nIF[#3NE#0]THEN#500=1\nIF[#5NE#0]THEN#500=1\n\
                 G0X#1Y#2Z#4\nX#7Y#500\nM99\n";
    assert_eq!(clean(mixed), ["R X1 Y2 Z-3", "R X5 Y0 Z-3"]);
}

#[test]
fn an_argument_without_a_point_is_ambiguous() {
    let got = faults(FANUC, "G65P9A10B1.S100\nM30\nO9\nG0X#1\nM99\n");
    assert_eq!(got, ["1: A10: AmbiguousDecimal"]);
}

#[test]
fn a_modal_macro_runs_after_each_motion() {
    let source = "G90G0X0.Y0.\nG66P7Z-2.R1.\nX10.\nX20.\nG67\nX30.\nM30\nO7\nG91G0Y#18\nG90M99\n";
    assert_eq!(
        clean(source),
        ["R X0 Y0", "R X10 Y0", "R X10 Y1", "R X20 Y1", "R X20 Y2", "R X30 Y2"]
    );
}

/// Each modal call would call those before it after every motion.
#[test]
fn modal_macros_are_no_more_than_calls_may_be_deep() {
    let source = |count: usize| format!("{}G1F9.X1.\nM30\nO7\nM99\n", "G66P7\n".repeat(count));
    assert!(
        faults(FANUC, &source(6))[0].contains("more than 5 modal macro calls are active"),
        "{:?}",
        faults(FANUC, &source(6))
    );
    assert_eq!(faults(FANUC, &source(5).replacen("M30", "G67M30", 1)), [""; 0]);
}

#[test]
fn the_chain_names_every_call() {
    let source = "N1M98P1\nM30\nO1\nN2G65P2A1.\nM99\nO2\nG0X#1\nM99\n";
    let dialect = trunnion_dialect::builtin(FANUC).expect("built in");
    let program = trunnion_syntax::parse(source.as_bytes().to_vec(), dialect.lex);
    let mut log = crate::support::Log::default();
    let mut interpreter = trunnion_interp::Interpreter::new(dialect, &Setup::default());
    while interpreter.advance(&program, &mut log).is_some() {}
    let frames = interpreter.chain(log.motions[0].chain);
    let got: Vec<_> = frames
        .iter()
        .map(|frame| format!("{}:{}", frame.line, frame.what))
        .collect();
    assert_eq!(got, ["1:N1M98P1", "4:N2G65P2A1."]);
    assert_eq!(
        log.motions[0].block.0, 6,
        "the block of the motion itself, in the same file"
    );
}

#[test]
fn mistakes_of_structure_have_their_alarms() {
    assert_eq!(said("#1=0\nGOTO99\nM30\n"), ["2 `99` Label PS0078"]);
    assert_eq!(said("WHILE[1EQ1]DO1\nG0X1.\nM30\n"), ["1 `DO1` Structure PS0124"]);
    assert_eq!(said("#1=1\nWHILE[#1LT3]DO4\n#1=#1+1\nEND4\nM30\n").len(), 2);
    assert_eq!(said("G0X1.\nEND1\nM30\n"), ["2 `END1` Structure "]);
    assert_eq!(
        said("#1=1\nWHILE[#1LT2]DO1\nWHILE[#1LT2]DO2\nEND1\nEND2\nM30\n"),
        ["4 `END1` Structure PS0124", "5 `END2` Structure "]
    );
    assert_eq!(
        said("GOTO5\nWHILE[1EQ1]DO1\nN5G0X1.\nEND1\nM30\n"),
        ["1 `5` Structure "]
    );
    assert_eq!(said("M98\nM30\n"), ["1 `M98` MissingWord PS0076"]);
    assert_eq!(said("G65A1.\nM30\n"), ["1 `G65` MissingWord PS0076"]);
    assert_eq!(said("G0X1.#1=5\nM30\n"), ["1 `#1=5` Structure PS0127"]);
    assert_eq!(
        said("M98P5\nM30\nO5\nG0X1.\nO6\nM99\n"),
        ["4 `G0X1.` ProgramEnd PS5010"]
    );
}

#[test]
fn calls_are_bounded_as_on_the_control() {
    let own = "M98P5\nM30\nO5\nM98P5\nM99\n";
    assert_eq!(said(own), ["4 `M98P5` Subprogram PS0077"]);
    let macros = "G65P5\nM30\nO5\nG65P5\nM99\n";
    assert_eq!(said(macros), ["4 `G65P5` Subprogram PS0077"]);
}

#[test]
fn endless_loops_are_told_at_the_line_that_opens_them() {
    let setup = Setup {
        limits: Limits {
            blocks: 1000,
            ..Limits::default()
        },
        ..Setup::default()
    };
    let endless = |source: &str| -> Vec<_> {
        let (program, log) = run_bytes(FANUC, source.as_bytes(), &setup);
        let found = log.faults.iter().filter_map(|fault| match fault.kind {
            FaultKind::EndlessLoop { blocks, proved } => {
                assert_eq!(proved, blocks < 1000);
                Some((fault.block.0 + 1, program.text(fault.range).into_owned(), blocks))
            }
            _ => None,
        });
        found.collect()
    };
    // two turns that are alike prove it
    assert_eq!(
        endless("#1=0\nWHILE[1]DO1\nEND1\nM30\n"),
        [(2, "WHILE[1]DO1".to_owned(), 4)]
    );
    assert_eq!(endless("N10#1=1\nN20\nGOTO20\nM30\n"), [(2, "N20".to_owned(), 4)]);
    let outer = "WHILE[1]DO1\n#2=0\nWHILE[#2LT3]DO2\n#2=#2+1\nEND2\nEND1\nM30\n";
    assert_eq!(endless(outer), [(1, "WHILE[1]DO1".to_owned(), 1007)]);
    let counts = "#1=0\nWHILE[#1GE0]DO1\n#1=#1+1\nEND1\nM30\n";
    assert_eq!(endless(counts), [(2, "WHILE[#1GE0]DO1".to_owned(), 1005)]);
    // a loop that ends is none, however often it turns without a change of its own
    assert_eq!(endless("M98P2L100\nM30\nO2\nG91G0X1.\nM99\n"), []);
}

#[test]
fn what_is_not_known_decides_nothing_and_says_why() {
    assert_eq!(
        said("IF[#500GT1]GOTO10\nG0X1.\nN10M30\n"),
        ["1 `[#500GT1]` not decided: #500: read before the program assigns it"]
    );
    assert_eq!(
        said("#100=#5061+1.\nWHILE[#100LT1]DO1\nEND1\nM30\n"),
        ["2 `[#100LT1]` not decided: #100: from #5061: the result of probing"]
    );
    assert_eq!(
        said("G0X#500\nM30\n"),
        ["1 `#500` not modelled: #500: read before the program assigns it"]
    );
}

#[test]
fn an_alarm_of_the_program_ends_the_run() {
    let source = "G0X1.\n#1=4\nIF[#1LT5]THEN#3000=12(TOO SMALL)\nG0X2.\nM30\n";
    assert_eq!(said(source), ["3 alarm 3012 TOO SMALL"]);
    assert_eq!(lines(FANUC, source), ["R X1"]);
    assert_eq!(clean("#3006=1(LOOK)\nG0X2.\nM30\n"), ["R X2"]);
}

#[test]
fn blocks_that_never_ran_are_read() {
    let source = "GOTO10\nG0 X1. CR=5\nN10 M30\nO55\nG0 X1. X2.\n#1=[1+\nFROB\nM99\n%\nG0 X1. X2.\n";
    let got = said(source);
    let expected = ["2 `CR=5` UnknownWord", "5 `X2.` RepeatedWord"];
    for line in expected {
        assert!(got.iter().any(|found| found == line), "{line} in {got:?}");
    }
    assert!(
        got.iter()
            .any(|found| found.starts_with("6 ") && found.contains("PS0114")),
        "{got:?}"
    );
    assert!(got.iter().any(|found| found.starts_with("7 `FROB`")), "{got:?}");
    assert!(
        !got.iter().any(|found| found.starts_with("10 ")),
        "behind the end mark: {got:?}"
    );
}

#[test]
fn a_loop_tells_each_fault_once() {
    let source = "#1=0\nWHILE[#1LT50]DO1\nG1X1.CR=5\nG0X5\n#1=#1+1\nEND1\nM30\n";
    let got = faults(FANUC, source);
    assert_eq!(got.len(), 3, "{got:?}");
}

#[test]
fn the_main_program_ends_where_the_next_one_begins() {
    let source = "%\nO1\nG0X1.\nO2\nG0X2.\nM30\n%\n";
    let log = run_text(FANUC, source);
    assert_eq!(log.motions.len(), 1);
    let (_, log) = run_bytes(FANUC, source.as_bytes(), &Setup::default());
    assert_eq!(log.faults.len(), 1);
    assert_eq!(log.faults[0].kind, FaultKind::MissingProgramEnd);
}

#[test]
fn steps_that_the_caller_chooses_know_no_variable_behind_a_jump() {
    let dialect = trunnion_dialect::builtin(FANUC).expect("built in");
    let source = b"#1=5.\nG0X#1\nIF[#1GT1]GOTO10\n#1=6.\nN10G0X#1\nM30\n".to_vec();
    let program = trunnion_syntax::parse(source, dialect.lex);
    let mut log = crate::support::Log::default();
    let mut interpreter = trunnion_interp::Interpreter::new(dialect, &Setup::default());
    for block in program.blocks() {
        interpreter.step(&program, block.id(), &mut log);
    }
    let got: Vec<_> = log.motions.iter().map(crate::support::line).collect();
    assert_eq!(got, ["R X5", "R -"]);
}

#[test]
fn refusals_are_chosen_by_their_sort() {
    let (_, log) = run_bytes(FANUC, b"#50=1\nM30\n", &Setup::default());
    assert!(matches!(
        &log.faults[0].kind,
        FaultKind::Rejected {
            refusal: Refusal::Variable,
            ..
        }
    ));
}

#[test]
fn a_jump_on_an_input_is_a_branch_that_is_not_known() {
    let source = "G0X0.\nN7M96P30Q8\nX1.\nN30X2.\nM30\n";
    let (_, log) = run_bytes("haas-ngc", source.as_bytes(), &Setup::default());
    let undecided: Vec<_> = log
        .faults
        .iter()
        .filter(|fault| matches!(&fault.kind, FaultKind::NotDecided { what } if what.contains("M96")))
        .map(|fault| fault.block.0 + 1)
        .collect();
    assert_eq!(undecided, [2]);
    assert!(
        !log.faults.iter().any(|fault| fault.kind == FaultKind::UnusedWord),
        "{:?}",
        log.faults
    );
    assert_eq!(lines("haas-ngc", source), ["R X0"]);
    // on a Fanuc the machine builder decides what it is
    let (_, log) = run_bytes(FANUC, source.as_bytes(), &Setup::default());
    assert!(
        !log.faults
            .iter()
            .any(|fault| matches!(fault.kind, FaultKind::NotDecided { .. }))
    );
}
