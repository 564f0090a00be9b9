//! The full-speed device of STM32F1 and G4 (and F0, F3, L0, L1, L4): eight endpoints, and a memory for packets between
//! the program and the bus.
//!
//! A register of an endpoint has bits that a 1 turns over and bits that only a 0 clears (RM0008, 23.5). What is told
//! apart by them, the two kinds of data packets too, is modelled: a packet of the wrong kind is acknowledged and lost,
//! as on the bus. Not modelled are suspension, isochronous and double-buffered endpoints.
//!
//! The unit of STM32G4 pulls the bus up when the program says so. Where the board does that itself, a host is taken to
//! find the device whenever the unit is on.

use super::host::Host;
use super::unit::{Function, Usb};
use crate::mcu::Mcu;
use crate::registers::merge;
use crate::wires::{LinkPort, Wires};

const ENDPOINTS: usize = 8;
/// The frequency that the unit needs, and how far it may be off: 0.25 %.
const USB_HZ: u64 = 48_000_000;
const USB_OFF_HZ: u64 = 120_000;
/// The unit shares its interrupt with a CAN unit.
const HOLDER: u8 = 1;

/// The registers behind those of the endpoints.
const CNTR: u32 = 0x40;
const ISTR: u32 = 0x44;
const FNR: u32 = 0x48;
const DADDR: u32 = 0x4C;
const BTABLE: u32 = 0x50;
const BCDR: u32 = 0x58;
/// The bit of BCDR that pulls the bus up.
const PULLS_UP: u32 = 1 << 15;
/// Bits of CNTR: the unit is held in reset, or has no power.
const FORCED_RESET: u32 = 1;
const POWER_DOWN: u32 = 1 << 1;
/// Bits of ISTR; those from the eighth on have their enable bits at the same place in CNTR.
const FROM_HOST: u32 = 1 << 4;
const SOF: u32 = 1 << 9;
const BUS_RESET: u32 = 1 << 10;
const TRANSFERRED: u32 = 1 << 15;
const ENABLES: u32 = 0xFF00;
/// The bit of DADDR that switches the device on.
const LISTENS: u32 = 1 << 7;
/// FNR: the data line that the pull-up resistor holds, and that frames come regularly.
const PULLED_UP: u32 = 1 << 15;
const LOCKED: u32 = 1 << 13;

/// Bits of an endpoint's register: those that only a 0 clears, those that a 1 turns over, and those that are written.
const RECEIVED: u32 = 1 << 15;
const SENT: u32 = 1 << 7;
const SETUP: u32 = 1 << 11;
const RX_DATA1: u32 = 1 << 14;
const TX_DATA1: u32 = 1 << 6;
const RX_STATE: u32 = 3 << 12;
const TX_STATE: u32 = 3 << 4;
const CLEARED_BY_ZERO: u32 = RECEIVED | SENT;
const TURNED_OVER: u32 = RX_DATA1 | TX_DATA1 | RX_STATE | TX_STATE;
const WRITTEN: u32 = 0x070F;
/// The states of an endpoint in one direction.
const DISABLED: u32 = 0;
const STALLED: u32 = 1;
const BUSY: u32 = 2;
const READY: u32 = 3;

/// The request of a host that chooses a configuration, which makes all endpoints begin with packets of the first kind.
const SET_CONFIGURATION: u8 = 9;

fn rx_state(register: u32) -> u32 {
    (register & RX_STATE) >> 12
}

fn tx_state(register: u32) -> u32 {
    (register & TX_STATE) >> 4
}

/// An endpoint's register after a write.
fn written(old: u32, value: u32, mask: u32) -> u32 {
    let value = value & mask | (old & WRITTEN | CLEARED_BY_ZERO) & !mask;
    let cleared = old & (value | !CLEARED_BY_ZERO);
    (cleared ^ value & TURNED_OVER) & !WRITTEN | value & WRITTEN
}

/// What the versions of the block differ in.
#[derive(Clone, Copy, Debug, Default)]
struct Layout {
    /// The words of the memory for packets.
    words: usize,
    /// The bytes in which the program sees each of them.
    bytes: u32,
    /// Whether the unit has the resistor that pulls the bus up.
    pulls_up: bool,
}

const F1: Layout = Layout { words: 256, bytes: 4, pulls_up: false };
const G4: Layout = Layout { words: 512, bytes: 2, pulls_up: true };

/// The unit, with the host at the other end of the cable.
#[derive(Debug, Default)]
pub(super) struct Device {
    irq: u16,
    layout: Layout,
    endpoints: [u32; ENDPOINTS],
    cntr: u32,
    istr: u32,
    daddr: u32,
    btable: u32,
    bcdr: u32,
    memory: Vec<u16>,
    /// The number of 1 ms frames since the bus was reset.
    frame: u32,
    host: Host,
    /// Whether the host expects, and will send, a packet of the second kind at each endpoint.
    expects_data1: [bool; ENDPOINTS],
    sends_data1: [bool; ENDPOINTS],
}

impl Device {
    pub(super) fn new(mcu: &Mcu) -> Self {
        let layout = if mcu.block("USB") == "usb_v3" { G4 } else { F1 };
        Self::with(mcu.irq("USB", "LP"), layout)
    }

    fn with(irq: u16, layout: Layout) -> Self {
        Self {
            irq,
            layout,
            cntr: FORCED_RESET | POWER_DOWN,
            memory: vec![0; layout.words],
            host: Host::new(),
            ..Self::default()
        }
    }

    fn is_connected(&self, wires: &Wires) -> bool {
        let is_pulled_up = !self.layout.pulls_up || self.bcdr & PULLS_UP != 0;
        let is_on = self.cntr & (FORCED_RESET | POWER_DOWN) == 0 && is_pulled_up;
        let is_in_time = wires.clocks.usb.abs_diff(USB_HZ) <= USB_OFF_HZ;
        is_on && is_in_time && wires.link.port == LinkPort::Usb
    }

    /// ISTR, with the first endpoint that has transferred something.
    fn status(&self) -> u32 {
        let has_any = |register: &u32| register & CLEARED_BY_ZERO != 0;
        let Some(number) = self.endpoints.iter().position(has_any) else { return self.istr };
        let direction = if self.endpoints[number] & RECEIVED == 0 { 0 } else { FROM_HOST };
        self.istr | TRANSFERRED | direction | u32::try_from(number).unwrap_or(0)
    }

    fn report(&self, wires: &mut Wires) {
        wires.interrupt(self.irq, HOLDER, self.status() & self.cntr & ENABLES != 0);
    }

    /// The register of an endpoint that is on in a direction, by the address that the program gave it.
    fn find(&self, endpoint: usize, state: impl Fn(u32) -> u32) -> Option<usize> {
        let is_it =
            |register: &u32| (register & 15) as usize == endpoint && state(*register) != DISABLED;
        self.endpoints.iter().position(is_it)
    }

    // --- the memory for packets ---

    fn word(&self, address: u32) -> u32 {
        self.memory.get((address / 2) as usize).copied().map_or(0, u32::from)
    }

    /// A word of an endpoint's row in the table of buffers: 0 is the address of what it sends and 1 the length, 2 and 3
    /// are those of what it receives.
    fn entry(&self, register: usize, at: u32) -> u32 {
        self.btable + 8 * u32::try_from(register).unwrap_or(0) + 2 * at
    }

    fn put_word(&mut self, address: u32, value: u32) {
        if let Some(word) = self.memory.get_mut((address / 2) as usize) {
            *word = (value & 0xFFFF) as u16;
        }
    }

    /// The bytes that an endpoint sends.
    fn outgoing(&self, register: usize) -> Vec<u8> {
        let [address, length] = [0, 1].map(|at| self.word(self.entry(register, at)));
        let byte = |at: u32| {
            let word = self.word(address + at);
            (if at.is_multiple_of(2) { word & 0xFF } else { word >> 8 }) as u8
        };
        (0..length & 0x3FF).map(byte).collect()
    }

    /// Puts bytes where an endpoint receives them, as far as its buffer has room.
    fn take_in(&mut self, register: usize, data: &[u8]) {
        let address = self.word(self.entry(register, 2));
        let length_at = self.entry(register, 3);
        let length = self.word(length_at);
        let blocks = length >> 10 & 31;
        let room = if length >> 15 == 0 { 2 * blocks } else { 32 * (blocks + 1) } as usize;
        let data = data.get(..room).unwrap_or(data);
        for (pair, at) in data.chunks(2).zip((address..).step_by(2)) {
            let pair = pair.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
            self.put_word(at, pair);
        }
        let count = u32::try_from(data.len()).unwrap_or(0);
        self.put_word(length_at, length & 0xFC00 | count);
    }
}

impl Function for Device {
    fn endpoints(&self) -> usize {
        ENDPOINTS
    }

    /// A reset of the bus leaves only what the program has to take.
    fn reset(&mut self) {
        for register in &mut self.endpoints {
            *register &= CLEARED_BY_ZERO;
        }
        (self.daddr, self.frame) = (0, 0);
        self.istr |= BUS_RESET;
        (self.expects_data1, self.sends_data1) = ([false; ENDPOINTS], [false; ENDPOINTS]);
    }

    fn enumerated(&mut self) {}

    fn start_frame(&mut self) {
        self.frame = (self.frame + 1) & 0x7FF;
        self.istr |= SOF;
    }

    fn hears(&self, address: u8) -> bool {
        self.daddr == LISTENS | u32::from(address)
    }

    fn setup(&mut self, packet: [u8; 8]) {
        let Some(number) = self.find(0, rx_state) else { return };
        self.take_in(number, &packet);
        // What follows is of the second kind, and waits until the program has read the request.
        let kept = self.endpoints[number] & (WRITTEN | SENT);
        let busy = BUSY << 12 | BUSY << 4;
        self.endpoints[number] = kept | RECEIVED | SETUP | RX_DATA1 | TX_DATA1 | busy;
        (self.expects_data1[0], self.sends_data1[0]) = (true, true);
        if packet[..2] == [0, SET_CONFIGURATION] {
            self.expects_data1[1..].fill(false);
            self.sends_data1[1..].fill(false);
        }
    }

    fn has_stalled(&self, endpoint: usize, is_in: bool) -> bool {
        let state = if is_in { tx_state } else { rx_state };
        self.find(endpoint, state).is_some_and(|at| state(self.endpoints[at]) == STALLED)
    }

    fn is_idle(&self) -> bool {
        let register = self.find(0, rx_state).map(|number| self.endpoints[number]);
        register.is_some_and(|register| register & CLEARED_BY_ZERO == 0)
    }

    fn send(&mut self, endpoint: usize, data: &[u8]) -> bool {
        let Some(number) = self.find(endpoint, rx_state) else { return false };
        let register = self.endpoints[number];
        if rx_state(register) != READY {
            return false;
        }
        let kind = self.sends_data1[endpoint];
        self.sends_data1[endpoint] = !kind;
        // The unit takes a packet of the wrong kind for one that it has already.
        if (register & RX_DATA1 != 0) == kind {
            self.take_in(number, data);
            let busy = register & !(RX_STATE | SETUP) | BUSY << 12;
            self.endpoints[number] = (busy ^ RX_DATA1) | RECEIVED;
        }
        true
    }

    fn fetch(&mut self, endpoint: usize) -> Option<Vec<u8>> {
        let number = self.find(endpoint, tx_state)?;
        let register = self.endpoints[number];
        if tx_state(register) != READY {
            return None;
        }
        self.endpoints[number] = ((register & !TX_STATE | BUSY << 4) ^ TX_DATA1) | SENT;
        // So does the host.
        if (register & TX_DATA1 != 0) != self.expects_data1[endpoint] {
            return None;
        }
        self.expects_data1[endpoint] ^= true;
        Some(self.outgoing(number))
    }
}

impl Usb for Device {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::with(self.irq, self.layout);
        self.report(wires);
    }

    fn deadline(&self) -> u64 {
        self.host.next_ns
    }

    fn advance(&mut self, wires: &mut Wires) {
        let mut host = std::mem::replace(&mut self.host, Host::new());
        while host.next_ns <= wires.now {
            host.act(self, wires);
        }
        self.host = host;
        self.report(wires);
    }

    fn read(&mut self, offset: u32, _: &mut Wires) -> u32 {
        match offset {
            0x00..CNTR => self.endpoints.get((offset / 4) as usize).copied().unwrap_or(0),
            CNTR => self.cntr,
            ISTR => self.status(),
            FNR => PULLED_UP | if self.frame == 0 { 0 } else { LOCKED } | self.frame,
            DADDR => self.daddr,
            BTABLE => self.btable,
            BCDR => self.bcdr,
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        match offset {
            0x00..CNTR => {
                if let Some(register) = self.endpoints.get_mut((offset / 4) as usize) {
                    *register = written(*register, value, mask);
                }
            }
            CNTR => {
                let was = self.cntr;
                self.cntr = merge(was, value, mask) & 0xFF1F;
                if self.cntr & !was & FORCED_RESET != 0 {
                    self.reset();
                }
            }
            ISTR => self.istr &= value | !mask,
            DADDR => self.daddr = merge(self.daddr, value, mask) & 0xFF,
            BTABLE => self.btable = merge(self.btable, value, mask) & 0xFFF8,
            BCDR if self.layout.pulls_up => self.bcdr = merge(self.bcdr, value, mask),
            _ => {}
        }
        if matches!(offset, CNTR | BCDR) {
            let is_connected = self.is_connected(wires);
            self.host.plugged(is_connected, wires.now);
        }
        self.report(wires);
    }

    fn read_memory(&self, offset: u32) -> u32 {
        let address = offset / (self.layout.bytes / 2);
        let next = if self.layout.bytes == 2 { self.word(address + 2) << 16 } else { 0 };
        self.word(address) | next
    }

    /// Where each word takes four bytes, the upper half of these is not there.
    fn write_memory(&mut self, offset: u32, value: u32, mask: u32) {
        let address = offset / (self.layout.bytes / 2);
        let word = merge(self.word(address), value, mask & 0xFFFF);
        self.put_word(address, word);
        if self.layout.bytes == 2 {
            let next = merge(self.word(address + 2), value >> 16, mask >> 16);
            self.put_word(address + 2, next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A control endpoint that receives up to 64 bytes at 0x40 and sends from 0x80, and a bulk endpoint with room for
    /// two bytes behind them, both ready for the host.
    fn device() -> Device {
        let mut usb = Device::with(20, F1);
        usb.daddr = LISTENS;
        let words = [0x80, 0, 0x40, 1 << 15 | 1 << 10, 0xC0, 0, 0xD0, 1 << 10];
        for (at, word) in (0..).zip(words) {
            usb.write_memory(4 * at, word, u32::MAX);
        }
        usb.endpoints[0] = written(0, 1 << 9 | READY << 12 | BUSY << 4, u32::MAX);
        usb.endpoints[1] = written(0, 2 | READY << 12 | BUSY << 4, u32::MAX);
        usb
    }

    #[test]
    fn bits_are_turned_over_cleared_by_zero_and_written() {
        let old = RECEIVED | SENT | RX_DATA1 | READY << 12 | BUSY << 4 | SETUP | 2;
        // Ones that turn nothing over and clear nothing: only what is written changes.
        assert_eq!(written(old, CLEARED_BY_ZERO | 3 | 1 << 9, u32::MAX), old & !15 | 3 | 1 << 9);
        assert_eq!(written(old, RECEIVED | 2, u32::MAX), old & !SENT);
        // BUSY and READY differ in one bit, and writing the register's own value clears what a 1 turns over.
        assert_eq!(tx_state(written(old, CLEARED_BY_ZERO | 1 << 4 | 2, u32::MAX)), READY);
        assert_eq!(written(old, old, u32::MAX), RECEIVED | SENT | SETUP | 2);
        // A byte changes nothing in the other.
        assert_eq!(written(old, SENT | 5, 0xFF), old & !15 | 5);
    }

    #[test]
    fn a_request_waits_to_be_read() {
        let mut usb = device();
        assert!(usb.hears(0) && !usb.hears(7) && usb.is_idle());
        usb.setup([1, 2, 3, 4, 5, 6, 7, 8]);
        assert!(!usb.is_idle());
        assert_eq!(usb.status(), TRANSFERRED | FROM_HOST);
        assert_eq!(usb.endpoints[0] & SETUP, SETUP);
        let words: Vec<u32> = (0..4).map(|at| usb.read_memory(0x80 + 4 * at)).collect();
        assert_eq!(words, [0x0201, 0x0403, 0x0605, 0x0807]);
        assert_eq!(usb.read_memory(12), 1 << 15 | 1 << 10 | 8);
        // Three bytes as an answer, of the second kind; until then the endpoint holds the host back.
        assert_eq!(usb.fetch(0), None);
        for (at, word) in [(0x80, 0x0B0A), (0x82, 0x0D0C), (0x02, 3)] {
            usb.put_word(at, word);
        }
        usb.endpoints[0] = written(usb.endpoints[0], SENT | 1 << 4 | 1 << 9, u32::MAX);
        assert!(usb.is_idle());
        assert_eq!(usb.fetch(0), Some(vec![0x0A, 0x0B, 0x0C]));
        assert_eq!((usb.status(), usb.fetch(0)), (TRANSFERRED, None));
        // The other direction refuses, which does not stop this one.
        usb.endpoints[0] = written(usb.endpoints[0], RECEIVED | (BUSY ^ STALLED) << 12, u32::MAX);
        assert!(usb.has_stalled(0, false) && !usb.has_stalled(0, true));
    }

    #[test]
    fn packets_of_the_wrong_kind_are_lost() {
        let mut usb = device();
        assert!(usb.send(2, &[1, 2, 3]));
        // The buffer has two bytes; the register is the second one, the endpoint's address is 2.
        assert_eq!((usb.read_memory(0x1A0), usb.read_memory(28)), (0x0201, 1 << 10 | 2));
        assert_eq!(usb.status(), TRANSFERRED | FROM_HOST | 1);
        assert!(!usb.send(2, &[4]) && !usb.send(3, &[4]));
        // A program that turns over more than it should.
        let ready = 1 << 12 | RX_DATA1 | 2;
        usb.endpoints[1] = written(usb.endpoints[1], ready, u32::MAX);
        assert!(usb.send(2, &[4]));
        assert_eq!((usb.endpoints[1] & RECEIVED, usb.read_memory(0x1A0)), (0, 0x0201));
        assert!(usb.send(2, &[5]));
        assert_eq!((usb.read_memory(0x1A0) & 0xFF, usb.read_memory(28) & 0x3FF), (5, 1));
        usb.reset();
        assert!(!usb.hears(0) && usb.endpoints[1] == RECEIVED && usb.istr & BUS_RESET != 0);
    }
}
