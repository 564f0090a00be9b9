//! The link to the host.

use sensedsl_board::profile::Usb;

use crate::job::BoardJob;

/// The USB device of a board, whatever its system.
pub(super) fn usb(job: &BoardJob<'_>) -> Option<Usb> {
    job.profile?.usb(None).cloned()
}
