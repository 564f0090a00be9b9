//! A part with registers on I2C or SPI: what it answers, byte by byte, as its driver describes it.
//!
//! What is written is kept and can be read back. Registers of values have the world's; where the driver knows an
//! identity or a calibration, it is there. A trigger starts a measurement; the part does not answer until it is done.

use std::collections::BTreeMap;

use sensedsl_model::protocol::{Formula, InitStep, Protocol};
use sensedsl_model::words::Words;

use super::ranges::Ranges;
use super::sleep::Sleep;
use super::waits::Waits;
use super::{formula, words};
use crate::truth::Subject;

/// Bytes that a read goes on for at most.
const READ_BYTES_MAX: usize = 2_112;

/// A value of the part.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    /// Index of the subject.
    pub(crate) subject: usize,
    /// Written to start its measurement; empty for none.
    pub(crate) trigger: Vec<u8>,
    /// How long that lasts.
    pub(crate) wait_ns: u64,
    /// Its register; `None` if it is read without one.
    pub(crate) register: Option<u16>,
    /// Sent before it is read, on SPI.
    pub(crate) select: Vec<u8>,
    /// Sent while it is read, on SPI.
    pub(crate) exchange: Vec<u8>,
    /// Where its bytes begin behind the register.
    pub(crate) byte: u16,
    /// Bytes of a transfer that reads it.
    pub(crate) length: u16,
    /// How it is coded; none where the formula makes it.
    pub(crate) words: Option<Words>,
    /// Which output of the formula it is.
    pub(crate) output: Option<u8>,
    /// What the part's registers make of it.
    pub(crate) ranges: Ranges,
}

/// A measurement that was started.
#[derive(Clone, Debug)]
struct Measurement {
    trigger: Vec<u8>,
    began_ns: u64,
    ready_ns: u64,
    /// How long it lasts, until it was taken.
    wait_ns: Option<u64>,
}

/// A part with registers.
#[derive(Clone, Debug)]
pub(crate) struct Registers {
    protocol: Protocol,
    readings: Vec<Reading>,
    written: BTreeMap<u16, u8>,
    /// What wakes it, and all that was written, triggers included.
    sleep: Option<Sleep>,
    controls: BTreeMap<u16, u8>,
    /// What the master has sent in this transfer.
    sent: Vec<u8>,
    pointer: Option<u16>,
    measurement: Option<Measurement>,
    /// What is read in this transfer.
    answer: Vec<u8>,
    at: usize,
    began_ns: u64,
    /// Its identity was read; something else was.
    is_asked: bool,
    is_used: bool,
    /// How much of what sets it up was written, and what the board has done that its driver does not say.
    begun: usize,
    odd: Option<String>,
    waits: Waits,
}

impl Registers {
    pub(crate) fn new(protocol: Protocol, readings: Vec<Reading>, sleep: Option<Sleep>) -> Self {
        Self {
            protocol,
            readings,
            written: BTreeMap::new(),
            sleep,
            controls: BTreeMap::new(),
            sent: Vec::new(),
            pointer: None,
            measurement: None,
            answer: Vec::new(),
            at: 0,
            began_ns: 0,
            is_asked: false,
            is_used: false,
            begun: 0,
            odd: None,
            waits: Waits::default(),
        }
    }

    /// The supply was gone.
    pub(crate) fn reset(&mut self) {
        let readings = std::mem::take(&mut self.readings);
        let (is_asked, is_used, odd) = (self.is_asked, self.is_used, self.odd.take());
        let new = Self::new(self.protocol.clone(), readings, self.sleep);
        *self = Self { is_asked, is_used, odd, waits: self.waits, ..new };
    }

    /// What the board has done first that the part's driver does not say; none where there is no such thing.
    pub(crate) fn odd(&self) -> Option<&str> {
        self.odd.as_deref()
    }

    /// What is wrong with how long the board waits for it; so many parts share its bus.
    pub(crate) fn waits_too_long(&self, parts: u64) -> Option<String> {
        self.waits.too_long(parts)
    }

    /// What sets a part up that was written to, and was never written. A part that is read tells it at once.
    pub(crate) fn not_set_up(&self) -> Option<String> {
        let missing = self.init().nth(self.begun).filter(|_| !self.controls.is_empty())?;
        Some(format!("{} is never written, which sets it up", hex(missing)))
    }

    /// A reading begins: it takes the measurement that was there last.
    fn taken(&mut self, now_ns: u64) {
        if let Some(measurement) = &mut self.measurement
            && let Some(wait_ns) = measurement.wait_ns.take()
        {
            self.waits.take(wait_ns, measurement.began_ns, now_ns);
        }
    }

    /// A value is read: what sets the part up must have been written.
    fn used(&mut self) {
        self.is_used = true;
        let mut writes = self.init();
        if let Some(missing) = writes.nth(self.begun) {
            let missing = hex(missing);
            drop(writes);
            self.tell(|| format!("values are read before {missing} is written, which sets it up"));
        }
    }

    /// The transfers that set it up. A part that is read while it is written has none that can be told from it.
    fn init(&self) -> impl Iterator<Item = &[u8]> {
        let is_told = self.readings.iter().all(|one| one.exchange.is_empty());
        self.protocol.init.iter().filter(move |_| is_told).filter_map(|step| match step {
            InitStep::Write(bytes) => Some(bytes.as_slice()),
            InitStep::Wait { .. } => None,
        })
    }

    fn tell(&mut self, what: impl FnOnce() -> String) {
        if self.odd.is_none() {
            self.odd = Some(what());
        }
    }

    /// Behind which byte, from a register on, the driver says nothing; none where nothing is known of the register.
    fn end_of(&self, pointer: Option<u16>) -> Option<u16> {
        // Calibration is read block by block, whatever lies behind it.
        let block = self.protocol.calibration.iter().find(|(first, _)| Some(*first) == pointer);
        if let Some((_, count)) = block {
            return Some(*count);
        }
        let behind = |register: Option<u16>, length: u16| {
            let first = match (pointer, register) {
                (Some(pointer), Some(register)) => register.checked_sub(pointer)?,
                (None, None) => 0,
                (Some(_), None) | (None, Some(_)) => return None,
            };
            Some(first.saturating_add(length))
        };
        let values = self.readings.iter().filter_map(|one| {
            let end = one.byte.saturating_add(one.length);
            behind(one.register, one.words.as_ref().map_or(end, |words| words.on_wire(end)))
        });
        let identity =
            self.protocol.identity.iter().filter_map(|one| {
                behind(Some(one.register), u16::try_from(one.expected.len()).ok()?)
            });
        let calibration = self.protocol.calibration.iter();
        let calibration =
            calibration.filter_map(|(register, count)| behind(Some(*register), *count));
        values.chain(identity).chain(calibration).max()
    }

    /// Whether the driver says what its identity is, where the part was read and not asked for it.
    pub(crate) fn is_unasked(&self) -> Option<bool> {
        (self.is_used && !self.is_asked).then_some(self.protocol.identity.is_some())
    }

    /// From one measurement to the next, as the design sets it up.
    pub(crate) fn held_ns(&self) -> u64 {
        self.readings.iter().map(|one| one.ranges.planned_ns()).max().unwrap_or(0)
    }

    /// A byte of the answer is taken.
    fn note(&mut self, place: usize) {
        let place = u16::try_from(place).unwrap_or(u16::MAX);
        let register = self.pointer.map(|first| first.saturating_add(place));
        let identity = self.protocol.identity.as_ref();
        if register.is_some() && register == identity.map(|one| one.register) {
            self.is_asked = true;
        } else {
            self.used();
        }
        if let Some(end) = self.end_of(self.pointer).filter(|end| *end <= place) {
            let from = self.pointer.map(|at| format!(" from register 0x{at:02X} on"));
            let from = from.unwrap_or_default();
            self.tell(|| format!("more is read{from} than {end} bytes, which is all there is"));
        }
    }

    /// Whether it measures and does not answer. A part that is set up first, or is asked for several things, has a
    /// processor of its own for its bus.
    pub(crate) fn is_busy(&self, now_ns: u64) -> bool {
        let first = self.readings.first().map(|one| &one.trigger);
        let is_simple = self.protocol.init.is_empty()
            && self.readings.iter().all(|one| Some(&one.trigger) == first);
        is_simple && self.measurement.as_ref().is_some_and(|one| now_ns < one.ready_ns)
    }

    /// A transfer begins, or goes on in the other direction.
    pub(crate) fn start(&mut self, read: bool, subjects: &[Subject], now_ns: u64) {
        self.take_sent(now_ns);
        if read {
            self.taken(now_ns);
            self.answer = self.answer(subjects, now_ns);
            self.at = 0;
        }
    }

    /// The master sends a byte.
    pub(crate) fn write(&mut self, byte: u8) {
        if self.sent.len() < READ_BYTES_MAX {
            self.sent.push(byte);
        }
    }

    /// The master takes a byte.
    pub(crate) fn read(&mut self) -> u8 {
        let byte = self.answer.get(self.at).copied().unwrap_or(0);
        self.note(self.at);
        self.at += 1;
        byte
    }

    /// The transfer is over.
    pub(crate) fn stop(&mut self, now_ns: u64) {
        self.take_sent(now_ns);
    }

    /// The chip select went low.
    pub(crate) fn select(&mut self, now_ns: u64) {
        self.sent.clear();
        self.answer.clear();
        self.began_ns = now_ns;
    }

    /// The chip select went high.
    pub(crate) fn deselect(&mut self, now_ns: u64) {
        let is_reading =
            self.sent.first().is_some_and(|first| first & self.protocol.read_mask != 0);
        let is_exchange = self.readings.iter().any(|one| !one.exchange.is_empty());
        if is_exchange || (is_reading && self.protocol.read_mask != 0) {
            self.sent.clear();
        } else {
            self.take_sent(now_ns);
        }
    }

    /// A byte goes out and another one comes in while the part is selected.
    pub(crate) fn exchange(&mut self, out: u8, subjects: &[Subject]) -> u8 {
        self.write(out);
        let now_ns = self.began_ns;
        let place = self.sent.len();
        let said =
            |one: &&Reading| !one.exchange.is_empty() && one.exchange.starts_with(&self.sent);
        if let Some(first) = self.readings.iter().find(said) {
            let same: Vec<&Reading> =
                self.readings.iter().filter(|one| one.exchange == first.exchange).collect();
            let bytes = merged(&self.bytes_of(&same, subjects, now_ns));
            self.used();
            return place.checked_sub(1).and_then(|at| bytes.get(at)).copied().unwrap_or(0);
        }
        let selected = |one: &&Reading| {
            !one.select.is_empty() && place > one.select.len() && self.sent.starts_with(&one.select)
        };
        if let Some(one) = self.readings.iter().find(selected) {
            let bytes = merged(&self.bytes_of(&[one], subjects, now_ns));
            let first = one.select.len();
            self.used();
            return bytes.get(place - first - 1).copied().unwrap_or(0);
        }
        let width = self.width();
        if place <= width {
            return 0;
        }
        if self.answer.is_empty() {
            let number =
                self.sent.iter().take(width).fold(0, |sum, byte| sum << 8 | u16::from(*byte));
            let mask = u16::from(self.protocol.read_mask) << (8 * (width - 1));
            self.pointer = Some(number & !mask);
            self.taken(now_ns);
            self.answer = self.answer(subjects, now_ns);
        }
        // Whoever writes gets bytes as well, which mean nothing.
        let first = self.sent.first().copied().unwrap_or(0);
        if first & self.protocol.read_mask != 0 || self.protocol.read_mask == 0 {
            self.note(place - width - 1);
        }
        self.answer.get(place - width - 1).copied().unwrap_or(0)
    }

    /// Bytes of a register's number.
    fn width(&self) -> usize {
        usize::from(self.protocol.register_bytes.clamp(1, 2))
    }

    /// What the bytes that were written mean: a trigger, or a register and what it is to hold.
    fn take_sent(&mut self, now_ns: u64) {
        let sent = std::mem::take(&mut self.sent);
        if sent.is_empty() {
            return;
        }
        if self.init().nth(self.begun) == Some(sent.as_slice()) {
            self.begun += 1;
        }
        let width = self.width();
        let first = sent.iter().take(width).fold(0, |sum, byte| sum << 8 | u16::from(*byte));
        self.controls.extend((first..=u16::MAX).zip(sent.iter().skip(width).copied()));
        if let Some(one) = self.readings.iter().find(|one| one.trigger == sent) {
            // A driver names the longest time; parts are a little faster.
            let ready_ns = now_ns.saturating_add(one.wait_ns - one.wait_ns / 50);
            let wait_ns = Some(one.wait_ns);
            self.measurement =
                Some(Measurement { trigger: sent, began_ns: now_ns, ready_ns, wait_ns });
            self.pointer = None;
            return;
        }
        self.pointer = Some(first);
        for (register, byte) in (first..=u16::MAX).zip(sent.iter().skip(width)) {
            self.written.insert(register, *byte);
        }
    }

    /// The bytes from the selected register on.
    fn answer(&self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        let Some(pointer) = self.pointer else {
            let open: Vec<&Reading> = self.live().filter(|one| one.register.is_none()).collect();
            return merged(&self.bytes_of(&open, subjects, now_ns));
        };
        let has_crc = |one: &&Reading| one.words.as_ref().is_some_and(|words| words.crc.is_some());
        let exact: Vec<&Reading> =
            self.live().filter(|one| one.register == Some(pointer)).collect();
        if exact.is_empty()
            && self.live().all(|one| one.register.is_none())
            && !self.is_known(pointer)
        {
            // A part without registers: what was written says nothing of what is read.
            let open: Vec<&Reading> = self.live().collect();
            return merged(&self.bytes_of(&open, subjects, now_ns));
        }
        if self.protocol.is_one_by_one || exact.iter().any(has_crc) {
            if let Some(identity) =
                self.protocol.identity.as_ref().filter(|one| one.register == pointer)
            {
                return identity.expected.clone();
            }
            let values = merged(&self.bytes_of(&exact, subjects, now_ns));
            return if values.is_empty() { self.kept(pointer) } else { values };
        }
        let mut image = self.written.clone();
        let mut put = |first: u16, bytes: &[u8]| {
            for (register, byte) in (first..=u16::MAX).zip(bytes) {
                image.insert(register, *byte);
            }
        };
        if let Some(identity) = &self.protocol.identity {
            put(identity.register, &identity.expected);
        }
        let mut calibration = self.protocol.formula.map(formula::calibration).unwrap_or_default();
        for (register, count) in &self.protocol.calibration {
            let (bytes, rest) = calibration.split_at(usize::from(*count).min(calibration.len()));
            put(*register, bytes);
            calibration = rest;
        }
        let mut values: BTreeMap<u16, u8> = BTreeMap::new();
        for one in self.live() {
            let Some(first) = one.register else { continue };
            for (place, byte) in self.bytes_of(&[one], subjects, now_ns).into_iter().flatten() {
                let place = u16::try_from(place).unwrap_or(u16::MAX);
                *values.entry(first.saturating_add(place)).or_insert(0) |= byte;
            }
        }
        image.extend(values);
        let bytes = (pointer..=u16::MAX).take(READ_BYTES_MAX);
        bytes.map(|register| image.get(&register).copied().unwrap_or(0)).collect()
    }

    /// Whether the driver says what a register holds.
    fn is_known(&self, register: u16) -> bool {
        let is_identity =
            self.protocol.identity.as_ref().is_some_and(|one| one.register == register);
        is_identity || self.protocol.calibration.iter().any(|(first, _)| *first == register)
    }

    fn kept(&self, first: u16) -> Vec<u8> {
        let registers = first..=first.saturating_add(8);
        registers.map(|register| self.written.get(&register).copied().unwrap_or(0)).collect()
    }

    /// The readings whose measurement was the last one, and those that need none.
    fn live(&self) -> impl Iterator<Item = &Reading> {
        let last = self.measurement.as_ref().map(|one| &one.trigger);
        self.readings.iter().filter(move |one| one.trigger.is_empty() || Some(&one.trigger) == last)
    }

    /// The bytes of readings, each with its place behind the register.
    fn bytes_of(
        &self,
        readings: &[&Reading],
        subjects: &[Subject],
        now_ns: u64,
    ) -> Vec<Vec<(usize, u8)>> {
        // The registers of what a part that sleeps would measure hold 0.
        if self.sleep.is_some_and(|sleep| sleep.is_asleep(&self.controls)) {
            return Vec::new();
        }
        let of = |one: &&Reading| {
            let measured = self.measurement.as_ref().filter(|_| !one.trigger.is_empty());
            let at_ns = measured.map_or(now_ns, |measured| measured.began_ns);
            let at_ns = match one.ranges.period_ns(&self.controls) {
                Some(period_ns) => at_ns - at_ns % period_ns.max(1),
                None => at_ns,
            };
            let factor = one.ranges.factor(&self.controls);
            if factor == 0.0 {
                return None;
            }
            let bytes = match (one.output, self.protocol.formula, &one.words) {
                (Some(_), Some(formula), _) => self.computed(formula, subjects, at_ns),
                (_, _, Some(coded)) => {
                    let subject = subjects.get(one.subject)?;
                    let elements = 0..subject.signals.len();
                    let raw: Vec<f64> =
                        elements.map(|one| factor * subject.raw(one, at_ns)).collect();
                    words::bytes(coded, &raw)
                }
                (_, _, None) => return None,
            };
            let is_exchange = !one.exchange.is_empty();
            let byte = if is_exchange || one.output.is_some() { 0 } else { one.byte };
            let first = one.words.as_ref().map_or(byte, |words| words.on_wire(byte));
            Some((usize::from(first)..).zip(bytes).collect())
        };
        readings.iter().filter_map(of).collect()
    }

    /// The raw bytes of all outputs of the formula.
    fn computed(&self, of: Formula, subjects: &[Subject], at_ns: u64) -> Vec<u8> {
        let wanted = [0, 1, 2].map(|output| {
            let measures = |one: &&Reading| one.ranges.factor(&self.controls) > 0.0;
            let own = self.readings.iter().find(|one| one.output == Some(output));
            let one = own.filter(measures)?;
            Some(subjects.get(one.subject)?.raw(0, at_ns))
        });
        formula::raw(of, &self.protocol.parameters, wanted)
    }
}

/// Bytes at their places in one piece.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<String>>().join(" ")
}

fn merged(all: &[Vec<(usize, u8)>]) -> Vec<u8> {
    let end = all.iter().flatten().map(|(place, _)| place + 1).max().unwrap_or(0);
    let mut bytes = vec![0; end];
    for (place, byte) in all.iter().flatten() {
        if let Some(target) = bytes.get_mut(*place) {
            *target |= byte;
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The part of a driver that writes `6B 00` and reads two bytes from `3B` on.
    fn part() -> Registers {
        let init = vec![InitStep::Write(vec![0x6B, 0x00])];
        let reading = Reading {
            subject: 0,
            trigger: Vec::new(),
            wait_ns: 0,
            register: Some(0x3B),
            select: Vec::new(),
            exchange: Vec::new(),
            byte: 0,
            length: 2,
            words: None,
            output: None,
            ranges: Ranges::default(),
        };
        let protocol = Protocol { init, register_bytes: 1, ..Protocol::default() };
        Registers::new(protocol, vec![reading], None)
    }

    fn write(part: &mut Registers, bytes: &[u8]) {
        part.start(false, &[], 0);
        bytes.iter().for_each(|byte| part.write(*byte));
    }

    fn read(part: &mut Registers, count: usize) {
        write(part, &[0x3B]);
        part.start(true, &[], 0);
        (0..count).for_each(|_| {
            let _ = part.read();
        });
        part.stop(0);
    }

    #[test]
    fn a_part_is_set_up_and_read_as_its_driver_says() {
        let mut right = part();
        write(&mut right, &[0x6B, 0x00]);
        right.stop(0);
        read(&mut right, 2);
        assert_eq!(right.odd(), None);
        read(&mut right, 3);
        assert!(
            right.odd().unwrap().starts_with("more is read from register 0x3B on than 2 bytes")
        );
        for bytes in [&[][..], &[0x6B, 0x01], &[0x6B]] {
            let mut other = part();
            write(&mut other, bytes);
            other.stop(0);
            read(&mut other, 2);
            assert!(other.odd().unwrap().contains("before 6B 00 is written"), "{bytes:02X?}");
        }
    }
}
