//! A command that a world has the host send.
//!
//! In: a device, a time and a value. Out: the same, for who reads worlds, for the bench that keeps them, and for the
//! host that sends them.

use sensedsl_model::design::DeviceIndex;
use sensedsl_wire::Scalar;

/// A command that a world has the host send.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The actuator.
    pub device: DeviceIndex,
    /// The time of the command.
    pub at_ns: u64,
    /// The value as it is on the wire, one scalar for each element.
    pub value: Vec<Scalar>,
}
