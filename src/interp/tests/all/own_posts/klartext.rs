//! A post for Klartext in the styles of CAM systems and of people at the control.
use super::{Step, Way, plain};
use trunnion_geometry::Vec3;

/// How arcs are written.
#[derive(Clone, Copy, PartialEq)]
enum Arcs {
    /// CR with its radius.
    Radius,
    /// CC and C.
    Centre,
    /// CC and CP with an incremental angle.
    Polar,
    /// CT where the arc goes on straight from the motion before, else CC and C.
    Tangent,
}

/// How ends are written.
#[derive(Clone, Copy, PartialEq)]
enum Ends {
    /// The axes that move.
    Changed,
    /// X, Y and Z in every block.
    All,
    /// IX, IY, IZ.
    Incremental,
    /// Values in Q parameters.
    Parameters,
    /// LP with PR and PA about the last pole.
    Polar,
}

/// Where the blocks stand.
#[derive(Clone, Copy, PartialEq)]
enum Frame {
    Plain,
    /// In subprograms of 100 blocks behind M30.
    Labels,
}

#[derive(Clone, Copy)]
pub(super) struct Style {
    pub(super) name: &'static str,
    pub(super) tolerance: f64,
    numbers: bool,
    comma: bool,
    plus: bool,
    rapid: &'static str,
    /// F in every block of feed.
    each_feed: bool,
    /// R0 in every line.
    each_r0: bool,
    arcs: Arcs,
    ends: Ends,
    frame: Frame,
}

const CAM: Style = Style {
    name: "numbers, comma, signs, CR",
    tolerance: 1e-6,
    numbers: true,
    comma: true,
    plus: true,
    rapid: "FMAX",
    each_feed: false,
    each_r0: false,
    arcs: Arcs::Radius,
    ends: Ends::Changed,
    frame: Frame::Plain,
};

pub(super) const STYLES: [Style; 7] = [
    CAM,
    Style {
        name: "no numbers, points, no signs, all axes, CC and C, F and R0 in every block",
        numbers: false,
        comma: false,
        plus: false,
        each_feed: true,
        each_r0: true,
        arcs: Arcs::Centre,
        ends: Ends::All,
        ..CAM
    },
    Style {
        name: "increments, CC and C, F MAX",
        comma: false,
        rapid: "F MAX",
        arcs: Arcs::Centre,
        ends: Ends::Incremental,
        ..CAM
    },
    Style {
        name: "CP about CC",
        arcs: Arcs::Polar,
        // radii at both ends of an arc differ by the last digit of the file
        tolerance: 3e-3,
        ends: Ends::All,
        ..CAM
    },
    Style {
        name: "CT, in subprograms",
        arcs: Arcs::Tangent,
        frame: Frame::Labels,
        ..CAM
    },
    Style {
        name: "Q parameters",
        comma: false,
        ends: Ends::Parameters,
        ..CAM
    },
    Style {
        name: "LP about the last pole, CC and C",
        comma: false,
        arcs: Arcs::Centre,
        ends: Ends::Polar,
        tolerance: 1e-4,
        ..CAM
    },
];

/// A program as it grows.
struct Writer<'s> {
    style: &'s Style,
    blocks: Vec<String>,
    feed: f64,
    pole: Option<Vec3>,
}

impl Style {
    fn number(&self, value: f64) -> String {
        let text = plain(value);
        let text = if self.plus && !text.starts_with('-') {
            format!("+{text}")
        } else {
            text
        };
        if self.comma { text.replace('.', ",") } else { text }
    }

    pub(super) fn post(&self, steps: &[Step]) -> String {
        let mut writer = Writer {
            style: self,
            blocks: Vec::new(),
            feed: 0.0,
            pole: None,
        };
        let mut before: Option<Step> = None;
        for step in steps {
            writer.step(step, before.as_ref());
            before = Some(*step);
        }
        let mut blocks = vec![
            "BEGIN PGM PART MM".to_owned(),
            "BLK FORM 0.1 Z X+0 Y+0 Z+0".to_owned(),
            "BLK FORM 0.2 X+252 Y+252 Z+92".to_owned(),
            "* - MILL".to_owned(),
            "TOOL CALL 1 Z S480".to_owned(),
            "M3".to_owned(),
        ];
        if self.frame == Frame::Labels {
            let parts: Vec<&[String]> = writer.blocks.chunks(100).collect();
            blocks.extend((1..=parts.len()).map(|label| format!("CALL LBL {label}")));
            blocks.push("L M30".to_owned());
            for (index, part) in parts.iter().enumerate() {
                blocks.push(format!("LBL {}", index + 1));
                blocks.extend(part.iter().cloned());
                blocks.push("LBL 0".to_owned());
            }
        } else {
            blocks.append(&mut writer.blocks);
            blocks.push("L M30".to_owned());
        }
        blocks.push("END PGM PART MM".to_owned());
        let mut text = String::new();
        for (at, block) in blocks.iter().enumerate() {
            if self.numbers {
                text += &format!("{at} ");
            }
            text += block;
            text.push('\n');
        }
        text
    }
}

impl Writer<'_> {
    fn step(&mut self, step: &Step, before: Option<&Step>) {
        match step.way {
            Way::Arc(centre, sweep) => self.arc(step, centre, sweep, before),
            way => self.line(step, way == Way::Rapid, before.is_none()),
        }
    }

    /// The end in axis words.
    fn end(&mut self, step: &Step, first: bool) -> String {
        let style = *self.style;
        let mut words = String::new();
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            let moved = (step.to[axis] - step.from[axis]).abs() > 1e-9;
            if !first && style.ends != Ends::All && !moved {
                continue;
            }
            let incremental = style.ends == Ends::Incremental && !first;
            if incremental {
                words += &format!(" I{letter}{}", style.number(step.to[axis] - step.from[axis]));
            } else if style.ends == Ends::Parameters {
                self.blocks
                    .push(format!("FN 0: Q{} = {}", axis + 1, style.number(step.to[axis])));
                words += &format!(" {letter}+Q{}", axis + 1);
            } else {
                words += &format!(" {letter}{}", style.number(step.to[axis]));
            }
        }
        words
    }

    fn feed(&mut self, feed: f64) -> String {
        let same = std::mem::replace(&mut self.feed, feed) == feed;
        if same && !self.style.each_feed {
            return String::new();
        }
        let text = plain(feed);
        format!(" F{}", if self.style.comma { text.replace('.', ",") } else { text })
    }

    fn line(&mut self, step: &Step, rapid: bool, first: bool) {
        let pole = self.pole.filter(|_| self.style.ends == Ends::Polar);
        let from_pole = pole.map(|pole| Vec3::new(step.to.x - pole.x, step.to.y - pole.y, 0.0));
        let in_plane = (step.to.z - step.from.z).abs() < 1e-9;
        let mut block = match from_pole {
            Some(arm) if in_plane && arm.norm() > 1.0 => {
                let angle = trunnion_geometry::math::atan2(arm.y, arm.x).to_degrees();
                format!("LP PR{} PA{angle:+.8}", self.style.number(arm.norm()))
            }
            _ => format!("L{}", self.end(step, first)),
        };
        if self.style.each_r0 || first {
            block += " R0";
        }
        block += &if rapid {
            format!(" {}", self.style.rapid)
        } else {
            self.feed(step.feed)
        };
        self.blocks.push(block);
    }

    fn arc(&mut self, step: &Step, centre: Vec3, sweep: f64, before: Option<&Step>) {
        let style = *self.style;
        let direction = if sweep < 0.0 { "DR-" } else { "DR+" };
        let radius = step.radius(centre);
        let full = (step.from - step.to).norm() < 1e-6;
        let feed = self.feed(step.feed);
        let tangent = before
            .and_then(Step::heading_out)
            .zip(step.heading())
            .is_some_and(|(out, on)| (out - on).norm() < 1e-3 && sweep.abs() < 300.0);
        match style.arcs {
            Arcs::Radius if !full => {
                let sign = if sweep.abs() > 180.0 { -1.0 } else { 1.0 };
                let end = self.end(step, false);
                self.blocks
                    .push(format!("CR{end} R{} {direction}{feed}", style.number(sign * radius)));
            }
            Arcs::Tangent if tangent => {
                let end = self.end(step, false);
                self.blocks.push(format!("CT{end}{feed}"));
            }
            arcs => {
                self.centre(step, centre);
                let block = if arcs == Arcs::Polar {
                    let angle = format!("{sweep:+.9}");
                    let angle = if style.comma { angle.replace('.', ",") } else { angle };
                    let rise = step.to.z - step.from.z;
                    let rise = if rise.abs() < 1e-9 {
                        String::new()
                    } else {
                        format!(" IZ{}", style.number(rise))
                    };
                    format!("CP IPA{angle}{rise} {direction}{feed}")
                } else {
                    let mut end = self.end(step, full);
                    if full && style.ends == Ends::Incremental {
                        " IX+0 IY+0".clone_into(&mut end);
                    }
                    format!("C{end} {direction}{feed}")
                };
                self.blocks.push(block);
            }
        }
    }

    fn centre(&mut self, step: &Step, centre: Vec3) {
        let style = *self.style;
        let block = if style.ends == Ends::Incremental {
            format!(
                "CC IX{} IY{}",
                style.number(centre.x - step.from.x),
                style.number(centre.y - step.from.y)
            )
        } else {
            format!("CC X{} Y{}", style.number(centre.x), style.number(centre.y))
        };
        self.blocks.push(block);
        self.pole = Some(centre);
    }
}
