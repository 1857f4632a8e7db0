//! An axis position that is shown as known is where the axis stands, in two properties over random programs on all dialects of controls:
//!
//! * An axis whose letter a block names has no known position after the block where the end of its motion is unknown.
//! * A program with values that nobody has set, and the same program with these values set: what the first knows is what the second finds.
//!
//! `TRUNNION_SILENCE_CASES` sets the number of programs.
mod found;
mod language;
use language::{LANGUAGES, Language, Line, body};
use proptest::prelude::*;
use trunnion_interp::{
    AXIS_LETTERS, Beside, Fault, FaultKind, ModalState, Motion, MotionKind, Setup, Sink, Tool, WorkOffset, run,
};
use trunnion_machine::{Follower, Machine, NoStance, builtin};
use trunnion_syntax::BlockId;

/// Values of the two variables of a program.
const VALUES: [[f64; 2]; 3] = [[0.0, 0.0], [7.5, -3.5], [-30.0, 90.0]];

/// What is known after a motion.
#[derive(Debug)]
struct After {
    motion: Motion,
    /// Why there is no stance.
    end: Result<(), NoStance>,
    /// Position of each joint, mm or rad, where it is known.
    joints: Vec<Option<f64>>,
    /// Axes whose coordinates in the plane the program knows, while the machine knows where it is.
    found: u16,
    /// The posture may be another one, or the path beside the contour is not computed: both are reported.
    open: bool,
}

/// Follows a program.
struct Followed<'m> {
    follower: Follower<'m>,
    after: Vec<After>,
    /// The first block that a control would refuse, or whose outcome is not decided.
    ends: Option<BlockId>,
}

impl Sink for Followed<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let (values, known) = leg.known_joints;
        let joints = self.follower.machine().axes.iter().enumerate();
        self.after.push(After {
            motion: *motion,
            end: leg.end.clone().map(drop),
            joints: joints
                .map(|(joint, _)| (known & 1 << joint != 0).then(|| values[joint]))
                .collect(),
            found: match &leg.end {
                Ok(_) if motion.tilt.free != 0 => !0,
                Ok(_) if !state.zero.is_lost() => state.position.known,
                _ => 0,
            },
            open: leg.open.is_some() || (state.compensation != 0 && state.beside != Beside::Computed),
        });
    }

    fn fault(&mut self, fault: Fault) {
        let goes_on = matches!(
            fault.kind,
            FaultKind::NotModelled { .. }
                | FaultKind::MissingFeed { .. }
                | FaultKind::WorkOffsetUnset { .. }
                | FaultKind::ToolLengthUnset { .. }
                | FaultKind::MissingProgramEnd
                | FaultKind::AmbiguousDecimal
                | FaultKind::CompensationLeft
        );
        if !goes_on {
            // a corner is refused in the block after it
            let block = BlockId(fault.block.0.saturating_sub(1));
            self.ends = Some(self.ends.map_or(block, |ends| ends.min(block)));
        }
    }
}

/// Runs a program with or without values of its variables.
fn follow<'m>(
    language: &Language,
    machine: &'m Machine,
    text: &str,
    offsets: bool,
    values: Option<[f64; 2]>,
) -> Followed<'m> {
    let dialect = trunnion_dialect::builtin(language.dialect).expect("built in");
    let mut setup = Setup::default();
    if offsets {
        let y = if language.machines.contains(&"lathe-2axis") {
            0.0
        } else {
            50.0
        };
        let values = [100.0, y, -200.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let named = |name: &str| WorkOffset {
            name: name.into(),
            values,
        };
        setup.work_offsets = ["G54", "G55", "G15 H1", "datum 1"].map(named).into();
        setup.tools = vec![Tool {
            number: 0,
            shape: None,
            diameter_mm: Some(8.0),
            length_mm: Some(70.0),
            holder_mm: None,
        }];
    }
    if let Some(values) = values {
        for (name, value) in language.variables.iter().zip(values) {
            match name.strip_prefix('#').and_then(|number| number.parse().ok()) {
                Some(number) => setup.variables.push((number, Some(value))),
                None => setup.named_variables.0.push(((*name).to_owned(), value)),
            }
        }
    }
    Machine::tell(Some(machine), &mut setup.control);
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let mut followed = Followed {
        follower: Follower::new(machine),
        after: Vec::new(),
        ends: None,
    };
    run(&program, dialect, &setup, &mut followed);
    followed
}

/// The first property.
fn named_axes(language: &Language, machine: &Machine, lines: &[Line], offsets: bool) -> Result<(), TestCaseError> {
    let text: String = lines.iter().map(|line| line.text.as_str()).collect();
    let dialect = trunnion_dialect::builtin(language.dialect).expect("built in");
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let mut start = 0;
    let mut named = Vec::new();
    for line in lines {
        named.push((start, line.axes));
        start += line.text.len();
    }
    let followed = follow(language, machine, &text, offsets, None);
    let moved: Vec<&After> = followed
        .after
        .iter()
        .filter(|after| !matches!(after.motion.kind, MotionKind::Dwell(_)))
        .collect();
    for (index, after) in moved.iter().enumerate() {
        let block = after.motion.block;
        if moved.get(index + 1).is_some_and(|next| next.motion.block == block) {
            continue;
        }
        let at = program.block(block).range().start as usize;
        let (_, axes) = named.iter().rfind(|(start, _)| *start <= at).expect("a line");
        for (joint, axis) in machine.axes.iter().enumerate() {
            let Some(letter) = AXIS_LETTERS.iter().position(|letter| *letter == axis.letter) else {
                continue;
            };
            let lost = !after.found & axes & 1 << letter != 0 && after.motion.end.get(letter).is_none();
            prop_assert!(
                !lost || after.joints[joint].is_none(),
                "{} on {}: {} is taken to be known\n{text}{after:#?}",
                language.dialect,
                machine.id,
                char::from(axis.letter)
            );
        }
    }
    Ok(())
}

/// The second property.
fn same_with_values(language: &Language, machine: &Machine, text: &str, offsets: bool) -> Result<(), TestCaseError> {
    let open = follow(language, machine, text, offsets, None);
    for values in VALUES {
        let set = follow(language, machine, text, offsets, Some(values));
        let last = open
            .after
            .iter()
            .chain(&set.after)
            .map(|after| after.motion.block)
            .max();
        let Some(last) = last else { continue };
        for block in 0..=last.0 {
            let ends = |ends: Option<BlockId>| ends.is_some_and(|ends| ends.0 <= block);
            if ends(set.ends) || ends(open.ends) {
                break;
            }
            let at = |of: &Followed<'_>| of.after.iter().rposition(|after| after.motion.block.0 <= block);
            let (Some(one), Some(other)) = (at(&open), at(&set)) else {
                continue;
            };
            if open.after[..=one]
                .iter()
                .chain(&set.after[..=other])
                .any(|after| after.open)
            {
                break;
            }
            let (one, other) = (&open.after[one], &set.after[other]);
            if one.motion.block.0 != block {
                // nothing is said about the axes before the next motion
                continue;
            }
            for (joint, axis) in machine.axes.iter().enumerate() {
                let (Some(a), Some(b)) = (one.joints[joint], other.joints[joint]) else {
                    continue;
                };
                prop_assert!(
                    (a - b).abs() < 1e-6,
                    "{} on {}: {} is taken to be at {a}, with {values:?} it is at {b} after block {block}\n{text}{one:#?}{other:#?}",
                    language.dialect,
                    machine.id,
                    char::from(axis.letter)
                );
            }
        }
    }
    Ok(())
}

fn cases() -> u32 {
    let asked = std::env::var("TRUNNION_SILENCE_CASES").ok();
    asked.and_then(|count| count.parse().ok()).unwrap_or(600)
}

/// A language, one of its machines, and lines.
fn programs() -> impl Strategy<Value = (&'static Language, &'static Machine, Vec<Line>)> {
    prop::sample::select(LANGUAGES.iter().collect::<Vec<_>>()).prop_flat_map(|language| {
        let machine = prop::sample::select(language.machines.to_vec());
        (
            Just(language),
            machine.prop_map(|name| builtin(name).expect("built in")),
            body(language),
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) })]

    #[test]
    fn an_axis_that_a_block_names_is_not_known_without_its_end((language, machine, lines) in programs(), offsets in any::<bool>()) {
        named_axes(language, machine, &lines, offsets)?;
    }

    #[test]
    fn what_is_known_without_a_value_is_so_with_it((language, machine, lines) in programs(), offsets in any::<bool>()) {
        let text: String = lines.iter().map(|line| line.text.as_str()).collect();
        same_with_values(language, machine, &text, offsets)?;
    }
}
