//! What each property of the language means: where it stands, what it takes, what it is without it, in words.
//!
//! In: a block and the kinds of what is in it. Out: the properties that it may have, for an editor, a page or a
//! message. Properties of one kind are described in the file of the kind. A test holds every entry to the reader: what
//! is read is described, what is described is read, and ranges and words are those of the reader.

mod boards;
mod control;
mod devices;
mod drivers;
mod entry;
mod takes;

use sensedsl_wire::Direction;

use crate::kind::{KindName, Values};
use crate::part::chip::{CHIP, OF_DEVICE, PLACED};
use crate::part::coding::{CODING, FILTER, PROTOCOL};
use crate::part::properties::{COMMON_PROPERTIES, PRESENTATION};
use crate::part::stranger;
use crate::rule;

pub use crate::test::words::{FUNCTIONS, STATES};
pub use entry::Meaning;
pub(crate) use entry::{REQUIRED, first};
pub use takes::Takes;

/// A block that properties stand in, with the kinds of what they are about and the direction of its value.
#[derive(Clone, Copy, Debug)]
pub enum Block<'a> {
    /// A board.
    Board,
    /// A board's link.
    Link,
    /// A device by itself, and its kind if that is known.
    Device(Option<KindName>, Direction),
    /// A device by itself that is one value of a driver, whose connections have these kinds.
    Value(&'a [KindName], Direction),
    /// A chip.
    Chip(&'a [KindName]),
    /// A device of a chip.
    OfChip(Direction),
    /// A connection, of a driver or of a chip.
    Connection(KindName),
    /// A driver.
    Driver(&'a [KindName]),
    /// A reading or command of a driver.
    OfDriver(&'a [KindName], Direction),
    /// A controller.
    Controller,
    /// A test.
    Test,
    /// A rule `prefer` or `avoid`.
    Wish,
}

/// The properties that every device has and that a driver can state for it.
const GIVEN: &[&str] = &["delay", "prio", "group", "level", "divider"];
/// Where the wires of a connection are, and what is on them.
const OF_CONNECTION: &[&str] = &["unit", "side", "header", "level", "divider"];
/// How values are coded where no driver names them.
const OF_NAMED_VALUES: &[&str] = &["via", "output", "drive", "initial"];

impl Block<'_> {
    /// The properties that may stand in it, each once: those of a kind first.
    #[must_use]
    pub fn properties(self) -> Vec<&'static Meaning> {
        let kinds: &[KindName] = match &self {
            Self::Device(kind, _) => kind.as_slice(),
            Self::Connection(kind) => std::slice::from_ref(kind),
            Self::Chip(kinds)
            | Self::Value(kinds, _)
            | Self::Driver(kinds)
            | Self::OfDriver(kinds, _) => kinds,
            Self::Board
            | Self::Link
            | Self::OfChip(_)
            | Self::Controller
            | Self::Test
            | Self::Wish => &[],
        };
        let mut found: Vec<&'static Meaning> = Vec::new();
        let of_kinds = kinds.iter().flat_map(|kind| of_kind(*kind));
        let way = self.direction();
        for meaning in of_kinds.chain(self.others(kinds)) {
            let suits = meaning.only.is_none_or(|only| way.is_none_or(|way| way == only));
            if suits && found.iter().all(|known| known.name != meaning.name) {
                found.push(meaning);
            }
        }
        found
    }

    /// A property of the block by its name.
    #[must_use]
    pub fn property(self, name: &str) -> Option<&'static Meaning> {
        self.properties().into_iter().find(|meaning| meaning.name == name)
    }

    const fn direction(self) -> Option<Direction> {
        match self {
            Self::Device(_, way)
            | Self::Value(_, way)
            | Self::OfChip(way)
            | Self::OfDriver(_, way) => Some(way),
            Self::Board
            | Self::Link
            | Self::Chip(_)
            | Self::Connection(_)
            | Self::Driver(_)
            | Self::Controller
            | Self::Test
            | Self::Wish => None,
        }
    }

    /// The properties that are not of a kind.
    fn others(self, kinds: &[KindName]) -> Vec<&'static Meaning> {
        let is_coded = kinds.iter().any(|kind| kind.spec().values == Values::Any);
        let suits = |name: &&&str| kinds.iter().any(|kind| stranger::is_for(name, *kind));
        let coding = CODING.iter().filter(|_| is_coded).filter(suits);
        let protocol = PROTOCOL.iter().filter(suits);
        let shown = PRESENTATION.iter().chain(FILTER);
        match self {
            Self::Board => boards::BOARD.iter().collect(),
            Self::Link => boards::LINK.iter().collect(),
            Self::Device(..) => {
                let coding = coding.filter(|name| !OF_NAMED_VALUES.contains(name));
                named(COMMON_PROPERTIES.iter().chain(shown).chain(coding).chain(&["failsafe"]))
            }
            Self::Value(..) => {
                named(CHIP.iter().chain(PLACED).chain(OF_DEVICE).chain(shown).chain(protocol))
            }
            Self::Chip(_) => named(CHIP.iter().chain(PLACED).chain(protocol)),
            Self::OfChip(_) => named(OF_DEVICE.iter().chain(shown)),
            Self::Connection(_) => named(OF_CONNECTION.iter()),
            Self::Driver(_) => {
                let about = drivers::ABOUT.iter();
                let given = GIVEN.iter().chain(protocol).chain(shown).chain(coding);
                about.chain(named(given)).collect()
            }
            Self::OfDriver(..) => named(
                ["delay", "prio", "group"].iter().chain(shown).chain(CODING.iter().filter(suits)),
            ),
            Self::Controller => {
                let one = |name: &&str| {
                    control::CONTROLLER.iter().chain(general()).find(|one| one.name == *name)
                };
                crate::control::PROPERTIES.iter().filter_map(one).collect()
            }
            Self::Test => control::TEST.iter().collect(),
            Self::Wish => named(rule::wishes().collect::<Vec<_>>().iter()),
        }
    }
}

/// The properties of a kind, in the order of its list; those that fix its wires are the same for all kinds.
#[must_use]
pub fn of_kind(kind: KindName) -> Vec<&'static Meaning> {
    let own = kind.meanings();
    let one = |name: &&str| own.iter().chain(devices::WIRES).find(|meaning| meaning.name == *name);
    kind.spec().properties.iter().filter_map(one).collect()
}

/// The properties with these names that are not of one kind.
fn named<'n>(names: impl Iterator<Item = &'n &'n str>) -> Vec<&'static Meaning> {
    let one = |name: &&str| general().find(|meaning| meaning.name == *name);
    names.filter_map(one).collect()
}

/// All properties of devices, chips and drivers that are not of one kind.
fn general() -> impl Iterator<Item = &'static Meaning> {
    let of_devices = devices::COMMON.iter().chain(devices::SHOWN).chain(devices::FILTER);
    let of_drivers = drivers::CODING.iter().chain(drivers::PROTOCOL).chain(drivers::ABOUT);
    of_devices.chain(devices::WIRES).chain(of_drivers)
}

#[cfg(test)]
mod tests;
