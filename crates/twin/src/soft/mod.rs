//! A board's job without its MCU: the work of generated firmware, done here in virtual time.
//!
//! The board has the tables that the generator prints, and the runtime of firmware in Rust (`sense-rt`) works on them:
//! it starts, identifies and reads chips over their buses byte by byte, parses messages, measures edges, filters values
//! and composes reports. The stand-ins for hardware are here: converters, timers, ports and threads. So this proves the
//! wire, the tables and the coding of values, but nothing about registers, pads, interrupts, clocks, DMA or stacks.

mod buses;
mod control;
mod core;
mod dialogue;
mod link;
mod motors;
mod outputs;
mod sensors;
mod stand_in;

use std::collections::{BTreeMap, BTreeSet};

use sense_rt::{
    BoardHealth, Cause, FilterTable, Health, Host, Outcome, Reporter, ReporterConfig, Schema, Store,
};
use sensedsl_job::{BoardJob, Owner};
use sensedsl_model::design::{Device, DeviceIndex, Transport};
use sensedsl_wire::{Direction, ScalarType};

use self::core::{Core, wrapped};
use crate::bench::Bench;
use crate::tables::{self, kept};
use buses::{Bus, CanPeers, Port};
use control::Controllers;
pub use control::UserCode;
use dialogue::Dialogue;
use link::{Link, QUEUE_BYTES};
use outputs::Outputs;
use sensors::{Captures, Contacts, Converter, Encoders};
pub use stand_in::StandIns;

const MS_NS: u64 = 1_000_000;
/// The longest cycle of the reporter, unless the link sets its rate.
const REPORT_MS: u32 = 10;
/// The bytes that a link without a line speed carries in a millisecond: bulk transfers of full-speed USB.
const USB_BYTES_A_MS: u64 = 1_000;

/// A value that the host has set: when, in milliseconds, the place of the device in the schema, and its bytes.
pub type Received = (u64, usize, Vec<u8>);

/// A board that does its job in this program.
pub struct SoftBoard {
    bench: Bench,
    shape: Shape,
    state: State,
    now_ms: u64,
    link: Link,
    /// The values that the host or the user's code has set: milliseconds, the device's place in the schema, the value's bytes.
    received: Vec<Received>,
    starts: u32,
    code: Option<Box<dyn UserCode>>,
    has_code_ended: bool,
    /// When and why the code has stopped, until somebody asks.
    code_news: Option<(u64, String)>,
}

/// The parts of a board that stay the same when it restarts.
struct Shape {
    schema: &'static Schema,
    cycles_ms: &'static [u32],
    filters: BTreeMap<usize, &'static FilterTable>,
    config: ReporterConfig,
    /// The bytes that the link carries in a millisecond, in thousandths.
    link_speed: u64,
    has_link: bool,
    buses: Vec<Bus>,
    ports: Vec<Port>,
    lines: Vec<Dialogue>,
    stations: Vec<CanPeers>,
    converters: Vec<Converter>,
    captures: Vec<Captures>,
    contacts: Vec<Contacts>,
    encoders: Vec<Encoders>,
    outputs: Outputs,
    controllers: Controllers,
    /// The devices in the order of the schema, with the types of their elements.
    devices: Vec<(DeviceIndex, ScalarType)>,
}

/// The parts of a board that a restart resets.
struct State {
    core: Core,
    reporter: Box<Reporter<[u8; 65_536]>>,
    buses: Vec<Bus>,
    ports: Vec<Port>,
    lines: Vec<Dialogue>,
    stations: Vec<CanPeers>,
    converters: Vec<Converter>,
    captures: Vec<Captures>,
    contacts: Vec<Contacts>,
    encoders: Vec<Encoders>,
    outputs: Outputs,
    /// The values that actuators are set to in this millisecond, by the host or because of its silence.
    owed: Vec<(usize, Vec<u8>)>,
    /// The devices of controllers that the host has set itself, and has not fallen silent since.
    taken: BTreeSet<usize>,
    began_ms: u64,
}

/// The board as the reporter sees it.
struct Side<'a> {
    core: &'a mut Core,
    buses: &'a mut Vec<Bus>,
    lines: &'a mut Vec<Dialogue>,
    outputs: &'a mut Outputs,
    owed: &'a mut Vec<(usize, Vec<u8>)>,
    taken: &'a mut BTreeSet<usize>,
    owners: &'a [Owner],
    received: &'a mut Vec<Received>,
    now_ms: u64,
    starts: u32,
}

impl Side<'_> {
    /// The user's code sets a value: that of an actuator, or one that is reported.
    fn set_by_code(&mut self, index: usize, value: &[u8]) {
        if self.taken.contains(&index) {
            return;
        }
        match self.core.store.schema().items.get(index).map(|item| item.direction) {
            Some(sense_rt::Direction::ToHost) => {
                self.core.record(index, Outcome::Fresh, &mut value.to_vec());
            }
            Some(sense_rt::Direction::ToBoard) | None => {
                self.put(index, value);
                self.received.push((self.now_ms, index, value.to_vec()));
            }
        }
    }

    /// Sets the failsafe values of devices that belong to somebody.
    fn fall_back(&mut self, is_it: impl Fn(Owner) -> bool) {
        let owner = |index: usize| self.owners.get(index).copied().unwrap_or(Owner::Host);
        let safe = self.outputs.safe().filter(|(index, _)| is_it(owner(*index)));
        let safe: Vec<_> = safe.map(|(index, of)| (index, of.to_vec())).collect();
        for (index, value) in safe {
            self.put(index, &value);
        }
    }

    fn put(&mut self, index: usize, value: &[u8]) {
        self.core.store.put(index, value);
        self.core.health.note(index, Outcome::Fresh, self.core.now_ms);
        for bus in self.buses.iter_mut() {
            bus.set(index, value);
        }
        for line in self.lines.iter_mut() {
            line.set(index, value);
        }
        self.owed.push((index, value.to_vec()));
    }
}

impl Host for Side<'_> {
    fn with(&mut self, task: &mut dyn FnMut(&mut Store, &mut Health)) {
        task(&mut self.core.store, &mut self.core.health);
    }

    fn apply(&mut self, index: usize, value: &[u8]) {
        match self.owners.get(index) {
            Some(Owner::Code) => return,
            Some(Owner::CodeOrHost) => {
                self.taken.insert(index);
            }
            Some(Owner::Host) | None => {}
        }
        self.put(index, value);
        self.received.push((self.now_ms, index, value.to_vec()));
    }

    fn failsafe(&mut self) {
        self.outputs.hush();
        self.lines.iter_mut().for_each(Dialogue::hush);
        self.taken.clear();
        // What code sets is not the host's: it goes on when the host is silent.
        self.fall_back(|owner| owner == Owner::Host);
    }

    fn describe(&mut self, board: &mut BoardHealth) {
        board.reset_cause = if self.starts > 1 { Cause::Power } else { Cause::Unknown };
    }
}

impl SoftBoard {
    /// A board with its bench, before it has power.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, bench: Bench) -> Self {
        let shape = Shape::new(job);
        let state = State::new(&shape, 0);
        let (received, link) = (Vec::new(), Link::default());
        let (code, has_code_ended, code_news) = (None, false, None);
        Self {
            bench,
            shape,
            state,
            now_ms: 0,
            link,
            received,
            starts: 1,
            code,
            has_code_ended,
            code_news,
        }
    }

    /// Gives the board the code of its controllers; without it they set nothing.
    #[must_use]
    pub fn with_code(mut self, code: Box<dyn UserCode>) -> Self {
        self.code = Some(code);
        self
    }

    /// When and why the user's code has stopped, said once; `None` while it runs.
    pub fn code_ended(&mut self) -> Option<(u64, String)> {
        self.code_news.take()
    }

    /// The virtual time.
    #[must_use]
    pub fn now_ns(&self) -> u64 {
        self.now_ms * MS_NS
    }

    /// The surroundings of the board.
    #[must_use]
    pub fn bench(&self) -> &Bench {
        &self.bench
    }

    /// Holds an element of a sensor at a value in the sensor's own unit from now on; `None` lets the world have it again.
    pub fn hold(&mut self, device: DeviceIndex, element: usize, shown: Option<f64>) {
        let now_ns = self.now_ns();
        self.bench.hold(device, element, shown, now_ns);
    }

    /// The bytes of the value that a device of the schema has now; `None` until it has one.
    #[must_use]
    pub fn applied(&self, index: usize) -> Option<&[u8]> {
        self.state.core.store.get(index)
    }

    /// The host sends bytes.
    pub fn link_write(&mut self, bytes: &[u8]) {
        let room = QUEUE_BYTES.saturating_sub(self.link.inbox.len());
        self.link.inbox.extend(bytes.iter().take(room));
    }

    /// The host opens or closes its port.
    pub fn link_open(&mut self, is_open: bool) {
        self.link.is_closed = !is_open;
        if !is_open {
            self.link.queue.clear();
        }
    }

    /// The bytes that have arrived at the host since the last call.
    pub fn link_read(&mut self) -> Vec<u8> {
        self.link.sent.drain(..).collect()
    }

    /// The values that the host or the user's code has set since the last call: milliseconds, the device's place in the
    /// schema, the value's bytes.
    pub fn received(&mut self) -> Vec<Received> {
        std::mem::take(&mut self.received)
    }

    /// Runs until the given time.
    pub fn run_until(&mut self, until_ns: u64) {
        while self.now_ns() + MS_NS <= until_ns {
            self.step();
        }
    }

    /// Runs for one millisecond.
    fn step(&mut self) {
        self.now_ms += 1;
        let now_ns = self.now_ns();
        self.bench.advance(now_ns);
        if self.bench.is_off(now_ns) {
            self.state.began_ms = u64::MAX;
            self.link.queue.clear();
            self.link.inbox.clear();
            return;
        }
        if self.state.began_ms == u64::MAX {
            self.bench.power_up(now_ns);
            self.state = State::new(&self.shape, self.now_ms - 1);
            self.starts += 1;
            self.restart_code();
        }
        let since_ms = self.now_ms - self.state.began_ms - 1;
        if since_ms == 0 {
            self.state.outputs.start(&mut self.bench, now_ns);
            self.shape.controllers.begin(&mut self.state.core);
        }
        self.serve(since_ms, now_ns);
        self.control(since_ms);
        self.report(since_ms);
        self.drive();
        self.carry(now_ns);
    }

    /// Runs all threads but the reporter.
    fn serve(&mut self, since_ms: u64, now_ns: u64) {
        let State {
            core,
            buses,
            ports,
            lines,
            stations,
            converters,
            captures,
            contacts,
            encoders,
            outputs,
            ..
        } = &mut self.state;
        core.now_ms = wrapped(since_ms);
        let bench = &mut self.bench;
        buses.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        ports.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        lines.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        stations.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        converters.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        captures.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        contacts.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        encoders.iter_mut().for_each(|one| one.step(core, bench, since_ms, now_ns));
        for (index, mut value) in outputs.motors.step(bench, since_ms, now_ns) {
            core.record(index, Outcome::Fresh, &mut value);
        }
    }

    fn report(&mut self, since_ms: u64) {
        if !self.shape.has_link || !since_ms.is_multiple_of(u64::from(self.shape.config.cycle_ms)) {
            return;
        }
        let shared = (&mut self.received, &self.shape.controllers);
        let (mut side, reporter) = self.state.side(shared, (self.now_ms, self.starts));
        reporter.cycle(since_ms * 1_000, &mut self.link, &mut side);
    }

    /// Runs the steps of the user's code.
    fn control(&mut self, since_ms: u64) {
        let Some(code) = self.code.as_mut().filter(|_| !self.has_code_ended) else { return };
        match self.shape.controllers.step(&mut **code, &mut self.state.core, since_ms) {
            Ok(set) => {
                let shared = (&mut self.received, &self.shape.controllers);
                let (mut side, _) = self.state.side(shared, (self.now_ms, self.starts));
                for (index, value) in set {
                    side.set_by_code(index, &value);
                }
            }
            Err(why) => self.end_code(why),
        }
    }

    fn restart_code(&mut self) {
        if let Some(code) = &mut self.code
            && let Err(why) = code.restart()
        {
            self.end_code(why);
        }
    }

    /// The code has stopped: what it would have set falls back, as it does when the host is silent.
    fn end_code(&mut self, why: String) {
        self.has_code_ended = true;
        self.code_news = Some((self.now_ns(), why));
        let shared = (&mut self.received, &self.shape.controllers);
        let (mut side, _) = self.state.side(shared, (self.now_ms, self.starts));
        side.fall_back(|owner| owner != Owner::Host);
    }

    /// Moves values that were set to pins and lines.
    fn drive(&mut self) {
        let now_ns = self.now_ms * MS_NS;
        let State { outputs, owed, .. } = &mut self.state;
        for (index, value) in std::mem::take(owed) {
            if let Some((device, of)) = self.shape.devices.get(index) {
                let all = value.chunks_exact(of.size_bytes()).filter_map(|one| of.read(one));
                self.bench.tell(*device, all.map(crate::truth::real).collect());
            }
            outputs.set(index, &value, &mut self.bench, now_ns);
        }
        outputs.repeat(&mut self.bench, now_ns);
    }

    /// Moves the bytes that the line carries in a millisecond.
    fn carry(&mut self, now_ns: u64) {
        let link = &mut self.link;
        link.credit =
            (link.credit + self.shape.link_speed).min(2 * self.shape.link_speed.max(1_000));
        while link.credit >= 1_000
            && let Some(byte) = link.queue.pop_front()
        {
            link.credit -= 1_000;
            link.sent.push_back(byte);
        }
        link.sent.extend(self.bench.garbage(now_ns));
    }
}

impl Shape {
    fn new(job: &BoardJob<'_>) -> Self {
        let schema = kept(tables::schema(job));
        let cycles_ms = job.cycles_ms();
        let filters = job.parts.iter().flat_map(|part| &part.plan.filters).filter_map(|plan| {
            let index = job.devices.iter().position(|one| one.name() == plan.field)?;
            Some((index, kept(tables::filter(plan))))
        });
        let link = &job.board.link;
        let is_asked =
            |one: &&Device| one.direction == Direction::Sensor && !one.kind.measures_itself();
        let asked = job.devices.iter().map(|one| one.device).filter(is_asked);
        let steps = job.controllers.iter().map(|one| one.controller.every_ms);
        let usual = asked.map(|one| one.delay_ms).chain(steps).fold(REPORT_MS, u32::min).max(1);
        let cycle_ms = link.report_ms().unwrap_or(usual);
        let speed = u64::from(link.baud) / 10;
        Self {
            schema,
            filters: filters.collect(),
            config: ReporterConfig { schema, cycle_ms, silence_ms: link.silence_ms.unwrap_or(0) },
            link_speed: match link.transport {
                Transport::Uart => speed.max(1),
                Transport::Usb | Transport::None => USB_BYTES_A_MS * 1_000,
            },
            has_link: link.transport != Transport::None,
            buses: buses::buses(job, schema),
            ports: buses::ports(job, schema),
            lines: dialogue::dialogues(job, schema),
            stations: buses::stations(job),
            converters: sensors::converters(job),
            captures: sensors::captures(job),
            contacts: sensors::contacts(job),
            encoders: sensors::encoders(job),
            outputs: Outputs::new(job, schema),
            controllers: Controllers::new(job),
            devices: job
                .devices
                .iter()
                .map(|one| (one.index, one.device.value.value.scalar))
                .collect(),
            cycles_ms: cycles_ms.leak(),
        }
    }
}

impl State {
    fn new(shape: &Shape, now_ms: u64) -> Self {
        Self {
            core: Core::new(shape.schema, shape.cycles_ms, &shape.filters),
            reporter: Box::new(Reporter::new(shape.config)),
            buses: shape.buses.iter().map(Bus::anew).collect(),
            ports: shape.ports.iter().map(Port::anew).collect(),
            lines: shape.lines.clone(),
            stations: shape.stations.clone(),
            converters: shape.converters.clone(),
            captures: shape.captures.clone(),
            contacts: shape.contacts.clone(),
            encoders: shape.encoders.clone(),
            outputs: shape.outputs.clone(),
            owed: Vec::new(),
            taken: BTreeSet::new(),
            began_ms: now_ms,
        }
    }

    /// The board as the reporter and the user's code see it, and the reporter.
    fn side<'a>(
        &'a mut self,
        (received, controllers): (&'a mut Vec<Received>, &'a Controllers),
        (now_ms, starts): (u64, u32),
    ) -> (Side<'a>, &'a mut Reporter<[u8; 65_536]>) {
        let Self { core, buses, lines, reporter, outputs, owed, taken, .. } = self;
        let owners = &controllers.owners;
        let side =
            Side { core, buses, lines, outputs, owed, taken, owners, received, now_ms, starts };
        (side, reporter)
    }
}
