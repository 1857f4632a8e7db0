//! Comments that allow a rule.
