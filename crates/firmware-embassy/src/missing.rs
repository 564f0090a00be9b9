//! What a device needs and does not have, so that there is no code for it. It is reported: no device is left out in
//! silence.

use sensedsl_board::signal::Function;
use sensedsl_model::kind::Role;

use sensedsl_job::{JobConnection, Pad};

/// What a device needs, and whose fault it is that it is missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Missing {
    what: String,
    whose: &'static str,
}

/// Code, or what is missing for it.
pub(super) type Printed<T> = Result<T, Missing>;

impl Missing {
    /// A name that the target profile does not have.
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

    /// Why there is no code for a part of that name.
    pub(super) fn why(&self, name: &str) -> String {
        format!("`{name}` needs {}, which {} does not have", self.what, self.whose)
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

/// The timer channel that a pad is on.
pub(super) fn channel(pad: &Pad<'_>) -> Printed<u8> {
    let function = pad.usage.map(|usage| usage.signal.function());
    let Some(Function::Timer { channel, .. }) = function else {
        return Err(Missing::wire(format!("a channel of a timer at {}", pad.pin.name)));
    };
    Ok(*channel)
}

/// The output of a digital-analog converter that a pad is on.
pub(super) fn converter_output(pad: &Pad<'_>) -> Printed<u8> {
    let function = pad.usage.map(|usage| usage.signal.function());
    let Some(Function::Dac { channel, .. }) = function else {
        return Err(Missing::wire(format!("an output of a converter at {}", pad.pin.name)));
    };
    Ok(*channel)
}

/// The settings of a connection's kind.
pub(super) fn kind<T>(settings: Option<T>) -> Printed<T> {
    settings.ok_or_else(|| Missing::wire("a connection of its kind".to_owned()))
}
