//! The ports, with a file for each version of the block, and the peripheral that each pad is switched to.
//!
//! In: writes to the registers, and the signals that the parts table gives each pad. Out: the level that the program
//! gives a pad, the pad that each signal is on, and the settings of all pads.

mod port;
mod v1;
mod v2;

use std::collections::BTreeMap;

use self::port::Port;
pub use self::port::{Mode, Pull};
use self::v1::{Afio, Field};
use crate::mcu::Mcu;
use sensedsl_surroundings::Pad;

/// The settings of a pad.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PadState {
    /// The pad.
    pub pad: Pad,
    /// Its mode.
    pub mode: Mode,
    /// The signals of the peripheral that it is switched to, as in `TIM3_CH1`, if the MCU has any there. One number may
    /// stand for two: a timer's channel and its external trigger. Where peripherals select their pads, these are all
    /// that could be there.
    pub wires: Vec<String>,
    /// Whether it is open-drain: only its low side is driven.
    pub open_drain: bool,
    /// Its pull resistor.
    pub pull: Pull,
    /// Its speed, from 0 (slow) to 3 (fast).
    pub speed: u8,
}

/// The condition under which a signal is on a pad.
#[derive(Clone, Copy, Debug)]
enum Chosen {
    /// The pad has this number.
    ByNumber(u8),
    /// The peripheral's field, if it has one, has the number of one of these blocks, one bit each.
    ByBlock(Option<Field>, u8),
}

/// A signal that can be on a pad.
#[derive(Clone, Debug)]
struct Lead {
    wire: String,
    chosen: Chosen,
}

/// All ports.
pub(crate) struct Gpio {
    /// Whether pads choose their peripherals, by number.
    is_numbered: bool,
    /// Whether pads are analog after a reset.
    is_later: bool,
    ports: Vec<Box<dyn Port>>,
    afio: Afio,
    /// The signals that can be on each pad.
    leads: BTreeMap<Pad, Vec<Lead>>,
    /// The pads of the converters' inputs, which need no alternate function, by signal.
    inputs: BTreeMap<String, Pad>,
    /// The pad that each signal is on now.
    routes: BTreeMap<String, Pad>,
    changes: Vec<(Pad, Option<bool>)>,
}

impl Gpio {
    pub(crate) fn new(mcu: &Mcu) -> Self {
        let mut leads: BTreeMap<Pad, Vec<Lead>> = BTreeMap::new();
        let mut inputs = BTreeMap::new();
        if let Some(found) = sensedsl_parts::find(mcu.largest()) {
            for (name, _, usages) in found.sheet.pins() {
                let Some(pad) = Pad::named(name.as_str()) else { continue };
                for (usage, number) in usages {
                    let (signal, blocks) = usage.split_once('#').unwrap_or((usage, "0"));
                    let wire = signal.replace('-', "_");
                    if let Some((units, input)) = converter(&wire) {
                        inputs.extend(units.map(|unit| (format!("ADC{unit}_{input}"), pad)));
                        continue;
                    }
                    let own = leads.entry(pad).or_default();
                    let chosen = match number {
                        Some(number) => Chosen::ByNumber(*number),
                        None if mcu.numbers_functions() => continue,
                        None => Chosen::ByBlock(mcu.remap(unit_of(&wire)), set_of(blocks)),
                    };
                    own.push(Lead { wire, chosen });
                }
            }
        }
        let (is_numbered, is_later) = (mcu.numbers_functions(), mcu.starts_analog);
        let ports =
            (0..mcu.ports()).map(|number| after_reset(is_numbered, is_later, number)).collect();
        let mut gpio = Self {
            is_numbered,
            is_later,
            ports,
            afio: Afio::default(),
            leads,
            inputs,
            routes: BTreeMap::new(),
            changes: Vec::new(),
        };
        gpio.route();
        gpio
    }

    /// Puts all pads into their state after a reset.
    pub(crate) fn reset(&mut self) {
        for port in 0..self.ports.len() {
            self.restart(port);
        }
        self.route();
    }

    pub(crate) fn reset_port(&mut self, port: usize) {
        self.restart(port);
        self.route();
    }

    fn restart(&mut self, port: usize) {
        let before = self.drives_of(port);
        self.ports[port] = after_reset(self.is_numbered, self.is_later, port);
        self.note_changes(port, before);
    }

    pub(crate) fn pad_of(&self, wire: &str) -> Option<Pad> {
        self.routes.get(wire).or_else(|| self.inputs.get(wire)).copied()
    }

    pub(crate) fn is_pulled_up(&self, pad: Pad) -> bool {
        self.pull(pad) == Some(Pull::Up)
    }

    fn port(&self, pad: Pad) -> Option<&dyn Port> {
        self.ports.get(usize::from(pad.port)).map(|port| &**port)
    }

    /// The pull resistor that the debug port gives a pad, if it holds it.
    fn debugs(&self, pad: Pad) -> Option<Pull> {
        if self.is_numbered { None } else { self.afio.debugs(pad) }
    }

    fn pull(&self, pad: Pad) -> Option<Pull> {
        let port = self.port(pad)?;
        Some(self.debugs(pad).unwrap_or_else(|| port.pull(pad.pin)))
    }

    /// The level that the program gives a pad.
    pub(crate) fn drives(&self, pad: Pad) -> Option<bool> {
        let port = self.port(pad)?;
        if self.mode(pad)? != Mode::Output {
            return None;
        }
        let is_high = port.is_high(pad.pin);
        (!(port.is_open_drain(pad.pin) && is_high)).then_some(is_high)
    }

    fn mode(&self, pad: Pad) -> Option<Mode> {
        let mode = self.port(pad)?.mode(pad.pin);
        Some(if self.debugs(pad).is_some() { Mode::Alternate(None) } else { mode })
    }

    /// Whether a signal that can be on a pad is there now.
    fn is_led(&self, pad: Pad, lead: &Lead) -> bool {
        let mode = self.mode(pad);
        match lead.chosen {
            Chosen::ByNumber(number) => mode == Some(Mode::Alternate(Some(number))),
            Chosen::ByBlock(field, blocks) => {
                let (comes_in, goes_out) = directions(&lead.wire);
                let fits = match mode {
                    Some(Mode::Input) => comes_in,
                    Some(Mode::Alternate(_)) => goes_out && self.debugs(pad).is_none(),
                    Some(Mode::Output | Mode::Analog) | None => false,
                };
                fits && u32::from(blocks) >> self.afio.block(field) & 1 == 1
            }
        }
    }

    pub(crate) fn pads(&self) -> Vec<PadState> {
        let mut pads = Vec::new();
        for (port, registers) in (0..).zip(&self.ports) {
            for pin in 0..16_u8 {
                let pad = Pad { port, pin };
                let (Some(mode), Some(pull)) = (self.mode(pad), self.pull(pad)) else { continue };
                let all = self.leads.get(&pad).into_iter().flatten();
                let wires = all.filter(|lead| self.is_led(pad, lead));
                let wires = wires.map(|lead| lead.wire.clone()).collect();
                let (speed, open_drain) = (registers.speed(pin), registers.is_open_drain(pin));
                pads.push(PadState { pad, mode, wires, open_drain, pull, speed });
            }
        }
        pads
    }

    pub(crate) fn take_changes(&mut self) -> Vec<(Pad, Option<bool>)> {
        std::mem::take(&mut self.changes)
    }

    pub(crate) fn has_changes(&self) -> bool {
        !self.changes.is_empty()
    }

    fn drives_of(&self, port: usize) -> [Option<bool>; 16] {
        let port = u8::try_from(port).unwrap_or(0);
        let mut drives = [None; 16];
        for (slot, pin) in drives.iter_mut().zip(0..16_u8) {
            *slot = self.drives(Pad { port, pin });
        }
        drives
    }

    fn note_changes(&mut self, port: usize, before: [Option<bool>; 16]) {
        let after = self.drives_of(port);
        let number = u8::try_from(port).unwrap_or(0);
        for ((before, after), pin) in before.iter().zip(after).zip(0..16_u8) {
            if *before != after {
                self.changes.push((Pad { port: number, pin }, after));
            }
        }
    }

    fn route(&mut self) {
        let mut routes = BTreeMap::new();
        for (pad, leads) in &self.leads {
            for lead in leads.iter().filter(|lead| self.is_led(*pad, lead)) {
                routes.entry(lead.wire.clone()).or_insert(*pad);
            }
        }
        self.routes = routes;
    }

    /// Whether a register of a port has the levels on its pads.
    pub(crate) fn has_levels(&self, port: usize, offset: u32) -> bool {
        self.ports[port].levels_at() == offset
    }

    /// Reads any other register.
    pub(crate) fn read(&self, port: usize, offset: u32) -> u32 {
        self.ports[port].read(offset)
    }

    /// Writes a register; returns whether pads may be switched to other peripherals now.
    pub(crate) fn write(&mut self, port: usize, offset: u32, value: u32, mask: u32) -> bool {
        let before = self.drives_of(port);
        let leads_elsewhere = self.ports[port].write(offset, value, mask);
        if leads_elsewhere {
            self.route();
        }
        self.note_changes(port, before);
        leads_elsewhere
    }

    pub(crate) fn read_afio(&self, offset: u32) -> u32 {
        self.afio.read(offset)
    }

    /// Writes a register of AFIO; returns whether peripherals may be on other pads now.
    pub(crate) fn write_afio(&mut self, offset: u32, value: u32, mask: u32) -> bool {
        let mut afio = self.afio;
        let leads_elsewhere = afio.write(offset, value, mask);
        self.set_afio(afio);
        leads_elsewhere
    }

    pub(crate) fn reset_afio(&mut self) {
        self.set_afio(Afio::default());
    }

    fn set_afio(&mut self, afio: Afio) {
        let before: Vec<_> = (0..self.ports.len()).map(|port| self.drives_of(port)).collect();
        self.afio = afio;
        self.route();
        for (port, before) in before.into_iter().enumerate() {
            self.note_changes(port, before);
        }
    }
}

fn after_reset(is_numbered: bool, is_later: bool, number: usize) -> Box<dyn Port> {
    if is_numbered {
        Box::new(v2::Registers::new(number, is_later))
    } else {
        Box::new(v1::Registers::new())
    }
}

/// Splits `ADC12_IN8` into the units 1 and 2, and `IN8`.
fn converter(wire: &str) -> Option<(std::str::Chars<'_>, &str)> {
    let (units, input) = wire.strip_prefix("ADC")?.split_once('_')?;
    input.starts_with("IN").then_some((units.chars(), input))
}

/// The unit of a signal: `TIM3` of `TIM3_CH1`.
fn unit_of(wire: &str) -> &str {
    wire.split_once('_').map_or(wire, |(unit, _)| unit)
}

/// The blocks of a usage such as `TIM2_CH1#0|2`, one bit each.
fn set_of(blocks: &str) -> u8 {
    let numbers = blocks.split('|').filter_map(|block| block.parse::<u32>().ok());
    numbers.fold(0, |set, block| set | 1_u8.checked_shl(block).unwrap_or(0))
}

/// Whether a signal comes in at a pad that is an input, and goes out at one that a peripheral controls. A timer's
/// channel can do both; a bus's wires need their drivers.
fn directions(wire: &str) -> (bool, bool) {
    let signal = wire.split_once('_').map_or("", |(_, signal)| signal);
    match signal {
        "RX" | "MISO" | "CTS" | "ETR" | "BKIN" => (true, false),
        "CH1" | "CH2" | "CH3" | "CH4" => (true, true),
        _ => (false, true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CRL: u32 = 0x00;
    const CRH: u32 = 0x04;
    const MAPR: u32 = 0x04;

    fn f103() -> Gpio {
        Gpio::new(Mcu::find("STM32F103C8").unwrap())
    }

    fn state(gpio: &Gpio, name: &str) -> PadState {
        let pad = Pad::named(name).unwrap();
        gpio.pads().into_iter().find(|state| state.pad == pad).unwrap()
    }

    fn put(gpio: &mut Gpio, port: usize, offset: u32, value: u32) {
        gpio.write(port, offset, value, u32::MAX);
    }

    #[test]
    fn four_bits_set_up_a_pad_of_f1() {
        let mut gpio = f103();
        let float = state(&gpio, "PB0");
        assert_eq!((float.mode, float.pull, float.open_drain), (Mode::Input, Pull::None, false));
        // PB0 analog, PB1 pushed and pulled at 2 MHz, PB2 open drain at 50 MHz, PB5 an input with a resistor.
        put(&mut gpio, 1, CRL, 0x4484_4720);
        assert_eq!(state(&gpio, "PB0").mode, Mode::Analog);
        let [plain, drain] = ["PB1", "PB2"].map(|name| state(&gpio, name));
        assert_eq!((plain.mode, plain.open_drain, plain.speed), (Mode::Output, false, 0));
        assert_eq!((drain.mode, drain.open_drain, drain.speed), (Mode::Output, true, 3));
        assert_eq!(state(&gpio, "PB5").pull, Pull::Down);
        // The level of an input's output register chooses its resistor; BRR clears, BSRR sets before it clears.
        put(&mut gpio, 1, 0x10, 0b10_0110);
        assert_eq!(state(&gpio, "PB5").pull, Pull::Up);
        let [plain, drain] = ["PB1", "PB2"].map(|name| gpio.drives(Pad::named(name).unwrap()));
        assert_eq!((plain, drain), (Some(true), None));
        put(&mut gpio, 1, 0x14, 0b100);
        assert_eq!(gpio.drives(Pad::named("PB2").unwrap()), Some(false));
        put(&mut gpio, 1, 0x10, 0b10 | 0b10 << 16);
        assert_eq!(gpio.read(1, 0x0C), 0b10_0010);
    }

    #[test]
    fn peripherals_of_f1_choose_their_pads() {
        let mut gpio = f103();
        // Where pads float, signals that come in are there, and no others.
        assert_eq!(gpio.pad_of("USART1_RX"), Pad::named("PA10"));
        assert_eq!(gpio.pad_of("USART1_TX"), None);
        put(&mut gpio, 0, CRH, 0x4444_44B4);
        assert_eq!(gpio.pad_of("USART1_TX"), Pad::named("PA9"));
        // An output of the peripheral is no input.
        put(&mut gpio, 0, CRH, 0x4444_4BB4);
        assert_eq!(gpio.pad_of("USART1_RX"), None);
        // USART1 and TIM2 in their next blocks.
        gpio.write_afio(MAPR, 1 << 2 | 1 << 8, u32::MAX);
        assert_eq!(gpio.pad_of("USART1_TX"), None);
        put(&mut gpio, 1, CRL, 0x4B44_4444);
        assert_eq!(gpio.pad_of("USART1_TX"), Pad::named("PB6"));
        assert_eq!(gpio.pad_of("USART1_RX"), Pad::named("PB7"));
        assert_eq!(gpio.pad_of("ADC1_IN8"), Pad::named("PB0"));
    }

    #[test]
    fn the_debug_port_of_f1_holds_its_pads() {
        let mut gpio = f103();
        // TIM2's first two channels move to PA15 and PB3, which JTAG has.
        gpio.write_afio(MAPR, 1 << 8, u32::MAX);
        assert_eq!(gpio.pad_of("TIM2_CH1"), None);
        assert_eq!((state(&gpio, "PA15").pull, state(&gpio, "PA14").pull), (Pull::Up, Pull::Down));
        put(&mut gpio, 1, CRL, 0x4444_2444);
        assert_eq!(gpio.drives(Pad::named("PB3").unwrap()), None);
        // The port keeps its two wires. This cannot be read back, so a write that only adds a bit takes the pads again.
        gpio.write_afio(MAPR, 1 << 8 | 2 << 24, u32::MAX);
        assert_eq!(gpio.drives(Pad::named("PB3").unwrap()), Some(false));
        assert_eq!(gpio.take_changes().last(), Some(&(Pad::named("PB3").unwrap(), Some(false))));
        assert_eq!(state(&gpio, "PA13").mode, Mode::Alternate(None));
        let read = gpio.read_afio(MAPR);
        assert_eq!(read, 1 << 8);
        // All ones leave it as it is.
        gpio.write_afio(MAPR, read | 7 << 24, u32::MAX);
        assert_eq!(gpio.drives(Pad::named("PB3").unwrap()), Some(false));
        gpio.write_afio(MAPR, read | 1 << 2, u32::MAX);
        assert_eq!(gpio.drives(Pad::named("PB3").unwrap()), None);
    }
}
