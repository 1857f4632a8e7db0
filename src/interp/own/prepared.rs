//! Names with indices that a formula does not read itself: elements of fields of two and three dimensions (`A[1,2]`), and variables of the
//! control (`$P_EP[X]`). They are evaluated first, and stand in the text of the formula as one name each, so that all places stay; so do
//! comparisons of texts, and functions of them that give a number (`STRLEN(NAME)`).
use super::strings::inside_of;
use super::text_functions::is_of_number;
use super::{Own, arguments};

/// Indices inside indices.
const DEEPEST: u32 = 8;

/// The value of a name with its indices.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) value: Option<f64>,
}

/// What the name with its indices is worth, if that is known.
struct Evaluated(Option<f64>);

/// The element that a name in a prepared text means.
pub(super) fn element<'e>(elements: &'e [Element], name: &str) -> Option<&'e Element> {
    let place: usize = name.strip_prefix("__e")?.trim_end_matches('_').parse().ok()?;
    elements.get(place)
}

fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$'
}

/// The byte after the bracket that closes the one at `open`.
fn closed(text: &[u8], open: usize) -> Option<usize> {
    let (mut deep, mut quoted) = (0usize, false);
    for (at, &byte) in text.iter().enumerate().skip(open) {
        match byte {
            b'"' => quoted = !quoted,
            b'[' if !quoted => deep += 1,
            b']' if !quoted => {
                deep -= 1;
                if deep == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
    }
    None
}

/// Puts a name into the place of a part of the text; `None`: the part is shorter than the name.
fn replace(out: &mut [u8], elements: &mut Vec<Element>, (from, to): (usize, usize), value: Option<f64>) -> Option<()> {
    let mark = format!("__e{}", elements.len());
    if mark.len() > to - from {
        return None;
    }
    let name = String::from_utf8_lossy(&out[from..to]).to_ascii_uppercase();
    out[from..to].fill(b'_');
    out[from..from + mark.len()].copy_from_slice(mark.as_bytes());
    elements.push(Element { name, value });
    Some(())
}

/// The names with brackets behind them in an expression, in lower case, and what is between the brackets; those in texts are not.
pub(super) fn indexed_names(text: &str) -> Vec<(String, String)> {
    let bytes = text.as_bytes();
    let (mut found, mut at, mut deep) = (Vec::new(), 0, 0u32);
    while at < bytes.len() && deep < DEEPEST {
        match bytes[at] {
            b'"' => match bytes[at + 1..].iter().position(|&byte| byte == b'"') {
                Some(end) => at += end + 2,
                None => break,
            },
            b'[' => {
                deep += 1;
                at += 1;
            }
            b']' => {
                deep = deep.saturating_sub(1);
                at += 1;
            }
            byte if is_name(byte) => {
                let end = at + bytes[at..].iter().take_while(|byte| is_name(**byte)).count();
                let open = end + bytes[end..].iter().take_while(|byte| **byte == b' ').count();
                if bytes.get(open) != Some(&b'[') {
                    at = end;
                    continue;
                }
                let Some(after) = closed(bytes, open) else { break };
                let inside = String::from_utf8_lossy(&bytes[open + 1..after - 1]).into_owned();
                found.push((String::from_utf8_lossy(&bytes[at..end]).to_ascii_lowercase(), inside));
                deep += 1;
                at = open + 1;
            }
            _ => at += 1,
        }
    }
    found
}

impl Own {
    /// The text with all such names replaced, and their values; `None`: there are none.
    pub(super) fn prepared(&self, text: &[u8], from: usize, nested: u32) -> Option<(Vec<u8>, Vec<Element>)> {
        let rest = &text[from.min(text.len())..];
        let has_texts = !self.is_task && (self.has_strings() || rest.contains(&b'"'));
        if self.is_task || !(has_texts || rest.contains(&b'[')) || nested >= DEEPEST {
            return None;
        }
        let mut out = text.to_vec();
        let mut elements = Vec::new();
        let (mut at, mut deep) = (from, 0u32);
        // the text or a bracket begins
        let mut begins = true;
        while at < text.len() {
            let first = begins && has_texts;
            begins = text[at] == b'(' || begins && text[at] == b' ';
            if let Some((end, holds)) = first.then(|| self.compared(text, at)).flatten() {
                let value = holds.map(|holds| f64::from(u8::from(holds)));
                replace(&mut out, &mut elements, (at, end), value)?;
                at = end;
                continue;
            }
            match text[at] {
                b';' => break,
                b'[' => {
                    deep += 1;
                    at += 1;
                }
                b']' => {
                    deep = deep.saturating_sub(1);
                    at += 1;
                }
                b'"' => {
                    let end = text[at + 1..].iter().position(|&byte| byte == b'"')?;
                    at += end + 2;
                }
                byte if is_name(byte) => {
                    let end = at + text[at..].iter().take_while(|byte| is_name(**byte)).count();
                    let blanks = text[end..].iter().take_while(|byte| **byte == b' ').count();
                    let open = end + blanks;
                    if let Some((after, value)) = self.counted(text, (at, end), open) {
                        replace(&mut out, &mut elements, (at, after), value)?;
                        at = after;
                        continue;
                    }
                    if text.get(open) != Some(&b'[') {
                        at = end;
                        continue;
                    }
                    // each bracket is looked through once for every name around it
                    let after = closed(text, open).filter(|_| deep < DEEPEST)?;
                    let name = String::from_utf8_lossy(&text[at..end]).to_ascii_lowercase();
                    let inside = String::from_utf8_lossy(&text[open + 1..after - 1]).into_owned();
                    if let Some(Evaluated(value)) = self.indexed(&name, &inside, nested + 1) {
                        replace(&mut out, &mut elements, (at, after), value)?;
                        at = after;
                    } else {
                        deep += 1;
                        at = open + 1;
                    }
                }
                _ => at += 1,
            }
        }
        (!elements.is_empty()).then_some((out, elements))
    }

    /// A function of a text that gives a number: where it ends and its value, if that is known.
    fn counted(&self, text: &[u8], name: (usize, usize), open: usize) -> Option<(usize, Option<f64>)> {
        if text.get(open) != Some(&b'(') {
            return None;
        }
        let name = String::from_utf8_lossy(&text[name.0..name.1]).to_ascii_lowercase();
        let (inside, after) = is_of_number(&name).then(|| inside_of(text, open)).flatten()?;
        Some((after, self.number_of_text(&name, &inside)))
    }

    /// The value of a name with indices that is evaluated here; `None`: the formula reads it itself.
    fn indexed(&self, name: &str, inside: &str, nested: u32) -> Option<Evaluated> {
        let parts = arguments(inside);
        if name.starts_with('$') || self.scope.frames.contains_key(name) {
            return Some(Evaluated(self.of_control(name, &parts, nested)));
        }
        if parts.len() < 2 || !self.scope.sorts.contains_key(name) {
            return None;
        }
        let place = self.place_in(name, &parts, nested);
        Some(Evaluated(place.and_then(|place| self.element(name, place))))
    }

    /// What the control knows under a name with indices: axes and words as they are, numbers evaluated.
    fn of_control(&self, name: &str, parts: &[&str], nested: u32) -> Option<f64> {
        self.system
            .get(self.key_of_control(name, parts, nested)?.as_str())
            .copied()
    }

    /// `$P_UIFR[R1, x, tr]` as `$p_uifr[2,x,tr]`.
    fn key_of_control(&self, name: &str, parts: &[&str], nested: u32) -> Option<String> {
        let mut words = Vec::new();
        for part in parts {
            let lower = part.to_ascii_lowercase();
            let is_word = matches!(lower.as_str(), "tr" | "fi" | "rt" | "sc" | "mi")
                || (lower.len() == 1 && lower.bytes().all(|byte| byte.is_ascii_alphabetic()));
            if is_word {
                words.push(lower);
                continue;
            }
            if let Some(axis) = lower.strip_prefix("$p_axn") {
                let place: usize = axis.parse().ok()?;
                words.push(char::from(*self.plane_letters.get(place.checked_sub(1)?)?).to_string());
                continue;
            }
            let value = self.value_in(part, nested);
            let value = value.filter(|value| value.fract() == 0.0 && value.abs() < 1e6)?;
            words.push(format!("{value:.0}"));
        }
        Some(format!("{}[{}]", name.to_ascii_lowercase(), words.join(",")))
    }
}
