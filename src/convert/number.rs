//! Numbers as words carry them.

/// `value` with at most `decimals` digits after the decimal point, without zeros at the end; `point`: a whole number keeps its point. Never "-0".
pub(crate) fn number(value: f64, decimals: usize, point: bool) -> String {
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').len());
        if text.ends_with('.') && !point {
            text.pop();
        }
    } else if point {
        text.push('.');
    }
    if !text.bytes().any(|byte| (b'1'..=b'9').contains(&byte)) {
        text = text.trim_start_matches('-').to_owned();
    }
    text
}

/// `value` > 0 with `digits` digits in all.
pub(crate) fn significant(value: f64, digits: usize, point: bool) -> String {
    let mut whole = 0;
    let mut rest = value;
    while rest >= 1.0 && whole < 18 {
        rest /= 10.0;
        whole += 1;
    }
    while rest < 0.1 && rest > 0.0 && whole > -12 {
        rest *= 10.0;
        whole -= 1;
    }
    let decimals = (digits as i32 - whole).clamp(0, 15) as usize;
    number(value, decimals, point)
}

/// Half of the last of this many digits after the decimal point.
pub(crate) fn rounding(decimals: usize) -> f64 {
    0.5 / 10f64.powi(decimals as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_points_and_signs() {
        assert_eq!(number(10.0, 4, false), "10");
        assert_eq!(number(10.0, 4, true), "10.");
        assert_eq!(number(-0.000_01, 4, false), "0");
        assert_eq!(number(-0.000_01, 4, true), "0.");
        assert_eq!(number(-1.23456, 4, false), "-1.2346");
        assert_eq!(number(100.0, 0, true), "100.");
        assert_eq!(number(100.0, 0, false), "100");
    }

    #[test]
    fn digits_in_all() {
        assert_eq!(significant(1_234.567_89, 7, false), "1234.568");
        assert_eq!(significant(0.001_234_567_8, 5, false), "0.0012346");
        assert_eq!(significant(123_456_789.0, 7, false), "123456789");
    }
}
