//! Whatever the input, a check ends with a report whose places lie in the file; and it says the same each time.
use proptest::prelude::*;
use trunnion_check::{Settings, Status, check, rules};
use trunnion_interp::{Limits, Setup};

const DIALECTS: [&str; 4] = ["iso-6983", "linuxcnc", "sinumerik-840d", "apt"];

fn settings(dialect: usize, machine: &str) -> Settings<'static> {
    Settings {
        dialect: trunnion_dialect::builtin(DIALECTS[dialect % DIALECTS.len()]).expect("the dialect is built in"),
        machine: trunnion_machine::builtin(machine),
        // a loop that a cut has made endless is to be given up soon
        setup: Setup {
            limits: Limits {
                blocks: 10_000,
                ..Limits::default()
            },
            ..Setup::default()
        },
        rules: Vec::new(),
        assume: trunnion_check::Assume::default(),
        port_to: Vec::new(),
        scope: None,
        control_known: true,
        foreign: None,
    }
}

fn judge(source: &[u8], dialect: usize) {
    for machine in ["mikron-ucp710", "mill-3axis", "none"] {
        let settings = settings(dialect, machine);
        let program = trunnion_syntax::parse(source.to_vec(), settings.dialect.lex);
        let report = check(&program, &settings);
        let end = source.len() as u32;
        for found in &report.diagnostics {
            let places = found
                .related
                .iter()
                .map(|(range, _)| *range)
                .chain([found.range, found.last]);
            for range in places {
                assert!(
                    range.start <= range.end && range.end <= end,
                    "{}: {range:?} of {end}",
                    found.rule
                );
            }
            assert!(!found.message.is_empty() && found.count >= 1, "{}", found.rule);
            assert!(
                found.status == Status::Fail || found.severity == trunnion_check::Severity::Info,
                "{}",
                found.rule
            );
        }
        assert!(
            report
                .diagnostics
                .is_sorted_by_key(|found| program.block_at(found.range.start)),
            "not sorted by block"
        );
        assert_eq!(report.diagnostics, check(&program, &settings).diagnostics);
    }
}

/// Every example of every rule, as one text.
fn examples() -> Vec<u8> {
    let docs = rules().iter().flat_map(|rule| rule.docs.lines());
    docs.collect::<Vec<_>>().join("\n").into_bytes()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn random_bytes(source in proptest::collection::vec(any::<u8>(), 0..400), dialect in 0usize..4) {
        judge(&source, dialect);
    }

    #[test]
    fn random_words(source in "((N[0-9]{1,3} )?[GMXYZACFSTDHIJKR][-]?[0-9]{0,4}[.]?[0-9]{0,3}[ \n;(/=]){0,60}", dialect in 0usize..4) {
        judge(source.as_bytes(), dialect);
    }

    #[test]
    fn cut_and_swapped_examples(cuts in proptest::collection::vec((any::<u32>(), any::<u8>()), 1..12), dialect in 0usize..4) {
        let mut source = examples();
        for (at, byte) in cuts {
            let at = at as usize % source.len();
            match byte % 3 {
                0 => source[at] = byte,
                1 => source.truncate(at.max(1)),
                _ => source.rotate_left(at),
            }
        }
        source.truncate(20_000);
        judge(&source, dialect);
    }
}
