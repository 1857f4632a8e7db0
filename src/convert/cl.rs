//! CL data from points, for callers that make paths themselves: a list of points becomes APT text, which [`crate::convert`] posts and proves.
use crate::number::number;
use core::fmt::Write;
use trunnion_geometry::Vec3;

/// How the tool moves to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClFeed {
    /// Rapid.
    Rapid,
    /// mm/min.
    PerMinute(f64),
}

/// A point of a tool path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClPoint {
    /// Tool tip, workpiece frame, mm.
    pub tip: Vec3,
    /// Tool axis, tip -> spindle; any length but 0.
    pub axis: Vec3,
    /// How the tool moves to it.
    pub feed: ClFeed,
}

/// The tool of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClTool {
    /// Number.
    pub number: u32,
    /// mm.
    pub diameter_mm: f64,
    /// mm: half the diameter for a ball.
    pub corner_radius_mm: f64,
    /// mm, where known.
    pub length_mm: Option<f64>,
    /// Spindle, 1/min, clockwise.
    pub rpm: f64,
}

/// CL data of a path: PARTNO to FINI, millimetres, eight decimals (vectors: twelve).
pub fn cl_text(name: &str, tool: &ClTool, points: &[ClPoint]) -> String {
    let mm = |value: f64| number(value, 8, false);
    let plain: String = name
        .chars()
        .map(|c| if c.is_ascii_graphic() && c != '$' { c } else { ' ' })
        .collect();
    let mut text = format!("PARTNO {plain}\nUNITS/MM\nMULTAX/ON\n");
    let _ = writeln!(text, "CUTTER/{},{}", mm(tool.diameter_mm), mm(tool.corner_radius_mm));
    let _ = write!(text, "LOADTL/{}", tool.number);
    if let Some(length) = tool.length_mm {
        let _ = write!(text, ",LENGTH,{}", mm(length));
    }
    let _ = writeln!(text, "\nSPINDL/{},RPM,CLW", mm(tool.rpm));
    let mut feed = None;
    for point in points {
        match point.feed {
            ClFeed::Rapid => text.push_str("RAPID\n"),
            ClFeed::PerMinute(value) if feed != Some(value) => {
                feed = Some(value);
                let _ = writeln!(text, "FEDRAT/{},MMPM", mm(value));
            }
            ClFeed::PerMinute(_) => {}
        }
        let (tip, axis) = (point.tip, point.axis / point.axis.norm());
        let part = |value: f64| number(value, 12, false);
        let _ = writeln!(
            text,
            "GOTO/{},{},{},$\n{},{},{}",
            mm(tip.x),
            mm(tip.y),
            mm(tip.z),
            part(axis.x),
            part(axis.y),
            part(axis.z)
        );
    }
    text.push_str("SPINDL/OFF\nFINI\n");
    text
}
