//! Timers that capture edges and pulses.

use embassy_stm32::pac::timer::TimGp16;
use embassy_stm32::timer::input_capture::InputCapture;
use embassy_stm32::timer::pwm_input::PwmInput;
use embassy_stm32::timer::{Channel, GeneralInstance4Channel};
use embassy_time::Instant;
use sense_rt::{Captured, TrainConfig};

use crate::capture::{Edges, SharedCapture, SharedTrain, note};

/// Counts edges, for ever.
pub async fn count<T: GeneralInstance4Channel>(
    mut timer: InputCapture<'static, T>,
    channel: Channel,
    edges: Edges,
    seen: &SharedCapture,
) -> ! {
    loop {
        match edges {
            Edges::Rising => timer.wait_for_rising_edge(channel).await,
            Edges::Falling => timer.wait_for_falling_edge(channel).await,
            Edges::Both => timer.wait_for_any_edge(channel).await,
        };
        note(seen, Captured::on_edge);
    }
}

/// Ticks between two edges. The timer starts anew with the first of them, and the count that it takes at the second
/// begins with 0.
fn between(captured: u32) -> u32 {
    captured.saturating_add(1)
}

/// Measures widths, or periods with their widths, for ever. What is longer than the timer counts is left out, and so
/// is the time before the first edge.
pub async fn measure<T: GeneralInstance4Channel>(
    mut timer: PwmInput<'static, T>,
    is_width: bool,
    tick_hz: u32,
    seen: &SharedCapture,
) -> ! {
    timer.enable();
    let mut last: Option<Instant> = None;
    loop {
        let ticks =
            if is_width { timer.wait_for_width().await } else { timer.wait_for_period().await };
        let now = Instant::now();
        let gap_us = last.replace(now).map(|last| (now - last).as_micros());
        if is_width {
            note(seen, |captured| captured.on_width(between(ticks), false));
            continue;
        }
        // 16 bits, whatever the timer has.
        let longest_us = 65_535_000_000 / u64::from(tick_hz.max(1));
        let is_whole = gap_us.is_some_and(|gap| gap <= longest_us);
        let width = timer.get_width_ticks();
        note(seen, |captured| {
            if is_whole {
                captured.on_width(between(width), false);
                captured.on_period(between(ticks));
            } else {
                captured.on_edge();
            }
        });
    }
}

/// Whether an edge came before the one ahead of it was taken, since the last call: the timer has kept the later one.
fn has_lost<T: GeneralInstance4Channel>(channel: Channel) -> bool {
    // SAFETY: the pointer is that of the timer's registers, of which all such timers have these.
    let timer = unsafe { TimGp16::from_ptr(T::regs()) };
    let has_lost = timer.sr().read().ccof(channel.index());
    if has_lost {
        // Flags that are written as 1 stay as they are.
        timer.sr().write(|flags| {
            flags.0 = u32::MAX;
            flags.set_ccof(channel.index(), false);
        });
    }
    has_lost
}

/// Measures the intervals of a pulse train, for ever. What is longer than the timer counts is a gap.
pub async fn train<T: GeneralInstance4Channel>(
    mut timer: PwmInput<'static, T>,
    channel: Channel,
    config: &TrainConfig,
    seen: &SharedTrain,
) -> ! {
    timer.enable();
    let longest_us = 65_535_000_000 / u64::from(config.tick_hz.max(1));
    let mut last: Option<Instant> = None;
    loop {
        let ticks = timer.wait_for_period().await;
        let now = Instant::now();
        let is_lost = has_lost::<T>(channel);
        // Before the first edge there is no interval, and what comes after it may be the rest of a train.
        let Some(last) = last.replace(now) else { continue };
        let is_whole = (now - last).as_micros() <= longest_us;
        seen.lock(|cell| {
            let mut train = cell.get();
            if is_lost {
                train.on_loss();
            } else {
                train.on_interval(config, if is_whole { between(ticks) } else { u32::MAX });
            }
            cell.set(train);
        });
    }
}
