//! The answer in names: which device is on which pins of which board.

use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{Board, BoardIndex, ConnectionIndex, Design, DeviceIndex};
use sensedsl_model::kind::Role;

/// How good a wiring is known to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Proved: no other wiring is better.
    Optimal,
    /// Valid, but not compared with all others.
    Feasible,
}

impl Status {
    /// The word in the JSON output.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Feasible => "feasible",
        }
    }
}

/// A wiring of all devices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// How good it is known to be.
    pub status: Status,
    /// Wires that differ from the wiring to keep.
    pub moved: u32,
    /// `prefer` and `avoid` rules that are violated.
    pub violated: u32,
    /// Used pins that something else on the board is on.
    pub shared: u32,
    /// Opportunity cost: usages of all pins used, each pin once.
    pub cost: u32,
    /// Proved: no wiring is better than this. If the search was cut off, it is below what was
    /// found. `None` if it was not asked for.
    pub bound: Option<Bound>,
    /// How neat its wires are at the connectors.
    pub neatness: Neatness,
    /// One for each board of the design, in its order.
    pub boards: Vec<BoardAssignment>,
}

/// How neat a wiring is; all 0 if no pin is on a connector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Neatness {
    /// Sides of connectors in use, summed over parts.
    pub sides: u32,
    /// The distance of the first from the last contact in use, summed over these sides.
    pub span: u32,
    /// Proved: no wiring that may cost as much is neater.
    pub is_proved: bool,
    /// The first by name of the cheapest wirings; none if no neater one was looked for.
    pub before: Option<Plain>,
    /// The steps of the search for a neater one.
    pub steps: u64,
}

/// The wiring that would be chosen if neatness did not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plain {
    /// Its sides of connectors.
    pub sides: u32,
    /// Its distances of contacts.
    pub span: u32,
    /// Its opportunity cost.
    pub cost: u32,
}

impl Assignment {
    /// By how much more it costs than the cheapest, to be neater.
    #[must_use]
    pub fn rise(&self) -> u32 {
        self.neatness.before.map_or(0, |plain| self.cost.saturating_sub(plain.cost))
    }
}

/// A bound that no wiring can beat, compared in field order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bound {
    /// Moved wires.
    pub moved: u32,
    /// Violated rules.
    pub violated: u32,
    /// Shared pins.
    pub shared: u32,
    /// Opportunity cost.
    pub cost: u32,
}

/// The wiring of one board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoardAssignment {
    /// The board.
    pub board: BoardIndex,
    /// Its part of the opportunity cost.
    pub cost: u32,
    /// The pins in use that something else is on, ascending.
    pub shared: Vec<SharedPin>,
    /// Its connections, in the order of the design.
    pub connections: Vec<ConnectionWiring>,
    /// Its devices, in file order, each with all wires that its value goes over.
    pub devices: Vec<DeviceWiring>,
    /// The wires of a serial link.
    pub link: Option<LinkWiring>,
    /// The DMA streams of the peripherals in use, by unit and request.
    pub dma: Vec<DmaAssignment>,
}

impl BoardAssignment {
    /// A board that nothing is wired to.
    #[must_use]
    pub const fn empty(board: BoardIndex) -> Self {
        Self {
            board,
            cost: 0,
            shared: Vec::new(),
            connections: Vec::new(),
            devices: Vec::new(),
            link: None,
            dma: Vec::new(),
        }
    }

    /// The wiring of one connection, if it is on this board.
    #[must_use]
    pub fn connection(&self, index: ConnectionIndex) -> Option<&ConnectionWiring> {
        let at = self.connections.binary_search_by_key(&index, |one| one.connection).ok()?;
        self.connections.get(at)
    }

    /// The peripheral instance that serves a wire; `None` for a bare GPIO.
    #[must_use]
    pub fn unit_of(&self, wire: &Wire) -> Option<&str> {
        self.connection(wire.connection?)?.unit.as_deref()
    }

    /// The other thing that is on the pin of a wire, if any.
    #[must_use]
    pub fn shared_with(&self, wire: &Wire) -> Option<&str> {
        let shared = self.shared.iter().find(|shared| shared.pin == wire.pin)?;
        Some(&shared.with)
    }
}

/// A pin in use that something else on the board is on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedPin {
    /// Index into the pins of the board's table.
    pub pin: usize,
    /// The other thing that is on it: `LED LD2`.
    pub with: String,
}

/// The wires of one connection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConnectionWiring {
    /// The connection.
    pub connection: ConnectionIndex,
    /// The peripheral instance (`ADC1`, `I2C3`, `TIM3`); `None` for a bare GPIO.
    pub unit: Option<String>,
    /// Its wires, in the order of the roles.
    pub wires: Vec<Wire>,
}

/// The wires of one device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceWiring {
    /// The device.
    pub device: DeviceIndex,
    /// The peripheral instance of its first connection.
    pub unit: Option<String>,
    /// Its wires, connection by connection, in the order of the roles. A chip's first device also
    /// has the wires that no value needs.
    pub wires: Vec<Wire>,
}

/// The wires of a serial link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkWiring {
    /// The serial port.
    pub unit: String,
    /// TX and RX.
    pub wires: Vec<Wire>,
}

/// One wire: a role on a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wire {
    /// The connection to which it belongs; `None` for a wire of a link.
    pub connection: Option<ConnectionIndex>,
    /// The role of the wire in the connection.
    pub role: Role,
    /// Index into the pins of the board's table.
    pub pin: usize,
    /// Index into the usages of that pin; `None` for a plain GPIO.
    pub usage: Option<usize>,
    /// Index into the places of that pin: the contact that is nearest to the part's other wires.
    /// `None` if the pin is on no connector.
    pub place: Option<usize>,
}

impl Wire {
    /// Its name among the wires of its device: `in`, `in[3]`, `pwm`.
    #[must_use]
    pub fn name(&self, design: &Design) -> String {
        let connection = self.connection.and_then(|index| design.connection(index));
        connection.map_or_else(|| self.role.name().to_owned(), |one| one.wire_name(self.role))
    }

    /// The pin in the board's table.
    #[must_use]
    pub fn pin<'a>(&self, board: &'a Board) -> Option<&'a Pin> {
        board.table.pins.get(self.pin)
    }

    /// The usage in the board's table.
    #[must_use]
    pub fn usage<'a>(&self, board: &'a Board) -> Option<&'a Usage> {
        self.pin(board)?.usages.get(self.usage?)
    }

    /// The signal as the table spells it; `GPIO` for a plain one.
    #[must_use]
    pub fn signal<'a>(&self, board: &'a Board) -> &'a str {
        self.usage(board).map_or("GPIO", |usage| usage.spelled.as_str())
    }
}

/// A DMA stream given to a peripheral.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct DmaAssignment {
    /// The peripheral instance.
    pub unit: String,
    /// The request, as the target profile names it (`I2C1_RX`).
    pub request: String,
    /// The stream, as the target profile spells it (`1,0`).
    pub stream: String,
}

impl Assignment {
    /// All wires of all connections, by which wirings are told apart.
    pub(crate) fn wires(&self) -> Vec<(BoardIndex, Vec<Wire>)> {
        let of = |board: &BoardAssignment| {
            let wires = board.connections.iter().flat_map(|one| &one.wires);
            (board.board, wires.copied().collect())
        };
        self.boards.iter().map(of).collect()
    }

    /// The wiring of one device and its board.
    #[must_use]
    pub fn device(&self, index: DeviceIndex) -> Option<(BoardIndex, &DeviceWiring)> {
        self.boards.iter().find_map(|board| {
            let wiring = board.devices.iter().find(|wiring| wiring.device == index)?;
            Some((board.board, wiring))
        })
    }

    /// The wiring of one connection and its board.
    #[must_use]
    pub fn connection(&self, index: ConnectionIndex) -> Option<(BoardIndex, &ConnectionWiring)> {
        self.boards.iter().find_map(|board| Some((board.board, board.connection(index)?)))
    }

    /// The boards that carry a device, each with its board in the design.
    pub fn used<'a>(
        &'a self,
        design: &'a Design,
    ) -> impl Iterator<Item = (&'a BoardAssignment, &'a Board)> {
        let used = self.boards.iter().filter(|board| !board.devices.is_empty());
        used.filter_map(|board| Some((board, design.board(board.board)?)))
    }
}
