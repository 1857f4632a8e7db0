//! Calls, repeated sections and bounds.
use super::{BlockBudget, Course, Ends, PendingCall};
use crate::{ChainId, Frame};
use trunnion_syntax::TextRange;
use trunnion_vocabulary::Work;

const MOST: Work = Work {
    blocks: 100,
    bytes: 100,
};

fn frame() -> Frame {
    Frame {
        file: String::new(),
        line: 1,
        what: "CALL".to_owned(),
        is_place: false,
    }
}

fn going(from: u32, file: u16, start: u32, times: u32, ends: Ends) -> PendingCall<&'static str> {
    PendingCall {
        from,
        back: from + 1,
        file,
        start,
        section: None,
        times,
        ends,
        level: "kept",
    }
}

#[test]
fn a_loop_without_a_change_is_endless() {
    let mut course = Course::<()>::default();
    course.open_loop(2);
    assert_eq!(course.close_loop(9, 2, 5), 2);
    assert!(course.is_again(2));
    course.open_loop(2);
    course.close_loop(9, 2, 6);
    assert_eq!(course.count(1, MOST), BlockBudget::Left, "something has changed");
    course.open_loop(2);
    course.close_loop(9, 2, 6);
    let out = BlockBudget::Out {
        most: Some((0, 2)),
        proved: true,
        blocks: 1,
    };
    assert_eq!(course.count(1, MOST), out);
}

#[test]
fn the_bound_names_the_loop_that_ran_most() {
    let mut course = Course::<()>::default();
    for changes in 0..3 {
        course.jump_back(9, 2, changes);
    }
    course.jump_back(9, 7, 0);
    assert_eq!(course.count(1, Work { blocks: 1, ..MOST }), BlockBudget::Left);
    let out = BlockBudget::Out {
        most: Some((0, 2)),
        proved: false,
        blocks: 1,
    };
    assert_eq!(course.count(1, Work { blocks: 1, ..MOST }), out);
}

#[test]
fn long_blocks_use_up_the_bound_on_bytes() {
    let mut course = Course::<()>::default();
    assert_eq!(course.count(60, MOST), BlockBudget::Left);
    assert_eq!(course.count(40, MOST), BlockBudget::Left);
    let out = BlockBudget::Out {
        most: None,
        proved: false,
        blocks: 2,
    };
    assert_eq!(course.count(1, MOST), out);
}

#[test]
fn calls_return_where_they_came_from() {
    let mut course = Course::default();
    let range = TextRange::new(3, 9);
    let chain = course.enter(going(4, 1, 0, 2, Ends::Return), ChainId::MAIN, range, frame);
    assert_ne!(chain, ChainId::MAIN);
    assert_eq!((course.place().file, course.place().main.0), (1, 4));
    let inner = course.enter(going(8, 2, 3, 1, Ends::Return), chain, TextRange::default(), frame);
    assert_eq!(course.place().main_range, range, "the call of the main program");
    assert_eq!(course.frames(inner).len(), 2);
    assert_eq!(course.once_more().map(|(start, _)| start), None);
    let call = course.leave(5).expect("a call");
    assert_eq!((call.back, call.chain, call.level), (9, chain, "kept"));
    assert_eq!(course.once_more().map(|(start, _)| start), Some(0), "the second time");
    assert!(course.once_more().is_none());
    course.leave(5);
    assert!(!course.is_called());
    assert!(course.has_run(4) && !course.has_run(5));
}

#[test]
fn a_repeated_section_is_no_program() {
    let mut course = Course::default();
    let chain = ChainId::MAIN;
    let section = going(9, 0, 2, 3, Ends::Section { last: 5 });
    assert_eq!(course.enter(section, chain, TextRange::default(), frame), chain);
    assert_eq!(
        (course.repeated(), course.is_called(), course.depth()),
        (Some((2, 5)), false, 1)
    );
    assert!(course.once_more().is_some() && course.once_more().is_some() && course.once_more().is_none());
    assert_eq!(course.leave(6).map(|call| call.back), Some(10));
    assert_eq!(course.repeated(), None);
}
