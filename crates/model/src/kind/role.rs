//! The wires of devices, in the order of the tie-break; one line each.

use std::fmt;

/// Generates the type, and what all wires have, from the table below.
macro_rules! roles {
    ($($(#[$doc:meta])* $Role:ident($name:literal, pin: $property:literal, driven by $by:ident, on $on:ident);)*) => {
        /// A wire of a device, in the order of the tie-break.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Role {
            $($(#[$doc])* $Role,)*
        }

        impl Role {
            /// All roles, in the order of the tie-break.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$Role),*];

            /// The word in JSON output and, except for `in` and `out`, the property that fixes the
            /// pin.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$Role => $name,)* }
            }

            /// The property that fixes the pin of this role.
            #[must_use]
            pub const fn property(self) -> &'static str {
                match self { $(Self::$Role => $property,)* }
            }

            /// Whether the device, not the MCU, drives the wire.
            #[must_use]
            pub const fn is_driven_by_device(self) -> bool {
                matches!(match self { $(Self::$Role => Driver::$by,)* }, Driver::Device)
            }

            /// Whether any pin can be the wire: a GPIO beside those of the interface.
            #[must_use]
            pub const fn is_on_any_pin(self) -> bool {
                matches!(match self { $(Self::$Role => Place::$on,)* }, Place::AnyPin)
            }
        }
    };
}

/// The end that drives a wire.
enum Driver {
    Device,
    Mcu,
}

/// The pins that can be a wire.
enum Place {
    /// Those of the device's interface.
    Interface,
    /// Any: it is a GPIO beside them.
    AnyPin,
}

roles! {
    /// The only wire of a sensor.
    In("in", pin: "pin", driven by Device, on Interface);
    /// The only wire of an actuator.
    Out("out", pin: "pin", driven by Mcu, on Interface);
    /// I2C clock; a device may stretch it.
    Scl("scl", pin: "scl", driven by Device, on Interface);
    /// I2C data.
    Sda("sda", pin: "sda", driven by Device, on Interface);
    /// Transmission by the board.
    Tx("tx", pin: "tx", driven by Mcu, on Interface);
    /// Reception by the board.
    Rx("rx", pin: "rx", driven by Device, on Interface);
    /// Which end of a half-duplex line speaks: high while the board does.
    Direction("direction", pin: "direction", driven by Mcu, on AnyPin);
    /// SPI clock.
    Sck("sck", pin: "sck", driven by Mcu, on Interface);
    /// SPI data from the device.
    Miso("miso", pin: "miso", driven by Device, on Interface);
    /// SPI data to the device.
    Mosi("mosi", pin: "mosi", driven by Mcu, on Interface);
    /// SPI chip select.
    Cs("cs", pin: "cs", driven by Mcu, on AnyPin);
    /// First encoder line.
    A("a", pin: "a", driven by Device, on Interface);
    /// Second encoder line.
    B("b", pin: "b", driven by Device, on Interface);
    /// The pulse that makes an icu device measure (HC-SR04).
    Trigger("trigger", pin: "trigger", driven by Mcu, on AnyPin);
    /// The only wire of a part that both ends pull low.
    Data("data", pin: "pin", driven by Device, on Interface);
    /// A pulse for each step of a motor.
    Step("step", pin: "step", driven by Mcu, on Interface);
    /// The direction of a motor's steps.
    Dir("dir", pin: "dir", driven by Mcu, on AnyPin);
    /// Lets current into a motor.
    Enable("enable", pin: "enable", driven by Mcu, on AnyPin);
}

impl Role {
    /// The role whose pin that property fixes; none for `pin`, which stands for the only wire of
    /// any device.
    #[must_use]
    pub fn from_property(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.property() == name && name != Self::In.property())
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
