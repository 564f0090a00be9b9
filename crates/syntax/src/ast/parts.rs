//! Views over parts with several values: chips, and the drivers that describe them.

use super::Device;
use super::node::{AstNode, children, choice, nodes};
use super::rules::Rule;
use super::values::{Name, Property, name};
use crate::kind::{SyntaxKind, SyntaxNode};

nodes! {
    /// `chip NAME { ... }`
    Chip = Chip {
        /// All items in order.
        items: ChipItem,
        /// The properties.
        properties: Property,
        /// The rules.
        rules: Rule,
        /// The devices.
        devices: Device,
        /// The connections.
        connections: Connection,
    };
    /// `driver NAME [for KIND] { ... }`
    Driver = Driver {
        /// All items in order.
        items: DriverItem,
        /// The properties.
        properties: Property,
        /// The connections.
        connections: Connection,
        /// The readings.
        readings: Reading,
        /// The commands.
        commands: Command,
    };
    /// `connection NAME [for KIND] { ... }`
    Connection = Connection {
        /// The properties.
        properties: Property,
    };
    /// `reading NAME returns TYPE { ... }`
    Reading = Reading {
        /// The properties.
        properties: Property,
    };
    /// `command NAME accepts TYPE { ... }`
    Command = Command {
        /// The properties.
        properties: Property,
    };
}
choice!(
    /// An item of a chip.
    ChipItem {
        /// A property of the chip, or of its connection.
        Property(Property),
        /// A rule.
        Rule(Rule),
        /// One of its values.
        Device(Device),
        /// Properties of one of its connections.
        Connection(Connection),
    }
);
choice!(
    /// An item of a driver.
    DriverItem {
        /// A property.
        Property(Property),
        /// A connection of the part.
        Connection(Connection),
        /// A value that the part gives.
        Reading(Reading),
        /// A value that the part takes.
        Command(Command),
    }
);

impl Driver {
    /// The kind of device that it is for, if one is written. Whether that kind exists is not
    /// checked here.
    #[must_use]
    pub fn kind(&self) -> Option<Name> {
        name(&self.0.children().find(|node| node.kind() == SyntaxKind::Kind)?)
    }
}

impl Connection {
    /// The kind of connection that it is, if one is written. Whether that kind exists is not
    /// checked here.
    #[must_use]
    pub fn kind(&self) -> Option<Name> {
        name(&self.0.children().find(|node| node.kind() == SyntaxKind::Kind)?)
    }
}
