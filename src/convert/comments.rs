//! Comments of the original as those of the output.
use crate::job::Event;

/// A longer comment is written as several, bytes: an Okuma reads 158 characters of a block (OSP-U10L manual), a LinuxCNC 255.
pub(crate) const LONGEST_COMMENT: usize = 120;

/// A text in pieces of that length, cut between words where that is possible.
pub(crate) fn pieces(text: &str) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for mut word in text.split_whitespace() {
        loop {
            let last = pieces.last_mut().expect("never empty");
            let blank = usize::from(!last.is_empty());
            if last.len() + blank + word.len() <= LONGEST_COMMENT {
                last.extend((blank == 1).then_some(' '));
                last.push_str(word);
                break;
            }
            if last.is_empty() {
                let (head, rest) = word.split_at(word.floor_char_boundary(LONGEST_COMMENT));
                last.push_str(head);
                word = rest;
            }
            pieces.push(String::new());
        }
    }
    pieces
}

/// A comment as an event; machine-readable marks and comments about another dialect are left out.
pub(crate) fn comment(text: &str) -> Option<Event> {
    let text = text.trim();
    let lower = text.to_ascii_lowercase();
    let ours = lower.strip_prefix("trunnion:").map(str::trim_start);
    let other = ours.is_some_and(|rest| !rest.starts_with("allow"));
    if text.is_empty() || other || text.starts_with("->") || text.starts_with('*') || text.starts_with("$PATH") {
        return None;
    }
    Some(Event::Comment(text.to_owned()))
}
