//! One board with everything that its sections are planned from, and what all kinds ask of it. No HAL: what is spelled
//! in a HAL's words is asked of its drivers, which look into the context as the kinds do.

use std::collections::BTreeMap;

use sensedsl_board::catalog::Crystal;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target::no_firmware_target;
use sensedsl_model::design::Part;
use sensedsl_model::kind::KindName;
use sensedsl_wire::ScalarType;

use super::missing::{Missing, Printed};
use super::names::{Chip, Names};
use sensedsl_job::{BoardJob, Cycle, JobConnection, JobDevice};

/// One board on its way to a plan.
pub(super) struct Context<'a> {
    pub(super) job: &'a BoardJob<'a>,
    pub(super) profile: &'a TargetProfile,
    pub(super) names: &'a Names,
    pub(super) chip: Chip,
    /// The connections that there is code for, in the design's order. The others are reported as gaps.
    pub(super) served: Vec<&'a JobConnection<'a>>,
}

/// A device of one value with its wires.
#[derive(Clone)]
pub(super) struct Wired<'a> {
    /// The index of its item.
    pub(super) index: usize,
    pub(super) device: &'a JobDevice<'a>,
    pub(super) first: &'a JobConnection<'a>,
    /// One for each element, including the first.
    pub(super) wires: Vec<&'a JobConnection<'a>>,
}

impl<'a> Context<'a> {
    /// The connections of a kind that there is code for, in the design's order.
    pub(super) fn connections(
        &self,
        kind: KindName,
    ) -> impl Iterator<Item = &'a JobConnection<'a>> {
        self.served.iter().copied().filter(move |one| one.connection.kind.name() == kind)
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

    /// The devices of a kind by unit and cycle: each entry becomes a task.
    pub(super) fn classes(&self, kind: KindName) -> BTreeMap<(String, Cycle), Vec<Wired<'a>>> {
        let mut classes: BTreeMap<(String, Cycle), Vec<Wired<'a>>> = BTreeMap::new();
        for wired in self.wired(kind) {
            let unit = wired.first.unit.unwrap_or("gpio");
            classes.entry((unit.to_owned(), wired.device.cycle)).or_default().push(wired);
        }
        classes
    }

    /// The identifier of the first device of a wire; 0 if it has none.
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

    /// The HAL's name of a unit.
    pub(super) fn peripheral(&self, unit: &str) -> String {
        self.names.peripheral(unit).to_owned()
    }

    /// The interrupt of a unit, a DMA channel or an external line.
    pub(super) fn interrupt(&self, unit: &str, signal: &str) -> Printed<&'a str> {
        let found = self.names.interrupt(unit, signal);
        found.ok_or_else(|| Missing::name(format!("the interrupt of {unit} ({signal})")))
    }

    /// Reports what is missing for a part.
    pub(super) fn report(&self, part: &Part, made: Printed<()>, diagnostics: &mut Vec<Diagnostic>) {
        let Err(missing) = made else { return };
        let (name, board) = (&part.name, &self.job.board.name.value);
        let report = no_firmware_target(name.span, board, &missing.why(&name.value));
        // All wires of a chip or an array give the same report.
        if diagnostics.last() != Some(&report) {
            diagnostics.push(report);
        }
    }
}

/// The scalar type in the runtime's words.
pub(super) fn scalar(scalar: ScalarType) -> String {
    format!("Scalar::{scalar:?}")
}
