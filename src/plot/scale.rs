//! Ranges of values and how numbers are written on an axis.
use crate::unit::Unit;

/// A range that holds all values, a little wider; never empty.
pub(crate) fn range(values: impl Iterator<Item = f64>, least: f64) -> [f64; 2] {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
    if low > high {
        return [0.0, 1.0];
    }
    let more = (0.06 * (high - low)).max(0.5 * (least - (high - low)).max(0.0));
    [low - more, high + more]
}

/// How high a length or a feed in mm stands on an axis: in a unit, and by its logarithm where the values are far apart.
#[derive(Clone, Copy)]
pub(crate) struct Height {
    pub(crate) unit: Unit,
    /// By its logarithm.
    pub(crate) decades: bool,
    /// With logarithms, lower values stand here, mm.
    pub(crate) floor: f64,
}

impl Height {
    /// Where a value in mm stands.
    pub(crate) fn of(&self, mm: f64) -> f64 {
        if self.decades {
            decade(self.unit.of_mm(mm.max(self.floor)))
        } else {
            self.unit.of_mm(mm)
        }
    }
    /// The name of the axis; `per`: what follows the unit of length.
    pub(crate) fn name(&self, what: &str, per: &str) -> String {
        let log = if self.decades { " (log)" } else { "" };
        format!("{what} / {}{per}{log}", self.unit.name())
    }
    /// How many labels it has.
    pub(crate) fn labels(&self, [low, high]: [f64; 2]) -> usize {
        if self.decades {
            (high - low).ceil() as usize + 1
        } else {
            8
        }
    }
}

/// `1 block`, `2 blocks`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// A number with as many decimals as its neighbours on the axis need.
pub(crate) fn short(value: f64, span: f64) -> String {
    let decimals = (1.2 - decade(span / 5.0)).ceil().clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    };
    if text == "-0" {
        "0".into()
    } else {
        text.replace('-', "\u{2212}")
    }
}

/// Decimal logarithm.
pub(crate) fn decade(value: f64) -> f64 {
    trunnion_geometry::math::ln(value) / core::f64::consts::LN_10
}

/// A power of ten as people write it.
pub(crate) fn power(exponent: i32) -> String {
    if (-4..=4).contains(&exponent) {
        let value = (0..exponent.abs()).fold(
            1.0,
            |value: f64, _| if exponent > 0 { value * 10.0 } else { value / 10.0 },
        );
        let decimals = (-exponent).max(0) as usize;
        return format!("{value:.decimals$}");
    }
    format!("1e{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::equal;

    #[test]
    fn numbers_on_an_axis_are_short() {
        assert_eq!(short(-0.0, 1.0), "0");
        assert_eq!(short(12.5, 40.0), "12.5");
        assert_eq!(short(-1200.0, 4000.0), "\u{2212}1200");
        assert_eq!(short(0.0123, 0.02), "0.0123");
        assert_eq!(
            (power(-3), power(2), power(-7)),
            ("0.001".into(), "100".into(), "1e-7".into())
        );
    }

    #[test]
    fn ranges_are_never_empty() {
        let [low, high] = range([5.0, 5.0].into_iter(), 0.1);
        assert!(low < 5.0 && high > 5.0);
        assert_eq!(range(core::iter::empty(), 1.0), [0.0, 1.0]);
        let (x, y) = equal([0.0, 10.0], [0.0, 1.0], (12_000, 7_000), 0.0);
        assert!(x[0] <= 0.0 && x[1] >= 10.0 && y[0] < 0.0 && y[1] > 1.0);
    }
}
