//! Okuma OSP: calls of other sections, jumps to names, variables, expressions and cycles.
use super::{Input, lines, repeat};

const NAME: &str = "okuma-osp";

/// A program with a known position, then `body`.
fn cut(body: &str) -> Vec<u8> {
    format!("$P.MIN%\nG15 H1\nG17 G90 G94 G40 G80\nT1 M6\nS1000 M3\nG56 H1\nG0 X0 Y0 Z50\nG1 X1 F100\n{body}\nM02\n")
        .into_bytes()
}

/// A name of four letters for a number.
fn named(mut number: usize) -> String {
    let mut name = String::new();
    for _ in 0..4 {
        name.push((b'A' + (number % 26) as u8) as char);
        number /= 26;
    }
    name
}

const fn input(name: &'static str, make: fn(usize) -> Vec<u8>) -> Input {
    Input::of(NAME, name, make)
}

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        input("okuma-calls-itself", |_| {
            cut("CALL OA\nM02\nOA\nG91 G1 X1\nCALL OA\nRTS")
        }),
        input("okuma-calls-itself-with-values", |_| {
            cut("CALL OA DA=1\nM02\nOA\nG1 X=DA\nCALL OA DA=DA+1 DB=DA*2\nRTS")
        }),
        input("okuma-calls-in-calls", |n| {
            cut(&format!(
                "CALL O{}\nM02\n{}",
                named(0),
                lines(n / 4, |i| format!(
                    "O{}\nG1 X{}\nCALL O{}\nRTS",
                    named(i),
                    i % 9,
                    named(i + 1)
                ))
            ))
        }),
        input("okuma-calls-repeated", |_| {
            cut(
                "V1=0\nCALL OA Q9999\nM02\nOA\nCALL OB Q9999\nRTS\nOB\nCALL OC Q99999999\nRTS\nOC\nV1=V1+1\nG1 X=V1\nRTS",
            )
        }),
        input("okuma-calls-one-many-times", |n| {
            cut(&format!(
                "{}M02\nOA\nG1 X2\nG1 X1\nRTS",
                repeat("CALL OA DA=1 DB=2\n", n)
            ))
        }),
        input("okuma-calls-what-is-missing", |n| {
            cut(&lines(n, |i| format!("CALL O{} DA={i}", named(i))))
        }),
        input("okuma-returns", |n| cut(&repeat("RTS\n", n))),
        input("okuma-programs", |n| {
            cut(&format!("M02\n{}", lines(n, |i| format!("O{}", named(i)))))
        }),
        input("okuma-moves-that-call", |n| {
            cut(&format!(
                "MODIN OA Q9\n{}MODOUT\nM02\nOA\nG1 Z-3 F50\nG0 Z9\nRTS",
                lines(n, |i| format!("X{}", i % 99))
            ))
        }),
        input("okuma-moves-that-call-themselves", |n| {
            cut(&format!(
                "{}X5\n{}M02\nOA\nMODIN OA\nX1\nRTS",
                repeat("MODIN OA\n", n),
                repeat("MODOUT\n", n)
            ))
        }),
        input("okuma-counts", |_| cut("V1=0\nNA V1=V1+1\nGOTO NA")),
        input("okuma-counts-and-moves", |_| {
            cut("V1=0\nNA V1=V1+1\nG1 X=V1 F100\nIF [V1 LT 999999999] NA")
        }),
        input("okuma-never-ends", |_| cut("NA G1 X2\nG1 X1\nIF [1 EQ 1] GOTO NA")),
        input("okuma-jumps-forward", |n| {
            cut(&lines(n / 2, |i| format!("GOTO N{0}\nN{0} G1 X{1}", named(i), i % 9)))
        }),
        input("okuma-jumps-to-one-name", |n| {
            cut(&repeat("IF [1 EQ 2] NA\nNA G1 X1\n", n))
        }),
        input("okuma-open-condition", |n| cut(&repeat("IF [VZOFX[1] EQ 1] NA\n", n))),
        input("okuma-brackets", |n| {
            cut(&format!("V1={}1{}", repeat("[", n), repeat("]", n)))
        }),
        input("okuma-functions", |n| {
            cut(&format!("V1={}1{}\nG1 X=V1", repeat("SIN[", n), repeat("]", n)))
        }),
        input("okuma-sum", |n| cut(&format!("V1=1{}", repeat("+V1*2", n)))),
        input("okuma-and-or", |n| {
            cut(&format!("IF [[1 EQ 1]{}] NA\nNA X1", repeat(" AND [1 EQ 1]", n)))
        }),
        input("okuma-indices", |n| {
            cut(&format!("V1={}1{}", repeat("V[", n), repeat("]", n)))
        }),
        input("okuma-variables", |n| {
            cut(&lines(n, |i| format!("{}={i}\nV{}=V{}+1", named(i), i % 999, i % 200)))
        }),
        input("okuma-system-variables", |n| {
            cut(&lines(n, |i| {
                format!("VZOFX[{i}]=V{}\nVTOFD[{i}]={i}\nVC{i}=VZOFX[{}]", i % 200, i % 100)
            }))
        }),
        input("okuma-continued", |n| {
            cut(&format!("G1 X1\n{}", repeat("$ Y5\n$(more) Z6\n", n)))
        }),
        input("okuma-peck-tiny", |_| {
            cut("G71 Z50\nG83 X5 Y5 Z-9000 R2 Q0.00001 F100 M54\nG73 X6 Q0.0001\nG80")
        }),
        input("okuma-peck-many-holes", |n| {
            cut(&format!(
                "G83 X0 Y0 Z-900 R2 Q0.01 F100 M54\n{}G80",
                lines(n, |i| format!("X{i}"))
            ))
        }),
        input("okuma-work-systems", |n| {
            cut(&lines(n, |i| {
                format!(
                    "G15 H{}\nG16 H{} X{}\nG56 H{}\nG1 Z{}",
                    i % 200,
                    i % 9,
                    i % 7,
                    i % 300,
                    i % 5
                )
            }))
        }),
        input("okuma-tip", |n| {
            cut(&format!(
                "G169 H1\n{}G170",
                lines(n, |i| format!("G1 X{}. A{}. C{i}9999.", i % 9, i % 80))
            ))
        }),
        input("okuma-not-modelled", |n| {
            cut(&lines(n, |i| {
                format!(
                    "LAA X{i} Y1 K9 J{}\nOMIT K{i}\nBHC I9 J{i}\nG116 T{i}\nNOEX G0 X1",
                    i % 90
                )
            }))
        }),
        input("okuma-lathe", |n| {
            lines(n, |i| {
                format!("NAT{} G85 NLAP1 D4 F0.3 U0.4 W0.1\nG50 S{i}\nG0 X{i} Z2\nG140", i % 9)
            })
            .into()
        }),
        input("okuma-half-sentences", |n| {
            cut(&repeat("CALL\nIF\nIF [\nGOTO\nMODIN\nV=\nV1=\nX=\nO\nN \n$\n", n / 5))
        }),
    ]
}
