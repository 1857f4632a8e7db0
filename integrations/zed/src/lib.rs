//! Starts `trunnion lsp` in Zed: the program that the settings name, else the one on PATH.
use zed_extension_api::{self as zed, settings::LspSettings, Command, LanguageServerId, Result, Worktree};

struct Trunnion;

impl zed::Extension for Trunnion {
    fn new() -> Self {
        Self
    }

    fn language_server_command(&mut self, id: &LanguageServerId, worktree: &Worktree) -> Result<Command> {
        let settings = LspSettings::for_worktree(id.as_ref(), worktree)?;
        let program = settings
            .binary
            .and_then(|binary| binary.path)
            .or_else(|| worktree.which("trunnion"))
            .ok_or("there is no `trunnion` on PATH: install it, or name it in lsp.trunnion.binary.path of the settings")?;
        Ok(Command {
            command: program,
            args: vec!["lsp".into()],
            env: worktree.shell_env(),
        })
    }

    fn language_server_initialization_options(
        &mut self,
        id: &LanguageServerId,
        worktree: &Worktree,
    ) -> Result<Option<zed::serde_json::Value>> {
        Ok(LspSettings::for_worktree(id.as_ref(), worktree)?.initialization_options)
    }
}

zed::register_extension!(Trunnion);
