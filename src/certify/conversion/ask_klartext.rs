//! What a Klartext block asks for beside its motions. What this file does not name is the control's own.
use super::ask::{Ask, Coolant, Found, Why};
use super::ask_iso::plain;
use trunnion_interp::{SentenceWord, sentence_words};
use trunnion_syntax::{Block, TextRange};

/// First words of blocks whose motions, tools, feeds and frames the run follows, or says that it cannot.
const HELD: &[&str] = &[
    "L", "LN", "C", "CR", "CT", "LP", "CP", "CTP", "CC", "RND", "CHF", "APPR", "DEP", "FL", "FLT", "FC", "FCT", "FPOL",
    "FSELECT", "TOOL", "CYCL", "CYCLE", "PLANE", "BEGIN", "END", "LBL", "CALL", "SEL", "TRANS", "PRESET", "TCH",
    "PATTERN", "CONTOUR", "SPL", "DECLARE", "IF", "ELSE", "ELSEIF", "WHILE", "FOR", "BREAK", "CONTINUE", "STOP", "M",
    "X", "Y", "Z", "A", "B", "IX", "IY", "IZ", "IA", "IB", "IC", "U", "V", "W", "R",
];

/// What a block asks for.
pub(super) fn sentence_asks(block: &Block<'_>) -> Found {
    let mut found = Found::default();
    let Some(sentence) = block.sentence() else {
        return found;
    };
    let range = sentence.range;
    if sentence.skips {
        found.own(range, "/", "/", Why::Switch);
    }
    let text = sentence.text();
    let words: Vec<SentenceWord> = sentence_words(&text).collect();
    let Some(first) = words.first() else { return found };
    let whole = || plain(&String::from_utf8_lossy(&text));
    let number = first.number.filter(|number| *number >= 0.0).map(|number| number as u32);
    match first.name.as_str() {
        "STOP" => found.asks.push((range, Ask::Stop { optional: false })),
        "BLK" => found.asks.push((range, Ask::Idle("BLK FORM".to_owned()))),
        "FN" => parameters(number, &whole(), range, &mut found),
        "" => stored(&whole(), range, &mut found),
        "CYCL" | "CYCLE" => {
            cycle(&words, &whole(), range, &mut found);
            return found;
        }
        "TOOL" => deltas(&words, &whole(), range, &mut found),
        "FUNCTION" if words.iter().any(|word| word.name == "TCPM") => {}
        // the tool table's deltas act along the normal
        "LN" if words.iter().any(|word| word.name == "NX") => found.own(range, "NX", whole(), Why::Machine),
        held if HELD.contains(&held) => {}
        _ => found.own(range, first.name.clone(), whole(), Why::Machine),
    }
    // in these a name may be M
    if matches!(
        first.name.as_str(),
        "BEGIN" | "END" | "LBL" | "CALL" | "SEL" | "BLK" | "FN" | ""
    ) {
        return found;
    }
    let guide = words
        .iter()
        .position(|word| word.name == "M" && word.number == Some(128.0));
    if guide.is_some_and(|at| words[at..].iter().any(|word| word.name == "F")) {
        // the highest feed of the motions that keep the tip in place
        found.own(range, "M128 F", whole(), Why::Machine);
    }
    let stops = first.name == "STOP";
    for word in words
        .iter()
        .filter(|word| word.name == "M" && !(stops && word.number == Some(0.0)))
    {
        match word.number {
            Some(code) => by_code(code as u32, range, &mut found),
            None => found.own(range, "M", whole(), Why::Machine),
        }
    }
    found
}

/// An M code.
fn by_code(code: u32, range: TextRange, found: &mut Found) {
    let name = format!("M{code}");
    let coolant = |coolant| (range, Ask::Coolant(coolant));
    let why = match code {
        3 => {
            found.counter_clockwise = Some(false);
            return;
        }
        4 => {
            found.counter_clockwise = Some(true);
            return;
        }
        13 | 14 => {
            found.counter_clockwise = Some(code == 14);
            found.asks.push(coolant(Coolant::Flood));
            return;
        }
        7 => return found.asks.push(coolant(Coolant::Mist)),
        8 => return found.asks.push(coolant(Coolant::Flood)),
        9 => return found.asks.push(coolant(Coolant::Off)),
        0 | 1 => return found.asks.push((range, Ask::Stop { optional: code == 1 })),
        // motions, ways of rotary axes, feeds and the end are those of the run, which reports what it does not follow
        2 | 5 | 6 | 30 | 89 | 91 | 99 | 114..=116 | 126..=130 | 136 | 137 | 140 | 143..=145 => return,
        // they end what is refused where it begins
        102 | 108 | 111 | 113 | 117 | 135 | 149 => return found.asks.push((range, Ask::Idle(name))),
        19 => Why::Oriented,
        90 | 97 | 98 | 112 | 120 | 124 | 134 => Why::PathControl,
        92 | 94 | 103 | 109 | 110 | 118 | 138 => Why::Motion,
        _ => Why::Machine,
    };
    found.own(range, name.clone(), name, why);
}

/// `FN 0: Q5 = +2`: values that outlive the program are stored; of the other functions those that only read or jump ask for nothing.
fn parameters(number: Option<u32>, text: &str, range: TextRange, found: &mut Found) {
    match number {
        Some(0..=8 | 13 | 18) => match text.split_once(':') {
            Some((_, assigned)) => stored(assigned.trim(), range, found),
            None => stored(
                text.trim_start_matches(|c: char| c.is_alphanumeric()).trim(),
                range,
                found,
            ),
        },
        Some(9..=12) => {}
        Some(14) => found.own(range, "FN 14", text, Why::Waits),
        Some(17) => found.own(range, "FN 17", text, Why::Stored),
        Some(other) => found.own(range, format!("FN {other}"), text, Why::Machine),
        None => found.own(range, "FN", text, Why::Machine),
    }
}

/// `Q5 = 2`: Q and QR keep their values after the program; QL are its own.
fn stored(text: &str, range: TextRange, found: &mut Found) {
    let name: String = text.chars().take_while(char::is_ascii_alphanumeric).collect();
    if !name.starts_with("QL") && !name.starts_with("QS") {
        found.own(range, name, text, Why::Stored);
    }
}

/// Cycles that only drill, place or wait are motions. The run reports those that it does not follow.
fn cycle(words: &[SentenceWord], text: &str, range: TextRange, found: &mut Found) {
    let defines = words.iter().find(|word| word.name == "DEF");
    let Some(number) = defines.and_then(|word| word.number) else {
        return;
    };
    let why = match number as u32 {
        2 | 17 | 18 | 206 | 207 | 209 | 262..=267 => Why::Synchronised,
        13 => Why::Oriented,
        32 | 332 => Why::PathControl,
        202 | 204 => Why::Motion,
        _ => return,
    };
    // lines that follow the first one of an old cycle belong to it
    if number.fract() == 0.0 || (number.fract() * 10.0).round() <= 1.0 {
        found.own(range, format!("CYCL DEF {}", number.trunc()), text, why);
    }
}

/// Deltas of the radius: who compensates with them is the control.
fn deltas(words: &[SentenceWord], text: &str, range: TextRange, found: &mut Found) {
    for word in words.iter().skip(1) {
        if matches!(word.name.as_str(), "DR" | "DR2") && word.number != Some(0.0) {
            found.own(range, word.name.clone(), text, Why::Machine);
        }
    }
}
