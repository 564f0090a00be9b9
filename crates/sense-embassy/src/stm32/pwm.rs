//! Pulse widths.

use embassy_stm32::timer::GeneralInstance4Channel;
use embassy_stm32::timer::simple_pwm::SimplePwmChannel;
use sense_rt::pulse_counts;

/// Sets the pulse of a level, from the least to the greatest of `[least, greatest, period]` in any unit.
pub fn set_width<T: GeneralInstance4Channel>(
    channel: &mut SimplePwmChannel<'_, T>,
    pulse: [u32; 3],
    level: u32,
) {
    channel.set_duty_cycle(pulse_counts(channel.max_duty_cycle(), pulse, level));
}
