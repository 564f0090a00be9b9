//! Parts on one wire: what they answer, byte by byte, and on the wire itself as slots and bursts.
//!
//! In: the pulses of the board, or the bytes that it sends. Out: when a part pulls the wire low, or its bytes. A pulse
//! that a data sheet forbids makes a part deaf until the next reset, so that firmware must keep the times.

mod wire;

use sensedsl_model::design::{ConnectionIndex, PartIndex};
use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};
use sensedsl_model::words::Words;

use super::words::{self, crc8};
use crate::truth::Subject;

pub(crate) use wire::Wire;

/// The polynomial of 1-Wire, the highest bit first.
const POLYNOMIAL: u8 = 0x31;
/// The time that a part of the DHT22's sort needs once it has power.
const WAKE_NS: u64 = 1_000_000_000;
/// Writes the limits of an alarm and the configuration, which are read back.
const WRITE_SCRATCHPAD: u8 = 0x4E;
/// A scratchpad once the supply came, without its checksum: 85 degrees.
const AT_POWER: [u8; 8] = [0x50, 0x05, 0x4B, 0x46, 0x7F, 0xFF, 0x0C, 0x10];

/// A value of a part.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    /// The index of the subject.
    pub(crate) subject: usize,
    /// Its first byte in the answer.
    pub(crate) byte: u16,
    /// How it is coded.
    pub(crate) words: Words,
}

/// What is wrong with a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Ailment {
    /// It does not answer.
    pub(crate) is_gone: bool,
    /// It answers late.
    pub(crate) is_late: bool,
    /// A bit of its answer is another one than its checksum is of.
    pub(crate) is_spoiled: bool,
}

/// A part.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) part: PartIndex,
    pub(crate) connection: ConnectionIndex,
    own: OneWire,
    readings: Vec<Reading>,
    rom: [u8; 8],
    /// What was written to the scratchpad.
    settings: [u8; 3],
    /// When the supply came, when it was last read, and when its measurement began.
    powered_ns: u64,
    read_ns: Option<u64>,
    began_ns: Option<u64>,
    pub(crate) ailment: Ailment,
}

impl Part {
    pub(crate) fn new(
        (part, connection): (PartIndex, ConnectionIndex),
        own: &OneWire,
        readings: Vec<Reading>,
    ) -> Self {
        // Without an address, any one will do.
        let mut rom = [own.family.unwrap_or(0x28), 0x1A, 0x31, 0x5F, 0x05, 0, 0, 0];
        let [head @ .., check] = &mut rom;
        *check = checksum(head);
        Self {
            part,
            connection,
            own: own.clone(),
            readings,
            rom: own.rom.map_or(rom, |rom| rom.bytes),
            settings: [0x4B, 0x46, 0x7F],
            powered_ns: 0,
            read_ns: None,
            began_ns: None,
            ailment: Ailment::default(),
        }
    }

    /// The supply was lost, and is back.
    pub(crate) fn reset(&mut self, now_ns: u64) {
        self.settings = [0x4B, 0x46, 0x7F];
        (self.powered_ns, self.read_ns, self.began_ns) = (now_ns, None, None);
    }

    /// Whether it is a part on 1-Wire.
    fn is_w1(&self) -> bool {
        self.own.protocol == OneWireProtocol::W1
    }

    /// Whether a pulse of that length makes it send a burst now.
    fn wakes(&self, low_ns: u64, now_ns: u64) -> bool {
        let pulse_ns = 1_000 * u64::from(self.own.pulse_us);
        // One that was asked a moment ago, or has just got its power, does not answer.
        let rest_ns = 1_000 * u64::from(self.own.rest_us);
        let is_rested =
            self.read_ns.is_none_or(|read_ns| now_ns >= read_ns + rest_ns - rest_ns / 20);
        let is_awake = now_ns >= self.powered_ns + WAKE_NS.min(rest_ns / 2);
        low_ns >= pulse_ns - pulse_ns / 5 && is_rested && is_awake
    }

    /// Whether it is measuring.
    fn is_busy(&self, now_ns: u64) -> bool {
        // A driver gives the longest time; parts are a little faster.
        let wait_ns = 1_000 * u64::from(self.own.wait_us);
        self.began_ns.is_some_and(|began_ns| now_ns < began_ns + wait_ns - wait_ns / 50)
    }

    /// A command of 1-Wire has come; the bytes that are to be read then, none if it is not whole or for writing.
    fn command(&mut self, sent: &[u8], subjects: &[Subject], now_ns: u64) -> Option<Vec<u8>> {
        if !self.own.trigger.is_empty() && sent == self.own.trigger {
            self.began_ns = Some(now_ns);
            return None;
        }
        if let [WRITE_SCRATCHPAD, high, low, config] = sent {
            self.settings = [*high, *low, *config];
        }
        (sent == self.own.read).then(|| self.scratchpad(subjects, now_ns))
    }

    /// The scratchpad, with what was measured last.
    fn scratchpad(&self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        let mut bytes = AT_POWER.to_vec();
        if let Some(settings) = bytes.get_mut(2..5) {
            settings.copy_from_slice(&self.settings);
        }
        let measured_ns = if self.own.trigger.is_empty() { Some(now_ns) } else { self.began_ns };
        if let Some(at_ns) = measured_ns.filter(|_| !self.is_busy(now_ns)) {
            self.put(&mut bytes, subjects, at_ns);
        }
        bytes.push(checksum(&bytes));
        self.spoil(bytes)
    }

    /// A burst.
    fn burst(&mut self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        self.read_ns = Some(now_ns);
        let mut bytes = vec![0; 4];
        self.put(&mut bytes, subjects, now_ns);
        bytes.push(bytes.iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte)));
        self.spoil(bytes)
    }

    /// The values at a moment, each at its place.
    fn put(&self, bytes: &mut [u8], subjects: &[Subject], at_ns: u64) {
        for one in &self.readings {
            let Some(subject) = subjects.get(one.subject) else { continue };
            let elements = 0..subject.signals.len();
            let raw: Vec<f64> = elements.map(|element| subject.raw(element, at_ns)).collect();
            let coded = words::bytes(&one.words, &raw);
            for (target, byte) in bytes.iter_mut().skip(usize::from(one.byte)).zip(coded) {
                *target = byte;
            }
        }
    }

    fn spoil(&self, mut bytes: Vec<u8>) -> Vec<u8> {
        if let Some(first) = bytes.first_mut().filter(|_| self.ailment.is_spoiled) {
            *first ^= 0x04;
        }
        bytes
    }

    /// What a whole transfer gives, for a board that makes no slots; `None` if nothing answers.
    pub(crate) fn transfer(
        &mut self,
        sent: &[u8],
        subjects: &[Subject],
        now_ns: u64,
    ) -> Option<Vec<u8>> {
        let Ailment { is_gone, is_late, .. } = self.ailment;
        if is_gone || is_late {
            return None;
        }
        if !self.is_w1() {
            let wakes = self.wakes(1_000 * u64::from(self.own.pulse_us), now_ns);
            return wakes.then(|| self.burst(subjects, now_ns));
        }
        if sent == [READ_ROM] {
            return Some(self.rom.to_vec());
        }
        Some(self.command(sent, subjects, now_ns).unwrap_or_default())
    }
}

/// Asks the only part on a wire for its address.
const READ_ROM: u8 = 0x33;

/// The checksum of 1-Wire, whose bits are the other way round than those of most.
fn checksum(bytes: &[u8]) -> u8 {
    let turned: Vec<u8> = bytes.iter().map(|byte| byte.reverse_bits()).collect();
    crc8(&turned, POLYNOMIAL, 0).reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::checksum;

    #[test]
    fn the_checksum_is_that_of_the_application_note() {
        assert_eq!(checksum(&[0x02, 0x1C, 0xB8, 0x01, 0x00, 0x00, 0x00]), 0xA2);
    }
}
