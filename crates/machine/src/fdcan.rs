//! The CAN units of STM32G4, which also take frames of CAN FD, and their message memory with its fixed layout.
//!
//! In: accesses of the program, and frames from the bus. Out: frames, interrupts. Frames are classic ones here: up to 8
//! bytes, at one rate. Not modelled are errors of the bus, events of transmission, priority messages and timestamps.

use super::mcu::Mcu;
use super::ports::{PortState, Setting};
use super::registers::merge;
use super::wires::{NEVER, Wires, periods_ns};
use sensedsl_surroundings::CanFrame;

/// The message memory in words: filters, then two queues, events, and what is to be sent. Elements of the last three
/// kinds have a length, and there are three of each.
const WORDS: usize = 0x350 / 4;
const WIDE_FILTERS: usize = 28;
const QUEUES: [usize; 2] = [44, 98];
const BUFFERS: usize = 158;
const ELEMENT: usize = 18;
const ELEMENTS: usize = 3;
/// Bits of the first word of an element.
const EXTENDED: u32 = 1 << 30;
const REMOTE: u32 = 1 << 29;
/// Bits of CCCR.
const INIT: u32 = 1;
const CHANGES: u32 = 1 << 1;
const STOPPED: u32 = 1 << 3;
const STOP: u32 = 1 << 4;
const MONITORS: u32 = 1 << 5;
const TESTS: u32 = 1 << 7;
/// The bit of TEST that leads what is sent back in.
const LOOPS: u32 = 1 << 4;
/// Bits of IR: for each queue a new element, a full queue and a lost element; and something was sent.
const NEW: [u32; 2] = [1, 1 << 3];
const FULL: [u32; 2] = [1 << 1, 1 << 4];
const LOST: [u32; 2] = [1 << 2, 1 << 5];
const SENT: u32 = 1 << 7;
const EMPTY: u32 = 1 << 9;
/// The bits of IR that each bit of ILS moves to the second interrupt.
const GROUPS: [u32; 7] = [0x7, 0x38, 0x1C0, 0x1E00, 0xE000, 0x3_0000, 0xFC_0000];
/// The registers, with those behind the clock's divider.
const REGISTERS: usize = 0x104 / 4;
const CCCR: u32 = 0x18;
const NBTP: u32 = 0x1C;
const TEST: u32 = 0x10;
const IR: u32 = 0x50;
const IE: u32 = 0x54;
const ILS: u32 = 0x58;
const ILE: u32 = 0x5C;
const RXGFC: u32 = 0x80;
const TXBC: u32 = 0xC0;
const TXBTIE: u32 = 0xDC;
const CKDIV: u32 = 0x100;
/// The bits of the shortest frame, and of one with a long identifier.
const SHORTEST: u64 = 47;
const LONG: u64 = 67;

/// A queue of received elements: the index of the first, and their number.
#[derive(Clone, Copy, Debug, Default)]
struct Queue {
    first: usize,
    length: usize,
    has_lost: bool,
}

/// A unit.
#[derive(Debug)]
pub(super) struct Fdcan {
    unit: u8,
    mcu: &'static Mcu,
    irqs: [u16; 2],
    name: String,
    registers: [u32; REGISTERS],
    memory: [u32; WORDS],
    queues: [Queue; 2],
    /// The buffers that are to be sent, one bit each, and those that have been.
    requested: u32,
    sent: u32,
    /// The buffer that the program fills next, and the one that is sent next, where they are a FIFO.
    put: usize,
    get: usize,
    sending: Option<usize>,
    sent_at: u64,
    listens_at: u64,
    tx: String,
    rx: String,
}

fn index(offset: u32) -> usize {
    (offset / 4) as usize
}

/// The bits of a frame on the bus, including those up to the next frame, without stuffed ones.
fn bits_of(frame: &CanFrame) -> u64 {
    let overhead = if frame.extended { LONG } else { SHORTEST };
    overhead + 8 * u64::from(frame.length)
}

impl Fdcan {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let name = format!("FDCAN{unit}");
        let mut registers = [0; REGISTERS];
        registers[index(CCCR)] = INIT;
        registers[index(NBTP)] = 0x0600_0A03;
        Self {
            unit,
            mcu,
            irqs: ["IT0", "IT1"].map(|signal| mcu.irq(&name, signal)),
            registers,
            memory: [0; WORDS],
            queues: [Queue::default(); 2],
            requested: 0,
            sent: 0,
            put: 0,
            get: 0,
            sending: None,
            sent_at: NEVER,
            listens_at: NEVER,
            tx: format!("{name}_TX"),
            rx: format!("{name}_RX"),
            name,
        }
    }

    /// Restarts it in its state after a reset, which its memory survives.
    pub(super) fn restart(&mut self, wires: &mut Wires) {
        let memory = self.memory;
        *self = Self::new(self.unit, self.mcu);
        self.memory = memory;
        self.report(wires);
    }

    fn register(&self, offset: u32) -> u32 {
        self.registers.get(index(offset)).copied().unwrap_or(0)
    }

    /// The divider of the clock, which only the first unit has, for all of them.
    pub(super) fn shared(&self) -> u32 {
        self.register(CKDIV)
    }

    pub(super) fn share(&mut self, divider: u32) {
        self.registers[index(CKDIV)] = divider;
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        let by = u64::from(self.register(CKDIV) & 15) * 2;
        wires.kernel_hz(&self.name).unwrap_or(wires.clocks.apb1) / by.max(1)
    }

    /// The number of clock periods in one bit.
    fn divider(&self) -> u64 {
        let nbtp = u64::from(self.register(NBTP));
        let steps = (nbtp >> 8 & 0xFF) + (nbtp & 0x7F) + 3;
        steps * ((nbtp >> 16 & 0x1FF) + 1)
    }

    fn bits_ns(&self, bits: u64, wires: &Wires) -> u64 {
        periods_ns(bits * self.divider(), self.clock_hz(wires)).max(1)
    }

    fn is_on(&self) -> bool {
        self.register(CCCR) & INIT == 0
    }

    /// Its settings, once it has started.
    pub(super) fn state(&self, wires: &Wires) -> Option<PortState> {
        let setting = Setting::Can { bitrate_hz: self.clock_hz(wires) / self.divider() };
        self.is_on().then(|| PortState { unit: self.name.clone(), setting })
    }

    pub(super) fn deadline(&self) -> u64 {
        self.sent_at.min(self.listens_at)
    }

    /// The frame in a buffer.
    fn frame(&self, buffer: usize) -> CanFrame {
        let at = BUFFERS + ELEMENT * buffer;
        let (first, length) = (self.memory[at], self.memory[at + 1] >> 16 & 15);
        let extended = first & EXTENDED != 0;
        let id = if extended { first & 0x1FFF_FFFF } else { first >> 18 & 0x7FF };
        let mut data = [0; 8];
        let bytes = self.memory[at + 2..at + 4].iter().flat_map(|word| word.to_le_bytes());
        for (slot, byte) in data.iter_mut().zip(bytes) {
            *slot = byte;
        }
        let length = u8::try_from(length).unwrap_or(8).min(8);
        CanFrame { id, extended, remote: first & REMOTE != 0, length, data }
    }

    fn is_queue(&self) -> bool {
        self.register(TXBC) >> 24 & 1 == 1
    }

    /// The buffer that is sent next: the one with the lowest identifier, or the one that was requested first.
    fn next(&self) -> Option<usize> {
        let mut requested = (0..ELEMENTS).filter(|buffer| self.requested >> buffer & 1 == 1);
        if self.is_queue() {
            return requested.min_by_key(|buffer| self.memory[BUFFERS + ELEMENT * buffer]);
        }
        requested.find(|buffer| *buffer == self.get)
    }

    fn begin(&mut self, at: u64, wires: &Wires) {
        self.sent_at = NEVER;
        if !self.is_on() || self.sending.is_some() {
            return;
        }
        if let Some(buffer) = self.next() {
            self.sending = Some(buffer);
            self.sent_at = at + self.bits_ns(bits_of(&self.frame(buffer)), wires);
        }
    }

    pub(super) fn advance(&mut self, wires: &mut Wires) {
        while self.sent_at <= wires.now {
            let at = self.sent_at;
            if let Some(buffer) = self.sending.take() {
                self.finish(buffer, wires);
            }
            self.begin(at, wires);
        }
        while self.listens_at <= wires.now {
            let hears = !self.loops() && wires.pad_of(&self.rx).is_some();
            let frame =
                if hears { wires.world(|world, now| world.can_in(self.unit, now)) } else { None };
            // The next frame follows once this one has gone over the bus.
            self.listens_at += self.bits_ns(frame.as_ref().map_or(SHORTEST, bits_of), wires);
            if let Some(frame) = frame {
                self.receive(&frame);
            }
        }
        self.report(wires);
    }

    fn loops(&self) -> bool {
        self.register(CCCR) & TESTS != 0 && self.register(TEST) & LOOPS != 0
    }

    fn finish(&mut self, buffer: usize, wires: &Wires) {
        let frame = self.frame(buffer);
        self.requested &= !(1 << buffer);
        self.sent |= 1 << buffer;
        self.get = (buffer + 1) % ELEMENTS;
        if self.register(TXBTIE) >> buffer & 1 == 1 {
            self.registers[index(IR)] |= SENT;
        }
        if self.requested == 0 {
            self.registers[index(IR)] |= EMPTY;
        }
        if self.loops() {
            self.receive(&frame);
        }
        let is_heard = self.register(CCCR) & MONITORS == 0 && wires.pad_of(&self.tx).is_some();
        if is_heard {
            wires.world(|world, now| world.can_out(self.unit, frame, now));
        }
    }

    /// The queue that a frame goes to, and the index of the filter that accepts it, or the bit that says that none did.
    fn accept(&self, frame: &CanFrame) -> Option<(usize, u32)> {
        const NO_FILTER: u32 = 1 << 31;
        let rxgfc = self.register(RXGFC);
        let (count, rejects_remote, others) = if frame.extended {
            (rxgfc >> 24 & 15, rxgfc & 1 == 1, rxgfc >> 2 & 3)
        } else {
            (rxgfc >> 16 & 31, rxgfc >> 1 & 1 == 1, rxgfc >> 4 & 3)
        };
        if frame.remote && rejects_remote {
            return None;
        }
        for filter in 0..count {
            let (configuration, is_hit) = self.filter(filter as usize, frame);
            match configuration {
                1 | 5 if is_hit => return Some((0, filter << 24)),
                2 | 6 if is_hit => return Some((1, filter << 24)),
                3 if is_hit => return None,
                _ => {}
            }
        }
        match others {
            0 => Some((0, NO_FILTER)),
            1 => Some((1, NO_FILTER)),
            _ => None,
        }
    }

    /// What a filter does with a frame that fits it, and whether this one does.
    fn filter(&self, filter: usize, frame: &CanFrame) -> (u32, bool) {
        let id = frame.id;
        let (configuration, kind, one, two) = if frame.extended {
            let at = WIDE_FILTERS + 2 * filter.min(7);
            let [first, second] = [self.memory[at], self.memory[at + 1]];
            (first >> 29, second >> 30, first & 0x1FFF_FFFF, second & 0x1FFF_FFFF)
        } else {
            let word = self.memory[filter.min(WIDE_FILTERS - 1)];
            (word >> 27 & 7, word >> 30, word >> 16 & 0x7FF, word & 0x7FF)
        };
        let is_hit = match kind {
            0 => (one..=two).contains(&id),
            1 => id == one || id == two,
            2 => id & two == one & two,
            // Only long identifiers have this kind; the short ones' filter is off.
            _ => frame.extended && (one..=two).contains(&id),
        };
        (configuration, is_hit)
    }

    fn receive(&mut self, frame: &CanFrame) {
        let Some((number, filter)) = self.accept(frame) else { return };
        let queue = &mut self.queues[number];
        if queue.length >= ELEMENTS {
            queue.has_lost = true;
            self.registers[index(IR)] |= LOST[number];
            return;
        }
        let at = QUEUES[number] + ELEMENT * ((queue.first + queue.length) % ELEMENTS);
        queue.length += 1;
        let is_full = queue.length >= ELEMENTS;
        let id = if frame.extended { frame.id | EXTENDED } else { frame.id << 18 };
        self.memory[at] = id | if frame.remote { REMOTE } else { 0 };
        self.memory[at + 1] = filter | u32::from(frame.length) << 16;
        let [low, high] = [0, 4].map(|from| {
            let bytes = frame.data.iter().skip(from).take(4).rev();
            bytes.fold(0, |word, byte| word << 8 | u32::from(*byte))
        });
        (self.memory[at + 2], self.memory[at + 3]) = (low, high);
        self.registers[index(IR)] |= NEW[number] | if is_full { FULL[number] } else { 0 };
    }

    fn report(&self, wires: &mut Wires) {
        let held = self.register(IR) & self.register(IE);
        let moves = |(group, _): &(usize, &u32)| self.register(ILS) >> group & 1 == 1;
        let second = GROUPS.iter().enumerate().filter(moves).fold(0, |all, (_, bits)| all | bits);
        for (line, (irq, bits)) in self.irqs.iter().zip([!second, second]).enumerate() {
            let is_on = self.register(ILE) >> line & 1 == 1;
            wires.interrupt(*irq, 0, is_on && held & bits != 0);
        }
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => 0x3214_1218,
            0x04 => 0x8765_4321,
            0x90 | 0x98 => {
                let Queue { first, length, has_lost } = self.queues[index(offset - 0x90) / 2];
                let [first, length] = [first, length].map(|one| u32::try_from(one).unwrap_or(0));
                let next = (first + length) % 3;
                let flags = u32::from(length >= 3) << 24 | u32::from(has_lost) << 25;
                length | first << 8 | next << 16 | flags
            }
            0xC4 => self.room(),
            0xC8 => self.requested,
            0xD4 => self.sent,
            _ => self.register(offset),
        }
    }

    /// The room for frames that are to be sent, and the buffers that are next.
    fn room(&self) -> u32 {
        let free = 3 - self.requested.count_ones();
        let get = self.next().unwrap_or(self.get);
        let put = if self.is_queue() { self.requested.trailing_ones() as usize } else { self.put };
        let [get, put] = [get, put % ELEMENTS].map(|one| u32::try_from(one).unwrap_or(0));
        let is_full = u32::from(free == 0) << 21;
        if self.is_queue() { put << 16 | is_full } else { free | get << 8 | put << 16 | is_full }
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        let bits = value & mask;
        match offset {
            CCCR => self.control(merge(self.register(CCCR), value, mask), wires),
            IR => self.registers[index(IR)] &= !bits,
            0x94 | 0x9C => {
                let queue = &mut self.queues[index(offset - 0x94) / 2];
                // The program names the last element that it has read.
                let read = ((bits & 7) as usize + ELEMENTS - queue.first) % ELEMENTS + 1;
                let read = read.min(queue.length);
                queue.first = (queue.first + read) % ELEMENTS;
                queue.length -= read;
                queue.has_lost &= read == 0;
            }
            0xCC if self.is_on() => self.request(bits & 7),
            0xD0 => {
                let kept = self.sending.map_or(0, |buffer| 1 << buffer);
                self.requested &= !bits | kept;
                self.registers[index(0xD8)] |= bits & !kept & 7;
            }
            _ => {
                if let Some(register) = self.registers.get_mut(index(offset)) {
                    *register = merge(*register, value, mask);
                }
            }
        }
        if self.sent_at == NEVER {
            self.begin(wires.now, wires);
        }
        self.report(wires);
    }

    fn request(&mut self, buffers: u32) {
        self.requested |= buffers;
        self.sent &= !buffers;
        self.registers[index(0xD8)] &= !buffers;
        self.put = (self.put + buffers.count_ones() as usize) % ELEMENTS;
    }

    /// Writes CCCR: a requested mode is there at once. Leaving the first mode ends the change of settings.
    fn control(&mut self, new: u32, wires: &Wires) {
        let is_stopped = new & STOP != 0;
        let init = if is_stopped { INIT } else { new & INIT };
        let changes = if init == 0 { 0 } else { new & CHANGES };
        let stopped = if is_stopped { STOPPED } else { 0 };
        self.registers[index(CCCR)] = new & !(INIT | CHANGES | STOPPED) | init | changes | stopped;
        if changes != 0 {
            // What is under way is given up.
            (self.requested, self.sent, self.put, self.get) = (0, 0, 0, 0);
            (self.sending, self.sent_at) = (None, NEVER);
            self.queues = [Queue::default(); 2];
        }
        if !self.is_on() {
            self.listens_at = NEVER;
        } else if self.listens_at == NEVER {
            self.listens_at = wires.now + self.bits_ns(SHORTEST, wires);
        }
    }

    pub(super) fn read_memory(&self, offset: u32) -> u32 {
        self.memory.get(index(offset)).copied().unwrap_or(0)
    }

    pub(super) fn write_memory(&mut self, offset: u32, value: u32, mask: u32) {
        if let Some(word) = self.memory.get_mut(index(offset)) {
            *word = merge(*word, value, mask);
        }
    }
}
