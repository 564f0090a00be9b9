//! The command line: the only part of SenseDSL that touches files, the terminal and the
//! environment.
//!
//! Exit status: 0 done, 1 the input is wrong, infeasible or out of date, 2 the call or the machine
//! is wrong.
#![expect(clippy::disallowed_methods, reason = "the binary is where the machine is touched")]

mod cli;
mod commands;
mod files;
mod firmware;
mod status;
mod terminal;

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser as _};

use sensedsl_diagnostics::visible;

use cli::{Cli, Command};
use files::Refused;
use status::{Reported, Status};
use terminal::Terminal;

fn main() -> ExitCode {
    // A shell that completes a line runs the program with this variable; then the program prints names and ends.
    clap_complete::CompleteEnv::with_factory(Cli::command).complete();
    let cli = Cli::try_parse().unwrap_or_else(|error| refused(&error));
    let mut terminal = Terminal::new(cli.quiet, cli.verbose);
    match run(cli.command, &mut terminal) {
        Ok(status) => status.into(),
        Err(error) if terminal::is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => ended(&error, &terminal).into(),
    }
}

/// Reports why a command ended early, unless it has done so itself.
fn ended(error: &anyhow::Error, terminal: &Terminal) -> Status {
    if let Some(Reported(status)) = error.downcast_ref::<Reported>() {
        return *status;
    }
    match error.downcast_ref::<Refused>() {
        Some(refused) => terminal.refusal(refused),
        None => terminal.failure(error),
    }
    Status::Misused
}

/// Exits with the error in the call. The error repeats arguments, which may come from file names through a shell
/// pattern.
fn refused(error: &clap::Error) -> ! {
    let arguments = std::env::args_os();
    let shown = arguments.map(|argument| visible(&argument.to_string_lossy()).into_owned());
    match Cli::try_parse_from(shown) {
        Err(shown) => shown.exit(),
        Ok(_) => error.exit(),
    }
}

fn run(command: Command, terminal: &mut Terminal) -> anyhow::Result<Status> {
    match command {
        Command::New(args) => commands::new::run(&args, terminal),
        Command::Check(args) => commands::check::run(&args, terminal),
        Command::Solve(args) => commands::solve::run(&args, terminal),
        Command::Generate(args) => commands::generate::run(&args, terminal),
        Command::Build(args) => commands::build::run(&args, terminal),
        Command::Flash(args) => commands::flash::run(&args, terminal),
        Command::Simulate(args) => commands::simulate::run(&args, terminal),
        Command::Test(args) => commands::test::run(&args, terminal),
        Command::Monitor(args) => commands::monitor::run(&args, terminal),
        Command::Convert(args) => commands::convert::run(&args, terminal),
        Command::Explain(args) => commands::explain::run(&args, terminal),
        Command::Capacity(args) => commands::capacity::run(&args, terminal),
        Command::Diff(args) => commands::diff::run(&args, terminal),
        Command::Parts(args) => commands::parts::run(&args, terminal),
        Command::Boards(args) => commands::boards::run(&args, terminal),
        Command::Drivers(args) => commands::drivers::run(&args, terminal),
        Command::Import(args) => commands::import::run(&args, terminal),
        Command::Fmt(args) => commands::fmt::run(&args, terminal),
        Command::Lsp => commands::lsp::run(),
        Command::Doctor(args) => commands::doctor::run(&args, terminal),
        Command::Studio(args) => commands::studio::run(&args, terminal),
        Command::Completions(args) => commands::help::completions(&args, terminal),
        Command::Man(args) => commands::help::man(&args, terminal),
    }
}
