//! Signs of Brother controls (CNC-B00, C00, D00): programs like those of a Fanuc, with codes that change the tool while the axes move
//! (G100 with T) and tap (G77, G78, with the pitch or the threads per inch).
use super::text::{has, word};
use super::votes::Votes;

/// Signs in a line without comments, in upper case.
pub(super) fn code(code: &str, votes: &mut Votes) {
    if has(code, b'G', "100") && word(code, b'T') {
        votes.add("brother", 12, "a tool change G100 T");
    }
    let taps = has(code, b'G', "77") || has(code, b'G', "78");
    if taps && word(code, b'Z') && word(code, b'R') && (word(code, b'I') || word(code, b'J')) {
        votes.add("brother", 10, "a tapping cycle G77 or G78");
    }
}
