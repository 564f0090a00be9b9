//! What is the same for all devices of a kind, and what each kind must be able to tell.

use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::Role;
use crate::fields::Fields;

/// A kind of device.
#[derive(Clone, Copy, Debug)]
pub struct KindSpec {
    /// The word after `type`.
    pub name: &'static str,
    /// `a` or `an`, for messages.
    pub article: &'static str,
    /// Which way devices may go.
    pub directions: &'static [Direction],
    /// The types that a value may have.
    pub values: Values,
    /// The properties beside those of every device.
    pub properties: &'static [&'static str],
    /// Whether devices share wires.
    pub sharing: Sharing,
    /// Whether the hardware takes the measurement itself, whatever the cycle time.
    pub triggers_itself: bool,
    /// The wires, for the language page.
    pub wires: &'static str,
    /// What a device needs beside `id` and `type`: for examples and tests.
    pub example: &'static str,
    /// Its colour in pictures, `#RRGGBB`: from a palette that people with colour blindness can tell
    /// apart (Okabe and Ito, 2008), and shades of it.
    pub colour: &'static str,
    /// Its sign in pictures, for those who cannot tell the colours.
    pub letter: char,
}

/// The types that a value of a kind may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// A whole number or one with a fraction.
    OneNumber,
    /// A whole number or a truth value.
    WholeNumber,
    /// Any type, arrays included.
    Any,
}

impl Values {
    /// Whether a value may have that type.
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

    /// How many sets of wires a value takes: an array of numbers that have a wire each as many as it
    /// has elements.
    #[must_use]
    pub const fn wires(self, value: ValueType) -> Option<u16> {
        match self {
            Self::OneNumber | Self::WholeNumber => value.length,
            Self::Any => None,
        }
    }

    /// For the language page.
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
    /// Each has its own.
    Own,
    /// Any number of devices is on the same wires.
    Bus,
    /// Any number of devices is on the same wires, each with a wire of its own beside them.
    BusAndSelect,
}

/// What a kind's properties must be able to tell. A new kind implements it in its file.
pub(crate) trait Properties: Sized {
    /// Takes the properties of a device of that direction with a value of that type.
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self;

    /// Those of a device without any property given; `address` (7-bit) is free on every bus.
    fn plain(address: u8) -> Self;

    /// The wires, in the order of the tie-break.
    fn roles(&self, direction: Direction) -> Vec<Role>;

    /// How long a measurement lasts once it has begun, in microseconds.
    fn measuring_us(&self) -> u32 {
        0
    }
}
