//! One block that makes a great deal: pecks, repeats, turns, patterns, pockets.
use super::{HEAD, Input, cut, lines};

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("peck-tiny", |_| cut("G83 Z-30. R2. Q0.0000001 F100.\nG80\nG1 X5.")),
        Input::new("peck-small", |_| cut("G83 Z-30. R2. Q0.0001 F100.\nG80\nG1 X5.")),
        Input::new("peck-zero", |_| cut("G83 Z-30. R2. Q0 F100.\nG80")),
        Input::new("peck-negative", |_| cut("G83 Z-30. R2. Q-1. F100.\nG80")),
        Input::new("peck-many-holes", |n| {
            cut(&format!(
                "G83 Z-30. R2. Q0.01 F100.\n{}G80",
                lines(n, |i| format!("X{i}."))
            ))
        }),
        Input::new("peck-chips", |_| cut("G73 Z-30. R2. Q0.0001 F100.\nG80\nG1 X5.")),
        Input::new("peck-shrinking", |_| {
            cut("G83 Z-30. R2. I1. J0.0001 K0.0001 F100.\nG80")
        }),
        Input::new("cycle83-tiny", |_| {
            cut("CYCLE83(10,0,2,-100,,,0.0001,0.0001,0,0,1,0,3,0.0001)\nG1 X5")
        }),
        Input::new("mcall-many-holes", |n| {
            cut(&format!(
                "MCALL CYCLE83(10,0,2,-100,,,0.01,0.01,0,0,1,0,3,0.01)\n{}MCALL",
                lines(n, |i| format!("X{i}"))
            ))
        }),
        Input::new("repeat-l", |_| cut("G91 G81 X1. Y1. Z-3. R-1. L999999999 F100.\nG80")),
        Input::new("repeat-k", |_| {
            cut("G91 G99 G81 X1. Y1. Z-3. R-1. K999999999 F100.\nG80")
        }),
        Input::new("bolt-circle", |_| {
            cut("G81 Z-3. R2. F100. L0\nG70 I10. J0 L999999999\nG71 I1. J0 K1. L99999999\nG80")
        }),
        Input::new("holes", |_| {
            cut(
                "MCALL CYCLE81(10,0,2,-5)\nHOLES2(0,0,50,0,0.00001,999999999)\nHOLES1(0,0,0,1,1,999999999)\nCYCLE801(0,0,0,1,1,99999,99999)\nMCALL",
            )
        }),
        Input::new("pocket-circular", |_| {
            cut("G12 I0.001 K500. Q0.0001 Z-1. F100. D1\nG13 I0.001 K500. Q0.0001 Z-999. L99999 F100.")
        }),
        Input::new("pocket-milled", |_| {
            cut(
                "POCKET3(10,0,1,-500,999,999,5,0,0,0,0.0001,0,0,100,100,0,11,0.0001)\nPOCKET4(10,0,1,-500,999,0,0,0.0001,0,0,100,100,0,11,0.0001)\nCYCLE71(50,1,1,0,0,0,999,999,0,0.0001,0.0001,1,0,100,31,1)\nSLOT1(10,0,1,-9,,999999,9,0,0,50,0,1,100,100,0.0001,2,0)",
            )
        }),
        Input::new("thread-turning", |_| {
            cut("G0 X50. Z5.\nG76 P999960 Q0.0001 R0.0001\nG76 X10. Z-30. P20. Q0.00001 F2.\nG92 X49. Z-30. F0.0001")
        }),
        Input::new("thread-turning-old", |_| {
            cut("G0 X50. Z5.\nG76 X10. Z-30. K20. D0.0001 F2. A60\nG76 P1 Z-30 I-1 J0.00001 K20 R1 Q0 H99999 E1 L2")
        }),
        Input::new("thread-cycle97", |_| {
            cut("CYCLE97(1,,0,-30,50,50,0,0,20,0.00001,30,0,99999999,9999999,3,99999)\nG1 X5")
        }),
        Input::new("rough-turning", |_| {
            cut(
                "G0 X5000. Z5.\nG71 U0.0001 R0.1\nG71 P10 Q20 U0.1 W0.1\nN10 G0 X0.\nG1 Z-50.\nN20 X5000.\nG72 W0.0001 R0.1\nG72 P10 Q20\nG73 U500. W1. R99999999\nG73 P10 Q20\nG70 P10 Q20",
            )
        }),
        Input::new("rough-turning-cycle95", |_| {
            cut("CYCLE95(\"A:B\",0.00001,0,0,0,100,100,100,9,0,0,1)\nA:\nX0\nZ-50\nX500\nB:")
        }),
        Input::new("groove-turning", |_| {
            cut(
                "G0 X50. Z5.\nG75 R0.1\nG75 X10. Z-30. P0.0001 Q0.0001\nG74 R0.1\nG74 X10. Z-30. P0.0001 Q0.0001\nCYCLE93(50,0,30,20,0,0,0,0,0,0,0,0,0,0.0001,1,5)",
            )
        }),
        Input::new("boring-with-dwell", |_| {
            cut("G82 Z-3. R2. P1E300 F1E-300\nG89 Z-3. R2. P99999999999\nG4 P1E300\nG4 X99999999999.\nG80")
        }),
        Input::new("tapping", |_| {
            cut("G84 Z-3000000000. R2. F0.000001 S99999999\nG84.2 Z-3.\nG33 Z-1E9 K0.000001\nG80")
        }),
        Input::new("arc-tiny-and-huge", |n| {
            cut(&lines(n, |i| {
                format!(
                    "G2 X{}. Y0. R1E-9\nG3 X1. Y0. I0.0000001 J99999999999.\nG2 X1E9 Y1E9 R{i}E20",
                    i % 7
                )
            }))
        }),
        Input::new("arc-full-turns", |n| {
            cut(&lines(n, |i| {
                format!("G2 X0. Y0. I10. J0. P{}99999999\nG3 X0 Y0 I10 J0 TURN=99999999", i % 9)
            }))
        }),
        Input::new("arc-helix", |n| {
            cut(&lines(n, |_| {
                "G2 X0. Y0. Z-1E9 I10. J0. L999999999\nG3 X0. Y0. Z0. I1E-9 J0.".to_owned()
            }))
        }),
        Input::new("arc-radius-zero", |n| {
            cut(&lines(n, |i| format!("G2 X{i}. Y1. R0\nG3 X{i}. Y2. I0 J0\nG2 I0")))
        }),
        Input::new("arcs", |n| {
            cut(&lines(n, |i| format!("G{} X{}. Y0. R5.", i % 2 + 2, i % 2 * 10)))
        }),
        Input::new("arcs-full", |n| cut(&lines(n, |i| format!("G2 I{}. J0.", i % 9 + 1)))),
        Input::new("windings", |n| {
            cut(&lines(n, |i| {
                format!("G1 C{}99999999. A{}.\nG0 C-{}E12 B1E15", i % 9, i % 80, i % 7)
            }))
        }),
        Input::new("windings-tip", |n| {
            format!(
                "{HEAD}TRAORI\nG43.4 H1\n{}M30\n",
                lines(n, |i| format!(
                    "G1 X1. Y1. C{}9999999. A{}.\nA3={} B3=0 C3=1",
                    i % 9,
                    i % 80,
                    i % 3
                ))
            )
            .into()
        }),
        Input::new("through-the-pole", |n| {
            format!(
                "{HEAD}TRAORI\nG43.4 H1\n{}M30\n",
                lines(n, |i| format!(
                    "G1 X{}. Y0. Z0. A{} C{}.",
                    i % 50,
                    if i % 2 == 0 { "0.0001" } else { "-0.0001" },
                    i * 179 % 360
                ))
            )
            .into()
        }),
        Input::new("vectors-nearly-zero", |n| {
            format!(
                "{HEAD}TRAORI\nG43.5 H1\n{}M30\n",
                lines(n, |i| format!(
                    "G1 X{}. A3=1E-300 B3={}E-200 C3=0\nX1. I1E-200 J0 K{}E300",
                    i % 9,
                    i % 5,
                    i % 5
                ))
            )
            .into()
        }),
        Input::new("speeds", |n| {
            cut(&lines(n, |i| {
                format!("G93 G1 X{i}. F1E-300\nG94 G1 X1. F{i}E300\nG95 G1 X2. F0\nG96 S1E300\nS-1 M3\nG97 S0")
            }))
        }),
        Input::new("impossible-arithmetic", |n| {
            cut(&lines(n, |i| {
                format!(
                    "#1=1/0\n#2=SQRT[-{i}]\n#3=9**9**9**9\n#4=TAN[90]\n#5=LN[0]\n#6=EXP[99999]\nR1=1/0 R2=SQRT(-1) R3=POT(1E200)\nG1 X#1 Y#3"
                )
            }))
        }),
        Input::new("scales", |n| {
            cut(&lines(n, |i| {
                format!("G51 X0 Y0 P{i}E30\nG1 X1.\nSCALE X=1E300\nG1 X1E300\nMIRROR X\nG51.1 X0")
            }))
        }),
        Input::new("threads-of-lead-zero", |n| {
            cut(&lines(n, |i| {
                format!("G33 Z-{i}. K0\nG33 Z1. K1E-300\nG32 Z-5. F0\nG34 Z-9. F1. K1E9")
            }))
        }),
        Input::new("polar", |n| {
            cut(&format!(
                "G12.1\nTRANSMIT\nG16\n{}",
                lines(n, |i| format!("G1 X0.0000{} C{}. Y{i}E9", i % 9, i))
            ))
        }),
    ]
}
