//! A sketch on the emulated AVR in its world, under a host: what the judges find, and what the host hears.

use sensedsl_diagnostics::SourceMap;
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::commands::{ActuatorFindings, Commands};
use sensedsl_twin::judge::{DeviceFindings, Judge};
use sensedsl_twin::world::{self, Scene};
use sensedsl_wire::{
    Decoder, DeviceHealth, Direction, Event, Health, Scalar, encode_health_request,
    encode_hello_request,
};

use super::board::AvrBoard;
use super::child::Reset;
use super::pads::{Mismatch, mismatches, short_triggers};
use super::units::MS;

/// How often the host asks who the board is, until it answers.
const ASK_MS: u64 = 500;
/// The time that the board has to say how it is.
const HEALTH_MS: u64 = 500;
/// When pads are looked at after a start, how often, and in what distance: a bus that is being freed has them for a
/// moment.
const LOOK_MS: u64 = 1_000;
const LOOKS: usize = 4;
const LOOKS_APART_MS: u64 = 7;

/// A host: how long it runs, and what it says.
#[derive(Clone, Copy)]
pub(super) struct Host<'a> {
    pub seconds: u64,
    /// When it asks how the board is, in milliseconds.
    pub asks_ms: &'a [u64],
    /// Whether it sets actuators, falls silent and speaks again, and then asks how the board is.
    pub sets: bool,
    /// What else it sends in a millisecond.
    pub says: &'a dyn Fn(u64) -> Vec<u8>,
}

impl Host<'_> {
    /// A host that sets actuators.
    pub(super) fn that_sets(seconds: u64) -> Self {
        Self { seconds, asks_ms: &[], sets: true, says: &|_| Vec::new() }
    }

    /// A host that asks at these times.
    pub(super) fn that_asks(seconds: u64, asks_ms: &[u64]) -> Host<'_> {
        Host { seconds, asks_ms, sets: false, says: &|_| Vec::new() }
    }
}

/// The results of a run.
#[derive(Debug)]
pub(super) struct Trial {
    pub judged: Vec<DeviceFindings>,
    pub outputs: Vec<ActuatorFindings>,
    pub mismatches: Vec<Mismatch>,
    /// Parts that were not made to measure as they need it.
    pub triggers: Vec<Mismatch>,
    pub halt: Option<String>,
    pub unwatched: Option<String>,
    pub resets: Vec<Reset>,
    /// What the board said of itself, with the time.
    pub health: Vec<(u64, Health)>,
    /// The values, with the time in milliseconds and the identifier.
    pub reported: Vec<(u64, u8, Vec<Scalar>)>,
    /// How many of these came before the board said who it is; none if it never did.
    pub greeted: Option<usize>,
    /// Whether it said that it is another.
    pub is_other: bool,
    /// All that came over the link.
    pub bytes: Vec<u8>,
    pub dropped: u64,
}

impl Trial {
    pub(super) fn reports_of(&self, id: u8, from_ms: u64, to_ms: u64) -> usize {
        let hits = |one: &&(u64, u8, Vec<Scalar>)| one.1 == id && (from_ms..to_ms).contains(&one.0);
        self.reported.iter().filter(hits).count()
    }

    /// A device in the health that the board told when it was asked for the `at`th time.
    #[track_caller]
    pub(super) fn device(&self, at: usize, id: u8) -> DeviceHealth {
        let (_, health) = &self.health[at];
        *health.devices.iter().find(|one| one.id == id).unwrap()
    }

    /// Devices that disagree with the world, with the worst of each.
    pub(super) fn wrong(&self) -> Vec<String> {
        let all = self.judged.iter().filter(|one| one.wrong > 0);
        all.map(|one| format!("{}: {} of {}, {:?}", one.name, one.wrong, one.reports, one.worst))
            .collect()
    }

    /// What is noticed of a mistake, in words; empty if nothing is.
    pub(super) fn noticed(&self) -> String {
        if let Some(why) = &self.halt {
            return format!("the program stops: {why}");
        }
        // The rest follows from these.
        if !self.resets.is_empty() {
            return "a reset".to_owned();
        }
        if self.greeted.is_none() {
            return "the host (no answer)".to_owned();
        }
        let mut all = Vec::new();
        all.extend(self.is_other.then(|| "the host (another schema)".to_owned()));
        all.extend(self.unwatched.as_ref().map(|what| format!("the watchdog {what}")));
        let listed = |what: &str, of: Vec<&str>| {
            (!of.is_empty()).then(|| format!("{what} ({})", of.join(", ")))
        };
        let pads = self.mismatches.iter().map(|one| one.what.as_str()).collect();
        all.extend(listed("pads and ports", pads));
        let triggers = self.triggers.iter().map(|one| one.what.as_str()).collect();
        all.extend(listed("triggers", triggers));
        let wrong = self.judged.iter().filter(|one| one.wrong > 0 || one.reports == 0);
        all.extend(listed("judge", wrong.map(|one| one.name.as_str()).collect()));
        let wrong = self.outputs.iter().filter(|one| one.wrong > 0);
        all.extend(listed("outputs", wrong.map(|one| one.name.as_str()).collect()));
        for one in self.mismatches.iter().chain(&self.triggers) {
            eprintln!("    {} is {}, not {}", one.what, one.found, one.expected);
        }
        self.wrong().iter().for_each(|one| eprintln!("    {one}"));
        for first in self.outputs.iter().filter_map(|one| one.first.as_ref()) {
            eprintln!("    {first:?}");
        }
        all.join(", ")
    }
}

/// A bench in a world.
pub(super) fn bench(job: &BoardJob<'_>, text: &str) -> Bench {
    let file = SourceMap::default().add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &|_| Err("there are no files".to_owned()),
    };
    let (world, mistakes) = world::read(file, text, &scene);
    assert!(mistakes.is_empty(), "{mistakes:?}");
    Bench::new(job, &world, world.seed.unwrap_or(1))
}

/// When pads are looked at next, and what every look since the start has found.
struct Looks {
    starts: usize,
    at_ms: u64,
    left: usize,
    found: Option<Vec<Mismatch>>,
}

impl Looks {
    fn look(&mut self, job: &BoardJob<'_>, board: &mut AvrBoard, ms: u64) -> Vec<Mismatch> {
        if board.resets().len() > self.starts {
            *self = Self { starts: board.resets().len(), at_ms: ms + LOOK_MS, ..Self::default() };
        }
        if self.left == 0 || ms < self.at_ms {
            return Vec::new();
        }
        let now = mismatches(job, board);
        let still = match self.found.take() {
            None => now,
            Some(before) => before.into_iter().filter(|one| now.contains(one)).collect(),
        };
        self.left = if still.is_empty() { 0 } else { self.left - 1 };
        self.at_ms = ms + LOOKS_APART_MS;
        if self.left == 0 {
            return still;
        }
        self.found = Some(still);
        Vec::new()
    }
}

impl Default for Looks {
    fn default() -> Self {
        Self { starts: 0, at_ms: LOOK_MS, left: LOOKS, found: None }
    }
}

/// A run under way.
struct Session<'a> {
    job: &'a BoardJob<'a>,
    board: AvrBoard,
    judge: Judge,
    decoder: Decoder<'a>,
    trial: Trial,
}

impl Session<'_> {
    /// Runs for a millisecond, and hears what comes of it.
    fn step(&mut self, ms: u64) {
        self.board.run_until(ms * MS);
        let bytes = self.board.link_read();
        let (judge, trial) = (&mut self.judge, &mut self.trial);
        let hash = self.job.schema.hash();
        self.decoder.feed(&bytes, |event| match event {
            Event::Report(_, values) => {
                judge.take(ms * MS, &values);
                trial.reported.extend(values.into_iter().map(|(id, value)| (ms, id, value)));
            }
            Event::Hello(found) => {
                judge.answered();
                trial.is_other |= found != hash;
                trial.greeted.get_or_insert(trial.reported.len());
            }
            Event::Health(health) => {
                judge.answered();
                judge.health(ms * MS, &health, judge.received());
                trial.health.push((ms, health));
            }
            Event::OtherHealth(_) => trial.is_other = true,
            Event::HelloRequest | Event::HealthRequest => {}
        });
        trial.bytes.extend(bytes);
        trial.unwatched = trial.unwatched.take().or_else(|| self.board.unwatched());
    }

    /// Asks how the board is, after all else.
    fn ask_health(&mut self, from_ms: u64, commands: &Commands<'_>) {
        self.judge.reported(&commands.reported());
        let before = self.trial.health.len();
        self.board.link_write(&encode_health_request(&self.job.schema));
        for ms in from_ms + 1..=from_ms + HEALTH_MS {
            self.step(ms);
        }
        if self.trial.health.len() == before {
            self.judge.no_health(self.board.now_ns(), &self.job.board.name.value);
        }
    }

    fn finish(mut self, outputs: Vec<ActuatorFindings>) -> Trial {
        self.judge.transfers(self.board.now_ns(), &self.board.odd_transfers());
        let unasked = self.board.unasked().into_iter().filter(|one| one.is_known);
        for one in unasked {
            let what = "it is not asked who it is".to_owned();
            self.judge.transfers(self.board.now_ns(), &[(one.name, what)]);
        }
        Trial {
            judged: self.judge.finish(self.board.now_ns()),
            outputs,
            triggers: short_triggers(self.job, &self.board),
            halt: self.board.halt(),
            resets: self.board.resets().to_vec(),
            dropped: self.decoder.dropped_bytes(),
            ..self.trial
        }
    }
}

/// Runs an image for a job's board in a world, under a host.
pub(super) fn run(
    job: &BoardJob<'_>,
    world: &str,
    image: &std::path::Path,
    host: Host<'_>,
) -> Trial {
    let own = bench(job, world);
    let mut session = Session {
        job,
        judge: Judge::new(job, &own),
        board: AvrBoard::new(job, bench(job, world), image),
        decoder: Decoder::new(&job.schema, Direction::Sensor),
        trial: Trial::empty(),
    };
    let end_ms = host.seconds * 1_000;
    let mut commands = Commands::new(job, &own, end_ms * MS);
    let mut looks = Looks::default();
    session.board.link_open(true);
    for ms in 1..=end_ms {
        let mut says = (host.says)(ms);
        if session.trial.greeted.is_none() && ms % ASK_MS == 0 {
            says.extend(encode_hello_request(&job.schema));
        }
        if host.asks_ms.contains(&ms) {
            says.extend(encode_health_request(&job.schema));
        }
        if host.sets {
            says.extend(commands.host((ms - 1) * MS, session.trial.greeted.is_some()));
        }
        session.board.link_write(&says);
        session.step(ms);
        if host.sets && commands.looks(ms * MS) {
            commands.look(ms * MS, &session.board.outputs());
        }
        let found = looks.look(job, &mut session.board, ms);
        session.trial.mismatches.extend(found);
        if session.board.halt().is_some() {
            break;
        }
    }
    if host.sets && session.board.halt().is_none() {
        session.ask_health(end_ms, &commands);
    }
    let outputs = if host.sets { commands.finish() } else { Vec::new() };
    session.finish(outputs)
}

impl Trial {
    fn empty() -> Self {
        Self {
            judged: Vec::new(),
            outputs: Vec::new(),
            mismatches: Vec::new(),
            triggers: Vec::new(),
            halt: None,
            unwatched: None,
            resets: Vec::new(),
            health: Vec::new(),
            reported: Vec::new(),
            greeted: None,
            is_other: false,
            bytes: Vec::new(),
            dropped: 0,
        }
    }
}
