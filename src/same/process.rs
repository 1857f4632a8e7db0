//! The state at a moment of a run, apart from the position of the tool.
use crate::initial::Initial;
use crate::item::Waits;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;
use trunnion_dialect::{Dialect, Plane};
use trunnion_interp::{Argument, Beside, LengthOf, ModalState, is_left};

/// Settings by their key; a key that is absent was never set, or has its initial value again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Process {
    settings: BTreeMap<Cow<'static, str>, Vec<Argument>>,
    /// Before anything was set.
    initial: Arc<Initial>,
    /// Words by their group that were programmed after something ran that may have changed everything modal: with and without them the state
    /// may differ.
    restated: BTreeMap<Restated, Vec<Argument>>,
}

/// A word that says again what is in effect.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Restated {
    pub(crate) group: String,
    /// It reads data of the control, as H does: see [`Process::note`].
    pub(crate) reads: bool,
}

/// The text on the screen: it matters if the program stops with it.
const MESSAGE: &str = "message";

/// A setting that differs.
pub(crate) struct Unlike {
    pub(crate) key: String,
    pub(crate) from: String,
    pub(crate) to: String,
    /// The state is unknown in one of the programs: it never set it, or something ran that may have changed it.
    pub(crate) is_unknown: bool,
}

impl Unlike {
    /// As a sentence.
    pub(crate) fn what(&self) -> String {
        format!("{} differs: {} and {}", self.key, self.from, self.to)
    }
}

impl Process {
    /// At the start of a program for a control.
    pub(crate) fn at_start(dialect: &Dialect) -> Self {
        Self {
            initial: Arc::new(Initial::of(dialect)),
            ..Self::default()
        }
    }

    /// Whether G61 stops only where the path bends.
    pub(crate) fn exact_path(&self) -> bool {
        self.initial.exact_path
    }

    /// Whether a key was never set, and what is in effect then is unknown.
    fn is_open(&self, key: &str) -> bool {
        !self.settings.contains_key(key) && self.initial.is_open(key)
    }

    /// Sets a key; whether that changes anything.
    pub(crate) fn set(this: &mut Arc<Self>, key: Cow<'static, str>, to: &[Argument]) -> bool {
        let was = this.get(&key);
        // what is off does not start when something may stop it
        let is_off = was.is_empty() || matches!(was, [only] if only.name == "M5");
        if was == to || is_left(to) && is_off {
            return false;
        }
        let this = Arc::make_mut(this);
        if to.is_empty() {
            this.settings.remove(&key);
        } else {
            this.settings.insert(key, to.to_vec());
        }
        true
    }

    /// What matters of words that only say again what is in effect; see [`Self::restated`].
    pub(crate) fn note(this: &mut Arc<Self>, what: Waits) {
        match what {
            // a word of a group was programmed again
            Waits::Restated(word, to) => {
                if this.restated.get(&word) != Some(&to) {
                    Arc::make_mut(this).restated.insert(word, to);
                }
            }
            // the whole modal state is unknown from here on
            Waits::Lost => {
                if !this.restated.is_empty() {
                    Arc::make_mut(this).restated.clear();
                }
            }
            // data that offsets are read from may have been written: what read them before does not hold the new values
            Waits::Written => {
                if this.restated.keys().any(|word| word.reads) {
                    let restated = &mut Arc::make_mut(this).restated;
                    restated.retain(|word, _| !word.reads);
                }
            }
            Waits::Effect(..) => {}
        }
    }

    /// The message on the screen.
    pub(crate) fn message(&self) -> &[Argument] {
        self.get(MESSAGE)
    }

    /// The value of a key; empty if it is not set, and the control has no known one from the start.
    pub fn get(&self, key: &str) -> &[Argument] {
        self.settings
            .get(key)
            .map_or_else(|| self.initial.get(key), Vec::as_slice)
    }

    /// All settings for messages, in the order of their keys.
    pub fn settings(&self) -> Vec<(String, String)> {
        let from_start = self.initial.all().filter(|(key, _)| !self.settings.contains_key(*key));
        let mut settings: Vec<_> = self.settings.iter().chain(from_start).collect();
        settings.retain(|(key, _)| *key != MESSAGE);
        settings.sort_by_key(|(key, _)| *key);
        settings
            .into_iter()
            .map(|(key, to)| (key.to_string(), shown(to)))
            .collect()
    }

    /// The first setting that `asks` wants, with its key.
    pub(crate) fn lengthy(&self, asks: impl Fn(&str, &[Argument]) -> bool) -> Option<(&str, &[Argument])> {
        let mut all = self.settings.iter().map(|(key, to)| (key.as_ref(), to.as_slice()));
        all.find(|(key, to)| asks(key, to))
    }

    /// The same with cutter radius compensation on the other side.
    pub(crate) fn on_other_side(this: &Arc<Self>) -> Arc<Self> {
        const KEY: &str = "compensation";
        let other = match this.get(KEY) {
            [only] if only.name == "G41" => "G42",
            [only] if only.name == "G42" => "G41",
            _ => return Arc::clone(this),
        };
        let mut process = Self::clone(this);
        process.settings.insert(Cow::Borrowed(KEY), vec![Argument::code(other)]);
        Arc::new(process)
    }

    /// Whether the spindle is known to be stopped: then its speed does not matter.
    fn spindle_is_stopped(&self) -> bool {
        matches!(self.get("spindle"), [only] if only.name == "M5")
    }

    /// The settings that APT and G code share.
    pub(crate) const SHARED: [&'static str; 5] = ["spindle", "speed", "flood coolant", "mist coolant", "tool in use"];

    /// The settings that differ among those that programs of two languages share: key, before, after.
    pub fn shared_differences<'p>(&'p self, other: &'p Self) -> Vec<(&'p str, String, String)> {
        let found = self.differences(other).into_iter();
        found.filter(|(key, ..)| Self::SHARED.contains(key)).collect()
    }

    /// The settings that differ: key, before, after.
    pub fn differences<'p>(&'p self, other: &'p Self) -> Vec<(&'p str, String, String)> {
        if std::ptr::eq(self, other) {
            return Vec::new();
        }
        let keys = self
            .settings
            .keys()
            .chain(other.settings.keys().filter(|key| !self.settings.contains_key(*key)));
        let idle = self.spindle_is_stopped() && other.spindle_is_stopped();
        keys.filter(|key| *key != MESSAGE && !is_in_motions(key) && self.get(key) != other.get(key))
            .filter(|key| !(idle && (key.starts_with("speed") && !key.contains('$'))))
            .map(|key| (key.as_ref(), shown(self.get(key)), shown(other.get(key))))
            .collect()
    }
}

/// Whether motions hold what a setting does to them: along which axes F is measured, whether X is a diameter.
fn is_in_motions(key: &str) -> bool {
    key == "feed group" || key.starts_with("feed radius ") || key == "diameter"
}

/// The first setting that differs among those that motions hold: it matters where a motion is not known, and where something else reads it.
pub(crate) fn unlike_in_motions(was: &Process, is: &Process) -> Option<Unlike> {
    if std::ptr::eq(was, is) {
        return None;
    }
    let mut keys = was.settings.keys().chain(is.settings.keys());
    let key = keys.find(|key| is_in_motions(key) && was.get(key) != is.get(key))?;
    Some(Unlike {
        key: key.to_string(),
        from: shown(was.get(key)),
        to: shown(is.get(key)),
        is_unknown: true,
    })
}

/// The first setting that differs and matters; `shared`: only those that APT and G code share.
pub(crate) fn unlike(was: &Process, is: &Process, shared: bool) -> Option<Unlike> {
    let found = if shared {
        was.shared_differences(is)
    } else {
        was.differences(is)
    };
    let left = |key: &str| is_left(was.get(key)) || is_left(is.get(key));
    let open = |key: &str| was.is_open(key) || is.is_open(key) || left(key);
    let certain = found.iter().find(|(key, ..)| !open(key));
    if let Some((key, from, to)) = certain.or_else(|| found.first()) {
        let is_unknown = open(key);
        let which = if is_unknown {
            " (what is in effect where nothing is programmed is unknown)"
        } else {
            ""
        };
        return Some(Unlike {
            key: (*key).to_owned(),
            from: from.clone(),
            to: format!("{to}{which}"),
            is_unknown,
        });
    }
    let words = was.restated.keys().chain(is.restated.keys());
    let mut words = words.filter(|word| was.restated.get(*word) != is.restated.get(*word));
    let word = words.next().filter(|_| !shared)?;
    let said = |process: &Process| shown(process.restated.get(word).map_or(&[], Vec::as_slice));
    let group = &word.group;
    let key = if word.reads {
        format!("{group} after offsets may have been written (whether one in effect follows at once is unknown)")
    } else {
        format!("{group} after a called program that could not be read")
    };
    Some(Unlike {
        key,
        from: said(was),
        to: said(is),
        is_unknown: true,
    })
}

/// Whether an event stops the program, so that the operator reads the message on the screen.
pub(crate) fn stops(words: &[Argument]) -> bool {
    words
        .first()
        .is_some_and(|word| matches!(word.name.as_ref(), "M0" | "M1"))
}

/// Words for messages.
pub fn shown(words: &[Argument]) -> String {
    if words.is_empty() {
        return "not programmed".to_owned();
    }
    words.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// What the modal state contains for a motion that the motion itself does not.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// Name of the active work offset.
    pub work_offset: Option<Arc<str>>,
    /// Side of the cutter radius compensation: 0 off, 41, 42.
    pub compensation: u8,
    /// The motions are the path of the tool, not the programmed path beside which it runs.
    pub(crate) beside_is_computed: bool,
    /// Which tool's length is active.
    pub length_of: LengthOf,
    /// Whether it acts after a motion in machine coordinates is not known.
    pub length_is_open: bool,
    /// Working plane: arcs, cycles and compensation lie in it.
    pub plane: Plane,
    /// Radius of the tool if it is declared to be a ball, mm.
    pub ball_radius: Option<f64>,
    /// I, J and K are the tool's direction (Fanuc G43.5).
    pub vector_mode: bool,
    /// What is declared about the tool in use.
    pub tool: Option<trunnion_interp::Tool>,
}

/// A work offset by one name: G110 to G129 of a Haas are G154 P1 to P20 (Haas mill operator's manual, G154).
pub fn offset_name(name: &str) -> Arc<str> {
    let number = name.strip_prefix('G').and_then(|digits| digits.parse::<u32>().ok());
    match number {
        Some(number @ 110..=129) => format!("G154 P{}", number - 109).into(),
        _ => name.into(),
    }
}

impl Held {
    /// Of a modal state.
    pub fn new(state: &ModalState) -> Self {
        Self {
            work_offset: state.zero.offset().map(offset_name),
            compensation: state.compensation,
            beside_is_computed: state.beside == Beside::Computed,
            length_of: state.length.of(),
            length_is_open: state.length.is_open(),
            plane: state.coordinates.plane(),
            vector_mode: state.tool_axis.vectors(),
            tool: state.tool.data(),
            ball_radius: match state.tool.shape() {
                Some((trunnion_interp::ToolShape::Ball, diameter)) => Some(0.5 * diameter),
                _ => None,
            },
        }
    }

    /// The first field that differs: name, before, after. `plane`: whether the working plane matters.
    pub(crate) fn difference(&self, other: &Self, plane: bool) -> Option<(&'static str, String, String)> {
        let offset = |held: &Self| held.work_offset.as_deref().unwrap_or("none").to_owned();
        let side = |held: &Self| match held.compensation {
            0 => "off".to_owned(),
            code => format!("G{code}"),
        };
        if self.work_offset != other.work_offset {
            Some(("the work offset", offset(self), offset(other)))
        } else if self.compensation != other.compensation {
            Some(("the side of the cutter radius compensation", side(self), side(other)))
        } else if plane && self.plane != other.plane {
            let name = |plane| match plane {
                Plane::Xy => "G17",
                Plane::Zx => "G18",
                Plane::Yz => "G19",
            };
            Some((
                "the working plane",
                name(self.plane).to_owned(),
                name(other.plane).to_owned(),
            ))
        } else if self.length_of != other.length_of {
            let name = "which tool's length is active";
            Some((name, self.length_of.to_string(), other.length_of.to_string()))
        } else {
            None
        }
    }
}
