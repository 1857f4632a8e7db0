//! Parameters: numbered ones, 1-5601, and named ones, and those that are local to a call.
mod names;
mod system;

use crate::{Engine, Ini, Setup, Side, Start, State};
use names::Names;
use trunnion_formula::{Name, ValueError, Variables};

/// Highest number that exists (observed: `#5601` is zero, `#5602` is refused).
const LAST: usize = 5601;
/// Why the control does not give the position (5420-5428) to a program under compensation.
const HELD_BACK: &str = "Cannot read current position with cutter radius compensation on";
/// Numbers local to a call: its arguments.
const LOCAL: usize = 30;

/// Number of a parameter that a program may set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(usize);

impl Slot {
    /// The slot of a number; `Err(true)` if programs may only read it, `Err(false)` if it does not exist.
    pub(crate) fn writable(index: i64) -> Result<Self, bool> {
        match usize::try_from(index) {
            // observed: these and no others
            Ok(5400..=5413 | 5420..=5428) => Err(true),
            Ok(index @ 1..=LAST) => Ok(Self(index)),
            _ => Err(false),
        }
    }
}

/// What a call saves of its caller.
#[derive(Clone, Debug)]
struct SavedCaller {
    /// `#1` to `#30`, too, which are the last ones saved; a call with M98 shares them.
    numbers: bool,
    names: Names,
}

/// All parameters that a program can read and set.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    /// Index = number; 0 is not used.
    numbers: Vec<f64>,
    /// Those that the program has set, by number.
    assigned: Vec<bool>,
    /// Names that begin with `_`: global.
    globals: Names,
    /// Other names: local to the current call.
    locals: Names,
    /// Callers, outermost first.
    aside: Vec<SavedCaller>,
    /// Their numbers.
    numbers_aside: Vec<f64>,
    /// Names of calls that ended, kept for their storage.
    spare: Vec<Names>,
    /// `#<_value>`: what the last subprogram returned.
    value: f64,
    /// `#<_value_returned>`.
    returned: bool,
    /// Axis letters that are not words here: bit per letter from A.
    missing_axes: u32,
    /// A subprogram that nothing calls runs: names that it does not define may be defined by its caller.
    pub(crate) alone: bool,
}

impl Store {
    /// As a run starts: what the parameter file declares, else zero. In a check numbers that no file declares are unknown, except
    /// the coordinate system (G54) and G92 (off).
    pub(crate) fn new(setup: &Setup) -> Self {
        let mut numbers = vec![0.0; LAST + 1];
        if setup.start == Start::Unknown {
            numbers[1..].fill(f64::NAN);
            numbers[5210] = 0.0;
        }
        numbers[5220] = 1.0;
        // (DEBUG,...) comments are emitted
        numbers[5599] = 1.0;
        for &(index, value) in &setup.parameters.values {
            if let Some(place) = numbers.get_mut(index as usize) {
                *place = value;
            }
        }
        let mut globals = Names::default();
        for (name, value) in &setup.parameters.globals {
            if is_stored_global(name) {
                globals.set(&Name::new(name), *value);
            }
        }
        Self {
            numbers,
            assigned: vec![false; LAST + 1],
            globals,
            locals: Names::default(),
            aside: Vec::new(),
            numbers_aside: Vec::new(),
            spare: Vec::new(),
            value: 0.0,
            returned: false,
            missing_axes: missing_axes(setup),
            alone: false,
        }
    }
    /// Whether nothing differs, bit for bit; values saved for callers are not compared.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let numbers = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        numbers(&self.numbers, &other.numbers)
            && self.locals.is_same(&other.locals)
            && self.globals.is_same(&other.globals)
            && self.value.to_bits() == other.value.to_bits()
            && self.returned == other.returned
            && self.aside.len() == other.aside.len()
    }
    /// How many names and saved numbers a copy copies: the numbered parameters do not grow with the program.
    pub(crate) fn copied(&self) -> usize {
        let aside: usize = self.aside.iter().map(|saved| saved.names.count()).sum();
        self.globals.count() + self.locals.count() + aside + self.numbers_aside.len()
    }
    /// The value of a parameter; 0 where there is none.
    pub(crate) fn number(&self, index: usize) -> f64 {
        self.numbers.get(index).copied().unwrap_or(0.0)
    }
    /// Global names with their values, in order.
    pub(crate) fn globals(&self) -> impl Iterator<Item = (String, f64)> {
        let mut named: Vec<(String, f64)> = self
            .globals
            .iter()
            .map(|(name, value)| (format!("#<{name}>"), value))
            .collect();
        named.sort_by(|a, b| a.0.cmp(&b.0));
        named.into_iter()
    }
    /// Writes a parameter for the interpreter itself, read-only or not.
    pub(crate) fn set_number(&mut self, index: usize, value: f64) {
        if let Some(place) = self.numbers.get_mut(index) {
            *place = value;
        }
    }
    /// Writes parameters side by side for the interpreter itself.
    #[inline]
    pub(crate) fn set_numbers(&mut self, first: usize, values: &[f64]) {
        if let Some(places) = self.numbers.get_mut(first..first + values.len()) {
            places.copy_from_slice(values);
        }
    }
    /// Writes a parameter for the program.
    pub(crate) fn set(&mut self, slot: Slot, value: f64) {
        self.numbers[slot.0] = value;
        self.assigned[slot.0] = true;
    }
    /// Whether the program has set a parameter.
    pub(crate) fn is_assigned(&self, index: i64) -> bool {
        usize::try_from(index).is_ok_and(|index| self.assigned.get(index).copied().unwrap_or_default())
    }
    /// A parameter with an unknown number was set: all that a program may set become unknown.
    pub(crate) fn forget(&mut self) {
        for index in 1..=LAST {
            if let Ok(slot) = Slot::writable(index as i64) {
                self.set(slot, f64::NAN);
            }
        }
    }
    /// Sets a named parameter: global if it begins with `_`, else local to the current call.
    pub(crate) fn set_named(&mut self, name: &Name, value: f64) {
        let names = if is_global(name) {
            &mut self.globals
        } else {
            &mut self.locals
        };
        names.set(name, value);
    }
    /// A subprogram is called: `#1` to `#30` become its arguments and zeros, its names are local.
    pub(crate) fn enter(&mut self, arguments: &[f64]) {
        let own = &mut self.numbers[1..=LOCAL];
        self.numbers_aside.extend_from_slice(own);
        own.fill(0.0);
        for (place, argument) in own.iter_mut().zip(arguments) {
            *place = *argument;
        }
        let names = self.fresh_names();
        self.aside.push(SavedCaller { numbers: true, names });
    }
    /// A Fanuc-style subprogram is called: its names are its own, `#1` to `#30` are the caller's.
    pub(crate) fn enter_sharing(&mut self) {
        let names = self.fresh_names();
        self.aside.push(SavedCaller { numbers: false, names });
    }
    /// Begins with no names; the ones there were.
    fn fresh_names(&mut self) -> Names {
        let fresh = self.spare.pop().unwrap_or_default();
        core::mem::replace(&mut self.locals, fresh)
    }
    /// A subprogram is left: `#1` to `#30` and the names of the caller are restored.
    pub(crate) fn leave(&mut self) {
        if let Some(aside) = self.aside.pop() {
            if aside.numbers {
                let from = self.numbers_aside.len() - LOCAL;
                self.numbers[1..=LOCAL].copy_from_slice(&self.numbers_aside[from..]);
                self.numbers_aside.truncate(from);
            }
            let mut left = core::mem::replace(&mut self.locals, aside.names);
            left.clear();
            self.spare.push(left);
        }
    }
    /// Which axis letters are not words: those of the machine, without `extra`.
    pub(crate) fn allow_axes(&mut self, setup: &Setup, extra: &str) {
        self.missing_axes = missing_axes(setup) & !axis_bits(extra);
    }
    /// What a subprogram returned: `#<_value>` and `#<_value_returned>`.
    pub(crate) fn set_returned(&mut self, value: Option<f64>) {
        self.value = value.unwrap_or(0.0);
        self.returned = value.is_some();
    }
}

/// `rs274` has the axes X Y Z A B C whatever the INI file says (observed); on a machine `[TRAJ] COORDINATES` decides.
fn missing_axes(setup: &Setup) -> u32 {
    let key = ("TRAJ".to_owned(), "COORDINATES".to_owned());
    let there = match setup.ini.values.get(&key) {
        Some(letters) if setup.start == Start::Unknown => axis_bits(letters),
        _ => axis_bits("XYZABC"),
    };
    axis_bits("XYZABCUVW") & !there
}

/// Bit per letter from A.
fn axis_bits(letters: &str) -> u32 {
    letters
        .bytes()
        .filter(u8::is_ascii_alphabetic)
        .fold(0, |bits, letter| bits | 1 << (letter.to_ascii_uppercase() - b'A'))
}

/// The source of variables for formulas at one line.
#[derive(Clone, Copy)]
pub(crate) struct Values<'a> {
    store: &'a Store,
    state: &'a State,
    setup: &'a Setup,
    /// From 1.
    line: u32,
}

impl<'a> Values<'a> {
    /// The values at the line that runs.
    #[inline]
    pub(crate) fn new(engine: &'a Engine) -> Self {
        Self {
            store: &engine.store,
            state: &engine.state,
            setup: &engine.setup,
            line: engine.at().line + 1,
        }
    }
    /// Whether a code, ten times its number, is one of the machine's own.
    pub(crate) fn owns(&self, letter: u8, tenths: u32) -> bool {
        self.setup.own_codes.binary_search(&(letter, tenths)).is_ok()
            || self.setup.any_ini && letter == b'M' && (2000..=9990).contains(&tenths)
    }
    /// Axis letters that the control refuses: bit per letter from A.
    #[inline]
    pub(crate) fn missing_axes(&self) -> u32 {
        self.store.missing_axes
    }
    /// Whether a name belongs to the control, so that programs can only read it.
    pub(crate) fn is_system(name: &Name) -> bool {
        is_global(name) && system::NAMES.binary_search_by(|(own, _)| (**own).cmp(&**name)).is_ok()
    }
    /// Values that only the machine knows are unknown in a check.
    fn is_check(&self) -> bool {
        self.setup.start == Start::Unknown
    }
    /// `#<_ini[section]name>`; section and name are compared in upper case.
    fn ini(&self, inside: &str) -> Result<f64, ValueError> {
        let Some((section, key)) = inside.split_once(']') else {
            return Err(ValueError::NotDefined);
        };
        let ini: &Ini = &self.setup.ini;
        let text = ini
            .values
            .get(&(section.to_ascii_uppercase(), key.to_ascii_uppercase()));
        if text.is_none() && self.setup.any_ini {
            return Ok(f64::NAN);
        }
        text.and_then(|text| text.trim().parse().ok())
            .ok_or(ValueError::NotDefined)
    }
}

impl Values<'_> {
    /// A numbered parameter as comments print it: the position of compensation, too.
    pub(crate) fn told(&self, index: i64) -> Option<f64> {
        let place = usize::try_from(index).ok().filter(|place| (1..=LAST).contains(place))?;
        Some(self.store.numbers[place])
    }
}

impl Variables for Values<'_> {
    #[inline]
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        match usize::try_from(index) {
            Ok(5420..=5428) if self.state.side != Side::Off => Err(ValueError::NotReadable(HELD_BACK.into())),
            Ok(place @ 1..=LAST) => Ok(self.store.numbers[place]),
            _ => Err(ValueError::OutOfRange),
        }
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        self.named_as(&Name::new(name))
    }
    #[inline]
    fn named_as(&self, name: &Name) -> Result<f64, ValueError> {
        let names = if is_global(name) {
            &self.store.globals
        } else {
            &self.store.locals
        };
        match names.get(name) {
            Some(value) => Ok(value),
            None => self.own(name),
        }
    }
    fn exists(&self, name: &str) -> bool {
        self.named(name).is_ok() && !self.is_of_caller(name)
    }
}

/// Whether a name, in lower case and without `#<` and `>`, is that of a global parameter that programs write: not one of the control's own.
pub fn is_stored_global(name: &str) -> bool {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.');
    name.len() > 1 && name.starts_with('_') && name.bytes().all(plain) && !Values::is_system(&Name::new(name))
}

/// Whether a name, without `#<` and `>`, is one that the control itself sets.
pub(crate) fn is_system_name(name: &str) -> bool {
    Values::is_system(&Name::new(name))
}

/// Whether a name is global.
#[inline]
fn is_global(name: &Name) -> bool {
    name.begins_with(b'_')
}

impl Values<'_> {
    /// The control's own value of a name.
    #[cold]
    #[inline(never)]
    fn own(&self, name: &str) -> Result<f64, ValueError> {
        if let Some(inside) = name.strip_prefix("_ini[") {
            return self.ini(inside);
        }
        if name.starts_with("_hal[") && self.is_check() {
            return Ok(f64::NAN);
        }
        match system::NAMES.binary_search_by(|(own, _)| (*own).cmp(name)) {
            Ok(place) => Ok((system::NAMES[place].1)(self)),
            Err(_) if self.is_of_caller(name) => Ok(f64::NAN),
            Err(_) => Err(ValueError::NotDefined),
        }
    }
    /// Whether a name that is not defined may have a value that the caller, or a remapped code, gave it.
    fn is_of_caller(&self, name: &str) -> bool {
        let store = &self.store;
        let global = name.starts_with('_');
        let names = if global { &store.globals } else { &store.locals };
        store.alone
            && (global || store.aside.len() == 1)
            && !name.starts_with("_ini[")
            && !name.starts_with("_hal[")
            && system::NAMES.binary_search_by(|(own, _)| (*own).cmp(name)).is_err()
            && names.get(&Name::new(name)).is_none()
    }
}
