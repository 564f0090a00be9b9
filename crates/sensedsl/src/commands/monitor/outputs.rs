//! Who is told of a run besides people: what the arguments ask for.

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0566_no_new_record::not_made;
use sensedsl_host::{Board, Moment, Output};
use sensedsl_sinks::Config;

use super::link::Link;
use super::record::Recording;
use super::subject::Subject;
use crate::cli::MonitorArgs;
use crate::files::Refused;

/// All outputs of a run.
pub(super) fn outputs(
    args: &MonitorArgs,
    config: &Config,
    subject: &Subject,
    links: &[Link<'_>],
    begin: Moment,
) -> Result<Vec<Box<dyn Output>>> {
    let boards: Vec<Board> = links.iter().map(|link| link.board.clone()).collect();
    let mut outputs: Vec<Box<dyn Output>> = Vec::new();
    if let Some(path) = &args.record {
        match Recording::new(path, &subject.schema_json, &boards, begin) {
            Ok(recording) => outputs.push(Box::new(recording)),
            Err(why) => {
                bail!(Refused::new(path, |at, shown| not_made(at, shown, &why.to_string())))
            }
        }
    }
    #[cfg(unix)]
    if args.pty {
        outputs.extend(super::pty::of_boards(&boards)?);
    }
    outputs.extend(sensedsl_sinks::outputs(config, &boards, &std::process::id().to_string()));
    Ok(outputs)
}
