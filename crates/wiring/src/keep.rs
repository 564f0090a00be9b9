//! An earlier wiring, of which as much as possible should be kept.

use std::collections::BTreeMap;

/// Where each wire of an earlier answer was: by device and role, the board and the pin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Keep {
    wires: BTreeMap<(String, String), (String, String)>,
}

impl Keep {
    /// Adds a wire; everything is given by name.
    pub fn add(&mut self, device: &str, role: &str, board: &str, pin: &str) {
        self.wires.insert((device.into(), role.into()), (board.into(), pin.into()));
    }

    /// Whether a wire of the device would be somewhere else than before. A new wire does not count
    /// as moved.
    pub(crate) fn moves(&self, device: &str, role: &str, board: &str, pin: &str) -> bool {
        let before = self.wires.get(&(device.to_owned(), role.to_owned()));
        before.is_some_and(|(on, at)| on != board || at != pin)
    }
}
