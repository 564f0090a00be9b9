//! All peripherals together: the one that answers at an address, the next deadline, and the transfers of the DMA.

mod resets;

use std::collections::BTreeMap;

use super::adc::{self, Adc, Common};
use super::can::{Can, Filters};
use super::dac::Dac;
use super::dma::{self, Dma, STREAMS};
use super::exti::Exti;
use super::fdcan::Fdcan;
use super::i2c::{self, I2c};
use super::iwdg::Iwdg;
use super::map::{Device, Request, Row};
use super::mcu::Mcu;
use super::plain::{Plain, next_random};
use super::ports::PortState;
use super::rcc::{self, Rcc};
use super::registers::merge;
use super::spi::{self, Spi};
use super::timer::Timer;
use super::transfer::{Memory, left_of};
use super::usart::Usart;
use super::usb::{self, Usb};
use super::wires::{Event, NEVER, ResetCause, Wires};

/// Everything on the chip but the core and its memory.
pub(super) struct Chip {
    pub(super) mcu: &'static Mcu,
    pub wires: Wires,
    pub rcc: Box<dyn Rcc>,
    pub(super) memory: Memory,
    // Units stand at their numbers, counted from 0, up to the last one that the MCU has.
    pub(super) timers: Vec<Timer>,
    pub(super) usarts: Vec<Usart>,
    pub(super) spis: Vec<Box<dyn Spi>>,
    pub(super) i2cs: Vec<Box<dyn I2c>>,
    pub(super) adcs: Vec<Box<dyn Adc>>,
    adc_irqs: Vec<u16>,
    /// What converters share, by the first of these.
    adc_commons: BTreeMap<usize, Common>,
    cans: Vec<Can>,
    fdcans: Vec<Fdcan>,
    filters: Filters,
    pub(super) dmas: Vec<Box<dyn Dma>>,
    pub(super) dma_irqs: Vec<[u16; STREAMS]>,
    /// The number of the request that the multiplexer has selected for each stream.
    selected: Vec<u32>,
    dacs: Vec<Dac>,
    exti: Exti,
    iwdg: Iwdg,
    usb: Box<dyn Usb>,
    pwr: Plain,
    flash: Plain,
    rtc: Plain,
    backup: Plain,
    recovery: Plain,
    crc: u32,
    random: (Plain, u32),
    debug: [u32; 4],
    /// The peripherals about which something was reported already.
    reported: Vec<u32>,
    /// The address of an instruction just before the access.
    pub pc: u32,
    /// A reset that is due.
    pub reset: Option<ResetCause>,
}

impl Chip {
    pub(super) fn new(wires: Wires, memory: Memory, rcc: Box<dyn Rcc>, mcu: &'static Mcu) -> Self {
        let stream_irq =
            |dma: usize, stream: usize| mcu.irq(&format!("DMA{}", dma + 1), &format!("CH{stream}"));
        let irqs = |dma| std::array::from_fn(|stream| stream_irq(dma, stream));
        let numbers = |kinds: &[&str]| (1_u8..).take(mcu.last(kinds));
        let dmas = mcu.last(&["DMA"]);
        let plain = |unit: &str| Plain::new(mcu.block(unit));
        let mut chip = Self {
            mcu,
            iwdg: Iwdg::new(wires.clocks.lsi),
            wires,
            rcc,
            memory,
            timers: (0..mcu.last(&["TIM"])).map(|at| Timer::new(at, mcu)).collect(),
            usarts: (0..mcu.serials()).map(|place| Usart::new(place, mcu)).collect(),
            spis: numbers(&["SPI"]).map(|unit| spi::new(unit, mcu)).collect(),
            i2cs: numbers(&["I2C"]).map(|unit| i2c::new(unit, mcu)).collect(),
            adcs: numbers(&["ADC"]).map(|unit| adc::new(mcu.block("ADC1"), unit)).collect(),
            adc_irqs: numbers(&["ADC"])
                .map(|unit| mcu.irq(&format!("ADC{unit}"), "GLOBAL"))
                .collect(),
            adc_commons: adc::commons(mcu),
            cans: numbers(&["CAN"]).map(|unit| Can::new(unit, mcu)).collect(),
            fdcans: numbers(&["FDCAN"]).map(|unit| Fdcan::new(unit, mcu)).collect(),
            filters: Filters::new(mcu.last(&["CAN"]) > 1),
            dmas: (0..dmas).map(|_| dma::new(mcu.block("DMA1"))).collect(),
            dma_irqs: (0..dmas).map(irqs).collect(),
            selected: Vec::new(),
            dacs: numbers(&["DAC"]).map(|unit| Dac::new(unit, mcu)).collect(),
            exti: Exti::new(mcu),
            usb: usb::new(mcu),
            pwr: plain("PWR"),
            flash: plain("FLASH"),
            rtc: plain("RTC"),
            backup: plain("BKP"),
            recovery: plain("CRS"),
            crc: u32::MAX,
            random: (plain("RNG"), 0),
            debug: [0; 4],
            reported: Vec::new(),
            pc: 0,
            reset: None,
        };
        chip.take_clocks();
        chip
    }

    /// Takes the frequencies after a change of the clock tree.
    fn take_clocks(&mut self) {
        self.wires.clocks = self.rcc.clocks();
        self.wires.kernels = rcc::kernels(self.mcu, &*self.rcc);
    }

    pub(super) fn memory(&self) -> Memory {
        self.memory.clone()
    }

    /// Whether the watchdog runs: it ends a standstill.
    pub(super) fn is_watched(&self) -> bool {
        self.iwdg.deadline() != NEVER
    }

    /// The time from a reload of the watchdog to its reset; `None` if it does not run.
    pub(super) fn watchdog_ns(&self) -> Option<u64> {
        self.is_watched().then(|| self.iwdg.period_ns())
    }

    /// The settings of the ports that have started.
    pub(super) fn ports(&self) -> Vec<PortState> {
        let serial = self.usarts.iter().filter_map(|one| one.state(&self.wires));
        let spi = self.spis.iter().filter_map(|one| one.state(&self.wires));
        let i2c = self.i2cs.iter().filter_map(|one| one.state(&self.wires));
        let can = self.cans.iter().filter_map(|one| one.state(&self.wires));
        let fdcan = self.fdcans.iter().filter_map(|one| one.state(&self.wires));
        serial.chain(spi).chain(i2c).chain(can).chain(fdcan).collect()
    }

    pub(super) fn deadline(&self) -> u64 {
        let timers = self.timers.iter().map(Timer::deadline);
        let ports = self.usarts.iter().map(Usart::deadline);
        let spis = self.spis.iter().map(|spi| spi.deadline());
        let buses = spis.chain(self.i2cs.iter().map(|i2c| i2c.deadline()));
        let others =
            self.adcs.iter().map(|adc| adc.deadline()).chain(self.cans.iter().map(Can::deadline));
        let others = others.chain(self.fdcans.iter().map(Fdcan::deadline));
        let single = [self.exti.deadline(), self.iwdg.deadline(), self.usb.deadline()];
        timers.chain(ports).chain(buses).chain(others).chain(single).min().unwrap_or(NEVER)
    }

    /// Handles everything that is due by now.
    pub(super) fn advance(&mut self) {
        let now = self.wires.now;
        let wires = &mut self.wires;
        for timer in &mut self.timers {
            if timer.deadline() <= now {
                timer.advance(wires);
            }
        }
        for usart in &mut self.usarts {
            if usart.deadline() <= now {
                usart.advance(wires);
            }
        }
        for spi in &mut self.spis {
            if spi.deadline() <= now {
                spi.advance(wires);
            }
        }
        for (index, i2c) in self.i2cs.iter_mut().enumerate() {
            if i2c.deadline() <= now {
                wires.i2c_left[index] = left_of(self.mcu, &self.dmas, Request::I2cRx(index));
                i2c.advance(wires);
            }
        }
        for adc in &mut self.adcs {
            if adc.deadline() <= now {
                adc.advance(wires);
            }
        }
        for can in &mut self.cans {
            if can.deadline() <= now {
                can.advance(wires, &self.filters);
            }
        }
        for can in &mut self.fdcans {
            if can.deadline() <= now {
                can.advance(wires);
            }
        }
        if self.exti.deadline() <= now {
            self.exti.advance(wires);
        }
        if self.usb.deadline() <= now {
            self.usb.advance(wires);
        }
        if self.iwdg.deadline() <= now {
            self.reset = Some(ResetCause::Watchdog);
            self.iwdg = Iwdg::new(self.wires.clocks.lsi);
        }
        self.settle();
    }

    /// Settles outputs, triggers, requests and interrupts after a change.
    fn settle(&mut self) {
        if self.wires.gpio.has_changes() {
            self.wires.report_outputs();
        }
        let triggers = std::mem::take(&mut self.wires.triggers);
        if triggers != 0 {
            for adc in &mut self.adcs {
                adc.trigger(triggers, &self.wires);
            }
        }
        self.serve_dma();
        self.exti.review(&mut self.wires);
        for timer in &mut self.timers {
            timer.review_edges(&self.wires);
        }
        for ((adc, irq), holder) in self.adcs.iter().zip(&self.adc_irqs).zip(0..) {
            self.wires.interrupt(*irq, holder, adc.interrupts());
        }
    }

    // --- the bus ---

    /// Reads from a peripheral, with the width of the program's access.
    pub(super) fn fetch(&mut self, address: u32, size: u32) -> Option<u32> {
        let row = self.mcu.at(address)?;
        let shift = 8 * (address & 3);
        if !self.has_clock(row, address, false) {
            return Some(0);
        }
        let word = self.read(row.device, (address - row.base) & !3, size);
        let mask = if size >= 4 { u32::MAX } else { (1 << (8 * size)) - 1 };
        Some(word >> shift & mask)
    }

    pub(super) fn put(&mut self, address: u32, value: u32, size: u32) -> Option<()> {
        let row = self.mcu.at(address)?;
        let (base, device) = (row.base, row.device);
        let shift = 8 * (address & 3);
        // Some lost writes are harmless: a 0 changes nothing after a reset, and neither does clearing flags that are
        // not set. ChibiOS does both.
        let is_clear = match device {
            Device::Dma(controller) => self.dmas[controller].clears_flags(address - base),
            _ => false,
        };
        let is_lost = value != 0 && !is_clear;
        if !self.has_clock(row, address, is_lost) {
            return Some(());
        }
        let mask = if size >= 4 { u32::MAX } else { ((1 << (8 * size)) - 1) << shift };
        self.write(device, (address - base) & !3, value << shift, mask);
        Some(())
    }

    /// Settles everything after an access by the program.
    pub(super) fn accessed(&mut self) {
        self.settle();
    }

    fn is_enabled(&self, row: Row) -> bool {
        row.clock.is_none_or(|(register, bit)| self.rcc.is_enabled(register, bit))
    }

    fn has_clock(&mut self, row: Row, address: u32, is_lost: bool) -> bool {
        let Row { base, device, clock, .. } = row;
        let is_on = match (device, clock) {
            // What converters share has the clock of any of them.
            (Device::AdcCommon(first), _) => {
                let members = self.adc_commons.get(&first).map_or(&[][..], |own| &own.members);
                let is_member = |row: &Row| members.iter().any(|at| row.device == Device::Adc(*at));
                self.mcu.rows.iter().any(|row| is_member(row) && self.is_enabled(*row))
            }
            _ => self.is_enabled(row),
        };
        let is_modelled = device != Device::Other;
        if (!is_on && is_lost || is_on && !is_modelled) && !self.reported.contains(&base) {
            self.reported.push(base);
            let (at_ns, pc) = (self.wires.now, self.pc);
            self.wires.events.push(if is_on {
                Event::NotModelled { at_ns, address, pc }
            } else {
                Event::ClockOff { at_ns, address, pc }
            });
        }
        is_on && is_modelled
    }

    fn read(&mut self, device: Device, offset: u32, bytes: u32) -> u32 {
        let wires = &mut self.wires;
        match device {
            Device::Gpio(port) => {
                if wires.gpio.has_levels(port, offset) {
                    return levels(wires, port);
                }
                wires.gpio.read(port, offset)
            }
            Device::Timer(unit) => self.timers[unit].read(offset, wires),
            Device::Usart(unit) => self.usarts[unit].read(offset, wires),
            Device::Spi(unit) => self.spis[unit].read(offset, bytes, wires),
            Device::I2c(unit) => {
                wires.i2c_left[unit] = left_of(self.mcu, &self.dmas, Request::I2cRx(unit));
                self.i2cs[unit].read(offset, wires)
            }
            Device::Can(unit) => self.cans[unit].read(offset, &self.filters),
            Device::Fdcan(unit) => self.fdcans[unit].read(offset),
            Device::FdcanMemory(unit) => self.fdcans[unit].read_memory(offset),
            Device::Adc(unit) => self.adcs[unit].read(offset),
            Device::AdcCommon(first) => {
                self.adc_commons.get(&first).map_or(0, |own| own.read(offset, &self.adcs))
            }
            Device::Dac(unit) => self.dacs[unit].read(offset),
            Device::Dma(controller) => self.dmas[controller].read(offset),
            Device::Multiplexer => self.selected.get((offset / 4) as usize).copied().unwrap_or(0),
            Device::Exti => self.exti.read(offset),
            Device::Afio if !EXTI_PORTS.contains(&offset) => wires.gpio.read_afio(offset),
            Device::Syscfg | Device::Afio => self.exti.read_ports(offset),
            Device::Rcc => self.rcc.read(offset),
            Device::Iwdg => self.iwdg.read(offset),
            Device::Usb => self.usb.read(offset, wires),
            Device::UsbMemory => self.usb.read_memory(offset),
            Device::Pwr => self.pwr.read(offset),
            Device::Flash => self.flash.read(offset),
            Device::Rtc => self.rtc.read(offset),
            Device::Backup => self.backup.read(offset),
            Device::Recovery => self.recovery.read(offset),
            Device::Crc => self.crc,
            Device::Random => {
                self.random.1 = next_random(self.random.1);
                if offset == 8 { self.random.1 } else { self.random.0.read(offset) }
            }
            Device::Debug => match offset {
                0 => self.mcu.idcode,
                _ => self.debug.get((offset / 4) as usize).copied().unwrap_or(0),
            },
            Device::Other => 0,
        }
    }

    fn write(&mut self, device: Device, offset: u32, value: u32, mask: u32) {
        let wires = &mut self.wires;
        match device {
            Device::Gpio(port) => {
                // A pad may be switched to a timer that already runs.
                let leads_elsewhere = wires.gpio.write(port, offset, value, mask);
                wires.version += u64::from(leads_elsewhere);
            }
            Device::Timer(unit) => self.timers[unit].write(offset, value, mask, wires),
            Device::Usart(unit) => self.usarts[unit].write(offset, value, mask, wires),
            Device::Spi(unit) => self.spis[unit].write(offset, value, mask, wires),
            Device::I2c(unit) => {
                wires.i2c_left[unit] = left_of(self.mcu, &self.dmas, Request::I2cRx(unit));
                self.i2cs[unit].write(offset, value, mask, wires);
            }
            Device::Can(unit) => {
                self.cans[unit].write(offset, value, mask, wires, &mut self.filters);
            }
            Device::Fdcan(unit) => {
                self.fdcans[unit].write(offset, value, mask, wires);
                // The first unit has the divider of all.
                let divider = self.fdcans[0].shared();
                self.fdcans.iter_mut().for_each(|can| can.share(divider));
            }
            Device::FdcanMemory(unit) => self.fdcans[unit].write_memory(offset, value, mask),
            Device::Adc(unit) => self.adcs[unit].write(offset, value, mask, wires),
            Device::AdcCommon(first) => {
                if let Some(own) = self.adc_commons.get_mut(&first) {
                    own.write(offset, value, mask, &mut self.adcs);
                }
            }
            Device::Dac(unit) => self.dacs[unit].write(offset, value, mask, wires),
            Device::Dma(controller) => {
                self.dmas[controller].write(offset, value, mask);
            }
            Device::Multiplexer => self.multiplex((offset / 4) as usize, value, mask),
            Device::Exti => self.exti.write(offset, value, mask, wires),
            Device::Afio if !EXTI_PORTS.contains(&offset) => {
                let leads_elsewhere = wires.gpio.write_afio(offset, value, mask);
                wires.version += u64::from(leads_elsewhere);
            }
            Device::Syscfg | Device::Afio => self.exti.write_ports(offset, value, mask, wires),
            Device::Rcc => {
                if let Some((register, bits)) = self.rcc.write(offset, value, mask) {
                    self.reset_behind(register, bits);
                }
                self.take_clocks();
            }
            Device::Iwdg => self.iwdg.write(offset, value, wires.now),
            Device::Usb => self.usb.write(offset, value, mask, wires),
            Device::UsbMemory => self.usb.write_memory(offset, value, mask),
            Device::Pwr => self.pwr.write(offset, value, mask),
            Device::Flash => self.flash.write(offset, value, mask),
            Device::Rtc => self.rtc.write(offset, value, mask),
            Device::Backup => self.backup.write(offset, value, mask),
            Device::Recovery => self.recovery.write(offset, value, mask),
            Device::Crc => self.crc = if offset == 8 { u32::MAX } else { self.crc },
            Device::Random => self.random.0.write(offset, value, mask),
            Device::Debug => {
                if let Some(register) = self.debug.get_mut((offset / 4) as usize) {
                    *register = merge(*register, value, mask);
                }
            }
            Device::Other => {}
        }
    }
}

/// The registers that have the ports of the lines of EXTI, in SYSCFG and AFIO alike.
const EXTI_PORTS: std::ops::RangeInclusive<u32> = 0x08..=0x14;

/// The levels on a port's pads.
fn levels(wires: &Wires, port: usize) -> u32 {
    let port = u8::try_from(port).unwrap_or(0);
    let is_high = |pin: u8| wires.level(sensedsl_surroundings::Pad { port, pin });
    (0..16_u8).filter(|pin| is_high(*pin)).fold(0, |levels, pin| levels | 1 << pin)
}
