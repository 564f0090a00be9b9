//! USART1 to USART3, UART4, UART5, USART6, UART7, UART8.

use super::mcu::Mcu;
use super::ports::{PortState, Setting};
use super::wires::{LinkPort, NEVER, Wires, merge, periods_ns};

/// Bits of SR.
const OVERRUN: u32 = 1 << 3;
const IDLE: u32 = 1 << 4;
const RECEIVED: u32 = 1 << 5;
const COMPLETE: u32 = 1 << 6;
const EMPTY: u32 = 1 << 7;
/// Bits of CR1.
const RECEIVER: u32 = 1 << 2;
const TRANSMITTER: u32 = 1 << 3;
const ENABLE: u32 = 1 << 13;

/// A serial port.
#[derive(Clone, Debug)]
pub(super) struct Usart {
    /// The port's number: `2` is USART2.
    unit: u8,
    mcu: &'static Mcu,
    irq: u16,
    is_on_apb2: bool,
    sr: u32,
    brr: u32,
    cr: [u32; 3],
    gtpr: u32,
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
    tx: String,
    rx: String,
}

impl Usart {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let name = if matches!(unit, 4 | 5 | 7 | 8) { "UART" } else { "USART" };
        let own = format!("{name}{unit}");
        Self {
            unit,
            mcu,
            irq: mcu.irq(&own, "GLOBAL"),
            is_on_apb2: mcu.is_on_apb2(&own),
            sr: EMPTY | COMPLETE,
            brr: 0,
            cr: [0; 3],
            gtpr: 0,
            received: 0,
            waiting: None,
            shifting: None,
            shifted_at: NEVER,
            listens_at: NEVER,
            was_busy: false,
            has_read_status: false,
            tx: format!("{name}{unit}_TX"),
            rx: format!("{name}{unit}_RX"),
        }
    }

    /// Restarts it in its state after a reset.
    pub(super) fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.unit, self.mcu);
        self.tell(wires);
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        if self.is_on_apb2 { wires.clocks.apb2 } else { wires.clocks.apb1 }
    }

    /// The number of clock periods in one bit.
    fn divider(&self) -> u64 {
        let divider =
            if self.cr[0] >> 15 & 1 == 1 { (self.brr >> 4) * 8 + (self.brr & 7) } else { self.brr };
        u64::from(divider).max(1)
    }

    fn frame_ns(&self, wires: &Wires) -> u64 {
        let data = if self.cr[0] >> 12 & 1 == 1 { 9 } else { 8 };
        let stop = if self.cr[1] >> 13 & 1 == 1 { 2 } else { 1 };
        periods_ns(self.divider() * (1 + data + stop), self.clock_hz(wires)).max(1)
    }

    /// Its settings, once it has started.
    pub(super) fn state(&self, wires: &Wires) -> Option<PortState> {
        let [cr, stops, _] = self.cr;
        let odd_parity = (cr >> 10 & 1 == 1).then_some(cr >> 9 & 1 == 1);
        let setting = Setting::Serial {
            baud: self.clock_hz(wires) / self.divider(),
            data_bits: 8 + (cr >> 12 & 1) as u8 - u8::from(odd_parity.is_some()),
            odd_parity,
            stop_bits: match stops >> 12 & 3 {
                0 => 1,
                2 => 2,
                _ => 0,
            },
        };
        let unit = self.tx.trim_end_matches("_TX").to_owned();
        (cr & ENABLE != 0).then_some(PortState { unit, setting })
    }

    pub(super) fn deadline(&self) -> u64 {
        self.shifted_at.min(self.listens_at)
    }

    pub(super) fn advance(&mut self, wires: &mut Wires) {
        while self.shifted_at <= wires.now {
            let at = self.shifted_at;
            self.sent(wires);
            self.shift(at, wires);
        }
        while self.listens_at <= wires.now {
            self.listen(wires);
        }
        self.tell(wires);
    }

    fn is_link(&self, wires: &Wires) -> bool {
        wires.link.port == LinkPort::Serial(self.unit)
    }

    fn sent(&mut self, wires: &mut Wires) {
        let Some(byte) = self.shifting.take() else { return };
        if wires.pad_of(&self.tx).is_none() {
            return;
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
        if wires.pad_of(&self.rx).is_none() {
            return;
        }
        let byte = if self.is_link(wires) {
            wires.link.to_mcu.pop_front()
        } else {
            wires.world(|world, now| world.uart_in(self.unit, now))
        };
        match byte {
            Some(_) if self.sr & RECEIVED != 0 => {
                self.sr |= OVERRUN;
                self.was_busy = true;
            }
            Some(byte) => {
                self.received = byte;
                self.sr |= RECEIVED;
                self.was_busy = true;
            }
            None if self.was_busy => {
                self.sr |= IDLE;
                self.was_busy = false;
            }
            None => {}
        }
    }

    fn tell(&self, wires: &mut Wires) {
        let (sr, cr) = (self.sr, self.cr[0]);
        let by_flag = (cr >> 7 & 1 != 0 && sr & EMPTY != 0)
            || (cr >> 6 & 1 != 0 && sr & COMPLETE != 0)
            || (cr >> 5 & 1 != 0 && sr & (RECEIVED | OVERRUN) != 0)
            || (cr >> 4 & 1 != 0 && sr & IDLE != 0)
            || (self.cr[2] & 1 != 0 && sr & (OVERRUN | 7) != 0);
        wires.interrupt(self.irq, 0, by_flag && cr & ENABLE != 0);
    }

    pub(super) fn asks(&self, transmits: bool) -> bool {
        if transmits {
            self.cr[2] >> 7 & 1 == 1 && self.sr & EMPTY != 0 && self.cr[0] & TRANSMITTER != 0
        } else {
            self.cr[2] >> 6 & 1 == 1 && self.sr & RECEIVED != 0
        }
    }

    pub(super) fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 => {
                self.has_read_status = true;
                self.sr
            }
            0x04 => {
                self.sr &= !RECEIVED;
                if self.has_read_status {
                    self.sr &= !(OVERRUN | IDLE | 7);
                }
                self.has_read_status = false;
                u32::from(self.received)
            }
            0x08 => self.brr,
            0x0C | 0x10 | 0x14 => self.cr[((offset - 0x0C) / 4) as usize],
            0x18 => self.gtpr,
            _ => 0,
        };
        self.tell(wires);
        value
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        match offset {
            // Only these flags can be cleared by writing 0.
            0x00 => self.sr &= !(COMPLETE | RECEIVED) | value | !mask,
            0x04 => self.transmit((value & 0xFF) as u8, wires),
            0x08 => self.brr = merge(self.brr, value, mask),
            0x0C | 0x10 | 0x14 => {
                let register = &mut self.cr[((offset - 0x0C) / 4) as usize];
                *register = merge(*register, value, mask);
            }
            0x18 => self.gtpr = merge(self.gtpr, value, mask),
            _ => {}
        }
        let listens = self.cr[0] & (ENABLE | RECEIVER) == ENABLE | RECEIVER;
        if !listens {
            self.listens_at = NEVER;
        } else if self.listens_at == NEVER {
            self.listens_at = wires.now + self.frame_ns(wires);
        }
        self.tell(wires);
    }

    fn transmit(&mut self, byte: u8, wires: &Wires) {
        self.sr &= !COMPLETE;
        self.has_read_status = false;
        if self.cr[0] & (ENABLE | TRANSMITTER) != ENABLE | TRANSMITTER {
            return;
        }
        self.waiting = Some(byte);
        self.sr &= !EMPTY;
        if self.shifting.is_none() {
            self.shift(wires.now, wires);
        }
    }
}
