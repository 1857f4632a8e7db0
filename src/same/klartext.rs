//! Blocks of Klartext that leave the coordinates and the machine where they are, apart from their motions.

/// First words of blocks that are in the motions, or that set something a later block reads.
const FIRST: [&str; 13] = [
    "L", "LN", "C", "CR", "CT", "CC", "LP", "CP", "CTP", "RND", "CHF", "LBL", "BLK",
];

/// Spindle, coolant, the call of a cycle: TNC 640 user's manual, M functions.
const CODES: [&str; 8] = ["3", "4", "5", "8", "9", "13", "14", "99"];

/// Whether a block certainly does, as far as its text says.
pub(crate) fn keeps_place(text: &str) -> bool {
    let text = text.split(';').next().unwrap_or_default().to_ascii_uppercase();
    let text = text
        .trim()
        .trim_start_matches(|sign: char| sign.is_ascii_digit())
        .trim_start();
    let length = text.bytes().take_while(u8::is_ascii_alphabetic).count();
    let (first, rest) = text.split_at(length);
    let keeps = text.is_empty() || FIRST.contains(&first) || is_hole_cycle(first, rest) || computes(first, rest);
    keeps && codes(text).all(|code| CODES.contains(&code))
}

/// FN 0 to FN 12: values of parameters, and jumps. FN 17 and others write to the control.
fn computes(first: &str, rest: &str) -> bool {
    let rest = rest.trim_start();
    let length = rest.bytes().take_while(u8::is_ascii_digit).count();
    first == "FN" && rest[..length].parse::<u32>().is_ok_and(|number| number <= 12)
}

/// `CYCL DEF` of a cycle from 200 on, which runs where it is called, or `CYCL CALL`.
fn is_hole_cycle(first: &str, rest: &str) -> bool {
    let words: Vec<&str> = rest.split_whitespace().collect();
    first == "CYCL"
        && match words[..] {
            ["CALL", ref more @ ..] => more
                .iter()
                .all(|word| !word.starts_with("PAT") && !word.starts_with("POS")),
            ["DEF", number, ..] => number
                .parse::<u32>()
                .is_ok_and(|number| matches!(number, 200..=209 | 240 | 241)),
            _ => false,
        }
}

/// The numbers of the M codes of a block.
fn codes(text: &str) -> impl Iterator<Item = &str> {
    let starts = text.match_indices('M').map(|(at, _)| at);
    let starts = starts.filter(|at| !text[..*at].ends_with(|sign: char| sign.is_ascii_alphabetic()));
    starts.filter_map(|at| {
        let rest = &text[at + 1..];
        let length = rest.bytes().take_while(u8::is_ascii_digit).count();
        // `MAX` and the like are words; `MQ5` names no number
        (length > 0 || rest.starts_with('Q')).then_some(&rest[..length])
    })
}

#[cfg(test)]
mod tests {
    use super::keeps_place;

    #[test]
    fn lines_holes_and_coolant_keep_the_place() {
        for text in [
            "L Z50 FMAX",
            "12 L X+5 M8 ; M6",
            "L X1 M3M8",
            "CYCL DEF 200 DRILLING Q200=2",
            "CYCL CALL M8",
            "LBL 1",
            "FN 1: Q5 = +1 + +2",
        ] {
            assert!(keeps_place(text), "{text}");
        }
        for text in [
            "TOOL CALL 2 Z",
            "L X1 M6",
            "L X1 M91",
            "L MQ5",
            "L X1 M3M50",
            "CYCL DEF 7.0 DATUM SHIFT",
            "CYCL DEF 247 DATUM SETTING",
            "PLANE RESET STAY",
            "TRANS DATUM",
            "Q5 = 1",
            "FN 17: SYSWRITE ID 508 NR1 = +1",
            "CALL PGM A",
        ] {
            assert!(!keeps_place(text), "{text}");
        }
    }
}
