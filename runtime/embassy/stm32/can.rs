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

use super::controller::{Come, Talk};
use super::now_ms;
use super::shared::Tell;

/// Frames that wait for the task of their bus.
pub const WAITING: usize = 16;
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

/// What a bit is made of: clocks of the unit in a step, steps before the sample beside the first, steps behind it, and
/// steps that a bit may jump to follow its sender. None is 0.
#[derive(Clone, Copy)]
pub struct Bit {
    pub divider: u16,
    pub before: u8,
    pub behind: u8,
    pub jump: u8,
}

/// A count that is not 0; one that were would count as 1.
pub(super) fn count(count: u8) -> NonZeroU8 {
    NonZeroU8::new(count).unwrap_or(NonZeroU8::MIN)
}

/// A value that comes: where it is, the identifier of its frame, and how often it is told at most.
pub type Value = (MessageField, Id, u32);

/// What the task of a bus keeps.
pub struct Bus<'a> {
    pub come: Come,
    pub schema: &'static Schema,
    pub values: &'static [Value],
    /// Items that are sent.
    pub sent: &'static [usize],
    /// When each value was told.
    pub told_ms: &'a mut [Option<u32>],
    /// Room for any value.
    pub value: &'a mut [u8],
}

impl Bus<'_> {
    /// Takes the frames that come until then, and what went wrong meanwhile.
    pub async fn hear(&mut self, until: Instant, sink: &mut Sink<'_>) {
        while let Ok(come) = with_deadline(until, self.come.next()).await {
            if let Some(frame) = come {
                self.take(&frame, sink);
            }
        }
        match self.come.left() {
            Ok(Some(frame)) => self.take(&frame, sink),
            Ok(None) => {}
            Err(error) => self.say(outcome(&error), sink),
        }
    }

    fn take(&mut self, frame: &Frame, sink: &mut Sink<'_>) {
        let now_ms = now_ms();
        for ((field, id, cycle_ms), told_ms) in self.values.iter().zip(self.told_ms.iter_mut()) {
            let index = usize::from(field.item);
            let Some(item) = self.schema.items.get(index).filter(|_| id == frame.id()) else {
                continue;
            };
            let value = self.value.get_mut(..item.bytes()).unwrap_or_default();
            let outcome = field.read(item, frame.data(), value).unwrap_or(Outcome::Invalid);
            if outcome != Outcome::Fresh {
                sink(index, outcome, &mut []);
            } else if told_ms.is_none_or(|told| now_ms.wrapping_sub(told) >= *cycle_ms) {
                *told_ms = Some(now_ms);
                sink(index, outcome, value);
            }
        }
    }

    /// What is the matter with the bus is the matter with all that it carries.
    fn say(&self, outcome: Outcome, sink: &mut Sink<'_>) {
        for (field, ..) in self.values {
            sink(field.item.into(), outcome, &mut []);
        }
        for index in self.sent {
            sink(*index, outcome, &mut []);
        }
    }
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
}

impl Sent {
    pub const fn new(id: Id, bytes: usize) -> Self {
        Self { id, bytes, data: [0; BYTES], is_due: false }
    }
}

/// The frames of a bus; they are a `static`.
pub type Frames<const COUNT: usize> = Mutex<CriticalSectionRawMutex, RefCell<[Sent; COUNT]>>;

pub const fn frames<const COUNT: usize>(all: [Sent; COUNT]) -> Frames<COUNT> {
    Mutex::new(RefCell::new(all))
}

/// Puts a value of the host's into its frame, from that byte on. Where it does not fit the frame is not sent, and the
/// device's health tells.
pub fn set<const COUNT: usize>(
    frames: &Frames<COUNT>,
    frame: usize,
    how: &Coding,
    schema: &Schema,
    index: usize,
    value: &[u8],
    byte: usize,
    board: &dyn Tell,
) {
    let size = frames.lock(|frames| {
        let mut frames = frames.borrow_mut();
        let (Some(frame), Some(item)) = (frames.get_mut(frame), schema.items.get(index)) else { return 0 };
        let end = frame.bytes.min(BYTES);
        let size = how.encode(item, value, frame.data.get_mut(byte..end).unwrap_or_default());
        frame.is_due |= size > 0;
        size
    });
    if size == 0 {
        board.tell(None, index, Outcome::BusError, &mut []);
    }
}

/// Sends what is due, as far as there is room.
pub fn send<const COUNT: usize>(bus: &mut Talk, frames: &Frames<COUNT>) {
    frames.lock(|frames| {
        for frame in frames.borrow_mut().iter_mut().filter(|frame| frame.is_due) {
            let data = frame.data.get(..frame.bytes).unwrap_or_default();
            match Frame::new_data(frame.id, data) {
                Ok(made) if !bus.say(&made) => return,
                _ => frame.is_due = false,
            }
        }
    });
}
