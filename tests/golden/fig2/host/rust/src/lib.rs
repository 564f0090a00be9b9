//! The boards of a design and their messages. Generated: changes are lost when it is generated again.
//!
//! Each device is a struct with its `raw` code and the `value()` that people read, each board a type with an enumeration
//! of all its messages. With the feature `std`, `open` and `find` of a board give a [`Board`]; without it, [`Link`] takes
//! bytes and gives messages.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]
#![allow(non_camel_case_types, reason = "names are the design's")]

#[macro_use]
pub mod sensedsl;

pub use sensedsl::*;

/// The design that this crate was generated for.
pub const DESIGN: &str = "fig2";

#[doc = "The sensor IRFront. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IRFront {
    /// The code.
    pub raw: u16,
}

device! {
    IRFront: u16, plain u16,
    Facts {
        id: 17,
        name: "IRFront",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(1000),
    }
}

#[doc = "The sensor IRFrontRight. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IRFrontRight {
    /// The code.
    pub raw: u16,
}

device! {
    IRFrontRight: u16, plain u16,
    Facts {
        id: 18,
        name: "IRFrontRight",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(60),
    }
}

#[doc = "The sensor USRear. Its value is shown in cm, its code is uint8."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct USRear {
    /// The code.
    pub raw: u8,
}

device! {
    USRear: u8, plain u8,
    Facts {
        id: 19,
        name: "USRear",
        is_sensor: true,
        scaling: None,
        unit: Some("cm"),
        min: None,
        max: None,
        cycle_ms: Some(80),
    }
}

#[doc = "The sensor WheelEncoder. Its value is shown, its code is uint32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelEncoder {
    /// The code.
    pub raw: u32,
}

device! {
    WheelEncoder: u32, plain u32,
    Facts {
        id: 20,
        name: "WheelEncoder",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

messages! {
    /// All messages of a board, of its sensors and its actuators.
    STM32F4DiscoveryBoardMessage {
        17 => IRFront,
        18 => IRFrontRight,
        19 => USRear,
        20 => WheelEncoder,
    }
}

/// A board of the design.
#[derive(Clone, Copy, Debug)]
pub struct STM32F4DiscoveryBoard;

impl Schema for STM32F4DiscoveryBoard {
    type Message = STM32F4DiscoveryBoardMessage;
    type Held = [u8; Table::frame_bytes(Self::ITEMS, false, Self::CHECKSUM)];
    const HELD: Self::Held = [0; Table::frame_bytes(Self::ITEMS, false, Self::CHECKSUM)];
    const NAME: &'static str = "STM32F4DiscoveryBoard";
    const TEXT: &'static str = concat!(
        "checksum none\u{a}",
        "17 sensor IRFront uint16\u{a}",
        "18 sensor IRFrontRight uint16\u{a}",
        "19 sensor USRear uint8\u{a}",
        "20 sensor WheelEncoder uint32\u{a}",
    );
    const HASH: u32 = 0xb2d2a70b;
    const CHECKSUM: Checksum = Checksum::None;
    const IS_STAMPED: bool = false;
    const BAUD: u32 = 115200;
    const SILENCE_MS: Option<u32> = None;
    const ITEMS: &'static [Item] = &[
        Item { id: 17, name: "IRFront", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 18, name: "IRFrontRight", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 19, name: "USRear", is_sensor: true, bytes: 1, is_bool: false },
        Item { id: 20, name: "WheelEncoder", is_sensor: true, bytes: 4, is_bool: false },
    ];
    const SENSORS: &'static Table = &Table::new(Self::ITEMS, true, false);
    const ACTUATORS: &'static Table = &Table::new(Self::ITEMS, false, false);

    #[inline]
    fn read(id: u8, bytes: &[u8]) -> Option<STM32F4DiscoveryBoardMessage> {
        STM32F4DiscoveryBoardMessage::read(id, bytes)
    }
}

#[cfg(feature = "std")]
impl STM32F4DiscoveryBoard {
    /// Opens the board at a serial port.
    ///
    /// # Errors
    /// Fails if the port cannot be opened.
    pub fn open(path: &str) -> Result<Board<Self>, Error> {
        Board::open(path)
    }

    /// Opens the first USB port that answers as this board.
    ///
    /// # Errors
    /// Fails if none does.
    pub fn find() -> Result<Board<Self>, Error> {
        Board::find()
    }

    /// Reads what was recorded of the board's link.
    pub fn play(recording: impl std::io::Read + Send + 'static) -> Board<Self> {
        Board::play(recording)
    }
}
