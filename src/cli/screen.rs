//! Which findings of a file fit on a screen: the worst first, a few of each rule before many of one, with lines of program where there is room.
use super::render::{EXCERPTS, Page, is_info};
use super::short;
use std::collections::BTreeMap;
use trunnion_check::{Diagnostic, Report};

/// Lines of the findings; the line that counts the rest and the verdict come below them.
const LINES: usize = 37;
/// Findings that are shown.
const MOST: usize = 10;
/// Findings of one rule that come before all others have had theirs.
const OF_ONE_RULE: usize = 2;

/// The findings that are shown, and of each whether its lines of program are shown.
pub(super) fn chosen<'r>(page: &Page<'_>, report: &'r Report) -> (Vec<&'r Diagnostic>, Vec<bool>) {
    let all: Vec<&Diagnostic> = report.diagnostics.iter().collect();
    let mut ranked: Vec<usize> = (0..all.len()).collect();
    ranked.sort_by_key(|&index| short::rank(all[index]));
    let picked = pick(page, &all, &ranked);
    // all of them in the order of the file, some in the order of their weight
    let order: Vec<usize> = if picked.len() == all.len() {
        (0..all.len()).collect()
    } else {
        ranked.into_iter().filter(|index| picked.contains(index)).collect()
    };
    let shown: Vec<&Diagnostic> = order.into_iter().map(|index| all[index]).collect();
    let excerpts = with_lines(page, &shown);
    (shown, excerpts)
}

/// Which findings fit, without lines of program.
fn pick(page: &Page<'_>, all: &[&Diagnostic], ranked: &[usize]) -> Vec<usize> {
    let mut picked: Vec<usize> = Vec::new();
    let mut of_rule: BTreeMap<&str, usize> = BTreeMap::new();
    let fits = |picked: &[usize], next: usize| {
        let some: Vec<&Diagnostic> = picked.iter().chain([&next]).map(|&index| all[index]).collect();
        picked.is_empty() || height(&page.text(&some, &vec![false; some.len()])) <= LINES
    };
    let mut left = Vec::new();
    for &index in ranked {
        let count = of_rule.entry(all[index].rule).or_default();
        if *count >= OF_ONE_RULE {
            left.push(index);
        } else if picked.len() < MOST && fits(&picked, index) {
            *count += 1;
            picked.push(index);
        }
    }
    for index in left {
        if picked.len() >= MOST || !fits(&picked, index) {
            break;
        }
        picked.push(index);
    }
    picked
}

/// Gives the worst findings their lines of program as long as that fits. Of many findings none has them: the list is easier to read.
fn with_lines(page: &Page<'_>, shown: &[&Diagnostic]) -> Vec<bool> {
    let mut excerpts = vec![false; shown.len()];
    let mut ranked: Vec<usize> = (0..shown.len()).filter(|&index| !is_info(shown[index])).collect();
    if ranked.len() > EXCERPTS {
        return excerpts;
    }
    ranked.sort_by_key(|&index| short::rank(shown[index]));
    for index in ranked {
        excerpts[index] = true;
        if height(&page.text(shown, &excerpts)) > LINES {
            excerpts[index] = false;
            break;
        }
    }
    excerpts
}

fn height(text: &str) -> usize {
    text.lines().count()
}
