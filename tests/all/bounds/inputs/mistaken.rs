//! Brackets that do not match, words beyond what a call or a cycle takes, sections that stay open, patterns in loops.
use super::{Input, cut, lines, repeat};

pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("brackets-that-do-not-match", |n| repeat("[)", n / 4).into()),
        Input::new("brackets-of-two-kinds", |n| {
            cut(&format!("R1={}1{}", repeat("A[", n / 8), repeat(")", n / 8)))
        }),
        Input::of("sinumerik-840d", "strings-in-brackets", |n| {
            cut(&format!(
                "DEF STRING[8] NN=\"A\"\nIF {}1{}==\"A\" GOTOF LA\nX={}NN{}\nLA: X2",
                repeat("NN<<(", n / 8),
                repeat(")", n / 8),
                repeat("STRLEN(<<", n / 8),
                repeat(")", n / 8)
            ))
        }),
        Input::of("fanuc-30i", "arguments-of-a-macro", |n| {
            format!("O1\nG65P2{}\nM30\nO2\nM99\n", repeat("I1.J1.K1.", n / 8)).into()
        }),
        Input::of("sinumerik-840d", "sections-that-stay-open", |n| {
            cut(&lines(n, |i| format!("LA{i}: REPEATB LA{} P=99", i + 1)))
        }),
        Input::of("sinumerik-840d", "names-that-stand-for-names", |n| {
            cut(&lines(n, |i| format!("DEFINE AA{i} AS AA{0} AA{0}", i + 1)))
        }),
        Input::of("heidenhain-klartext", "klartext-cycle-parameters", |n| {
            let given = repeat(" ~\n Q200=1", n / 2);
            format!(
                "BEGIN PGM A MM\nCYCL DEF 200 DRILLING{given}\n{}END PGM A MM\n",
                repeat("CYCL CALL\n", n / 2)
            )
            .into()
        }),
        Input::of("heidenhain-klartext", "klartext-patterns", |n| {
            let points = lines(n / 8, |i| format!(" POS{i} (X+{} Y+1 Z+0) ~", i % 500));
            format!(
                "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nCYCL DEF 200 Q200=2 Q201=-5 Q206=100 Q202=5 Q203=0 Q204=50\n\
                 PATTERN DEF ~\n{points} POS99 (X+1 Y+1 Z+0)\n{}END PGM A MM\n",
                repeat("CYCL CALL PAT F100\n", n / 2)
            )
            .into()
        }),
        Input::of("linuxcnc", "splines-of-a-high-order", |n| {
            let points = lines(n / 2, |i| format!("X{i} Y{} P1", i % 9));
            let order = points.lines().count();
            cut(&format!(
                "F100\nG1 X0 Y0 Z5\nG5.2 P1 L{order} X0 Y0\n{points}G5.3\nM2\n"
            ))
        }),
        Input::of("linuxcnc", "splines-of-many-chords", |n| {
            let there = "G5.1 X1000000 Y5 I900000 J900000\nG5.1 X0 Y0 I900000 J-900000\n";
            cut(&format!("F100\nG1 X0 Y0 Z5\n{}M2\n", repeat(there, n / 2)))
        }),
        Input::of("fanuc-30i", "modal-macros-without-end", |n| {
            let begins = lines(n / 2, |i| format!("G66P{}A1.", 1000 + i % 8000));
            cut(&format!(
                "O1\n{begins}G1X1.F100.\nX2.\nM30\n{}",
                lines(n / 2, |i| { format!("O{}\nG1X#1\nM99", 1000 + i % 8000) })
            ))
        }),
        Input::of("fanuc-30i", "obstacles-beside-rapids", |n| {
            let far = lines(n / 2, |i| {
                format!(
                    "(trunnion: obstacle name = \"c{i}\", box = [[{0},0,0],[{1},20,30]])",
                    1000 + i % 50,
                    1001 + i % 50
                )
            });
            cut(&format!(
                "G21G90G17G94G54\n{far}{}M30\n",
                lines(n / 2, |i| format!("G0X{}.Y-30.Z5.\nY30.", i % 90))
            ))
        }),
    ]
}
