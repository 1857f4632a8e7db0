//! Canonical calls as text, in the format of `rs274 -g`.
use crate::{Canon, Coolant, MotionMode, Plane, Pose, SpindleTurn, Stop, Switch, Units};
use std::io::{Result, Write};

/// Width of the column of sequence numbers.
const COLUMN: usize = 6;

/// Writes a listing: counts its lines.
#[derive(Clone, Copy, Debug, Default)]
pub struct Listing {
    /// Lines written so far.
    pub count: u64,
    /// Decimals of each number after those that `rs274` prints: 0 except for a closer look.
    pub more: usize,
}

impl Listing {
    /// Writes one call: usually one numbered line, sometimes none or several. `number`: digits of the sequence number of the line
    /// that made the call, `.....` where it has none.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&mut self, call: &Canon, number: &[u8], out: &mut impl Write) -> Result<()> {
        match call {
            Canon::Print(text) => {
                out.write_all(text)?;
                out.write_all(b"\n")
            }
            Canon::Comment(text) => self.quoted("COMMENT", text, number, out),
            Canon::Message(text) => self.quoted("MESSAGE", text, number, out),
            Canon::Log(text) => {
                self.number(number, out)?;
                out.write_all(text)?;
                out.write_all(b"\n")
            }
            Canon::Probe(_, pose) => {
                self.line("TURN_PROBE_ON()", number, out)?;
                self.line(&format!("STRAIGHT_PROBE({})", six(self.more, pose)), number, out)?;
                self.line("TURN_PROBE_OFF()", number, out)
            }
            Canon::ProbeResult | Canon::WaitInput { .. } => Ok(()),
            _ => self.line(&text(call, self.more), number, out),
        }
    }
    fn number(&mut self, number: &[u8], out: &mut impl Write) -> Result<()> {
        self.count += 1;
        write!(out, "{:5} N", self.count)?;
        out.write_all(number)?;
        (number.len()..COLUMN).try_for_each(|_| out.write_all(b" "))
    }
    fn line(&mut self, text: &str, number: &[u8], out: &mut impl Write) -> Result<()> {
        self.number(number, out)?;
        writeln!(out, "{text}")
    }
    fn quoted(&mut self, name: &str, text: &[u8], number: &[u8], out: &mut impl Write) -> Result<()> {
        self.number(number, out)?;
        write!(out, "{name}(\"")?;
        out.write_all(text)?;
        out.write_all(b"\")\n")
    }
}

/// X Y Z A B C with four decimals.
fn six(more: usize, pose: &Pose) -> String {
    join(more, &pose[..6], ", ")
}

fn join(more: usize, values: &[f64], between: &str) -> String {
    let texts: Vec<String> = values.iter().map(|&value| four(more, value)).collect();
    texts.join(between)
}

/// Four decimals; what is unknown is `nan`, as C prints it.
fn four(more: usize, value: f64) -> String {
    if value.is_nan() {
        "nan".to_owned()
    } else {
        format!("{value:.*}", 4 + more)
    }
}

/// The text of a call that is one line.
fn text(call: &Canon, more: usize) -> String {
    match call {
        Canon::Units(Units::Inch) => "USE_LENGTH_UNITS(CANON_UNITS_INCHES)".to_owned(),
        Canon::Units(Units::Millimetre) => "USE_LENGTH_UNITS(CANON_UNITS_MM)".to_owned(),
        Canon::G5xOffset(index, pose) => format!("SET_G5X_OFFSET({index}, {})", six(more, pose)),
        Canon::G92Offset(pose) => format!("SET_G92_OFFSET({})", six(more, pose)),
        Canon::XyRotation(angle) => format!("SET_XY_ROTATION({})", four(more, *angle)),
        Canon::FeedReference => "SET_FEED_REFERENCE(CANON_XYZ)".to_owned(),
        Canon::Reset => "ON_RESET()".to_owned(),
        Canon::Plane(plane) => format!("SELECT_PLANE(CANON_PLANE_{})", plane_name(*plane)),
        Canon::FeedRate(rate) => format!("SET_FEED_RATE({})", four(more, *rate)),
        Canon::FeedMode(spindle, mode) => format!("SET_FEED_MODE({spindle}, {mode})"),
        Canon::MotionMode(mode) => motion_mode(*mode, more),
        Canon::NaiveCamTolerance(tolerance) => format!("SET_NAIVECAM_TOLERANCE({})", four(more, *tolerance)),
        Canon::Traverse(pose) => format!("STRAIGHT_TRAVERSE({})", six(more, pose)),
        Canon::Feed(pose) => format!("STRAIGHT_FEED({})", six(more, pose)),
        Canon::Arc {
            end,
            centre,
            turns,
            axis_end,
            others,
        } => format!(
            "ARC_FEED({}, {}, {turns}, {}, {})",
            join(more, end, ", "),
            join(more, centre, ", "),
            four(more, *axis_end),
            join(more, &others[..3], ", ")
        ),
        Canon::Nurbs { points, .. } => format!("NURBS_FEED({}, ...)", points.len()),
        Canon::RigidTap(end, _) => format!("RIGID_TAP({})", join(more, end, ", ")),
        Canon::StartSync(feed) => format!(
            "START_SPEED_FEED_SYNC({:.*},{})",
            6 + more,
            feed.per_revolution,
            u8::from(feed.velocity)
        ),
        Canon::StopSync => "STOP_SPEED_FEED_SYNCH()".to_owned(),
        Canon::Dwell(seconds) => format!("DWELL({})", four(more, *seconds)),
        Canon::ToolOffset(pose) => format!(
            "USE_TOOL_LENGTH_OFFSET({}, {}, {})",
            join(more, &pose[..3], " "),
            join(more, &pose[3..6], " "),
            join(more, &pose[6..], " ")
        ),
        Canon::SetToolEntry(row, entry) => format!(
            "SET_TOOL_TABLE_ENTRY({row}, {}, {}, {}, {}, {})",
            entry.number,
            join(more, &entry.offset, " "),
            four(more, entry.front_angle),
            four(more, entry.back_angle),
            entry.orientation
        ),
        other => machine_text(other, more),
    }
}

/// Calls that switch something or stop.
fn machine_text(call: &Canon, more: usize) -> String {
    match call {
        Canon::SpindleSpeed(spindle, speed) => format!("SET_SPINDLE_SPEED({spindle}, {})", four(more, *speed)),
        Canon::SpindleMode(spindle, ceiling) => format!("SET_SPINDLE_MODE({spindle} {})", four(more, *ceiling)),
        Canon::Spindle(spindle, SpindleTurn::Clockwise) => format!("START_SPINDLE_CLOCKWISE({spindle})"),
        Canon::Spindle(spindle, SpindleTurn::CounterClockwise) => format!("START_SPINDLE_COUNTERCLOCKWISE({spindle})"),
        Canon::Spindle(spindle, SpindleTurn::Stop) => format!("STOP_SPINDLE_TURNING({spindle})"),
        Canon::OrientSpindle(spindle, angle, mode) => {
            format!("ORIENT_SPINDLE({spindle}, {}, {mode})", four(more, *angle))
        }
        Canon::WaitOrient(spindle, timeout) => {
            format!("SPINDLE.{spindle}.WAIT_ORIENT_COMPLETE({})", four(more, *timeout))
        }
        Canon::Coolant(Coolant::MistOn) => "MIST_ON()".to_owned(),
        Canon::Coolant(Coolant::MistOff) => "MIST_OFF()".to_owned(),
        Canon::Coolant(Coolant::FloodOn) => "FLOOD_ON()".to_owned(),
        Canon::Coolant(Coolant::FloodOff) => "FLOOD_OFF()".to_owned(),
        Canon::SelectTool(tool) => format!("SELECT_TOOL({tool})"),
        Canon::StartChange => "START_CHANGE()".to_owned(),
        Canon::ChangeTool { row, .. } => format!("CHANGE_TOOL({row})"),
        Canon::ChangeToolNumber { row, .. } => format!("CHANGE_TOOL_NUMBER({row})"),
        Canon::Switch(switch, on) => {
            let verb = if *on { "ENABLE" } else { "DISABLE" };
            match switch {
                Switch::FeedOverride => format!("{verb}_FEED_OVERRIDE()"),
                Switch::SpeedOverride(spindle) => format!("{verb}_SPEED_OVERRIDE({spindle})"),
                Switch::AdaptiveFeed => format!("{verb}_ADAPTIVE_FEED()"),
                Switch::FeedHold => format!("{verb}_FEED_HOLD()"),
            }
        }
        Canon::DigitalOutput { index, on, with_motion } => {
            let verb = if *on { "SET" } else { "CLEAR" };
            format!("{verb}_{}_OUTPUT_BIT({index})", output(*with_motion))
        }
        Canon::AnalogOutput {
            index,
            value,
            with_motion,
        } => format!(
            "SET_{}_OUTPUT_VALUE({index},{value:.*})",
            output(*with_motion),
            6 + more
        ),
        Canon::UserCode(code, p, q) => format!("USER_DEFINED_FUNCTION({code}, {}, {})", four(more, *p), four(more, *q)),
        Canon::Stop(Stop::Program) => "PROGRAM_STOP()".to_owned(),
        Canon::Stop(Stop::Optional) => "OPTIONAL_PROGRAM_STOP()".to_owned(),
        Canon::Stop(Stop::End) => "PROGRAM_END()".to_owned(),
        Canon::PalletShuttle => "PALLET_SHUTTLE()".to_owned(),
        Canon::ReloadTools => "RELOAD_TOOLDATA()".to_owned(),
        Canon::Finish => "FINISH()".to_owned(),
        // calls that [`Listing::write`] handles itself have no separate line
        other => format!("{other:?}"),
    }
}

fn output(with_motion: bool) -> &'static str {
    if with_motion { "MOTION" } else { "AUX" }
}

fn plane_name(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "XY",
        Plane::Xz => "XZ",
        Plane::Yz => "YZ",
        Plane::Uv | Plane::Uw | Plane::Vw => "UNKNOWN",
    }
}

fn motion_mode(mode: MotionMode, more: usize) -> String {
    match mode {
        MotionMode::ExactPath => "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)".to_owned(),
        MotionMode::ExactStop => "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)".to_owned(),
        MotionMode::Continuous(tolerance) => {
            format!("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {tolerance:.*})", 6 + more)
        }
    }
}
