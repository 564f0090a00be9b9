//! The kinds of devices: one file each, and one line each in the registry below.
//!
//! A kind's file has its `SPEC`, which all its devices share, and a struct with the properties of
//! one device, which knows the wires that the device needs. A file with the same name in crate
//! `wiring` knows which pins can be those wires.

use std::fmt;

use sensedsl_board::table::Pin;
use sensedsl_wire::{Direction, ValueType};

use crate::fields::Fields;
use crate::meaning::Meaning;

pub mod analog;
pub mod can;
pub mod code;
pub mod dac;
pub mod digital;
pub mod encoder;
pub mod encoding;
pub mod i2c;
pub mod icu;
mod interface;
pub mod onewire;
pub mod pwm;
mod role;
mod snippet;
mod spec;
pub mod spi;
pub mod stepper;
pub mod uart;

pub use interface::{Bytes, Interface, RegisterAccess};
pub use role::Role;
pub use spec::{KindSpec, Serves, Sharing, Values};

use spec::Properties;

/// Generates the types, and everything that covers all kinds, from the registry below.
macro_rules! kinds {
    ($($(#[doc = $doc:literal])* $Kind:ident in $module:ident;)*) => {
        /// The kind of a device, with the properties of that kind.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Kind {
            $($(#[doc = $doc])* $Kind($module::$Kind),)*
        }

        /// The word after `type`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum KindName {
            $($(#[doc = $doc])* $Kind,)*
        }

        impl KindName {
            /// All kinds, in the order of the language page.
            pub const ALL: [Self; [$(Self::$Kind),*].len()] = [$(Self::$Kind),*];

            /// Those whose devices have wires.
            pub fn wired() -> impl Iterator<Item = Self> {
                Self::ALL.into_iter().filter(|kind| *kind != Self::Code)
            }

            /// The properties that all devices of the kind share.
            #[must_use]
            pub const fn spec(self) -> &'static KindSpec {
                match self { $(Self::$Kind => &$module::SPEC,)* }
            }

            /// What the properties of the kind mean; those that fix its wires are the same for all kinds.
            pub(crate) const fn meanings(self) -> &'static [Meaning] {
                match self { $(Self::$Kind => $module::MEANINGS,)* }
            }

            /// What it is, in a line.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self { $(Self::$Kind => concat!($($doc),*).trim_start(),)* }
            }

            pub(crate) fn read(
                self,
                fields: &mut Fields<'_>,
                direction: Direction,
                value: ValueType,
            ) -> Kind {
                match self { $(Self::$Kind => Kind::$Kind(Properties::read(fields, direction, value)),)* }
            }
        }

        impl Kind {
            /// The name of the kind.
            #[must_use]
            pub const fn name(&self) -> KindName {
                match self { $(Self::$Kind(_) => KindName::$Kind,)* }
            }

            /// The wires that a device of this kind needs, in the order of the tie-break.
            #[must_use]
            pub fn roles(&self, direction: Direction) -> Vec<Role> {
                match self { $(Self::$Kind(properties) => properties.roles(direction),)* }
            }

            /// How long a measurement lasts once it has begun, in microseconds.
            #[must_use]
            pub fn measuring_us(&self) -> u32 {
                match self { $(Self::$Kind(properties) => properties.measuring_us(),)* }
            }

            /// A device of that kind with no properties given; on a bus at `address` (7-bit).
            #[must_use]
            pub fn plain(kind: KindName, address: u8) -> Self {
                match kind { $(KindName::$Kind => Self::$Kind(Properties::plain(address)),)* }
            }
        }
    };
}

kinds! {
    /// A voltage on an ADC input.
    Analog in analog;
    /// A device on an I2C bus.
    I2c in i2c;
    /// Edges on an input-capture channel.
    Icu in icu;
    /// A quadrature encoder.
    Encoder in encoder;
    /// A level on a GPIO.
    Digital in digital;
    /// Bytes on a serial port.
    Uart in uart;
    /// A device on an SPI bus.
    Spi in spi;
    /// A pulse width on a timer output.
    Pwm in pwm;
    /// A voltage from a DAC output.
    Dac in dac;
    /// Frames on a CAN bus.
    Can in can;
    /// A part with one data wire, such as a DS18B20 or a DHT22.
    OneWire in onewire;
    /// A stepper motor behind a driver with step and direction.
    Stepper in stepper;
    /// A value that code on the board makes, or that it gets from the host.
    Code in code;
}

impl KindName {
    /// The word in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.spec().name
    }

    /// The name with its article, for messages.
    #[must_use]
    pub fn with_article(self) -> String {
        format!("{} {} device", self.spec().article, self.name())
    }

    /// The kind with that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether the pin can be that wire.
    #[must_use]
    pub fn serves(self, role: Role, pin: &Pin) -> bool {
        let of_kind = match self.spec().serves {
            Serves::AnyPin => true,
            Serves::Signal(is) => pin.usages.iter().any(|usage| is(role, usage.signal.function())),
        };
        of_kind || role.is_on_any_pin()
    }

    /// All names, for a message.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

impl fmt::Display for KindName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use sensedsl_diagnostics::{SourceMap, Span};
    use sensedsl_wire::ScalarType;

    use super::*;
    use crate::fields::asked;

    /// The properties that a kind's `read` asks for.
    fn asked(kind: KindName) -> BTreeSet<String> {
        let mut sources = SourceMap::default();
        let file = sources.add("x.sense", "");
        let asked = asked::during(|| {
            for direction in kind.spec().directions {
                let constants = crate::value::constants::Constants::default();
                let (mut reported, at) = (Vec::new(), Span::new(file, 0..0));
                let (none, reported) = (std::iter::empty(), (&constants, &mut reported));
                let mut fields = Fields::new(none, file, "a device", at, reported);
                kind.read(&mut fields, *direction, ValueType::scalar(ScalarType::Uint16));
            }
        });
        asked.into_keys().collect()
    }

    #[test]
    fn the_properties_of_a_kind_are_those_that_it_reads() {
        for kind in KindName::ALL {
            let own = kind.spec().properties.iter().map(|name| (*name).to_owned());
            let (listed, asked): (BTreeSet<String>, _) = (own.collect(), asked(kind));
            let unlisted: Vec<_> = asked.difference(&listed).collect();
            assert!(unlisted.is_empty(), "{kind}: {unlisted:?} are read and not in its SPEC");
            let wires = Role::ALL.map(|role| role.property().to_owned());
            let unread = listed.difference(&asked).filter(|name| !wires.contains(name));
            let unread: Vec<_> = unread.collect();
            assert!(unread.is_empty(), "{kind}: {unread:?} are in its SPEC and not read");
        }
    }

    #[test]
    fn the_wires_of_a_kind_are_in_order_and_can_be_fixed() {
        let names: BTreeSet<&str> = Role::ALL.into_iter().map(Role::name).collect();
        assert_eq!(names.len(), Role::ALL.len(), "two wires have one name");
        for kind in KindName::ALL {
            for direction in kind.spec().directions {
                let roles = Kind::plain(kind, 0x40).roles(*direction);
                assert!(
                    roles.is_sorted(),
                    "{kind}: {roles:?} are not in the order of the tie-break"
                );
                for role in roles {
                    let property = role.property();
                    assert!(kind.spec().properties.contains(&property), "{kind}: `{property}`");
                }
            }
        }
    }
}
