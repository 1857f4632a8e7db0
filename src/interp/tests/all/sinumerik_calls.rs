//! Sinumerik: repeated sections and subprograms, checked by hand against the programming manual (12/2019, 3.1.6, 3.2.2, 3.2.3).
use crate::sinumerik_flow::{SINUMERIK, clean, said, said_with};
use crate::support::{line, lines, run_bytes};
use std::sync::Arc;
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

struct Folder;

impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let text: &str = match name {
            "CUT.SPF" => "PROC CUT(REAL DEPTH, INT CNT=2, VAR REAL OUT)\nG0 Z=DEPTH\nZ=CNT\nOUT=DEPTH+CNT\nM17\n",
            "SHIFT.SPF" => {
                "PROC SHIFT(VAR REAL FROM[3], VAR REAL TO[], REAL BY[2,2])\nDEF INT I\nFOR I=0 TO 2\nTO[I]=FROM[I]+BY[1,0]\nENDFOR\nBY[1,0]=99\nRET\n"
            }
            "BOTH.SPF" => "PROC BOTH(VAR REAL ONE, VAR REAL TWO)\nONE=1\nTWO=2\nG0 X=ONE\nRET\n",
            "L20.SPF" => "R1=R1+1\nG0 X=R1\nM17\n",
            "L020.SPF" => "G0 X=-20\nM17\n",
            "L140.SPF" => "PROC L140(REAL DEPTH)\nG0 Z=DEPTH\nRET\n",
            "DRILLS.SPF" => "CYCLE82(10,0,2,-8,,1)\nRET\n",
            "PLAIN.SPF" => "G0 Y1\nRET\n",
            "MAINP.MPF" => "G0 Y7\nM30\n",
            "MAINP.SPF" => "G0 Y8\nM17\n",
            "DEEP.SPF" => "DEEP\nM17\n",
            "OPEN.SPF" => "G0 Y3\n",
            "KEEPS.SPF" => "PROC KEEPS SAVE\nG0 Y3\nM17\n",
            "CUTS.SPF" => "PROC CUTS SAVE\nG18 G91 G1 F50\nTRANS X5\nG55\nZ1\nM17\n",
            "INCH.SPF" => "PROC INCH SAVE\nG700 G95\nG1 X1 F2\nM17\n",
            "OTHER.SPF" => "PROC OTHER SAVE\nG41\nG1 X10 D1\nM17\n",
            "TURNS.SPF" => "PROC TURNS SAVE\nAROT Z90\nG1 X10 Y0\nM17\n",
            "ANEW.SPF" => "PROC ANEW SAVE\nG55\n$P_UIFR[1,X,TR]=7\nG54\nM17\n",
            "RADII.SPF" => "PROC RADII SAVE\nDIAMOF\nG1 X40\nM17\n",
            "STAYS.SPF" => "PROC STAYS\nDIAMOF\nG1 X40\nM17\n",
            "LOOPS.SPF" => "DEF INT ROW\nFOR ROW=1 TO 2\nG0 Y=ROW\nENDFOR\nIF R1==0 GOTOF OUT\nG0 Y99\nOUT: RET\n",
            _ => return Err(vec!["subs".into()]),
        };
        Ok(Loaded {
            path: format!("subs/{name}"),
            bytes: text.as_bytes().into(),
        })
    }
}

fn setup() -> Setup {
    Setup {
        library: Library(Some(Arc::new(Folder))),
        ..Setup::default()
    }
}

pub(crate) fn run(source: &str) -> (Vec<String>, Vec<String>) {
    let log = run_bytes(SINUMERIK, source.as_bytes(), &setup()).1;
    let lines = log.motions.iter().map(line).collect();
    (lines, said_with(source, &setup()))
}

/// Programming manual, 12/2019, p. 495: a parameter with VAR is the variable of the caller itself, a field too.
#[test]
fn fields_are_handed_over() {
    let begin = "DEF REAL P[3]=SET(1,2,3), Q[3], B[2,2]\nB[1,0]=10\n";
    let end = "G0 X=Q[0] Y=Q[2] Z=B[1,0]\nM30\n";
    assert_eq!(called(&format!("{begin}SHIFT(P,Q,B)\n{end}")), ["R X11 Y13 Z10"]);
    // another number of elements, another type, another number of dimensions: not followed
    for (define, call) in [
        ("DEF REAL S[2]", "SHIFT(S,Q,B)"),
        ("DEF INT S[3]", "SHIFT(S,Q,B)"),
        ("DEF REAL S[3]", "SHIFT(P,Q,S)"),
    ] {
        let (_, said) = run(&format!("{begin}{define}\n{call}\n{end}"));
        assert!(
            said.iter().any(|said| said.contains("q[0]") || said.contains("Q[0]")),
            "{call}: {said:?}"
        );
    }
}

#[test]
fn one_variable_for_two_parameters_is_not_followed() {
    let (_, said) = run("DEF REAL S\nBOTH(S,S)\nG0 X=S\nM30\n");
    assert!(
        said[0].contains("`s` is handed over to two parameters with VAR"),
        "{said:?}"
    );
    assert_eq!(
        called("DEF REAL S, T\nBOTH(S,T)\nG0 Y=S Z=T\nM30\n"),
        ["R X1", "R X1 Y1 Z2"]
    );
}

/// Motions of a program about which nothing is said.
fn called(source: &str) -> Vec<String> {
    let (lines, said) = run(source);
    assert_eq!(said, [""; 0], "{source}");
    lines
}

#[test]
fn a_section_is_repeated_so_many_more_times() {
    let from = "R1=0\nG0\nLA: R1=R1+1\nX=R1\nREPEAT LA P=2\nX99\nM30\n";
    assert_eq!(clean(from), ["R X1", "R X2", "R X3", "R X99"]);
    let once = "R1=0\nG0\nLA: R1=R1+1\nX=R1\nREPEAT LA\nX99\nM30\n";
    assert_eq!(clean(once), ["R X1", "R X2", "R X99"]);
    let between = "R1=0\nG0\nLA: R1=R1+1\nLB: X=R1\nX50\nREPEAT LA LB P=2\nX99\nM30\n";
    assert_eq!(clean(between), ["R X1", "R X50", "R X2", "R X3", "R X99"]);
    let block = "R1=0\nG0\nLA: R1=R1+1\nX=R1\nREPEATB LA P=5\nX=R1\nM30\n";
    assert_eq!(clean(block), ["R X1", "R X6"]);
    let marked = "R1=0\nG0\nLA: R1=R1+1\nX=R1\nENDLABEL:\nX50\nREPEAT LA P1\nX99\nM30\n";
    assert_eq!(clean(marked), ["R X1", "R X50", "R X2", "R X99"]);
    // after the statement it runs as it is written, too
    let ahead = "R1=0\nG0\nREPEAT LA LB\nLA: R1=R1+1\nLB: X=R1\nM30\n";
    assert_eq!(clean(ahead), ["R X1", "R X2"]);
    let computed = "R1=0 R2=2\nG0\nLA: R1=R1+1\nX=R1\nREPEAT LA P=R2+1\nM30\n";
    assert_eq!(clean(computed), ["R X1", "R X2", "R X3", "R X4"]);
}

#[test]
fn repeats_nest_and_hold_loops() {
    let nested = "R1=0\nG0\nLA: R1=R1+1\nLB: X=R1\nREPEAT LB P=1\nREPEAT LA P=1\nM30\n";
    assert_eq!(clean(nested), ["R X1", "R X1", "R X2", "R X2"]);
    let ends_with_a_loop =
        "R1=0\nG0\nLA: R2=0\nWHILE R2<2\nX=R1*10+R2\nR2=R2+1\nLB: ENDWHILE\nR1=R1+1\nREPEAT LA LB\nX99\nM30\n";
    assert_eq!(clean(ends_with_a_loop), ["R X0", "R X1", "R X10", "R X11", "R X99"]);
}

#[test]
fn what_repeat_does_not_say_is_not_decided() {
    for (source, what) in [
        ("LA: X1\nREPEAT NONE\nM30\n", "3 `NONE` Label 14080"),
        ("LA: X1\nREPEAT LA P=R9\nM30\n", "3 `R9` not decided: R9"),
        (
            "LA: X1\nREPEAT LA P=0\nM30\n",
            "3 `LA P=0` not decided: how often REPEAT repeats: 0 times",
        ),
        (
            "LA: X1\nREPEAT LA\nLA: X2\nM30\n",
            "3 `LA` not decided: LA: the label is defined both before and after REPEAT",
        ),
        ("REPEAT LA\nX1\nLA: X2\nM30\n", "2 `LA` not decided: which blocks"),
        (
            "R1=0\nLA: R1=R1+1\nIF R1==2 GOTOF OUT\nREPEAT LA P=5\nOUT: M30\n",
            "4 `OUT` not decided: a jump out of",
        ),
    ] {
        let got = said(&format!("G0\n{source}"));
        assert!(got.len() == 1 && got[0].starts_with(what), "{source}: {got:?}");
    }
}

#[test]
fn a_subprogram_runs_by_its_name_and_its_number() {
    assert_eq!(called("G0 X1\nPLAIN\nX2\nM30\n"), ["R X1", "R X1 Y1", "R X2 Y1"]);
    assert_eq!(called("R1=5\nL20\nM30\n"), ["R X6"]);
    assert_eq!(called("L020\nM30\n"), ["R X-20"], "leading zeros count");
    assert_eq!(called("R1=5\nL20 P3\nM30\n"), ["R X6", "R X7", "R X8"]);
    assert_eq!(
        called("MAINP\nG0 X1\nM30\n"),
        ["R Y7", "R X1 Y7"],
        "a main program first; its M30 returns"
    );
    assert_eq!(called("R1=0\nLOOPS\nM30\n"), ["R Y1", "R Y2"]);
}

#[test]
fn programs_of_one_file_call_each_other() {
    let source = "%_N_MAIN_MPF\nG0 X1\nSUB\nX2\nM30\n%_N_SUB_SPF\nY1\nINNER P2\nM17\n%_N_INNER_SPF\nZ1\nRET\n";
    assert_eq!(
        clean(source),
        ["R X1", "R X1 Y1", "R X1 Y1 Z1", "R X1 Y1 Z1", "R X2 Y1 Z1"]
    );
    let without_end = "%_N_MAIN_MPF\nG0 X1\nSUB\nM30\n%_N_SUB_SPF\nY1\n%_N_NEXT_SPF\nZ1\nM17\n";
    assert_eq!(
        said(without_end),
        ["6 `Y1` not modelled: a subprogram that ends without M17 or RET: taken as its return"]
    );
    assert_eq!(lines(SINUMERIK, without_end), ["R X1", "R X1 Y1"]);
}

#[test]
fn arguments_come_in_by_value_and_go_out_by_reference() {
    let source = "DEF REAL GOT\nCUT(5,,GOT)\nG0 X=GOT\nCUT(1,4,GOT)\nX=GOT\nM30\n";
    assert_eq!(
        called(source),
        ["R Z5", "R Z2", "R X7 Z2", "R X7 Z1", "R X7 Z4", "R X5 Z4"]
    );
    assert_eq!(called("CUT(5)\nM30\n"), ["R Z5", "R Z2"]);
    let (_, said) = run("CUT(1,2,3,4)\nM30\n");
    assert!(
        said[0].contains("4 arguments for a subprogram whose PROC declares 3"),
        "{said:?}"
    );
    // the caller's variables are its own: DEPTH is not one of them
    let (_, said) = run("CUT(5)\nG0 X=DEPTH\nM30\n");
    assert_eq!(said, ["2 `DEPTH` not modelled: DEPTH: not declared in this program"]);
}

#[test]
fn what_a_call_leaves_open_is_said() {
    assert_eq!(run("G0 X1\nL99\nX2\nM30\n").1, ["2 `L99` missing L99"]);
    assert_eq!(run("G0 X1\nNOSUCH P2\nM30\n").1, ["2 `NOSUCH` missing NOSUCH"]);
    assert_eq!(
        run("EXTERN NOSUCH(REAL)\nNOSUCH(1)\nM30\n").1,
        ["2 `NOSUCH(1)` missing NOSUCH"]
    );
    // a name alone may be the machine's
    assert_eq!(
        run("R1=4\nG0 X1 Y1\nNOSUCH\nX2\nX=R1\nM30\n").1,
        [
            "3 `NOSUCH` not modelled: NOSUCH: no code of the control, and no program of that name was found",
            "5 `R1` not modelled: R1: jumps or calls before it are not followed"
        ]
    );
    assert_eq!(run("R1=4\nG0 X1 Y1\nNOSUCH\nX2\nM30\n").0, ["R X1 Y1", "R X2"]);
    assert_eq!(run("OPEN\nM30\n").1.len(), 1);
    assert_eq!(run("DEEP\nM30\n").1.len(), 1);
    assert!(
        run("DEEP\nM30\n").1[0].ends_with("Subprogram "),
        "{:?}",
        run("DEEP\nM30\n").1
    );
}

#[test]
fn a_subprogram_with_a_number_takes_arguments() {
    assert_eq!(run("L140(7)\nM30\n"), (vec!["R Z7".to_owned()], Vec::new()));
}

/// Parameters of a PROC are declared where it is judged alone; the caller, which is not here, gives their values.
#[test]
fn the_parameters_of_a_subprogram_that_runs_alone_are_declared() {
    let source = "PROC FOO(REAL WERT, INT N)\nWERT=5\nG0 X=WERT\nY=N\nM17\n";
    assert_eq!(said(source), ["4 `N` not modelled: N: its value is unknown here"]);
    assert_eq!(lines(SINUMERIK, source), ["R X5", "R X5"]);
}

#[test]
fn ret_of_the_main_program_is_said_to_be_its_end() {
    assert_eq!(
        said("G0 X1\nRET\nX2\nM30\n"),
        ["2 `RET` not modelled: RET in the main program: taken as its end"]
    );
    assert_eq!(lines(SINUMERIK, "G0 X1\nRET\nX2\nM30\n"), ["R X1"]);
    assert_eq!(said("G0 X1\nM17\n"), [""; 0]);
    // a subprogram that is run alone returns to its caller
    assert_eq!(said("G0 X1\nRET\n"), [""; 0]);
    assert_eq!(said("PROC SLOT\nG0 X1\nRET\n"), [""; 0]);
}

#[test]
fn a_motion_of_a_subprogram_belongs_to_the_block_of_its_call() {
    let log = run_bytes(SINUMERIK, b"G0 X1\nPLAIN\nM30\n", &setup()).1;
    assert_eq!(
        log.motions.iter().map(|motion| motion.block.0).collect::<Vec<_>>(),
        [0, 1]
    );
}

/// MCALL with a subprogram: after each block that moves, and after one with only F or S under G0 and G1.
#[test]
fn a_modal_subprogram_runs_after_each_motion() {
    assert_eq!(
        called("G0 X0 Y0 Z50\nMCALL CUT(-3,5)\nX5\nG4 F1\nY6\nMCALL\nX9\n"),
        [
            "R X0 Y0 Z50",
            "R X5 Y0 Z50",
            "R X5 Y0 Z-3",
            "R X5 Y0 Z5",
            "D1 X5 Y0 Z5",
            "R X5 Y6 Z5",
            "R X5 Y6 Z-3",
            "R X5 Y6 Z5",
            "R X9 Y6 Z5",
        ]
    );
    assert_eq!(
        called("G0 X0\nMCALL L140(4)\nF500\nM8\nMCALL\nX1\n"),
        ["R X0", "R X0 Z4", "R X1 Z4"]
    );
    assert_eq!(
        called("R1=7\nG0 X0\nMCALL L20\nX5\nMCALL\nX1\n"),
        ["R X0", "R X5", "R X8", "R X1"]
    );
    // a cycle takes its place, and so does another subprogram
    assert_eq!(
        called("G0 X0\nMCALL CUT(1,2)\nMCALL PLAIN\nX5\nMCALL\nX1\n"),
        ["R X0", "R X5", "R X5 Y1", "R X1 Y1"]
    );
    // when an argument that is no number is evaluated, no source says
    assert!(
        run("G0 X0\nR1=3\nMCALL CUT(R1)\nX5\n")
            .1
            .iter()
            .any(|said| said.contains("CUT"))
    );
    // whether it acts in a subprogram that is called meanwhile, no source says
    assert!(
        run("G0 X0\nMCALL PLAIN\nL20\n")
            .1
            .iter()
            .any(|said| said.contains("MCALL of another program"))
    );
}

#[test]
fn a_modal_cycle_acts_after_a_block_with_only_a_feed() {
    let holes = |text: &str| {
        let text = format!("G17 G0 X0 Y0 Z50 F100 S100 M3\nMCALL CYCLE81(10,0,2,-5)\n{text}\nMCALL\n");
        lines(SINUMERIK, &text)
            .iter()
            .filter(|line| line.starts_with('L'))
            .count()
    };
    assert_eq!(holes("X5"), 1);
    assert_eq!(holes("X5\nF200"), 2);
    assert_eq!(holes("X5\nN10 S200"), 2);
    assert_eq!(holes("X5\nM8"), 1);
    assert_eq!(holes("X5 F200"), 1);
}

/// SAVE: G functions and the programmable frame come back at the return, F and positions do not.
#[test]
fn save_brings_back_the_g_functions_and_the_frame() {
    let mut setup = setup();
    setup.work_offsets = vec![offset("G54", 0.0), offset("G55", 100.0)];
    let run = |source: &str| {
        let log = run_bytes(SINUMERIK, source.as_bytes(), &setup).1;
        let lines: Vec<_> = log.motions.iter().map(line).collect();
        (lines, said_with(source, &setup))
    };
    let quiet = |source: &str| {
        let (lines, said) = run(source);
        assert_eq!(said, [""; 0], "{source}");
        lines
    };
    assert_eq!(quiet("G54 G0 X1\nKEEPS\nX2\nM30\n"), ["R X1", "R X1 Y3", "R X2 Y3"]);
    // G1, G18, G91, G55, TRANS and F50 in it: behind it only F stays
    assert_eq!(
        quiet("G54 G17 G90 G0 X1 Y0 Z0\nCUTS\nX2\nG1 X3\nG2 X5 Y2 I2 J0\nM30\n"),
        [
            "R X1 Y0 Z0",
            "L X-104 Y0 Z1 F50",
            "R X2 Y0 Z1",
            "L X3 Y0 Z1 F50",
            "A(5 0 1; -90) X5 Y2 Z1 F50"
        ]
    );
    // DIAMON too
    for (name, x) in [("RADII", 30), ("STAYS", 60)] {
        let text = format!("G54 G1 F100 DIAMON X40\n{name}\nX60\nM30\n");
        assert_eq!(quiet(&text), ["L X20 F100", "L X40 F100", &format!("L X{x} F100")]);
    }
    // the frame of the caller, after each of two runs
    assert_eq!(
        quiet("G54 G1 F100 X0 Y0 Z0\nTRANS X20\nX0 Y0\nTURNS P2\nX7 Y1\nM30\n")[1..],
        [
            "L X0 Y0 Z0 F100",
            "L X0 Y10 Z0 F100",
            "L X0 Y10 Z0 F100",
            "L X7 Y1 Z0 F100",
        ]
    );
    let (lines, said) = run("G54 G71 G94 G1 F100 X0\nINCH\nX5\nM30\n");
    assert_eq!(lines[1..], ["L X25.4 F50.8/rev", "L X5"]);
    assert!(said.len() == 1 && said[0].contains("F after the return"), "{said:?}");
    for (source, what) in [
        ("OTHER\nX1\nM30\n", "cutter radius compensation"),
        ("ANEW\nX1\nM30\n", "10617"),
    ] {
        let said = run(&format!("G54 G0 X1 Y1\n{source}")).1;
        assert!(said.iter().any(|said| said.contains(what)), "{source}: {said:?}");
    }
}

fn offset(name: &str, x: f64) -> trunnion_interp::WorkOffset {
    let mut values = [0.0; 9];
    values[0] = x;
    trunnion_interp::WorkOffset {
        name: name.to_owned(),
        values,
    }
}

/// MCALL with a subprogram of the same file.
#[test]
fn a_modal_subprogram_may_stand_in_the_same_file() {
    let source = "%_N_MAIN_MPF\nG0 X0 Z5\nMCALL HOLE(-3)\nX1\nX2\nMCALL\nX3\nM30\n%_N_HOLE_SPF\nPROC HOLE(REAL DEPTH)\nG0 Z=DEPTH\nZ5\nM17\n";
    assert_eq!(
        clean(source),
        [
            "R X0 Z5", "R X1 Z5", "R X1 Z-3", "R X1 Z5", "R X2 Z5", "R X2 Z-3", "R X2 Z5", "R X3 Z5"
        ]
    );
}
