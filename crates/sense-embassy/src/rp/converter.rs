//! The converter, whose conversions may fail.

use embassy_rp::adc::{Adc, Async, Channel};

/// Takes a sample; false if the conversion failed.
pub async fn read(
    adc: &mut Adc<'static, Async>,
    input: &mut Channel<'static>,
    sample: &mut u16,
) -> bool {
    match adc.read(input).await {
        Ok(value) => {
            *sample = value;
            true
        }
        Err(_) => false,
    }
}
