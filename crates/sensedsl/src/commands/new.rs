//! `sensedsl new`: a small project to start with.

use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_board::{catalog, profile};
use sensedsl_diagnostics::visible;
use sensedsl_generate::target;

use super::template::{self, Template};
use super::{in_the_way, output, starter};
use crate::cli::NewArgs;
use crate::files::{files_below, is_part_of, shown, write_together};
use crate::status::Status;
use crate::terminal::Terminal;

const README: &str = include_str!("../../templates/project-readme.md");
const README_OF_EMBASSY: &str = include_str!("../../templates/project-readme-embassy.md");
const README_OF_WIRING: &str = include_str!("../../templates/project-readme-wiring.md");
const README_OF_WORLD: &str = include_str!("../../templates/project-readme-world.md");
const IGNORED: &str = "/build/\n";

pub(crate) fn run(args: &NewArgs, terminal: &mut Terminal) -> Result<Status> {
    let Some(board) = catalog::find(&args.board) else {
        bail!("there is no built-in board {} (`sensedsl boards` lists them)", args.board);
    };
    if args.dir.extension().is_some_and(|end| end == "sense") {
        let folder = args.dir.with_extension("");
        let folder = output::typed(&folder, "");
        bail!("`new` makes a folder with a file robot.sense in it: sensedsl new {folder}");
    }
    let texts = match &args.template {
        None => begin(board),
        Some(name) => robot_of(template::find(name)?, board)?,
    };
    let paths = texts.iter().map(|(name, text)| (args.dir.join(name), text.as_bytes()));
    let paths: Vec<_> = paths.collect();
    let files: Vec<_> = paths.iter().map(|(path, bytes)| (path.as_path(), *bytes)).collect();
    if !args.force {
        if in_the_way::refuse(&files, "the new project", terminal)? {
            return Ok(Status::Misused);
        }
        let own = |path: &Path| {
            let path = args.dir.join(path);
            files.iter().any(|(file, _)| *file == path || is_part_of(&path, file))
        };
        let found = files_below(&args.dir, &|_| false)?;
        if let Some(other) = found.iter().find(|path| !own(path)) {
            in_the_way::say_not_empty(&args.dir, other, terminal)?;
            return Ok(Status::Misused);
        }
    }
    write_together(&files)?;
    terminal.note(&format!(
        "made {} for the board {} (`--board NAME` takes another)\nnext: sensedsl solve {}\n",
        visible(&shown(&args.dir)),
        board.name,
        visible(&output::typed(&args.dir, "robot.sense"))
    ))?;
    Ok(Status::Done)
}

/// Names and texts of the files of a project.
type Texts = Vec<(&'static str, String)>;

/// The first files: with firmware for the first system on which the board can have a robot, or only a wiring.
fn begin(board: &catalog::Entry) -> Texts {
    for system in target::systems_of(board) {
        if let Some(robot) = starter::robot(board, Some(system)) {
            return project(readme_of(Some(system)).to_owned(), robot);
        }
    }
    let empty = || format!("board Robot on {} {{}}\n", board.name.replace('-', "_"));
    project(readme_of(None).to_owned(), starter::robot(board, None).unwrap_or_else(empty))
}

/// The files of a template, with its world.
fn robot_of(template: &Template, board: &catalog::Entry) -> Result<Texts> {
    let (robot, system) = template.on(board)?;
    let mut texts = project(format!("{}{README_OF_WORLD}", readme_of(system)), robot);
    texts.push(("world.toml", template.world.to_owned()));
    Ok(texts)
}

fn project(readme: String, robot: String) -> Texts {
    vec![(".gitignore", IGNORED.to_owned()), ("README.md", readme), ("robot.sense", robot)]
}

/// What a project has to be told about itself, with firmware for that system or without any.
fn readme_of(system: Option<&str>) -> &'static str {
    match system {
        None => README_OF_WIRING,
        Some(_) if system == profile::full_name(profile::DEFAULT) => README,
        Some(_) => README_OF_EMBASSY,
    }
}
