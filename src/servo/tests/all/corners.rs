//! The corner of paper 002: interior angle 45 deg, F 1 m/min, 33.33 mm/s^2, Kv 1 (m/min)/mm. Numbers: two independent programs agree on them.
use trunnion_geometry::{Vec3, rad};
use trunnion_servo::*;

const KV: f64 = 1000.0 / 60.0;

fn corner() -> Corner {
    Corner::turning(rad(135.0)).expect("works")
}

fn profile() -> Profile {
    Profile {
        feeds: [1000.0 / 60.0; 2],
        acceleration: 33.33,
        corner_speed: 0.0,
    }
}

fn servo(plant: Plant, sample: Option<f64>) -> Servo {
    Servo {
        gain: Vec3::repeat(KV),
        feed_forward: 0.0,
        plant,
        sample,
    }
}

fn third(bandwidth_hz: f64) -> Servo {
    servo(Plant::Third { bandwidth_hz }, Some(1e-3))
}

fn run(servo: &Servo, gain: f64, delay: u32, predict: bool) -> Response {
    let correction = Correction { gain, delay, predict };
    simulate(&corner(), &profile(), servo, &correction).expect("works")
}

/// um, within a share of the wanted value.
fn near(found_mm: f64, wanted_um: f64, share: f64) {
    let found = found_mm * 1e3;
    assert!(
        (found - wanted_um).abs() <= share * wanted_um,
        "{found} um, wanted {wanted_um} um"
    );
}

#[test]
fn closed_forms_and_the_first_order() {
    near(closed_form(&corner(), &profile(), KV, 0.0), 23.121, 3e-5);
    near(run(&servo(Plant::First, None), 0.0, 0, false).exact, 23.117, 5e-5);
    let sampled = servo(Plant::First, Some(1e-3));
    assert!((sampled.closed_gain().expect("works") - 16.807).abs() < 5e-4);
    near(
        closed_form(&corner(), &profile(), sampled.closed_gain().expect("works"), 0.0),
        22.736,
        5e-5,
    );
    near(run(&sampled, 0.0, 0, false).exact, 22.73, 5e-4);
    // held 10 us; where in the period the corner comes moves the last digit
    near(run(&servo(Plant::First, Some(1e-5)), 0.0, 0, false).exact, 23.115, 1e-4);
}

const GAINS: [f64; 7] = [0.0, 100.0, 140.0, 145.0, 160.0, 200.0, 300.0];

#[test]
fn the_third_order_at_60_hz() {
    let path = [22.814, 11.03, 8.85, 8.63, 8.04, 6.80, 4.89];
    let sampled = [22.572, 10.99, 8.80, 8.56, 7.93, 6.77, 4.86];
    for ((gain, path), sampled) in GAINS.into_iter().zip(path).zip(sampled) {
        for (delay, predict) in [(0, false), (4, true)] {
            let found = run(&third(60.0), gain, delay, predict);
            near(found.exact, path, 0.002);
            near(found.sampled, sampled, 0.005);
            assert!(!found.unstable);
        }
    }
}

#[test]
fn the_published_value_holds_from_145_on() {
    for gain in [145.0, 150.0, 160.0, 180.0, 200.0, 250.0, 300.0] {
        let found = run(&third(60.0), gain, 4, true);
        assert!(
            found.exact <= 8.75e-3 && found.sampled <= 8.75e-3,
            "Sp {gain}: {} mm",
            found.exact
        );
    }
    assert!(run(&third(60.0), 140.0, 4, true).exact > 8.75e-3);
}

#[test]
fn a_delay_without_prediction() {
    for (gain, wanted) in [(100.0, 12.40), (140.0, 9.95), (160.0, 9.18), (200.0, 7.64)] {
        let found = run(&third(60.0), gain, 4, false);
        near(found.sampled, wanted, 0.005);
        assert!(!found.unstable, "Sp {gain}");
    }
    for gain in [250.0, 300.0] {
        let found = run(&third(60.0), gain, 4, false);
        assert!(found.unstable, "Sp {gain}");
    }
}

#[test]
fn the_radial_error_of_the_paper_is_another_measure() {
    let found = run(&third(60.0), 0.0, 0, false);
    near(found.radial, 58.22, 0.005);
    near(found.sampled, 22.572, 0.005);
    near(run(&third(30.0), 0.0, 0, false).sampled, 22.885, 0.005);
}

/// Kv and A scale the error, the feed does not (while the braking is long against 1/Kv); the plane of the corner does not matter.
#[test]
fn closed_form_and_simulation_agree() {
    for (turn, kv, acceleration, feed_mm_min, corner_share) in [
        (135.0, 20.0, 50.0, 2000.0, 0.0),
        (90.0, 33.0, 1000.0, 30000.0, 0.0),
        (30.0, 50.0, 500.0, 12000.0, 0.0),
        (60.0, 25.0, 200.0, 3000.0, 1.0),
        (120.0, 25.0, 300.0, 6000.0, 0.3),
    ] {
        let feed = feed_mm_min / 60.0;
        let profile = Profile {
            feeds: [feed; 2],
            acceleration,
            corner_speed: corner_share * feed,
        };
        let (sin, cos) = trunnion_geometry::math::sin_cos(rad(turn));
        let (a, n) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 1.0, 0.0));
        let corner = Corner::new(&a, &(a * cos + n * sin)).expect("works");
        for feed_forward in [0.0, 0.6] {
            let servo = Servo {
                gain: Vec3::repeat(kv),
                feed_forward,
                plant: Plant::First,
                sample: None,
            };
            let found = simulate(&corner, &profile, &servo, &Correction::default())
                .expect("works")
                .exact;
            let closed = closed_form(&corner, &profile, kv, feed_forward);
            assert!(
                (found / closed - 1.0).abs() < 1e-3,
                "turn {turn}: {found} against {closed}"
            );
        }
    }
}

/// With its ramps it holds for any feed: one that the braking reaches within a fraction of 1/Kv, too.
#[test]
fn the_closed_form_with_ramps_holds_for_slow_feeds() {
    near(closed_form_with_ramps(&corner(), &profile(), KV, 0.0), 23.117, 5e-5);
    let corner = Corner::turning(rad(90.0)).expect("works");
    for feed_mm_min in [20.0, 60.0, 300.0, 3000.0] {
        for (corner_speed, feed_forward) in [(0.0, 0.0), (0.2, 0.0), (0.0, 0.5)] {
            let profile = Profile {
                feeds: [feed_mm_min / 60.0; 2],
                acceleration: 1000.0,
                corner_speed,
            };
            let servo = Servo {
                gain: Vec3::repeat(30.0),
                feed_forward,
                plant: Plant::First,
                sample: None,
            };
            let found = simulate(&corner, &profile, &servo, &Correction::default()).expect("works");
            let closed = closed_form_with_ramps(&corner, &profile, 30.0, feed_forward);
            assert!(
                (found.exact / closed - 1.0).abs() < 2e-3,
                "F{feed_mm_min} {corner_speed}: {} {closed}",
                found.exact
            );
        }
    }
}

#[test]
fn known_factors() {
    let corner = Corner::turning(rad(90.0)).expect("works");
    // a constant speed v leaves e^-1 v/Kv, a stop 0.272511 A/Kv^2
    assert!((slowest_corner_speed(&corner, 1.0, 0.0, 0.367_879_441) - 1.0).abs() < 1e-8);
    assert!((stop_acceleration(&corner, 1.0, 0.0, 0.272_511) - 1.0).abs() < 1e-5);
}

#[test]
fn straight_on_and_back() {
    for turn in [0.0, 180.0] {
        let corner = Corner::turning(rad(turn)).expect("works");
        let found = simulate(
            &corner,
            &profile(),
            &third(60.0),
            &Correction {
                gain: 150.0,
                delay: 0,
                predict: false,
            },
        )
        .expect("works");
        assert!(
            found.sampled < 1e-9 && !found.unstable,
            "turn {turn}: {} mm",
            found.sampled
        );
    }
}

#[test]
fn gains_that_differ_leave_an_error_on_the_legs() {
    // on a line at the angle b: v sin b cos b |1/Kx - 1/Ky|
    let (kx, ky) = (20.0, 25.0);
    let corner = Corner::new(&Vec3::new(1.0, 1.0, 0.0), &Vec3::new(-1.0, 1.0, 0.0)).expect("works");
    let servo = Servo {
        gain: Vec3::new(kx, ky, kx),
        ..servo(Plant::First, Some(1e-3))
    };
    let feed = 1000.0 / 60.0;
    let found = simulate(&corner, &profile(), &servo, &Correction::default()).expect("works");
    let first = found.spots.first().expect("works");
    let wanted = first.reference.norm();
    assert!(wanted > 3.5);
    // the reference is braking there: take the start in steady state, before it
    let speed = profile().at(first.time).1;
    assert!(speed > 0.9 * feed);
    let expected = speed * 0.5 * (1.0 / kx - 1.0 / ky);
    assert!(
        (first.distance / expected - 1.0).abs() < 0.05,
        "{} against {expected}",
        first.distance
    );
    assert!(servo.closed_gain().is_none());
}

#[test]
fn what_keeps_a_corner_within_a_tolerance() {
    let (corner, profile, servo) = (corner(), profile(), third(60.0));
    let correction = Correction {
        gain: 0.0,
        delay: 4,
        predict: true,
    };
    let found = within(&corner, &profile, &servo, &correction, 8.75e-3).expect("works");
    let gain = found.corner_gain.expect("works");
    assert!((140.0..145.0).contains(&gain), "{gain}");
    let acceleration = found.acceleration.expect("works");
    let check = simulate(
        &corner,
        &Profile {
            acceleration,
            ..profile
        },
        &servo,
        &correction,
    )
    .expect("works");
    assert!(check.exact <= 8.75e-3 && check.exact > 8.7e-3, "{}", check.exact);
    // the closed form is that of a lag of the first order: 33.33 * 8.75 / 23.121
    assert!((found.acceleration_closed.expect("works") - 12.614).abs() < 0.01);
    let kv = found.position_gain.expect("works");
    let faster = Servo {
        gain: Vec3::repeat(kv),
        ..servo
    };
    assert!(simulate(&corner, &profile, &faster, &correction).expect("works").exact <= 8.75e-3);
    assert_eq!(found.corner_speed, None, "a stop already leaves 22.8 um");
    assert!((found.speed_closed.expect("works") - 8.75e-3 * KV * core::f64::consts::E / (0.5_f64).sqrt()).abs() < 1e-6);
}

#[test]
fn a_gain_too_large_for_the_sample_is_unstable() {
    let servo = Servo {
        gain: Vec3::repeat(2100.0),
        ..servo(Plant::First, Some(1e-3))
    };
    assert!(
        simulate(&corner(), &profile(), &servo, &Correction::default())
            .expect("works")
            .unstable
    );
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let plain = Correction::default();
    let refused = |profile: Profile, servo: Servo, correction: Correction| {
        simulate(&corner(), &profile, &servo, &correction).expect_err("refused")
    };
    assert_eq!(
        refused(
            profile(),
            Servo {
                sample: None,
                ..third(60.0)
            },
            plain
        ),
        ServoError::NeedsSample
    );
    let correction = Correction { gain: 1.0, ..plain };
    assert_eq!(
        refused(profile(), servo(Plant::First, None), correction),
        ServoError::NeedsSample
    );
    assert_eq!(
        refused(
            Profile {
                acceleration: 1e-9,
                ..profile()
            },
            third(60.0),
            plain
        ),
        ServoError::TooLong
    );
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            refused(
                Profile {
                    acceleration: value,
                    ..profile()
                },
                third(60.0),
                plain
            ),
            ServoError::Value(_)
        ));
        assert!(matches!(refused(profile(), third(value), plain), ServoError::Value(_)));
    }
}
