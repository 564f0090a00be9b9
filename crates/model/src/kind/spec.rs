//! What all devices of a kind share, and what each kind must provide.

use sensedsl_board::signal::Function;
use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::role::Role;
use crate::fields::Fields;

/// A kind of device.
#[derive(Clone, Copy, Debug)]
pub struct KindSpec {
    /// The word after `type`.
    pub name: &'static str,
    /// `a` or `an`, for messages.
    pub article: &'static str,
    /// The directions that devices may have.
    pub directions: &'static [Direction],
    /// The types that a value may have.
    pub values: Values,
    /// The properties besides those that every device has.
    pub properties: &'static [&'static str],
    /// Whether devices share wires.
    pub sharing: Sharing,
    /// Whether the hardware measures on its own, regardless of the cycle time.
    pub triggers_itself: bool,
    /// The least and the greatest code of a value; none if its type and its bits decide.
    pub codes: Option<(f64, f64)>,
    /// The type of one number of a driver that gives none.
    pub natural: ScalarType,
    /// Properties that only an input has: a driver that gives none of them, and no direction, is for
    /// an output. Empty if it is for an input then.
    pub inputs_have: &'static [&'static str],
    /// Properties that all values of a chip have in common, although each has others of its own.
    pub of_part: &'static [&'static str],
    /// The pins that can be its wires, for proposals to who named one that does not exist.
    pub serves: Serves,
    /// The wires, for the language page.
    pub wires: &'static str,
    /// What a device has besides `id` and `type` in tests of all kinds, which need its value to come.
    pub example: &'static str,
    /// Its colour in pictures on a light ground, `#RRGGBB`. People with any of the common colour
    /// blindnesses can distinguish all of them: `report` has the test.
    pub colour: &'static str,
    /// Its colour in pictures on a dark ground.
    pub colour_on_dark: &'static str,
    /// Its letter in pictures, for people who cannot distinguish the colours.
    pub letter: char,
}

/// The pins that can be a kind's wires, besides those for which any pin will do.
#[derive(Clone, Copy, Debug)]
pub enum Serves {
    /// All pins.
    AnyPin,
    /// Those with a function that can be the wire.
    Signal(fn(Role, &Function) -> bool),
}

/// The types that a value of a kind may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// A whole number, or one with a fraction.
    OneNumber,
    /// A whole number or a truth value.
    WholeNumber,
    /// Any type, arrays included.
    Any,
}

impl Values {
    /// Checks that a value may have that type.
    ///
    /// # Errors
    /// The types that it may have, in words.
    pub fn accept(self, value: ValueType) -> Result<(), &'static str> {
        let (fits, can) = match self {
            Self::OneNumber => (
                value.scalar != ScalarType::Bool,
                "one number a wire: uint8..uint64, int8..int64, float32 or float64",
            ),
            Self::WholeNumber => {
                (value.scalar.integer_range().is_some(), "bool or one whole number a wire")
            }
            Self::Any => (true, ""),
        };
        if fits { Ok(()) } else { Err(can) }
    }

    /// How many sets of wires a value takes: for an array of numbers with a wire each, as many as
    /// it has elements.
    #[must_use]
    pub const fn wires(self, value: ValueType) -> Option<u16> {
        match self {
            Self::OneNumber | Self::WholeNumber => value.length,
            Self::Any => None,
        }
    }

    /// The text for the language page.
    #[must_use]
    pub const fn shown(self) -> &'static str {
        match self {
            Self::OneNumber => "one number, no `bool`; an array is as many wires",
            Self::WholeNumber => "`bool` or one whole number; an array is as many wires",
            Self::Any => "any type",
        }
    }
}

/// Whether devices share wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Each device has its own wires.
    Own,
    /// Any number of devices share the same wires.
    Bus,
    /// Devices with different addresses share the same wires.
    Addresses,
    /// Any number of devices share the same wires, and each also has a wire of its own.
    BusAndSelect,
}

/// What a kind's properties must provide. A new kind implements it in its file.
pub(crate) trait Properties: Sized {
    /// Reads the properties of a device with that direction and value type.
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self;

    /// The properties of a device with none given; `address` (7-bit) is free on every bus.
    fn plain(address: u8) -> Self;

    /// The wires, in the order of the tie-break.
    fn roles(&self, direction: Direction) -> Vec<Role>;

    /// How long a measurement lasts once it has begun, in microseconds.
    fn measuring_us(&self) -> u32 {
        0
    }
}
