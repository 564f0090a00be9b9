//! The world that a board is simulated in: a text, or a record of a run, and the values set on the command line.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0565_not_a_record::other_boards;
use sensedsl_diagnostics::codes::e0568_recorded_otherwise::changed;
use sensedsl_diagnostics::{SourceMap, Span};
use sensedsl_job::BoardJob;
use sensedsl_model::FileUse;
use sensedsl_model::design::DeviceIndex;
use sensedsl_record::{Ending, Past};
use sensedsl_session::has_errors;
use sensedsl_twin::world::{self, Recorded, Scene, World};
use sensedsl_wire::Direction;

use crate::cli::SimulateArgs;
use crate::files::{Disk, Refused, no_record, open_record, read_text, shown};
use crate::terminal::Terminal;

/// Reads the world; `None` if it has errors, which have been reported. Its text may speak of the devices of other boards
/// that are simulated beside this one: their signals are read as well, and the faults left out.
pub(crate) fn world(
    args: &SimulateArgs,
    terminal: &Terminal,
    job: &BoardJob<'_>,
    beside: &[DeviceIndex],
) -> Result<Option<World>> {
    let record =
        args.world.as_deref().filter(|path| path.extension().is_some_and(|end| end == "mcap"));
    let (name, text) = match (&args.world, record) {
        (Some(path), None) => (shown(path), read_text(path, FileUse::World)?),
        (Some(path), Some(_)) => (shown(path), String::new()),
        (None, _) => ("--world".to_owned(), String::new()),
    };
    let path = args.world.as_deref().unwrap_or(Path::new(""));
    let disk = Disk::of(path, &args.reach.allow_outside);
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let samples = |name: &str| -> Result<String, String> {
        let path: PathBuf = folder.join(name);
        let bytes = disk.bytes(&path, FileUse::World).map_err(|unread| unread.why())?;
        String::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())
    };
    let own: Vec<DeviceIndex> = job.devices.iter().map(|one| one.index).collect();
    // A record has boards, and of each its own devices.
    let beside = beside.iter().filter(|one| record.is_none() && !own.contains(one));
    let devices: Vec<DeviceIndex> = own.iter().chain(beside).copied().collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: args.seed,
        samples: &samples,
    };
    let mut sources = SourceMap::default();
    let file = sources.add(name, text.as_str());
    let (mut world, mut reported) = match record {
        Some(path) => {
            let again = world::recorded(file, recorded(path, job, terminal)?, &scene);
            let mut reported = again.reported;
            let gone = again.left_out.iter().map(|name| format!("{name} is gone"));
            let changes: Vec<String> = gone.chain(again.changes).collect();
            if args.judge && !changes.is_empty() {
                reported.push(changed(Span::new(file, 0..0), &shown(path), &changes));
            }
            for change in changes.iter().filter(|_| !args.judge) {
                terminal.aside(&format!("not as in the record: {change}"))?;
            }
            (again.world, reported)
        }
        None => world::read(file, &text, &scene),
    };
    for one in &args.set {
        let text = format!("[devices]\n{}\n", line(one));
        let file = sources.add("--set", text.as_str());
        let (own, why) = world::read(file, &text, &scene);
        world.signals.extend(own.signals);
        reported.extend(why);
    }
    // Another board's fault is on wires that this one may have as well.
    world.faults.retain(|fault| fault.device.is_none_or(|device| own.contains(&device)));
    terminal.diagnostics(&reported, &sources)?;
    Ok((!has_errors(&reported)).then_some(world))
}

/// What a record has of the board.
fn recorded(path: &Path, job: &BoardJob<'_>, terminal: &Terminal) -> Result<Recorded> {
    let mut reader = open_record(path)?;
    let boards = reader.boards().to_vec();
    let wanted = job.board.name.value.as_str();
    let Some(index) = boards.iter().position(|board| board.name == wanted) else {
        let names: Vec<&str> = boards.iter().map(|board| board.name.as_str()).collect();
        bail!(Refused::new(path, |at, shown| other_boards(at, shown, wanted, &names)))
    };
    let devices = boards.get(index).map(|board| board.devices.clone()).unwrap_or_default();
    let mut run = Recorded { devices, ..Recorded::default() };
    while let Some(entry) = reader.next_entry().map_err(|why| no_record(path, &why.to_string()))? {
        run.lasts_ns = nanoseconds(entry.at.run);
        let Past::Value { device, value, latency, .. } = entry.what else { continue };
        let place = boards.get(index).filter(|_| entry.board == index);
        let Some(device) = place.and_then(|board| board.devices.get(device)) else { continue };
        // What arrived later was measured earlier.
        let at_ns = nanoseconds(entry.at.run.saturating_sub(latency.unwrap_or_default()));
        let numbers: Vec<f64> = value.iter().map(|raw| device.shown(*raw)).collect();
        if device.direction == Direction::Actuator {
            run.actuators.entry(device.name.clone()).or_default().push((at_ns, numbers));
            continue;
        }
        let courses = run.sensors.entry(device.name.clone()).or_default();
        courses.resize(numbers.len(), Vec::new());
        for (course, number) in courses.iter_mut().zip(numbers).filter(|one| one.1.is_finite()) {
            course.push((at_ns, number));
        }
    }
    if reader.ending() == Some(Ending::Cut) {
        terminal.aside("the record was cut off: this is all up to its last whole chunk")?;
    }
    Ok(run)
}

fn nanoseconds(time: std::time::Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}

/// The line of a world for `NAME=VALUE`. A value that is neither a number nor a list or table becomes a string:
/// `20 cm`.
fn line(set: &str) -> String {
    let Some((name, value)) = set.split_once('=') else { return set.to_owned() };
    let (name, value) = (name.trim(), value.trim());
    let is_plain =
        value.parse::<f64>().is_ok_and(f64::is_finite) || matches!(value, "true" | "false");
    if is_plain || value.starts_with(['[', '{', '"', '\'']) {
        return format!("{name} = {value}");
    }
    format!("{name} = \"{}\"", value.replace('\\', "\\\\").replace('"', "\\\""))
}
