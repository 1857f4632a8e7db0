//! Arcs against numbers worked out by hand and against dense sampling.
use super::{Arc, RadiusFault, Turning};
use crate::Vec3;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use proptest::prelude::*;

fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

#[test]
fn a_quarter_circle() {
    let arc = Arc::from_centre(
        v(10., 0., 5.),
        v(0., 10., 5.),
        v(0., 0., 99.),
        Vec3::z(),
        Turning::CounterClockwise,
        0,
    )
    .expect("an arc");
    assert_eq!(arc.centre, v(0., 0., 5.));
    assert!((arc.sweep - FRAC_PI_2).abs() < 1e-15);
    assert_eq!((arc.radius_start, arc.radius_end), (10.0, 10.0));
    assert!((arc.length() - 10.0 * FRAC_PI_2).abs() < 1e-13);
    let clockwise = Arc::from_centre(arc.start, arc.end, arc.centre, Vec3::z(), Turning::Clockwise, 0).expect("an arc");
    assert!((clockwise.sweep + 1.5 * PI).abs() < 1e-15);
    assert!((clockwise.point_at(1.0 / 3.0) - v(0., -10., 5.)).norm() < 1e-13);
    assert!((clockwise.extent(&Vec3::x()).0 + 10.0).abs() < 1e-13);
    assert!((arc.extent(&Vec3::x()).0).abs() < 1e-13);
}

#[test]
fn same_end_is_a_full_circle_and_turns_add() {
    let p = v(3., 4., 0.);
    let full = Arc::from_centre(p, p, Vec3::zeros(), Vec3::z(), Turning::Clockwise, 0).expect("an arc");
    assert!((full.sweep + TAU).abs() < 1e-15);
    let helix = Arc::from_centre(
        p,
        p + v(0., 0., 6.),
        Vec3::zeros(),
        Vec3::z(),
        Turning::CounterClockwise,
        2,
    )
    .expect("an arc");
    assert!((helix.sweep - 3.0 * TAU).abs() < 1e-14);
    let exact = ((3.0 * TAU * 5.0f64).powi(2) + 36.0).sqrt();
    assert!((helix.length() - exact).abs() < 1e-12);
    assert!((helix.extent(&Vec3::z()).1 - 6.0).abs() < 1e-12);
    assert!((helix.extent(&Vec3::y()).1 - 5.0).abs() < 1e-12);
}

#[test]
fn a_radius_gives_the_minor_or_the_major_arc() {
    let (start, end) = (v(10., 0., 0.), v(0., 10., 0.));
    let minor = Arc::from_radius(start, end, 10.0, Vec3::z(), Turning::CounterClockwise, 0.0).expect("an arc");
    assert!((minor.centre - Vec3::zeros()).norm() < 1e-14);
    assert!((minor.sweep - FRAC_PI_2).abs() < 1e-14);
    let major = Arc::from_radius(start, end, -10.0, Vec3::z(), Turning::CounterClockwise, 0.0).expect("an arc");
    assert!((major.centre - v(10., 10., 0.)).norm() < 1e-14);
    assert!((major.sweep - 1.5 * PI).abs() < 1e-14);
    let g2 = Arc::from_radius(start, end, 10.0, Vec3::z(), Turning::Clockwise, 0.0).expect("an arc");
    assert!((g2.centre - v(10., 10., 0.)).norm() < 1e-14);
    assert!((g2.sweep + FRAC_PI_2).abs() < 1e-14);
    assert_eq!(
        Arc::from_radius(start, v(30., 0., 0.), 9.99, Vec3::z(), Turning::Clockwise, 0.001),
        Err(RadiusFault::TooSmall(10.0))
    );
    let half = Arc::from_radius(start, v(30., 0., 0.), 9.9995, Vec3::z(), Turning::Clockwise, 0.001).expect("an arc");
    assert!((half.sweep + PI).abs() < 1e-12);
    assert_eq!(
        Arc::from_radius(start, start, 5.0, Vec3::z(), Turning::Clockwise, 0.001),
        Err(RadiusFault::SamePoint)
    );
}

#[test]
fn nothing_panics_on_odd_numbers() {
    for odd in [f64::NAN, f64::INFINITY, 0.0, 1e300] {
        let _ = Arc::from_centre(
            v(odd, 0., 0.),
            v(0., 1., 0.),
            v(0., odd, 0.),
            Vec3::z(),
            Turning::Clockwise,
            u32::MAX,
        );
        let _ = Arc::from_radius(v(odd, 0., 0.), v(0., 1., 0.), odd, Vec3::z(), Turning::Clockwise, 0.0);
    }
}

/// The first guess may be the middle: that is no sign that the steps have ended.
#[test]
fn a_zero_is_found_where_both_ends_are_as_far_from_it() {
    use crate::math::cos;
    let along = super::Along {
        cosine: 0.0,
        sine: 1.0,
        drift: -0.5 * (cos(1.0) + cos(2.0)),
        slope: 0.0,
        radius: 1.0,
        sweep: 1.0,
    };
    let [low, high] = [1.0, 2.0].map(|t| (t, along.rate(t)));
    assert!((low.1 + high.1).abs() < 1e-15 && along.rate(1.5).abs() > 1e-3);
    assert!(along.rate(along.zero(low, high)).abs() < 1e-12);
}

proptest! {
    #[test]
    fn length_and_extent_agree_with_sampling(
        r0 in 0.5f64..50.0, ratio in 0.5f64..2.0, angle in 0.1f64..6.0, turns in 0u32..6, height in -20.0f64..20.0,
        clockwise: bool, direction in (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0),
    ) {
        let (s, c) = crate::math::sin_cos(angle);
        let (start, end) = (v(r0, 0., 1.), v(r0 * ratio * c, r0 * ratio * s, 1.0 + height));
        let turning = if clockwise { Turning::Clockwise } else { Turning::CounterClockwise };
        let arc = Arc::from_centre(start, end, Vec3::zeros(), Vec3::z(), turning, turns).expect("an arc");
        prop_assert!((arc.point_at(0.999_999_999_999) - end).norm() < 1e-8);
        let direction = v(direction.0, direction.1, direction.2);
        prop_assume!(direction.norm() > 0.1);
        let direction = direction.normalize();
        let (low, high) = arc.extent(&direction);
        let (mut sum, mut last) = (0.0, start);
        let (mut seen_low, mut seen_high) = (direction.dot(&start), direction.dot(&start));
        for i in 1..=4000 {
            let point = arc.point_at(f64::from(i) / 4000.0);
            sum += (point - last).norm();
            last = point;
            let value = direction.dot(&point);
            (seen_low, seen_high) = (seen_low.min(value), seen_high.max(value));
            prop_assert!(value >= low - 1e-9 && value <= high + 1e-9, "{value} outside {low}..{high}");
        }
        prop_assert!((sum - arc.length()).abs() < 2e-5 * arc.length());
        prop_assert!(seen_low - low < 0.02 && high - seen_high < 0.02);
        let d = (arc.point_at(0.5001) - arc.point_at(0.4999)) / 0.0002;
        prop_assert!((d - arc.derivative_at(0.5)).norm() < 1e-4 * d.norm());
    }
}
