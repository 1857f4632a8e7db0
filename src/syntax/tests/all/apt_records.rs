//! Every form of an APT record, with its arguments by hand.
use crate::show::{APT, errors, program};
use trunnion_syntax::{AptArg, Program};

fn records(program: &Program) -> String {
    let text = |range| program.text(range).into_owned();
    let argument = |argument| match argument {
        AptArg::Number(number, _) => number.to_string(),
        AptArg::Word(range) => text(range),
        AptArg::Other(range) => format!("[{}]", text(range)),
    };
    let record = |block: trunnion_syntax::Block<'_>| match block.record() {
        Some(record) => format!(
            "{}/{}",
            text(record.major),
            record.args().map(argument).collect::<Vec<_>>().join(",")
        ),
        None => String::new(),
    };
    program.blocks().map(record).collect::<Vec<_>>().join(" | ")
}

fn check(rows: &[(&str, &str, &str)]) {
    for &(source, expected, problems) in rows {
        let program = program(source, APT);
        assert_eq!(records(&program), expected, "records of {source:?}");
        assert_eq!(errors(&program), problems, "problems of {source:?}");
    }
}

#[test]
fn statements() {
    check(&[
        ("GODLTA / 1, -2.5E-3,+.5\n", "GODLTA/1,-0.0025,0.5", ""),
        ("goto/1,2,3,0,0,1", "goto/1,2,3,0,0,1", ""),
        ("RAPID\nRAPID/\nFINI ", "RAPID/ | RAPID/ | FINI/", ""),
        (
            "CIRCLE / 1, 2,  $\r\n3, 4 $ more\n ,5\nGODLTA/6",
            "CIRCLE/1,2,3,4,5 | GODLTA/6",
            "",
        ),
        ("SPINDL / RPM, 100.5,  CLW", "SPINDL/RPM,100.5,CLW", ""),
        (
            "CYCLE/DEEP2,FEDTO,9.0,1STPECK,5.",
            "CYCLE/DEEP2,FEDTO,9.0,1STPECK,5.",
            "",
        ),
        ("GODLTA/- 5, + .5", "GODLTA/-5,0.5", ""),
        (
            "PARTNO / MFG0004 A, $$ B\nPPRINT",
            "PARTNO/[MFG0004 A, $$ B] | PPRINT/",
            "",
        ),
        (
            "PARTNO MY PART\nINSERT/Stock X30. (\nREMARK",
            "PARTNO/[MY PART] | INSERT/[Stock X30. (] | REMARK/",
            "",
        ),
        ("$$ comment $\nGODLTA/1 $$ end", " | GODLTA/1", ""),
        ("$$-> CSYS / 1.0,  $\n   0.0, $\n 2.0\nGODLTA/1", " | GODLTA/1", ""),
        ("\n\n", " | ", ""),
        (
            "TOOL PATH/MILL,TOOL,M1\nEND-OF-PATH",
            "TOOL PATH/MILL,TOOL,M1 | END-OF-PATH/",
            "",
        ),
        ("P1 = POINT/1,2,3\nA = 5", "POINT/1,2,3 | A/[=],5", ""),
        ("L1=LINE/(POINT/1,(2)),P2", "LINE/[(POINT/1,(2))],P2", ""),
        ("LAB1) GODLTA/1", "GODLTA/1", ""),
        ("GODLTA/X*2,3", "GODLTA/X,[*],2,3", ""),
        ("LOADTL/1,'a,b'", "LOADTL/1,['a,b']", ""),
    ]);
}

#[test]
fn broken_statements() {
    check(&[
        ("1,2,3", "", "BadRecord[1]"),
        ("/GOTO", "", "BadRecord[/]"),
        ("GOTO/1,,2", "GOTO/1,2", "BadRecord[,]"),
        ("GOTO/,1", "GOTO/1", "BadRecord[,]"),
        ("GOTO/1, $$ c", "GOTO/1", "BadRecord[,]"),
        ("GOTO//1", "GOTO/1", "BadRecord[/]"),
        ("GOTO 1,2", "GOTO/1,2", "BadRecord[1]"),
        ("GOTO/1-2,3", "GOTO/1,[-2],3", "BadRecord[-2]"),
        ("GOTO/1.2.3,4", "GOTO/[1.2.3],4", "BadNumber[1.2.3]"),
        ("GOTO/1,(2,3\nRAPID", "GOTO/1,[(2,3] | RAPID/", "UnbalancedBracket[(]"),
        ("GOTO/1,2)", "GOTO/1,2,[)]", "UnbalancedBracket[)]"),
        ("GOTO/1,$", "GOTO/1", "BadRecord[,] DanglingContinuation[$]"),
        ("GOTO/1,?ä", "GOTO/1,[?ä]", "UnexpectedCharacter[?ä]"),
        ("GOTO/", "GOTO/", "BadRecord[GOTO/]"),
        ("GOTO/10,0", "GOTO/10,0", "BadRecord[GOTO/10,0]"),
        (
            "LAB) goto/1,2,3,4,5 $$ c",
            "goto/1,2,3,4,5",
            "BadRecord[goto/1,2,3,4,5]",
        ),
        ("GOTO/P1", "GOTO/P1", ""),
        ("GOTO/1,2,3,4,5,6,7", "GOTO/1,2,3,4,5,6,7", ""),
        ("PAINT/\"A", "PAINT/[\"A]", "UnclosedText[\"A]"),
    ]);
}

#[test]
fn a_continued_record_is_one_block_with_one_range() {
    let program = program("RAPID\nCIRCLE / 1, $\n 2 $$ end\nFINI", APT);
    assert_eq!(program.block_count(), 3);
    let block = program.blocks().nth(1).expect("three blocks");
    assert_eq!(program.text(block.range()), "CIRCLE / 1, $\n 2 $$ end");
    let record = block.record().expect("a record");
    assert_eq!(program.text(record.range), "CIRCLE / 1, $\n 2");
    assert!(record.is("circle") && !record.is("CIRCL"));
    let comments: Vec<_> = block.comments().map(|comment| program.text(comment.inner)).collect();
    assert_eq!(comments, [" end"]);
    assert_eq!(program.block_at(20), Some(block.id()));
}
