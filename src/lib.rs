//! Trunnion: a G-code language toolkit and NC verifier. This crate is the facade: it re-exports the floors.
pub use trunnion_certify as certify;
pub use trunnion_check as check;
pub use trunnion_convert as convert;
pub use trunnion_dialect as dialect;
pub use trunnion_diff as diff;
pub use trunnion_formula as formula;
pub use trunnion_geometry as geometry;
pub use trunnion_interp as interp;
pub use trunnion_layout as layout;
pub use trunnion_machine as machine;
pub use trunnion_ngc as ngc;
pub use trunnion_pieces as pieces;
pub use trunnion_plot as plot;
pub use trunnion_rewrite as rewrite;
pub use trunnion_stats as stats;
pub use trunnion_surface as surface;
pub use trunnion_syntax as syntax;
