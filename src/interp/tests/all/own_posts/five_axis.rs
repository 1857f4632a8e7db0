//! The five-axis part: X Y Z of the tip with A and C, in styles that the tests of the whole program do not have.
use super::{plain, run_posted};
use crate::support::{run_bytes, shared};
use trunnion_interp::{Motion, MotionKind, Setup};

/// Targets that are compared: the tool turns more than twice in them.
const TARGETS: usize = 4000;

/// A target: X Y Z A C, and the feed word that belongs to it (`None`: rapid).
#[derive(Clone, Copy, Debug)]
struct Target {
    place: [f64; 5],
    feed: Option<f64>,
}

const AXES: [usize; 5] = [0, 1, 2, 3, 5];
const LETTERS: [char; 5] = ['X', 'Y', 'Z', 'A', 'C'];

fn targets(motions: &[Motion]) -> Vec<Target> {
    let led = motions.iter().filter(|motion| motion.tcp);
    led.filter_map(|motion| {
        let place = AXES.map(|axis| motion.end.get(axis));
        let place = place
            .iter()
            .all(Option::is_some)
            .then(|| place.map(Option::unwrap_or_default))?;
        let feed = match (motion.kind, motion.feed) {
            (MotionKind::Rapid, _) => None,
            (_, trunnion_interp::Feed::PerMinute(feed)) => Some(feed),
            _ => return None,
        };
        Some(Target { place, feed })
    })
    .take(TARGETS)
    .collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Ends {
    Changed,
    All,
    /// IX IY IZ IA IC, or G91.
    Incremental,
    /// C between 0 and 360 and the shorter way.
    ShorterWay,
}

#[derive(Clone, Copy)]
struct Style {
    name: &'static str,
    on: &'static str,
    off: &'static str,
    /// The word that switches stands in the block of the first motion.
    in_motion: bool,
    ends: Ends,
    /// C before A before X.
    backwards: bool,
}

const KLARTEXT: [Style; 6] = [
    Style {
        name: "M128 in the first motion, all axes",
        on: "M128",
        off: "M129",
        in_motion: true,
        ends: Ends::All,
        backwards: false,
    },
    Style {
        name: "L M128 F, increments",
        on: "L M128 F5000",
        off: "L M129",
        in_motion: false,
        ends: Ends::Incremental,
        backwards: false,
    },
    Style {
        name: "TCPM, rotary words first",
        on: "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP",
        off: "FUNCTION RESET TCPM",
        in_motion: false,
        ends: Ends::Changed,
        backwards: true,
    },
    Style {
        name: "M126 and C modulo 360",
        on: "M126\nM128",
        off: "M129\nM127",
        in_motion: false,
        ends: Ends::ShorterWay,
        backwards: false,
    },
    Style {
        name: "TCPM with VECTOR",
        on: "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR",
        off: "FUNCTION RESET TCPM",
        in_motion: false,
        ends: Ends::Changed,
        backwards: false,
    },
    Style {
        name: "F CONT is said, the places are known",
        on: "FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS",
        off: "FUNCTION RESET TCPM",
        in_motion: false,
        ends: Ends::Changed,
        backwards: false,
    },
];

const OKUMA: [Style; 4] = [
    Style {
        name: "G169 H in a block of its own",
        on: "G169 H1",
        off: "G170",
        in_motion: false,
        ends: Ends::Changed,
        backwards: false,
    },
    Style {
        name: "G169 H in the first motion, all axes",
        on: "G169 H1",
        off: "G170",
        in_motion: true,
        ends: Ends::All,
        backwards: false,
    },
    Style {
        name: "G169 under G91",
        on: "G169 H1",
        off: "G170",
        in_motion: false,
        ends: Ends::Incremental,
        backwards: false,
    },
    Style {
        name: "rotary words first",
        on: "G169 H1",
        off: "G170",
        in_motion: false,
        ends: Ends::Changed,
        backwards: true,
    },
];

impl Style {
    /// The axis words from one target to the next.
    fn words(&self, from: Option<&Target>, to: &Target, klartext: bool) -> String {
        let mut words = Vec::new();
        for (at, letter) in LETTERS.into_iter().enumerate() {
            let before = from.map(|from| from.place[at]);
            let value = to.place[at];
            if self.ends != Ends::All && before.is_some_and(|before| (before - value).abs() < 1e-9) {
                continue;
            }
            words.push(match (self.ends, before) {
                (Ends::Incremental, Some(before)) if klartext => format!("I{letter}{}", plain(value - before)),
                (Ends::Incremental, Some(before)) => format!("{letter}{}", plain(value - before)),
                (Ends::ShorterWay, _) if letter == 'C' => format!("C{}", plain(value.rem_euclid(360.0))),
                _ => format!("{letter}{}", plain(value)),
            });
        }
        if self.backwards {
            words.reverse();
        }
        words.join(" ")
    }

    fn klartext(&self, targets: &[Target]) -> String {
        let first = &targets[0];
        let [.., a, c] = first.place.map(plain);
        let mut out = format!("0 BEGIN PGM PART MM\n1 TOOL CALL 1 Z S5093\n2 M3\nL A{a} C{c} R0 FMAX\n");
        if !self.in_motion {
            out += &format!("{}\n", self.on);
        }
        let mut feed = None;
        for (at, target) in targets.iter().enumerate() {
            let from = at.checked_sub(1).map(|at| &targets[at]);
            out += &format!("{} L {}", at + 3, self.words(from, target, true));
            match target.feed {
                None => out += " FMAX",
                Some(value) if feed != Some(value) => {
                    out += &format!(" F{}", plain(value));
                    feed = Some(value);
                }
                Some(_) => {}
            }
            if at == 0 && self.in_motion {
                out += &format!(" {}", self.on);
            }
            out.push('\n');
        }
        out + self.off + "\nL M30\nEND PGM PART MM\n"
    }

    fn okuma(&self, targets: &[Target]) -> String {
        let [.., a, c] = targets[0].place.map(plain);
        let mut out = format!("$PART.MIN%\nO1\nG15 H1\nT1 M6\nS5093 M3\nG90 G94 G17\nG0 A{a} C{c}\n");
        if !self.in_motion {
            out += &format!("{}\n", self.on);
        }
        let (mut feed, mut rapid) = (None, true);
        for (at, target) in targets.iter().enumerate() {
            let from = at.checked_sub(1).map(|at| &targets[at]);
            let mut words = Vec::new();
            if at == 0 && self.in_motion {
                words.push(self.on.to_owned());
            }
            if target.feed.is_none() != rapid || at == 0 {
                rapid = target.feed.is_none();
                words.push(if rapid { "G0" } else { "G1" }.to_owned());
            }
            words.push(self.words(from, target, false));
            if let Some(value) = target.feed.filter(|_| feed != target.feed) {
                words.push(format!("F{}", plain(value)));
                feed = Some(value);
            }
            out += &format!("{}\n", words.join(" "));
            if at == 0 && self.ends == Ends::Incremental {
                out += "G91\n";
            }
        }
        out + "G90\n" + self.off + "\nM2\n"
    }
}

fn source() -> Option<Vec<Target>> {
    let bytes = shared("four-controls/siemens/5X_Milling.mpf")?;
    let text = String::from_utf8_lossy(&bytes);
    let some: Vec<&str> = text.lines().take(TARGETS + 100).collect();
    let some = some.join("\n");
    let found = targets(
        &run_bytes("sinumerik-840d", some.as_bytes(), &Setup::default())
            .1
            .motions,
    );
    assert!(found.len() > TARGETS - 100, "{}", found.len());
    Some(found)
}

fn compare(style: &Style, wanted: &[Target], found: &[Target]) {
    assert_eq!(wanted.len(), found.len(), "{}", style.name);
    // C modulo 360 begins within the first turn, and goes on from there
    let whole = wanted[0].place[4] - found[0].place[4];
    assert!(
        (whole / 360.0 - (whole / 360.0).round()).abs() < 1e-9,
        "{}: {whole}",
        style.name
    );
    assert!(
        style.ends == Ends::ShorterWay || whole == 0.0,
        "{}: {whole}",
        style.name
    );
    for (at, (wanted, found)) in wanted.iter().zip(found).enumerate() {
        let mut place = found.place;
        place[4] += whole;
        let near = wanted
            .place
            .iter()
            .zip(place)
            .all(|(one, two)| (one - two).abs() < 1e-6);
        let feed = wanted.feed == found.feed;
        assert!(near && feed, "{}, target {at}: {wanted:?} and {found:?}", style.name);
    }
}

#[test]
fn the_five_axis_part_in_klartext() {
    let Some(wanted) = source() else { return };
    for style in &KLARTEXT {
        let text = style.klartext(&wanted);
        let motions = run_posted("heidenhain-klartext", style.name, &text, &["F CONT: what F means"]);
        compare(style, &wanted, &targets(&motions));
    }
}

#[test]
fn the_five_axis_part_for_an_okuma() {
    let Some(wanted) = source() else { return };
    for style in &OKUMA {
        let text = style.okuma(&wanted);
        let motions = run_posted("okuma-osp", style.name, &text, &[]);
        compare(style, &wanted, &targets(&motions));
    }
}
