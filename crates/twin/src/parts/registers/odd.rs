//! Transfers of a board that a part's driver does not describe. In: the transfers. Out: the first such oddity.

use sensedsl_model::protocol::InitStep;

use super::Registers;

impl Registers {
    /// The first thing that the board did and the part's driver does not describe, if there is one.
    pub(crate) fn odd(&self) -> Option<&str> {
        self.odd.as_deref()
    }

    /// The error if the board waits too long for it, on a bus shared by this many parts.
    pub(crate) fn waits_too_long(&self, parts: u64) -> Option<String> {
        self.waits.too_long(parts)
    }

    /// A pause required by its driver that the board has not kept.
    pub(crate) fn not_left_alone(&self) -> Option<String> {
        self.rest.broken()
    }

    /// The missing setup write of a part that is only written to. For a part that is read, this is reported at the
    /// first read.
    pub(crate) fn not_set_up(&self) -> Option<String> {
        let missing = self.init().nth(self.begun).filter(|_| !self.controls.is_empty())?;
        Some(format!("{} is never written, which sets it up", hex(missing)))
    }

    /// A read starts: it takes the last measurement.
    pub(super) fn taken(&mut self, now_ns: u64) {
        if let Some(measurement) = &mut self.measurement
            && let Some(wait_ns) = measurement.wait_ns.take()
        {
            self.waits.take(wait_ns, measurement.began_ns, now_ns);
        }
    }

    /// A value is read: the part's setup must have been written.
    pub(super) fn used(&mut self) {
        self.is_used = true;
        let mut writes = self.init();
        if let Some(missing) = writes.nth(self.begun) {
            let missing = hex(missing);
            drop(writes);
            self.record(|| {
                format!("values are read before {missing} is written, which sets it up")
            });
        }
    }

    /// The writes that set it up; none for a part that is read while it is written, where they cannot be told apart
    /// from reads.
    pub(super) fn init(&self) -> impl Iterator<Item = &[u8]> {
        let is_reported = self.readings.iter().all(|one| one.exchange.is_empty());
        self.protocol.init.iter().filter(move |_| is_reported).filter_map(|step| match step {
            InitStep::Write(bytes) => Some(bytes.as_slice()),
            InitStep::Wait { .. } => None,
        })
    }

    fn record(&mut self, what: impl FnOnce() -> String) {
        if self.odd.is_none() {
            self.odd = Some(what());
        }
    }

    /// The number of bytes from a register on that the driver describes; `None` if it does not know the register.
    fn end_of(&self, pointer: Option<u16>) -> Option<u16> {
        // Calibration is read block by block, whatever is after it.
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

    /// For a part that was read without asking for its identity: whether its driver gives one.
    pub(crate) fn is_unasked(&self) -> Option<bool> {
        (self.is_used && !self.is_asked).then_some(self.protocol.identity.is_some())
    }

    /// A byte of the answer is taken.
    pub(super) fn note(&mut self, place: usize) {
        let place = u16::try_from(place).unwrap_or(u16::MAX);
        let register = self.pointer.map(|first| first.saturating_add(place));
        let identity = self.protocol.identity.as_ref();
        if register.is_some() && register == identity.map(|one| one.register) {
            self.is_asked = true;
        } else {
            self.used();
        }
        let end = self.end_of(self.pointer).map(|end| end.max(self.least_bytes));
        if let Some(end) = end.filter(|end| *end <= place) {
            let from = self.pointer.map(|at| format!(" from register 0x{at:02X} on"));
            let from = from.unwrap_or_default();
            self.record(|| format!("more is read{from} than {end} bytes, which is all there is"));
        }
    }
}

pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<String>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::super::Reading;
    use super::*;
    use sensedsl_model::protocol::Protocol;

    /// The part of a driver that writes `6B 00` and reads two bytes from `3B` on.
    fn part() -> Registers {
        let init = vec![InitStep::Write(vec![0x6B, 0x00])];
        let reading = Reading { register: Some(0x3B), length: 2, ..Reading::default() };
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
