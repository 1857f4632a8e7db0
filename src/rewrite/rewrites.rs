//! The list of rewrites, alphabetical. A rewrite is one file in `rewrites/`; its name appears in two lists here.
mod reroute_rapid;
mod smooth_pole;
mod switch_angles;
mod unwind_rotary;

use crate::{Options, Proposal, Rewrite};
use trunnion_check::{Settings, header};
use trunnion_syntax::Program;

/// What a rewrite file says about itself; name and documentation come from the file.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    /// Rules whose findings it may fix.
    pub(crate) cures: &'static [&'static str],
    /// Proposes; see [`Rewrite::propose`].
    pub(crate) propose: fn(&Program, &Settings<'_>, &Options) -> Result<Option<Proposal>, String>,
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
                propose: $file::REWRITE.propose,
            };
            &REWRITE
        }),*]
    };
}

static REWRITES: &[&Rewrite] = table![reroute_rapid, smooth_pole, switch_angles, unwind_rotary];

/// All rewrites, by name.
pub fn rewrites() -> &'static [&'static Rewrite] {
    REWRITES
}

/// A rewrite by name.
pub fn rewrite(name: &str) -> Option<&'static Rewrite> {
    rewrites().iter().copied().find(|rewrite| rewrite.name == name)
}
