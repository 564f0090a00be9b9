//! One board with everything that its sections are planned from.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{TargetProfile, Timer};
use sensedsl_board::signal::Function;
use sensedsl_job::{BoardJob, JobConnection, JobDevice, Pad};
use sensedsl_model::kind::{KindName, Role};

use crate::names::{BoardNames, Names};

/// One board and what its plan is made from.
pub(crate) struct Context<'a> {
    pub(crate) job: &'a BoardJob<'a>,
    pub(crate) profile: &'a TargetProfile,
    pub(crate) names: Names,
    /// The clock of MCU and timers, in hertz.
    pub(crate) cpu_hz: u32,
}

impl<'a> Context<'a> {
    /// `None` if [`super::Arduino`] refuses the board.
    pub(crate) fn new(job: &'a BoardJob<'a>) -> Option<Self> {
        let profile = job.profile?;
        let mut names = Names::of(profile).ok()?;
        if let Some(facts) = job.board.facts.as_ref().filter(|_| job.board.built_in) {
            names.board = BoardNames::of(facts).ok()?.unwrap_or(names.board);
        }
        let cpu_hz = profile.clocks_hz.get("CPU").copied()?;
        Some(Self { job, profile, names, cpu_hz })
    }

    /// The devices of a kind, each with its connections.
    pub(crate) fn devices(
        &self,
        kind: KindName,
    ) -> impl Iterator<Item = (&'a JobDevice<'a>, Vec<&'a JobConnection<'a>>)> {
        let job = self.job;
        let of_kind = move |one: &&JobDevice<'_>| one.device.kind.name() == kind;
        job.devices.iter().filter(of_kind).map(move |device| (device, job.wires_of(device.device)))
    }

    /// The framework's number of the pin at a wire.
    pub(crate) fn number(&self, wire: &JobConnection<'_>, role: Role) -> Option<u8> {
        self.names.number(&wire.pad(role)?.pin.name)
    }

    /// The timer and the channel that a pad carries.
    pub(crate) fn channel(&self, pad: &Pad<'_>) -> Option<(&'a Timer, u8)> {
        let Function::Timer { unit, channel, .. } = pad.usage?.signal.function() else {
            return None;
        };
        Some((self.profile.timer(unit.as_str())?, *channel))
    }
}

/// The level of a pin in C: `(PIND & 0x04U) != 0U`.
pub(crate) fn level(pin: &PinName) -> String {
    let (port, mask) = port_and_mask(pin);
    format!("(PIN{port} & {mask}) != 0U")
}

/// The letter of a pin's port, and its bit as a mask.
pub(crate) fn port_and_mask(pin: &PinName) -> (char, String) {
    let mask = 1_u32 << pin.number().unwrap_or(0).min(7);
    (pin.port().unwrap_or('B'), format!("0x{mask:02X}U"))
}
