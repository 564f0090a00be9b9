//! The certificate as it is in the file. Everything is identified by name.
//!
//! All numbers have 32 bits, so that no sum of products of three of them overflows the 128 bits in
//! which they are added up. Unknown fields and duplicate names are refused.

use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;

/// Name and version of the format.
pub const NAME: &str = "SenseDSL certificate 4";

/// Things by name, without duplicates.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Map<T>(BTreeMap<String, T>);

impl<T> Default for Map<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T> Deref for Map<T> {
    type Target = BTreeMap<String, T>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, T> IntoIterator for &'a Map<T> {
    type Item = (&'a String, &'a T);
    type IntoIter = std::collections::btree_map::Iter<'a, String, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Map<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Names<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Names<T> {
            type Value = Map<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Map<T>, A::Error> {
                let mut map = BTreeMap::new();
                while let Some((name, one)) = entries.next_entry::<String, T>()? {
                    if map.contains_key(&name) {
                        return Err(Error::custom(format_args!("{name:?} stands there twice")));
                    }
                    map.insert(name, one);
                }
                Ok(Map(map))
            }
        }
        deserializer.deserialize_map(Names(PhantomData))
    }
}

/// A whole certificate.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`NAME`].
    pub format: String,
    /// The sources from which the problem was made.
    pub subject: Subject,
    /// The problem that was solved.
    pub problem: Problem,
    /// The claim; `null` claims that there is no wiring.
    #[serde(deserialize_with = "stated")]
    pub answer: Option<Answer>,
    /// The proof: the record of a search.
    pub search: Search,
}

/// A value that may be `null`, but not left out.
fn stated<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(from)
}

/// The sources from which the problem was made; the hashes are SHA-256 in lower-case hexadecimal.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// The program that made it, with its version.
    pub tool: String,
    /// The options of its call that change the problem.
    pub options: Map<String>,
    /// The hash of each file that was read, by the name that the design gives it.
    pub files: Map<String>,
    /// The hash of each built-in text, by the arguments with which the program prints it.
    pub built_in: Map<String>,
}

/// The problem that was solved.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// Boards; true for a spare one, which counts if a device is on it.
    pub boards: Map<bool>,
    /// Pins, each with the cost of using it.
    pub pins: Map<u32>,
    /// Pins that something else is on, too.
    pub shared: BTreeSet<String>,
    /// Peripherals that need DMA streams: for each request, the streams that can serve it.
    pub dma: Map<Vec<BTreeSet<String>>>,
    /// Devices; each takes one of its alternatives.
    pub devices: Map<Map<Alternative>>,
}

/// One way to connect a device.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alternative {
    /// The board that it is on.
    pub board: String,
    /// Resources taken, each with its holder: [`OWN`], or the purpose for which several devices
    /// take it.
    #[serde(default)]
    pub claims: Map<String>,
    /// Soft rules violated.
    #[serde(default)]
    pub violates: BTreeSet<String>,
    /// Peripherals whose DMA requests have to be served.
    #[serde(default)]
    pub dma: BTreeSet<String>,
    /// The wires; each takes one of its candidates.
    #[serde(default)]
    pub roles: Map<Map<Candidate>>,
}

/// One way to connect a wire.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Candidate {
    /// The pin.
    pub pin: String,
    /// [`OWN`], or the purpose for which several devices hold the pin.
    #[serde(default = "own")]
    pub holder: String,
    /// The pin's function; devices that hold a pin together must agree on it.
    pub signal: String,
    /// Further resources taken, each with its holder.
    #[serde(default)]
    pub claims: Map<String>,
    /// Soft rules violated.
    #[serde(default)]
    pub violates: BTreeSet<String>,
    /// Whether the wire differs from the wiring that was to be kept.
    #[serde(default)]
    pub moved: bool,
}

/// The holder of whatever a device has for itself.
pub const OWN: &str = "own";

fn own() -> String {
    OWN.to_owned()
}

/// The claim: this wiring, with this objective, is the best.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The objective of the wiring.
    pub objective: Objective,
    /// The choice of each device.
    pub wiring: Map<Choice>,
    /// For each peripheral in use, the streams of its requests.
    pub streams: Map<Vec<String>>,
}

/// The choice of a device.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// The alternative.
    pub takes: String,
    /// The candidate for each of its roles.
    pub wires: Map<String>,
}

/// The objective.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Objective {
    /// Pins whose wires moved.
    pub moved: u32,
    /// Soft rules violated.
    pub violated: u32,
    /// Shared pins used.
    pub shared: u32,
    /// Sum of the costs of the pins used.
    pub cost: u32,
    /// Spare boards used.
    pub spares: u32,
}

impl Objective {
    /// The parts, the most important first.
    pub(crate) const fn parts(self) -> [u32; 5] {
        [self.moved, self.violated, self.shared, self.cost, self.spares]
    }
}

impl fmt::Display for Objective {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { moved, violated, shared, cost, spares } = self;
        write!(f, "moved {moved}, violated {violated}, shared {shared}, ")?;
        write!(f, "cost {cost}, spares {spares}")
    }
}

/// Numbers in a row; those that belong together are adjacent.
pub type Row = Vec<u64>;

/// The record of a search that no wiring weighs less than the answer, or that there is none.
///
/// Boards, pins, users of DMA, devices, their alternatives, the roles of these and their candidates
/// are identified by their place in the order of names; so are all resources and holders that are
/// claimed, rules that are violated, and streams. The holder `own` is 0.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Search {
    /// The weight of each part of the objective.
    pub weights: [u64; 5],
    /// Things that are opened once for all their users.
    pub facilities: Vec<Facility>,
    /// Sets of facilities of which a minimum number must be open.
    pub covers: Vec<Cover>,
    /// Boards and devices that can change places.
    pub swaps: Vec<Swap>,
    /// The cases, depth first.
    pub steps: Vec<Step>,
}

/// Something that is opened once for all who use it together.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Facility {
    /// Device, alternative: a device that takes one of these uses the facility.
    pub members: Row,
    /// The resource that it occupies, if any.
    pub resource: Option<u64>,
    /// For each wire that its members hold together, the role of every member.
    pub wires: Vec<Row>,
    /// The users of DMA whose streams it needs.
    pub users: Row,
    /// Resources that only one member at a time can hold.
    pub slots: Row,
}

/// Facilities of which a minimum number must be open because these devices have no room otherwise.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cover {
    /// The devices.
    pub devices: Row,
    /// The facilities of which `need` must be open.
    pub great: Row,
    /// The other facilities that these devices can use.
    pub small: Row,
    /// How many of `great` must be open.
    pub need: u64,
}

/// Things that change places, in pairs. Anything that is not named stays.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Swap {
    /// Boards.
    pub boards: Row,
    /// Pins.
    pub pins: Row,
    /// Resources.
    pub resources: Row,
    /// Holders.
    pub holders: Row,
    /// Users of DMA.
    pub users: Row,
    /// Streams.
    pub streams: Row,
    /// Rules.
    pub rules: Row,
    /// Devices; each alternative changes places with the one at the same position.
    pub devices: Row,
    /// Device, and two of its alternatives.
    pub ways: Row,
}

/// A step of a search.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Step {
    /// Nothing is left.
    Dead,
    /// Everything that is left weighs too much.
    Closed(By),
    /// Everything that weighs too much is removed. The next step is about the rest.
    Narrowed(By),
    /// Two cases: the next steps assume that the question is answered with yes, the steps after
    /// them that it is answered with no.
    Split {
        /// The question.
        on: Question,
        /// Swaps that keep the case, so that the questions into which they turn this one are as
        /// good.
        #[serde(default)]
        swaps: Row,
    },
}

/// A choice that is taken or refused.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Question {
    /// Device, alternative.
    Way(u64, u64),
    /// Device, alternative, role, candidate.
    Wire(u64, u64, u64, u64),
    /// No device violates the rule.
    Kept(u64),
    /// No device is on the board.
    Unused(u64),
    /// At least one device uses the facility.
    Open(u64),
}

/// Multipliers: the prices of everything; see the module `search::price`.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct By {
    /// How many units of these prices make a unit of weight.
    pub scale: u64,
    /// Pin, its price beyond its weight.
    pub pins: Row,
    /// Resource, its price.
    pub resources: Row,
    /// Stream, its price.
    pub streams: Row,
    /// Facility, device, the price that the device pays to it.
    pub links: Row,
    /// Facility, resource, the price that the member that holds it for itself pays to the facility.
    pub tickets: Row,
    /// Rule, device, 0 or the role plus 1, the price of violating the rule there.
    pub rules: Row,
    /// Cover, the amount that each of its facilities saves.
    pub covers: Row,
}
