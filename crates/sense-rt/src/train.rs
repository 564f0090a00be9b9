//! The pulse train of a model receiver (PPM sum): one interval between edges for each channel, then
//! a gap.
//!
//! A train counts if it is between two gaps and all its intervals are long enough.

use crate::convert::store_ratio;
use crate::outcome::Outcome;
use crate::schema::Item;

/// The most channels of a train; trains with more are ignored.
pub const CHANNELS_MAX: usize = 16;
const US_PER_S: u64 = 1_000_000;

/// The shape of a train.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrainConfig {
    /// The clock of the timer, at least 1.
    pub tick_hz: u32,
    /// An interval longer than this starts a train: 2.7 ms.
    pub gap_ticks: u32,
    /// An interval shorter than this is a disturbance and spoils the train: 0.5 ms; 0: none does.
    pub min_ticks: u32,
}

/// The train so far: written by the capturing side, copied by the reader.
#[derive(Clone, Copy, Debug, Default)]
pub struct Train {
    last_ticks: Option<u32>,
    building: [u32; CHANNELS_MAX],
    channels: [u32; CHANNELS_MAX],
    building_count: usize,
    channels_count: usize,
    trains: u32,
    spoilt: u32,
    is_inside: bool,
}

impl Train {
    /// The state at the start.
    pub const NEW: Self = Self {
        last_ticks: None,
        building: [0; CHANNELS_MAX],
        channels: [0; CHANNELS_MAX],
        building_count: 0,
        channels_count: 0,
        trains: 0,
        spoilt: 0,
        is_inside: false,
    };

    /// The trains with a disturbance or too many channels; wraps.
    #[must_use]
    pub const fn spoilt(&self) -> u32 {
        self.spoilt
    }

    fn end(&mut self) {
        if self.is_inside && self.building_count > 0 {
            self.channels = self.building;
            self.channels_count = self.building_count;
            self.trains = self.trains.wrapping_add(1);
        }
        self.is_inside = true;
        self.building_count = 0;
    }

    fn spoil(&mut self) {
        self.is_inside = false;
        self.spoilt = self.spoilt.wrapping_add(1);
    }

    /// An edge was missed: its train does not count.
    pub fn on_loss(&mut self) {
        if self.is_inside {
            self.spoil();
        }
    }

    /// The time between two edges of the same direction, for timers that measure it.
    pub fn on_interval(&mut self, config: &TrainConfig, interval_ticks: u32) {
        if interval_ticks > config.gap_ticks {
            self.end();
        } else if self.is_inside {
            match self.building.get_mut(self.building_count) {
                Some(place) if interval_ticks >= config.min_ticks => {
                    *place = interval_ticks;
                    self.building_count += 1;
                }
                Some(_) | None => self.spoil(),
            }
        }
    }

    /// The time of an edge (all of the same direction), from a counter that wraps at 2^32.
    pub fn on_edge(&mut self, config: &TrainConfig, time_ticks: u32) {
        if let Some(last) = self.last_ticks.replace(time_ticks) {
            self.on_interval(config, time_ticks.wrapping_sub(last));
        }
    }

    /// The channels in us, rounded, if a train has come since the last call (`seen` remembers it):
    /// `Fresh`; `Invalid` if it has fewer channels than the item has elements. Further channels are
    /// ignored.
    pub fn read(
        &self,
        config: &TrainConfig,
        seen: &mut u32,
        item: &Item,
        value: &mut [u8],
    ) -> Outcome {
        if self.trains == *seen {
            return Outcome::Nothing;
        }
        *seen = self.trains;
        let channels = self.channels.get(..self.channels_count).unwrap_or_default();
        if channels.len() < usize::from(item.count) {
            return Outcome::Invalid;
        }
        let elements = value.chunks_mut(item.scalar.bytes()).take(usize::from(item.count));
        for (element, channel) in elements.zip(channels) {
            let numerator = u64::from(*channel) * US_PER_S;
            store_ratio(item.scalar, numerator, config.tick_hz.into(), element);
        }
        Outcome::Fresh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Scalar;

    const CONFIG: TrainConfig =
        TrainConfig { tick_hz: 1_000_000, gap_ticks: 2_700, min_ticks: 500 };
    const ITEM: Item = Item::sensor(20, Scalar::Uint16, 3);

    #[test]
    fn a_train_of_which_an_edge_was_missed_does_not_count() {
        let (mut train, mut seen, mut value) = (Train::NEW, 0, [0; 6]);
        let mut feed = |lost: Option<usize>| {
            for (place, ticks) in [5_000, 1_000, 1_200, 1_400, 5_000].into_iter().enumerate() {
                if lost == Some(place) {
                    train.on_loss();
                } else if lost.map(|lost| lost.wrapping_sub(1)) != Some(place) {
                    train.on_interval(&CONFIG, ticks);
                }
            }
            train.read(&CONFIG, &mut seen, &ITEM, &mut value)
        };
        assert_eq!(feed(None), Outcome::Fresh);
        // The interval that ends with the missed edge never comes; the next one comes after the
        // loss is reported.
        assert_eq!(feed(Some(2)), Outcome::Nothing);
        assert_eq!(feed(None), Outcome::Fresh);
        assert_eq!(train.spoilt(), 1);
    }
}
