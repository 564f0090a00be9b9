//! The chips on a board's buses.

use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::{ConnectionIndex, PartIndex};
use sensedsl_model::words::Words;

use super::Bench;
use crate::parts::ranges::Ranges;
use crate::parts::registers::{Reading, Registers};
use crate::parts::sleep::Sleep;

/// A chip on a bus.
#[derive(Clone, Debug)]
pub(super) struct Chip {
    pub(super) part: PartIndex,
    name: String,
    pub(super) unit: u8,
    /// The address; only on I2C.
    pub(super) address: Option<u8>,
    /// On SPI, the connection that has its chip select.
    pub(super) connection: ConnectionIndex,
    pub(super) is_selected: bool,
    pub(super) registers: Registers,
}

/// A part whose identity the board has not asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UncheckedIdentity {
    /// Its name.
    pub name: String,
    /// Whether its driver gives an identity to compare with, so that the board should have asked.
    pub is_known: bool,
}

impl Bench {
    /// The parts on buses that the board has read without asking for their identity.
    #[must_use]
    pub fn unasked(&self) -> Vec<UncheckedIdentity> {
        let all = self.chips.iter().filter_map(|one| {
            let is_known = one.registers.is_unasked()?;
            Some(UncheckedIdentity { name: one.name.clone(), is_known })
        });
        all.collect()
    }

    /// The parts on buses that the board has treated in a way that their drivers do not describe, each with what
    /// happened.
    #[must_use]
    pub fn odd_transfers(&self) -> Vec<(String, String)> {
        let odd = |one: &Chip| {
            let of_bus = self.chips.iter().filter(|other| other.unit == one.unit).count();
            let registers = &one.registers;
            let reported = registers.odd().map(str::to_owned);
            // Settings that a fault of the world has undone may not have been restored yet.
            let not_set_up = || registers.not_set_up().filter(|_| self.faults.is_empty());
            let not_left_alone = || registers.not_left_alone().filter(|_| self.faults.is_empty());
            let parts = u64::try_from(of_bus).unwrap_or(u64::MAX);
            let reported = reported.or_else(not_left_alone).or_else(not_set_up);
            reported.or_else(|| registers.waits_too_long(parts))
        };
        self.chips.iter().filter_map(|one| Some((one.name.clone(), odd(one)?))).collect()
    }

    /// The time from one measurement of a part to the next if it measures at its own pace; otherwise 0.
    pub(crate) fn held_ns(&self, part: PartIndex) -> u64 {
        let own = self.chips.iter().filter(|one| one.part == part);
        own.map(|one| one.registers.held_ns()).max().unwrap_or(0)
    }

    pub(super) fn chip(&self, job: &BoardJob<'_>, one: &JobConnection<'_>, unit: u8) -> Chip {
        let part = one.connection.part;
        let protocol = one.part.chip.clone().unwrap_or_default();
        let driver = one.part.driver.as_deref();
        let sleep = driver.and_then(Sleep::of);
        let readings = job.devices.iter().filter(|of| of.device.part == part).filter_map(|of| {
            let device = of.device;
            let subject = self.subject(device)?;
            let own = device.kind.register_access()?;
            Some(Reading {
                subject,
                trigger: own.trigger.to_vec(),
                wait_ns: 1_000 * u64::from(own.wait_us),
                register: own.register,
                select: own.read.to_vec(),
                exchange: device.coding.exchange.clone(),
                byte: device.coding.byte,
                length: own.length_bytes,
                words: Words::of(device).filter(|_| device.coding.output.is_none()),
                output: device.coding.output.map(|output| output.number),
                ranges: driver
                    .map(|driver| Ranges::of(driver, device.coding.reading.as_deref(), &protocol))
                    .unwrap_or_default(),
            })
        });
        let readings = readings.collect();
        let address = one.connection.kind.register_access().and_then(|own| own.address);
        let least_bytes = job.board.profile().filter(|_| address.is_some());
        let least_bytes = least_bytes.map_or(1, |profile| profile.i2c.read_bytes_min.into());
        Chip {
            part,
            name: one.part.name.value.clone(),
            unit,
            address,
            connection: one.index,
            is_selected: false,
            registers: Registers::new(protocol, readings, sleep).read_at_least(least_bytes),
        }
    }
}
