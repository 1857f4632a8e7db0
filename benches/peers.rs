//! `cargo bench --bench peers`: parsing beside the `gcode` crate, interpretation beside LinuxCNC's `rs274 -g` (where it is installed), on
//! five-axis, high-speed-milling, macro and loop programs; memory per block. Ratios are of this run; nothing is asserted.
//!
//! The `gcode` crate's visitor stores nothing; ours stores the lossless table. `rs274` prints its calls (to /dev/null here). Times are
//! processor time, the least of some runs. Both of a pair run in turns, each for about as long, so that a host whose speed changes from
//! second to second gives both the same chance of a fast one.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
#![expect(
    clippy::disallowed_methods,
    reason = "a surface to run over needs no reproducible last digit"
)]
use gcode::core::{
    BlockVisitor, CommandVisitor, ControlFlow, Diagnostics, HasDiagnostics, Number, ProgramVisitor, Span, Value,
};
use std::fmt::Write;
use std::hint::black_box;
use std::sync::Arc;
use trunnion::dialect::builtin;
use trunnion::ngc::{At, Canon, Engine, Error, Limits, Setup, Sink, Source, State};
use trunnion::syntax::parse;

#[path = "support/cpu.rs"]
mod cpu;

/// Turns of a pair.
const TURNS: usize = 5;

/// So many times ours is interpreted in a turn: about as long as `rs274` needs once.
const INTERPRETED: usize = 15;

/// Fewer lines are parsed again and again, so that there is something to measure.
const SHORT: f64 = 500_000.0;

fn main() {
    println!(
        "{:10} {:>9} {:>7} {:>12} {:>12} {:>7} {:>12} {:>12} {:>7} {:>10}",
        "program", "blocks", "MB", "gcode us", "parse us", "ratio", "rs274 us", "interp. us", "ratio", "B/block"
    );
    let programs = [
        ("five-axis", five_axis(1_000_000), 1_000_000),
        ("hsm", hsm(1_000_000), 1_000_000),
        ("macro", macros(40_000), 0),
        ("distinct", distinct(40_000), 0),
        ("loop", looped(250_000), 1_000_000),
    ];
    for (name, text, executed) in programs {
        compare(name, &text, executed);
    }
    println!(
        "\nus: microseconds per block (loop and macro: per executed line for interpretation, per line for parsing)"
    );
    println!(
        "macro: 40 000 subprograms, each called once, whose lines differ in their O numbers and arguments: what a line says is read once\n\
         and found again by its text. distinct: the same with other numbers in each line, so that no line is found again"
    );
    println!(
        "limits: parsing at least 5 x gcode's visitor; interpretation at least 25 x rs274 on five-axis, 15 x on loops, 8 x on macros"
    );
}

fn compare(name: &str, text: &str, executed: u64) {
    let lines = text.lines().count() as f64;
    let dialect = builtin("linuxcnc").expect("built in");
    // the clock of processor time ticks: a short text is parsed often
    let times = (SHORT / lines).ceil().max(1.0) as usize;
    let bytes = text.as_bytes().to_vec();
    let (mut peer, mut ours) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..TURNS {
        let visited = cpu::best(1, || {
            let mut visitor = Counter::default();
            for _ in 0..times {
                gcode::core::parse(black_box(text), &mut visitor);
            }
            visitor.count
        });
        // about as long as the peer
        for _ in 0..3 {
            let mut copies = Some(vec![bytes.clone(); times]);
            let parsed = cpu::best(1, || {
                let copies = copies.take().unwrap_or_default().into_iter();
                copies
                    .map(|copy| parse(black_box(copy), dialect.lex).block_count())
                    .sum::<usize>()
            });
            ours = ours.min(parsed / times as f64);
        }
        peer = peer.min(visited / times as f64);
    }
    let program = parse(bytes.clone(), dialect.lex);
    let memory = program.tokens().bytes() + program.block_count() * 4;
    let source: Arc<[u8]> = bytes.into();
    let path = std::env::temp_dir().join(format!("trunnion-peer-{}.ngc", std::process::id()));
    let written = std::fs::write(&path, text).is_ok();
    let (mut run, mut oracle) = (f64::INFINITY, None::<f64>);
    for _ in 0..TURNS {
        run = run.min(cpu::best(INTERPRETED, || interpret(name, &source)));
        // where it is not installed or refuses the program there is nothing to compare with
        let seconds = if written { cpu::rs274(&path, 1) } else { None };
        oracle = oracle.into_iter().chain(seconds).reduce(f64::min);
    }
    std::fs::remove_file(&path).ok();
    let executed = if executed == 0 { lines } else { executed as f64 };
    print!(
        "{name:10} {lines:>9} {:>7.1} {:>12.3} {:>12.3} {:>7.2}",
        text.len() as f64 / 1e6,
        peer / lines * 1e6,
        ours / lines * 1e6,
        peer / ours
    );
    match oracle {
        Some(seconds) => print!(
            " {:>12.3} {:>12.3} {:>7.1}",
            seconds / executed * 1e6,
            run / executed * 1e6,
            seconds / run
        ),
        None => print!(" {:>12} {:>12.3} {:>7}", "-", run / executed * 1e6, "-"),
    }
    println!(" {:>10.1}", memory as f64 / lines);
}

/// Runs a program; how many canonical calls it makes.
fn interpret(name: &str, source: &Arc<[u8]>) -> u64 {
    let setup = Setup {
        limits: Limits {
            blocks: u64::MAX,
            ..Limits::default()
        },
        ..Setup::default()
    };
    let mut count = Count::default();
    Engine::new(Arc::new(Source::new(String::new(), source.clone())), &setup).run(true, &mut count);
    assert_eq!(count.errors, 0, "{name} runs");
    count.calls
}

/// Counts canonical calls.
#[derive(Default)]
struct Count {
    calls: u64,
    errors: u64,
}

impl Sink for Count {
    fn call(&mut self, call: &Canon, _at: At, _state: &State) {
        black_box(call);
        self.calls += 1;
    }
    fn error(&mut self, _error: &Error, _at: At) {
        self.errors += 1;
    }
}

/// A serpentine over a bumpy surface with the tool axis on its normal.
fn five_axis(blocks: usize) -> String {
    let mut text =
        String::from("%\n(five axes)\nG21 G90 G17 G40 G80\nS12000 M3\nG54\nG0 X0 Y0 Z50 A0 C0\nG1 Z10 F2000\n");
    let mut before = 0.0_f64;
    for index in 0..blocks {
        let (row, column) = (index / 2000, index % 2000);
        let x = 0.05 * if row % 2 == 0 { column } else { 1999 - column } as f64;
        let y = 0.2 * row as f64;
        let z = 5.0 * (x / 17.0).sin() * (y / 13.0).cos();
        let (zx, zy) = (
            5.0 / 17.0 * (x / 17.0).cos() * (y / 13.0).cos(),
            -5.0 / 13.0 * (x / 17.0).sin() * (y / 13.0).sin(),
        );
        let a = (1.0 / (zx * zx + zy * zy + 1.0).sqrt()).acos().to_degrees();
        let mut c = (-zx).atan2(zy).to_degrees();
        c -= 360.0 * ((c - before) / 360.0).round();
        before = c;
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.4} C{c:.4}");
    }
    text.push_str("G0 Z50\nM5\nM30\n%\n");
    text
}

/// Three-axis finishing: only words that change.
fn hsm(blocks: usize) -> String {
    let mut text = String::from("%\n(finishing)\nG21 G90 G17 G40 G80 G94\nS18000 M3\nG54\nG0 X0 Y0 Z20\nG1 Z2 F4000\n");
    for index in 0..blocks {
        let (row, column) = (index / 1500, index % 1500);
        let x = 0.08 * if row % 2 == 0 { column } else { 1499 - column } as f64;
        let y = 0.1 * row as f64;
        let z = -3.0 + 2.5 * (x / 9.0 + y / 31.0).sin() * (y / 7.0).cos();
        let _ = if column == 0 {
            writeln!(text, "X{x:.3} Y{y:.3} Z{z:.3}")
        } else {
            writeln!(text, "X{x:.3} Z{z:.3}")
        };
    }
    text.push_str("G0 Z20\nM5\nM30\n%\n");
    text
}

/// Many subprograms, each called once.
fn macros(count: usize) -> String {
    let mut text = String::from("G21 G90 G17 G94 G64 P0.01 F1000\n");
    for index in 0..count {
        let o = 100 + 4 * index;
        let _ = write!(
            text,
            "o{o} sub (pocket {index})\n  #<w> = [#1 * 2 + #2 / 3.5]\n  #<h> = [ABS[SIN[#3]] ** 2 + SQRT[#<w> * #<w> + 1]]\n  \
             o{a} if [#<w> GT 10 AND #<h> LT 1000]\n    G1 X#<w> Y[#<h> - 1.25] F[500 + #4]\n  o{a} else\n    \
             G1 X[#1] Y[-#2] Z-0.5\n  o{a} endif\n  #<i> = 0\n  o{b} while [#<i> LT 3]\n    \
             G1 X[#<w> + #<i>] Y[COS[#<i> * 30] * 5] ; step\n    #<i> = [#<i> + 1]\n  o{b} endwhile\n  \
             G1 X[ROUND[#1]] Y[FIX[#2]] Z[FUP[#3] MOD 7]\no{o} endsub\no{o} call [{}] [0.5] [{}] [0] [1.0]\n",
            index % 17,
            index % 360,
            a = o + 1,
            b = o + 2,
        );
    }
    text.push_str("M2\n");
    text
}

/// The same with numbers that differ from subprogram to subprogram, so that no line is there twice.
fn distinct(count: usize) -> String {
    let mut text = String::from("G21 G90 G17 G94 G64 P0.01 F1000\n");
    for (index, part) in macros(count).split_inclusive("endsub\n").enumerate() {
        // the numbers that have no other meaning
        for line in part.lines().skip(usize::from(index == 0)) {
            let own = line
                .replace("3.5", &format!("3.5{index}"))
                .replace("] ; step", &format!("] ; step {index}"));
            let own = own
                .replace("* 30]", &format!("* 30.0{index}]"))
                .replace("1.25", &format!("1.25{index}"));
            let own = own
                .replace("LT 1000]", &format!("LT 1000.{index}]"))
                .replace("+ 1]", &format!("+ 1.0000{index}]"));
            let own = own
                .replace("Z-0.5", &format!("Z-0.5{index}"))
                .replace("LT 3]", &format!("LT 3.0{index}]"));
            let own = own
                .replace("MOD 7", &format!("MOD 7.{index}"))
                .replace("#<i> = 0", &format!("#<i> = 0.0000{index}"));
            let _ = writeln!(text, "{own}");
        }
    }
    text
}

/// One loop over four lines.
fn looped(turns: usize) -> String {
    format!(
        "G21 G90 G17 G94\nF1000\n#<i> = 0\no1 while [#<i> LT {turns}]\n  #<a> = [#<i> * 0.01]\n  \
         G1 X[5*COS[#<a>]] Y[5*SIN[#<a>]] Z[#<a> MOD 10]\n  #<i> = [#<i> + 1]\no1 endwhile\nM2\n"
    )
}

/// The peer's visitor at its least: counts words, looks at values, stores nothing.
#[derive(Default)]
struct Counter {
    count: u64,
    diagnostics: Silent,
}

#[derive(Default)]
struct Silent;

impl Diagnostics for Silent {}

struct Part<'a>(&'a mut Counter);

impl HasDiagnostics for Counter {
    fn diagnostics(&mut self) -> &mut dyn Diagnostics {
        &mut self.diagnostics
    }
}

impl HasDiagnostics for Part<'_> {
    fn diagnostics(&mut self) -> &mut dyn Diagnostics {
        &mut self.0.diagnostics
    }
}

impl ProgramVisitor for Counter {
    fn start_block(&mut self) -> ControlFlow<impl BlockVisitor + '_> {
        ControlFlow::Continue(Part(self))
    }
}

impl BlockVisitor for Part<'_> {
    fn word_address(&mut self, _letter: char, _value: Value<'_>, _span: Span) {
        self.0.count += 1;
    }
    fn start_general_code(&mut self, _number: Number) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.count += 1;
        ControlFlow::Continue(Part(self.0))
    }
    fn start_miscellaneous_code(&mut self, _number: Number) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.count += 1;
        ControlFlow::Continue(Part(self.0))
    }
    fn start_tool_change_code(&mut self, _number: Number) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.count += 1;
        ControlFlow::Continue(Part(self.0))
    }
}

impl CommandVisitor for Part<'_> {
    fn argument(&mut self, _letter: char, value: Value<'_>, _span: Span) {
        if let Value::Literal(value) = value {
            self.0.count += u64::from(value > 0.0);
        }
    }
}
