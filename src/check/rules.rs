//! The list of rules, alphabetical. A rule is one file in `rules/`; its name appears in two lists here.
mod ambiguous_implicit_decimal;
mod ambiguous_posture;
mod angle_wrap;
mod apt_unknown_record;
mod apt_vector_missing;
mod arc_centre_missing;
mod arc_radius_mismatch;
mod axis_acceleration;
mod axis_limit;
mod axis_overspeed;
mod bad_expression;
mod bad_number;
mod bare_carriage_return;
mod block_delete_unset;
mod block_number_order;
mod branch_swap;
mod broken_directive;
mod broken_structure;
mod canned_cycle;
mod clamped_axis_moves;
mod corner_error;
mod cutter_compensation;
mod decimal_comma;
mod dwell_mark;
mod empty_program;
mod endless_loop;
mod excess_linear_travel;
mod excess_rapid_travel;
mod excess_rotary_travel;
mod fast_pole;
mod feed_drop;
mod feed_mode;
mod feed_oscillation;
mod ignored_record;
mod machine_not_used;
mod machine_unset;
mod missing_axis;
mod missing_feed;
mod missing_label;
mod missing_program_end;
mod missing_subprogram;
mod missing_tool_length;
mod missing_word;
mod modal_group_conflict;
mod not_a_program;
mod not_decided;
mod not_modelled;
mod not_run;
mod only_one_posture;
mod orientation_deviation;
mod other_tool_length;
mod path_deviation;
mod pivot_uncertainty;
mod pole_crossing;
mod pole_flip;
mod porting;
mod position_unknown;
mod program_alarm;
mod program_name_mismatch;
mod rapid_through_obstacle;
mod rejected_block;
mod repeated_word;
mod short_block_time;
mod spindle_off_cut;
mod spindle_unset;
mod swept_deviation;
mod syntax_error;
mod tcp_state;
mod tilted_plane_misaligned;
mod tool_defined_twice;
mod tool_length_unset;
mod tool_vector_not_unit;
mod unbracketed_comparison;
mod unclosed_comment;
mod undefined_variable;
mod units_unset;
mod unknown_code;
mod unknown_word;
mod unlimited_spindle;
mod unreachable_orientation;
mod unsupported_control;
mod unused_suppression;
mod unused_word;
mod winding_limit;
mod work_offset_unset;

use crate::Rule;
use crate::header;

/// The rules of the files named: name from the file's name, documentation from the file's header. The `mod` lines stay
/// plain above, because rustfmt does not follow those a macro makes.
macro_rules! table {
    ($($file:ident),* $(,)?) => {
        &[$({
            const SOURCE: &str = include_str!(concat!("rules/", stringify!($file), ".rs"));
            const DOCS: [u8; header::docs_len(SOURCE)] = header::docs_bytes(SOURCE);
            const NAME: [u8; stringify!($file).len()] = header::dashed(stringify!($file));
            const RULE: Rule = $file::RULE.named(header::text(&NAME), header::text(&DOCS));
            &RULE
        }),*]
    };
}

static RULES: &[&Rule] = table![
    ambiguous_implicit_decimal,
    ambiguous_posture,
    angle_wrap,
    apt_unknown_record,
    apt_vector_missing,
    arc_centre_missing,
    arc_radius_mismatch,
    axis_acceleration,
    axis_limit,
    axis_overspeed,
    bad_expression,
    bad_number,
    bare_carriage_return,
    block_delete_unset,
    block_number_order,
    branch_swap,
    broken_directive,
    broken_structure,
    canned_cycle,
    clamped_axis_moves,
    corner_error,
    cutter_compensation,
    decimal_comma,
    dwell_mark,
    empty_program,
    endless_loop,
    excess_linear_travel,
    excess_rapid_travel,
    excess_rotary_travel,
    fast_pole,
    feed_drop,
    feed_mode,
    feed_oscillation,
    ignored_record,
    machine_not_used,
    machine_unset,
    missing_axis,
    missing_feed,
    missing_label,
    missing_program_end,
    missing_subprogram,
    missing_tool_length,
    missing_word,
    modal_group_conflict,
    not_a_program,
    not_decided,
    not_modelled,
    not_run,
    only_one_posture,
    orientation_deviation,
    other_tool_length,
    path_deviation,
    pivot_uncertainty,
    pole_crossing,
    pole_flip,
    porting,
    position_unknown,
    program_alarm,
    program_name_mismatch,
    rapid_through_obstacle,
    rejected_block,
    repeated_word,
    short_block_time,
    spindle_off_cut,
    spindle_unset,
    swept_deviation,
    syntax_error,
    tcp_state,
    tilted_plane_misaligned,
    tool_defined_twice,
    tool_length_unset,
    tool_vector_not_unit,
    unbracketed_comparison,
    unclosed_comment,
    undefined_variable,
    units_unset,
    unknown_code,
    unknown_word,
    unlimited_spindle,
    unreachable_orientation,
    unsupported_control,
    unused_suppression,
    unused_word,
    winding_limit,
    work_offset_unset,
];

/// All rules, by name.
pub fn rules() -> &'static [&'static Rule] {
    RULES
}

/// The names of all rules, sorted.
pub fn rule_names() -> Vec<&'static str> {
    rules().iter().map(|rule| rule.name).collect()
}

/// A rule by name.
pub fn rule(name: &str) -> Option<&'static Rule> {
    rules().iter().copied().find(|rule| rule.name == name)
}

#[cfg(test)]
mod tests {
    use crate::sink::{Reporter, active};
    use crate::suppress::Suppressions;
    use crate::wake::Wake;
    use trunnion_interp::{Fault, FaultKind, Refusal, TcpMistake};
    use trunnion_syntax::{BlockId, LexOptions, SyntaxError, SyntaxErrorKind, TextRange, parse};

    /// All sorts of refusals; one that is added must be added here, and to a rule.
    const REFUSALS: [Refusal; 20] = [
        Refusal::Syntax,
        Refusal::Number,
        Refusal::Expression,
        Refusal::Variable,
        Refusal::Label,
        Refusal::Subprogram,
        Refusal::Structure,
        Refusal::GroupConflict,
        Refusal::RepeatedWord,
        Refusal::UnusedWord,
        Refusal::MissingWord,
        Refusal::UnknownCode,
        Refusal::UnknownWord,
        Refusal::Feed,
        Refusal::ArcRadius,
        Refusal::ArcCentre,
        Refusal::Compensation,
        Refusal::CannedCycle,
        Refusal::ProgramEnd,
        Refusal::Other,
    ];

    /// One of each kind of fault; a kind that is added must be added here, and to a rule.
    fn faults() -> Vec<FaultKind> {
        let text = String::new;
        vec![
            FaultKind::UnknownCode { machine_builder: false },
            FaultKind::UnknownCode { machine_builder: true },
            FaultKind::UnknownWord,
            FaultKind::GroupConflict {
                group: text(),
                first: text(),
                second: text(),
                first_range: TextRange::new(0, 1),
            },
            FaultKind::RepeatedWord,
            FaultKind::UnusedWord,
            FaultKind::MissingFeed {
                inverse_time: false,
                zero: false,
            },
            FaultKind::ArcRadiusMismatch {
                start: 1.0,
                end: 2.0,
                tolerance: 0.1,
            },
            FaultKind::ArcFitsAbsolute { start: 1.0, end: 2.0 },
            FaultKind::ArcRadiusTooSmall {
                radius: 1.0,
                half_chord: 2.0,
            },
            FaultKind::ArcCentreMissing,
            FaultKind::VectorNotUnit { norm: 0.0 },
            FaultKind::AptUnknownRecord,
            FaultKind::AmbiguousDecimal,
            FaultKind::AptVectorMissing,
            FaultKind::NotModelled { what: text() },
            FaultKind::WorkOffsetUnset { name: text() },
            FaultKind::ToolLengthUnset { tool: text() },
            FaultKind::ToolDefinedTwice {
                tool: 1,
                is_diameter: false,
                program_mm: 1.0,
                settings_mm: 2.0,
            },
            FaultKind::MissingProgramEnd,
            FaultKind::CompensationLeft,
            FaultKind::TcpState(TcpMistake::RotaryWithout),
            FaultKind::TcpState(TcpMistake::NoLength),
            FaultKind::TcpState(TcpMistake::ToolChange),
            FaultKind::TcpState(TcpMistake::MachineCoordinates),
            FaultKind::TcpState(TcpMistake::NoLengthNumber),
            FaultKind::EndlessLoop {
                blocks: 3,
                proved: false,
            },
            FaultKind::EndlessLoop {
                blocks: 3,
                proved: true,
            },
            FaultKind::MissingSubprogram {
                name: text(),
                searched: vec![text().into()],
                alarm: Some(text()),
                caller: Some(text()),
            },
            FaultKind::NotDecided { what: text() },
            FaultKind::ProgramAlarm { message: text() },
        ]
        .into_iter()
        .chain(REFUSALS.map(|refusal| FaultKind::Rejected {
            refusal,
            message: text(),
            alarm: Some(text()),
        }))
        .collect()
    }

    /// What all rules report of something that `ask` shows them.
    fn told(ask: impl Fn(Wake, &mut Reporter<'_>)) -> usize {
        let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
        let program = parse(b"G0 X0\n".to_vec(), LexOptions::default());
        let suppressions = Suppressions::default();
        let mut out = Reporter::new(&program, dialect, &suppressions);
        for rule in &active(&[]) {
            out.enter(rule, Some(BlockId(0)), 0);
            ask(rule.wake, &mut out);
            out.leave();
        }
        out.finish(&|_| Vec::new()).len()
    }

    #[test]
    fn every_fault_is_told_by_exactly_one_rule() {
        // what depends on an offset or a length is judged, not its word
        let unset = |kind: &FaultKind| {
            matches!(
                kind,
                FaultKind::WorkOffsetUnset { .. } | FaultKind::ToolLengthUnset { .. }
            )
        };
        for kind in faults().into_iter().filter(|kind| !unset(kind)) {
            let fault = Fault {
                place: None,
                block: BlockId(0),
                range: TextRange::new(0, 5),
                kind,
            };
            let count = told(|wake, out| wake.read_fault(&fault, out));
            assert_eq!(count, 1, "{:?}", fault.kind);
        }
    }

    #[test]
    fn every_syntax_error_is_told_by_exactly_one_rule() {
        use SyntaxErrorKind as Kind;
        for kind in [
            Kind::UnclosedComment,
            Kind::NestedComment,
            Kind::UnexpectedCharacter,
            Kind::WordWithoutValue,
            Kind::NumberWithoutLetter,
            Kind::BadNumber,
            Kind::DecimalComma,
            Kind::BlankInNumber,
            Kind::MissingValue,
            Kind::UnbalancedBracket,
            Kind::UnclosedText,
            Kind::DanglingContinuation,
            Kind::BadRecord,
            Kind::TooLarge,
        ] {
            let error = SyntaxError {
                kind,
                range: TextRange::new(3, 5),
            };
            let count = told(|wake, out| {
                if let Wake::Text(rule) = wake {
                    rule(&error, out);
                }
            });
            assert_eq!(count, 1, "{kind:?}");
        }
    }
}
