//! What a HAL says about pins and outputs: GPIO, pulses of timers, voltages.

use sensedsl_board::pin::PinName;
use sensedsl_job::JobConnection;
use sensedsl_model::kind::pwm::Pwm;

use crate::context::{Context, Wired};
use crate::missing::Printed;
use crate::section::{Constructor, Field};

/// Pins and outputs of GPIO.
pub(crate) trait Pins {
    /// The HAL's name of a pin: `PA1`, or `PIN_1` of `GP1`.
    fn pin(&self, pin: &PinName) -> String;

    /// An `Output` that begins with a level, `Level::Low` or `Level::High`.
    fn output(&self, pin: &PinName, level: &str, speed: Speed) -> String;
}

/// How steep the edges of an output are, where a HAL can say that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Speed {
    Low,
    Medium,
}

/// Pulses that timers make.
pub(crate) trait Pulses {
    /// The timer with all its outputs, of which there is at least one.
    fn timer(&self, context: &Context<'_>, unit: &str, outputs: &[Output<'_>]) -> Printed<Timer>;

    /// The statement that gives an output a level in ten-thousandths, in a scope with `outputs`.
    fn set(&self, pulse: &Pulse, level: &str) -> String;

    /// The statement after new levels that lets the output's timer take them; `None` if it takes each by itself.
    fn apply(&self, _pulse: &Pulse) -> Option<String> {
        None
    }

    /// The statement that turns an output off within the period, so that what follows does not find the old level.
    fn stop(&self, pulse: &Pulse) -> String {
        self.set(pulse, "0")
    }
}

/// An element of a value on its channel.
pub(crate) struct Output<'a> {
    pub(crate) wired: Wired<'a>,
    /// The index of the element.
    pub(crate) at: usize,
    pub(crate) wire: &'a JobConnection<'a>,
    pub(crate) pin: &'a PinName,
    pub(crate) pwm: &'a Pwm,
    pub(crate) pulse: Pulse,
}

/// An output of a timer.
pub(crate) struct Pulse {
    /// The field of `Outputs` that has the timer.
    pub(crate) name: String,
    /// The HAL's name of the timer.
    pub(crate) timer: String,
    /// The number of the channel, from 1.
    pub(crate) channel: u8,
    /// Whether it is the complement of the channel.
    pub(crate) is_complement: bool,
    /// The length of the pulses for the levels 0 and 10,000.
    pub(crate) min_us: u32,
    pub(crate) max_us: u32,
    pub(crate) period_us: u32,
}

/// The outputs of a timer in the HAL's words.
pub(crate) struct Timer {
    /// The fields of `Outputs`.
    pub(crate) fields: Vec<Field>,
    /// How the outputs of an array change in the same period; `None` if [`Pulses::apply`] sees to it.
    pub(crate) hold: Option<Hold>,
}

/// The statements around the new levels of an array.
pub(crate) struct Hold {
    /// Keeps the timer from taking new levels.
    pub(crate) begin: String,
    /// Lets it take them.
    pub(crate) end: String,
}

/// Analog outputs of 12 bits.
pub(crate) trait Dac {
    /// A channel of a converter with its pin, where the other one is not in use.
    fn channel(&self, context: &Context<'_>, unit: &str, pin: &PinName) -> Constructor;

    /// Both channels of a converter with their pins, as a pair.
    fn channels(&self, context: &Context<'_>, unit: &str, pins: [&PinName; 2]) -> Constructor;

    /// The expression that sets it, in a scope with `outputs`. `field` is that of `Outputs`, `value` has at most 12
    /// bits.
    fn set(&self, field: &str, value: &str) -> String;
}
