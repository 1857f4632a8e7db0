//! The shared parts as posts for other controls write them: Klartext and OSP in several styles, each compared with the program of the Sinumerik,
//! target by target, plane by plane, hole by hole.
//!
//! The posts here know nothing of the interpreter: they write text from a list of places.
mod five_axis;
mod holes;
mod klartext;
mod okuma;
mod patterns;
mod planes;

use crate::support::{fault_line, run_bytes, shared};
use trunnion_geometry::Vec3;
use trunnion_interp::{Feed, Motion, MotionKind, Setup};

/// How the tool moves.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Rapid,
    Line,
    /// Centre, and sweep in degrees, positive to the left.
    Arc(Vec3, f64),
}

/// One motion of a part in the plane XY.
#[derive(Clone, Copy, Debug)]
struct Step {
    way: Way,
    from: Vec3,
    to: Vec3,
    /// mm/min; 0 for a rapid.
    feed: f64,
}

impl Step {
    fn of(motion: &Motion, from: Vec3) -> Option<Self> {
        let to = motion.end.xyz().filter(|_| !motion.machine_coordinates)?;
        let way = match motion.kind {
            MotionKind::Rapid => Way::Rapid,
            MotionKind::Linear => Way::Line,
            MotionKind::Arc(Some(arc)) => Way::Arc(arc.centre, (arc.sweep * arc.normal.z.signum()).to_degrees()),
            _ => return None,
        };
        let feed = match (way, motion.feed) {
            (Way::Rapid, _) => 0.0,
            (_, Feed::PerMinute(feed)) => feed,
            _ => f64::NAN,
        };
        Some(Self { way, from, to, feed })
    }
    fn is_still(&self) -> bool {
        !matches!(self.way, Way::Arc(..)) && (self.from - self.to).norm() < 1e-9
    }
    /// The radius of an arc about a centre: the mean of both ends.
    fn radius(&self, centre: Vec3) -> f64 {
        let of = |point: Vec3| trunnion_geometry::math::hypot(point.x - centre.x, point.y - centre.y);
        f64::midpoint(of(self.from), of(self.to))
    }
    /// The direction of the way in the plane at its start.
    fn heading(&self) -> Option<Vec3> {
        let flat = match self.way {
            Way::Arc(centre, sweep) => Vec3::z().cross(&(self.from - centre)) * sweep.signum(),
            _ => self.to - self.from,
        };
        Vec3::new(flat.x, flat.y, 0.0).try_normalize(1e-9)
    }
    /// The same at its end.
    fn heading_out(&self) -> Option<Vec3> {
        let flat = match self.way {
            Way::Arc(centre, sweep) => Vec3::z().cross(&(self.to - centre)) * sweep.signum(),
            _ => self.to - self.from,
        };
        Vec3::new(flat.x, flat.y, 0.0).try_normalize(1e-9)
    }
}

/// All motions with known places, one after the other, without those that move nothing.
fn steps(motions: &[Motion]) -> Vec<Step> {
    let mut found: Vec<Step> = Vec::new();
    for motion in motions {
        let from = found.last().map_or_else(Vec3::zeros, |step| step.to);
        let Some(step) = Step::of(motion, from) else { continue };
        if found.is_empty() || !step.is_still() {
            found.push(step);
        }
    }
    found
}

/// The steps of a shared program.
fn source(path: &str, dialect: &str) -> Option<Vec<Step>> {
    let bytes = shared(path)?;
    Some(steps(&run_bytes(dialect, &bytes, &Setup::default()).1.motions))
}

/// What no program declares.
const UNDECLARED: [&str; 2] = ["WorkOffsetUnset", "ToolLengthUnset"];

/// Runs a posted program: nothing in it is refused or unknown but what `allowed` names.
fn run_posted(dialect: &str, name: &str, text: &str, allowed: &[&str]) -> Vec<Motion> {
    let (program, log) = run_bytes(dialect, text.as_bytes(), &Setup::default());
    let told: Vec<String> = log
        .faults
        .iter()
        .map(|fault| fault_line(&program, fault))
        .filter(|fault| !allowed.iter().chain(&UNDECLARED).any(|known| fault.contains(known)))
        .take(5)
        .collect();
    assert!(
        told.is_empty(),
        "{name}: {told:#?}\n{}",
        text.lines().take(40).collect::<Vec<_>>().join("\n")
    );
    log.motions
}

/// Each step is the same: kind, end, centre, sweep, feed.
fn compare(name: &str, wanted: &[Step], found: &[Step], tolerance: f64) {
    for (at, (wanted, found)) in wanted.iter().zip(found).enumerate() {
        let same_way = match (wanted.way, found.way) {
            (Way::Arc(one, sweep), Way::Arc(two, other)) => {
                // the middle of a flat arc is known less well than its ends
                let radius = wanted.radius(one);
                let flat = Vec3::new(one.x - two.x, one.y - two.y, 0.0);
                flat.norm() <= 0.05f64.max(0.02 * radius) && (sweep - other).abs() < 1.0
            }
            (one, two) => one == two,
        };
        let near = (wanted.to - found.to).norm() <= tolerance;
        let feed = (wanted.feed - found.feed).abs() < 1e-6;
        assert!(same_way && near && feed, "{name}, step {at}: {wanted:?} and {found:?}");
    }
    assert_eq!(wanted.len(), found.len(), "{name}");
}

/// A number with up to six decimals.
fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[test]
fn the_milled_part_in_klartext() {
    let Some(wanted) = source("four-controls/siemens/2.5D_Milling.mpf", "sinumerik-840d") else {
        return;
    };
    assert!(wanted.len() > 700, "{}", wanted.len());
    for style in klartext::STYLES {
        let text = style.post(&wanted);
        let found = steps(&run_posted("heidenhain-klartext", style.name, &text, &[]));
        compare(style.name, &wanted, &found, style.tolerance);
    }
}

#[test]
fn the_milled_part_for_an_okuma() {
    let Some(wanted) = source("four-controls/siemens/2.5D_Milling.mpf", "sinumerik-840d") else {
        return;
    };
    for style in okuma::STYLES {
        let text = style.post(&wanted);
        let found = steps(&run_posted("okuma-osp", style.name, &text, &[]));
        compare(style.name, &wanted, &found, 1e-6);
    }
}

/// Whether a place lies on an arc, at its height.
fn is_on(place: Vec3, step: &Step) -> bool {
    let Way::Arc(centre, _) = step.way else { return false };
    let radius = |point: Vec3| trunnion_geometry::math::hypot(point.x - centre.x, point.y - centre.y);
    let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
    (radius(place) - radius(step.from)).abs() < 2e-3 && place.z > low - 1e-3 && place.z < high + 1e-3
}

/// The files of the folder: all places of the Fanuc program in their order, but that Klartext makes a helix or a full circle in one block.
#[test]
fn the_milled_part_of_the_folder_on_all_controls() {
    let path = |control: &str, file: &str| format!("four-controls/{control}/{file}");
    let (Some(fanuc), Some(siemens), Some(okuma), Some(klartext)) = (
        source(&path("fanuc", "2.5D_MILLING.NC"), "fanuc-30i"),
        source(&path("siemens", "2.5D_Milling.mpf"), "sinumerik-840d"),
        source(&path("okuma", "2.5D_MILLING.min"), "okuma-osp"),
        source(&path("heidenhain", "2.5D_MILLING.H"), "heidenhain-klartext"),
    ) else {
        return;
    };
    compare("Fanuc and Sinumerik", &fanuc, &siemens, 1e-3);
    compare("Fanuc and Okuma", &fanuc, &okuma, 1e-3);
    let mut left = fanuc.iter();
    let mut inside = 0;
    for step in &klartext {
        loop {
            let next = left.next().unwrap_or_else(|| panic!("nothing is left for {step:?}"));
            if (next.to - step.to).norm() < 1.5e-3 {
                break;
            }
            assert!(is_on(next.to, step), "{next:?} is left out before {step:?}");
            inside += 1;
        }
    }
    assert_eq!(left.count(), 0);
    assert!(inside > 20 && klartext.len() > 650, "{inside} {}", klartext.len());
}

/// Where each block of a program leads that names an axis: X Y Z A C, `None` where an axis is not known. Returns to the reference point, the dwells and
/// places in machine coordinates do not count.
fn targets(path: &str, dialect: &str) -> Option<Vec<[Option<f64>; 5]>> {
    let motions = run_bytes(dialect, &shared(path)?, &Setup::default()).1.motions;
    let counts = |motion: &&Motion| {
        !motion.machine_coordinates
            && matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(_))
    };
    let place = |motion: &Motion| [0, 1, 2, 3, 5].map(|axis| motion.end.get(axis));
    Some(motions.iter().filter(counts).map(place).collect())
}

/// The 761 blocks with an axis of the Fanuc program lead to the same 761 places, in their order, as those of the Sinumerik.
#[test]
fn the_milled_part_of_the_folder_has_761_targets() {
    let (Some(fanuc), Some(siemens)) = (
        targets("four-controls/fanuc/2.5D_MILLING.NC", "fanuc-30i"),
        targets("four-controls/siemens/2.5D_Milling.mpf", "sinumerik-840d"),
    ) else {
        return;
    };
    assert_eq!((fanuc.len(), siemens.len()), (761, 761));
    let mut whole = 0;
    for (at, (one, two)) in fanuc.iter().zip(&siemens).enumerate() {
        let same = one.iter().zip(two).all(|axes| match axes {
            (Some(one), Some(two)) => (one - two).abs() <= 1e-3,
            (one, two) => one.is_none() && two.is_none(),
        });
        assert!(same, "target {at}: {one:?} and {two:?}");
        whole += usize::from(one.iter().all(Option::is_some));
    }
    // before the first block with Z after each of the four tool changes, Z is not known
    assert_eq!(whole, 753);
}
