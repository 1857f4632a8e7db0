//! Signs of a Fadal CNC 88 in its own format: a fixture offset E1 to E48 in the block that positions the tool at the start of an operation.
use super::text::{has, word, words};
use super::votes::Votes;

/// Signs in a line without comments, in upper case.
pub(super) fn code(code: &str, votes: &mut Votes) {
    let fixture = words(code).any(|(letter, digits)| {
        let number = digits.parse::<u32>().is_ok_and(|number| (1..=48).contains(&number));
        letter == b'E' && number
    });
    let starts = word(code, b'S') && (has(code, b'M', "3") || has(code, b'M', "4"));
    if fixture && starts && word(code, b'X') && word(code, b'Y') {
        votes.add("fadal", 12, "a fixture offset E");
    }
}
