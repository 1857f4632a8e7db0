//! Obstacles that are far, and obstacles that are many: what is not measured.
use crate::obstacles::{body, leg, prism, with};
use trunnion_interp::MotionKind;
use trunnion_machine::{Leg, Machine, Nearness, Obstacles, RapidPath, ToolBody, builtin, nearness, nearness_with_part};

/// The bounding box is enough for a far obstacle: the distance of the boxes is given, not the exact one.
#[test]
fn a_far_obstacle_is_not_measured() {
    let machine = with(
        "mill-3axis",
        prism(&[[900.0, 900.0], [910.0, 900.0], [900.0, 910.0]], 0.0, 30.0),
    );
    let (from, to) = (
        [(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)],
        [(b'X', 50.0), (b'Y', 30.0), (b'Z', 0.0)],
    );
    let leg = leg(&machine, MotionKind::Linear, false, [&from, &to]);
    let found = |of: fn(&Machine, &Leg, &ToolBody, f64) -> Vec<trunnion_machine::Near>| {
        of(&machine, &leg, &body(4.0, None), 1.0)[0].nearness
    };
    assert_eq!(found(nearness), Nearness::Clear(866.0));
    assert!(matches!(found(nearness_with_part), Nearness::Clear(mm) if mm > 1200.0));
}

/// The pieces of one block are looked at for all obstacles together: the effort does not grow with their number.
#[test]
fn too_many_obstacles_near_to_a_turning_tool_are_unknown() {
    let Some(base) = builtin("mikron-ucp710") else { return };
    let mut machine = base.clone();
    machine.control.rapid = RapidPath::Synchronous;
    // nearer than what a piece of the block is bounded by
    let near = prism(
        &[[14.000_000_1, -40.0], [30.0, -40.0], [30.0, 40.0], [14.000_000_1, 40.0]],
        -50.0,
        90.0,
    );
    machine.obstacles = Obstacles(vec![near; 400]);
    let letters: Vec<u8> = base.rotary.iter().map(|&joint| base.axes[joint].letter).collect();
    let words = |turn: f64| {
        vec![
            (b'X', 10.0),
            (b'Y', 0.0),
            (b'Z', 0.0),
            (letters[0], turn),
            (letters[1], 0.0),
        ]
    };
    let leg = leg(&machine, MotionKind::Linear, true, [&words(0.0), &words(359.0)]);
    let found = nearness(&machine, &leg, &body(4.0, Some(60.0)), 0.0);
    let first = |near: &&trunnion_machine::Near| near.nearness == found[0].nearness;
    let same = found.iter().take_while(first).count();
    assert!(matches!(found[0].nearness, Nearness::Unknown(_)), "{:?}", found[0]);
    assert!((1..20).contains(&same), "{same}: {:?}", found[0]);
    let rest = Nearness::Unknown("too many obstacles are near to the tool in this block for all to be looked at");
    assert!(
        found[same..].iter().all(|near| near.nearness == rest),
        "{:?}",
        found[same]
    );
}
