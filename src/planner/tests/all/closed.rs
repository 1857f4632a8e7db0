//! Single moves against closed forms, and against phases that are integrated here.
use trunnion_planner::{Ramp, s_curve, trapezoid};

/// Way and time of the seven phases, integrated one by one: jerk j, -j, ... with the durations of a symmetric move.
fn seven(jerk: f64, bend: f64, even: f64, cruise: f64) -> (f64, f64, f64, f64) {
    let phases = [
        (jerk, bend),
        (0.0, even),
        (-jerk, bend),
        (0.0, cruise),
        (-jerk, bend),
        (0.0, even),
        (jerk, bend),
    ];
    let (mut s, mut v, mut a, mut time) = (0.0, 0.0, 0.0, 0.0);
    let (mut top, mut most) = (0.0_f64, 0.0_f64);
    for (j, t) in phases {
        s += v * t + a * t * t / 2.0 + j * t * t * t / 6.0;
        v += a * t + j * t * t / 2.0;
        a += j * t;
        time += t;
        top = top.max(v);
        most = most.max(a);
    }
    assert!(v.abs() < 1e-9 && a.abs() < 1e-9);
    (s, time, top, most)
}

#[test]
fn s_curves_are_their_seven_phases() {
    for (jerk, bend, even, cruise) in [
        (50_000.0, 0.04, 0.1, 0.3),
        (50_000.0, 0.04, 0.0, 0.3),
        (50_000.0, 0.04, 0.1, 0.0),
        (2000.0, 0.013, 0.0, 0.0),
        (20.0, 0.5, 0.2, 7.0),
    ] {
        let (length, time, top, most) = seven(jerk, bend, even, cruise);
        // what a phase does not use may be anything above it
        let cap = if cruise > 0.0 { top } else { top * 3.0 };
        let acceleration = if even > 0.0 { most } else { most * 2.0 };
        let (found, reached) = s_curve(length, cap, acceleration, jerk);
        assert!((found - time).abs() < 1e-9 * time, "{found} against {time}");
        assert!((reached - top).abs() < 1e-9 * top);
    }
}

#[test]
fn trapezoids() {
    // reached: L/v + v/a; not reached: 2 sqrt(L/a)
    assert!((trapezoid(100.0, 50.0, 1000.0) - 2.05).abs() < 1e-9);
    assert!((trapezoid(1.0, 500.0, 1000.0) - 2.0 * (1.0_f64 / 1000.0).sqrt()).abs() < 1e-9);
    assert!((trapezoid(100.0, 50.0, f64::INFINITY) - 2.0).abs() < 1e-12);
    assert_eq!(
        s_curve(100.0, 50.0, 1000.0, f64::INFINITY).0,
        trapezoid(100.0, 50.0, 1000.0)
    );
}

#[test]
fn time_below_a_speed() {
    // from rest to 50 with 1000 and back: below 10 for 10 ms at each end
    let ramp = Ramp::fastest(100.0, 50.0, 1000.0, [0.0, 0.0]);
    let below = |speed: f64, smooth: [f64; 2]| ramp.seconds_below(speed, smooth);
    assert!(
        below(10.0, [ramp.top / 1000.0, 0.0])
            .iter()
            .all(|end| (end - 0.01).abs() < 1e-12)
    );
    // with 40 000 mm/s^3 the acceleration is there after 0.025 s, at 12.5: v = j t^2/2 before, and the same before the top
    let smooth = [ramp.top / 1000.0, 0.025];
    for (speed, seconds) in [(10.0, (20.0 / 40_000.0_f64).sqrt()), (30.0, 0.0425), (50.0, 0.075)] {
        assert!((below(speed, smooth)[0] - seconds).abs() < 1e-12, "{speed}");
    }
    assert_eq!(ramp.at(0.2), ((400.0_f64).sqrt(), 1000.0));
}
