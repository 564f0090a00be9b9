//! The MCUs that the machine can emulate, with a file in `mcus/` for each, which `cargo xtask mcus` writes.
//!
//! A file gives the version and address of each block, with its clock and its interrupts, and the requests to the DMA.
//! The function [`device`] maps blocks to models.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::map::{DEBUG_BASE, Device, Request, Row};
use crate::usart::place;

const FILES: [&str; 8] = [
    include_str!("../mcus/stm32f103c8.toml"),
    include_str!("../mcus/stm32f401.toml"),
    include_str!("../mcus/stm32f405.toml"),
    include_str!("../mcus/stm32f411.toml"),
    include_str!("../mcus/stm32f412.toml"),
    include_str!("../mcus/stm32f427.toml"),
    include_str!("../mcus/stm32f446.toml"),
    include_str!("../mcus/stm32g473.toml"),
];

static MCUS: LazyLock<Vec<Mcu>> =
    LazyLock::new(|| FILES.iter().filter_map(|text| Mcu::read(text)).collect());

/// The contents of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    parts: Vec<String>,
    largest: String,
    core: Core,
    idcode: u32,
    size_at: u32,
    flash_bytes: u32,
    sram_bytes: u32,
    ccm_bytes: u32,
    #[serde(default)]
    ccm_in_sram: bool,
    #[serde(default)]
    starts_analog: bool,
    units: BTreeMap<String, Unit>,
    requests: BTreeMap<String, Vec<Vec<String>>>,
    #[serde(default)]
    multiplexed: BTreeMap<String, usize>,
}

/// The processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) enum Core {
    #[serde(rename = "cortex-m3")]
    M3,
    #[serde(rename = "cortex-m4f")]
    M4F,
}

/// A unit of a file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Unit {
    block: String,
    base: u32,
    /// How many channels a timer has, and of which width, by the name that the source of the file has for it.
    shape: Option<String>,
    /// The offset of an enable register of the RCC, and the bit; `None` for a unit that always runs.
    clock: Option<(u32, u32)>,
    /// The choice of its kernel clock, if it has one.
    kernel: Option<Kernel>,
    /// The field of AFIO that moves the unit's signals to other pads: offset, lowest bit, bits.
    remap: Option<(u32, u32, u32)>,
    #[serde(default)]
    irqs: BTreeMap<String, u16>,
}

/// The choice among clocks that a unit has.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Kernel {
    /// The field of the RCC: offset, lowest bit, bits.
    pub(crate) field: (u32, u32, u32),
    /// The names of the clocks, by the value of the field.
    pub(crate) clocks: Vec<String>,
}

/// The properties of an MCU that the machine must know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mcu {
    parts: Vec<String>,
    largest: String,
    pub(crate) core: Core,
    pub(crate) idcode: u32,
    /// The address of the half-word that has the size of the flash in kibibytes.
    pub(crate) size_at: u32,
    pub(crate) flash_bytes: u32,
    pub(crate) sram_bytes: u32,
    /// The size of the core-coupled memory, which the DMA does not reach; 0 if there is none.
    pub(crate) ccm_bytes: u32,
    /// Whether the core-coupled memory is also the end of the other memory, where the DMA does reach it.
    pub(crate) ccm_in_sram: bool,
    /// Whether pads are analog after a reset, and not inputs.
    pub(crate) starts_analog: bool,
    /// The peripherals, by address.
    pub(crate) rows: Vec<Row>,
    units: BTreeMap<String, Unit>,
    /// The requests, by controller, stream and channel.
    requests: Vec<Vec<Vec<Vec<Request>>>>,
    /// The requests that a multiplexer can give any stream, by number, and the stream of each of its channels.
    selectable: Vec<Vec<Request>>,
    multiplexed: Vec<(usize, usize)>,
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
        let units = &file.units;
        let mut rows: Vec<Row> =
            units.iter().filter_map(|(name, unit)| row(name, unit, units)).collect();
        rows.sort_by_key(|row| row.base);
        let mut requests: Vec<Vec<Vec<Vec<Request>>>> = Vec::new();
        let mut selectable = Vec::new();
        for (place, row) in &file.requests {
            let named =
                |names: &Vec<String>| names.iter().filter_map(|name| request(name)).collect();
            let row = row.iter().map(named).collect();
            if place.starts_with("DMAMUX") {
                selectable = row;
                continue;
            }
            let (controller, stream) = stream(place)?;
            *at_index(at_index(&mut requests, controller)?, stream)? = row;
        }
        let mut multiplexed = Vec::new();
        for (place, channel) in &file.multiplexed {
            *at_index(&mut multiplexed, *channel)? = stream(place)?;
        }
        Some(Self {
            parts: file.parts,
            largest: file.largest,
            core: file.core,
            size_at: file.size_at,
            idcode: file.idcode,
            flash_bytes: file.flash_bytes,
            sram_bytes: file.sram_bytes,
            ccm_bytes: file.ccm_bytes,
            ccm_in_sram: file.ccm_in_sram,
            starts_analog: file.starts_analog,
            rows,
            units: file.units,
            requests,
            selectable,
            multiplexed,
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

    /// The name and version of a unit's block, as in `timer_v1`; empty if the MCU lacks the unit.
    pub(crate) fn block(&self, unit: &str) -> &str {
        self.units.get(unit).map_or("", |unit| &unit.block)
    }

    /// How many channels a timer has, and of which width, as in `TIM_GP16`.
    pub(crate) fn shape(&self, timer: &str) -> &str {
        self.units.get(timer).and_then(|unit| unit.shape.as_deref()).unwrap_or_default()
    }

    /// The field of AFIO that moves a unit's signals.
    pub(crate) fn remap(&self, unit: &str) -> Option<(u32, u32, u32)> {
        self.units.get(unit)?.remap
    }

    /// The address of the unique number, which every MCU has.
    pub(crate) fn number_at(&self) -> u32 {
        self.units.get("UID").map_or(0, |unit| unit.base)
    }

    /// The highest number among the units of these kinds: 4 with TIM1 and TIM4. A unit without a number has number 1.
    pub(crate) fn last(&self, kinds: &[&str]) -> usize {
        let is_own = |name: &&String| kinds.contains(&kind(name));
        self.units.keys().filter(is_own).filter_map(|name| index(name)).max().map_or(0, |at| at + 1)
    }

    /// The name of a unit by its number, from 1 on: that of CAN 1 is `CAN` where it is the only one.
    pub(crate) fn unit(&self, kind: &str, number: u8) -> String {
        let own = format!("{kind}{number}");
        let is_only =
            number == 1 && !self.units.contains_key(&own) && self.units.contains_key(kind);
        if is_only { kind.to_owned() } else { own }
    }

    /// The number of places of serial ports.
    pub(crate) fn serials(&self) -> usize {
        let places = self.rows.iter().filter_map(|row| match row.device {
            Device::Usart(place) => Some(place + 1),
            _ => None,
        });
        places.max().unwrap_or(0)
    }

    /// The registers that converters share: the first of these, and the registers' name and block.
    pub(crate) fn adc_commons(&self) -> impl Iterator<Item = (usize, &str, &str)> {
        self.units.iter().filter_map(|(name, unit)| match device(name, &unit.block) {
            Some(Device::AdcCommon(first)) => Some((first, name.as_str(), unit.block.as_str())),
            _ => None,
        })
    }

    /// The number of ports up to the last one.
    pub(crate) fn ports(&self) -> usize {
        let ports = self.rows.iter().filter_map(|row| match row.device {
            Device::Gpio(port) => Some(port + 1),
            _ => None,
        });
        ports.max().unwrap_or(0)
    }

    /// Whether each pad chooses a peripheral by the number of an alternate function. Otherwise each peripheral chooses
    /// its pads, and reads those that are inputs.
    #[must_use]
    pub fn numbers_functions(&self) -> bool {
        self.block("GPIOA") != "gpio_v1"
    }

    /// The choices of the units that select their kernel clock, with the units' names.
    pub(crate) fn kernels(&self) -> impl Iterator<Item = (&str, &Kernel)> {
        self.units.iter().filter_map(|(name, unit)| Some((name.as_str(), unit.kernel.as_ref()?)))
    }

    /// The stream that a channel of the multiplexer serves.
    pub(crate) fn multiplexed(&self, channel: usize) -> Option<(usize, usize)> {
        self.multiplexed.get(channel).copied()
    }

    /// The requests that a stream serves on one of its channels, or with what its multiplexer selects. Controllers
    /// count from 0, and streams as in the manual.
    pub(crate) fn requests(&self, controller: usize, stream: usize, channel: u32) -> &[Request] {
        if !self.multiplexed.is_empty() {
            return self.selectable.get(channel as usize).map_or(&[], Vec::as_slice);
        }
        let streams = self.requests.get(controller).and_then(|streams| streams.get(stream));
        streams.and_then(|channels| channels.get(channel as usize)).map_or(&[], Vec::as_slice)
    }

    /// The peripheral at an address.
    pub(crate) fn at(&self, address: u32) -> Option<Row> {
        let after = self.rows.partition_point(|row| row.base <= address);
        let row = self.rows.get(after.checked_sub(1)?)?;
        (address - row.base < row.bytes).then_some(*row)
    }

    /// The peripherals whose clock bits are in an enable register. Their reset bits are at the same places.
    pub(crate) fn behind(&self, register: u32, bits: u32) -> impl Iterator<Item = Device> {
        let has = move |row: &&Row| {
            row.clock.is_some_and(|(enable, bit)| enable == register && bits >> bit & 1 == 1)
        };
        self.rows.iter().filter(has).map(|row| row.device)
    }
}

/// The controller, counted from 0, and the number of a stream such as `DMA2_CH7`.
fn stream(name: &str) -> Option<(usize, usize)> {
    let (controller, stream) = name.strip_prefix("DMA")?.split_once("_CH")?;
    Some((controller.parse::<usize>().ok()?.checked_sub(1)?, stream.parse().ok()?))
}

/// An element of a list, which becomes longer if it has to; `None` beyond what any MCU has.
fn at_index<T: Default>(list: &mut Vec<T>, at: usize) -> Option<&mut T> {
    const LONGEST: usize = 64;
    if at < LONGEST {
        list.resize_with(list.len().max(at + 1), T::default);
    }
    list.get_mut(at)
}

/// A unit's name without the number at its end.
fn kind(name: &str) -> &str {
    name.trim_end_matches(|letter: char| letter.is_ascii_digit())
}

/// The number at the end of a unit's name, counted from 0; the only unit of a kind may have none.
fn index(name: &str) -> Option<usize> {
    match name.strip_prefix(kind(name))? {
        "" => Some(0),
        digits => digits.parse::<usize>().ok()?.checked_sub(1),
    }
}

/// The first converter of those that share the registers of a unit such as `ADC345_COMMON`, counted from 0.
fn common(name: &str) -> Option<usize> {
    let first = name.strip_prefix("ADC")?.get(..1)?;
    first.parse::<usize>().ok()?.checked_sub(1)
}

/// The model for a unit; `None` for one whose name is not of its block.
fn device(name: &str, block: &str) -> Option<Device> {
    Some(match block {
        "gpio_v1" | "gpio_v2" => {
            let port = name.strip_prefix("GPIO")?.bytes().next()?;
            Device::Gpio(usize::from(port.checked_sub(b'A')?))
        }
        "timer_v1" | "timer_v2" => Device::Timer(index(name)?),
        // The first two versions differ in oversampling, which no firmware of this generator uses.
        "usart_v1" | "usart_v2" | "usart_v4" => Device::Usart(place(name)?),
        "spi_v1" | "spi_v2_i2s" | "spi_v3_i2s" => Device::Spi(index(name)?),
        // The fast-mode I2C is a different block.
        "i2c_v1" | "i2c_v2" => Device::I2c(index(name)?),
        "can_bxcan" => Device::Can(index(name)?),
        "can_fdcan_v1" => Device::Fdcan(index(name)?),
        "fdcanram_v1" => Device::FdcanMemory(index(name)?),
        "adc_f1" | "adc_v2" | "adc_g4" => Device::Adc(index(name)?),
        "adccommon_v2" | "adccommon_g4" => Device::AdcCommon(common(name)?),
        "dac_v2" | "dac_v7" => Device::Dac(index(name)?),
        "bdma_v1" | "dma_v2" => Device::Dma(index(name)?),
        "dmamux_v1" => Device::Multiplexer,
        "exti_v1" => Device::Exti,
        "syscfg_f4" | "syscfg_g4" => Device::Syscfg,
        "afio_f1" => Device::Afio,
        "rcc_f1" | "rcc_f4" | "rcc_g4" => Device::Rcc,
        "crs_v1" => Device::Recovery,
        "iwdg_v1" | "iwdg_v2" => Device::Iwdg,
        "otg_v1" if name == "USB_OTG_FS" => Device::Usb,
        "usb_v1" | "usb_v3" => Device::Usb,
        "usbram_16x1_512" | "usbram_16x2_1024" => Device::UsbMemory,
        "pwr_f1" | "pwr_f4" | "pwr_g4" => Device::Pwr,
        "flash_f1" | "flash_f4" | "flash_g4c3" => Device::Flash,
        "rtc_v1" | "rtc_v2_f4" | "rtc_v3_base" => Device::Rtc,
        "bkp_v1" | "tamp_g4" => Device::Backup,
        "crc_v1" | "crc_v3" => Device::Crc,
        "rng_v1" => Device::Random,
        "dbgmcu_f1" | "dbgmcu_f4" | "dbgmcu_g4" => Device::Debug,
        _ => Device::Other,
    })
}

/// The place of a unit; `None` for one outside the peripherals' addresses.
fn row(name: &str, unit: &Unit, units: &BTreeMap<String, Unit>) -> Option<Row> {
    let is_within = (0x4000_0000..0x6000_0000).contains(&unit.base) || unit.base == DEBUG_BASE;
    let device = device(name, &unit.block).filter(|_| is_within)?;
    let bytes = match unit.block.as_str() {
        "otg_v1" => 0x4_0000,
        "eth_v1b" => 0x1400,
        "adc_v2" | "adccommon_v2" | "adc_g4" | "adccommon_g4" => 0x100,
        // These are close together.
        "syscfg_g4" => 0x30,
        "vrefbuf_v2b" => 0x1D0,
        "comp_v2" | "opamp_v5" => 4,
        "fdcanram_v1" => 0x350,
        _ => 0x400,
    };
    // A memory for packets or messages has the clock of its unit.
    let owner = match device {
        Device::UsbMemory => "USB",
        Device::FdcanMemory(_) => "FDCAN1",
        _ => "",
    };
    let clock = unit.clock.or_else(|| units.get(owner)?.clock);
    Some(Row { base: unit.base, bytes, device, clock })
}

/// The request of a name such as `SPI3_RX`; `None` for units that are not modelled.
fn request(name: &str) -> Option<Request> {
    let (unit, signal) = name.split_once('_')?;
    let at = index(unit)?;
    Some(match (kind(unit), signal) {
        ("ADC", _) => Request::Adc(at),
        ("I2C", "RX") => Request::I2cRx(at),
        ("I2C", "TX") => Request::I2cTx(at),
        ("SPI", "RX") => Request::SpiRx(at),
        ("SPI", "TX") => Request::SpiTx(at),
        ("USART" | "UART" | "LPUART", "RX") => Request::UsartRx(place(unit)?),
        ("USART" | "UART" | "LPUART", "TX") => Request::UsartTx(place(unit)?),
        ("DAC", _) => Request::Dac(index(signal)?),
        ("TIM", "UP") => Request::Timer(at, 0),
        ("TIM", _) => Request::Timer(at, signal.strip_prefix("CH")?.parse().ok()?),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{FILES, Mcu};
    use crate::map::{Device, Request};

    #[test]
    fn every_file_is_read() {
        for text in FILES {
            let mcu = Mcu::read(text).unwrap_or_else(|| panic!("{text}"));
            assert!(sensedsl_parts::find(mcu.largest()).is_some(), "{}", mcu.largest());
            let overlaps = mcu.rows.windows(2).any(|two| two[1].base - two[0].base < two[0].bytes);
            assert!(!overlaps && mcu.rows.len() > 30, "{}", mcu.name());
            assert!(mcu.number_at() > 0 && mcu.ports() > 4, "{}", mcu.name());
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
        assert_eq!((f407.last(&["TIM"]), f411.last(&["USART", "UART"])), (14, 6));
        assert_eq!((f407.shape("TIM2"), f407.shape("TIM12")), ("TIM_GP32", "TIM_2CH"));
        assert!(f407.numbers_functions() && f407.remap("TIM2").is_none());
    }

    #[test]
    fn the_parts_of_f1_have_what_their_manual_says() {
        let f103 = Mcu::find("STM32F103C8T6").unwrap();
        assert_eq!((f103.name(), f103.core), ("STM32F103", super::Core::M3));
        assert_eq!(f103.at(0x4001_2800).unwrap().device, Device::Adc(1));
        assert_eq!(f103.at(0x4000_6204).unwrap().device, Device::UsbMemory);
        assert_eq!(f103.at(0x4000_6204).unwrap().clock, f103.at(0x4000_5C00).unwrap().clock);
        assert_eq!(f103.at(0x4001_0004).unwrap().device, Device::Afio);
        // The first stream, which has one list.
        let first = [Request::Adc(0), Request::Timer(1, 3), Request::Timer(3, 1)];
        assert!(first.iter().all(|one| f103.requests(0, 1, 0).contains(one)));
        assert!(f103.requests(0, 1, 1).is_empty() && f103.requests(1, 1, 0).is_empty());
        assert_eq!((f103.irq("USB", "LP"), f103.irq("CAN", "RX0")), (20, 20));
        assert_eq!((f103.unit("CAN", 1), f103.last(&["CAN"])), ("CAN".to_owned(), 1));
        assert_eq!((f103.shape("TIM2"), f103.remap("TIM2")), ("TIM_GP16", Some((4, 8, 2))));
        assert!(!f103.numbers_functions());
        assert_eq!((f103.ports(), f103.number_at()), (5, 0x1FFF_F7E8));
        // Other densities have other units.
        assert!(Mcu::find("STM32F103ZE").is_none() && Mcu::find("STM32F103C6").is_none());
    }
}
