//! Holes and tilted planes of the shared parts that are posted for several controls: position, depth and kind of each hole, and the matrix of
//! each plane.
use crate::support::{run_text, shared};
use std::collections::BTreeMap;
use trunnion_interp::{Motion, MotionKind};

/// What is done in a hole, as the motions in it say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Hole {
    bottom: f64,
    /// Strokes at the feed, downwards.
    strokes: u32,
    /// Rapids out of the hole between two strokes.
    cleared: u32,
    /// Short rapids up between two strokes.
    broken: u32,
    /// The tool comes out at the feed.
    feed_out: bool,
    /// Something in it is not known.
    open: bool,
}

impl Hole {
    fn kind(&self) -> &'static str {
        match self {
            Self { open: true, .. } => "not known",
            Self { feed_out: true, .. } => "out at the feed",
            Self {
                broken: 0, cleared: 0, ..
            } => "one stroke",
            Self { broken: 0, .. } => "cleared",
            Self { cleared: 0, .. } => "chips broken",
            _ => "chips broken and cleared",
        }
    }
}

/// The holes by their places in 0.01 mm; `surface`: Z of it.
fn holes(dialect: &str, text: &str, surface: f64) -> BTreeMap<(i64, i64), Hole> {
    let mut found: BTreeMap<(i64, i64), Hole> = BTreeMap::new();
    let motions: Vec<Motion> = run_text(dialect, text).motions;
    let mut at: Option<(i64, i64)> = None;
    for motion in &motions {
        if matches!(motion.kind, MotionKind::Dwell(_)) {
            continue;
        }
        let (from, Some(to)) = (motion.start.xyz(), motion.end.xyz()) else {
            // a hole whose steps are not known
            if let (Some(place), MotionKind::Unknown) = (at, motion.kind) {
                found.entry(place).or_default().open = true;
            }
            continue;
        };
        let key = |value: f64| (value * 100.0).round() as i64;
        let place = (key(to.x), key(to.y));
        at = Some(place);
        let Some(from) = from.filter(|from| (key(from.x), key(from.y)) == place) else {
            continue;
        };
        let hole = found.entry(place).or_default();
        match motion.kind {
            MotionKind::Unknown => {
                hole.open = true;
                hole.bottom = hole.bottom.min(to.z);
            }
            MotionKind::Linear if to.z < from.z && to.z < surface => {
                hole.strokes += 1;
                hole.bottom = hole.bottom.min(to.z);
                hole.feed_out = false;
            }
            MotionKind::Linear if to.z > from.z => hole.feed_out = true,
            MotionKind::Rapid if to.z > from.z && from.z < surface => {
                if to.z > surface {
                    hole.cleared += 1;
                } else {
                    hole.broken += 1;
                }
            }
            _ => {}
        }
    }
    found.retain(|_, hole| hole.strokes > 0 || hole.open);
    for hole in found.values_mut() {
        // the last one is the way out
        hole.cleared = hole.cleared.saturating_sub(1);
    }
    found
}

#[test]
fn the_holes_are_those_of_the_other_control() {
    let (Some(klartext), Some(siemens)) = (
        shared("four-controls/heidenhain/DRILLING.H"),
        shared("four-controls/siemens/DRILLING.mpf"),
    ) else {
        return;
    };
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    let klartext = holes("heidenhain-klartext", &text(klartext), 50.0);
    let siemens = holes("sinumerik-840d", &text(siemens), 50.0);
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for (place, hole) in &siemens {
        let other = klartext.get(place).unwrap_or_else(|| panic!("no hole at {place:?}"));
        if !hole.open && !other.open {
            assert!(
                (hole.bottom - other.bottom).abs() < 2e-3,
                "{place:?}: {hole:?} and {other:?}"
            );
        }
        *kinds.entry(format!("{} / {}", hole.kind(), other.kind())).or_default() += 1;
    }
    eprintln!("{} and {} holes: {kinds:#?}", siemens.len(), klartext.len());
}

/// Each plane of a 3+2 program of the Siemens, written once more in Klartext: CYCLE800 mode 27 turns about Z, the new Y, the new X, as PLANE
/// SPATIAL does.
#[test]
fn each_plane_of_the_shared_programs_has_the_same_matrix() {
    let mut planes = 0;
    for file in [
        "four-controls/siemens/Demo_1.mpf",
        "sinumerik/CAM_TEST.MPF",
        "five-axis-pairs/sinumerik_cycle800.mpf",
    ] {
        let Some(bytes) = shared(file) else { return };
        let text = String::from_utf8_lossy(&bytes).into_owned();
        for line in text.lines() {
            let Some((_, call)) = line.split_once("CYCLE800(") else {
                continue;
            };
            let numbers: Vec<&str> = call
                .trim_end()
                .trim_end_matches(')')
                .split(',')
                .map(str::trim)
                .collect();
            let number = |place: usize| {
                numbers
                    .get(place)
                    .and_then(|text| text.parse::<f64>().ok())
                    .unwrap_or(0.0)
            };
            // the axes of the three angles by the mode
            let order: [usize; 3] = match number(3) as u32 {
                57 => [0, 1, 2],
                27 => [2, 1, 0],
                _ => continue,
            };
            let mut space = [number(7), number(8), number(9)];
            if order == [2, 1, 0] {
                space.swap(0, 2);
            } else if space.iter().filter(|angle| **angle != 0.0).count() > 1 {
                // about X first: other angles in space
                continue;
            }
            let origin = [number(4), number(5), number(6)];
            if origin != [0.0; 3] || (10..13).any(|place| number(place) != 0.0) {
                continue;
            }
            let [a, b, c] = space;
            let points = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [3.0, -4.0, 25.0]];
            let mut own = format!("G17 G90 G71 F100\nG0 X0 Y0 Z0\nCYCLE800({call}\n");
            let mut other = format!("0 BEGIN PGM A MM\nL X0 Y0 Z0 FMAX\nPLANE SPATIAL SPA{a} SPB{b} SPC{c} STAY\n");
            for [x, y, z] in points {
                own += &format!("G1 X{x} Y{y} Z{z}\n");
                other += &format!("L X{x} Y{y} Z{z} F100\n");
            }
            let ends = |dialect: &str, text: &str| -> Vec<[f64; 3]> {
                let motions = run_text(dialect, text).motions;
                motions
                    .iter()
                    .filter(|motion| motion.is_feed())
                    .map(|motion| {
                        motion
                            .end
                            .xyz()
                            .unwrap_or_else(|| panic!("{text}: an unknown end"))
                            .into()
                    })
                    .collect()
            };
            let (own, other) = (ends("sinumerik-840d", &own), ends("heidenhain-klartext", &other));
            assert_eq!((own.len(), other.len()), (4, 4), "{file}: {line}");
            for (one, two) in own.iter().zip(&other) {
                let off = (0..3).map(|i| (one[i] - two[i]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{file}: {line}: {one:?} and {two:?}");
            }
            planes += 1;
        }
    }
    eprintln!("{planes} planes");
    assert!(planes >= 5, "{planes}");
}
