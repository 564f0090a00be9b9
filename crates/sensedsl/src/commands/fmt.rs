//! `sensedsl fmt`: the canonical layout.

use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::{SourceMap, visible};
use sensedsl_model::{What, syntax_diagnostic};

use crate::Status;
use crate::cli::FmtArgs;
use crate::files::{read_text, shown, write_whole};
use crate::terminal::Terminal;

pub(crate) fn run(args: &FmtArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut status = Status::Done;
    for path in &args.files {
        let text = read_text(path, What::Sense)?;
        let formatted = match sensedsl_syntax::format(&text) {
            Ok(formatted) => formatted,
            Err(errors) => {
                let mut sources = SourceMap::default();
                let file = sources.add(shown(path), text);
                let reports: Vec<_> =
                    errors.iter().map(|error| syntax_diagnostic(error, file)).collect();
                terminal.diagnostics(&reports, &sources)?;
                status = Status::Wrong;
                continue;
            }
        };
        if args.check {
            if formatted != text {
                terminal.note(&format!("{}: not laid out canonically\n", visible(&shown(path))))?;
                status = Status::Wrong;
            }
        } else if path == Path::new("-") {
            terminal.result(&formatted)?;
        } else if formatted != text {
            write_whole(path, formatted.as_bytes())?;
            terminal.note(&format!("{}: laid out\n", visible(&shown(path))))?;
        }
    }
    Ok(status)
}
