//! Arcs as CATIA writes them: INDIRV/i,j,k, then TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z): the tool end stays on the circle, begins in
//! the direction of the vector, and stops at the line; `2,INTOF` before the line: where it meets it for the second time.
//!
//! Source: ISO 4342 (APT language): TLON, GOFWD, INDIRV, ON, INTOF. A circle lies in a plane of constant z.
use crate::apt::{Apt, Circle};
use crate::core::Report;
use crate::{FaultKind, Motion};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::atan2;
use trunnion_syntax::{Record, TextRange};

/// Points and directions that differ by less are one, as a part of the radius.
const SAME: f64 = 1e-6;

/// What the record says, in its coordinates.
struct Drive {
    /// x, y, z, r.
    circle: [f64; 4],
    line: [[f64; 3]; 2],
    /// At which crossing of the line the motion ends.
    crossing: usize,
}

/// A record without blanks and continuations, in upper case.
fn packed(record: &Record<'_>) -> String {
    let text = record.program.text(record.range).to_ascii_uppercase();
    let lines = text.lines().map(|line| line.split('$').next().unwrap_or_default());
    lines
        .flat_map(str::chars)
        .filter(|sign| !sign.is_whitespace())
        .collect()
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut values = [0.0; N];
    let mut parts = text.split(',');
    for value in &mut values {
        *value = parts.next()?.parse().ok().filter(|value: &f64| value.abs() < 1e12)?;
    }
    parts.next().is_none().then_some(values)
}

impl Drive {
    fn read(record: &Record<'_>) -> Option<Self> {
        let text = packed(record);
        let (circle, rest) = text.strip_prefix("TLON,GOFWD/(CIRCLE/")?.split_once("),ON,")?;
        let (crossing, rest) = match rest.strip_prefix("2,INTOF,") {
            Some(rest) => (2, rest),
            None => (1, rest.strip_prefix("1,INTOF,").unwrap_or(rest)),
        };
        let line: [f64; 6] = numbers(rest.strip_prefix("(LINE/")?.strip_suffix(')')?)?;
        let [a, b, c, d, e, f] = line;
        Some(Self {
            circle: numbers(circle)?,
            line: [[a, b, c], [d, e, f]],
            crossing,
        })
    }
}

impl Apt<'_> {
    /// TLON: an arc to where the circle meets the line.
    pub(crate) fn drive_circle(&mut self, record: &Record<'_>, report: &mut Report<'_>) -> Option<Motion> {
        let direction = self.kept.direction.take();
        let end = Drive::read(record)
            .zip(direction)
            .and_then(|(drive, direction)| self.drive_end(&drive, direction));
        let Some((end, circle)) = end else {
            let what = "TLON: a motion along a surface, or one whose end does not follow from a circle and a line";
            report.fault(record.range, FaultKind::NotModelled { what: what.to_owned() });
            self.kept.circle = None;
            return Some(self.unknown_goto(self.core.held_orientation(), report));
        };
        self.kept.rapid = false;
        self.kept.circle = Some(circle);
        self.go(end, None, TextRange::default(), report)
    }

    /// Where the motion ends, and its circle.
    fn drive_end(&self, drive: &Drive, direction: Vec3) -> Option<(Vec3, Circle)> {
        let unit = self.core.state.coordinates.unit_mm();
        let frame = self.kept.frame;
        let start = self.core.state.position.xyz()?;
        let [x, y, z, radius] = drive.circle.map(|value| value * unit);
        let normal = frame.vector(Vec3::z());
        let centre = frame.point(Vec3::new(x, y, z));
        let centre = centre + normal * (start - centre).dot(&normal);
        let arm = start - centre;
        let turns = direction.dot(&normal.cross(&arm));
        if radius <= 0.0 || turns.abs() <= SAME * direction.norm() * arm.norm() {
            return None;
        }
        let normal = if turns > 0.0 { normal } else { -normal };
        let level = |point: [f64; 3]| {
            let point = frame.point(Vec3::from(point) * unit) - centre;
            point - normal * point.dot(&normal)
        };
        let [from, to] = drive.line.map(level);
        let along = (to - from).try_normalize(f64::MIN_POSITIVE)?;
        let foot = from - along * from.dot(&along);
        let half = (radius * radius - foot.norm_squared()).sqrt();
        if !half.is_finite() || half <= SAME * radius {
            // the line misses the circle, or only touches it
            return None;
        }
        // the crossings in the order in which the tool comes to them
        let side = normal.cross(&arm);
        let mut crossings = [foot + along * half, foot - along * half].map(|point| {
            let turned = atan2(point.dot(&side), point.dot(&arm));
            let turned = if turned <= 0.0 {
                turned + std::f64::consts::TAU
            } else {
                turned
            };
            (turned, point)
        });
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let starts_on_it = crossings
            .iter()
            .any(|crossing| crossing.0 < SAME || crossing.0 > std::f64::consts::TAU - SAME);
        if starts_on_it {
            return None;
        }
        let circle = Circle {
            shape: Some((centre, normal)),
            radius: Some(radius),
        };
        Some((centre + crossings[drive.crossing - 1].1, circle))
    }
}
