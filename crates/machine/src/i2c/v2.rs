//! The second version of the block (F0, F3, F7, G0, G4, H7, L4): the unit counts the bytes of a transfer, acknowledges
//! them, and stops by itself or when it is told to.
//!
//! The clock is held low while the unit waits for the program: for a byte to send, for room to receive one, or for what
//! comes after the last byte of a transfer (TC, TCR). Not modelled are slaves, ten-bit addresses, timeouts and PEC.

use super::{I2c, is_held};
use crate::mcu::Mcu;
use crate::ports::{PortState, Setting};
use crate::registers::merge;
use crate::wires::{NEVER, SECOND_NS, Wires, periods_ns};
use sensedsl_surroundings::{I2cEvent, I2cReply};

/// Fast mode plus.
const FASTEST_HZ: u64 = 1_000_000;
/// The shortest delay of the analog filter, and the fewest clocks until the unit sees an edge.
const FILTER_NS: u64 = 50;
const EDGE_CLOCKS: u64 = 2;
/// Bits of CR1; those from TXIE on enable the interrupts of flags.
const ENABLE: u32 = 1;
const EMPTY_INTERRUPTS: u32 = 1 << 1;
const RECEIVED_INTERRUPTS: u32 = 1 << 2;
const REFUSED_INTERRUPTS: u32 = 1 << 4;
const STOPPED_INTERRUPTS: u32 = 1 << 5;
const COMPLETE_INTERRUPTS: u32 = 1 << 6;
const UNFILTERED: u32 = 1 << 12;
const TRANSMITS_BY_DMA: u32 = 1 << 14;
const RECEIVES_BY_DMA: u32 = 1 << 15;
/// Bits of CR2.
const READS: u32 = 1 << 10;
const START: u32 = 1 << 13;
const STOP: u32 = 1 << 14;
const RELOAD: u32 = 1 << 24;
const STOPS_BY_ITSELF: u32 = 1 << 25;
/// Bits of ISR.
const EMPTY: u32 = 1;
const WANTED: u32 = 1 << 1;
const RECEIVED: u32 = 1 << 2;
const REFUSED: u32 = 1 << 4;
const STOPPED: u32 = 1 << 5;
const COMPLETE: u32 = 1 << 6;
const RELOADS: u32 = 1 << 7;
const BUSY: u32 = 1 << 15;
/// The flags that ICR clears. Errors of the bus itself do not occur.
const CLEARABLE: u32 = REFUSED | STOPPED | 0x3F00;

/// The present activity on the wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// None; the clock is held low if a transfer is under way.
    Rest,
    Addressing,
    Sending(u8),
    Receiving,
    Stopping,
    /// Something holds a wire low.
    Hung,
}

/// A bus.
#[derive(Debug)]
pub(super) struct Unit {
    unit: u8,
    mcu: &'static Mcu,
    irqs: [u16; 2],
    name: String,
    /// The names of its wires.
    lines: [String; 2],
    cr: [u32; 2],
    oar: [u32; 2],
    timing: u32,
    timeout: u32,
    isr: u32,
    rxdr: u8,
    txdr: Option<u8>,
    phase: Phase,
    until: u64,
    /// Whether the unit has started, and has not stopped yet.
    is_master: bool,
    /// Whether the present transfer reads.
    reads: bool,
    /// The number of bytes that the present transfer still has to move.
    left: u32,
    /// A received byte that waits for room in RXDR.
    behind: Option<u8>,
}

impl Unit {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let name = format!("I2C{unit}");
        Self {
            unit,
            mcu,
            irqs: ["EV", "ER"].map(|signal| mcu.irq(&name, signal)),
            lines: ["SCL", "SDA"].map(|line| format!("{name}_{line}")),
            name,
            cr: [0; 2],
            oar: [0; 2],
            timing: 0,
            timeout: 0,
            isr: EMPTY,
            rxdr: 0,
            txdr: None,
            phase: Phase::Rest,
            until: NEVER,
            is_master: false,
            reads: false,
            left: 0,
            behind: None,
        }
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        wires.kernel_hz(&self.name).unwrap_or(wires.clocks.apb1).max(1)
    }

    /// The shortest period of the bus's clock (RM0440, 41.4.10).
    fn bit_ns(&self, wires: &Wires) -> u64 {
        let field = |shift: u32, bits: u32| u64::from(self.timing >> shift & ((1 << bits) - 1)) + 1;
        let counted = (field(0, 8) + field(8, 8)) * field(28, 4);
        let filtered = u64::from(self.cr[0] >> 8 & 15);
        let clocks = counted + 2 * (EDGE_CLOCKS + filtered);
        let filter_ns = if self.cr[0] & UNFILTERED == 0 { 2 * FILTER_NS } else { 0 };
        periods_ns(clocks, self.clock_hz(wires)) + filter_ns
    }

    fn ask(&self, event: I2cEvent, wires: &Wires) -> I2cReply {
        wires.world(|world, now| world.i2c(self.unit, event, now))
    }

    fn begin(&mut self, phase: Phase, bits: u64, at: u64, wires: &Wires) {
        self.phase = phase;
        self.until = at + bits * self.bit_ns(wires);
    }

    fn hang(&mut self) {
        self.phase = Phase::Hung;
    }

    /// Ends the present activity on the wires.
    fn proceed(&mut self, at: u64, wires: &Wires) {
        match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest | Phase::Hung => {}
            Phase::Addressing => self.addressed(at, wires),
            Phase::Sending(byte) => match self.ask(I2cEvent::Write(byte), wires) {
                I2cReply::Ack | I2cReply::Byte(_) => self.moved(),
                I2cReply::Nack => self.refuse(at, wires),
                I2cReply::Stuck | I2cReply::Silent => self.hang(),
            },
            Phase::Receiving => {
                // The last byte is refused, unless more are to come.
                let ack = self.left > 1 || self.cr[1] & RELOAD != 0;
                match self.ask(I2cEvent::Read { ack }, wires) {
                    I2cReply::Byte(byte) => self.received(byte),
                    I2cReply::Ack | I2cReply::Nack => self.received(0xFF),
                    I2cReply::Stuck | I2cReply::Silent => self.hang(),
                }
            }
            Phase::Stopping => self.stopped(wires),
        }
    }

    fn addressed(&mut self, at: u64, wires: &Wires) {
        self.cr[1] &= !START;
        self.reads = self.cr[1] & READS != 0;
        self.left = self.cr[1] >> 16 & 0xFF;
        let address = u8::try_from(self.cr[1] >> 1 & 0x7F).unwrap_or(0);
        match self.ask(I2cEvent::Start { address, read: self.reads }, wires) {
            I2cReply::Ack | I2cReply::Byte(_) => {
                if self.left == 0 {
                    self.ended();
                }
            }
            I2cReply::Nack => self.refuse(at, wires),
            I2cReply::Stuck | I2cReply::Silent => self.hang(),
        }
    }

    /// A byte was refused: the unit stops by itself.
    fn refuse(&mut self, at: u64, wires: &Wires) {
        self.isr |= REFUSED;
        self.isr &= !WANTED;
        self.left = 0;
        self.begin(Phase::Stopping, 1, at, wires);
    }

    fn received(&mut self, byte: u8) {
        if self.isr & RECEIVED == 0 {
            self.rxdr = byte;
            self.isr |= RECEIVED;
        } else {
            self.behind = Some(byte);
        }
        self.moved();
    }

    fn moved(&mut self) {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 {
            self.ended();
        }
    }

    /// All bytes of a transfer have been moved: the program says how it goes on, unless the unit stops by itself.
    fn ended(&mut self) {
        if self.cr[1] & RELOAD != 0 {
            self.isr |= RELOADS;
        } else if self.cr[1] & STOPS_BY_ITSELF == 0 {
            self.isr |= COMPLETE;
        } else {
            self.cr[1] |= STOP;
        }
    }

    fn stopped(&mut self, wires: &Wires) {
        let reply = self.ask(I2cEvent::Stop, wires);
        self.cr[1] &= !(START | STOP);
        self.isr = self.isr & !(COMPLETE | RELOADS | WANTED) | STOPPED;
        self.is_master = false;
        if matches!(reply, I2cReply::Stuck | I2cReply::Silent) {
            self.hang();
        }
    }

    /// Starts the next activity if there is a reason for one.
    fn continue_at(&mut self, at: u64, wires: &Wires) {
        if self.phase != Phase::Rest || self.cr[0] & ENABLE == 0 {
            return;
        }
        if self.cr[1] & START != 0 {
            // A bus that something else holds is waited for; a repeated start needs no free bus.
            if !self.is_master && is_held(&self.lines, wires) {
                return;
            }
            self.is_master = true;
            self.isr &= !(COMPLETE | RELOADS);
            self.begin(Phase::Addressing, 10, at, wires);
        } else if self.is_master && self.cr[1] & STOP != 0 {
            self.begin(Phase::Stopping, 1, at, wires);
        } else if self.is_master && self.left > 0 && self.isr & (COMPLETE | RELOADS) == 0 {
            self.go_on(at, wires);
        }
    }

    /// Goes on with the next byte of a transfer.
    fn go_on(&mut self, at: u64, wires: &Wires) {
        if self.reads {
            if self.behind.is_none() {
                self.begin(Phase::Receiving, 9, at, wires);
            }
        } else if let Some(byte) = self.txdr.take() {
            self.isr = self.isr & !WANTED | EMPTY;
            self.begin(Phase::Sending(byte), 9, at, wires);
            // The next byte is wanted while this one is sent.
            if self.left > 1 {
                self.isr |= WANTED;
            }
        } else {
            self.isr |= WANTED;
        }
    }

    fn report(&self, wires: &mut Wires) {
        let holds = |enable: u32, flags: u32| self.cr[0] & enable != 0 && self.isr & flags != 0;
        let events = holds(EMPTY_INTERRUPTS, WANTED)
            || holds(RECEIVED_INTERRUPTS, RECEIVED)
            || holds(REFUSED_INTERRUPTS, REFUSED)
            || holds(STOPPED_INTERRUPTS, STOPPED)
            || holds(COMPLETE_INTERRUPTS, COMPLETE | RELOADS);
        wires.interrupt(self.irqs[0], 0, events);
    }

    fn take(&mut self) -> u32 {
        let byte = self.rxdr;
        self.isr &= !RECEIVED;
        if let Some(next) = self.behind.take() {
            self.rxdr = next;
            self.isr |= RECEIVED;
        }
        u32::from(byte)
    }

    fn status(&self, wires: &Wires) -> u32 {
        let is_on = self.cr[0] & ENABLE != 0;
        let is_busy = self.is_master || self.phase == Phase::Hung || is_held(&self.lines, wires);
        self.isr | if is_on && is_busy { BUSY } else { 0 }
    }

    /// Writes CR1. Switching off releases the bus, and clears flags and what the program has requested.
    fn control(&mut self, new: u32, wires: &Wires) {
        let was = self.cr[0];
        self.cr[0] = new;
        if was & ENABLE != 0 && new & ENABLE == 0 {
            if self.is_master {
                self.ask(I2cEvent::Stop, wires);
            }
            let kept = (self.cr[1] & !(START | STOP), self.oar, self.timing, self.timeout);
            *self = Self::new(self.unit, self.mcu);
            self.cr[0] = new;
            (self.cr[1], self.oar, self.timing, self.timeout) = kept;
        }
    }

    /// Writes CR2. The program sets START and STOP; only the unit clears them.
    fn command(&mut self, new: u32) {
        let was = self.cr[1];
        self.cr[1] = new | was & (START | STOP);
        if self.isr & RELOADS != 0 && new >> 16 & 0xFF != 0 {
            self.left = new >> 16 & 0xFF;
            self.isr &= !RELOADS;
        }
        if self.cr[1] & (START | STOP) != 0 {
            self.isr &= !COMPLETE;
        }
        // A stop that the program wants outside of a transfer has no effect.
        if !self.is_master && self.cr[1] & START == 0 {
            self.cr[1] &= !STOP;
        }
    }
}

impl I2c for Unit {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.unit, self.mcu);
        self.report(wires);
    }

    fn state(&self, wires: &Wires) -> Option<PortState> {
        let clock_hz = SECOND_NS / self.bit_ns(wires).max(1);
        let setting = Setting::I2c { clock_hz, fastest_hz: FASTEST_HZ };
        (self.cr[0] & ENABLE != 0).then(|| PortState { unit: self.name.clone(), setting })
    }

    fn deadline(&self) -> u64 {
        self.until
    }

    fn advance(&mut self, wires: &mut Wires) {
        while self.until <= wires.now {
            let at = self.until;
            self.until = NEVER;
            self.proceed(at, wires);
            self.continue_at(at, wires);
        }
        self.report(wires);
    }

    fn asks(&self, transmits: bool) -> bool {
        let is_ready = |enable: u32, flag: u32| self.cr[0] & enable != 0 && self.isr & flag != 0;
        if transmits {
            is_ready(TRANSMITS_BY_DMA, WANTED)
        } else {
            is_ready(RECEIVES_BY_DMA, RECEIVED)
        }
    }

    fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x08 | 0x0C => self.oar[((offset - 8) / 4) as usize],
            0x10 => self.timing,
            0x14 => self.timeout,
            0x18 => self.status(wires),
            0x24 => self.take(),
            0x28 => u32::from(self.txdr.unwrap_or(0)),
            _ => 0,
        };
        self.continue_at(wires.now, wires);
        self.report(wires);
        value
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => self.control(merge(self.cr[0], value, mask), wires),
            0x04 => self.command(merge(self.cr[1], value, mask)),
            0x08 | 0x0C => put(&mut self.oar[((offset - 8) / 4) as usize]),
            0x10 => put(&mut self.timing),
            0x14 => put(&mut self.timeout),
            // Writing EMPTY gives up the byte that waits.
            0x18 if value & mask & EMPTY != 0 => {
                self.txdr = None;
                self.isr |= EMPTY;
            }
            0x1C => self.isr &= !(value & mask & CLEARABLE),
            0x28 => {
                self.txdr = Some((value & 0xFF) as u8);
                self.isr &= !(EMPTY | WANTED);
            }
            _ => {}
        }
        self.continue_at(wires.now, wires);
        self.report(wires);
    }
}
