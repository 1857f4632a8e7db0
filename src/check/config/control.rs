//! `[control]` of `trunnion.toml`: parameters of the control that decide what a program means.
use super::ConfigError;
use super::readings::{Chamfer, Places, Scaled};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_dialect::Dialect;
use trunnion_interp::{
    AxisLetter, ControlData, DrillingAxis, FrameAngles, ImplicitDecimals, LengthUnit, OuterCorner, Position,
    RollPitchYaw, RoughingEscape, SplineReading, TcpCodes,
};

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Decimals {
    LeastIncrement,
    Calculator,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Unit {
    Mm,
    Inch,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Corner {
    Lines,
    Arc,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Angles {
    Fixed,
    Turned,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Order {
    Rpy,
    Euler,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Splines {
    ChordLength,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Escape {
    Feed,
    Rapid,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Drilling {
    Z,
    AcrossPlane,
}

/// `tcp_codes = { on = ["M428"], off = ["M429"] }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Codes {
    #[serde(default)]
    on: Vec<String>,
    #[serde(default)]
    off: Vec<String>,
    #[serde(default)]
    at_start: bool,
}

/// The section as written.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileControl {
    units: Option<Unit>,
    implicit_decimals: Option<Decimals>,
    chip_break_retract: Option<Spanned<f64>>,
    peck_clearance: Option<Spanned<f64>>,
    bore_shift: Option<Spanned<String>>,
    main_spindle: Option<Spanned<i64>>,
    drilling_axis: Option<Drilling>,
    roughing_escape: Option<Escape>,
    thread_pull_out: Option<Spanned<f64>>,
    roughing_retract: Option<Spanned<f64>>,
    thread_least_cut: Option<Spanned<f64>>,
    thread_finish: Option<Spanned<f64>>,
    spline_arcs: Option<Spanned<f64>>,
    outer_corner: Option<Corner>,
    block_delete: Option<bool>,
    roll_pitch_yaw: Option<Angles>,
    frame_angles: Option<Order>,
    splines: Option<Splines>,
    scaled_axes: Option<Scaled>,
    chamfer_length: Option<Chamfer>,
    hole_places: Option<Places>,
    increment_adds_frame: Option<bool>,
    increment_adds_length: Option<bool>,
    positive_angles: Option<bool>,
    tcp_codes: Option<Codes>,
    #[serde(default)]
    reference_points: Vec<BTreeMap<Spanned<String>, Spanned<f64>>>,
    fixed_points: Option<Vec<BTreeMap<Spanned<String>, Spanned<f64>>>>,
    power_on: Option<Vec<Spanned<String>>>,
}

/// What the settings say of the dialect.
#[derive(Clone, Copy)]
pub(super) enum KnownDialect<'d> {
    /// Nothing: each program has its own.
    Unset,
    Named(&'d Dialect),
    /// A table of one shop, which is not read here.
    Table,
}

impl KnownDialect<'static> {
    pub(super) fn of(config: &super::Config) -> Self {
        match config.dialect.as_deref().and_then(trunnion_dialect::builtin) {
            Some(dialect) => Self::Named(dialect),
            None if config.dialect_table.is_some() => Self::Table,
            None => Self::Unset,
        }
    }

    pub(super) fn named(self) -> Option<&'static Dialect> {
        match self {
            Self::Named(dialect) => Some(dialect),
            Self::Unset | Self::Table => None,
        }
    }
}

impl FileControl {
    /// As the interpreter wants it.
    pub(super) fn data(&self, known: KnownDialect<'_>) -> Result<ControlData, ConfigError> {
        let points = |points: &[_]| points.iter().map(position).collect::<Result<Vec<_>, _>>();
        Ok(ControlData {
            units: self.units.map(|unit| match unit {
                Unit::Mm => LengthUnit::Millimetre,
                Unit::Inch => LengthUnit::Inch,
            }),
            implicit_decimals: self.implicit_decimals.map(|decimals| match decimals {
                Decimals::LeastIncrement => ImplicitDecimals::LeastIncrement,
                Decimals::Calculator => ImplicitDecimals::Calculator,
            }),
            chip_break_retract_mm: length("chip_break_retract", self.chip_break_retract.as_ref())?,
            peck_clearance_mm: length("peck_clearance", self.peck_clearance.as_ref())?,
            bore_shift: self.bore_shift.as_ref().map(bore_shift).transpose()?,
            main_spindle: self.main_spindle.as_ref().map(main_spindle).transpose()?,
            drilling_axis: self.drilling_axis.map(|axis| match axis {
                Drilling::Z => DrillingAxis::Z,
                Drilling::AcrossPlane => DrillingAxis::AcrossPlane,
            }),
            roughing_escape: self.roughing_escape.map(|escape| match escape {
                Escape::Feed => RoughingEscape::Feed,
                Escape::Rapid => RoughingEscape::Rapid,
            }),
            thread_pull_out: leads(self.thread_pull_out.as_ref())?,
            roughing_retract_mm: length("roughing_retract", self.roughing_retract.as_ref())?,
            thread_least_cut_mm: length("thread_least_cut", self.thread_least_cut.as_ref())?,
            thread_finish_mm: length("thread_finish", self.thread_finish.as_ref())?,
            spline_arcs_mm: length("spline_arcs", self.spline_arcs.as_ref())?,
            outer_corner: match self.outer_corner {
                Some(Corner::Arc) => OuterCorner::Arc,
                Some(Corner::Lines) | None => OuterCorner::Lines,
            },
            block_delete: self.block_delete,
            roll_pitch_yaw: self.roll_pitch_yaw.map(|angles| match angles {
                Angles::Fixed => RollPitchYaw::Fixed,
                Angles::Turned => RollPitchYaw::Turned,
            }),
            frame_angles: self.frame_angles.map(|order| match order {
                Order::Rpy => FrameAngles::RollPitchYaw,
                Order::Euler => FrameAngles::Euler,
            }),
            splines: self.splines.map(|Splines::ChordLength| SplineReading::ChordLength),
            scaled_axes: self.scaled_axes.map(Into::into),
            chamfer_length: self.chamfer_length.map(Into::into),
            hole_places: self.hole_places.map(Into::into),
            increment_adds_frame: self.increment_adds_frame,
            increment_adds_length: self.increment_adds_length,
            positive_angles: self.positive_angles,
            tcp_codes: self.tcp_codes.as_ref().map(|codes| TcpCodes {
                on: codes.on.clone(),
                off: codes.off.clone(),
                at_start: codes.at_start,
            }),
            clamp_codes: trunnion_interp::AllClampCodes::default(),
            further_axes: Vec::new(),
            absent_axis: None,
            axes_declared: false,
            has_rotary: false,
            length_along: None,
            x_diameter: false,
            rotary_turns: None,
            reference_points: points(&self.reference_points)?,
            fixed_points: self.fixed_points.as_deref().map(points).transpose()?,
            tool_change: None,
            power_on: self
                .power_on
                .as_ref()
                .map(|codes| codes.iter().map(|code| g_code(code, known)).collect())
                .transpose()?,
        })
    }
}

fn main_spindle(number: &Spanned<i64>) -> Result<u32, ConfigError> {
    match u32::try_from(*number.get_ref()) {
        Ok(spindle @ 1..=99) => Ok(spindle),
        _ => Err(at(
            number,
            format!(
                "main_spindle = {} must be the number of a spindle, 1 to 99",
                number.get_ref()
            ),
        )),
    }
}

fn at<T>(place: &Spanned<T>, message: impl Into<String>) -> ConfigError {
    ConfigError {
        message: message.into(),
        span: Some(place.span()),
    }
}

fn length(key: &str, value: Option<&Spanned<f64>>) -> Result<Option<f64>, ConfigError> {
    match value {
        Some(value) if !(0.0..=1000.0).contains(value.get_ref()) => {
            let message = format!("`{key}` must be from 0 to 1000 mm, not {}", value.get_ref());
            Err(at(value, message))
        }
        value => Ok(value.map(|value| *value.get_ref())),
    }
}

/// Leads of a thread.
fn leads(value: Option<&Spanned<f64>>) -> Result<Option<f64>, ConfigError> {
    match value {
        // two digits, in tenths
        Some(value) if !(0.0..10.0).contains(value.get_ref()) => {
            let message = format!("`thread_pull_out` must be from 0 to 9.9 leads, not {}", value.get_ref());
            Err(at(value, message))
        }
        value => Ok(value.map(|value| *value.get_ref())),
    }
}

/// `+X`: axis and sense.
fn bore_shift(way: &Spanned<String>) -> Result<(usize, f64), ConfigError> {
    let sense = |sign: char| if sign == '-' { -1.0 } else { 1.0 };
    if let [sign @ (b'+' | b'-'), axis @ b'X'..=b'Z'] = way.get_ref().as_bytes() {
        return Ok((usize::from(axis - b'X'), sense(char::from(*sign))));
    }
    let message = format!("`bore_shift` must be one of +X -X +Y -Y +Z -Z, not {:?}", way.get_ref());
    Err(at(way, message))
}

/// `G17`.
fn g_code(code: &Spanned<String>, known: KnownDialect<'_>) -> Result<String, ConfigError> {
    let number = code.get_ref().strip_prefix('G').unwrap_or_default();
    if !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') {
        let dialect = match known {
            KnownDialect::Table => return Ok(code.get_ref().clone()),
            KnownDialect::Named(dialect) => Some(dialect),
            KnownDialect::Unset => None,
        };
        trunnion_dialect::known_at_power_on(code.get_ref(), dialect).map_err(|message| ConfigError {
            message,
            span: Some(code.span()),
        })?;
        return Ok(code.get_ref().clone());
    }
    let message = format!(
        "{:?} is not a G code: write G and its number, for example `power_on = [\"G17\", \"G90\"]`",
        code.get_ref()
    );
    Err(at(code, message))
}

fn position(point: &BTreeMap<Spanned<String>, Spanned<f64>>) -> Result<Position, ConfigError> {
    let mut position = Position::default();
    for (letter, value) in point {
        let axis = match letter.get_ref().as_bytes() {
            [letter] => AxisLetter::new(*letter),
            _ => None,
        };
        let Some(axis) = axis else {
            return Err(at(
                letter,
                format!("`{}` is not an axis; the axes are X Y Z A B C U V W", letter.get_ref()),
            ));
        };
        if !value.get_ref().is_finite() {
            return Err(at(value, "a place must be a number in mm or degrees: `X = 0.0`"));
        }
        position.set(usize::from(axis.0), *value.get_ref());
    }
    Ok(position)
}

#[cfg(test)]
mod tests {
    use crate::Config;
    use trunnion_interp::{ImplicitDecimals, LengthUnit, OuterCorner, RoughingEscape};

    #[test]
    fn a_whole_section_is_read() {
        let text = "[control]\nunits = \"inch\"\nimplicit_decimals = \"least-increment\"\nchip_break_retract = 0.5\npeck_clearance = 1\nbore_shift = \"-Y\"\nmain_spindle = 2\ndrilling_axis = \"across-plane\"\nroughing_escape = \"rapid\"\nthread_pull_out = 1.2\n\
                    outer_corner = \"arc\"\nroll_pitch_yaw = \"fixed\"\nframe_angles = \"rpy\"\nscaled_axes = \"all\"\nchamfer_length = \"side\"\nhole_places = \"pairs\"\nincrement_adds_frame = true\nincrement_adds_length = false\npositive_angles = false\nblock_delete = true\ntcp_codes = { on = [\"M429\"] }\nreference_points = [{ X = 0, Z = 400 }, { Z = 300 }]\nfixed_points = [{ Z = 0 }]\n";
        let control = Config::parse(text).expect("read").setup.control;
        assert_eq!(control.units, Some(LengthUnit::Inch));
        assert_eq!(control.implicit_decimals, Some(ImplicitDecimals::LeastIncrement));
        assert_eq!(control.chip_break_retract_mm, Some(0.5));
        assert_eq!(control.peck_clearance_mm, Some(1.0));
        assert_eq!(control.bore_shift, Some((1, -1.0)));
        assert_eq!(control.main_spindle, Some(2));
        assert_eq!(control.drilling_axis, Some(trunnion_interp::DrillingAxis::AcrossPlane));
        assert_eq!(control.roughing_escape, Some(RoughingEscape::Rapid));
        assert_eq!(control.thread_pull_out, Some(1.2));
        assert_eq!(control.outer_corner, OuterCorner::Arc);
        assert_eq!(control.block_delete, Some(true));
        assert_eq!(control.roll_pitch_yaw, Some(trunnion_interp::RollPitchYaw::Fixed));
        assert_eq!(control.frame_angles, Some(trunnion_interp::FrameAngles::RollPitchYaw));
        assert_eq!(control.scaled_axes, Some(trunnion_interp::ScaledAxes::All));
        assert_eq!(control.chamfer_length, Some(trunnion_interp::ChamferLength::Side));
        assert_eq!(control.hole_places, Some(trunnion_interp::HolePlaces::Pairs));
        assert_eq!(
            (control.increment_adds_frame, control.increment_adds_length),
            (Some(true), Some(false))
        );
        assert_eq!(control.positive_angles, Some(false));
        let codes = control.tcp_codes.expect("declared");
        assert_eq!((codes.meaning("M429"), codes.meaning("M428")), (Some(true), None));
        let points: Vec<_> = control
            .reference_points
            .iter()
            .map(|p| (p.get(0), p.get(1), p.get(2)))
            .collect();
        assert_eq!(points, [(Some(0.0), None, Some(400.0)), (None, None, Some(300.0))]);
        assert_eq!(
            control
                .fixed_points
                .unwrap_or_default()
                .iter()
                .map(|p| (p.get(0), p.get(2)))
                .collect::<Vec<_>>(),
            [(None, Some(0.0))]
        );
    }

    #[test]
    fn errors_point_at_their_place() {
        for (text, wrong) in [
            ("[control]\nimplicit_decimals = \"maybe\"", "\"maybe\""),
            ("[control]\nunits = \"cm\"", "\"cm\""),
            ("[control]\npeck_clearance = -1", "-1"),
            ("[control]\nmain_spindle = 0", "0"),
            ("[control]\nbore_shift = \"X\"", "\"X\""),
            ("[control]\ndrilling_axis = \"y\"", "\"y\""),
            ("[control]\nscaled_axes = \"z\"", "\"z\""),
            ("[control]\nchamfer_length = 2", "2"),
            ("[control]\nhole_places = \"list\"", "\"list\""),
            ("[control]\nroughing_escape = \"slow\"", "\"slow\""),
            ("[control]\nthread_pull_out = -0.1", "-0.1"),
            ("[control]\nreference_points = [{ Q = 1 }]", "Q"),
            ("[control]\nreference_points = [{ X = inf }]", "inf"),
            ("[control]\nretract = 1", "retract"),
        ] {
            let error = Config::parse(text).expect_err(text);
            let span = error
                .span
                .clone()
                .unwrap_or_else(|| panic!("{text}: {error} has no place"));
            assert_eq!(&text[span], wrong, "{error}");
        }
    }
}
