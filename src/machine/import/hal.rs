//! Values of HAL pins, as far as the HALCMD lines of an INI file set them.
use super::ini::Ini;
use crate::MachineError;

/// What is known about a pin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pin {
    /// Set by a line of the INI, or given.
    Set(f64),
    /// Nothing in the INI sets or connects it: the module's own default applies, unless a HAL file sets it.
    Untouched,
    /// Connected to a signal whose value comes from somewhere else (a panel, a HAL file).
    Elsewhere,
}

/// The pins of one component.
pub(super) struct Pins<'a> {
    /// `xyzac-trt-kins`.
    component: String,
    /// Pin, value as written, place.
    set: Vec<(&'a str, &'a str, core::ops::Range<usize>)>,
    /// Signal, value as written, place.
    signals: Vec<(&'a str, &'a str, core::ops::Range<usize>)>,
    /// Signal, pin.
    nets: Vec<(&'a str, &'a str)>,
    given: &'a [(String, f64)],
    ini: &'a Ini<'a>,
}

impl<'a> Pins<'a> {
    /// Of the component whose name begins as `module` (`-` and `_` are the same).
    pub(super) fn new(ini: &'a Ini<'a>, module: &str, given: &'a [(String, f64)]) -> Self {
        let mut pins = Self {
            component: plain(module),
            set: Vec::new(),
            signals: Vec::new(),
            nets: Vec::new(),
            given,
            ini,
        };
        for entry in ini.entries.iter().filter(|entry| entry.key == "HALCMD") {
            let mut words = entry.value.split_whitespace();
            match (words.next(), words.next()) {
                (Some("setp"), Some(pin)) => {
                    pins.set.push((pin, words.next().unwrap_or(""), entry.span.clone()));
                }
                (Some("sets"), Some(signal)) => {
                    pins.signals
                        .push((signal, words.next().unwrap_or(""), entry.span.clone()));
                }
                (Some("net"), Some(signal)) => {
                    pins.nets
                        .extend(words.filter(|word| !word.contains('=')).map(|pin| (signal, pin)));
                }
                _ => {}
            }
        }
        pins
    }

    /// A pin of the component by the part after the dot.
    pub(super) fn get(&self, name: &str) -> Result<Pin, MachineError> {
        let given = |(pin, _): &&(String, f64)| plain(pin) == plain(name) || self.is(pin, name);
        if let Some((_, value)) = self.given.iter().find(given) {
            return Ok(Pin::Set(*value));
        }
        // the last line wins
        if let Some((_, text, span)) = self.set.iter().rev().find(|(pin, ..)| self.is(pin, name)) {
            return self.value(text, span).map(Pin::Set);
        }
        let Some((signal, _)) = self.nets.iter().find(|(_, pin)| self.is(pin, name)) else {
            return Ok(Pin::Untouched);
        };
        match self.signals.iter().rev().find(|(known, ..)| known == signal) {
            Some((_, text, span)) => self.value(text, span).map(Pin::Set),
            None => Ok(Pin::Elsewhere),
        }
    }

    /// Whether a full pin name is the component's pin `name`.
    fn is(&self, pin: &str, name: &str) -> bool {
        pin.rsplit_once('.').is_some_and(|(component, own)| {
            plain(own) == plain(name)
                && plain(component).trim_end_matches("kins") == self.component.trim_end_matches("kins")
        })
    }

    /// A number, true or false, or the value of `[SECTION]KEY`.
    fn value(&self, text: &str, span: &core::ops::Range<usize>) -> Result<f64, MachineError> {
        if let Some((section, key)) = text.strip_prefix('[').and_then(|rest| rest.split_once(']'))
            && let Some(value) = self.ini.number(section, key)?
        {
            return Ok(value);
        }
        match text.to_ascii_lowercase().as_str() {
            "true" => Ok(1.0),
            "false" => Ok(0.0),
            text => match text.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(MachineError {
                    message: format!("HALCMD: {:?} is not a number", super::short(text)),
                    span: Some(span.clone()),
                }),
            },
        }
    }
}

/// Letters and digits: `xyzac-trt-kins` and `xyzac_trt_kins` are the same.
fn plain(name: &str) -> String {
    name.chars()
        .filter(|c| c.is_ascii_alphanumeric() || *c == '.')
        .map(|c| c.to_ascii_lowercase())
        .collect()
}
