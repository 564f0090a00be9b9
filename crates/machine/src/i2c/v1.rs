//! The first version of the block (F1, F2, F4, L1): the program starts, addresses, acknowledges and stops.

use super::{I2c, is_held};
use crate::mcu::Mcu;
use crate::ports::{PortState, Setting};
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};
use sensedsl_surroundings::{I2cEvent, I2cReply};

/// Fast mode; this unit has no fast mode plus.
const FASTEST_HZ: u64 = 400_000;
/// Bits of SR1.
const STARTED: u32 = 1;
const ADDRESSED: u32 = 1 << 1;
const FINISHED: u32 = 1 << 2;
const RECEIVED: u32 = 1 << 6;
const EMPTY: u32 = 1 << 7;
const REFUSED: u32 = 1 << 10;
const ERRORS: u32 = 0xDF00;
/// Bits of SR2.
const MASTER: u32 = 1;
const BUSY: u32 = 1 << 1;
const TRANSMITS: u32 = 1 << 2;
/// Bits of CR1.
const ENABLE: u32 = 1;
const START: u32 = 1 << 8;
const STOP: u32 = 1 << 9;
const ACKNOWLEDGE: u32 = 1 << 10;
const NEXT: u32 = 1 << 11;
const RESET: u32 = 1 << 15;
/// Bits of CR2.
const DMA: u32 = 1 << 11;
const LAST: u32 = 1 << 12;

/// The present activity on the wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// None, or the clock is held low until the program acts.
    Rest,
    Starting,
    Addressing(u8),
    Sending(u8),
    Receiving {
        ack: bool,
    },
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
    cr: [u32; 2],
    oar: [u32; 2],
    sr1: u32,
    sr2: u32,
    ccr: u32,
    trise: u32,
    dr: u8,
    /// A received byte that waits for room in DR.
    behind: Option<u8>,
    waiting: Option<u8>,
    phase: Phase,
    until: u64,
    has_read_status: bool,
    /// Whether a byte was refused, by either side: no more of them come.
    has_ended: bool,
    /// The acknowledge bit as it was one byte ago; POS delays it by one byte.
    acknowledged: bool,
    /// The names of its wires.
    lines: [String; 2],
}

impl Unit {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let own = format!("I2C{unit}");
        Self {
            unit,
            mcu,
            irqs: ["EV", "ER"].map(|signal| mcu.irq(&own, signal)),
            cr: [0; 2],
            oar: [0x4000, 0],
            sr1: 0,
            sr2: 0,
            ccr: 0,
            trise: 2,
            dr: 0,
            behind: None,
            waiting: None,
            phase: Phase::Rest,
            until: NEVER,
            has_read_status: false,
            has_ended: false,
            acknowledged: false,
            lines: ["SCL", "SDA"].map(|line| format!("{own}_{line}")),
        }
    }

    /// The number of the unit's clock periods in one of the bus.
    fn divider(&self) -> u64 {
        let parts = match self.ccr >> 14 & 3 {
            2 => 3,
            3 => 25,
            _ => 2,
        };
        u64::from(self.ccr & 0xFFF).max(1) * parts
    }

    fn bit_ns(&self, wires: &Wires) -> u64 {
        periods_ns(self.divider(), wires.clocks.apb1).max(1)
    }

    fn ask(&self, event: I2cEvent, wires: &Wires) -> I2cReply {
        wires.world(|world, now| world.i2c(self.unit, event, now))
    }

    fn hang(&mut self) {
        self.phase = Phase::Hung;
        self.sr2 |= BUSY;
    }

    /// Ends the present activity on the wires.
    fn proceed(&mut self, wires: &Wires) {
        let phase = std::mem::replace(&mut self.phase, Phase::Rest);
        match phase {
            Phase::Rest | Phase::Hung => {}
            Phase::Starting => {
                self.cr[0] &= !START;
                self.sr1 = (self.sr1 & !(EMPTY | FINISHED)) | STARTED;
                self.sr2 = (self.sr2 | MASTER | BUSY) & !TRANSMITS;
                (self.behind, self.waiting, self.has_ended) = (None, None, false);
            }
            Phase::Addressing(byte) => self.addressed(byte, wires),
            Phase::Sending(byte) => match self.ask(I2cEvent::Write(byte), wires) {
                I2cReply::Ack | I2cReply::Byte(_) => {
                    if self.waiting.is_none() {
                        self.sr1 |= FINISHED;
                    }
                }
                I2cReply::Nack => self.refuse(),
                I2cReply::Stuck | I2cReply::Silent => self.hang(),
            },
            Phase::Receiving { ack } => match self.ask(I2cEvent::Read { ack }, wires) {
                I2cReply::Byte(byte) => self.received(byte, ack),
                I2cReply::Ack | I2cReply::Nack => self.received(0xFF, ack),
                I2cReply::Stuck | I2cReply::Silent => self.hang(),
            },
            Phase::Stopping => self.stopped(wires),
        }
    }

    fn addressed(&mut self, byte: u8, wires: &Wires) {
        let read = byte & 1 == 1;
        match self.ask(I2cEvent::Start { address: byte >> 1, read }, wires) {
            I2cReply::Ack | I2cReply::Byte(_) => {
                // From here on, the data register of a transmitter is empty.
                self.sr1 |= if read { ADDRESSED } else { ADDRESSED | EMPTY };
                self.sr2 = (self.sr2 & !TRANSMITS) | if read { 0 } else { TRANSMITS };
            }
            I2cReply::Nack => self.refuse(),
            I2cReply::Stuck | I2cReply::Silent => self.hang(),
        }
    }

    /// Nothing more goes over the bus until a stop or a start, even if the flag is cleared before.
    fn refuse(&mut self) {
        self.sr1 |= REFUSED;
        self.has_ended = true;
    }

    fn received(&mut self, byte: u8, ack: bool) {
        if self.sr1 & RECEIVED == 0 {
            self.dr = byte;
            self.sr1 |= RECEIVED;
        } else {
            self.behind = Some(byte);
            self.sr1 |= FINISHED;
        }
        self.has_ended = !ack;
    }

    fn stopped(&mut self, wires: &Wires) {
        let reply = self.ask(I2cEvent::Stop, wires);
        self.cr[0] &= !STOP;
        self.sr1 &= !(STARTED | ADDRESSED | FINISHED | EMPTY);
        self.sr2 = 0;
        if matches!(reply, I2cReply::Stuck | I2cReply::Silent) {
            self.hang();
        }
    }

    /// Starts the next activity if the program has requested one.
    fn continue_at(&mut self, at: u64, wires: &Wires) {
        if self.phase != Phase::Rest || self.cr[0] & ENABLE == 0 {
            return;
        }
        let bit = self.bit_ns(wires);
        let (one, byte_end) = (at + bit, at + 9 * bit);
        let is_master = self.sr2 & MASTER != 0;
        if self.sr1 & (STARTED | ADDRESSED) != 0 && self.cr[0] & STOP == 0 {
            return;
        }
        let transmits = self.sr2 & TRANSMITS != 0;
        if is_master && transmits && !self.has_ended && self.waiting.is_some() {
            if let Some(byte) = self.waiting.take() {
                (self.phase, self.until) = (Phase::Sending(byte), byte_end);
                self.sr1 |= EMPTY;
            }
        } else if is_master && self.cr[0] & STOP != 0 {
            (self.phase, self.until) = (Phase::Stopping, one);
        } else if self.cr[0] & START != 0 {
            if !is_master && is_held(&self.lines, wires) {
                self.sr2 |= BUSY;
                return;
            }
            (self.phase, self.until) = (Phase::Starting, one);
        } else if is_master && !transmits && !self.has_ended && self.behind.is_none() {
            let ack = self.acknowledges(wires);
            (self.phase, self.until) = (Phase::Receiving { ack }, byte_end);
            self.acknowledged = self.cr[0] & ACKNOWLEDGE != 0;
        }
    }

    /// Whether the next byte is acknowledged.
    fn acknowledges(&self, wires: &Wires) -> bool {
        let left = wires.i2c_left.get(usize::from(self.unit) - 1).copied().flatten();
        // A byte that the DMA has not taken yet still counts.
        let taken_soon = u32::from(self.sr1 & RECEIVED != 0) + u32::from(self.behind.is_some());
        if self.cr[1] & (DMA | LAST) == DMA | LAST
            && left.is_some_and(|left| left <= 1 + taken_soon)
        {
            return false;
        }
        if self.cr[0] & NEXT != 0 { self.acknowledged } else { self.cr[0] & ACKNOWLEDGE != 0 }
    }

    fn report(&self, wires: &mut Wires) {
        let events = self.sr1 & 0x1F != 0
            || (self.cr[1] >> 10 & 1 == 1 && self.sr1 & (EMPTY | RECEIVED) != 0);
        wires.interrupt(self.irqs[0], 0, self.cr[1] >> 9 & 1 == 1 && events);
        let errors = self.cr[1] >> 8 & 1 == 1 && self.sr1 & ERRORS != 0;
        wires.interrupt(self.irqs[1], 0, errors);
    }

    fn take(&mut self, wires: &Wires) -> u32 {
        let byte = self.dr;
        self.sr1 &= !(RECEIVED | FINISHED);
        if let Some(next) = self.behind.take() {
            self.dr = next;
            self.sr1 |= RECEIVED;
        }
        self.continue_at(wires.now, wires);
        u32::from(byte)
    }

    /// Reads SR2; a read of it after SR1 ends the address phase.
    fn status2(&mut self, wires: &Wires) -> u32 {
        let mut value = self.sr2;
        if self.phase == Phase::Rest && self.sr2 & MASTER == 0 && self.cr[0] & ENABLE != 0 {
            value = if is_held(&self.lines, wires) { value | BUSY } else { value & !BUSY };
            self.sr2 = value;
        }
        if self.sr1 & ADDRESSED != 0 && self.has_read_status {
            self.sr1 &= !ADDRESSED;
            self.acknowledged = self.cr[0] & ACKNOWLEDGE != 0;
            self.continue_at(wires.now, wires);
        }
        self.has_read_status = false;
        value
    }

    fn control(&mut self, new: u32, wires: &Wires) {
        let was = self.cr[0];
        self.cr[0] = new;
        if new & RESET != 0 || (was & ENABLE != 0 && new & ENABLE == 0) {
            // The chips on the bus see it released.
            if self.sr2 & MASTER != 0 {
                self.ask(I2cEvent::Stop, wires);
            }
            let kept = (self.cr[1], self.oar, self.ccr, self.trise);
            *self = Self::new(self.unit, self.mcu);
            self.cr[0] = new & !(START | STOP);
            // A reset clears all settings; switching off clears none.
            if new & RESET == 0 {
                (self.cr[1], self.oar, self.ccr, self.trise) = kept;
            }
        }
    }

    fn put(&mut self, byte: u8, wires: &Wires) {
        if self.sr1 & STARTED != 0 {
            self.sr1 &= !STARTED;
            self.has_read_status = false;
            self.phase = Phase::Addressing(byte);
            self.until = wires.now + 9 * self.bit_ns(wires);
            return;
        }
        self.sr1 &= !(EMPTY | FINISHED);
        self.waiting = Some(byte);
    }
}

impl I2c for Unit {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.unit, self.mcu);
        self.report(wires);
    }

    fn state(&self, wires: &Wires) -> Option<PortState> {
        let [cr, _] = self.cr;
        let clock_hz = wires.clocks.apb1 / self.divider();
        let setting = Setting::I2c { clock_hz, fastest_hz: FASTEST_HZ };
        (cr & ENABLE != 0).then(|| PortState { unit: format!("I2C{}", self.unit), setting })
    }

    fn deadline(&self) -> u64 {
        self.until
    }

    fn advance(&mut self, wires: &mut Wires) {
        while self.until <= wires.now {
            let at = self.until;
            self.until = NEVER;
            self.proceed(wires);
            self.continue_at(at, wires);
        }
        self.report(wires);
    }

    fn asks(&self, transmits: bool) -> bool {
        let is_on = self.cr[1] & DMA != 0 && self.cr[0] & ENABLE != 0;
        let flag = if transmits { EMPTY } else { RECEIVED };
        is_on && self.sr1 & flag != 0 && (self.sr2 & TRANSMITS != 0) == transmits
    }

    fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x08 | 0x0C => self.oar[((offset - 8) / 4) as usize],
            0x10 => self.take(wires),
            0x14 => {
                self.has_read_status = true;
                self.sr1
            }
            0x18 => self.status2(wires),
            0x1C => self.ccr,
            0x20 => self.trise,
            _ => 0,
        };
        self.report(wires);
        value
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        match offset {
            0x00 => self.control(merge(self.cr[0], value, mask), wires),
            0x04 => self.cr[1] = merge(self.cr[1], value, mask),
            0x08 | 0x0C => {
                let register = &mut self.oar[((offset - 8) / 4) as usize];
                *register = merge(*register, value, mask);
            }
            0x10 => self.put((value & 0xFF) as u8, wires),
            // Only errors can be cleared by writing 0.
            0x14 => self.sr1 &= value | !mask | !ERRORS,
            0x1C => self.ccr = merge(self.ccr, value, mask),
            0x20 => self.trise = merge(self.trise, value, mask),
            _ => {}
        }
        self.continue_at(wires.now, wires);
        self.report(wires);
    }
}
