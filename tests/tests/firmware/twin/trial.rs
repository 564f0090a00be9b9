//! A real image in a simulated world, judged as in `simulate --firmware IMAGE --judge`.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock};

use sensedsl_diagnostics::SourceMap;
use sensedsl_job::BoardJob;
use sensedsl_machine::{Event as Told, Lockup};
use sensedsl_tests::root;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::emulated::EmulatedBoard;
use sensedsl_twin::judge::{DeviceFindings, Judge};
use sensedsl_twin::pads::PadMismatch;
use sensedsl_twin::world::{self, Scene};
use sensedsl_wire::{
    Decoder, Direction, Event, Health, Scalar, Schema, encode_health_request, encode_hello_request,
    encode_report,
};

use super::bench::{MS, STEERING, folder};
use crate::embassy::with_job;
use crate::firmware::chibios::{build, tree};
use crate::firmware::embassy;

/// The results of a run.
pub(super) struct Trial {
    pub judged: Vec<DeviceFindings>,
    pub mismatches: Vec<PadMismatch>,
    pub halt: Option<Lockup>,
    pub told: Vec<Told>,
    /// The health that the board reported, with the time.
    pub health: Vec<(u64, Health)>,
    /// The values reported, with the time in milliseconds and the identifier.
    pub reported: Vec<(u64, u8, Vec<Scalar>)>,
    /// How many of these came before the board's greeting; `None` if the board greets nobody.
    pub greeted: Option<usize>,
    /// The names of the identifiers.
    pub names: BTreeMap<u8, String>,
    pub dropped: u64,
    /// Mismatches of the rover's outputs.
    pub outputs: Vec<String>,
}

impl Trial {
    pub(super) fn wrong(&self) -> Vec<String> {
        let all = self.judged.iter().filter(|one| one.wrong > 0);
        all.map(|one| format!("{}: {} of {}, {:?}", one.name, one.wrong, one.reports, one.worst))
            .collect()
    }

    pub(super) fn reports_of(&self, id: u8, from_ms: u64, to_ms: u64) -> usize {
        let hits = |one: &&(u64, u8, Vec<Scalar>)| one.1 == id && (from_ms..to_ms).contains(&one.0);
        self.reported.iter().filter(hits).count()
    }
}

/// The target that a program is generated for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum System {
    Chibios,
    Embassy,
}

impl System {
    /// The program of a design's only board, built once; `None` if the machine cannot build it, or
    /// has no time for it.
    pub(super) fn image(self, name: &str, text: &str) -> Option<Arc<[u8]>> {
        type Built = Arc<OnceLock<Option<Arc<[u8]>>>>;
        static BUILT: Mutex<BTreeMap<(System, String), Built>> = Mutex::new(BTreeMap::new());
        let mut all = BUILT.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let own = Arc::clone(all.entry((self, text.to_owned())).or_default());
        drop(all);
        own.get_or_init(|| self.build(name, text).map(Into::into)).clone()
    }

    fn build(self, name: &str, text: &str) -> Option<Vec<u8>> {
        match self {
            Self::Chibios => {
                let tree = tree()?;
                let board = folder(name, text);
                build(&tree, &board, "production");
                Some(image(&board))
            }
            Self::Embassy => Some(std::fs::read(embassy::program(name, text)?).unwrap()),
        }
    }

    pub(super) fn target(self) -> Option<&'static str> {
        match self {
            Self::Chibios => None,
            Self::Embassy => Some("embassy"),
        }
    }
}

/// Runs an image for the board of a text, with a host that greets it and requests health at the
/// given times.
pub(super) fn run(
    system: System,
    design: (&str, &str),
    image: &[u8],
    seconds: u64,
    asks_ms: &[u64],
) -> Trial {
    run_with(system, design, image, seconds, |ms, _, schema| {
        let mut output = greets(ms, &[], schema);
        if asks_ms.contains(&ms) {
            output.extend(encode_health_request(schema));
        }
        output
    })
}

/// Runs an image for the board of a text, with a host that is called each millisecond: it gets the
/// time and the bytes that the board sent, and returns the bytes that it sends.
pub(super) fn run_with(
    system: System,
    (text, world): (&str, &str),
    image: &[u8],
    seconds: u64,
    host: impl FnMut(u64, &[u8], &Schema) -> Vec<u8>,
) -> Trial {
    with_job(text, system.target(), |job| run_job(job, world, image, seconds, host))
}

/// A host that only sends a greeting.
pub(super) fn greets(ms: u64, _: &[u8], schema: &Schema) -> Vec<u8> {
    if ms == 500 { encode_hello_request(schema) } else { Vec::new() }
}

/// Runs an image for a board's job.
pub(super) fn run_job(
    job: &BoardJob<'_>,
    world: &str,
    image: &[u8],
    seconds: u64,
    mut host: impl FnMut(u64, &[u8], &Schema) -> Vec<u8>,
) -> Trial {
    let mut sources = SourceMap::default();
    let file = sources.add("world.toml", world);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &|_| Err("there are no files".to_owned()),
    };
    let (world, output) = world::read(file, world, &scene);
    assert!(output.is_empty(), "{output:#?}");
    let bench = Bench::new(job, &world, world.seed.unwrap_or(1));
    let mut judge = Judge::new(job, &bench);
    let mut board = EmulatedBoard::new(job, bench, image).unwrap();
    let mut decoder = Decoder::new(&job.schema, Direction::Sensor);
    let (mut health, mut reported, mut told) = (Vec::new(), Vec::new(), Vec::new());
    let (mut mismatches, mut outputs) = (Vec::new(), Vec::new());
    let (mut output, mut greeted) = (Vec::new(), None);
    let motor = job.schema.items.iter().any(|item| item.name == "Motor" && item.id == 20);
    for ms in 1..=seconds * 1_000 {
        board.link_write(&host(ms, &output, &job.schema));
        // The host sends full speed for 300 ms, and then nothing.
        if motor && (600..900).contains(&ms) && ms % 100 == 0 {
            let values = [(20, vec![Scalar::Unsigned(10_000)])];
            let bytes = encode_report(&job.schema, Direction::Actuator, &values);
            board.link_write(&bytes.unwrap());
        }
        board.run_until(ms * MS);
        for (at, name, width) in PULSES {
            let found = board.waves().get(&STEERING).copied();
            let is_right = |(period_ns, width_ns): (u64, u64)| {
                period_ns.abs_diff(20 * MS) < 1_000 && width_ns.abs_diff(width) < 1_000
            };
            if motor && ms == at && !found.is_some_and(is_right) {
                outputs.push(format!("{name}: {found:?} and not 20 ms, {width} ns"));
            }
        }
        output = board.link_read();
        decoder.feed(&output, |event| match event {
            Event::Report(_, values) => {
                judge.take(ms * MS, &values);
                reported.extend(values.into_iter().map(|(id, value)| (ms, id, value)));
            }
            Event::Hello(hash) => {
                judge.answered();
                assert_eq!(hash, job.schema.hash());
                greeted.get_or_insert(reported.len());
            }
            Event::Health(found) => {
                judge.answered();
                health.push((ms, found));
            }
            Event::OtherHealth(_) | Event::HelloRequest | Event::HealthRequest => {}
        });
        told.extend(board.events());
        mismatches.extend(board.mismatches());
        if board.halt().is_some() {
            break;
        }
    }
    // The host gets the last bytes; its answer goes nowhere.
    let _ = host(seconds * 1_000, &output, &job.schema);
    Trial {
        judged: judge.finish(board.now_ns()),
        mismatches,
        halt: board.halt(),
        told,
        health,
        reported,
        greeted,
        names: job.schema.items.iter().map(|item| (item.id, item.name.clone())).collect(),
        dropped: decoder.dropped_bytes(),
        outputs,
    }
}

/// The expected pulse width of the rover's motor, by time.
const PULSES: [(u64, &str, u64); 3] = [
    (500, "before the host says something", 1_500_000),
    (900, "as the host wants it", 2_000_000),
    (1_700, "when the host is silent", 1_500_000),
];

/// The design that has one of everything.
pub(super) fn rover() -> String {
    std::fs::read_to_string(root().join("tests/firmware/trial/rover.sense")).unwrap()
}

/// The world of the rover, without faults.
pub(super) fn rover_world() -> String {
    std::fs::read_to_string(root().join("tests/firmware/trial/rover.toml")).unwrap()
}

/// The program in a board's folder.
pub(super) fn image(board: &Path) -> Vec<u8> {
    std::fs::read(board.join("build/production/sense.elf")).unwrap()
}

/// The rover's image; `None` if it cannot be built.
pub(super) fn rover_image(system: System) -> Option<Arc<[u8]>> {
    system.image(&format!("trial_rover_{system:?}"), &rover())
}
