//! Words whose meaning no source gives, where the settings declare it: CHF of Klartext, CYCLE802 of a Sinumerik (decision 0367).
use crate::support::{fault_line, line, run_bytes};
use trunnion_interp::{ChamferLength, FaultKind, HolePlaces, Setup};

/// The motions of a program after its first, and the faults that say a reason for what is not known.
fn run(dialect: &str, text: &str, declare: impl Fn(&mut Setup)) -> (Vec<String>, Vec<String>) {
    let mut setup = Setup::default();
    declare(&mut setup);
    let (program, log) = run_bytes(dialect, text.as_bytes(), &setup);
    let says = |kind: &FaultKind| matches!(kind, FaultKind::NotModelled { .. } | FaultKind::Rejected { .. });
    let told = log
        .faults
        .iter()
        .filter(|fault| says(&fault.kind))
        .map(|fault| fault_line(&program, fault))
        .collect();
    (log.motions[1..].iter().map(line).collect(), told)
}

fn chamfer(length: ChamferLength, blocks: &str) -> (Vec<String>, Vec<String>) {
    let text = format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0 FMAX\n{blocks}\n9 END PGM A MM\n");
    run("heidenhain-klartext", &text, |setup| {
        setup.control.chamfer_length = Some(length);
    })
}

#[test]
fn a_chamfer_is_cut_by_its_side_or_by_its_face() {
    let corner = "L X+20 F100\nCHF 4\nL Y+20";
    let (side, told) = chamfer(ChamferLength::Side, corner);
    assert_eq!(told, [""; 0]);
    assert_eq!(side, ["L X16 Y0 Z0 F100", "L X20 Y4 Z0 F100", "L X20 Y20 Z0 F100"]);
    // a face of 4 mm takes 4/sqrt(2) off each line of a right angle
    let (face, told) = chamfer(ChamferLength::Face, corner);
    assert_eq!(told, [""; 0]);
    let by = 8.0_f64.sqrt();
    let cut = |x: f64, y: f64| {
        format!(
            "L X{} Y{} Z0 F100",
            crate::support::number(x),
            crate::support::number(y)
        )
    };
    assert_eq!(face, [cut(20.0 - by, 0.0), cut(20.0, by), cut(20.0, 20.0)]);
    // between lines at 120 degrees the face is longer than the side by 2 sin 60
    let blunt = "L X+20 F100\nCHF 2\nL X+30 Y+17.320508075688775";
    let (side, _) = chamfer(ChamferLength::Side, blunt);
    assert_eq!(side[..2], ["L X18 Y0 Z0 F100", "L X21 Y1.732051 Z0 F100"]);
    let (face, _) = chamfer(
        ChamferLength::Face,
        "L X+20 F100\nCHF 3.4641016151377544\nL X+30 Y+17.320508075688775",
    );
    assert_eq!(face, side);
}

#[test]
fn the_feed_of_a_chamfer_is_its_own() {
    let (found, told) = chamfer(ChamferLength::Side, "L X+20 F100\nQ1 = 4\nCHF Q1 F50\nL Y+20\nL X+0");
    assert_eq!(told, [""; 0]);
    let wanted = [
        "L X16 Y0 Z0 F100",
        "L X20 Y4 Z0 F50",
        "L X20 Y20 Z0 F100",
        "L X0 Y20 Z0 F100",
    ];
    assert_eq!(found, wanted);
}

#[test]
fn a_chamfer_is_scaled_with_its_lines() {
    let scale = "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X 0.5 Y 0.5 CCX+0 CCY+0\n";
    let (_, told) = chamfer(ChamferLength::Side, &format!("{scale}L X+20 F100\nCHF 4\nL Y+20"));
    let reason = "CHF while cycle 26 scales: its size";
    assert!(told.iter().any(|told| told.contains(reason)), "{told:?}");
    let text = "0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0 FMAX\nCYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.5\n\
                L X+20 F100\nCHF 4\nL Y+20\n9 END PGM A MM\n";
    let (found, told) = run("heidenhain-klartext", text, |setup| {
        setup.control.chamfer_length = Some(ChamferLength::Side);
        setup.control.scaled_axes = Some(trunnion_interp::ScaledAxes::Plane);
    });
    assert_eq!(told, [""; 0]);
    assert_eq!(found, ["L X8 Y0 Z0 F100", "L X10 Y2 Z0 F100", "L X10 Y10 Z0 F100"]);
}

#[test]
fn a_chamfer_that_does_not_fit_is_told() {
    for (blocks, reason) in [
        ("L X+20 F100\nCHF 25\nL Y+20", "takes more than"),
        ("L X+20 F100\nCHF\nL Y+20", "CHF needs its length"),
        (
            "L X+20 F100\nCHF 2\nCR X+0 Y+20 R+20 DR+",
            "CHF: a corner that is not between two lines in the plane",
        ),
        ("L X+20 F100\nCHF 2 R3\nL Y+20", "CHF: words beside its length"),
        ("TOOL CALL S500\nCHF 5", "no path block precedes the corner"),
    ] {
        let (_, told) = chamfer(ChamferLength::Side, blocks);
        assert!(told.iter().any(|told| told.contains(reason)), "{blocks}: {told:?}");
    }
}

const HEAD: &str = "G17 G90 G94 F100\nS1000 M3\nG0 X0 Y0 Z50\n";

fn places(call: &str) -> (Vec<String>, Vec<String>) {
    let text = format!("{HEAD}MCALL CYCLE81(60,0,3,-5)\n{call}\nMCALL\nM30\n");
    let (motions, told) = run("sinumerik-840d", &text, |setup| {
        setup.control.hole_places = Some(HolePlaces::Pairs);
    });
    let holes = motions.into_iter().filter(|line| line.starts_with('L')).collect();
    (holes, told)
}

#[test]
fn the_cycle_runs_at_each_place_of_cycle802() {
    let (holes, told) = places("CYCLE802(111111111,111111111,10,20,30,40,-5,6)");
    assert_eq!(told, [""; 0]);
    assert_eq!(holes, ["L X10 Y20 Z-5 F100", "L X30 Y40 Z-5 F100", "L X-5 Y6 Z-5 F100"]);
    // the second place in X and the third in Y from the place before; the empty ones at the end are none, zeros after them select nothing
    let (holes, told) = places("CYCLE802(121,211,10,20,30,40,-5,6,,,,,,,,,,,,,0,0,0)");
    assert_eq!(told, [""; 0]);
    assert_eq!(
        holes,
        ["L X10 Y20 Z-5 F100", "L X40 Y40 Z-5 F100", "L X-5 Y46 Z-5 F100"]
    );
    let all: Vec<_> = (0..9).map(|i| format!("{i},{}", i * i)).collect();
    let (holes, told) = places(&format!("CYCLE802(111111111,111111111,{})", all.join(",")));
    assert_eq!((holes.len(), told.len()), (9, 0));
    assert_eq!(holes[8], "L X8 Y64 Z-5 F100");
}

#[test]
fn what_cycle802_does_not_say_is_unknown() {
    for call in [
        "CYCLE802(111111111,111111111)",
        "CYCLE802(111111111,111111111,10)",
        "CYCLE802(111111111,111111111,10,,20,30)",
        "CYCLE802(111111111,111111111,,,20,30)",
        "CYCLE802(112,111,10,20)",
        "CYCLE802(1,1,10,20,30,40)",
        "CYCLE802(31,11,10,20,30,40)",
        "CYCLE802(11.5,11,10,20,30,40)",
        "CYCLE802(,11,10,20,30,40)",
        "CYCLE802(11,11,10,R77,30,40)",
        "CYCLE802(111111111,111111111,1,1,2,2,3,3,4,4,5,5,6,6,7,7,8,8,9,9,10,10)",
        "CYCLE802(11,11,10,20,30,40,,,,,,,,,,,,,,,0,0,1)",
        "CYCLE802(\"A,B\",11,10,20)",
    ] {
        let (holes, told) = places(call);
        assert!(told.iter().any(|told| told.contains("CYCLE802")), "{call}: {told:?}");
        assert_eq!(holes, [""; 0], "{call}");
    }
}

#[test]
fn without_a_declaration_positions_are_unknown() {
    let (motions, told) = run(
        "sinumerik-840d",
        &format!("{HEAD}MCALL CYCLE81(60,0,3,-5)\nCYCLE802(1,1,10,20)\nMCALL\nG0 X5\nM30\n"),
        |_| {},
    );
    assert!(
        told.iter().any(|told| told.contains("declare [control] hole_places")),
        "{told:?}"
    );
    assert!(motions.iter().all(|line| !line.starts_with("L X10 Y20")), "{motions:?}");
    let text = "0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0 FMAX\nL X+20 F100\nCHF 4\nL Y+20\n9 END PGM A MM\n";
    let (_, told) = run("heidenhain-klartext", text, |_| {});
    assert!(
        told.iter()
            .any(|told| told.contains("declare [control] chamfer_length")),
        "{told:?}"
    );
}
