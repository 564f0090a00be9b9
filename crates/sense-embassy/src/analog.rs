//! Analog devices: values are made of the samples of a converter.

use sense_rt::{Filter, Formula, Outcome, Scalar, store_mean, store_signed};

use crate::devices::Report;

/// The value that is made of the mean of an element's samples.
pub enum Value {
    /// The mean itself.
    Mean,
    /// An output of a formula, with the formula's parameters.
    Computed(&'static Formula, usize, &'static [i32]),
}

/// Reports the value of a device. `samples` are those of its `count` elements in turn, again and
/// again; `value` is room for the value. One element without a measurement makes the whole value
/// invalid.
#[expect(
    clippy::too_many_arguments,
    reason = "a generator prints the calls, and a table would take flash"
)]
pub fn report(
    board: &dyn Report,
    filter: Option<&mut Filter>,
    index: usize,
    scalar: Scalar,
    how: &Value,
    samples: &[u16],
    count: usize,
    value: &mut [u8],
) {
    let mut outcome = Outcome::Fresh;
    for at in 0..count {
        let own = samples.get(at..).unwrap_or_default();
        let element = value.get_mut(at * scalar.bytes()..).unwrap_or_default();
        match how {
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
    board.report(filter, index, outcome, value);
}
