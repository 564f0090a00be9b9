//! One board with everything its sections are planned from.

use std::collections::BTreeMap;

use sensedsl_board::catalog::Crystal;
use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target::no_firmware_target;
use sensedsl_model::kind::KindName;
use sensedsl_wire::ScalarType;

use super::hal::Hal;
use super::lack::{Missing, Printed};
use super::names::{Chip, Names};
use super::{gaps, moved, rp};
use sensedsl_job::{BoardJob, Cycle, JobConnection, JobDevice};

/// One board on its way to a plan.
pub(super) struct Context<'a> {
    pub(super) job: &'a BoardJob<'a>,
    pub(super) profile: &'a TargetProfile,
    pub(super) names: Names,
    pub(super) chip: Chip,
    /// The timer that the clock runs on; `None` where the HAL has one of its own.
    pub(super) timer: Option<String>,
    /// The block of pins of each unit that moves as a whole.
    pub(super) blocks: BTreeMap<UnitName, u8>,
}

/// A device of one value with its wires.
#[derive(Clone)]
pub(super) struct Wired<'a> {
    /// Index of its item.
    pub(super) index: usize,
    pub(super) device: &'a JobDevice<'a>,
    pub(super) first: &'a JobConnection<'a>,
    /// One for each element, the first among them.
    pub(super) wires: Vec<&'a JobConnection<'a>>,
}

impl<'a> Context<'a> {
    /// Fails if Embassy does not support the board's MCU, or if the devices leave no timer for its clock.
    pub(super) fn new(job: &'a BoardJob<'a>) -> Result<Self, Vec<Diagnostic>> {
        let board = &job.board.name;
        let lack = |why: &str| vec![no_firmware_target(board.span, &board.value, why)];
        let profile = job.profile.ok_or_else(|| lack("it has no target profile"))?;
        let names = Names::of(profile).map_err(|error| lack(&error))?;
        let chip = job.board.mcu.as_deref().and_then(|mcu| names.chip(mcu));
        let chip = chip.ok_or_else(|| lack("Embassy does not support its MCU"))?;
        let timer = match names.hal {
            Hal::Stm32 => Some(super::clock::timer(job, profile).ok_or_else(|| {
                let timers = profile.kernel.timers.join(", ");
                lack(&format!(
                    "its devices leave no timer for Embassy's clock, which runs on one of {timers}; another pin or \
                     kind for one of them frees one"
                ))
            })?),
            Hal::Rp => None,
        };
        if let Some(why) = rp::refusal(names.hal, job) {
            return Err(lack(&why));
        }
        Ok(Self { job, profile, names, chip, timer, blocks: moved::blocks(job) })
    }

    /// The connections of a kind, in the design's order. Those that no code is made for are left out: they are told as
    /// gaps.
    pub(super) fn connections(
        &self,
        kind: KindName,
    ) -> impl Iterator<Item = &'a JobConnection<'a>> {
        let job = self.job;
        job.connections(kind).filter(|one| gaps::lacks(job, one).is_none())
    }

    /// The devices of a kind with their wires, in the design's order.
    pub(super) fn wired(&self, kind: KindName) -> Vec<Wired<'a>> {
        let devices = self.job.devices.iter().enumerate();
        let wired = devices.filter_map(|(index, device)| {
            let own = self.connections(kind).filter(|one| one.devices.contains(&index));
            let wires: Vec<&JobConnection<'a>> = own.collect();
            Some(Wired { index, device, first: wires.first()?, wires })
        });
        wired.collect()
    }

    /// The devices of a kind by unit and cycle: a task each.
    pub(super) fn classes(&self, kind: KindName) -> BTreeMap<(String, Cycle), Vec<Wired<'a>>> {
        let mut classes: BTreeMap<(String, Cycle), Vec<Wired<'a>>> = BTreeMap::new();
        for wired in self.wired(kind) {
            let unit = wired.first.unit.unwrap_or("gpio");
            classes.entry((unit.to_owned(), wired.device.cycle)).or_default().push(wired);
        }
        classes
    }

    /// The identifier of the first device of a wire; 0 where it has none.
    pub(super) fn id_of(&self, wire: &JobConnection<'_>) -> u8 {
        let own = wire.devices.iter().filter_map(|index| self.job.devices.get(*index));
        own.map(|one| one.device.id.value).next().unwrap_or(0)
    }

    /// The clock of a unit.
    pub(super) fn unit_hz(&self, unit: &str) -> Option<u32> {
        let clock = self.profile.unit(unit)?.clock.as_deref()?;
        self.profile.clocks_hz.get(clock).copied()
    }

    /// The index of a device's item.
    pub(super) fn item(&self, field: &str) -> Printed<usize> {
        let found = self.job.devices.iter().position(|one| one.name() == field);
        found.ok_or_else(|| Missing::wire(format!("a place for `{field}`")))
    }

    /// The board's crystals.
    pub(super) fn crystal(&self) -> Crystal {
        self.job.board.facts.as_ref().map(|facts| facts.crystal.clone()).unwrap_or_default()
    }

    /// What the HAL calls a unit.
    pub(super) fn peripheral(&self, unit: &str) -> String {
        self.names.peripheral(unit).to_owned()
    }
}

/// The scalar type in the runtime's words.
pub(super) fn scalar(scalar: ScalarType) -> String {
    format!("Scalar::{scalar:?}")
}
