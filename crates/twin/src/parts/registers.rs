//! A part with registers on I2C or SPI: its answers, byte by byte, as its driver describes them.
//!
//! Written values are kept and can be read back. The registers of readings have the world's values, and those of an
//! identity or a calibration have what the driver gives. A trigger starts a measurement; the part does not answer until
//! it is done.

mod odd;
mod rest;

use std::collections::BTreeMap;

use sensedsl_model::protocol::{Formula, Protocol};
use sensedsl_model::words::Words;

use rest::Pause;

use super::ranges::Ranges;
use super::sleep::Sleep;
use super::waits::Waits;
use super::{formula, words};
use crate::truth::Subject;

/// The greatest number of bytes in one read.
const READ_BYTES_MAX: usize = 2_112;

/// A value of the part.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reading {
    /// The index of the subject.
    pub(crate) subject: usize,
    /// The bytes that start its measurement; empty for none.
    pub(crate) trigger: Vec<u8>,
    /// The length of a measurement.
    pub(crate) wait_ns: u64,
    /// Its register; `None` if it is read without one.
    pub(crate) register: Option<u16>,
    /// The bytes sent before it is read, on SPI.
    pub(crate) select: Vec<u8>,
    /// The bytes sent while it is read, on SPI.
    pub(crate) exchange: Vec<u8>,
    /// The byte, counted from the register, at which it starts.
    pub(crate) byte: u16,
    /// The number of bytes in a transfer that reads it.
    pub(crate) length: u16,
    /// The coding; `None` if the formula gives it.
    pub(crate) words: Option<Words>,
    /// The output of the formula that it is.
    pub(crate) output: Option<u8>,
    /// The ranges and rates that the part's registers set for it.
    pub(crate) ranges: Ranges,
}

impl Reading {
    /// Whether nothing is sent before or while it is read.
    fn is_only_read(&self) -> bool {
        self.register.is_none() && self.select.is_empty() && self.exchange.is_empty()
    }
}

/// A measurement that was started.
#[derive(Clone, Debug)]
struct Measurement {
    trigger: Vec<u8>,
    began_ns: u64,
    ready_ns: u64,
    /// How long it lasts; `None` once it was read.
    wait_ns: Option<u64>,
}

/// A part with registers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Registers {
    protocol: Protocol,
    readings: Vec<Reading>,
    written: BTreeMap<u16, u8>,
    /// The register that wakes it, and everything that was written, including triggers.
    sleep: Option<Sleep>,
    controls: BTreeMap<u16, u8>,
    /// The bytes that the master has sent in this transfer.
    sent: Vec<u8>,
    pointer: Option<u16>,
    measurement: Option<Measurement>,
    /// The bytes that are read in this transfer.
    answer: Vec<u8>,
    at: usize,
    /// The fewest bytes that the board's driver reads at once; what a part has no byte for it drops.
    least_bytes: u16,
    began_ns: u64,
    /// Whether its identity was read, and whether anything else was.
    is_asked: bool,
    is_used: bool,
    /// The number of setup writes so far, and the first thing the board did that the driver does not describe.
    begun: usize,
    odd: Option<String>,
    waits: Waits,
    /// The pause that it needs.
    rest: Pause,
}

impl Registers {
    pub(crate) fn new(protocol: Protocol, readings: Vec<Reading>, sleep: Option<Sleep>) -> Self {
        Self { protocol, readings, sleep, ..Self::default() }
    }

    /// On a bus whose driver reads at least that many bytes.
    pub(crate) fn read_at_least(self, least_bytes: u16) -> Self {
        Self { least_bytes, ..self }
    }

    /// The supply was lost.
    pub(crate) fn reset(&mut self) {
        let readings = std::mem::take(&mut self.readings);
        let (is_asked, is_used, odd) = (self.is_asked, self.is_used, self.odd.take());
        let new = Self::new(self.protocol.clone(), readings, self.sleep);
        let new = new.read_at_least(self.least_bytes);
        *self = Self { is_asked, is_used, odd, waits: self.waits, rest: self.rest.again(), ..new };
    }

    /// The time from one measurement to the next, as the design sets it up.
    pub(crate) fn held_ns(&self) -> u64 {
        self.readings.iter().map(|one| one.ranges.planned_ns()).max().unwrap_or(0)
    }

    /// Whether it is measuring and does not answer meanwhile. A part that needs initialisation or has several triggers
    /// has separate logic for its bus, and always answers.
    pub(crate) fn is_busy(&self, now_ns: u64) -> bool {
        let first = self.readings.first().map(|one| &one.trigger);
        let is_simple = self.protocol.init.is_empty()
            && self.readings.iter().all(|one| Some(&one.trigger) == first);
        is_simple && self.measurement.as_ref().is_some_and(|one| now_ns < one.ready_ns)
    }

    /// A transfer begins, or goes on in the other direction.
    pub(crate) fn start(&mut self, read: bool, subjects: &[Subject], now_ns: u64) {
        self.rest.touch(now_ns);
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
        self.rest.touch(now_ns);
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
        let reported =
            |one: &&Reading| !one.exchange.is_empty() && one.exchange.starts_with(&self.sent);
        if let Some(first) = self.readings.iter().find(reported) {
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
        // A part that is only read gives its first byte at once, unless something is written to it.
        let is_only_read = !self.readings.is_empty()
            && self.readings.iter().all(Reading::is_only_read)
            && self.sent.iter().all(|byte| *byte == 0);
        let is_trigger = |one: &Reading| one.trigger.starts_with(&self.sent);
        let width = if is_only_read { 0 } else { self.width() };
        if place <= width || (is_only_read && self.readings.iter().any(is_trigger)) {
            return 0;
        }
        if self.answer.is_empty() {
            let number =
                self.sent.iter().take(width).fold(0, |sum, byte| sum << 8 | u16::from(*byte));
            let mask = u16::from(self.protocol.read_mask) << (8 * width.saturating_sub(1));
            self.pointer = (!is_only_read).then_some(number & !mask);
            self.taken(now_ns);
            self.answer = self.answer(subjects, now_ns);
        }
        // A write also returns bytes, which mean nothing.
        let first = self.sent.first().copied().unwrap_or(0);
        let is_read = first & self.protocol.read_mask != 0 || self.protocol.read_mask == 0;
        // Without a mask a setup write looks like a read until it has ended.
        let is_setup =
            self.init().nth(self.begun).is_some_and(|bytes| bytes.starts_with(&self.sent));
        if is_read && !is_setup {
            self.note(place - width - 1);
        }
        self.answer.get(place - width - 1).copied().unwrap_or(0)
    }

    /// The number of bytes in a register's number.
    fn width(&self) -> usize {
        usize::from(self.protocol.register_bytes.clamp(1, 2))
    }

    /// Handles the written bytes: a trigger, or a register and its new contents.
    fn take_sent(&mut self, now_ns: u64) {
        let sent = std::mem::take(&mut self.sent);
        if sent.is_empty() {
            return;
        }
        if self.init().nth(self.begun) == Some(sent.as_slice()) {
            self.begun += 1;
            self.rest.begin(&self.protocol.init, self.begun, now_ns);
        }
        let width = self.width();
        let first = sent.iter().take(width).fold(0, |sum, byte| sum << 8 | u16::from(*byte));
        self.controls.extend((first..=u16::MAX).zip(sent.iter().skip(width).copied()));
        if let Some(one) = self.readings.iter().find(|one| one.trigger == sent) {
            // A driver gives the longest time; parts are a little faster.
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
            // A part without registers: the bytes written do not affect the bytes read.
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

    /// Whether the driver describes a register's contents.
    fn is_known(&self, register: u16) -> bool {
        let is_identity =
            self.protocol.identity.as_ref().is_some_and(|one| one.register == register);
        is_identity || self.protocol.calibration.iter().any(|(first, _)| *first == register)
    }

    fn kept(&self, first: u16) -> Vec<u8> {
        let registers = first..=first.saturating_add(8);
        registers.map(|register| self.written.get(&register).copied().unwrap_or(0)).collect()
    }

    /// The readings of the last measurement, and those that need none.
    fn live(&self) -> impl Iterator<Item = &Reading> {
        let last = self.measurement.as_ref().map(|one| &one.trigger);
        self.readings.iter().filter(move |one| one.trigger.is_empty() || Some(&one.trigger) == last)
    }

    /// The bytes of readings, each with its offset from the register.
    fn bytes_of(
        &self,
        readings: &[&Reading],
        subjects: &[Subject],
        now_ns: u64,
    ) -> Vec<Vec<(usize, u8)>> {
        // In a part that sleeps, the registers of measured values hold 0.
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

/// Bytes at their offsets, joined to one answer.
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
