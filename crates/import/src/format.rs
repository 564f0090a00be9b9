//! The formats that can be imported.

/// A format that can be imported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// A table as text, wide or long.
    Csv,
    /// A workbook of Excel and others.
    Xlsx,
    /// A workbook of `LibreOffice` and others.
    Ods,
    /// The description of an MCU in a CubeMX installation.
    CubeMx,
    /// A project of CubeMX.
    Ioc,
    /// A board of `ArduPilot`.
    Hwdef,
    /// The alternate functions of `MicroPython`'s ports, or the pins of one of its boards.
    MicroPython,
    /// A flight controller of Betaflight, as a dump or as its header.
    Betaflight,
    /// A device tree of Zephyr: a board, or an overlay.
    Zephyr,
    /// A file of a variant of an Arduino core.
    Arduino,
    /// The messages of a CAN bus.
    Dbc,
}
