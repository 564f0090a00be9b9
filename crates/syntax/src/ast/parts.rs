//! Views over parts with several values: chips, and the drivers that describe them.

use super::{AstNode, Device, Name, Property, Rule, Type, children, choice, name, node};
use crate::kind::{SyntaxKind, SyntaxNode};

node!(
    /// `chip NAME { ... }`
    Chip = Chip
);
node!(
    /// `driver NAME [for KIND] { ... }`
    Driver = Driver
);
node!(
    /// `connection NAME [for KIND] { ... }`
    Connection = Connection
);
node!(
    /// `reading NAME returns TYPE { ... }`
    Reading = Reading
);
node!(
    /// `command NAME accepts TYPE { ... }`
    Command = Command
);
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

impl Chip {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// All items in order.
    pub fn items(&self) -> impl Iterator<Item = ChipItem> + use<> {
        children(&self.0)
    }
    /// The properties.
    pub fn properties(&self) -> impl Iterator<Item = Property> + use<> {
        children(&self.0)
    }
    /// The rules.
    pub fn rules(&self) -> impl Iterator<Item = Rule> + use<> {
        children(&self.0)
    }
    /// The devices.
    pub fn devices(&self) -> impl Iterator<Item = Device> + use<> {
        children(&self.0)
    }
    /// The connections.
    pub fn connections(&self) -> impl Iterator<Item = Connection> + use<> {
        children(&self.0)
    }
}

impl Driver {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The kind of device that it is for, if one is written. Whether that kind exists is not
    /// checked here.
    #[must_use]
    pub fn kind(&self) -> Option<Name> {
        name(&self.0.children().find(|node| node.kind() == SyntaxKind::Kind)?)
    }
    /// All items in order.
    pub fn items(&self) -> impl Iterator<Item = DriverItem> + use<> {
        children(&self.0)
    }
    /// The properties.
    pub fn properties(&self) -> impl Iterator<Item = Property> + use<> {
        children(&self.0)
    }
    /// The connections.
    pub fn connections(&self) -> impl Iterator<Item = Connection> + use<> {
        children(&self.0)
    }
    /// The readings.
    pub fn readings(&self) -> impl Iterator<Item = Reading> + use<> {
        children(&self.0)
    }
    /// The commands.
    pub fn commands(&self) -> impl Iterator<Item = Command> + use<> {
        children(&self.0)
    }
}

impl Connection {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The kind of connection that it is, if one is written. Whether that kind exists is not
    /// checked here.
    #[must_use]
    pub fn kind(&self) -> Option<Name> {
        name(&self.0.children().find(|node| node.kind() == SyntaxKind::Kind)?)
    }
    /// The properties.
    pub fn properties(&self) -> impl Iterator<Item = Property> + use<> {
        children(&self.0)
    }
}

impl Reading {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The data type.
    #[must_use]
    pub fn ty(&self) -> Option<Type> {
        children(&self.0).next()
    }
    /// The properties.
    pub fn properties(&self) -> impl Iterator<Item = Property> + use<> {
        children(&self.0)
    }
}

impl Command {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The data type.
    #[must_use]
    pub fn ty(&self) -> Option<Type> {
        children(&self.0).next()
    }
    /// The properties.
    pub fn properties(&self) -> impl Iterator<Item = Property> + use<> {
        children(&self.0)
    }
}
