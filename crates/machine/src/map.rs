//! Where in the address space each peripheral is, and which clock it needs.

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

/// Enable registers of the RCC.
const AHB1: u32 = 0x30;
const AHB2: u32 = 0x34;
const APB1: u32 = 0x40;
const APB2: u32 = 0x44;

/// Where a peripheral begins, how long it is, what it is, and the bit of its clock.
type Row = (u32, u32, Device, Option<(u32, u32)>);

const fn at(base: u32, device: Device, register: u32, bit: u32) -> Row {
    (base, 0x400, device, Some((register, bit)))
}

const fn always(base: u32, length: u32, device: Device) -> Row {
    (base, length, device, None)
}

/// By address.
const ROWS: &[Row] = &[
    at(0x4000_0000, Device::Timer(1), APB1, 0),
    at(0x4000_0400, Device::Timer(2), APB1, 1),
    at(0x4000_0800, Device::Timer(3), APB1, 2),
    at(0x4000_0C00, Device::Timer(4), APB1, 3),
    at(0x4000_1000, Device::Timer(5), APB1, 4),
    at(0x4000_1400, Device::Timer(6), APB1, 5),
    at(0x4000_1800, Device::Timer(11), APB1, 6),
    at(0x4000_1C00, Device::Timer(12), APB1, 7),
    at(0x4000_2000, Device::Timer(13), APB1, 8),
    always(0x4000_2800, 0x400, Device::Rtc),
    at(0x4000_2C00, Device::Other, APB1, 11),
    always(0x4000_3000, 0x400, Device::Iwdg),
    at(0x4000_3400, Device::Other, APB1, 14),
    at(0x4000_3800, Device::Spi(1), APB1, 14),
    at(0x4000_3C00, Device::Spi(2), APB1, 15),
    at(0x4000_4000, Device::Other, APB1, 15),
    at(0x4000_4400, Device::Usart(1), APB1, 17),
    at(0x4000_4800, Device::Usart(2), APB1, 18),
    at(0x4000_4C00, Device::Usart(3), APB1, 19),
    at(0x4000_5000, Device::Usart(4), APB1, 20),
    at(0x4000_5400, Device::I2c(0), APB1, 21),
    at(0x4000_5800, Device::I2c(1), APB1, 22),
    at(0x4000_5C00, Device::I2c(2), APB1, 23),
    at(0x4000_6400, Device::Can(0), APB1, 25),
    at(0x4000_6800, Device::Can(1), APB1, 26),
    at(0x4000_7000, Device::Pwr, APB1, 28),
    at(0x4000_7400, Device::Dac, APB1, 29),
    at(0x4001_0000, Device::Timer(0), APB2, 0),
    at(0x4001_0400, Device::Timer(7), APB2, 1),
    at(0x4001_1000, Device::Usart(0), APB2, 4),
    at(0x4001_1400, Device::Usart(5), APB2, 5),
    always(0x4001_2000, 0x400, Device::Adc),
    at(0x4001_2C00, Device::Other, APB2, 11),
    at(0x4001_3000, Device::Spi(0), APB2, 12),
    at(0x4001_3800, Device::Syscfg, APB2, 14),
    always(0x4001_3C00, 0x400, Device::Exti),
    at(0x4001_4000, Device::Timer(8), APB2, 16),
    at(0x4001_4400, Device::Timer(9), APB2, 17),
    at(0x4001_4800, Device::Timer(10), APB2, 18),
    at(0x4002_0000, Device::Gpio(0), AHB1, 0),
    at(0x4002_0400, Device::Gpio(1), AHB1, 1),
    at(0x4002_0800, Device::Gpio(2), AHB1, 2),
    at(0x4002_0C00, Device::Gpio(3), AHB1, 3),
    at(0x4002_1000, Device::Gpio(4), AHB1, 4),
    at(0x4002_1400, Device::Gpio(5), AHB1, 5),
    at(0x4002_1800, Device::Gpio(6), AHB1, 6),
    at(0x4002_1C00, Device::Gpio(7), AHB1, 7),
    at(0x4002_2000, Device::Gpio(8), AHB1, 8),
    at(0x4002_3000, Device::Crc, AHB1, 12),
    always(0x4002_3800, 0x400, Device::Rcc),
    always(0x4002_3C00, 0x400, Device::Flash),
    at(0x4002_6000, Device::Dma(0), AHB1, 21),
    at(0x4002_6400, Device::Dma(1), AHB1, 22),
    (0x4002_8000, 0x1400, Device::Other, Some((AHB1, 25))),
    (0x4004_0000, 0x4_0000, Device::Other, Some((AHB1, 29))),
    (0x5000_0000, 0x4_0000, Device::Usb, Some((AHB2, 7))),
    (0x5005_0000, 0x400, Device::Other, Some((AHB2, 0))),
    (0x5006_0800, 0x400, Device::Random, Some((AHB2, 6))),
    always(0xE004_2000, 0x400, Device::Debug),
];

/// Where the debugger's registers are, which lie apart from the others.
pub(super) const DEBUG_BASE: u32 = 0xE004_2000;

/// The peripheral at an address.
pub(super) fn find(address: u32) -> Option<&'static Row> {
    let after = ROWS.partition_point(|row| row.0 <= address);
    let row = ROWS.get(after.checked_sub(1)?)?;
    (address - row.0 < row.1).then_some(row)
}

/// The peripherals whose clock, and reset, is a bit of a register. The reset registers stand 0x20 before the enable
/// registers.
pub(super) fn behind(register: u32, bits: u32) -> impl Iterator<Item = Device> {
    let has = move |row: &&Row| {
        row.3.is_some_and(|(enable, bit)| enable == register && bits >> bit & 1 == 1)
    };
    ROWS.iter().filter(has).map(|row| row.2)
}
