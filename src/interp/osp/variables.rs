//! Variables of the user task: V1 to V200, and VC1 to VC200 on machining centres (OSP MACRO, nc-macro-lab.na.coocan.jp/osp2.html), are common and
//! keep their values; names of up to four characters that begin with two letters are local to a program; all other names that begin with V and a
//! letter belong to the control.
use crate::flow::Calling;
use crate::own::{Own, Sort};
use std::collections::{BTreeSet, HashSet};

/// The last common variable that every control has (NC-PB/gEdit, syntax-okuma.md, 3.6).
const COMMON: u32 = 200;
/// Characters of a local variable.
const LONGEST: usize = 4;

/// What only the user task keeps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Task {
    /// Local variables of the callers: whether a subprogram sees them is not stated.
    pub(crate) outer: Vec<BTreeSet<Box<str>>>,
    /// Local variables that the subprogram that runs has written.
    pub(crate) written: HashSet<Box<str>>,
    /// The call of MODIN, and how many calls were open there.
    pub(crate) modal: Option<(Calling, usize)>,
    /// The subprogram of MODIN runs.
    pub(crate) in_modal: bool,
}

/// What a name is, in lower case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Common,
    Local,
    /// A variable of the control, or a common one that not every control has.
    Control,
    /// No name of a variable.
    None,
}

pub(super) fn class(name: &str) -> Class {
    let bytes = name.as_bytes();
    let plain = bytes.iter().all(u8::is_ascii_alphanumeric);
    match bytes {
        _ if !plain => Class::None,
        [b'v', b'c', digits @ ..] | [b'v', digits @ ..]
            if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) =>
        {
            let number = name[name.len() - digits.len()..].parse().unwrap_or(0);
            if (1..=COMMON).contains(&number) && digits[0] != b'0' {
                Class::Common
            } else {
                Class::Control
            }
        }
        [b'v', b'a'..=b'z', ..] => Class::Control,
        [b'a'..=b'z', b'a'..=b'z', ..] if bytes.len() <= LONGEST && !matches!(bytes[0], b'n' | b'o') => Class::Local,
        _ => Class::None,
    }
}

/// Whether what is assigned is neither a common nor a local variable.
pub(crate) fn is_of_control(name: &[u8]) -> bool {
    let stem = name.split(|byte| *byte == b'[').next().unwrap_or_default().trim_ascii();
    let stem = String::from_utf8_lossy(stem).to_ascii_lowercase();
    !matches!(class(&stem), Class::Common | Class::Local)
}

/// Whether a name, in lower case, is that of a common variable.
pub(crate) fn is_common(name: &str) -> bool {
    class(name) == Class::Common
}

/// Why the value of a name is not known.
pub(crate) fn why_unknown(own: &Own, name: &str) -> String {
    let stem = name.trim_end_matches('[').to_ascii_lowercase();
    let shown = stem.to_ascii_uppercase();
    match class(&stem) {
        _ if name == "empty" => "EMPTY: followed only as the whole of one comparison with one variable".to_owned(),
        Class::Control => format!("{shown}: a variable of the control"),
        Class::None => format!("{shown}: no variable of this name is known"),
        _ if name.ends_with('[') => format!("{shown}[]: no source states what it gives"),
        Class::Common => format!("{shown}: {}", own.why_valueless(&stem)),
        Class::Local if own.is_declared(&stem) => format!("{shown}: its value is unknown here"),
        Class::Local => format!("{shown}: not written before"),
    }
}

impl Own {
    /// A value for a name in lower case; `None`: unknown.
    pub(crate) fn assign_of_task(&mut self, name: &str, value: Option<f64>) {
        let key: Box<str> = name.into();
        let values = match class(name) {
            Class::Common => &mut self.others,
            Class::Local => {
                self.scope.sorts.insert(key.clone(), Sort::Real);
                self.task.written.insert(key.clone());
                &mut self.scope.values
            }
            Class::Control | Class::None => return,
        };
        match value {
            Some(value) => values.insert(key.clone(), value),
            None => values.remove(&key),
        };
        self.fresh.push(key);
    }

    /// Common variables with known values, which keep them after the program ends.
    pub(crate) fn common(&self) -> impl Iterator<Item = (String, f64)> {
        let kept = self.others.iter().filter(|_| self.is_task);
        kept.map(|(name, value)| (name.to_ascii_uppercase(), *value))
    }

    /// Whether a local variable is defined; `None`: it is not known.
    pub(super) fn is_defined(&self, name: &str) -> Option<bool> {
        let name = name.to_ascii_lowercase();
        if self.scope.sorts.contains_key(name.as_str()) {
            return Some(true);
        }
        // a file that is run alone may be a subprogram with arguments
        let seen = self.task.outer.iter().any(|names| names.contains(name.as_str()));
        (class(&name) == Class::Local && self.is_called && !seen).then_some(false)
    }
}

#[cfg(test)]
mod tests {
    use super::{Class, class};

    #[test]
    fn names_have_a_class() {
        for (name, wanted) in [
            ("v1", Class::Common),
            ("v200", Class::Common),
            ("v01", Class::Control),
            ("v201", Class::Control),
            ("vzofx", Class::Control),
            ("vc1", Class::Common),
            ("vc200", Class::Common),
            ("vc201", Class::Control),
            ("vc", Class::Control),
            ("vc1a", Class::Control),
            ("dia1", Class::Local),
            ("px", Class::Local),
            ("p1", Class::None),
            ("depth", Class::None),
            ("oabc", Class::None),
            ("n1", Class::None),
        ] {
            assert_eq!(class(name), wanted, "{name}");
        }
    }
}
