//! Messages: the value of one device, and any of a board's.

use core::fmt::{self, Write as _};

use super::values::{Facts, Number, Overstep, Raw, Refused};

/// The value of one device: `raw` as it travels.
pub trait Device: Copy + fmt::Debug + fmt::Display + PartialEq + Send + 'static {
    /// The type of the raw value.
    type Raw: Raw;
    /// What the design says of the device.
    const FACTS: Facts;
    /// The message of a raw value.
    fn from_raw(raw: Self::Raw) -> Self;
    /// The raw value.
    fn into_raw(self) -> Self::Raw;
}

/// Prints a message as all hosts do: `Ranger = 1000 (37.9758523 cm)`.
pub(crate) fn print<D: Device>(device: D, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let facts = &D::FACTS;
    write!(f, "{} = ", facts.name)?;
    let raw = device.into_raw();
    raw.print(f, None)?;
    if facts.scaling.is_some() || facts.unit.is_some() {
        f.write_str(" (")?;
        raw.print(f, Some(facts))?;
        if let Some(unit) = facts.unit {
            write!(f, " {unit}")?;
        }
        f.write_char(')')?;
    }
    let unit = facts.unit.map_or(("", ""), |unit| (" ", unit));
    match raw.beyond(facts).map(|(_, overstep)| overstep) {
        Some(Overstep::Below(least)) => {
            write!(f, " (below the minimum of {}{}{})", Number(least), unit.0, unit.1)
        }
        Some(Overstep::Above(most)) => {
            write!(f, " (above the maximum of {}{}{})", Number(most), unit.0, unit.1)
        }
        None => Ok(()),
    }
}

/// Any message of a board.
pub trait AnyMessage: Copy + fmt::Debug + fmt::Display + PartialEq + Send + 'static {
    /// What the design says of its device.
    fn facts(&self) -> &'static Facts;
    /// The bytes of its raw value.
    fn bytes(&self) -> usize;
    /// Writes the raw value to that many bytes.
    fn write(&self, bytes: &mut [u8]);
    /// Prints the raw value alone.
    ///
    /// # Errors
    /// Fails if the formatter does.
    fn print_raw(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result;
    /// Whether it is beyond a limit of the design.
    fn refused(&self) -> Option<Refused>;
}

/// What all messages have. `shown` for a device whose values are scaled, `plain` for one whose raw value is shown.
macro_rules! device {
    ($name:ident: $raw:ty, $mode:ident $value:ty, $facts:expr) => {
        impl $name {
            /// What the design says of the device.
            pub const FACTS: $crate::sensedsl::Facts = $facts;

            /// What is shown.
            #[must_use]
            pub fn value(&self) -> $value {
                device!(@$mode value self)
            }

            /// The unit of what is shown; empty where there is none.
            #[must_use]
            pub fn unit(&self) -> &'static str {
                Self::FACTS.unit.unwrap_or("")
            }

            /// The message of what is shown: the nearest code.
            ///
            /// # Errors
            /// Fails if the value is beyond a limit of the design, or if no code is shown so.
            pub fn of(value: $value) -> Result<Self, $crate::sensedsl::Refused> {
                device!(@$mode of value)
            }

            /// The message of a code.
            ///
            /// # Errors
            /// Fails if what is shown is beyond a limit of the design.
            pub fn of_raw(raw: $raw) -> Result<Self, $crate::sensedsl::Refused> {
                match $crate::sensedsl::AnyMessage::refused(&Self { raw }) {
                    Some(refused) => Err(refused),
                    None => Ok(Self { raw }),
                }
            }

            /// The limit of the design that the value is beyond.
            #[must_use]
            pub fn outside(&self) -> Option<$crate::sensedsl::Overstep> {
                $crate::sensedsl::AnyMessage::refused(self)?.overstep
            }
        }

        impl $crate::sensedsl::Device for $name {
            type Raw = $raw;
            const FACTS: $crate::sensedsl::Facts = Self::FACTS;

            fn from_raw(raw: $raw) -> Self {
                Self { raw }
            }

            fn into_raw(self) -> $raw {
                self.raw
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                $crate::sensedsl::print(*self, f)
            }
        }
    };
    (@shown value $self:ident) => { $crate::sensedsl::Raw::shown($self.raw, &Self::FACTS) };
    (@plain value $self:ident) => { $self.raw };
    (@shown of $value:ident) => {
        $crate::sensedsl::Raw::of_shown($value, &Self::FACTS).map(|raw| Self { raw })
    };
    (@plain of $value:ident) => { Self::of_raw($value) };
}

impl<D: Device> AnyMessage for D {
    fn facts(&self) -> &'static Facts {
        &D::FACTS
    }

    fn bytes(&self) -> usize {
        D::Raw::BYTES
    }

    fn write(&self, bytes: &mut [u8]) {
        self.into_raw().write(bytes);
    }

    fn print_raw(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.into_raw().print(f, None)
    }

    fn refused(&self) -> Option<Refused> {
        let (value, overstep) = self.into_raw().beyond(&D::FACTS)?;
        Some(Refused { device: D::FACTS.name, value, overstep: Some(overstep) })
    }
}

/// An enumeration of all messages of a board, by their identifiers.
macro_rules! messages {
    ($(#[$doc:meta])* $name:ident { $($id:literal => $device:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(clippy::large_enum_variant, reason = "nothing is allocated")]
        pub enum $name {
            $(
                #[allow(missing_docs, reason = "the type has them")]
                $device($device),
            )*
        }

        impl $name {
            /// The message of an item, if it has such bytes.
            #[inline]
            #[must_use]
            pub fn read(id: u8, bytes: &[u8]) -> Option<Self> {
                match id {
                    $($id => Some(Self::$device(<$device as $crate::sensedsl::Device>::from_raw(
                        $crate::sensedsl::Raw::read(bytes)?,
                    ))),)*
                    _ => {
                        let _ = bytes;
                        None
                    }
                }
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let _ = &f;
                match *self {
                    $(Self::$device(one) => core::fmt::Display::fmt(&one, f),)*
                }
            }
        }

        impl $crate::sensedsl::AnyMessage for $name {
            fn facts(&self) -> &'static $crate::sensedsl::Facts {
                match *self {
                    $(Self::$device(ref one) => $crate::sensedsl::AnyMessage::facts(one),)*
                }
            }

            fn bytes(&self) -> usize {
                match *self {
                    $(Self::$device(ref one) => $crate::sensedsl::AnyMessage::bytes(one),)*
                }
            }

            fn write(&self, bytes: &mut [u8]) {
                let _ = &bytes;
                match *self {
                    $(Self::$device(ref one) => $crate::sensedsl::AnyMessage::write(one, bytes),)*
                }
            }

            fn print_raw(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let _ = &f;
                match *self {
                    $(Self::$device(ref one) => $crate::sensedsl::AnyMessage::print_raw(one, f),)*
                }
            }

            fn refused(&self) -> Option<$crate::sensedsl::Refused> {
                match *self {
                    $(Self::$device(ref one) => $crate::sensedsl::AnyMessage::refused(one),)*
                }
            }
        }

        $(
            impl From<$device> for $name {
                fn from(one: $device) -> Self {
                    Self::$device(one)
                }
            }

            impl TryFrom<$name> for $device {
                type Error = $name;

                #[allow(unreachable_patterns, reason = "a board may have one device")]
                fn try_from(message: $name) -> Result<Self, $name> {
                    match message {
                        $name::$device(one) => Ok(one),
                        other => Err(other),
                    }
                }
            }
        )*
    };
}
