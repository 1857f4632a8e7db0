//! `[check]` of a table: what a check says of a control. No run depends on it, so it is not part of a certificate.
use serde::Deserialize;

/// What decides what F means in a block that moves rotary axes, without tool centre point control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RotaryFeed {
    /// The language itself.
    #[default]
    Language,
    /// The family of the machine's control: the table describes no particular control.
    Family,
    /// A parameter.
    Parameter,
    /// A parameter; and where only rotary axes turn, F is the speed along circles whose diameters are settings.
    Diameters,
}

/// What a check knows about a control. In TOML: table `[check]`, each key optional: missing keys stay as in the table that it
/// extends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Advice {
    /// What decides what F means while rotary axes move.
    pub rotary_feed: RotaryFeed,
    /// Of two words with one letter in a block the last one wins, without a message.
    pub last_word_wins: bool,
    /// Which setting decides what a coordinate without a decimal point means.
    pub whole_coordinate: Option<String>,
    /// Which setting decides what F without a decimal point means.
    pub whole_feed: Option<String>,
    /// Subprograms that are not in the folder may be in the control, which is supplied with some.
    pub subprograms_in_control: bool,
    /// How to limit the spindle speed under constant surface speed; `None`: a check does not ask for a limit.
    pub spindle_limit: Option<String>,
    /// S may be the power of a laser: S0 with the spindle on is no mistake.
    pub s_may_be_power: bool,
}

/// The keys of `[check]`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct AdviceRow {
    rotary_feed: Option<RotaryFeed>,
    last_word_wins: Option<bool>,
    whole_coordinate: Option<String>,
    whole_feed: Option<String>,
    spindle_limit: Option<String>,
    subprograms_in_control: Option<bool>,
    s_may_be_power: Option<bool>,
}

impl AdviceRow {
    /// Applies the table to `base`.
    pub(crate) fn over(self, base: &Advice) -> Advice {
        Advice {
            rotary_feed: self.rotary_feed.unwrap_or(base.rotary_feed),
            last_word_wins: self.last_word_wins.unwrap_or(base.last_word_wins),
            whole_coordinate: self.whole_coordinate.or_else(|| base.whole_coordinate.clone()),
            whole_feed: self.whole_feed.or_else(|| base.whole_feed.clone()),
            subprograms_in_control: self.subprograms_in_control.unwrap_or(base.subprograms_in_control),
            spindle_limit: self.spindle_limit.or_else(|| base.spindle_limit.clone()),
            s_may_be_power: self.s_may_be_power.unwrap_or(base.s_may_be_power),
        }
    }
}
