//! Serial lines on which the board speaks with one part after the other: it asks in each cycle, and says what the host
//! has set.
//!
//! In: the job of a board, the values of the host. Out: requests and commands to the bench, and values or faults from
//! its answers. The runtime knows when an answer is complete; here is who sends and who waits.

use sense_rt::{Compose, Echo, Exchange, Heard, InitStep, Item, MessageStart, MessageStream};
use sense_rt::{Outcome, Reply, Schema};
use sensedsl_job::kinds::serial;
use sensedsl_job::part::{ComposePlan, MessagePlan};
use sensedsl_job::{BoardJob, Cycle, JobConnection};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::Duplex;

use super::core::{Core, begins, wrapped};
use crate::bench::{Bench, Units};
use crate::tables;
use sensedsl_surroundings::Surroundings as _;

const MS_NS: u64 = 1_000_000;
/// What a part says to a step of its start is taken off the line for so long.
const DRAIN_NS: u64 = 5 * MS_NS;

/// A line with its parts.
#[derive(Clone)]
pub(super) struct Dialogue {
    wires: Wires,
    schema: &'static Schema,
    stations: Vec<Station>,
}

/// How the line is wired.
#[derive(Clone, Copy)]
struct Wires {
    unit: u8,
    duplex: Duplex,
    /// The connection that has the wire for the direction.
    first: ConnectionIndex,
}

/// A part on the line.
#[derive(Clone)]
struct Station {
    cycle: Cycle,
    init: &'static [InitStep],
    start: MessageStart,
    exchanges: Vec<Exchange>,
    orders: Vec<Order>,
    /// It did not answer the last time.
    is_lost: bool,
}

/// A value that a part is told.
#[derive(Clone)]
struct Order {
    index: usize,
    item: Item,
    compose: Compose,
    answer: Vec<u8>,
    wait_ns: u64,
    resend_ms: u64,
    value: Option<Vec<u8>>,
    is_owed: bool,
    /// The part did not take it the last time.
    has_failed: bool,
    /// When it was sent last, if it is to be repeated.
    sent_ms: Option<u64>,
}

impl Dialogue {
    /// The host has set a device.
    pub(super) fn set(&mut self, index: usize, value: &[u8]) {
        let orders = self.stations.iter_mut().flat_map(|one| &mut one.orders);
        for order in orders.filter(|one| one.index == index) {
            order.value = Some(value.to_vec());
            order.is_owed = true;
            order.has_failed = false;
        }
    }

    /// The host is silent: nothing is repeated until a failsafe or the host sets it again.
    pub(super) fn hush(&mut self) {
        let orders = self.stations.iter_mut().flat_map(|one| &mut one.orders);
        orders.for_each(|order| order.sent_ms = None);
    }

    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        if since_ms == 0 && self.wires.duplex == Duplex::Direction {
            bench.drive_at(self.wires.first, Role::Direction, Some(false), now_ns);
        }
        for station in &mut self.stations {
            let is_due = begins(since_ms, station.cycle);
            if is_due {
                station.set_up(self.wires, bench, since_ms, now_ns);
                station.ask((self.wires, self.schema), core, bench, now_ns);
            }
            for order in &mut station.orders {
                // One that was not taken is sent again in the next cycle.
                let is_repeated = order.is_repeated(since_ms);
                if is_repeated || order.is_owed && (is_due || !order.has_failed) {
                    order.send(self.wires, core, bench, (since_ms, now_ns));
                }
            }
        }
    }
}

impl Wires {
    /// Sends bytes.
    fn say(self, bytes: &[u8], bench: &mut Bench, now_ns: u64) {
        let has_direction = self.duplex == Duplex::Direction;
        if has_direction {
            bench.drive_at(self.first, Role::Direction, Some(true), now_ns);
        }
        for byte in bytes {
            bench.uart_out(self.unit, *byte, now_ns);
        }
        if has_direction {
            bench.drive_at(self.first, Role::Direction, Some(false), now_ns);
        }
    }

    /// Takes what is on the line until a moment, without what the board itself has sent, until `take` has heard
    /// enough.
    fn hear(
        self,
        sent: &[u8],
        bench: &mut Bench,
        until_ns: u64,
        mut take: impl FnMut(&[u8]) -> Heard,
    ) -> Heard {
        let mut echo = Echo::NEW;
        // With one wire the bench does not show what the port itself would hear.
        let has_echo = self.duplex == Duplex::Joined;
        while let Some(byte) = bench.uart_in(self.unit, until_ns) {
            let byte = [byte];
            let rest = if has_echo { echo.behind(sent, &byte) } else { &byte };
            let heard = if rest.is_empty() { Heard::Waiting } else { take(rest) };
            if heard != Heard::Waiting {
                return heard;
            }
        }
        Heard::Waiting
    }
}

impl Station {
    /// Sends what is due of the part's start.
    fn set_up(&mut self, wires: Wires, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        while let Some(step) = self.start.next(self.init, wrapped(since_ms)) {
            wires.say(step.bytes, bench, now_ns);
            wires.hear(&[], bench, now_ns + DRAIN_NS, |_| Heard::Waiting);
        }
    }

    /// Asks for all values. A part that does not answer the first question is not asked another one.
    fn ask(
        &mut self,
        (wires, schema): (Wires, &'static Schema),
        core: &mut Core,
        bench: &mut Bench,
        now_ns: u64,
    ) {
        let mut is_silent = false;
        for exchange in &self.exchanges {
            let mut record =
                |item: usize, outcome, value: &mut [u8]| core.record(item, outcome, value);
            if is_silent {
                exchange.fail(Outcome::TimedOut, &mut record);
                continue;
            }
            let mut stream: Box<MessageStream<[u8; 4_096]>> =
                Box::new(MessageStream::new(exchange.answer, schema));
            exchange.begin(&mut stream);
            wires.say(exchange.request, bench, now_ns);
            let until_ns = now_ns + MS_NS * u64::from(exchange.wait_ms);
            let heard = wires.hear(exchange.request, bench, until_ns, |bytes| {
                exchange.take(&mut stream, bytes, &mut record)
            });
            if heard == Heard::Waiting {
                is_silent = true;
                exchange.fail(Outcome::TimedOut, &mut record);
            }
        }
        if self.exchanges.is_empty() {
            return;
        }
        if self.is_lost && !is_silent {
            // It had no supply, perhaps: it is set up, and told everything, again.
            self.start = MessageStart::NEW;
            self.orders.iter_mut().for_each(|one| one.is_owed = one.value.is_some());
        }
        self.is_lost = is_silent;
    }
}

impl Order {
    fn is_repeated(&self, since_ms: u64) -> bool {
        let due = self.sent_ms.filter(|_| self.resend_ms > 0).map(|sent| sent + self.resend_ms);
        due.is_some_and(|due| due <= since_ms)
    }

    fn send(
        &mut self,
        wires: Wires,
        core: &mut Core,
        bench: &mut Bench,
        (since_ms, now_ns): (u64, u64),
    ) {
        let Some(value) = &self.value else { return };
        let mut message = vec![0; self.compose.bytes(&self.item)];
        let count = self.compose.write(&self.item, value, &mut message);
        message.truncate(count);
        wires.say(&message, bench, now_ns);
        let mut reply = Reply::NEW;
        let mut heard = Heard::Answered;
        if !self.answer.is_empty() || wires.duplex == Duplex::Joined {
            heard = wires.hear(&message, bench, now_ns + self.wait_ns, |bytes| {
                reply.take(&self.answer, bytes)
            });
        }
        let is_taken = self.answer.is_empty() || heard == Heard::Answered;
        self.is_owed = !is_taken;
        self.has_failed = !is_taken;
        self.sent_ms = Some(since_ms);
        let outcome = match heard {
            _ if is_taken => Outcome::Nothing,
            Heard::Waiting => Outcome::TimedOut,
            Heard::Answered | Heard::Refused => Outcome::NotAcknowledged,
        };
        core.record(self.index, outcome, &mut []);
    }
}

/// The lines of a board.
pub(super) fn dialogues(job: &BoardJob<'_>, schema: &'static Schema) -> Vec<Dialogue> {
    let units = Units::new(job);
    let of_line = |line: serial::Dialogue<'_>| {
        let wires = Wires {
            unit: units.number(line.unit)?,
            duplex: line.uart.exchange.duplex,
            first: line.wires.first()?.index,
        };
        let stations = line.wires.iter().filter_map(|wire| station(job, wire, schema)).collect();
        Some(Dialogue { wires, schema, stations })
    };
    serial::dialogues(job).into_iter().filter_map(of_line).collect()
}

fn station(
    job: &BoardJob<'_>,
    wire: &JobConnection<'_>,
    schema: &'static Schema,
) -> Option<Station> {
    let plan: &MessagePlan = job.tables_of(wire)?.message.as_ref()?;
    let place = |name: &str| job.devices.iter().position(|one| one.name() == name);
    let number = |name: &str| place(name).and_then(|at| u16::try_from(at).ok()).unwrap_or(u16::MAX);
    let order = |one: &ComposePlan| {
        let index = place(&one.field)?;
        Some(Order {
            index,
            item: *schema.items.get(index)?,
            compose: tables::compose(one),
            answer: one.answer.clone(),
            wait_ns: MS_NS * u64::from(one.wait_ms),
            resend_ms: u64::from(one.resend_ms),
            value: None,
            is_owed: false,
            has_failed: false,
            sent_ms: None,
        })
    };
    Some(Station {
        cycle: wire.cycle,
        init: tables::init(&plan.init),
        start: MessageStart::NEW,
        exchanges: plan.exchanges.iter().map(|one| tables::exchange(one, number)).collect(),
        orders: plan.commands.iter().filter_map(order).collect(),
        is_lost: false,
    })
}
