//! How the bytes of a command are sent where they are not the words of its value: colours of LED strips, letters of a
//! display.
//!
//! In: the words after `encoding` and `colours`. Out: which wires that takes, which values it sends, and what the strip
//! demands of the times on its wire. Whoever computes bytes or clocks asks here, so that a strip is described once.

use sensedsl_diagnostics::codes::e0245_other_encoding::other_encoding;
use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::role::Role;
use crate::fields::Fields;
use crate::spanned::Spanned;

/// How the bytes of a command are sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// As the words of its value.
    #[default]
    Plain,
    /// As pulses on one wire, with the times of a WS2812B.
    Ws2812,
    /// As pulses on one wire, with the times of an SK6812.
    Sk6812,
    /// As the frames of an APA102.
    Apa102,
    /// As the dots of letters, six columns of eight dots each.
    Text,
}

/// The words after `encoding` of a device on SPI.
pub(super) const OF_SPI: [(&str, Encoding); 4] = [
    ("none", Encoding::Plain),
    ("ws2812", Encoding::Ws2812),
    ("sk6812", Encoding::Sk6812),
    ("apa102", Encoding::Apa102),
];
/// The words after `encoding` of a device on I2C.
pub(super) const OF_I2C: [(&str, Encoding); 2] =
    [("none", Encoding::Plain), ("text", Encoding::Text)];

/// The order in which the colours of an LED are sent: for each the place of its byte in the number, 0 for the lowest.
pub type Colours = &'static [u8];

const WHITE: u8 = 3;
const RED: u8 = 2;
const GREEN: u8 = 1;
const BLUE: u8 = 0;

/// The words after `colours`.
pub(super) const COLOURS: [(&str, Colours); 8] = [
    ("rgb", &[RED, GREEN, BLUE]),
    ("rbg", &[RED, BLUE, GREEN]),
    ("grb", &[GREEN, RED, BLUE]),
    ("gbr", &[GREEN, BLUE, RED]),
    ("brg", &[BLUE, RED, GREEN]),
    ("bgr", &[BLUE, GREEN, RED]),
    ("rgbw", &[RED, GREEN, BLUE, WHITE]),
    ("grbw", &[GREEN, RED, BLUE, WHITE]),
];

/// The least and the greatest time of a level, in nanoseconds.
pub type Window = (u32, u32);

/// What a strip demands of the times on its wire, in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Windows {
    /// High and low of a 0.
    pub zero: (Window, Window),
    /// High and low of a 1.
    pub one: (Window, Window),
}

/// Worldsemi, data sheet WS2812B: 0.4 and 0.85 us for a 0, 0.8 and 0.45 us for a 1, each 150 ns more or less.
const WS2812: Windows = Windows { zero: ((250, 550), (700, 1_000)), one: ((650, 950), (300, 600)) };
/// Opsco, data sheet SK6812: 0.3 and 0.9 us for a 0, 0.6 and 0.6 us for a 1, each 150 ns more or less.
const SK6812: Windows = Windows { zero: ((150, 450), (750, 1_050)), one: ((450, 750), (450, 750)) };

impl Encoding {
    /// The times that the pulses of a strip must have; none if it is not sent in pulses.
    #[must_use]
    pub const fn windows(self) -> Option<Windows> {
        match self {
            Self::Ws2812 => Some(WS2812),
            Self::Sk6812 => Some(SK6812),
            Self::Plain | Self::Apa102 | Self::Text => None,
        }
    }

    /// Whether it is a strip of LEDs, which nothing selects: it takes whatever is sent.
    #[must_use]
    pub const fn is_strip(self) -> bool {
        matches!(self, Self::Ws2812 | Self::Sk6812 | Self::Apa102)
    }

    /// The order of the colours unless the file gives one.
    pub(super) const fn colours(self) -> Colours {
        match self {
            Self::Ws2812 | Self::Sk6812 => &[GREEN, RED, BLUE],
            Self::Apa102 => &[BLUE, GREEN, RED],
            Self::Plain | Self::Text => &[],
        }
    }

    /// The wires of SPI that it takes.
    pub(super) fn wires(self) -> Vec<Role> {
        match self {
            Self::Ws2812 | Self::Sk6812 => vec![Role::Mosi],
            Self::Apa102 => vec![Role::Sck, Role::Mosi],
            Self::Plain | Self::Text => vec![Role::Sck, Role::Miso, Role::Mosi, Role::Cs],
        }
    }

    /// The word after `encoding`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "none",
            Self::Ws2812 => "ws2812",
            Self::Sk6812 => "sk6812",
            Self::Apa102 => "apa102",
            Self::Text => "text",
        }
    }

    /// The type of the elements that it sends, and what they are; none if any can be sent.
    #[must_use]
    pub const fn sends(self) -> Option<(ScalarType, &'static str)> {
        match self {
            Self::Plain => None,
            Self::Ws2812 | Self::Sk6812 | Self::Apa102 => Some((ScalarType::Uint32, "colours")),
            Self::Text => Some((ScalarType::Uint8, "letters")),
        }
    }
}

/// The type of what the encoding of that name sends; none if it sends any.
pub(crate) fn scalar(name: &str) -> Option<ScalarType> {
    let mut all = OF_SPI.iter().chain(&OF_I2C);
    all.find(|(word, _)| *word == name)?.1.sends().map(|(scalar, _)| scalar)
}

/// Reads the encoding of a command, which must have values of that type.
pub(super) fn read(
    fields: &mut Fields<'_>,
    words: &[(&str, Encoding)],
    direction: Direction,
    value: ValueType,
) -> Encoding {
    let Some(Spanned { value: encoding, span }) = fields.word("encoding", words) else {
        return Encoding::Plain;
    };
    let Some((scalar, what)) = encoding.sends() else { return encoding };
    if direction == Direction::Sensor {
        fields.needs_direction(span, "encoding", Direction::Actuator);
        return Encoding::Plain;
    }
    if value.scalar != scalar {
        // A driver of the library has the encoding, and whoever uses it the type.
        let own = fields.own_span("encoding");
        let at = own.unwrap_or_else(|| fields.owner_span());
        let words = (encoding.name(), what, scalar.name());
        fields.say(other_encoding(at, own.is_none().then_some(span), words, &value.to_string()));
        return Encoding::Plain;
    }
    encoding
}

/// Reads the order of the colours.
pub(super) fn colours(fields: &mut Fields<'_>, encoding: Encoding) -> Colours {
    let Some(word) = fields.word("colours", &COLOURS) else { return encoding.colours() };
    if !encoding.is_strip() {
        fields.contradiction(word.span, "encoding", "`colours` is for LED strips only");
        return encoding.colours();
    }
    if encoding == Encoding::Apa102 && word.value.len() > 3 {
        fields.contradiction(word.span, "encoding", "an APA102 has three colours");
        return encoding.colours();
    }
    word.value
}
