//! What Embassy firmware cannot do yet. Every gap is reported; nothing is left out in silence.

use sensedsl_model::kind::{Kind, KindName};

use super::hal::Hal;
use super::names::Names;
use super::rp;
use sensedsl_job::{BoardJob, JobConnection};

/// The kinds that there is code for.
pub(super) const KINDS: &[KindName] = &[
    KindName::Analog,
    KindName::I2c,
    KindName::Icu,
    KindName::Encoder,
    KindName::Digital,
    KindName::Pwm,
    KindName::Dac,
    KindName::Uart,
    KindName::Spi,
    KindName::Can,
];

/// What a connection needs and no code is made for.
pub(super) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    match hal(job) {
        Some(Hal::Rp) => {
            if let Some(gap) = rp::gaps::lacks(job, connection) {
                return Some(gap);
            }
        }
        Some(Hal::Stm32) | None => {}
    }
    match &connection.connection.kind {
        Kind::I2c(_) | Kind::Spi(_) => job.lacks_on_buses(connection),
        Kind::Analog(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_) => None,
    }
}

fn hal(job: &BoardJob<'_>) -> Option<Hal> {
    Some(Names::of(job.profile?).ok()?.hal)
}
