//! The devices in the address space, the clocks that they need, and what they ask the DMA for. The MCU determines their
//! addresses (`mcu.rs`).

/// A peripheral; units count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Device {
    Gpio(usize),
    Timer(usize),
    Usart(usize),
    Spi(usize),
    I2c(usize),
    Can(usize),
    Fdcan(usize),
    /// The messages and filters of such a unit.
    FdcanMemory(usize),
    Adc(usize),
    /// The registers that converters share, by the first of these.
    AdcCommon(usize),
    Dac(usize),
    Dma(usize),
    /// The selection of the request that each stream serves.
    Multiplexer,
    Exti,
    /// The ports of the lines of EXTI; AFIO also has the places of peripherals' signals.
    Syscfg,
    Afio,
    Rcc,
    /// What keeps an oscillator at its frequency, by the frames of USB.
    Recovery,
    Iwdg,
    Usb,
    /// The memory for packets, where it is apart from the registers.
    UsbMemory,
    Pwr,
    Flash,
    Rtc,
    /// Registers that keep their contents as long as there is power.
    Backup,
    Crc,
    Random,
    Debug,
    /// A peripheral that is known to exist but not modelled.
    Other,
}

/// The place of a peripheral.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) base: u32,
    pub(super) bytes: u32,
    pub(super) device: Device,
    /// The offset of an enable register of the RCC, and the bit; `None` for a peripheral that
    /// always runs.
    pub(super) clock: Option<(u32, u32)>,
}

/// The address of the debugger's registers, which are apart from the others.
pub(super) const DEBUG_BASE: u32 = 0xE004_2000;

/// The requests to the DMA controllers, by peripheral.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Request {
    Adc(usize),
    I2cRx(usize),
    I2cTx(usize),
    SpiRx(usize),
    SpiTx(usize),
    UsartRx(usize),
    UsartTx(usize),
    Dac(usize),
    /// Timer and channel; channel 0 is its update.
    Timer(usize, usize),
}
