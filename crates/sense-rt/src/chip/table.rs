//! The tables that describe a chip.

use crate::coding::Coding;
use crate::formula::{Formula, Outputs};
use crate::schema::Schema;
use crate::uses;

/// One step of setting up a device, on a bus or a serial port: bytes, then a pause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InitStep {
    /// The bytes sent in one transfer; empty for a pause only.
    pub bytes: &'static [u8],
    /// The least pause after them.
    pub pause_ms: u16,
}

/// The register that identifies a part, and its contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The bytes written before reading: the register.
    pub select: &'static [u8],
    /// The contents that it must have.
    pub expected: &'static [u8],
    /// The bits that are compared; empty: all.
    pub mask: &'static [u8],
}

/// A block of calibration; the blocks are stored one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Calibration {
    /// The bytes written before reading.
    pub select: &'static [u8],
    /// The number of bytes read, at least 1.
    pub count: u16,
}

/// Bytes that are read together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transfer {
    /// The bytes that start a measurement; empty: the chip measures by itself.
    pub trigger: &'static [u8],
    /// The bytes written before reading: the register, most significant byte first, including SPI's
    /// read bit. In an exchange: the bytes sent, `length` in number.
    pub select: &'static [u8],
    /// The time from one measurement to the next; 0, or less than the chip's: in every step.
    pub cycle_ms: u32,
    /// The time from the trigger to the reading; without a trigger, from the start of the chip or
    /// the last reading to the next.
    pub wait_ms: u32,
    /// The number of bytes read, as on the wire (including checksums), at least 1.
    pub length: u16,
    /// True for SPI if the bytes read are those received while `select` is sent.
    pub exchange: bool,
}

impl Transfer {
    /// One byte, in every step.
    pub const NEW: Self =
        Self { trigger: &[], select: &[], cycle_ms: 0, wait_ms: 0, length: 1, exchange: false };

    pub(super) fn asked(&self) -> NextTransfer {
        if uses::CHIP_EXCHANGES && self.exchange {
            NextTransfer::Exchange(self.select, self.length.into())
        } else {
            NextTransfer::Read(self.select, self.length.into())
        }
    }
}

/// The transfer to make on the bus.
#[derive(Clone, Copy)]
pub(super) enum NextTransfer {
    Write(&'static [u8]),
    Read(&'static [u8], usize),
    Exchange(&'static [u8], usize),
}

/// A value in a transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// The index of its item in the schema; a sensor.
    pub item: u16,
    /// The offset in the transfer in bytes, as on the wire (including checksums).
    pub offset: u16,
    /// The index of the transfer.
    pub transfer: u8,
    /// The output of the chip's formula for the raw block at `offset`; `value` is then ignored.
    pub output: Option<u8>,
    /// The coding.
    pub value: Coding,
}

impl Reading {
    /// The first byte of the first transfer.
    pub const NEW: Self =
        Self { item: 0, offset: 0, transfer: 0, output: None, value: Coding::NEW };
}

/// A value that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Command {
    /// The bytes written before the value: the register, or any command.
    pub prefix: &'static [u8],
    /// The index of its item in the schema; an actuator.
    pub item: u16,
    /// The coding.
    pub value: Coding,
    /// The bits that it changes if other commands have bits of the same register, in as many bytes
    /// as the value has; empty: all.
    pub own: &'static [u8],
    /// With `own`: the offset of its register in [`ChipTable::kept`].
    pub kept: u16,
}

impl Command {
    /// One byte, without a register.
    pub const NEW: Self = Self { prefix: &[], item: 0, value: Coding::NEW, own: &[], kept: 0 };

    /// Merges the bits that other commands have last written to the register into the bytes of this
    /// one, and stores the result in `differs`, as the difference from `start`.
    pub(super) fn join(&self, start: &[u8], differs: &mut [u8], bytes: &mut [u8]) {
        let kept = differs.iter_mut().zip(start).skip(self.kept.into());
        for ((byte, own), (differs, start)) in bytes.iter_mut().zip(self.own).zip(kept) {
            *byte = (*differs ^ start) & !own | *byte & own;
            *differs = *byte ^ start;
        }
    }
}

/// The formula's outputs of one raw block, computed once for all readings in it.
pub(super) type Computed = Option<(u16, Option<Outputs>)>;

/// A chip.
#[derive(Clone, Copy, Debug)]
pub struct ChipTable {
    /// The steps of the initialisation.
    pub init: &'static [InitStep],
    /// The identity that the part must have; `None`: any part that answers is right.
    pub identity: Option<Identity>,
    /// The calibration that the formula needs.
    pub calibration: &'static [Calibration],
    /// The transfers, at most 254.
    pub transfers: &'static [Transfer],
    /// The values in the transfers.
    pub readings: &'static [Reading],
    /// The values that are written.
    pub commands: &'static [Command],
    /// The start values of the registers that commands share, one after the other.
    pub kept: &'static [u8],
    /// The formula that computes its readings.
    pub formula: Option<Formula>,
    /// The parameters of the formula.
    pub parameters: &'static [i32],
    /// How often the chip is served: a transfer is made in the first step at or after its time, or
    /// at most an eighth of this before it (clocks round).
    pub cycle_ms: u32,
    /// The 7-bit address on I2C; on SPI the number of the chip select, as the system counts them.
    pub address: u8,
}

const fn greater(left: usize, right: usize) -> usize {
    if left > right { left } else { right }
}

impl ChipTable {
    /// A chip without readings or commands.
    pub const NEW: Self = Self {
        init: &[],
        identity: None,
        calibration: &[],
        transfers: &[],
        readings: &[],
        commands: &[],
        kept: &[],
        formula: None,
        parameters: &[],
        cycle_ms: 0,
        address: 0,
    };

    /// The size of the memory of a [`crate::Chip`].
    #[must_use]
    pub const fn chip_bytes(&self, schema: &Schema) -> usize {
        let states = self.transfers.len() * super::memory::STATE_BYTES;
        let values = self.value_bytes(schema) + self.kept.len();
        states + self.calibration_bytes() + values + self.work_bytes(schema)
    }

    /// The steps of the initialisation, unless the feature is off.
    pub(super) const fn init(&self) -> &'static [InitStep] {
        if uses::CHIP_INIT { self.init } else { &[] }
    }

    pub(super) fn identity(&self) -> Option<&Identity> {
        self.identity.as_ref().filter(|_| uses::CHIP_IDENTITY)
    }

    pub(super) const fn calibration(&self) -> &'static [Calibration] {
        if uses::CHIP_FORMULAS { self.calibration } else { &[] }
    }

    pub(super) const fn calibration_bytes(&self) -> usize {
        let mut bytes = 0;
        let mut rest = self.calibration;
        while let [block, others @ ..] = rest {
            bytes += block.count as usize;
            rest = others;
        }
        bytes
    }

    /// The size of the largest value of a reading, in bytes.
    pub(super) const fn value_bytes(&self, schema: &Schema) -> usize {
        let mut bytes = 0;
        let mut rest = self.readings;
        while let [reading, others @ ..] = rest {
            if let Some(item) = item(schema, reading.item) {
                bytes = greater(bytes, item.bytes());
            }
            rest = others;
        }
        bytes
    }

    /// The most bytes that any transfer or command writes and reads together.
    #[must_use]
    pub const fn work_bytes(&self, schema: &Schema) -> usize {
        let mut bytes = 1;
        let mut init = self.init;
        while let [step, others @ ..] = init {
            bytes = greater(bytes, step.bytes.len());
            init = others;
        }
        if let Some(identity) = &self.identity {
            bytes = greater(bytes, identity.select.len() + identity.expected.len());
        }
        let mut calibration = self.calibration;
        while let [block, others @ ..] = calibration {
            bytes = greater(bytes, block.select.len() + block.count as usize);
            calibration = others;
        }
        let mut transfers = self.transfers;
        while let [transfer, others @ ..] = transfers {
            let read = transfer.select.len() + transfer.length as usize;
            bytes = greater(bytes, greater(transfer.trigger.len(), read));
            transfers = others;
        }
        let mut commands = self.commands;
        while let [command, others @ ..] = commands {
            if let Some(item) = item(schema, command.item) {
                let value = command.value.wire_bytes(item.count);
                bytes = greater(bytes, command.prefix.len() + value);
            }
            commands = others;
        }
        bytes
    }

    /// The output of the formula for the raw block at the start of `bytes`.
    pub(super) fn compute(
        &self,
        reading: &Reading,
        output: u8,
        calibration: &[u8],
        bytes: &[u8],
        computed: &mut Computed,
    ) -> Option<i64> {
        let formula = self.formula.as_ref().filter(|formula| output < formula.outputs_count)?;
        let outputs = match computed {
            Some((known, outputs)) if *known == reading.offset => *outputs,
            Some(_) | None => {
                let outputs = formula.compute(calibration, self.parameters, bytes);
                *computed = Some((reading.offset, outputs));
                outputs
            }
        };
        outputs?.get(usize::from(output)).copied()
    }
}

/// The item with this index.
const fn item(schema: &Schema, index: u16) -> Option<&'static crate::Item> {
    let mut rest = schema.items;
    let mut left = index;
    while let [item, others @ ..] = rest {
        if left == 0 {
            return Some(item);
        }
        left -= 1;
        rest = others;
    }
    None
}
