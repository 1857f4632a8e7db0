//! Sinumerik: branches, jumps and loops, checked by hand against the programming manual (12/2019, 3.1.5 to 3.1.7).
use crate::support::{lines, run_bytes};
use trunnion_interp::{FaultKind, Limits, Setup};

pub(crate) const SINUMERIK: &str = "sinumerik-840d";

/// Facts as short lines: refusals with their sort and alarm.
pub(crate) fn said_with(source: &str, setup: &Setup) -> Vec<String> {
    let (program, log) = run_bytes(SINUMERIK, source.as_bytes(), setup);
    let facts = log.faults.iter().filter_map(|fault| {
        let line = fault.block.0 + 1;
        let text = program.text(fault.range).trim().to_owned();
        Some(match &fault.kind {
            FaultKind::MissingProgramEnd => return None,
            FaultKind::Rejected { refusal, alarm, .. } => {
                format!("{line} `{text}` {refusal:?} {}", alarm.clone().unwrap_or_default())
            }
            FaultKind::NotDecided { what } => format!("{line} `{text}` not decided: {what}"),
            FaultKind::NotModelled { what } => format!("{line} `{text}` not modelled: {what}"),
            FaultKind::EndlessLoop { proved, .. } => format!("{line} `{text}` endless {proved}"),
            FaultKind::MissingSubprogram { name, .. } => format!("{line} `{text}` missing {name}"),
            other => format!("{line} `{text}` {other:?}"),
        })
    });
    facts.collect()
}

pub(crate) fn said(source: &str) -> Vec<String> {
    said_with(source, &Setup::default())
}

pub(crate) fn clean(source: &str) -> Vec<String> {
    assert_eq!(said(source), [""; 0], "{source}");
    lines(SINUMERIK, source)
}

/// Where X comes to, block for block.
pub(crate) fn places(source: &str) -> Vec<String> {
    let end = |line: String| line.trim_start_matches("R X").to_owned();
    clean(source).into_iter().map(end).collect()
}

#[test]
fn a_branch_runs_one_side() {
    let source =
        |r1: i32| format!("R1={r1}\nG0\nIF R1>2\nX1\nIF R1==4\nX2\nELSE\nX3\nENDIF\nELSE\nX4\nENDIF\nX5\nM30\n");
    assert_eq!(places(&source(1)), ["4", "5"]);
    assert_eq!(places(&source(3)), ["1", "3", "5"]);
    assert_eq!(places(&source(4)), ["1", "2", "5"]);
    let without = "R1=1\nG0 X0\nIF R1\nX1\nENDIF\nIF NOT R1\nX2\nENDIF\nM30\n";
    assert_eq!(places(without), ["0", "1"]);
}

#[test]
fn priority_is_the_control_s_where_a_comparison_meets_and() {
    let source =
        |condition: &str| format!("R1=6 R2=2\nG0\nIF {condition} GOTOF YES\nX0\nGOTOF DONE\nYES: X1\nDONE: M30\n");
    // (R1 > (5 AND R2)) < 3
    assert_eq!(places(&source("R1>5 AND R2<3")), ["1"]);
    // ((R1 > (5 AND R2)) > 3)
    assert_eq!(places(&source("R1>5 AND R2>3")), ["0"]);
    assert_eq!(places(&source("(R1>5) AND (R2>1)")), ["1"]);
    assert_eq!(
        places(&source("R1==6 AND R2==2")),
        ["0"],
        "6 == (6 AND 2) is 0, and 0 == 2 is not"
    );
}

#[test]
fn while_loop_repeat_and_for_count_their_passes() {
    assert_eq!(
        places("R1=0\nG0\nWHILE R1<3\nX=R1*10\nR1=R1+1\nENDWHILE\nX99\nM30\n"),
        ["0", "10", "20", "99"]
    );
    assert_eq!(
        places("R1=5\nG0\nWHILE R1<3\nX1\nENDWHILE\nX99\nM30\n"),
        ["99"],
        "no pass"
    );
    assert_eq!(
        places("R1=9\nG0\nREPEAT\nX=R1\nR1=R1+1\nUNTIL R1>10\nX99\nM30\n"),
        ["9", "10", "99"]
    );
    assert_eq!(
        places("R1=9\nG0\nREPEAT\nX=R1\nUNTIL R1>5\nM30\n"),
        ["9"],
        "one pass at least"
    );
    let out = "R1=0\nG0\nLOOP\nR1=R1+1\nX=R1\nIF R1==3 GOTOF OUT\nENDLOOP\nOUT: X99\nM30\n";
    assert_eq!(places(out), ["1", "2", "3", "99"]);
}

#[test]
fn for_counts_by_one_and_leaves_one_more() {
    let source = "DEF INT ROW\nG0\nFOR ROW=2 TO 4\nX=ROW\nENDFOR\nX=ROW*10\nM30\n";
    assert_eq!(places(source), ["2", "3", "4", "50"]);
    assert_eq!(places("G0\nFOR R1=3 TO 1\nX1\nENDFOR\nX=R1\nM30\n"), ["3"], "no pass");
    assert_eq!(places("G0\nFOR R1=-1 TO 0\nX=R1\nENDFOR\nM30\n"), ["-1", "0"]);
    // the counter is a variable like others: this counts by two
    assert_eq!(
        places("G0\nFOR R1=0 TO 5\nX=R1\nR1=R1+1\nENDFOR\nM30\n"),
        ["0", "2", "4"]
    );
    let nested = "DEF INT ROW,COL\nG0\nFOR ROW=0 TO 1\nFOR COL=0 TO 2\nX=ROW*10+COL\nENDFOR\nENDFOR\nM30\n";
    assert_eq!(places(nested), ["0", "1", "2", "10", "11", "12"]);
    // what is not documented is not decided
    let changes = "R2=3\nG0\nFOR R1=0 TO R2\nX=R1\nR2=R2+1\nENDFOR\nM30\n";
    assert!(
        said(changes)[0].contains("changes while the loop runs"),
        "{:?}",
        said(changes)
    );
    assert!(said("G0\nFOR R1=0.5 TO 3\nX1\nENDFOR\nM30\n")[0].contains("not a whole number"));
}

#[test]
fn a_label_is_looked_for_in_the_direction_of_the_jump() {
    let twice = |jump: &str| format!("G0\nGOTOF START\nLA: X1\nM30\nSTART: {jump} LA\nX2\nLA: X3\nM30\n");
    assert_eq!(places(&twice("GOTOF")), ["3"]);
    assert_eq!(places(&twice("GOTOB")), ["1"]);
    assert_eq!(places(&twice("GOTO")), ["3"], "forward first");
    assert_eq!(
        places("G0\nGOTOF IN\nLA: X1\nM30\nIN: GOTO LA\nM30\n"),
        ["1"],
        "then backward"
    );
    // the nearest before the jump, not the first of the program
    let nearest = "G0\nGOTOF IN\nLA: X1\nM30\nLA: X2\nM30\nIN: GOTO LA\nM30\n";
    assert_eq!(places(nearest), ["2"]);
    assert_eq!(
        places("R1=0\nG0\nLA: R1=R1+1\nX=R1\nIF R1<3 GOTOB LA\nM30\n"),
        ["1", "2", "3"]
    );
    // of the jump's own block
    assert_eq!(places("R1=3\nG0\nLA: IF R1==1 GOTOB LA\nX1\nM30\n"), ["1"]);
    for number in ["90", "N90", "N0090"] {
        assert_eq!(
            places(&format!("G0\nN10 GOTOF {number}\nN20 X1\nN90 X2\nM30\n")),
            ["2"],
            "{number}"
        );
    }
    assert_eq!(places("G0\nGOTOF \"LA\"\nX1\nLA: X2\nM30\n"), ["2"]);
    assert_eq!(
        places("G0\ngotof la\nX1\nLa: X2\nM30\n"),
        ["2"],
        "upper and lower case are one"
    );
}

#[test]
fn a_missing_label_is_refused_unless_gotoc_asks() {
    for jump in ["GOTOF", "GOTOB", "GOTO"] {
        let source = format!("G0 X1\n{jump} NOWHERE\nX2\nM30\n");
        assert_eq!(said(&source), ["2 `NOWHERE` Label 14080"], "{jump}");
        assert_eq!(lines(SINUMERIK, &source), ["R X1"]);
    }
    // it stands in the other direction
    assert_eq!(said("G0\nLA: X1\nGOTOF LA\nM30\n"), ["3 `LA` Label 14080"]);
    assert_eq!(said("G0\nGOTOB LA\nLA: X1\nM30\n"), ["2 `LA` Label 14080"]);
    // beyond the end of the program that runs
    let beyond = "%_N_MAIN_MPF\nG0\nGOTOF LA\nM30\n%_N_SUB_SPF\nLA: X1\nM17\n";
    assert_eq!(said(beyond), ["3 `LA` Label 14080"]);
    assert_eq!(places("G0\nGOTOC NOWHERE\nX2\nM30\n"), ["2"]);
    assert_eq!(
        places("G0\nR1=2\nIF R1==1 GOTOF NOWHERE\nX2\nM30\n"),
        ["2"],
        "a jump that is not taken"
    );
}

#[test]
fn several_conditional_jumps_may_share_a_block() {
    let source =
        |r1: i32| format!("G0\nR1={r1}\nIF R1==1 GOTOF LA IF R1==2 GOTOF LB\nX9\nM30\nLA: X1\nM30\nLB: X2\nM30\n");
    assert_eq!(places(&source(1)), ["1"]);
    assert_eq!(places(&source(2)), ["2"]);
    assert_eq!(places(&source(3)), ["9"]);
}

#[test]
fn case_goes_to_the_label_of_its_value() {
    let source = |value: &str, rest: &str| {
        format!(
            "G0\nR1={value}\nCASE(R1*2) OF -2 GOTOF LA 4 GOTOF LB 6 GOTOF LC{rest}\nX9\nM30\nLA: X1\nM30\nLB: X2\nM30\nLC: X3\nM30\n"
        )
    };
    assert_eq!(places(&source("-1", "")), ["1"]);
    assert_eq!(places(&source("2", "")), ["2"]);
    assert_eq!(places(&source("5", "")), ["9"]);
    assert_eq!(places(&source("5", " DEFAULT GOTOF LC")), ["3"]);
    assert!(said(&source("0.3", ""))[0].contains("not a whole number"));
    assert_eq!(
        places("G0\nR1=2\nCASE R1 OF 1 GOTOF LBL1 2 GOTOF LBL2\nX9\nLBL1: X1\nLBL2: X2\nM30\n"),
        ["2"]
    );
}

#[test]
fn what_depends_on_the_unknown_is_not_decided() {
    for (source, what) in [
        (
            "IF R5>1 GOTOF LA\nX2\nLA: M30\n",
            "2 `R5>1` not decided: R5: the program does not set its value",
        ),
        (
            "IF $AA_IM[X]>1\nX2\nENDIF\nM30\n",
            "2 `$AA_IM[X]>1` not decided: $AA_IM[X]: a variable of the control",
        ),
        (
            "WHILE GUD<2\nX2\nENDWHILE\nM30\n",
            "2 `GUD<2` not decided: GUD: not declared",
        ),
        ("CASE R5 OF 1 GOTOF LA\nLA: M30\n", "2 `R5` not decided: R5"),
        ("FOR R1=1 TO R5\nX2\nENDFOR\nM30\n", "2 `R5` not decided: R5"),
        (
            "DEF INT GOAL\nGOTOF GOAL\nM30\n",
            "3 `GOAL` not decided: GOAL: the target of a jump in a variable",
        ),
        (
            "GOTOF \"N\"<<R10\nM30\n",
            "2 `R10` not decided: `R10`, a part of the target",
        ),
        (
            "R1=0.1+0.2\nIF R1==0.3 GOTOF LA\nLA: M30\n",
            "3 `R1==0.3` not decided: R1==0.3: the control",
        ),
        ("IF 1 GOTOF LA X5\nLA: M30\n", "2 `X5` not decided"),
        (
            "R1=1\nX5 GOTOF LA\nLA: M30\n",
            "3 `GOTOF LA` not decided: other words in",
        ),
    ] {
        let source = match source.split_once('\n') {
            Some((first, rest)) if first.starts_with("DEF") => format!("{first}\nG0 X1\n{rest}"),
            _ => format!("G0 X1\n{source}"),
        };
        let got = said(&source);
        assert!(got.len() == 1 && got[0].starts_with(what), "{source}: {got:?}");
        assert_eq!(lines(SINUMERIK, &source), ["R X1"], "{source}");
    }
    assert_eq!(
        said("G0\nIF R[-1]>0 GOTOF LA\nLA: M30\n"),
        ["2 `R[-1]>0 GOTOF LA` Variable "]
    );
}

#[test]
fn a_jump_may_leave_a_loop_and_not_enter_one() {
    let out = "R1=0\nG0\nWHILE R1<9\nIF R1==2\nGOTOF OUT\nENDIF\nX=R1\nR1=R1+1\nENDWHILE\nOUT: X99\nM30\n";
    assert_eq!(places(out), ["0", "1", "99"]);
    let into = "R1=0\nG0\nGOTOF IN\nWHILE R1<9\nIN: X1\nR1=R1+5\nENDWHILE\nM30\n";
    let got = said(into);
    assert!(
        got[0].starts_with("3 `IN` not decided: a jump into a loop or branch"),
        "{got:?}"
    );
}

#[test]
fn structures_that_are_not_whole_end_the_run_where_they_are_reached() {
    assert_eq!(said("G0\nR1=1\nIF R1>2\nX1\nM30\n"), ["3 `IF R1>2` Structure "]);
    assert_eq!(
        said("G0\nR1=1\nWHILE R1>2\nX1\nENDLOOP\nM30\n"),
        ["3 `WHILE R1>2` Structure "]
    );
    assert_eq!(said("G0\nX1\nENDWHILE\nM30\n"), ["3 `ENDWHILE` Structure "]);
    // looked for while the program runs: what is not reached is no mistake
    assert_eq!(places("G0 X1\nGOTOF LA\nIF R1>2\nLA: X2\nM30\n"), ["1", "2"]);
}

#[test]
fn loops_without_end_are_found() {
    assert_eq!(said("G0\nLOOP\nX1\nENDLOOP\nM30\n"), ["2 `LOOP` endless true"]);
    assert_eq!(
        said("R1=1\nG0\nWHILE R1>0\nX1\nENDWHILE\nM30\n"),
        ["3 `WHILE R1>0` endless true"]
    );
    assert_eq!(said("G0\nLA: X1\nGOTOB LA\nM30\n"), ["2 `LA: X1` endless true"]);
    let setup = Setup {
        limits: Limits {
            blocks: 1000,
            ..Limits::default()
        },
        ..Setup::default()
    };
    let grows = "R1=1\nG0\nWHILE R1>0\nR1=R1+1\nENDWHILE\nM30\n";
    assert_eq!(said_with(grows, &setup), ["3 `WHILE R1>0` endless false"]);
}

#[test]
fn variables_are_rounded_and_local_as_declared() {
    assert_eq!(
        places("DEF INT ROW=2.6\nDEF BOOL YES=5\nG0 X=ROW Y=YES\nM30\n"),
        ["3 Y1"]
    );
    assert_eq!(places("R1=5\nR2=R1>3\nG0 X=R2\nM30\n"), ["1"]);
    assert_eq!(places("R1=3\nR[R1+1]=7\nG0 X=R4\nM30\n"), ["7"]);
}

#[test]
fn ten_thousand_nested_branches_need_no_stack() {
    let depth = 10_000;
    let source = format!(
        "R1=1\nG0\n{}X1\n{}M30\n",
        "IF R1\n".repeat(depth),
        "ENDIF\n".repeat(depth)
    );
    assert_eq!(places(&source), ["1"]);
    let unclosed = format!("R1=1\nG0\n{}X1\nM30\n", "WHILE R1\n".repeat(depth));
    assert_eq!(said(&unclosed).len(), 1);
}

#[test]
fn a_name_is_defined_once_and_a_block_has_five_m_functions() {
    for twice in ["DEF INT AB=5, AB=6", "DEF INT AB\nDEF REAL CD, AB"] {
        let told = said(&format!("{twice}\nG0 X1\nM30\n"));
        assert!(
            told.len() == 1 && told[0].contains("AB: the program defines it twice"),
            "{told:?}"
        );
    }
    assert_eq!(said("G0 X1 M3 M7 M8 M40 M42\nM30\n").len(), 0);
    assert_eq!(said("G0 X1 M3 M7 M8 M40 M42 M43\nM30\n"), ["1 `M43` Other "]);
}

#[test]
fn a_frame_word_stands_alone() {
    for text in ["TRANS X5 Y2", "N5 ROT RPL=30", "SCALE X2 Y2", "TRANS", "AROT Z=R1"] {
        assert_eq!(said(&format!("R1=5\nG0 X1\n{text}\nM30\n")), [""; 0], "{text}");
    }
    assert_eq!(
        said("F100 S5 M3\nG0 X1 Z9\nMCALL CYCLE81(10,0,2,-5)\nX2\nMCALL\nM30\n"),
        [""; 0]
    );
    let told = said("F100 S5 M3\nG0 X1 Z9\nCYCLE81(10,0,2,-5) M8 F33\nM30\n");
    assert!(
        told.iter().any(|told| told.starts_with("3 ") && told.contains("Other")),
        "{told:?}"
    );
    for text in [
        "TRANS X5 F100",
        "ROT RPL=30 S500",
        "G17 ROT RPL=30",
        "TRANS X5 M8",
        "MIRROR X0 T1",
    ] {
        let told = said(&format!("G0 X1\n{text}\nM30\n"));
        assert!(
            told.iter().any(|told| told.starts_with("2 ") && told.contains("Other")),
            "{text}: {told:?}"
        );
    }
}

/// Sections that stay open: as many as no control has.
#[test]
fn repeated_sections_inside_each_other_are_bounded() {
    let lines: Vec<String> = (0..3000)
        .map(|i| format!("LA{i}: REPEATB LA{} P=99\n", i + 1))
        .collect();
    let text = lines.concat();
    let got = said(&format!("G0 X1\n{text}M30\n"));
    assert!(
        got.len() == 1 && got[0].contains("more than 1000 repeated sections"),
        "{got:?}"
    );
}
