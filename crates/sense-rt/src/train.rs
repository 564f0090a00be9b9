//! The pulse train of a model receiver (PPM sum): one interval between edges for each channel, and a
//! gap.
//!
//! A train counts if it is between two gaps and each of its intervals is long enough.

use crate::convert::store_ratio;
use crate::outcome::Outcome;
use crate::schema::Item;

/// Trains with more channels are not taken.
pub const CHANNELS_MAX: usize = 16;
const US_PER_S: u64 = 1_000_000;

/// What a train looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrainConfig {
    /// Of the timer, at least 1.
    pub tick_hz: u32,
    /// A longer interval starts a train: 2.7 ms.
    pub gap_ticks: u32,
    /// A shorter one is a disturbance and spoils the train: 0.5 ms; 0: none is.
    pub min_ticks: u32,
}

/// What was seen of a train: written by the side that captures, copied by the reader.
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
    /// At the start.
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

    /// Trains with a disturbance or too many channels; wraps.
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

    /// An edge was not taken in time: the train that it is of does not count.
    pub fn on_loss(&mut self) {
        if self.is_inside {
            self.spoil();
        }
    }

    /// The time between two edges of one direction, where the timer measures that itself.
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

    /// The time of an edge (all of one direction), from a counter that wraps at 2^32.
    pub fn on_edge(&mut self, config: &TrainConfig, time_ticks: u32) {
        if let Some(last) = self.last_ticks.replace(time_ticks) {
            self.on_interval(config, time_ticks.wrapping_sub(last));
        }
    }

    /// The channels in us, rounded, when a train has come since the last look (`seen` remembers it):
    /// fresh; invalid when it has fewer channels than the item has elements. More are left out.
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
        // The interval that ends with the missed edge never comes, and the next one is told with the loss.
        assert_eq!(feed(Some(2)), Outcome::Nothing);
        assert_eq!(feed(None), Outcome::Fresh);
        assert_eq!(train.spoilt(), 1);
    }
}
