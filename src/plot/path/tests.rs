//! Views, marks and legends of a path.
use super::*;
use crate::texts::{header, overlaps, record};

fn drawn(record: &Record) -> String {
    let svg = path(&header(), record, 0.01).expect("drawn");
    assert_eq!(overlaps(&svg), []);
    svg
}
const UP: fn(usize) -> Vec3 = |_| Vec3::z();

#[test]
fn a_part_is_seen_from_three_sides_too() {
    let moves = [
        ('r', Vec3::new(0.0, 0.0, 50.0)),
        ('r', Vec3::new(0.0, 0.0, 2.0)),
        ('f', Vec3::new(0.0, 0.0, -4.0)),
        ('f', Vec3::new(40.0, 0.0, -4.0)),
        ('f', Vec3::new(40.0, 30.0, -4.0)),
    ];
    let svg = drawn(&record(&moves, UP));
    for (_, name) in VIEWS {
        assert!(svg.contains(name), "{name}");
    }
}

/// From above a hole is a point, which has a mark; a rapid from far away does not end where the frame does.
#[test]
fn holes_and_rapids_that_leave_the_frame_are_seen() {
    let mut moves = vec![('r', Vec3::new(0.0, 0.0, 500.0))];
    for x in [0.0, 20.0, 40.0] {
        let at = |z: f64| Vec3::new(x, 0.3 * x, z);
        moves.extend([('r', at(2.0)), ('f', at(-20.0)), ('r', at(2.0))]);
    }
    let all = record(&moves, UP);
    let svg = drawn(&all);
    assert!(svg.contains("feed seen end-on (hole, plunge)") && svg.contains("rapid (1 of 6 reach beyond a view)"));
    // one in the legend, three from above
    assert_eq!(svg.matches("<circle").count(), 4);
    assert!(!svg.contains("tool axis"), "it never turns");
    let svg = drawn(&record(
        &moves[1..4],
        |step| if step == 1 { Vec3::x() } else { Vec3::z() },
    ));
    assert!(svg.contains("tool axis") && svg.contains("rapid\n"), "{svg}");
}

#[test]
fn what_is_not_drawn_is_named() {
    let mut record = record(&[('r', Vec3::zeros()), ('f', Vec3::x()), ('f', Vec3::y())], UP);
    assert!(!drawn(&record).contains("not drawn"));
    (record.unknown, record.unknown_lines) = (1, vec![7]);
    assert!(drawn(&record).contains("1 motion not drawn: start or end not known (line 7)"));
    (record.unknown, record.unknown_lines) = (9, vec![2, 4, 5, 7]);
    assert!(drawn(&record).contains("9 motions not drawn: start or end not known (lines 2, 4, 5 and more)"));
}

/// However flat a part is, the isometric view names X, Y and Z with a scale or a range.
#[test]
fn every_axis_of_the_isometric_view_has_a_scale() {
    for size in [
        [40.0, 30.0, 0.3],
        [40.0, 0.2, 30.0],
        [0.1, 4.0, 4.0],
        [80.0, 70.0, 0.0],
        [0.001, 0.001, 9.0],
    ] {
        let high = Vec3::from(size);
        let moves = [
            ('r', Vec3::new(0.0, 0.0, high.z + 3.0)),
            ('r', Vec3::zeros()),
            ('f', Vec3::new(high.x, 0.0, 0.0)),
            ('f', high),
            ('r', Vec3::new(high.x, high.y, high.z + 2.0)),
        ];
        let svg = drawn(&record(&moves, UP));
        for (text, [left, top, right, bottom]) in crate::texts::texts(&svg) {
            assert!(
                left >= 0.0 && top >= 0.0 && right <= 12_000.0 && bottom <= 8_000.0,
                "{text}"
            );
        }
        let left: Vec<String> = crate::texts::texts(&svg)
            .into_iter()
            .filter(|(_, place)| place[2] < 7600.0)
            .map(|(text, _)| text)
            .collect();
        for letter in LETTERS {
            assert!(
                left.iter().any(|text| text.starts_with(letter) && text.contains("mm")),
                "{size:?}: no {letter} in {left:?}"
            );
        }
    }
}

/// A lathe's path lies in one plane: Z across, and X, along which its tools stand, upwards.
#[test]
fn a_path_in_one_plane_is_seen_at_right_angles() {
    let turned = [
        ('r', Vec3::new(30.0, 0.0, 5.0)),
        ('r', Vec3::new(20.0, 0.0, 5.0)),
        ('f', Vec3::new(20.0, 0.0, -60.0)),
        ('f', Vec3::new(24.0, 0.0, -60.0)),
    ];
    let view = |record: &Record| Part::of(record, 0.01).flat().map(|view| [view.across, view.upwards]);
    let lathe = record(&turned, |_| Vec3::x());
    assert_eq!(view(&lathe), Some([2, 0]));
    let svg = drawn(&lathe);
    assert!(svg.contains("Z / mm") && svg.contains("X / mm") && !svg.contains("Y / mm") && !svg.contains("from "));
    // the same in a mill, and in the other planes
    assert_eq!(view(&record(&turned, UP)), Some([0, 2]));
    let swapped = turned.map(|(kind, p)| (kind, Vec3::new(p.y, p.x, p.z)));
    assert_eq!(view(&record(&swapped, UP)), Some([1, 2]));
    let level = turned.map(|(kind, p)| (kind, Vec3::new(p.x, p.z, p.y)));
    assert_eq!(view(&record(&level, UP)), Some([0, 1]));
}

/// Only the tool axis moves in the cut: the scale is that of the rapids.
#[test]
fn cuts_in_one_point_are_seen_with_the_rapids() {
    let tip = Vec3::new(0.0, 0.0, 10.0);
    let moves = [
        ('r', Vec3::new(0.0, 0.0, 110.0)),
        ('r', tip),
        ('f', tip),
        ('f', tip),
        ('r', Vec3::new(0.0, 0.0, 80.0)),
    ];
    let svg = drawn(&record(&moves, UP));
    let numbers = crate::texts::texts(&svg);
    assert!(numbers.iter().any(|(text, _)| text == "100"), "{numbers:?}");
}
