//! Whose HAL a project uses, and what all kinds say in its words.

use sensedsl_board::pin::PinName;
use serde::Deserialize;

use super::context::Context;

/// A crate of Embassy with the drivers of some MCUs. Where kinds differ between them, each has a file of its own: those
/// of [`Hal::Rp`] are in `rp/`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Hal {
    /// `embassy-stm32`
    #[default]
    Stm32,
    /// `embassy-rp`, of RP2040 and RP2350.
    Rp,
}

/// How fast the edges of an output are, where that can be said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Speed {
    Low,
    Medium,
}

impl Hal {
    /// What `main.rs` imports of the HAL.
    pub(super) const fn main_uses(self) -> &'static str {
        match self {
            Self::Stm32 => include_str!("templates/stm32/main_uses.rs.txt"),
            Self::Rp => include_str!("templates/rp/main_uses.rs.txt"),
        }
    }

    /// What `wiring.rs` imports of the HAL.
    pub(super) const fn wiring_uses(self) -> &'static str {
        match self {
            Self::Stm32 => include_str!("templates/stm32/wiring_uses.rs.txt"),
            Self::Rp => include_str!("templates/rp/wiring_uses.rs.txt"),
        }
    }

    /// What writes a program to a board without a debug probe, where its boot loader takes one over USB.
    pub(super) const fn loader(self) -> Option<&'static str> {
        match self {
            Self::Stm32 => None,
            Self::Rp => Some("picotool load -u -v -x -t elf"),
        }
    }

    /// The number of the least urgent interrupt that tasks can run in.
    pub(super) fn last_priority(self, target: &str) -> usize {
        match self {
            Self::Stm32 if target.starts_with("thumbv6m") => 3,
            Self::Stm32 => 7,
            // The HAL has two bits for all its chips.
            Self::Rp => 3,
        }
    }

    /// What the HAL calls a pin: `PA1`, or `PIN_1` of `GP1`.
    pub(super) fn pin(self, pin: &PinName) -> String {
        match self {
            Self::Stm32 => pin.to_string(),
            Self::Rp => match pin.as_str().strip_prefix("GP") {
                Some(number) => format!("PIN_{number}"),
                None => pin.to_string(),
            },
        }
    }
}

impl Context<'_> {
    /// What the HAL calls a pin.
    pub(super) fn pin(&self, pin: &PinName) -> String {
        self.names.hal.pin(pin)
    }

    /// An output that begins with a level: `Level::Low`.
    pub(super) fn output(&self, pin: &PinName, level: &str, speed: Speed) -> String {
        let pin = self.pin(pin);
        match self.names.hal {
            Hal::Stm32 => {
                let speed = match speed {
                    Speed::Low => "Low",
                    Speed::Medium => "Medium",
                };
                format!("Output::new(p.{pin}, {level}, Speed::{speed})")
            }
            Hal::Rp => format!("Output::new(p.{pin}, {level})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Hal, PinName};

    #[test]
    fn pins_are_called_as_the_hal_calls_them() {
        let name = |hal: Hal, pin: &str| PinName::parse(pin).map(|pin| hal.pin(&pin));
        assert_eq!(name(Hal::Rp, "GP26").as_deref(), Some("PIN_26"));
        assert_eq!(name(Hal::Stm32, "PC13").as_deref(), Some("PC13"));
    }
}
