//! The timer that the HAL's clock runs on, and the tree of clocks that the firmware sets.

use std::collections::BTreeSet;

use sensedsl_board::catalog::Crystal;
use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;
use sensedsl_job::BoardJob;
use serde::Deserialize;

/// The first timer of the profile that no device uses; `None` if all are taken.
pub(super) fn timer(job: &BoardJob<'_>, profile: &TargetProfile) -> Option<String> {
    let units: BTreeSet<UnitName> =
        job.connections.iter().filter_map(|one| one.unit).map(UnitName::new).collect();
    let is_free = |timer: &&String| !units.contains(&UnitName::new(timer));
    profile.kernel.timers.iter().find(is_free).cloned()
}

/// How the firmware sets the clocks of a line: members of the HAL's configuration and their values.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Clock {
    /// The members that are the same whatever drives the tree.
    #[serde(default)]
    set: Vec<String>,
    /// What can drive it, best first; all ways give the same clocks.
    ways: Vec<Way>,
}

/// An oscillator and what is made of it. `{hse}` stands for the frequency of the crystal, `{mode}` for whether it is a
/// crystal or a driven clock, `{divide}` for its frequency in whole megahertz.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Way {
    /// The crystals that it takes; `None` for the internal oscillator.
    crystal: Option<Crystals>,
    #[serde(default)]
    set: Vec<String>,
    /// The members that give a USB device its 48 MHz; `None` if it cannot have them.
    usb: Option<Vec<String>>,
}

/// A range of crystals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Crystals {
    least_hz: u32,
    greatest_hz: u32,
    /// Only multiples of this frequency.
    step_hz: u32,
}

impl Crystals {
    fn takes(self, hz: u32) -> bool {
        (self.least_hz..=self.greatest_hz).contains(&hz) && hz.is_multiple_of(self.step_hz.max(1))
    }
}

impl Clock {
    /// The assignments for a board; `None` if no oscillator gives what is needed.
    pub(super) fn lines(&self, crystal: &Crystal, needs_usb: bool) -> Option<Vec<String>> {
        let fits = |way: &&Way| {
            let is_driven = match way.crystal {
                Some(crystals) => crystal.hse_hz.is_some_and(|hz| crystals.takes(hz)),
                None => true,
            };
            is_driven && (!needs_usb || way.usb.is_some())
        };
        let way = self.ways.iter().find(fits)?;
        let hse_hz = crystal.hse_hz.unwrap_or(0);
        let mode = if crystal.hse_driven { "Bypass" } else { "Oscillator" };
        let usb = way.usb.iter().flatten().filter(|_| needs_usb);
        let lines = self.set.iter().chain(&way.set).chain(usb);
        let filled = lines.map(|line| {
            line.replace("{hse}", &hse_hz.to_string())
                .replace("{mode}", mode)
                .replace("{divide}", &(hse_hz / 1_000_000).to_string())
        });
        Some(filled.collect())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;

    #[test]
    fn the_first_way_that_fits_is_taken() {
        let clock: Clock = toml::from_str(
            r#"
            set = ["sys = Sysclk::PLL1_P"]
            [[ways]]
            crystal = { least_hz = 2_000_000, greatest_hz = 50_000_000, step_hz = 1_000_000 }
            set = ["hse = {hse} {mode} {divide}"]
            usb = ["usb"]
            [[ways]]
            set = ["hsi"]
            "#,
        )
        .unwrap();
        let crystal = |hse_hz, hse_driven| Crystal { hse_hz, hse_driven, ..Crystal::default() };
        let lines =
            |hse_hz, usb| clock.lines(&crystal(hse_hz, true), usb).map(|all| all.join(", "));
        assert_eq!(
            lines(Some(8_000_000), true).unwrap(),
            "sys = Sysclk::PLL1_P, hse = 8000000 Bypass 8, usb"
        );
        assert_eq!(lines(Some(12_288_000), false).unwrap(), "sys = Sysclk::PLL1_P, hsi");
        assert_eq!(lines(None, true), None);
        let own = clock.lines(&crystal(Some(8_000_000), false), false).unwrap();
        assert_eq!(own[1], "hse = 8000000 Oscillator 8");
    }
}
