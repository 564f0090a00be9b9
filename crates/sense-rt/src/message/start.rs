//! Setting up a serial device.

use crate::chip::InitStep;

/// How far the setup of a serial device has come.
#[derive(Clone, Copy, Debug, Default)]
pub struct MessageStart {
    pause_until_ms: Option<u32>,
    at: usize,
}

impl MessageStart {
    /// The state at the start.
    pub const NEW: Self = Self { pause_until_ms: None, at: 0 };

    /// The step whose bytes must be sent now; call again until it is `None`. Then there is a pause
    /// (call again in the next cycle), or all steps are done.
    pub fn next(&mut self, init: &'static [InitStep], now_ms: u32) -> Option<&'static InitStep> {
        if self.pause_until_ms.is_some_and(|until| now_ms.wrapping_sub(until) >= 0x8000_0000) {
            return None;
        }
        self.pause_until_ms = None;
        let step = init.get(self.at)?;
        self.at += 1;
        if step.pause_ms > 0 {
            // One more, because the first millisecond is cut short.
            self.pause_until_ms = Some(now_ms.wrapping_add(u32::from(step.pause_ms) + 1));
        }
        Some(step)
    }
}
