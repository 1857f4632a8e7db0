//! A dialect: notation, letters, codes, quirks and alarms.
use super::{CanonicalV1, Encode};
use trunnion_dialect::{ArcTolerance, Code, Dialect, DialectFacts, Quirks};
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
        id = 1, kind = 2, group = 3, words = 4, action = 5, owner = 6,
    } without {
        doc, source,
    }
}

record! {
    Quirks {
        rs274 = 1, motion_at_start = 2, tool_word_changes = 3, unit_vectors = 4, percent_ends_program = 5,
        first_offset_at_start = 6, edge_at_tool_change = 7, dwell_in_ms = 8, arc_tolerance_relative = 9,
        user_names = 10, last_code_wins = 11, numbers_follow_names = 12, whole_numbers_ambiguous = 13,
        own_parameters_to = 14, diameter = 15, tool_word_holds_offset = 16, return_moves_all = 17,
        plain_scale_factor = 18, corner_words = 19, offset_compensation = 20, cutter_offset_ambiguous = 21,
        whole_feed_ambiguous = 22, delete_rest = 23, dwell_then_moves = 24, macro_b = 25,
        machine_data_suppress_length = 26,
    }
}
