//! The drilled part: each hole at its place, to its depth, in its way, however the cycle is defined and called.
use super::plain;
use crate::four_controls::{Hole, Out, holes};
use crate::support::shared;

/// The modal cycles of the Sinumerik program and where they run.
struct Section {
    cycle: String,
    arguments: Vec<String>,
    feed: String,
    places: Vec<[f64; 2]>,
}

impl Section {
    fn number(&self, at: usize) -> f64 {
        self.arguments.get(at).and_then(|text| text.parse().ok()).unwrap_or(0.0)
    }
    /// Distance from the surface to the bottom, above 0.
    fn depth(&self) -> f64 {
        self.number(1) - self.number(3)
    }
}

/// The sections, and a Sinumerik program of nothing else.
fn sections(siemens: &str) -> (Vec<Section>, String) {
    let mut found: Vec<Section> = Vec::new();
    let mut text = String::from("G17 G40 G54 G71 G90 G94\nS295 M3\nG0 X20 Y20 Z52\n");
    let (mut feed, mut here, mut modal) = ("637".to_owned(), [20.0, 20.0], false);
    for line in siemens.lines().filter(|line| !line.starts_with(['%', ';'])) {
        let words: Vec<&str> = line.split_whitespace().filter(|word| !word.starts_with('N')).collect();
        if words.first() == Some(&"MCALL") {
            modal = words.len() > 1;
            text += &format!("{}\n", words.join(" "));
            let call = words[1..].join(" ");
            if let Some((name, inside)) = call.split_once('(') {
                let arguments = inside
                    .trim_end_matches(')')
                    .split(',')
                    .map(|word| word.trim().to_owned());
                found.push(Section {
                    cycle: name.trim().to_owned(),
                    arguments: arguments.collect(),
                    feed: feed.clone(),
                    places: Vec::new(),
                });
            }
            continue;
        }
        let (mut moves, mut level) = (false, false);
        for word in &words {
            let Ok(value) = word[1..].parse::<f64>() else { continue };
            match &word[..1] {
                "X" => (here[0], moves) = (value, true),
                "Y" => (here[1], moves) = (value, true),
                "Z" => level = true,
                "F" => {
                    word[1..].clone_into(&mut feed);
                    text += &format!("F{feed}\n");
                }
                _ => {}
            }
        }
        if modal && moves && !level {
            text += &format!("G0 X{} Y{}\n", here[0], here[1]);
            found.last_mut().expect("a cycle").places.push(here);
        }
    }
    (found, text + "M30\n")
}

/// How Klartext calls a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Call {
    /// L, CYCL CALL.
    Here,
    /// CYCL CALL at the first place, M99 at the others.
    Mixed,
    /// CYCL CALL POS.
    Position,
    /// M89 at the first place, M99 at the last.
    Modal,
    /// PATTERN DEF, CYCL CALL PAT.
    Pattern,
    /// The places of a section in a subprogram, with M99.
    Label,
    /// IX and IY with M99 from one place to the next.
    Increments,
}

/// How Klartext defines a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Define {
    /// A line for each parameter, `~` and a remark.
    Lines,
    /// All in one line.
    OneLine,
    /// Values from other parameters.
    Parameters,
}

const STYLES: [(Call, Define, bool); 8] = [
    (Call::Mixed, Define::Lines, true),
    (Call::Here, Define::OneLine, false),
    (Call::Position, Define::Lines, false),
    (Call::Modal, Define::Lines, true),
    (Call::Pattern, Define::OneLine, true),
    (Call::Pattern, Define::Lines, false),
    (Call::Label, Define::Parameters, false),
    (Call::Increments, Define::Lines, true),
];

/// Stands for MAX.
const RAPID: f64 = f64::MAX;

/// A program as it grows.
struct Writer {
    comma: bool,
    text: String,
    behind: String,
    labels: u32,
}

impl Writer {
    fn n(&self, value: f64) -> String {
        let text = plain(value);
        let text = if text.starts_with('-') {
            text
        } else {
            format!("+{text}")
        };
        if self.comma { text.replace('.', ",") } else { text }
    }

    fn line(&mut self, block: &str) {
        self.text += block;
        self.text.push('\n');
    }

    fn define(&mut self, section: &Section, define: Define) {
        let depth = section.depth();
        let feed: f64 = section.feed.parse().expect("a feed");
        let clear = section.number(2);
        let second = section.number(0) - section.number(1);
        // number and value of each parameter, in the order of the cycle manuals
        let (cycle, own): (u32, Vec<(u32, f64)>) = match section.cycle.as_str() {
            "CYCLE81" => (200, vec![(206, feed), (202, depth), (210, 0.0)]),
            "CYCLE83" if section.number(11) == 0.0 => (
                203,
                vec![
                    (206, feed),
                    (202, 2.0),
                    (210, 0.0),
                    (212, 0.0),
                    (213, 99.0),
                    (205, 0.0),
                    (208, RAPID),
                    (256, 1.0),
                ],
            ),
            "CYCLE83" => (200, vec![(206, feed), (202, 2.0), (210, 0.0)]),
            "CYCLE84" if section.arguments.len() > 13 => (209, vec![(239, 1.5), (257, 2.2), (256, 1.1), (336, 0.0)]),
            "CYCLE84" => (207, vec![(239, 1.5)]),
            "CYCLE85" => (201, vec![(206, section.number(6)), (208, section.number(7))]),
            _ => (202, vec![(206, feed), (208, RAPID), (214, 0.0), (336, 0.0)]),
        };
        let mut all = vec![(200, clear), (201, -depth)];
        all.extend(own);
        all.extend([(203, section.number(1)), (204, second), (211, 0.0)]);
        if define == Define::Parameters {
            for (at, (_, value)) in all.iter().enumerate().filter(|(_, (_, value))| *value != RAPID) {
                let value = self.n(*value);
                self.line(&format!("Q{} = {value}", at + 1));
            }
        }
        let words: Vec<String> = all
            .iter()
            .enumerate()
            .map(|(at, (number, value))| match define {
                Define::Parameters if *value != RAPID => format!("Q{number}=+Q{}", at + 1),
                _ if *value == RAPID => format!("Q{number}=MAX"),
                _ => format!("Q{number}={}", self.n(*value)),
            })
            .collect();
        let block = if define == Define::OneLine {
            format!("CYCL DEF {cycle} DRILLING {}", words.join(" "))
        } else {
            let lines: Vec<String> = words.iter().map(|word| format!("    {word} ;REMARK")).collect();
            format!("CYCL DEF {cycle} BOHREN ~\n{}", lines.join(" ~\n"))
        };
        self.line(&block);
    }

    fn call(&mut self, section: &Section, call: Call) {
        let places = &section.places;
        let last = places.len() - 1;
        if call == Call::Pattern {
            let points: Vec<String> = places
                .iter()
                .enumerate()
                .map(|(at, [x, y])| format!("    POS{} (X{} Y{} Z+0)", at + 1, self.n(*x), self.n(*y)))
                .collect();
            self.line(&format!("PATTERN DEF ~\n{}", points.join(" ~\n")));
            return self.line("CYCL CALL PAT FMAX M3");
        }
        let mut blocks = Vec::new();
        for (at, [x, y]) in places.iter().enumerate() {
            let to = format!("X{} Y{}", self.n(*x), self.n(*y));
            match call {
                Call::Here => blocks.extend([format!("L {to} R0 FMAX"), "CYCL CALL M8".to_owned()]),
                Call::Mixed if at == 0 => blocks.extend([format!("L {to} FMAX"), "CYCL CALL".to_owned()]),
                Call::Position => blocks.push(format!("CYCL CALL POS {to} Z+0 FMAX M3")),
                Call::Modal if at == last => blocks.push(format!("L {to} FMAX M99")),
                Call::Modal if at == 0 => blocks.push(format!("L {to} FMAX M89")),
                Call::Modal => blocks.push(format!("L {to} FMAX")),
                Call::Increments if at > 0 => {
                    let [a, b] = places[at - 1];
                    blocks.push(format!("L IX{} IY{} R0 F MAX M99", self.n(x - a), self.n(y - b)));
                }
                _ => blocks.push(format!("L {to} R0 FMAX M99")),
            }
        }
        if call == Call::Label {
            self.labels += 1;
            let label = self.labels;
            self.line(&format!("CALL LBL {label}"));
            self.behind += &format!("LBL {label}\n{}\nLBL 0\n", blocks.join("\n"));
        } else {
            for block in &blocks {
                self.line(block);
            }
        }
    }
}

fn klartext(sections: &[Section], (call, define, comma): (Call, Define, bool)) -> String {
    let mut writer = Writer {
        comma,
        text: "BEGIN PGM DRILL MM\nTOOL CALL 1 Z S295\nM3\nL X+20 Y+20 R0 FMAX\nL Z+52 FMAX\n".to_owned(),
        behind: String::new(),
        labels: 0,
    };
    for section in sections {
        writer.define(section, define);
        writer.call(section, call);
    }
    writer.line("L Z+52 R0 FMAX M30");
    format!("{}{}END PGM DRILL MM\n", writer.text, writer.behind)
}

/// How a post for an Okuma writes holes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Okuma {
    /// The cycle with all words in every block.
    All,
    /// Z, R and the cycle first, the places after it, values in VC.
    Variables,
    /// A subprogram of places after each cycle.
    Subprogram,
}

fn okuma(sections: &[Section], style: Okuma) -> String {
    let mut out = String::from("$DRILL.MIN%\nO0002\nG15 H1\nT1 M6\nS295 M3\nG90 G94 G17 G0 X20 Y20\nG56 H1 Z52\n");
    let mut behind = String::new();
    for (index, section) in sections.iter().enumerate() {
        let word = match section.cycle.as_str() {
            "CYCLE81" => format!("G81 F{}", section.feed),
            "CYCLE83" if section.number(11) == 0.0 => format!("G73 Q2. F{}", section.feed),
            "CYCLE83" => format!("G83 Q2. F{}", section.feed),
            "CYCLE84" => "G284 F442.5".to_owned(),
            "CYCLE85" => format!("G85 F{}", section.number(6)),
            _ => format!("G86 F{}", section.feed),
        };
        let (z, r) = (section.number(3), section.number(1) + section.number(2));
        out += &format!("G71 Z{}\n", plain(section.number(0)));
        let levels = match style {
            Okuma::Variables => {
                out += &format!("VC1={}\nVC2={}\n", plain(z), plain(r));
                "Z=VC1 R=VC2".to_owned()
            }
            _ => format!("Z{} R{}", plain(z), plain(r)),
        };
        let places = section
            .places
            .iter()
            .map(|[x, y]| format!("X{} Y{}", plain(*x), plain(*y)));
        let mut blocks: Vec<String> = places.collect();
        match style {
            Okuma::All => blocks
                .iter_mut()
                .for_each(|place| *place = format!("{word} {place} {levels} M53")),
            _ => blocks[0] = format!("{word} {} {levels} M53", blocks[0]),
        }
        if style == Okuma::Subprogram {
            let first = blocks.remove(0);
            out += &format!("{first}\nCALL OP{index}\n");
            behind += &format!("OP{index}\n{}\nRTS\n", blocks.join("\n"));
        } else {
            out += &format!("{}\n", blocks.join("\n"));
        }
        out += "G80\n";
    }
    out + "G0 Z52\nM2\n" + &behind
}

fn same_holes(name: &str, wanted: &[Hole], found: &[Hole]) {
    assert_eq!(wanted.len(), found.len(), "{name}");
    let mut alike = 0;
    for (one, two) in wanted.iter().zip(found) {
        assert_eq!(one.place, two.place, "{name}: {one:?} and {two:?}");
        assert!((one.bottom - two.bottom).abs() < 1e-9, "{name}: {one:?} and {two:?}");
        if let (Some(pitch), Some(other)) = (one.pitch, two.pitch) {
            assert!((pitch / other - 1.0).abs() < 2e-3, "{name}: {one:?} and {two:?}");
        }
        if !one.open && !two.open && one.out != Out::NotKnown && two.out != Out::NotKnown {
            assert_eq!(
                (one.way(), one.out),
                (two.way(), two.out),
                "{name}: {one:?} and {two:?}"
            );
            alike += 1;
        }
    }
    assert!(alike > 40, "{name}: {alike} holes whose way is known on both controls");
}

fn source() -> Option<(Vec<Section>, Vec<Hole>)> {
    let siemens = shared("four-controls/siemens/DRILLING.mpf")?;
    let (found, text) = sections(&String::from_utf8_lossy(&siemens));
    let wanted = holes("sinumerik-840d", &text, 50.0);
    let places: usize = found.iter().map(|section| section.places.len()).sum();
    assert_eq!((found.len(), places), (9, wanted.len()), "each place is a hole");
    Some((found, wanted))
}

#[test]
fn the_drilled_part_in_klartext() {
    let Some((sections, wanted)) = source() else { return };
    for style in STYLES {
        let text = klartext(&sections, style);
        same_holes(
            &format!("{style:?}"),
            &wanted,
            &holes("heidenhain-klartext", &text, 50.0),
        );
    }
}

#[test]
fn the_drilled_part_for_an_okuma() {
    let Some((sections, wanted)) = source() else { return };
    for style in [Okuma::All, Okuma::Variables, Okuma::Subprogram] {
        let text = okuma(&sections, style);
        same_holes(&format!("{style:?}"), &wanted, &holes("okuma-osp", &text, 50.0));
    }
}
