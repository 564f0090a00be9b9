//! All peripherals together: the one that answers at an address, the next deadline, and the transfers of the DMA.

use super::adc::Adc;
use super::can::{Can, Filters};
use super::dac::Dac;
use super::dma::Dma;
use super::exti::Exti;
use super::i2c::I2c;
use super::iwdg::Iwdg;
use super::map::{Device, Row};
use super::mcu::Mcu;
use super::plain::{self, Plain};
use super::ports::PortState;
use super::rcc::Rcc;
use super::spi::Spi;
use super::timer::Timer;
use super::transfer::{Memory, left_of};
use super::usart::Usart;
use super::usb::Usb;
use super::wires::{Event, NEVER, Request, ResetCause, Wires, merge};

/// Everything on the chip but the core and its memory.
pub(super) struct Chip {
    pub(super) mcu: &'static Mcu,
    pub wires: Wires,
    pub rcc: Rcc,
    pub(super) memory: Memory,
    pub(super) timers: [Timer; 14],
    pub(super) usarts: [Usart; 8],
    pub(super) spis: [Spi; 6],
    pub(super) i2cs: [I2c; 3],
    pub(super) adcs: [Adc; 3],
    adc_common: u32,
    cans: [Can; 2],
    filters: Filters,
    pub(super) dmas: [Dma; 2],
    pub(super) dma_irqs: [[u16; 8]; 2],
    adc_irq: u16,
    dac: Dac,
    exti: Exti,
    iwdg: Iwdg,
    pub usb: Usb,
    pwr: Plain,
    flash: Plain,
    rtc: Plain,
    crc: u32,
    random: (Plain, u32),
    debug: [u32; 4],
    /// The peripherals about which something was reported already.
    told: Vec<u32>,
    /// The address of an instruction just before the access.
    pub pc: u32,
    /// A reset that is due.
    pub reset: Option<ResetCause>,
}

impl Chip {
    pub(super) fn new(wires: Wires, memory: Memory, crystal_hz: u64, mcu: &'static Mcu) -> Self {
        let stream_irq =
            |dma: usize, stream: usize| mcu.irq(&format!("DMA{}", dma + 1), &format!("CH{stream}"));
        Self {
            mcu,
            wires,
            rcc: Rcc::new(crystal_hz),
            memory,
            timers: std::array::from_fn(|at| Timer::new(at, mcu)),
            usarts: [1, 2, 3, 4, 5, 6, 7, 8].map(|unit| Usart::new(unit, mcu)),
            spis: [1, 2, 3, 4, 5, 6].map(|unit| Spi::new(unit, mcu)),
            i2cs: [1, 2, 3].map(|unit| I2c::new(unit, mcu)),
            adcs: [1, 2, 3].map(Adc::new),
            adc_common: 0,
            cans: [1, 2].map(|unit| Can::new(unit, mcu)),
            filters: Filters::new(),
            dmas: [Dma::default(), Dma::default()],
            dma_irqs: [0, 1].map(|dma| std::array::from_fn(|stream| stream_irq(dma, stream))),
            adc_irq: mcu.irq("ADC1", "GLOBAL"),
            dac: Dac::default(),
            exti: Exti::new(mcu),
            iwdg: Iwdg::new(),
            usb: Usb::new(mcu),
            pwr: Plain::new(0x400, plain::PWR),
            flash: Plain::new(0x400, plain::FLASH),
            rtc: Plain::new(0x400, plain::RTC),
            crc: u32::MAX,
            random: (Plain::new(0x400, plain::RNG), 0),
            debug: [0; 4],
            told: Vec::new(),
            pc: 0,
            reset: None,
        }
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

    /// Puts all peripherals into their state after a reset; the backup domain keeps its contents unless power was lost.
    pub(super) fn restart(&mut self, cause: ResetCause) {
        self.rcc.reset(cause);
        for register in [0x30, 0x34, 0x38, 0x40, 0x44] {
            self.reset_behind(register, u32::MAX);
        }
        self.iwdg = Iwdg::new();
        self.exti = Exti::new(self.mcu);
        self.wires.gpio.reset();
        self.wires.clocks = self.rcc.clocks();
        self.settle();
    }

    /// The settings of the ports that have started.
    pub(super) fn ports(&self) -> Vec<PortState> {
        let serial = self.usarts.iter().filter_map(|one| one.state(&self.wires));
        let spi = self.spis.iter().filter_map(|one| one.state(&self.wires));
        let i2c = self.i2cs.iter().filter_map(|one| one.state(&self.wires));
        let can = self.cans.iter().filter_map(|one| one.state(&self.wires));
        serial.chain(spi).chain(i2c).chain(can).collect()
    }

    pub(super) fn deadline(&self) -> u64 {
        let timers = self.timers.iter().map(Timer::deadline);
        let ports = self.usarts.iter().map(Usart::deadline);
        let buses = self.spis.iter().map(Spi::deadline).chain(self.i2cs.iter().map(I2c::deadline));
        let others = self.adcs.iter().map(Adc::deadline).chain(self.cans.iter().map(Can::deadline));
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
        if self.exti.deadline() <= now {
            self.exti.advance(wires);
        }
        if self.usb.deadline() <= now {
            self.usb.advance(wires);
        }
        if self.iwdg.deadline() <= now {
            self.reset = Some(ResetCause::Watchdog);
            self.iwdg = Iwdg::new();
        }
        self.settle();
    }

    /// Settles outputs, triggers, requests and interrupts after a change.
    fn settle(&mut self) {
        if self.wires.gpio.has_changes() {
            self.wires.tell_outputs();
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
        let holds = |adc: &Adc| adc.interrupts();
        let is_held = self.adcs.iter().any(holds);
        self.wires.interrupt(self.adc_irq, 0, is_held);
    }

    // --- the bus ---

    /// Reads from a peripheral, with the width of the program's access.
    pub(super) fn fetch(&mut self, address: u32, size: u32) -> Option<u32> {
        let row = self.mcu.at(address)?;
        let shift = 8 * (address & 3);
        if !self.has_clock(row, address, false) {
            return Some(0);
        }
        let word = self.read(row.device, (address - row.base) & !3);
        let mask = if size >= 4 { u32::MAX } else { (1 << (8 * size)) - 1 };
        Some(word >> shift & mask)
    }

    pub(super) fn put(&mut self, address: u32, value: u32, size: u32) -> Option<()> {
        let row = self.mcu.at(address)?;
        let (base, device) = (row.base, row.device);
        let shift = 8 * (address & 3);
        // Some lost writes are harmless: a 0 changes nothing after a reset, and neither does clearing flags that are
        // not set. ChibiOS does both.
        let is_clear = matches!(device, Device::Dma(_)) && matches!(address - base, 0x08 | 0x0C);
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

    fn has_clock(&mut self, row: Row, address: u32, is_lost: bool) -> bool {
        let Row { base, device, clock, .. } = row;
        let is_on = match (device, clock) {
            (Device::Adc, _) => {
                let unit = (address - base) / 0x100;
                if unit < 3 {
                    self.rcc.is_enabled(0x44, 8 + unit)
                } else {
                    self.rcc.read(0x44) & 0x700 != 0
                }
            }
            (_, Some((register, bit))) => self.rcc.is_enabled(register, bit),
            (_, None) => true,
        };
        let is_modelled = device != Device::Other;
        if (!is_on && is_lost || is_on && !is_modelled) && !self.told.contains(&base) {
            self.told.push(base);
            let (at_ns, pc) = (self.wires.now, self.pc);
            self.wires.events.push(if is_on {
                Event::NotModelled { at_ns, address, pc }
            } else {
                Event::ClockOff { at_ns, address, pc }
            });
        }
        is_on && is_modelled
    }

    fn read(&mut self, device: Device, offset: u32) -> u32 {
        let wires = &mut self.wires;
        match device {
            Device::Gpio(port) => {
                let levels = if offset == 0x10 { levels(wires, port) } else { 0 };
                wires.gpio.read(port, offset, |_| levels)
            }
            Device::Timer(unit) => self.timers[unit].read(offset, wires),
            Device::Usart(unit) => self.usarts[unit].read(offset, wires),
            Device::Spi(unit) => self.spis[unit].read(offset, wires),
            Device::I2c(unit) => {
                wires.i2c_left[unit] = left_of(self.mcu, &self.dmas, Request::I2cRx(unit));
                self.i2cs[unit].read(offset, wires)
            }
            Device::Can(unit) => self.cans[unit].read(offset, &self.filters),
            Device::Adc => self.read_adc(offset),
            Device::Dac => self.dac.read(offset),
            Device::Dma(controller) => self.dmas[controller].read(offset),
            Device::Exti => self.exti.read(offset),
            Device::Syscfg => self.exti.read_ports(offset),
            Device::Rcc => self.rcc.read(offset),
            Device::Iwdg => self.iwdg.read(offset),
            Device::Usb => self.usb.read(offset, wires),
            Device::Pwr => self.pwr.read(offset),
            Device::Flash => self.flash.read(offset),
            Device::Rtc => self.rtc.read(offset),
            Device::Crc => self.crc,
            Device::Random => {
                self.random.1 = plain::next_random(self.random.1);
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
                wires.gpio.write(port, offset, value, mask);
                // A pad may be switched to a timer that already runs.
                wires.version += u64::from(matches!(offset, 0x00 | 0x20 | 0x24));
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
            Device::Adc => self.write_adc(offset, value, mask),
            Device::Dac => self.dac.write(offset, value, mask, wires),
            Device::Dma(controller) => {
                self.dmas[controller].write(offset, value, mask);
            }
            Device::Exti => self.exti.write(offset, value, mask, wires),
            Device::Syscfg => self.exti.write_ports(offset, value, mask, wires),
            Device::Rcc => {
                if let Some((register, bits)) = self.rcc.write(offset, value, mask) {
                    self.reset_behind(register + 0x20, bits);
                }
                self.wires.clocks = self.rcc.clocks();
            }
            Device::Iwdg => self.iwdg.write(offset, value, wires.now),
            Device::Usb => self.usb.write(offset, value, mask, wires),
            Device::Pwr => self.pwr.write(offset, value, mask),
            Device::Flash => self.flash.write(offset, value, mask),
            Device::Rtc => self.rtc.write(offset, value, mask),
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

    fn read_adc(&mut self, offset: u32) -> u32 {
        let (unit, register) = ((offset / 0x100) as usize, offset % 0x100);
        match (self.adcs.get_mut(unit), register) {
            (Some(adc), _) => adc.read(register),
            (None, 0) => self.adcs.iter().rev().fold(0, |all, adc| all << 8 | adc.status()),
            (None, 4) => self.adc_common,
            (None, _) => 0,
        }
    }

    fn write_adc(&mut self, offset: u32, value: u32, mask: u32) {
        let (unit, register) = ((offset / 0x100) as usize, offset % 0x100);
        if let Some(adc) = self.adcs.get_mut(unit) {
            adc.write(register, value, mask, &self.wires);
        } else if register == 4 {
            self.adc_common = merge(self.adc_common, value, mask);
            let divider = u64::from(self.adc_common >> 16 & 3) * 2 + 2;
            for adc in &mut self.adcs {
                adc.divider = divider;
            }
        }
    }

    /// Resets the peripherals that belong to clock bits.
    fn reset_behind(&mut self, register: u32, bits: u32) {
        for device in self.mcu.behind(register, bits) {
            match device {
                Device::Gpio(port) => self.wires.gpio.reset_port(port),
                Device::Timer(unit) => {
                    self.timers[unit] = Timer::new(unit, self.mcu);
                    self.timers[unit].settle(&mut self.wires);
                }
                Device::Usart(unit) => self.usarts[unit].restart(&mut self.wires),
                Device::Spi(unit) => self.spis[unit].restart(&mut self.wires),
                Device::I2c(unit) => self.i2cs[unit].restart(&mut self.wires),
                Device::Can(unit) => self.cans[unit].restart(&mut self.wires),
                Device::Dac => self.dac = Dac::default(),
                Device::Dma(controller) => self.dmas[controller] = Dma::default(),
                Device::Usb => self.usb.restart(&mut self.wires),
                _ => {}
            }
        }
        if register == 0x44 && bits & 0x100 != 0 {
            self.adcs = [1, 2, 3].map(Adc::new);
            self.adc_common = 0;
        }
    }
}

/// The levels on a port's pads.
fn levels(wires: &Wires, port: usize) -> u32 {
    let port = u8::try_from(port).unwrap_or(0);
    let is_high = |pin: u8| wires.level(sensedsl_surroundings::Pad { port, pin });
    (0..16_u8).filter(|pin| is_high(*pin)).fold(0, |levels, pin| levels | 1 << pin)
}
