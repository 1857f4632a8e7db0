//! Every difference from `rs274` that is accepted: when, and why.
use crate::Answer;

/// A difference that is accepted.
pub(crate) struct Explanation {
    /// The reason, in words.
    pub(crate) why: &'static str,
    /// Whether it explains how the control's answer and ours differ.
    pub(crate) holds: fn(control: &Answer, ours: &Answer) -> bool,
}

/// All of them.
pub(crate) const EXPLAINED: &[Explanation] = &[
    Explanation {
        why: "the sign of a zero: it depends on the order of sums and says nothing about where the tool goes",
        holds: |control, ours| {
            same_but(control, ours, |a, b| {
                a.replace("-0.0000", "0.0000") == b.replace("-0.0000", "0.0000")
            })
        },
    },
    Explanation {
        why: "the last decimal off by one: between two decimals the last bit of a sum decides, which depends on the order of additions",
        holds: |control, ours| same_but(control, ours, last_decimal),
    },
    Explanation {
        why: "refused by name, since it is not proved that our answer would be the control's",
        holds: |control, ours| !ours.good && is_refused(&ours.error) && is_head(&ours.calls, &control.calls),
    },
    Explanation {
        why: "the control never ends, we say so",
        holds: |control, ours| {
            control.hangs && !ours.good && (ours.error.contains("never ends") || ours.error.contains("does not end"))
        },
    },
    Explanation {
        why: "the message is the same; the control quotes a line that it made itself (M72 restores by blocks of its own, a turning cycle calls \
              its subprogram by one)",
        holds: |control, ours| {
            let [(a, quoted), (b, _)] =
                [control, ours].map(|answer| answer.error.split_once('\n').unwrap_or((&answer.error, "")));
            let made = quoted.starts_with(" G")
                || quoted.starts_with(" F")
                || quoted.starts_with(" S")
                || quoted.starts_with(" M")
                || (quoted.starts_with('O') && quoted.ends_with("CALL"));
            a == b && made && control.good == ours.good && same_calls(control, ours)
        },
    },
    Explanation {
        why: "a program without anything in it: the control does not begin to run it, so it does not reset the machine either",
        holds: |control, ours| {
            let first = |answer: &Answer| answer.error.lines().next().map(str::to_owned);
            first(control) == first(ours) && first(control).as_deref() == Some("File ended with no percent sign")
        },
    },
    Explanation {
        why: "the control never ends behind the last arc of a turning cycle, by its rounding; all that it told until then is ours",
        holds: |control, ours| {
            let last = control.calls.last().is_some_and(|line| line.contains("ARC_FEED"));
            control.hangs && last && control.calls.iter().zip(&ours.calls).all(|(a, b)| alike(a, b))
        },
    },
    Explanation {
        why: "the control crashes (a corner in a turning contour with nothing before it), we refuse",
        holds: |control, ours| control.crashed && !ours.good && is_refused(&ours.error),
    },
];

/// Messages of what this interpreter does not model.
const REFUSED: [&str; 10] = [
    "pockets of a turning contour with several arcs: where the control cuts them is not known",
    "M61 or G10 L0 with cutter radius compensation on: where the control goes on from is not known",
    "a spline (G5, G5.1) before the end of another one (G5.2): the control mixes their control points",
    "corner of a turning contour with nothing before it: the control crashes",
    "block in the contour of a turning cycle: how the control takes it is not known",
    "corner of a turning contour that has no room for its radius or chamfer",
    "contour of a turning cycle whose allowance is greater than its details at the ends: the way of the tool is not known",
    "corner of a turning contour that is nearly straight, with an allowance: how the control rounds it is not known",
    "G70 with cutter compensation: the way of the tool is not known",
    "arc of a turning contour with its deepest point inside, or with unequal radii: how the control cuts there is not known",
];

fn is_refused(error: &str) -> bool {
    error.lines().next().is_some_and(|line| REFUSED.contains(&line))
}

/// The calls before the refusal are the control's; two calls behind it reset the machine.
fn is_head(ours: &[String], control: &[String]) -> bool {
    let head = ours
        .iter()
        .take_while(|line| !line.ends_with("ON_RESET()") || line.starts_with("    6 "));
    head.zip(control).all(|(a, b)| alike(a, b))
}

fn alike(a: &str, b: &str) -> bool {
    a == b || a.replace("-0.0000", "0.0000") == b.replace("-0.0000", "0.0000") || last_decimal(a, b)
}

/// Equal but for lines for which `same` holds.
fn same_but(control: &Answer, ours: &Answer, same: fn(&str, &str) -> bool) -> bool {
    control.good == ours.good
        && control.error == ours.error
        && control.calls.len() == ours.calls.len()
        && control.calls.iter().zip(&ours.calls).all(|(a, b)| a == b || same(a, b))
}

fn same_calls(control: &Answer, ours: &Answer) -> bool {
    control.calls.len() == ours.calls.len() && control.calls.iter().zip(&ours.calls).all(|(a, b)| alike(a, b))
}

/// Two lines differ in the last decimal of numbers alone.
fn last_decimal(a: &str, b: &str) -> bool {
    let split =
        |text: &str| -> Vec<String> { text.split([' ', ',', '(', ')', '"', '\t']).map(str::to_owned).collect() };
    let (a, b) = (split(a), split(b));
    let whole = |text: &str| -> Option<i128> {
        let (_, decimals) = text.split_once('.')?;
        if !matches!(decimals.len(), 4 | 6) {
            return None;
        }
        text.replacen('.', "", 1).parse().ok()
    };
    a.len() == b.len()
        && a.iter()
            .zip(&b)
            .all(|(a, b)| a == b || matches!((whole(a), whole(b)), (Some(a), Some(b)) if a.abs_diff(b) <= 1))
}
