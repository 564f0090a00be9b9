//! Pulse widths.

use embassy_stm32::timer::GeneralInstance4Channel;
use embassy_stm32::timer::simple_pwm::SimplePwmChannel;
use sense_rt::LEVEL_FULL;

/// Sets the pulse of a level, from the least to the greatest of `[least, greatest, period]` in any unit.
pub fn set_width<T: GeneralInstance4Channel>(
    channel: &mut SimplePwmChannel<'_, T>,
    [least, greatest, period]: [u32; 3],
    level: u32,
) {
    let full = u64::from(LEVEL_FULL);
    let level = u64::from(level.min(LEVEL_FULL));
    let width = u64::from(least) * (full - level) + u64::from(greatest) * level;
    let whole = u64::from(period.max(1)) * full;
    if width >= whole {
        channel.set_duty_cycle_fully_on();
    } else {
        let duty = (u64::from(channel.max_duty_cycle()) * width + whole / 2) / whole;
        channel.set_duty_cycle(u32::try_from(duty).unwrap_or(0));
    }
}
