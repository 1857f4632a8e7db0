//! Lengths of an inch program as its people know them: each length and feed of a text in mm gets its value in inch after it.
//!
//! Inside, and in the numbers of the JSON documents, everything is in mm. This is for sentences, rows and pages alone.
use crate::Report;
use crate::words::number;
use core::fmt::Write;

const MM_PER_INCH: f64 = 25.4;

/// The text with the value in inch after each length in mm and each feed per minute or turn: `10 mm (0.3937 in)`.
pub fn with_inches(text: &str) -> String {
    let mut out = String::with_capacity(text.len() * 5 / 4);
    let mut rest = text;
    while let Some(at) = rest.find(" mm") {
        let (before, after) = (&rest[..at], &rest[at + 3..]);
        let (per, after) = ["/min", "/rev"]
            .into_iter()
            .find_map(|per| Some((per, after.strip_prefix(per)?)))
            .unwrap_or(("", after));
        out.push_str(before);
        let _ = write!(out, " mm{per}");
        rest = after;
        // mm/s, mm^2 and names that begin with mm are something else
        let ends = !after.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '/' | '^' | '_'));
        let Some((value, start)) = last_number(before).filter(|_| ends) else {
            continue;
        };
        // both ends of a range have the unit once
        let lead = before[..start].trim_end();
        let lead = lead.strip_suffix(" to").or_else(|| lead.strip_suffix(".."));
        let range = lead.and_then(|lead| last_number(lead.trim_end()));
        let _ = match range {
            Some((low, _)) => write!(out, " ({} to {} in{per})", inch(low), inch(value)),
            None => write!(out, " ({} in{per})", inch(value)),
        };
    }
    out.push_str(rest);
    out
}

fn inch(mm: f64) -> String {
    number(mm / MM_PER_INCH)
}

/// The number that ends a text, and where it begins. Blanks may group its digits by three.
fn last_number(text: &str) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let part = |byte: u8| byte.is_ascii_digit() || byte == b'.';
    let mut start = bytes.len();
    while start > 0 && part(bytes[start - 1]) {
        start -= 1;
        let grouped = start >= 2 && bytes[start - 1] == b' ' && bytes[start - 2].is_ascii_digit();
        let three = bytes[start..].iter().take_while(|byte| byte.is_ascii_digit()).count() == 3;
        if grouped && three {
            start -= 1;
        }
    }
    if start > 0 && bytes[start - 1] == b'-' {
        start -= 1;
    }
    // a digit of a name is no number: `X1 mm`
    let is_name = text[..start].ends_with(|c: char| c.is_alphabetic() || c == '_');
    let value: f64 = text[start..].replace(' ', "").parse().ok()?;
    (!is_name).then_some((value, start))
}

impl Report {
    /// Puts inches into everything that people read, and says what the settings are in.
    pub(crate) fn tell_inches(&mut self) {
        for found in &mut self.diagnostics {
            found.message = with_inches(&found.message);
            found.notes.iter_mut().for_each(|note| *note = with_inches(note));
            if let Some(help) = &mut found.help {
                *help = with_inches(help);
                if help.contains("[work_offsets]") {
                    help.push_str("; trunnion.toml is in mm, also for a program in inch");
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_length_gets_its_value_in_inch() {
        for (text, wanted) in [
            (
                "X goes to 254 mm, 12.7 mm too far",
                "X goes to 254 mm (10 in), 12.7 mm (0.5 in) too far",
            ),
            (
                "fits with X -25.4 mm to 50.8 mm",
                "fits with X -25.4 mm (-1 in) to 50.8 mm (2 in)",
            ),
            ("X -25.4 to 50.8 mm", "X -25.4 to 50.8 mm (-1 to 2 in)"),
            ("Z    -25.400 ..   50.8 mm", "Z    -25.400 ..   50.8 mm (-1 to 2 in)"),
            ("feed 2 540.0 mm/min", "feed 2 540.0 mm/min (100 in/min)"),
            ("lead 1.27 mm/rev.", "lead 1.27 mm/rev (0.05 in/rev)."),
            ("500 mm/s and 3 mm/s^2, 5 mm^2", "500 mm/s and 3 mm/s^2, 5 mm^2"),
            ("lengths in mm, B1 mm", "lengths in mm, B1 mm"),
        ] {
            assert_eq!(with_inches(text), wanted);
        }
    }
}
