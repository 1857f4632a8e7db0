//! The bytes of a scene. Layout: docs/scene.md.
use crate::scene::{Kind, Vertex};
use trunnion_geometry::{Vec3, deg};
use trunnion_machine::{AxisKind, Machine};

/// The first four bytes.
const MAGIC: &[u8; 4] = b"TRSC";
/// The version of the layout.
const VERSION: u32 = 1;

/// Vertices as little-endian arrays, tips relative to `origin` (mm). `level` says what was found on a line (from 1): 0 nothing, 1 info or
/// unknown, 2 warning, 3 error. Joints are in mm and deg, in chain order, none without a machine.
pub fn encode(vertices: &[Vertex], machine: Option<&Machine>, origin: &Vec3, level: impl Fn(u32) -> u8) -> Vec<u8> {
    let axes: Vec<(usize, bool)> = machine.map_or_else(Vec::new, |machine| {
        let axes = machine.own_axes();
        axes.map(|(index, axis)| (index, axis.kind == AxisKind::Rotary))
            .collect()
    });
    let count = vertices.len();
    let mut bytes = Vec::with_capacity(40 + count * (48 + 4 * axes.len()));
    bytes.extend_from_slice(MAGIC);
    for number in [VERSION, count as u32, axes.len() as u32] {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
    for value in origin.iter() {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    let mut floats = |values: &mut dyn Iterator<Item = f64>| {
        for value in values {
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
    };
    floats(&mut vertices.iter().flat_map(|vertex| <[f64; 3]>::from(vertex.tip - origin)));
    floats(&mut vertices.iter().flat_map(|vertex| <[f64; 3]>::from(vertex.axis)));
    floats(&mut vertices.iter().map(|vertex| vertex.time));
    floats(&mut vertices.iter().map(|vertex| vertex.deviation));
    floats(&mut vertices.iter().map(|vertex| vertex.feed_limit));
    floats(&mut vertices.iter().map(|vertex| vertex.feed));
    for vertex in vertices {
        bytes.extend_from_slice(&vertex.line.to_le_bytes());
    }
    for vertex in vertices {
        bytes.extend_from_slice(&flags(vertex, level(vertex.line)).to_le_bytes());
    }
    for vertex in vertices {
        for (index, rotary) in &axes {
            let value = vertex.joints[*index];
            let value = if *rotary { deg(value) } else { value };
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
    }
    bytes
}

fn flags(vertex: &Vertex, level: u8) -> u32 {
    let kind = match vertex.kind {
        Kind::Start => 0,
        Kind::Rapid => 1,
        Kind::Feed => 2,
    };
    let posture = match vertex.posture {
        None => 0,
        Some(0) => 1,
        Some(1..) => 2,
        Some(..0) => 3,
    };
    kind | u32::from(vertex.ends_block) << 2 | posture << 4 | u32::from(level.min(3)) << 8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_is_as_documented() {
        let vertex = Vertex {
            tip: Vec3::new(11.0, 20.5, 30.0),
            axis: Vec3::z(),
            time: 1.5,
            deviation: f64::NAN,
            feed_limit: 1571.0,
            feed: 2000.0,
            posture: Some(-1),
            line: 7,
            kind: Kind::Feed,
            ends_block: true,
            joints: [0.5; trunnion_machine::MAX_AXES],
        };
        let machine = trunnion_machine::builtin("mikron-ucp710").unwrap();
        let bytes = encode(&[vertex], Some(machine), &Vec3::new(10.0, 20.0, 30.0), |line| {
            u8::from(line == 7) * 3
        });
        assert_eq!(&bytes[..4], b"TRSC");
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let float = |at: usize| f32::from_bits(word(at));
        assert_eq!([word(4), word(8), word(12)], [1, 1, 5]);
        assert_eq!(f64::from_le_bytes(bytes[16..24].try_into().unwrap()), 10.0);
        assert_eq!([float(40), float(44), float(48)], [1.0, 0.5, 0.0]);
        assert_eq!([float(52), float(56), float(60)], [0.0, 0.0, 1.0]);
        assert_eq!([float(64), float(72), float(76)], [1.5, 1571.0, 2000.0]);
        assert!(float(68).is_nan());
        assert_eq!([word(80), word(84)], [7, 2 | 4 | 3 << 4 | 3 << 8]);
        // X Y Z in mm, A and C in deg
        let joints: Vec<f32> = (0..5).map(|i| float(88 + 4 * i)).collect();
        let turned = joints.iter().filter(|value| (**value - 28.647_89).abs() < 1e-4).count();
        assert_eq!((turned, joints.iter().filter(|value| **value == 0.5).count()), (2, 3));
        assert_eq!(bytes.len(), 88 + 20);
    }
}
