//! The encoding is well formed, says what it says in one way only, and every fact that counts reaches the digest.
use super::{CanonicalV1, Encode, Fields};
use crate::digest::{dialect_digest, machine_digest, setup_digest};
use std::collections::BTreeSet;
use trunnion_dialect::{Action, Dialect};
use trunnion_interp::{
    ClampCodes, FrameAngles, ImplicitDecimals, LengthUnit, OuterCorner, Position, RollPitchYaw, RoughingEscape,
    ScaledAxes, Setup, SplineReading, TcpCodes, Tool, ToolShape, WorkOffset,
};
use trunnion_machine::{Criterion, Gantry, Limits, Machine, PoleAction, PostureRule, RapidPath, Wrap};

/// Reads fields to the end of a record.
fn fields(mut content: &[u8]) -> Result<&[u8], String> {
    let mut last = 0;
    while let Some((tag, after)) = content.split_first_chunk::<2>() {
        let tag = u16::from_be_bytes(*tag);
        if tag <= last {
            return Err(format!("tag {tag} after {last}"));
        }
        (last, content) = (tag, read(after)?);
    }
    Ok(content)
}

/// Reads one value as the module's page describes it; the rest of the bytes, or what is wrong.
fn read(bytes: &[u8]) -> Result<&[u8], String> {
    let (marker, rest) = bytes.split_first().ok_or("no marker")?;
    let (length, rest) = rest.split_first_chunk::<8>().ok_or("no length")?;
    let length = usize::try_from(u64::from_be_bytes(*length)).map_err(|e| e.to_string())?;
    let (content, rest) = rest.split_at_checked(length).ok_or("too short")?;
    let left = match marker {
        0 if length == 0 => &[],
        1 if matches!(content, [0 | 1]) => &[],
        2 | 3 if length == 8 => &[],
        4 => core::str::from_utf8(content)
            .map(|_| &[][..])
            .map_err(|e| e.to_string())?,
        5 => {
            let (count, mut items) = content.split_first_chunk::<8>().ok_or("no count")?;
            for _ in 0..u64::from_be_bytes(*count) {
                items = read(items)?;
            }
            items
        }
        6 => fields(content)?,
        7 => {
            let (tag, content) = content.split_first_chunk::<2>().ok_or("no variant")?;
            if *tag == [0, 0] {
                return Err("variant 0".into());
            }
            fields(content)?
        }
        _ => return Err(format!("marker {marker} with {length} bytes")),
    };
    let all = left.is_empty().then_some(rest);
    all.ok_or_else(|| format!("{} bytes left in a value of marker {marker}", left.len()))
}

fn well_formed(value: &impl Encode) {
    assert_eq!(read(&CanonicalV1::bytes_of(value)), Ok(&[][..]));
}

fn mikron() -> Machine {
    trunnion_machine::builtin("mikron-ucp710").expect("built in").clone()
}

#[test]
fn all_that_is_built_in_is_well_formed() {
    for name in trunnion_dialect::BUILTIN_NAMES {
        well_formed(trunnion_dialect::builtin(name).expect("built in"));
    }
    for name in trunnion_machine::BUILTIN_MACHINES {
        well_formed(trunnion_machine::builtin(name).expect("built in"));
    }
    well_formed(&Setup::default());
}

#[test]
fn what_is_built_in_has_digests_of_its_own() {
    let dialects = trunnion_dialect::BUILTIN_NAMES
        .iter()
        .map(|name| dialect_digest(trunnion_dialect::builtin(name).expect("built in")));
    assert_eq!(
        dialects.collect::<BTreeSet<_>>().len(),
        trunnion_dialect::BUILTIN_NAMES.len()
    );
    let machines = trunnion_machine::BUILTIN_MACHINES
        .iter()
        .map(|name| machine_digest(trunnion_machine::builtin(name).expect("built in")));
    assert_eq!(
        machines.collect::<BTreeSet<_>>().len(),
        trunnion_machine::BUILTIN_MACHINES.len()
    );
}

#[test]
fn one_number_has_one_encoding_and_another_number_another() {
    let bytes = |value: f64| CanonicalV1::bytes_of(&value);
    assert_eq!(bytes(0.0), bytes(-0.0));
    assert_eq!(bytes(f64::NAN), bytes(-f64::NAN));
    assert_eq!(bytes(f64::NAN), bytes(f64::from_bits(0x7ff0_0000_0000_0001)));
    assert_ne!(bytes(1.0), bytes(1.0 + f64::EPSILON));
    assert_ne!(bytes(1.0), bytes(-1.0));
    assert_ne!(bytes(f64::NAN), bytes(f64::INFINITY));
}

#[test]
fn parts_do_not_run_into_each_other() {
    let bytes = |parts: &[&str]| CanonicalV1::bytes_of(parts);
    assert_ne!(bytes(&["ab", "c"]), bytes(&["a", "bc"]));
    assert_ne!(bytes(&["", "a"]), bytes(&["a", ""]));
    assert_ne!(bytes(&[]), bytes(&[""]));
    assert_ne!(bytes(&["a", "b"]), bytes(&["b", "a"]));
}

/// A record whose tags are given.
struct Tagged(&'static [u16]);

impl Encode for Tagged {
    fn encode(&self, out: &mut CanonicalV1) {
        out.record(|fields: &mut Fields<'_>| {
            for tag in self.0 {
                fields.field(*tag, &true);
            }
        });
    }
}

#[test]
fn a_tag_names_its_field_not_its_place() {
    assert_ne!(
        CanonicalV1::bytes_of(&Tagged(&[1, 2])),
        CanonicalV1::bytes_of(&Tagged(&[1, 3]))
    );
}

#[test]
#[should_panic(expected = "tag 2 after 2")]
fn a_tag_cannot_be_used_twice() {
    CanonicalV1::bytes_of(&Tagged(&[2, 2]));
}

/// Applies each change alone; all digests, and that of the value as it was, must differ.
fn all_count<T: Clone + Encode>(original: &T, digest: impl Fn(&T) -> String, changes: &[fn(&mut T)]) {
    let mut seen = BTreeSet::from([digest(original)]);
    for (index, change) in changes.iter().enumerate() {
        let mut changed = original.clone();
        change(&mut changed);
        well_formed(&changed);
        assert!(seen.insert(digest(&changed)), "change {index} does not count");
    }
}

#[test]
fn the_bounds_of_a_run_do_not_count() {
    let digest = setup_digest(&Setup::default());
    let changes: [fn(&mut Setup); 3] = [
        |s| s.limits.blocks += 1,
        |s| s.limits.steps += 1,
        |s| s.limits.held += 1,
    ];
    for change in changes {
        let mut setup = Setup::default();
        change(&mut setup);
        assert_eq!(setup_digest(&setup), digest);
    }
}

#[test]
fn every_fact_of_a_setup_counts() {
    all_count(
        &Setup::default(),
        setup_digest,
        &[
            |s| s.tools.push(tool(None)),
            |s| s.tools.push(tool(Some(ToolShape::Ball))),
            |s| s.tools.push(tool(Some(ToolShape::Flat))),
            |s| s.tools.push(tool(Some(ToolShape::Bull(1.0)))),
            |s| s.tools.extend([tool(None), tool(None)]),
            |s| {
                s.tools.push(Tool {
                    length_mm: Some(10.0),
                    ..tool(None)
                });
            },
            |s| {
                s.tools.push(Tool {
                    diameter_mm: Some(10.0),
                    ..tool(None)
                });
            },
            |s| s.work_offsets.push(offset("G54", 0.0)),
            |s| s.work_offsets.push(offset("G55", 0.0)),
            |s| s.work_offsets.push(offset("G54", 1.0)),
            |s| s.limits.depth += 1,
            |s| s.variables.push((500, None)),
            |s| s.variables.push((500, Some(0.0))),
            |s| s.variables.push((501, Some(0.0))),
            |s| s.control.units = Some(LengthUnit::Millimetre),
            |s| s.control.units = Some(LengthUnit::Inch),
            |s| s.control.implicit_decimals = Some(ImplicitDecimals::LeastIncrement),
            |s| s.control.implicit_decimals = Some(ImplicitDecimals::Calculator),
            |s| s.control.chip_break_retract_mm = Some(1.0),
            |s| s.control.peck_clearance_mm = Some(1.0),
            |s| s.control.bore_shift = Some((0, 1.0)),
            |s| s.control.bore_shift = Some((1, 1.0)),
            |s| s.control.roughing_escape = Some(RoughingEscape::Feed),
            |s| s.control.roughing_escape = Some(RoughingEscape::Rapid),
            |s| s.control.thread_pull_out = Some(1.0),
            |s| s.control.outer_corner = OuterCorner::Arc,
            |s| s.control.block_delete = Some(false),
            |s| s.control.block_delete = Some(true),
            |s| s.control.roll_pitch_yaw = Some(RollPitchYaw::Fixed),
            |s| s.control.roll_pitch_yaw = Some(RollPitchYaw::Turned),
            |s| s.control.frame_angles = Some(FrameAngles::RollPitchYaw),
            |s| s.control.frame_angles = Some(FrameAngles::Euler),
            |s| s.control.splines = Some(SplineReading::ChordLength),
            |s| s.control.scaled_axes = Some(ScaledAxes::Plane),
            |s| s.control.scaled_axes = Some(ScaledAxes::All),
            |s| s.control.increment_adds_frame = Some(true),
            |s| s.control.increment_adds_frame = Some(false),
            |s| s.control.increment_adds_length = Some(true),
            |s| s.control.increment_adds_length = Some(false),
            |s| s.control.tcp_codes = Some(TcpCodes::default()),
            |s| s.control.tcp_codes = Some(codes(true, false)),
            |s| s.control.tcp_codes = Some(codes(false, false)),
            |s| s.control.tcp_codes = Some(codes(true, true)),
            |s| s.control.clamp_codes[4] = Some(ClampCodes { on: 10, off: 11 }),
            |s| s.control.clamp_codes[5] = Some(ClampCodes { on: 10, off: 11 }),
            |s| s.control.further_axes = b"UV".to_vec(),
            |s| s.control.length_along = Some([0.0, 0.0, 1.0]),
            |s| s.named_variables.0.push(("R1".to_owned(), 1.0)),
            |s| s.named_variables.0.push(("R1".to_owned(), 2.0)),
            |s| s.named_variables.0.push(("R2".to_owned(), 1.0)),
            |s| s.control.reference_points.push(Position::default()),
            |s| {
                let mut point = Position::default();
                point.set(2, 0.0);
                s.control.reference_points.push(point);
            },
            |s| s.control.fixed_points = Some(vec![Position::default()]),
        ],
    );
}

fn tool(shape: Option<ToolShape>) -> Tool {
    Tool {
        number: 1,
        shape,
        diameter_mm: None,
        length_mm: None,
        holder_mm: None,
    }
}

fn offset(name: &str, x: f64) -> WorkOffset {
    let values = core::array::from_fn(|axis| if axis == 0 { x } else { 0.0 });
    WorkOffset {
        name: name.into(),
        values,
    }
}

fn codes(on: bool, at_start: bool) -> TcpCodes {
    let code = vec!["M428".to_owned()];
    let (on, off) = if on { (code, Vec::new()) } else { (Vec::new(), code) };
    TcpCodes { on, off, at_start }
}

#[test]
fn an_unknown_coordinate_has_no_value() {
    let mut point = Position::default();
    let unknown = CanonicalV1::bytes_of(&point);
    point.values[3] = 7.0;
    assert_eq!(CanonicalV1::bytes_of(&point), unknown);
    point.set(3, 7.0);
    assert_ne!(CanonicalV1::bytes_of(&point), unknown);
}

#[test]
fn every_fact_of_a_machine_counts() {
    all_count(
        &mikron(),
        machine_digest,
        &[
            |m| m.id.push('x'),
            |m| m.axes.swap(2, 3),
            |m| m.tool_axis.x += 1.0,
            |m| m.gauge_point.y += 1.0,
            |m| m.home.tool_axis.x += 1.0,
            |m| m.home.gauge_point.y += 1.0,
            |m| m.gantries.push(gantry([b'U', b'X'])),
            |m| m.axes[0].letter = b'B',
            |m| m.axes[0].kind = trunnion_machine::AxisKind::Linear,
            |m| m.axes[0].side = trunnion_machine::Side::Head,
            |m| m.axes[0].direction.x = 1e-12,
            |m| m.axes[0].point.z = 1e-12,
            |m| m.axes[0].sign = -1.0,
            |m| m.axes[0].limits = Limits::Range(0.0, 1.0),
            |m| m.axes[0].limits = Limits::Range(1.0, 0.0),
            |m| m.axes[0].max_speed = None,
            |m| m.axes[0].max_acceleration = Some(2.0),
            |m| m.axes[0].extra.wrap = Wrap::Shortest,
            |m| m.axes[0].extra.wrap = Wrap::ModuloSign,
            |m| m.axes[0].extra.clamp = true,
            |m| m.axes[0].extra.clamp_codes = Some(ClampCodes { on: 1, off: 2 }),
            |m| m.axes[0].extra.clamp_codes = Some(ClampCodes { on: 2, off: 1 }),
            |m| m.axes[0].extra.cable = true,
            |m| m.axes[0].extra.spindle = true,
            |m| m.axes[0].extra.diameter = true,
            |m| m.axes[0].extra.limits_declared = false,
            |m| m.axes[0].extra.limit_margin = Some(1.0),
            |m| m.axes[0].extra.resolution = Some(1.0),
            |m| m.axes[0].extra.max_jerk = Some(1.0),
            |m| m.axes[0].extra.position_gain = Some(1.0),
            |m| m.axes[0].extra.feed_forward = Some(1.0),
            |m| m.axes[0].extra.point_uncertainty = Some(1.0),
            |m| m.axes[0].extra.direction_uncertainty = Some(1.0),
            |m| m.axes[0].extra.hold = Some(1.0),
            |m| m.control.family.push('x'),
            |m| m.control.tcp_great_circle = true,
            |m| m.control.tcp_declared = false,
            |m| m.control.rapid = RapidPath::Synchronous,
            |m| m.control.rapid = RapidPath::Dogleg,
            |m| m.control.branch.rule = None,
            |m| m.control.branch.rule = Some(PostureRule::Fanuc),
            |m| m.control.branch.declared = false,
            |m| m.control.branch.order = vec![Criterion::Time],
            |m| m.control.branch.order = vec![Criterion::Move(0)],
            |m| m.control.branch.order = vec![Criterion::Value(0)],
            |m| m.control.branch.range.push((b'A', 0.0, 1.0)),
            |m| m.control.branch.passing_type = Some(1),
            |m| m.control.branch.solution_negative = Some(false),
            |m| m.control.pole_cone = Some(1.0),
            |m| m.control.pole_action = PoleAction::Hold,
            |m| m.control.feed = Some(trunnion_machine::FeedMeaning::Xyz),
            |m| m.control.corner_model = Some("grbl".into()),
            |m| m.control.block_time = Some(1.0),
            |m| m.control.tcp_codes = Some(codes(true, false)),
            |m| m.control.posture_words.turn.push((b'A', 1)),
            |m| m.control.posture_words.status = Some((1, sign())),
            |m| m.control.posture_words.solutions.push((1, sign())),
            |m| m.control.units = None,
            |m| m.control.reference_points = Some(vec![]),
            |m| m.control.fixed_points = Some(vec![]),
            |m| m.control.peck_clearance_mm = Some(1.0),
            |m| m.control.chip_break_retract_mm = Some(1.0),
            |m| m.tolerances.tip_mm += 1.0,
            |m| m.tolerances.near_mm += 1.0,
        ],
    );
}

fn sign() -> trunnion_machine::AxisSign {
    let (letter, negative) = (b'A', true);
    trunnion_machine::AxisSign { letter, negative }
}

#[test]
fn every_fact_of_a_dialect_counts() {
    let sinumerik = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
    all_count(
        sinumerik,
        dialect_digest,
        &[
            |d: &mut Dialect| d.name.push('x'),
            |d| d.lex.blanks_in_numbers ^= true,
            |d| d.lex.paren_comment ^= true,
            |d| d.arc.mm += 1.0,
            |d| d.arc.relative_up_to = 7.0,
            |d| d.quirks.motion_at_start = None,
            |d| d.quirks.motion_at_start = Some(Action::Rapid),
            |d| d.quirks.diameter ^= true,
            |d| d.quirks.own_parameters_to += 1,
            |d| d.quirks.machine_data_suppress_length ^= true,
        ],
    );
}

#[test]
fn prose_does_not_count() {
    let mut machine = mikron();
    machine.name.push('x');
    machine.sources.push("elsewhere".into());
    machine.warnings.push("odd".into());
    machine.axes[0].note = Some("assumed".into());
    machine.axes[0].source = Some("elsewhere".into());
    assert_eq!(machine_digest(&machine), machine_digest(&mikron()));
    let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
    let mut told = dialect.clone();
    told.title.push('x');
    told.arc.source.push('x');
    told.groups.clear();
    told.extensions.clear();
    assert_eq!(dialect_digest(&told), dialect_digest(dialect));
}

fn gantry([letter, leader]: [u8; 2]) -> Gantry {
    Gantry { letter, leader }
}
