//! Choice of postures: rules of controls, ties, limits.
mod asked;

use super::*;
use crate::{builtin, load};
use proptest::prelude::*;
use trunnion_geometry::{deg, rad};

fn mikron() -> &'static Machine {
    builtin("mikron-ucp710").expect("built in")
}

/// Coming from known rotary values, rad.
fn from(machine: &Machine, q: [f64; 2]) -> Before {
    let s = crate::solution_s(machine, q[1]);
    let axis = crate::tool_axis_at(machine, q);
    Before {
        q,
        reference: Reference::Known,
        sign: if s > 1e-9 {
            1
        } else if s < -1e-9 {
            -1
        } else {
            0
        },
        pole_angle: crate::pole_angle(machine, &axis),
        continuous: false,
        wish: Posture::ByRule,
    }
}

/// Rotary values in degrees, workpiece side first, and what is open.
fn chosen(machine: &Machine, axis: Vec3, before: [f64; 2]) -> ([f64; 2], Option<Open>) {
    let before = from(machine, before.map(rad));
    let found = choose(machine, &axis.normalize(), &before).expect("reachable");
    (found.q.map(deg), found.open)
}

fn joints(axis: Vec3, before: [f64; 2]) -> [f64; 2] {
    chosen(mikron(), axis, before).0
}

fn assert_near(found: [f64; 2], wanted: [f64; 2]) {
    assert!(
        (found[0] - wanted[0]).abs() < 1e-4 && (found[1] - wanted[1]).abs() < 1e-4,
        "{found:?}, not {wanted:?}"
    );
}

#[test]
fn an_endless_axis_takes_the_nearest_winding() {
    // |u| sin 20 deg along (3, 4) / 5: C 143.1301 A 20, or C -36.8699 A -20
    let axis = Vec3::new(0.205_212_086, 0.273_616_115, 0.939_692_621);
    assert_near(joints(axis, [0.0, 20.0]), [-36.8699, -20.0]);
    assert_near(joints(axis, [1200.0, 20.0]), [143.1301 + 1080.0, 20.0]);
    assert_near(joints(axis, [-400.0, -20.0]), [-36.8699 - 360.0, -20.0]);
}

#[test]
fn a_limit_excludes_a_posture() {
    // A -60 is outside -30..120, so only the long way is left
    let axis = Vec3::new(0.0, 0.866_025, 0.5);
    assert_near(joints(axis, [0.0, 0.0]), [180.0, 60.0]);
    // pointing down at 150 deg: both postures leave the travel of A, +150 is the nearer
    let down = Vec3::new(0.0, -0.5, -0.866_025).normalize();
    let Err(NoStance::OutsideLimits { axis, value, limit }) = choose(mikron(), &down, &from(mikron(), [0.0; 2])) else {
        panic!("a posture outside the limits was chosen")
    };
    assert_eq!(axis, b'A');
    assert!((deg(value) - 150.0).abs() < 1e-3 && (deg(limit) - 120.0).abs() < 1e-9);
}

#[test]
fn ties_are_settled_the_same_way_everywhere() {
    // half a turn in either direction: the winding nearer zero
    let axis = Vec3::new(0.0, -0.5, 0.866_025);
    assert_near(joints(axis, [180.0, 30.0]), [0.0, 30.0]);
    assert_near(joints(axis, [-180.0, 30.0]), [0.0, 30.0]);
    assert_near(joints(axis, [540.0, 30.0]), [360.0, 30.0]);
}

#[test]
fn the_pole_keeps_the_first_axis() {
    assert_near(joints(Vec3::z(), [77.0, 3.0]), [77.0, 0.0]);
    assert_near(joints(Vec3::z(), [-1000.0, 3.0]), [-1000.0, 0.0]);
}

/// A first vector along the pole leaves the first axis unknown; Trunnion's own rule assumes zero.
#[test]
fn the_pole_keeps_an_axis_where_it_was_only_if_that_is_known() {
    for (control, is_open) in [
        ("family = \"sinumerik-840d\"", true),
        ("family = \"fanuc-30i\"", true),
        ("family = \"generic\"", false),
    ] {
        let machine = machine(C_TABLE, A_TABLE, control);
        let mut before = from(&machine, [0.0, 0.0]);
        assert_eq!(choose(&machine, &Vec3::z(), &before).expect("reachable").open, None);
        before.reference = Reference::Assumed;
        let open = choose(&machine, &Vec3::z(), &before).expect("reachable").open;
        assert_eq!(
            open.map(|open| open.cause),
            is_open.then_some(OpenCause::StartUnknown),
            "{control}"
        );
        if let Some(open) = open {
            assert_near(open.other.map(deg), [180.0, 0.0]);
        }
    }
}

#[test]
fn the_cheapest_move_of_a_posture_ignores_limits() {
    let axis = Vec3::new(0.0, 0.866_025, 0.5).normalize();
    let least = cheapest_in_posture(mikron(), &axis, 1, [0.0, rad(-10.0)]).expect("two postures");
    assert!((deg(least) - 50.0).abs() < 1e-3, "{}", deg(least));
    let least = cheapest_in_posture(mikron(), &axis, -1, [0.0, rad(10.0)]).expect("two postures");
    assert!((deg(least) - 230.0).abs() < 1e-3, "{}", deg(least));
}

/// Both postures of one tool axis: C 10 A 20 and C -170 A -20. Coming from A -15 a slow A takes the long move of C.
#[test]
fn the_slowest_axis_decides_not_the_longest_way() {
    let axis = trunnion_geometry::math::rotate(
        &Vec3::z(),
        rad(10.0),
        &trunnion_geometry::math::rotate(&Vec3::x(), rad(20.0), &Vec3::z()),
    );
    let mut machine = mikron().clone();
    let q = |machine: &Machine| chosen(machine, axis, [0.0, -15.0]).0;
    let [c, a] = [machine.joint(b'C').expect("C"), machine.joint(b'A').expect("A")];
    (machine.axes[c].max_speed, machine.axes[a].max_speed) = (Some(1.0), Some(1.0));
    assert_near(q(&machine), [10.0, 20.0]);
    (machine.axes[c].max_speed, machine.axes[a].max_speed) = (Some(100.0), Some(1.0));
    assert_near(q(&machine), [-170.0, -20.0]);
}

/// A machine of two rotary axes and X Y Z: `first` and `second` are the keys of the rotary axes, workpiece side first.
fn machine(first: &str, second: &str, control: &str) -> Machine {
    let linear = ["X", "Y", "Z"].iter().zip(["[1,0,0]", "[0,1,0]", "[0,0,1]"]);
    let linear: Vec<String> = linear
        .map(|(letter, dir)| {
            format!("{{letter=\"{letter}\",kind=\"linear\",side=\"head\",dir={dir},sign=1,limits=[-900,900]}}")
        })
        .collect();
    let head = first.contains("head");
    let (front, back) = if head {
        (linear.join(","), format!("{{{first}}},{{{second}}}"))
    } else if second.contains("head") {
        (format!("{{{first}}},{}", linear.join(",")), format!("{{{second}}}"))
    } else {
        (format!("{{{first}}},{{{second}}}"), linear.join(","))
    };
    let text = format!("schema = \"ncmachine/1\"\naxis = [{front},{back}]\n[control]\n{control}\n");
    load("test", &text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

const C_HEAD: &str = r#"letter="C",kind="rotary",side="head",dir=[0,0,1],sign=1,limits="unbounded""#;
const B_HEAD: &str = r#"letter="B",kind="rotary",side="head",dir=[0,1,0],sign=1,limits="unbounded""#;
const C_TABLE: &str = r#"letter="C",kind="rotary",side="table",dir=[0,0,1],sign=1,limits="unbounded""#;
const A_TABLE: &str = r#"letter="A",kind="rotary",side="table",dir=[1,0,0],sign=1,limits=[-120,120]"#;

/// The worked example of the Series 30i operator's manual, tool centre point control type 2.
#[test]
fn fanuc_takes_the_master_nearer_zero_where_both_ways_are_equal() {
    let fanuc = machine(C_HEAD, B_HEAD, "family = \"fanuc-30i\"");
    // C 90 B 180: both postures need 90 deg of C and 90 deg of B
    let (q, open) = chosen(&fanuc, Vec3::new(-1.0, 0.0, 0.0), [90.0, 180.0]);
    assert_near(q, [0.0, 270.0]);
    assert_eq!(open, None);
    // the slave at zero: the master stays
    assert_near(chosen(&fanuc, Vec3::z(), [90.0, 45.0]).0, [90.0, 0.0]);
}

#[test]
fn fanuc_looks_at_the_axis_that_carries_the_other_first() {
    let fanuc = machine(C_TABLE, A_TABLE, "family = \"fanuc-30i\"");
    // C 170 A 30 or C -10 A -30: from C 0 A 10 the master A moves 20 or 40, the slave C 170 or 10
    let axis = crate::tool_axis_at(&fanuc, [rad(170.0), rad(30.0)]);
    assert_near(chosen(&fanuc, axis, [0.0, 10.0]).0, [170.0, 30.0]);
    // on a head C carries B and goes first
    let head = machine(C_HEAD, B_HEAD, "family = \"fanuc-30i\"");
    let axis = crate::tool_axis_at(&head, [rad(170.0), rad(30.0)]);
    assert_near(chosen(&head, axis, [0.0, 10.0]).0, [-10.0, -30.0]);
    // a table goes before a head
    let mixed = machine(C_TABLE, B_HEAD, "family = \"fanuc-30i\"");
    assert_near(chosen(&mixed, axis, [0.0, 10.0]).0, [-10.0, -30.0]);
}

#[test]
fn fanuc_ranges_filter_and_undeclared_ones_leave_it_open() {
    let ranged = "family = \"fanuc-30i\"\nbranch = { range = { A = [-5, 100] } }";
    let tilt = r#"letter="A",kind="rotary",side="table",dir=[1,0,0],sign=1,limits=[-30,120]"#;
    let axis = |machine: &Machine| crate::tool_axis_at(machine, [rad(10.0), rad(-20.0)]);
    let declared = machine(C_TABLE, tilt, ranged);
    let (q, open) = chosen(&declared, axis(&declared), [0.0, -1.0]);
    assert_near(q, [-170.0, 20.0]);
    assert_eq!(open, None);
    // A -60 is beyond the travel; whether the control looks elsewhere depends on its parameters
    let undeclared = machine(C_TABLE, tilt, "family = \"fanuc-30i\"");
    let beyond = crate::tool_axis_at(&undeclared, [rad(10.0), rad(-60.0)]);
    let (q, open) = chosen(&undeclared, beyond, [0.0, -1.0]);
    assert_near(q, [-170.0, 60.0]);
    let open = open.expect("open");
    assert_eq!(open.cause, OpenCause::RangeNotDeclared);
    assert_near(open.other.map(deg), [10.0, -60.0]);
}

#[test]
fn mitsubishi_passes_the_pole_by_type() {
    let control = |passing: &str| format!("family = \"mitsubishi-m700\"\npole = {{ {passing} }}");
    let first = machine(C_TABLE, A_TABLE, &control("passing_type = 1"));
    let second = machine(C_TABLE, A_TABLE, &control("passing_type = 2"));
    let both = machine(C_TABLE, A_TABLE, "family = \"mitsubishi-m700\"");
    // from A 2 C 0 over the pole to A -2 C 0, which is A 2 C 180 too
    let axis = crate::tool_axis_at(&first, [0.0, rad(-2.0)]);
    assert_near(chosen(&first, axis, [0.0, 2.0]).0, [180.0, 2.0]);
    assert_near(chosen(&second, axis, [0.0, 2.0]).0, [0.0, -2.0]);
    let open = chosen(&both, axis, [0.0, 2.0]).1.expect("open");
    assert_eq!(open.cause, OpenCause::PassingTypeNotDeclared);
    // away from the pole both say the same
    let near = crate::tool_axis_at(&first, [rad(5.0), rad(40.0)]);
    let (q, open) = chosen(&both, near, [0.0, 38.0]);
    assert_near(q, [5.0, 40.0]);
    assert_eq!(open, None);
    // from the pole: the wider stroke, else minus
    assert_near(chosen(&first, near, [0.0, 0.0]).0, [-175.0, -40.0]);
    let wide = A_TABLE.replace("[-120,120]", "[-45,120]");
    let wide = machine(C_TABLE, &wide, &control("passing_type = 1"));
    assert_near(chosen(&wide, near, [0.0, 0.0]).0, [5.0, 40.0]);
    // a follower remembers the sign from before the stop at the pole: it is not the one to be kept
    for sign in [-1, 1] {
        let before = Before {
            sign,
            ..from(&first, [0.0, 0.0])
        };
        let found = choose(&first, &near.normalize(), &before).expect("reachable");
        assert_near(found.q.map(deg), [-175.0, -40.0]);
    }
}

/// A great circle past the pole from A 2 C 0 to where A 2 C 170 and A -2 C -10 point: nearer is the other posture, but on the great
/// circle C turns by 170 deg.
#[test]
fn where_a_rule_and_the_great_circle_want_different_postures_both_are_named() {
    for rule in ["fanuc", "mitsubishi"] {
        let control =
            format!("branch = {{ rule = \"{rule}\", range = {{ A = [-90, 90] }} }}\npole = {{ passing_type = 2 }}");
        let head = machine(C_HEAD, &A_TABLE.replace("table", "head"), &control);
        let axis = crate::tool_axis_at(&head, [rad(170.0), rad(2.0)]);
        let mut before = from(&head, [0.0, rad(2.0)]);
        let even = choose(&head, &axis, &before).expect("reachable");
        assert_near(even.q.map(deg), [-10.0, -2.0]);
        assert_eq!(even.open, None, "{rule}");
        before.continuous = true;
        let found = choose(&head, &axis, &before).expect("reachable");
        assert_near(found.q.map(deg), [-10.0, -2.0]);
        let open = found.open.expect("open");
        assert_eq!(open.cause, OpenCause::GreatCircle, "{rule}");
        assert_near(open.other.map(deg), [170.0, 2.0]);
        // far from the pole both agree
        let near = crate::tool_axis_at(&head, [rad(20.0), rad(5.0)]);
        assert_eq!(choose(&head, &near, &before).expect("reachable").open, None);
    }
}

#[test]
fn what_is_not_documented_is_open_with_both_postures() {
    let okuma = machine(C_TABLE, A_TABLE, "family = \"okuma-osp\"");
    let axis = crate::tool_axis_at(&okuma, [rad(10.0), rad(30.0)]);
    let (q, open) = chosen(&okuma, axis, [0.0, 20.0]);
    assert_near(q, [10.0, 30.0]);
    let open = open.expect("open");
    assert_eq!(open.cause, OpenCause::RuleNotDeclared);
    assert_near(open.other.map(deg), [-170.0, -30.0]);
    // on a great circle clear of the pole the posture cannot change
    let mut before = from(&okuma, [0.0, rad(20.0)]);
    before.continuous = true;
    let found = choose(&okuma, &axis, &before).expect("reachable");
    assert_near(found.q.map(deg), [10.0, 30.0]);
    assert_eq!(found.open, None);
    // a limit that leaves one posture leaves nothing open
    let narrow = A_TABLE.replace("[-120,120]", "[-20,120]");
    let narrow = machine(C_TABLE, &narrow, "family = \"okuma-osp\"");
    assert_eq!(chosen(&narrow, axis, [0.0, 20.0]).1, None);
}

#[test]
fn an_order_in_the_machine_file_goes_before_the_rule() {
    let by_value = "family = \"okuma-osp\"\nbranch = { rule = \"generic\", order = [\"abs1\", \"move2\"] }";
    let ordered = machine(C_TABLE, A_TABLE, by_value);
    let axis = crate::tool_axis_at(&ordered, [rad(170.0), rad(30.0)]);
    assert_near(chosen(&ordered, axis, [168.0, 28.0]).0, [-10.0, -30.0]);
    let moves = machine(C_TABLE, A_TABLE, "branch = { rule = \"shortest\" }");
    let (q, open) = chosen(&moves, axis, [168.0, 28.0]);
    assert_near(q, [170.0, 30.0]);
    assert_eq!(open, None);
    // A moves less in one direction, C in the other
    assert_eq!(
        chosen(&moves, axis, [100.0, -28.0]).1.map(|open| open.cause),
        Some(OpenCause::Tie)
    );
}

#[test]
fn half_a_turn_is_open_where_the_rule_is_a_controls() {
    let fanuc = machine(
        C_TABLE,
        A_TABLE,
        "family = \"fanuc-30i\"\nbranch = { range = { A = [0, 120] } }",
    );
    let axis = crate::tool_axis_at(&fanuc, [rad(180.0), rad(30.0)]);
    let (q, open) = chosen(&fanuc, axis, [0.0, 30.0]);
    assert!((q[0].abs() - 180.0).abs() < 1e-9, "{q:?}");
    let open = open.expect("open");
    assert_eq!(open.cause, OpenCause::HalfTurn);
    assert!((deg(open.other[0]) + q[0]).abs() < 1e-9 && (deg(open.other[1]) - 30.0).abs() < 1e-9);
}

#[test]
fn a_preferred_direction_takes_the_lower_or_higher_value_of_the_tilting_axis() {
    let swivel = machine(C_TABLE, A_TABLE, "family = \"sinumerik-840d\"");
    let axis = crate::tool_axis_at(&swivel, [rad(90.0), rad(-15.0)]);
    for (wish, q) in [(Posture::Lower, [90.0, -15.0]), (Posture::Higher, [-90.0, 15.0])] {
        let mut before = from(&swivel, [0.0, 0.0]);
        before.wish = wish;
        let found = choose(&swivel, &axis, &before).expect("reachable");
        assert_near(found.q.map(deg), q);
        assert_eq!(found.open, None);
    }
}

proptest! {
    /// Whatever the rule, the posture gives the vector, and asking again gives the same.
    #[test]
    fn the_chosen_posture_gives_the_vector(c in -180.0..180.0f64, a in -119.0..119.0f64, c0 in -400.0..400.0f64, a0 in -119.0..119.0f64,
        rule in 0..4usize) {
        let rule = PostureRule::NAMES[rule].0;
        let machine = machine(C_TABLE, A_TABLE, &format!("branch = {{ rule = \"{rule}\" }}"));
        let axis = crate::tool_axis_at(&machine, [rad(c), rad(a)]);
        let before = from(&machine, [rad(c0), rad(a0)]);
        let found = choose(&machine, &axis, &before).expect("reachable");
        prop_assert!((crate::tool_axis_at(&machine, found.q) - axis).norm() < 1e-9);
        prop_assert_eq!(choose(&machine, &axis, &before).expect("reachable").q, found.q);
        if let Some(open) = found.open {
            prop_assert!((crate::tool_axis_at(&machine, open.other) - axis).norm() < 1e-9);
            prop_assert_eq!(open.taken, found.q);
        }
    }
}
