//! Names of pins in a design: the file's spelling, and the pin of each board that it was bound to.

use sensedsl_board::pin::PinName;

use super::index::BoardIndex;

/// A pin, as the file names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PinRef {
    /// The name as it is written.
    pub spelled: String,
    /// For each board that has such a pin, which pin it is; in the order of the boards.
    pub(crate) on: Vec<(BoardIndex, PinName)>,
}

impl PinRef {
    /// A name that does not stand for any pin yet.
    pub(crate) fn unbound(spelled: &str) -> Self {
        Self { spelled: spelled.to_owned(), on: Vec::new() }
    }

    /// A pin of one board.
    #[must_use]
    pub fn of_board(board: BoardIndex, pin: PinName) -> Self {
        Self { spelled: pin.to_string(), on: vec![(board, pin)] }
    }

    /// The MCU's name for the first pin that it stands for; as it is written if there is none.
    #[must_use]
    pub fn name(&self) -> &str {
        self.on.first().map_or(&self.spelled, |(_, pin)| pin.as_str())
    }

    /// Formats it for people: `PA5`, or `PA5 (D13)` if the file uses another name.
    #[must_use]
    pub fn shown(&self) -> String {
        let name = self.name();
        if PinName::parse(&self.spelled).is_some_and(|pin| pin.as_str() == name) {
            return name.to_owned();
        }
        format!("{name} ({})", self.spelled)
    }

    /// The pin on a board.
    #[must_use]
    pub fn on(&self, board: BoardIndex) -> Option<&PinName> {
        self.on.iter().find(|(index, _)| *index == board).map(|(_, pin)| pin)
    }
}
