//! `cargo bench --bench dialects`: how many blocks each dialect parses and interprets in a second, beside the ISO core (`iso-6983`) on the same places.
//! Two programs without expressions: lines and arcs in the plane, and lines of five axes. `cargo bench --bench dialects -- 1000000` sets the blocks;
//! a word takes only the dialects that have it in their names.
//! Times are processor time, the least of some runs. Each dialect takes turns with the ISO core, and the ratio is of these runs; a dialect
//! below half the ISO core is marked. Nothing is asserted.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::env;
use std::fmt::Write;
use trunnion::dialect::{BUILTIN_NAMES, Dialect, builtin};
use trunnion::geometry::math::{cos, sin};
use trunnion::interp::{Fault, ModalState, Motion, Setup, Sink, run};
use trunnion::syntax::{Program, parse};

#[path = "support/cpu.rs"]
mod cpu;

const BLOCKS: usize = 200_000;
const RUNS: usize = 7;
const CORE: &str = "iso-6983";

/// A program of the benchmark.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// Seven lines, an arc, and so on.
    Milled,
    /// X Y Z with two rotary axes, or a tool vector.
    FiveAxis,
}

/// How a dialect writes a block.
#[derive(Clone, Copy, PartialEq)]
enum Words {
    Iso,
    Sinumerik,
    Klartext,
    Apt,
    /// X and Z.
    Turned,
}

fn words_of(dialect: &str) -> Words {
    match dialect {
        "sinumerik-840d" => Words::Sinumerik,
        "heidenhain-klartext" => Words::Klartext,
        "apt" => Words::Apt,
        name if name.contains("lathe") => Words::Turned,
        _ => Words::Iso,
    }
}

fn main() {
    let said = env::args().skip(1).find_map(|argument| argument.parse::<usize>().ok());
    let blocks = said.unwrap_or(BLOCKS);
    let wanted: Vec<String> = env::args()
        .skip(1)
        .filter(|word| word.starts_with(|first: char| first.is_ascii_lowercase()))
        .collect();
    let is_wanted = |dialect: &str| wanted.is_empty() || wanted.iter().any(|word| dialect.contains(word.as_str()));
    println!("{blocks} blocks, best of {RUNS} runs, one core\n");
    println!(
        "{:12} {:22} {:>10} {:>10} {:>12} {:>10} {:>10}",
        "program", "dialect", "us parse", "us run", "blocks/s", "x ISO", "unknown"
    );
    for (name, part) in [("milled", Part::Milled), ("five-axis", Part::FiveAxis)] {
        let mut core = Timed::new(CORE, part, blocks);
        for dialect in BUILTIN_NAMES.iter().filter(|dialect| is_wanted(dialect)) {
            let words = words_of(dialect);
            if part == Part::FiveAxis && (words == Words::Turned || *dialect == "grbl") {
                continue;
            }
            let mut other = Timed::new(dialect, part, blocks);
            core.forget();
            for _ in 0..RUNS {
                core.run_once();
                other.run_once();
            }
            let ratio = core.seconds() / other.seconds();
            println!(
                "{name:12} {dialect:22} {:>10.3} {:>10.3} {:>12.0} {ratio:>10.2} {:>10}{}",
                other.parsed / blocks as f64 * 1e6,
                other.ran / blocks as f64 * 1e6,
                blocks as f64 / other.seconds(),
                other.unknown,
                if ratio < 0.5 { "  below half the ISO core" } else { "" }
            );
        }
        println!();
    }
}

/// A program and the least seconds that parsing it and running it took.
struct Timed {
    text: Vec<u8>,
    table: &'static Dialect,
    read: Program,
    unknown: usize,
    parsed: f64,
    ran: f64,
}

impl Timed {
    fn new(dialect: &str, part: Part, blocks: usize) -> Self {
        let table = builtin(dialect).expect("built in");
        let text = program(words_of(dialect), part, blocks).into_bytes();
        let read = parse(text.clone(), table.lex);
        let mut counted = Counted::default();
        run(&read, table, &Setup::default(), &mut counted);
        let unknown = counted.unknown;
        let (parsed, ran) = (f64::INFINITY, f64::INFINITY);
        Timed {
            text,
            table,
            read,
            unknown,
            parsed,
            ran,
        }
    }

    fn forget(&mut self) {
        (self.parsed, self.ran) = (f64::INFINITY, f64::INFINITY);
    }

    fn run_once(&mut self) {
        let text = self.text.clone();
        self.parsed = self.parsed.min(cpu::once(|| parse(text, self.table.lex)));
        let setup = Setup::default();
        let run = || run(&self.read, self.table, &setup, &mut Counted::default());
        self.ran = self.ran.min(cpu::once(run));
    }

    fn seconds(&self) -> f64 {
        self.parsed + self.ran
    }
}

/// How many motions have an end that is not known: a run that stops or knows nothing would be fast.
#[derive(Default)]
struct Counted {
    unknown: usize,
}

impl Sink for Counted {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        self.unknown += usize::from(motion.end.get(0).is_none());
    }
    fn fault(&mut self, _fault: Fault) {}
}

/// The text of a program: the same places in every dialect.
fn program(words: Words, part: Part, blocks: usize) -> String {
    let mut out = String::from(match words {
        Words::Klartext => "0 BEGIN PGM BENCH MM\n1 TOOL CALL 1 Z S8000\n2 L X+0 Y+0 Z+5 R0 FMAX M3\n3 L F2000\n",
        Words::Apt => "PARTNO / BENCH\nUNITS / MM\nMULTAX / ON\nLOADTL / 1\nSPINDL / 8000, CLW\nFEDRAT / 2000, MMPM\n",
        Words::Turned => "G18\nT0101\nG97 S1000 M3\nG0 X10. Z5.\nG1 F0.2\n",
        Words::Iso | Words::Sinumerik => "G17 G90 G94\nT1 M6\nS8000 M3\nG0 X0. Y0. Z5.\nG1 F2000.\n",
    });
    let mut before = [0.0; 3];
    for at in 0..blocks {
        let k = at as f64;
        let place = [
            (at % 1000) as f64 * 0.1,
            (at / 1000) as f64 * 0.2,
            3.0 * sin(k / 170.0) * cos(k / 1300.0),
        ];
        let [x, y, z] = place;
        let arc = part == Part::Milled && at % 8 == 7 && x > before[0];
        let written = match (words, part) {
            (Words::Turned, _) => writeln!(out, "X{:.3} Z{z:.3}", 20.0 + x),
            (Words::Apt, Part::Milled) => writeln!(out, "GOTO / {x:.3}, {y:.3}, {z:.3}"),
            (Words::Apt, Part::FiveAxis) => {
                let (i, k) = (sin(k / 900.0) * 0.3, cos(k / 900.0) * 0.3);
                writeln!(
                    out,
                    "GOTO / {x:.3}, {y:.3}, {z:.3}, {i:.6}, {k:.6}, {:.6}",
                    (1.0 - i * i - k * k).sqrt()
                )
            }
            (Words::Klartext, Part::FiveAxis) => {
                writeln!(
                    out,
                    "{} L X{x:+.3} Y{y:+.3} Z{z:+.3} A{:+.3} C{:+.3}",
                    at + 4,
                    tilt(k),
                    turn(k)
                )
            }
            (_, Part::FiveAxis) => writeln!(out, "X{x:.3} Y{y:.3} Z{z:.3} A{:.3} C{:.3}", tilt(k), turn(k)),
            (Words::Klartext, Part::Milled) if arc => {
                writeln!(out, "{} CR X{x:+.3} Y{y:+.3} R+5 DR+", at + 4)
            }
            (Words::Klartext, Part::Milled) => writeln!(out, "{} L X{x:+.3} Y{y:+.3} Z{z:+.3}", at + 4),
            (Words::Sinumerik, Part::Milled) if arc => writeln!(out, "G3 X{x:.3} Y{y:.3} CR=5"),
            (_, Part::Milled) if arc => writeln!(out, "G3 X{x:.3} Y{y:.3} R5."),
            (_, Part::Milled) => writeln!(out, "G1 X{x:.3} Y{y:.3} Z{z:.3}"),
        };
        written.expect("memory");
        before = place;
    }
    out.push_str(match words {
        Words::Klartext => "L M30\nEND PGM BENCH MM\n",
        Words::Apt => "FINI\n",
        _ => "M30\n",
    });
    out
}

fn tilt(k: f64) -> f64 {
    20.0 * sin(k / 900.0)
}

fn turn(k: f64) -> f64 {
    30.0 + 25.0 * cos(k / 700.0)
}
