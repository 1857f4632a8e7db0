//! HEIDENHAIN Klartext: labels, repeats, called programs, FN blocks, formulas, continued blocks and cycles.
use super::{Input, lines, repeat};

const NAME: &str = "heidenhain-klartext";

/// A program with a known position, then `body`.
fn cut(body: &str) -> Vec<u8> {
    format!(
        "BEGIN PGM P MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+50 R0 FMAX M3\nM5\nM3\nM8\nM9\nL X+1 F100\n{body}\nM30\nEND PGM P MM\n"
    )
    .into_bytes()
}

const fn input(name: &'static str, make: fn(usize) -> Vec<u8>) -> Input {
    Input::of(NAME, name, make)
}

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        input("klartext-calls-in-calls", |n| {
            cut(&format!(
                "CALL LBL 1\nM30\n{}",
                lines(n / 4, |i| format!("LBL {}\nL IX+1\nCALL LBL {}\nLBL 0", i + 1, i + 2))
            ))
        }),
        input("klartext-calls-itself", |_| {
            cut("LBL 1\nL IX+1\nCALL LBL 1\nLBL 0\nCALL LBL 1")
        }),
        input("klartext-calls-one-many-times", |n| {
            cut(&format!("LBL 1\nL IX+1\nLBL 0\n{}", repeat("CALL LBL 1\n", n)))
        }),
        input("klartext-calls-what-is-missing", |n| {
            cut(&lines(n, |i| format!("CALL LBL {}\nCALL LBL \"A{i}\"", i + 1)))
        }),
        input("klartext-labels", |n| {
            cut(&lines(n, |i| format!("LBL \"L{i}\"\nL IX+1\nLBL 0")))
        }),
        input("klartext-labels-of-one-number", |n| cut(&repeat("LBL 1\nL IX+1\n", n))),
        input("klartext-jumps-forward", |n| {
            cut(&lines(n / 2, |i| {
                format!("FN 9: IF +1 EQU +1 GOTO LBL {}\nLBL {}", i + 1, i + 1)
            }))
        }),
        input("klartext-repeats", |_| cut("LBL 1\nL IX+1\nCALL LBL 1 REP 999999999")),
        input("klartext-repeats-in-repeats", |_| {
            cut(&format!(
                "{}L IX+1\n{}",
                lines(9, |i| format!("LBL {}", i + 1)),
                lines(9, |i| format!("CALL LBL {} REP 65534", 9 - i))
            ))
        }),
        input("klartext-repeats-nothing", |_| cut("LBL 1\nCALL LBL 1 REP 999999999")),
        input("klartext-calls-its-program", |_| {
            cut("L IX+1\nCALL PGM klartext-calls-its-program.nc\nCALL PGM klartext-calls-its-program")
        }),
        input("klartext-calls-programs", |n| {
            cut(&lines(n, |i| {
                format!("CALL PGM TNC:\\A\\P{i}.H\nCYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM P{i}\nCYCL CALL")
            }))
        }),
        input("klartext-counts", |_| {
            cut("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 9: IF +1 EQU +1 GOTO LBL 1")
        }),
        input("klartext-counts-and-moves", |_| {
            cut("FN 0: Q1 = +0\nLBL 1\nFN 1: Q1 = +Q1 + +1\nL X+Q1 Y+0 F100\nFN 12: IF +Q1 LT +999999999 GOTO LBL 1")
        }),
        input("klartext-never-ends", |_| cut("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1")),
        input("klartext-open-condition", |n| {
            cut(&repeat("FN 9: IF +Q1700 EQU +1 GOTO LBL 1\n", n))
        }),
        input("klartext-brackets", |n| {
            cut(&format!("Q1 = {}1{}", repeat("(", n), repeat(")", n)))
        }),
        input("klartext-functions", |n| cut(&format!("Q1 = {}1", repeat("SIN ", n)))),
        input("klartext-sum", |n| cut(&format!("Q1 = 1{}", repeat(" + 1", n)))),
        input("klartext-powers", |n| cut(&format!("Q1 = 2{}", repeat(" ^ 2", n)))),
        input("klartext-signs", |n| {
            cut(&format!("Q1 = {}1\nL X{}Q1", repeat("- ", n), repeat("+", n)))
        }),
        input("klartext-texts-that-double", |n| {
            cut(&format!("QS1 = \"AB\"\n{}", repeat("QS1 = QS1 || QS1\n", n)))
        }),
        input("klartext-text-joined", |n| {
            cut(&format!("QS1 = \"A\"{}", repeat(" || \"B\"", n)))
        }),
        input("klartext-parameters", |n| {
            cut(&lines(n, |i| format!("Q{i} = {i}\nQL{i} = Q{i} + 1\nQR{i} = 2")))
        }),
        input("klartext-fn-blocks", |n| {
            cut(&lines(n, |i| {
                format!("FN {}: Q{} = +Q{} DIV +{}", i % 40, i % 99, i % 7, i % 3)
            }))
        }),
        input("klartext-continued", |n| {
            cut(&format!(
                "CYCL DEF 200 BOHREN ~\n{}Q211=0",
                lines(n, |i| format!(" Q{}={i} ~", 200 + i % 9))
            ))
        }),
        input("klartext-continued-comments", |n| {
            cut(&format!("L X+1 ~\n{}Y+1", repeat("; text ~\n", n)))
        }),
        input("klartext-continued-nothing", |n| {
            cut(&format!("L X+1{}", repeat(" ~\n", n)))
        }),
        input("klartext-peck-tiny", |_| {
            cut(
                "CYCL DEF 200 BOHREN ~\n Q200=2 ~\n Q201=-9000 ~\n Q206=150 ~\n Q202=0,00001 ~\n Q210=0 ~\n Q203=+10 ~\n Q204=30 ~\n Q211=0\nCYCL CALL\nL X+15 FMAX M99",
            )
        }),
        input("klartext-peck-many-holes", |n| {
            cut(&format!(
                "CYCL DEF 203 UNIVERSAL ~\n Q200=2 ~\n Q201=-900 ~\n Q206=150 ~\n Q202=0,01 ~\n Q210=0 ~\n Q203=+10 ~\n Q204=30 ~\n Q212=0,001 ~\n Q213=3 ~\n Q205=0,001 ~\n Q211=0 ~\n Q208=0 ~\n Q256=0,2\n{}",
                lines(n, |i| format!("L X+{i} FMAX M99"))
            ))
        }),
        input("klartext-old-cycles", |n| {
            cut(&lines(n / 7, |i| {
                format!(
                    "CYCL DEF 1.0 T\nCYCL DEF 1.1 ABST+2\nCYCL DEF 1.2 TIEFE-10\nCYCL DEF 1.3 ZUSTLG+0,00001\nCYCL DEF 1.4 V.ZEIT0\nCYCL DEF 1.5 F150\nL X+{i} FMAX M99"
                )
            }))
        }),
        input("klartext-datum-shifts", |n| {
            cut(&lines(n / 3, |i| {
                format!(
                    "CYCL DEF 7.0 N\nCYCL DEF 7.1 IX+{i}\nCYCL DEF 10.0 D\nCYCL DEF 10.1 IROT+1\nCYCL DEF 8.0 S\nCYCL DEF 8.1 X\nL X+1"
                )
            }))
        }),
        input("klartext-planes", |n| {
            cut(&lines(n, |i| {
                format!(
                    "PLANE SPATIAL SPA+{} SPB+{} SPC+0 {}\nL X+1",
                    i % 90,
                    i % 360,
                    ["STAY", "TURN FMAX", "MOVE DIST50 FMAX", "STAY SEQ- TABLE ROT"][i % 4]
                )
            }))
        }),
        input("klartext-turns", |n| {
            cut(&lines(n, |i| {
                format!("CC X+{} Y+10\nCP IPA+999999999 IZ+1 DR+\nCP IPA-{i}0000000 DR-", i % 9)
            }))
        }),
        input("klartext-corners", |n| {
            cut(&lines(n, |i| format!("L X+{i} Y+{} RL\nRND R9999\nCHF 5", i % 3)))
        }),
        input("klartext-approaches", |n| {
            cut(&lines(n, |i| {
                format!(
                    "APPR LCT X+{i} Y+20 Z+0 R999 RL F100\nL X+{} Y+3\nDEP CT CCA180 R+99",
                    i % 7
                )
            }))
        }),
        input("klartext-tip-vectors", |n| {
            cut(&format!(
                "M128 F20000\n{}",
                lines(n, |i| format!(
                    "LN X+{} Y+0 Z+0 TX+0,{} TY+1E-300 TZ+{}",
                    i % 9,
                    i % 7,
                    i % 2
                ))
            ))
        }),
        input("klartext-windings", |n| {
            cut(&format!(
                "M126\nFUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n{}",
                lines(n, |i| format!("L X+1 A+{} C+{i}9999999 FMAX", i % 80))
            ))
        }),
        input("klartext-unknown-words", |n| {
            cut(&lines(n, |i| {
                format!("FK X+{i} PDX+1\nSEL PATTERN \"A{i}\"\nWIDGET {i}")
            }))
        }),
        input("klartext-half-sentences", |n| {
            cut(&repeat(
                "CYCL DEF\nCALL\nLBL\nFN\nPLANE\nTOOL CALL\nCC\nL\nC DR\nCALL LBL REP\n",
                n / 5,
            ))
        }),
        input("klartext-structured", |n| {
            cut(&format!("{}{}", repeat("IF Q1 == 1\n", n), repeat("END IF\n", n)))
        }),
        input("klartext-no-begin", |n| {
            repeat("L X+1 Y+1 R0 FMAX M3 M8 M99\n", n).into()
        }),
        input("klartext-numbers", |n| {
            lines(n, |i| format!("{} L X+{},{i} Y-{i},5 R0 F MAX", i * 7 % 5, i % 5)).into()
        }),
    ]
}
