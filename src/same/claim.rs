//! What a comparison claims: how near, and what may differ.
use crate::exact::Exact;
use crate::refit::Refit;

/// What is claimed to be the same.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Tolerance of the path, mm.
    pub mm: f64,
    /// Tolerance of the tool axis and of rotary axes, deg.
    pub deg: f64,
    /// Feeds may differ.
    pub frees_feed: bool,
    /// Everything but the geometry may differ: the claim is the path alone.
    pub path_only: bool,
    /// The programs are for controls that name what is in effect in other words. Set by [`crate::compare`].
    pub across: bool,
    /// Rapids of both controls move in straight lines. Set by [`crate::compare`].
    pub straight_rapids: bool,
    /// The working plane matters for straight lines too, as the length of the tool is perpendicular to it. Set by [`crate::compare`].
    pub plane_counts: bool,
    /// Neither program is for a machine with rotary axes, as far as is known. Set by [`crate::compare`].
    pub no_rotary: bool,
    /// Motions may be cut: a line in two is the line. Off, both programs must have the same motions one by one.
    pub cuts: bool,
    /// The judge may find that several lines are the pieces of one.
    pub pieces: bool,
    /// Lines may be put together into fewer lines and arcs; what is not, must be the same within `mm` and `deg`.
    pub refit: Option<Refit>,
    /// Of rapid motions one after the other only the start of the first and the end of the last are compared: [`crate::Judge::rapids`] decides.
    pub rapid_runs: bool,
    /// Rapid motions of the program after where the program before cuts: the judge may find that they take the tool away from the part, and
    /// cuts after them that they bring it back.
    pub retracts: bool,
    /// Nothing may differ but the layout of the text, or its block numbers: to the last bit, without any tolerance.
    pub exact: Option<Exact>,
}

impl Claim {
    /// Both programs do the same, motion by motion: no tolerance, and nothing may differ. Other claims say in what they differ from it.
    pub const STRICT: Self = Self {
        mm: 0.0,
        deg: 0.0,
        frees_feed: false,
        path_only: false,
        across: false,
        straight_rapids: false,
        plane_counts: true,
        no_rotary: false,
        cuts: false,
        pieces: false,
        refit: None,
        rapid_runs: false,
        retracts: false,
        exact: None,
    };
}
