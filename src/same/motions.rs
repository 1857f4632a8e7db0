//! What motions themselves have of the process.
use crate::process::Unlike;
use trunnion_interp::{Feed, Motion, Posture, Swivel, same_number};

/// A part of the process that a motion has.
#[derive(Clone, Copy)]
enum Part {
    Tool,
    ToolLength,
    MachineCoordinates,
    Turn,
    Posture,
    ToolAxis,
    Feed,
}

impl Part {
    const ALL: [Self; 7] = [
        Self::Tool,
        Self::ToolLength,
        Self::MachineCoordinates,
        Self::Turn,
        Self::Posture,
        Self::ToolAxis,
        Self::Feed,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Tool => "the tool",
            Self::ToolLength => "the active tool length",
            Self::MachineCoordinates => "machine coordinates",
            Self::Turn => "what the linear axes do in a turn",
            Self::Posture => "the requested posture",
            Self::ToolAxis => "the interpolation of the tool axis",
            Self::Feed => "the feed",
        }
    }

    fn differs(self, a: &Motion, b: &Motion) -> bool {
        match self {
            Self::Tool => a.tool != b.tool,
            Self::ToolLength => !same_number(a.tool_length_mm, b.tool_length_mm),
            Self::MachineCoordinates => a.machine_coordinates != b.machine_coordinates,
            Self::Turn => a.tilt.swivel != b.tilt.swivel,
            Self::Posture => a.tilt.posture != b.tilt.posture,
            Self::ToolAxis => a.tcp && b.tcp && a.great_circle != b.great_circle,
            Self::Feed => a.is_feed() && !same_feed(a.feed, b.feed),
        }
    }

    /// Whether the motion does not show it: what the other has may be the same.
    fn is_unknown(self, motion: &Motion) -> bool {
        match self {
            Self::Tool => motion.tool.is_none(),
            Self::ToolLength => motion.tool_length_mm.is_nan(),
            Self::ToolAxis => motion.great_circle.is_none(),
            Self::Feed => motion.feed == Feed::Unknown,
            Self::MachineCoordinates | Self::Turn | Self::Posture => false,
        }
    }

    fn said(self, motion: &Motion) -> String {
        match self {
            Self::Tool => motion.tool.map_or("unknown".to_owned(), |number| format!("T{number}")),
            Self::ToolLength if self.is_unknown(motion) => "unknown".to_owned(),
            Self::ToolLength => format!("{} mm", motion.tool_length_mm),
            Self::MachineCoordinates => if motion.machine_coordinates { "on" } else { "off" }.to_owned(),
            Self::Turn => match motion.tilt.swivel {
                Swivel::No => "no turn onto the plane",
                Swivel::AxesStay => "they stay",
                Swivel::TipStays => "they keep the tip on the part",
                Swivel::AxesLost => "they retract",
                Swivel::PointToPoint => "all axes move linearly",
            }
            .to_owned(),
            Self::Posture => posture(motion.tilt.posture),
            Self::ToolAxis => match motion.great_circle {
                Some(true) => "great circle",
                Some(false) => "linear in the axes",
                None => "as the machine does it",
            }
            .to_owned(),
            Self::Feed => feed(motion.feed),
        }
    }
}

fn posture(asked: Posture) -> String {
    match asked {
        Posture::ByRule => "the control's own".to_owned(),
        Posture::Lower => "the lower".to_owned(),
        Posture::Higher => "the higher".to_owned(),
        Posture::Numbered(number) => format!("number {number}"),
        Posture::Bits { status, turn } => {
            let bits = |name: &str, bits: Option<u16>| bits.map_or(String::new(), |bits| format!("{name}={bits} "));
            format!("{}{}", bits("STAT", status), bits("TU", turn))
                .trim_end()
                .to_owned()
        }
    }
}

/// Feed with its unit.
pub(crate) fn feed(feed: Feed) -> String {
    match feed {
        Feed::PerMinute(value) => format!("{value} mm/min"),
        Feed::PerRevolution(value) => format!("{value} mm/rev"),
        Feed::InverseTime(value) => format!("{value} 1/min"),
        Feed::Unknown => "unknown".to_owned(),
        Feed::Rapid => "rapid".to_owned(),
    }
}

/// Whether two feeds are the same setting.
fn same_feed(a: Feed, b: Feed) -> bool {
    match (a, b) {
        (Feed::PerMinute(a), Feed::PerMinute(b))
        | (Feed::PerRevolution(a), Feed::PerRevolution(b))
        | (Feed::InverseTime(a), Feed::InverseTime(b)) => same_number(a, b),
        (Feed::Unknown, Feed::Unknown) | (Feed::Rapid, Feed::Rapid) => true,
        _ => false,
    }
}

/// Which parts count that do not always do.
#[derive(Clone, Copy)]
pub(crate) struct Which {
    pub(crate) feed: bool,
    pub(crate) tool_length: bool,
    pub(crate) posture: bool,
}

impl Which {
    /// All.
    pub(crate) const ALL: Self = Self {
        feed: true,
        tool_length: true,
        posture: true,
    };
}

/// The part of the process in the motions themselves that differs and must be the same: the first that is known in both, else the first
/// that one of them does not show.
pub(crate) fn motion_difference(a: &Motion, b: &Motion, which: Which) -> Option<Unlike> {
    let counts = |part: &Part| match part {
        Part::Feed => which.feed,
        Part::ToolLength => which.tool_length,
        Part::Posture => which.posture,
        _ => true,
    };
    let mut found = Part::ALL.into_iter().filter(counts).filter(|part| part.differs(a, b));
    let first = found.next()?;
    let open = |part: Part| part.is_unknown(a) || part.is_unknown(b);
    let part = [first]
        .into_iter()
        .chain(found)
        .find(|&part| !open(part))
        .unwrap_or(first);
    Some(Unlike {
        key: part.name().to_owned(),
        from: part.said(a),
        to: part.said(b),
        is_unknown: open(part),
    })
}
