//! What settings and machine files declare of lathes, spindles, chamfers and holes counts.
use crate::digest::{machine_digest, setup_digest};
use std::collections::BTreeSet;
use trunnion_interp::{ChamferLength, DrillingAxis, HolePlaces, Setup, ToolOffsets};

#[test]
fn what_settings_declare_counts() {
    let offsets = |number: u32, value: f64| Setup {
        tool_offsets: ToolOffsets(vec![(number, [value; 9])]),
        ..Setup::default()
    };
    let drills = |axis| {
        let mut setup = Setup::default();
        setup.control.drilling_axis = Some(axis);
        setup
    };
    let turns = |number| {
        let mut setup = Setup::default();
        setup.control.main_spindle = Some(number);
        setup
    };
    let chamfer = |length| {
        let mut setup = Setup::default();
        setup.control.chamfer_length = Some(length);
        setup
    };
    let angles = |positive| {
        let mut setup = Setup::default();
        setup.control.positive_angles = Some(positive);
        setup
    };
    let mut places = Setup::default();
    places.control.hole_places = Some(HolePlaces::Pairs);
    let setups = [
        Setup::default(),
        offsets(2, 0.0),
        offsets(2, 1.0),
        offsets(3, 1.0),
        turns(1),
        turns(2),
        drills(DrillingAxis::Z),
        drills(DrillingAxis::AcrossPlane),
        chamfer(ChamferLength::Side),
        chamfer(ChamferLength::Face),
        places,
        angles(false),
        angles(true),
    ];
    let digests: BTreeSet<_> = setups.iter().map(setup_digest).collect();
    assert_eq!(digests.len(), setups.len());
    let mut machine = trunnion_machine::builtin("mill-3axis").expect("built in").clone();
    let plain = machine_digest(&machine);
    machine.control.drilling_axis = Some(DrillingAxis::Z);
    let drills = machine_digest(&machine);
    assert_ne!(drills, plain);
    machine.control.main_spindle = Some(1);
    assert_ne!(machine_digest(&machine), drills);
}
