//! A tool change may take the machine elsewhere: the motions after it say so, with the place where that is known.
use crate::support::{faults, line, run_bytes};
use trunnion_interp::{Position, Setup};

const PROGRAMS: [(&str, &str); 4] = [
    (
        "sinumerik-840d",
        "G17 G71 G90 G94\nT1 D1 M6\nG0 X0 Y0 Z50\nX5\nT5 D1 M6\nX1\nX2\nM30\n",
    ),
    (
        "fanuc-30i",
        "G17 G21 G90 G94\nT1 M6\nG0 X0. Y0. Z50.\nX5.\nT5 M6\nX1.\nX2.\nM30\n",
    ),
    (
        "okuma-osp",
        "G17 G90 G94 G15 H1\nT1 M6\nG0 X0 Y0 Z50\nX5\nT5 M6\nX1\nX2\nM2\n",
    ),
    (
        "heidenhain-klartext",
        "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X0 Y0 Z50 R0 FMAX\nL X5 FMAX\nTOOL CALL 5 Z S200\nL X1 FMAX\nL X2 FMAX\nEND PGM T MM\n",
    ),
];

#[test]
fn motions_say_how_often_the_machine_was_moved() {
    let mut up = Position::default();
    up.set(2, 300.0);
    for (dialect, text) in PROGRAMS {
        for (place, after) in [
            (Some(up), ["R X1 Y0 Z300", "R X2 Y0 Z300"]),
            (Some(Position::default()), ["R X1 Y0 Z50", "R X2 Y0 Z50"]),
            (None, ["R X1", "R X2"]),
        ] {
            let mut setup = Setup::default();
            setup.control.tool_change = place;
            for number in [1, 5] {
                setup.tools.push(trunnion_interp::Tool {
                    number,
                    shape: None,
                    diameter_mm: None,
                    length_mm: Some(0.0),
                    holder_mm: None,
                });
            }
            let log = run_bytes(dialect, text.as_bytes(), &setup).1;
            let moved: Vec<u32> = log.motions.iter().map(|motion| motion.relocations).collect();
            let steps: Vec<u32> = moved.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let moves = u32::from(place != Some(Position::default()));
            assert_eq!(steps, [0, moves, 0], "{dialect} {place:?}");
            let lines: Vec<String> = log.motions[2..].iter().map(line).collect();
            assert_eq!(lines, after, "{dialect} {place:?}");
        }
    }
}

/// Posts write H in G169. Without it the tip goes where the program says; only the length is not known.
#[test]
fn tip_control_of_an_okuma_without_a_length() {
    let text =
        "G90 G94 G15 H1\nT1 M6\nS100 M3\nG56 H1 G0 X0 Y0 Z50 A0 C0\nG169\nG1 X1 Y2 Z3 A10 C20 F100\nG170\nG53\nM2\n";
    let log = run_bytes("okuma-osp", text.as_bytes(), &Setup::default()).1;
    let tip = &log.motions[1];
    assert_eq!(line(tip), "L X1 Y2 Z3 A10 C20 F100 tcp");
    assert!(tip.undeclared.any());
    let told = faults("okuma-osp", text);
    assert!(told.iter().any(|fault| fault.contains("G169 without H")), "{told:?}");
    assert!(
        !told.iter().any(|fault| fault.contains("a length offset without H")),
        "{told:?}"
    );
}
