//! Programs that never end, or take longer than anybody waits.
use super::{Input, cut, lines};

/// A body that moves and counts, so that no two rounds are the same.
const ROUND: &str = "#1=#1+1\nG1 X#1 Y1.\n";
const ROUND_R: &str = "R1=R1+1\nG1 X=R1 Y1\n";

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("while-true-do", |_| cut("WHILE[1EQ1]DO1\nG1 X1.\nG1 X2.\nEND1")),
        Input::new("while-do-counts", |_| cut("#1=0\nWHILE[1EQ1]DO1\n#1=#1+1\nEND1")),
        Input::new("while-do-moves", |_| cut(&format!("#1=0\nWHILE[1EQ1]DO1\n{ROUND}END1"))),
        Input::new("while-do-empty", |_| cut("WHILE[1EQ1]DO1\nEND1")),
        Input::new("while-do-changes-tool", |_| {
            cut("#1=0\nWHILE[1EQ1]DO1\n#1=#1+1\nT#1 M6\nM8\nG4 P1\nM9\nEND1")
        }),
        Input::new("while-do-effects", |_| {
            cut("#1=0\nWHILE[1EQ1]DO1\n#1=#1+1\n#500=#1\nS#1 M3\nM0\nG10 L2 P1 X#1\nEND1")
        }),
        Input::new("while-do-new-variables", |_| {
            cut("#1=100\nWHILE[1EQ1]DO1\n#1=#1+1\n#[#1]=#1\nEND1")
        }),
        Input::new("goto-back", |_| cut("#1=0\nN10 #1=#1+1\nG1 X#1\nGOTO10")),
        Input::new("goto-itself", |_| cut("N10 GOTO10")),
        Input::new("goto-computed", |_| {
            cut("#1=10\nN10 #1=30-#1\nGOTO#1\nN20 G1 X#1\n#1=30-#1\nGOTO#1")
        }),
        Input::new("o-while", |_| cut("o1 while [1]\nG1 X1\nG1 X2\no1 endwhile")),
        Input::new("o-while-moves", |_| {
            cut(&format!("#1=0\no1 while [1]\n{ROUND}o1 endwhile"))
        }),
        Input::new("o-do-while", |_| cut(&format!("#1=0\no1 do\n{ROUND}o1 while [1]"))),
        Input::new("o-repeat", |_| {
            cut(&format!("#1=0\no1 repeat [999999999]\n{ROUND}o1 endrepeat"))
        }),
        Input::new("o-repeat-empty", |_| cut("o1 repeat [999999999]\no1 endrepeat")),
        Input::new("o-continue", |_| cut("o1 while [1]\no1 continue\no1 endwhile")),
        Input::new("o-named-grow", |_| {
            cut("#1=0\no1 while [1]\n#1=#1+1\n#<_a>=#1\n(print, #1)\no1 endwhile")
        }),
        Input::new("while-true", |_| cut("WHILE TRUE\nG1 X1\nG1 X2\nENDWHILE")),
        Input::new("while-moves", |_| cut(&format!("R1=0\nWHILE TRUE\n{ROUND_R}ENDWHILE"))),
        Input::new("loop-moves", |_| cut(&format!("R1=0\nLOOP\n{ROUND_R}ENDLOOP"))),
        Input::new("for-to", |_| cut("FOR R1=1 TO 999999999\nG1 X=R1\nENDFOR")),
        Input::new("repeat-until", |_| cut(&format!("R1=0\nREPEAT\n{ROUND_R}UNTIL R1<0"))),
        Input::new("goto-label-back", |_| cut(&format!("R1=0\nL1:\n{ROUND_R}GOTOB L1"))),
        Input::new("repeat-label", |_| {
            cut(&format!("R1=0\nA1:\n{ROUND_R}A2:\nREPEAT A1 A2 P=999999999"))
        }),
        Input::new("repeat-line", |_| cut("R1=0\nA1: G91 X1\nREPEATB A1 P=999999999")),
        Input::new("repeat-end-word", |_| {
            cut("G91 X1 G4 F0.1 P999999999\nN1 X2 P999999999")
        }),
        Input::new("string-doubles", |_| {
            cut("DEF STRING[200] S\nS=\"AB\"\nWHILE TRUE\nS=S<<S\nENDWHILE")
        }),
        Input::new("r-parameters-grow", |_| {
            cut("R1=100\nWHILE TRUE\nR1=R1+1\nR[R1]=R1\nENDWHILE")
        }),
        Input::new("call-itself", |_| b"O1\nG21 G90\nG1 X1. F100.\nM98 P1\nM30\n".to_vec()),
        Input::new("call-itself-twice", |_| {
            b"O1\nG91 G1 X1. F100.\nM98 P1\nM98 P1\nM30\n".to_vec()
        }),
        Input::new("call-many-times", |_| {
            format!(
                "O1\nG21 G91 F100.\nM98 P2 L99999999\nM30\n{}",
                lines(8, |i| format!("O{}\nG1 X1.\nM98 P{} L99999999\nM99", i + 2, i + 3))
            )
            .into()
        }),
        Input::new("calls-that-double", |_| {
            format!(
                "O1\nG21 G91 F100.\nM98 P2\nM30\n{}",
                lines(90, |i| format!(
                    "O{}\nG1 X1.\nM98 P{}\nM98 P{}\nM99",
                    i + 2,
                    i + 3,
                    i + 3
                ))
            )
            .into()
        }),
        Input::new("macro-calls-itself", |_| b"O1\nG65 P1 A#1 B1.\nM30\n".to_vec()),
        Input::new("macro-calls-grow", |_| {
            b"O1\n#500=0\nG65 P2\nM30\nO2\n#500=#500+1\nG1 X#500 F1.\nG65 P2 A#500\nM99\n".to_vec()
        }),
        Input::new("modal-macro-at-each-motion", |n| {
            format!(
                "O1\nG21 G90 G1 F100. X0.\nG66 P2 L999\n{}G67\nM30\nO2\nG1 X1.\nX2.\nM99\n",
                lines(n, |i| format!("X{}.", i % 9))
            )
            .into()
        }),
        Input::new("local-calls", |_| {
            b"O1\nG91 G1 F100.\nN5 X1.\nM97 P5 L99999999\nM30\nM99\n".to_vec()
        }),
        Input::new("main-returns", |_| {
            b"O1\nG21 G90 G94 F100.\nG1 X1.\nX2.\nM99\n".to_vec()
        }),
        Input::new("main-returns-counting", |_| {
            b"O1\nG21 G91 G94 F100.\nG1 X1.\nM99\n".to_vec()
        }),
        Input::new("return-to-number", |_| {
            b"O1\nG91 G94 F100.\nN5 G1 X1.\nM99 P5\n".to_vec()
        }),
        Input::new("sub-calls-itself", |_| {
            cut("o100 sub\nG91 G1 X1.\no100 call\no100 call\no100 endsub\no100 call")
        }),
        Input::new("sub-calls-in-loop", |_| {
            cut("o100 sub\nG91 G1 X1.\no100 endsub\no1 while [1]\no100 call [1] [2]\no1 endwhile")
        }),
        Input::new("procedure-calls-itself", |_| {
            b"PROC P1\nG91 G1 X1 F100\nP1\nP1\nM17\n".to_vec()
        }),
        Input::new("label-calls-itself", |_| {
            cut("CALL BLOCK A TO B\nA:\nG91 X1\nCALL BLOCK A TO B\nB:")
        }),
        Input::new("apt-jump", |_| {
            b"PARTNO\nI=0\nA) I=I+1\nGOTO/I,0,0\nJUMPTO/A\nFINI\n".to_vec()
        }),
        Input::new("apt-macro-calls-itself", |_| {
            b"PARTNO\nM=MACRO/A\nGOTO/A,0,0\nCALL/M,A=1\nTERMAC\nCALL/M,A=1\nFINI\n".to_vec()
        }),
        Input::new("apt-copy", |_| {
            b"PARTNO\nINDEX/1\nGOTO/1,0,0\nCOPY/1,TRANSL,1,0,0,999999999\nFINI\n".to_vec()
        }),
        Input::new("skipped-loop", |_| cut("/WHILE[1EQ1]DO1\n/G1 X1.\n/END1\n/N10 GOTO10")),
        Input::new("powers-in-loop", |_| {
            cut("#1=2\nWHILE[1EQ1]DO1\n#1=#1*#1\n#2=SQRT[0-#1]\n#3=1/[#1-#1]\nEND1")
        }),
    ]
}
