//! What the module exports: texts go in and out four bytes at a time, so no function takes or returns an address.
#![expect(
    unsafe_code,
    reason = "an exported name counts as unsafe code: it could be that of another function. No function here has an unsafe block"
)]
use crate::{Request, check, lists, refused};
use std::cell::RefCell;

#[derive(Default)]
struct Exchange {
    /// The request, JSON.
    request: Vec<u8>,
    /// The bytes of the program.
    program: Vec<u8>,
    /// What is read by the caller.
    answer: Vec<u8>,
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> = RefCell::default();
}

/// Adds the lowest `count` bytes of `word`, the lowest first, to the request (`to` = 0) or to the program.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn trunnion_push(to: u32, word: u32, count: u32) {
    let bytes = word.to_le_bytes();
    let some = &bytes[..(count as usize).min(bytes.len())];
    EXCHANGE.with_borrow_mut(|exchange| {
        let buffer = if to == 0 {
            &mut exchange.request
        } else {
            &mut exchange.program
        };
        buffer.extend_from_slice(some);
    });
}

/// Checks what was pushed, and forgets it. Returns how many bytes the answer has.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn trunnion_check() -> u32 {
    let (request, program) = EXCHANGE.with_borrow_mut(|exchange| {
        exchange.answer = Vec::new();
        (
            std::mem::take(&mut exchange.request),
            std::mem::take(&mut exchange.program),
        )
    });
    answer(match Request::read(&String::from_utf8_lossy(&request)) {
        Ok(request) => check(&request, program),
        Err(message) => refused(&message),
    })
}

/// Lists what is built in. Returns how many bytes the answer has.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn trunnion_lists() -> u32 {
    answer(lists())
}

/// Four bytes of the answer, from the one with this number times four; those after its end are 0.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn trunnion_pull(number: u32) -> u32 {
    EXCHANGE.with_borrow(|exchange| {
        let rest = exchange.answer.get(number as usize * 4..).unwrap_or_default();
        let mut word = [0; 4];
        for (to, from) in word.iter_mut().zip(rest) {
            *to = *from;
        }
        u32::from_le_bytes(word)
    })
}

fn answer(text: String) -> u32 {
    let length = text.len() as u32;
    EXCHANGE.with_borrow_mut(|exchange| exchange.answer = text.into_bytes());
    length
}
