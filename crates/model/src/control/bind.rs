//! Controllers with names in; the same with devices, and what is wrong with them, out.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{
    e0250_not_of_controller as wrong, e0251_two_owners, w0629_read_faster_than_measured,
};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};
use sensedsl_wire::Direction;

use super::Unbound;
use crate::design::{BoardIndex, Controller, Design, Device, DeviceIndex, PartIndex};
use crate::spanned::Spanned;
use crate::value::written::shown_us;

/// How often a sensor may be read within its own cycle without a word: it is measured beside others.
const READS_MAX: u32 = 4;

/// Finds the devices of the controllers, each of which is of the part of that number.
pub(crate) fn bind(
    design: &mut Design,
    unbound: Vec<(PartIndex, Unbound)>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut owners: BTreeMap<DeviceIndex, (String, Span)> = BTreeMap::new();
    for (part, one) in unbound {
        let at = design.devices.iter().position(|device| device.part == part);
        let board = design.part(part).and_then(|part| part.board);
        let (Some(device), Some(board)) = (at.map(DeviceIndex), board) else { continue };
        let mut names = Names { design, board, diagnostics };
        let reads = names.found(&one.reads, |_, _| true);
        let sets = names.found(&one.sets, |names, found| names.can_be_set(found));
        let own = design.part_name(part).to_owned();
        for set in &sets {
            if let Some((first, at)) = owners.get(&set.value) {
                let name = name(design, set.value);
                diagnostics.push(e0251_two_owners::two_owners(set.span, name, first, *at));
            } else {
                owners.insert(set.value, (own.clone(), set.span));
            }
        }
        let controller = Controller {
            device,
            board,
            every_ms: one.every_ms,
            every_span: one.every_span,
            reads,
            sets,
            takes_us: one.takes_us,
            host_overrides: one.host_overrides,
        };
        diagnostics.extend(slow_sensors(design, &own, &controller));
        design.controllers.push(controller);
    }
}

fn name(design: &Design, device: DeviceIndex) -> &str {
    design.device(device).map_or("", |device| device.name.value.as_str())
}

/// The sensors that are measured much less often than the code reads them, because the file gives no cycle.
fn slow_sensors(design: &Design, own: &str, controller: &Controller) -> Vec<Diagnostic> {
    let every = shown_us(controller.every_ms.saturating_mul(1_000));
    let slow = |read: &Spanned<DeviceIndex>| {
        let device = design.device(read.value)?;
        let is_paced = device.direction == Direction::Sensor
            && device.kind.code().is_none()
            && !device.kind.measures_itself();
        let is_slow = device.delay_ms > controller.every_ms.saturating_mul(READS_MAX);
        if !is_paced || !is_slow || device.delay_span.is_some() {
            return None;
        }
        let delay = shown_us(device.delay_ms.saturating_mul(1_000));
        Some(w0629_read_faster_than_measured::read_faster_than_measured(
            device.name.span,
            (&device.name.value, &delay),
            (own, &every),
            read.span,
        ))
    };
    controller.reads.iter().filter_map(slow).collect()
}

/// The devices of a board, by their names.
struct Names<'a> {
    design: &'a Design,
    board: BoardIndex,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Names<'_> {
    /// The devices with those names for which `is_fit` holds, each once.
    fn found(
        &mut self,
        names: &[Spanned<String>],
        is_fit: impl Fn(&mut Self, Spanned<DeviceIndex>) -> bool,
    ) -> Vec<Spanned<DeviceIndex>> {
        let mut found: Vec<Spanned<DeviceIndex>> = Vec::new();
        for name in names {
            let Some(device) = self.device(name) else { continue };
            let one = Spanned { value: device, span: name.span };
            if found.iter().all(|before| before.value != device) && is_fit(self, one) {
                found.push(one);
            }
        }
        found
    }

    fn device(&mut self, name: &Spanned<String>) -> Option<DeviceIndex> {
        let all = (0..).map(DeviceIndex).zip(&self.design.devices);
        let mut named = all.filter(|(_, device)| device.name.value == name.value);
        let (report, at) = match named.next() {
            Some((index, device)) if self.board_of(device) == Some(self.board) => {
                return Some(index);
            }
            Some((_, device)) => {
                let report =
                    wrong::elsewhere(name.span, &name.value, self.board_name(), device.name.span);
                (report, name.span)
            }
            None => (self.unknown(name), name.span),
        };
        debug_assert_eq!(report.primary.span, at, "a report is where the name is");
        self.diagnostics.push(report);
        None
    }

    /// Nothing has that name, or a chip has it.
    fn unknown(&self, name: &Spanned<String>) -> Diagnostic {
        let parts = (0..).map(PartIndex).zip(&self.design.parts);
        let mut named = parts.filter(|(_, part)| part.name.value == name.value);
        let values = named.next().map(|(index, _)| self.values(index)).unwrap_or_default();
        if !values.is_empty() {
            return wrong::chip(name.span, &name.value, &values);
        }
        let here =
            self.design.devices.iter().filter(|device| self.board_of(device) == Some(self.board));
        let meant = nearest(&name.value, here.map(|device| device.name.value.as_str()));
        wrong::unknown_device(name.span, &name.value, self.board_name(), meant)
    }

    fn values(&self, part: PartIndex) -> Vec<&str> {
        let devices = self.design.devices.iter().filter(|device| device.part == part);
        devices.map(|device| device.name.value.as_str()).collect()
    }

    fn can_be_set(&mut self, one: Spanned<DeviceIndex>) -> bool {
        let Some(device) = self.design.device(one.value) else { return false };
        let is_code = device.kind.code().is_some();
        let is_fit = device.direction == Direction::Actuator || is_code;
        if !is_fit {
            let report = wrong::measured(one.span, &device.name.value, device.name.span);
            self.diagnostics.push(report);
        }
        is_fit
    }

    fn board_of(&self, device: &Device) -> Option<BoardIndex> {
        self.design.part(device.part)?.board
    }

    fn board_name(&self) -> &str {
        self.design.board(self.board).map_or("", |board| board.name.value.as_str())
    }
}
