//! A dialect: notation, letters, codes, quirks and alarms.
use super::{CanonicalV1, Encode};
use trunnion_dialect::{
    ArcTolerance, Code, Dialect, DialectFacts, Language, LengthAfterReturn, LengthChange, Macros, Quirks, ToolWord,
};
use trunnion_syntax::LexOptions;

impl Encode for Dialect {
    fn encode(&self, out: &mut CanonicalV1) {
        self.facts().encode(out);
    }
}

record! {
    DialectFacts<'_> {
        name = 1, lex = 2, arc = 3, builder_codes = 4, codes = 5, roles = 6, named_roles = 7, quirks = 8, alarms = 9,
    }
}

record! {
    LexOptions {
        format = 1, paren_comment = 2, semicolon_comment = 3, slash_star_comment = 4, blanks_in_numbers = 5,
    }
}

record! {
    ArcTolerance {
        mm = 1, inch_mm = 2, relative = 3, relative_up_to = 4,
    } without {
        source,
    }
}

record! {
    Code {
        id = 1, kind = 2, group = 3, words = 4, action = 5, owner = 6, path = 7, feed = 8, lengths = 9,
    } without {
        doc, source,
    }
}

/// What older versions did not know of the tool length after a return.
fn returned(decision: LengthAfterReturn) -> Option<u32> {
    match decision {
        LengthAfterReturn::Kept | LengthAfterReturn::CancelledByG28 => None,
        LengthAfterReturn::Cancelled => Some(1),
        LengthAfterReturn::Undeclared => Some(2),
    }
}

/// What a new tool length moves; older versions knew one answer.
fn changes(decision: LengthChange) -> Option<u32> {
    match decision {
        LengthChange::Shifts => None,
        LengthChange::Moves => Some(1),
        LengthChange::Undeclared => Some(2),
    }
}

/// Decisions are written as the flags that they replace, so that stored certificates stay valid: a tag for each.
impl Encode for Quirks {
    fn encode(&self, out: &mut CanonicalV1) {
        // no `..`: a new field does not compile until somebody decides whether it matters
        let Self {
            language,
            macros,
            tool_word,
            whole_numbers,
            motion_at_start,
            unit_vectors,
            percent_ends_program,
            first_offset_at_start,
            edge_at_tool_change,
            dwell_in_ms,
            arc_tolerance_relative,
            last_code_wins,
            numbers_follow_names,
            own_parameters_to,
            diameter,
            return_moves_all,
            plain_scale_factor,
            corner_words,
            offset_compensation,
            cutter_offset_ambiguous,
            delete_rest,
            dwell_then_moves,
            straight_rapids,
            cycle_level_optional,
            cycle_return_unknown,
            tool_change_stops_spindle,
            program_stop_stops_spindle,
            length_after_return,
            length_change,
            dollar_commands,
            skips_leader,
            machine_data_suppress_length,
        } = self;
        let has = |wanted: Language| *language == wanted;
        out.record(|fields| {
            fields
                .field(1, &has(Language::Linuxcnc))
                .field(2, motion_at_start)
                .field(3, &tool_word.changes())
                .field(4, unit_vectors)
                .field(5, percent_ends_program)
                .field(6, first_offset_at_start)
                .field(7, edge_at_tool_change)
                .field(8, dwell_in_ms)
                .field(9, arc_tolerance_relative)
                .field(10, &has(Language::Sinumerik))
                .field(11, last_code_wins)
                .field(12, numbers_follow_names)
                .field(13, &whole_numbers.lengths_ambiguous())
                .field(14, own_parameters_to)
                .field(15, diameter)
                .field(16, &(*tool_word == ToolWord::ChangesWithOffset))
                .field(17, return_moves_all)
                .field(18, plain_scale_factor)
                .field(19, corner_words)
                .field(20, offset_compensation)
                .field(21, cutter_offset_ambiguous)
                .field(22, &whole_numbers.feeds_ambiguous())
                .field(23, delete_rest)
                .field(24, dwell_then_moves)
                .field(25, &has(Language::MacroB))
                .field(26, machine_data_suppress_length)
                .field(27, &(*macros == Macros::Fanuc).then_some(true))
                .field(28, &straight_rapids.then_some(true))
                .field(29, &cycle_level_optional.then_some(true))
                .field(30, &has(Language::UserTask).then_some(true))
                .field(31, &cycle_return_unknown.then_some(true))
                .field(32, &dollar_commands.then_some(true))
                .field(33, &skips_leader.then_some(true))
                .field(34, &tool_change_stops_spindle.then_some(true))
                .field(
                    35,
                    &(*length_after_return == LengthAfterReturn::CancelledByG28).then_some(true),
                )
                .field(36, &program_stop_stops_spindle.then_some(true))
                .field(37, &returned(*length_after_return))
                .field(38, &changes(*length_change));
        });
    }
}
