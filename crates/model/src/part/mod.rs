//! Parts: the blocks of devices and chips in; what is bought, with its devices, its wires and the bytes of its values,
//! out.

pub(crate) mod block;
pub(crate) mod chip;
pub(crate) mod coding;
pub(crate) mod device;
pub(crate) mod frames;
pub mod given;
pub(crate) mod ids;
pub(crate) mod placement;
pub(crate) mod properties;
pub mod reach;
pub mod registers;
pub(crate) mod serial;
pub(crate) mod stranger;
pub mod words;
