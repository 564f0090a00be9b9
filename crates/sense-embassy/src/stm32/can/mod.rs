//! CAN buses: values of frames that come, and frames with values of the host's.

use core::cell::RefCell;
use core::num::NonZeroU8;

use embassy_stm32::can::Frame;
use embassy_stm32::can::enums::BusError;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::{Instant, with_deadline};
use embedded_can::{ExtendedId, Id, StandardId};
use sense_rt::{Coding, MessageField, Outcome, Schema, Sink};

pub use sense_rt::Turn;

use crate::devices::Report;
use crate::now_ms;

#[cfg(feature = "can-banks")]
mod banks;
#[cfg(feature = "can-fd")]
mod fd;
#[cfg(feature = "can-banks")]
pub use banks::{Banks, Memory, Receiver, Sender, start};
#[cfg(feature = "can-fd")]
pub use fd::{Memory, Receiver, Sender, start};

/// Frames that wait for the task of their bus.
const WAITING: usize = 16;
/// Bytes of a frame.
const BYTES: usize = 8;

/// An identifier of eleven bits.
pub const fn standard(id: u16) -> Id {
    Id::Standard(match StandardId::new(id) {
        Some(id) => id,
        None => StandardId::MAX,
    })
}

/// An identifier of 29 bits.
pub const fn extended(id: u32) -> Id {
    Id::Extended(match ExtendedId::new(id) {
        Some(id) => id,
        None => ExtendedId::MAX,
    })
}

/// What a bit consists of.
#[derive(Clone, Copy)]
pub struct Bit {
    /// Clocks of the unit in a step, at least 1.
    pub divider: u16,
    /// Steps before the sample, without the first; at least 1.
    pub before: u8,
    /// Steps after the sample, at least 1.
    pub after: u8,
    /// Steps by which a bit may be longer or shorter to follow its sender, at least 1.
    pub jump: u8,
}

/// A count that is not 0; one that were would count as 1.
fn count(count: u8) -> NonZeroU8 {
    NonZeroU8::new(count).unwrap_or(NonZeroU8::MIN)
}

/// A value that a frame has: where it is, the identifier of the frame, the shortest time between two reports, and the
/// bits by which the frame has it: those that count, and what they are. Byte 0 of a frame has the lowest bits.
pub type Value = (MessageField, Id, u32, (u64, u64));

/// What the task of a bus keeps.
pub struct Bus<'a> {
    /// The half of the controller that receives.
    pub receiver: Receiver,
    /// The schema of the board.
    pub schema: &'static Schema,
    /// The values in the frames.
    pub values: &'static [Value],
    /// Items that are sent.
    pub sent: &'static [usize],
    /// Which frame of each value is next.
    pub turns: &'a mut [Turn],
    /// Room for any value.
    pub value: &'a mut [u8],
}

impl Bus<'_> {
    /// Takes the frames that come until then, and what went wrong meanwhile.
    pub async fn receive(&mut self, until: Instant, sink: &mut Sink<'_>) {
        while let Ok(come) = with_deadline(until, self.receiver.next()).await {
            if let Some(frame) = come {
                self.take(&frame, sink);
            }
        }
        match self.receiver.left() {
            Ok(Some(frame)) => self.take(&frame, sink),
            Ok(None) => {}
            Err(error) => self.report(outcome(&error), sink),
        }
    }

    fn take(&mut self, frame: &Frame, sink: &mut Sink<'_>) {
        let now_ms = now_ms();
        let bits = bits(frame.data());
        for ((field, id, cycle_ms, (mask, select)), turn) in
            self.values.iter().zip(self.turns.iter_mut())
        {
            let index = usize::from(field.item);
            let Some(item) =
                self.schema.items.get(index).filter(|_| id == frame.id() && bits & mask == *select)
            else {
                continue;
            };
            let value = self.value.get_mut(..item.bytes()).unwrap_or_default();
            let outcome = field.read(item, frame.data(), value).unwrap_or(Outcome::Invalid);
            if outcome != Outcome::Fresh {
                sink(index, outcome, &mut []);
            } else if turn.is_next(*cycle_ms, now_ms) {
                sink(index, outcome, value);
            }
        }
    }

    /// What is the matter with the bus is the matter with all that it carries.
    fn report(&self, outcome: Outcome, sink: &mut Sink<'_>) {
        for (field, ..) in self.values {
            sink(field.item.into(), outcome, &mut []);
        }
        for index in self.sent {
            sink(*index, outcome, &mut []);
        }
    }
}

/// The bytes of a frame as a number, the first the lowest.
fn bits(data: &[u8]) -> u64 {
    data.iter().take(BYTES).rev().fold(0, |bits, byte| bits << 8 | u64::from(*byte))
}

fn outcome(error: &BusError) -> Outcome {
    match error {
        BusError::Acknowledge => Outcome::NotAcknowledged,
        BusError::Crc => Outcome::WrongCrc,
        BusError::Stuff
        | BusError::Form
        | BusError::BitRecessive
        | BusError::BitDominant
        | BusError::Software => Outcome::BusError,
    }
}

/// A frame that is sent when the host has set a value of it.
#[derive(Clone, Copy)]
pub struct Sent {
    id: Id,
    bytes: usize,
    data: [u8; BYTES],
    is_due: bool,
    /// It is sent again so long after it was commanded; 0: never.
    every_ms: u32,
    /// By the host or as failsafe, and the host has not fallen silent since.
    is_commanded: bool,
    sent_ms: u32,
}

impl Sent {
    /// A frame of zeros that is sent when a value of it is set.
    #[must_use]
    pub const fn new(id: Id, bytes: usize) -> Self {
        Self {
            id,
            bytes,
            data: [0; BYTES],
            is_due: false,
            every_ms: 0,
            is_commanded: false,
            sent_ms: 0,
        }
    }

    /// Sent again so often once it was commanded.
    pub const fn repeated(self, every_ms: u32) -> Self {
        Self { every_ms, ..self }
    }

    /// With the bits that say what else is in it.
    pub const fn selected(self, data: [u8; BYTES]) -> Self {
        Self { data, ..self }
    }

    fn is_wanted(&self, now_ms: u32) -> bool {
        let is_repeated = self.every_ms > 0 && self.is_commanded;
        self.is_due || is_repeated && now_ms.wrapping_sub(self.sent_ms) >= self.every_ms
    }

    /// The next one is due a period after this one was, however late this one is.
    fn sent(&mut self, now_ms: u32) {
        let late_ms = now_ms.wrapping_sub(self.sent_ms).wrapping_sub(self.every_ms);
        let is_in_turn = !self.is_due && late_ms < self.every_ms;
        self.sent_ms = if is_in_turn { now_ms.wrapping_sub(late_ms) } else { now_ms };
        self.is_due = false;
    }
}

/// Where a value is in its frame.
#[derive(Clone, Copy)]
pub struct Place {
    byte: usize,
    /// Its bits of the frame; 0: all of its bytes.
    mask: u64,
    is_quiet: bool,
}

impl Place {
    /// From that byte of the frame on.
    #[must_use]
    pub const fn new(byte: usize) -> Self {
        Self { byte, mask: 0, is_quiet: false }
    }

    /// Only with these bits of the frame, of which byte 0 has the lowest.
    pub const fn masked(self, mask: u64) -> Self {
        Self { mask, ..self }
    }

    /// Setting it does not make the frame due, because another one with it is sent.
    pub const fn quiet(self) -> Self {
        Self { is_quiet: true, ..self }
    }
}

/// The frames of a bus; they are a `static`.
pub type Frames<const COUNT: usize> = Mutex<CriticalSectionRawMutex, RefCell<[Sent; COUNT]>>;

/// The frames that a bus sends, none of which is due.
#[must_use]
pub const fn frames<const COUNT: usize>(all: [Sent; COUNT]) -> Frames<COUNT> {
    Mutex::new(RefCell::new(all))
}

/// Puts a value of the host's into its frame, from that byte on. Where it does not fit the frame is not sent, and the
/// device's health tells.
#[expect(clippy::too_many_arguments, reason = "a generator prints the calls")]
pub fn set<const COUNT: usize>(
    frames: &Frames<COUNT>,
    frame: usize,
    how: &Coding,
    schema: &Schema,
    index: usize,
    value: &[u8],
    place: Place,
    board: &dyn Report,
) {
    let size = frames.lock(|frames| {
        let mut frames = frames.borrow_mut();
        let (Some(frame), Some(item)) = (frames.get_mut(frame), schema.items.get(index)) else {
            return 0;
        };
        let mut coded = [0; BYTES];
        let (byte, end) = (place.byte, frame.bytes.min(BYTES));
        let size = how.encode(item, value, coded.get_mut(byte..end).unwrap_or_default());
        let mask = if place.mask == 0 { u64::MAX } else { place.mask }.to_le_bytes();
        let bytes = frame.data.iter_mut().zip(coded).zip(mask);
        for ((data, coded), mask) in bytes.skip(byte).take(size) {
            *data = *data & !mask | coded & mask;
        }
        let is_commanded = size > 0 && !place.is_quiet;
        frame.is_due |= is_commanded;
        frame.is_commanded |= is_commanded;
        size
    });
    if size == 0 {
        board.report(None, index, Outcome::BusError, &mut []);
    }
}

/// The host is silent: nothing is repeated until it is set again, by a failsafe or by the host.
pub fn stop_repeats<const COUNT: usize>(frames: &Frames<COUNT>) {
    frames.lock(|frames| {
        for frame in frames.borrow_mut().iter_mut().filter(|frame| frame.every_ms > 0) {
            frame.is_commanded = false;
            frame.is_due = false;
        }
    });
}

/// Sends what is due or to be repeated, as far as there is room.
pub fn send<const COUNT: usize>(bus: &mut Sender, frames: &Frames<COUNT>) {
    let now_ms = now_ms();
    frames.lock(|frames| {
        for frame in frames.borrow_mut().iter_mut().filter(|frame| frame.is_wanted(now_ms)) {
            let data = frame.data.get(..frame.bytes).unwrap_or_default();
            match Frame::new_data(frame.id, data) {
                Ok(made) if !bus.send(&made) => return,
                _ => frame.sent(now_ms),
            }
        }
    });
}
