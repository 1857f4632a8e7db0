//! Numbers: labels, variables, tools, calls, comments, findings.
use super::{Input, cut, lines, repeat};

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("lines", |n| cut(&lines(n, |i| format!("X{i}")))),
        Input::new("five-axis-lines", |n| {
            cut(&format!(
                "G43.4 H1\nTRAORI\n{}",
                lines(n, |i| format!("G1 X{} Y{} A{}.5 C{}", i % 97, i % 89, i % 41, i % 360))
            ))
        }),
        Input::new("apt-lines", |n| {
            format!(
                "PARTNO\nMULTAX/ON\nFEDRAT/100,MMPM\n{}FINI\n",
                lines(n, |i| format!("GOTO/{},{},1,0,0,1", i % 97, i % 89))
            )
            .into()
        }),
        Input::new("apt-words", |n| {
            format!("PARTNO\nGOTO/1{}\nFINI\n", repeat(",1", n)).into()
        }),
        Input::new("block-numbers", |n| cut(&lines(n, |i| format!("N{i} G1 X{}", i % 7)))),
        Input::new("same-block-number", |n| {
            cut(&format!("{}GOTO10", repeat("N10 G1 X1.\n", n)))
        }),
        Input::new("labels", |n| cut(&lines(n, |i| format!("L_{i}: G1 X{}", i % 7)))),
        Input::new("same-label", |n| cut(&format!("GOTOF L\n{}", repeat("L: G1 X1.\n", n)))),
        Input::new("jumps-to-missing-numbers", |n| {
            cut(&lines(n, |i| format!("IF[#1EQ1]GOTO{i}")))
        }),
        Input::new("jumps-to-missing-labels", |n| {
            cut(&lines(n, |i| format!("IF R1==1 GOTOF NO_{i}")))
        }),
        Input::new("jumps-here-and-there", |n| {
            cut(&format!(
                "{}{}",
                lines(n / 2, |i| format!("N{} GOTO{}", 2 * i, (n - 1).saturating_sub(2 * i))),
                lines(n / 2, |i| format!(
                    "N{} GOTO{}",
                    2 * i + 1,
                    (n - 1).saturating_sub(2 * i + 2)
                ))
            ))
        }),
        Input::new("jumps-to-labels-here-and-there", |n| {
            cut(&format!(
                "{}{}",
                lines(n / 2, |i| format!("A{i}: GOTOF B{i}")),
                lines(n / 2, |i| format!("B{i}: GOTOB A{}", i + 1))
            ))
        }),
        Input::new("jumps-forward", |n| {
            cut(&lines(n, |i| format!("N{} GOTO{}", i + 1, i + 2)))
        }),
        Input::new("jumps-on-unknown", |n| {
            cut(&lines(n, |i| format!("IF[#5061GT{i}]GOTO{}\nN{} G1 X1.", i + 1, i + 1)))
        }),
        Input::new("program-numbers", |n| lines(n, |i| format!("O{i}\nG1 X1.\nM99")).into()),
        Input::new("same-program-number", |n| repeat("O1\nG1 X1.\nM99\n", n).into()),
        Input::new("programs-that-return", |n| {
            lines(n / 4, |i| format!("O{}\nN{i} M98 P{}\nM98 P1\nM99 P{i}", i + 1, i + 2)).into()
        }),
        Input::new("numbers-with-zeros", |n| {
            cut(&format!(
                "N{}1 X1.\n{}",
                repeat("0", n),
                lines(n, |i| format!("N{i} X1."))
            ))
        }),
        Input::new("enormous-program-number", |n| {
            format!("O{}\nM98 P{}\nM30\n", repeat("9", n), repeat("9", n)).into()
        }),
        Input::new("calls-of-missing-programs", |n| cut(&lines(n, |i| format!("M98 P{i}")))),
        Input::new("calls-of-missing-subs", |n| {
            cut(&lines(n, |i| format!("o{i} call\no<name_{i}> call [1]")))
        }),
        Input::new("calls-of-missing-names", |n| {
            cut(&lines(n, |i| format!("SUB_{i}(1,2)")))
        }),
        Input::new("calls-of-macros", |n| cut(&lines(n, |i| format!("G65 P{i} A1. B2.")))),
        Input::new("subs", |n| {
            cut(&lines(n, |i| format!("o{i} sub\nG1 X1.\no{i} endsub\no{i} call")))
        }),
        Input::new("one-sub-many-calls", |n| {
            format!(
                "O1\nG21 G90 G94 F100.\nG1 X0. Y0. Z0.\n{}M30\nO2\n{}M99\n",
                repeat("M98 P2\n", n),
                repeat("G1 X1.\n", n)
            )
            .into()
        }),
        Input::new("variables", |n| cut(&lines(n, |i| format!("#{i}=#{}+1", i + 1)))),
        Input::new("named-parameters", |n| cut(&lines(n, |i| format!("#<name_{i}>={i}")))),
        Input::new("r-parameters", |n| cut(&lines(n, |i| format!("R{i}=R{}+1", i + 1)))),
        Input::new("definitions", |n| lines(n, |i| format!("DEF REAL V_{i}={i}")).into()),
        Input::new("definitions-of-one-line", |n| {
            format!("DEF REAL V_0{}\n", repeat(", VAR_X", n)).into()
        }),
        Input::new("enormous-array", |_| {
            cut("DEF REAL A[999999999,999999999]\nA[1,1]=2\nDEF STRING[999999999] S\nS=\"X\"\nR1=A[0,0]")
        }),
        Input::new("array-written-whole", |_| {
            cut("DEF REAL A[999999999]\nA[0]=REP(1)\nA[0]=SET(1,2,3)\nG1 X=A[5]")
        }),
        Input::new("g-codes", |n| cut(&lines(n, |i| format!("G{}.{}", i % 1000, i % 10)))),
        Input::new("m-codes", |n| cut(&lines(n, |i| format!("M{i}")))),
        Input::new("tools", |n| cut(&lines(n, |i| format!("T{i} M6 D1 H{i}")))),
        Input::new("lengths-of-many-tools", |n| {
            cut(&lines(n / 3, |i| format!("T{i} M6\nG43 H{i}\nG1 Z{}.", i % 7)))
        }),
        Input::new("conditions-of-one-line", |n| {
            cut(&format!("{}#5221=7.", repeat("IF[#1EQ1]THEN ", n)))
        }),
        Input::new("offsets", |n| {
            cut(&lines(n, |i| {
                format!("G10 L2 P{} X{i}. Y1.\nG54.1 P{}", i % 400, i % 400)
            }))
        }),
        Input::new("feeds", |n| cut(&lines(n, |i| format!("G1 X{} F{i} S{i}", i % 9)))),
        Input::new("comments", |n| {
            cut(&lines(n, |i| {
                format!("(comment {i}) G1 X{} (another) ; and one", i % 9)
            }))
        }),
        Input::new("messages", |n| {
            cut(&lines(n, |i| {
                format!("MSG(\"text {i}\")\n(MSG, text {i})\n#3000=1(text {i})")
            }))
        }),
        Input::new("modelines", |n| {
            cut(&lines(n, |i| format!("(trunnion: tool {i} ball diameter 10)")))
        }),
        Input::new("modelines-of-machines", |n| {
            cut(&repeat("(trunnion: machine nothing)\n", n))
        }),
        Input::new("allowed-rules", |n| {
            cut(&repeat("(trunnion: allow unknown-word)\n@ @ @\n", n))
        }),
        Input::new("printed-parameters", |n| {
            cut(&repeat("(print, #1 #2 #<a> %d %f)\n(debug, #5420)\n", n))
        }),
        Input::new("unknown-words", |n| cut(&lines(n, |i| format!("QQ{i} @ W! \\ ~{i}")))),
        Input::new("arcs-without-centre", |n| cut(&repeat("G2 X1. Y1.\nG3 R\n", n))),
        Input::new("stops", |n| cut(&repeat("M0\nM1\nG4 P1\n", n))),
        Input::new("ends", |n| repeat("M30\n%\n", n).into()),
        Input::new("outputs", |n| {
            cut(&lines(n, |i| {
                format!("M62 P{}\nM68 E{} Q{i}\n$A_OUT[{}]=1", i % 64, i % 4, i % 9)
            }))
        }),
        Input::new("synchronous-actions", |n| {
            cut(&lines(n, |i| format!("ID={i} WHENEVER $AA_IM[X]>1 DO M3")))
        }),
        Input::new("probes", |n| {
            cut(&lines(n, |i| format!("G38.2 Z-{i} F10\nG31 X{i}.\nMEAS=1 X{i}")))
        }),
        Input::new("frames-on-frames", |n| {
            cut(&repeat("ATRANS X1\nAROT Z1\nASCALE X2\nG1 X1\n", n))
        }),
        Input::new("rotations-on-rotations", |n| {
            cut(&lines(n, |i| format!("G68 X0 Y0 R{}\nG1 X1.\nG52 X{i}", i % 360)))
        }),
        Input::new("tilted-planes", |n| {
            cut(&lines(n, |i| {
                format!(
                    "G68.2 X0 Y0 Z0 I{} J10 K0\nG53.1\nG1 X1.\nCYCLE800(0,\"\",0,57,0,0,0,{},0,0,0,0,0,1)",
                    i % 360,
                    i % 90
                )
            }))
        }),
        Input::new("incremental-steps", |n| {
            cut(&format!("G91\n{}", repeat("G1 X999999999999. Y1E300 Z0.0000001\n", n)))
        }),
        Input::new("splines", |n| {
            cut(&lines(n, |i| {
                format!("G5.2 X{i} Y{} P1\nG5 X{i} Y1 I1 J1 P1 Q1", i % 9)
            }))
        }),
        Input::new("b-splines", |n| {
            cut(&format!(
                "BSPLINE\n{}",
                lines(n, |i| format!("X{i} Y{} PW=0.1 PL=0", i % 9))
            ))
        }),
        Input::new("nurbs", |n| {
            cut(&format!(
                "G6.2 P4 K0. X0. Y0. Z0. R1.\n{}",
                lines(n, |i| format!("K{i}. X{i}. Y{}. R1.", i % 9))
            ))
        }),
        Input::new("compensated-contour", |n| {
            cut(&format!(
                "G41 D1\n{}G40 X0.",
                lines(n, |i| format!("G1 X{}. Y{}.", i, (i * 7) % 5))
            ))
        }),
        Input::new("compensated-standstill", |n| {
            cut(&format!(
                "G41 D1\nG1 X10. Y10.\n{}G1 X20.\nG40 X0.",
                repeat("G1 X10. Y10.\nM8\n", n)
            ))
        }),
        Input::new("compensated-zigzag", |n| {
            cut(&format!(
                "G42 D1\n{}",
                repeat("G1 X1. Y0.\nX1.0001 Y0.0001\nX1. Y0.\n", n)
            ))
        }),
        Input::new("chamfers", |n| {
            cut(&lines(n, |i| {
                format!("G1 X{i}. ,C999.\nY{i}. ,R0.0001\nX1 RND=5 CHF=3")
            }))
        }),
        Input::new("turning-contour", |n| {
            cut(&format!(
                "G71 U1. R1.\nG71 P10 Q20 U0.1 W0.1\nN10 G0 X0.\n{}N20 X100.\nG70 P10 Q20",
                lines(n, |i| format!("G1 X{}. Z-{i}.", i % 77))
            ))
        }),
    ]
}
