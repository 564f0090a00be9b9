//! The checked design: what is to be connected to which boards, with names bound, defaults filled
//! in and units converted. Nothing here says how it is wired; that is crate `wiring`.

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{Target, TargetProfile};
use sensedsl_board::silicon::{self, Silicon};
use sensedsl_board::table::Table;
use sensedsl_diagnostics::{Code, FileId, Span};
use sensedsl_wire::{Checksum, Direction, Item, Schema, ValueType};

use crate::bounds::Bounds;
pub use crate::fields::Bare;
use crate::kind::{Kind, Role};
use crate::protocol::{Coding, Filter, Protocol};
use crate::volts::{shown_mv, shown_ohm};

mod placement;

pub use placement::{Placement, Together, Wish, WishFor};

/// Index into [`Design::boards`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoardIndex(pub usize);

/// Index into [`Design::devices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DeviceIndex(pub usize);

/// Index into [`Design::parts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PartIndex(pub usize);

/// Index into [`Design::connections`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConnectionIndex(pub usize);

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
    /// What is bought and put on a board as one thing, in file order: a device, or a chip with all
    /// its devices.
    pub parts: Vec<Part>,
    /// What has an identifier and a value, in file order; those of one part one after the other.
    pub devices: Vec<Device>,
    /// The wires that are to be found, a set each, in the order of their parts.
    pub connections: Vec<Connection>,
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
    /// Whether each report begins with the board's time and a counter.
    pub stamp: bool,
    /// After how long without a frame from the host actuators take what is safe; none for never.
    pub silence_ms: Option<u32>,
    /// Where that is given.
    pub silence_span: Option<Span>,
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

/// One thing on a board: a device by itself, or a chip.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name of the device, or of the chip.
    pub name: Spanned<String>,
    /// The whole block.
    pub block: Span,
    /// The board it is bound to; none where it may go to any.
    pub board: Option<BoardIndex>,
    /// The driver its protocol was taken from.
    pub driver: Option<String>,
    /// Warnings that are not given for it.
    pub allows: Vec<Allow>,
    /// How it is started and identified, where it is a chip.
    pub chip: Option<Protocol>,
    /// What its document bounds.
    pub bounds: Bounds,
}

/// A sensor or an actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// The part that it is, or is a value of.
    pub part: PartIndex,
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
    /// How a host shows the value.
    pub shown: Presentation,
    /// How the value is coded in what the part sends or is sent.
    pub coding: Coding,
    /// What becomes of it on the board before it is reported.
    pub filter: Filter,
    /// The wires that its value goes over, the first of them those of `kind`.
    pub connections: Vec<ConnectionIndex>,
}

/// Wires that belong together: those of a device, of one element of an array, of one connection of a
/// chip. One peripheral instance serves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// The part that they are of.
    pub part: PartIndex,
    /// What tells them from other wires of the part: the name of a chip's connection.
    pub name: Option<String>,
    /// Which element of the array they carry, from 0.
    pub element: Option<u16>,
    /// The first device whose value goes over them; of wires that no value needs the part's first.
    pub device: DeviceIndex,
    /// What they are, with the properties of that kind.
    pub kind: Kind,
    /// Which way the value goes.
    pub direction: Direction,
    /// The board the part is bound to; none where it may go to any.
    pub board: Option<BoardIndex>,
    /// What the user fixed of them.
    pub placement: Placement,
    /// Soft rules.
    pub wishes: Vec<Wish>,
    /// The voltage on them, where it is stated.
    pub level: Option<Level>,
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
    /// Where these two are stated.
    pub bounds: [Option<Span>; 2],
    /// Points between which `scale * raw + offset` is interpolated; empty for none.
    pub curve: Vec<(f64, f64)>,
    /// A bare number that was given as a shown value, where it is another code.
    pub bare: Option<Bare>,
}

impl Connection {
    /// What one of the wires is called beside the others of its device: `in`, `in[3]`, `pwm`,
    /// `encoder.a`.
    #[must_use]
    pub fn wire_name(&self, role: Role) -> String {
        let mut name = match &self.name {
            None => role.name().to_owned(),
            Some(own) if self.kind.roles(self.direction).len() == 1 => own.clone(),
            Some(own) => format!("{own}.{role}"),
        };
        if let Some(element) = self.element {
            name.push_str(&format!("[{element}]"));
        }
        name
    }
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

    /// The part at `index`.
    #[must_use]
    pub fn part(&self, index: PartIndex) -> Option<&Part> {
        self.parts.get(index.0)
    }

    /// The name of a part; empty where there is none at `index`.
    #[must_use]
    pub fn part_name(&self, index: PartIndex) -> &str {
        self.part(index).map_or("", |part| part.name.value.as_str())
    }

    /// The connection at `index`.
    #[must_use]
    pub fn connection(&self, index: ConnectionIndex) -> Option<&Connection> {
        self.connections.get(index.0)
    }

    /// The wires that a device's own properties are of.
    #[must_use]
    pub fn main_connection(&self, device: &Device) -> Option<&Connection> {
        self.connection(*device.connections.first()?)
    }

    /// What a connection is called: `Line[3]`, `Left.pwm`, or as its part.
    #[must_use]
    pub fn connection_name(&self, connection: &Connection) -> String {
        let mut name = self.part_name(connection.part).to_owned();
        if let Some(own) = &connection.name {
            name.push('.');
            name.push_str(own);
        }
        if let Some(element) = connection.element {
            name.push_str(&format!("[{element}]"));
        }
        name
    }

    /// Where the connections of a part are, which stand one after the other.
    fn range_of(&self, part: PartIndex) -> std::ops::Range<usize> {
        let first = self.connections.partition_point(|one| one.part < part);
        first..self.connections.partition_point(|one| one.part <= part)
    }

    /// The connections of a part.
    pub fn connections_of(&self, part: PartIndex) -> impl Iterator<Item = &Connection> {
        self.connections.get(self.range_of(part)).into_iter().flatten()
    }

    /// The connections of a part, to be changed.
    pub fn connections_of_mut(&mut self, part: PartIndex) -> impl Iterator<Item = &mut Connection> {
        let range = self.range_of(part);
        self.connections.get_mut(range).into_iter().flatten()
    }

    /// Leaves out all parts but those for which the function holds, with their devices and
    /// connections. What is left is numbered anew; the parts' old numbers come back in order.
    pub fn retain_parts(&mut self, holds: impl Fn(PartIndex, &Part) -> bool) -> Vec<PartIndex> {
        let kept: Vec<PartIndex> = (0..)
            .map(PartIndex)
            .zip(&self.parts)
            .filter(|(index, part)| holds(*index, part))
            .map(|(index, _)| index)
            .collect();
        let new_part = |old: PartIndex| kept.binary_search(&old).ok().map(PartIndex);
        let mut new_connections = Vec::with_capacity(self.connections.len());
        let mut next = 0;
        self.connections.retain_mut(|one| {
            let part = new_part(one.part);
            new_connections.push(part.map(|_| ConnectionIndex(next)));
            next += usize::from(part.is_some());
            part.map(|part| one.part = part).is_some()
        });
        let mut new_devices = Vec::with_capacity(self.devices.len());
        let mut next = 0;
        self.devices.retain_mut(|one| {
            let part = new_part(one.part);
            new_devices.push(DeviceIndex(next));
            next += usize::from(part.is_some());
            let renumbered = |old: &ConnectionIndex| new_connections.get(old.0).copied().flatten();
            one.connections = one.connections.iter().filter_map(renumbered).collect();
            part.map(|part| one.part = part).is_some()
        });
        for connection in &mut self.connections {
            let new = new_devices.get(connection.device.0);
            connection.device = new.copied().unwrap_or(connection.device);
        }
        let mut number = 0;
        self.parts.retain(|_| {
            number += 1;
            kept.binary_search(&PartIndex(number - 1)).is_ok()
        });
        kept
    }

    /// The wire of one board that carries `devices` (in file order).
    #[must_use]
    pub fn schema(&self, board: BoardIndex, devices: &[DeviceIndex]) -> Schema {
        let link = self.board(board).map(|board| &board.link);
        let checksum = link.map_or(Checksum::None, |link| link.checksum);
        let stamp = link.is_some_and(|link| link.stamp);
        let items = devices.iter().filter_map(|&index| self.device(index));
        let items = items.map(|device| Item {
            id: device.id.value,
            name: device.name.value.clone(),
            direction: device.direction,
            value: device.value.value,
        });
        Schema { checksum, stamp, items: items.collect() }
    }
}
