//! The changes on the bench from one wiring to another: two answers in JSON in, the changes out.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::columns::table;

/// A wire of a device.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wire {
    /// The device's name.
    pub device: String,
    /// The name of its role.
    pub role: String,
}

/// The place of a wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The board's name.
    pub board: String,
    /// The pin.
    pub pin: String,
    /// The signal that it carries.
    pub signal: String,
}

/// A wire that has changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The wire.
    pub wire: Wire,
    /// Its old place; `None` if the wire is new.
    pub from: Option<Place>,
    /// Its new place; `None` if the wire is gone.
    pub to: Option<Place>,
}

impl Change {
    /// The change to make: `added`, `removed`, `reconfigured` or `moved`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match (&self.from, &self.to) {
            (None, _) => "added",
            (Some(_), None) => "removed",
            (Some(from), Some(to)) if (&from.board, &from.pin) == (&to.board, &to.pin) => {
                "reconfigured"
            }
            (Some(_), Some(_)) => "moved",
        }
    }

    /// The change as JSON, for scripts.
    #[must_use]
    pub fn value(&self) -> Value {
        let place = |place: &Option<Place>| {
            place.as_ref().map(|Place { board, pin, signal }| {
                json!({ "board": board, "pin": pin, "signal": signal })
            })
        };
        json!({
            "change": self.name(),
            "device": self.wire.device,
            "role": self.wire.role,
            "from": place(&self.from),
            "to": place(&self.to),
        })
    }
}

/// The wires of an answer of `solve`; `None` if it lacks boards, devices or wires.
#[must_use]
pub fn wires(answer: &Value) -> Option<BTreeMap<Wire, Place>> {
    let mut wires = BTreeMap::new();
    let text = |value: &Value, key: &str| Some(value.get(key)?.as_str()?.to_owned());
    for board in answer.get("boards")?.as_array()? {
        let board_name = text(board, "name")?;
        for device in board.get("devices")?.as_array()? {
            let name = text(device, "name")?;
            for wire in device.get("wires")?.as_array()? {
                let (pin, signal) = (text(wire, "pin")?, text(wire, "signal")?);
                let place = Place { board: board_name.clone(), pin, signal };
                wires.insert(Wire { device: name.clone(), role: text(wire, "role")? }, place);
            }
        }
    }
    Some(wires)
}

/// The wires that differ, in the order of their devices' names.
#[must_use]
pub fn changes(old: &BTreeMap<Wire, Place>, new: &BTreeMap<Wire, Place>) -> Vec<Change> {
    let all: BTreeSet<&Wire> = old.keys().chain(new.keys()).collect();
    let change = |wire: &Wire| Change {
        wire: wire.clone(),
        from: old.get(wire).cloned(),
        to: new.get(wire).cloned(),
    };
    all.into_iter().map(change).filter(|change| change.from != change.to).collect()
}

/// The changes, as `sensedsl diff --format json` prints them.
#[must_use]
pub fn value(changes: &[Change]) -> Value {
    let list: Vec<Value> = changes.iter().map(Change::value).collect();
    json!({ "version": 1, "changes": list })
}

/// The changes as a table, with their number among all wires.
#[must_use]
pub fn human(changes: &[Change], wires: usize) -> String {
    if changes.is_empty() {
        return "nothing changes\n".to_owned();
    }
    let places = changes.iter().flat_map(|change| [&change.from, &change.to]).flatten();
    let boards: BTreeSet<&str> = places.map(|place| place.board.as_str()).collect();
    let place = |place: &Option<Place>| match place {
        None => "-".to_owned(),
        Some(Place { pin, signal, .. }) if boards.len() == 1 => format!("{pin} ({signal})"),
        Some(Place { board, pin, signal }) => format!("{board} {pin} ({signal})"),
    };
    let rows: Vec<[String; 5]> = changes
        .iter()
        .map(|change| {
            let Change { wire, from, to } = change;
            let (device, role) = (wire.device.clone(), wire.role.clone());
            [change.name().to_owned(), device, role, place(from), place(to)]
        })
        .collect();
    let heads = ["Change", "Device", "Role", "From", "To"];
    let text = table(heads, &rows);
    format!("{text}\n{} of {wires} wires change\n", changes.len())
}
