//! Offsets that a line writes and that are kept after the program ends.
use crate::Argument;

/// What a line writes to the offsets that are kept after the program ends: `G10 L2`, `G10 L20`, `#5221=0` (LinuxCNC user manual: numbered parameters).
pub(super) fn stored_offsets(line: &str, names: &[String], value: impl Fn(&str) -> Option<f64>) -> Vec<Argument> {
    let active = value("#5220").unwrap_or(f64::NAN);
    let is_offset = |name: &&String| {
        let number = name.trim_start_matches('#').parse::<u32>();
        number.is_ok_and(|number| (5161..=5390).contains(&number)) && line.contains(&format!("{name}="))
    };
    let mut stores: Vec<Argument> = names
        .iter()
        .filter(is_offset)
        .map(|name| Argument::number(format!("written to {name}"), value(name).unwrap_or(f64::NAN)))
        .collect();
    if line.contains("G10") && line.contains("L2") {
        stores.extend(written_by_g10(line, active));
    }
    stores
}

/// The values of a line `G10 L2 P2 X5`, each under its own name; with an expression the whole line.
fn written_by_g10(line: &str, active: f64) -> Vec<Argument> {
    let text = crate::canonical_text(line);
    let mut words: Vec<(char, f64)> = Vec::new();
    let mut rest = text.as_str();
    while let Some(letter) = rest.chars().next() {
        let after = &rest[letter.len_utf8()..];
        let end = after.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(after.len());
        let Ok(value) = after[..end].parse::<f64>() else {
            return vec![Argument::text("written by G10", &text)];
        };
        words.push((letter, value));
        rest = &after[end..];
    }
    let of = |name: char| {
        words
            .iter()
            .find(|(letter, _)| *letter == name)
            .map_or(0.0, |(_, value)| *value)
    };
    // P0 is the system that is active
    let of_system = matches!(of('L'), 2.0 | 20.0) && of('P') == 0.0;
    let place = if of_system {
        format!("G10 L{} P{}", of('L'), active)
    } else {
        format!("G10 L{} P{}", of('L'), of('P'))
    };
    let data = words
        .iter()
        .filter(|(letter, _)| !matches!(letter, 'G' | 'L' | 'P' | 'N'));
    data.map(|(letter, value)| Argument::number(format!("{place} {letter}"), *value))
        .collect()
}
