//! The board's end of a link: takes what the host sends, and sends what is due.
//!
//! The owner of the link calls [`Reporter::cycle`] at its rate. Nothing waits. A report is only put
//! together when the one before it has left the channel, so that its values have waited for at most
//! one report, however slow the line is. A frame that the channel does not take at once is finished
//! in the next cycles.

use core::ops::{Deref, DerefMut};

use crate::bits::Bits;
use crate::bytes::{Writer, part, part_mut, split};
use crate::convert::milliseconds;
use crate::decode::Frame;
use crate::encode::{Stamp, encode_each, encode_health, encode_hello};
use crate::health::{AGE_NEVER, BoardHealth, Health, HealthRow};
use crate::listener::Listener;
use crate::schema::{Direction, Schema};
use crate::silence::Silence;
use crate::store::Store;
use crate::uses;

/// Bytes per read and reads per cycle: a host that sends without end must not delay reports.
const READ_BYTES: usize = 16;
const READS_MAX: usize = 64;
/// The time between two looks at the age of a device, a power of two: all of them are seen long before the clock wraps.
const TICK_MS: u32 = 1024;
/// A value that has waited for more of its device's cycles, or of the reporter's, is too old.
const FRESH_CYCLES: u32 = 2;

/// A channel for bytes: a port, an endpoint, or a queue before either. Its methods must not wait.
pub trait Channel {
    /// Whether the other end listens, as far as the channel can tell.
    fn is_open(&mut self) -> bool;
    /// Reads the bytes that have arrived, as many as fit into `bytes`; returns how many.
    fn read(&mut self, bytes: &mut [u8]) -> usize;
    /// The number of bytes that [`Self::write`] should accept now.
    fn room(&mut self) -> usize;
    /// Whether all bytes that it accepted have left: then a report may be put together.
    fn is_empty(&mut self) -> bool;
    /// Accepts bytes, which are no more than [`Self::room`], and returns how many: fewer if there was less room after all,
    /// 0 if the other end has gone.
    fn write(&mut self, bytes: &[u8]) -> usize;
}

/// The board, as the reporter needs it.
pub trait Host {
    /// Passes the store and the health of the devices to a task; locks them if others use them.
    fn with(&mut self, task: &mut dyn FnMut(&mut Store, &mut Health));
    /// The host has set an actuator: stores the value and sets the output.
    fn apply(&mut self, index: usize, value: &[u8]);
    /// The host has been silent for too long: applies the failsafe values.
    fn failsafe(&mut self) {}
    /// Completes the health of the board: reset cause, load and stack.
    fn describe(&mut self, board: &mut BoardHealth) {
        let _ = board;
    }
    /// Sees each byte between two frames before the reporter does; returns true if it was meant for
    /// something else.
    fn intercept(&mut self, byte: u8) -> bool {
        let _ = byte;
        false
    }
}

/// The configuration of a link, printed by a generator.
#[derive(Clone, Copy, Debug)]
pub struct ReporterConfig {
    /// The schema of the link.
    pub schema: &'static Schema,
    /// The time between calls of [`Reporter::cycle`].
    pub cycle_ms: u32,
    /// The time without a frame from the host after which actuators take their failsafe values, 10
    /// to 3600000; 0: never.
    pub silence_ms: u32,
}

/// Event counts since the start; each wraps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReporterCounts {
    /// The reports sent.
    pub reports_sent: u32,
    /// Cycles in which something was due while the line was still busy with a frame.
    pub reports_refused: u32,
    /// Frames that were cut off because the other end went away.
    pub frames_torn: u32,
    /// Values that were dropped because they were too old when the channel had room.
    pub values_dropped: u32,
}

/// The reporter of a board, with its buffers in `[u8; SCHEMA.reporter_bytes()]`.
#[derive(Debug)]
pub struct Reporter<B: ?Sized = [u8]> {
    config: ReporterConfig,
    /// The sizes of the longest payload and frame to the host.
    payload_bytes: usize,
    frame_bytes: usize,
    listener: Listener,
    silence: Silence,
    counts: ReporterCounts,
    now_us: u64,
    now_ms: u32,
    /// The size of the frame that is being sent; 0 for none.
    frame_size: usize,
    frame_sent: usize,
    /// The values in the report that is being sent.
    taken: Bits,
    is_report: bool,
    counter: u8,
    is_open: bool,
    hello_due: bool,
    health_due: bool,
    /// True if the last frame was an answer: a report's turn is next.
    has_answered: bool,
    /// A frame to the host, then the buffer of the decoder.
    memory: B,
}

impl<const BYTES: usize> Reporter<[u8; BYTES]> {
    /// The state at the start, with the clock at 0. `BYTES` is [`Schema::reporter_bytes`]; with
    /// less, nothing is sent.
    #[must_use]
    pub const fn new(config: ReporterConfig) -> Self {
        let is_enough = BYTES >= config.schema.reporter_bytes();
        Self {
            listener: Listener::new(config.schema, is_enough),
            silence: Silence::new(config.silence_ms, 0),
            counts: ReporterCounts {
                reports_sent: 0,
                reports_refused: 0,
                frames_torn: 0,
                values_dropped: 0,
            },
            now_us: 0,
            now_ms: 0,
            frame_size: 0,
            frame_sent: 0,
            taken: Bits::NONE,
            is_report: false,
            counter: 0,
            is_open: false,
            hello_due: false,
            health_due: false,
            has_answered: false,
            payload_bytes: config.schema.payload_bytes_max(Direction::ToHost),
            frame_bytes: config.schema.frame_bytes(Direction::ToHost),
            config,
            memory: [0; BYTES],
        }
    }
}

impl<const BYTES: usize> Deref for Reporter<[u8; BYTES]> {
    type Target = Reporter;

    fn deref(&self) -> &Reporter {
        self
    }
}

impl<const BYTES: usize> DerefMut for Reporter<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut Reporter {
        self
    }
}

impl Reporter {
    /// Restarts the host's time limit now, for a start with the clock not at 0.
    pub fn begin_at(&mut self, now_us: u64) {
        self.set_now(now_us);
        self.silence = Silence::new(self.config.silence_ms, self.now_ms);
    }

    /// The event counts since the start.
    #[must_use]
    pub fn counts(&self) -> &ReporterCounts {
        &self.counts
    }

    /// Runs one cycle.
    pub fn cycle(&mut self, now_us: u64, channel: &mut dyn Channel, host: &mut dyn Host) {
        let is_open = channel.is_open();
        self.begin_cycle(now_us, is_open, host);
        if is_open {
            self.receive(channel, host);
        }
        self.fall_back(host);
        if is_open {
            self.transmit(channel, host);
        }
    }

    /// Replaces a cycle while something else uses the channel: when it is free again, frames begin
    /// with a hello.
    pub fn pause(&mut self, now_us: u64, host: &mut dyn Host) {
        self.begin_cycle(now_us, false, host);
        self.fall_back(host);
    }

    fn set_now(&mut self, now_us: u64) {
        self.now_us = now_us;
        self.now_ms = milliseconds(now_us);
    }

    // ---- from the host ----

    fn receive(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) {
        let frames = self.listener.frames();
        let mut bytes = [0; READ_BYTES];
        for _ in 0..READS_MAX {
            let size = channel.read(&mut bytes).min(READ_BYTES);
            if size > 0 {
                self.take_bytes(part(&bytes, 0, size), host);
            }
            if size < READ_BYTES {
                break;
            }
        }
        if self.listener.frames() != frames {
            self.silence.received(self.now_ms);
        }
    }

    fn take_bytes(&mut self, bytes: &[u8], host: &mut dyn Host) {
        let (_, buffer) = split(&mut self.memory, self.frame_bytes);
        let count = self.config.schema.items.len();
        for byte in bytes {
            if self.listener.is_idle() && host.intercept(*byte) {
                continue;
            }
            let (hello_due, health_due) = (&mut self.hello_due, &mut self.health_due);
            self.listener.feed(buffer, core::slice::from_ref(byte), &mut |frame| match frame {
                // In the order of the schema, regardless of the order in the frame.
                Frame::Values(_, items) if uses::ACTUATORS => {
                    for index in 0..count {
                        let own = |(of, _): &(usize, &[u8])| *of == index;
                        if let Some((_, value)) = items.into_iter().find(own) {
                            host.apply(index, value);
                        }
                    }
                }
                Frame::HelloRequest => *hello_due = true,
                Frame::HealthRequest => *health_due = true,
                Frame::Values(..) | Frame::Hello(_) | Frame::Health(_) => {}
            });
        }
    }

    // ---- to the host ----

    /// Gives up the frame that is being sent; the values of a report become due again.
    fn give_up(&mut self, host: &mut dyn Host) {
        if self.frame_size == 0 {
            return;
        }
        self.counts.frames_torn = self.counts.frames_torn.wrapping_add(1);
        self.frame_size = 0;
        if self.is_report {
            host.with(&mut |store, _| store.restore(&self.taken));
        }
    }

    /// Sends as much as there is room for; true if nothing is left to send.
    fn push(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) -> bool {
        if self.frame_size == 0 {
            return true;
        }
        let left = self.frame_size.saturating_sub(self.frame_sent);
        let mut size = channel.room().min(left);
        if size > 0 {
            size = channel.write(part(&self.memory, self.frame_sent, size));
            if size == 0 {
                self.give_up(host);
                return false;
            }
        }
        self.frame_sent += size;
        if size < left {
            return false;
        }
        self.frame_size = 0;
        let sent = u32::from(self.is_report);
        self.counts.reports_sent = self.counts.reports_sent.wrapping_add(sent);
        true
    }

    fn send(
        &mut self,
        size: usize,
        is_report: bool,
        channel: &mut dyn Channel,
        host: &mut dyn Host,
    ) {
        self.frame_size = size;
        self.frame_sent = 0;
        self.is_report = is_report;
        self.push(channel, host);
    }

    fn send_health(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) {
        let now_ms = self.now_ms;
        let mut board = BoardHealth {
            uptime_ms: now_ms,
            reports_sent: self.counts.reports_sent,
            reports_refused: self.counts.reports_refused,
            ..BoardHealth::NEW
        };
        host.describe(&mut board);
        let schema = self.config.schema;
        let frame = part_mut(&mut self.memory, 0, self.frame_bytes);
        let mut row_of = |index| {
            let mut row = HealthRow::UNKNOWN;
            host.with(&mut |_, health| row = health.row(index, now_ms));
            row
        };
        let size = encode_health(schema, &board, &mut row_of, frame);
        self.send(size, false, channel, host);
    }

    /// Answers the host's requests; true if an answer is on its way.
    fn answer(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) -> bool {
        if core::mem::take(&mut self.hello_due) {
            let schema = self.config.schema;
            let frame = part_mut(&mut self.memory, 0, self.frame_bytes);
            let size = encode_hello(schema, frame);
            self.send(size, false, channel, host);
        } else if core::mem::take(&mut self.health_due) {
            self.send_health(channel, host);
        } else {
            return false;
        }
        true
    }

    fn send_report(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) {
        let stamp = Stamp { time_us: self.now_us as u32, counter: self.counter };
        let (now_ms, cycle_ms) = (self.now_ms, self.config.cycle_ms);
        let frame = part_mut(&mut self.memory, 0, self.frame_bytes);
        let (schema, longest_bytes) = (self.config.schema, self.payload_bytes);
        let taken = &mut self.taken;
        let (mut dropped, mut at) = (0, 0_usize);
        host.with(&mut |store, _| *taken = *store.due());
        // The host locks for one item at a time: if that masks interrupts, ports can take
        // characters in between.
        let mut put = |index: usize, out: &mut Writer<'_>| {
            let Some(item) = schema.items.get(index) else { return };
            let from = at;
            at = from.wrapping_add(item.bytes());
            if !taken.has(index) {
                return;
            }
            host.with(&mut |store, health| {
                if is_old(health, index, now_ms, cycle_ms) {
                    store.forget(index);
                    taken.clear(index);
                    dropped += 1;
                } else {
                    store.hand_out((index, item, from..at), out);
                }
            });
        };
        let size = encode_each((schema, longest_bytes), Direction::ToHost, stamp, &mut put, frame);
        self.counts.values_dropped = self.counts.values_dropped.wrapping_add(dropped);
        if size > 0 {
            self.counter = self.counter.wrapping_add(1);
            self.send(size, true, channel, host);
        }
    }

    /// Sends one frame at a time, so that none waits for another; answers and reports take turns.
    fn transmit(&mut self, channel: &mut dyn Channel, host: &mut dyn Host) {
        let is_free = self.push(channel, host) && channel.is_empty();
        if is_free {
            self.has_answered = !self.has_answered && self.answer(channel, host);
        }
        let mut is_due = false;
        host.with(&mut |store, _| is_due = store.is_due());
        if !is_due {
            return;
        }
        if is_free && !self.has_answered {
            self.send_report(channel, host);
        } else {
            self.counts.reports_refused = self.counts.reports_refused.wrapping_add(1);
        }
    }

    // ---- the cycle ----

    /// Updates the state at the start of a cycle; `is_open`: frames may use the channel.
    fn begin_cycle(&mut self, now_us: u64, is_open: bool, host: &mut dyn Host) {
        let before_ms = self.now_ms;
        self.set_now(now_us);
        let now_ms = self.now_ms;
        if (before_ms ^ now_ms) >= TICK_MS {
            host.with(&mut |_, health| health.tick(now_ms));
        }
        if !is_open {
            self.give_up(host);
        }
        self.hello_due = self.hello_due || (is_open && !self.is_open);
        self.is_open = is_open;
    }

    fn fall_back(&mut self, host: &mut dyn Host) {
        if self.silence.step(self.now_ms) {
            host.failsafe();
        }
    }
}

/// Whether a value has waited too long for room in the channel without a newer reading.
fn is_old(health: &Health, index: usize, now_ms: u32, own_ms: u32) -> bool {
    let device_ms = health.cycle_ms(index);
    let cycle_ms = device_ms.max(own_ms);
    let age_ms = health.age_ms(index, now_ms);
    let is_late =
        age_ms / FRESH_CYCLES >= cycle_ms && age_ms > cycle_ms.saturating_mul(FRESH_CYCLES);
    device_ms != 0 && age_ms != AGE_NEVER && is_late
}
