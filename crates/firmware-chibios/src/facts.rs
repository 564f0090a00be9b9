//! The facts about a board in the ChibiOS tree: the group `[system.chibios]` of its `board.toml`.

use std::collections::BTreeMap;

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use serde::{Deserialize, Deserializer};

/// The name of the target, after which its part of a board's file is named.
pub(crate) const NAME: &str = "chibios";

/// The facts about a board. Paths are relative to the tree.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Facts {
    /// The folder below `os/hal/boards`.
    pub board: String,
    /// The demo whose configuration is the base.
    pub demo: String,
    /// The folder of the configuration below the demo.
    pub cfg: String,
    /// The linker script.
    pub ldscript: String,
    /// The stack sizes of the main thread and of interrupts, if the usual ones are too large.
    pub stacks_bytes: Option<[u32; 2]>,
    /// The macro with which the configuration identifies its MCU.
    pub mcuconf: String,
    /// Macros that the files of the tree need.
    #[serde(default)]
    pub defines: Vec<String>,
    /// Macros in which the board's folder and the demo's configuration are wrong for this board, with the right values;
    /// empty for one that must not be defined.
    #[serde(default)]
    pub changes: BTreeMap<String, String>,
    /// Pins that the folder sets up as outputs and that are free on this board.
    #[serde(default, deserialize_with = "pins")]
    pub released: Vec<PinName>,
    /// The frequencies of the configuration's clock tree, by macro.
    #[serde(skip)]
    pub clocks_hz: BTreeMap<String, u32>,
}

impl Facts {
    /// The facts about a board; `None` if the tree has none.
    ///
    /// # Errors
    ///
    /// If the board's file is damaged; tests rule that out for the built-in ones.
    pub fn of(board: &catalog::Board) -> Result<Option<Self>, String> {
        let Some(facts) = board.system.get(NAME) else { return Ok(None) };
        let own =
            facts.own.clone().try_into::<Self>().map_err(|error| error.message().to_owned())?;
        Ok(Some(Self { clocks_hz: facts.clocks_hz.clone(), ..own }))
    }
}

fn pins<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PinName>, D::Error> {
    let names = Vec::<String>::deserialize(deserializer)?;
    let pin = |name: &String| {
        PinName::parse(name).ok_or_else(|| serde::de::Error::custom(format!("`{name}` is no pin")))
    };
    names.iter().map(pin).collect()
}

#[cfg(test)]
mod tests {
    use sensedsl_board::catalog;

    use super::Facts;

    #[test]
    fn the_facts_of_every_board_are_sound() {
        let mut count = 0;
        for entry in catalog::all() {
            let facts = Facts::of(&entry.board().unwrap());
            count += usize::from(
                facts.unwrap_or_else(|error| panic!("{}: {error}", entry.name)).is_some(),
            );
        }
        assert!(count > 70, "{count}");
    }

    #[test]
    fn an_unknown_word_is_refused() {
        let mut board = catalog::find("STM32F407G-DISC1").unwrap().board().unwrap();
        board.system.get_mut("chibios").unwrap().own.insert("nonsense".to_owned(), true.into());
        assert!(Facts::of(&board).unwrap_err().contains("nonsense"));
    }
}
