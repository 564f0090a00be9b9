//! Values of converters.

use sense_rt::{Outcome, Scalar, store_mean};

use super::shared::Tell;

/// Tells the value of one device: of each element the mean of its samples, which stand element by element.
pub fn tell(board: &dyn Tell, filter: Option<&mut sense_rt::Filter>, index: usize, scalar: Scalar, samples: &[u16], count: usize, value: &mut [u8]) {
    for element in 0..count {
        let own = samples.get(element..).unwrap_or_default();
        store_mean(scalar, own, count, value.get_mut(element * scalar.bytes()..).unwrap_or_default());
    }
    board.tell(filter, index, Outcome::Fresh, value);
}
