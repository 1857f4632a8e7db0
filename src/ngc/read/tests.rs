//! Lines compared with the control: every line of `tests/lines.tsv` was given to `rs274` (2.9.0~pre1), most with ` ^` after it, which no line
//! survives; the message is beside it.
use super::{Line, apply, errors, evaluate, problems};
use crate::parameters::Values;
use crate::{Block, Engine, Error, Setup, Source, Start};
use proptest::prelude::*;
use std::sync::Arc;
use trunnion_syntax::TextRange;

fn engine(start: Start) -> Engine {
    let setup = Setup {
        start,
        ..Setup::default()
    };
    Engine::new(Arc::new(Source::new(String::new(), Arc::from(&b""[..]))), &setup)
}

fn read(text: &str) -> Line {
    let mut line = Line::default();
    let text = text.as_bytes();
    Line::read(text, TextRange::new(0, text.len() as u32), &mut line);
    line
}

/// What the control says about the line on its own.
fn first_error(text: &str, engine: &Engine) -> Option<Error> {
    let line = read(text);
    let evaluated = evaluate(&line, &Values::new(engine), &mut Block::new()).err();
    assert!(
        evaluated.is_some() || line.errors.is_empty(),
        "{text}: {:?} are not met",
        line.errors
    );
    for error in line.errors.iter().chain(&evaluated) {
        assert!(
            error.range.start <= error.range.end && error.range.end as usize <= text.len(),
            "{text}: {error:?}"
        );
    }
    evaluated
}

/// All that is wrong with the line.
fn all_errors(text: &str, engine: &Engine) -> Vec<Error> {
    errors(&read(text), &Values::new(engine), &mut Block::new())
}

/// Runs lines one after the other, without effect but on parameters.
fn run(lines: &[&str], engine: &mut Engine) -> Block {
    let mut block = Block::new();
    for text in lines {
        let line = read(text);
        evaluate(&line, &Values::new(engine), &mut block).expect(text);
        apply(engine, &line).expect(text);
    }
    block
}

#[test]
fn every_answer_of_the_control() {
    let engine = engine(Start::Zero);
    let mut wrong = Vec::new();
    for case in include_str!("../tests/lines.tsv").lines() {
        let (text, answer) = case.rsplit_once('\t').expect("two columns");
        let ours = first_error(text, &engine);
        let ours = ours.as_ref().map_or("", Error::message);
        // what the control finds only after the line's end belongs to other modules
        let later = answer.contains("read-only")
            || !problems::ALL.iter().any(|problem| {
                let (before, behind) = problem.message.split_once("{}").unwrap_or((problem.message, ""));
                !problem.message.is_empty() && answer.starts_with(before) && answer.ends_with(behind)
            });
        let expected = if later || answer == "Unknown m code used: M100" || answer == "Unknown m code used: M199" {
            ""
        } else {
            answer
        };
        if ours != expected {
            wrong.push(format!("{text}\n    expected {expected}\n    found    {ours}"));
        }
    }
    assert!(wrong.is_empty(), "{} lines:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn values_in_their_places() {
    let mut engine = engine(Start::Zero);
    let block = run(
        &["N10 G01 G90 x 1 2.5 Y-.5 F#1 T2.00001 M3 $0 @5 ^30 H1 (c) g17"],
        &mut engine,
    );
    assert_eq!(
        (block.word(b'X'), block.word(b'Y'), block.word(b'F')),
        (Some(12.5), Some(-0.5), Some(0.0))
    );
    assert_eq!(
        (block.word(b'T'), block.word(b'H'), block.word(b'Z')),
        (Some(2.0), Some(1.0), None)
    );
    assert_eq!(
        (block.g_code(1), block.g_code(3), block.g_code(2), block.g_code(0)),
        (Some(10), Some(900), Some(170), None)
    );
    assert_eq!((block.m_code(7), block.m_count), (Some(3), 1));
    assert_eq!(
        (block.number, block.radius, block.angle, block.spindle),
        (Some(10.0), Some(5.0), Some(30.0), Some(0))
    );
    assert_eq!(block.range_of(b'X'), TextRange::new(12, 19));
    let cycle = run(&["G80 G81 G80"], &mut engine);
    assert_eq!((cycle.g_code(1), cycle.g_range(1)), (Some(810), TextRange::new(4, 7)));
}

#[test]
fn assignments_take_effect_behind_the_line() {
    let mut engine = engine(Start::Zero);
    let value = |block: &Block| block.word(b'X').expect("X");
    assert_eq!(value(&run(&["#3=15", "#3=6 G0 X#3"], &mut engine)), 15.0);
    assert_eq!(value(&run(&["X#3"], &mut engine)), 6.0);
    assert_eq!(value(&run(&["#1=2 #2=[#1+1]", "X[#1*10+#2]"], &mut engine)), 21.0);
    assert_eq!(value(&run(&["#<Foo Bar>=3", "X#<foobar>"], &mut engine)), 3.0);
    assert_eq!(
        value(&run(&["#<new>=5 X#<new>"], &mut engine)),
        0.0,
        "it exists, with zero"
    );
    assert_eq!(value(&run(&["#1=#<new> #<new>=7 X#<new>"], &mut engine)), 5.0);
    assert_eq!(
        value(&run(&["#[#<new>+1]=4 #<_g>=8", "X[#8+#<_g>]"], &mut engine)),
        12.0
    );
}

#[test]
fn a_call_has_its_own_numbers_and_names() {
    let mut engine = engine(Start::Zero);
    run(&["#1=3 #5=9 #31=1 #<a>=2 #<_g>=4"], &mut engine);
    engine.store.enter(&[7.0]);
    let inside = run(
        &[
            "X[#1+#5*10+#31*100] Y EXISTS[#<a>] Z#<_g> R#<_call_level>",
            "#1=0 #31=6 #<a>=0 #<_g>=5",
        ],
        &mut engine,
    );
    assert!(!inside.has(b'X'));
    engine.store.leave();
    let after = run(&["X[#1+#5*10+#31*100] Y#<a> Z#<_g> R#<_call_level>"], &mut engine);
    assert_eq!(
        [b'X', b'Y', b'Z', b'R'].map(|letter| after.word(letter)),
        [Some(693.0), Some(2.0), Some(5.0), Some(0.0)]
    );
}

#[test]
fn all_errors_of_a_line_with_their_places() {
    let table: &[(&str, &[(&str, &str)])] = &[
        (
            "G0 X1 X2 ! Y[1+ Z1.2.3 #5=",
            &[
                ("Multiple x words on one line", "X2"),
                ("Bad character '!' used", "!"),
                ("Unknown word where unary operation could be", "Z"),
                ("bad number format (trailing characters) parsing '1.2.3'", "1.2.3"),
                ("No characters found in reading real value", ""),
            ],
        ),
        (
            "ANDX1.5G1G1",
            &[
                ("Unknown word where unary operation could be", "N"),
                ("Two g codes used from same modal group", "G1"),
            ],
        ),
        (
            // an unknown name is not a row of words
            "X Y1.2.3 CYCLE800 S-1",
            &[
                ("Unknown word where unary operation could be", "Y"),
                ("bad number format (trailing characters) parsing '1.2.3'", "1.2.3"),
                ("Negative spindle speed used", "S-1"),
            ],
        ),
        (
            "X[1 FOO 2 BAR [3]] Y[1 Z2",
            &[("Unknown operation", "F"), ("Unknown operation", "Z")],
        ),
        ("#<a Y1", &[("Named parameter not terminated", "<")]),
        (
            "#1 5 #=5 (c) N7 \u{e9}",
            &[
                ("Equal sign missing in parameter setting", "#1 5"),
                ("bad number format (conversion failed) parsing ''", "="),
                ("Bad character 'n' used", "N"),
                ("Bad character '\\303' used", "\u{e9}"),
            ],
        ),
        (
            "X1 (a (b) c) Y",
            &[
                ("Nested comment found", "("),
                ("No characters found in reading real value", ""),
            ],
        ),
        ("X1 (a", &[("Unclosed comment found", "(a")]),
        ("N-5 X1", &[("Bad format unsigned integer", "N")]),
    ];
    for (text, expected) in table {
        let all = all_errors(text, &engine(Start::Zero));
        let told: Vec<_> = all
            .iter()
            .map(|error| (error.message(), &text[error.range.as_usize()]))
            .collect();
        assert_eq!(told, *expected, "{text}");
    }
}

#[test]
fn unknown_values_are_no_errors() {
    let mut engine = engine(Start::Unknown);
    let block = run(&["G1 X#3 F#4 S#<_hal[pin]> T#5", "G1 X#3 Y#<_x> F#4"], &mut engine);
    assert!(block.word(b'X').is_some_and(f64::is_nan) && block.word(b'Y').is_some_and(f64::is_nan));
    let error = first_error("G#3", &engine).expect("not decided");
    assert_eq!(error.problem, &super::UNDECIDED);
    run(&["#1=5 #[#2]=1"], &mut engine);
    assert!(engine.store.number(1).is_nan(), "any number may have been set");
    assert_eq!(run(&["X#<_task>"], &mut engine).word(b'X'), Some(1.0));
}

/// Pieces of lines, right and wrong.
fn pieces() -> impl Strategy<Value = Vec<String>> {
    let piece = proptest::sample::select(vec![
        "G1", "G2", "X", "Y1.5", "Z-", "M3", "M", "N", "O", "AND", "MOD", "SIN", "FIX[", "[", "]", "#", "#1", "#<a",
        ">", "=", "+", "-", "*", "**", "/", "1", ".", "2.5", "!", "@", "^3", "$", "P-1", "Q5", "CYCLE", "\u{e9}",
        "EXISTS[#", "ATAN[1]", "LE", "F0",
    ]);
    proptest::collection::vec(piece.prop_map(str::to_owned), 0..14)
}

proptest! {
    #[test]
    fn blanks_have_no_say(pieces in pieces(), blanks in proptest::collection::vec("[ \t]{0,2}", 40)) {
        let engine = engine(Start::Zero);
        let close = pieces.concat();
        let mut blanks = blanks.iter().cycle();
        let wide: String = close.chars().flat_map(|sign| [sign.to_string(), blanks.next().cloned().unwrap_or_default()]).collect();
        let told = |text: &str| {
            let text = text.trim_end();
            let line = read(text);
            let mut block = Block::new();
            let all = errors(&line, &Values::new(&engine), &mut block);
            let messages: Vec<String> = all.iter().map(|error| error.message().to_owned()).collect();
            let values: Vec<_> = (b'A'..=b'Z').map(|letter| block.word(letter).map(f64::to_bits)).collect();
            let first = evaluate(&line, &Values::new(&engine), &mut Block::new()).err().map(|error| error.message().to_owned());
            (messages, values, block.g, block.m, first)
        };
        prop_assert_eq!(told(&close), told(&wide), "{:?} and {:?}", close, wide);
    }
}
