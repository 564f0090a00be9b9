//! Values of converters.

use sense_rt::{Filter, Formula, Outcome, Scalar, store_mean, store_signed};

use super::shared::Tell;

/// What is made of the mean of the samples.
pub enum Value {
    /// The mean.
    Mean,
    /// An output of a formula, with the formula's parameters.
    Computed(&'static Formula, usize, &'static [i32]),
}

/// Tells the value of one device: of each element what is made of the mean of its samples, which are element by
/// element. One element without a measurement makes the whole value invalid.
pub fn tell(
    board: &dyn Tell,
    filter: Option<&mut Filter>,
    index: usize,
    scalar: Scalar,
    how: Value,
    samples: &[u16],
    count: usize,
    value: &mut [u8],
) {
    let mut outcome = Outcome::Fresh;
    for at in 0..count {
        let own = samples.get(at..).unwrap_or_default();
        let element = value.get_mut(at * scalar.bytes()..).unwrap_or_default();
        match &how {
            Value::Mean => store_mean(scalar, own, count, element),
            Value::Computed(formula, output, parameters) => {
                let mut raw = [0; 2];
                store_mean(Scalar::Uint16, own, count, &mut raw);
                let outputs = formula.compute(&[], parameters, &raw);
                match outputs.as_ref().and_then(|outputs| outputs.get(*output)) {
                    Some(number) => store_signed(scalar, *number, element),
                    None => outcome = Outcome::Invalid,
                }
            }
        }
    }
    board.tell(filter, index, outcome, value);
}
