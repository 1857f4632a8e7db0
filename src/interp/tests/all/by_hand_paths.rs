//! As `by_hand`: turning cycles, and paths beside a contour.
#![expect(clippy::too_many_lines, reason = "tables of programs")]
use crate::by_hand::{Case, check};
use crate::support::{line, run_bytes};
use trunnion_interp::{MotionKind, Setup, Tool};

#[test]
fn turning() {
    check(
        "fanuc-30i-lathe-a",
        &[
            (
                "X is a diameter, U and W are distances",
                "G0X20.Z5.\nG1Z-10.F.2\nU4.W-3.\n",
                &["R X10 Z5", "L X10 Z-10 F0.2/rev", "L X12 Z-13 F0.2/rev"],
            ),
            (
                "G90: cut along Z",
                "G0X50.Z2.\nG90X40.Z-20.F.3\nX30.\n",
                &[
                    "R X25 Z2",
                    "R X20 Z2",
                    "L X20 Z-20 F0.3/rev",
                    "L X25 Z-20 F0.3/rev",
                    "R X25 Z2",
                    "R X15 Z2",
                    "L X15 Z-20 F0.3/rev",
                    "L X25 Z-20 F0.3/rev",
                    "R X25 Z2",
                ],
            ),
            (
                "G94: cut along X",
                "G0X50.Z2.\nG94X10.Z-1.F.3\n",
                &[
                    "R X25 Z2",
                    "R X25 Z-1",
                    "L X5 Z-1 F0.3/rev",
                    "L X5 Z2 F0.3/rev",
                    "R X25 Z2",
                ],
            ),
            (
                "G92: a thread",
                "G0X50.Z2.\nG92X39.Z-20.F1.5\n",
                &[
                    "R X25 Z2",
                    "R X19.5 Z2",
                    "L X19.5 Z-20 F1.5/rev",
                    "R X25 Z-20",
                    "R X25 Z2",
                ],
            ),
        ],
    );
}

#[test]
fn compensation() {
    // radius 5; the tool is left of the path with G41, right with G42
    let setup = Setup {
        tools: vec![Tool {
            number: 1,
            shape: None,
            diameter_mm: Some(10.0),
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let cases: &[Case] = &[
        (
            "outer corner of 45 deg: the tip is 5 tan 22.5 deg behind the corner",
            "G0X-10.Y-10.Z0.\nG42D1G1X0.Y0.F9.\nX20.\nX30.Y10.\nG40X40.\nM30\n",
            &[
                "R X-10 Y-10",
                "L X0 Y-5",
                "L X22.071068 Y-5",
                "L X33.535534 Y6.464466",
                "L X40 Y10",
            ],
        ),
        (
            "inside of an arc: radius 10 - 5",
            "G0X0.Y0.Z0.\nG41D1G1X10.Y0.F9.\nG3X-10.Y0.I-10.J0.\nG40G1X0.\nM30\n",
            &["R X0 Y0", "L X5 Y0", "A(0 0 0; 180) X-5 Y0", "L X0 Y0"],
        ),
        (
            "outside of an arc: radius 10 + 5",
            "G0X20.Y0.Z0.\nG42D1G1X10.Y0.F9.\nG3X-10.Y0.I-10.J0.\nG40G1X-20.\nM30\n",
            &["R X20 Y0", "L X15 Y0", "A(0 0 0; 180) X-15 Y0", "L X-20 Y0"],
        ),
        (
            "line into arc, tangent: no link",
            "G0X-10.Y-10.Z0.\nG42D1G1X0.Y0.F9.\nX20.\nG3X30.Y10.R10.\nG1Y20.\nG40X50.\nM30\n",
            &[
                "R X-10 Y-10",
                "L X0 Y-5",
                "L X20 Y-5",
                "A(20 10 0; 90) X35 Y10",
                "L X35 Y20",
                "L X50 Y20",
            ],
        ),
        (
            "Z between: at the end of the motion before",
            "G0X-10.Y-10.Z0.\nG42D1G1X0.Y0.F9.\nX20.\nZ-1.\nX30.\nG40Y10.\nM30\n",
            &[
                "R X-10 Y-10",
                "L X0 Y-5",
                "L X20 Y-5",
                "L X20 Y-5 Z-1",
                "L X30 Y-5 Z-1",
                "L X30 Y10 Z-1",
            ],
        ),
        (
            "G40 alone: the next motion leads off",
            "G0X-10.Y-10.Z0.\nG42D1G1X0.Y0.F9.\nX20.\nG40\nY20.\nM30\n",
            &["R X-10 Y-10", "L X0 Y-5", "L X20 Y-5", "L X20 Y20"],
        ),
        (
            "a dwell and an M code do not part the contour",
            "G0X-10.Y-10.Z0.\nG42D1G1X0.Y0.F9.\nX20.\nM8\nY20.\nG40X0.\nM30\n",
            &["R X-10 Y-10", "L X0 Y-5", "L X25 Y-5", "L X25 Y20", "L X0 Y20"],
        ),
    ];
    let mut wrong = String::new();
    for (name, source, want) in cases {
        let (_, log) = run_bytes("fanuc-30i", source.as_bytes(), &setup);
        let got: Vec<_> = log
            .motions
            .iter()
            .map(|m| line(m).replace(" Z0", "").replace(" F9", ""))
            .collect();
        if got != *want {
            wrong += &format!("{name}\n  got  {got:?}\n  want {want:?}\n");
        }
        for motion in &log.motions {
            let MotionKind::Arc(Some(arc)) = motion.kind else {
                continue;
            };
            assert!((arc.radius_start - arc.radius_end).abs() < 1e-9, "{name}: {arc:?}");
        }
        let blocks: Vec<_> = log.motions.iter().map(|m| m.block.0).collect();
        assert!(blocks.is_sorted(), "{name}: {blocks:?}");
    }
    assert!(wrong.is_empty(), "{wrong}");
}
