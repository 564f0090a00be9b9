//! `sensedsl simulate`: a board without hardware, whose sensors measure a simulated world.

mod back;
mod board;
#[cfg(unix)]
mod can;
mod code;
mod commands;
#[cfg(feature = "twin")]
mod emulated;
mod outlet;
mod picture;
mod process;
#[cfg(unix)]
mod pty;
mod run;
mod screen;
mod simulated;
mod simulation;
#[cfg(unix)]
mod slcan;
mod tcp;
mod trace;
mod verdict;
mod world;

use std::path::{Path, PathBuf};

use anyhow::Result;
#[cfg(feature = "twin")]
use sensedsl_diagnostics::codes::e0546_image_refused;
#[cfg(not(feature = "twin"))]
use sensedsl_diagnostics::codes::e0547_no_machine;
use sensedsl_diagnostics::codes::{e0519_which_board, e0536_user_code_stopped};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};
use sensedsl_job::{BoardJob, jobs};
#[cfg(feature = "twin")]
use sensedsl_machine::Mcu;
use sensedsl_model::FileUse;
use sensedsl_report::schema::schema;
use sensedsl_session::{Ask, has_errors};
use sensedsl_twin::bench::Bench;
#[cfg(feature = "twin")]
use sensedsl_twin::emulated::EmulatedBoard;
use sensedsl_twin::soft::{StandIns, UserCode};
use sensedsl_twin::trial::Tested;
use sensedsl_twin::world::World;

use super::input;
use crate::cli::{On, SimulateArgs};
use crate::files::read_bytes;
#[cfg(feature = "twin")]
use crate::files::shown;
use crate::status::Status;
use crate::terminal::Terminal;
use board::Board;
pub(crate) use code::{Built, Running, Words, build};
pub(crate) use process::attach_all;
#[cfg(unix)]
pub(crate) use pty::Pty;
pub(crate) use simulated::Simulated;
use simulation::Simulation;
pub(crate) use world::world;

/// The seed of the random numbers if none is given.
pub(crate) const SEED: u64 = 1;

/// What each way proves and does not prove, in lines of at most 80 columns.
const SOFT: [&str; 4] = [
    "Running the board's job in this program: the tables of the firmware on the",
    "runtime that firmware in Rust has. This proves the wire, how values are coded,",
    "parts, and host applications; it does not prove registers, clocks, pads,",
    "interrupts, DMA, stacks, or the C of the firmware (`--firmware` does).",
];
const EMULATED: [&str; 3] = [
    "Running the image on an emulated MCU. This proves the firmware as it would be",
    "flashed: pads, drivers, timing to about a microsecond; it does not prove what",
    "is between a pad and a part: voltages, noise, cables, connectors.",
];

pub(crate) fn run(args: &SimulateArgs, terminal: &Terminal) -> Result<Status> {
    let on = On { board: None, target: args.target.clone(), reach: args.reach.clone() };
    let snapshot = input::load(&args.file, &on);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = input::wired(&answer, &snapshot, &on, terminal)?;
    let diagnostics = &answer.diagnostics;
    terminal.diagnostics(diagnostics, snapshot.sources())?;
    if has_errors(diagnostics) {
        return Ok(Status::Wrong);
    }
    let all: Vec<BoardJob<'_>> = jobs(design, wiring).collect();
    let names: Vec<&str> = all.iter().map(|job| job.board.name.value.as_str()).collect();
    let wanted =
        |job: &&BoardJob<'_>| args.board.as_ref().is_none_or(|name| *name == job.board.name.value);
    let Some(job) = all.iter().find(wanted) else {
        let asked = args.board.as_deref().unwrap_or_default();
        let why = e0519_which_board::not_in_file(input::place(design), asked, &names);
        terminal.diagnostics(&[why], snapshot.sources())?;
        return Ok(Status::Misused);
    };
    if args.board.is_none() && names.len() > 1 {
        let others: Vec<&str> = names.iter().skip(1).copied().collect();
        terminal.aside(&format!("`--board` simulates another one: {}", others.join(", ")))?;
    }
    let schema = args.trace.is_some().then(|| schema(design, wiring).to_string());
    simulate(args, terminal, job, snapshot.sources(), schema)
}

fn simulate(
    args: &SimulateArgs,
    terminal: &Terminal,
    job: &BoardJob<'_>,
    sources: &SourceMap,
    schema_json: Option<String>,
) -> Result<Status> {
    let Some(world) = world(args, terminal, job, &[])? else { return Ok(Status::Wrong) };
    let (at, lasts_ns) = (input::place(job.design), world.lasts_ns);
    let (said, cases) = Default::default();
    let scenery =
        Simulation { args, terminal, job, at, sources, lasts_ns, schema_json, said, cases };
    let seed = args.seed.or(world.seed).unwrap_or(SEED);
    let mut bench = Bench::new(job, &world, seed);
    let folder = args.world.as_deref().and_then(Path::parent).unwrap_or_else(|| Path::new(""));
    attach_all(&mut bench, &world, folder);
    #[cfg(unix)]
    let peer = args.can.then(|| bench.open_can(job));
    if args.wires.is_some() {
        bench.start_log();
    }
    let Some(firmware) = &args.firmware else {
        let code = match code(&scenery, &world)? {
            Ok(code) => code,
            Err(why) => {
                scenery.say(*why)?;
                return Ok(Status::Wrong);
            }
        };
        explain(&scenery, &SOFT)?;
        let board = board::soft(job, bench.clone(), code);
        return run::run(
            &scenery,
            &bench,
            board,
            #[cfg(unix)]
            peer,
        );
    };
    let image = read_bytes(firmware, FileUse::Image)?;
    at_rest(&scenery, &bench)?;
    match machine(&scenery, bench.clone(), firmware, &image) {
        Ok(board) => {
            explain(&scenery, &EMULATED)?;
            run::run(
                &scenery,
                &bench,
                board,
                #[cfg(unix)]
                peer,
            )
        }
        Err(why) => {
            scenery.say(*why)?;
            Ok(Status::Wrong)
        }
    }
}

/// The folder of a board's firmware, beside the file, unless somebody says another.
pub(crate) fn usual_code(file: &Path, board: &str) -> PathBuf {
    let beside = file.parent().unwrap_or_else(|| Path::new(""));
    beside.join("build").join("firmware").join(board)
}

/// The user's code, running.
type Code = Box<dyn UserCode>;

/// The user's code, built and started, or what stands in for it in the world as long as no code was made; none if the
/// board has no controller, or neither is there.
fn code(scenery: &Simulation<'_>, world: &World) -> Result<Result<Option<Code>, Box<Diagnostic>>> {
    let (job, args) = (scenery.job, scenery.args);
    if job.controllers.is_empty() {
        return Ok(Ok(None));
    }
    let usual = || usual_code(&args.file, &job.board.name.value);
    let folder = args.code.clone().unwrap_or_else(usual);
    if args.code.is_none() && !folder.is_dir() {
        let devices = job.controllers.iter().filter_map(|one| job.devices.get(one.own));
        let names: Vec<&str> = devices.map(|one| one.device.name.value.as_str()).collect();
        let held = world.stand_ins.iter().filter_map(|one| job.design.device(one.controller));
        let held: Vec<&str> = held.map(|one| one.name.value.as_str()).collect();
        let idle: Vec<&str> = names.into_iter().filter(|name| !held.contains(name)).collect();
        if !held.is_empty() {
            let names = held.join(", ");
            let what = format!("no code of {names}: the world's `[controllers]` stand in for it");
            scenery.terminal.aside(&what)?;
        }
        if !idle.is_empty() {
            let names = idle.join(", ");
            let next = "`sensedsl generate` makes its first file";
            scenery.terminal.aside(&format!("no code of {names}: it sets nothing. {next}"))?;
        }
        let code = || Box::new(StandIns::new(job, &world.stand_ins)) as Code;
        return Ok(Ok((!held.is_empty()).then(code)));
    }
    let built = match build(job, &folder, scenery.at, Words::Above)? {
        Ok(built) => built,
        Err(why) => return Ok(Err(why)),
    };
    Ok(match Running::new(built) {
        Ok(running) => Ok(Some(Box::new(running))),
        Err(why) => Err(e0536_user_code_stopped::user_code_stopped(scenery.at, "0 s", &why).into()),
    })
}

/// Names the actuators that an image tells over a bus: nothing reads there what they were told.
fn at_rest(scenery: &Simulation<'_>, bench: &Bench) -> Result<()> {
    let design = scenery.job.design;
    let told = bench.told().into_iter().filter_map(|at| design.device(at));
    let names: Vec<&str> = told.map(|one| one.name.value.as_str()).collect();
    if !names.is_empty() {
        let names = names.join(", ");
        let what = format!("{names}: plants do not follow what an image tells parts on buses");
        scenery.terminal.aside(&what)?;
    }
    Ok(())
}

/// Prints what the run proves; as an aside, because programs also read a judge's verdict.
fn explain(scenery: &Simulation<'_>, lines: &[&str]) -> Result<()> {
    for line in lines {
        scenery.terminal.aside(line)?;
    }
    Ok(())
}

#[cfg(feature = "twin")]
fn emulated(
    (job, at): (&BoardJob<'_>, Span),
    bench: Bench,
    firmware: &Path,
    image: &[u8],
) -> Result<EmulatedBoard, Box<Diagnostic>> {
    let board = job.board;
    let mcu = board.mcu.as_deref().unwrap_or("MCU that nobody knows");
    if Mcu::find(mcu).is_none() {
        let name = &board.name.value;
        let known: Vec<&str> = Mcu::parts().collect();
        let known = known.join(", ");
        return Err(e0546_image_refused::other_mcu(at, name, mcu, &known).into());
    }
    EmulatedBoard::new(job, bench, image).map_err(|why| {
        let (image, why) = (shown(firmware), why.to_string());
        e0546_image_refused::refused(at, &image, &why).into()
    })
}

#[cfg(feature = "twin")]
fn machine(
    scenery: &Simulation<'_>,
    bench: Bench,
    firmware: &Path,
    image: &[u8],
) -> Result<Box<dyn Board>, Box<Diagnostic>> {
    Ok(Box::new(emulated((scenery.job, scenery.at), bench, firmware, image)?))
}

#[cfg(not(feature = "twin"))]
fn machine(
    scenery: &Simulation<'_>,
    _: Bench,
    _: &Path,
    _: &[u8],
) -> Result<Box<dyn Board>, Box<Diagnostic>> {
    Err(e0547_no_machine::no_machine(scenery.at).into())
}

/// An image on the emulated MCU, for a test.
///
/// # Errors
///
/// The image cannot be read; a mistake of the user's is a diagnostic.
#[cfg(feature = "twin")]
pub(crate) fn tested_image(
    of: (&BoardJob<'_>, Span),
    bench: Bench,
    path: &Path,
) -> Result<Result<Box<dyn Tested>, Box<Diagnostic>>> {
    let image = read_bytes(path, FileUse::Image)?;
    Ok(emulated(of, bench, path, &image).map(|board| Box::new(board) as Box<dyn Tested>))
}

/// There is no emulated MCU in this program.
///
/// # Errors
///
/// None: that there is no machine is a diagnostic.
#[cfg(not(feature = "twin"))]
#[expect(clippy::unnecessary_wraps, reason = "as with the machine")]
pub(crate) fn tested_image(
    (_, at): (&BoardJob<'_>, Span),
    _: Bench,
    _: &Path,
) -> Result<Result<Box<dyn Tested>, Box<Diagnostic>>> {
    Ok(Err(e0547_no_machine::no_machine(at).into()))
}
