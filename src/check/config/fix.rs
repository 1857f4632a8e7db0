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

/// What the file says; what it does not say is the rewrite's own default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FixSettings {
    /// `tolerance_mm`: tip (or ball centre) may move by this much, mm.
    pub tolerance_mm: Option<f64>,
    /// `tolerance_deg`: the tool axis may turn by this much, deg.
    pub tolerance_deg: Option<f64>,
    /// `cost`: of `switch-angles`.
    pub cost: Option<FixCost>,
}

/// The table as it is written.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileFix {
    tolerance_mm: Option<Spanned<f64>>,
    tolerance_deg: Option<Spanned<f64>>,
    cost: Option<FixCost>,
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
        })
    }
}
