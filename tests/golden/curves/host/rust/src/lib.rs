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
pub const DESIGN: &str = "curves";

#[doc = "The sensor Ranger: a GP2Y0A21 behind the bumper. Its value is shown in cm, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranger {
    /// The code.
    pub raw: u16,
}

device! {
    Ranger: u16, shown f64,
    Facts {
        id: 1,
        name: "Ranger",
        is_sensor: true,
        scaling: Some(Scaling { scale: 0.0008056640625, offset: 0.0, curve: &[(0.4, 80.0), (0.5, 60.0), (0.75, 40.0), (1.3, 20.0), (2.3, 10.0), (3.1, 6.0)] }),
        unit: Some("cm"),
        min: Some(8.0),
        max: Some(70.0),
        cycle_ms: Some(1000),
    }
}

#[doc = "The sensor Line. Its value is shown in percent, its code is uint16[8]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The code.
    pub raw: [u16; 8],
}

device! {
    Line: [u16; 8], shown [f64; 8],
    Facts {
        id: 10,
        name: "Line",
        is_sensor: true,
        scaling: Some(Scaling { scale: 1.0, offset: 0.0, curve: &[(200.0, 0.0), (3800.0, 100.0)] }),
        unit: Some("percent"),
        min: Some(1.0),
        max: None,
        cycle_ms: Some(1000),
    }
}

#[doc = "The sensor Bumper. Its value is shown, its code is bool[3]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bumper {
    /// The code.
    pub raw: [bool; 3],
}

device! {
    Bumper: [bool; 3], plain [bool; 3],
    Facts {
        id: 12,
        name: "Bumper",
        is_sensor: true,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(1000),
    }
}

#[doc = "The sensor Wheels. Its value is shown, its code is int32[2]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels {
    /// The code.
    pub raw: [i32; 2],
}

device! {
    Wheels: [i32; 2], shown [f64; 2],
    Facts {
        id: 13,
        name: "Wheels",
        is_sensor: true,
        scaling: Some(Scaling { scale: 0.25, offset: -90.0, curve: &[] }),
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The sensor Bent. Its value is shown, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bent {
    /// The code.
    pub raw: u16,
}

device! {
    Bent: u16, shown f64,
    Facts {
        id: 14,
        name: "Bent",
        is_sensor: true,
        scaling: Some(Scaling { scale: 1.0, offset: 0.0, curve: &[(80.0, 8.0), (250.0, 3.0)] }),
        unit: None,
        min: None,
        max: None,
        cycle_ms: Some(1000),
    }
}

#[doc = "The sensor Acceleration. Its value is shown in g, its code is int16[3]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acceleration {
    /// The code.
    pub raw: [i16; 3],
}

device! {
    Acceleration: [i16; 3], shown [f64; 3],
    Facts {
        id: 30,
        name: "Acceleration",
        is_sensor: true,
        scaling: Some(Scaling { scale: 6.103515625e-5, offset: 0.0, curve: &[] }),
        unit: Some("g"),
        min: None,
        max: None,
        cycle_ms: Some(10),
    }
}

#[doc = "The sensor Rate. Its value is shown in deg/s, its code is int16[3]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// The code.
    pub raw: [i16; 3],
}

device! {
    Rate: [i16; 3], shown [f64; 3],
    Facts {
        id: 31,
        name: "Rate",
        is_sensor: true,
        scaling: Some(Scaling { scale: 0.007633587786259542, offset: 0.0, curve: &[] }),
        unit: Some("deg/s"),
        min: None,
        max: None,
        cycle_ms: Some(10),
    }
}

#[doc = "The sensor Position. Its value is shown in deg, its code is int32."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// The code.
    pub raw: i32,
}

device! {
    Position: i32, shown f64,
    Facts {
        id: 41,
        name: "Position",
        is_sensor: true,
        scaling: Some(Scaling { scale: 0.2571428571428571, offset: 0.0, curve: &[] }),
        unit: Some("deg"),
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The actuator Escs. Its value is shown in percent, its code is uint16[4]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Escs {
    /// The code.
    pub raw: [u16; 4],
}

device! {
    Escs: [u16; 4], shown [f64; 4],
    Facts {
        id: 20,
        name: "Escs",
        is_sensor: false,
        scaling: Some(Scaling { scale: 1.0, offset: 0.0, curve: &[(1000.0, 0.0), (2000.0, 100.0)] }),
        unit: Some("percent"),
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The actuator Lamps. Its value is shown, its code is bool[3]."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamps {
    /// The code.
    pub raw: [bool; 3],
}

device! {
    Lamps: [bool; 3], plain [bool; 3],
    Facts {
        id: 21,
        name: "Lamps",
        is_sensor: false,
        scaling: None,
        unit: None,
        min: None,
        max: None,
        cycle_ms: None,
    }
}

#[doc = "The actuator Winch. Its value is shown in N, its code is uint16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winch {
    /// The code.
    pub raw: u16,
}

device! {
    Winch: u16, shown f64,
    Facts {
        id: 22,
        name: "Winch",
        is_sensor: false,
        scaling: Some(Scaling { scale: 0.5, offset: 0.0, curve: &[(0.0, -50.0), (1000.0, 0.0), (2000.0, 200.0)] }),
        unit: Some("N"),
        min: Some(-25.0),
        max: Some(100.0),
        cycle_ms: None,
    }
}

#[doc = "The actuator Speed. Its value is shown in %, its code is int16."]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// The code.
    pub raw: i16,
}

device! {
    Speed: i16, shown f64,
    Facts {
        id: 40,
        name: "Speed",
        is_sensor: false,
        scaling: Some(Scaling { scale: 0.01, offset: 0.0, curve: &[] }),
        unit: Some("%"),
        min: Some(-100.0),
        max: Some(100.0),
        cycle_ms: None,
    }
}

messages! {
    /// All messages of a board, of its sensors and its actuators.
    RoverMessage {
        1 => Ranger,
        10 => Line,
        12 => Bumper,
        13 => Wheels,
        14 => Bent,
        30 => Acceleration,
        31 => Rate,
        41 => Position,
        20 => Escs,
        21 => Lamps,
        22 => Winch,
        40 => Speed,
    }
}

/// A board of the design.
#[derive(Clone, Copy, Debug)]
pub struct Rover;

impl Schema for Rover {
    type Message = RoverMessage;
    type Held = [u8; Table::frame_bytes(Self::ITEMS, false, Self::CHECKSUM)];
    const HELD: Self::Held = [0; Table::frame_bytes(Self::ITEMS, false, Self::CHECKSUM)];
    const NAME: &'static str = "Rover";
    const TEXT: &'static str = concat!(
        "checksum none\u{a}",
        "1 sensor Ranger uint16\u{a}",
        "10 sensor Line uint16[8]\u{a}",
        "12 sensor Bumper bool[3]\u{a}",
        "13 sensor Wheels int32[2]\u{a}",
        "14 sensor Bent uint16\u{a}",
        "20 actuator Escs uint16[4]\u{a}",
        "21 actuator Lamps bool[3]\u{a}",
        "22 actuator Winch uint16\u{a}",
        "30 sensor Acceleration int16[3]\u{a}",
        "31 sensor Rate int16[3]\u{a}",
        "40 actuator Speed int16\u{a}",
        "41 sensor Position int32\u{a}",
    );
    const HASH: u32 = 0x0ca56b7c;
    const CHECKSUM: Checksum = Checksum::None;
    const IS_STAMPED: bool = false;
    const BAUD: u32 = 115200;
    const SILENCE_MS: Option<u32> = Some(500);
    const ITEMS: &'static [Item] = &[
        Item { id: 1, name: "Ranger", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 10, name: "Line", is_sensor: true, bytes: 16, is_bool: false },
        Item { id: 12, name: "Bumper", is_sensor: true, bytes: 3, is_bool: true },
        Item { id: 13, name: "Wheels", is_sensor: true, bytes: 8, is_bool: false },
        Item { id: 14, name: "Bent", is_sensor: true, bytes: 2, is_bool: false },
        Item { id: 20, name: "Escs", is_sensor: false, bytes: 8, is_bool: false },
        Item { id: 21, name: "Lamps", is_sensor: false, bytes: 3, is_bool: true },
        Item { id: 22, name: "Winch", is_sensor: false, bytes: 2, is_bool: false },
        Item { id: 30, name: "Acceleration", is_sensor: true, bytes: 6, is_bool: false },
        Item { id: 31, name: "Rate", is_sensor: true, bytes: 6, is_bool: false },
        Item { id: 40, name: "Speed", is_sensor: false, bytes: 2, is_bool: false },
        Item { id: 41, name: "Position", is_sensor: true, bytes: 4, is_bool: false },
    ];
    const SENSORS: &'static Table = &Table::new(Self::ITEMS, true, false);
    const ACTUATORS: &'static Table = &Table::new(Self::ITEMS, false, false);

    #[inline]
    fn read(id: u8, bytes: &[u8]) -> Option<RoverMessage> {
        RoverMessage::read(id, bytes)
    }
}

#[cfg(feature = "std")]
impl Rover {
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
