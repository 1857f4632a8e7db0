//! One analysis of one version of a document: everything requests read, immutable.
use crate::position::line_starts;
use std::{path::PathBuf, sync::Arc, time::Duration, time::Instant};
use tower_lsp::lsp_types::Url;
use trunnion_check::Session;
use trunnion_syntax::Program;
use trunnion_workspace::{LoadError, Overrides, Resolved, resolve};

/// What an analysis found.
pub(crate) struct Analysed {
    /// Document.
    pub(crate) uri: Url,
    /// Version of the text.
    pub(crate) version: i32,
    /// Text.
    pub(crate) text: Arc<str>,
    /// Line starts of the text.
    pub(crate) starts: Vec<u32>,
    /// Parsed and judged; or why the settings cannot be used.
    pub(crate) outcome: Result<Judged, LoadError>,
    /// How long it took.
    pub(crate) took: Duration,
}

/// A parsed and judged program.
pub(crate) struct Judged {
    /// Program.
    pub(crate) program: Program,
    /// Settings.
    pub(crate) resolved: Resolved,
    /// Report and check-points.
    pub(crate) session: Session,
}

/// Analyses a text; `None` when `cancelled` returned true.
pub(crate) fn analyse(
    uri: Url,
    version: i32,
    text: Arc<str>,
    overrides: &Overrides,
    cancelled: &dyn Fn() -> bool,
) -> Option<Analysed> {
    let begun = Instant::now();
    let path: Option<PathBuf> = uri.to_file_path().ok().or_else(|| {
        // An unsaved or remote document still has a name whose extension shows the dialect.
        uri.path_segments().and_then(|mut s| s.next_back().map(PathBuf::from))
    });
    let outcome = match resolve(path.as_deref(), text.as_bytes(), overrides) {
        Err(error) => Err(error),
        Ok(mut resolved) => {
            // a document is judged at every key stroke
            resolved.setup.limits = resolved.setup.limits.of_steps();
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), resolved.dialect.lex);
            let session = Session::new(&program, &resolved.settings(), cancelled)?;
            Ok(Judged {
                program,
                resolved,
                session,
            })
        }
    };
    let starts = line_starts(&text);
    Some(Analysed {
        uri,
        version,
        text,
        starts,
        outcome,
        took: begun.elapsed(),
    })
}
