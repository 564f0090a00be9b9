//! What a HAL says about stepper motors: a timer that makes one pulse at a time, with an interrupt after each.

use sensedsl_job::JobConnection;

use crate::context::Context;
use crate::missing::Printed;
use crate::section::Constructor;

/// Stepper motors. The HAL's folder in `sense-embassy` has a module `stepper`.
pub(crate) trait Motors {
    /// The timer of a motor.
    fn timer(&self, context: &Context<'_>, wire: &JobConnection<'_>) -> Printed<MotorTimer>;
}

/// The timer of a motor in the HAL's words.
pub(crate) struct MotorTimer {
    /// What the wiring hands over.
    pub(crate) made: Constructor,
    /// The number of the channel, from 1.
    pub(crate) channel: u8,
    /// The interrupt at the end of its period.
    pub(crate) interrupt: String,
}
