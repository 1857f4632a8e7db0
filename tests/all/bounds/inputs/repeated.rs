//! Cycles that make many motions, or work much out for nothing, in loops and at many points.
use super::{Input, cut, lines};

pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::of("fanuc-30i-lathe-a", "grooves-in-a-loop", |n| {
            in_a_loop(n, "G75 X20. Z-9. P20 Q3000 F.1")
        }),
        Input::of("fanuc-30i-lathe-a", "threads-in-a-loop", |n| {
            in_a_loop(n, "G76 P010060 Q1 R.001\nG76 X38.16 Z-25. P919 Q1 F1.5")
        }),
        Input::of("fanuc-30i-lathe-c", "grooves-without-depth", |_| {
            cut("G0 X50. Z-25.\nG1 Z-26. ,R2. F.1\nG76 R1.\nG76 X9999999. Z-26. P9 Q3 F.1")
        }),
        Input::of("fanuc-30i-lathe-a", "threads-of-too-many-cuts", |n| {
            in_a_loop(n, "G76 P010060 Q0 R.001\nG76 X38.16 Z-25. P919 Q1 F1.5")
        }),
        Input::of("fanuc-30i-lathe-a", "contours-in-a-loop", |n| {
            let contour = lines(n / 50, |i| format!("G1 X{}. Z-{i}.", 20 + i % 7));
            let run = in_a_loop(n, "G71 U1. R.1\nG71 P10 Q20 F.1");
            let run = String::from_utf8_lossy(&run).replace("M30", "GOTO 30");
            format!("{run}N10 G0 X20.\n{contour}N20 G1 X50.\nN30 M30\n").into_bytes()
        }),
        Input::of("apt", "apt-deep-holes", |n| {
            let holes = lines(n, |i| format!("GOTO/{},2,0", i % 100));
            format!("PARTNO A\nUNITS/MM\nCYCLE/DEEP,DEPTH,500,STEP,0.1,MMPM,100,CLEAR,2\n{holes}CYCLE/OFF\nFINI\n")
                .into_bytes()
        }),
        Input::of("sinumerik-840d", "rows-in-a-loop", |n| {
            cut(&format!(
                "F100\nMCALL CYCLE81(10,0,1,-5)\nDEF INT I\nFOR I=1 TO {n}\nHOLES1(0,0,0,1,1,9999)\nHOLES2(0,0,10,0,1,9999)\nENDFOR"
            ))
        }),
        Input::of("sinumerik-840d", "polynomials-in-a-loop", |n| {
            cut(&format!(
                "DEF INT I\nFOR I=1 TO {n}\nPOLY PO[X]=(10,5000,5000) PO[Y]=(5,1000,1000)\nG1 X0 Y0\nENDFOR"
            ))
        }),
    ]
}

/// A turning cycle with hundreds of motions, as often as there are lines.
fn in_a_loop(n: usize, cycle: &str) -> Vec<u8> {
    cut(&format!(
        "G0 X50. Z2.\nG75 R1.\n#1=0\nWHILE[#1LT{n}]DO1\n#1=#1+1\n{cycle}\nEND1"
    ))
}
