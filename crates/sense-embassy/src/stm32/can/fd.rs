//! CAN controllers with a memory for messages (FDCAN), here with frames of up to eight bytes.

use core::num::NonZeroU16;

use embassy_stm32::can::config::{
    FrameTransmissionConfig, GlobalFilter, NominalBitTiming, TxBufferMode,
};
use embassy_stm32::can::enums::BusError;
use embassy_stm32::can::filter::{
    Action, EXTENDED_FILTER_MAX, ExtendedFilter, Filter, FilterType, STANDARD_FILTER_MAX,
    StandardFilter,
};
use embassy_stm32::can::{
    BufferedCanReceiver, BufferedCanSender, CanConfigurator, Frame, Properties, RxBuf, TxBuf,
};
use embassy_stm32::pac;
use embedded_can::Id;
use static_cell::StaticCell;

use super::{Bit, WAITING, count};

/// Frames that wait for the bus, beside those that the controller has.
const GOING: usize = 4;

/// What the driver of a bus keeps for good; it is a `static`.
pub struct Memory {
    waiting: StaticCell<RxBuf<WAITING>>,
    going: StaticCell<TxBuf<GOING>>,
}

impl Memory {
    /// Not in use yet.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        Self { waiting: StaticCell::new(), going: StaticCell::new() }
    }
}

/// The frames that a bus has let through.
pub struct Receiver {
    frames: BufferedCanReceiver,
    registers: pac::can::Fdcan,
    wrong: Option<BusError>,
}

/// The half that sends.
pub struct Sender(BufferedCanSender);

/// Starts a bus, which comes back from bus-off by itself and lets only the frames wanted through; none: all.
pub fn start(
    mut can: CanConfigurator<'static>,
    registers: pac::can::Fdcan,
    memory: &'static Memory,
    bit: Bit,
    wanted: &[Id],
) -> (Sender, Receiver) {
    let mut config = can.config();
    config.nbtr = NominalBitTiming {
        prescaler: NonZeroU16::new(bit.divider).unwrap_or(NonZeroU16::MIN),
        seg1: count(bit.before),
        seg2: count(bit.after),
        sync_jump_width: count(bit.jump),
    };
    config.frame_transmit = FrameTransmissionConfig::ClassicCanOnly;
    config.tx_buffer_mode = TxBufferMode::Fifo;
    config.automatic_bus_off_recovery = true;
    if !wanted.is_empty() {
        config.global_filter = GlobalFilter::reject_all();
        filter(can.properties(), wanted);
    }
    can.set_config(config);
    let can = can
        .into_normal_mode()
        .buffered(memory.going.init(TxBuf::new()), memory.waiting.init(RxBuf::new()));
    (Sender(can.writer()), Receiver { frames: can.reader(), registers, wrong: None })
}

/// Lets the frames wanted through, two in a filter.
fn filter(can: &Properties, wanted: &[Id]) {
    let mut standard = [StandardFilter::disable(); STANDARD_FILTER_MAX as usize];
    let mut extended = [ExtendedFilter::disable(); EXTENDED_FILTER_MAX as usize];
    let ids =
        || wanted.iter().filter_map(|id| if let Id::Standard(id) = id { Some(*id) } else { None });
    for (place, (one, two)) in standard.iter_mut().zip(pairs(ids())) {
        *place =
            Filter { filter: FilterType::DedicatedDual(one, two), action: Action::StoreInFifo0 };
    }
    let ids =
        || wanted.iter().filter_map(|id| if let Id::Extended(id) = id { Some(*id) } else { None });
    for (place, (one, two)) in extended.iter_mut().zip(pairs(ids())) {
        *place =
            Filter { filter: FilterType::DedicatedDual(one, two), action: Action::StoreInFifo0 };
    }
    can.set_standard_filters(&standard);
    can.set_extended_filters(&extended);
}

/// Two and two; the last is its own other where their number is odd.
fn pairs<T: Copy>(mut all: impl Iterator<Item = T>) -> impl Iterator<Item = (T, T)> {
    core::iter::from_fn(move || {
        let one = all.next()?;
        Some((one, all.next().unwrap_or(one)))
    })
}

impl Receiver {
    /// Waits for the next frame; `None` is one that went wrong.
    pub async fn next(&mut self) -> Option<Frame> {
        match self.frames.receive().await {
            Ok(envelope) => Some(envelope.frame),
            Err(error) => {
                self.wrong = Some(error);
                None
            }
        }
    }

    /// A frame that is there already; none if there is none.
    ///
    /// # Errors
    ///
    /// What is the matter with the bus.
    pub fn left(&mut self) -> Result<Option<Frame>, BusError> {
        if let Some(error) = self.wrong.take().or_else(|| self.last()) {
            return Err(error);
        }
        match self.frames.try_receive() {
            Ok(come) => come.map(|envelope| Some(envelope.frame)),
            Err(_) => Ok(None),
        }
    }

    /// What went wrong on the bus since the status was read. No interrupt tells of it: nobody may answer at all.
    fn last(&self) -> Option<BusError> {
        // The registers of the families spell the field's values differently.
        match self.registers.psr().read().0 & 7 {
            1 => Some(BusError::Stuff),
            2 => Some(BusError::Form),
            3 => Some(BusError::Acknowledge),
            4 => Some(BusError::BitRecessive),
            5 => Some(BusError::BitDominant),
            6 => Some(BusError::Crc),
            _ => None,
        }
    }
}

impl Sender {
    /// Sends a frame; false if there is no room for it.
    pub fn send(&mut self, frame: &Frame) -> bool {
        self.0.try_write(*frame).is_ok()
    }
}
