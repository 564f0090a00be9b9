//! What the tables of a part are made from.
//!
//! In: a design and one of its parts. Out: the part with its protocol and its devices, for each file that makes a table.

use sensedsl_model::design::{Design, Device, Part, PartIndex};
use sensedsl_model::kind::Kind;
use sensedsl_model::protocol::Protocol;

/// A part with the sources of its tables.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) part: &'a Part,
    pub(super) protocol: &'a Protocol,
    pub(super) design: &'a Design,
    pub(super) index: PartIndex,
}

impl<'a> Source<'a> {
    /// The devices of the part that are of the wanted kinds, in the file's order.
    pub(super) fn devices(self, is_wanted: fn(&Kind) -> bool) -> impl Iterator<Item = &'a Device> {
        let own = self.design.devices.iter().filter(move |device| device.part == self.index);
        own.filter(move |device| is_wanted(&device.kind))
    }
}
