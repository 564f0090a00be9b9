//! The expected writes to chips.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::kind::encoding::Encoding;
use sensedsl_model::protocol::{InitStep, Protocol};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::expect::{Expectation, Expected, expected};
use crate::parts::{lamps, letters, words};

/// A transfer to a chip.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Written {
    pub(super) bytes: Vec<u8>,
    /// The number of bytes at the start that identify the register.
    pub(super) begins: usize,
    /// The bits that are checked; the others belong to other devices.
    mask: Vec<u8>,
}

impl Written {
    /// Whether a transfer matches, in the bits that belong to this device.
    pub(super) fn is(&self, found: &[u8]) -> bool {
        let mut pairs = self.bytes.iter().zip(found).zip(&self.mask);
        found.len() == self.bytes.len()
            && pairs.all(|((one, other), mask)| (one ^ other) & mask == 0)
    }

    /// Whether other devices have bits of the same register, so that their transfers must keep this value.
    pub(super) fn is_shared(&self) -> bool {
        self.mask.iter().any(|mask| *mask != 0xFF)
    }

    /// The bits that are checked; `None` if all of them are.
    pub(super) fn mask(&self) -> Option<&[u8]> {
        self.is_shared().then_some(&self.mask)
    }
}

/// The register that a device is written to; `None` if it is not on a register bus. The inner `None` is a device
/// without a register number.
fn register(one: &JobDevice<'_>) -> Option<Option<u16>> {
    one.device.kind.register_access().map(|own| own.register)
}

/// A value in registers: the register number, then its bytes. Bits of a register that belong to no device are as the
/// initialisation leaves them.
pub(super) fn write(
    job: &BoardJob<'_>,
    wire: &JobConnection<'_>,
    one: &JobDevice<'_>,
    raw: &[f64],
) -> Option<Expected> {
    let number = register(one)?;
    if let Some(shown) = shown(one, raw) {
        return Some(expected(wire, 0, Expectation::Write(shown)));
    }
    let chip = job.design.part(one.device.part)?.chip.as_ref();
    let is_wide = chip.is_some_and(|chip| chip.register_bytes == 2);
    let mut bytes: Vec<u8> = match number {
        None => Vec::new(),
        Some(number) if is_wide => number.to_be_bytes().to_vec(),
        Some(number) => number.to_le_bytes().into_iter().take(1).collect(),
    };
    let begins = bytes.len();
    let words = Words::of(one.device)?;
    bytes.extend(words::bytes(&words, raw));
    let mut mask = vec![0xFF; bytes.len()];
    let is_narrow = words.crc.is_none() && bytes.len() <= begins + size_of::<u64>();
    if is_narrow {
        let own = words.in_frame(0).to_le_bytes();
        let start = chip.and_then(|chip| left_by_init(chip, &bytes, begins));
        if is_shared(job, one) {
            mask.iter_mut().skip(begins).zip(own).for_each(|(mask, own)| *mask = own);
        } else if let Some(start) = start {
            let all = bytes.iter_mut().zip(start).skip(begins).zip(own);
            all.for_each(|((byte, start), own)| *byte |= start & !own);
        }
    }
    Some(expected(wire, 0, Expectation::Write(Written { bytes, begins, mask })))
}

/// What a strip or a display shows of a value: the colours of its LEDs, or the number of a line and its letters.
fn shown(one: &JobDevice<'_>, raw: &[f64]) -> Option<Written> {
    let encoding = one.device.kind.encoding();
    let (bytes, begins) = match encoding {
        Encoding::Plain => return None,
        Encoding::Ws2812 | Encoding::Sk6812 | Encoding::Apa102 => {
            let colours = one.device.kind.spi()?.colours.len();
            (lamps::colours(encoding, colours, raw), 0)
        }
        Encoding::Text => {
            // The command that says the line is 0xB0 to 0xB7.
            let start = &one.device.kind.i2c()?.start;
            let line = start.iter().find(|byte| (0xB0..=0xB7).contains(*byte))? & 7;
            ([vec![line], letters::shown(raw)].concat(), 1)
        }
    };
    Some(Written { mask: vec![0xFF; bytes.len()], bytes, begins })
}

/// The last transfer of the initialisation with the same length and start.
fn left_by_init(chip: &Protocol, bytes: &[u8], begins: usize) -> Option<Vec<u8>> {
    let is_alike =
        |one: &&Vec<u8>| one.len() == bytes.len() && one.get(..begins) == bytes.get(..begins);
    let mut writes = chip.init.iter().filter_map(|step| match step {
        InitStep::Write(bytes) => Some(bytes),
        InitStep::Wait { .. } => None,
    });
    writes.rfind(is_alike).cloned()
}

/// Whether another device of the chip is written to the same register.
fn is_shared(job: &BoardJob<'_>, one: &JobDevice<'_>) -> bool {
    let is_beside = |other: &&JobDevice<'_>| {
        other.device.part == one.device.part
            && other.device.id.value != one.device.id.value
            && other.device.direction == Direction::Actuator
            && register(other) == register(one)
    };
    job.devices.iter().any(|other| is_beside(&other))
}

/// The longest time that starting a chip takes, without its pauses.
const START_MS: u64 = 40;

/// The value that a chip's switch must have been set to before the host sets it; `None` if the design does not give it,
/// or if the chip may not have started yet.
pub(super) fn first(
    job: &BoardJob<'_>,
    wire: &JobConnection<'_>,
    one: &JobDevice<'_>,
    now_ns: u64,
) -> Option<Expected> {
    let is_on = one.device.coding.initial?;
    let chip = job.design.part(one.device.part)?.chip.as_ref()?;
    let pause_ms = chip.init.iter().map(|step| match step {
        InitStep::Write(_) => 0,
        InitStep::Wait { ms } => u64::from(*ms),
    });
    let starts_ms = u64::from(wire.cycle.start_ms) + pause_ms.sum::<u64>() + START_MS;
    let is_started = now_ns >= starts_ms * 1_000_000;
    write(job, wire, one, &[f64::from(u8::from(is_on))]).filter(|_| is_started)
}
