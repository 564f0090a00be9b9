//! What is known of a chip while its block is read: the block and its driver, for the readers of its connections and
//! of its values.

use sensedsl_diagnostics::{FileId, Span};
use sensedsl_syntax::ast::Property;
use sensedsl_wire::{Direction, ValueType};

use crate::design::protocol::Protocol;
use crate::driver::Driver;
use crate::driver::known::Known;
use crate::kind::KindName;
use crate::part::block::Next;
use crate::part::properties::COMMON_PROPERTIES;
use crate::spanned::Spanned;

/// A chip, or a device that is a chip's only value, with its driver.
pub(super) struct ChipReader<'a> {
    pub(super) file: FileId,
    /// The numbers of the part, its first device and its first wires.
    pub(super) next: Next,
    pub(super) name: Spanned<String>,
    pub(super) block: Span,
    pub(super) driver: &'a Driver,
    pub(super) known: Known<'a>,
    /// The properties of the chip as a whole.
    pub(super) properties: Vec<Property>,
    pub(super) protocol: Protocol,
    /// The driver's named values.
    pub(super) given: Vec<DriverValue>,
}

/// A reading or command of a driver.
#[derive(Clone, Debug)]
pub(super) struct DriverValue {
    pub(super) name: String,
    /// Where its name stands.
    pub(super) span: Span,
    pub(super) direction: Direction,
    pub(super) value: ValueType,
    pub(super) properties: Vec<Property>,
    /// Indices of the connections that it goes over.
    pub(super) via: Vec<usize>,
}

impl ChipReader<'_> {
    /// The properties of the chip that apply to a connection of that kind.
    pub(super) fn properties_for(&self, kind: KindName) -> impl Iterator<Item = Property> {
        let concerns = move |one: &Property| {
            one.name().is_some_and(|name| {
                let name = name.text();
                let common = COMMON_PROPERTIES.contains(&name);
                let own = matches!(name, "id" | "driver" | "type");
                (common && !own) || kind.spec().properties.contains(&name)
            })
        };
        self.properties.iter().filter(move |one| concerns(one)).cloned()
    }
}
