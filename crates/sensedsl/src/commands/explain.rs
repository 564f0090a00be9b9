//! `sensedsl explain`: the long text of a diagnostic.

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::ALL;
use sensedsl_diagnostics::{Code, nearest};

use crate::Status;
use crate::cli::ExplainArgs;
use crate::terminal::Terminal;

pub(crate) fn run(args: &ExplainArgs, terminal: &mut Terminal) -> Result<Status> {
    let Some(name) = &args.code else {
        let lines = ALL.iter().map(|code| format!("{code}  {}\n", code.info().title));
        terminal.result(&lines.collect::<String>())?;
        return Ok(Status::Done);
    };
    let Some(code) = Code::find(name) else {
        let meant = nearest(name, ALL.iter().map(|code| code.name()));
        let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        bail!("there is no diagnostic {name}{meant} (`sensedsl explain` lists them)");
    };
    let info = code.info();
    terminal.result(&format!("{}: {}\n\n{}", info.code, info.title, info.explanation))?;
    Ok(Status::Done)
}
