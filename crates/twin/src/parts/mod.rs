//! What is behind a board's pins: parts that answer as the library's drivers describe them, with the world's values.

pub(crate) mod can;
pub(crate) mod formula;
pub(crate) mod line;
pub(crate) mod message;
pub(crate) mod pulses;
pub(crate) mod ranges;
pub(crate) mod registers;
pub(crate) mod sleep;
pub(crate) mod waits;
pub(crate) mod words;
