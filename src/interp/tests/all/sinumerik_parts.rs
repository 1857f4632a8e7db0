//! Sinumerik: what the program reads of the control and of its own frames part by part, axes and characters as variables, the two parts of a
//! programmed shift, and new values of the work offset in effect.
use crate::sinumerik_values::zeroed;
use crate::support::{faults, line, lines, number, run_bytes};
use trunnion_interp::{Motion, Setup, WorkOffset};

const NAME: &str = "sinumerik-840d";
const HEAD: &str = "G17 G90 G94 G71 G1 X0 Y0 Z0 F100\n";

fn trouble(text: &str) -> Vec<String> {
    let mut found = faults(NAME, text);
    found.retain(|fault| !fault.contains("Unset"));
    found
}

/// Where the last motion ends, in machine coordinates; the program has no faults.
fn place(text: &str) -> String {
    assert_eq!(trouble(text), [""; 0], "{text}");
    let (motion, zero): (Motion, [f64; 9]) = zeroed(text).pop().expect("a motion");
    let end = motion.end.xyz().expect("a known end");
    format!(
        "{} {} {}",
        number(end.x + zero[0]),
        number(end.y + zero[1]),
        number(end.z + zero[2])
    )
}

/// Programming Manual, 12/2019, p. 315: its example, and G58 and G59 after each other.
#[test]
fn shifts_of_single_axes() {
    let at = |blocks: &str| place(&format!("{HEAD}{blocks}\nX0 Y0 Z0\nM30\n"));
    let manual = "TRANS X10 Y10 Z10\nATRANS X5 Y5";
    assert_eq!(at(manual), "15 15 10");
    assert_eq!(at(&format!("{manual}\nG58 X20")), "25 15 10");
    assert_eq!(at(&format!("{manual}\nG58 X20\nG59 X10 Y10")), "30 20 10");
    assert_eq!(at("G58 X5"), "5 0 0");
    assert_eq!(at("G59 X5\nG59 X7 Y1\nG58 X1"), "8 1 0");
    assert_eq!(at("TRANS X5\nG59 X2\nTRANS"), "0 0 0");
    assert_eq!(at("G59 X2\n$P_PFRAME=CTRANS(X,4)\nG58 X1"), "1 0 0");
    for blocks in [
        "G58",
        "ROT Z30\nG58 X5",
        "G58 A5",
        // whether the part of G59 outlives it
        "G59 X5\nTRANS X1",
        "G59 X5\n$P_PFRAME[X,TR]=1",
        "$P_PFRAME=CFINE(X,1)\nG58 X5",
        "ROT Z30\nATRANS X5\nG59 X5",
    ] {
        let text = format!("{HEAD}{blocks}\nX0 Y0 Z0\nM30\n");
        assert!(!trouble(&text).is_empty(), "{blocks}");
    }
}

/// New values act once the code is programmed again; where a motion before that ends is unknown.
#[test]
fn new_values_of_the_offset_in_effect() {
    let begin = format!("G54 {HEAD}");
    for write in ["$P_UIFR[1]=CTRANS(X,5)", "$P_UIFR[1,X,TR]=5"] {
        assert_eq!(place(&format!("{begin}{write}\nG54\nX1 Y2\nM30\n")), "6 2 0");
        assert_eq!(place(&format!("{begin}{write}\nG4 F1\nG54 X1\nM30\n")), "6 0 0");
        assert_eq!(place(&format!("{begin}{write}\nG53 G0 X3\nG54\nX1\nM30\n")), "6 0 0");
        for rest in ["X1", "X1\nG54\nX1 Y1 Z1", "CYCLE81(9,0,1,-1)"] {
            let text = format!("{begin}{write}\n{rest}\nM30\n");
            assert!(trouble(&text)[0].contains("new values of the work offset"), "{text}");
            let last = lines(NAME, &text).pop().expect("a motion");
            assert!(!last.contains(['X', 'Y', 'Z']), "{text}: {last}");
        }
        // in the same block
        assert!(!trouble(&format!("{begin}G54 {write}\nX1\nM30\n")).is_empty());
    }
    assert_eq!(
        lines(
            NAME,
            &format!("{begin}$P_UIFR[1,X,TR]=5\nG54\nR1=$P_UIFR[1,X,TR]\nY=R1\nM30\n")
        )
        .pop()
        .expect("a motion"),
        "L X-5 Y5 Z0 F100"
    );
}

/// `DEF` first, then the head.
fn x_of(definitions: &str, blocks: &str, setup: &Setup) -> Option<f64> {
    let text = format!("{definitions}{HEAD}{blocks}\nM30\n");
    run_bytes(NAME, text.as_bytes(), setup).1.motions.last()?.end.get(0)
}

#[test]
fn what_the_control_knows_of_its_codes_and_frames() {
    let mut setup = Setup::default();
    let values = [30.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    setup.work_offsets.push(WorkOffset {
        name: "G54".into(),
        values,
    });
    setup.control.main_spindle = Some(1);
    for (blocks, x) in [
        ("X=$P_GG[13]", Some(2.0)),
        ("G710\nX=$P_GG[13]", Some(4.0)),
        ("G602\nBRISK\nX=$P_GG[12]*10+$P_GG[21]", Some(21.0)),
        ("FFWON\nX=$P_GG[24]", Some(2.0)),
        ("X=$P_GG[12]", None),
        // it sets accelerations
        ("SOFT\nCYCLE832(0.1,1)\nX=$P_GG[21]", None),
        ("S1234 M3\nX=$P_S[1]", Some(1234.0)),
        ("S1234 M3\nX=$P_S[2]", None),
        ("X=$P_MSNUM", Some(1.0)),
        ("G54\nX=$P_IFRAME[X,TR]", Some(30.0)),
        ("G54\nTRANS X5\nX=$P_ACTFRAME[X,TR]", Some(35.0)),
        ("X=$P_IFRAME[X,TR]", None),
        ("G55\nX=$P_ACTFRAME[X,TR]", None),
    ] {
        assert_eq!(x_of("", blocks, &setup), x, "{blocks}");
    }
    assert_eq!(x_of("", "S1234 M3\nX=$P_S[1]", &Setup::default()), None);
}

#[test]
fn characters_axes_and_frames_are_variables() {
    let x = |definitions: &str, blocks: &str| x_of(definitions, blocks, &Setup::default());
    assert_eq!(x("DEF CHAR SIGN=65\n", "X=SIGN"), Some(65.0));
    assert_eq!(x("DEF CHAR SIGN=65\n", "SIGN=66\nX=SIGN"), Some(66.0));
    assert_eq!(x("DEF CHAR SIGN=300\n", "X=SIGN"), None);
    assert_eq!(x("DEF CHAR SIGN=65\n", "SIGN=\"B\"\nX=SIGN"), None);
    let frame = "DEF FRAME PLACE\n";
    assert_eq!(x(frame, "PLACE=CTRANS(X,5,Y,7)\nX=PLACE[Y,TR]"), Some(7.0));
    assert_eq!(x(frame, "PLACE=CTRANS(X,5):CFINE(X,1)\nX=PLACE[X,TR]"), None);
    assert_eq!(x(frame, "X=PLACE[X,SC]"), None);
    let end = |definitions: &str, blocks: &str| {
        let text = format!("{definitions}{HEAD}{blocks}\nM30\n");
        let (_, log) = run_bytes(NAME, text.as_bytes(), &Setup::default());
        log.motions.last().map(line).expect("a motion")
    };
    assert_eq!(end("", "AX[Y]=5"), "L X0 Y5 Z0 F100");
    assert_eq!(end("", "AX[X]=IC(2)"), "L X2 Y0 Z0 F100");
    assert_eq!(end("", "G18\nAX[$P_AXN1]=5"), "L X0 Y0 Z5 F100");
    assert_eq!(end("DEF AXIS A1=(Y)\n", "AX[A1]=5"), "L X0 Y5 Z0 F100");
    assert_eq!(end("DEF AXIS A1, A2\n", "A1=Y\nA2=A1\nAX[A2]=5"), "L X0 Y5 Z0 F100");
    for (definitions, blocks) in [
        ("DEF AXIS A1\n", "AX[A1]=5"),
        ("DEF AXIS A1=(Y)\n", "A1=R1\nAX[A1]=5"),
        ("", "AX[SP1]=5"),
    ] {
        let text = format!("{definitions}{HEAD}{blocks}\nM30\n");
        assert!(!trouble(&text).is_empty(), "{text}");
    }
}

/// A coordinate that G112 leaves out stays that of the last pole; G91 changes no pole.
#[test]
fn poles_after_poles() {
    let ends = |blocks: &str| lines(NAME, &format!("{HEAD}{blocks}\n")).pop();
    let after = |pole: &str| ends(&format!("G110 X5 Y0\nG1 AP=0 RP=10\n{pole}\nG1 AP=0 RP=10"));
    assert_eq!(after("G112 X1").as_deref(), Some("L X16 Y0 Z0 F100"));
    assert_eq!(after("G91\nG112 X1 Y2\nG90").as_deref(), Some("L X16 Y2 Z0 F100"));
    for pole in ["G110 X1", "G111 X1", "G112 Z1"] {
        assert!(!after(pole).expect("a motion").starts_with('L'), "{pole}");
    }
}
