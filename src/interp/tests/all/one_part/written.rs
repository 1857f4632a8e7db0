//! A part in the words of each control.
use super::numbers::{euler, number};
use super::part::{Hole, Holes, Op, PECK_CLEARANCE, Part, SHIFTS};

/// A control for which parts are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Control {
    Klartext,
    Siemens,
    Fanuc,
    Okuma,
}

pub(super) const ALL: [Control; 4] = [Control::Klartext, Control::Siemens, Control::Fanuc, Control::Okuma];

const LETTERS: [char; 3] = ['X', 'Y', 'Z'];
const CENTRES: [char; 3] = ['I', 'J', 'K'];

impl Control {
    pub(super) fn dialect(self) -> &'static str {
        match self {
            Self::Klartext => "heidenhain-klartext",
            Self::Siemens => "sinumerik-840d",
            Self::Fanuc => "fanuc-30i",
            Self::Okuma => "okuma-osp",
        }
    }

    pub(super) fn write(self, part: &Part) -> String {
        let mut out = Writer {
            control: self,
            text: String::new(),
            names: 0,
        };
        out.program(part);
        out.text
    }
}

struct Writer {
    control: Control,
    text: String,
    /// Labels that were given.
    names: u32,
}

impl Writer {
    fn n(&self, value: f64) -> String {
        number(self.control, value)
    }
    fn line(&mut self, text: &str) {
        self.text += text;
        self.text.push('\n');
    }
    /// `X1 Y2 Z3`.
    fn place(&self, place: &[(usize, f64)]) -> String {
        let words = place
            .iter()
            .map(|(axis, value)| format!("{}{}", LETTERS[*axis], self.n(*value)));
        words.collect::<Vec<_>>().join(" ")
    }

    fn program(&mut self, part: &Part) {
        let speed = Part::SPEED;
        match self.control {
            Control::Klartext => {
                self.line(&format!("0 BEGIN PGM PART MM\nTOOL CALL 1 Z S{speed}\nM3"));
                self.ops(&part.ops);
                self.line("M30\nLBL 99");
                self.ops(&part.subprogram);
                self.line("LBL 0\nEND PGM PART MM");
            }
            Control::Siemens => {
                self.line(&format!("G17 G40 G54 G71 G90 G94\nS{speed} M3\nGOTOF BEGIN\nSUBA:"));
                self.ops(&part.subprogram);
                self.line("SUBE:\nBEGIN:");
                self.ops(&part.ops);
                self.line("M30");
            }
            Control::Fanuc => {
                self.line(&format!("%\nO0001\nG17 G21 G40 G49 G54 G80 G90 G94\nS{speed} M3"));
                self.ops(&part.ops);
                self.line("M30\nO1000");
                self.ops(&part.subprogram);
                self.line("M99\n%");
            }
            Control::Okuma => {
                self.line(&format!("$PART.MIN%\nG15 H1\nG17 G40 G80 G90 G94\nS{speed} M3"));
                self.ops(&part.ops);
                self.line("M02\nOSUB");
                self.ops(&part.subprogram);
                self.line("RTS");
            }
        }
    }

    fn ops(&mut self, ops: &[Op]) {
        for op in ops {
            self.op(op);
        }
    }

    fn op(&mut self, op: &Op) {
        match op {
            Op::Line(to, feed) => self.go(&[(0, to[0]), (1, to[1]), (2, to[2])], *feed),
            Op::Axis(axis, to, feed) => self.go(&[(*axis, *to)], Some(*feed)),
            Op::Arc {
                plane,
                centre,
                from,
                end,
                left,
                feed,
            } => self.arc(*plane, [*centre, *from, *end], None, *left, *feed),
            Op::Helix {
                centre,
                from,
                end,
                degrees,
                rise,
                z,
                feed,
            } => {
                if self.control == Control::Klartext {
                    let (x, y, turn, rise) = (self.n(centre[0]), self.n(centre[1]), self.n(*degrees), self.n(*rise));
                    let sign = if *degrees > 0.0 { '+' } else { '-' };
                    self.line(&format!("CC X{x} Y{y}\nCP IPA{turn} IZ{rise} DR{sign} F{feed}"));
                } else {
                    self.arc(0, [*centre, *from, *end], Some(*z), *degrees > 0.0, *feed);
                }
            }
            Op::Holes(holes) => self.holes(holes),
            Op::Loop {
                times,
                from,
                step,
                depth,
                feed,
            } => self.repeated(*times, *from, [*step, *depth, *feed]),
            Op::Call => self.line(match self.control {
                Control::Klartext => "CALL LBL 99",
                Control::Siemens => "REPEAT SUBA SUBE",
                Control::Fanuc => "M98 P1000",
                Control::Okuma => "CALL OSUB",
            }),
            Op::Shifted(index, inside) => self.shifted(*index, inside),
            Op::Tilted(angles, inside) => self.tilted(*angles, inside),
        }
    }

    fn go(&mut self, place: &[(usize, f64)], feed: Option<f64>) {
        let place = self.place(place);
        let line = match (self.control, feed) {
            (Control::Klartext, None) => format!("L {place} R0 FMAX"),
            (Control::Klartext, Some(feed)) => format!("L {place} F{feed}"),
            (_, None) => format!("G0 {place}"),
            (_, Some(feed)) => format!("G1 {place} F{}", self.n(feed)),
        };
        self.line(&line);
    }

    /// `places`: centre, start and end in the plane.
    fn arc(&mut self, plane: usize, places: [[f64; 2]; 3], height: Option<f64>, left: bool, feed: f64) {
        let [centre, from, end] = places;
        let axes = [plane, (plane + 1) % 3];
        let mut to = vec![(axes[0], end[0]), (axes[1], end[1])];
        to.extend(height.map(|height| (2, height)));
        let to = self.place(&to);
        if self.control == Control::Klartext {
            let middle = self.place(&[(axes[0], centre[0]), (axes[1], centre[1])]);
            let sign = if left { '+' } else { '-' };
            self.line(&format!("CC {middle}\nC {to} DR{sign} F{feed}"));
            return;
        }
        let arm = |index: usize| format!("{}{}", CENTRES[axes[index]], self.n(centre[index] - from[index]));
        let code = if left { "G3" } else { "G2" };
        let line = format!("{code} {to} {} {} F{}", arm(0), arm(1), self.n(feed));
        // G17 XY, G19 YZ, G18 ZX
        match plane {
            0 => self.line(&line),
            1 => self.line(&format!("G19\n{line}\nG17")),
            _ => self.line(&format!("G18\n{line}\nG17")),
        }
    }

    fn holes(&mut self, holes: &Holes) {
        let Holes {
            surface,
            clearance,
            depth,
            level,
            feed,
            ..
        } = *holes;
        let pitch_feed = |pitch: f64| pitch * Part::SPEED;
        let begin = match (self.control, holes.kind) {
            (Control::Okuma, _) | (Control::Fanuc, Hole::Peck(_)) => return self.by_steps(holes),
            (Control::Klartext, kind) => {
                let (number, own) = match kind {
                    Hole::Drill(dwell) => (
                        200,
                        format!("Q206={feed} ~\n Q202={depth} ~\n Q210=0 ~\n Q211={dwell} ~\n"),
                    ),
                    Hole::Peck(step) => (200, format!("Q206={feed} ~\n Q202={step} ~\n Q210=0 ~\n Q211=0 ~\n")),
                    Hole::Ream => (201, format!("Q206={feed} ~\n Q211=0 ~\n Q208={feed} ~\n")),
                    Hole::Tap(pitch) => (207, format!("Q239={pitch} ~\n")),
                };
                let depth = self.n(-depth);
                let (surface, second) = (self.n(surface), self.n(level - surface));
                format!(
                    "CYCL DEF {number} H ~\n Q200={clearance} ~\n Q201={depth} ~\n {own} Q203={surface} ~\n Q204={second}"
                )
            }
            (Control::Siemens, kind) => {
                let levels = format!(
                    "{},{},{},{}",
                    self.n(level),
                    self.n(surface),
                    self.n(clearance),
                    self.n(surface - depth)
                );
                let call = match kind {
                    Hole::Drill(0.0) => format!("CYCLE81({levels})"),
                    Hole::Drill(dwell) => format!("CYCLE82({levels},,{dwell})"),
                    Hole::Ream => format!("CYCLE85({levels},,0,{feed},{feed})"),
                    Hole::Tap(pitch) => format!("CYCLE84({levels},,0,3,,{pitch},0,{0},{0})", Part::SPEED),
                    Hole::Peck(step) => format!("CYCLE83({levels},,,{step},0,0,0,1,1,0,0,0,0,{PECK_CLEARANCE})"),
                };
                format!("F{feed}\nMCALL {call}")
            }
            (Control::Fanuc, kind) => {
                let [x, y] = holes.places[0];
                let place = self.place(&[(0, x), (1, y), (2, surface - depth)]);
                let (code, own, feed) = match kind {
                    Hole::Drill(0.0) => ("G81", String::new(), feed),
                    Hole::Drill(dwell) => ("G82", format!(" P{:.0}", dwell * 1000.0), feed),
                    Hole::Ream => ("G85", String::new(), feed),
                    Hole::Tap(pitch) => ("G84", String::new(), pitch_feed(pitch)),
                    Hole::Peck(_) => unreachable!("by steps"),
                };
                format!(
                    "G98 {code} {place} R{}{own} F{}",
                    self.n(surface + clearance),
                    self.n(feed)
                )
            }
        };
        self.line(&begin);
        if self.control == Control::Klartext {
            self.line("CYCL CALL");
        }
        for (index, [x, y]) in holes.places.iter().enumerate() {
            let place = self.place(&[(0, *x), (1, *y)]);
            match self.control {
                Control::Klartext if index > 0 => self.line(&format!("L {place} FMAX M99")),
                Control::Fanuc if index > 0 => self.line(&place),
                Control::Siemens => self.line(&format!("G0 {place}")),
                _ => {}
            }
        }
        match self.control {
            Control::Siemens => self.line("MCALL"),
            Control::Fanuc => self.line("G80"),
            _ => {}
        }
    }

    /// The motions of a cycle, one by one.
    fn by_steps(&mut self, holes: &Holes) {
        let bottom = holes.surface - holes.depth;
        let start = holes.surface + holes.clearance;
        for [x, y] in &holes.places {
            self.go(&[(0, *x), (1, *y)], None);
            self.go(&[(2, start)], None);
            let (feed, dwell, out) = match holes.kind {
                Hole::Drill(dwell) => (holes.feed, dwell, None),
                Hole::Ream => (holes.feed, 0.0, Some(holes.feed)),
                Hole::Tap(pitch) => (pitch * Part::SPEED, 0.0, Some(pitch * Part::SPEED)),
                Hole::Peck(step) => {
                    let mut depth = holes.surface - step;
                    while depth > bottom + 1e-9 {
                        self.go(&[(2, depth)], Some(holes.feed));
                        self.go(&[(2, start)], None);
                        self.go(&[(2, depth + PECK_CLEARANCE)], None);
                        depth -= step;
                    }
                    (holes.feed, 0.0, None)
                }
            };
            self.go(&[(2, bottom)], Some(feed));
            if dwell > 0.0 {
                self.line(&format!("G4 F{}", self.n(dwell)));
            }
            if let Some(feed) = out {
                self.go(&[(2, start)], Some(feed));
            }
            self.go(&[(2, holes.level)], None);
        }
    }

    fn repeated(&mut self, times: u32, from: [f64; 3], [step, depth, feed]: [f64; 3]) {
        self.names += 1;
        let name = self.names;
        self.go(&[(0, from[0]), (1, from[1]), (2, from[2])], None);
        let (x, step) = (self.n(from[0]), self.n(step));
        let control = self.control;
        match control {
            Control::Klartext => {
                let begin = format!("Q1 = 0\nLBL {name}\nFN 3: Q2 = +Q1 * {step}\nFN 1: Q2 = +Q2 + {x}\nL X+Q2 FMAX");
                self.line(&begin);
            }
            Control::Siemens => self.line(&format!("R1=0\nWHILE R1<{times}\nG0 X={x}+R1*{step}")),
            Control::Fanuc => self.line(&format!("#1=0\nWHILE[#1LT{times}]DO1\nG0 X[{x}+#1*{step}]")),
            Control::Okuma => self.line(&format!("V1=0\nNL{name} G0 X={x}+V1*{step}")),
        }
        self.go(&[(2, from[2] - depth)], Some(feed));
        self.go(&[(2, from[2])], None);
        match control {
            Control::Klartext => {
                self.line("Q1 = Q1 + 1");
                if times > 1 {
                    self.line(&format!("CALL LBL {name} REP {}", times - 1));
                }
            }
            Control::Siemens => self.line("R1=R1+1\nENDWHILE"),
            Control::Fanuc => self.line("#1=#1+1\nEND1"),
            Control::Okuma => self.line(&format!("V1=V1+1\nIF [V1 LT {times}] GOTO NL{name}")),
        }
    }

    fn shifted(&mut self, index: usize, inside: &[Op]) {
        let [x, y, z] = SHIFTS[index];
        let words = self.place(&[(0, x), (1, y), (2, z)]);
        let (on, off) = match self.control {
            Control::Klartext => {
                let shift = |x: &str, y: &str, z: &str| {
                    format!("CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X{x}\nCYCL DEF 7.2 Y{y}\nCYCL DEF 7.3 Z{z}")
                };
                (shift(&self.n(x), &self.n(y), &self.n(z)), shift("+0", "+0", "+0"))
            }
            // a work offset under a swivelled plane: how CYCLE800 and TRANS go together is not followed
            Control::Siemens | Control::Fanuc if inside.iter().any(|op| matches!(op, Op::Tilted(..))) => {
                (format!("G{}", 54 + index), "G54".to_owned())
            }
            Control::Siemens => (format!("TRANS {words}"), "TRANS".to_owned()),
            Control::Fanuc => (format!("G52 {words}"), "G52 X0. Y0. Z0.".to_owned()),
            Control::Okuma => (format!("G15 H{}", index + 1), "G15 H1".to_owned()),
        };
        self.line(&on);
        self.ops(inside);
        self.line(&off);
    }

    fn tilted(&mut self, angles: [f64; 3], inside: &[Op]) {
        let [a, b, c] = angles;
        let (on, off) = match self.control {
            Control::Klartext => (
                format!("PLANE SPATIAL SPA{} SPB{} SPC{} STAY", self.n(a), self.n(b), self.n(c)),
                "PLANE RESET STAY",
            ),
            Control::Siemens => (
                format!(
                    "CYCLE800(0,\"T\",0,27,0,0,0,{},{},{},0,0,0,0)",
                    self.n(c),
                    self.n(b),
                    self.n(a)
                ),
                "CYCLE800()",
            ),
            Control::Fanuc => {
                let [i, j, k] = euler(angles);
                (format!("G68.2 X0. Y0. Z0. I{i:.12} J{j:.12} K{k:.12}"), "G69")
            }
            Control::Okuma => unreachable!("no source states a tilted plane of an Okuma"),
        };
        self.line(&on);
        self.ops(inside);
        self.line(off);
    }
}
