//! Identifiers that the file leaves out: parts in, a number for each device out.

use std::collections::BTreeSet;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0231_no_identifier_left;

use crate::part::block::ReadPart;

/// Numbers the devices that have no identifier, in file order, after the greatest one stated.
pub(crate) fn complete(parts: &mut [ReadPart], diagnostics: &mut Vec<Diagnostic>) {
    let stated: BTreeSet<u8> =
        parts.iter().flat_map(|read| &read.devices).map(|device| device.id.value).collect();
    let mut last = stated.last().copied().unwrap_or(0);
    for device in parts.iter_mut().flat_map(|read| &mut read.devices) {
        if device.id.value > 0 {
            continue;
        }
        let Some(next) = last.checked_add(1).filter(|next| *next <= ID_MAX) else {
            let (at, name) = (device.name.span, &device.name.value);
            diagnostics.push(e0231_no_identifier_left::no_identifier_left(at, name, last));
            return;
        };
        last = next;
        device.id.value = next;
    }
}

/// The greatest identifier of a device; 255 belongs to the link.
pub(crate) const ID_MAX: u8 = 254;
