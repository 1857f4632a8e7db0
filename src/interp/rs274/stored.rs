//! Offsets that a line writes and that are kept after the program ends.
use crate::Argument;

/// What a line writes to the offsets that are kept after the program ends: `G10 L2`, `G10 L20`, `#5221=0` (LinuxCNC user manual: numbered parameters).
/// Words become mm, of `unit` mm; parameters are in the unit of the machine whatever the program's is.
pub(super) fn stored_offsets(
    line: &str,
    names: &[String],
    unit: f64,
    value: impl Fn(&str) -> Option<f64>,
) -> Vec<Argument> {
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
        stores.extend(written_by_g10(line, active, unit));
    }
    stores
}

/// The values of a line `G10 L2 P2 X5`, each under its own name; with an expression the whole line, and its unit where that is not mm.
fn written_by_g10(line: &str, active: f64, unit: f64) -> Vec<Argument> {
    let text = crate::canonical_text(line);
    let mut words: Vec<(char, f64)> = Vec::new();
    let mut rest = text.as_str();
    while let Some(letter) = rest.chars().next() {
        let after = &rest[letter.len_utf8()..];
        let end = after.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(after.len());
        let Ok(value) = after[..end].parse::<f64>() else {
            let of_unit = if unit == 1.0 { "" } else { " in inch" };
            return vec![Argument::text("written by G10", &format!("{text}{of_unit}"))];
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
    // A B C are angles, as R is
    let is_length = |letter: &char| matches!(letter, 'X' | 'Y' | 'Z' | 'U' | 'V' | 'W');
    data.map(|(letter, value)| {
        let scale = if is_length(letter) { unit } else { 1.0 };
        Argument::number(format!("{place} {letter}"), value * scale)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::stored_offsets;

    #[test]
    fn offsets_are_written_in_mm_and_angles_in_degrees() {
        let of = |line: &str, unit: f64| {
            let words = stored_offsets(line, &[], unit, |_| Some(1.0));
            words.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        let mm = ["G10 L2 P2 X=50.8", "G10 L2 P2 A=30", "G10 L2 P2 R=45"];
        assert_eq!(of("G10L2P2X50.8A30R45", 1.0), mm);
        assert_eq!(of("G10L2P2X2A30R45", 25.4), mm);
        assert_eq!(of("G10L20P0Z1", 25.4), ["G10 L20 P1 Z=25.4"]);
        let [expression, in_inch] = [1.0, 25.4].map(|unit| of("G10L2P2X[1+1]", unit));
        assert_ne!(expression, in_inch);
    }
}
