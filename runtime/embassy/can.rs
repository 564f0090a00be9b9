//! CAN buses: values of frames that come, and frames with values of the host's.

use core::cell::RefCell;

use embassy_stm32::can::enums::{BusError, TryReadError};
use embassy_stm32::can::filter::{ListEntry32, Mask32};
use embassy_stm32::can::{BufferedCanRx, Can, CanTx, ExtendedId, Fifo, Frame, Id, RxBuf, StandardId};
use embassy_stm32::pac;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::{Instant, with_deadline};
use sense_rt::{Coding, MessageField, Outcome, Schema, Sink};

use super::now_ms;
use super::shared::Tell;

/// Frames that wait for the task of their bus.
pub const WAITING: usize = 16;
/// Bytes of a frame.
const BYTES: usize = 8;

/// The frames that a bus has let through.
pub type Come = BufferedCanRx<'static, WAITING>;
pub type Waiting = RxBuf<WAITING>;

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

/// Starts a bus, which comes back from bus-off by itself and lets only the frames wanted through; none: all.
pub fn start(
    can: &'static mut Can<'static>,
    registers: pac::can::Can,
    waiting: &'static mut Waiting,
    bitrate_hz: u32,
    wanted: &[Id],
) -> (CanTx<'static>, Come) {
    can.set_tx_fifo_scheduling(true);
    drop(can.modify_config().set_bitrate(bitrate_hz));
    registers.mcr().modify(|control| {
        control.set_abom(true);
        control.set_sleep(false);
    });
    let mut filters = can.modify_filters();
    filters.clear();
    for (bank, pair) in wanted.chunks(2).enumerate() {
        if let [first, .., last] | [first @ last] = pair {
            let both = [*first, *last].map(ListEntry32::data_frames_with_id);
            filters.enable_bank(bank as u8, Fifo::Fifo0, both);
        }
    }
    if wanted.is_empty() {
        filters.enable_bank(0, Fifo::Fifo0, Mask32::accept_all());
    }
    drop(filters);
    let (tx, rx) = can.split();
    (tx, rx.buffered(waiting))
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
        while let Ok(come) = with_deadline(until, self.come.read()).await {
            if let Ok(envelope) = come {
                self.take(&envelope.frame, sink);
            }
        }
        match self.come.try_read() {
            Ok(envelope) => self.take(&envelope.frame, sink),
            Err(TryReadError::BusError(error)) => self.say(outcome(&error), sink),
            Err(TryReadError::Empty) => {}
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
pub fn send<const COUNT: usize>(bus: &mut CanTx<'static>, frames: &Frames<COUNT>) {
    frames.lock(|frames| {
        for frame in frames.borrow_mut().iter_mut().filter(|frame| frame.is_due) {
            let data = frame.data.get(..frame.bytes).unwrap_or_default();
            match Frame::new_data(frame.id, data) {
                Ok(made) if bus.try_write(&made).is_err() => return,
                _ => frame.is_due = false,
            }
        }
    });
}
