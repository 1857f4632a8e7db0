//! Tilted working planes: what G68.2 and CYCLE800 make of coordinates, arcs, cycles and lengths.
use crate::support::{faults, line, run_bytes, run_text, shared};
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, MotionKind, Orientation, Posture, Setup, Swivel};

fn motions(dialect: &str, text: &str) -> Vec<Motion> {
    run_text(dialect, text).motions
}

fn near(found: Option<Vec3>, wanted: [f64; 3]) {
    let found = found.expect("known");
    assert!((found - Vec3::from(wanted)).norm() < 1e-9, "{found}, not {wanted:?}");
}

#[test]
fn euler_angles_turn_lines_and_arcs_into_the_workpiece_frame() {
    // front face: X stays, Y of the plane is Z of the part, Z of the plane is -Y of it
    let text = "G68.2 X0. Y0. Z-50. I0. J90. K0.\nG53.1\nG0 X25. Y15. Z25.\nG1 Z-5. F100.\nG17 G3 X35. Y25. I0. J10.\nG69\nG0 X1. Y2. Z3.\n";
    let found = motions("fanuc-30i", text);
    assert_eq!(found.len(), 5, "{:#?}", found.iter().map(line).collect::<Vec<_>>());
    let turn = &found[0];
    assert_eq!(
        (turn.tilt.swivel, turn.tilt.posture),
        (Swivel::AxesStay, Posture::ByRule)
    );
    let Orientation::Vector(None, normal) = turn.orientation else {
        panic!("no vector: {turn:?}")
    };
    near(Some(normal), [0.0, -1.0, 0.0]);
    near(found[1].end.xyz(), [25.0, -25.0, -35.0]);
    near(found[2].end.xyz(), [25.0, 5.0, -35.0]);
    near(found[2].tilt.normal, [0.0, -1.0, 0.0]);
    near(found[3].end.xyz(), [35.0, 5.0, -25.0]);
    let MotionKind::Arc(Some(arc)) = found[3].kind else {
        panic!("no arc: {:?}", found[3])
    };
    near(Some(arc.centre), [25.0, 5.0, -25.0]);
    near(Some(arc.normal), [0.0, -1.0, 0.0]);
    near(Some(arc.point_at(1.0)), [35.0, 5.0, -25.0]);
    // after G69 the words are the part's again
    near(found[4].end.xyz(), [1.0, 2.0, 3.0]);
    assert_eq!(found[4].tilt.normal, None);
    assert_eq!(faults("fanuc-30i", text), Vec::<String>::new());
}

#[test]
fn the_tools_length_and_holes_lie_along_the_planes_normal() {
    let mut setup = Setup::default();
    setup.tools.push(crate::tools::tool(1, None, None, Some(80.0)));
    let text = "T1 M6\nG68.2 X0. Y0. Z0. I90. J90. K0.\nG53.1\nG0 X10. Y5. Z100.\nG43 H1\nG81 X10. Y20. Z-3. R2. F100.\nG80\nG69\nM30\n";
    let log = crate::length_change::run_with("fanuc-30i", crate::length_change::SHIFTS, text, &setup);
    assert_eq!(log.faults, []);
    // X of the plane is Y of the part, Y of it Z, Z of it X
    let ends: Vec<_> = log.motions[1..].iter().map(|motion| motion.end.xyz()).collect();
    near(ends[0], [100.0, 10.0, 5.0]);
    // with the active length the tip is 80 mm down the normal
    near(ends[1], [20.0, 10.0, 20.0]);
    near(ends[2], [2.0, 10.0, 20.0]);
    near(ends[3], [-3.0, 10.0, 20.0]);
    near(ends[4], [20.0, 10.0, 20.0]);
}

#[test]
fn a_swivel_cycle_shifts_turns_and_shifts_again() {
    let text = "CYCLE800(0,\"\",0,39,10,0,0,90,30,0,0,0,5,-1)\nG0 X0 Y0 Z0\nG1 X2 F100\nCYCLE800(0,\"\",1,57,0,0,0,0,0,90,0,0,0,0)\nG1 X2 Y0 Z0\nCYCLE800()\nG1 X7 Y8 Z9\n";
    let found = motions("sinumerik-840d", text);
    // Z by 90, then the new X by 30: the normal leans to +X
    let (sin, cos) = (0.5, 0.75f64.sqrt());
    assert_eq!(
        (found[0].tilt.swivel, found[0].tilt.posture),
        (Swivel::AxesStay, Posture::Lower)
    );
    near(found[1].end.xyz(), [10.0 + 5.0 * sin, 0.0, 5.0 * cos]);
    near(found[1].tilt.normal, [sin, 0.0, cos]);
    near(found[2].end.xyz(), [10.0 + 5.0 * sin, 2.0, 5.0 * cos]);
    // added: X of the new plane is Y of the old one, which is -X turned down
    near(
        found[3].end.xyz(),
        [10.0 + 5.0 * sin - 2.0 * cos, 0.0, 5.0 * cos + 2.0 * sin],
    );
    near(found[4].end.xyz(), [7.0, 8.0, 9.0]);
    assert_eq!(faults("sinumerik-840d", text), Vec::<String>::new());
}

#[test]
fn what_is_not_modelled_says_so_and_hides_the_position() {
    for (dialect, text) in [
        ("fanuc-30i", "G68.2 P1 Q123 X0. Y0. Z0. I10. J20. K0.\n"),
        ("fanuc-30i", "G68.2 P3 Q1 X0. Y0. Z0. I1. J0. K0.\n"),
        ("fanuc-30i", "G68.2 P4 X0. Y0. Z0. I10. J20. K0.\n"),
        ("fanuc-30i", "G68.2 P2 Q0 X0. Y0. Z0.\n"),
        ("fanuc-30i", "G68.3 X0. Y0. Z0.\n"),
        ("fanuc-30i", "G68.4 X0. Y0. Z0. I0. J10. K0.\n"),
        ("sinumerik-840d", "CYCLE800(0,\"\",0,192,0,0,0,10,20,0,0,0,0,1)\n"),
        ("sinumerik-840d", "CYCLE800(0,\"\",0,57,0,0,0,R1,20,0,0,0,0,1)\n"),
    ] {
        let text = format!("{text}G0 X1. Y2. Z3.\nG1 X4. F100.\n");
        let log = run_text(dialect, &text);
        assert!(!log.faults.is_empty(), "{text}");
        let last = log.motions.last().expect("a motion");
        assert_eq!((last.end.xyz(), last.tilt.normal), (None, None), "{text}");
    }
    // 30 without a decimal point is 30 deg or 0.030 deg, as a parameter says
    assert_eq!(
        faults("fanuc-30i", "G68.2 X0. Y0. Z0. I0 J30 K0\n"),
        ["1: J30: AmbiguousDecimal"]
    );
    // one angle alone is the same whatever the order
    let one = motions("fanuc-30i", "G68.2 P1 Q321 X0. Y0. Z0. I90. J0. K0.\nG0 X1. Y2. Z3.\n");
    near(one[0].end.xyz(), [1.0, -3.0, 2.0]);
}

/// Codes that turn planes, zero points or axes and are not modelled: each is named, and where anything is afterwards is not known.
#[test]
fn no_code_that_turns_something_passes_for_a_plain_motion() {
    for (dialect, code, end) in [
        ("haas-ngc", "G254", "G255"),
        ("haas-ngc", "G268 X1. Y2. Z3. I10. J20. K30.", "G269"),
        ("haas-ngc", "G268 X1. Y2. Z3. I10. J20. K30. Q321", "G269"),
        ("fanuc-30i", "G68.2 P2 Q1 X0. Y0. Z0.", "G69"),
        ("fanuc-30i", "G68.2 P3 Q1 X0. Y0. Z0. I1. J0. K0.", "G69"),
        ("fanuc-30i", "G68.2 P4 X0. Y0. Z0. I10. J20. K0.", "G69"),
        ("fanuc-30i", "G68.3 X0. Y0. Z0.", "G69"),
        ("fanuc-30i", "G54.2 P1", "G54.2 P0"),
        ("fanuc-30i", "G54.4 P1", "G54.4 P0"),
        ("linuxcnc", "G68.2 X0 Y0 Z0 I10 J20 K30", "G69"),
        ("linuxcnc", "G68.4 X0 Y0 Z0 I10 J20 K30", "G69"),
    ] {
        let text = format!("G0 X1. Y2. Z3.\n{code}\nG0 X4. Y5. Z6.\nG1 X7. F100.\n{end}\n");
        let log = run_text(dialect, &text);
        let name = code.split(' ').next().unwrap_or_default();
        let said = faults(dialect, &text);
        assert!(
            said.iter().any(|fault| fault.contains(name)),
            "{dialect} {code}: {said:?}"
        );
        for motion in &log.motions[1..] {
            assert_eq!(motion.end.xyz(), None, "{dialect} {code}: {}", line(motion));
        }
    }
    // these turn the rotary axes once
    for (dialect, code) in [
        ("haas-ngc", "G253"),
        ("linuxcnc", "G53.1 P0"),
        ("linuxcnc", "G53.3 P0 X1 Y2 Z3"),
        ("linuxcnc", "G53.6 P0"),
        ("fanuc-30i", "G53.1"),
        ("fanuc-30i", "G53.6 P1"),
    ] {
        let text = format!("G0 X1. Y2. Z3. A4. C5.\n{code}\nG0 X4. Y5. Z6.\n");
        let log = run_text(dialect, &text);
        let name = code.split(' ').next().unwrap_or_default();
        let said = faults(dialect, &text);
        assert!(
            said.iter().any(|fault| fault.contains(name)),
            "{dialect} {code}: {said:?}"
        );
        let last = log.motions.last().expect("a motion");
        assert!(
            last.end.get(3).is_none() && last.end.get(5).is_none(),
            "{dialect} {code}: {}",
            line(last)
        );
    }
}

/// Roll 30 about X, then pitch 20 about Y (Q123). About fixed axes the normal is Ry Rx z, about turned axes Rx Ry z; Q213 swaps the two.
#[test]
fn roll_pitch_and_yaw_are_known_where_the_control_says_what_they_turn_about() {
    use trunnion_interp::RollPitchYaw::{Fixed, Turned};
    let (sin_roll, cos_roll) = trunnion_geometry::math::sin_cos(30f64.to_radians());
    let (sin_pitch, cos_pitch) = trunnion_geometry::math::sin_cos(20f64.to_radians());
    let pitch_outside = [cos_roll * sin_pitch, -sin_roll, cos_roll * cos_pitch];
    let roll_outside = [sin_pitch, -sin_roll * cos_pitch, cos_roll * cos_pitch];
    for (order, about, wanted) in [
        (123, Some(Fixed), Some(pitch_outside)),
        (123, Some(Turned), Some(roll_outside)),
        (213, Some(Fixed), Some(roll_outside)),
        (213, Some(Turned), Some(pitch_outside)),
        (123, None, None),
        (122, Some(Fixed), None),
        (1123, Some(Fixed), None),
    ] {
        let mut setup = Setup::default();
        setup.control.roll_pitch_yaw = about;
        let text = format!("G68.2 P1 Q{order} X0. Y0. Z0. I30. J20. K0.\nG0 X1. Y2. Z3.\n");
        let (_, log) = run_bytes("fanuc-30i", text.as_bytes(), &setup);
        match wanted {
            Some(wanted) => near(log.motions[0].tilt.normal, wanted),
            None => assert_eq!(log.motions[0].end.xyz(), None, "Q{order}"),
        }
    }
}

/// Which of two solutions P means is for the machine to say; the program continues.
#[test]
fn a_numbered_solution_is_passed_on() {
    let found = motions(
        "fanuc-30i",
        "G68.2 X0. Y0. Z0. I0. J30. K0.\nG53.1 P2\nG0 X1. Y2. Z3.\n",
    );
    assert_eq!(found[0].tilt.posture, Posture::Numbered(2));
    assert_eq!(found[1].tilt.posture, Posture::ByRule);
    assert!(found[1].end.xyz().is_some());
}

/// STAT is modal, TU holds for its block, and both only point to point.
#[test]
fn point_to_point_travel_carries_its_words() {
    let text = "TRAORI\nG0 X0 Y0 Z0 A0 C0\nPTP\nG1 X1 A10 C20 F500 STAT='B10' TU='H18'\nX2 C30\nG2 X4 I1 TU=8\nCP\nG1 X5\nPTPG0\nG0 X6 TU=8\nG1 X7\nTRAFOOF\nG0 X8\n";
    let found = motions("sinumerik-840d", text);
    let travel: Vec<_> = found
        .iter()
        .map(|motion| (motion.tilt.swivel, motion.tilt.posture))
        .collect();
    let bits = |status, turn| Posture::Bits { status, turn };
    let led = (Swivel::No, Posture::ByRule);
    assert_eq!(
        travel,
        [
            led,
            (Swivel::PointToPoint, bits(Some(2), Some(24))),
            (Swivel::PointToPoint, bits(Some(2), None)),
            led,
            led,
            (Swivel::PointToPoint, bits(Some(2), Some(8))),
            led,
            led
        ]
    );
    let said = faults("sinumerik-840d", text);
    assert!(
        said.len() == 2
            && said.iter().any(|fault| fault.contains("TU"))
            && said.iter().any(|fault| fault.contains("arc")),
        "{said:?}"
    );
    // continuous: the control reads neither; without a transformation nothing says what they are
    let said = faults("sinumerik-840d", "TRAORI\nG0 X0 Y0 Z0 A0 C0 STAT=1 TU=2\n");
    assert_eq!(said, [""; 0]);
    let said = faults("sinumerik-840d", "G0 X0 Y0 Z0 A0 C0 STAT=1 TU=2\n");
    assert_eq!(said.len(), 2, "{said:?}");
}

#[test]
fn machine_coordinates_and_zero_points_are_not_the_planes() {
    let text = "G54\nG0 X0. Y0. Z0.\nG68.2 X0. Y0. Z0. I0. J90. K0.\nG0 X1. Y2. Z3.\nG53 G0 Z0.\nG0 X5.\nG69\n";
    let found = motions("fanuc-30i", text);
    assert!(found[2].machine_coordinates && found[2].tilt.normal.is_none());
    assert_eq!((found[2].end.get(0), found[2].end.get(2)), (None, Some(0.0)));
    // X of the plane alone is X of the part here; the others are not known any more
    assert_eq!(
        (found[3].end.get(0), found[3].end.get(1), found[3].end.get(2)),
        (Some(5.0), None, None)
    );
}

/// Ends of the feed motions in each tilted plane, in order: number of the plane's first line, ends.
fn planes(dialect: &str, file: &str) -> Option<Vec<(Vec3, Vec<Vec3>)>> {
    let (_, log) = run_bytes(dialect, &shared(file)?, &Setup::default());
    let mut planes: Vec<(Vec3, Vec<Vec3>)> = Vec::new();
    let mut inside = false;
    for motion in &log.motions {
        let Some(normal) = motion.tilt.normal else {
            inside = false;
            continue;
        };
        if !inside {
            planes.push((normal, Vec::new()));
            inside = true;
        }
        if let (true, Some(end), Some((_, ends))) = (motion.is_feed(), motion.end.xyz(), planes.last_mut()) {
            ends.push(end);
        }
    }
    Some(planes)
}

/// One 3+2 part posted for a Fanuc and for an 840D: what the 840D feeds to, the Fanuc feeds to in the same order, within the last
/// decimal of the words. The Fanuc writes each turn of a helix; drilling cycles of the 840D are not expanded.
#[test]
fn a_part_for_two_controls_has_the_same_motions() {
    let (Some(fanuc), Some(sinumerik)) = (
        planes("fanuc-30i", "five-axis-pairs/smpl_sim08_5ax_fanuc_mm.nc"),
        planes("sinumerik-840d", "five-axis-pairs/smpl_sim08_5ax_sinumerik_mm.mpf"),
    ) else {
        return;
    };
    assert_eq!((fanuc.len(), sinumerik.len()), (4, 4));
    for (index, ((n1, fanuc), (n2, sinumerik))) in fanuc.iter().zip(&sinumerik).enumerate() {
        assert!((n1 - n2).norm() < 1e-9, "{index}: {n1} {n2}");
        let mut left = fanuc.iter();
        for end in sinumerik {
            let found = left.any(|other| (end - other).norm() < 2e-3);
            assert!(found, "operation {index}: {end:?} is not there on the Fanuc");
        }
        if index != 1 {
            assert!(sinumerik.len() > 20, "operation {index}: {}", sinumerik.len());
        }
    }
}

#[test]
fn three_points_and_two_vectors_give_the_plane_of_the_euler_angles() {
    let euler = "G68.2 X10. Y20. Z30. I0. J90. K0.\nG53.1\nG0 X25. Y15. Z25.\n";
    let points = "G68.2 P2 Q1 X10. Y20. Z30.\nG68.2 P2 Q2 X20. Y20. Z30.\nG68.2 P2 Q3 X10. Y20. Z40.\nG53.1\nG0 X25. Y15. Z25.\n";
    let vectors = "G68.2 P3 Q1 X10. Y20. Z30. I1. J0. K0.\nG68.2 P3 Q2 I0. J-2. K0.\nG53.1\nG0 X25. Y15. Z25.\n";
    let last = |text: &str| *motions("fanuc-30i", text).last().expect("a motion");
    let wanted = last(euler);
    for text in [points, vectors] {
        assert_eq!(faults("fanuc-30i", text), Vec::<String>::new(), "{text}");
        let found = last(text);
        near(found.end.xyz(), wanted.end.xyz().expect("known").into());
        near(found.tilt.normal, wanted.tilt.normal.expect("tilted").into());
    }
    // R turns about the new Z: x of the plane is then the old y of it
    let turned = "G68.2 P3 Q1 X0. Y0. Z0. I1. J0. K0.\nG68.2 P3 Q2 I0. J0. K1. R90.\nG53.1\nG0 X1. Y0. Z0.\n";
    near(last(turned).end.xyz(), [0.0, 1.0, 0.0]);
}

#[test]
fn a_plane_that_is_not_complete_or_has_a_shift_in_q0_is_unknown() {
    for text in [
        "G68.2 P2 Q1 X0. Y0. Z0.\nG68.2 P2 Q2 X1. Y0. Z0.\nG53.1\nG0 X1. Y1. Z1.\n",
        "G68.2 P2 Q1 X0. Y0. Z0.\nX1. Y1. Z1.\n",
        "G68.2 P2 Q0 X1. Y0. Z0.\nG0 X1. Y1. Z1.\n",
        "G68.2 P2 Q1 X0. Y0. Z0.\nG68.2 P2 Q2 X1. Y0. Z0.\nG68.2 P2 Q3 X2. Y0. Z0.\nG0 X1. Y1. Z1.\n",
        "G68.2 P3 Q1 X0. Y0. Z0. I1. J0. K0.\nG68.2 P3 Q2 I1. J0. K1.\nG0 X1. Y1. Z1.\n",
        "G68.2 P3 Q2 I0. J0. K1.\nG0 X1. Y1. Z1.\n",
    ] {
        let got = faults("fanuc-30i", text);
        assert!(got.iter().any(|fault| fault.contains("G68.2")), "{text}: {got:?}");
        let last = *motions("fanuc-30i", text).last().expect("a motion");
        assert_eq!(last.end.xyz(), None, "{text}");
    }
}

#[test]
fn cycle800_ends_with_empty_brackets_or_with_the_record_0() {
    let start = "G17 G90\nCYCLE800(0,\"T\",0,57,1,2,3,0,90,0,0,0,0,-1)\nG0 X10 Y0 Z5\n";
    for end in ["CYCLE800", "CYCLE800()", "CYCLE800(0,\"0\",0,57,0,0,0,0,0,0,0,0,0,0)"] {
        let text = format!("{start}{end}\nG0 X10 Y20 Z5\n");
        assert_eq!(faults("sinumerik-840d", &text), Vec::<String>::new(), "{end}");
        let last = *motions("sinumerik-840d", &text).last().expect("a motion");
        near(last.end.xyz(), [10.0, 20.0, 5.0]);
        assert_eq!(last.tilt.normal, None, "{end}");
    }
    let moved = format!("{start}CYCLE800(2,\"0\",0,57,0,0,0,0,0,0,0,0,0,1)\nG0 X10 Y20\n");
    let got = faults("sinumerik-840d", &moved);
    assert!(
        got.iter().any(|fault| fault.contains("retracts and turns back")),
        "{got:?}"
    );
    let last = *motions("sinumerik-840d", &moved).last().expect("a motion");
    assert_eq!((last.end.get(0), last.end.get(2)), (Some(10.0), None));
}
