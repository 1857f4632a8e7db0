//! What to say about an unknown name: the known name that it most resembles, or the list of known names.

/// Longer names are not compared.
const LONGEST: usize = 64;

/// The name in `known` that differs least from `wanted`, if at most a third of its characters differ.
pub fn nearest<'a>(wanted: &str, known: &[&'a str]) -> Option<&'a str> {
    if wanted.len() > LONGEST {
        return None;
    }
    let most = wanted.chars().count() / 3;
    let distances = known.iter().map(|name| (distance(wanted, name), *name));
    distances
        .filter(|(changes, _)| *changes <= most)
        .min()
        .map(|(_, name)| name)
}

/// Characters to add, remove or replace to turn one text into the other (Levenshtein).
fn distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, ours) in from.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, theirs) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(ours != *theirs);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
}

/// The end of a sentence about an unknown name: ``; did you mean `name`?`` if one is near, else `other`.
pub fn did_you_mean(wanted: &str, known: &[&str], other: &str) -> String {
    match nearest(wanted, known) {
        Some(name) => format!("; did you mean `{name}`?"),
        None => other.to_owned(),
    }
}

/// [`did_you_mean`] with the list of all names where none is near; `what`: what they are, in the plural.
pub fn or_known(wanted: &str, known: &[&str], what: &str) -> String {
    did_you_mean(wanted, known, &format!("; known {what}: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINES: &[&str] = &["mikron-ucp710", "mill-3axis", "mill-4axis-a"];

    #[test]
    fn a_slip_finds_the_name() {
        for wanted in ["mikron-ucp71", "mikron-upc710", "Mikron-ucp710", "mikronucp710"] {
            assert_eq!(nearest(wanted, MACHINES), Some("mikron-ucp710"), "{wanted}");
        }
        assert_eq!(nearest("mill-5axis", MACHINES), Some("mill-3axis"));
    }

    #[test]
    fn what_resembles_nothing_gets_the_list() {
        assert_eq!(nearest("nope", MACHINES), None);
        assert_eq!(nearest("", MACHINES), None);
        assert_eq!(nearest(&"m".repeat(100_000), MACHINES), None);
        assert_eq!(
            or_known("nope", MACHINES, "machines"),
            "; known machines: mikron-ucp710, mill-3axis, mill-4axis-a"
        );
        assert_eq!(
            or_known("mill-3axs", MACHINES, "machines"),
            "; did you mean `mill-3axis`?"
        );
    }

    #[test]
    fn distances_of_texts() {
        for (from, to, changes) in [
            ("", "", 0),
            ("", "abc", 3),
            ("kitten", "sitting", 3),
            ("abc", "acb", 2),
            ("größe", "grösse", 2),
        ] {
            assert_eq!(distance(from, to), changes, "{from} {to}");
            assert_eq!(distance(to, from), changes, "{to} {from}");
        }
    }
}
