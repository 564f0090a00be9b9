//! The checked design: what is to be connected to which boards, with names bound, defaults filled
//! in and units converted. Nothing here says how it is wired; that is crate `wiring`.

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{Target, TargetProfile};
use sensedsl_board::silicon::{self, Silicon};
use sensedsl_board::table::Table;
use sensedsl_diagnostics::{Code, FileId, Span};
use sensedsl_wire::{Checksum, Direction, Item, Schema, ValueType};

use crate::kind::{Kind, Role};
use crate::pins::PinRef;
use crate::volts::{shown_mv, shown_ohm};

/// Index into [`Design::boards`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoardIndex(pub usize);

/// Index into [`Design::devices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DeviceIndex(pub usize);

/// A value and where it was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

/// All boards and devices of a file and the files it uses.
#[derive(Clone, Debug)]
pub struct Design {
    /// The file that was asked for.
    pub file: FileId,
    /// In file order; at least one.
    pub boards: Vec<Board>,
    /// In file order, those of boards and those outside any board alike.
    pub devices: Vec<Device>,
}

/// A board of the file.
#[derive(Clone, Debug)]
pub struct Board {
    /// Its name in the file.
    pub name: Spanned<String>,
    /// Used only if the devices need it.
    pub spare: bool,
    /// Its pins.
    pub table: Table,
    /// The table's text, for places in it.
    pub table_file: FileId,
    /// The facts beside the pins: of the built-in board, or of one with the same MCU.
    pub facts: Option<catalog::Board>,
    /// True when the pins are a built-in board's own.
    pub built_in: bool,
    /// The MCU, where it is known.
    pub mcu: Option<String>,
    /// What firmware can do on it.
    pub target: Target,
    /// How it talks to the host.
    pub link: Link,
    /// Pins and peripherals that stay free.
    pub reserved: Vec<Spanned<String>>,
    /// On-board pins and parts that may be used.
    pub released: Vec<Spanned<String>>,
    /// Soft rules for every device on the board.
    pub wishes: Vec<Wish>,
    /// Warnings that are not given for anything on the board.
    pub allows: Vec<Allow>,
}

impl Board {
    /// What the operating system's drivers can do, when there is one.
    #[must_use]
    pub fn profile(&self) -> Option<&TargetProfile> {
        match &self.target {
            Target::None => None,
            Target::Profile(profile) => Some(profile),
        }
    }

    /// What the MCU's peripherals can do, where it differs from what most can.
    #[must_use]
    pub fn silicon(&self) -> Option<&'static Silicon> {
        self.mcu.as_deref().and_then(silicon::of)
    }

    /// Whether a name in a file means that peripheral instance of the board's MCU.
    #[must_use]
    pub fn same_unit(&self, written: &str, unit: &str) -> bool {
        written == unit || self.silicon().is_some_and(|silicon| silicon.same_unit(written, unit))
    }

    /// The place of a range of its table.
    #[must_use]
    pub fn table_span(&self, range: std::ops::Range<usize>) -> Span {
        Span::new(self.table_file, range)
    }
}

/// How a board talks to its host.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Link {
    /// The medium.
    pub transport: Transport,
    /// The UART of `transport = uart`.
    pub unit: Option<Spanned<String>>,
    /// TX and RX of `transport = uart` where the board has wired them; empty where any will do.
    pub pins: Vec<PinName>,
    /// Bits per second of `transport = uart`.
    pub baud: u32,
    /// Where they are given.
    pub baud_span: Option<Span>,
    /// Whether frames end with a checksum.
    pub checksum: Checksum,
    /// At most that many frames per second; none for as many as become due.
    pub rate_hz: Option<u32>,
    /// Whether the USB device is told by its VBUS pin that a host is there.
    pub vbus: bool,
    /// Whether the file states the medium.
    pub stated: bool,
}

/// The medium of a link.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transport {
    /// USB CDC: `/dev/ttyACM0` on Linux.
    #[default]
    Usb,
    /// A UART, mostly to a debugger's virtual COM port.
    Uart,
    /// None: no pin and no peripheral is taken.
    None,
}

impl Transport {
    /// The word of the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Usb => "usb",
            Self::Uart => "uart",
            Self::None => "none",
        }
    }
}

/// A sensor or an actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Its name.
    pub name: Spanned<String>,
    /// The whole block.
    pub block: Span,
    /// 1 to 254, unique in the design.
    pub id: Spanned<u8>,
    /// Sensor or actuator.
    pub direction: Direction,
    /// What it carries.
    pub value: Spanned<ValueType>,
    /// What it is connected to, with the properties of that kind.
    pub kind: Kind,
    /// Where `type` is given.
    pub kind_span: Span,
    /// Cycle time.
    pub delay_ms: u32,
    /// Where the cycle time is given; none for the default.
    pub delay_span: Option<Span>,
    /// Thread priority relative to `NORMALPRIO`.
    pub prio: i8,
    /// Where the device itself gives the priority.
    pub prio_span: Option<Span>,
    /// The devices that it never measures together with.
    pub group: Option<Group>,
    /// The board it is bound to; none where it may go to any.
    pub board: Option<BoardIndex>,
    /// What the user fixed of its wiring.
    pub placement: Placement,
    /// Soft rules.
    pub wishes: Vec<Wish>,
    /// How a host shows the value.
    pub shown: Presentation,
    /// The voltage on its wires, where it is stated.
    pub level: Option<Level>,
    /// The driver its protocol was taken from.
    pub driver: Option<String>,
    /// Warnings that are not given for this device.
    pub allows: Vec<Allow>,
}

/// The voltage that a device puts on its wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// At the device, in millivolts; of an analog device the highest there is.
    pub mv: u32,
    /// The resistors that divide it, in ohms: from the device to the pin, and from there to ground.
    pub divider: Option<[u32; 2]>,
    /// Where it is stated.
    pub span: Span,
}

impl Level {
    /// For people: `12.6 V, 33 kOhm to the pin, 10 kOhm to ground: 2.931 V`; none without resistors.
    #[must_use]
    pub fn divided(&self) -> Option<String> {
        let [upper, lower] = self.divider?.map(shown_ohm);
        let (level, left) = (shown_mv(self.mv), shown_mv(self.at_pin_mv()));
        Some(format!("{level}, {upper} to the pin, {lower} to ground: {left}"))
    }

    /// What arrives at the pin, in millivolts, rounded up.
    #[must_use]
    pub fn at_pin_mv(&self) -> u32 {
        let Some([upper, lower]) = self.divider.map(|divider| divider.map(u64::from)) else {
            return self.mv;
        };
        let divided = (u64::from(self.mv) * lower).div_ceil((upper + lower).max(1));
        u32::try_from(divided).unwrap_or(self.mv)
    }
}

/// Devices of one group never measure at the same time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// The device names it itself, not its driver.
    pub own: bool,
}

/// What the user fixed of a device's wiring.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// Fixed pins by role.
    pub pins: Vec<(Role, Spanned<PinRef>)>,
    /// Fixed peripheral instance, upper case (`ADC1`).
    pub unit: Option<Spanned<String>>,
    /// Only pins on that side.
    pub side: Option<Spanned<String>>,
    /// Only pins on that header.
    pub header: Option<Spanned<String>>,
}

/// A soft rule: `prefer` or `avoid`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wish {
    /// True for `prefer`, false for `avoid`.
    pub prefer: bool,
    /// Of what.
    pub what: WishFor,
    /// Where the rule stands.
    pub span: Span,
}

/// What a soft rule speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WishFor {
    /// A pin, of one role or of any.
    Pin(Option<Role>, PinRef),
    /// A peripheral instance.
    Unit(String),
    /// A side of the board.
    Side(String),
    /// A header of the board.
    Header(String),
}

/// A warning that is accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allow {
    /// Which one.
    pub code: Code,
    /// Why.
    pub reason: String,
    /// Where it says so.
    pub span: Span,
    /// The block it stands in: what it is about.
    pub scope: Span,
}

/// How a host shows a value: `scale * raw + offset`, in `quantity`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Presentation {
    /// Text for people.
    pub label: Option<String>,
    /// Unit name (`cm`, `V`).
    pub quantity: Option<String>,
    /// Factor; none for 1.
    pub scale: Option<f64>,
    /// Added after scaling; none for 0.
    pub offset: Option<f64>,
    /// Least value to expect, scaled.
    pub min: Option<f64>,
    /// Greatest value to expect, scaled.
    pub max: Option<f64>,
}

impl Design {
    /// The board at `index`.
    #[must_use]
    pub fn board(&self, index: BoardIndex) -> Option<&Board> {
        self.boards.get(index.0)
    }

    /// How long a measurement of the device lasts once it has begun, in microseconds.
    #[must_use]
    pub fn measuring_us(device: &Device) -> u32 {
        device.kind.measuring_us()
    }

    /// The device at `index`.
    #[must_use]
    pub fn device(&self, index: DeviceIndex) -> Option<&Device> {
        self.devices.get(index.0)
    }

    /// The wire of one board that carries `devices` (in file order).
    #[must_use]
    pub fn schema(&self, board: BoardIndex, devices: &[DeviceIndex]) -> Schema {
        let checksum = self.board(board).map_or(Checksum::None, |board| board.link.checksum);
        let items = devices.iter().filter_map(|&index| self.device(index));
        let items = items.map(|device| Item {
            id: device.id.value,
            name: device.name.value.clone(),
            direction: device.direction,
            value: device.value.value,
        });
        Schema { checksum, items: items.collect() }
    }
}
