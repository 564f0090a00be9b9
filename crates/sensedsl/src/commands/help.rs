//! Shell completions and manual pages, of the definitions of the arguments. A script of completions asks the program
//! what fits, so that it knows names of the version that is installed.

use anyhow::{Result, bail};
use clap::CommandFactory as _;

use crate::cli::{Cli, CompletionsArgs, ManArgs};
use crate::files::{shown, write_together};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn completions(args: &CompletionsArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut script = Vec::new();
    let shells = clap_complete::env::Shells::builtins();
    let shell = args.shell.to_string();
    let Some(completer) = shells.completer(&shell) else { bail!("{shell} has no completions") };
    completer.write_registration("COMPLETE", "sensedsl", "sensedsl", "sensedsl", &mut script)?;
    terminal.result(&String::from_utf8_lossy(&script))?;
    Ok(Status::Done)
}

pub(crate) fn man(args: &ManArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut command = Cli::command();
    command.build();
    let Some(dir) = &args.dir else {
        terminal.result(&page(command)?)?;
        return Ok(Status::Done);
    };
    let of_commands = command.get_subcommands().cloned().collect::<Vec<_>>();
    let mut pages = vec![(dir.join("sensedsl.1"), page(command)?)];
    for one in of_commands.into_iter().filter(|one| one.get_name() != "help") {
        let name = format!("sensedsl-{}", one.get_name());
        let path = dir.join(format!("{name}.1"));
        pages.push((path, page(one.display_name(name))?));
    }
    let files: Vec<_> =
        pages.iter().map(|(path, text)| (path.as_path(), text.as_bytes())).collect();
    write_together(&files)?;
    for (path, _) in &pages {
        terminal.note(&format!("{}\n", shown(path)))?;
    }
    Ok(Status::Done)
}

fn page(command: clap::Command) -> Result<String> {
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}
