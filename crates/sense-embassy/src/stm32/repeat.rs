//! Converters that repeat their last conversion when they are started again.

use embassy_stm32::pac::adc::Adc;

/// Fills all slots with samples of one input. `first` is its first one, which set the converter up; the others only
/// start it again.
pub fn fill<'a>(converter: Adc, first: u16, slots: impl Iterator<Item = &'a mut u16>) {
    let mut sample = Some(first);
    for slot in slots {
        *slot = sample.take().unwrap_or_else(|| convert(converter));
    }
}

/// The last conversion once more; reading its result acknowledges it.
fn convert(converter: Adc) -> u16 {
    converter.cr2().modify(|control| control.set_swstart(true));
    while !converter.sr().read().eoc() {}
    converter.dr().read().data()
}
