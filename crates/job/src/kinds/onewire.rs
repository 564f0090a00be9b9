//! Wires with 1-Wire parts or one of the DHT22's sort: which parts are on each, and by what number.

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_model::design::PartIndex;
use sensedsl_model::kind::{KindName, Role};

use crate::{BoardJob, JobConnection, Pad};

/// A wire with the parts on it.
#[derive(Clone, Debug)]
pub struct Wire<'a> {
    /// The pad, which all of them have.
    pub pad: &'a Pad<'a>,
    /// The connections, in the design's order. A part's number is its place here.
    pub all: Vec<&'a JobConnection<'a>>,
}

impl Wire<'_> {
    /// The name of the wire in code and for threads: `Wire PA1`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("Wire {}", self.pad.pin.name)
    }

    /// The names of the connections, for a comment.
    #[must_use]
    pub fn titles(&self) -> String {
        self.all.iter().map(|one| one.title.as_str()).collect::<Vec<_>>().join(", ")
    }
}

/// The wires of a board, by pin.
#[must_use]
pub fn wires<'a>(job: &'a BoardJob<'a>) -> Vec<Wire<'a>> {
    let mut wires: BTreeMap<&PinName, Wire<'a>> = BTreeMap::new();
    for one in job.connections(KindName::OneWire) {
        let Some(pad) = one.pad(Role::Data) else { continue };
        let new = || Wire { pad, all: Vec::new() };
        wires.entry(&pad.pin.name).or_insert_with(new).all.push(one);
    }
    wires.into_values().collect()
}

/// The number of a part on its wire.
#[must_use]
pub fn number_of(job: &BoardJob<'_>, part: PartIndex) -> Option<u8> {
    let wires = wires(job);
    let number = |wire: &Wire<'_>| wire.all.iter().position(|one| one.connection.part == part);
    wires.iter().find_map(number).and_then(|number| u8::try_from(number).ok())
}
