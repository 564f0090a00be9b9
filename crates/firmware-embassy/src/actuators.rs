//! What the host sets: the actuators of a kind, and how the bytes of their values come to their wires.

use sensedsl_model::kind::KindName;
use sensedsl_model::kind::digital::Digital;
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};

/// The actuators of a kind.
pub(super) fn actuators<'a>(context: &Context<'a>, kind: KindName) -> Vec<Wired<'a>> {
    let all = context.wired(kind).into_iter();
    all.filter(|one| one.device.device.direction == Direction::Actuator).collect()
}

/// Whether the outputs of a device are those of a bridge.
pub(super) fn is_bridge(wired: &Wired<'_>) -> bool {
    wired.device.device.coding.drive.is_some()
}

/// The type of an element and an expression for its bytes in the value that has come.
pub(super) fn element(wired: &Wired<'_>, at: usize) -> (String, String) {
    let value = wired.device.device.value.value;
    let start = at * value.scalar.size_bytes();
    (scalar(value.scalar), format!("value.get({start}..).unwrap_or_default()"))
}

/// The level of a pin that is on or off.
pub(super) const fn level_of(own: &Digital, is_on: bool) -> &'static str {
    if is_on == own.active_low { "Level::Low" } else { "Level::High" }
}

/// A level in ten-thousandths, as the runtime counts.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is clamped")]
pub(super) fn level(value: f64) -> u32 {
    value.clamp(0.0, 10_000.0).round() as u32
}
