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
const README_OF_ARDUINO: &str = include_str!("../../templates/project-readme-arduino.md");
const README_OF_WIRING: &str = include_str!("../../templates/project-readme-wiring.md");
const README_OF_WORLD: &str = include_str!("../../templates/project-readme-world.md");
const README_OF_CODE: &str = include_str!("../../templates/project-readme-code.md");
const IGNORED: &str = "/build/\n";
/// Where there is code of the user's in the firmware: everything else there is made again.
const IGNORED_BUT_CODE: &str = "\
/build/*
!/build/firmware/
/build/firmware/*/*
!/build/firmware/*/user/
!/build/firmware/*/src/
/build/firmware/*/src/*
!/build/firmware/*/src/user/
";

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
type Texts = Vec<(String, String)>;

const GITIGNORE: &str = ".gitignore";

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

/// The files of a template: its worlds, and the code of its controller where the firmware will have it.
fn robot_of(template: &Template, board: &catalog::Entry) -> Result<Texts> {
    let made = template.on(board)?;
    let system = made.system;
    let world = template.worlds.first().map_or("", |(name, _)| name);
    let of_world = if template.code.is_some() { README_OF_CODE } else { README_OF_WORLD };
    let code = template.code.as_ref().map_or("", |code| code.of(system).0);
    let of_robot = of_world.replace("WORLD", world).replace("CODE", code);
    let readme = format!("{}{of_robot}", readme_of(system));
    let worlds = template.worlds.iter().map(|(name, text)| ((*name).to_owned(), made.adapt(text)));
    let worlds: Texts = worlds.collect();
    let code = template.code.as_ref().map(|code| {
        let (name, text) = code.of(system);
        (format!("build/firmware/Robot/{name}"), made.adapt(&of_folder(name, text)))
    });
    let mut texts = project(readme, made.text);
    texts.extend(worlds);
    if let Some(code) = code {
        texts.push(code);
        texts.retain(|(name, _)| name != GITIGNORE);
        texts.push((GITIGNORE.to_owned(), IGNORED_BUT_CODE.to_owned()));
    }
    Ok(texts)
}

/// A user's file in C in the folder of a sketch, whose headers are in the folder above.
fn of_folder(name: &str, text: &str) -> String {
    let is_of_sketch =
        name.starts_with("src/") && Path::new(name).extension().is_some_and(|one| one == "c");
    if is_of_sketch { text.replacen("#include \"", "#include \"../", 1) } else { text.to_owned() }
}

fn project(readme: String, robot: String) -> Texts {
    let all = [(GITIGNORE, IGNORED.to_owned()), ("README.md", readme), ("robot.sense", robot)];
    all.map(|(name, text)| (name.to_owned(), text)).into()
}

/// What a project has to be told about itself, with firmware for that system or without any.
fn readme_of(system: Option<&str>) -> &'static str {
    match system {
        None => README_OF_WIRING,
        Some(_) if system == profile::full_name(profile::DEFAULT) => README,
        Some(system) if system.starts_with("arduino-") => README_OF_ARDUINO,
        Some(_) => README_OF_EMBASSY,
    }
}
