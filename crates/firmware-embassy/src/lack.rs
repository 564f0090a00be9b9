//! What no code can be made of because something is missing. It is told, so that no device is left out in silence.

use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_model::design::Part;
use sensedsl_model::kind::Role;

use super::context::Context;
use sensedsl_job::{JobConnection, Pad};

/// What a device needs, and who does not have it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Missing {
    what: String,
    whose: &'static str,
}

/// What code is made of, or what is missing for it.
pub(super) type Printed<T> = Result<T, Missing>;

impl Missing {
    /// A name that the target's profile does not have.
    pub(super) fn name(what: String) -> Self {
        Self { what, whose: "its target profile" }
    }

    /// Something that the wiring does not give.
    pub(super) fn wire(what: String) -> Self {
        Self { what, whose: "its wiring" }
    }

    /// Something that the unit cannot make.
    pub(super) fn unit(what: String) -> Self {
        Self { what, whose: "its unit" }
    }

    /// Something that the part's tables do not have.
    pub(super) fn table(what: &str) -> Self {
        Self { what: what.to_owned(), whose: "its part" }
    }
}

impl Context<'_> {
    /// Tells what is missing for a part.
    pub(super) fn tell(&self, part: &Part, made: Printed<()>, diagnostics: &mut Vec<Diagnostic>) {
        let Err(Missing { what, whose }) = made else { return };
        let (name, board) = (&part.name, &self.job.board.name.value);
        let why = format!("`{}` needs {what}, which {whose} does not have", name.value);
        let report = e0504_no_firmware_target::no_firmware_target(name.span, board, &why);
        // All wires of a chip or an array have one thing to say.
        if diagnostics.last() != Some(&report) {
            diagnostics.push(report);
        }
    }

    /// The interrupt of a unit, a DMA channel or a line.
    pub(super) fn interrupt(&self, unit: &str, signal: &str) -> Printed<&str> {
        let found = self.names.interrupt(unit, signal);
        found.ok_or_else(|| Missing::name(format!("the interrupt of {unit} ({signal})")))
    }
}

/// The unit of a connection.
pub(super) fn unit<'a>(wire: &JobConnection<'a>) -> Printed<&'a str> {
    wire.unit.ok_or_else(|| Missing::wire("a unit".to_owned()))
}

/// The pad of a role.
pub(super) fn pad<'w, 'a>(wire: &'w JobConnection<'a>, role: Role) -> Printed<&'w Pad<'a>> {
    wire.pad(role).ok_or_else(|| Missing::wire(format!("a pin for `{}`", role.name())))
}

/// The channel of a timer that a pad is on.
pub(super) fn channel(pad: &Pad<'_>) -> Printed<u8> {
    let function = pad.usage.map(|usage| usage.signal.function());
    let Some(Function::Timer { channel, .. }) = function else {
        return Err(Missing::wire(format!("a channel of a timer at {}", pad.pin.name)));
    };
    Ok(*channel)
}

/// The settings of a connection's kind.
pub(super) fn kind<T>(settings: Option<T>) -> Printed<T> {
    settings.ok_or_else(|| Missing::wire("a connection of its kind".to_owned()))
}
