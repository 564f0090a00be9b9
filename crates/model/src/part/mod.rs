//! Parts: the blocks of a file in, what is bought with its devices and its wires out, with what is said about its bytes.

pub(crate) mod block;
pub(crate) mod chip;
pub(crate) mod coding;
pub(crate) mod device;
pub(crate) mod frames;
pub mod given;
pub(crate) mod ids;
pub(crate) mod placement;
pub(crate) mod properties;
pub mod protocol;
pub mod reach;
pub mod registers;
pub mod words;
