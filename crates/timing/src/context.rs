//! What every part of a board's load is computed from.
//!
//! A design and the wiring of one of its boards go in. A [`Context`] comes out, which has the devices with their wires
//! and the clocks of the board, so that no file looks them up twice.

use std::collections::BTreeMap;

use sensedsl_board::catalog::SystemFacts;
use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;
use sensedsl_model::design::{Board, Design, Device, DeviceIndex};
use sensedsl_wiring::assignment::{BoardAssignment, ConnectionWiring};

use crate::groups::{Starts, starts};
use crate::rows::Cycle;

/// A device with the wires of its kind; for an array, with those of one element.
#[derive(Clone, Copy)]
pub(crate) struct Wired<'a> {
    pub(crate) index: DeviceIndex,
    pub(crate) device: &'a Device,
    pub(crate) wiring: &'a ConnectionWiring,
}

/// A board with everything that its parts are computed from.
pub(crate) struct Context<'a> {
    pub(crate) design: &'a Design,
    pub(crate) board: &'a Board,
    pub(crate) wiring: &'a BoardAssignment,
    /// Each device once, with its first element.
    pub(crate) devices: Vec<Wired<'a>>,
    /// Each element of each device.
    pub(crate) elements: Vec<Wired<'a>>,
    pub(crate) starts: Starts,
}

impl<'a> Context<'a> {
    pub(crate) fn new(design: &'a Design, board: &'a Board, wiring: &'a BoardAssignment) -> Self {
        let (mut devices, mut elements) = (Vec::new(), Vec::new());
        for index in wiring.devices.iter().map(|one| one.device) {
            let Some(device) = design.device(index) else { continue };
            let of_kind = |one: &&ConnectionWiring| {
                let connection = design.connection(one.connection);
                connection.is_some_and(|one| one.kind.name() == device.kind.name())
            };
            let all = device.connections.iter().filter_map(|one| wiring.connection(*one));
            let all = all.filter(of_kind).map(|wiring| Wired { index, device, wiring });
            let all: Vec<Wired<'_>> = all.collect();
            devices.extend(all.first());
            elements.extend(all);
        }
        let starts = starts(design, wiring);
        Self { design, board, wiring, devices, elements, starts }
    }

    /// A clock of the clock tree, by name: the system's own, or else the board's.
    pub(crate) fn clock_hz(&self, name: &str) -> Option<u32> {
        if let Some(hz) = self.board.profile().and_then(|profile| profile.clocks_hz.get(name)) {
            return Some(*hz);
        }
        self.system()?.clocks_hz.get(name).copied().filter(|hz| *hz > 0)
    }

    /// The facts that the board's system has for it.
    pub(crate) fn system(&self) -> Option<&SystemFacts> {
        let system = self.board.profile().map(TargetProfile::system);
        self.board.facts.as_ref()?.facts_of(system)
    }

    /// What devices served by one thread have in common.
    pub(crate) fn cycle(&self, wired: &Wired<'_>) -> Cycle {
        let Wired { index, device, .. } = wired;
        Cycle {
            delay_ms: device.delay_ms,
            prio: device.prio,
            start_ms: self.starts.get(index).copied().unwrap_or_default(),
        }
    }

    /// Devices of a kind, by unit and cycle.
    pub(crate) fn classes<'c, T>(
        &'c self,
        of: impl Fn(&'c Wired<'a>) -> Option<T>,
    ) -> BTreeMap<(UnitName, Cycle), Vec<(&'c Wired<'a>, T)>> {
        let mut classes: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for wired in &self.elements {
            let Some(what) = of(wired) else { continue };
            let Some(unit) = wired.wiring.unit.as_deref() else { continue };
            let key = (UnitName::new(unit), self.cycle(wired));
            classes.entry(key).or_default().push((wired, what));
        }
        classes
    }
}
