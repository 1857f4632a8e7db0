//! Writes APT / CL data.
use crate::emit::plain;
use crate::job::{Coolant, Event, Job};
use crate::modal::Modal;
use crate::number::{number, significant};
use crate::plan::{Move, Out, Shape};
use crate::{Options, Refused, Units};
use trunnion_certify::conversion::Reading;
use trunnion_geometry::Vec3;
use trunnion_interp::{Feed, Tool, ToolShape};

/// Digits after the decimal point: lengths mm and inch, vectors, feeds.
pub(crate) const LENGTH: [usize; 2] = [6, 7];
pub(crate) const VECTOR: usize = 9;
pub(crate) const FEED: usize = 6;
/// Digits of an inverse time feed.
const TIME: usize = 10;

/// Records end before this column: the columns after it were for sequence numbers.
const COLUMNS: usize = 71;

/// Writes CL data.
pub(crate) struct AptWriter<'a> {
    reading: &'a Reading,
    options: &'a Options,
    text: String,
    modal: Modal,
    /// Vectors are written.
    multax: bool,
}

impl<'a> AptWriter<'a> {
    pub(crate) fn new(reading: &'a Reading, options: &'a Options, outs: &[Out]) -> Self {
        let tilts = |one: &Move| (one.axis - Vec3::z()).norm() > 1e-12;
        let multax = outs.iter().any(|out| match out {
            Out::Moves(moves) => moves.iter().any(tilts),
            Out::Left | Out::Words { .. } | Out::Dwell(_) => false,
        });
        Self {
            reading,
            options,
            text: String::new(),
            modal: Modal::default(),
            multax,
        }
    }

    /// The whole file.
    pub(crate) fn write(mut self, job: &Job, outs: &[Out]) -> Result<String, Refused> {
        let name = text(job.name.as_deref().unwrap_or("PROGRAM"));
        self.record(&format!("PARTNO {name}"));
        self.record(match self.options.units {
            Units::Mm => "UNITS/MM",
            Units::Inch => "UNITS/INCHES",
        });
        if self.multax {
            self.record("MULTAX/ON");
        }
        for placed in &job.events {
            match &placed.event {
                Event::Motion(index) => self.motion(&outs[*index]),
                Event::Tool(number) => {
                    let tool = job.tool(*number);
                    self.tool(*number, tool.and_then(|(_, tool)| tool.as_ref()));
                }
                Event::WorkOffset(_) => {}
                Event::SpindleOn(ccw, rpm) => {
                    let direction = if *ccw { "CCLW" } else { "CLW" };
                    self.record(&format!("SPINDL/{},RPM,{direction}", number(*rpm, 3, false)));
                }
                event => {
                    let record = plain_record(event).ok_or_else(|| {
                        Refused::at(
                            &self.reading.program,
                            placed.block,
                            "this has no record in APT".to_owned(),
                        )
                    })?;
                    self.record(&record);
                }
            }
        }
        if self.multax {
            self.record("MULTAX/OFF");
        }
        self.record("END");
        self.record("FINI");
        Ok(self.text)
    }

    /// A record, continued with `$` after a comma where it is long.
    fn record(&mut self, record: &str) {
        let mut rest = record;
        let textual = record.starts_with("PARTNO") || record.starts_with("PPRINT") || record.starts_with("DISPLY");
        while rest.len() > COLUMNS && !textual {
            let Some(comma) = rest[..COLUMNS - 1].rfind(',') else {
                break;
            };
            self.text.push_str(&rest[..=comma]);
            self.text.push_str("$\n");
            rest = &rest[comma + 1..];
        }
        self.text.push_str(rest);
        self.text.push('\n');
    }

    fn length(&self, mm: f64) -> String {
        let inch = self.options.units == Units::Inch;
        number(mm / self.options.units.mm(), LENGTH[usize::from(inch)], false)
    }

    fn point(&self, point: &Vec3) -> String {
        format!(
            "{},{},{}",
            self.length(point.x),
            self.length(point.y),
            self.length(point.z)
        )
    }

    fn tool(&mut self, number: u32, tool: Option<&Tool>) {
        if let Some(Tool {
            shape,
            diameter_mm: Some(diameter),
            ..
        }) = tool
        {
            let corner = match shape {
                Some(ToolShape::Ball) => Some(diameter / 2.0),
                Some(ToolShape::Bull(radius)) => Some(*radius),
                Some(ToolShape::Flat) => Some(0.0),
                Some(ToolShape::Turning(_)) | None => None,
            };
            if let Some(corner) = corner {
                self.record(&format!("CUTTER/{},{}", self.length(*diameter), self.length(corner)));
            }
        }
        match tool.and_then(|tool| tool.length_mm) {
            Some(length) => self.record(&format!("LOADTL/{number},LENGTH,{}", self.length(length))),
            None => self.record(&format!("LOADTL/{number}")),
        }
    }

    fn motion(&mut self, out: &Out) {
        match out {
            Out::Left | Out::Words { .. } => {}
            Out::Dwell(seconds) => self.record(&format!("DELAY/{}", number(*seconds, 3, false))),
            Out::Moves(moves) => {
                for one in moves {
                    self.one(one);
                }
            }
        }
    }

    fn one(&mut self, one: &Move) {
        if one.shape == Shape::Rapid {
            self.record("RAPID");
        }
        let unit = self.options.units.mm();
        let per = |mm: &str, inch: &str| if unit == 1.0 { mm.to_owned() } else { inch.to_owned() };
        let feed = match one.feed {
            Feed::PerMinute(feed) => Some(format!("{},{}", number(feed / unit, FEED, false), per("MMPM", "IPM"))),
            Feed::PerRevolution(feed) => Some(format!("{},{}", number(feed / unit, FEED, false), per("MMPR", "IPR"))),
            Feed::InverseTime(feed) => Some(format!("{},INVERS", significant(feed, TIME, false))),
            Feed::Rapid | Feed::Unknown => None,
        };
        if let Some(feed) = feed.and_then(|feed| self.modal.change("FEDRAT", format!("FEDRAT/{feed}"))) {
            self.record(&feed);
        }
        if let Shape::Arc(arc) = one.shape {
            let normal = arc.normal * arc.sweep.signum();
            let part = |value: f64| number(value, VECTOR, false);
            let record = format!(
                "CIRCLE/{},{},{},{},{}",
                self.point(&arc.centre),
                part(normal.x),
                part(normal.y),
                part(normal.z),
                self.length(arc.radius_start)
            );
            self.record(&record);
        }
        let mut record = format!("GOTO/{}", self.point(&one.xyz));
        if self.multax {
            for value in one.axis.iter() {
                record.push(',');
                record.push_str(&number(*value, VECTOR, false));
            }
        }
        self.record(&record);
    }
}

/// The record of an event that has its own record.
fn plain_record(event: &Event) -> Option<String> {
    Some(match event {
        Event::Comment(comment) => format!("PPRINT {}", text(comment)),
        Event::Message(message) => format!("DISPLY/{}", text(message)),
        Event::SpindleOff => "SPINDL/OFF".to_owned(),
        // only COOLNT/OFF exists
        Event::Coolant(Coolant::ThruOff)
        | Event::Path(_)
        | Event::Own(_)
        | Event::Tool(_)
        | Event::SpindleOn(..)
        | Event::Speed(_)
        | Event::WorkOffset(_)
        | Event::Motion(_) => return None,
        Event::Coolant(coolant) => format!(
            "COOLNT/{}",
            match coolant {
                Coolant::Flood => "FLOOD",
                Coolant::Mist => "MIST",
                Coolant::Thru => "THRU",
                Coolant::Air => "AIR",
                Coolant::ThruOff | Coolant::Off => "OFF",
            }
        ),
        Event::Stop(optional) => if *optional { "OPSTOP" } else { "STOP" }.to_owned(),
        Event::Auxiliary(number) => format!("AUXFUN/{number}"),
    })
}

/// Text for a record: `$` would end the line.
fn text(text: &str) -> String {
    plain(text).replace('$', "S")
}
