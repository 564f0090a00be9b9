//! `sensedsl new`: a small project to begin with.

use anyhow::{Result, bail};
use sensedsl_board::catalog;

use super::{boards, starter};
use crate::Status;
use crate::cli::NewArgs;
use crate::files::{files_below, shown, write_whole};
use crate::terminal::Terminal;

const README: &str = include_str!("../../templates/project-readme.md");
const README_OF_WIRING: &str = include_str!("../../templates/project-readme-wiring.md");
const IGNORED: &str = "/build/\n";

pub(crate) fn run(args: &NewArgs, terminal: &mut Terminal) -> Result<Status> {
    let Some(board) = catalog::find(&args.board) else {
        bail!("there is no built-in board {} (`sensedsl boards` lists them)", args.board);
    };
    if !files_below(&args.dir, &|_| false)?.is_empty() {
        bail!("{} is not empty: name a folder that does not exist yet", shown(&args.dir));
    }
    let robot = starter::robot(board);
    write_whole(&args.dir.join("robot.sense"), robot.as_bytes())?;
    let readme = if boards::firmware(board).is_some() { README } else { README_OF_WIRING };
    write_whole(&args.dir.join("README.md"), readme.as_bytes())?;
    write_whole(&args.dir.join(".gitignore"), IGNORED.as_bytes())?;
    let file = args.dir.join("robot.sense");
    terminal.note(&format!(
        "made {}\nnext: sensedsl solve {}\n",
        shown(&args.dir),
        shown(&file)
    ))?;
    Ok(Status::Done)
}
