//! Pulse widths.

use embassy_stm32::timer::GeneralInstance4Channel;
use embassy_stm32::timer::simple_pwm::SimplePwmChannel;

/// Sets the share of the period in which the output is high, and turns it on.
pub fn set_pulse<T: GeneralInstance4Channel>(
    channel: &mut SimplePwmChannel<'_, T>,
    share: u32,
    whole: u32,
) {
    if share >= whole {
        channel.set_duty_cycle_fully_on();
    } else {
        let duty = u64::from(channel.max_duty_cycle()) * u64::from(share) / u64::from(whole.max(1));
        channel.set_duty_cycle(u32::try_from(duty).unwrap_or(0));
    }
    channel.enable();
}
