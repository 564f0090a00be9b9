//! CAN controllers with banks of filters (bxCAN), which the second of two shares with the first.

use core::num::NonZeroU16;

use embassy_stm32::can::enums::{BusError, TryReadError};
use embassy_stm32::can::util::NominalBitTiming;
use embassy_stm32::can::{BufferedCanRx, Can, CanTx, Frame, RxBuf};
use embassy_stm32::pac;
use embedded_can::Id;
use static_cell::StaticCell;

use super::{Bit, WAITING, count};

/// What the driver of a bus keeps for good; it is a `static`.
pub struct Memory {
    can: StaticCell<Can<'static>>,
    waiting: StaticCell<RxBuf<WAITING>>,
}

impl Memory {
    /// Not in use yet.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        Self { can: StaticCell::new(), waiting: StaticCell::new() }
    }
}

/// Where a controller's filters are: the registers with the banks, and the first of its own.
pub struct Banks {
    /// The controller that has the banks.
    pub registers: pac::can::Can,
    /// Its first bank that belongs to the bus.
    pub first: usize,
}

/// Banks that a controller has.
const BANKS: usize = 14;

/// The frames that a bus has let through.
pub struct Receiver(BufferedCanRx<'static, WAITING>);

/// The half that sends.
pub struct Sender(CanTx<'static>);

/// Starts a bus, which comes back from bus-off by itself and lets only the frames wanted through; none: all.
pub fn start(
    can: Can<'static>,
    registers: pac::can::Can,
    banks: &Banks,
    memory: &'static Memory,
    bit: Bit,
    wanted: &[Id],
) -> (Sender, Receiver) {
    let can = memory.can.init(can);
    can.set_tx_fifo_scheduling(true);
    drop(can.modify_config().set_bit_timing(NominalBitTiming {
        prescaler: NonZeroU16::new(bit.divider).unwrap_or(NonZeroU16::MIN),
        seg1: count(bit.before),
        seg2: count(bit.after),
        sync_jump_width: count(bit.jump),
    }));
    registers.mcr().modify(|control| {
        control.set_abom(true);
        control.set_sleep(false);
    });
    banks.filter(wanted);
    let (tx, rx) = can.split();
    (Sender(tx), Receiver(rx.buffered(memory.waiting.init(RxBuf::new()))))
}

impl Banks {
    /// Lets the frames wanted through, two in a bank; none: all.
    fn filter(&self, wanted: &[Id]) {
        self.registers.fmr().modify(|control| control.set_finit(true));
        self.registers
            .fa1r()
            .modify(|active| (0..BANKS).for_each(|bank| active.set_fact(self.first + bank, false)));
        for (bank, pair) in (self.first..).zip(wanted.chunks(2).take(BANKS)) {
            if let [one, .., two] | [one @ two] = pair {
                self.bank(bank, true, [*one, *two].map(word));
            }
        }
        if wanted.is_empty() {
            // No bit of a frame counts.
            self.bank(self.first, false, [0, 0]);
        }
        self.registers.fmr().modify(|control| control.set_finit(false));
    }

    /// A bank with a list of two words, or with a word and the bits of it that count.
    fn bank(&self, bank: usize, is_list: bool, [one, two]: [u32; 2]) {
        let registers = &self.registers;
        registers.fm1r().modify(|mode| mode.set_fbm(bank, is_list));
        registers.fs1r().modify(|width| width.set_fsc(bank, true));
        registers.fb(bank).fr1().write(|word| word.0 = one);
        registers.fb(bank).fr2().write(|word| word.0 = two);
        registers.ffa1r().modify(|queue| queue.set_ffa(bank, false));
        registers.fa1r().modify(|active| active.set_fact(bank, true));
    }
}

/// A frame of data as a bank has it.
fn word(id: Id) -> u32 {
    match id {
        Id::Standard(id) => u32::from(id.as_raw()) << 21,
        Id::Extended(id) => id.as_raw() << 3 | 4,
    }
}

impl Receiver {
    /// Waits for the next frame; `None` is one that went wrong.
    pub async fn next(&mut self) -> Option<Frame> {
        self.0.read().await.ok().map(|envelope| envelope.frame)
    }

    /// A frame that is there already; none if there is none.
    ///
    /// # Errors
    ///
    /// What is the matter with the bus.
    pub fn left(&mut self) -> Result<Option<Frame>, BusError> {
        match self.0.try_read() {
            Ok(envelope) => Ok(Some(envelope.frame)),
            Err(TryReadError::Empty) => Ok(None),
            Err(TryReadError::BusError(error)) => Err(error),
        }
    }
}

impl Sender {
    /// Sends a frame; false if there is no room for it.
    pub fn send(&mut self, frame: &Frame) -> bool {
        self.0.try_write(frame).is_ok()
    }
}
