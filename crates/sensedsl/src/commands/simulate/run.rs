//! The simulation loop: at the pace of the clock for a host application, or as fast as possible for a judge.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::{e0546_image_refused, e0548_locked_up, e0573_process_failed};
use sensedsl_host::restarted;
use sensedsl_model::design::Transport;
#[cfg(unix)]
use sensedsl_twin::bench::Peer;
use sensedsl_twin::bench::{Bench, seconds};
use sensedsl_twin::commands::Commands;
use sensedsl_twin::judge::Judge;
use sensedsl_wire::{
    Decoder, Direction, Event, Health, NEVER_MS, Scalar, Status as HealthStatus,
    encode_health_request, encode_hello_request,
};

use super::back::Reporters;
use super::board::Board;
#[cfg(unix)]
use super::can::Adapters;
use super::outlet::Outlet;
use super::picture;
use super::screen::Screen;
use super::simulation::Simulation;
use super::trace::Trace;
use super::verdict::{verdict, write_junit};
use crate::commands::deadline::interruption;
use crate::files::write_whole;
use crate::status::Status;
use sensedsl_report::columns::table;

pub(super) const MS: u64 = 1_000_000;
/// The length of a run with a judge or with lines, unless a time is given.
const SECONDS: f64 = 10.0;
/// The interval at which our host asks for the board's identity until it answers.
const ASK_NS: u64 = 500 * MS;
/// The prompt of ChibiOS' shell.
const SHELL: &[u8] = b"ch> ";
/// The interval at which the table is refreshed.
const REFRESH: Duration = Duration::from_millis(200);
/// How long the loop waits for the other side, in real time.
const STEP: Duration = Duration::from_millis(1);
/// The time that the board has to report its health.
const HEALTH_NS: u64 = 500 * MS;

pub(super) fn run(
    scenery: &Simulation<'_>,
    bench: &Bench,
    board: Box<dyn Board>,
    #[cfg(unix)] peer: Option<Peer>,
) -> Result<Status> {
    let mut session = Session::new(scenery, bench, board);
    session.trace = Trace::begin(scenery)?;
    #[cfg(unix)]
    {
        session.peer = peer;
    }
    let args = scenery.args;
    let mut status = if args.judge {
        session.hurry(false)?
    } else if args.stdout && !scenery.terminal.is_watched() {
        session.hurry(true)?
    } else {
        session.pace()?
    };
    if args.health {
        session.health()?;
    } else if args.judge && status == Status::Done && session.has_link() {
        let _ = session.ask_health()?;
    }
    let judged_ns = session.now_ns;
    picture::tell(scenery, bench)?;
    if args.judge && status == Status::Done {
        status = session.come_back()?;
    }
    if let Some(path) = &args.frames {
        write_whole(path, &session.frames)?;
    }
    if let Some(trace) = session.trace.take() {
        trace.end()?;
    }
    if let Some((path, log)) = args.wires.as_ref().zip(session.board.log()) {
        write_whole(path, log.as_bytes())?;
    }
    let status = match status {
        Status::Done if args.judge => verdict(session, judged_ns)?,
        Status::Done if session.is_wrong => Status::Wrong,
        other @ (Status::Done | Status::Wrong | Status::Misused) => other,
    };
    write_junit(scenery, status)?;
    Ok(status)
}

/// A board, and everything that listens to it.
pub(super) struct Session<'a> {
    pub(super) scenery: &'a Simulation<'a>,
    pub(super) board: Box<dyn Board>,
    decoder: Decoder<'a>,
    pub(super) judge: Judge,
    /// Whether the board's reports are compared with the world.
    pub(super) is_judged: bool,
    /// Whether the world has faults.
    pub(super) is_disturbed: bool,
    pub(super) reporters: Reporters,
    /// The host that sets actuators, in a run with a judge.
    pub(super) commands: Option<Commands<'a>>,
    screen: Screen,
    /// The peer on the CAN buses that replaces the world's stations.
    #[cfg(unix)]
    peer: Option<Peer>,
    frames: Vec<u8>,
    /// The record of the run, where one is asked for.
    trace: Option<Trace>,
    /// Whether a program of the world has failed, so that nothing more can be told of it.
    has_lost_world: bool,
    pub(super) now_ns: u64,
    /// Whether the board has identified itself.
    pub(super) is_known: bool,
    /// Whether a shell has the link until a host asks for frames: a development build.
    pub(super) has_shell: bool,
    /// The bytes that came before the board identified itself.
    greeting: Vec<u8>,
    is_other_design: bool,
    /// The last health, and the number of reports before it.
    last: Option<(Health, u64)>,
    pub(super) reports: u64,
    /// Whether the firmware has done something that is not in the plan.
    pub(super) is_wrong: bool,
}

impl<'a> Session<'a> {
    fn new(scenery: &'a Simulation<'a>, bench: &Bench, board: Box<dyn Board>) -> Self {
        let job = scenery.job;
        let mut session = Self {
            scenery,
            board,
            decoder: Decoder::new(&job.schema, Direction::Sensor),
            judge: Judge::new(job, bench),
            is_judged: true,
            is_disturbed: bench.is_disturbed(),
            reporters: Reporters::default(),
            commands: None,
            screen: Screen::new(job),
            #[cfg(unix)]
            peer: None,
            frames: Vec::new(),
            trace: None,
            has_lost_world: false,
            now_ns: 0,
            is_known: false,
            has_shell: false,
            greeting: Vec::new(),
            is_other_design: false,
            last: None,
            reports: 0,
            is_wrong: false,
        };
        if scenery.args.judge && session.has_link() {
            let end_ns = session.end_ns(Some(SECONDS)).unwrap_or(0);
            session.commands = Some(Commands::new(job, bench, end_ns));
        }
        session
    }

    /// The length of the run in virtual time; `None` if it lasts until it is stopped.
    fn end_ns(&self, usual: Option<f64>) -> Option<u64> {
        let nanoseconds = |seconds: f64| {
            Duration::from_secs_f64(seconds).as_nanos().try_into().unwrap_or(u64::MAX)
        };
        let asked = self.scenery.args.seconds.map(nanoseconds);
        asked.or_else(|| self.scenery.lasts_ns.or(Some(nanoseconds(usual?))))
    }

    /// Runs for a millisecond. Returns the bytes that the host receives.
    pub(super) fn step(&mut self, mut line: Option<&mut String>) -> Result<Vec<u8>> {
        self.now_ns += MS;
        self.board.run_until(self.now_ns);
        let bytes = self.board.link_read();
        if self.scenery.args.frames.is_some() {
            self.frames.extend_from_slice(&bytes);
        }
        self.look_for_shell(&bytes);
        let (judge, screen, now_ns) = (&mut self.judge, &mut self.screen, self.now_ns);
        let (reporters, is_judged) = (&mut self.reporters, self.is_judged);
        let hash = self.scenery.job.schema.hash();
        let trace = &mut self.trace;
        let (is_known, is_other_design, last, reports) =
            (&mut self.is_known, &mut self.is_other_design, &mut self.last, &mut self.reports);
        if is_judged {
            judge.worked(now_ns, self.board.worked_ns());
        }
        self.decoder.feed(&bytes, |event| match event {
            Event::Report(_, values) => {
                *reports += 1;
                if is_judged {
                    judge.take(now_ns, &values);
                }
                trace.iter_mut().for_each(|trace| trace.report(now_ns, &values));
                values.iter().for_each(|(id, _)| reporters.take(*id, now_ns));
                screen.take(now_ns, &values, Direction::Sensor);
                if let Some(line) = &mut line {
                    line.push_str(&screen.line(now_ns, &values));
                }
            }
            Event::Hello(reported) => {
                judge.answered();
                (*is_known, *is_other_design) = (true, reported != hash);
            }
            Event::Health(health) => {
                judge.answered();
                *last = Some((health, judge.received()));
            }
            Event::OtherHealth(_) | Event::HelloRequest | Event::HealthRequest => {}
        });
        for (index, value) in self.board.received() {
            self.set(index, &value);
        }
        for wrong in self.board.wrongs(self.scenery.at) {
            self.is_wrong = true;
            self.has_lost_world |= wrong.code.name() == e0573_process_failed::CODE.name();
            self.scenery.say(wrong)?;
        }
        for news in self.board.news() {
            self.scenery.terminal.aside(&news)?;
        }
        Ok(bytes)
    }

    /// Looks for the shell's prompt before the board has identified itself.
    fn look_for_shell(&mut self, bytes: &[u8]) {
        if !self.is_known && !self.has_shell {
            self.greeting.extend_from_slice(bytes);
            self.has_shell = self.greeting.windows(SHELL.len()).any(|some| some == SHELL);
        }
    }

    /// Shows the value that the host has set.
    fn set(&mut self, index: usize, value: &[u8]) {
        let Some(item) = self.scenery.job.schema.items.get(index) else { return };
        let elements = value.chunks_exact(item.value.scalar.size_bytes());
        let scalars: Vec<Scalar> = elements.filter_map(|one| item.value.scalar.read(one)).collect();
        if let Some(trace) = &mut self.trace {
            trace.set(self.now_ns, item.id, &scalars);
        }
        self.screen.take(self.now_ns, &[(item.id, scalars)], Direction::Actuator);
    }

    /// Asks for the board's identity, as a host does.
    fn ask(&mut self) {
        if !self.is_known && self.now_ns.is_multiple_of(ASK_NS) {
            self.ask_now();
        }
    }

    pub(super) fn ask_now(&mut self) {
        self.board.link_write(&encode_hello_request(&self.scenery.job.schema));
    }

    /// Sets actuators, as a host does.
    fn command(&mut self) {
        if let Some(commands) = &mut self.commands {
            let bytes = commands.host(self.now_ns, self.is_known);
            self.board.link_write(&bytes);
        }
    }

    /// Compares the board's outputs if it is time.
    fn look(&mut self) {
        if let Some(commands) = self.commands.as_mut().filter(|all| all.looks(self.now_ns)) {
            commands.look(self.now_ns, &self.board.outputs());
        }
    }

    /// The reason to end the run here; `None` if it goes on.
    pub(super) fn trouble(&self) -> Result<Option<Status>> {
        if self.is_other_design {
            let name = self.scenery.args.firmware.as_deref().map(crate::files::shown);
            let why = "it was made from another file, or from an older state of this one";
            let name = name.unwrap_or_default();
            self.scenery.say(e0546_image_refused::refused(self.scenery.at, &name, why))?;
            return Ok(Some(Status::Wrong));
        }
        if self.has_lost_world {
            return Ok(Some(Status::Wrong));
        }
        let Some((pc, why)) = self.board.halted() else { return Ok(None) };
        let at = format!("{:.3}", seconds(self.now_ns));
        self.scenery.say(e0548_locked_up::locked_up(self.scenery.at, pc, &why, &at))?;
        Ok(Some(Status::Wrong))
    }

    /// Runs as fast as possible; prints lines if they are wanted.
    fn hurry(&mut self, has_lines: bool) -> Result<Status> {
        let end_ns = self.end_ns(Some(SECONDS)).unwrap_or(0);
        while self.now_ns < end_ns {
            let mut line = has_lines.then(String::new);
            self.ask();
            self.command();
            self.step(line.as_mut())?;
            self.look();
            if let Some(line) = line.filter(|line| !line.is_empty()) {
                self.scenery.terminal.result(&line)?;
            }
            if let Some(status) = self.trouble()? {
                return Ok(status);
            }
        }
        Ok(Status::Done)
    }

    /// Runs at the pace of the clock, and shows the table if people can see it.
    fn pace(&mut self) -> Result<Status> {
        let terminal = self.scenery.terminal;
        let mut outlet = Outlet::open(self.scenery.args, terminal)?;
        #[cfg(unix)]
        let mut adapters =
            self.peer.as_ref().map(|peer| Adapters::open(peer, terminal)).transpose()?;
        let stop = interruption()?;
        let end_ns = self.end_ns(None);
        let (began, mut shown) = (Instant::now(), Instant::now());
        while !stop.load(Ordering::Relaxed) && end_ns.is_none_or(|end| self.now_ns < end) {
            let is_connected = outlet.wait(STEP);
            #[cfg(unix)]
            if let Some(adapters) = &mut adapters {
                adapters.turn();
            }
            let due = u64::try_from(began.elapsed().as_nanos()).unwrap_or(u64::MAX);
            let due = end_ns.map_or(due, |end| due.min(end));
            while self.now_ns + MS <= due && !stop.load(Ordering::Relaxed) {
                if !is_connected {
                    self.ask();
                }
                let bytes = self.step(None)?;
                outlet.write(&bytes, is_connected);
                if began.elapsed() > Duration::from_nanos(due) + REFRESH {
                    break;
                }
            }
            if is_connected {
                self.board.link_write(&outlet.read());
            }
            if let Some(status) = self.trouble()? {
                return Ok(status);
            }
            if terminal.is_watched() && shown.elapsed() >= REFRESH {
                shown = Instant::now();
                terminal.coloured_note(&self.screen.refreshed(self.now_ns))?;
            }
        }
        if !terminal.is_watched() {
            terminal.note(&self.screen.table(self.now_ns))?;
        }
        Ok(Status::Done)
    }

    fn has_link(&self) -> bool {
        self.scenery.job.board.link.transport != Transport::None
    }

    /// Asks the board for its health; the judge receives the answer as well.
    fn ask_health(&mut self) -> Result<Option<Health>> {
        self.last = None;
        // Garbage may have hit the answer: a host asks again.
        for _ in 0..2 {
            if self.last.is_some() {
                break;
            }
            self.board.link_write(&encode_health_request(&self.scenery.job.schema));
            let end_ns = self.now_ns + HEALTH_NS;
            while self.last.is_none() && self.now_ns < end_ns {
                self.step(None)?;
            }
        }
        self.judge.reported(&self.commands.as_ref().map(Commands::reported).unwrap_or_default());
        match &self.last {
            Some((health, received)) => self.judge.health(self.now_ns, health, *received),
            None => self.judge.no_health(self.now_ns, &self.scenery.job.board.name.value),
        }
        Ok(self.last.as_ref().map(|(health, _)| health.clone()))
    }

    /// Asks the board for its health, and prints the answer.
    fn health(&mut self) -> Result<()> {
        let Some(health) = self.ask_health()? else { bail!("the board did not say how it is") };
        let item = |id| self.scenery.job.schema.items.iter().find(|item| item.id == id);
        let restarted = restarted(&health, |id| item(id).map(|item| item.name.clone()));
        let text = format!(
            "up for {} ms{}, {} reports sent, {} not\n",
            health.uptime_ms,
            restarted.map(|text| format!(", {text}")).unwrap_or_default(),
            health.reports_sent,
            health.reports_refused
        );
        let rows: Vec<[String; 4]> = health
            .devices
            .iter()
            .map(|one| {
                let name = item(one.id).map_or("", |item| item.name.as_str()).to_owned();
                let causes = one.causes;
                let faults = [
                    causes.not_acknowledged,
                    causes.bus_error,
                    causes.arbitration_lost,
                    causes.timed_out,
                    causes.wrong_checksum,
                    causes.invalid,
                ];
                let faults: u32 = faults.into_iter().map(u32::from).sum();
                let age =
                    if one.age_ms == NEVER_MS { "-".to_owned() } else { one.age_ms.to_string() };
                [name, status(one.status).to_owned(), age, faults.to_string()]
            })
            .collect();
        let heads = ["Device", "Status", ">Age ms", ">Faults"];
        Ok(self.scenery.terminal.result(&format!("{text}{}", table(heads, &rows)))?)
    }
}

fn status(of: HealthStatus) -> &'static str {
    match of {
        HealthStatus::NeverRead => "never read",
        HealthStatus::Good => "good",
        HealthStatus::Stale => "stale",
        HealthStatus::Failed => "failed",
        HealthStatus::Invalid => "invalid",
        HealthStatus::Other(_) => "unknown",
    }
}
