//! What is in the address space, and which clock it needs. Where it is says the MCU (`mcu.rs`).

/// A peripheral; units count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Device {
    Gpio(usize),
    Timer(usize),
    Usart(usize),
    Spi(usize),
    I2c(usize),
    Can(usize),
    Adc,
    Dac,
    Dma(usize),
    Exti,
    Syscfg,
    Rcc,
    Iwdg,
    Usb,
    Pwr,
    Flash,
    Rtc,
    Crc,
    Random,
    Debug,
    /// Known to exist, not modelled.
    Other,
}

/// A peripheral's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) base: u32,
    pub(super) bytes: u32,
    pub(super) device: Device,
    /// The offset of an enable register of the RCC, and the bit; none for what always runs.
    pub(super) clock: Option<(u32, u32)>,
}

/// Where the debugger's registers are, which lie apart from the others.
pub(super) const DEBUG_BASE: u32 = 0xE004_2000;
