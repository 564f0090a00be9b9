//! The HALs: a folder each, and a line of [`HALS`]. Nothing outside of a folder names its HAL.
//!
//! In: a target profile, which names its HAL by a word. Out: the HAL with its drivers for the profile's line of MCUs.

pub(crate) mod contract;
mod counted;
mod dma;
mod esp;
mod nrf;
mod rp;
mod stm32;
mod timed;

use sensedsl_board::profile::TargetProfile;

use crate::names::Names;
use contract::{Drivers, Hal};

/// All HALs. A profile that names none has the first.
pub(crate) const HALS: &[&dyn Hal] = &[&stm32::Stm32, &rp::Rp, &nrf::Nrf, &esp::Esp];

/// The HAL of a profile, with all that is read from it.
pub(crate) struct Opened {
    pub(crate) names: Names,
    pub(crate) hal: &'static dyn Hal,
    pub(crate) drivers: Box<dyn Drivers>,
}

impl Opened {
    /// Reads what a profile keeps for this target.
    ///
    /// # Errors
    ///
    /// What is wrong with it.
    pub(crate) fn new(profile: &TargetProfile, hals: &[&'static dyn Hal]) -> Result<Self, String> {
        let names = Names::of(profile)?;
        let is_named = |hal: &&&dyn Hal| match &names.hal {
            Some(word) => hal.package().name == word,
            None => true,
        };
        let hal = hals.iter().find(is_named).copied().ok_or_else(|| {
            let known: Vec<String> =
                hals.iter().map(|hal| format!("`{}`", hal.package().name)).collect();
            let word = names.hal.as_deref().unwrap_or_default();
            format!("unknown HAL `{word}`, expected one of {}", known.join(", "))
        })?;
        let drivers = hal.drivers(&names)?;
        Ok(Self { names, hal, drivers })
    }

    /// What is wrong with the names of a profile.
    pub(crate) fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        let mut problems = self.names.problems(profile);
        problems.extend(self.drivers.project().problems(profile, &self.names));
        problems
    }
}
