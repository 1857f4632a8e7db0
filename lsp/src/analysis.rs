//! What requests read, immutable: a parsed version of a document, and its analysis.
use crate::position::line_starts;
use std::{
    path::PathBuf,
    sync::{Arc, OnceLock},
    time::{Duration, Instant},
};
use tower_lsp::lsp_types::Url;
use trunnion_check::Session;
use trunnion_ide::{Names, Node, TomlFile, names, outline};
use trunnion_syntax::Program;
use trunnion_workspace::{LoadError, Overrides, Resolved, resolve};

/// One version of a document, parsed.
pub(crate) struct Parsed {
    /// Document.
    pub(crate) uri: Url,
    /// Version of the text.
    pub(crate) version: i32,
    /// Text.
    pub(crate) text: Arc<str>,
    /// Line starts of the text.
    pub(crate) starts: Vec<u32>,
    /// The program with its settings; or why the settings cannot be used.
    pub(crate) outcome: Result<Source, LoadError>,
    /// It is a settings or machine file, and no program.
    pub(crate) toml: Option<TomlFile>,
}

/// A program with its settings.
pub(crate) struct Source {
    /// Program.
    pub(crate) program: Program,
    /// Settings.
    pub(crate) resolved: Resolved,
    names: OnceLock<Names>,
    outline: OnceLock<Vec<Node>>,
}

impl Source {
    pub(crate) fn new(program: Program, resolved: Resolved) -> Self {
        Self {
            program,
            resolved,
            names: OnceLock::new(),
            outline: OnceLock::new(),
        }
    }

    /// All names of the program, read when first asked for.
    pub(crate) fn names(&self) -> &Names {
        self.names.get_or_init(|| names(&self.program, self.resolved.dialect))
    }

    /// Its outline, likewise.
    pub(crate) fn outline(&self) -> &[Node] {
        self.outline
            .get_or_init(|| outline(&self.program, self.resolved.dialect, self.names()))
    }
}

/// What an analysis found.
pub(crate) struct Analysed {
    /// What was analysed.
    pub(crate) parsed: Arc<Parsed>,
    /// Report and check-points; `None` where the settings cannot be used.
    pub(crate) session: Option<Session>,
    /// How long it took.
    pub(crate) took: Duration,
}

impl Analysed {
    /// Program, settings and session, where there are any.
    pub(crate) fn judged(&self) -> Option<(&Source, &Session)> {
        Some((self.parsed.outcome.as_ref().ok()?, self.session.as_ref()?))
    }
}

/// Whether a document is a settings or machine file.
pub(crate) fn toml_file(uri: &Url, text: &str) -> Option<TomlFile> {
    let name = uri.path_segments()?.next_back()?;
    if name == "trunnion.toml" {
        return Some(TomlFile::Settings);
    }
    let machine = || {
        text.lines()
            .any(|line| line.starts_with("schema") && line.contains("\"ncmachine/"))
    };
    (name
        .to_ascii_lowercase()
        .rsplit_once('.')
        .is_some_and(|(_, ending)| ending == "toml")
        && machine())
    .then_some(TomlFile::Machine)
}

/// Parses a version of a document.
pub(crate) fn parse(uri: Url, version: i32, text: Arc<str>, overrides: &Overrides) -> Parsed {
    let toml = toml_file(&uri, &text);
    let path: Option<PathBuf> = uri.to_file_path().ok().or_else(|| {
        // An unsaved or remote document still has a name whose extension shows the dialect.
        uri.path_segments().and_then(|mut s| s.next_back().map(PathBuf::from))
    });
    let outcome = if toml.is_some() {
        Err(LoadError::new("this is no program"))
    } else {
        resolve(path.as_deref(), text.as_bytes(), overrides).map(|mut resolved| {
            // a document is judged at every key stroke
            resolved.setup.limits = resolved.setup.limits.of_steps();
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), resolved.dialect.lex);
            Source::new(program, resolved)
        })
    };
    Parsed {
        starts: line_starts(&text),
        uri,
        version,
        text,
        outcome,
        toml,
    }
}

/// Analyses a parsed version; `None` when `cancelled` returned true.
pub(crate) fn analyse(parsed: Arc<Parsed>, cancelled: &dyn Fn() -> bool) -> Option<Analysed> {
    let begun = Instant::now();
    let session = match &parsed.outcome {
        Err(_) => None,
        Ok(source) => Some(Session::new(&source.program, &source.resolved.settings(), cancelled)?),
    };
    Some(Analysed {
        parsed,
        session,
        took: begun.elapsed(),
    })
}
