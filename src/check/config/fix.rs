//! `[fix]` of `trunnion.toml`: what rewrites may do. Only read here; no check uses it.
use serde::Deserialize;
use toml::Spanned;

/// What a sequence of postures is chosen by.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FixCost {
    /// Travel of the rotary axes.
    Travel,
    /// Time of the slowest rotary axis.
    Time,
    /// How far the tip is off its line.
    Deviation,
}

/// Which point of a ball X Y Z of a program are.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FixPoint {
    /// Its tip.
    Tip,
    /// Its centre.
    Centre,
}

/// What a refitted path must be near.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FixSource {
    /// The ends of the lines.
    Points,
    /// The lines.
    Chords,
}

/// What the file says; what it does not say is the rewrite's own default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FixSettings {
    /// `tolerance_mm`: tip (or ball centre) may move by this much, mm.
    pub tolerance_mm: Option<f64>,
    /// `tolerance_deg`: the tool axis may turn by this much, deg.
    pub tolerance_deg: Option<f64>,
    /// `cost`: of `switch-angles`.
    pub cost: Option<FixCost>,
    /// `point`: of `smooth-pole`.
    pub point: Option<FixPoint>,
    /// `source`: of `fit-arcs` and `fit-splines`.
    pub source: Option<FixSource>,
    /// `feed_mm_min`: of `adapt-feed`, mm/min.
    pub feed_mm_min: Option<f64>,
}

/// The table as it is written.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileFix {
    tolerance_mm: Option<Spanned<f64>>,
    tolerance_deg: Option<Spanned<f64>>,
    cost: Option<FixCost>,
    point: Option<FixPoint>,
    source: Option<FixSource>,
    feed_mm_min: Option<Spanned<f64>>,
}

impl FileFix {
    pub(super) fn settings(self) -> Result<FixSettings, super::ConfigError> {
        let positive = |key: &str, value: Option<Spanned<f64>>| match value {
            Some(value) if !(value.get_ref().is_finite() && *value.get_ref() > 0.0) => Err(super::ConfigError {
                message: format!("`{key}` must be a positive number, not {}", value.get_ref()),
                span: Some(value.span()),
            }),
            value => Ok(value.map(Spanned::into_inner)),
        };
        Ok(FixSettings {
            tolerance_mm: positive("tolerance_mm", self.tolerance_mm)?,
            tolerance_deg: positive("tolerance_deg", self.tolerance_deg)?,
            cost: self.cost,
            point: self.point,
            source: self.source,
            feed_mm_min: positive("feed_mm_min", self.feed_mm_min)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{FixCost, FixPoint, FixSettings, FixSource};
    use crate::config::Config;

    #[test]
    fn every_key_is_read() {
        let text = "[fix]\ntolerance_mm = 0.002\ntolerance_deg = 0.2\ncost = \"time\"\npoint = \"centre\"\nsource = \"points\"\nfeed_mm_min = 3000\n";
        let wanted = FixSettings {
            tolerance_mm: Some(0.002),
            tolerance_deg: Some(0.2),
            cost: Some(FixCost::Time),
            point: Some(FixPoint::Centre),
            source: Some(FixSource::Points),
            feed_mm_min: Some(3000.0),
        };
        assert_eq!(Config::parse(text).expect("a whole table").fix, wanted);
        assert_eq!(Config::parse("").expect("an empty file").fix, FixSettings::default());
    }

    #[test]
    fn what_no_rewrite_can_keep_to_is_refused() {
        for text in [
            "tolerance_mm = 0.0",
            "tolerance_deg = -1.0",
            "point = \"middle\"",
            "points = \"tip\"",
            "source = \"lines\"",
            "feed_mm_min = 0",
            "feed_mm_min = inf",
        ] {
            Config::parse(&format!("[fix]\n{text}\n")).expect_err(text);
        }
    }
}
