//! Typed views over the tree: the contents of a file, without trivia and punctuation.
//!
//! A view is a cheap handle. If the text is incomplete, the accessors return `None` or leave the
//! broken part out; callers that need everything first check the parse for errors.

mod node;
mod parts;
mod rules;
mod steps;
mod values;

pub use node::AstNode;
pub use parts::{Chip, ChipItem, Command, Connection, Driver, DriverItem, Reading};
pub use rules::{Allow, Avoid, Prefer, Release, Reserve, Rule};
pub use steps::{
    AlwaysRule, Call, Clause, Compare, Comparison, Condition, Controller, EventuallyRule,
    FaultStep, Index, Inside, Logic, Member, NeverRule, Not, Operation, SetStep, Step, Test,
    WhenRule,
};
pub use values::{
    Binary, List, Magnitude, Name, NameValue, Number, Operator, Paren, Property, Range, Sign,
    Signed, StringLiteral, StringValue, Value,
};

use crate::kind::{SyntaxKind, SyntaxNode, SyntaxToken};
use crate::literal;
use node::{children, choice, nodes, token};
use rowan::TextRange;
use values::{name, names, string};

/// Gives views the name that stands in their head.
macro_rules! named {
    ($($view:ident),+) => { $(
        impl $view {
            /// The name.
            #[must_use]
            pub fn name(&self) -> Option<Name> {
                name(self.syntax())
            }
        }
    )+ };
}

/// Gives views the data type that stands in their head.
macro_rules! typed {
    ($($view:ident),+) => { $(
        impl $view {
            /// The data type.
            #[must_use]
            pub fn ty(&self) -> Option<Type> {
                children(self.syntax()).next()
            }
        }
    )+ };
}

nodes! {
    /// A whole file.
    SourceFile = SourceFile {
        /// All items in order.
        items: FileItem,
        /// The files used.
        uses: Use,
        /// The boards.
        boards: Board,
        /// The devices outside any board.
        devices: Device,
        /// The chips outside any board.
        chips: Chip,
        /// The devices and chips outside any board, in file order.
        parts: Item,
        /// The constants.
        constants: Constant,
        /// The drivers.
        drivers: Driver,
        /// The tests.
        tests: Test,
    };
    /// `use "FILE";`
    Use = Use;
    /// `const NAME = VALUE;`
    Constant = Const;
    /// `[spare] board NAME [on SOURCE] { ... }`
    Board = Board {
        /// All items in order.
        items: BoardItem,
        /// The devices.
        devices: Device,
        /// The chips.
        chips: Chip,
        /// The devices and chips in order.
        parts: Item,
        /// The rules.
        rules: Rule,
        /// The properties.
        properties: Property,
        /// The links; the grammar allows several.
        links: Link,
        /// The controllers.
        controllers: Controller,
    };
    /// `link { ... }`
    Link = Link {
        /// The properties.
        properties: Property,
    };
    /// `sensor NAME returns TYPE { ... }` or `actuator NAME accepts TYPE { ... }`
    Device = Device {
        /// All items in order.
        items: DeviceItem,
        /// The properties.
        properties: Property,
        /// The rules.
        rules: Rule,
    };
    /// The data type of a device.
    Type = Type;
}
choice!(
    /// An item of a file.
    FileItem {
        /// A file that is used.
        Use(Use),
        /// A board.
        Board(Board),
        /// A named value.
        Constant(Constant),
        /// A device that may go on any board.
        Device(Device),
        /// A chip that may go on any board.
        Chip(Chip),
        /// A reusable protocol.
        Driver(Driver),
        /// What must hold in a run.
        Test(Test),
    }
);
choice!(
    /// An item of a board.
    BoardItem {
        /// A device that stays on this board.
        Device(Device),
        /// A chip that stays on this board.
        Chip(Chip),
        /// A rule.
        Rule(Rule),
        /// A property of the board.
        Property(Property),
        /// The link to the host.
        Link(Link),
        /// Code of the user's.
        Controller(Controller),
    }
);
choice!(
    /// What has identifiers: a part with one value, one with several, or code.
    Item {
        /// A part with one value.
        Device(Device),
        /// A part with several values.
        Chip(Chip),
        /// Code of the user's.
        Controller(Controller),
    }
);
choice!(
    /// An item of a device.
    DeviceItem {
        /// A property of the device.
        Property(Property),
        /// A rule.
        Rule(Rule),
    }
);

named!(Constant, Board, Device, Property, Chip, Driver, Connection, Reading, Command, NameValue);
typed!(Device, Reading, Command);

/// The source of a board's pins.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum BoardSource {
    /// A built-in board or MCU part.
    Name(Name),
    /// The path of a table.
    File(StringLiteral),
}

impl BoardSource {
    /// The range of the source.
    #[must_use]
    pub fn range(&self) -> TextRange {
        match self {
            Self::Name(name) => name.range(),
            Self::File(path) => path.range(),
        }
    }
}

/// The direction of a device's data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// To the host: a sensor.
    Sensor,
    /// From the host: an actuator.
    Actuator,
}

impl Use {
    /// The path of the file.
    #[must_use]
    pub fn path(&self) -> Option<StringLiteral> {
        string(&self.0)
    }
}

impl Constant {
    /// The value.
    #[must_use]
    pub fn value(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

impl Board {
    /// The word `spare`, if it is there.
    #[must_use]
    pub fn spare_token(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::SpareKw)
    }
    /// Whether the board is used only if needed.
    #[must_use]
    pub fn is_spare(&self) -> bool {
        self.spare_token().is_some()
    }
    /// The source after `on`.
    #[must_use]
    pub fn on(&self) -> Option<BoardSource> {
        let clause = self.0.children().find(|node| node.kind() == SyntaxKind::OnClause)?;
        name(&clause).map(BoardSource::Name).or_else(|| string(&clause).map(BoardSource::File))
    }
}

impl Link {
    /// The word `link`.
    #[must_use]
    pub fn keyword(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::LinkKw)
    }
}

impl Device {
    /// The direction of the data, from the first keyword.
    #[must_use]
    pub fn direction(&self) -> Option<Direction> {
        let sensor = token(&self.0, SyntaxKind::SensorKw).map(|_| Direction::Sensor);
        sensor.or_else(|| token(&self.0, SyntaxKind::ActuatorKw).map(|_| Direction::Actuator))
    }
}

impl Type {
    /// The name of the scalar type. Whether that type exists is not checked here.
    #[must_use]
    pub fn scalar(&self) -> Option<Name> {
        name(&self.0)
    }
    /// Whether a length is written, even if it is broken.
    #[must_use]
    pub fn is_array(&self) -> bool {
        token(&self.0, SyntaxKind::LBracket).is_some()
    }
    /// The number of elements of an array, with its range, if a number is written.
    #[must_use]
    pub fn length(&self) -> Option<(u64, TextRange)> {
        let digits = token(&self.0, SyntaxKind::Int)?;
        Some((literal::integer(digits.text())?, digits.text_range()))
    }
    /// The constant for the number of elements of an array, if a name is written.
    #[must_use]
    pub fn length_name(&self) -> Option<Name> {
        names(&self.0).nth(1)
    }
}
