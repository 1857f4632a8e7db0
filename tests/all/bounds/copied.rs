//! What a copy of a run takes: the session of a document keeps copies, and has as many blocks between two of them as
//! [`trunnion::interp::Interpreter::copied`] counts entries. A list that grows with the program and is not counted takes gigabytes.
use super::inputs;
use trunnion::check::Settings;
use trunnion::dialect::{BUILTIN_NAMES, Dialect, builtin};
use trunnion::interp::{Fault, ModalState, Motion, Setup, Sink, Tool};
use trunnion::syntax::parse;

/// An entry has no more bytes than this: a tool, a name with its value, a fault with its text.
const ENTRY: u64 = 600;

/// More than this is not counted where a program has four times as many elements.
const NOT_COUNTED: u64 = 10_000;

/// Elements of the smaller and of the larger program.
const SIZES: [usize; 2] = [300, 1200];

/// So many blocks run.
const MOST_BLOCKS: usize = 4000;

/// A copy is made after so many blocks.
const EVERY: usize = 60;

struct Nowhere;

impl Sink for Nowhere {
    fn motion(&mut self, _: &Motion, _: &ModalState) {}
    fn fault(&mut self, _: Fault) {}
}

/// The most bytes that a copy takes beyond its entries, during a run.
fn not_counted(program: Vec<u8>, dialect: &'static Dialect) -> u64 {
    let tool = Tool {
        number: 1,
        shape: None,
        diameter_mm: Some(10.0),
        length_mm: Some(100.0),
        holder_mm: None,
    };
    let setup = Setup {
        tools: vec![tool],
        ..Setup::default()
    };
    let settings = Settings::new(dialect, None, setup);
    let program = parse(program, dialect.lex);
    let mut run = settings.interpreter();
    let mut most = 0;
    for block in 0..MOST_BLOCKS {
        if run.advance(&program, &mut Nowhere).is_none() {
            break;
        }
        if block % EVERY == EVERY - 1 {
            let taken = allocation_counter::measure(|| drop(run.clone())).bytes_total;
            most = most.max(taken.saturating_sub(ENTRY * run.copied() as u64));
        }
    }
    most
}

#[test]
fn a_copy_of_a_run_counts_what_grows() {
    let mut wrong = Vec::new();
    for input in inputs::all() {
        let dialects = BUILTIN_NAMES
            .iter()
            .filter(|name| input.dialect.is_none_or(|own| own == **name));
        for name in dialects {
            let dialect = builtin(name).expect("built in");
            let [small, large] = SIZES.map(|size| not_counted(input.bytes(size), dialect));
            if large > small + NOT_COUNTED {
                wrong.push(format!("{} {name}: {small} and {large} bytes", input.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of a copy:\n{}", wrong.len(), wrong.join("\n"));
}
