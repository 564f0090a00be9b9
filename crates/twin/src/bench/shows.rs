//! What people see of a board: strips of LEDs and displays, by the units and connections that they are on. How bytes
//! come to them is in `seen.rs`.

use std::collections::BTreeMap;

use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::encoding::Encoding;

use crate::parts::lamps::Strip;
use crate::parts::screen::Screen;

/// The strips of LEDs, by their units of SPI, and the displays on I2C.
#[derive(Clone, Debug, Default)]
pub(super) struct Shows {
    pub(super) strips: BTreeMap<u8, (ConnectionIndex, Strip)>,
    pub(super) screens: BTreeMap<ConnectionIndex, Screen>,
}

/// Whether a device of the connection is text.
pub(super) fn is_text(job: &BoardJob<'_>, one: &JobConnection<'_>) -> bool {
    let devices = one.devices.iter().filter_map(|at| job.devices.get(*at));
    devices.into_iter().any(|of| of.device.kind.encoding() == Encoding::Text)
}
