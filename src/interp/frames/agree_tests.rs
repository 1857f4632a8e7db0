//! CYCLE800 in its six orders, G68.2 by Euler angles, by points and by vectors, on the same random planes.
use super::points::Pending;
use super::swivel_call::SwivelCall;
use super::tilt::{Tilted, turn_about};
use trunnion_geometry::math::{atan2, hypot};
use trunnion_geometry::{Mat3, Vec3};

/// Degrees, -180 to 180, from a linear congruence (Knuth's MMIX).
struct Angles(u64);

impl Angles {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 * 360.0 - 180.0
    }
}

/// Angles about Z, the new X, the new Z that make a matrix (column-wise: the plane's axes).
fn euler(turn: &Mat3) -> [f64; 3] {
    let normal = turn.column(2);
    let tilt = atan2(hypot(normal[0], normal[1]), normal[2]);
    let first = atan2(normal[0], -normal[1]);
    let rest = turn_about(0, tilt.to_degrees()).transpose() * turn_about(2, first.to_degrees()).transpose() * turn;
    [first, tilt, atan2(rest[(1, 0)], rest[(0, 0)])].map(f64::to_degrees)
}

#[test]
fn the_same_plane_in_every_form() {
    let mut angles = Angles(20_240_611);
    let orders = [
        (57, [0, 1, 2]),
        (45, [0, 2, 1]),
        (54, [1, 0, 2]),
        (30, [1, 2, 0]),
        (39, [2, 0, 1]),
        (27, [2, 1, 0]),
    ];
    for round in 0..10_000 {
        let (mode, axes) = orders[round % 6];
        let given = [angles.next(), angles.next(), angles.next()];
        let call = format!(
            "CYCLE800(0,\"\",0,{mode},0,0,0,{},{},{},0,0,0,0)",
            given[0], given[1], given[2]
        );
        let swivelled = Tilted::new(
            Vec3::zeros(),
            &SwivelCall::read(&call, |_| None).expect("modelled").turns,
        );
        // turns about the axes as they come out are turns about the fixed axes in the other order
        let fixed = axes
            .iter()
            .zip(given)
            .rev()
            .fold(Mat3::identity(), |turn, (&axis, angle)| turn_about(axis, angle) * turn);
        assert!((swivelled.turn - fixed).norm() < 1e-12, "{call}");
        let [i, j, k] = euler(&swivelled.turn);
        let by_euler = Tilted::new(Vec3::zeros(), &[(2, i), (0, j), (2, k)]);
        let [x, y, z] = [0, 1, 2].map(|column| Vec3::from(swivelled.turn.column(column)));
        let by_points = Pending::points([Vec3::zeros(), x * 7.0, x * 2.0 + y * 3.0]);
        let by_vectors = Pending::vectors(x * 0.5, z * 4.0);
        for (form, turn) in [("G68.2", by_euler.turn), ("P2", by_points), ("P3", by_vectors)] {
            assert!((swivelled.turn - turn).norm() < 1e-9, "{form} {call}");
        }
    }
}
