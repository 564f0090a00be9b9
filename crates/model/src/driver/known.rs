//! What blocks can refer to: constants and drivers, handed from reader to reader.

use super::Drivers;
use crate::value::constants::Constants;

/// What blocks can refer to.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    pub(crate) constants: &'a Constants,
    pub(crate) drivers: &'a Drivers,
}
