//! What Embassy firmware cannot do yet. Every gap is reported; nothing is left out in silence.

use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_model::kind::{Kind, KindName, Role};

use super::hal::Hal;
use super::names::Names;
use super::rp;
use crate::job::{BoardJob, JobConnection};

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
        Kind::Pwm(_) if is_complementary(connection) => {
            Some("complementary outputs in Embassy's firmware")
        }
        Kind::I2c(_) | Kind::Spi(_) if on_buses(job, connection) > 1 => {
            Some("parts with two connections to buses in Embassy's firmware")
        }
        Kind::Can(_) if !has_can_banks(job) => Some("FDCAN controllers in Embassy's firmware"),
        Kind::Can(_) if connection.unit.is_some_and(|unit| unit == "CAN2" || unit == "CAN3") => {
            Some("the second CAN controller in Embassy's firmware")
        }
        Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_) => None,
    }
}

/// Whether an output is the complement of its timer's channel.
fn is_complementary(connection: &JobConnection<'_>) -> bool {
    let function = connection.pad(Role::Out).and_then(|pad| Some(pad.usage?.signal.function()));
    matches!(function, Some(Function::Timer { line: TimerLine::Inverted, .. }))
}

/// Connections of the same part to buses of the same kind.
fn on_buses(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> usize {
    let kind = connection.connection.kind.name();
    job.connections(kind).filter(|one| one.connection.part == connection.connection.part).count()
}

fn hal(job: &BoardJob<'_>) -> Option<Hal> {
    Some(Names::of(job.profile?).ok()?.hal)
}

fn has_can_banks(job: &BoardJob<'_>) -> bool {
    job.profile.is_some_and(|profile| Names::of(profile).is_ok_and(|names| names.has_can_banks()))
}
