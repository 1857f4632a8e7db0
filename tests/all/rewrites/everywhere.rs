//! Every rewrite on the samples and on the programs that people wrote, in ../shared/data: proved, or refused with a reason; what is proved is proved again, is
//! never worse, and a second attempt changes nothing. A sample runs in CI; `TRUNNION_REWRITES=full` takes every program.
#![expect(
    clippy::print_stdout,
    reason = "a skipped test says so, and the long form prints what it counted"
)]
use crate::mutations::programs;
use std::collections::BTreeMap;
use std::path::Path;
use trunnion::certify::{Outcome, recheck};
use trunnion::check::config::parse_tool_flag;
use trunnion::check::{Assume, Settings, Severity, Verdict, check};
use trunnion::dialect::detect;
use trunnion::interp::{Limits, Setup};
use trunnion::machine;
use trunnion::rewrite::{Options, attempt, rewrites};
use trunnion::syntax::parse;

/// One program of so many is taken in CI.
const SAMPLE: usize = 3;

fn rank(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Pass => 0,
        Verdict::Unknown => 1,
        Verdict::Fail => 2,
    }
}

/// Attempts a rewrite; what became of it.
fn judged(name: &str, text: &[u8], settings: &Settings<'_>, path: &Path) -> &'static str {
    let rewrite = trunnion::rewrite::rewrite(name).expect("a rewrite");
    let options = Options {
        tolerance_mm: 0.01,
        ..Options::default()
    };
    let program = parse(text.to_vec(), settings.dialect.lex);
    let place = || format!("{name} on {}", path.display());
    let proved = match attempt(rewrite, &program, settings, &options).outcome() {
        Ok(Some(proved)) => proved,
        Ok(None) => return "nothing to do",
        Err(reason) => {
            assert!(reason.len() > 10, "{}: {reason}", place());
            return "refused";
        }
    };
    assert_ne!(proved.after, text, "{}", place());
    let machine = settings.machine.expect("a machine");
    let again = recheck(
        &proved.certificate,
        text,
        &proved.after,
        settings.dialect,
        machine,
        &proved.setup,
    );
    assert!(matches!(again, Outcome::Proved(_)), "{}: {again:?}", place());
    let after = parse(proved.after.clone(), settings.dialect.lex);
    let verdicts = [&program, &after].map(|program| rank(check(program, settings).verdict(Severity::Error)));
    assert!(verdicts[1] <= verdicts[0], "{}: the verdict is worse", place());
    let second = attempt(rewrite, &after, settings, &options).outcome();
    let second = second.map(|proved| proved.map(|proved| proved.summary));
    assert!(
        !matches!(second, Ok(Some(_))),
        "{}: a second attempt changes more: {second:?}",
        place()
    );
    "proved"
}

#[test]
fn every_rewrite_is_proved_or_refused_on_real_programs() {
    let full = std::env::var("TRUNNION_REWRITES").is_ok_and(|form| form == "full");
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for (index, (path, text)) in programs().iter().enumerate() {
        if !full && index % SAMPLE != 0 {
            continue;
        }
        let found = detect(path.file_name().and_then(|name| name.to_str()), text, None);
        if found.foreign.is_some() {
            continue;
        }
        // machines with and without rotary axes, with tool centre point control and without
        for name in ["mikron-ucp710", "mill-3axis"] {
            let mut setup = Setup {
                limits: Limits {
                    blocks: 20_000,
                    ..Limits::default()
                },
                ..Setup::default()
            };
            setup.tools.push(parse_tool_flag("ball:10").expect("a tool"));
            let mut settings = Settings::new(found.dialect, machine::builtin(name), setup);
            settings.assume = Assume::ALL;
            for rewrite in rewrites() {
                let became = judged(rewrite.name, text, &settings, path);
                *counts.entry((rewrite.name, became)).or_default() += 1;
            }
        }
    }
    if full {
        println!("{counts:#?}");
    }
    let some = |became| counts.keys().any(|(_, known)| *known == became);
    assert!(some("proved") && some("refused") && some("nothing to do"), "{counts:?}");
}
