//! The parts behind a board's pins, which answer with the world's values as the library's drivers describe.

pub(crate) mod can;
pub(crate) mod dialogue;
pub(crate) mod formula;
pub(crate) mod lamps;
pub(crate) mod letters;
pub(crate) mod line;
pub(crate) mod message;
pub(crate) mod onewire;
pub(crate) mod pulses;
pub(crate) mod ranges;
pub(crate) mod registers;
pub(crate) mod screen;
pub(crate) mod sleep;
pub(crate) mod waits;
pub(crate) mod words;
