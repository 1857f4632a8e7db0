//! Every difference from `rs274` that is accepted: when, and why.
use super::Answer;

/// A difference that is accepted.
pub(crate) struct Explanation {
    /// The reason, in words.
    pub(crate) why: &'static str,
    /// Whether it explains how the control's answer and ours differ.
    pub(crate) holds: fn(control: &Answer, ours: &Ours) -> bool,
}

/// Our answer, and the same with more decimals.
pub(crate) struct Ours {
    pub(crate) answer: Answer,
    pub(crate) exact: Answer,
}

impl Ours {
    /// Without cuts that lead nowhere.
    fn moving(&self) -> Self {
        let gone = standstills(&self.answer);
        Self {
            answer: self.answer.without(&gone),
            exact: self.exact.without(&gone),
        }
    }
}

impl Answer {
    /// Without these calls, and without the numbers of all.
    fn without(&self, gone: &[usize]) -> Self {
        let stays = |(at, _): &(usize, &String)| gone.binary_search(at).is_err();
        let bare = |(_, line): (usize, &String)| match line.split_once(" N") {
            Some((number, rest)) if number.trim().bytes().all(|sign| sign.is_ascii_digit()) => rest.to_owned(),
            _ => line.clone(),
        };
        Self {
            calls: self.calls.iter().enumerate().filter(stays).map(bare).collect(),
            ..self.clone()
        }
    }
}

/// Which calls are straight cuts to where the move before them has led, in the ZX plane of turning cycles.
fn standstills(answer: &Answer) -> Vec<usize> {
    // Z, X, Y, A, B, C of the end: in this order arcs of the ZX plane tell it, too, around their centre and sense
    let end = |line: &str| {
        let (name, numbers) = line.split_once('(')?;
        let numbers: Vec<&str> = numbers.trim_end_matches(')').split(", ").collect();
        let places = if name.ends_with("ARC_FEED") {
            [0, 1, 5, 6, 7, 8]
        } else if name.ends_with("STRAIGHT_FEED") || name.ends_with("STRAIGHT_TRAVERSE") {
            [2, 0, 1, 3, 4, 5]
        } else {
            return None;
        };
        let numbers: Option<Vec<String>> = places
            .iter()
            .map(|&at| numbers.get(at).map(|number| (*number).to_owned()))
            .collect();
        numbers
    };
    let pairs = answer.calls.windows(2).zip(1..);
    pairs
        .filter(|(pair, _)| {
            pair[1].contains("STRAIGHT_FEED(") && end(&pair[0]).is_some() && end(&pair[0]) == end(&pair[1])
        })
        .map(|(_, at)| at)
        .collect()
}

impl core::ops::Deref for Ours {
    type Target = Answer;
    fn deref(&self) -> &Answer {
        &self.answer
    }
}

/// All of them.
pub(crate) const EXPLAINED: &[Explanation] = &[
    Explanation {
        why: "the sign of a zero: it depends on the order of sums and says nothing about where the tool goes",
        holds: |control, ours| same_but(control, ours, |a, b, _| is_zero(a) && is_zero(b)),
    },
    Explanation {
        why: "a value that lies between two decimals within 1e-9: the last bit of a sum, which depends on the order of additions, decides \
              to which of both it is rounded",
        holds: |control, ours| {
            same_but(control, ours, |a, b, exact| {
                is_zero(a) && is_zero(b) || is_tie(a, b, exact)
            })
        },
    },
    Explanation {
        why: "refused by name, since it is not proved that our answer would be the control's",
        holds: |control, ours| !ours.good && is_refused(&ours.error) && is_head(ours, control),
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
                [control, &ours.answer].map(|answer| answer.error.split_once('\n').unwrap_or((&answer.error, "")));
            let made = quoted.starts_with(" G")
                || quoted.starts_with(" F")
                || quoted.starts_with(" S")
                || quoted.starts_with(" M")
                || (quoted.starts_with('O') && quoted.ends_with("CALL"));
            a == b && made && control.good == ours.good && same_calls(control, ours)
        },
    },
    Explanation {
        why: "a cut of no length in a turning cycle: whether the control tells it hangs on its rounding, and it leads nowhere",
        holds: |control, ours| {
            control.good && ours.good && {
                let (ours, control) = (ours.moving(), control.without(&standstills(control)));
                same_but(&control, &ours, |a, b, exact| {
                    is_zero(a) && is_zero(b) || is_tie(a, b, exact)
                })
            }
        },
    },
    Explanation {
        why: "a program without anything in it: the control does not begin to run it, so it does not reset the machine either",
        holds: |control, ours| {
            let first = |answer: &Answer| answer.error.lines().next().map(str::to_owned);
            first(control) == first(&ours.answer)
                && first(control).as_deref() == Some("File ended with no percent sign")
        },
    },
    Explanation {
        why: "the control never ends behind the last arc of a turning cycle, by its rounding; all that it told until then is ours",
        holds: |control, ours| {
            let last = control.calls.last().is_some_and(|line| line.contains("ARC_FEED"));
            control.hangs && last && alike_lines(control, ours, control.calls.len())
        },
    },
    Explanation {
        why: "the control was stopped while it told one call after the other, more than 100 000: all that it told is ours",
        holds: |control, ours| {
            // the last line may be cut off
            let whole = control.calls.len().saturating_sub(1);
            control.hangs && whole > 100_000 && alike_lines(control, ours, whole)
        },
    },
    Explanation {
        why: "the control takes its own entry arc of a turning tool as wrong, or draws a full circle instead; we refuse it in both cases",
        holds: |control, ours| {
            const INVALID: &str = "BUG: cutter compensation has generated an invalid arc";
            let refused = ours.error.starts_with(INVALID);
            let same = control.error.lines().next() == ours.error.lines().next();
            refused && (same && same_calls(control, ours) || control.error.is_empty() && is_head(ours, control))
        },
    },
    Explanation {
        why: "the control crashes (a corner in a turning contour with nothing before it), we refuse",
        holds: |control, ours| control.crashed && !ours.good && is_refused(&ours.error),
    },
];

/// Messages of what this interpreter does not model.
const REFUSED: [&str; 17] = [
    "G53 with a spline (G5.2): it is not known where the control puts the control point",
    "a spline (G5.2) with cutter radius compensation on: it is not known where the control continues",
    "G17.1, G18.1 or G19.1 with cutter radius compensation on: it is not known what the control does with the contour",
    "turning contour that moves back very slightly along the cut: it is not known whether the control accepts it",
    "rounded or chamfered corner of a turning contour next to an arc, or one that uses up half of a line across the cut: it is not known how the control runs it",
    "pockets of a turning contour with several arcs: it is not known where the control cuts them",
    "M61 or G10 L0 with cutter radius compensation on: it is not known where the control continues",
    "a spline (G5, G5.1) starts before another one (G5.2) has ended: the control mixes their control points",
    "corner of a turning contour with nothing before it: the control crashes",
    "block in the contour of a turning cycle: it is not known how the control runs it",
    "corner of a turning contour without enough room for its radius or chamfer",
    "contour of a turning cycle whose allowance is larger than the details at its ends: the path of the tool is unknown",
    "nearly straight corner of a turning contour with an allowance: it is not known how the control rounds it",
    "corner between two arcs of a turning contour with an allowance: it is not known how the control cuts it",
    "corner of a turning contour whose radius or chamfer is shorter than 0.01 mm or inch, as programmed, along the cut: it is not known how the control runs it",
    "G70 with cutter compensation: the path of the tool is unknown",
    "arc of a turning contour with its deepest point inside, or with unequal radii: it is not known how the control cuts there",
];

fn is_refused(error: &str) -> bool {
    error.lines().next().is_some_and(|line| REFUSED.contains(&line))
}

/// The calls before the refusal are the control's; two calls after it reset the machine.
fn is_head(ours: &Ours, control: &Answer) -> bool {
    let resets = |line: &&String| line.ends_with("ON_RESET()") && !line.starts_with("    6 ");
    let length = ours
        .calls
        .iter()
        .position(|line| resets(&line))
        .unwrap_or(ours.calls.len());
    alike_lines(control, ours, length)
}

/// Equal but for numbers for which `same` holds.
fn same_but(control: &Answer, ours: &Ours, same: fn(&str, &str, &str) -> bool) -> bool {
    control.good == ours.good
        && control.error == ours.error
        && control.calls.len() == ours.calls.len()
        && lines(control, ours).all(|[a, b, exact]| same_line(a, b, exact, same))
}

fn same_calls(control: &Answer, ours: &Ours) -> bool {
    control.calls.len() == ours.calls.len() && alike_lines(control, ours, control.calls.len())
}

/// Both have so many lines, and they are alike up to there.
fn alike_lines(control: &Answer, ours: &Ours, length: usize) -> bool {
    let number = |a: &str, b: &str, exact: &str| is_zero(a) && is_zero(b) || is_tie(a, b, exact);
    control.calls.len() >= length
        && ours.calls.len() >= length
        && lines(control, ours)
            .take(length)
            .all(|[a, b, exact]| same_line(a, b, exact, number))
}

/// Lines side by side: the control's, ours, and ours with more decimals.
fn lines<'a>(control: &'a Answer, ours: &'a Ours) -> impl Iterator<Item = [&'a str; 3]> {
    let exact = ours.exact.calls.iter().map(String::as_str).chain(std::iter::repeat(""));
    let both = control.calls.iter().zip(&ours.calls).zip(exact);
    both.map(|((a, b), exact)| [a.as_str(), b.as_str(), exact])
}

fn same_line(a: &str, b: &str, exact: &str, same: impl Fn(&str, &str, &str) -> bool) -> bool {
    let split = |text| -> Vec<&str> { str::split(text, [' ', ',', '(', ')', '"', '\t']).collect() };
    let [x, y, z] = [a, b, exact].map(split);
    a == b
        || x.len() == y.len()
            && y.len() == z.len()
            && x.iter()
                .zip(&y)
                .zip(&z)
                .all(|((a, b), exact)| a == b || same(a, b, exact))
}

/// A zero with decimals, whatever its sign.
fn is_zero(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    digits.starts_with("0.0") && digits.bytes().all(|byte| matches!(byte, b'0' | b'.'))
}

/// Two neighbours in the last decimal, and the value is in the middle between them, as far as sums of doubles show.
fn is_tie(a: &str, b: &str, exact: &str) -> bool {
    let decimals = |text: &str| Some(text.split_once('.')?.1.len());
    let [Some(count), Some(other)] = [a, b].map(decimals) else {
        return false;
    };
    let [Ok(a), Ok(b), Ok(exact)] = [a, b, exact].map(str::parse::<f64>) else {
        return false;
    };
    let unit = 0.1_f64.powi(count as i32);
    let slack = 1e-9 + exact.abs() * 1e-13;
    count == other && ((a - b).abs() - unit).abs() < unit * 0.01 && (exact - f64::midpoint(a, b)).abs() <= slack
}
