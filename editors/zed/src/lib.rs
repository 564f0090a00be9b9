//! How Zed starts the language server: the `sensedsl` that is in the project's `PATH`, with `lsp`.

use zed_extension_api::{self as zed, Command, LanguageServerId, Worktree};

struct SenseDsl;

impl zed::Extension for SenseDsl {
    fn new() -> Self {
        Self
    }

    fn language_server_command(
        &mut self,
        _server: &LanguageServerId,
        worktree: &Worktree,
    ) -> zed::Result<Command> {
        let command = worktree.which("sensedsl");
        let command = command.ok_or("`sensedsl` is not in PATH: install it, then restart the language server")?;
        Ok(Command { command, args: vec!["lsp".to_owned()], env: worktree.shell_env() })
    }
}

zed::register_extension!(SenseDsl);
