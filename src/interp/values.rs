//! Values of words: numbers, names, targets such as IC(5), and expressions where the dialect has them.
use crate::FaultKind;
use crate::reader::{LARGEST, Reader};
use crate::words::{Number, Reading, WordValue};
use trunnion_syntax::{Decimal, TextRange, Value, Word};

/// Ten times the number of a code, where that is whole: G43.4 is 434.
pub(crate) fn tenths(decimal: Decimal) -> Option<u32> {
    let mut mantissa = decimal.mantissa.checked_mul(10)?;
    let mut scale = decimal.scale;
    while scale > 0 {
        if mantissa % 10 != 0 {
            return None;
        }
        mantissa /= 10;
        scale -= 1;
    }
    if scale < 0 {
        return None;
    }
    u32::try_from(mantissa).ok()
}

/// A number, unless it is beyond what can be reckoned with.
pub(crate) fn number(decimal: Decimal, range: TextRange) -> WordValue {
    let value = decimal.to_f64();
    if value.abs() <= LARGEST {
        WordValue::Number(Number {
            value,
            has_point: decimal.has_point,
            range,
        })
    } else {
        WordValue::Unread
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// A word that knows only numbers and names, kept by its letter too.
    pub(crate) fn kept(&mut self, letter: u8, word: &Word) -> WordValue {
        let said = self.said(word);
        self.words.by_letter.keep(letter, said);
        said
    }

    /// A word that knows only numbers and names.
    fn said(&mut self, word: &Word) -> WordValue {
        match word.value {
            Value::Number(decimal) => number(decimal, word.range),
            Value::Text(range) => WordValue::Name(range),
            Value::Missing | Value::Bad => WordValue::Unread,
            Value::Expression(range) if self.macros.is_some() => self.macro_value(word, range),
            Value::Expression(_) | Value::Call(..) => {
                if let Some(number) = self.own_number(word.value_range) {
                    return WordValue::Number(number);
                }
                let stops = self.why_it_stops(word.value_range);
                let kind = stops.unwrap_or_else(|| {
                    let what = self.why_no_number(word.value_range);
                    let what = what.unwrap_or_else(|| self.text(word.value_range));
                    FaultKind::NotModelled { what }
                });
                (self.report)(word.value_range, kind);
                WordValue::Unread
            }
        }
    }

    /// A word that also knows AC(), IC(), DC(), ACP(), ACN().
    pub(crate) fn said_place(&mut self, word: &Word) -> (WordValue, Reading) {
        if let Value::Call(name, decimal) = word.value {
            let name = self.program.source().get(name.as_usize()).unwrap_or_default();
            let reading = READINGS.iter().find(|(known, _)| name.eq_ignore_ascii_case(known));
            if let Some(&(_, reading)) = reading {
                return (number(decimal, word.range), reading);
            }
        }
        if let Some(place) = self.own_place(word) {
            return place;
        }
        (self.said(word), Reading::Modal)
    }
}

pub(crate) const READINGS: [(&[u8], Reading); 5] = [
    (b"AC", Reading::Absolute),
    (b"IC", Reading::Incremental),
    (b"DC", Reading::Shortest),
    (b"ACP", Reading::Positive),
    (b"ACN", Reading::Negative),
];
