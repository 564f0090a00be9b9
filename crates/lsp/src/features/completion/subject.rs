//! What a block is about: the direction of its value, its kind, its driver, its board.

use sensedsl_model::design::{Board, BoardIndex, Design};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_model::meaning::{self, Meaning};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::Direction;

use super::site::{Block, Site};
use crate::context::Context;
use crate::library;
use crate::names::folded;

/// What can stand in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    File,
    Board,
    Link,
    Device,
    Chip,
    /// A device of a chip.
    OfChip,
    Connection,
    Driver,
    /// A reading or command.
    OfDriver,
    Controller,
    Test,
    /// A block whose keyword is none.
    Unknown,
}

/// A driver, of the library or of the file.
#[derive(Clone, Debug, Default)]
pub(crate) struct DriverFacts {
    pub(crate) name: String,
    pub(crate) kinds: Vec<KindName>,
    pub(crate) values: Vec<ValueFacts>,
    pub(crate) connections: Vec<(String, KindName)>,
    pub(crate) outputs: Vec<&'static str>,
    pub(crate) about: String,
    /// What it leaves to the design that the kind must have.
    open: Vec<&'static str>,
}

impl DriverFacts {
    /// Whether the driver says what a property is that its kind must have.
    pub(crate) fn states(&self, name: &str) -> bool {
        !self.open.contains(&name)
    }
}

/// A value that a driver names.
#[derive(Clone, Debug)]
pub(crate) struct ValueFacts {
    pub(crate) name: String,
    pub(crate) direction: Direction,
    pub(crate) ty: String,
    pub(crate) quantity: Option<String>,
}

/// What the block at the cursor is about.
pub(crate) struct Subject<'s, 'a> {
    pub(crate) cx: &'s Context<'a>,
    pub(crate) site: &'s Site<'a>,
    pub(crate) place: Place,
    pub(crate) direction: Direction,
    pub(crate) driver: Option<DriverFacts>,
    pub(crate) kinds: Vec<KindName>,
}

impl<'s, 'a> Subject<'s, 'a> {
    pub(crate) fn of(cx: &'s Context<'a>, site: &'s Site<'a>) -> Self {
        let block = site.block();
        let outer = site.blocks.get(1);
        let is_in = |word: &str| outer.is_some_and(|outer| outer.keyword() == word);
        let place = match block.keyword() {
            "board" => Place::Board,
            "link" => Place::Link,
            "sensor" | "actuator" if is_in("chip") => Place::OfChip,
            "sensor" | "actuator" => Place::Device,
            "chip" => Place::Chip,
            "connection" => Place::Connection,
            "driver" => Place::Driver,
            "reading" | "command" => Place::OfDriver,
            "controller" => Place::Controller,
            "test" => Place::Test,
            _ if outer.is_some() => Place::Unknown,
            _ => Place::File,
        };
        let mut subject = Self {
            cx,
            site,
            place,
            direction: direction(block.keyword()),
            driver: None,
            kinds: Vec::new(),
        };
        subject.driver = match place {
            Place::Device | Place::Chip => subject.driver_of(block),
            Place::OfChip | Place::Connection => outer.and_then(|outer| subject.driver_of(outer)),
            Place::Driver => block.name().map(|_| of_block(block)),
            Place::OfDriver => outer.map(of_block),
            Place::File
            | Place::Board
            | Place::Link
            | Place::Controller
            | Place::Test
            | Place::Unknown => None,
        };
        subject.kinds = subject.kinds_of(block);
        subject
    }

    fn driver_of(&self, block: &Block<'_>) -> Option<DriverFacts> {
        driver(self.cx, block.value("driver")?)
    }

    fn kinds_of(&self, block: &Block<'_>) -> Vec<KindName> {
        if self.place == Place::Connection {
            let stated = block.after("for").and_then(KindName::from_name);
            let named = |driver: &DriverFacts| {
                let own =
                    driver.connections.iter().find(|(name, _)| Some(&**name) == block.name())?;
                Some(own.1)
            };
            let kind = stated.or_else(|| self.driver.as_ref().and_then(named));
            return kind.into_iter().collect();
        }
        let stated = block.value("type").filter(|_| self.place == Place::Device);
        let stated = stated.and_then(KindName::from_name);
        match (stated, &self.driver) {
            (Some(kind), _) => vec![kind],
            (None, Some(driver)) => driver.kinds.clone(),
            (None, None) => Vec::new(),
        }
    }

    /// Its kind, if it has one and no other.
    pub(crate) fn kind(&self) -> Option<KindName> {
        match self.kinds.as_slice() {
            [only] => Some(*only),
            _ => None,
        }
    }

    /// The block as the language describes it.
    pub(crate) fn block(&self) -> Option<meaning::Block<'_>> {
        let has_values = self.driver.as_ref().is_some_and(|driver| !driver.values.is_empty());
        Some(match self.place {
            Place::File | Place::Unknown => return None,
            Place::Board => meaning::Block::Board,
            Place::Link => meaning::Block::Link,
            Place::Device if has_values => meaning::Block::Value(&self.kinds, self.direction),
            Place::Device => meaning::Block::Device(self.kind(), self.direction),
            Place::Chip => meaning::Block::Chip(&self.kinds),
            Place::OfChip => meaning::Block::OfChip(self.direction),
            Place::Connection => meaning::Block::Connection(self.kind()?),
            Place::Driver => meaning::Block::Driver(&self.kinds),
            Place::OfDriver => meaning::Block::OfDriver(&self.kinds, self.direction),
            Place::Controller => meaning::Block::Controller,
            Place::Test => meaning::Block::Test,
        })
    }

    /// The property in whose value the cursor is: of the block, or of a rule.
    pub(crate) fn meaning(&self) -> Option<&'static Meaning> {
        let (name, _) = self.site.property()?;
        match self.site.before.first()?.text {
            "prefer" | "avoid" if self.site.words().get(1) != Some(&"=") => {
                meaning::Block::Wish.property(name)
            }
            "const" => None,
            _ => self.block()?.property(name),
        }
    }

    /// The kind of the chip's connection that has this name.
    pub(crate) fn connection(&self, name: &str) -> Option<KindName> {
        let is_chip = matches!(self.place, Place::Chip | Place::Device);
        let mut all = self.driver.as_ref().filter(|_| is_chip)?.connections.iter();
        all.find(|(own, _)| own == name).map(|(_, kind)| *kind)
    }

    /// The wires that a property fixes, each with its kind.
    pub(crate) fn wires(&self, property: &str) -> Vec<(KindName, Role)> {
        if let Some(kind) = self.connection(property) {
            return roles_of(kind).into_iter().map(|role| (kind, role)).collect();
        }
        let any: Vec<KindName> = KindName::ALL
            .into_iter()
            .filter(|kind| kind.spec().directions.contains(&self.direction))
            .collect();
        let kinds = if self.kinds.is_empty() { &any } else { &self.kinds };
        let has = |kind: &&KindName| kind.spec().properties.contains(&property);
        let role = |kind: KindName| {
            let is_output = kind.spec().directions == [Direction::Actuator]
                || self.direction == Direction::Actuator;
            let only = if is_output { Role::Out } else { Role::In };
            Role::from_property(property).unwrap_or(only)
        };
        kinds.iter().filter(has).map(|kind| (*kind, role(*kind))).collect()
    }

    /// The boards that the block's part may go to, in the newest design that has any.
    pub(crate) fn boards(&self) -> Vec<(&Design, BoardIndex, &Board)> {
        let sound = self.cx.analysis.snapshot.sound().map(|sound| sound.design);
        let wired = || Some(self.cx.wired.as_ref()?.wired()?.0);
        let own = self.site.blocks.iter().find(|block| block.keyword() == "board");
        let own = own.and_then(Block::name);
        for design in sound.into_iter().chain(wired()) {
            let all = design.boards.iter().enumerate();
            let all = all.map(|(index, board)| (design, BoardIndex(index), board));
            let is_own = |board: &Board| own.is_none_or(|own| board.name.value == own);
            let found: Vec<_> = all.filter(|(_, _, board)| is_own(board)).collect();
            if !found.is_empty() {
                return found;
            }
        }
        Vec::new()
    }

    /// The name of the part that the cursor is in.
    pub(crate) fn part(&self) -> Option<&'a str> {
        let words = ["chip", "sensor", "actuator"];
        let mut parts = self.site.blocks.iter().filter(|one| words.contains(&one.keyword()));
        parts.next_back().and_then(Block::name)
    }
}

fn direction(word: &str) -> Direction {
    if matches!(word, "actuator" | "command" | "accepts") {
        Direction::Actuator
    } else {
        Direction::Sensor
    }
}

/// The wires of a kind, whatever the direction.
fn roles_of(kind: KindName) -> Vec<Role> {
    let mut roles: Vec<Role> = Vec::new();
    for role in kind.spec().properties.iter().filter_map(|name| Role::from_property(name)) {
        roles.push(role);
    }
    if kind.spec().properties.contains(&"pin") {
        let is_input = kind.spec().directions.first() == Some(&Direction::Sensor);
        roles.push(if is_input { Role::In } else { Role::Out });
    }
    roles
}

/// The driver of that name: of the file, or of the library.
pub(crate) fn driver(cx: &Context<'_>, name: &str) -> Option<DriverFacts> {
    let mut own = of_file(cx).into_iter();
    own.find(|driver| folded(&driver.name) == folded(name)).or_else(|| of_library(name))
}

/// The drivers of the file and of those that it uses.
pub(crate) fn of_file(cx: &Context<'_>) -> Vec<DriverFacts> {
    let trees = cx.analysis.snapshot.trees().iter();
    let all = trees.flat_map(|(_, tree)| tree.ast().drivers().collect::<Vec<_>>());
    all.filter_map(|node| of_node(&node)).collect()
}

fn of_node(node: &ast::Driver) -> Option<DriverFacts> {
    let kind = |name: Option<ast::Name>| KindName::from_name(name?.text());
    let text = |properties: &[ast::Property], name: &str| {
        let found = properties.iter().find(|one| one.name().is_some_and(|own| own.text() == name));
        Some(found?.value()?.syntax().text().to_string().trim_matches('"').to_owned())
    };
    let value = |name: Option<ast::Name>, ty: Option<ast::Type>, way, own: &[ast::Property]| {
        let ty = ty.map(|ty| ty.syntax().text().to_string());
        let (name, quantity) = (name?.text().to_owned(), text(own, "quantity"));
        Some(ValueFacts { name, direction: way, ty: ty?.trim().to_owned(), quantity })
    };
    let readings = node.readings().filter_map(|one| {
        value(one.name(), one.ty(), Direction::Sensor, &one.properties().collect::<Vec<_>>())
    });
    let commands = node.commands().filter_map(|one| {
        value(one.name(), one.ty(), Direction::Actuator, &one.properties().collect::<Vec<_>>())
    });
    let connections: Vec<(String, KindName)> = node
        .connections()
        .filter_map(|one| Some((one.name()?.text().to_owned(), kind(one.kind())?)))
        .collect();
    let own: Vec<ast::Property> = node.properties().collect();
    let formula = text(&own, "compensate");
    let is_open = |name: &&str| text(&own, name).is_none();
    Some(DriverFacts {
        name: node.name()?.text().to_owned(),
        kinds: distinct(kind(node.kind()).into_iter().chain(connections.iter().map(|one| one.1))),
        values: readings.chain(commands).collect(),
        connections,
        outputs: outputs(formula.as_deref()),
        about: text(&own, "about").or_else(|| text(&own, "part")).unwrap_or_default(),
        open: ["address"].into_iter().filter(is_open).collect(),
    })
}

fn outputs(formula: Option<&str>) -> Vec<&'static str> {
    let all = sensedsl_model::protocol::Formula::ALL;
    let found = all.into_iter().find(|one| Some(one.name()) == formula);
    found.map(|one| one.outputs().to_vec()).unwrap_or_default()
}

/// The driver that is being written.
fn of_block(block: &Block<'_>) -> DriverFacts {
    let connections: Vec<(String, KindName)> = block
        .blocks
        .iter()
        .filter(|one| one.keyword() == "connection")
        .filter_map(|one| Some((one.name()?.to_owned(), KindName::from_name(one.after("for")?)?)))
        .collect();
    let kind = block.after("for").and_then(KindName::from_name);
    DriverFacts {
        name: block.name().unwrap_or_default().to_owned(),
        kinds: distinct(kind.into_iter().chain(connections.iter().map(|one| one.1))),
        connections,
        outputs: outputs(block.value("compensate")),
        ..DriverFacts::default()
    }
}

fn of_library(name: &str) -> Option<DriverFacts> {
    let part = library::part(name)?;
    let values = part.values.iter().filter_map(|value| {
        Some(ValueFacts {
            name: value.name.clone()?,
            direction: value.direction,
            ty: value.value.to_string(),
            quantity: value.shown.quantity.clone(),
        })
    });
    let connections = part.connections.iter();
    let connections = connections.filter_map(|one| Some((one.name.clone()?, one.kind.name())));
    Some(DriverFacts {
        name: part.name.clone(),
        kinds: part.kinds.clone(),
        values: values.collect(),
        connections: connections.collect(),
        outputs: Vec::new(),
        about: part.about.clone(),
        open: part.address.is_none().then_some("address").into_iter().collect(),
    })
}

fn distinct(kinds: impl Iterator<Item = KindName>) -> Vec<KindName> {
    let mut all: Vec<KindName> = kinds.collect();
    all.sort_unstable();
    all.dedup();
    all
}
