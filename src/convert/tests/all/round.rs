//! Random CL data on every built-in machine, to G-code and back: the same points within rounding.
use crate::support::{machine, to};
use proptest::prelude::*;
use trunnion_convert::{ClFeed, ClPoint, ClTool, Options, OrientationWords, cl_text};
use trunnion_geometry::{Vec3, rad};
use trunnion_machine::{BUILTIN_MACHINES, Limits, Machine, tool_axis_at};

const TOOL: ClTool = ClTool {
    number: 1,
    diameter_mm: 10.0,
    corner_radius_mm: 5.0,
    length_mm: Some(100.0),
    rpm: 12_000.0,
};

/// A walk of the rotary joints, in small steps inside the travels.
fn points(machine: &Machine, start: [f64; 2], steps: &[(f64, f64, [f64; 3])]) -> Vec<ClPoint> {
    let range = |index: usize| match machine.rotary.get(index).map(|&joint| machine.axes[joint].limits) {
        Some(Limits::Range(low, high)) => (low, high),
        Some(Limits::Unbounded) => (-100.0, 100.0),
        None => (0.0, 0.0),
    };
    let mut q = [0, 1].map(|index| {
        let (low, high) = range(index);
        low + (high - low) * start[index]
    });
    let mut tip = Vec3::zeros();
    let mut all = Vec::new();
    for (index, (first, second, way)) in steps.iter().enumerate() {
        for (slot, step) in [first, second].into_iter().enumerate() {
            let (low, high) = range(slot);
            let joint = machine.rotary.get(slot);
            if index > 0 && joint.is_some_and(|&joint| machine.axes[joint].extra.clamp) {
                // it must stand still while cutting
                continue;
            }
            q[slot] = (q[slot] + rad(*step)).clamp(low, high);
        }
        tip += Vec3::from(*way);
        all.push(ClPoint {
            tip,
            axis: tool_axis_at(machine, q),
            feed: if index == 0 {
                ClFeed::Rapid
            } else {
                ClFeed::PerMinute(800.0)
            },
        });
    }
    all
}

/// Points of CL text.
fn read(text: &str) -> Vec<(Vec3, Vec3)> {
    let joined = text.replace("$\n", "");
    let records = joined.lines().filter_map(|line| line.strip_prefix("GOTO/"));
    let numbers =
        |record: &str| -> Vec<f64> { record.split(',').map(|n| n.trim().parse().expect("a number")).collect() };
    records
        .map(numbers)
        .map(|n| {
            let axis = if n.len() > 3 {
                Vec3::new(n[3], n[4], n[5])
            } else {
                Vec3::z()
            };
            (Vec3::new(n[0], n[1], n[2]), axis)
        })
        .collect()
}

/// All built-in machines with two rotary axes. Diameters are no lengths of a mill.
fn five_axes() -> Vec<&'static str> {
    let five = |name: &&str| {
        let on = machine(name).expect("built in");
        on.rotary.len() == 2 && !on.axes.iter().any(|axis| axis.extra.diameter)
    };
    let names: Vec<&str> = BUILTIN_MACHINES.iter().copied().filter(five).collect();
    assert!(names.len() >= 18, "{names:?}");
    names
}

fn cases() -> u32 {
    std::env::var("TRUNNION_CONVERT_CASES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(60)
}

fn steps() -> impl Strategy<Value = Vec<(f64, f64, [f64; 3])>> {
    let way = prop::array::uniform3(-4.0..4.0f64);
    prop::collection::vec((-4.0..4.0f64, -2.0..2.0f64, way), 2..12)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) })]

    #[test]
    fn to_the_machine_and_back(
        name in prop::sample::select(five_axes()),
        start in prop::array::uniform2(0.2..0.8f64),
        steps in steps(),
        kind in 0..3u8,
    ) {
        let on = machine(name).expect("built in");
        // a LinuxCNC has no tool vectors; codes of its own switch its kinematics, or nothing does
        let family = on.control.family == "linuxcnc";
        let always = on.control.tcp_codes.as_ref().is_some_and(|codes| codes.at_start && codes.off.is_empty());
        let never = family && on.control.tcp_codes.is_none();
        let kind = if never { 1 } else if (family && kind == 2) || (always && kind == 1) { 0 } else { kind };
        // vectors leave out the words of further axes, so that it is unknown where those stand
        let more = on.axes.len() > 5;
        let kind = if more && kind == 2 { 0 } else { kind };
        let dialect = if family { "linuxcnc" } else { "sinumerik-840d" };
        let points = points(on, start, &steps);
        let text = cl_text("RANDOM", &TOOL, &points);
        let options = Options {
            tcp: kind != 1,
            orientation: if kind == 2 { OrientationWords::Vectors } else { OrientationWords::Rotary },
            allow_swap: true,
            tolerance_mm: Some(0.05),
            ..Options::default()
        };
        let made = match to((&text, "apt", ""), dialect, name, &options) {
            Ok(made) => made,
            // a walk over the pole cannot always be linearised
            Err(refused) => {
                prop_assert!(kind == 1 && refused.message.contains("blocks to keep the tolerance"), "{name}: {refused}\n{text}");
                return Ok(());
            }
        };
        let back = to((&made.text, dialect, name), "apt", "", &Options::default());
        let back = match back {
            Ok(back) => back,
            Err(refused) => return Err(TestCaseError::fail(format!("{name}: {refused}\n{}", made.text))),
        };
        let (wanted, found) = (read(&text), read(&back.text));
        // each point is found again, in order; linearised cuts have more
        let mut rest = found.iter();
        for (tip, axis) in &wanted {
            let limit = if kind == 1 { 0.05 } else { 2e-4 };
            let hit = rest.any(|(at, along)| (at - tip).norm() < limit && (along - axis).norm() < 5e-6);
            prop_assert!(hit, "{name}: {tip:?} {axis:?} is lost\n{}\n{}", made.text, back.text);
        }
        prop_assert!(kind == 1 || wanted.len() == found.len());
    }
}
