//! The CAN units; the first one has the acceptance filters of both, if there are two.

use std::collections::VecDeque;

use super::mcu::Mcu;
use super::ports::{PortState, Setting};
use super::registers::merge;
use super::wires::{NEVER, Wires, periods_ns};
use sensedsl_surroundings::CanFrame;

/// Bits of MCR and MSR.
const INIT: u32 = 1;
const SLEEP: u32 = 1 << 1;
/// The bits of the shortest frame.
const SHORTEST: u64 = 47;
/// The filter banks that two units share, and those of a unit that is alone.
const BANKS: usize = 28;
const BANKS_OF_ONE: usize = 14;

/// The acceptance filters of both units.
#[derive(Debug)]
pub(super) struct Filters {
    is_shared: bool,
    fmr: u32,
    is_list: u32,
    is_wide: u32,
    fifo: u32,
    is_active: u32,
    banks: [[u32; 2]; BANKS],
}

impl Filters {
    pub(super) fn new(is_shared: bool) -> Self {
        Self {
            is_shared,
            fmr: 0x2A1C_0E01,
            is_list: 0,
            is_wide: 0,
            fifo: 0,
            is_active: 0,
            banks: [[0; 2]; BANKS],
        }
    }

    fn read(&self, offset: u32) -> u32 {
        match offset {
            0x200 => self.fmr,
            0x204 => self.is_list,
            0x20C => self.is_wide,
            0x214 => self.fifo,
            0x21C => self.is_active,
            0x240..=0x31C => self.banks[((offset - 0x240) / 8) as usize][(offset / 4 % 2) as usize],
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) {
        let register = match offset {
            0x200 => &mut self.fmr,
            0x204 => &mut self.is_list,
            0x20C => &mut self.is_wide,
            0x214 => &mut self.fifo,
            0x21C => &mut self.is_active,
            0x240..=0x31C => {
                &mut self.banks[((offset - 0x240) / 8) as usize][(offset / 4 % 2) as usize]
            }
            _ => return,
        };
        *register = merge(*register, value, mask);
    }

    /// The queue that a frame goes to, and the number of the filter that accepted it.
    fn accept(&self, unit: u8, frame: &CanFrame) -> Option<(usize, u32)> {
        let split = if self.is_shared { (self.fmr >> 8 & 63) as usize } else { BANKS_OF_ONE };
        let banks = if unit == 1 { 0..split.min(BANKS) } else { split.min(BANKS)..BANKS };
        let mut numbers = [0; 2];
        for bank in banks {
            let queue = (self.fifo >> bank & 1) as usize;
            let filters = self.filters(bank);
            let is_active = self.is_active >> bank & 1 == 1 && self.fmr & 1 == 0;
            let wide = self.is_wide >> bank & 1 == 1;
            let bits = if wide { wide_bits(frame) } else { narrow_bits(frame) };
            let hit = filters.iter().position(|(wanted, mask)| bits & mask == wanted & mask);
            if let (true, Some(hit)) = (is_active, hit) {
                return Some((queue, numbers[queue] + u32::try_from(hit).unwrap_or(0)));
            }
            numbers[queue] += u32::try_from(filters.len()).unwrap_or(0);
        }
        None
    }

    /// The filters of a bank, each as the bits of an identifier and the mask of those that count.
    fn filters(&self, bank: usize) -> Vec<(u32, u32)> {
        let [one, two] = self.banks[bank];
        let is_list = self.is_list >> bank & 1 == 1;
        if self.is_wide >> bank & 1 == 1 {
            let all = 0xFFFF_FFFE;
            return if is_list { vec![(one, all), (two, all)] } else { vec![(one, two & all)] };
        }
        let halves = |word: u32| (word & 0xFFFF, word >> 16);
        let ((a, b), (c, d)) = (halves(one), halves(two));
        if is_list { [a, b, c, d].map(|id| (id, 0xFFFF)).to_vec() } else { vec![(a, b), (c, d)] }
    }
}

/// The bits of a frame on the bus, including those up to the next frame, without stuffed ones.
fn bits_of(frame: &CanFrame) -> u64 {
    let overhead = if frame.extended { 67 } else { SHORTEST };
    overhead + 8 * u64::from(frame.length)
}

fn wide_bits(frame: &CanFrame) -> u32 {
    let remote = u32::from(frame.remote) << 1;
    if frame.extended { frame.id << 3 | 4 | remote } else { frame.id << 21 | remote }
}

fn narrow_bits(frame: &CanFrame) -> u32 {
    let remote = u32::from(frame.remote) << 4;
    if frame.extended {
        (frame.id >> 18) << 5 | remote | 8 | (frame.id >> 15 & 7)
    } else {
        frame.id << 5 | remote
    }
}

/// A CAN unit.
#[derive(Debug)]
pub(super) struct Can {
    unit: u8,
    mcu: &'static Mcu,
    irqs: [u16; 4],
    mcr: u32,
    msr: u32,
    tsr: u32,
    ier: u32,
    esr: u32,
    btr: u32,
    mailboxes: [[u32; 4]; 3],
    queues: [VecDeque<[u32; 4]>; 2],
    overrun: [bool; 2],
    sending: Option<usize>,
    sent_at: u64,
    listens_at: u64,
    tx: String,
    rx: String,
}

impl Can {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let own = mcu.unit("CAN", unit);
        Self {
            unit,
            mcu,
            irqs: ["TX", "RX0", "RX1", "SCE"].map(|signal| mcu.irq(&own, signal)),
            mcr: 0x0001_0002,
            msr: 0x0C02,
            tsr: 0x1C00_0000,
            ier: 0,
            esr: 0,
            btr: 0x0123_0000,
            mailboxes: [[0; 4]; 3],
            queues: [VecDeque::new(), VecDeque::new()],
            overrun: [false; 2],
            sending: None,
            sent_at: NEVER,
            listens_at: NEVER,
            tx: format!("{own}_TX"),
            rx: format!("{own}_RX"),
        }
    }

    /// Restarts it in its state after a reset.
    pub(super) fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.unit, self.mcu);
        self.report(wires);
    }

    /// The number of clock periods in one bit.
    fn divider(&self) -> u64 {
        let quanta = u64::from((self.btr >> 16 & 15) + (self.btr >> 20 & 7) + 3);
        quanta * (u64::from(self.btr & 0x3FF) + 1)
    }

    fn bits_ns(&self, bits: u64, wires: &Wires) -> u64 {
        periods_ns(bits * self.divider(), wires.clocks.apb1).max(1)
    }

    /// Its settings, once it has started.
    pub(super) fn state(&self, wires: &Wires) -> Option<PortState> {
        let setting = Setting::Can { bitrate_hz: wires.clocks.apb1 / self.divider() };
        let unit = self.tx.trim_end_matches("_TX");
        self.is_on().then(|| PortState { unit: unit.to_owned(), setting })
    }

    pub(super) fn deadline(&self) -> u64 {
        self.sent_at.min(self.listens_at)
    }

    fn is_on(&self) -> bool {
        self.msr & (INIT | SLEEP) == 0
    }

    fn frame(&self, mailbox: usize) -> CanFrame {
        let [identifier, length, low, high] = self.mailboxes[mailbox];
        let extended = identifier & 4 != 0;
        let id = if extended { identifier >> 3 } else { identifier >> 21 };
        let mut data = [0; 8];
        for (slot, byte) in
            data.iter_mut().zip(low.to_le_bytes().into_iter().chain(high.to_le_bytes()))
        {
            *slot = byte;
        }
        let length = u8::try_from(length & 15).unwrap_or(8).min(8);
        CanFrame { id, extended, remote: identifier & 2 != 0, length, data }
    }

    /// Sends the frame with the lowest identifier next.
    fn begin(&mut self, at: u64, wires: &Wires) {
        self.sent_at = NEVER;
        if !self.is_on() || self.sending.is_some() {
            return;
        }
        let requested = (0..3).filter(|mailbox| self.mailboxes[*mailbox][0] & 1 == 1);
        let Some(mailbox) = requested.min_by_key(|mailbox| self.mailboxes[*mailbox][0] & !1) else {
            return;
        };
        let frame = self.frame(mailbox);
        self.sending = Some(mailbox);
        self.sent_at = at + self.bits_ns(bits_of(&frame), wires);
    }

    pub(super) fn advance(&mut self, wires: &mut Wires, filters: &Filters) {
        while self.sent_at <= wires.now {
            let at = self.sent_at;
            if let Some(mailbox) = self.sending.take() {
                self.sent(mailbox, wires, filters);
            }
            self.begin(at, wires);
        }
        while self.listens_at <= wires.now {
            let hears = self.btr >> 30 & 1 == 0 && wires.pad_of(&self.rx).is_some();
            let frame =
                if hears { wires.world(|world, now| world.can_in(self.unit, now)) } else { None };
            // The next frame follows once this one has gone over the bus.
            self.listens_at += self.bits_ns(frame.as_ref().map_or(SHORTEST, bits_of), wires);
            if let Some(frame) = frame {
                self.receive(&frame, filters);
            }
        }
        self.report(wires);
    }

    fn sent(&mut self, mailbox: usize, wires: &Wires, filters: &Filters) {
        let frame = self.frame(mailbox);
        self.mailboxes[mailbox][0] &= !1;
        self.tsr |= 3 << (8 * mailbox) | 1 << (26 + mailbox);
        if self.btr >> 30 & 1 == 1 {
            self.receive(&frame, filters);
        }
        if self.btr >> 31 == 0 && wires.pad_of(&self.tx).is_some() {
            wires.world(|world, now| world.can_out(self.unit, frame, now));
        }
    }

    fn receive(&mut self, frame: &CanFrame, filters: &Filters) {
        let Some((queue, number)) = filters.accept(self.unit, frame) else { return };
        if self.queues[queue].len() >= 3 {
            self.overrun[queue] = true;
            return;
        }
        let word = |at: usize| {
            frame
                .data
                .iter()
                .skip(at)
                .take(4)
                .rev()
                .fold(0, |word, byte| word << 8 | u32::from(*byte))
        };
        let length = u32::from(frame.length) | number << 8;
        self.queues[queue].push_back([wide_bits(frame), length, word(0), word(4)]);
    }

    fn report(&self, wires: &mut Wires) {
        let ier = self.ier;
        wires.interrupt(self.irqs[0], 0, ier & 1 != 0 && self.tsr & 0x0001_0101 != 0);
        for queue in 0..2 {
            let enabled = ier >> (1 + 3 * queue);
            let waiting = self.queues[queue].len();
            let held = (enabled & 1 != 0 && waiting > 0)
                || (enabled & 2 != 0 && waiting >= 3)
                || (enabled & 4 != 0 && self.overrun[queue]);
            wires.interrupt(self.irqs[1 + queue], 0, held);
        }
    }

    pub(super) fn read(&self, offset: u32, filters: &Filters) -> u32 {
        match offset {
            0x00 => self.mcr,
            0x04 => self.msr,
            0x08 => self.tsr | (self.tsr >> 26 & 7).trailing_zeros().min(2) << 24,
            0x0C | 0x10 => {
                let queue = ((offset - 0x0C) / 4) as usize;
                let waiting = self.queues[queue].len();
                let count = u32::try_from(waiting).unwrap_or(3);
                count | u32::from(waiting >= 3) << 3 | u32::from(self.overrun[queue]) << 4
            }
            0x14 => self.ier,
            0x18 => self.esr,
            0x1C => self.btr,
            0x180..=0x1AC => {
                self.mailboxes[((offset - 0x180) / 16) as usize][(offset / 4 % 4) as usize]
            }
            0x1B0..=0x1CC => {
                let queue = &self.queues[((offset - 0x1B0) / 16) as usize];
                queue.front().map_or(0, |frame| frame[(offset / 4 % 4) as usize])
            }
            0x200..=0x31C if self.unit == 1 => filters.read(offset),
            _ => 0,
        }
    }

    pub(super) fn write(
        &mut self,
        offset: u32,
        value: u32,
        mask: u32,
        wires: &mut Wires,
        filters: &mut Filters,
    ) {
        let bits = value & mask;
        match offset {
            0x00 => self.control(merge(self.mcr, value, mask), wires),
            0x04 => self.msr &= !(bits & 0x1C),
            0x08 => self.acknowledge(bits),
            0x0C | 0x10 => {
                let queue = ((offset - 0x0C) / 4) as usize;
                if bits & 1 << 5 != 0 {
                    self.queues[queue].pop_front();
                }
                if bits & 1 << 4 != 0 {
                    self.overrun[queue] = false;
                }
            }
            0x14 => self.ier = merge(self.ier, value, mask),
            0x18 => self.esr = merge(self.esr, value, mask & 0x70),
            0x1C => self.btr = merge(self.btr, value, mask),
            0x180..=0x1AC => {
                let (mailbox, word) = (((offset - 0x180) / 16) as usize, (offset / 4 % 4) as usize);
                let register = &mut self.mailboxes[mailbox][word];
                *register = merge(*register, value, mask);
                if word == 0 && *register & 1 == 1 {
                    self.tsr &= !(15 << (8 * mailbox) | 1 << (26 + mailbox));
                }
            }
            0x200..=0x31C if self.unit == 1 => filters.write(offset, value, mask),
            _ => {}
        }
        if self.sent_at == NEVER {
            self.begin(wires.now, wires);
        }
        self.report(wires);
    }

    fn acknowledge(&mut self, bits: u32) {
        for mailbox in 0..3 {
            if bits >> (8 * mailbox) & 1 == 1 {
                self.tsr &= !(15 << (8 * mailbox));
            }
            if bits >> (8 * mailbox + 7) & 1 == 1 && self.sending != Some(mailbox) {
                self.mailboxes[mailbox][0] &= !1;
                self.tsr |= 1 << (8 * mailbox) | 1 << (26 + mailbox);
            }
        }
    }

    fn control(&mut self, new: u32, wires: &Wires) {
        if new >> 15 & 1 == 1 {
            *self = Self::new(self.unit, self.mcu);
            return;
        }
        self.mcr = new;
        // A requested mode is acknowledged at once.
        self.msr = (self.msr & !(INIT | SLEEP))
            | (new & INIT)
            | if new & INIT == 0 { new & SLEEP } else { 0 };
        if !self.is_on() {
            self.listens_at = NEVER;
        } else if self.listens_at == NEVER {
            self.listens_at = wires.now + self.bits_ns(47, wires);
        }
    }
}
