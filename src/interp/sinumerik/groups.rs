//! Which code of a G group is in effect, for `$P_GG[n]` (SINUMERIK ONE, NC programming, 12/2019, table of the G groups). Before the program says one, machine
//! data decide.

use crate::codes::Found;
use crate::iso::Iso;
use trunnion_dialect::Action;

/// The number in its group of the last code of groups 12, 13, 21 and 24.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Groups([Option<u8>; 4]);

/// Groups by number, with their codes in order.
const GROUPS: [(u8, &[&str]); 4] = [
    (12, &["G601", "G602", "G603"]),
    (13, &["G70", "G71", "G700", "G710"]),
    (21, &["BRISK", "SOFT", "DRIVE"]),
    (24, &["FFWOF", "FFWON"]),
];

impl Groups {
    /// A code is in effect.
    pub(crate) fn note(&mut self, id: &str) {
        for (slot, (_, codes)) in self.0.iter_mut().zip(GROUPS) {
            if let Some(place) = codes.iter().position(|code| *code == id) {
                *slot = Some(place as u8 + 1);
            }
        }
    }
    /// Those that are known: the number of the group, and of its code.
    pub(super) fn known(&self) -> impl Iterator<Item = (u8, f64)> {
        let numbers = self.0.into_iter().zip(GROUPS);
        numbers.filter_map(|(number, (group, _))| Some((group, f64::from(number?))))
    }
}

impl Iso<'_> {
    /// What the group of a code says beside its action.
    pub(crate) fn note_group(&mut self, found: &Found<'_>) {
        match found.code.group.as_deref() {
            Some("feed-profile") => self.core.feed_profile = found.code.action != Action::NoMotion,
            Some("feed-mode") => self.core.feed_mode_unread = found.code.action == Action::NotModelled,
            Some("units" | "exact-stop-window" | "acceleration" | "feed-forward") => {
                self.memory.own.groups.note(&found.code.id);
            }
            // a program of the control may leave others behind
            None if found.with_arguments => self.memory.own.groups = crate::sinumerik::Groups::default(),
            _ => {}
        }
    }
}
