//! APT motions: FROM, GOTO, GODLTA, CIRCLE, DELAY.
use crate::apt::Apt;
use crate::apt::{Args, Circle};
use crate::arc::mismatch;
use crate::core::ROTARY;
use crate::core::Report;
use crate::{Argument, Effect, FaultKind, Feed, Motion, MotionKind, Orientation, Position};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::{Arc, Turning};
use trunnion_syntax::TextRange;

impl Apt<'_> {
    /// GOTO/x,y,z[,i,j,k[,feed]].
    pub(crate) fn goto(&mut self, args: &Args, report: &mut Report<'_>) -> Option<Motion> {
        let numbers = args.numbers();
        let readable = !args.odd && args.words().is_empty() && matches!(numbers.len(), 3 | 6 | 7);
        if !readable {
            return Some(self.unreadable_goto(report));
        }
        if let Some(&feed) = numbers.get(6) {
            self.feed_without_unit(feed, report);
        }
        let unit = self.core.state.coordinates.unit_mm();
        let frame = self.kept.frame;
        let target = frame.point(Vec3::new(numbers[0], numbers[1], numbers[2]) * unit);
        let vector = (numbers.len() >= 6).then(|| frame.vector(Vec3::new(numbers[3], numbers[4], numbers[5])));
        self.go(target, vector, args.range, report)
    }

    /// GODLTA/dx,dy,dz from where the tool is; GODLTA/d along the tool axis.
    pub(crate) fn godlta(&mut self, args: &Args, report: &mut Report<'_>) -> Option<Motion> {
        let numbers = args.numbers();
        let unit = self.core.state.coordinates.unit_mm();
        let delta = match (numbers.len(), self.core.held_orientation()) {
            _ if args.odd || !args.words().is_empty() => None,
            (3, _) => Some(
                self.kept
                    .frame
                    .vector(Vec3::new(numbers[0], numbers[1], numbers[2]) * unit),
            ),
            (1, Orientation::Vector(_, axis)) => Some(axis * (numbers[0] * unit)),
            (1, Orientation::Words) => Some(self.kept.frame.tool() * (numbers[0] * unit)),
            _ => None,
        };
        match (delta, self.core.state.position.xyz()) {
            (Some(delta), Some(from)) => self.go(from + delta, None, args.range, report),
            // from unknown to unknown: the record is correct, but its effect is unknown
            (Some(_), None) => {
                let what = "GODLTA from an unknown position".to_owned();
                report.fault(report.whole(), FaultKind::NotModelled { what });
                Some(self.unknown_goto(self.core.held_orientation(), report))
            }
            (None, _) => Some(self.unreadable_goto(report)),
        }
    }

    /// FROM: the position of the tool, without a motion.
    pub(crate) fn from(&mut self, args: &Args, report: &mut Report<'_>) {
        let numbers = args.numbers();
        if args.odd || !matches!(numbers.len(), 3 | 6) {
            let what = report.program.text(report.whole()).into_owned();
            report.fault(TextRange::default(), FaultKind::NotModelled { what });
            self.core.forget_position();
            return;
        }
        let point = Vec3::new(numbers[0], numbers[1], numbers[2]) * self.core.state.coordinates.unit_mm();
        self.core.state.position = self.at(self.kept.frame.point(point));
        if numbers.len() == 6 {
            let vector = self.kept.frame.vector(Vec3::new(numbers[3], numbers[4], numbers[5]));
            self.core.state.orientation = self.core.unit_vector(vector, true, args.range, report);
            self.kept.axis_lost = self.core.state.orientation == Orientation::Words;
        } else if self.core.state.orientation == Orientation::Words
            && !self.core.state.tool_axis.multax()
            && !self.kept.axis_lost
        {
            // as for GOTO: straight along Z while MULTAX is off
            self.core.state.orientation = Orientation::Vector(None, self.kept.frame.tool());
        }
    }

    /// MULTAX, MULTAX/OFF: whether points have tool axes from here on.
    pub(crate) fn multax(&mut self, off: bool) {
        let upright = self.kept.frame.tool();
        let orientation = self.core.state.orientation;
        let tilted = matches!(orientation, Orientation::Vector(_, axis) if (axis - upright).norm() > 1e-6);
        self.kept.axis_fixed = off;
        self.kept.axis_open = off && tilted;
        self.core.state.tool_axis.set_multax(!off);
    }

    /// TLAXIS/i,j,k: the vector for what follows.
    pub(crate) fn tool_axis(&mut self, args: &Args, report: &mut Report<'_>) {
        match args.numbers() {
            &[i, j, k] if !args.odd => {
                let vector = self.kept.frame.vector(Vec3::new(i, j, k));
                let orientation = self.core.unit_vector(vector, true, args.range, report);
                // set without motion: the tool turns with the next one
                self.kept.axis = Some(orientation);
            }
            _ => {
                let what = report.program.text(report.whole()).into_owned();
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
                self.core.state.orientation = Orientation::Words;
                self.core.state.position.known &= !ROTARY;
            }
        }
    }

    /// What CIRCLE says, however it is written: centre in mm, axis of length 1, and the radius in mm, which is the distance from the centre to
    /// where the tool is if it is left out. `None`: other numbers, or that place is unknown.
    pub(crate) fn circle_as_read(&self, args: &Args) -> Option<[(&'static str, f64); 7]> {
        let unit = self.core.state.coordinates.unit_mm();
        let numbers = args.numbers();
        if args.odd || !args.words().is_empty() || !matches!(numbers.len(), 6 | 7 | 11) {
            return None;
        }
        let axis = Vec3::new(numbers[3], numbers[4], numbers[5]).try_normalize(f64::MIN_POSITIVE)?;
        let axis = self.kept.frame.vector(axis);
        let centre = self
            .kept
            .frame
            .point(Vec3::new(numbers[0], numbers[1], numbers[2]) * unit);
        let from = self.core.state.position.xyz()? - centre;
        let reached = (from - axis * from.dot(&axis)).norm();
        let radius = numbers.get(6).map_or(reached, |radius| radius * unit);
        // in whole thousandths of a mm, and nine digits of the axis: both are what programs write
        let rounded = |value: f64, steps: f64| (value * steps).round() / steps + 0.0;
        let [x, y, z, radius] = [centre.x, centre.y, centre.z, radius].map(|mm| rounded(mm, 1e3));
        let [i, j, k] = [axis.x, axis.y, axis.z].map(|part| rounded(part, 1e9));
        Some([
            ("X", x),
            ("Y", y),
            ("Z", z),
            ("I", i),
            ("J", j),
            ("K", k),
            ("radius", radius),
        ])
    }

    /// CIRCLE/x,y,z,i,j,k[,r]: centre, axis (right-hand rule) and radius of the arc that the next GOTO ends. NX writes eleven numbers: two
    /// tolerances, the diameter of the tool and its corner radius follow, which do not change the arc.
    pub(crate) fn circle(&mut self, args: &Args, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let numbers = args.numbers();
        let readable = !args.odd && args.words().is_empty() && matches!(numbers.len(), 6 | 7 | 11);
        let axis = if readable {
            Vec3::new(numbers[3], numbers[4], numbers[5])
        } else {
            Vec3::zeros()
        };
        let shape = axis.try_normalize(f64::MIN_POSITIVE).filter(|_| readable).map(|axis| {
            let centre = Vec3::new(numbers[0], numbers[1], numbers[2]) * unit;
            (self.kept.frame.point(centre), self.kept.frame.vector(axis))
        });
        if shape.is_none() {
            let what = report.program.text(report.whole()).into_owned();
            report.fault(TextRange::default(), FaultKind::NotModelled { what });
        }
        let radius = numbers.get(6).filter(|_| readable).map(|radius| radius * unit);
        self.kept.rapid = false;
        self.kept.circle = Some(Circle { shape, radius });
    }

    /// DELAY/seconds, DELAY/turns,REV.
    pub(crate) fn delay(&mut self, args: &Args, report: &mut Report<'_>) -> Motion {
        let value = args
            .numbers()
            .first()
            .copied()
            .filter(|&value| value >= 0.0 && !args.odd);
        let seconds = if args.has(report.program, "REV") {
            let rpm = self.core.state.spindle.rpm().filter(|&rpm| rpm > 0.0);
            value.zip(rpm).map(|(turns, rpm)| turns / rpm * 60.0)
        } else {
            value
        };
        let position = self.core.state.position;
        let kind = MotionKind::Dwell(seconds);
        self.core.new_motion(
            kind,
            position,
            position,
            self.core.held_orientation(),
            Feed::Unknown,
            report,
        )
    }

    pub(crate) fn at(&self, point: Vec3) -> Position {
        let mut position = self.core.state.position;
        for axis in 0..3 {
            position.set(axis, point[axis]);
        }
        position
    }

    /// A motion whose target cannot be read.
    fn unreadable_goto(&mut self, report: &mut Report<'_>) -> Motion {
        let what = report.program.text(report.whole()).into_owned();
        report.fault(TextRange::default(), FaultKind::NotModelled { what });
        self.kept.circle = None;
        self.kept.axis_lost = true;
        self.unknown_goto(Orientation::Words, report)
    }

    pub(crate) fn unknown_goto(&mut self, orientation: Orientation, report: &mut Report<'_>) -> Motion {
        let start = self.core.state.position;
        self.core.forget_position();
        self.core.state.orientation = orientation;
        let end = self.core.state.position;
        self.core
            .motion_in_frame(MotionKind::Unknown, [start, end], orientation, Feed::Unknown, report)
    }

    /// The orientation of a GOTO: its vector, else the one in effect, else straight along Z.
    fn goto_orientation(&mut self, vector: Option<Vec3>, range: TextRange, report: &mut Report<'_>) -> Orientation {
        let set = self.kept.axis.take();
        let axis_open = std::mem::take(&mut self.kept.axis_open);
        if let Some(vector) = vector {
            let now = self.core.unit_vector(vector, true, range, report);
            let is_vector = matches!(now, Orientation::Vector(..));
            if is_vector && self.core.effects.wanted() && !self.is_held(now) {
                // whether a postprocessor follows it where MULTAX/ON was not programmed is not known
                let off = !self.core.state.tool_axis.multax();
                let to: Vec<Argument> = off.then(|| Argument::code("OFF")).into_iter().collect();
                let block = self.core.main_block(report.block);
                self.core.effects.add(block, Effect::set("MULTAX", to));
            }
            if self.kept.axis_fixed && is_vector && !self.is_held(now) {
                let what = "a tool axis after MULTAX/OFF: whether the postprocessor follows it".to_owned();
                report.fault(range, FaultKind::NotModelled { what });
                return Orientation::Words;
            }
            return now;
        }
        if self.core.state.tool_axis.multax() && set.is_none() {
            report.fault(range, FaultKind::AptVectorMissing);
        }
        if axis_open && set.is_none() {
            let what = "a point without a tool axis after MULTAX/OFF: whether the tool stays tilted".to_owned();
            report.fault(range, FaultKind::NotModelled { what });
            self.kept.axis_lost = true;
            return Orientation::Words;
        }
        match (set, self.core.state.orientation) {
            (Some(orientation), _) => orientation,
            (None, Orientation::Vector(_, vector)) => Orientation::Vector(Some(vector), vector),
            (None, Orientation::Words) if self.kept.axis_lost => Orientation::Words,
            (None, Orientation::Words) => Orientation::Vector(None, self.kept.frame.tool()),
        }
    }

    /// Whether the tool is along this axis already.
    fn is_held(&self, orientation: Orientation) -> bool {
        const SAME: f64 = 1e-6;
        let before = match self.core.state.orientation {
            Orientation::Vector(_, before) => before,
            Orientation::Words if self.kept.axis_lost => return false,
            Orientation::Words => self.kept.frame.tool(),
        };
        matches!(orientation, Orientation::Vector(_, now) if (now - before).norm() < SAME)
    }

    /// The motion to a point.
    pub(crate) fn go(
        &mut self,
        target: Vec3,
        vector: Option<Vec3>,
        range: TextRange,
        report: &mut Report<'_>,
    ) -> Option<Motion> {
        let rapid = std::mem::take(&mut self.kept.rapid);
        let circle = self.kept.circle.take();
        let start = self.core.state.position;
        let orientation = self.goto_orientation(vector, range, report);
        self.kept.axis_lost = orientation == Orientation::Words;
        let cycle = self.core.state.motion == Some(Action::CannedCycle);
        self.core.tools.use_cutter();
        if cycle {
            let Some(hole) = self.kept.hole else {
                return Some(self.unknown_goto(orientation, report));
            };
            self.drill(&hole, target, orientation, report);
            return None;
        }
        let mut end = self.at(target);
        if let Orientation::Vector(..) = orientation {
            end.known &= !ROTARY;
        }
        self.core.state.position = end;
        self.core.state.orientation = orientation;
        let kind = match circle {
            Some(circle) => MotionKind::Arc(self.arc_to(&circle, start, end, report)),
            None if self.kept.rapid_unread => MotionKind::Unknown,
            None if rapid => MotionKind::Rapid,
            None => MotionKind::Linear,
        };
        self.core.state.motion = Some(if rapid { Action::Rapid } else { Action::Linear });
        let feed = match kind {
            MotionKind::Unknown => Feed::Unknown,
            kind => self.core.feed(kind, || range, report),
        };
        Some(self.core.motion_in_frame(kind, [start, end], orientation, feed, report))
    }

    fn arc_to(&self, circle: &Circle, start: Position, end: Position, report: &mut Report<'_>) -> Option<Arc> {
        let (centre, normal) = circle.shape?;
        let (start, end) = (start.xyz()?, end.xyz()?);
        let Some(arc) = Arc::from_centre(start, end, centre, normal, Turning::CounterClockwise, 0) else {
            report.fault(TextRange::default(), FaultKind::ArcCentreMissing);
            return None;
        };
        let unit = self.core.state.coordinates.unit_mm();
        let written = circle.radius.map(|radius| Arc {
            radius_start: radius,
            ..arc
        });
        let fault = mismatch(&arc, self.core.dialect, unit).or_else(|| mismatch(&written?, self.core.dialect, unit));
        if let Some(kind) = fault {
            report.fault(TextRange::default(), kind);
        }
        Some(arc)
    }
}
