//! Reporting the outcomes of readings.

use super::Chip;
use super::memory::Memory;
use crate::bytes::{part, part_mut};
use crate::convert::store_signed;
use crate::outcome::{Outcome, Sink};
use crate::uses;

impl Chip {
    /// Reports the fault for all readings of one transfer, or of all.
    pub(super) fn say_fault(&self, transfer: Option<usize>, sink: &mut Sink<'_>) {
        for reading in self.table.readings {
            if transfer.is_none_or(|transfer| usize::from(reading.transfer) == transfer) {
                sink(reading.item.into(), self.fault, &mut []);
            }
        }
    }

    pub(super) fn say_values(&mut self, transfer: usize, sink: &mut Sink<'_>) {
        let Some(table) = self.table.transfers.get(transfer) else { return };
        let mut computed = None;
        for reading in self.table.readings {
            let index = usize::from(reading.item);
            let Some(item) = self.schema.items.get(index) else { continue };
            if usize::from(reading.transfer) != transfer {
                continue;
            }
            let Memory { calibration, value, work, .. } =
                Memory::split(&mut self.memory, &self.sizes);
            let bytes = part(work, table.select.len(), table.length.into());
            let bytes = bytes.get(reading.offset.into()..).unwrap_or_default();
            let value = part_mut(value, 0, item.bytes());
            let outcome = match reading.output.filter(|_| uses::CHIP_FORMULAS) {
                None if bytes.is_empty() => Outcome::Invalid,
                None => reading.value.decode(item, bytes, value),
                Some(output) => {
                    let number =
                        self.table.compute(reading, output, calibration, bytes, &mut computed);
                    number.map_or(Outcome::Invalid, |number| {
                        store_signed(item.scalar, number, value);
                        Outcome::Fresh
                    })
                }
            };
            if outcome == Outcome::Fresh {
                sink(index, outcome, value);
                self.count(outcome);
            } else {
                self.count_fault(outcome);
                sink(index, outcome, &mut []);
            }
        }
    }
}
