//! `[quirks]` of a table: missing keys stay as in the table that it extends.
use crate::{Action, Language, LengthAfterReturn, LengthChange, Macros, Quirks, ToolWord, WholeNumbers};
use serde::Deserialize;

/// The keys of `[quirks]`, each optional; [`Quirks`] says what they mean.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct QuirksRow {
    language: Option<Language>,
    macros: Option<Macros>,
    tool_word: Option<ToolWord>,
    whole_numbers: Option<WholeNumbers>,
    #[serde(deserialize_with = "crate::action::some_action")]
    motion_at_start: Option<Action>,
    unit_vectors: Option<bool>,
    percent_ends_program: Option<bool>,
    first_offset_at_start: Option<bool>,
    edge_at_tool_change: Option<bool>,
    dwell_in_ms: Option<bool>,
    last_code_wins: Option<bool>,
    numbers_follow_names: Option<bool>,
    own_parameters_to: Option<u32>,
    delete_rest: Option<bool>,
    machine_data_suppress_length: Option<bool>,
    diameter: Option<bool>,
    return_moves_all: Option<bool>,
    plain_scale_factor: Option<bool>,
    corner_words: Option<bool>,
    offset_compensation: Option<bool>,
    cutter_offset_ambiguous: Option<bool>,
    dwell_then_moves: Option<bool>,
    straight_rapids: Option<bool>,
    cycle_level_optional: Option<bool>,
    cycle_return_unknown: Option<bool>,
    tool_change_stops_spindle: Option<bool>,
    program_stop_stops_spindle: Option<bool>,
    length_after_return: Option<LengthAfterReturn>,
    length_change: Option<LengthChange>,
    dollar_commands: Option<bool>,
    skips_leader: Option<bool>,
}

impl QuirksRow {
    /// Applies the table to `base`.
    pub(crate) fn over(self, base: &Quirks) -> Quirks {
        Quirks {
            language: self.language.unwrap_or(base.language),
            macros: self.macros.unwrap_or(base.macros),
            tool_word: self.tool_word.unwrap_or(base.tool_word),
            whole_numbers: self.whole_numbers.unwrap_or(base.whole_numbers),
            motion_at_start: self.motion_at_start.or(base.motion_at_start),
            unit_vectors: self.unit_vectors.unwrap_or(base.unit_vectors),
            percent_ends_program: self.percent_ends_program.unwrap_or(base.percent_ends_program),
            first_offset_at_start: self.first_offset_at_start.unwrap_or(base.first_offset_at_start),
            edge_at_tool_change: self.edge_at_tool_change.unwrap_or(base.edge_at_tool_change),
            dwell_in_ms: self.dwell_in_ms.unwrap_or(base.dwell_in_ms),
            last_code_wins: self.last_code_wins.unwrap_or(base.last_code_wins),
            numbers_follow_names: self.numbers_follow_names.unwrap_or(base.numbers_follow_names),
            own_parameters_to: self.own_parameters_to.unwrap_or(base.own_parameters_to),
            delete_rest: self.delete_rest.unwrap_or(base.delete_rest),
            diameter: self.diameter.unwrap_or(base.diameter),
            return_moves_all: self.return_moves_all.unwrap_or(base.return_moves_all),
            plain_scale_factor: self.plain_scale_factor.unwrap_or(base.plain_scale_factor),
            corner_words: self.corner_words.unwrap_or(base.corner_words),
            offset_compensation: self.offset_compensation.unwrap_or(base.offset_compensation),
            cutter_offset_ambiguous: self.cutter_offset_ambiguous.unwrap_or(base.cutter_offset_ambiguous),
            dwell_then_moves: self.dwell_then_moves.unwrap_or(base.dwell_then_moves),
            straight_rapids: self.straight_rapids.unwrap_or(base.straight_rapids),
            cycle_level_optional: self.cycle_level_optional.unwrap_or(base.cycle_level_optional),
            cycle_return_unknown: self.cycle_return_unknown.unwrap_or(base.cycle_return_unknown),
            tool_change_stops_spindle: self.tool_change_stops_spindle.unwrap_or(base.tool_change_stops_spindle),
            program_stop_stops_spindle: self
                .program_stop_stops_spindle
                .unwrap_or(base.program_stop_stops_spindle),
            length_after_return: self.length_after_return.unwrap_or(base.length_after_return),
            length_change: self.length_change.unwrap_or(base.length_change),
            dollar_commands: self.dollar_commands.unwrap_or(base.dollar_commands),
            skips_leader: self.skips_leader.unwrap_or(base.skips_leader),
            machine_data_suppress_length: self
                .machine_data_suppress_length
                .unwrap_or(base.machine_data_suppress_length),
            arc_tolerance_relative: base.arc_tolerance_relative,
        }
    }
}
