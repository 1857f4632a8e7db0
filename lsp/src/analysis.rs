//! What requests read, immutable: a parsed version of a document, and its analysis.
use crate::{part::LARGE, position::Lines};
use std::{
    path::PathBuf,
    sync::{Arc, OnceLock},
    time::{Duration, Instant},
};
use tower_lsp::lsp_types::Url;
use trunnion_check::Session;
use trunnion_ide::{Names, Node, TomlFile, names, outline};
use trunnion_syntax::{Block, Program};
use trunnion_workspace::{LoadError, Overrides, Resolved, resolve};

/// Which text of a document something belongs to, and which settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Version {
    /// The client's number of the text. A client may give the same number twice.
    pub(crate) client: i32,
    /// The server's own number: no other text or settings have it.
    pub(crate) own: u64,
}

/// One version of a document, parsed.
pub(crate) struct Parsed {
    /// Document.
    pub(crate) uri: Url,
    /// Version of the text.
    pub(crate) version: Version,
    /// Text, which is UTF-8: the source of the program.
    pub(crate) text: Arc<Vec<u8>>,
    /// Line starts of the text.
    pub(crate) starts: Lines,
    /// The program with its settings; or why the settings cannot be used.
    pub(crate) outcome: Result<Source, LoadError>,
    /// It is a TOML file, and no program.
    pub(crate) toml: Option<TomlFile>,
}

impl Parsed {
    /// The text as characters; it is read through for that.
    pub(crate) fn characters(&self) -> &str {
        core::str::from_utf8(&self.text).unwrap_or_default()
    }

    /// Whether each line is a block of its own, so that their numbers agree.
    pub(crate) fn blocks_are_lines(&self) -> bool {
        let Ok(source) = &self.outcome else { return false };
        let program = &source.program;
        let begins = |(block, start): (Block<'_>, &u32)| block.range().start == *start;
        // an empty line after the last line end is no block
        program.block_count() + 1 >= self.starts.len() && program.blocks().zip(self.starts.iter()).all(begins)
    }
}

/// A program with its settings.
pub(crate) struct Source {
    /// Program.
    pub(crate) program: Program,
    /// Settings.
    pub(crate) resolved: Arc<Resolved>,
    names: OnceLock<Names>,
    outline: OnceLock<Vec<Node>>,
}

impl Source {
    pub(crate) fn new(program: Program, resolved: Arc<Resolved>) -> Self {
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
    pub(crate) session: Option<Arc<Session>>,
    /// The lines of a long text are its blocks: see [`Parsed::blocks_are_lines`].
    pub(crate) lines_are_blocks: bool,
    /// How long it took.
    pub(crate) took: Duration,
}

impl Analysed {
    /// Program, settings and session, where there are any.
    pub(crate) fn judged(&self) -> Option<(&Source, &Session)> {
        Some((self.parsed.outcome.as_ref().ok()?, self.session.as_deref()?))
    }
}

/// Which TOML file a document is; `None`: a program.
pub(crate) fn toml_file(uri: &Url, text: &str) -> Option<TomlFile> {
    let name = uri.path_segments()?.next_back()?;
    if name == "trunnion.toml" {
        return Some(TomlFile::Settings);
    }
    let machine = || {
        text.lines()
            .any(|line| line.starts_with("schema") && line.contains("\"ncmachine/"))
    };
    let ending = name.rsplit_once('.').map(|(_, ending)| ending);
    let toml = ending.is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    toml.then(|| if machine() { TomlFile::Machine } else { TomlFile::Other })
}

/// The settings of a document with this text.
pub(crate) fn settings_of(uri: &Url, text: &[u8], overrides: &Overrides) -> Result<Resolved, LoadError> {
    let path: Option<PathBuf> = uri.to_file_path().ok().or_else(|| {
        // An unsaved or remote document still has a name whose extension shows the dialect.
        uri.path_segments().and_then(|mut s| s.next_back().map(PathBuf::from))
    });
    let mut resolved = resolve(path.as_deref(), text, overrides)?;
    // a document is judged at every key stroke
    resolved.bound_steps();
    Ok(resolved)
}

/// Parses a version of a document, a long one on this many threads.
pub(crate) fn parse(uri: Url, version: Version, text: String, overrides: &Overrides, threads: usize) -> Parsed {
    let toml = toml_file(&uri, &text);
    let starts = Lines::new(text.as_bytes());
    let text = text.into_bytes();
    let settings = if toml.is_some() {
        Err(LoadError::new("this is no program"))
    } else {
        settings_of(&uri, &text, overrides)
    };
    let (text, outcome) = match settings {
        Err(error) => (Arc::new(text), Err(error)),
        Ok(resolved) => {
            let program = trunnion_syntax::parse_on(text, resolved.dialect.lex, threads);
            (program.shared_source(), Ok(Source::new(program, Arc::new(resolved))))
        }
    };
    Parsed {
        uri,
        version,
        text,
        starts,
        outcome,
        toml,
    }
}

/// Analyses a parsed version; `None` when `cancelled` returned true.
pub(crate) fn analyse(parsed: Arc<Parsed>, cancelled: &dyn Fn() -> bool) -> Option<Analysed> {
    let begun = Instant::now();
    let session = match &parsed.outcome {
        Err(_) => None,
        Ok(source) => {
            let session = Session::new(&source.program, &source.resolved.settings(), cancelled)?;
            Some(Arc::new(session))
        }
    };
    Some(Analysed {
        lines_are_blocks: parsed.text.len() > LARGE && parsed.blocks_are_lines(),
        parsed,
        session,
        took: begun.elapsed(),
    })
}
