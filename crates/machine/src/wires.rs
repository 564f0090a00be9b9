//! The state that the devices of the chip share: time, clocks, pads, lines to the interrupt controller, the world.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, PoisonError};

use super::gpio::Gpio;
use super::mcu::Mcu;
use sensedsl_surroundings::{Pad, Surroundings};

/// The time of an event that is not due.
pub(super) const NEVER: u64 = u64::MAX;
/// Nanoseconds in a second.
pub(super) const SECOND_NS: u64 = 1_000_000_000;
/// The full scale of the converters and of the DAC, in millivolts.
pub(super) const SUPPLY_MV: f64 = 3300.0;

/// The frequencies in Hz, with the present settings of the clock tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Clocks {
    pub core: u64,
    pub apb1: u64,
    pub apb2: u64,
    pub timers1: u64,
    pub timers2: u64,
    /// The clock of the converters, before a divider of their own.
    pub adc: u64,
    pub usb: u64,
    /// The slow oscillator inside, which the watchdog has.
    pub lsi: u64,
}

/// The port of the MCU that a host computer is connected to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkPort {
    /// A serial port: `2` is USART2.
    Serial(u8),
    /// The USB port, as a serial port of the communications class.
    Usb,
}

/// The bytes between MCU and host.
#[derive(Debug)]
pub(super) struct Link {
    pub port: LinkPort,
    pub to_mcu: VecDeque<u8>,
    pub from_mcu: Vec<(u64, u8)>,
    /// Whether a program on the host has the port open.
    pub is_open: bool,
}

/// Events and mistakes that matter to a user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// The MCU was reset.
    Reset {
        /// The time of the reset.
        at_ns: u64,
        /// The cause of the reset.
        cause: ResetCause,
    },
    /// The program used a peripheral whose clock is off: reads gave 0, writes were lost. Reported once for each
    /// peripheral.
    ClockOff {
        /// The time of the access.
        at_ns: u64,
        /// The peripheral's address.
        address: u32,
        /// The address of the instruction, or one near it.
        pc: u32,
    },
    /// The program used an address of a peripheral that is not modelled. Reported once for each peripheral.
    NotModelled {
        /// The time of the access.
        at_ns: u64,
        /// The address.
        address: u32,
        /// The address of the instruction, or one near it.
        pc: u32,
    },
}

/// The cause of a reset of the MCU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResetCause {
    /// The supply was lost.
    Power,
    /// The independent watchdog was not reloaded in time.
    Watchdog,
    /// The program requested it.
    Software,
}

/// The state that the devices share.
pub(super) struct Wires {
    pub now: u64,
    pub clocks: Clocks,
    /// The frequencies of units that select their clock, by their names.
    pub kernels: BTreeMap<&'static str, u64>,
    pub gpio: Gpio,
    pub link: Link,
    pub events: Vec<Event>,
    /// The timers whose trigger output has fired since the chip last looked, one bit each.
    pub triggers: u32,
    /// A counter of changes after which the world may have other edges.
    pub version: u64,
    /// The number of items left in the stream of each I2C unit's receiver: it refuses the byte after the last one.
    pub i2c_left: Vec<Option<u32>>,
    world: Arc<Mutex<dyn Surroundings>>,
    /// The holders of each interrupt's line, one bit each.
    holders: [u16; IRQS],
    changed: Vec<(u16, bool)>,
}

/// The most interrupts that an MCU has.
const IRQS: usize = 102;

impl Wires {
    pub(super) fn new(
        world: Arc<Mutex<dyn Surroundings>>,
        port: LinkPort,
        clocks: Clocks,
        mcu: &Mcu,
    ) -> Self {
        let link = Link { port, to_mcu: VecDeque::new(), from_mcu: Vec::new(), is_open: true };
        Self {
            now: 0,
            clocks,
            kernels: BTreeMap::new(),
            gpio: Gpio::new(mcu),
            link,
            events: Vec::new(),
            triggers: 0,
            version: 0,
            i2c_left: vec![None; mcu.last(&["I2C"])],
            world,
            holders: [0; IRQS],
            changed: Vec::new(),
        }
    }

    /// The frequency of the clock that a unit has selected, if it has a choice.
    pub(super) fn kernel_hz(&self, unit: &str) -> Option<u64> {
        self.kernels.get(unit).copied()
    }

    /// Calls the world.
    pub(super) fn world<T>(&self, ask: impl FnOnce(&mut dyn Surroundings, u64) -> T) -> T {
        let mut world = self.world.lock().unwrap_or_else(PoisonError::into_inner);
        ask(&mut *world, self.now)
    }

    /// Records whether one of several devices on a line holds it.
    pub(super) fn interrupt(&mut self, irq: u16, holder: u8, is_held: bool) {
        let Some(holders) = self.holders.get_mut(usize::from(irq)) else { return };
        let before = *holders;
        let bit = 1 << holder;
        *holders = if is_held { before | bit } else { before & !bit };
        if (before == 0) != (*holders == 0) {
            self.changed.push((irq, *holders != 0));
        }
    }

    /// The lines that have changed since the last call.
    pub(super) fn take_changed(&mut self) -> Vec<(u16, bool)> {
        std::mem::take(&mut self.changed)
    }

    pub(super) fn has_changed_lines(&self) -> bool {
        !self.changed.is_empty()
    }

    /// The pad that a peripheral's signal is on, as in `TIM3_CH1`.
    pub(super) fn pad_of(&self, wire: &str) -> Option<Pad> {
        self.gpio.pad_of(wire)
    }

    /// The level on a pad, whatever drives it.
    pub(super) fn level(&self, pad: Pad) -> bool {
        if let Some(level) = self.gpio.drives(pad) {
            return level;
        }
        let outside = self.world(|world, now| world.level(pad, now));
        outside.unwrap_or_else(|| self.gpio.is_pulled_up(pad))
    }

    /// The next change of a pad from outside.
    pub(super) fn next_edge(&self, pad: Pad, after: u64) -> Option<(u64, bool)> {
        let edge = self.world(|world, _| world.next_edge(pad, after))?;
        // An edge in the past would make the time stand still.
        Some((edge.0.max(after.saturating_add(1)), edge.1))
    }

    /// Passes the MCU's changed outputs to the world.
    pub(super) fn report_outputs(&mut self) {
        let changes = self.gpio.take_changes();
        for (pad, level) in &changes {
            self.world(|world, now| world.driven(*pad, *level, now));
        }
        if !changes.is_empty() {
            self.version += 1;
        }
    }
}

/// The time that `count` periods of `hz` take, rounded up.
pub(super) fn periods_ns(count: u64, hz: u64) -> u64 {
    let ns = (u128::from(count) * u128::from(SECOND_NS)).div_ceil(u128::from(hz.max(1)));
    u64::try_from(ns).unwrap_or(NEVER)
}

/// The number of whole periods of `hz` in a time.
pub(super) fn periods_in(ns: u64, hz: u64) -> u64 {
    u64::try_from(u128::from(ns) * u128::from(hz) / u128::from(SECOND_NS)).unwrap_or(NEVER)
}
