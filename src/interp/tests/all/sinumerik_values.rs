//! Sinumerik: system variables that follow from the program, frames as values, fields of more dimensions, splines, and the cycles and words
//! around them.
use crate::support::{faults, lines, number, run_text};
use trunnion_dialect::builtin;
use trunnion_interp::{Fault, ModalState, Motion, MotionKind, Setup, Sink, WorkOffset, run};
use trunnion_syntax::parse;

const HEAD: &str = "G17 G90 G94 G71 G1 X0 Y0 Z0 F100\n";

/// Motions with the zero point that they refer to.
#[derive(Default)]
struct Zeroed(Vec<(Motion, [f64; 9])>);

impl Sink for Zeroed {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.0.push((*motion, state.zero.values()));
    }
    fn fault(&mut self, _: Fault) {}
}

pub(crate) fn zeroed(text: &str) -> Vec<(Motion, [f64; 9])> {
    let dialect = builtin("sinumerik-840d").expect("built in");
    let mut sink = Zeroed::default();
    run(
        &parse(text.as_bytes().to_vec(), dialect.lex),
        dialect,
        &Setup::default(),
        &mut sink,
    );
    sink.0
}

/// The program: the definitions of `text`, the head, what follows.
fn program(text: &str) -> String {
    let follows = |line: &&str| !line.starts_with("DEF ");
    let at = text
        .split_inclusive('\n')
        .take_while(|line| !follows(line))
        .map(str::len)
        .sum();
    let (definitions, rest) = text.split_at(at);
    let newline = if at == 0 || definitions.ends_with('\n') {
        ""
    } else {
        "\n"
    };
    format!("{definitions}{newline}{HEAD}{rest}")
}

/// The lines of the motions after the first.
fn after(text: &str) -> Vec<String> {
    lines("sinumerik-840d", &program(text))[1..].to_vec()
}

fn trouble(text: &str) -> Vec<String> {
    let mut found = faults("sinumerik-840d", &program(text));
    found.retain(|fault| !fault.contains("ToolLengthUnset"));
    found
}

#[test]
fn what_the_control_knows_of_its_state() {
    for (text, x) in [
        ("X5 Y6\nX=$P_EP[Y]+1", "7"),
        ("X5 Y6\nR1=$AA_IW[X]\nX=R1*2", "10"),
        ("TRANS X10\nX=$P_PFRAME[X,TR]", "10"),
        ("X=$P_F/10", "10"),
        ("S500 M3\nX=$P_S", "500"),
        ("G18\nX=$P_GG[6]", "2"),
        ("G18\nX3 Z7\nX=$P_EP[$P_AXN1]", "7"),
        ("X=$P_SIM+3", "3"),
        ("MCALL CYCLE81(9,0,1,-1)\nR1=$P_MC\nMCALL\nX=R1", "1"),
        ("T7 D2 M6\nX=$P_TOOLNO*10+$P_TOOL", "72"),
        ("$P_UIFR[2,X,TR]=25\nX=$P_UIFR[2,X,TR]", "25"),
        (
            "R2=2\n$P_UIFR[R2]=CTRANS(X,25)\nX=$P_UIFR[R2,X,TR]+$P_UIFR[2,Y,TR]",
            "25",
        ),
        ("G70\nX1\nX=$P_EP[X]+1", "50.8"),
    ] {
        let found = after(text);
        let last = found.last().expect("a motion");
        assert!(
            last.contains(&format!(" X{x} ")) || last.contains(&format!("X{x} ")),
            "{text}: {last}"
        );
        assert_eq!(trouble(text), [""; 0], "{text}");
    }
    for text in [
        "X=$AA_IM[X]",
        "X=$AA_MW[X]",
        "X=$P_TOOLR",
        "X=$P_UIFR[1,X,TR]",
        "X=$P_UIFR[1,X,RT]",
        "X=$P_EP[Q]",
        "X=$P_EP[",
        "X=$P_GG[1]",
        "X=$TC_DP3[1,1]",
    ] {
        assert!(!trouble(text).is_empty(), "{text}");
        assert!(
            !after(text)
                .iter()
                .any(|line| line.contains("X0 ") && line.starts_with("L X")),
            "{text}"
        );
    }
}

/// A loop that waits for a position ends when the position is there, and is not taken for endless.
#[test]
fn a_loop_until_a_position_is_reached() {
    let text = "REPEAT\nX=IC(10)\nUNTIL $AA_IW[X]>25\nY1";
    assert_eq!(
        after(text),
        [
            "L X10 Y0 Z0 F100",
            "L X20 Y0 Z0 F100",
            "L X30 Y0 Z0 F100",
            "L X30 Y1 Z0 F100"
        ]
    );
    assert_eq!(trouble(text), [""; 0]);
}

/// A motion to X2 Y1 Z0 in the frame; where that is without it.
fn framed(text: &str) -> String {
    let text = format!("{text}\nX2 Y1 Z0\nTRANS\nX0 Y0 Z0");
    assert_eq!(trouble(&text), [""; 0], "{text}");
    let (motion, zero) = zeroed(&format!("{}\n", program(&text)))[1];
    let end = motion.end.xyz().expect("a known end");
    let place = [end.x + zero[0], end.y + zero[1], end.z + zero[2]];
    format!("{} {} {}", number(place[0]), number(place[1]), number(place[2]))
}

/// A chain a:b takes a point first through b, then through a, as the words one after the other do.
#[test]
fn frames_are_values() {
    for (value, words) in [
        ("$P_PFRAME=CTRANS(X,10,Y,5)", "TRANS X10 Y5"),
        ("$P_PFRAME=CTRANS(X,10):CROT(Z,90)", "TRANS X10\nAROT Z90"),
        ("$P_PFRAME=CROT(Z,90):CTRANS(X,10)", "ROT Z90\nATRANS X10"),
        (
            "$P_PFRAME = CROT(Z,90) : CTRANS(X,10) : CSCALE(X,2)",
            "ROT Z90\nATRANS X10\nASCALE X2",
        ),
        ("$P_PFRAME=CMIRROR(X)", "MIRROR X0"),
        ("$P_PFRAME=CMIRROR(X,1,Y)", "MIRROR X0 Y0"),
        (
            "DEF FRAME F1\nF1=CTRANS(X,3):CROT(Z,30)\n$P_PFRAME=F1",
            "TRANS X3\nAROT Z30",
        ),
        (
            "DEF FRAME SHIFT\nSHIFT=CTRANS(X,3)\n$P_PFRAME=SHIFT:CROT(Z,30):SHIFT",
            "TRANS X3\nAROT Z30\nATRANS X3",
        ),
        ("TRANS X10\n$P_PFRAME=$P_PFRAME:CROT(Z,90)", "TRANS X10\nAROT Z90"),
        ("TRANS X10\n$P_PFRAME[Y,TR]=4", "TRANS X10 Y4"),
        ("$P_PFRAME=CTRANS()", "TRANS"),
        ("$P_UIFR[1]=CTRANS(X,10,Y,5)\nG54", "TRANS X10 Y5"),
        (
            "$P_UIFR[5,X,TR]=10\n$P_UIFR[5,Y,TR]=0\n$P_UIFR[5,Z,TR]=0\nG505",
            "TRANS X10",
        ),
    ] {
        let value = framed(&format!("{value}\nX2 Y1"));
        assert_eq!(value, framed(&format!("{words}\nX2 Y1")), "{words}");
    }
}

#[test]
fn frames_that_are_not_known_make_positions_unknown() {
    for text in [
        "$P_PFRAME=CROT(X,10,Y,20)",
        "$P_PFRAME=CROTS(X,10,Y,10,Z,10)",
        "$P_PFRAME=OTHER",
        "$P_PFRAME=CTRANS(X,R99)",
        "$P_PFRAME=CTRANS(A,10)",
        "$P_PFRAME[X,FI]=1",
        "$P_PFRAME[Z,RT]=1",
        "$P_UIFR[1]=CROT(Z,5)",
        "G54\n$P_UIFR[1]=CTRANS(X,5)",
        "$P_IFRAME=CTRANS(X,5)",
        "DEF FRAME F1\n$P_PFRAME=F1:F2",
    ] {
        let text = format!("{text}\nX1 Y1");
        assert!(!trouble(&text).is_empty(), "{text}");
        assert!(
            run_text("sinumerik-840d", &format!("{}\n", program(&text))).motions[1]
                .end
                .xyz()
                .is_none(),
            "{text}"
        );
    }
}

#[test]
fn fields_of_more_dimensions() {
    for (text, x) in [
        ("DEF REAL A[2,3]=SET(1,2,3,4,5,6)\nX=A[1,0]", "4"),
        ("DEF REAL A[2,3]=REP(7)\nR1=1\nA[R1,2]=9\nX=A[R1,R1+1]+A[0,0]", "16"),
        ("DEF INT A[2,2,2]\nA[1,1,1]=5\nX=A[1,1,1]", "5"),
        ("DEF REAL A[4]=REP(7,2)\nX=A[1]+A[2]", "7"),
        ("DEF INT A[2,2]=SET(1,0,0,1)\nX=A[A[0,1],A[1,0]]", "1"),
        ("DEF REAL A[2,2]\nA[0,1]=SET(3,4)\nX=A[1,0]", "4"),
    ] {
        let found = after(text);
        assert_eq!(
            found.last().map(String::as_str),
            Some(format!("L X{x} Y0 Z0 F100").as_str()),
            "{text}"
        );
        assert_eq!(trouble(text), [""; 0], "{text}");
    }
    for text in [
        "DEF REAL A[2,3]\nX=A[2,0]",
        "DEF REAL A[2,3]\nX=A[1]",
        "DEF REAL A[2,3]\nA[R9,0]=1\nX=A[0,0]",
    ] {
        assert!(after(text).iter().all(|line| !line.starts_with("L X0")), "{text}");
        assert!(!trouble(text).is_empty(), "{text}");
    }
}

/// A variable may be named like an address; what is written to it counts.
#[test]
fn variables_that_are_named_like_addresses() {
    for (define, text) in [
        ("DEF REAL H2=5", "H2 = 7\nX=H2"),
        ("DEF REAL H2", "H2=7\nX=H2"),
        ("DEF REAL S3=2", "S3=7\nX=S3"),
        ("DEF INT Q", "Q=7\nX=Q"),
        ("DEF REAL H2=5", "R1=7\nH2=R1\nX=H2"),
    ] {
        let text = format!("{define}\n{HEAD}{text}\n");
        assert_eq!(
            lines("sinumerik-840d", &text).last().map(String::as_str),
            Some("L X7 Y0 Z0 F100"),
            "{text}"
        );
        assert_eq!(faults("sinumerik-840d", &text), [""; 0], "{text}");
    }
    // without the declaration it is the address
    assert!(trouble("S3=7")[0].contains("S3=7"));
}

#[test]
fn splines_have_known_ends() {
    let ends = |text: &str| -> Vec<(bool, Option<[f64; 3]>)> {
        let log = run_text("sinumerik-840d", &format!("{}\n", program(text)));
        let moves = log.motions[1..].iter();
        moves
            .map(|motion| (motion.kind == MotionKind::Unknown, motion.end.xyz().map(Into::into)))
            .collect()
    };
    for code in ["ASPLINE", "CSPLINE"] {
        assert_eq!(
            ends(&format!("{code} X1 Y2\nX3 Y4\nG1 X5")),
            [
                (true, Some([1.0, 2.0, 0.0])),
                (true, Some([3.0, 4.0, 0.0])),
                (false, Some([5.0, 4.0, 0.0]))
            ],
            "{code}"
        );
    }
    assert_eq!(
        ends("BSPLINE X1 Y2 PW=2\nX3 Y4\nX5\nG1 Y9\nX6"),
        [
            (true, None),
            (true, None),
            (true, None),
            (false, Some([5.0, 9.0, 0.0])),
            (false, Some([6.0, 9.0, 0.0]))
        ]
    );
    let poly =
        ends("POLY PO[X]=(10,2.5) PO[Y]=(3,-1,0.5) PL=2\nPO[X]=(20)\nPO[X]=(0,-10) PO[Y]=(10) PO[]=(2,1)\nG1 X5");
    let mut wanted = [[10.0, 3.0, 0.0], [20.0, 3.0, 0.0], [0.0, 10.0, 0.0], [5.0, 10.0, 0.0]]
        .iter()
        .peekable();
    for (unknown, end) in poly {
        assert!(!unknown, "{end:?}");
        let end = end.expect("known");
        if wanted
            .peek()
            .is_some_and(|place| (0..3).all(|axis| (place[axis] - end[axis]).abs() < 1e-12))
        {
            wanted.next();
        }
    }
    assert_eq!(wanted.next(), None);
    // each is said once by its name
    for code in ["ASPLINE X1", "BSPLINE X1"] {
        let name = code.split(' ').next().expect("a name");
        assert_eq!(trouble(code).len(), 1, "{code}");
        assert!(trouble(code)[0].contains(name), "{code}");
    }
    assert_eq!(
        ends("PO[X]=(10,2)\nG1 X3"),
        [(true, None), (false, Some([3.0, 0.0, 0.0]))]
    );
    assert!(trouble("PO[X]=(10,2)")[0].contains("where POLY is not in effect"));
    // the direction at the end of a spline is not known
    assert!(
        ends("CSPLINE X1 Y2\nCT X3 Y4")
            .last()
            .is_some_and(|end| end.1.is_some())
    );
    assert!(
        trouble("CSPLINE X1 Y2\nCT X3 Y4")
            .iter()
            .any(|fault| fault.contains("CT"))
    );
}

#[test]
fn cycle840_taps_with_a_floating_chuck() {
    let text = "S500 M3\nG0 Z10\nCYCLE840(10,0,2,-12,,0,4,3,0,0,1.25)\nX5";
    assert_eq!(
        after(text)[1..],
        [
            "R X0 Y0 Z2",
            "L X0 Y0 Z-12 F1.25/rev",
            "L X0 Y0 Z2 F1.25/rev",
            "R X0 Y0 Z10",
            "R X5 Y0 Z10"
        ]
    );
    assert_eq!(trouble(text), [""; 0]);
    // ENC 1: the lead is that of F
    assert!(after("S500 M3\nG0 Z10\nCYCLE840(10,0,2,-12,,0,4,3,1)")[2].starts_with("L X0 Y0 Z-12 F100"));
    assert!(trouble("S500 M3\nG0 Z10\nCYCLE840(10,0,2,-12,,0,4,3,0,8.2)")[0].contains("the pitch"));
    assert!(after("S500 M3\nG0 Z10\nCYCLE840(10,0,2,-12,,0,4,3,0,8)")[2].starts_with("L X0 Y0 Z-12 F1.25/rev"));
    assert!(trouble("G0 Z10\nCYCLE840(10,0,2,-12,,0,4,3,0,0,1,2)")[0].contains("CYCLE840"));
}

/// CP: the control does not read STAT and TU.
#[test]
fn stat_and_tu_act_point_to_point_only() {
    let with = |travel: &str| trouble(&format!("TRAORI\n{travel}\nG1 X1 A10 STAT=1 TU=2\nTRAFOOF"));
    assert_eq!(with("CP"), [""; 0]);
    assert_eq!(with(";"), [""; 0]);
    assert!(
        !trouble("G1 X1 STAT=1").is_empty(),
        "without a transformation no source says what it is"
    );
}

#[test]
fn an_offset_that_is_declared_is_known() {
    let offset = WorkOffset {
        name: "G54".to_owned(),
        values: [10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let setup = Setup {
        work_offsets: vec![offset],
        ..Setup::default()
    };
    let text = format!("{HEAD}X=$P_UIFR[1,X,TR]\nM30\n");
    let log = crate::support::run_bytes("sinumerik-840d", text.as_bytes(), &setup).1;
    assert_eq!(log.motions[1].end.get(0), Some(10.0));
}

/// A colon chains frames inside an expression, and is a label or a mistake elsewhere.
#[test]
fn where_a_colon_may_stand() {
    let dialect = builtin("sinumerik-840d").expect("built in");
    let errors = |text: &str| parse(text.as_bytes().to_vec(), dialect.lex).errors().len();
    for text in [
        "$P_PFRAME=CTRANS(X,10):CROT(Z,90)\n",
        "$P_UIFR[1]=$P_UIFR[2] : CTRANS(X,1)\n",
        "SHIFT=ONE:TWO:THREE\n",
        "LABEL: X=R1\n",
        ":10 X5\n",
    ] {
        assert_eq!(errors(text), 0, "{text}");
    }
    for text in ["X=5:6\n", "X5 : Y6\n", "SHIFT=ONE:\n"] {
        assert!(errors(text) > 0, "{text}");
    }
}
