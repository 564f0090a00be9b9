//! What a HAL says about inputs: edges, analog inputs, input capture, encoders.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Cycles;
use sensedsl_job::{JobConnection, Pad};
use sensedsl_model::kind::icu::Icu;

use crate::context::Context;
use crate::missing::Printed;
use crate::section::{Constructor, Section};

/// Digital inputs whose edges interrupt.
pub(crate) trait Edges {
    /// An input that sees its edges. The static `kept` is a `rt::contact::Watched` of a `rt::edges::InterruptInput`.
    fn watch(&self, context: &Context<'_>, input: &EdgeInput<'_>) -> Printed<Watch>;
}

/// A digital input whose edges count.
pub(crate) struct EdgeInput<'a> {
    pub(crate) wire: &'a JobConnection<'a>,
    pub(crate) pad: &'a Pad<'a>,
    /// The resistor: `Pull::Up`.
    pub(crate) pull: &'static str,
    /// The edges that must be seen: `Rising`, `Falling` or `Any`.
    pub(crate) trigger: &'static str,
    /// The static that keeps what was seen.
    pub(crate) kept: &'a str,
}

/// How an input sees its edges.
pub(crate) struct Watch {
    /// What the wiring hands over.
    pub(crate) made: Constructor,
    /// The pin whose level the static reads: what it begins with.
    pub(crate) begin: String,
    pub(crate) by: WatchedBy,
}

/// Who is woken by an edge.
pub(crate) enum WatchedBy {
    /// The project's handler of this interrupt, which several inputs may share.
    Handler(String),
    /// A task with the parameter `pin`, which does nothing but this statement.
    Task(String),
}

/// Analog inputs.
pub(crate) trait Analog {
    /// A converter, with its interrupt bound in the section where it has one.
    fn converter(
        &self,
        context: &Context<'_>,
        unit: &str,
        section: &mut Section,
    ) -> Printed<Constructor>;

    /// What a pin becomes so that a converter can read it.
    fn input(&self, context: &Context<'_>, unit: &str, pin: &PinName) -> Constructor;

    /// Where samples are while the task waits for them.
    fn room(&self) -> SampleRoom {
        SampleRoom::Task
    }

    /// Statements that fill the variable `samples` with all inputs in turn, as often as there is room. Each input's
    /// parameter is named after its wire, and its converter is locked.
    fn sample(&self, inputs: &[AnalogInput<'_>], sampling: Cycles, samples: &str) -> Vec<String>;

    /// The statement that reports a value, given the one that does so if all conversions succeeded. `constant` is that
    /// of the device's item.
    fn report(&self, _constant: &str, report: String) -> String {
        report
    }
}

/// Where the samples of a device are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SampleRoom {
    /// In a variable of the task, which reads converters and inputs by mutable references.
    Task,
    /// In a static that the task and an interrupt hand to each other.
    Interrupt,
}

/// An analog input of a task.
pub(crate) struct AnalogInput<'a> {
    pub(crate) wire: &'a JobConnection<'a>,
    /// The unit of its converter.
    pub(crate) unit: &'a str,
    /// The variable that has the locked converter.
    pub(crate) converter: String,
}

/// The loop over the samples in which each input is read once in each round. `read` makes the statement that reads an
/// input into a variable.
pub(crate) fn each_round(
    inputs: &[AnalogInput<'_>],
    samples: &str,
    read: impl Fn(&str, &AnalogInput<'_>) -> String,
) -> String {
    let names: Vec<String> = (0..inputs.len()).map(|at| format!("s{at}")).collect();
    let reads: Vec<String> =
        names.iter().zip(inputs).map(|(name, input)| read(name, input)).collect();
    format!("for [{}] in {samples}.as_chunks_mut().0 {{ {} }}", names.join(", "), reads.join(" "))
}

/// Input capture.
pub(crate) trait Capture {
    /// Hardware that counts the edges of an input by itself; `None` if a task must wait for them.
    fn counter(
        &self,
        _context: &Context<'_>,
        _input: &CaptureInput<'_>,
    ) -> Printed<Option<Counter>> {
        Ok(None)
    }

    /// A driver that a task waits with for edges. The task fills the static `{statics}_SEEN`, of a pulse train as
    /// `{statics}_TRAIN` says.
    fn waiting(
        &self,
        context: &Context<'_>,
        input: &CaptureInput<'_>,
        section: &mut Section,
    ) -> Printed<Waiting>;
}

/// An input whose edges are captured.
pub(crate) struct CaptureInput<'a> {
    pub(crate) wire: &'a JobConnection<'a>,
    pub(crate) icu: &'a Icu,
    /// What the statics of the wire begin with.
    pub(crate) statics: String,
    /// Whether a pulse train is read from it.
    pub(crate) is_train: bool,
}

/// A driver that a task waits with.
pub(crate) struct Waiting {
    /// What the wiring hands over.
    pub(crate) made: Constructor,
    /// The task's parameter, and its type in `main.rs`.
    pub(crate) parameter: &'static str,
    pub(crate) type_: String,
    /// The future that the task awaits, and that never ends.
    pub(crate) runs: String,
}

/// Encoders of two tracks.
pub(crate) trait Encoder {
    /// The hardware that counts the steps of an encoder.
    fn counter(
        &self,
        context: &Context<'_>,
        wire: &JobConnection<'_>,
        section: &mut Section,
    ) -> Printed<Counter>;
}

/// Hardware that counts by itself in 16 bits. Its driver has the method `count`.
pub(crate) struct Counter {
    /// What the wiring hands over.
    pub(crate) made: Constructor,
    /// What the driver is called behind the name of its wire: `qei`.
    pub(crate) suffix: &'static str,
    /// Its type in `main.rs`.
    pub(crate) type_: String,
}
