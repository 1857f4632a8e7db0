//! The variables of a program: local, common and named ones. `None` is `<vacant>`, NaN is a value that is unknown.
use std::collections::BTreeMap;

/// A variable's content: `None` is `<vacant>`, NaN a value that is unknown.
pub(crate) type Held = Option<f64>;

/// #1 to #33 of one level of macro calls.
pub(crate) type Locals = [Held; LOCALS];

/// Local variables of a level.
const LOCALS: usize = 33;

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct Variables {
    /// #1 to #33 of the level that runs.
    pub(crate) locals: Locals,
    common: BTreeMap<u32, Held>,
    named: BTreeMap<Box<str>, f64>,
    /// Variables of the control that the setup declares and the program has not written.
    declared: BTreeMap<u32, Held>,
    /// Why a variable that was assigned is not known.
    reasons: BTreeMap<i64, Box<str>>,
    /// Blocks ran, or did not run, that were not followed: all values are unknown.
    lost: bool,
    /// Grows with everything that may change the outcome of a decision: assignments, calls, values of the control.
    pub(crate) changes: u64,
}

/// Bytes that are kept of the reason that caused it.
const LONGEST_REASON: usize = 240;

impl Default for Variables {
    fn default() -> Self {
        Self {
            locals: [None; LOCALS],
            common: BTreeMap::new(),
            named: BTreeMap::new(),
            declared: BTreeMap::new(),
            reasons: BTreeMap::new(),
            lost: false,
            changes: 0,
        }
    }
}

/// The kind of a variable's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// #0: always vacant.
    Vacant,
    /// #1 to #33: place in [`Locals`].
    Local(usize),
    /// #100 to #999.
    Common(u32),
    /// #1000 and above: of the control.
    System(u32),
    /// There is no such variable.
    Missing,
}

/// Series 30i operator's manual, custom macro, variables: #1 to #33 local, #100 to #199 and #500 to #999 common (#200 to #499 with
/// an option), from #1000 the control's.
pub(crate) fn class(index: i64) -> Class {
    match u32::try_from(index) {
        Ok(0) => Class::Vacant,
        Ok(local @ 1..=33) => Class::Local(local as usize - 1),
        Ok(common @ 100..=999) => Class::Common(common),
        Ok(system @ 1000..) => Class::System(system),
        _ => Class::Missing,
    }
}

impl Variables {
    /// How many a clone copies, apart from those of the level that runs and of the setup: these do not grow with the program.
    pub(crate) fn copied(&self) -> usize {
        self.common.len() + self.named.len() + self.reasons.len()
    }

    /// With what a setup declares, by number.
    pub(crate) fn with(declared: &[(u32, Held)]) -> Self {
        let mut variables = Self::default();
        for (number, held) in declared {
            match class(i64::from(*number)) {
                Class::Common(common) => variables.common.insert(common, *held),
                Class::System(system) => variables.declared.insert(system, *held),
                _ => None,
            };
        }
        variables
    }
    /// A variable of the control as the setup declares it; NaN where it is not declared, or may have changed.
    pub(crate) fn of_control(&self, number: u32) -> Held {
        match self.declared.get(&number) {
            Some(held) if !self.lost => *held,
            _ => Some(f64::NAN),
        }
    }
    /// The program writes a variable of the control.
    pub(crate) fn control_written(&mut self, number: u32) {
        self.declared.remove(&number);
    }
    /// A local or common variable; `None` where the number is neither.
    pub(crate) fn get(&self, index: i64) -> Option<Held> {
        let held = match class(index) {
            Class::Vacant => return Some(None),
            Class::Local(place) => self.locals[place],
            // before the program assigns it, it holds what another program has left there
            Class::Common(common) => self.common.get(&common).copied().unwrap_or(Some(f64::NAN)),
            Class::System(_) | Class::Missing => return None,
        };
        Some(if self.lost { Some(f64::NAN) } else { held })
    }
    /// Assigns a local or common variable. `reason`: why its value is unknown, where it is not.
    pub(crate) fn set(&mut self, index: i64, held: Held, reason: Option<&str>) {
        self.changes += 1;
        match class(index) {
            Class::Local(place) => self.locals[place] = held,
            Class::Common(common) => {
                self.common.insert(common, held);
            }
            _ => return,
        }
        match reason {
            Some(reason) => {
                self.reasons.insert(index, reason.into());
            }
            None if self.reasons.is_empty() => {}
            None => {
                self.reasons.remove(&index);
            }
        }
    }
    /// A local, common or named variable as it is written; NaN where it is unknown, `None` where it is vacant or there is none.
    pub(crate) fn written(&self, text: &str) -> Option<f64> {
        let name = text.trim().strip_prefix('#')?;
        match name.parse() {
            Ok(index) => self.get(index).flatten(),
            Err(_) => self.named(&name.to_ascii_lowercase()),
        }
    }
    /// All that have a value; after all values were lost, those from before.
    pub(crate) fn all(&self) -> Vec<crate::Argument> {
        let locals = self.locals.iter().zip(1..).map(|(held, number)| (number, *held));
        let common = self.common.iter().map(|(number, held)| (*number, *held));
        let numbered = locals
            .chain(common)
            .filter_map(|(number, held)| Some((format!("#{number}"), held?)));
        let named = self.named.iter().map(|(name, value)| (format!("#{name}"), *value));
        let known = numbered.chain(named).filter(|(_, value)| !value.is_nan());
        known
            .map(|(name, value)| crate::Argument::number(name, value))
            .collect()
    }
    /// The entry of [`Self::all`] with this name.
    pub(crate) fn of_all(&self, name: &str) -> Option<crate::Argument> {
        let bare = name.strip_prefix('#')?;
        let number = bare.parse().ok().filter(|number: &u32| number.to_string() == bare);
        let local = number.and_then(|number| self.locals.get((number as usize).checked_sub(1)?));
        let value = match (local, number) {
            (Some(local), _) => *local,
            (None, Some(number)) => self.common.get(&number).copied().flatten(),
            (None, None) => self.named.get(bare).copied(),
        };
        let value = value.filter(|value| !value.is_nan())?;
        Some(crate::Argument::number(name.to_owned(), value))
    }
    /// Those from `first` on with their values, as far as they are known: they keep their values after the program ends. Fanuc: #500 to #999
    /// (Series 30i operator's manual, custom macro); Haas: #100 to #149 are kept too (zappettiniconsulting.com, Haas system variables), so
    /// that all common ones count.
    pub(crate) fn kept(&self, first: u32) -> Vec<(String, f64)> {
        let kept = self.common.range(first..).filter(|_| !self.lost);
        kept.filter_map(|(number, held)| Some((format!("#{number}"), (*held)?)))
            .filter(|(_, value)| !value.is_nan())
            .collect()
    }
    /// The common variables from `first` on that are vacant since the program, or the setup, has left them so.
    pub(crate) fn vacant(&self, first: u32) -> impl Iterator<Item = String> {
        let kept = self.common.range(first..).filter(|_| !self.lost);
        let vacant = kept.filter(|(_, held)| held.is_none());
        vacant.map(|(number, _)| format!("#{number}"))
    }
    /// A named variable.
    pub(crate) fn named(&self, name: &str) -> Option<f64> {
        if self.lost {
            return Some(f64::NAN);
        }
        self.named.get(name).copied()
    }
    /// Assigns a named variable.
    pub(crate) fn set_named(&mut self, name: &str, held: Held) {
        self.changes += 1;
        self.named.insert(name.into(), held.unwrap_or(0.0));
    }
    /// From here on all values are unknown: assignments are not followed.
    pub(crate) fn lose(&mut self) {
        self.changes += 1;
        self.lost = true;
    }
    /// Why the value of a variable is not known, as a short text for people.
    pub(crate) fn reason(&self, index: i64) -> String {
        if self.lost {
            return format!("#{index}: jumps or calls before it are not followed");
        }
        if let Some(reason) = self.reasons.get(&index) {
            // in a loop a value may depend on itself repeatedly; the original cause is at the end
            let from = reason.ceil_char_boundary(reason.len().saturating_sub(LONGEST_REASON));
            let cut = if from == 0 { "" } else { "... " };
            return format!("#{index}: from {cut}{}", &reason[from..]);
        }
        match class(index) {
            Class::System(system) => format!("#{index}: {}", super::system::what(system)),
            _ => format!("#{index}: read before the program assigns it"),
        }
    }
}
