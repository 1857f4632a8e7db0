//! C and A of a lathe that has no such axes, and corners between the cuts of a lathe.
use crate::support::{faults, lines};

const LATHES: [&str; 2] = ["fanuc-30i-lathe-a", "haas-lathe"];

/// A chamfer of 1 and one of 2 at the ends of cuts along Z and along X; a radius of 3 at the last corner.
#[test]
fn c_is_a_chamfer_and_r_a_radius() {
    for [first, second, third] in [["C1.", "C2.", "R3."], [",C1.", ",C2.", ",R3."], ["K1.", "K-2.", "R3."]] {
        let second = if second == "K-2." { "I2." } else { second };
        let source = format!("G21 G18\nG0 X20. Z0.\nG1 Z-10. {first} F0.2\nX40. {second}\nZ-30. {third}\nX60.\nM30\n");
        let source = if first == "K1." {
            source.replace("K1.", "I1.").replace("X40. I2.", "X40. K2.")
        } else {
            source
        };
        for dialect in LATHES {
            assert_eq!(faults(dialect, &source), [""; 0], "{dialect} {source}");
            let found = lines(dialect, &source);
            let places: Vec<String> = found.iter().map(|line| line.replace(" Y0", "")).collect();
            assert_eq!(
                places,
                [
                    "R X10 Z0",
                    "L X10 Z-9 F0.2/rev",
                    "L X11 Z-10 F0.2/rev",
                    "L X18 Z-10 F0.2/rev",
                    "L X20 Z-12 F0.2/rev",
                    "L X20 Z-27 F0.2/rev",
                    "A(23 0 -27; -90) X23 Z-30 F0.2/rev",
                    "L X30 Z-30 F0.2/rev",
                ],
                "{dialect} {source}"
            );
        }
    }
}

/// 30 degrees from Z: along Z by -10 the radius changes by 10 tan 30 = 5.7735, and back along X by 10 in radius the way is 17.3205.
#[test]
fn a_is_the_angle_of_a_cut() {
    for dialect in LATHES {
        let source = "G21 G18\nG0 X40. Z0.\nG1 Z-10. A150. F0.2\nX40. A150.\nM30\n";
        assert_eq!(faults(dialect, source), [""; 0], "{dialect}");
        let found: Vec<String> = lines(dialect, source)
            .iter()
            .map(|line| line.replace(" Y0", ""))
            .collect();
        assert_eq!(
            found[1..],
            ["L X25.773503 Z-10 F0.2/rev", "L X20 Z0 F0.2/rev"],
            "{dialect}"
        );
    }
}

/// A program that positions C has the axis.
#[test]
fn c_is_an_axis_where_the_program_positions_it() {
    for (dialect, source) in [
        ("fanuc-30i-lathe-a", "G21 G0 X20. Z0. C0.\nG1 Z-10. C90. F0.2\nM30\n"),
        ("haas-lathe", "G21 G0 X20. Z0.\nG28 H0.\nG1 Z-10. C90. F0.2\nM30\n"),
    ] {
        let found = lines(dialect, source);
        assert!(found.last().is_some_and(|line| line.contains("C90")), "{found:?}");
    }
}
