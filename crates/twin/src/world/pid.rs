//! What stands in for the code of controllers, as a world describes it.

use sensedsl_model::Expression;
use sensedsl_model::design::DeviceIndex;

/// What stands in for the code of a controller.
#[derive(Clone, Debug, PartialEq)]
pub struct StandIn {
    /// The device that the controller is to its host.
    pub controller: DeviceIndex,
    /// What it sets.
    pub loops: Vec<Pid>,
}

/// A PID controller of one output. Errors are in the unit of what is measured, outputs in that of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct Pid {
    /// The device that is set.
    pub device: DeviceIndex,
    /// Its element.
    pub element: usize,
    /// What is measured, and what it should be; `None` if only the feedforward counts.
    pub error: Option<(Expression, Expression)>,
    /// Output for each unit of error.
    pub kp: f64,
    /// Output for each unit of error and second.
    pub ki: f64,
    /// Output for each unit of error a second.
    pub kd: f64,
    /// What is added to the output.
    pub feedforward: Option<Expression>,
    /// The least and the greatest output.
    pub range: (f64, f64),
}
