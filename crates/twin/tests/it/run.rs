//! Simulation of a text with a world, as the command does it.

use sensedsl_diagnostics::{Diagnostic, SourceMap};
use sensedsl_job::{BoardJob, jobs};
use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_twin::bench::{Bench, UncheckedIdentity};
use sensedsl_twin::judge::{DeviceFindings, Judge};
use sensedsl_twin::soft::SoftBoard;
use sensedsl_twin::world::{self, Scene, World};
use sensedsl_wire::{Decoder, Direction, Event, Scalar, Status, encode_health_request};

pub(crate) type Values = Vec<(u8, Vec<Scalar>)>;

/// The results of a run.
pub(crate) struct Run {
    pub(crate) bytes: Vec<u8>,
    pub(crate) reports: Vec<(u64, Values)>,
    pub(crate) judged: Vec<DeviceFindings>,
    pub(crate) dropped: u64,
    /// What the board says of its devices at the end, with their numbers.
    pub(crate) statuses: Vec<(u8, Status)>,
    pub(crate) unasked: Vec<UncheckedIdentity>,
    /// The parts on buses that the board has treated in a way that their drivers do not describe,
    /// each with what happened.
    pub(crate) odd: Vec<(String, String)>,
}

impl Run {
    pub(crate) fn of(&self, name: &str) -> &DeviceFindings {
        self.judged.iter().find(|one| one.name == name).unwrap_or_else(|| panic!("no {name}"))
    }

    pub(crate) fn wrong(&self) -> Vec<String> {
        let all = self.judged.iter().filter(|one| one.wrong > 0);
        all.map(|one| format!("{}: {} of {}, {:?}", one.name, one.wrong, one.reports, one.worst))
            .collect()
    }
}

/// Makes the board's job from a text and passes it on.
pub(crate) fn with_job<T>(text: &str, then: impl FnOnce(&BoardJob<'_>) -> T) -> T {
    let mut workspace = Workspace::default();
    workspace.open("board.sense", text);
    let snapshot = workspace.snapshot("board.sense", On { board: None, target: None }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else {
        panic!("{text}: {:#?}", answer.diagnostics)
    };
    let job = jobs(design, wiring).next().unwrap();
    then(&job)
}

/// Reads a world for a job.
pub(crate) fn read(job: &BoardJob<'_>, text: &str, seed: u64) -> (World, Vec<Diagnostic>) {
    let mut sources = SourceMap::default();
    let file = sources.add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let samples = |name: &str| match name {
        "drive.csv" => Ok("t,speed,other\n0,10,1\n1.0,20,\n2.0,20,3\n".to_owned()),
        "bad.csv" => Ok("t,speed\n0,1\n2,5\n1,3\n".to_owned()),
        _ => Err("there is no such file".to_owned()),
    };
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: Some(seed),
        samples: &samples,
    };
    world::read(file, text, &scene)
}

/// Runs a text with a world; reports go through `tamper` before they are judged.
pub(crate) fn simulate(
    text: &str,
    world: &str,
    seconds: u64,
    tamper: impl FnMut(u64, &mut Values),
) -> Run {
    with_job(text, |job| run(job, job, world, seconds, tamper))
}

/// Runs the board of a text with a mistake in the world of the correct text, before that one's
/// judge.
pub(crate) fn mistaken(right: &str, wrong: &str, world: &str, seconds: u64) -> Run {
    with_job(right, |right| with_job(wrong, |wrong| run(right, wrong, world, seconds, |_, _| {})))
}

fn run(
    job: &BoardJob<'_>,
    board: &BoardJob<'_>,
    world: &str,
    seconds: u64,
    mut tamper: impl FnMut(u64, &mut Values),
) -> Run {
    {
        assert_eq!(job.schema.hash(), board.schema.hash());
        let (world, output) = read(job, world, 7);
        assert!(output.is_empty(), "{output:#?}");
        let bench = Bench::new(job, &world, 7);
        let mut judge = Judge::new(job, &bench);
        let mut board = SoftBoard::new(board, bench);
        let mut decoder = Decoder::new(&job.schema, Direction::Sensor);
        let (mut all, mut reports) = (Vec::new(), Vec::new());
        let (end_ms, mut statuses) = (seconds * 1_000, Vec::new());
        for ms in 1..=end_ms + 100 {
            // Not at a full second, at which much comes.
            if ms == end_ms + 50 {
                board.link_write(&encode_health_request(&job.schema));
            }
            board.run_until(ms * 1_000_000);
            let bytes = board.link_read();
            all.extend_from_slice(&bytes);
            decoder.feed(&bytes, |event| match event {
                Event::Report(_, mut values) => {
                    tamper(ms * 1_000_000, &mut values);
                    judge.take(ms * 1_000_000, &values);
                    reports.push((ms * 1_000_000, values));
                }
                Event::Health(output) => {
                    judge.answered();
                    let received = judge.received();
                    judge.health(ms * 1_000_000, &output, received);
                    statuses = output.devices.iter().map(|row| (row.id, row.status)).collect();
                }
                Event::Hello(_)
                | Event::OtherHealth(_)
                | Event::HelloRequest
                | Event::HealthRequest => {}
            });
        }
        if statuses.is_empty() {
            judge.no_health(board.now_ns(), "the board");
        }
        let judged = judge.finish(board.now_ns());
        let unasked = board.bench().unasked();
        let odd = board.bench().odd_transfers();
        let dropped = decoder.dropped_bytes();
        Run { bytes: all, reports, judged, dropped, statuses, unasked, odd }
    }
}

/// Runs a text with a world, without tampering.
pub(crate) fn plainly(text: &str, world: &str, seconds: u64) -> Run {
    simulate(text, world, seconds, |_, _| {})
}
