//! Serial ports, with a file for the registers of each version of the block.
//!
//! In: accesses of the program, and bytes from the host or from a device, at the port's speed. Out: bytes at that
//! speed, interrupts, requests to the DMA.

mod names;
mod v2;
mod v4;

pub(crate) use self::names::place;
use self::names::{LOW_POWER, name};
use crate::mcu::Mcu;
use crate::ports::{PortState, Setting};
use crate::wires::{LinkPort, NEVER, Wires, periods_ns};

/// Flags, which SR and ISR have at the same places.
const OVERRUN: u32 = 1 << 3;
const IDLE: u32 = 1 << 4;
const RECEIVED: u32 = 1 << 5;
const COMPLETE: u32 = 1 << 6;
const EMPTY: u32 = 1 << 7;
const ERRORS: u32 = OVERRUN | 7;
/// Bits of CR1.
const RECEIVER: u32 = 1 << 2;
const TRANSMITTER: u32 = 1 << 3;
const IDLE_INTERRUPTS: u32 = 1 << 4;
const RECEIVED_INTERRUPTS: u32 = 1 << 5;
const COMPLETE_INTERRUPTS: u32 = 1 << 6;
const EMPTY_INTERRUPTS: u32 = 1 << 7;
/// Bits of CR3.
const ERROR_INTERRUPTS: u32 = 1;
const ONE_WIRE: u32 = 1 << 3;
const RECEIVES_BY_DMA: u32 = 1 << 6;
const TRANSMITS_BY_DMA: u32 = 1 << 7;

/// The versions of the block. The low-power ports have the last one's registers, and another unit of speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    V2,
    V4,
    LowPower,
}

/// The number of the first low-power port for the surroundings, whose numbers have one byte.
const LOW_POWER_NUMBER: usize = 128;

/// A serial port.
#[derive(Clone, Debug)]
pub(crate) struct Usart {
    place: usize,
    /// The port's number for the surroundings: `2` is USART2.
    unit: u8,
    mcu: &'static Mcu,
    version: Version,
    irq: u16,
    is_on_apb2: bool,
    sr: u32,
    brr: u32,
    cr: [u32; 3],
    gtpr: u32,
    rtor: u32,
    presc: u32,
    received: u8,
    waiting: Option<u8>,
    shifting: Option<u8>,
    shifted_at: u64,
    /// The earliest time at which the next byte can have arrived.
    listens_at: u64,
    /// Whether bytes came since the line was last idle.
    was_busy: bool,
    /// Whether SR was read, so that an access to DR clears flags.
    has_read_status: bool,
    name: String,
    tx: String,
    rx: String,
}

impl Usart {
    /// The port at a place, in its state after a reset.
    pub(crate) fn new(place: usize, mcu: &'static Mcu) -> Self {
        let name = name(place);
        let number = match place {
            LOW_POWER.. => LOW_POWER_NUMBER + place - LOW_POWER,
            _ => place + 1,
        };
        Self {
            place,
            unit: u8::try_from(number).unwrap_or(u8::MAX),
            mcu,
            version: match mcu.block(&name) {
                "usart_v4" if place >= LOW_POWER => Version::LowPower,
                "usart_v4" => Version::V4,
                _ => Version::V2,
            },
            irq: mcu.irq(&name, "GLOBAL"),
            is_on_apb2: mcu.is_on_apb2(&name),
            sr: EMPTY | COMPLETE,
            brr: 0,
            cr: [0; 3],
            gtpr: 0,
            rtor: 0,
            presc: 0,
            received: 0,
            waiting: None,
            shifting: None,
            shifted_at: NEVER,
            listens_at: NEVER,
            was_busy: false,
            has_read_status: false,
            tx: format!("{name}_TX"),
            rx: format!("{name}_RX"),
            name,
        }
    }

    /// Restarts it in its state after a reset.
    pub(crate) fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.place, self.mcu);
        self.report(wires);
    }

    fn is_on(&self) -> bool {
        let enable = if self.version == Version::V2 { v2::ENABLE } else { v4::ENABLE };
        self.cr[0] & enable != 0
    }

    /// The frequency of the clock that the divider counts.
    fn clock_hz(&self, wires: &Wires) -> u64 {
        let bus = if self.is_on_apb2 { wires.clocks.apb2 } else { wires.clocks.apb1 };
        let hz = wires.kernel_hz(&self.name).unwrap_or(bus) / v4::prescaler(self.presc);
        if self.version == Version::LowPower { 256 * hz } else { hz }
    }

    /// The number of clock periods in one bit.
    fn divider(&self) -> u64 {
        let is_by_8 = self.cr[0] >> 15 & 1 == 1 && self.version != Version::LowPower;
        let divider = if is_by_8 { (self.brr >> 4) * 8 + (self.brr & 7) } else { self.brr };
        u64::from(divider).max(1)
    }

    /// The bits of a character, with its parity.
    fn character_bits(&self) -> u8 {
        match (self.cr[0] >> 12 & 1, self.cr[0] >> 28 & 1) {
            (_, 1) if self.version != Version::V2 => 7,
            (1, _) => 9,
            _ => 8,
        }
    }

    fn frame_ns(&self, wires: &Wires) -> u64 {
        let stop = if self.cr[1] >> 13 & 1 == 1 { 2 } else { 1 };
        let bits = 1 + u64::from(self.character_bits()) + stop;
        periods_ns(self.divider() * bits, self.clock_hz(wires)).max(1)
    }

    /// Its settings, once it has started.
    pub(crate) fn state(&self, wires: &Wires) -> Option<PortState> {
        let [cr, stops, _] = self.cr;
        let odd_parity = (cr >> 10 & 1 == 1).then_some(cr >> 9 & 1 == 1);
        let setting = Setting::Serial {
            baud: self.clock_hz(wires) / self.divider(),
            data_bits: self.character_bits() - u8::from(odd_parity.is_some()),
            odd_parity,
            stop_bits: match stops >> 12 & 3 {
                0 => 1,
                2 => 2,
                _ => 0,
            },
        };
        self.is_on().then(|| PortState { unit: self.name.clone(), setting })
    }

    pub(crate) fn deadline(&self) -> u64 {
        self.shifted_at.min(self.listens_at)
    }

    pub(crate) fn advance(&mut self, wires: &mut Wires) {
        while self.shifted_at <= wires.now {
            let at = self.shifted_at;
            self.sent(wires);
            self.shift(at, wires);
        }
        while self.listens_at <= wires.now {
            self.listen(wires);
        }
        self.report(wires);
    }

    fn is_link(&self, wires: &Wires) -> bool {
        wires.link.port == LinkPort::Serial(self.unit)
    }

    /// Whether both directions are on the wire of TX.
    fn has_one_wire(&self) -> bool {
        self.cr[2] & ONE_WIRE != 0
    }

    fn sent(&mut self, wires: &mut Wires) {
        let Some(byte) = self.shifting.take() else { return };
        if wires.pad_of(&self.tx).is_none() {
            return;
        }
        if self.has_one_wire() && self.cr[0] & RECEIVER != 0 {
            self.receive(byte);
        }
        if self.is_link(wires) {
            let at = self.shifted_at;
            wires.link.from_mcu.push((at, byte));
        } else {
            wires.world(|world, now| world.uart_out(self.unit, byte, now));
        }
    }

    fn shift(&mut self, at: u64, wires: &Wires) {
        self.shifted_at = NEVER;
        if let Some(byte) = self.waiting.take() {
            self.shifting = Some(byte);
            self.shifted_at = at + self.frame_ns(wires);
            self.sr |= EMPTY;
        } else {
            self.sr |= COMPLETE;
        }
    }

    fn listen(&mut self, wires: &mut Wires) {
        self.listens_at += self.frame_ns(wires);
        let wire = if self.has_one_wire() { &self.tx } else { &self.rx };
        if wires.pad_of(wire).is_none() {
            return;
        }
        let byte = if self.is_link(wires) {
            wires.link.to_mcu.pop_front()
        } else {
            wires.world(|world, now| world.uart_in(self.unit, now))
        };
        match byte {
            Some(byte) => self.receive(byte),
            None if self.was_busy => {
                self.sr |= IDLE;
                self.was_busy = false;
            }
            None => {}
        }
    }

    fn receive(&mut self, byte: u8) {
        if self.sr & RECEIVED != 0 {
            self.sr |= OVERRUN;
        } else {
            self.received = byte;
            self.sr |= RECEIVED;
        }
        self.was_busy = true;
    }

    fn report(&self, wires: &mut Wires) {
        let (sr, cr) = (self.sr, self.cr[0]);
        let holds = |enable: u32, flags: u32| cr & enable != 0 && sr & flags != 0;
        let by_flag = holds(EMPTY_INTERRUPTS, EMPTY)
            || holds(COMPLETE_INTERRUPTS, COMPLETE)
            || holds(RECEIVED_INTERRUPTS, RECEIVED | OVERRUN)
            || holds(IDLE_INTERRUPTS, IDLE)
            || (self.cr[2] & ERROR_INTERRUPTS != 0 && sr & ERRORS != 0);
        wires.interrupt(self.irq, 0, by_flag && self.is_on());
    }

    pub(crate) fn asks(&self, transmits: bool) -> bool {
        let is_ready = |enable: u32, flag: u32| self.cr[2] & enable != 0 && self.sr & flag != 0;
        if transmits {
            is_ready(TRANSMITS_BY_DMA, EMPTY) && self.cr[0] & TRANSMITTER != 0
        } else {
            is_ready(RECEIVES_BY_DMA, RECEIVED)
        }
    }

    pub(crate) fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match self.version {
            Version::V2 => self.read_v2(offset),
            Version::V4 | Version::LowPower => self.read_v4(offset),
        };
        self.report(wires);
        value
    }

    pub(crate) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        match self.version {
            Version::V2 => self.write_v2(offset, value, mask, wires),
            Version::V4 | Version::LowPower => self.write_v4(offset, value, mask, wires),
        }
        if !self.is_on() || self.cr[0] & RECEIVER == 0 {
            self.listens_at = NEVER;
        } else if self.listens_at == NEVER {
            self.listens_at = wires.now + self.frame_ns(wires);
        }
        self.report(wires);
    }

    fn transmit(&mut self, byte: u8, wires: &Wires) {
        self.sr &= !COMPLETE;
        if !self.is_on() || self.cr[0] & TRANSMITTER == 0 {
            return;
        }
        self.waiting = Some(byte);
        self.sr &= !EMPTY;
        if self.shifting.is_none() {
            self.shift(wires.now, wires);
        }
    }
}
