//! Runs the examples in every rule's header: what is drawn under an example is found, and exactly that; the cure is silent.
#![expect(clippy::print_stdout, reason = "a rule that waits says so")]
use trunnion::check::fixture::Fixture;
use trunnion::check::{Rule, rules};

/// Rules about faults which the interpreter of their example does not report yet: the examples are run, and what they lack
/// is printed. Take a name out of the list once its example holds.
const PENDING: &[&str] = &[];

/// Fences of a section as (info string, text).
fn fences(docs: &str, section: &str) -> Vec<(String, String)> {
    let mut out: Vec<(String, String)> = Vec::new();
    let (mut here, mut inside) = (false, false);
    for line in docs.lines() {
        if let Some(info) = line.strip_prefix("```") {
            inside = !inside;
            if inside && here {
                out.push((info.to_owned(), String::new()));
            }
        } else if inside {
            if let (true, Some((_, text))) = (here, out.last_mut()) {
                text.push_str(line);
                text.push('\n');
            }
        } else if let Some(heading) = line.strip_prefix("# ") {
            here = heading == section;
        }
    }
    out
}

fn examples_hold(rule: &Rule) -> Result<(), String> {
    let bad = fences(rule.docs, "Example");
    if bad.is_empty() {
        return Err("has no example".to_owned());
    }
    for (info, text) in bad {
        let fixture = Fixture::parse(&info, &text);
        if fixture.drawn.iter().all(|drawn| drawn.rule != rule.name) {
            return Err("its example does not draw it".to_owned());
        }
        fixture.compare()?;
    }
    for (info, text) in fences(rule.docs, "Use instead") {
        let report = Fixture::parse(&info, &text).check()?;
        if let Some(found) = report.findings().find(|found| found.rule == rule.name) {
            return Err(format!("its cure is reported: {}", found.message));
        }
    }
    Ok(())
}

#[test]
fn examples_of_all_rules_hold() {
    let mut broken = Vec::new();
    for rule in rules() {
        match examples_hold(rule) {
            Ok(()) => {}
            Err(why) if PENDING.contains(&rule.name) => println!("pending: {}: {why}", rule.name),
            Err(why) => broken.push(format!("{}: {why}", rule.name)),
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn rules_are_sorted_and_unique() {
    let names: Vec<&str> = rules().iter().map(|rule| rule.name).collect();
    let mut sorted = names.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(names, sorted);
}
