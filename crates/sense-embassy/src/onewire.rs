//! Parts on one wire that both ends pull low: slots of 1-Wire, and the bursts of a DHT22.
//!
//! Interrupts are off only while a slot must be short: a one that is written, and a bit that is read, about 12 us. A
//! zero that something made longer than it may be is noticed, and the transfer begins again. Between slots the other
//! tasks go on. During a burst, which lasts 5 ms, they wait: nothing else sees its edges in time.

use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, Instant, Timer, block_for};
use sense_rt::onewire::{BURST_BYTES, BURST_FALLS, MATCH_ROM, READ_ROM, SKIP_ROM, burst, check};
use sense_rt::{Outcome, Step};

use crate::bus::Line;

/// A pin with a pull-up resistor, which is pulled low or released.
pub trait Wire {
    /// Pulls it low.
    fn pull(&mut self);
    /// Lets the resistor pull it high.
    fn release(&mut self);
    /// Whether nobody pulls it low.
    fn is_high(&mut self) -> bool;
}

/// A wire that several tasks share.
pub type OneWireBus<W> = Mutex<CriticalSectionRawMutex, W>;

/// How a part is addressed.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// By 1-Wire.
    W1 {
        /// Its address; `None` if it is alone on its wire.
        rom: Option<[u8; 8]>,
        /// The first byte of what starts a measurement, after which it says that it is busy.
        trigger: Option<u8>,
    },
    /// By a low pulse, which it answers with a burst.
    Burst {
        /// The length of the pulse.
        pulse_us: u32,
    },
}

/// A part on its wire.
pub struct OneWireLine<W: 'static> {
    /// Its wire.
    pub wire: &'static OneWireBus<W>,
    /// How it is addressed.
    pub part: Part,
}

/// Times of 1-Wire. A wait may be shorter by one microsecond, as the clock has no finer steps.
const RESET: Duration = Duration::from_micros(500);
const PRESENCE: Duration = Duration::from_micros(300);
const AFTER: Duration = Duration::from_micros(500);
const SHORT: Duration = Duration::from_micros(2);
const SAMPLE: Duration = Duration::from_micros(8);
const LONG: Duration = Duration::from_micros(63);
const LONG_MOST: Duration = Duration::from_micros(110);
const REST: Duration = Duration::from_micros(62);
const RECOVERY: Duration = Duration::from_micros(5);

/// A burst lasts 5 ms at most, and begins within 50 us.
const BURST: Duration = Duration::from_micros(6_500);

/// How often a transfer is begun that something has disturbed.
const ATTEMPTS: usize = 3;

impl<W: Wire> Line for OneWireLine<W> {
    async fn transfer(&mut self, _: u8, step: Step<'_>, _: Duration) -> Outcome {
        let mut wire = self.wire.lock().await;
        let (sent, received): (&[u8], &mut [u8]) = match step {
            Step::Write(bytes) => (bytes, &mut []),
            Step::WriteRead(sent, received) => (sent, received),
            Step::Exchange(..) | Step::Wait(_) => return Outcome::BusError,
        };
        let (rom, trigger) = match self.part {
            // It must be left alone after each reading, also after one that failed.
            Part::Burst { pulse_us } => return read_burst(&mut *wire, pulse_us, received).await,
            Part::W1 { rom, trigger } => (rom, trigger),
        };
        let is_trigger = trigger.is_some() && sent.first().copied() == trigger;
        let mut outcome = Outcome::BusError;
        for _ in 0..ATTEMPTS {
            outcome = attempt(&mut *wire, rom, (sent, is_trigger), received).await;
            if !matches!(outcome, Outcome::BusError | Outcome::NotAcknowledged) {
                break;
            }
        }
        outcome
    }
}

/// Sends bytes to a part, and receives bytes from it.
async fn attempt(
    wire: &mut impl Wire,
    rom: Option<[u8; 8]>,
    (sent, is_trigger): (&[u8], bool),
    received: &mut [u8],
) -> Outcome {
    let answer = reset(wire).await;
    if answer != Outcome::Fresh {
        return answer;
    }
    let is_right = match rom {
        // The one command that takes the place of the call.
        None if sent.first() == Some(&READ_ROM) => true,
        None => write(wire, &[SKIP_ROM]).await,
        Some(rom) => write(wire, &[MATCH_ROM]).await && write(wire, &rom).await,
    };
    if !(is_right && write(wire, sent).await) {
        return Outcome::BusError;
    }
    if received.is_empty() {
        // A part that measures says so: one that has not heard it would give its last value as a new one.
        let is_unheard = is_trigger && read_bit(wire);
        return if is_unheard { Outcome::BusError } else { Outcome::Fresh };
    }
    for byte in received.iter_mut() {
        *byte = 0;
        for bit in 0..8 {
            *byte |= u8::from(read_bit(wire)) << bit;
            yield_now().await;
        }
    }
    check(received)
}

/// Calls all parts to attention.
async fn reset(wire: &mut impl Wire) -> Outcome {
    if !wire.is_high() {
        return Outcome::TimedOut;
    }
    wire.pull();
    Timer::after(RESET).await;
    wire.release();
    let begin = Instant::now();
    let mut is_answered = false;
    while !is_answered && begin.elapsed() < PRESENCE {
        // Its slope takes a few microseconds where the cable is long.
        is_answered = begin.elapsed() > SAMPLE && !wire.is_high();
    }
    Timer::after(AFTER).await;
    if !wire.is_high() {
        return Outcome::TimedOut;
    }
    if is_answered { Outcome::Fresh } else { Outcome::NotAcknowledged }
}

/// Sends bytes; false if something may have made a reset of them.
async fn write(wire: &mut impl Wire, bytes: &[u8]) -> bool {
    for byte in bytes {
        for bit in 0..8 {
            if byte >> bit & 1 != 0 {
                write_one(wire);
            } else if !write_zero(wire) {
                return false;
            }
            yield_now().await;
        }
    }
    true
}

fn write_one(wire: &mut impl Wire) {
    undisturbed(|| {
        wire.pull();
        block_for(SHORT);
        wire.release();
    });
    block_for(REST);
}

fn write_zero(wire: &mut impl Wire) -> bool {
    let begin = Instant::now();
    wire.pull();
    block_for(LONG);
    wire.release();
    let is_right = begin.elapsed() < LONG_MOST;
    block_for(RECOVERY);
    is_right
}

fn read_bit(wire: &mut impl Wire) -> bool {
    let bit = undisturbed(|| {
        wire.pull();
        block_for(SHORT);
        wire.release();
        block_for(SAMPLE);
        wire.is_high()
    });
    block_for(REST);
    bit
}

/// Does something while interrupts are off.
fn undisturbed<T>(act: impl FnOnce() -> T) -> T {
    CriticalSectionMutex::new(()).lock(|()| act())
}

/// Asks for a burst, and takes its bytes.
async fn read_burst(wire: &mut impl Wire, pulse_us: u32, received: &mut [u8]) -> Outcome {
    if !wire.is_high() {
        return Outcome::TimedOut;
    }
    wire.pull();
    Timer::after_micros(pulse_us.into()).await;
    let mut falls = [0; BURST_FALLS];
    let mut count = 0;
    wire.release();
    let begin = Instant::now();
    let mut was_high = true;
    while count < BURST_FALLS && begin.elapsed() < BURST {
        let is_high = wire.is_high();
        if was_high && !is_high {
            if let Some(fall) = falls.get_mut(count) {
                *fall = u32::try_from(begin.elapsed().as_micros()).unwrap_or(u32::MAX);
            }
            count += 1;
        }
        was_high = is_high;
    }
    let mut bytes = [0; BURST_BYTES];
    let outcome = burst(falls.get(..count).unwrap_or_default(), &mut bytes);
    if outcome == Outcome::Fresh {
        received.iter_mut().zip(bytes).for_each(|(place, byte)| *place = byte);
    }
    outcome
}
