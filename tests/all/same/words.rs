//! Words of a base as text, and what they can be changed to.

/// What may happen to a word without a consequence.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Freedom {
    None,
    Deletion,
    Anything,
}

/// A word as it is written: `X`, `10.` or `CR=`, `10` or `TRANS` with nothing, or an APT record and its text.
#[derive(Clone)]
pub(crate) struct Word {
    pub(crate) head: String,
    pub(crate) value: String,
    pub(crate) freedom: Freedom,
}

impl Word {
    pub(crate) fn text(&self) -> String {
        format!("{}{}", self.head, self.value)
    }
    pub(crate) fn letter(&self) -> Option<char> {
        let mut chars = self.head.chars();
        let letter = chars.next().filter(char::is_ascii_uppercase)?;
        (chars.next().is_none() && !self.value.is_empty()).then_some(letter)
    }
    /// G1, M6 or TRANS: what the table may list.
    pub(crate) fn code(&self) -> Option<String> {
        match self.letter() {
            Some('G' | 'M') => Some(self.text()),
            Some(_) => None,
            None => (self.value.is_empty() && self.head.chars().all(|c| c.is_ascii_alphanumeric()))
                .then(|| self.head.clone()),
        }
    }
}

pub(crate) const LETTERS: &str = "XYZABCIJKRFSTHDPQLE";

pub(crate) fn is_layout(line: &str) -> bool {
    line == "%" || line.starts_with('(') || line.starts_with(';') || line.starts_with("O0")
}

pub(crate) fn line_of(words: &[Word]) -> String {
    words.iter().map(Word::text).collect::<Vec<_>>().join(" ")
}

pub(crate) fn spelled(words: &[Word], spell: impl Fn(&Word) -> String) -> String {
    words.iter().map(spell).collect::<Vec<_>>().join(" ")
}

pub(crate) fn leading_zero(word: &Word) -> String {
    let whole = word.value.len() == 1 && word.value.bytes().all(|b| b.is_ascii_digit());
    match word.letter() {
        Some(letter @ ('G' | 'M' | 'T' | 'H' | 'D')) if whole => format!("{letter}0{}", word.value),
        _ => word.text(),
    }
}

pub(crate) fn trailing_zero(word: &Word) -> String {
    match word.letter() {
        Some('X' | 'Y' | 'Z' | 'A' | 'C' | 'U' | 'W' | 'F' | 'I' | 'J' | 'K' | 'R') if word.value.contains('.') => {
            word.text() + "0"
        }
        _ => word.text(),
    }
}

/// Cuts a line of a base: words are apart by blanks, `{}` and `<>` mark them. An APT record is one word.
pub(crate) fn words(line: &str, apt: bool) -> Vec<Word> {
    let comparison = |text: &str| text.contains("AC_DTEB");
    let parts: Vec<&str> = if apt || is_layout(line) || comparison(line) {
        vec![line]
    } else {
        line.split(' ').collect()
    };
    let word = |part: &str| -> Word {
        let (freedom, bare) = match part.as_bytes() {
            [b'{', .., b'}'] => (Freedom::Deletion, &part[1..part.len() - 1]),
            [b'<', .., b'>'] => (Freedom::Anything, &part[1..part.len() - 1]),
            _ if is_layout(part) => (Freedom::Anything, part),
            _ => (Freedom::None, part),
        };
        let cut = match bare.find(['=', '/', '(']).filter(|_| !is_layout(bare)) {
            Some(i) => i + 1,
            None if bare.len() > 1 && !bare.as_bytes()[1].is_ascii_alphabetic() => 1,
            None => bare.len(),
        };
        Word {
            head: bare[..cut].to_owned(),
            value: bare[cut..].to_owned(),
            freedom,
        }
    };
    parts.into_iter().map(word).collect()
}

/// Each number in a word's value, changed in each way that cannot be the same number.
pub(crate) fn other_values(word: &Word) -> Vec<Word> {
    let letter = word.letter();
    if matches!(letter, Some('G' | 'M' | 'N' | 'O')) {
        return Vec::new();
    }
    let call = word.head.ends_with('(') || word.head.ends_with('/');
    let fractions = letter.is_none_or(|letter| "XYZABCIJKRFUW".contains(letter));
    let mut all = Vec::new();
    for (number, (start, end)) in numbers(&word.value).into_iter().enumerate() {
        if without_effect(word, number) {
            continue;
        }
        let old = &word.value[start..end];
        let value: f64 = old.parse().expect("digits");
        let mut others = vec![value + 1.0, value * 10.0];
        if fractions {
            others.push(value + 0.01);
        }
        // the signs of a cycle's arguments and of Q may be ignored
        if !call && letter != Some('Q') {
            others.push(-value);
        }
        for other in others.into_iter().filter(|other| *other != value) {
            let point = if old.contains('.') && other.fract() == 0.0 {
                "."
            } else {
                ""
            };
            let other = format!("{}{point}", (other * 1e9).round() / 1e9);
            let value = format!("{}{other}{}", &word.value[..start], &word.value[end..]);
            all.push(Word { value, ..word.clone() });
        }
    }
    all
}

/// APT: the length of a vector, and the place of a circle's centre along its axis, may be anything.
pub(crate) fn without_effect(word: &Word, number: usize) -> bool {
    match word.head.as_str() {
        "GOTO/" => number == 5,
        "CIRCLE/" => number == 2 || number == 5,
        _ => false,
    }
}

/// Where numbers stand in a text: start and end in bytes. Digits behind a letter are part of a name.
pub(crate) fn numbers(text: &str) -> Vec<(usize, usize)> {
    let bytes = text.as_bytes();
    let (mut all, mut i) = (Vec::new(), 0);
    while i < bytes.len() {
        let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
        let dot = |i: usize| bytes.get(i) == Some(&b'.');
        let sign = usize::from(bytes[i] == b'-' && (i == 0 || !bytes[i - 1].is_ascii_alphanumeric()));
        if digit(i + sign) || (dot(i + sign) && digit(i + sign + 1)) {
            let mut end = i + sign;
            while digit(end) || dot(end) {
                end += 1;
            }
            all.push((i, end));
            i = end;
        } else if bytes[i].is_ascii_alphabetic() {
            while bytes.get(i).is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_') {
                i += 1;
            }
        } else {
            i += 1;
        }
    }
    all
}

/// Two neighbours with their letters exchanged, where that says something else.
pub(crate) fn swapped(a: &Word, b: &Word) -> Option<[Word; 2]> {
    let (x, y) = (a.letter()?, b.letter()?);
    let good = |letter: char| LETTERS.contains(letter);
    let free = a.freedom == Freedom::None && b.freedom == Freedom::None;
    let same = a.value.parse::<f64>().ok() == b.value.parse::<f64>().ok();
    (free && good(x) && good(y) && x != y && !same).then(|| {
        [
            Word {
                head: y.to_string(),
                ..a.clone()
            },
            Word {
                head: x.to_string(),
                ..b.clone()
            },
        ]
    })
}

/// APT: other motions, other stops, and other minor words.
pub(crate) fn other_majors(word: &Word) -> Vec<Word> {
    const MAJORS: &[&[&str]] = &[&["GOTO/", "GODLTA/", "FROM/"], &["STOP", "OPSTOP"]];
    const MINORS: &[&[&str]] = &[
        &["MMPM", "MMPR", "IPM", "IPR"],
        &["CLW", "CCLW", "OFF"],
        &["RPM", "SFM", "SMM"],
        &["FLOOD", "MIST", "THRU", "AIR", "OFF"],
    ];
    let majors = MAJORS
        .iter()
        .filter(|group| group.contains(&word.head.as_str()))
        .copied()
        .flatten();
    let mut all: Vec<Word> = majors
        .filter(|other| **other != word.head)
        .map(|other| Word {
            head: (*other).to_owned(),
            ..word.clone()
        })
        .collect();
    for group in MINORS {
        for (i, part) in word
            .value
            .split(',')
            .enumerate()
            .filter(|(_, part)| group.contains(part))
        {
            // OFF belongs to the spindle and to the coolant
            let fits =
                |other: &&&str| **other != part && (part != "OFF" || (word.head == "SPINDL/") == (group[0] == "CLW"));
            for other in group.iter().filter(fits) {
                let mut parts: Vec<&str> = word.value.split(',').collect();
                parts[i] = other;
                all.push(Word {
                    value: parts.join(","),
                    ..word.clone()
                });
            }
        }
    }
    all
}
