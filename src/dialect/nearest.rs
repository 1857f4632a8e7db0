//! What to say about an unknown name: the known name that it most resembles, or the list of known names.

/// Longer names are not compared.
const LONGEST: usize = 64;

/// The name in `known` that differs least from `wanted`, if at most a third of its characters differ.
pub fn nearest<'a>(wanted: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if wanted.len() > LONGEST {
        return None;
    }
    let letters = letters(wanted);
    let wanted: Vec<char> = wanted.chars().collect();
    let most = wanted.len() / 3;
    let mut rows = [const { Vec::new() }; 3];
    let near = known.filter_map(|name| {
        // a program may hold millions of unknown names: most known ones are ruled out at a glance. A change takes away one letter at most,
        // and brings one
        if length(name).abs_diff(wanted.len()) > most
            || (self::letters(name) ^ letters).count_ones() as usize > 2 * most
        {
            return None;
        }
        Some((distance_within(most, &wanted, name, &mut rows)?, name))
    });
    near.min().map(|(_, name)| name)
}

/// Characters of a name.
fn length(name: &str) -> usize {
    if name.is_ascii() {
        name.len()
    } else {
        name.chars().count()
    }
}

/// The set of its letters; several letters share a bit.
fn letters(name: &str) -> u64 {
    name.chars().fold(0, |set, letter| set | 1 << (letter as u32 % 64))
}

/// Characters to add, remove, replace or swap with their neighbour to turn one text into the other (optimal string alignment: Damerau 1964,
/// Levenshtein 1966), if no more than `most`; `rows`: storage that is used again.
fn distance_within(most: usize, to: &[char], from: &str, rows: &mut [Vec<usize>; 3]) -> Option<usize> {
    rows[2].clear();
    rows[2].extend(0..=to.len());
    let (mut ours_before, mut least_before) = (None, 0);
    for (i, ours) in from.chars().enumerate() {
        // two rows back, one row back, and the row that is written
        rows.rotate_left(1);
        rows[2].resize(to.len() + 1, 0);
        let [two_back, back, row] = rows;
        row[0] = i + 1;
        let mut least = row[0];
        for (j, theirs) in to.iter().enumerate() {
            let mut changes = (back[j] + usize::from(ours != *theirs))
                .min(row[j] + 1)
                .min(back[j + 1] + 1);
            if j > 0 && ours_before == Some(*theirs) && to[j - 1] == ours {
                changes = changes.min(two_back[j - 1] + 1);
            }
            row[j + 1] = changes;
            least = least.min(changes);
        }
        // no later row has a smaller number than the least of two
        if least.min(least_before) > most {
            return None;
        }
        (ours_before, least_before) = (Some(ours), least);
    }
    Some(rows[2][to.len()]).filter(|changes| *changes <= most)
}

/// The end of a sentence about an unknown name: ``; did you mean `name`?`` if one is near, else `other`.
pub fn did_you_mean(wanted: &str, known: &[&str], other: &str) -> String {
    let names = match nearest(wanted, known.iter().copied()) {
        Some(name) => vec![name],
        None => family(wanted, known),
    };
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => other.to_owned(),
        Some((last, [])) => format!("; did you mean {last}?"),
        Some((last, before)) => format!("; did you mean {} or {last}?", before.join(", ")),
    }
}

/// The names whose first part (up to `-`) is near: `haas` begins `haas-ngc` and `haas-lathe`. None where they are too many to choose from.
fn family<'a>(wanted: &str, known: &[&'a str]) -> Vec<&'a str> {
    const MOST: usize = 4;
    let head = |name: &'a str| name.split_once('-').map(|(head, _)| head);
    let Some(near) = nearest(wanted, known.iter().filter_map(|name| head(name))) else {
        return Vec::new();
    };
    let names: Vec<&str> = known.iter().copied().filter(|name| head(name) == Some(near)).collect();
    if names.len() > MOST { Vec::new() } else { names }
}

/// [`did_you_mean`] with the list of all names where none is near; `what`: what they are, in the plural.
pub fn or_known(wanted: &str, known: &[&str], what: &str) -> String {
    did_you_mean(wanted, known, &format!("; known {what}: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINES: &[&str] = &["mikron-ucp710", "mill-3axis", "mill-4axis-a"];

    fn near(wanted: &str) -> Option<&'static str> {
        nearest(wanted, MACHINES.iter().copied())
    }

    #[test]
    fn a_slip_finds_the_name() {
        for wanted in ["mikron-ucp71", "mikron-upc710", "Mikron-ucp710", "mikronucp710"] {
            assert_eq!(near(wanted), Some("mikron-ucp710"), "{wanted}");
        }
        assert_eq!(near("mill-5axis"), Some("mill-3axis"));
    }

    #[test]
    fn the_first_part_finds_its_family() {
        let mean = |wanted| did_you_mean(wanted, MACHINES, "");
        assert_eq!(mean("mikron"), "; did you mean `mikron-ucp710`?");
        assert_eq!(mean("mil"), "; did you mean `mill-3axis` or `mill-4axis-a`?");
        assert_eq!(mean("maho"), "");
    }

    #[test]
    fn what_resembles_nothing_gets_the_list() {
        assert_eq!(near("nope"), None);
        assert_eq!(near(""), None);
        assert_eq!(near(&"m".repeat(100_000)), None);
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
    fn what_is_ruled_out_at_a_glance_is_not_near() {
        let known = [
            "TRAORI", "TRAFOOF", "CYCLE81", "CYCLE800", "ATRANS", "AROT", "ROT", "Größe", "GROESSE",
        ];
        for wanted in [
            "TRAORY", "TAROT", "AROTT", "CYCLE18", "grösse", "Groeße", "RTO", "CYKLE800", "ANSTAR", "X",
        ] {
            let to: Vec<char> = wanted.chars().collect();
            let all = known.iter().filter_map(|name| {
                let changes = distance_within(to.len() / 3, &to, name, &mut Default::default())?;
                Some((changes, *name))
            });
            assert_eq!(
                nearest(wanted, known.into_iter()),
                all.min().map(|(_, name)| name),
                "{wanted}"
            );
        }
    }

    #[test]
    fn distances_of_texts() {
        for (from, to, changes) in [
            ("", "", 0),
            ("", "abc", 3),
            ("kitten", "sitting", 3),
            ("abc", "acb", 1),
            ("SPUA", "SUPA", 1),
            ("ab", "bca", 3),
            ("größe", "grösse", 2),
        ] {
            for (one, other) in [(from, to), (to, from)] {
                let other: Vec<char> = other.chars().collect();
                let within = |most| distance_within(most, &other, one, &mut Default::default());
                for most in 0..9 {
                    assert_eq!(
                        within(most),
                        Some(changes).filter(|_| changes <= most),
                        "{from} {to} {most}"
                    );
                }
            }
        }
    }
}
