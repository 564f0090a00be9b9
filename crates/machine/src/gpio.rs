//! Ports A to K, and the peripheral that each pad is switched to.

use std::collections::BTreeMap;

use super::mcu::Mcu;
use super::wires::merge;
use sensedsl_surroundings::Pad;

/// Ports A to K.
const PORTS: usize = 11;

/// The mode of a pad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Its level can be read.
    Input,
    /// The program sets its level.
    Output,
    /// A peripheral controls the pad.
    Alternate(u8),
    /// For converters and the DAC. After a reset, all pads except the debugger's are [`Mode::Input`].
    Analog,
}

/// The internal pull resistor of a pad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pull {
    /// No resistor.
    None,
    /// A pull-up.
    Up,
    /// A pull-down.
    Down,
}

/// The settings of a pad.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PadState {
    /// The pad.
    pub pad: Pad,
    /// Its mode.
    pub mode: Mode,
    /// The signals of the peripheral that it is switched to, as in `TIM3_CH1`, if the MCU has any there. One number may
    /// stand for two: a timer's channel and its external trigger.
    pub wires: Vec<String>,
    /// Whether it is open-drain: only its low side is driven.
    pub open_drain: bool,
    /// Its pull resistor.
    pub pull: Pull,
    /// Its speed, from 0 (slow) to 3 (fast).
    pub speed: u8,
}

/// The registers of a port, with the manual's names.
#[derive(Clone, Copy, Debug)]
struct Port {
    moder: u32,
    otyper: u32,
    ospeedr: u32,
    pupdr: u32,
    odr: u32,
    lckr: u32,
    afr: [u32; 2],
}

/// All ports.
pub(super) struct Gpio {
    ports: [Port; PORTS],
    /// The peripherals' signals, by pad and number of the alternate function.
    functions: BTreeMap<(Pad, u8), Vec<String>>,
    /// The pads of the converters' inputs, which need no alternate function, by signal.
    inputs: BTreeMap<String, Pad>,
    /// The pad that each signal is on now.
    routes: BTreeMap<String, Pad>,
    changes: Vec<(Pad, Option<bool>)>,
}

/// The state after a reset: the debugger has its own pads.
fn after_reset(port: usize) -> Port {
    let (moder, ospeedr, pupdr) = match port {
        0 => (0xA800_0000, 0x0C00_0000, 0x6400_0000),
        1 => (0x0000_0280, 0x0000_00C0, 0x0000_0100),
        _ => (0, 0, 0),
    };
    Port { moder, otyper: 0, ospeedr, pupdr, odr: 0, lckr: 0, afr: [0; 2] }
}

fn field(register: u32, pin: u8) -> u32 {
    (register >> (2 * u32::from(pin))) & 3
}

impl Gpio {
    pub(super) fn new(mcu: &Mcu) -> Self {
        let mut functions: BTreeMap<(Pad, u8), Vec<String>> = BTreeMap::new();
        let mut inputs = BTreeMap::new();
        if let Some(found) = sensedsl_parts::find(mcu.largest()) {
            for (name, _, usages) in found.sheet.pins() {
                let Some(pad) = Pad::named(name.as_str()) else { continue };
                for (usage, number) in usages {
                    let wire = usage.replace('-', "_");
                    if let Some(number) = number {
                        functions.entry((pad, *number)).or_default().push(wire);
                    } else if let Some((units, input)) = converter(&wire) {
                        for unit in units {
                            inputs.insert(format!("ADC{unit}_{input}"), pad);
                        }
                    }
                }
            }
        }
        Self {
            ports: std::array::from_fn(after_reset),
            functions,
            inputs,
            routes: BTreeMap::new(),
            changes: Vec::new(),
        }
    }

    /// Puts all pads into their state after a reset.
    pub(super) fn reset(&mut self) {
        for port in 0..PORTS {
            let before = self.drives_of(port);
            self.ports[port] = after_reset(port);
            self.note_changes(port, before);
        }
        self.route();
    }

    pub(super) fn reset_port(&mut self, port: usize) {
        let before = self.drives_of(port);
        self.ports[port] = after_reset(port);
        self.note_changes(port, before);
        self.route();
    }

    pub(super) fn pad_of(&self, wire: &str) -> Option<Pad> {
        self.routes.get(wire).or_else(|| self.inputs.get(wire)).copied()
    }

    pub(super) fn is_pulled_up(&self, pad: Pad) -> bool {
        self.port(pad).is_some_and(|port| field(port.pupdr, pad.pin) == 1)
    }

    fn port(&self, pad: Pad) -> Option<&Port> {
        self.ports.get(usize::from(pad.port))
    }

    /// The level that the program gives a pad.
    pub(super) fn drives(&self, pad: Pad) -> Option<bool> {
        let port = self.port(pad)?;
        let is_high = port.odr >> pad.pin & 1 == 1;
        let is_open_drain = port.otyper >> pad.pin & 1 == 1;
        (field(port.moder, pad.pin) == 1 && !(is_open_drain && is_high)).then_some(is_high)
    }

    pub(super) fn mode(&self, pad: Pad) -> Option<Mode> {
        let port = self.port(pad)?;
        Some(match field(port.moder, pad.pin) {
            0 => Mode::Input,
            1 => Mode::Output,
            2 => Mode::Alternate(function_number(port, pad.pin)),
            _ => Mode::Analog,
        })
    }

    pub(super) fn pads(&self) -> Vec<PadState> {
        let mut pads = Vec::new();
        for port in 0..11_u8 {
            for pin in 0..16_u8 {
                let pad = Pad { port, pin };
                let (Some(registers), Some(mode)) = (self.port(pad), self.mode(pad)) else {
                    continue;
                };
                let wires = match mode {
                    Mode::Alternate(number) => self.functions.get(&(pad, number)).cloned(),
                    Mode::Input | Mode::Output | Mode::Analog => None,
                };
                let pull = match field(registers.pupdr, pin) {
                    1 => Pull::Up,
                    2 => Pull::Down,
                    _ => Pull::None,
                };
                let speed = u8::try_from(field(registers.ospeedr, pin)).unwrap_or(0);
                let open_drain = registers.otyper >> pin & 1 == 1;
                let wires = wires.unwrap_or_default();
                pads.push(PadState { pad, mode, wires, open_drain, pull, speed });
            }
        }
        pads
    }

    pub(super) fn take_changes(&mut self) -> Vec<(Pad, Option<bool>)> {
        std::mem::take(&mut self.changes)
    }

    pub(super) fn has_changes(&self) -> bool {
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
        self.routes.clear();
        for ((pad, number), wires) in &self.functions {
            if self.mode(*pad) == Some(Mode::Alternate(*number)) {
                for wire in wires {
                    self.routes.entry(wire.clone()).or_insert(*pad);
                }
            }
        }
    }

    /// Reads a register; `levels` gives the levels on the port's pads, for IDR.
    pub(super) fn read(&self, port: usize, offset: u32, levels: impl FnOnce(&Self) -> u32) -> u32 {
        let registers = &self.ports[port];
        match offset {
            0x00 => registers.moder,
            0x04 => registers.otyper,
            0x08 => registers.ospeedr,
            0x0C => registers.pupdr,
            0x10 => levels(self),
            0x14 => registers.odr,
            0x1C => registers.lckr,
            0x20 => registers.afr[0],
            0x24 => registers.afr[1],
            _ => 0,
        }
    }

    pub(super) fn write(&mut self, port: usize, offset: u32, value: u32, mask: u32) {
        let before = self.drives_of(port);
        let registers = &mut self.ports[port];
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => put(&mut registers.moder),
            0x04 => put(&mut registers.otyper),
            0x08 => put(&mut registers.ospeedr),
            0x0C => put(&mut registers.pupdr),
            0x14 => put(&mut registers.odr),
            0x18 => {
                let (set, clear) = (value & mask & 0xFFFF, (value & mask) >> 16);
                registers.odr = (registers.odr & !clear) | set;
            }
            0x1C => put(&mut registers.lckr),
            0x20 => put(&mut registers.afr[0]),
            0x24 => put(&mut registers.afr[1]),
            _ => {}
        }
        registers.odr &= 0xFFFF;
        if matches!(offset, 0x00 | 0x20 | 0x24) {
            self.route();
        }
        self.note_changes(port, before);
    }
}

fn function_number(port: &Port, pin: u8) -> u8 {
    let register = port.afr[usize::from(pin / 8)];
    u8::try_from((register >> (4 * u32::from(pin % 8))) & 15).unwrap_or(0)
}

/// Splits `ADC12_IN8` into the units 1 and 2, and `IN8`.
fn converter(wire: &str) -> Option<(Vec<char>, &str)> {
    let (units, input) = wire.strip_prefix("ADC")?.split_once('_')?;
    Some((units.chars().collect(), input))
}
