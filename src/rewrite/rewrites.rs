//! The list of rewrites, in the order in which `fix` applies them: postures first, then paths, then feeds, then text. A rewrite is one file in
//! `rewrites/`; its name appears in two lists here.
mod adapt_feed;
mod drop_redundant;
mod fit_arcs;
mod fit_splines;
mod insert_points;
mod insert_retract;
mod renumber;
mod reroute_rapid;
mod retarget;
mod smooth_pole;
mod switch_angles;
mod unwind_rotary;

use crate::{Known, Options, Proposed, Rewrite};
use trunnion_check::{Settings, header};
use trunnion_syntax::Program;

/// What a rewrite file says about itself; name and documentation come from the file.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    /// Rules whose findings it may fix.
    pub(crate) cures: &'static [&'static str],
    /// What it reads and writes, in G code alone; `None`: it works on the blocks of any format.
    pub(crate) writes: Option<&'static str>,
    /// Proposes; see [`Rewrite::propose`].
    pub(crate) propose: fn(&Program, &Settings<'_>, &Options, &Known) -> Proposed,
}

/// The rewrites of the files named: name from the file's name, documentation from the file's header. The `mod` lines stay
/// plain above, because rustfmt does not follow those a macro makes.
macro_rules! table {
    ($($file:ident),* $(,)?) => {
        &[$({
            const SOURCE: &str = include_str!(concat!("rewrites/", stringify!($file), ".rs"));
            const DOCS: [u8; header::docs_len(SOURCE)] = header::docs_bytes(SOURCE);
            const NAME: [u8; stringify!($file).len()] = header::dashed(stringify!($file));
            static REWRITE: Rewrite = Rewrite {
                name: header::text(&NAME),
                docs: header::text(&DOCS),
                cures: $file::REWRITE.cures,
                writes: $file::REWRITE.writes,
                proposes: $file::REWRITE.propose,
            };
            &REWRITE
        }),*]
    };
}

static REWRITES: &[&Rewrite] = table![
    switch_angles,
    unwind_rotary,
    smooth_pole,
    insert_retract,
    reroute_rapid,
    fit_arcs,
    fit_splines,
    drop_redundant,
    insert_points,
    adapt_feed,
    renumber,
    retarget
];

/// All rewrites, in the order in which they are applied.
pub fn rewrites() -> &'static [&'static Rewrite] {
    REWRITES
}

/// A rewrite by name.
pub fn rewrite(name: &str) -> Option<&'static Rewrite> {
    rewrites().iter().copied().find(|rewrite| rewrite.name == name)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    /// What a rule offers and what a rewrite fixes are one list: every call of `fix_...` in a rule stands in the rewrite's `cures`.
    #[test]
    fn rules_and_rewrites_agree_on_what_is_fixed() {
        let rules = concat!(env!("CARGO_MANIFEST_DIR"), "/../check/rules");
        let calls = [
            (".fix_pole(", "smooth-pole"),
            (".fix_turns(", "unwind-rotary"),
            (".fix_posture(", "switch-angles"),
            (".fix_feed(", "adapt-feed"),
            (".fix_points(", "insert-points"),
            (".fix_retract(", "insert-retract"),
            (".fix_rapid(", "reroute-rapid"),
        ];
        let mut offered: BTreeSet<(String, &str)> = BTreeSet::new();
        for entry in std::fs::read_dir(rules).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_stem().expect("a name").to_string_lossy().replace('_', "-");
            let text = std::fs::read_to_string(&path).expect("text");
            for (call, rewrite) in calls {
                if text.contains(call) {
                    offered.insert((name.clone(), rewrite));
                }
            }
        }
        assert!(offered.len() > 10, "{offered:?}");
        for (rule, name) in &offered {
            let rewrite = super::rewrite(name).expect("a rewrite");
            assert!(rewrite.cures.contains(&rule.as_str()), "{rule} offers {name}");
        }
        for rewrite in super::rewrites().iter().filter(|rewrite| !rewrite.cures.is_empty()) {
            assert!(
                offered.iter().any(|(_, name)| *name == rewrite.name),
                "no rule offers {}",
                rewrite.name
            );
        }
    }
}
