//! Random numbers and random machines for tests.
use std::fmt::Write;
use trunnion_geometry::Vec3;
use trunnion_machine::{Machine, load};

/// Random numbers that are the same everywhere (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// 0..1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    pub(crate) fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
    pub(crate) fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::new(self.range(-1.0, 1.0), self.range(-1.0, 1.0), self.range(-1.0, 1.0));
            if v.norm() > 0.1 && v.norm() < 1.0 {
                return v.normalize();
            }
        }
    }
}

/// A machine with two rotary axes (C nearest the workpiece, then A) and three linear axes in any places of the chain, with any
/// directions, signs and offsets. `straight`: linear axes along the coordinates, all in one place of the chain.
pub(crate) fn random_machine(random: &mut Random, straight: bool, tcp_orientation: &str) -> Machine {
    loop {
        let mut order: Vec<usize> = vec![3, 4];
        let shared = random.below(3);
        for linear in 0..3 {
            let place = if straight { shared } else { random.below(3) };
            // before C, between, after A
            let rotaries: Vec<usize> = (0..order.len()).filter(|&i| order[i] >= 3).collect();
            let at = match place {
                0 => rotaries[0],
                1 => rotaries[1],
                _ => order.len(),
            };
            order.insert(at, linear);
        }
        let mut text = String::from("schema = \"ncmachine/1\"\nname = \"random\"\n[spindle]\ntool_axis = [0, 0, 1]\n");
        let gauge = Vec3::new(
            random.range(-50.0, 50.0),
            random.range(-50.0, 50.0),
            random.range(-50.0, 50.0),
        );
        writeln!(text, "gauge_point = [{}, {}, {}]", gauge.x, gauge.y, gauge.z).expect("text");
        for axis in order {
            let letter = ["X", "Y", "Z", "C", "A"][axis];
            let mut direction = [Vec3::x(), Vec3::y(), Vec3::z(), Vec3::z(), Vec3::x()][axis];
            if !straight || (axis >= 3 && random.below(3) == 0) {
                direction = (direction + random.direction() * if axis < 3 { 0.3 } else { 1.5 }).normalize();
            }
            let sign = if random.below(2) == 0 { 1 } else { -1 };
            let kind = if axis < 3 { "linear" } else { "rotary" };
            writeln!(
                text,
                "[[axis]]\nletter = \"{letter}\"\nkind = \"{kind}\"\nside = \"table\"\ndir = [{}, {}, {}]\nsign = {sign}",
                direction.x, direction.y, direction.z
            )
            .expect("text");
            if axis < 3 {
                writeln!(
                    text,
                    "limits = [-2000, 2000]\ndyn = {{ vmax = {} }}",
                    random.range(5.0, 500.0)
                )
                .expect("text");
            } else {
                let point = random.direction() * random.range(0.0, 150.0);
                writeln!(
                    text,
                    "point = [{}, {}, {}]\nlimits = \"unbounded\"",
                    point.x, point.y, point.z
                )
                .expect("text");
                writeln!(text, "dyn = {{ vmax = {} }}", random.range(20.0, 500.0)).expect("text");
            }
        }
        writeln!(
            text,
            "[control]\nfamily = \"generic\"\ntcp = {{ orientation = \"{tcp_orientation}\" }}"
        )
        .expect("text");
        match load("random", &text) {
            Ok(machine) => return machine,
            // unlucky directions (nearly parallel axes) are refused by the loader
            Err(error) => assert!(!error.message.contains("unknown"), "{}\n{text}", error.message),
        }
    }
}
