//! `OTG_FS` as a device: endpoints and FIFOs as the program sees them.

use std::collections::VecDeque;

use super::host::Host;
use super::unit::{Function, Usb};
use crate::mcu::Mcu;
use crate::registers::merge;
use crate::wires::{LinkPort, NEVER, Wires};

/// The number of endpoints in each direction.
const ENDPOINTS: usize = 4;
/// The memory of all FIFOs together.
const FIFO_BYTES: usize = 1280;
/// Interrupts of the core (GINTSTS).
const SOF: u32 = 1 << 3;
const RECEIVED: u32 = 1 << 4;
const IN_ENDPOINT: u32 = 1 << 18;
const OUT_ENDPOINT: u32 = 1 << 19;
const BUS_RESET: u32 = 1 << 12;
const ENUMERATED: u32 = 1 << 13;
const SESSION: u32 = 1 << 30;
/// The time until the comparators have detected the bus voltage.
const SENSING_NS: u64 = 100_000;
/// The bits that software clears by writing 1.
const CLEARED_BY_ONE: u32 = 0xF070_FC0A;
/// Bits of an endpoint's control register.
const ENABLE: u32 = 1 << 31;
const DISABLE: u32 = 1 << 30;
const SET_NAK: u32 = 1 << 27;
const CLEAR_NAK: u32 = 1 << 26;
const STALL: u32 = 1 << 21;
const ACTIVE: u32 = 1 << 15;
const NAK: u32 = 1 << 17;
/// Interrupts of an endpoint.
const TRANSFERRED: u32 = 1;
const DISABLED: u32 = 1 << 1;
const SETUP: u32 = 1 << 3;
const FIFO_EMPTY: u32 = 1 << 7;

/// The contents of the receive FIFO, by the code in its status word.
const OUT_DATA: u32 = 2;
const OUT_COMPLETE: u32 = 3;
const SETUP_COMPLETE: u32 = 4;
const SETUP_DATA: u32 = 6;

/// An endpoint in one direction.
#[derive(Clone, Debug, Default)]
struct Endpoint {
    control: u32,
    interrupts: u32,
    size: u32,
    /// The bytes that wait to be sent.
    fifo: VecDeque<u8>,
}

impl Endpoint {
    fn left(&self) -> u32 {
        self.size & 0x7_FFFF
    }

    fn packets(&self) -> u32 {
        self.size >> 19 & 0x3FF
    }

    fn take(&mut self, bytes: u32) {
        let (left, packets) = (self.left().saturating_sub(bytes), self.packets().saturating_sub(1));
        self.size = (self.size & 0xE000_0000) | packets << 19 | left;
    }

    /// The control register; the control endpoint, number 0, is always active.
    fn control_of(&self, number: usize) -> u32 {
        self.control | if number == 0 { ACTIVE } else { 0 }
    }

    /// Writes the control register; some bits are commands.
    fn command(&mut self, value: u32, mask: u32) {
        let was = self.control;
        let new = merge(was & (ENABLE | NAK), value, mask & !NAK);
        let mut control = new & !(DISABLE | SET_NAK | CLEAR_NAK) & !NAK;
        // Writing 0 does not switch an endpoint off.
        control |= was & ENABLE;
        let is_quiet = (was & NAK != 0 || new & SET_NAK != 0) && new & CLEAR_NAK == 0;
        control |= if is_quiet { NAK } else { 0 };
        if new & DISABLE != 0 {
            control &= !ENABLE;
            self.interrupts |= DISABLED;
        }
        self.control = control;
    }
}

/// The USB port.
#[derive(Debug, Default)]
pub(super) struct Otg {
    irq: u16,
    registers: Vec<u32>,
    status: u32,
    ins: [Endpoint; ENDPOINTS],
    outs: [Endpoint; ENDPOINTS],
    /// The status words that the program has not taken, each with its data.
    received: VecDeque<(u32, Vec<u8>)>,
    /// The data of the entry that was taken last.
    reading: VecDeque<u8>,
    host: Host,
    /// The number of 1 ms frames since the bus was reset.
    frame: u32,
    /// The time at which the bus voltage is detected.
    session_ns: u64,
}

impl Otg {
    pub(super) fn new(mcu: &Mcu) -> Self {
        Self::with(mcu.irq("USB_OTG_FS", "GLOBAL"))
    }

    fn with(irq: u16) -> Self {
        Self {
            irq,
            registers: vec![0; 0x1000 / 4],
            status: 0x0400_0020,
            host: Host::new(),
            session_ns: NEVER,
            ..Self::default()
        }
    }

    fn register(&self, offset: u32) -> u32 {
        self.registers.get((offset / 4) as usize).copied().unwrap_or(0)
    }

    /// Whether the transceiver is on, its pads are switched to it, and the program has enabled the connection.
    fn is_connected(&self, wires: &Wires) -> bool {
        let configuration = self.register(0x38);
        let is_on = configuration >> 16 & 1 == 1 && configuration & (1 << 19 | 1 << 21) != 0;
        let is_wanted = self.register(0x804) & 2 == 0;
        let has_pads =
            ["DP", "DM"].iter().all(|wire| wires.pad_of(&format!("USB_OTG_FS_{wire}")).is_some());
        is_on && is_wanted && has_pads && wires.link.port == LinkPort::Usb
    }

    /// The other end of the cable supplies the bus voltage, which is detected by a device that looks for it.
    fn sense(&mut self, was: u32, wires: &Wires) {
        let looks = |configuration: u32| configuration >> 16 & configuration >> 19 & 1 == 1;
        let is_there = wires.link.port == LinkPort::Usb;
        if is_there && looks(self.register(0x38)) && !looks(was) {
            self.session_ns = wires.now + SENSING_NS;
        }
    }

    fn endpoint_interrupts(&self) -> u32 {
        let (in_mask, out_mask) = (self.register(0x810), self.register(0x814));
        let empty_mask = self.register(0x834);
        let mut all = 0;
        for number in 0..ENDPOINTS {
            let (one, other) = (&self.ins[number], &self.outs[number]);
            let is_empty = one.fifo.is_empty() && empty_mask >> number & 1 == 1;
            if one.interrupts & in_mask != 0 || is_empty {
                all |= 1 << number;
            }
            if other.interrupts & out_mask != 0 {
                all |= 0x1_0000 << number;
            }
        }
        all
    }

    fn core_interrupts(&self) -> u32 {
        let endpoints = self.endpoint_interrupts() & self.register(0x81C);
        let mut status = self.status;
        status |= if self.received.is_empty() { 0 } else { RECEIVED };
        status |= if endpoints & 0xFFFF != 0 { IN_ENDPOINT } else { 0 };
        status |= if endpoints >> 16 != 0 { OUT_ENDPOINT } else { 0 };
        status
    }

    fn report(&self, wires: &mut Wires) {
        let is_held =
            self.core_interrupts() & self.register(0x18) != 0 && self.register(0x08) & 1 == 1;
        wires.interrupt(self.irq, 0, is_held);
    }

    fn read_in(&self, number: usize, register: u32) -> u32 {
        let endpoint = &self.ins[number];
        match register {
            0x00 => endpoint.control_of(number),
            0x08 => endpoint.interrupts | if endpoint.fifo.is_empty() { FIFO_EMPTY } else { 0 },
            0x10 => endpoint.size,
            0x18 => {
                let depth = if number == 0 {
                    self.register(0x28)
                } else {
                    self.register(0x100 + 4 * number as u32)
                };
                (depth >> 16).saturating_sub(endpoint.fifo.len() as u32 / 4)
            }
            _ => 0,
        }
    }

    /// The next entry of the receive FIFO; after that, its data can be read.
    fn pop(&mut self) -> u32 {
        let Some((word, data)) = self.received.pop_front() else { return 0 };
        self.reading = data.into();
        let endpoint = &mut self.outs[(word & 3) as usize];
        match word >> 17 & 15 {
            OUT_COMPLETE => endpoint.interrupts |= TRANSFERRED,
            SETUP_COMPLETE => endpoint.interrupts |= SETUP,
            _ => {}
        }
        word
    }

    fn read_fifo(&mut self) -> u32 {
        let bytes = std::array::from_fn(|_| self.reading.pop_front().unwrap_or(0));
        u32::from_le_bytes(bytes)
    }

    fn reset_parts(&mut self, bits: u32) {
        if bits & 1 != 0 {
            // A reset of the core clears the FIFOs and the state of the endpoints.
            self.received.clear();
            self.ins = Default::default();
            self.outs = Default::default();
        }
        if bits & 0x10 != 0 {
            self.received.clear();
            self.reading.clear();
        }
        if bits & 0x20 != 0 {
            let number = (bits >> 6 & 31) as usize;
            for (at, endpoint) in self.ins.iter_mut().enumerate() {
                if number == 16 || at == number {
                    endpoint.fifo.clear();
                }
            }
        }
    }
}

impl Function for Otg {
    fn endpoints(&self) -> usize {
        ENDPOINTS
    }

    fn reset(&mut self) {
        self.status |= BUS_RESET;
        self.received.clear();
        self.reading.clear();
        for endpoint in &mut self.ins {
            endpoint.fifo.clear();
        }
    }

    fn enumerated(&mut self) {
        self.status |= ENUMERATED;
    }

    /// DCFG has the address; a new one counts from the end of the request that gives it.
    fn hears(&self, address: u8) -> bool {
        address == 0 || self.register(0x800) >> 4 & 0x7F == u32::from(address)
    }

    fn start_frame(&mut self) {
        self.frame = (self.frame + 1) & 0x3FFF;
        self.status |= SOF;
    }

    fn setup(&mut self, packet: [u8; 8]) {
        self.ins[0].control &= !STALL;
        self.outs[0].control = (self.outs[0].control & !STALL) | NAK;
        self.ins[0].fifo.clear();
        self.received.push_back((SETUP_DATA << 17 | 8 << 4, packet.to_vec()));
        self.received.push_back((SETUP_COMPLETE << 17, Vec::new()));
    }

    fn has_stalled(&self, endpoint: usize, is_in: bool) -> bool {
        let side = if is_in { &self.ins } else { &self.outs };
        side[endpoint].control & STALL != 0
    }

    fn is_idle(&self) -> bool {
        self.received.is_empty() && self.reading.is_empty()
    }

    fn send(&mut self, endpoint: usize, data: &[u8]) -> bool {
        let out = &mut self.outs[endpoint];
        // On an active endpoint, only NAK holds packets back.
        if out.control_of(endpoint) & (ACTIVE | NAK | STALL) != ACTIVE {
            return false;
        }
        let length = u32::try_from(data.len()).unwrap_or(0);
        let number = u32::try_from(endpoint).unwrap_or(0);
        let is_short = length < packet_bytes(out.control, endpoint);
        out.take(length);
        self.received.push_back((OUT_DATA << 17 | length << 4 | number, data.to_vec()));
        if is_short || out.packets() == 0 {
            out.control = (out.control & !ENABLE) | NAK;
            self.received.push_back((OUT_COMPLETE << 17 | number, Vec::new()));
        }
        true
    }

    fn fetch(&mut self, endpoint: usize) -> Option<Vec<u8>> {
        let from = &mut self.ins[endpoint];
        if from.control & ENABLE == 0 || from.control & (NAK | STALL) != 0 || from.packets() == 0 {
            return None;
        }
        let length = from.left().min(packet_bytes(from.control, endpoint));
        // The FIFO is filled in words.
        let words = length.div_ceil(4) as usize * 4;
        if from.fifo.len() < words {
            return None;
        }
        let data: Vec<u8> = from.fifo.drain(..words).take(length as usize).collect();
        from.take(length);
        if from.packets() == 0 {
            from.control &= !ENABLE;
            from.interrupts |= TRANSFERRED;
        }
        Some(data)
    }
}

impl Usb for Otg {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::with(self.irq);
        self.report(wires);
    }

    fn deadline(&self) -> u64 {
        self.host.next_ns.min(self.session_ns)
    }

    fn advance(&mut self, wires: &mut Wires) {
        let mut host = std::mem::replace(&mut self.host, Host::new());
        while host.next_ns <= wires.now {
            host.act(self, wires);
        }
        self.host = host;
        if self.session_ns <= wires.now {
            self.session_ns = NEVER;
            self.status |= SESSION;
        }
        self.report(wires);
    }

    fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x10 => 1 << 31,
            0x14 => self.core_interrupts(),
            0x1C => self.received.front().map_or(0, |entry| entry.0),
            0x20 => self.pop(),
            0x3C => 0x1200,
            0x808 => self.frame << 8 | 6,
            0x818 => self.endpoint_interrupts(),
            0x900..=0x97C => self.read_in(((offset - 0x900) / 0x20) as usize, offset % 0x20),
            0xB00..=0xB7C => {
                let number = ((offset - 0xB00) / 0x20) as usize;
                let endpoint = &self.outs[number];
                match offset % 0x20 {
                    0x00 => endpoint.control_of(number),
                    0x08 => endpoint.interrupts,
                    0x10 => endpoint.size,
                    _ => 0,
                }
            }
            0x1000..=0x1FFF => self.read_fifo(),
            _ => self.register(offset),
        };
        self.report(wires);
        value
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        let (bits, configuration) = (value & mask, self.register(0x38));
        match offset {
            0x10 => self.reset_parts(bits),
            0x14 => self.status &= !(bits & CLEARED_BY_ONE),
            0x900..=0x97C => {
                let endpoint = &mut self.ins[((offset - 0x900) / 0x20) as usize];
                match offset % 0x20 {
                    0x00 => endpoint.command(value, mask),
                    0x08 => endpoint.interrupts &= !bits,
                    0x10 => endpoint.size = merge(endpoint.size, value, mask),
                    _ => {}
                }
            }
            0xB00..=0xB7C => {
                let endpoint = &mut self.outs[((offset - 0xB00) / 0x20) as usize];
                match offset % 0x20 {
                    0x00 => endpoint.command(value, mask),
                    0x08 => endpoint.interrupts &= !bits,
                    0x10 => endpoint.size = merge(endpoint.size, value, mask),
                    _ => {}
                }
            }
            0x1000..=0x4FFF => {
                let endpoint = &mut self.ins[(offset / 0x1000 - 1) as usize];
                // Bytes for which the FIFO memory has no room are lost.
                if endpoint.fifo.len() < FIFO_BYTES {
                    endpoint.fifo.extend(value.to_le_bytes());
                }
            }
            _ => {
                if let Some(register) = self.registers.get_mut((offset / 4) as usize) {
                    *register = merge(*register, value, mask);
                }
            }
        }
        self.sense(configuration, wires);
        if matches!(offset, 0x38 | 0x804) {
            let is_connected = self.is_connected(wires);
            self.host.plugged(is_connected, wires.now);
        }
        self.report(wires);
    }
}

/// The size of the longest packet; endpoint 0 has a code for it.
fn packet_bytes(control: u32, endpoint: usize) -> u32 {
    if endpoint == 0 {
        return [64, 32, 16, 8][(control & 3) as usize];
    }
    (control & 0x7FF).max(1)
}
