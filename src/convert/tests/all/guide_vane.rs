//! The four strategies of the guide vane paper of 2006, printed as APT vectors and as Sinumerik words: both ways, on a Mikron UCP710.
use crate::support::{assuming, to};
use std::path::Path;
use trunnion_certify::conversion::Assume;
use trunnion_convert::Options;

const MACHINE: &str = "mikron-ucp710";

/// The excerpts as printed, where the data are there.
fn printed(strategy: u32) -> Option<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/guide-vane-2006");
    let read = |kind: &str| std::fs::read_to_string(root.join(format!("strategy-{strategy}.{kind}"))).ok();
    let found = read("apt").zip(read("mpf"));
    if found.is_none() {
        println!("skipped: no data set for strategy {strategy}");
    }
    found
}

fn sample(strategy: u32, kind: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/programs/guide-vane");
    std::fs::read_to_string(root.join(format!("strategy-{strategy}.{kind}"))).expect("the sample is there")
}

fn excerpt() -> Assume {
    Assume {
        tcp: true,
        feed_mm_min: Some(2000.0),
    }
}

/// Values of the words X Y Z A C in each cut; words that are left out stay.
fn words(text: &str) -> Vec<[f64; 5]> {
    let mut now = [f64::NAN; 5];
    let mut rows = Vec::new();
    for line in text.lines() {
        let mut moves = false;
        for word in line.split_whitespace() {
            if let Some(slot) = "XYZAC".find(&word[..1])
                && let Ok(value) = word[1..].parse()
            {
                now[slot] = value;
                moves = true;
            }
        }
        if moves {
            rows.push(now);
        }
    }
    rows
}

/// Numbers behind GOTO/.
fn vectors(text: &str) -> Vec<Vec<f64>> {
    let joined = text.replace("$\n", "");
    let records = joined.lines().filter_map(|line| line.trim().strip_prefix("GOTO"));
    let numbers = |record: &str| {
        let record = record.trim_start_matches([' ', '/']);
        record
            .split(',')
            .map(|number| number.trim().parse().expect("a number"))
            .collect()
    };
    records.map(numbers).collect()
}

/// Rows at the pole: the tool stands straight, and the table's angle is free.
const POLE: [(u32, usize); 2] = [(1, 2), (3, 2)];

#[test]
fn apt_to_iso_gives_the_printed_words() {
    let (mut compared, mut n2930) = (0, None);
    for strategy in 1..=4 {
        let Some((apt, mpf)) = printed(strategy) else { continue };
        let assume = Assume {
            tcp: false,
            ..excerpt()
        };
        let made = assuming(
            (&apt, "apt", ""),
            assume,
            "sinumerik-840d",
            MACHINE,
            &Options::default(),
        )
        .expect("proved");
        assert_eq!((made.proof.motions_before, made.proof.motions_after), (5, 5));
        let (wanted, found) = (words(&mpf), words(&made.text));
        assert_eq!((wanted.len(), found.len()), (5, 5), "{}", made.text);
        for (row, (wanted, found)) in wanted.iter().zip(&found).enumerate() {
            for axis in 0..3 {
                assert!(
                    (wanted[axis] - found[axis]).abs() < 1e-4,
                    "strategy {strategy} row {row}"
                );
            }
            if POLE.contains(&(strategy, row)) {
                continue;
            }
            // N2930: the post of 2006 took an arc cosine near the pole and was 0.0038 deg off
            let limit_a = if (strategy, row) == (2, 2) {
                n2930 = Some(found[3]);
                0.004
            } else {
                0.0020
            };
            assert!(
                (wanted[3] - found[3]).abs() <= limit_a,
                "A: strategy {strategy} row {row}: {wanted:?} {found:?}"
            );
            // the post wound C on by whole turns
            let off_c = (wanted[4] - found[4] + 180.0).rem_euclid(360.0) - 180.0;
            assert!(
                off_c.abs() <= 0.0006,
                "C: strategy {strategy} row {row}: {wanted:?} {found:?}"
            );
            compared += 1;
        }
    }
    if let Some(angle) = n2930 {
        assert!((angle - 0.0772).abs() < 5e-5, "{angle}");
        assert_eq!(compared, 18);
    }
}

#[test]
fn iso_to_apt_gives_the_printed_vectors() {
    for strategy in 1..=4 {
        let Some((apt, mpf)) = printed(strategy) else { continue };
        let made = assuming(
            (&mpf, "sinumerik-840d", MACHINE),
            excerpt(),
            "apt",
            "",
            &Options::default(),
        )
        .expect("proved");
        let (wanted, found) = (vectors(&apt), vectors(&made.text));
        assert_eq!((wanted.len(), found.len()), (5, 5), "{}", made.text);
        for (row, (wanted, found)) in wanted.iter().zip(&found).enumerate() {
            for axis in 0..6 {
                // angles with three digits against vectors with six; at row 2.3 the post's acos was off by 0.0038 deg
                let limit = if axis < 3 { 1e-5 } else { 7e-5 };
                let off = (wanted[axis] - found[axis]).abs();
                assert!(off < limit, "strategy {strategy} row {row} axis {axis}: {off}");
            }
        }
    }
}

#[test]
fn whole_programs_go_both_ways() {
    for strategy in 1..=4 {
        let apt = sample(strategy, "apt");
        let made = to((&apt, "apt", ""), "sinumerik-840d", MACHINE, &Options::default()).expect("proved");
        let back = to((&made.text, "sinumerik-840d", MACHINE), "apt", "", &Options::default()).expect("proved");
        let (wanted, found) = (vectors(&apt), vectors(&back.text));
        assert_eq!(wanted.len(), found.len());
        for (wanted, found) in wanted.iter().zip(&found) {
            let off = |range: core::ops::Range<usize>| {
                range
                    .map(|i| (wanted[i] - found[i]) * (wanted[i] - found[i]))
                    .sum::<f64>()
                    .sqrt()
            };
            assert!(
                off(0..3) < 2e-4 && off(3..6) < 3e-6,
                "strategy {strategy}: {wanted:?} {found:?}"
            );
        }
        let mpf = sample(strategy, "mpf");
        let made = to((&mpf, "sinumerik-840d", MACHINE), "apt", "", &Options::default()).expect("proved");
        assert!(made.text.contains("GOTO/") && made.proof.left_out > 0, "{}", made.text);
        to((&made.text, "apt", ""), "fanuc-30i", MACHINE, &Options::default()).expect("proved");
    }
}

#[test]
fn another_machine_holds_the_tool_the_same_way() {
    for strategy in 1..=4 {
        let mpf = sample(strategy, "mpf");
        let made = to(
            (&mpf, "sinumerik-840d", MACHINE),
            "sinumerik-840d",
            "ferrari-bc",
            &Options::default(),
        );
        let made = made.expect("proved");
        assert!(made.text.contains(" B") && !made.text.contains(" A"), "{}", made.text);
        let (there, here) = (
            ("ferrari-bc", made.text.as_str()),
            to((&mpf, "sinumerik-840d", MACHINE), "apt", "", &Options::default()),
        );
        let back = to((there.1, "sinumerik-840d", there.0), "apt", "", &Options::default()).expect("proved");
        let (wanted, found) = (vectors(&here.expect("proved").text), vectors(&back.text));
        assert_eq!(wanted.len(), found.len());
        for (wanted, found) in wanted.iter().zip(&found) {
            assert!(
                wanted.iter().zip(found).all(|(a, b)| (a - b).abs() < 2e-4),
                "{wanted:?} {found:?}"
            );
        }
    }
}
