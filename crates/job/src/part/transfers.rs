//! Which bytes of a chip are read together.
//!
//! Each reading needs bytes from a register on. Neighbours are read in one transfer, which costs one address instead of
//! several, and their values are from the same moment, as they must be if a measurement was started for them.

use sensedsl_model::design::Device;
use sensedsl_model::kind::RegisterAccess;
use sensedsl_model::protocol::Protocol;
use sensedsl_model::words::Words;

/// The largest gap between two readings that is read and discarded: about the cost of a separate transfer.
const GAP_BYTES: u32 = 4;
/// The largest such gap between readings of the same measurement: starting another one costs more than any gap.
const GAP_OF_MEASUREMENT_BYTES: u32 = 16;
/// The most bytes that neighbours may have to be read together.
const TOGETHER_BYTES_MAX: u32 = 128;

/// An `up_chip_transfer_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TransferPlan {
    /// The bytes that start a measurement; empty for none.
    pub trigger: Vec<u8>,
    /// The bytes written before reading, or sent in an exchange.
    pub select: Vec<u8>,
    /// The time from one measurement to the next.
    pub cycle_ms: u32,
    /// The time from the trigger to the reading.
    pub wait_ms: u32,
    /// The number of bytes read, including checksums.
    pub length: u16,
    /// True if the bytes read are those received while `select` is sent.
    pub is_exchange: bool,
}

/// The place of a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) transfer: usize,
    pub(super) offset: u16,
}

/// The bytes that are written to select what is read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Select {
    /// The number of the first register.
    Register,
    /// These bytes, possibly none.
    Bytes(Vec<u8>),
    /// These bytes, and as many are received while they are sent.
    Exchange(Vec<u8>),
}

/// The properties that all readings of a transfer share.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    trigger: Vec<u8>,
    wait_ms: u32,
    cycle_ms: u32,
    has_crc: bool,
    select: Select,
}

/// The bytes that a reading needs, without checksums.
struct NeededBytes {
    key: Key,
    register: u32,
    end: u32,
    /// The offset of its own bytes after the register.
    byte: u16,
}

/// Bytes that are read together.
struct CombinedRead {
    key: Key,
    register: u32,
    end: u32,
    /// Whether it holds only readings of this very register: the part answers to each register by itself, or there
    /// are checksums in between.
    is_alone: bool,
}

/// The transfers of a chip, and the place of each of its readings.
pub(super) fn plan(
    readings: &[&Device],
    protocol: &Protocol,
) -> (Vec<TransferPlan>, Vec<Option<Place>>) {
    let wanted: Vec<Option<NeededBytes>> = readings.iter().map(|device| wanted(device)).collect();
    let mut sorted: Vec<&NeededBytes> = wanted.iter().flatten().collect();
    sorted.sort_by_key(|one| (&one.key, one.register, one.end));
    let mut all: Vec<CombinedRead> = Vec::new();
    for one in sorted {
        match all.last_mut().filter(|last| last.takes(one)) {
            Some(last) => last.end = last.end.max(one.end),
            None => {
                all.push(CombinedRead {
                    key: one.key.clone(),
                    register: one.register,
                    end: one.end,
                    is_alone: protocol.is_one_by_one || one.key.has_crc,
                });
            }
        }
    }
    // In the file order of the first value of each.
    let first = |together: &CombinedRead| wanted.iter().flatten().position(|one| together.has(one));
    all.sort_by_key(first);
    let places = wanted.iter().map(|one| {
        let one = one.as_ref()?;
        let transfer = all.iter().position(|together| together.has(one))?;
        Some(Place { transfer, offset: all.get(transfer)?.offset(one) })
    });
    let places = places.collect();
    (all.iter().map(|together| together.plan(protocol)).collect(), places)
}

/// The bytes that a reading needs; `None` if it is not on a register bus.
fn wanted(device: &Device) -> Option<NeededBytes> {
    let coding = &device.coding;
    let RegisterAccess { trigger, wait_us, register, read, length_bytes, address: _ } =
        device.kind.register_access()?;
    let words = Words::of(device).filter(|_| coding.output.is_none());
    let length = words.as_ref().map_or(length_bytes, |words| words.data_bytes);
    let select = match register {
        _ if !coding.exchange.is_empty() => Select::Exchange(coding.exchange.clone()),
        Some(_) if read.is_empty() => Select::Register,
        Some(_) | None => Select::Bytes(read.to_vec()),
    };
    let first = if select == Select::Register { u32::from(register.unwrap_or(0)) } else { 0 };
    let byte = if matches!(select, Select::Exchange(_)) { 0 } else { coding.byte };
    let key = Key {
        trigger: trigger.to_vec(),
        wait_ms: wait_us.div_ceil(1_000),
        cycle_ms: device.delay_ms,
        has_crc: words.is_some_and(|words| words.crc.is_some()),
        select,
    };
    let bytes = byte.saturating_add(length).max(device.kind.answer_bytes().unwrap_or(0));
    Some(NeededBytes { key, register: first, end: first + u32::from(bytes), byte })
}

impl CombinedRead {
    /// Whether the transfer also covers the reading, which begins no earlier.
    fn takes(&self, one: &NeededBytes) -> bool {
        if self.key != one.key {
            return false;
        }
        if one.register == self.register {
            return true;
        }
        let gap = if self.key.trigger.is_empty() { GAP_BYTES } else { GAP_OF_MEASUREMENT_BYTES };
        let is_short = one.end.max(self.end) - self.register <= TOGETHER_BYTES_MAX;
        !self.is_alone && one.register <= self.end.saturating_add(gap) && is_short
    }

    fn has(&self, one: &NeededBytes) -> bool {
        let is_in = self.register <= one.register && one.end <= self.end;
        self.key == one.key && is_in && (!self.is_alone || self.register == one.register)
    }

    fn on_wire(&self, byte: u32) -> u16 {
        let bytes = if self.key.has_crc { byte + byte / 2 } else { byte };
        u16::try_from(bytes).unwrap_or(u16::MAX)
    }

    fn offset(&self, one: &NeededBytes) -> u16 {
        self.on_wire(one.register - self.register + u32::from(one.byte))
    }

    fn plan(&self, protocol: &Protocol) -> TransferPlan {
        let select = match &self.key.select {
            Select::Register => register_to_read(self.register, protocol),
            Select::Bytes(bytes) | Select::Exchange(bytes) => bytes.clone(),
        };
        TransferPlan {
            trigger: self.key.trigger.clone(),
            select,
            cycle_ms: self.key.cycle_ms,
            wait_ms: self.key.wait_ms,
            length: self.on_wire(self.end - self.register),
            is_exchange: matches!(self.key.select, Select::Exchange(_)),
        }
    }
}

/// The bytes of a register's number for reading: on some buses a bit in it marks a read.
pub(super) fn register_to_read(number: u32, protocol: &Protocol) -> Vec<u8> {
    let mut bytes = protocol.register(number);
    if let Some(first) = bytes.first_mut() {
        *first |= protocol.read_mask;
    }
    bytes
}
