//! Sample programs with one number changed.
use super::reading::{Expected, Pair};
use super::words::{Freedom, Word, numbers, without_effect};

/// A program as it is, with each number of each word increased by one: block numbers, codes, program names and comments stay.
pub(crate) fn numbers_changed(name: &str, text: &str, dialect: &str, machine: &str) -> Vec<Pair> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let code = line.split(['(', ';']).next().unwrap_or_default();
        // the numbers of a code that ends mirroring have no meaning
        let ends_mirror = code.starts_with("G50.1 ") || code.starts_with("G100 ");
        if code.starts_with(['%', 'O', '$']) || code.contains("PARTNO") || ends_mirror {
            continue;
        }
        for (start, end) in numbers_of_words(code, dialect == "apt") {
            let old: f64 = code[start..end].parse().expect("digits");
            let point = if code[start..end].ends_with('.') { "." } else { "" };
            let other = format!(
                "{}{}{point}{}",
                &line[..start],
                ((old + 1.0) * 1e9).round() / 1e9,
                &line[end..]
            );
            let mut changed = lines.clone();
            changed[at] = &other;
            all.push(Pair {
                name: format!("{name}: line {}: `{line}` to `{other}`", at + 1),
                expected: Expected::Different,
                dialect: dialect.to_owned(),
                dialect_after: None,
                machine: machine.to_owned(),
                claim: None,
                before: text.to_owned(),
                after: changed.join("\n") + "\n",
                files: Vec::new(),
            });
        }
    }
    all
}

/// Where the numbers of words stand that are no G, M or N word.
fn numbers_of_words(code: &str, apt: bool) -> Vec<(usize, usize)> {
    let numeric = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    if apt {
        let word = code.split('/').next().unwrap_or_default();
        let all = numbers(code).into_iter().enumerate();
        let without = |number: usize| {
            let word = Word {
                head: format!("{word}/"),
                value: String::new(),
                freedom: Freedom::None,
            };
            without_effect(&word, number)
        };
        return all
            .filter(|(number, _)| !without(*number))
            .map(|(_, place)| place)
            .collect();
    }
    let mut all = Vec::new();
    for (i, letter) in code.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()) {
        let alone = i == 0 || !code.as_bytes()[i - 1].is_ascii_alphabetic();
        let end = code[i + 1..].find(|c| !numeric(c)).map_or(code.len(), |n| i + 1 + n);
        if alone && !"GMN".contains(letter) && end > i + 1 {
            all.push((i + 1, end));
        }
    }
    all
}
