//! All peripherals together: who answers at an address, what is due when, and what the DMA moves.

use std::sync::Arc;

use rsemu::core::space::RamStore;

use super::adc::Adc;
use super::can::{Can, Filters};
use super::dac::Dac;
use super::dma::{Direction, Dma, requester};
use super::exti::Exti;
use super::i2c::I2c;
use super::iwdg::Iwdg;
use super::map::{self, Device};
use super::plain::{self, Plain};
use super::rcc::Rcc;
use super::spi::Spi;
use super::timer::Timer;
use super::usart::Usart;
use super::usb::Usb;
use super::wires::{Event, NEVER, Request, ResetCause, Wires, merge};

/// What DBGMCU says the chip is: STM32F40x, revision Y.
const IDCODE: u32 = 0x100F_6413;
/// The most items that one request moves at once; a request that never ends is a mistake of a model.
const ITEMS_MAX: usize = 70_000;

/// Memory that the DMA can reach.
#[derive(Clone)]
pub(super) struct Memory {
    pub flash: Arc<RamStore>,
    pub sram: Arc<RamStore>,
}

/// Where memory begins.
pub(super) const FLASH_BASE: u32 = 0x0800_0000;
pub(super) const SRAM_BASE: u32 = 0x2000_0000;

impl Memory {
    fn place(&self, address: u32) -> Option<(&RamStore, u64)> {
        let within = |store: &RamStore, base: u32| {
            let offset = u64::from(address.wrapping_sub(base));
            (offset < store.len()).then_some(offset)
        };
        if let Some(offset) = within(&self.sram, SRAM_BASE) {
            return Some((&self.sram, offset));
        }
        within(&self.flash, FLASH_BASE).map(|offset| (&*self.flash, offset))
    }

    fn read(&self, address: u32) -> Option<u8> {
        let (store, offset) = self.place(address)?;
        store.read_u8(offset).ok()
    }

    fn write(&self, address: u32, byte: u8) -> bool {
        let Some((store, offset)) = self.place(address) else { return false };
        address >= SRAM_BASE && store.write_u8(offset, byte).is_ok()
    }
}

/// Everything on the chip but the core and its memory.
pub(super) struct Chip {
    pub wires: Wires,
    pub rcc: Rcc,
    memory: Memory,
    timers: [Timer; 14],
    usarts: [Usart; 6],
    spis: [Spi; 3],
    i2cs: [I2c; 3],
    adcs: [Adc; 3],
    adc_common: u32,
    cans: [Can; 2],
    filters: Filters,
    dmas: [Dma; 2],
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
    /// Peripherals of which something was told already.
    told: Vec<u32>,
    /// The address of an instruction just before the access.
    pub pc: u32,
    /// A reset is due.
    pub reset: Option<ResetCause>,
}

impl Chip {
    pub(super) fn new(wires: Wires, memory: Memory, crystal_hz: u64) -> Self {
        Self {
            wires,
            rcc: Rcc::new(crystal_hz),
            memory,
            timers: std::array::from_fn(Timer::new),
            usarts: [(1, 37), (2, 38), (3, 39), (4, 52), (5, 53), (6, 71)].map(|(unit, irq)| Usart::new(unit, irq)),
            spis: [1, 2, 3].map(Spi::new),
            i2cs: [1, 2, 3].map(I2c::new),
            adcs: [1, 2, 3].map(Adc::new),
            adc_common: 0,
            cans: [1, 2].map(Can::new),
            filters: Filters::new(),
            dmas: [Dma::default(), Dma::default()],
            dac: Dac::default(),
            exti: Exti::new(),
            iwdg: Iwdg::new(),
            usb: Usb::new(),
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

    /// The host has something to send.
    pub(super) fn link_has_bytes(&mut self) {
        self.usb.link_has_bytes(&mut self.wires);
    }

    /// All peripherals as after a reset; the backup domain keeps what it has.
    pub(super) fn restart(&mut self, cause: ResetCause) {
        self.rcc.reset(cause);
        for register in [0x30, 0x34, 0x38, 0x40, 0x44] {
            self.reset_behind(register, u32::MAX);
        }
        self.iwdg = Iwdg::new();
        self.exti = Exti::new();
        self.wires.gpio.reset();
        self.wires.clocks = self.rcc.clocks();
        self.settle();
    }

    pub(super) fn deadline(&self) -> u64 {
        let timers = self.timers.iter().map(Timer::deadline);
        let ports = self.usarts.iter().map(Usart::deadline);
        let buses = self.spis.iter().map(Spi::deadline).chain(self.i2cs.iter().map(I2c::deadline));
        let others = self.adcs.iter().map(Adc::deadline).chain(self.cans.iter().map(Can::deadline));
        let single = [self.exti.deadline(), self.iwdg.deadline(), self.usb.deadline()];
        timers.chain(ports).chain(buses).chain(others).chain(single).min().unwrap_or(NEVER)
    }

    /// Works on everything that is due until now.
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
                wires.i2c_left[index] = left_of(&self.dmas, Request::I2cRx(index));
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

    /// After any change: outputs, triggers, requests, interrupts.
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
        self.wires.interrupt(18, 0, is_held);
    }

    // --- DMA ---

    fn serve_dma(&mut self) {
        for controller in 0..2 {
            for stream in 0..8 {
                if self.dmas[controller].streams[stream].is_enabled() {
                    self.serve_stream(controller, stream);
                }
            }
            const IRQS: [[u16; 8]; 2] = [[11, 12, 13, 14, 15, 16, 17, 47], [56, 57, 58, 59, 60, 68, 69, 70]];
            for (stream, irq) in IRQS[controller].iter().enumerate() {
                let is_held = self.dmas[controller].interrupts(stream);
                self.wires.interrupt(*irq, 0, is_held);
            }
        }
    }

    fn serve_stream(&mut self, controller: usize, stream: usize) {
        for _ in 0..ITEMS_MAX {
            let state = self.dmas[controller].streams[stream];
            if !state.is_enabled() {
                return;
            }
            if state.direction() != Direction::Memory {
                let channel = state.cr >> 25 & 7;
                let Some(request) = requester(controller, stream, channel) else { return };
                if !self.asks(request) {
                    return;
                }
                self.served(request, state.left);
            }
            if self.move_item(controller, stream).is_none() {
                self.dmas[controller].fail(stream);
                return;
            }
        }
    }

    fn asks(&self, request: Request) -> bool {
        match request {
            Request::Adc(unit) => self.adcs[unit].asks(),
            Request::I2cRx(unit) => self.i2cs[unit].asks(false),
            Request::I2cTx(unit) => self.i2cs[unit].asks(true),
            Request::SpiRx(unit) => self.spis[unit].asks(false),
            Request::SpiTx(unit) => self.spis[unit].asks(true),
            Request::UsartRx(unit) => self.usarts[unit].asks(false),
            Request::UsartTx(unit) => self.usarts[unit].asks(true),
            Request::Timer(unit, channel) => self.timers[unit].asks(channel),
            // No firmware of this generator has its DAC fed by the DMA.
            Request::Dac(_) => false,
        }
    }

    fn served(&mut self, request: Request, left: u32) {
        match request {
            Request::Timer(unit, channel) => self.timers[unit].was_served(channel),
            Request::Adc(unit) if left == 1 => self.adcs[unit].dma_ended(),
            Request::I2cRx(unit) => self.wires.i2c_left[unit] = Some(left.saturating_sub(1)),
            Request::Adc(_)
            | Request::I2cTx(_)
            | Request::SpiRx(_)
            | Request::SpiTx(_)
            | Request::UsartRx(_)
            | Request::UsartTx(_)
            | Request::Dac(_) => {}
        }
    }

    /// Moves an item of the peripheral's size; `None` where nothing is at an address.
    fn move_item(&mut self, controller: usize, stream: usize) -> Option<()> {
        let state = self.dmas[controller].streams[stream];
        let (size, _) = state.sizes();
        let (peripheral, memory) = (state.peripheral_address(), state.memory_address(state.moved()));
        match state.direction() {
            Direction::FromPeripheral => {
                let value = self.fetch(peripheral, size)?;
                self.store_bytes(memory, value, size)?;
            }
            Direction::ToPeripheral => {
                let value = self.load_bytes(memory, size)?;
                self.put(peripheral, value, size)?;
            }
            Direction::Memory => {
                let value = self.load_bytes(peripheral, size)?;
                self.store_bytes(memory, value, size)?;
            }
        }
        self.dmas[controller].count(stream);
        Some(())
    }

    fn load_bytes(&self, address: u32, size: u32) -> Option<u32> {
        (0..size).rev().try_fold(0, |value, at| Some(value << 8 | u32::from(self.memory.read(address + at)?)))
    }

    fn store_bytes(&self, address: u32, value: u32, size: u32) -> Option<()> {
        let bytes = value.to_le_bytes();
        let mut places = (0..size).zip(bytes);
        places.all(|(at, byte)| self.memory.write(address + at, byte)).then_some(())
    }

    // --- the bus ---

    /// Reads from a peripheral, as wide as the program does it.
    pub(super) fn fetch(&mut self, address: u32, size: u32) -> Option<u32> {
        let (base, _, device, gate) = map::find(address)?;
        let shift = 8 * (address & 3);
        if !self.has_clock(*device, address, *base, *gate) {
            return Some(0);
        }
        let word = self.read(*device, (address - base) & !3);
        let mask = if size >= 4 { u32::MAX } else { (1 << (8 * size)) - 1 };
        Some(word >> shift & mask)
    }

    pub(super) fn put(&mut self, address: u32, value: u32, size: u32) -> Option<()> {
        let (base, _, device, gate) = map::find(address)?;
        let shift = 8 * (address & 3);
        if !self.has_clock(*device, address, *base, *gate) {
            return Some(());
        }
        let mask = if size >= 4 { u32::MAX } else { ((1 << (8 * size)) - 1) << shift };
        self.write(*device, (address - base) & !3, value << shift, mask);
        Some(())
    }

    /// After an access of the program's.
    pub(super) fn accessed(&mut self) {
        self.settle();
    }

    fn has_clock(&mut self, device: Device, address: u32, base: u32, gate: Option<(u32, u32)>) -> bool {
        let is_on = match (device, gate) {
            (Device::Adc, _) => {
                let unit = (address - base) / 0x100;
                if unit < 3 { self.rcc.is_enabled(0x44, 8 + unit) } else { self.rcc.read(0x44) & 0x700 != 0 }
            }
            (_, Some((register, bit))) => self.rcc.is_enabled(register, bit),
            (_, None) => true,
        };
        let is_modelled = device != Device::Other;
        if (!is_on || !is_modelled) && !self.told.contains(&base) {
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
                wires.i2c_left[unit] = left_of(&self.dmas, Request::I2cRx(unit));
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
                0 => IDCODE,
                _ => self.debug.get((offset / 4) as usize).copied().unwrap_or(0),
            },
            Device::Other => 0,
        }
    }

    fn write(&mut self, device: Device, offset: u32, value: u32, mask: u32) {
        let wires = &mut self.wires;
        match device {
            Device::Gpio(port) => wires.gpio.write(port, offset, value, mask),
            Device::Timer(unit) => self.timers[unit].write(offset, value, mask, wires),
            Device::Usart(unit) => self.usarts[unit].write(offset, value, mask, wires),
            Device::Spi(unit) => self.spis[unit].write(offset, value, mask, wires),
            Device::I2c(unit) => {
                wires.i2c_left[unit] = left_of(&self.dmas, Request::I2cRx(unit));
                self.i2cs[unit].write(offset, value, mask, wires);
            }
            Device::Can(unit) => self.cans[unit].write(offset, value, mask, wires, &mut self.filters),
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

    /// Resets peripherals by the bits of their clocks.
    fn reset_behind(&mut self, register: u32, bits: u32) {
        for device in map::behind(register, bits) {
            match device {
                Device::Gpio(port) => self.wires.gpio.reset_port(port),
                Device::Timer(unit) => {
                    self.timers[unit] = Timer::new(unit);
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

/// What is left in the stream that serves a request.
fn left_of(dmas: &[Dma; 2], wanted: Request) -> Option<u32> {
    for (controller, dma) in dmas.iter().enumerate() {
        for (stream, state) in dma.streams.iter().enumerate() {
            if state.is_enabled() && requester(controller, stream, state.cr >> 25 & 7) == Some(wanted) {
                return Some(state.left);
            }
        }
    }
    None
}

/// The levels of a port's pads.
fn levels(wires: &Wires, port: usize) -> u32 {
    let port = u8::try_from(port).unwrap_or(0);
    let is_high = |pin: u8| wires.level(crate::surroundings::Pad { port, pin });
    (0..16_u8).filter(|pin| is_high(*pin)).fold(0, |levels, pin| levels | 1 << pin)
}
