//! What each name of a design stands for, and where else it stands.
//!
//! In: the trees of a design. Out: for a word of one of them the thing that it names, and all words that name it. A name
//! is that of a constant, a driver, a value or connection of a driver, a group, a board, or a part.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::{FileId, Span};
use sensedsl_session::Snapshot;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};

use crate::context::bytes;
use crate::library;

/// The thing that a name stands for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Thing {
    Constant(String),
    /// By its name, which aliases are for, too.
    Driver(String),
    /// A reading or a command of a driver.
    DriverValue(String, String),
    /// A connection of a driver.
    Connection(String, String),
    Group(String),
    Board(String),
    /// A device or a chip.
    Part(String),
}

impl Thing {
    /// What it is, for people.
    pub(crate) const fn what(&self) -> &'static str {
        match self {
            Self::Constant(_) => "constant",
            Self::Driver(_) => "driver",
            Self::DriverValue(..) => "value of a driver",
            Self::Connection(..) => "connection of a driver",
            Self::Group(_) => "group",
            Self::Board(_) => "board",
            Self::Part(_) => "device",
        }
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Constant(name)
            | Self::Driver(name)
            | Self::DriverValue(_, name)
            | Self::Connection(_, name)
            | Self::Group(name)
            | Self::Board(name)
            | Self::Part(name) => name,
        }
    }
}

/// A word that names something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Occurrence {
    pub(crate) span: Span,
    pub(crate) thing: Thing,
    /// Whether it is where the thing is described.
    pub(crate) is_declaration: bool,
    /// Whether it is a text between quotes.
    pub(crate) is_text: bool,
}

/// The names of a design.
pub(crate) struct Names {
    /// In the order of the files, and of their texts.
    pub(crate) all: Vec<Occurrence>,
}

impl Names {
    pub(crate) fn new(snapshot: &Snapshot) -> Self {
        let reader = Reader::new(snapshot);
        let mut all = Vec::new();
        for (file, tree) in snapshot.trees() {
            let root = tree.syntax();
            let tokens = root.descendants_with_tokens().filter_map(SyntaxElement::into_token);
            all.extend(tokens.filter_map(|token| reader.occurrence(*file, &token)));
        }
        Self { all }
    }

    /// The name at an offset of a file.
    pub(crate) fn at(&self, file: FileId, offset: usize) -> Option<&Occurrence> {
        let touches = |one: &&Occurrence| {
            let range = one.span.range();
            one.span.file == file && range.start <= offset && offset <= range.end
        };
        self.all.iter().find(touches)
    }

    /// All words that name a thing.
    pub(crate) fn of<'a>(&'a self, thing: &'a Thing) -> impl Iterator<Item = &'a Occurrence> {
        self.all.iter().filter(move |one| one.thing == *thing)
    }
}

/// A name as it is compared: case, hyphens and underscores do not count.
pub(crate) fn folded(name: &str) -> String {
    name.chars().filter(|one| !"_-".contains(*one)).flat_map(char::to_lowercase).collect()
}

struct Reader {
    constants: BTreeSet<String>,
    /// The drivers of the files, by their folded names, with the folded names of their values.
    drivers: BTreeMap<String, (String, BTreeMap<String, String>)>,
}

impl Reader {
    fn new(snapshot: &Snapshot) -> Self {
        let (mut constants, mut drivers) = (BTreeSet::new(), BTreeMap::new());
        for (_, tree) in snapshot.trees() {
            let names = tree.ast().constants().filter_map(|one| one.name());
            constants.extend(names.map(|name| name.text().to_owned()));
            for driver in tree.ast().drivers() {
                let Some(name) = driver.name() else { continue };
                let readings = driver.readings().filter_map(|one| one.name());
                let commands = driver.commands().filter_map(|one| one.name());
                let values = readings.chain(commands).map(|one| one.text().to_owned());
                let values = values.map(|one| (folded(&one), one)).collect();
                drivers.insert(folded(name.text()), (name.text().to_owned(), values));
            }
        }
        Self { constants, drivers }
    }

    fn occurrence(&self, file: FileId, token: &SyntaxToken) -> Option<Occurrence> {
        let is_text = token.kind() == SyntaxKind::Str;
        if !is_text && token.kind() != SyntaxKind::Ident {
            return None;
        }
        let (thing, is_declaration) = self.thing(token, is_text)?;
        let mut range = bytes(token.text_range());
        if is_text {
            range = range.start + 1..range.end.saturating_sub(1).max(range.start + 1);
        }
        Some(Occurrence { span: Span::new(file, range), thing, is_declaration, is_text })
    }

    fn thing(&self, token: &SyntaxToken, is_text: bool) -> Option<(Thing, bool)> {
        let parent = token.parent()?;
        let written = if is_text { token.text().trim_matches('"') } else { token.text() };
        let name = || written.to_owned();
        let declared = |thing| Some((thing, true));
        match parent.kind() {
            SyntaxKind::NameValue if self.constants.contains(written) => {
                Some((Thing::Constant(name()), false))
            }
            SyntaxKind::NameValue | SyntaxKind::StringValue => {
                self.of_value(&parent, written).map(|thing| (thing, false))
            }
            _ if is_text => None,
            SyntaxKind::Const => declared(Thing::Constant(name())),
            SyntaxKind::Type if self.constants.contains(written) => {
                Some((Thing::Constant(name()), false))
            }
            SyntaxKind::Board => declared(Thing::Board(name())),
            SyntaxKind::Device | SyntaxKind::Chip => declared(Thing::Part(name())),
            SyntaxKind::Driver => declared(Thing::Driver(name())),
            SyntaxKind::Reading | SyntaxKind::Command => {
                declared(Thing::DriverValue(driver_around(&parent)?, name()))
            }
            SyntaxKind::Connection => match driver_around(&parent) {
                Some(driver) => declared(Thing::Connection(driver, name())),
                None => Some((Thing::Connection(self.driver_of_chip(&parent)?, name()), false)),
            },
            _ => None,
        }
    }

    /// What a name or a text after `=` stands for.
    fn of_value(&self, value: &SyntaxNode, written: &str) -> Option<Thing> {
        let property = value.ancestors().find_map(ast::Property::cast)?.name()?;
        match property.text() {
            "driver" => Some(Thing::Driver(self.driver(written)?)),
            "group" if written != "none" => Some(Thing::Group(written.to_owned())),
            "reading" => self.value(&self.driver_of_chip(value)?, written),
            "via" => Some(Thing::Connection(driver_around(value)?, written.to_owned())),
            "mux" => match driver_around(value) {
                Some(driver) => self.value(&driver, written),
                None => Some(Thing::Part(written.to_owned())),
            },
            _ => None,
        }
    }

    fn value(&self, driver: &str, written: &str) -> Option<Thing> {
        let (_, values) = self.drivers.get(&folded(driver))?;
        Some(Thing::DriverValue(driver.to_owned(), values.get(&folded(written))?.clone()))
    }

    /// The driver that a written name means: one of the files, or a part of the library.
    fn driver(&self, written: &str) -> Option<String> {
        let wanted = folded(written);
        if let Some((name, _)) = self.drivers.get(&wanted) {
            return Some(name.clone());
        }
        Some(library::part(written)?.name.clone())
    }

    /// The driver of the chip that something is in.
    fn driver_of_chip(&self, within: &SyntaxNode) -> Option<String> {
        let chip = within.ancestors().find_map(ast::Chip::cast)?;
        let is_driver =
            |one: &ast::Property| one.name().is_some_and(|name| name.text() == "driver");
        let written = match chip.properties().find(is_driver)?.value()? {
            ast::Value::Name(name) => name.name()?.text().to_owned(),
            ast::Value::String(text) => text.literal()?.value(),
            _ => return None,
        };
        self.driver(&written)
    }
}

/// The name of the driver block that something is in.
fn driver_around(within: &SyntaxNode) -> Option<String> {
    let driver = within.ancestors().find_map(ast::Driver::cast)?;
    Some(driver.name()?.text().to_owned())
}
