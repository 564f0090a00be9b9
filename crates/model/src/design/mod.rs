//! The checked design: what to connect to which boards, with names bound, defaults filled in and
//! units converted. How it is wired is the job of crate `wiring`.

mod bounds;
mod controller;
mod fault;
mod index;
mod module;
mod pace;
mod pin_ref;
mod placement;
mod presentation;
pub mod protocol;
mod test;

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{Target, TargetProfile};
use sensedsl_board::silicon::{self, Silicon};
use sensedsl_board::table::Table;
use sensedsl_diagnostics::{Code, FileId, Span};
use sensedsl_wire::{Checksum, Direction, Item, Schema, ValueType};

use crate::kind::{Kind, Role};
pub use crate::spanned::Spanned;
use crate::value::written::{shown_mv, shown_ohm};
use protocol::{Coding, Filter, Protocol};

pub use bounds::Bounds;
pub use controller::Controller;
pub use fault::FaultKind;
pub use index::{BoardIndex, ConnectionIndex, DeviceIndex, PartIndex};
pub use module::Module;
pub use pin_ref::PinRef;
pub use placement::{Placement, Preference, PreferenceSubject, Together};
pub use presentation::{Bare, Presentation};
pub use test::{Setting, SignalOf, Test, TestFault, TestRule, TestSignal, TestUnit, rounded};

/// All boards and devices of a file and the files it uses.
#[derive(Clone, Debug)]
pub struct Design {
    /// The file that was requested.
    pub file: FileId,
    /// The boards in file order; at least one.
    pub boards: Vec<Board>,
    /// What is bought and mounted as one thing, in file order: a device, or a chip with all its
    /// devices.
    pub parts: Vec<Part>,
    /// Everything with an identifier and a value, in file order; the devices of one part are
    /// consecutive.
    pub devices: Vec<Device>,
    /// The sets of wires to be found, in the order of their parts.
    pub connections: Vec<Connection>,
    /// The code of the user's that runs on the boards, in file order.
    pub controllers: Vec<Controller>,
    /// What must hold in runs, in file order.
    pub tests: Vec<Test>,
}

/// A board of the file.
#[derive(Clone, Debug)]
pub struct Board {
    /// Its name in the file.
    pub name: Spanned<String>,
    /// True if it is used only when the devices need it.
    pub spare: bool,
    /// Its pins.
    pub table: Table,
    /// The text of the table, for places in it.
    pub table_file: FileId,
    /// The facts besides the pins, from this built-in board or from one with the same MCU.
    pub facts: Option<catalog::Board>,
    /// True if the pins are a built-in board's own.
    pub built_in: bool,
    /// The MCU, if known.
    pub mcu: Option<String>,
    /// What firmware can do on the board.
    pub target: Target,
    /// How the board talks to the host.
    pub link: Link,
    /// Pins and peripherals that must stay free.
    pub reserved: Vec<Spanned<String>>,
    /// On-board pins and parts that may be used.
    pub released: Vec<Spanned<String>>,
    /// Soft rules for every device on the board.
    pub wishes: Vec<Preference>,
    /// Warnings that are not given for anything on this board.
    pub allows: Vec<Allow>,
}

impl Board {
    /// What the operating system's drivers can do, if there is a system.
    #[must_use]
    pub fn profile(&self) -> Option<&TargetProfile> {
        match &self.target {
            Target::None => None,
            Target::Profile(profile) => Some(profile),
        }
    }

    /// What the MCU's peripherals can do, where that differs from most MCUs.
    #[must_use]
    pub fn silicon(&self) -> Option<&'static Silicon> {
        self.mcu.as_deref().and_then(silicon::of)
    }

    /// Whether a name in a file means that peripheral instance of the board's MCU.
    #[must_use]
    pub fn same_unit(&self, written: &str, unit: &str) -> bool {
        written == unit || self.silicon().is_some_and(|silicon| silicon.same_unit(written, unit))
    }

    /// The span of a range of the board's table.
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
    /// TX and RX of `transport = uart` where they are wired on the board; empty where any pins will
    /// do.
    pub pins: Vec<PinName>,
    /// Bits per second of `transport = uart`.
    pub baud: u32,
    /// Where the rate is given.
    pub baud_span: Option<Span>,
    /// Whether frames end with a checksum.
    pub checksum: Checksum,
    /// Whether each report begins with the board's time stamp and a counter.
    pub stamp: bool,
    /// How long no frame may come from the host before actuators take their failsafe values; none
    /// for no limit.
    pub silence_ms: Option<u32>,
    /// Where that time is given.
    pub silence_span: Option<Span>,
    /// Most frames per second; none to send each frame when it is due.
    pub rate_hz: Option<u32>,
    /// Whether the USB device detects a host by its VBUS pin.
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
    /// A UART, usually one to a debugger's virtual COM port.
    Uart,
    /// No link, so no pin and no peripheral is taken.
    None,
}

impl Transport {
    /// The word in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Usb => "usb",
            Self::Uart => "uart",
            Self::None => "none",
        }
    }
}

/// A thing on a board: a device on its own, or a chip.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name of the device, or of the chip.
    pub name: Spanned<String>,
    /// The whole block.
    pub block: Span,
    /// The board it is bound to; none if it may go to any.
    pub board: Option<BoardIndex>,
    /// The driver that its protocol comes from.
    pub driver: Option<String>,
    /// Warnings that are not given for it.
    pub allows: Vec<Allow>,
    /// How it is started and identified; none if it is not a chip.
    pub chip: Option<Protocol>,
    /// The limits from its data sheet.
    pub bounds: Bounds,
    /// What it is for the people who wire it; none without a driver.
    pub module: Option<Module>,
}

/// A sensor or an actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// The part that it is, or whose value it is.
    pub part: PartIndex,
    /// The name of the device.
    pub name: Spanned<String>,
    /// The whole block.
    pub block: Span,
    /// Its identifier, 1 to 254, unique in the design.
    pub id: Spanned<u8>,
    /// The direction: sensor or actuator.
    pub direction: Direction,
    /// The type of its value.
    pub value: Spanned<ValueType>,
    /// The kind of its connection, with the properties of that kind.
    pub kind: Kind,
    /// Where `type` is given.
    pub kind_span: Span,
    /// The cycle time.
    pub delay_ms: u32,
    /// Where the cycle time is given; none for the default.
    pub delay_span: Option<Span>,
    /// Thread priority relative to `NORMALPRIO`.
    pub prio: i8,
    /// Where the device itself gives the priority.
    pub prio_span: Option<Span>,
    /// The group of devices that it never measures at the same time as.
    pub group: Option<Group>,
    /// How a host shows the value.
    pub shown: Presentation,
    /// How the value is coded in the bytes that the part sends or receives.
    pub coding: Coding,
    /// How the value is filtered on the board before it is reported.
    pub filter: Filter,
    /// The wires that carry its value; the first are those of `kind`.
    pub connections: Vec<ConnectionIndex>,
}

/// Wires that belong together: those of a device, of one element of an array, or of one connection
/// of a chip. One peripheral instance serves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// The part that they belong to.
    pub part: PartIndex,
    /// The name of a chip's connection, which distinguishes them from the part's other wires.
    pub name: Option<String>,
    /// The index, from 0, of the array element that they carry.
    pub element: Option<u16>,
    /// The first device whose value they carry; if no value needs them, the part's first device.
    pub device: DeviceIndex,
    /// Their kind, with the properties of that kind.
    pub kind: Kind,
    /// The direction of the value.
    pub direction: Direction,
    /// The board the part is bound to; none if it may go to any.
    pub board: Option<BoardIndex>,
    /// What the user fixed about them.
    pub placement: Placement,
    /// Soft rules for them.
    pub wishes: Vec<Preference>,
    /// The voltage on them, if it is stated.
    pub level: Option<Level>,
}

/// The voltage that a device puts on its wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// The voltage at the device, in millivolts; for an analog device the highest that occurs.
    pub mv: u32,
    /// The resistors of a divider, in ohms: from the device to the pin, and from the pin to ground.
    pub divider: Option<[u32; 2]>,
    /// Where it is stated.
    pub span: Span,
}

impl Level {
    /// Formats it for people: `12.6 V, 33 kOhm to the pin, 10 kOhm to ground: 2.931 V`; none
    /// without resistors.
    #[must_use]
    pub fn divided(&self) -> Option<String> {
        let [upper, lower] = self.divider?.map(shown_ohm);
        let (level, left) = (shown_mv(self.mv), shown_mv(self.at_pin_mv()));
        Some(format!("{level}, {upper} to the pin, {lower} to ground: {left}"))
    }

    /// The voltage at the pin, in millivolts, rounded up.
    #[must_use]
    pub fn at_pin_mv(&self) -> u32 {
        let Some([upper, lower]) = self.divider.map(|divider| divider.map(u64::from)) else {
            return self.mv;
        };
        let divided = (u64::from(self.mv) * lower).div_ceil((upper + lower).max(1));
        u32::try_from(divided).unwrap_or(self.mv)
    }
}

/// A group of devices that never measure at the same time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The name of the group.
    pub name: String,
    /// Where the group is named.
    pub span: Span,
    /// True if the device itself names the group, not its driver.
    pub own: bool,
}

/// A warning that is accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allow {
    /// The code of the warning.
    pub code: Code,
    /// The user's reason.
    pub reason: String,
    /// Where the warning is allowed.
    pub span: Span,
    /// The block that contains the rule, which is what the rule applies to.
    pub scope: Span,
}

impl Connection {
    /// The name of one of the wires, as distinct from the others of its device: `in`, `in[3]`,
    /// `pwm`, `encoder.a`.
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

    /// The device at `index`.
    #[must_use]
    pub fn device(&self, index: DeviceIndex) -> Option<&Device> {
        self.devices.get(index.0)
    }

    /// The controller that sets a device; none if the host does, or hardware.
    #[must_use]
    pub fn owner(&self, device: DeviceIndex) -> Option<&Controller> {
        self.controllers.iter().find(|one| one.sets(device))
    }

    /// The part at `index`.
    #[must_use]
    pub fn part(&self, index: PartIndex) -> Option<&Part> {
        self.parts.get(index.0)
    }

    /// The name of a part; empty if there is none at `index`.
    #[must_use]
    pub fn part_name(&self, index: PartIndex) -> &str {
        self.part(index).map_or("", |part| part.name.value.as_str())
    }

    /// The connection at `index`.
    #[must_use]
    pub fn connection(&self, index: ConnectionIndex) -> Option<&Connection> {
        self.connections.get(index.0)
    }

    /// The wires that a device's own properties apply to.
    #[must_use]
    pub fn main_connection(&self, device: &Device) -> Option<&Connection> {
        self.connection(*device.connections.first()?)
    }

    /// The name of a connection: `Line[3]`, `Left.pwm`, or that of its part.
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

    /// The index range of a part's connections, which are consecutive.
    fn range_of(&self, part: PartIndex) -> std::ops::Range<usize> {
        let first = self.connections.partition_point(|one| one.part < part);
        first..self.connections.partition_point(|one| one.part <= part)
    }

    /// The connections of a part.
    pub fn connections_of(&self, part: PartIndex) -> impl Iterator<Item = &Connection> {
        self.connections.get(self.range_of(part)).into_iter().flatten()
    }

    /// The connections of a part, mutably.
    pub fn connections_of_mut(&mut self, part: PartIndex) -> impl Iterator<Item = &mut Connection> {
        let range = self.range_of(part);
        self.connections.get_mut(range).into_iter().flatten()
    }

    /// Keeps only the parts for which the function holds, with their devices and connections.
    /// Renumbers what is left and returns the parts' old numbers in order.
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
            new_devices.push(part.map(|_| DeviceIndex(next)));
            next += usize::from(part.is_some());
            let renumbered = |old: &ConnectionIndex| new_connections.get(old.0).copied().flatten();
            one.connections = one.connections.iter().filter_map(renumbered).collect();
            part.map(|part| one.part = part).is_some()
        });
        let new_device = |old: DeviceIndex| new_devices.get(old.0).copied().flatten();
        self.controllers.retain_mut(|one| one.renumber(&new_device));
        self.tests.retain_mut(|one| one.renumber(&new_device));
        for connection in &mut self.connections {
            connection.device = new_device(connection.device).unwrap_or(connection.device);
        }
        let mut number = 0;
        self.parts.retain(|_| {
            number += 1;
            kept.binary_search(&PartIndex(number - 1)).is_ok()
        });
        kept
    }

    /// The schema of one board's link that carries `devices` (in file order).
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
