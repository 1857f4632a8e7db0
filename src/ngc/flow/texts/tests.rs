//! What is found by its text beside what is read.
use super::{Compiled, Label, NOWHERE, Part, plain_label};
use crate::flow::Kind;
use crate::flow::labels::Place;
use crate::{Engine, FileId, Setup, Source};
use proptest::prelude::*;
use std::sync::Arc;

/// All that a read form says.
fn said(read: &Compiled) -> String {
    let line = &read.line;
    let words = (&line.number, line.delete, &line.items, &line.words, &line.assignments);
    let rest = (line.range, &line.comment, &line.remark, &line.errors);
    format!(
        "{:?} {:?} {:?} {:?} {words:?} {rest:?}",
        read.kind, read.o, read.cut, read.flaw
    )
}

/// Reads both lines of a program, the second one as it is found by its text; whether it was found, and the result of both readings.
fn both(first: &str, second: &str) -> (bool, String, String) {
    // the third one has its own number where the text follows a number
    let third = match plain_label(format!("{second}\n").as_bytes()) {
        Some((start, end, Label::Number(_))) => format!("{}o345{}", &second[..start], &second[end..]),
        _ => second.to_owned(),
    };
    let text = format!("{first}\n\n{second}\n{third}\n");
    let source = Source::new(String::new(), text.as_bytes().into());
    let mut engine = Engine::new(Arc::new(source), &Setup::default());
    let there = Place::new(FileId::MAIN, 2, first.len() as u32 + 2);
    let read = engine.read(Place::default(), true);
    let slot = read.slot();
    engine.put_back(read, false);
    let mut moved = engine.read(there, true);
    let mut fresh = Compiled::default();
    engine.compile(there, &mut fresh);
    assert_eq!((moved.place, moved.next), (fresh.place, fresh.next));
    let found = slot != NOWHERE && slot == moved.slot();
    let (said_there, said_afresh) = compared(&mut moved, &fresh);
    let sure = found && moved.origin.part != Part::BehindName;
    guessed(engine, moved, sure);
    (found, said_there, said_afresh)
}

/// What two read forms say, except the words of lines whose words are not used.
fn compared(moved: &mut Compiled, fresh: &Compiled) -> (String, String) {
    let words = |read: &Compiled| {
        let counts = matches!(read.kind, Kind::Words | Kind::CallNumbered | Kind::ReturnNumbered);
        counts && read.flaw.is_none()
    };
    if !words(moved) && !words(fresh) {
        moved.line = fresh.line.clone();
    }
    (said(moved), said(fresh))
}

/// Reads the line after one that was read, which says the same; `sure`: it is certainly taken without a look-up of its text.
fn guessed(mut engine: Engine, before: Box<Compiled>, sure: bool) {
    let there = before.next;
    engine.put_back(before, false);
    let source = Arc::clone(&engine.files[0]);
    let taken = engine.flow.texts.guess(source.bytes(), there);
    assert_eq!(taken.is_some(), sure);
    let Some(mut taken) = taken else { return };
    let mut fresh = Compiled::default();
    engine.compile(there, &mut fresh);
    assert_eq!((taken.place, taken.next), (fresh.place, fresh.next));
    let (one, other) = compared(&mut taken, &fresh);
    assert_eq!(one, other);
}

#[test]
fn behind_skipped_lines_another_one_is_expected() {
    let source = Source::new(String::new(), b"G1 X1\nG1 Y2\nG1 Z3\n".as_slice().into());
    let mut engine = Engine::new(Arc::new(source), &Setup::default());
    let [first, second, third] = [0, 1, 2].map(|line| Place::new(FileId::MAIN, line, 6 * line));
    let run = |engine: &mut Engine, place| {
        let read = engine.read(place, true);
        engine.put_back(read, false);
    };
    run(&mut engine, first);
    run(&mut engine, second);
    run(&mut engine, first);
    engine.flow.texts.skip();
    run(&mut engine, third);
    for (skips, expected, other) in [(false, second, third), (true, third, second)] {
        run(&mut engine, first);
        if skips {
            engine.flow.texts.skip();
        }
        let source = Arc::clone(&engine.files[0]);
        let texts = &mut engine.flow.texts;
        assert!(texts.guess(source.bytes(), other).is_none(), "{skips}");
        let read = texts.guess(source.bytes(), expected).expect("it stood there before");
        assert_eq!(read.place, expected);
        engine.put_back(read, false);
    }
}

#[test]
fn what_is_found_by_its_text_is_what_is_read() {
    for (first, second) in [
        ("  G1 X#<w> Y[#<h> - 1.25] (c)", "  G1 X#<w> Y[#<h> - 1.25] (c)"),
        (
            "o7 if [#1 GT 10 AND #<h> LT 1000] ;c",
            "O12 if [#1 GT 10 AND #<h> LT 1000] ;c",
        ),
        ("o<ab> call [3] [0.5] [#2]", "o<abc_d> call [3] [0.5] [#2]"),
        ("o7", "o77"),
        ("#<a> = [1 + 2] #3=4", "#<a> = [1 + 2] #3=4"),
        ("G1 X1 X2 Y[1+", "G1 X1 X2 Y[1+"),
        ("o7 foo", "o9 foo"),
    ] {
        let (found, moved, fresh) = both(first, second);
        assert!(found, "{first:?}");
        assert_eq!(moved, fresh, "{first:?}");
    }
    // where the number does not end with its digits, what follows is no separate text
    for (first, second) in [("o7.5 if [1]", "o8.5 if [1]"), ("o7 7 if [1]", "o8 7 if [1]")] {
        let (found, moved, fresh) = both(first, second);
        assert!(!found, "{first:?}");
        assert_eq!(moved, fresh, "{first:?}");
    }
}

proptest! {
    #[test]
    fn whatever_stands_there(
        line in "[/ ]{0,2}(N5 )?(o(7|<ab>|#1|1\\.5|\\[1\\]) ?(if|while|sub|call|endif|else|foo)?|G1 X#<w>|#1=|#<a>=5|X1\\.2\\.3|M98 P1|M99|%|X1 X)[ 7.]{0,2}(\\[[#<x>1+2.]{0,5}\\]){0,2}( ;c| \\(d\\)|\\(a\\(b)?"
    ) {
        let other = line.replacen("o7", "O12", 1).replacen("<ab>", "<abc_d>", 1);
        let (_, moved, fresh) = both(&line, &other);
        prop_assert_eq!(moved, fresh);
    }
}
