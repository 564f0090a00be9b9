//! The MCUs that the machine can emulate, with a file in `mcus/` for each, which `cargo xtask mcus` writes.
//!
//! A file gives the version and address of each block, with its clock and its interrupts, and the requests to the DMA.
//! The function [`device`] maps blocks to models.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::map::{DEBUG_BASE, Device, Row};
use crate::wires::Request;

const FILES: [&str; 5] = [
    include_str!("../mcus/stm32f401.toml"),
    include_str!("../mcus/stm32f405.toml"),
    include_str!("../mcus/stm32f411.toml"),
    include_str!("../mcus/stm32f427.toml"),
    include_str!("../mcus/stm32f446.toml"),
];

static MCUS: LazyLock<Vec<Mcu>> =
    LazyLock::new(|| FILES.iter().filter_map(|text| Mcu::read(text)).collect());

/// The contents of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    parts: Vec<String>,
    largest: String,
    idcode: u32,
    flash_bytes: u32,
    sram_bytes: u32,
    ccm_bytes: u32,
    units: BTreeMap<String, Unit>,
    requests: BTreeMap<String, [Vec<String>; 8]>,
}

/// A unit of a file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Unit {
    block: String,
    base: u32,
    /// The offset of an enable register of the RCC, and the bit; `None` for a unit that always runs.
    clock: Option<(u32, u32)>,
    #[serde(default)]
    irqs: BTreeMap<String, u16>,
}

/// The properties of an MCU that the machine must know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mcu {
    parts: Vec<String>,
    largest: String,
    pub(crate) idcode: u32,
    pub(crate) flash_bytes: u32,
    pub(crate) sram_bytes: u32,
    /// The size of the core-coupled memory, which the DMA does not reach; 0 if there is none.
    pub(crate) ccm_bytes: u32,
    /// The peripherals, by address.
    pub(crate) rows: Vec<Row>,
    units: BTreeMap<String, Unit>,
    /// The requests, by controller, stream and channel.
    requests: [[[Vec<Request>; 8]; 8]; 2],
}

/// The number of an interrupt that no core has.
const NO_IRQ: u16 = u16::MAX;

impl Mcu {
    /// The MCU of a part such as `STM32F407VGT6`; `None` if it cannot be emulated.
    #[must_use]
    pub fn find(part: &str) -> Option<&'static Self> {
        MCUS.iter().find(|mcu| mcu.parts.iter().any(|start| part.starts_with(start.as_str())))
    }

    /// The prefixes of all part names for which there is a model, in order.
    pub fn parts() -> impl Iterator<Item = &'static str> {
        MCUS.iter().flat_map(|mcu| &mcu.parts).map(String::as_str)
    }

    /// Reads a file; `None` if it is damaged, which a test rules out.
    fn read(text: &str) -> Option<Self> {
        let file: File = toml::from_str(text).ok()?;
        let mut rows: Vec<Row> =
            file.units.iter().filter_map(|(name, unit)| row(name, unit)).collect();
        rows.sort_by_key(|row| row.base);
        let mut requests = <[[[Vec<Request>; 8]; 8]; 2]>::default();
        for (channel, row) in &file.requests {
            let place = channel.strip_prefix("DMA").and_then(|rest| rest.split_once("_CH"));
            let (controller, stream) = place?;
            let controller = controller.parse::<usize>().ok()?.checked_sub(1)?;
            let stream = requests.get_mut(controller)?.get_mut(stream.parse::<usize>().ok()?)?;
            for (asking, names) in stream.iter_mut().zip(row) {
                *asking = names.iter().filter_map(|name| request(name)).collect();
            }
        }
        Some(Self {
            parts: file.parts,
            largest: file.largest,
            idcode: file.idcode,
            flash_bytes: file.flash_bytes,
            sram_bytes: file.sram_bytes,
            ccm_bytes: file.ccm_bytes,
            rows,
            units: file.units,
            requests,
        })
    }

    /// The name of its line: `STM32F407`.
    #[must_use]
    pub fn name(&self) -> &str {
        self.largest.get(..9).unwrap_or(&self.largest)
    }

    /// The part whose package has all pads, as named in the parts table.
    pub(crate) fn largest(&self) -> &str {
        &self.largest
    }

    /// The interrupt of a unit's signal; one that no core has if the MCU lacks the unit.
    pub(crate) fn irq(&self, unit: &str, signal: &str) -> u16 {
        let irq = self.units.get(unit).and_then(|unit| unit.irqs.get(signal));
        irq.copied().unwrap_or(NO_IRQ)
    }

    /// Whether a unit is on the faster of the two buses.
    pub(crate) fn is_on_apb2(&self, unit: &str) -> bool {
        self.units.get(unit).is_some_and(|unit| unit.base >= 0x4001_0000)
    }

    /// The requests that a stream serves on one of its channels. Streams and controllers count from 0.
    pub(crate) fn requests(&self, controller: usize, stream: usize, channel: u32) -> &[Request] {
        let streams = self.requests.get(controller).and_then(|streams| streams.get(stream));
        streams.and_then(|channels| channels.get(channel as usize)).map_or(&[], Vec::as_slice)
    }

    /// The peripheral at an address.
    pub(crate) fn at(&self, address: u32) -> Option<Row> {
        let after = self.rows.partition_point(|row| row.base <= address);
        let row = self.rows.get(after.checked_sub(1)?)?;
        (address - row.base < row.bytes).then_some(*row)
    }

    /// The peripherals whose clock bit, and reset bit, is in a register. The reset registers are 0x20 below the enable
    /// registers.
    pub(crate) fn behind(&self, register: u32, bits: u32) -> impl Iterator<Item = Device> {
        let has = move |row: &&Row| {
            row.clock.is_some_and(|(enable, bit)| enable == register && bits >> bit & 1 == 1)
        };
        self.rows.iter().filter(has).map(|row| row.device)
    }
}

/// The number at the end of a unit's name, counted from 0.
fn index(name: &str) -> Option<usize> {
    let kind = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let digits = name.strip_prefix(kind)?;
    digits.parse::<usize>().ok()?.checked_sub(1)
}

/// The model for a unit; `None` for a unit that shares the place of another.
fn device(name: &str, block: &str) -> Option<Device> {
    Some(match block {
        "gpio_v2" => {
            let port = name.strip_prefix("GPIO")?.bytes().next()?;
            Device::Gpio(usize::from(port.checked_sub(b'A')?))
        }
        "timer_v1" => Device::Timer(index(name)?),
        "usart_v2" => Device::Usart(index(name)?),
        "spi_v2_i2s" => Device::Spi(index(name)?),
        // The fast-mode I2C is a different block.
        "i2c_v1" => Device::I2c(index(name)?),
        "can_bxcan" => Device::Can(index(name)?),
        // All converters, with the registers that they share, are in one place.
        "adc_v2" if name == "ADC1" => Device::Adc,
        "adc_v2" | "adccommon_v2" => return None,
        "dac_v2" => Device::Dac,
        "dma_v2" => Device::Dma(index(name)?),
        "exti_v1" => Device::Exti,
        "syscfg_f4" => Device::Syscfg,
        "rcc_f4" => Device::Rcc,
        "iwdg_v1" => Device::Iwdg,
        "otg_v1" if name == "USB_OTG_FS" => Device::Usb,
        "pwr_f4" => Device::Pwr,
        "flash_f4" => Device::Flash,
        "rtc_v2_f4" => Device::Rtc,
        "crc_v1" => Device::Crc,
        "rng_v1" => Device::Random,
        "dbgmcu_f4" => Device::Debug,
        _ => Device::Other,
    })
}

/// The place of a unit; `None` for one outside the peripherals' addresses.
fn row(name: &str, unit: &Unit) -> Option<Row> {
    let is_within = (0x4000_0000..0x6000_0000).contains(&unit.base) || unit.base == DEBUG_BASE;
    let device = device(name, &unit.block).filter(|_| is_within)?;
    let bytes = match unit.block.as_str() {
        "otg_v1" => 0x4_0000,
        "eth_v1b" => 0x1400,
        _ => 0x400,
    };
    // Each converter has its own clock, which `chip.rs` checks.
    let clock = unit.clock.filter(|_| device != Device::Adc);
    Some(Row { base: unit.base, bytes, device, clock })
}

/// The request of a name such as `SPI3_RX`; `None` for units that are not modelled.
fn request(name: &str) -> Option<Request> {
    let (unit, signal) = name.split_once('_')?;
    let at = index(unit)?;
    let kind = unit.trim_end_matches(|letter: char| letter.is_ascii_digit());
    Some(match (kind, signal) {
        ("ADC", _) => Request::Adc(at),
        ("I2C", "RX") => Request::I2cRx(at),
        ("I2C", "TX") => Request::I2cTx(at),
        ("SPI", "RX") => Request::SpiRx(at),
        ("SPI", "TX") => Request::SpiTx(at),
        ("USART" | "UART", "RX") => Request::UsartRx(at),
        ("USART" | "UART", "TX") => Request::UsartTx(at),
        ("DAC", _) => Request::Dac(index(signal)?),
        ("TIM", "UP") => Request::Timer(at, 0),
        ("TIM", _) => Request::Timer(at, signal.strip_prefix("CH")?.parse().ok()?),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{FILES, Mcu};
    use crate::map::Device;
    use crate::wires::Request;

    #[test]
    fn every_file_is_read() {
        for text in FILES {
            let mcu = Mcu::read(text).unwrap_or_else(|| panic!("{text}"));
            assert!(sensedsl_parts::find(mcu.largest()).is_some(), "{}", mcu.largest());
            let overlaps = mcu.rows.windows(2).any(|two| two[1].base - two[0].base < two[0].bytes);
            assert!(!overlaps && mcu.rows.len() > 30, "{}", mcu.name());
        }
    }

    #[test]
    fn parts_have_what_their_manuals_say() {
        let (f407, f411) =
            (Mcu::find("STM32F407VGT6").unwrap(), Mcu::find("STM32F411CEU6").unwrap());
        assert_eq!((f407.name(), f411.name()), ("STM32F407", "STM32F411"));
        assert_eq!(f407.at(0x4000_4C04).unwrap().device, Device::Usart(3));
        assert!(f411.at(0x4000_4C04).is_none());
        assert_eq!(f411.at(0x4001_5000).unwrap().device, Device::Spi(4));
        assert_eq!(f407.requests(0, 0, 6), [Request::Timer(4, 3), Request::Timer(4, 0)]);
        assert_eq!(f411.requests(0, 5, 6), [Request::I2cTx(2)]);
        assert_eq!((f407.irq("I2C3", "EV"), f411.irq("UART4", "GLOBAL")), (72, u16::MAX));
        assert!(f407.is_on_apb2("USART6") && !f407.is_on_apb2("USART3"));
        assert!(Mcu::find("STM32F103C8").is_none());
    }
}
