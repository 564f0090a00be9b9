//! Serial lines on which the board speaks with one part after the other: it asks in each cycle, and
//! says what the host has set.
//!
//! Tables of parts and the queues of a port in, values and faults out. One task has a line, so
//! requests, commands and answers of its parts never meet.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Instant, Timer, with_deadline};
use sense_rt::{
    Compose, Echo, Exchange, Heard, InitStep, MessageStart, MessageStream, Outcome, Reply, Schema,
    Sink,
};

use crate::now_ms;
use crate::serial::{RxQueue, TxQueue};

/// What a part says to a step of its start is taken off the line for so long.
const DRAIN_MS: u16 = 5;

/// What takes the bytes of an answer, and says whether it has heard enough.
type Listener<'a> = dyn FnMut(&[u8]) -> Heard + 'a;

/// Tells the task of a line that the host has set something; it is a `static`.
pub type Wake = Signal<CriticalSectionRawMutex, ()>;

/// What is known of an order.
#[derive(Clone, Copy)]
pub struct OrderState {
    sent_ms: u32,
    /// The part has not taken the value yet.
    is_owed: bool,
    /// It did not take it the last time: it is told again in its next cycle.
    has_failed: bool,
    /// There is a value.
    is_set: bool,
    /// It is sent again and again.
    is_repeated: bool,
}

/// The value of an order, which the reporter sets; it is a `static`.
pub struct Told<const BYTES: usize>(
    Mutex<CriticalSectionRawMutex, RefCell<(OrderState, [u8; BYTES])>>,
);

/// The value of an order, whatever its size.
pub trait Slot: Sync {
    /// Hands out what is known of the order, and its value.
    fn with(&self, task: &mut dyn FnMut(&mut OrderState, &mut [u8]));
}

impl<const BYTES: usize> Told<BYTES> {
    /// Without a value yet.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        let state = OrderState {
            sent_ms: 0,
            is_owed: false,
            has_failed: false,
            is_set: false,
            is_repeated: false,
        };
        Self(Mutex::new(RefCell::new((state, [0; BYTES]))))
    }
}

impl<const BYTES: usize> Slot for Told<BYTES> {
    fn with(&self, task: &mut dyn FnMut(&mut OrderState, &mut [u8])) {
        self.0.lock(|told| {
            let mut told = told.borrow_mut();
            let (state, value) = &mut *told;
            task(state, value);
        });
    }
}

/// The host has set a value.
pub fn tell(slot: &dyn Slot, value: &[u8], wake: &Wake) {
    slot.with(&mut |state, place| {
        for (to, from) in place.iter_mut().zip(value) {
            *to = *from;
        }
        state.is_set = true;
        state.is_owed = true;
        state.has_failed = false;
    });
    wake.signal(());
}

/// The host is silent: an order is not repeated until it is set again.
pub fn hush(slot: &dyn Slot) {
    slot.with(&mut |state, _| state.is_repeated = false);
}

/// A value that a part is told.
pub struct Order {
    /// The message.
    pub compose: Compose,
    /// The index of the item in the schema.
    pub item: u16,
    /// What the part says when it has taken it; empty for nothing.
    pub answer: &'static [u8],
    /// The time that the part has for that.
    pub wait_ms: u16,
    /// The time after which it is sent again; 0: it is sent once.
    pub resend_ms: u32,
    /// Its value.
    pub told: &'static dyn Slot,
}

/// A part on a line.
pub struct Station {
    /// How it is started.
    pub init: &'static [InitStep],
    /// What it is asked in each cycle.
    pub exchanges: &'static [Exchange],
    /// What it is told.
    pub orders: &'static [Order],
    /// Its cycle.
    pub cycle_ms: u32,
}

/// How far a part has come.
#[derive(Clone, Copy)]
struct Progress {
    start: MessageStart,
    due_ms: Option<u32>,
    /// It did not answer the last time.
    is_lost: bool,
}

impl Progress {
    /// Whether its turn is nearer to this cycle of its line, half of which is over at `now_ms`, than
    /// to the next one.
    fn is_due(&mut self, cycle_ms: u32, now_ms: u32) -> bool {
        let late_ms = self.due_ms.map(|due| now_ms.wrapping_sub(due));
        if late_ms.is_some_and(|late| late >= 0x8000_0000) {
            return false;
        }
        // Cycles that were missed are left out.
        let from = match (self.due_ms, late_ms) {
            (Some(due), Some(late)) if late < cycle_ms => due,
            (_, _) => now_ms,
        };
        self.due_ms = Some(from.wrapping_add(cycle_ms));
        true
    }
}

/// The queues of a port, and how its line is wired.
#[derive(Clone, Copy)]
pub struct Wires<const RX: usize, const TX: usize> {
    /// What comes.
    pub rx: &'static RxQueue<RX>,
    /// What is to be sent.
    pub tx: &'static TxQueue<TX>,
    /// The time of a character in microseconds, rounded up.
    pub character_us: u32,
    /// The board hears what it sends.
    pub has_echo: bool,
    /// A wire gives the line to the board.
    pub has_direction: bool,
}

/// A line with its parts. `MEMORY` is room for the longest answer and the longest value, `SENT` for
/// the longest command.
pub struct Line<
    const MEMORY: usize,
    const SENT: usize,
    const RX: usize,
    const TX: usize,
    const N: usize,
> {
    wires: Wires<RX, TX>,
    stations: &'static [Station; N],
    schema: &'static Schema,
    wake: &'static Wake,
    progress: [Progress; N],
    sent: [u8; SENT],
}

impl<const RX: usize, const TX: usize> Wires<RX, TX> {
    /// Sends bytes; what came before them belongs to nothing.
    async fn say(&self, bytes: &[u8], give: &mut dyn FnMut(bool)) {
        self.rx.clear();
        if !self.has_direction {
            self.tx.write_all(bytes).await;
            return;
        }
        give(true);
        self.tx.write_all(bytes).await;
        let character = Duration::from_micros(u64::from(self.character_us));
        while !self.tx.is_empty() {
            Timer::after(character).await;
        }
        // One is in the port, and one in its register.
        Timer::after(character * 2).await;
        give(false);
    }

    /// Takes what comes in the time that the bytes take on the line and `wait_ms`, without their
    /// echo, until `take` has heard enough; with no `take`, until the echo is over.
    async fn hear(&self, sent: &[u8], wait_ms: u16, mut take: Option<&mut Listener<'_>>) -> Heard {
        // A byte that is queued waits for a tick of the clock besides its own time.
        let line_us = sent.len() as u64 * 2 * (u64::from(self.character_us) + 64);
        let until = Instant::now()
            + Duration::from_millis(u64::from(wait_ms))
            + Duration::from_micros(line_us);
        let mut echo = Echo::NEW;
        loop {
            let mut bytes = [0; 16];
            let Ok(size) = with_deadline(until, self.rx.read(&mut bytes)).await else {
                return Heard::Waiting;
            };
            let all = bytes.get(..size).unwrap_or_default();
            let rest = if self.has_echo { echo.behind(sent, all) } else { all };
            if echo.is_wrong() {
                return Heard::Waiting;
            }
            let heard = match &mut take {
                None if echo.is_over(sent) => Heard::Answered,
                Some(take) if !rest.is_empty() => take(rest),
                None | Some(_) => Heard::Waiting,
            };
            if heard != Heard::Waiting {
                return heard;
            }
        }
    }
}

impl<const MEMORY: usize, const SENT: usize, const RX: usize, const TX: usize, const N: usize>
    Line<MEMORY, SENT, RX, TX, N>
{
    /// Nothing was asked yet.
    pub fn new(
        wires: Wires<RX, TX>,
        stations: &'static [Station; N],
        schema: &'static Schema,
        wake: &'static Wake,
    ) -> Self {
        let progress = Progress { start: MessageStart::NEW, due_ms: None, is_lost: false };
        Self { wires, stations, schema, wake, progress: [progress; N], sent: [0; SENT] }
    }

    /// Asks the parts that are due, and tells them what they are owed, up to `until`. `give` has the
    /// wire for the direction.
    pub async fn cycle(&mut self, until: Instant, give: &mut dyn FnMut(bool), sink: &mut Sink<'_>) {
        let fastest_ms = self.stations.iter().map(|one| one.cycle_ms).min().unwrap_or(0);
        let middle_ms = now_ms().wrapping_add(fastest_ms / 2);
        for (station, progress) in self.stations.iter().zip(&mut self.progress) {
            let is_due = progress.is_due(station.cycle_ms, middle_ms);
            if is_due {
                set_up(&self.wires, station, progress, give).await;
                let asked =
                    ask_all::<MEMORY, RX, TX>(&self.wires, station, self.schema, give, sink);
                let is_silent = asked.await;
                progress.answered(station, is_silent);
            }
            tell_all(&self.wires, station, self.schema, &mut self.sent, (is_due, give, sink)).await;
        }
        while Instant::now() < until {
            let next = repeated_ms(self.stations).map(|ms| Duration::from_millis(ms.into()));
            let next = next.map_or(until, |next| until.min(Instant::now() + next));
            // Whether it was told or time has passed: what is due is looked up.
            let _ = with_deadline(next, self.wake.wait()).await;
            for station in self.stations {
                tell_all(&self.wires, station, self.schema, &mut self.sent, (false, give, sink))
                    .await;
            }
        }
    }
}

impl Progress {
    /// A part that answers again had no supply, perhaps: it is set up, and told everything, again.
    fn answered(&mut self, station: &Station, is_silent: bool) {
        if station.exchanges.is_empty() {
            return;
        }
        if self.is_lost && !is_silent {
            self.start = MessageStart::NEW;
            for order in station.orders {
                order.told.with(&mut |state, _| state.is_owed = state.is_set);
            }
        }
        self.is_lost = is_silent;
    }
}

/// Sends the bytes that are due from the steps that start a part, and drops what it says to them.
async fn set_up<const RX: usize, const TX: usize>(
    wires: &Wires<RX, TX>,
    station: &Station,
    progress: &mut Progress,
    give: &mut dyn FnMut(bool),
) {
    while let Some(step) = progress.start.next(station.init, now_ms()) {
        wires.say(step.bytes, give).await;
        wires.hear(step.bytes, DRAIN_MS, Some(&mut |_| Heard::Waiting)).await;
    }
}

/// Asks for all values. A part that does not answer the first question is not asked another one.
async fn ask_all<const MEMORY: usize, const RX: usize, const TX: usize>(
    wires: &Wires<RX, TX>,
    station: &Station,
    schema: &'static Schema,
    give: &mut dyn FnMut(bool),
    sink: &mut Sink<'_>,
) -> bool {
    let mut is_silent = false;
    for exchange in station.exchanges {
        if !is_silent {
            let mut stream = MessageStream::<[u8; MEMORY]>::new(exchange.answer, schema);
            exchange.begin(&mut stream);
            wires.say(exchange.request, give).await;
            let mut take = |bytes: &[u8]| exchange.take(&mut stream, bytes, sink);
            let heard = wires.hear(exchange.request, exchange.wait_ms, Some(&mut take)).await;
            is_silent = heard == Heard::Waiting;
        }
        if is_silent {
            exchange.fail(Outcome::TimedOut, sink);
        }
    }
    is_silent
}

/// The time until something has to be repeated.
fn repeated_ms(stations: &[Station]) -> Option<u32> {
    let left = |order: &Order| {
        let mut left = None;
        order.told.with(&mut |state, _| {
            let passed = now_ms().wrapping_sub(state.sent_ms);
            left = state.is_repeated.then(|| order.resend_ms.saturating_sub(passed));
        });
        left
    };
    stations.iter().flat_map(|one| one.orders).filter_map(left).min()
}

/// Tells a part what is due: what is new, what has to be repeated, and in its own cycle what it has
/// not taken.
async fn tell_all<const RX: usize, const TX: usize>(
    wires: &Wires<RX, TX>,
    station: &Station,
    schema: &'static Schema,
    message: &mut [u8],
    (is_due, give, sink): (bool, &mut dyn FnMut(bool), &mut Sink<'_>),
) {
    for order in station.orders {
        let size = due(order, schema, is_due, message);
        let Some(message) = size.and_then(|size| message.get(..size)) else { continue };
        let index = usize::from(order.item);
        if message.is_empty() {
            sink(index, Outcome::BusError, &mut []);
            continue;
        }
        wires.say(message, give).await;
        let mut reply = Reply::NEW;
        let mut take = |bytes: &[u8]| reply.take(order.answer, bytes);
        let heard = match (order.answer.is_empty(), wires.has_echo) {
            (false, _) => wires.hear(message, order.wait_ms, Some(&mut take)).await,
            (true, true) => wires.hear(message, order.wait_ms, None).await,
            (true, false) => Heard::Answered,
        };
        let outcome = match heard {
            Heard::Answered => Outcome::Nothing,
            Heard::Waiting => Outcome::TimedOut,
            Heard::Refused => Outcome::NotAcknowledged,
        };
        if heard != Heard::Answered {
            order.told.with(&mut |state, _| {
                state.is_owed = true;
                state.has_failed = true;
            });
        }
        sink(index, outcome, &mut []);
    }
}

/// Writes the message of an order that is due, and returns its size; 0 if the value does not fit.
fn due(order: &Order, schema: &Schema, is_its_turn: bool, message: &mut [u8]) -> Option<usize> {
    let item = schema.items.get(usize::from(order.item))?;
    let mut size = None;
    order.told.with(&mut |state, value| {
        let passed = now_ms().wrapping_sub(state.sent_ms);
        let is_repeated = state.is_repeated && passed >= order.resend_ms;
        if is_repeated || state.is_owed && (is_its_turn || !state.has_failed) {
            state.is_owed = false;
            state.has_failed = false;
            state.is_repeated = order.resend_ms > 0;
            state.sent_ms = now_ms();
            size = Some(order.compose.write(item, value, message));
        }
    });
    size
}
