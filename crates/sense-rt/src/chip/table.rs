//! What a chip is described by.

use super::Asked;
use super::say::Computed;
use crate::coding::Coding;
use crate::formula::Formula;
use crate::schema::Schema;
use crate::uses;

/// One step of setting a device up: bytes, then a pause. Of serial devices as well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InitStep {
    /// Sent in one transfer; empty where there is only a pause.
    pub bytes: &'static [u8],
    /// Waited at least after them.
    pub pause_ms: u16,
}

/// What must be read where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Bytes that are written before reading: the register.
    pub select: &'static [u8],
    /// What must be there.
    pub expected: &'static [u8],
    /// Bits that are compared; empty: all.
    pub mask: &'static [u8],
}

/// A block of calibration; the blocks lie one behind the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Calibration {
    /// Bytes that are written before reading.
    pub select: &'static [u8],
    /// Bytes read, at least 1.
    pub count: u16,
}

/// Bytes that are read together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transfer {
    /// Written to start a measurement; empty: the chip measures by itself.
    pub trigger: &'static [u8],
    /// Written before reading: the register, most significant byte first, SPI's read bit in it. In an
    /// exchange: what is sent, `length` bytes.
    pub select: &'static [u8],
    /// From one measurement to the next; 0, or less than the chip's: in every step.
    pub cycle_ms: u32,
    /// From the trigger to the reading; without one, from the start of the chip or the last reading to
    /// the next.
    pub wait_ms: u32,
    /// Bytes read, as on the wire (with checksums), at least 1.
    pub length: u16,
    /// SPI: what is received while `select` is sent is what is read.
    pub exchange: bool,
}

impl Transfer {
    /// One byte, in every step.
    pub const NEW: Self =
        Self { trigger: &[], select: &[], cycle_ms: 0, wait_ms: 0, length: 1, exchange: false };

    pub(super) fn asked(&self) -> Asked {
        if uses::CHIP_EXCHANGES && self.exchange {
            Asked::Exchange(self.select, self.length.into())
        } else {
            Asked::Read(self.select, self.length.into())
        }
    }
}

/// A value in a transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Index of the item in the schema: of a sensor.
    pub item: u16,
    /// Where it begins in the transfer: bytes, as on the wire (with checksums).
    pub offset: u16,
    /// Which transfer.
    pub transfer: u8,
    /// Which output of the chip's formula, from the raw block at `offset`; `value` is then of no
    /// meaning.
    pub output: Option<u8>,
    /// How it is coded.
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
    /// Written in front of the value: the register, or any command.
    pub prefix: &'static [u8],
    /// Index of the item in the schema: of an actuator.
    pub item: u16,
    /// How it is coded.
    pub value: Coding,
    /// The bits of the value's bytes that it changes, where other commands have the others: as many bytes as the
    /// value; empty: all.
    pub own: &'static [u8],
    /// With `own`: where the bytes of its register begin in [`ChipTable::kept`].
    pub kept: u16,
}

impl Command {
    /// One byte, without a register.
    pub const NEW: Self = Self { prefix: &[], item: 0, value: Coding::NEW, own: &[], kept: 0 };

    /// Puts what the other commands have told a register into the bytes of this one, and keeps all of it, as what
    /// `differs` from the start.
    pub(super) fn join(&self, start: &[u8], differs: &mut [u8], bytes: &mut [u8]) {
        let kept = differs.iter_mut().zip(start).skip(self.kept.into());
        for ((byte, own), (differs, start)) in bytes.iter_mut().zip(self.own).zip(kept) {
            *byte = (*differs ^ start) & !own | *byte & own;
            *differs = *byte ^ start;
        }
    }
}

/// A chip.
#[derive(Clone, Copy, Debug)]
pub struct ChipTable {
    /// How it is set up.
    pub init: &'static [InitStep],
    /// What the part must be; none: any part that answers is right.
    pub identity: Option<Identity>,
    /// What its formula is told of it.
    pub calibration: &'static [Calibration],
    /// At most 254.
    pub transfers: &'static [Transfer],
    /// The values in them.
    pub readings: &'static [Reading],
    /// The values that are written.
    pub commands: &'static [Command],
    /// What the registers that commands share begin with, one behind the other.
    pub kept: &'static [u8],
    /// What makes numbers of its readings.
    pub formula: Option<Formula>,
    /// Of the formula.
    pub parameters: &'static [i32],
    /// How often it is looked after: a transfer is made in the first step that comes at its time, or
    /// too early by at most an eighth of this (clocks round).
    pub cycle_ms: u32,
    /// The 7-bit address on I2C, and the number of the chip select on SPI as the system counts them.
    pub address: u8,
}

const fn greater(left: usize, right: usize) -> usize {
    if left > right { left } else { right }
}

impl ChipTable {
    /// A chip that says and takes nothing.
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

    /// The memory of a [`crate::Chip`].
    #[must_use]
    pub const fn chip_bytes(&self, schema: &Schema) -> usize {
        let states = self.transfers.len() * super::memory::STATE_BYTES;
        let values = self.value_bytes(schema) + self.kept.len();
        states + self.calibration_bytes() + values + self.work_bytes(schema)
    }

    /// How it is set up, as far as that is not left out.
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

    /// Bytes of the largest value of a reading.
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

    /// The most that any transfer writes and reads together, a command's bytes included.
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

    /// The output of the formula of the block that `bytes` begin with.
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

/// The item of that index.
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
