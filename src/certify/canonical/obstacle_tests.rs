//! Each fact about an obstacle changes the digest of its machine.
use crate::digest::{machine_digest, setup_digest};
use std::collections::BTreeSet;

fn obstacle(axis: Option<u8>, bottom: f64) -> trunnion_machine::Obstacle {
    let centre = trunnion_geometry::plane::Point::new(1.0, 2.0);
    trunnion_machine::Obstacle {
        name: "clamp".into(),
        axis,
        footprint: trunnion_machine::Footprint::Circle { centre, radius: 3.0 },
        bottom,
        top: 5.0,
        kind: trunnion_machine::ObstacleKind::Body,
    }
}

fn square() -> trunnion_machine::Obstacle {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(trunnion_geometry::plane::Point::from);
    let polygon = trunnion_geometry::plane::Polygon::new(&corners).expect("a square");
    trunnion_machine::Obstacle {
        footprint: trunnion_machine::Footprint::Polygon(polygon),
        ..obstacle(None, 0.0)
    }
}

#[test]
fn obstacles_are_part_of_a_machine() {
    let plain = trunnion_machine::builtin("mill-3axis").expect("built in").clone();
    let with = |obstacles: &[trunnion_machine::Obstacle]| {
        let mut machine = plain.clone();
        machine.obstacles.0.extend(obstacles.iter().cloned());
        machine_digest(&machine)
    };
    let kinds = [
        obstacle(None, 0.0),
        obstacle(Some(b'X'), 0.0),
        obstacle(None, 1.0),
        square(),
        trunnion_machine::Obstacle {
            kind: trunnion_machine::ObstacleKind::Part,
            ..square()
        },
    ];
    let mut digests: BTreeSet<String> = kinds.iter().map(|kind| with(core::slice::from_ref(kind))).collect();
    digests.insert(with(&[]));
    digests.insert(with(&kinds));
    assert_eq!(digests.len(), 7);
    // a name is for people
    let mut named = obstacle(None, 0.0);
    named.name = "vice".into();
    assert_eq!(with(&[named]), with(&[obstacle(None, 0.0)]));
}

#[test]
fn clearance_and_holder_count_where_they_are_declared() {
    let mut machine = trunnion_machine::builtin("mill-3axis").expect("built in").clone();
    let plain = machine_digest(&machine);
    machine.tolerances.clearance_mm = Some(1.0);
    assert_ne!(machine_digest(&machine), plain);
    let setup = |holder_mm: Option<f64>| trunnion_interp::Setup {
        tools: vec![trunnion_interp::Tool {
            number: 1,
            shape: None,
            diameter_mm: Some(8.0),
            length_mm: None,
            holder_mm,
        }],
        ..Default::default()
    };
    let digests = [None, Some(40.0), Some(50.0)].map(|holder| setup_digest(&setup(holder)));
    assert!(digests[0] != digests[1] && digests[1] != digests[2]);
}
