//! What is in effect before a program sets it: what a control documents, and what is left open.
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use trunnion_dialect::{Action, CodeKind, Dialect, Macros};
use trunnion_interp::Argument;

/// The settings of a control before a program sets them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Initial {
    known: BTreeMap<Cow<'static, str>, Vec<Argument>>,
    /// Modal groups of the control, of which one code is in effect at any time: parameters of the control, or the program before, decide which.
    groups: BTreeSet<String>,
    /// G61 keeps the path and stops only where it bends: a point on a line stops nothing.
    pub(crate) exact_path: bool,
}

/// The modal group of exact stop and continuous path.
const PATH_CONTROL: &str = "path-control";

impl Initial {
    /// Sources: Series 30i operator's manual, list of G codes (those marked for power-on): G22, G64, G97. Grbl knows no other mode than G61. LinuxCNC, `Interp::init`: overrides on, adaptive feed off.
    pub(crate) fn of(dialect: &Dialect) -> Self {
        let mut initial = Self::default();
        let (mut modes, mut limits) = (Vec::new(), false);
        for code in dialect.codes() {
            let Some(group) = code.group.as_deref() else { continue };
            if group == PATH_CONTROL {
                modes.push(code.id.as_str());
            }
            limits |= code.id == "G22" && group == "stroke-check";
            // an M code acts when it is programmed, whatever was on before
            let sets = code.kind != CodeKind::M;
            if sets
                && matches!(
                    code.action,
                    Action::NoMotion | Action::PathMode | Action::OrientationAxes | Action::OrientationVector
                )
            {
                initial.groups.insert(group.to_owned());
            }
        }
        initial.set("compensation", "G40");
        initial.set("speed mode", "G97");
        // other controls may begin in other modes
        let fanuc = dialect.quirks.macros == Macros::Fanuc;
        if fanuc && modes.contains(&"G64") {
            initial.set(PATH_CONTROL, "G64");
        } else if let [only] = modes[..] {
            initial.set(PATH_CONTROL, only);
        }
        if fanuc && limits {
            initial.set("stroke-check", "G22");
        }
        // a postprocessor may turn the tool or not where MULTAX/ON was not programmed
        initial.groups.insert("MULTAX".to_owned());
        // LinuxCNC keeps the shift of G92 from one program to the next (user manual, G92)
        initial.groups.insert("G92 of the program before".to_owned());
        if dialect.quirks.rs274() {
            initial.set("feed override", "on");
            initial.set("speed override", "on");
            initial.set("adaptive feed", "off");
            initial
                .groups
                .extend([PATH_CONTROL, "path-control Q", "feed hold"].map(str::to_owned));
        }
        initial.exact_path = dialect.quirks.rs274() || modes == ["G61"];
        initial
    }

    fn set(&mut self, key: &'static str, code: &str) {
        self.known.insert(key.into(), vec![Argument::code(code.to_owned())]);
    }

    /// The value of a key that no program has set; empty where nothing is in effect, or where that is unknown.
    pub(crate) fn get(&self, key: &str) -> &[Argument] {
        self.known.get(key).map_or(&[], Vec::as_slice)
    }

    /// All that is known.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&Cow<'static, str>, &Vec<Argument>)> {
        self.known.iter()
    }

    /// Whether a key has a value from the start, but it is not known.
    pub(crate) fn is_open(&self, key: &str) -> bool {
        self.groups.contains(key) && !self.known.contains_key(key)
    }
}

impl crate::Steps<'_> {
    /// An excerpt: what is in effect before its first block. `feed` in mm/min.
    pub fn assume(&mut self, tcp: bool, feed: Option<f64>) {
        let state = self.interpreter.state_mut();
        state.tool_axis.set_tcp(state.tool_axis.tcp() || tcp);
        state.feed.set(feed.or(state.feed.value()));
    }
}

#[cfg(test)]
mod tests {
    use super::Initial;

    #[test]
    fn controls_begin_in_the_modes_that_their_manuals_name() {
        let of = |name: &str| Initial::of(trunnion_dialect::builtin(name).expect("built in"));
        let mode = |name: &str| of(name).get("path-control").first().map(|code| code.name.to_string());
        assert_eq!(mode("fanuc-30i").as_deref(), Some("G64"));
        assert_eq!(mode("grbl").as_deref(), Some("G61"));
        for name in ["sinumerik-840d", "iso-6983", "linuxcnc", "haas-ngc"] {
            assert!(of(name).is_open("path-control"), "{name}");
        }
        assert!(of("sinumerik-840d").is_open("compressor") && !of("fanuc-30i").is_open("coolant-that-is-none"));
        assert!(of("grbl").exact_path && of("linuxcnc").exact_path && !of("fanuc-30i").exact_path);
    }
}
