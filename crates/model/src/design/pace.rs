//! How often values come: what the cycle times of a design, the waiting times of its parts and the turns of its rangers
//! come to.

use sensedsl_wire::Direction;

use super::{Design, Device, Link};

/// Time between two measurements, for the transfer that starts one and a tick of the kernel.
const GAP_MS: u32 = 1;

impl Link {
    /// The time between two reports that its `rate` asks for, in whole milliseconds; none where each goes out when it is
    /// due.
    #[must_use]
    pub fn report_ms(&self) -> Option<u32> {
        self.rate_hz.map(|rate| 1_000_u32.div_ceil(rate.max(1)))
    }
}

impl Device {
    /// The time from one measurement to the next, in milliseconds; none for a device that measures on its own.
    ///
    /// A part that needs time for its answer is asked each cycle, and answers once that time is over.
    #[must_use]
    pub fn measured_every_ms(&self) -> Option<u32> {
        let delay_ms = self.delay_ms.max(1);
        let of_onewire = || self.kind.onewire().map(|own| own.wait_us);
        let wait_us = self.kind.i2c().map(|own| own.wait_us).or_else(of_onewire).unwrap_or(0);
        let cycles = wait_us.div_ceil(1_000).div_ceil(delay_ms).max(1);
        (!self.kind.measures_itself()).then(|| cycles.saturating_mul(delay_ms))
    }

    /// How long one measurement takes with the gap behind it, in milliseconds.
    #[must_use]
    pub fn measuring_ms(&self) -> u32 {
        self.kind.measuring_us().div_ceil(1_000) + GAP_MS
    }

    /// How long its turn takes, in milliseconds: for an array that measures on demand, the elements one after the other.
    #[must_use]
    pub fn turn_ms(&self) -> u32 {
        let is_asked = self.kind.pulse_us().is_some();
        let elements = self.value.value.length.filter(|_| is_asked).map_or(1, u32::from);
        self.measuring_ms().saturating_mul(elements)
    }
}

impl Design {
    /// How often a device's value can be counted on, in milliseconds; none if it is set, or comes when something
    /// happens. What counts on its own is told when it has changed.
    ///
    /// Rangers of one group wait for each other, so that no value comes sooner than all their turns take where the cycle
    /// is too short for them.
    #[must_use]
    pub fn paced_ms(&self, device: &Device) -> Option<u32> {
        let own_ms =
            device.measured_every_ms().filter(|_| device.direction == Direction::Sensor)?;
        let board = |one: &Device| self.part(one.part).map(|part| part.board);
        let Some(group) = device.group.as_ref().filter(|_| device.kind.pulse_us().is_some()) else {
            return Some(own_ms);
        };
        let shares = |one: &&Device| {
            let is_in_it = one.group.as_ref().is_some_and(|own| own.name == group.name);
            is_in_it && one.kind.pulse_us().is_some() && board(one) == board(device)
        };
        let turns = self.devices.iter().filter(shares).map(Device::turn_ms);
        Some(own_ms.max(turns.fold(0, u32::saturating_add)))
    }

    /// How often the host can count on a device's value, in milliseconds: as often as it comes, or as the link's `rate`
    /// lets reports go out.
    #[must_use]
    pub fn told_every_ms(&self, device: &Device) -> Option<u32> {
        let board = self.part(device.part)?.board.and_then(|board| self.board(board));
        let report_ms = board.and_then(|board| board.link.report_ms());
        self.paced_ms(device).map(|own_ms| own_ms.max(report_ms.unwrap_or(0)))
    }
}
