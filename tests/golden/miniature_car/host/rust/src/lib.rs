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
pub const DESIGN: &str = "miniature_car";

#[doc = "The sensor IRFrontRight. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IRFrontRight {
    /// The code.
    pub raw: u16,
}

device! {
    IRFrontRight: u16, plain u16,
    Facts {
        id: 1,
        name: "IRFrontRight",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(60),
    }
}

#[doc = "The sensor IRRearRight. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IRRearRight {
    /// The code.
    pub raw: u16,
}

device! {
    IRRearRight: u16, plain u16,
    Facts {
        id: 2,
        name: "IRRearRight",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(60),
    }
}

#[doc = "The sensor IRRear. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IRRear {
    /// The code.
    pub raw: u16,
}

device! {
    IRRear: u16, plain u16,
    Facts {
        id: 3,
        name: "IRRear",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(60),
    }
}

#[doc = "The sensor USFront. Its value is shown in cm, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct USFront {
    /// The code.
    pub raw: u16,
}

device! {
    USFront: u16, plain u16,
    Facts {
        id: 4,
        name: "USFront",
        is_sensor: true,
        scaling: None,
        unit: Some("cm"),
        min: None,
        max: None,
        cycle_ms: Some(70),
    }
}

#[doc = "The sensor USFrontRight. Its value is shown in cm, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct USFrontRight {
    /// The code.
    pub raw: u16,
}

device! {
    USFrontRight: u16, plain u16,
    Facts {
        id: 5,
        name: "USFrontRight",
        is_sensor: true,
        scaling: None,
        unit: Some("cm"),
        min: None,
        max: None,
        cycle_ms: Some(70),
    }
}

#[doc = "The sensor USRear. Its value is shown in cm, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct USRear {
    /// The code.
    pub raw: u16,
}

device! {
    USRear: u16, plain u16,
    Facts {
        id: 6,
        name: "USRear",
        is_sensor: true,
        scaling: None,
        unit: Some("cm"),
        min: None,
        max: None,
        cycle_ms: Some(70),
    }
}

#[doc = "The sensor WheelLeftA. Its value is shown, its code is uint32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelLeftA {
    /// The code.
    pub raw: u32,
}

device! {
    WheelLeftA: u32, plain u32,
    Facts {
        id: 7,
        name: "WheelLeftA",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The sensor WheelLeftB. Its value is shown, its code is uint32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelLeftB {
    /// The code.
    pub raw: u32,
}

device! {
    WheelLeftB: u32, plain u32,
    Facts {
        id: 8,
        name: "WheelLeftB",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The sensor WheelRightA. Its value is shown, its code is uint32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelRightA {
    /// The code.
    pub raw: u32,
}

device! {
    WheelRightA: u32, plain u32,
    Facts {
        id: 9,
        name: "WheelRightA",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The sensor WheelRightB. Its value is shown, its code is uint32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelRightB {
    /// The code.
    pub raw: u32,
}

device! {
    WheelRightB: u32, plain u32,
    Facts {
        id: 10,
        name: "WheelRightB",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The sensor RCSteering. Its value is shown in us, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RCSteering {
    /// The code.
    pub raw: u16,
}

device! {
    RCSteering: u16, plain u16,
    Facts {
        id: 11,
        name: "RCSteering",
        is_sensor: true,
        scaling: None,
        unit: Some("us"),
        min: Some(1000.0),
        max: Some(2000.0),
        cycle_ms: None,
    }
}

#[doc = "The sensor RCThrottle. Its value is shown in us, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RCThrottle {
    /// The code.
    pub raw: u16,
}

device! {
    RCThrottle: u16, plain u16,
    Facts {
        id: 12,
        name: "RCThrottle",
        is_sensor: true,
        scaling: None,
        unit: Some("us"),
        min: Some(1000.0),
        max: Some(2000.0),
        cycle_ms: None,
    }
}

#[doc = "The sensor RCSwitch. Its value is shown in us, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RCSwitch {
    /// The code.
    pub raw: u16,
}

device! {
    RCSwitch: u16, plain u16,
    Facts {
        id: 13,
        name: "RCSwitch",
        is_sensor: true,
        scaling: None,
        unit: Some("us"),
        min: Some(1000.0),
        max: Some(2000.0),
        cycle_ms: None,
    }
}

messages! {
    /// All messages of a board, of its sensors and its actuators.
    STM32F4DiscoveryBoardMessage {
        1 => IRFrontRight,
        2 => IRRearRight,
        3 => IRRear,
        4 => USFront,
        5 => USFrontRight,
        6 => USRear,
        7 => WheelLeftA,
        8 => WheelLeftB,
        9 => WheelRightA,
        10 => WheelRightB,
        11 => RCSteering,
        12 => RCThrottle,
        13 => RCSwitch,
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
        "1 sensor IRFrontRight uint16\u{a}",
        "2 sensor IRRearRight uint16\u{a}",
        "3 sensor IRRear uint16\u{a}",
        "4 sensor USFront uint16\u{a}",
        "5 sensor USFrontRight uint16\u{a}",
        "6 sensor USRear uint16\u{a}",
        "7 sensor WheelLeftA uint32\u{a}",
        "8 sensor WheelLeftB uint32\u{a}",
        "9 sensor WheelRightA uint32\u{a}",
        "10 sensor WheelRightB uint32\u{a}",
        "11 sensor RCSteering uint16\u{a}",
        "12 sensor RCThrottle uint16\u{a}",
        "13 sensor RCSwitch uint16\u{a}",
    );
    const HASH: u32 = 0x64783683;
    const CHECKSUM: Checksum = Checksum::None;
    const IS_STAMPED: bool = false;
    const BAUD: u32 = 115200;
    const SILENCE_MS: Option<u32> = None;
    const ITEMS: &'static [Item] = &[
        Item { id: 1, name: "IRFrontRight", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 2, name: "IRRearRight", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 3, name: "IRRear", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 4, name: "USFront", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 5, name: "USFrontRight", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 6, name: "USRear", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 7, name: "WheelLeftA", is_sensor: true, bytes: 4, is_bool: false },
        Item { id: 8, name: "WheelLeftB", is_sensor: true, bytes: 4, is_bool: false },
        Item { id: 9, name: "WheelRightA", is_sensor: true, bytes: 4, is_bool: false },
        Item { id: 10, name: "WheelRightB", is_sensor: true, bytes: 4, is_bool: false },
        Item { id: 11, name: "RCSteering", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 12, name: "RCThrottle", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 13, name: "RCSwitch", is_sensor: true, bytes: 2, is_bool: false },
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
