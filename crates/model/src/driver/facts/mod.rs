//! What is known about the parts of the library: its drivers in, plain data about each out, for
//! tables, pages and programs.
//!
//! Wires and values are those that a design gets: each driver is read as a part that uses
//! everything the driver has.

mod example;
mod source;

use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::parse;
use sensedsl_wire::{Direction, ScalarType, ValueType};

use crate::design::protocol::{Coding, Filter, Formula, Protocol};
use crate::design::{Bounds, Level, Module, Presentation};
use crate::driver::known::Known;
use crate::driver::library::search;
use crate::driver::{Driver, Drivers, bounds, module};
use crate::fields::Fields;
use crate::kind::{Kind, KindName, Role, Values, encoding};
use crate::meaning::first;
use crate::part::block::{Next, ReadPart};
use crate::part::coding::{CODING, CRCS, DRIVES, FORMATS, PROTOCOL};
use crate::part::{chip, device, properties, reach};
use crate::spanned::span;
use crate::value::constants::Constants;

pub use crate::driver::near::{Near, identifier};
pub use example::{EXAMPLE_BOARD, delay_ms, example, example_board, example_on, snippet};
pub use source::source;

/// A part of the library.
#[derive(Clone, Debug)]
pub struct PartFacts {
    /// The name in `driver = …;`.
    pub name: String,
    /// The field that it belongs to, which is the name of the library's file (`motion`).
    pub field: &'static str,
    /// The kinds of its connections, each once.
    pub kinds: Vec<KindName>,
    /// Its full name.
    pub part: String,
    /// A sentence about what it does.
    pub about: String,
    /// Other names that people use for it.
    pub aliases: Vec<String>,
    /// Search terms of people who mean it: `motor driver`, `imu`.
    pub words: Vec<&'static str>,
    /// The source of its figures.
    pub sheet: Option<String>,
    /// What the figures were compared with; none if they were not.
    pub checked: Option<String>,
    /// The least and the greatest supply, in millivolts.
    pub supply_mv: Option<(u32, u32)>,
    /// The greatest clock of its bus, if the driver states it.
    pub clock_max_hz: Option<u32>,
    /// Whether its bus or its wire needs pull-up resistors.
    pub needs_pull_up: bool,
    /// The addresses that it can have.
    pub addresses: Vec<u8>,
    /// Whether it states its own cycle time.
    pub has_own_delay: bool,
    /// Its default address; none if a design must state it.
    pub address: Option<u8>,
    /// What it is for the people who wire it.
    pub module: Module,
    /// How it is started and identified; none for a part with one value that has no name.
    pub protocol: Option<Protocol>,
    /// Its wires.
    pub connections: Vec<ConnectionFacts>,
    /// Its values.
    pub values: Vec<ValueFacts>,
}

/// Wires of a part.
#[derive(Clone, Debug)]
pub struct ConnectionFacts {
    /// The driver's name for them; none if the driver is for one kind.
    pub name: Option<String>,
    /// Their kind, with the properties of that kind.
    pub kind: Kind,
    /// The role of each wire.
    pub roles: Vec<Role>,
    /// The voltage on them, if the driver states it.
    pub level: Option<Level>,
}

/// A value of a part.
#[derive(Clone, Debug)]
pub struct ValueFacts {
    /// The driver's reading or command; none for a single value, which has no name.
    pub name: Option<String>,
    /// Its direction.
    pub direction: Direction,
    /// Its type.
    pub value: ValueType,
    /// The kind of its connection, with its own register, length and order.
    pub kind: Kind,
    /// How a host shows it.
    pub shown: Presentation,
    /// How it is coded.
    pub coding: Coding,
    /// How it is filtered on the board.
    pub filter: Filter,
    /// The connections that it goes over; empty if the driver is for one kind.
    pub via: Vec<String>,
}

impl ValueFacts {
    /// The least and the greatest value as a host shows it, if the part limits them more than the
    /// type does.
    #[must_use]
    pub fn range(&self) -> Option<(f64, f64)> {
        if let (Some(min), Some(max)) = (self.shown.min, self.shown.max) {
            return Some((min, max));
        }
        if let (Some(first), Some(last)) = (self.shown.curve.first(), self.shown.curve.last()) {
            return Some((first.1.min(last.1), first.1.max(last.1)));
        }
        let (least, most) = self.raw_range()?;
        let (scale, offset) = (self.shown.scale.unwrap_or(1.0), self.shown.offset.unwrap_or(0.0));
        let (one, other) = (least * scale + offset, most * scale + offset);
        Some((one.min(other), one.max(other)))
    }

    /// The least and the greatest value on the wire.
    fn raw_range(&self) -> Option<(f64, f64)> {
        let computed = self.coding.output.is_some() || self.coding.text.is_some();
        if computed || self.coding.bcd {
            return None;
        }
        if let Some(fixed) = reach::fixed(&self.kind, &self.coding) {
            return Some(fixed);
        }
        let (least, most) = self.value.scalar.integer_range()?;
        let bits = self.coding.bits.map(|(high, low)| high - low + 1);
        let signed = self.coding.signed.unwrap_or(least < 0) || self.coding.is_magnitude;
        match bits.or(self.coding.packed_bits) {
            Some(1) => None,
            Some(bits) if bits <= 32 && signed => {
                let half = 2_f64.powi(i32::from(bits) - 1);
                Some((-half, half - 1.0))
            }
            Some(bits) if bits <= 32 => Some((0.0, 2_f64.powi(i32::from(bits)) - 1.0)),
            // A wide word reveals little about the part, and so does one that is counted.
            None if self.shown.scale.is_some() && self.value.scalar.size_bytes() <= 2 =>
            {
                #[expect(clippy::cast_precision_loss, reason = "of at most 16 bits")]
                Some((least as f64, most as f64))
            }
            Some(_) | None => None,
        }
    }
}

/// All parts of the library, by field, in the order of its files.
#[must_use]
pub fn all() -> Vec<PartFacts> {
    let library = Library::open();
    let all = library.drivers.of_library();
    all.filter_map(|(field, driver)| library.facts(field, driver, &mut Vec::new())).collect()
}

/// The names of all drivers of the library.
pub fn names() -> impl Iterator<Item = &'static str> {
    crate::driver::library::LIBRARY.iter().flat_map(|(_, text)| {
        let ranges = parse(text).ast().drivers().filter_map(|one| Some(one.name()?.range()));
        let ranges: Vec<_> = ranges.map(|at| at.start().into()..at.end().into()).collect();
        ranges.into_iter().filter_map(|at: std::ops::Range<usize>| text.get(at))
    })
}

/// All words of the driver language: the properties of a driver, its readings and its commands, and
/// the words that they take. Those of a kind are listed with the kind.
pub fn words_of_drivers() -> impl Iterator<Item = &'static str> {
    let properties = CODING.iter().chain(PROTOCOL).chain(properties::ABOUT_PART).copied();
    let words = [first(&CRCS), first(&FORMATS), first(&DRIVES)].concat();
    properties.chain(words).chain(Formula::ALL.map(Formula::name))
}

/// The part that a driver's name or one of its aliases stands for.
#[must_use]
pub fn find(name: &str) -> Option<PartFacts> {
    let library = Library::open();
    let wanted = &library.drivers.look_up(name)?.name;
    let found = library.drivers.of_library().find(|(_, one)| one.name == *wanted);
    found.and_then(|(field, driver)| library.facts(field, driver, &mut Vec::new()))
}

/// What a name may stand for that no driver has.
#[must_use]
pub fn near(name: &str) -> Near {
    Library::open().drivers.near(name)
}

/// The mistakes in the library; each driver is read as a part that uses everything the driver has.
#[must_use]
pub fn mistakes() -> Vec<(String, Diagnostic)> {
    let library = Library::open();
    let mut found = Vec::new();
    for (field, driver) in library.drivers.of_library() {
        let mut reported = Vec::new();
        let facts = library.facts(field, driver, &mut reported);
        debug_assert!(facts.is_some() || !reported.is_empty(), "{}", driver.name.value);
        found.extend(reported.into_iter().map(|one| (driver.name.value.clone(), one)));
    }
    found
}

/// The search terms for a driver.
fn words(driver: &str) -> Vec<&'static str> {
    let lines = search().lines().skip(1).filter_map(|line| line.split_once(','));
    let of_driver = lines.filter(|(_, drivers)| drivers.split(' ').any(|one| one == driver));
    of_driver.flat_map(|(words, _)| words.split(' ')).collect()
}

/// The drivers, and an empty file in place of the text of a user who asks for them.
struct Library {
    constants: Constants,
    drivers: Drivers,
    file: FileId,
}

impl Library {
    fn open() -> Self {
        let mut sources = SourceMap::default();
        let drivers = Drivers::new(&[], &mut sources, &mut Vec::new());
        let file = sources.add("", "");
        Self { constants: Constants::default(), drivers, file }
    }

    /// Reads one driver; none if it cannot be used, which is reported.
    fn facts(
        &self,
        field: &'static str,
        driver: &Driver,
        reported: &mut Vec<Diagnostic>,
    ) -> Option<PartFacts> {
        let mut fields = self.fields(driver, reported);
        let mut text = |name: &str| fields.text(name).map(|text| text.value);
        let about = text("about");
        let (sheet, checked) = (text("sheet"), text("checked"));
        let aliases = module::texts(&mut fields, "aliases");
        let module = module::read(&mut fields);
        let Bounds { addresses, clock_max_hz, supply_mv } = bounds::read(&mut fields);
        let address = fields.peek_integer("address").and_then(|one| u8::try_from(one).ok());
        let has_own_delay = fields.has("delay");
        let pull = fields.peek_name("pull");
        drop(fields);
        let part = Some(module.title.clone()).filter(|title| !title.is_empty());
        let first = addresses.first().filter(|_| address.is_none()).copied();
        let read = self.whole(driver, first, reported)?;
        let kinds = kinds(&read);
        // For a GPIO and an input, `pull` is the resistor inside the MCU.
        let is_outside = kinds.iter().any(|kind| !kind.spec().properties.contains(&"pull"));
        Some(PartFacts {
            name: driver.name.value.clone(),
            field,
            kinds,
            part: part.unwrap_or_else(|| driver.name.value.clone()),
            about: about.unwrap_or_default(),
            aliases,
            words: words(&driver.name.value),
            sheet,
            checked,
            supply_mv,
            clock_max_hz,
            needs_pull_up: is_outside && pull.as_deref() == Some("up"),
            addresses,
            has_own_delay,
            address,
            module,
            protocol: read.part.chip.clone(),
            values: values(&read),
            connections: connections(&read),
        })
    }

    /// The properties of the driver's head.
    fn fields<'a>(&'a self, driver: &Driver, reported: &'a mut Vec<Diagnostic>) -> Fields<'a> {
        let at = span(driver.file, driver.node.range());
        let own = driver.node.properties();
        Fields::new(own, driver.file, "a driver", at, (&self.constants, reported))
    }

    /// A part that uses everything the driver has.
    fn whole(
        &self,
        driver: &Driver,
        address: Option<u8>,
        reported: &mut Vec<Diagnostic>,
    ) -> Option<ReadPart> {
        let name = &driver.name.value;
        let address = address.map(|one| format!("address = {one:#04X};")).unwrap_or_default();
        let known = Known { constants: &self.constants, drivers: &self.drivers };
        let head = if driver.has_values() {
            "chip Part".to_owned()
        } else {
            let (direction, value) = self.plain_value(driver)?;
            head_of_device("Part", direction, value)
        };
        let at = (self.file, Next::FIRST);
        let tree = parse(&format!("{head} {{ driver = {name}; {address} }}")).ast();
        match tree.parts().next()? {
            ast::Item::Chip(node) => chip::read(at, &node, None, known, reported),
            ast::Item::Device(node) => device::read(at, &node, None, known, reported),
            ast::Item::Controller(_) => None,
        }
    }

    /// Direction and type of a driver's only value, if the driver does not name it.
    fn plain_value(&self, driver: &Driver) -> Option<(Direction, ValueType)> {
        let mut reported = Vec::new();
        let fields = self.fields(driver, &mut reported);
        let kind = driver.kind?;
        if let Some(scalar) = fields.peek_name("encoding").and_then(|word| encoding::scalar(&word))
        {
            return Some((Direction::Actuator, ValueType { scalar, length: Some(EXAMPLE_LEDS) }));
        }
        let inputs_have = kind.spec().inputs_have;
        let is_read = inputs_have.is_empty() || inputs_have.iter().any(|name| fields.has(name));
        let direction = match kind.spec().directions {
            [only] => *only,
            _ if is_read => Direction::Sensor,
            _ => Direction::Actuator,
        };
        let signed = fields.peek_name("quantity").is_some_and(|unit| SIGNED.contains(&&*unit));
        let length = fields.peek_integer("length").and_then(|n| u16::try_from(n).ok());
        Some((direction, natural_type(kind, length, signed)))
    }
}

/// The LEDs of a strip in an example.
const EXAMPLE_LEDS: u16 = 8;

/// The type that suits a part's only value; where bytes are counted, it has that many.
fn natural_type(kind: KindName, length: Option<u16>, signed: bool) -> ValueType {
    let word = kind.spec().natural;
    if kind.spec().values != Values::Any {
        return ValueType::scalar(word);
    }
    let word = if signed { ScalarType::Int16 } else { word };
    match length {
        None | Some(2) => ValueType::scalar(word),
        Some(1) => ValueType::scalar(ScalarType::Uint8),
        Some(4) => ValueType::scalar(ScalarType::Uint32),
        Some(even) if even % 2 == 0 => ValueType { scalar: word, length: Some(even / 2) },
        Some(bytes) => ValueType { scalar: ScalarType::Uint8, length: Some(bytes) },
    }
}

/// Units of quantities that can be negative.
const SIGNED: &[&str] = &["degC", "g", "deg/s", "m/s^2", "uT"];

/// The head of a device: `sensor NAME returns TYPE`, or an actuator's.
fn head_of_device(name: &str, direction: Direction, value: ValueType) -> String {
    match direction {
        Direction::Sensor => format!("sensor {name} returns {value}"),
        Direction::Actuator => format!("actuator {name} accepts {value}"),
    }
}

fn kinds(read: &ReadPart) -> Vec<KindName> {
    let mut kinds: Vec<KindName> = read.connections.iter().map(|one| one.kind.name()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds
}

fn values(read: &ReadPart) -> Vec<ValueFacts> {
    let via =
        |number: &crate::design::ConnectionIndex| read.connections.get(number.0)?.name.clone();
    let values = read.devices.iter().map(|device| ValueFacts {
        name: device.coding.reading.clone().filter(|name| !name.is_empty()),
        direction: device.direction,
        value: device.value.value,
        kind: device.kind.clone(),
        shown: device.shown.clone(),
        coding: device.coding.clone(),
        filter: device.filter.clone(),
        via: device.connections.iter().filter_map(via).collect(),
    });
    values.collect()
}

fn connections(read: &ReadPart) -> Vec<ConnectionFacts> {
    let connections = read.connections.iter().map(|one| ConnectionFacts {
        name: one.name.clone(),
        roles: one.kind.roles(one.direction),
        kind: one.kind.clone(),
        level: one.level,
    });
    connections.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_driver_is_found_by_what_it_is_for() {
        let all: Vec<&str> = names().collect();
        for line in search().lines().skip(1) {
            let (words, drivers) = line.split_once(',').unwrap_or_default();
            assert!(!words.is_empty() && words == words.to_lowercase(), "{line}");
            for driver in drivers.split(' ') {
                assert!(all.contains(&driver), "drivers/search.csv names {driver}, which is none");
            }
        }
        for driver in all {
            assert!(!words(driver).is_empty(), "{driver} is in no line of drivers/search.csv");
        }
    }
}
